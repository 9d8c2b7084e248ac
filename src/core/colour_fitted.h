// Made by tools/fit/colour.py from skies of 48 wavelengths; Delta E: `colour.py --report`. `make fit-check` compares.
// clang-format off
#ifndef SKV_CORE_COLOUR_FITTED_H
#define SKV_CORE_COLOUR_FITTED_H

// Luminance of linear BT.709 red, green and blue.
static const float skv_luma[3] = {0.212639f, 0.7151687f, 0.07219232f};

// Bands; wavelengths, nm; rows R, G, B per W m^-2 sr^-1 nm^-1.
static const skv_colour_set skv_colour_sets[4] = {
    {3, {450.0f, 535.0f, 610.0f, 0.0f}, {
        {1.65228f, -34.2453f, 124.5194f, 0.0f},
        {-3.938174f, 72.26983f, -0.2375659f, 0.0f},
        {68.38476f, -2.252638f, -3.111617f, 0.0f}}},
    {4, {445.0f, 520.0f, 570.0f, 630.0f}, {
        {3.96342f, -39.7866f, 50.09674f, 71.87299f},
        {-5.488479f, 46.75962f, 34.04927f, -4.734042f},
        {63.43144f, 12.07355f, -9.691712f, -0.5496469f}}},
    {4, {440.0f, 520.0f, 600.0f, 680.0f}, {
        {3.154437f, -30.2463f, 96.42094f, 19.07422f},
        {-2.388075f, 45.80236f, 33.2944f, -4.661233f},
        {63.85119f, 15.41499f, -8.925207f, 0.4003758f}}},
    {3, {440.0f, 550.0f, 680.0f, 0.0f}, {
        {-23.04105f, 75.79661f, 20.70773f, 0.0f},
        {5.22503f, 66.04287f, -1.169639f, 0.0f},
        {73.7811f, -1.520344f, -0.365134f, 0.0f}}},
};

#endif
