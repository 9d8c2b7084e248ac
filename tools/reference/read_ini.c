/// Reads the ini form of an atmosphere for the reference, by itself.
#include <ctype.h>
#include <ini.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "read_ini.h"

typedef struct reader {
    ref_file *file;
    const char *name;
    int line, counts[10], failed;
    char table[4][512];
} reader;

static int list(double *out, int most, const char *text) {
    int n = 0;
    while (n < most) {
        char *end;
        out[n] = strtod(text, &end);
        if (end == text || !isfinite(out[n]))
            return 0;
        n++;
        while (isspace((unsigned char)*end))
            end++;
        if (*end == '\0')
            return n;
        if (*end != ',')
            return 0;
        text = end + 1;
    }
    return 0;
}

static int kind(ref_profile *p, const char *value) {
    static const char *const names[] = {"",          "exponential", "exponential-background", "us76", "tent",
                                        "lognormal", "table"};
    for (int i = 1; i <= REF_TABLE; i++)
        if (strcmp(value, names[i]) == 0)
            p->kind = (ref_kind)i;
    return p->kind != REF_NONE;
}

typedef struct key {
    const char *section, *name;
    double *value;
    int most;
} key;

static int profile_key(reader *r, int which, ref_profile *p, const char *name, const char *value) {
    const key keys[] = {{0, "scale_height_km", &p->scale_km, 1},
                        {0, "background", &p->background, 1},
                        {0, "a", &p->us76_a, 1},
                        {0, "b", &p->us76_b, 1},
                        {0, "peak_km", &p->peak_km, 1},
                        {0, "half_width_km", &p->half_width_km, 1},
                        {0, "mu", &p->lognormal_mu, 1},
                        {0, "k", &p->lognormal_k, 1}};
    if (strcmp(name, "profile") == 0)
        return kind(p, value);
    if (strcmp(name, "table") == 0)
        return snprintf(r->table[which], sizeof r->table[which], "%s", value) > 0;
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (strcmp(name, keys[i].name) == 0)
            return list(keys[i].value, 1, value) == 1;
    return 0;
}

static int phase(ref_phase *phase, const char *value) {
    if (strcmp(value, "henyey-greenstein") == 0)
        *phase = REF_HENYEY_GREENSTEIN;
    else if (strcmp(value, "cornette-shanks") == 0)
        *phase = REF_CORNETTE_SHANKS;
    else
        return 0;
    return 1;
}

static int take(void *user, const char *section, const char *name, const char *value) {
    reader *r = user;
    ref_atmosphere *a = &r->file->atmosphere;
    const key keys[] = {{"planet", "radius_km", &a->radius_km, 1},
                        {"planet", "top_km", &a->top_km, 1},
                        {"planet", "albedo", a->albedo, 4},
                        {"bands", "wavelength_nm", a->wavelength_nm, 4},
                        {"bands", "solar_irradiance", a->irradiance, 4},
                        {"rayleigh", "scattering_per_km", a->rayleigh_scattering, 4},
                        {"aerosol", "scattering_per_km", a->aerosol_scattering, 4},
                        {"aerosol", "extinction_per_km", a->aerosol_extinction, 4},
                        {"ozone", "absorption_per_km", a->ozone_absorption, 4},
                        {"rayleigh", "absorption_per_km", a->rayleigh_absorption, 4},
                        {"dust", "scattering_per_km", a->dust_scattering, 4},
                        {"dust", "extinction_per_km", a->dust_extinction, 4},
                        {"aerosol", "g", &a->g, 1},
                        {"dust", "g", &a->dust_g, 1}};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (strcmp(section, keys[i].section) == 0 && strcmp(name, keys[i].name) == 0) {
            const int n = list(keys[i].value, keys[i].most, value);
            if (i >= 2 && i < 12)
                r->counts[i - 2] = n;
            return n > 0;
        }
    if (strcmp(section, "aerosol") == 0 && strcmp(name, "phase") == 0)
        return phase(&a->phase, value);
    if (strcmp(section, "dust") == 0 && strcmp(name, "phase") == 0)
        return phase(&a->dust_phase, value);
    if (strcmp(section, "rayleigh") == 0)
        return profile_key(r, 0, &a->rayleigh, name, value);
    if (strcmp(section, "aerosol") == 0)
        return profile_key(r, 1, &a->aerosol, name, value);
    if (strcmp(section, "ozone") == 0)
        return profile_key(r, 2, &a->ozone, name, value);
    if (strcmp(section, "dust") == 0)
        return profile_key(r, 3, &a->dust, name, value);
    return 0;
}

static int complain(const char *file, int line, const char *what) {
    fprintf(stderr, "%s:%d: %s\n", file, line, what);
    return -1;
}

static int rows(FILE *in, const char *name, double *km, double *density) {
    char text[256];
    int n = 0;
    for (int line = 1; fgets(text, sizeof text, in); line++) {
        double row[2];
        if (text[0] == '#' || text[0] == '\n' || (line == 1 && isalpha((unsigned char)text[0])))
            continue;
        text[strcspn(text, "\r\n")] = '\0';
        if (n == REF_TABLE_ROWS || list(row, 2, text) != 2 || row[1] < 0 || (n > 0 && row[0] <= km[n - 1])) {
            complain(name, line, "altitude_km,relative_density, ascending, 512 rows at most");
            return 0;
        }
        km[n] = row[0];
        density[n++] = row[1];
    }
    return n;
}

static int read_table(reader *r, int which, ref_profile *p) {
    char path[1024];
    const char *slash = strrchr(r->name, '/');
    const int folder = r->table[which][0] == '/' || !slash ? 0 : (int)(slash - r->name) + 1;
    if (p->kind != REF_TABLE)
        return 0;
    snprintf(path, sizeof path, "%.*s%s", folder, r->name, r->table[which]);
    FILE *in = fopen(path, "r");
    if (!in)
        return complain(r->name, 0, "a table cannot be opened");
    p->table_km = r->file->table_km[which];
    p->table_density = r->file->table_density[which];
    p->rows = rows(in, path, r->file->table_km[which], r->file->table_density[which]);
    fclose(in);
    return p->rows >= 2 ? 0 : complain(path, 0, "two rows at least");
}

int ref_read_ini(ref_file *file, const char *name) {
    static reader none;
    reader r = none;
    r.file = file;
    r.name = name;
    const ref_profile blank = {
        .us76_a = .07771971, .us76_b = 1.16364243, .lognormal_mu = 3.22261, .lognormal_k = 5.55555555};
    ref_atmosphere *a = &file->atmosphere;
    *a = (ref_atmosphere){.rayleigh = blank, .aerosol = blank, .ozone = blank, .dust = blank};
    const int line = ini_parse(name, take, &r);
    if (line != 0)
        return complain(name, line < 0 ? 0 : line, line < 0 ? "cannot be read" : "unknown key or bad value");
    a->bands = r.counts[1]; // of wavelength_nm
    for (int i = 0; i < 10; i++)
        if (r.counts[i] != 0 && r.counts[i] != a->bands)
            return complain(name, 0, "the lists differ in length");
    if (a->bands < 3 || !(a->radius_km > 0) || !(a->top_km > 0))
        return complain(name, 0, "[planet] radius_km, top_km and [bands] wavelength_nm of 3 or 4 bands are needed");
    return read_table(&r, 0, &a->rayleigh) || read_table(&r, 1, &a->aerosol) || read_table(&r, 2, &a->ozone) ||
                   read_table(&r, 3, &a->dust)
               ? -1
               : 0;
}
