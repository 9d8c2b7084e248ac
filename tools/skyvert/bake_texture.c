/// `skyvert bake`: which light goes into which texel.
#include "bake.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// What a frame's rays bring, [n][4] each; `ray` is the directions, [n][3].
typedef struct scratch {
    float *ray, *radiance, *once[SKV_BAKE_DEFERRED_MAX], *transmittance;
} scratch;

static bool scratch_begin(scratch *s, size_t n) {
    s->ray = malloc(3 * n * sizeof(float));
    s->radiance = calloc(4 * n, sizeof(float));
    for (int k = 0; k < SKV_BAKE_DEFERRED_MAX; k++)
        s->once[k] = calloc(4 * n, sizeof(float));
    s->transmittance = calloc(4 * n, sizeof(float));
    return s->ray && s->radiance && s->once[0] && s->once[1] && s->transmittance;
}

static void scratch_end(scratch *s) {
    free(s->ray);
    free(s->radiance);
    for (int k = 0; k < SKV_BAKE_DEFERRED_MAX; k++)
        free(s->once[k]);
    free(s->transmittance);
}

// ---- texels

/// Bands or RGB into one texel of a layer; texel = (z height + y) width + x.
static void put(const bake_texture *texture, const bake_air *air, int layer, size_t texel, const float band[4]) {
    const skv_bake_table *const map = &texture->map;
    float *const out = texture->texels + (size_t)layer * skv_bake_layer_values(map) + texel * (size_t)map->channels;
    float luminance;
    if (air->options->rgb)
        (void)skv_colour(&air->options->sky.matrix, air->model.bands, 1, band, 0, out, 0, &luminance, 0);
    else
        memcpy(out, band, (size_t)map->channels * sizeof *out);
}

/// Directions of a grid of rows and azimuths about a sun in the east: [row][azimuth].
static void directions(const skv_bake_table *map, int rows, int azimuths, float altitude_km, float *ray) {
    for (int y = 0; y < rows; y++) {
        float mu, level;
        skv_bake_row_direction(map, rows, altitude_km, y, &mu, &level);
        for (int x = 0; x < azimuths; x++, ray += 3) {
            const float half = (float)x / (float)(azimuths - 1); // sin(phi/2)
            ray[0] = level * (1.0f - 2.0f * half * half);
            ray[1] = level * 2.0f * half * sqrtf((1.0f - half) * (1.0f + half));
            ray[2] = mu;
        }
    }
}

static void sun_at(float mu_s, float sun_enu[3]) {
    sun_enu[0] = sqrtf(fmaxf((1.0f - mu_s) * (1.0f + mu_s), 0.0f));
    sun_enu[1] = 0.0f;
    sun_enu[2] = mu_s;
}

static bool make_sky_view(bake_texture *texture, bake_air *air, const scratch *s) {
    const skv_bake_table *const map = &texture->map;
    bake_rays rays = {map->height_km, {0.0f, 0.0f, 0.0f}, (size_t)(map->width * map->height), s->ray};
    sun_at(map->mu_s, rays.sun_enu);
    directions(map, map->height, map->width, map->height_km, s->ray);
    // In pieces: the bar moves, and an interrupt is not late.
    for (size_t from = 0; from < rays.n; from += (size_t)map->width) {
        bake_rays row = rays;
        row.n = (size_t)map->width;
        row.direction_enu = s->ray + 3 * from;
        if (!bake_light(air, &row, s->radiance, s->once, s->transmittance))
            return false;
        for (size_t i = 0; i < row.n; i++) {
            put(texture, air, 0, from + i, s->radiance + 4 * i);
            for (int k = 0; k < map->deferred; k++)
                put(texture, air, 1 + k, from + i, s->once[k] + 4 * i);
            if (!air->options->rgb)
                put(texture, air, 1 + map->deferred, from + i, s->transmittance + 4 * i);
        }
        progress_update(from + row.n);
    }
    return true;
}

static float altitude_of(const skv_bake_table *map, int i, int n) {
    const float u = (float)i / (float)(n - 1);
    return map->top_km * u * u;
}

