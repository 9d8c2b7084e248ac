/// What an atmosphere file means: DESIGN section 8's sections and keys into skv_atmosphere, each value checked.
#include "ini.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "ini_document.h"
#include "table_file.h"

typedef struct reading {
    ini_taker ini;
    atmosphere_file *file;
    int tables;
} reading;

static const ini_known known[] = {
    {"planet", {"radius_km", "top_km", "albedo"}},
    {"bands", {"wavelength_nm", "solar_irradiance"}},
    {"rayleigh", {"scattering_per_km", "absorption_per_km", "profile", "scale_height_km", "a", "b", "table"}},
    {"aerosol",
     {"scattering_per_km", "extinction_per_km", "profile", "scale_height_km", "background", "phase", "g", "table"}},
    {"dust",
     {"scattering_per_km", "extinction_per_km", "profile", "scale_height_km", "background", "phase", "g", "peak_km",
      "half_width_km", "mu", "k", "table"}},
    {"ozone", {"absorption_per_km", "profile", "peak_km", "half_width_km", "mu", "k", "table"}},
};

static void check_names(reading *r) {
    const ini_document *const d = r->ini.document;
    ini_check_names(&r->ini, known, sizeof known / sizeof *known);
    for (int i = 0; i < 3; i++)
        if (!ini_find_section(d, known[i].section))
            ini_fail(&r->ini, d->lines > 0 ? d->lines : 1,
                     "section [%s] is missing; needed are [planet], [bands] and [rayleigh]", known[i].section);
}

// --- values ---

typedef struct range {
    double low, high;
} range;

static bool check_number(reading *r, const ini_entry *e, const char *text, range allowed, double *value) {
    if (parse_number(text, value) && *value >= allowed.low && *value <= allowed.high)
        return true;
    ini_fail(&r->ini, e->line, "%s = %.60s: allowed is a number from %.10g to %.10g", e->name, text, allowed.low,
             allowed.high);
    return false;
}

/// A value that has a default stays as it is where the key is missing.
static void take_number(reading *r, const char *section, const char *key, bool needed, range allowed, float *value) {
    const ini_entry *const e = ini_want(&r->ini, section, key, needed);
    double v;
    if (e && check_number(r, e, e->value, allowed, &v))
        *value = (float)v;
}

/// Cuts at commas. @return the number of items, at most 5: the fifth is one too many
static int split_list(char *text, char *items[5]) {
    int n = 0;
    items[n++] = text;
    for (char *comma = strchr(text, ','); comma && n < 5; comma = strchr(comma + 1, ',')) {
        *comma = '\0';
        items[n++] = comma + 1;
    }
    return n;
}

/// @return the number of values, 0 after an error line
static int parse_list(reading *r, const ini_entry *e, char *copy, range allowed, double values[4]) {
    char *items[5];
    const int n = split_list(copy, items), bands = r->file->atmosphere.bands;
    if (bands ? n != bands : n != 3 && n != 4) {
        if (bands)
            ini_fail(&r->ini, e->line, "%s: %s%d values; allowed are %d, one per band, with commas between", e->name,
                     n == 5 ? "more than " : "", n == 5 ? 4 : n, bands);
        else
            ini_fail(&r->ini, e->line, "%s: %s%d values; allowed are 3 or 4, with commas between", e->name,
                     n == 5 ? "more than " : "", n == 5 ? 4 : n);
        return 0;
    }
    for (int i = 0; i < n; i++)
        if (!check_number(r, e, items[i], allowed, &values[i]))
            return 0;
    return n;
}

static int take_doubles(reading *r, const char *section, const char *key, bool needed, range allowed,
                        double values[4]) {
    const ini_entry *const e = ini_want(&r->ini, section, key, needed);
    if (!e)
        return 0;
    char *const copy = strdup(e->value);
    if (!copy) {
        r->ini.result = fail_job("out of memory");
        return 0;
    }
    const int n = parse_list(r, e, copy, allowed, values);
    free(copy);
    return n;
}

