#include "truth.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/reference/single.h"

const char *const trade_airs[] = {"br16", "br17o", NULL};
const char *const trade_sun_name[TRADE_SUNS] = {"day", "sunset", "twilight"};
const char *const trade_height_name[TRADE_HEIGHTS] = {"ground", "12 km", "40 km"};
const char *const trade_light_name[TRADE_LIGHTS] = {"single", "full"};
const double trade_sun_zenith_deg[TRADE_SUNS] = {40, 88.5, 94}, trade_height_km[TRADE_HEIGHTS] = {0, 12, 40};

static const double degree = 3.14159265358979323846 / 180;

static void sin_cos_deg(double degrees, double *sine, double *cosine) {
    const double turn = fmod(degrees, 360), quarter = floor(turn / 90 + 0.5);
    const double rest = (turn - 90 * quarter) * degree, s = sin(rest), c = cos(rest);
    const int q = ((int)quarter % 4 + 4) % 4;
    *sine = (q == 0 ? s : q == 1 ? c : q == 2 ? -s : -c) + 0;
    *cosine = (q == 0 ? c : q == 1 ? -s : q == 2 ? -c : s) + 0;
}

void trade_direction(float direction[3], double zenith_deg, double azimuth_deg) {
    double sin_zenith, cos_zenith, sin_azimuth, cos_azimuth;
    sin_cos_deg(zenith_deg, &sin_zenith, &cos_zenith);
    sin_cos_deg(azimuth_deg, &sin_azimuth, &cos_azimuth);
    direction[0] = (float)(sin_zenith * sin_azimuth);
    direction[1] = (float)-(sin_zenith * cos_azimuth);
    direction[2] = (float)cos_zenith;
}

static int wrong(const char *name, int line, const char *what) {
    fprintf(stderr, "%.200s:%d: %s\n", name, line, what);
    return 2;
}

static trade_scene *scene_of(trade_truth *truth, double height_km, double sun_deg) {
    for (int i = 0; i < TRADE_SCENES; i++)
        if (fabs(truth->scene[i].height_km - height_km) < 1e-9 && fabs(truth->scene[i].sun_zenith_deg - sun_deg) < 1e-9)
            return &truth->scene[i];
    return NULL;
}

static void begin_scenes(trade_truth *truth) {
    for (int i = 0; i < TRADE_SCENES; i++) {
        trade_scene *const s = &truth->scene[i];
        *s = (trade_scene){.sun = i % TRADE_SUNS, .height = i / TRADE_SUNS};
        s->height_km = trade_height_km[s->height];
        s->sun_zenith_deg = trade_sun_zenith_deg[s->sun];
        snprintf(s->name, sizeof s->name, "%s, %s", trade_height_name[s->height], trade_sun_name[s->sun]);
        trade_direction(s->sun_enu, s->sun_zenith_deg, 0);
    }
}

/// Altitude, three angles, the bands' radiances and their standard errors.
static const char *take_row(trade_truth *truth, const char *text) {
    double x[4 + 2 * TRADE_BANDS];
    const int want = 4 + 2 * truth->bands;
    for (int i = 0; i < want; i++) {
        char *end;
        x[i] = strtod(text, &end);
        if (end == text || !isfinite(x[i]) || (i < want - 1 ? *end != ',' : *end != '\n' && *end != '\0'))
            return "altitude, three angles, and a radiance and a standard error per band are wanted";
        text = end + 1;
    }
    trade_scene *const s = scene_of(truth, x[0], x[1]);
    if (!s || s->n == TRADE_RAYS)
        return "24 rays at most from 0, 12 and 40 km with the sun at 40, 88.5 and 94 deg are wanted";
    const int i = s->n++;
    s->view_zenith_deg[i] = x[2];
    s->azimuth_deg[i] = x[3];
    trade_direction(s->direction[i], x[2], x[3]);
    for (int b = 0; b < truth->bands; b++) {
        s->radiance[TRADE_FULL][i][b] = x[4 + b];
        s->noise[i][b] = x[4 + truth->bands + b];
    }
    return NULL;
}

static int read_rows(trade_truth *truth, FILE *in, const char *name) {
    static const char head[] = "altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg,L_";
    char text[1024];
    int header = 0, line = 0;
    while (fgets(text, sizeof text, in)) {
        line++;
        if (text[0] == '#')
            continue;
        const char *what = NULL;
        if (!header)
            what = strncmp(text, head, sizeof head - 1) == 0 ? NULL : "not the header of skyvert-reference";
        else
            what = take_row(truth, text);
        if (what)
            return wrong(name, line, what);
        header = 1;
    }
    for (int i = 0; i < TRADE_SCENES; i++)
        if (truth->scene[i].n == 0)
            return wrong(name, line, "rays of a scene are missing: make trade-truth writes them");
    return 0;
}

static int find_single(trade_truth *truth) {
    for (int k = 0; k < TRADE_SCENES; k++) {
        trade_scene *const s = &truth->scene[k];
        for (int i = 0; i < s->n; i++) {
            ref_answer answer;
            const ref_ray ray =
                ref_ray_from_angles(s->height_km, s->sun_zenith_deg, s->view_zenith_deg[i], s->azimuth_deg[i]);
            if (ref_single(&truth->file.atmosphere, &ray, 1, NULL, &answer) != 0) {
                fprintf(stderr, "%s: the light scattered once does not converge at %s, view zenith %g\n", truth->air,
                        s->name, s->view_zenith_deg[i]);
                return 1;
            }
            memcpy(s->radiance[TRADE_SINGLE][i], answer.radiance, sizeof answer.radiance);
            s->to_ground[i] = answer.meets_ground;
        }
    }
    return 0;
}

int trade_truth_load(trade_truth *truth, const char *root, const char *air) {
    char name[256];
    truth->air = air;
    snprintf(truth->ini, sizeof truth->ini, "%.180s%stools/bench/%.32s.ini", strcmp(root, ".") == 0 ? "" : root,
             strcmp(root, ".") == 0 ? "" : "/", air);
    snprintf(name, sizeof name, "%.180s/tools/trade/truth/%.32s.csv", root, air);
    if (ref_read_ini(&truth->file, truth->ini) != 0)
        return 2;
    ref_to_skyvert(&truth->file.atmosphere, &truth->atmosphere, &truth->tables);
    ref_from_skyvert(&truth->atmosphere, 0, &truth->file); // both see the same floats
    truth->bands = truth->atmosphere.bands;
    begin_scenes(truth);
    FILE *const in = fopen(name, "r");
    if (!in)
        return wrong(name, 0, "cannot be opened (run it in the project's folder, or name that with --root)");
    const int status = read_rows(truth, in, name);
    fclose(in);
    return status ? status : find_single(truth);
}
