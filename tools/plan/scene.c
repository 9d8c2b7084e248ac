#include "tools/plan/scene.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/skyvert/command.h"
#include "tools/skyvert/ini_document.h"

const char *const plan_preset_names[] = {"earth-clear", "earth-hazy", "mars",  "tiny",        "giant", "earth-thin",
                                         "earth-dense", "earth-x25",  "titan", "earth-smoke", NULL};

typedef struct reading {
    ini_taker ini;
    plan_scene *scene;
} reading;

static const ini_known known[] = {
    {"planet", {"preset", "atmosphere"}},
    {"observer", {"height_m", "ground_m"}},
    {"sun", {"elevation_deg"}},
    {"air", {"visibility_km"}},
    {"view", {"elevation_deg", "terrain", "terrain_km", "terrain_share", "stars"}},
};

// --- values ---

/// One number or two with a comma between, the first not above the second.
static void take_range(reading *r, const char *section, const char *key, bool needed, plan_range allowed,
                       plan_range *range) {
    const ini_entry *const e = ini_want(&r->ini, section, key, needed);
    double low, high;
    if (!e)
        return;
    const char *const comma = strchr(e->value, ',');
    char *const first = strdup(e->value);
    if (!first) {
        r->ini.result = fail_job("out of memory");
        return;
    }
    if (comma)
        first[comma - e->value] = '\0';
    const bool good = parse_number(first, &low) && (!comma || parse_number(comma + 1, &high));
    free(first);
    high = good && !comma ? low : high;
    if (!good || low < allowed.low || high > allowed.high || low > high)
        ini_fail(&r->ini, e->line, "%s = %.60s: allowed is a number from %.10g to %.10g, or two, the lower one first",
                 key, e->value, allowed.low, allowed.high);
    else
        *range = (plan_range){low, high};
}

static void take_number(reading *r, const char *section, const char *key, plan_range allowed, double *value) {
    const ini_entry *const e = ini_want(&r->ini, section, key, false);
    double v;
    if (!e)
        return;
    if (!parse_number(e->value, &v) || v < allowed.low || v > allowed.high)
        ini_fail(&r->ini, e->line, "%s = %.60s: allowed is a number from %.10g to %.10g", key, e->value, allowed.low,
                 allowed.high);
    else
        *value = v;
}

static void take_flag(reading *r, const char *section, const char *key, bool *value) {
    const ini_entry *const e = ini_want(&r->ini, section, key, false);
    if (!e)
        return;
    if (strcmp(e->value, "yes") != 0 && strcmp(e->value, "no") != 0)
        ini_fail(&r->ini, e->line, "%s = %.60s: allowed is yes or no", key, e->value);
    *value = strcmp(e->value, "yes") == 0;
}

// --- the planet ---

static void take_preset(reading *r, const ini_entry *e) {
    char allowed[200] = "";
    for (int i = 0; plan_preset_names[i]; i++) {
        if (strcmp(e->value, plan_preset_names[i]) == 0) {
            r->scene->preset = i;
            r->scene->planet = plan_preset_names[i];
            return;
        }
        const size_t used = strlen(allowed);
        snprintf(allowed + used, sizeof allowed - used, "%s%s", i == 0 ? "" : ", ", plan_preset_names[i]);
    }
    ini_fail(&r->ini, e->line, "preset = %.60s: allowed are %s", e->value, allowed);
}

/// The file is looked for beside the scene file.
static void take_atmosphere(reading *r, const ini_entry *e) {
    if (*e->value == '\0') {
        ini_fail(&r->ini, e->line, "atmosphere: allowed is the name of a file");
        return;
    }
    char *const path = ini_beside(r->ini.document, e->value);
    if (!path) {
        r->ini.result = fail_job("out of memory");
        return;
    }
    r->ini.result = atmosphere_load(&r->scene->file, path);
    const char *const name = strrchr(path, '/');
    snprintf(r->scene->planet_text, sizeof r->scene->planet_text, "%.60s", name ? name + 1 : path);
    r->scene->planet = r->scene->planet_text;
    r->scene->preset = -1;
    free(path);
}

static void take_planet(reading *r) {
    const ini_entry *const preset = ini_want(&r->ini, "planet", "preset", false);
    const ini_entry *const file = ini_want(&r->ini, "planet", "atmosphere", false);
    if (r->ini.result)
        return;
    if (preset && file)
        ini_fail(&r->ini, file->line, "atmosphere: allowed is it or preset, and preset stands in line %d",
                 preset->line);
    else if (preset)
        take_preset(r, preset);
    else if (file)
        take_atmosphere(r, file);
    else
        (void)ini_want(&r->ini, "planet", "preset", true);
}

// --- optics ---

static double at_550(const skv_atmosphere *air, const float *value) {
    int i = 0;
    while (i + 2 < air->bands && air->wavelength_nm[i + 1] < 550.0f)
        i++;
    const double a = (double)air->wavelength_nm[i], b = (double)air->wavelength_nm[i + 1];
    const double t = (550 - a) / (b - a);
    return fmax((double)value[i] + t * ((double)value[i + 1] - (double)value[i]), 0);
}

static bool stands_on_ground(const skv_profile *p) {
    return p->kind == SKV_PROFILE_EXPONENTIAL || p->kind == SKV_PROFILE_EXP_BACKGROUND;
}

