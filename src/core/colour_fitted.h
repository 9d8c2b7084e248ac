// Made by tools/fit/colour.py from skies of 48 wavelengths; Delta E: `colour.py --report`. `make fit-check` compares.
// clang-format off
#ifndef SKV_CORE_COLOUR_FITTED_H
#define SKV_CORE_COLOUR_FITTED_H

// Luminance of linear BT.709 red, green and blue.
static const float skv_luma[3] = {0.212639f, 0.7151687f, 0.07219232f};

// Bands; wavelengths, nm; rows R, G, B per W m^-2 sr^-1 nm^-1.
static const skv_colour_set skv_colour_sets[4] = {
    {3, {450.0f, 535.0f, 610.0f, 0.0f}, {
        {1.051645f, -32.47149f, 123.232f, 0.0f},
        {-3.966186f, 72.09425f, 0.03437602f, 0.0f},
        {67.57019f, -0.2097335f, -4.427175f, 0.0f}}},
    {4, {445.0f, 520.0f, 570.0f, 630.0f}, {
        {3.92215f, -39.59903f, 49.89102f, 71.89365f},
        {-5.464985f, 46.85342f, 33.66996f, -4.501557f},
        {63.27779f, 12.60343f, -10.13217f, -0.5504834f}}},
    {4, {440.0f, 520.0f, 600.0f, 680.0f}, {
        {2.048062f, -27.52874f, 95.47224f, 18.02537f},
        {-3.726475f, 48.93527f, 32.4991f, -5.944044f},
        {63.67308f, 16.76737f, -10.77226f, 0.6963133f}}},
    {3, {440.0f, 550.0f, 680.0f, 0.0f}, {
        {-24.1471f, 79.2171f, 18.34996f, 0.0f},
        {3.744048f, 68.91852f, -2.137713f, 0.0f},
        {71.45121f, 2.535979f, -1.594623f, 0.0f}}},
};

#endif