static bool make_transmittance(bake_texture *texture, bake_air *air, const scratch *s) {
    const skv_bake_table *const map = &texture->map;
    for (int y = 0; y < map->height; y++) {
        bake_rays rays = {altitude_of(map, y, map->height), {1.0f, 0.0f, 0.0f}, (size_t)map->width, s->ray};
        for (int x = 0; x < map->width; x++) {
            float *const ray = s->ray + 3 * x;
            ray[1] = 0.0f;
            skv_bake_row_direction(map, map->width, rays.altitude_km, x, &ray[2], &ray[0]);
        }
        if (!bake_light(air, &rays, s->radiance, NULL, s->transmittance))
            return false;
        for (size_t i = 0; i < rays.n; i++)
            put(texture, air, 0, (size_t)y * (size_t)map->width + i, s->transmittance + 4 * i);
        progress_update((size_t)(y + 1));
    }
    return true;
}

/// One altitude and sun: all azimuths and rows.
static bool make_column(bake_texture *texture, bake_air *air, const scratch *s, int z, int sun) {
    const skv_bake_table *const map = &texture->map;
    const int suns = map->width / map->azimuths;
    bake_rays rays = {
        altitude_of(map, z, map->depth), {0.0f, 0.0f, 0.0f}, (size_t)(map->azimuths * map->height), s->ray};
    sun_at(skv_bake_sun_mu_s(map, (float)sun / (float)(suns - 1)), rays.sun_enu);
    if (!bake_light(air, &rays, s->radiance, s->once, NULL))
        return false;
    for (size_t i = 0; i < rays.n; i++) {
        const size_t y = i / (size_t)map->azimuths, a = i % (size_t)map->azimuths;
        const size_t texel =
            ((size_t)z * (size_t)map->height + y) * (size_t)map->width + a * (size_t)suns + (size_t)sun;
        put(texture, air, 0, texel, s->radiance + 4 * i);
        for (int k = 0; k < map->deferred; k++)
            put(texture, air, 1 + k, texel, s->once[k] + 4 * i);
    }
    return true;
}

static bool make_scattering(bake_texture *texture, bake_air *air, const scratch *s) {
    const skv_bake_table *const map = &texture->map;
    const int suns = map->width / map->azimuths;
    for (int z = 0; z < map->depth; z++) {
        directions(map, map->height, map->azimuths, altitude_of(map, z, map->depth), s->ray);
        for (int sun = 0; sun < suns; sun++) {
            if (!make_column(texture, air, s, z, sun))
                return false;
            progress_update((size_t)(z * suns + sun + 1));
        }
    }
    return true;
}

static bool make_irradiance(bake_texture *texture, bake_air *air) {
    const skv_bake_table *const map = &texture->map;
    for (int y = 0; y < map->height; y++)
        for (int x = 0; x < map->width; x++) {
            float sun_enu[3], out[3][4];
            sun_at(skv_bake_sun_mu_s(map, (float)x / (float)(map->width - 1)), sun_enu);
            if (!bake_irradiance(air, altitude_of(map, y, map->height), sun_enu, out))
                return false;
            for (int layer = 0; layer < 3; layer++)
                put(texture, air, layer, (size_t)(y * map->width + x), out[layer]);
            progress_update((size_t)(y * map->width + x + 1));
        }
    return true;
}

// ---- shape

static void set_shape(skv_bake_table *map, const bake_air *air) {
    const bake_options *const options = air->options;
    const int *const size = options->size;
    map->depth = map->azimuths = map->layers = 1;
    switch (options->what) {
    case SKV_BAKE_SKY_VIEW:
        map->width = size[AXIS_AZIMUTHS];
        map->height = size[AXIS_ROWS];
        map->layers = 1 + air->deferred + !options->rgb;
        break;
    case SKV_BAKE_TRANSMITTANCE:
        map->width = size[AXIS_ROWS];
        map->height = size[AXIS_ALTITUDES];
        break;
    case SKV_BAKE_SCATTERING:
        map->azimuths = size[AXIS_AZIMUTHS];
        map->width = map->azimuths * size[AXIS_SUNS];
        map->height = size[AXIS_ROWS];
        map->depth = size[AXIS_ALTITUDES];
        map->layers = 1 + air->deferred;
        break;
    default:
        map->width = size[AXIS_SUNS];
        map->height = size[AXIS_ALTITUDES];
        map->layers = 3;
    }
}

