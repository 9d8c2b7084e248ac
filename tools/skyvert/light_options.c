#include "light_options.h"

#include <stdio.h>
#include <string.h>

#include "all_orders.h"
#include "command.h"

static const char *const switch_names[] = {"off", "on", NULL};
static const char *const choice_names[] = {"off", "on", "auto", NULL};

// clang-format off
const char light_options_help[] =
    "Light:\n"
    "  --orders all|single    orders of scattering: all (default), by a table that is built first, or one\n"
    "  --table accurate|small|large  which table (default accurate)\n"
    "  --grid auto|on|off     light scattered more than once by a grid per picture, or ray by ray; auto\n"
    "                         (default): by a grid from 2000 rays on, but not from above the air\n"
    "  --discs on|off         the discs of sun and moon (default on; of a dome: off)\n"
    "  --moon auto|on|off     the moon, as a disc and, when the sun is down, as a light; auto (default): on\n"
    "                         Earth where position and time, or --moon-zenith-deg, say where it stands\n"
    "  --night auto|on|off    airglow, zodiacal light and faint stars; auto (default): on Earth, where\n"
    "                         position and time are given. Single stars are not drawn\n"
    "  --wind-m-s W           over water: 0 (a mirror) to 40 (default 5)\n"
    "  --wind-azimuth-deg A   where it comes from, clockwise from north (default 270)\n";
// clang-format on

void light_options_begin(light_options *options) {
    *options = (light_options){.orders = 1,
                               .table = SKV_TABLE_ACCURATE,
                               .grid = CHOICE_AUTO,
                               .discs = CHOICE_ON,
                               .moon = CHOICE_AUTO,
                               .night = CHOICE_AUTO,
                               .wind_m_s = 5.0,
                               .wind_azimuth_deg = 270.0};
}

int light_options_take(light_options *options, const char *command, int option, const char *value) {
    switch (option) {
    case OPT_ORDERS:
        return option_choice(command, "--orders", value, order_names, &options->orders);
    case OPT_TABLE:
        return option_choice(command, "--table", value, table_names, &options->table);
    case OPT_GRID:
        return option_choice(command, "--grid", value, choice_names, &options->grid);
    case OPT_DISCS:
        return option_choice(command, "--discs", value, switch_names, &options->discs);
    case OPT_MOON:
        return option_choice(command, "--moon", value, choice_names, &options->moon);
    case OPT_NIGHT:
        return option_choice(command, "--night", value, choice_names, &options->night);
    case OPT_WIND:
        return option_number(command, "--wind-m-s", value, 0.0, (double)SKV_WIND_MAX, &options->wind_m_s);
    case OPT_WIND_AZIMUTH:
        return option_number(command, "--wind-azimuth-deg", value, -360.0, 360.0, &options->wind_azimuth_deg);
    default:
        return -1;
    }
}

char *light_options_describe(const light_options *options, char *text, size_t size) {
    if (options->orders == 0)
        snprintf(text, size, "light scattered once");
    else
        snprintf(text, size, "all orders of scattering (%s table)", table_names[options->table]);
    return text;
}

void water_albedo(int bands, const float wavelength_nm[], float albedo[]) {
    static const struct {
        float nm, albedo;
    } row[] = {{400.0f, 0.037f},  {443.0f, 0.033f},  {490.0f, 0.019f}, {520.0f, 0.0084f},
               {550.0f, 0.0051f}, {600.0f, 0.0013f}, {670.0f, 0.0003f}};
    enum { ROWS = sizeof row / sizeof row[0] };
    for (int b = 0; b < bands; b++) {
        const float nm = wavelength_nm[b];
        int i = 0;
        while (i < ROWS - 2 && nm > row[i + 1].nm)
            i++;
        float t = (nm - row[i].nm) / (row[i + 1].nm - row[i].nm);
        t = t < 0.0f ? 0.0f : t > 1.0f ? 1.0f : t;
        albedo[b] = row[i].albedo + t * (row[i + 1].albedo - row[i].albedo);
    }
}