/// Where a list has a default it is zeros.
static void take_list(reading *r, const char *section, const char *key, bool needed, range allowed, float values[4]) {
    double v[4];
    const int n = take_doubles(r, section, key, needed, allowed, v);
    for (int i = 0; i < n; i++)
        values[i] = (float)v[i];
}

/// @return the place in names, or -1 after an error line
static int take_choice(reading *r, const char *section, const char *key, const char *const names[]) {
    const ini_entry *const e = ini_want(&r->ini, section, key, true);
    char allowed[200] = "";
    for (int i = 0; e && names[i]; i++) {
        if (strcmp(e->value, names[i]) == 0)
            return i;
        const size_t used = strlen(allowed);
        snprintf(allowed + used, sizeof allowed - used, "%s%s", i == 0 ? "" : names[i + 1] ? ", " : " or ", names[i]);
    }
    if (e)
        ini_fail(&r->ini, e->line, "%s = %.60s: allowed is %s", key, e->value, allowed);
    return -1;
}

// --- profiles ---

static void take_table(reading *r, const char *section, skv_profile *profile) {
    const ini_entry *const e = ini_want(&r->ini, section, "table", true);
    if (!e)
        return;
    if (*e->value == '\0') {
        ini_fail(&r->ini, e->line, "table: allowed is the name of a file");
        return;
    }
    char *const path = ini_beside(r->ini.document, e->value);
    density_table table;
    r->ini.result = path ? table_read(&table, path) : fail_job("out of memory");
    free(path);
    if (r->ini.result)
        return;
    r->file->memory[r->tables++] = table.altitude_km;
    r->file->memory[r->tables++] = table.density;
    profile->table_altitude_km = table.altitude_km;
    profile->table_density = table.density;
    profile->table_rows = table.rows;
}

/// The parameters of a profile, by its kind.
static void take_parameters(reading *r, const char *section, skv_profile *p) {
    switch (p->kind) {
    case SKV_PROFILE_EXP_BACKGROUND:
        take_number(r, section, "background", true, (range){0, 1}, &p->background);
        take_number(r, section, "scale_height_km", true, (range){.001, 1000}, &p->scale_height_km);
        break;
    case SKV_PROFILE_EXPONENTIAL:
        take_number(r, section, "scale_height_km", true, (range){.001, 1000}, &p->scale_height_km);
        break;
    case SKV_PROFILE_US76:
        take_number(r, section, "a", false, (range){1e-9, 10}, &p->us76_a);
        take_number(r, section, "b", false, (range){.5, 3}, &p->us76_b);
        break;
    case SKV_PROFILE_TENT:
        take_number(r, section, "peak_km", true, (range){0, 1000}, &p->peak_km);
        take_number(r, section, "half_width_km", true, (range){.01, 1000}, &p->half_width_km);
        break;
    case SKV_PROFILE_LOGNORMAL:
        take_number(r, section, "mu", false, (range){-3, 7}, &p->lognormal_mu);
        take_number(r, section, "k", false, (range){.05, 200}, &p->lognormal_k);
        break;
    case SKV_PROFILE_TABLE:
        take_table(r, section, p);
        break;
    case SKV_PROFILE_NONE:
        break;
    }
}

/// Which profile reads a key that not all read.
static const struct {
    const char *key;
    unsigned kinds;
} readers[] = {
    {"scale_height_km", 1u << SKV_PROFILE_EXPONENTIAL | 1u << SKV_PROFILE_EXP_BACKGROUND},
    {"background", 1u << SKV_PROFILE_EXP_BACKGROUND},
    {"a", 1u << SKV_PROFILE_US76},
    {"b", 1u << SKV_PROFILE_US76},
    {"peak_km", 1u << SKV_PROFILE_TENT},
    {"half_width_km", 1u << SKV_PROFILE_TENT},
    {"mu", 1u << SKV_PROFILE_LOGNORMAL},
    {"k", 1u << SKV_PROFILE_LOGNORMAL},
    {"table", 1u << SKV_PROFILE_TABLE},
};

