/// `skyvert bake`: the text that goes with a table: numbers for programs (skv_bake_file.h), the mapping for people.
#include "bake.h"

#include <stdarg.h>
#include <string.h>

static void add(bake_texture *texture, const char *format, ...) SKV_PRINTF(2, 3);
static void add(bake_texture *texture, const char *format, ...) {
    const size_t used = strlen(texture->text);
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(texture->text + used, sizeof texture->text - used, format, arguments);
    va_end(arguments);
}

static const char rows_text[] =
    "# rows: the first half is sky, zenith to horizon, the second half ground, horizon to nadir; in a half of n the\n"
    "#   i-th row from the horizon has u = i/(n - 1). sky: sin(d/2) = u^2 sin(D/2), d the angle from the geometric\n"
    "#   horizon, D that of the zenith (from above the air: that of its edge; beyond is space). ground: the ray's "
    "length is a + (1 - u)^2 (b - a), a to the nadir (the\n"
    "#   altitude), b to the horizon\n";
static const char azimuth_text[] =
    "# azimuth from the sun's, phi: column i of n at sin(phi/2) = i/(n - 1); the other half of the sky is its mirror\n";
static const char sun_text[] =
    "# sun: w = .74 - sin(Z/2), g = w/(.12 + |w|), Z its zenith angle; column i of n at g = a + (b - a) i/(n - 1),\n"
    "#   a the g of cos Z = mu_s_min, b that of Z = 0\n";
static const char altitude_text[] =
    "# altitude above the ground: index i of n at top_km (i/(n - 1))^2; above the air start where the ray enters it\n";

static void add_mapping(bake_texture *texture) {
    static const char *const axes[] = {"x azimuth, y rows", "x rows, y altitude",
                                       "x [azimuth][sun], y rows, z altitude", "x sun, y altitude"};
    const skv_bake_table *const map = &texture->map;
    add(texture, "# axes: %s\n", axes[map->what]);
    if (map->what != SKV_BAKE_IRRADIANCE)
        add(texture, "%s", rows_text);
    if (map->what == SKV_BAKE_SKY_VIEW || map->what == SKV_BAKE_SCATTERING)
        add(texture, "%s", azimuth_text);
    if (map->what == SKV_BAKE_SCATTERING || map->what == SKV_BAKE_IRRADIANCE)
        add(texture, "%s", sun_text);
    if (map->what != SKV_BAKE_SKY_VIEW)
        add(texture, "%s", altitude_text);
    if (map->what == SKV_BAKE_SCATTERING)
        add(texture, "# filter the two nearest azimuths apart and mix them\n");
    add(texture, "# index i of n is at the texture coordinate (i + .5)/n; samplers: skv_bake.h, skv_bake.glsl\n");
}

static void add_layers(bake_texture *texture, const bake_options *options) {
    static const char *const phases[] = {"henyey-greenstein", "cornette-shanks"};
    const skv_bake_table *const map = &texture->map;
    const char *const unit = options->rgb                       ? "linear BT.709, (1,1,1) = 1000 cd/m2 or lx"
                             : map->what == SKV_BAKE_IRRADIANCE ? "W m^-2 nm^-1"
                                                                : "W m^-2 sr^-1 nm^-1";
    for (int l = 0; l < map->layers; l++) {
        const bool plain = strcmp(texture->layer_name[l], "transmittance") == 0;
        add(texture, "layer_%d = %s\nscale_%d = %.9g\n", l, texture->layer_name[l], l, (double)map->scale[l]);
        add(texture, "# %s: %s; texels are this times scale_%d\n", texture->layer_name[l], plain ? "0 to 1" : unit, l);
    }
    for (int l = 1; l <= map->deferred; l++)
        add(texture, "phase_%d = %s\ng_%d = %.9g\n", l, phases[map->phase[l - 1]], l, (double)map->g[l - 1]);
    if (map->deferred)
        add(texture,
            "# light = radiance + the sum of the layers with a phase, each times its phase function (1/sr) of the "
            "angle\n#   between view and sun\n");
    if (map->what == SKV_BAKE_IRRADIANCE)
        add(texture,
            "# down: on a horizontal surface that faces up, without the sun; up: on one that faces down; beam: of "
            "the\n#   sun on a surface that faces it\n");
}

static void add_bands(bake_texture *texture, const bake_air *air) {
    const skv_model *const m = &air->model;
    const skv_colour_matrix *const c = &air->options->sky.matrix;
    static const char *const rows[4] = {"to_red", "to_green", "to_blue", "to_luminance"};
    add(texture, "wavelength_nm =");
    for (int b = 0; b < m->bands; b++)
        add(texture, " %g", (double)m->wavelength_nm[b]);
    if (!air->options->rgb) {
        add(texture,
            "\n# channel R is the first wavelength, G the second and so on; linear BT.709 (1 = 1000 cd/m2) and "
            "luminance\n#   (cd/m2) by the rows of numbers below, one number a channel");
        for (int row = 0; row < 4; row++) {
            add(texture, "\n%s =", rows[row]);
            for (int b = 0; b < m->bands; b++)
                add(texture, " %.9g", (double)(row < 3 ? c->rgb[row][b] : c->luminance[b]));
        }
    }
    add(texture, "\nsolar_irradiance =");
    for (int b = 0; b < m->bands; b++)
        add(texture, " %.9g", (double)(m->solar_irradiance[b] * air->sun_scale));
    add(texture, "\n# of the sun above the air, W m^-2 nm^-1\n");
}

void bake_texture_describe(bake_texture *texture, const bake_air *air, int data_offset) {
    const bake_options *const options = air->options;
    const skv_bake_table *const map = &texture->map;
    char from[400];
    texture->text[0] = '\0';
    add(texture, "skyvert-bake 1\nwhat = %s\n", bake_what_names[map->what]);
    add(texture, "# skyvert " SKV_VERSION " from %s\n", sky_options_describe(&options->sky, from, sizeof from));
    if (options->format == BAKE_RAW16F)
        add(texture,
            "data_offset = %6d\n# from there: IEEE 754 binary16, little-endian, [layer][z][y][x][channel], no gaps\n",
            data_offset);
    add(texture, "width = %d\nheight = %d\ndepth = %d\nlayers = %d\nchannels = %d\nazimuths = %d\ndeferred = %d\n",
        map->width, map->height, map->depth, map->layers, map->channels, map->azimuths, map->deferred);
    if (options->format == BAKE_EXR && map->depth > 1)
        add(texture, "# this picture has its %d slices of %d lines one below the other\n", map->depth, map->height);
    add(texture, "radius_km = %.9g\ntop_km = %.9g\nheight_km = %.9g\nmu_s = %.9g\nmu_s_min = %.9g\n",
        (double)map->radius_km, (double)map->top_km, (double)map->height_km, (double)map->mu_s, (double)map->mu_s_min);
    add(texture, "# radius_km of the ground, top_km of the air above it%s\n",
        map->what == SKV_BAKE_SKY_VIEW ? ", height_km of the observer above it, mu_s = cosine of the sun's zenith angle"
                                       : "");
    add_layers(texture, options);
    add_bands(texture, air);
    add_mapping(texture);
    add(texture, "end\n");
}
