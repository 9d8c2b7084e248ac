/// What the studies share: skies to compare, the rays whose truth is known, and differences of colour.
#include "study_sky.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

double study_horizon_deg(const skv_atmosphere *air, double height_km) {
    const double radius = (double)air->radius_km;
    return 90 + acos(radius / (radius + height_km)) / STUDY_DEGREE;
}

double study_halton(int i, int base) {
    double f = 1, r = 0;
    for (; i > 0; i /= base) {
        f /= base;
        r += f * (i % base);
    }
    return r;
}

int study_stop(const trade_study *how, double done) {
    return how->progress != NULL && how->progress(how->context, done) != 0;
}

static int refused(skv_status status, const char *what) {
    if (status == SKV_OK)
        return TRADE_STUDY_DONE;
    fprintf(stderr, "trade: %s: status %d\n", what, (int)status);
    return TRADE_STUDY_FAILED;
}

int study_radiance(const study_sky *sky, double height_km, const float sun_enu[3], size_t n,
                   const float (*direction)[3], float (*radiance)[4]) {
    static float grid[8192];
    skv_frame frame;
    skv_light light;
    const skv_rays rays = {direction[0], 0, NULL, 0};
    const skv_sky out = {radiance[0], sizeof radiance[0], NULL, 0};
    skv_status status = skv_light_sun(&light, sky->model, sun_enu);
    if (status == SKV_OK)
        status = skv_frame_begin(&frame, sky->model, &sky->quality, (float)height_km, 0, &light, 1);
    if (status == SKV_OK)
        status = skv_frame_table(&frame, sky->table);
    // High up a grid is refused: rays are integrated there whatever is asked for.
    const skv_status gridded = status == SKV_OK && sky->grid ? skv_frame_grid(&frame, grid, sizeof grid) : SKV_OK;
    if (status == SKV_OK && gridded != SKV_ERR_RANGE)
        status = gridded;
    if (status == SKV_OK)
        status = skv_radiance(&frame, n, &rays, &out);
    return refused(status, "skv_radiance");
}

skv_model *study_model(const skv_atmosphere *air) {
    skv_model *const model = malloc(sizeof *model);
    if (model == NULL) {
        fprintf(stderr, "trade: out of memory\n");
        return NULL;
    }
    if (refused(skv_model_build(model, air), "skv_model_build") == TRADE_STUDY_DONE)
        return model;
    free(model);
    return NULL;
}

void study_finest(skv_table_spec *spec, const skv_model *model) {
    (void)skv_table_spec_for(spec, model, SKV_TABLE_ACCURATE);
    spec->detailed = (spec->detailed * 24 + spec->altitudes - 1) / spec->altitudes;
    spec->altitudes = 24;
    spec->suns = 48;
    spec->samples[0] = 10, spec->samples[1] = 6;
    spec->polar[0] = 12, spec->polar[1] = 10;
    spec->azimuths[0] = 12, spec->azimuths[1] = 8;
    spec->format = SKV_TABLE_FLOAT;
}

skv_table *study_table(const skv_model *model, const skv_table_spec *given) {
    skv_table_spec spec;
    if (given != NULL)
        spec = *given;
    else
        (void)skv_table_spec_for(&spec, model, SKV_TABLE_ACCURATE);
    const size_t size = skv_table_size(&spec, model->bands), room = skv_table_work_size(&spec, model->bands);
    skv_table *table = malloc(size > 0 ? size : 1);
    void *const work = malloc(room > 0 ? room : 1);
    const skv_status status =
        table == NULL || work == NULL ? SKV_ERR_SIZE : skv_table_build(table, size, work, room, model, &spec);
    free(work);
    if (refused(status, "skv_table_build") == TRADE_STUDY_DONE)
        return table;
    free(table);
    return NULL;
}

// --- scenes ---

static void aim(trade_scene *s, double view_deg, double azimuth_deg, int to_ground) {
    trade_direction(s->direction[s->n], view_deg, azimuth_deg);
    s->to_ground[s->n] = to_ground;
    s->view_zenith_deg[s->n] = view_deg;
    s->azimuth_deg[s->n++] = azimuth_deg;
}

/// Sky and, from above it, ground: a quarter of the rays each within 6 deg of the horizon and below it.
static void lay_rays(trade_scene *s, double horizon_deg) {
    for (int i = 1; s->n < TRADE_RAYS; i++) {
        const double t = study_halton(i, 2), azimuth = 360 * study_halton(i, 3);
        if (i % 4 == 0)
            aim(s, horizon_deg - 0.02 - 6 * t * t, azimuth, 0);
        else if (i % 4 == 1 && s->height_km > 0)
            aim(s, horizon_deg + 0.05 + (179 - horizon_deg) * t * t, azimuth, 1);
        else
            aim(s, horizon_deg * t, azimuth, 0);
    }
}