/// A known key that the chosen profile does not read is no error, but it is said; it must still be a number.
static void note_unread(reading *r, const char *section, skv_profile_kind kind) {
    for (size_t i = 0; i < sizeof readers / sizeof readers[0] && !r->ini.result; i++) {
        const ini_entry *const e = ini_find(r->ini.document, section, readers[i].key);
        double v;
        if (!e || readers[i].kinds >> kind & 1u)
            continue;
        if (strcmp(e->name, "table") != 0 && !check_number(r, e, e->value, (range){-3.4e38, 3.4e38}, &v))
            return;
        fail_usage("%.200s:%d: note: %s is not read with this profile", r->ini.document->path, e->line, e->name);
    }
}

static void take_profile(reading *r, const char *section, const char *const names[], const skv_profile_kind kinds[],
                         skv_profile *profile) {
    const int choice = take_choice(r, section, "profile", names);
    if (choice < 0)
        return;
    // The defaults of DESIGN section 8.
    *profile = (skv_profile){.kind = kinds[choice],
                             .us76_a = .07771971f,
                             .us76_b = 1.16364243f,
                             .lognormal_mu = 3.22261f,
                             .lognormal_k = 5.55555555f};
    take_parameters(r, section, profile);
    note_unread(r, section, profile->kind);
}

// --- sections ---

static const range coefficient = {0, 1e4};

static void take_bands(reading *r) {
    skv_atmosphere *const a = &r->file->atmosphere;
    double nm[4];
    a->bands = 0;
    const int n = take_doubles(r, "bands", "wavelength_nm", true, (range){200, 3000}, nm);
    for (int i = 0; i < n; i++) {
        a->wavelength_nm[i] = (float)nm[i];
        snprintf(r->file->band_name[i], sizeof r->file->band_name[i], "%.10g", nm[i]);
        if (i > 0 && !(a->wavelength_nm[i] > a->wavelength_nm[i - 1]))
            ini_fail(&r->ini, ini_want(&r->ini, "bands", "wavelength_nm", true)->line,
                     "wavelength_nm: %s does not follow %s; allowed are ascending values", r->file->band_name[i],
                     r->file->band_name[i - 1]);
    }
    a->bands = n;
    take_list(r, "bands", "solar_irradiance", true, (range){0, 1e6}, a->solar_irradiance);
}

static void take_planet(reading *r) {
    skv_atmosphere *const a = &r->file->atmosphere;
    take_number(r, "planet", "radius_km", true, (range){1, 100000}, &a->radius_km);
    take_number(r, "planet", "top_km", true, (range){.1, 1000}, &a->top_km);
    if (!r->ini.result && a->top_km > a->radius_km)
        ini_fail(&r->ini, ini_want(&r->ini, "planet", "top_km", true)->line,
                 "top_km = %g: allowed is at most radius_km, %g", (double)a->top_km, (double)a->radius_km);
    take_list(r, "planet", "albedo", true, (range){0, 1}, a->albedo);
}

static void take_rayleigh(reading *r) {
    static const char *const names[] = {"exponential", "us76", "table", NULL};
    static const skv_profile_kind kinds[] = {SKV_PROFILE_EXPONENTIAL, SKV_PROFILE_US76, SKV_PROFILE_TABLE};
    skv_atmosphere *const a = &r->file->atmosphere;
    take_list(r, "rayleigh", "scattering_per_km", true, coefficient, a->rayleigh_scattering_per_km);
    take_list(r, "rayleigh", "absorption_per_km", false, coefficient, a->rayleigh_absorption_per_km);
    take_profile(r, "rayleigh", names, kinds, &a->rayleigh);
}