static void set_map(bake_texture *texture, const bake_air *air) {
    const bake_options *const options = air->options;
    skv_bake_table *const map = &texture->map;
    memset(map, 0, sizeof *map);
    map->what = options->what;
    set_shape(map, air);
    map->channels = options->rgb ? 3 : air->model.bands;
    map->deferred = air->deferred;
    memcpy(map->phase, air->phase, sizeof map->phase);
    memcpy(map->g, air->g, sizeof map->g);
    map->radius_km = air->model.radius_km + air->ground_km;
    map->top_km = air->model.top_km - air->ground_km;
    map->height_km = (float)fmax(options->now.at.msl_m / 1000.0 - (double)air->ground_km, 0.0);
    map->mu_s = options->what == SKV_BAKE_SKY_VIEW ? options->now.sun_enu[2] : 0.0f;
    map->mu_s_min = (float)cos(options->sun_lowest_deg * (3.14159265358979323846 / 180.0));
    for (int l = 0; l < SKV_BAKE_LAYERS_MAX; l++)
        map->scale[l] = 1.0f;
}

static void name_layers(bake_texture *texture, const bake_air *air) {
    const skv_bake_table *const map = &texture->map;
    static const char *const irradiance[3] = {"down", "up", "beam"};
    texture->layer_name[0] = map->what == SKV_BAKE_TRANSMITTANCE ? "transmittance" : "radiance";
    for (int l = 1; l < map->layers; l++)
        texture->layer_name[l] = l <= air->deferred ? air->deferred_name[l - 1] : "transmittance";
    for (int l = 0; map->what == SKV_BAKE_IRRADIANCE && l < 3; l++)
        texture->layer_name[l] = irradiance[l];
}

/// Halves have 30 powers of two of full precision: the scale brings a layer's largest value near their upper end.
static void scale_layers(bake_texture *texture, const bake_options *options) {
    skv_bake_table *const map = &texture->map;
    const size_t n = skv_bake_layer_values(map);
    for (int l = 0; l < map->layers; l++) {
        float *const texel = texture->texels + (size_t)l * n;
        float most = 0.0f;
        for (size_t i = 0; i < n; i++)
            most = fmaxf(most, fabsf(texel[i]));
        int exponent = 0;
        if (!options->half || strcmp(texture->layer_name[l], "transmittance") == 0 || !(most > FLT_MIN))
            continue;
        (void)frexpf(most, &exponent); // most < 2^exponent
        const float scale = ldexpf(1.0f, 15 - exponent < 100 ? 15 - exponent : 100);
        for (size_t i = 0; i < n; i++)
            texel[i] *= scale;
        map->scale[l] = scale;
    }
}

static bool make(bake_texture *texture, bake_air *air, const scratch *s) {
    switch (texture->map.what) {
    case SKV_BAKE_SKY_VIEW:
        return make_sky_view(texture, air, s);
    case SKV_BAKE_TRANSMITTANCE:
        return make_transmittance(texture, air, s);
    case SKV_BAKE_SCATTERING:
        return make_scattering(texture, air, s);
    default:
        return make_irradiance(texture, air);
    }
}

/// What progress counts.
static size_t steps(const skv_bake_table *map) {
    switch (map->what) {
    case SKV_BAKE_TRANSMITTANCE:
        return (size_t)map->height;
    case SKV_BAKE_SCATTERING:
        return (size_t)(map->depth * (map->width / map->azimuths));
    default:
        return (size_t)(map->width * map->height);
    }
}

int bake_texture_make(bake_texture *texture, bake_air *air) {
    skv_bake_table *const map = &texture->map;
    set_map(texture, air);
    name_layers(texture, air);
    const size_t most = (size_t)map->height * (size_t)(map->what == SKV_BAKE_SCATTERING ? map->azimuths : map->width);
    scratch s;
    texture->texels = calloc((size_t)map->layers * skv_bake_layer_values(map), sizeof(float));
    bool ok = scratch_begin(&s, most) && texture->texels;
    if (!ok) {
        scratch_end(&s);
        return fail_job("skyvert bake: no memory for %d x %d x %d texels", map->width, map->height, map->depth);
    }
    progress_begin("bake", steps(map));
    ok = make(texture, air, &s);
    progress_end();
    scratch_end(&s);
    if (!ok)
        return fail_job("skyvert bake: the core refused a ray or a frame");
    scale_layers(texture, air->options);
    return 0;
}