double plan_gas_per_km(const skv_atmosphere *air) {
    return air->rayleigh.kind == SKV_PROFILE_NONE ? 0 : at_550(air, air->rayleigh_scattering_per_km);
}

double plan_particles_per_km(const skv_atmosphere *air) {
    const double dust = stands_on_ground(&air->dust) ? at_550(air, air->dust_extinction_per_km) : 0;
    const double aerosol = stands_on_ground(&air->aerosol) ? at_550(air, air->aerosol_extinction_per_km) : 0;
    return (aerosol + dust) * (double)air->turbidity;
}

int plan_airs(const plan_scene *scene) {
    return scene->visibility_km.high > scene->visibility_km.low ? PLAN_AIRS_MAX : 1;
}

double plan_air_visibility_km(const plan_scene *scene, int which) {
    const plan_range v = scene->visibility_km;
    return which == 0 ? v.low : which == 1 ? sqrt(v.low * v.high) : v.high;
}

void plan_air(const plan_scene *scene, int which, int bands, skv_atmosphere *air) {
    if (scene->preset < 0)
        *air = scene->file.atmosphere;
    else
        (void)skv_atmosphere_preset(air, (skv_preset)scene->preset, bands);
    if (scene->visibility_km.low <= 0)
        return;
    const double wanted = PLAN_KOSCHMIEDER / plan_air_visibility_km(scene, which) - plan_gas_per_km(air);
    air->turbidity = (float)(fmax(wanted, 0) / plan_particles_per_km(air) * (double)air->turbidity);
}

static void take_visibility(reading *r) {
    skv_atmosphere air;
    take_range(r, "air", "visibility_km", false, (plan_range){0.05, 1000}, &r->scene->visibility_km);
    const ini_entry *const e = ini_want(&r->ini, "air", "visibility_km", false);
    if (r->ini.result || !e)
        return;
    plan_scene as_is = *r->scene;
    as_is.visibility_km = (plan_range){0, 0};
    plan_air(&as_is, 0, 4, &air);
    if (!(plan_particles_per_km(&air) > 0))
        ini_fail(&r->ini, e->line,
                 "visibility_km: this air has no particles on the ground that could set it; leave it out");
    else if (r->scene->visibility_km.high > PLAN_KOSCHMIEDER / fmax(plan_gas_per_km(&air), 1e-9))
        ini_fail(&r->ini, e->line,
                 "visibility_km = %.60s: allowed is up to %.4g, where this air would have no particles", e->value,
                 PLAN_KOSCHMIEDER / plan_gas_per_km(&air));
}

// --- the whole ---

static void take_view(reading *r) {
    plan_scene *const s = r->scene;
    take_range(r, "view", "elevation_deg", true, (plan_range){-90, 90}, &s->view_deg);
    take_flag(r, "view", "terrain", &s->terrain);
    take_flag(r, "view", "stars", &s->stars);
    take_range(r, "view", "terrain_km", false, (plan_range){0.001, 1000}, &s->terrain_km);
    take_number(r, "view", "terrain_share", (plan_range){0, 0.9}, &s->terrain_share);
    const char *const only[] = {"terrain_km", "terrain_share"};
    for (int i = 0; i < 2; i++) {
        const ini_entry *const e = ini_want(&r->ini, "view", only[i], false);
        if (e && !s->terrain)
            ini_fail(&r->ini, e->line, "%s: allowed with terrain = yes", only[i]);
    }
}

static void take_all(reading *r) {
    plan_scene *const s = r->scene;
    ini_check_names(&r->ini, known, sizeof known / sizeof *known);
    take_planet(r);
    take_range(r, "observer", "height_m", true, (plan_range){-12000, 1e6}, &s->height_m);
    take_number(r, "observer", "ground_m", (plan_range){-12000, 12000}, &s->ground_m);
    take_range(r, "sun", "elevation_deg", true, (plan_range){-12, 90}, &s->sun_deg);
    take_visibility(r);
    take_view(r);
    const ini_entry *const height = ini_want(&r->ini, "observer", "height_m", true);
    if (height && s->height_m.low < s->ground_m)
        ini_fail(&r->ini, height->line, "height_m = %.60s: allowed is from ground_m, %g, up", height->value,
                 s->ground_m);
}

int plan_scene_load(plan_scene *scene, const char *path) {
    ini_document document;
    FILE *const stream = fopen(path, "rb");
    if (!stream)
        return fail_usage("%.200s: cannot be read: %s", path, strerror(errno));
    *scene = (plan_scene){.preset = -1, .terrain_km = {1, 40}, .terrain_share = 0.2};
    const int failed = ini_read(&document, stream, path);
    fclose(stream);
    if (failed)
        return failed;
    reading r = {.ini.document = &document, .scene = scene};
    take_all(&r);
    if (!scene->terrain)
        scene->terrain_share = 0;
    ini_free(&document);
    if (r.ini.result)
        plan_scene_free(scene);
    else if (scene->planet != scene->planet_text && scene->preset >= 0)
        scene->planet = plan_preset_names[scene->preset];
    return r.ini.result;
}

void plan_scene_free(plan_scene *scene) {
    if (scene->preset < 0)
        atmosphere_free(&scene->file);
}