static int compute_scenes(trade_scene scene[TRADE_SCENES], const trade_study_air *air) {
    static float radiance[TRADE_RAYS][4];
    skv_table_spec spec;
    skv_quality quality;
    int status = TRADE_STUDY_FAILED;
    skv_model *const model = study_model(air->atmosphere);
    skv_table *table = NULL;
    if (model != NULL) {
        study_finest(&spec, model);
        table = study_table(model, &spec);
    }
    (void)skv_quality_tier(&quality, SKV_TIER_HIGH);
    quality.terms = SKV_WITH_ALL;
    const study_sky sky = {model, table, quality, 0};
    for (int i = 0; table != NULL && i < TRADE_SCENES; i++) {
        trade_scene *const s = &scene[i];
        lay_rays(s, study_horizon_deg(air->atmosphere, s->height_km));
        status =
            study_radiance(&sky, s->height_km, s->sun_enu, (size_t)s->n, (const float(*)[3])s->direction, radiance);
        for (int k = 0; k < s->n; k++)
            for (int b = 0; b < 4; b++)
                s->radiance[TRADE_FULL][k][b] = (double)radiance[k][b];
    }
    free(table);
    free(model);
    return status;
}

int study_scenes(trade_scene scene[TRADE_SCENES], const trade_study_air *air) {
    if (air->scene != NULL) {
        memcpy(scene, air->scene, TRADE_SCENES * sizeof *scene);
        return TRADE_STUDY_DONE;
    }
    memset(scene, 0, TRADE_SCENES * sizeof *scene);
    for (int i = 0; i < TRADE_SCENES; i++) {
        trade_scene *const s = &scene[i];
        s->height = i / TRADE_SUNS;
        s->sun = i % TRADE_SUNS;
        s->height_km = trade_height_km[s->height];
        s->sun_zenith_deg = trade_sun_zenith_deg[s->sun];
        snprintf(s->name, sizeof s->name, "%s, %s", trade_height_name[s->height], trade_sun_name[s->sun]);
        trade_direction(s->sun_enu, s->sun_zenith_deg, 0);
    }
    return compute_scenes(scene, air);
}

// --- colour ---

static double lightness(double t) {
    const double d = 6.0 / 29;
    return t > d * d * d ? cbrt(t) : t / (3 * d * d) + 4.0 / 29;
}

void study_lab_of(const double xyz[3], double white, double lab[3]) {
    const double x = 0.3127, y = 0.3290; // D65 [BT709]
    const double fx = lightness(xyz[0] / (white * x / y)), fy = lightness(xyz[1] / white),
                 fz = lightness(xyz[2] / (white * (1 - x - y) / y));
    lab[0] = 116 * fy - 16;
    lab[1] = 500 * (fx - fy);
    lab[2] = 200 * (fy - fz);
}

static void linear_rgb(const skv_colour_matrix *matrix, int bands, const double radiance[4], double rgb[3]) {
    for (int i = 0; i < 3; i++) {
        rgb[i] = 0;
        for (int b = 0; b < bands; b++)
            rgb[i] += (double)SKV_WHITE_LUMINANCE * (double)matrix->rgb[i][b] * radiance[b];
    }
}

void study_lab(const skv_colour_matrix *matrix, int bands, const double radiance[4], double white, double lab[3]) {
    // Linear BT.709 to XYZ [BT709].
    static const double to_xyz[3][3] = {
        {0.4123908, 0.3575843, 0.1804808}, {0.2126390, 0.7151687, 0.0721923}, {0.0193308, 0.1191948, 0.9505322}};
    double rgb[3], xyz[3];
    linear_rgb(matrix, bands, radiance, rgb);
    for (int i = 0; i < 3; i++)
        xyz[i] = to_xyz[i][0] * rgb[0] + to_xyz[i][1] * rgb[1] + to_xyz[i][2] * rgb[2];
    study_lab_of(xyz, white, lab);
}

double study_luminance(const skv_colour_matrix *matrix, int bands, const double radiance[4]) {
    double y = 0;
    for (int b = 0; b < bands; b++)
        y += (double)matrix->luminance[b] * radiance[b];
    return y;
}

double study_distance(const double a[3], const double b[3]) {
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}