/// What aerosol and dust have in common.
static void take_particles(reading *r, const char *section, float scattering[4], float extinction[4], skv_phase *phase,
                           float *g) {
    static const char *const phases[] = {"henyey-greenstein", "cornette-shanks", NULL};
    take_list(r, section, "scattering_per_km", true, coefficient, scattering);
    take_list(r, section, "extinction_per_km", true, coefficient, extinction);
    for (int i = 0; i < r->file->atmosphere.bands && !r->ini.result; i++)
        if (extinction[i] < scattering[i])
            ini_fail(&r->ini, ini_want(&r->ini, section, "extinction_per_km", true)->line,
                     "extinction_per_km = %g in band %d: allowed is scattering_per_km, %g, or more",
                     (double)extinction[i], i + 1, (double)scattering[i]);
    *phase = take_choice(r, section, "phase", phases) == 1 ? SKV_PHASE_CS : SKV_PHASE_HG;
    take_number(r, section, "g", true, (range){-.9999, .9999}, g);
}

static void take_aerosol(reading *r) {
    static const char *const names[] = {"exponential", "exponential-background", "table", NULL};
    static const skv_profile_kind kinds[] = {SKV_PROFILE_EXPONENTIAL, SKV_PROFILE_EXP_BACKGROUND, SKV_PROFILE_TABLE};
    skv_atmosphere *const a = &r->file->atmosphere;
    take_particles(r, "aerosol", a->aerosol_scattering_per_km, a->aerosol_extinction_per_km, &a->aerosol_phase,
                   &a->aerosol_g);
    take_profile(r, "aerosol", names, kinds, &a->aerosol);
}

static void take_dust(reading *r) {
    static const char *const names[] = {"exponential", "exponential-background", "tent", "lognormal", "table", NULL};
    static const skv_profile_kind kinds[] = {SKV_PROFILE_EXPONENTIAL, SKV_PROFILE_EXP_BACKGROUND, SKV_PROFILE_TENT,
                                             SKV_PROFILE_LOGNORMAL, SKV_PROFILE_TABLE};
    skv_atmosphere *const a = &r->file->atmosphere;
    take_particles(r, "dust", a->dust_scattering_per_km, a->dust_extinction_per_km, &a->dust_phase, &a->dust_g);
    take_profile(r, "dust", names, kinds, &a->dust);
}

static void take_ozone(reading *r) {
    static const char *const names[] = {"tent", "lognormal", "table", NULL};
    static const skv_profile_kind kinds[] = {SKV_PROFILE_TENT, SKV_PROFILE_LOGNORMAL, SKV_PROFILE_TABLE};
    skv_atmosphere *const a = &r->file->atmosphere;
    take_list(r, "ozone", "absorption_per_km", true, coefficient, a->ozone_absorption_per_km);
    take_profile(r, "ozone", names, kinds, &a->ozone);
}

static void take_all(reading *r) {
    check_names(r);
    take_bands(r);
    take_planet(r);
    take_rayleigh(r);
    if (ini_find_section(r->ini.document, "aerosol"))
        take_aerosol(r);
    if (ini_find_section(r->ini.document, "dust"))
        take_dust(r);
    if (ini_find_section(r->ini.document, "ozone"))
        take_ozone(r);
}

void atmosphere_free(atmosphere_file *file) {
    for (size_t i = 0; i < sizeof file->memory / sizeof file->memory[0]; i++) {
        free(file->memory[i]);
        file->memory[i] = NULL;
    }
}

int atmosphere_read(atmosphere_file *file, FILE *stream, const char *path) {
    ini_document document;
    *file = (atmosphere_file){0};
    file->atmosphere.turbidity = 1;
    for (int i = 0; i < 4; i++)
        file->atmosphere.absorption_colour[i] = 1;
    const int failed = ini_read(&document, stream, path);
    if (failed)
        return failed;
    reading r = {.ini.document = &document, .file = file};
    take_all(&r);
    ini_free(&document);
    if (r.ini.result)
        atmosphere_free(file);
    return r.ini.result;
}

int atmosphere_load(atmosphere_file *file, const char *path) {
    FILE *const stream = fopen(path, "rb");
    if (!stream)
        return fail_usage("%.200s: cannot be read: %s", path, strerror(errno));
    const int result = atmosphere_read(file, stream, path);
    fclose(stream);
    return result;
}
