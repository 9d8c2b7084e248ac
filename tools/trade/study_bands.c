/// What three bands instead of four are worth in colour: light scattered once against 48 wavelengths.
///
/// The air of a preset at any wavelength: gas by [Bodhaine99], ozone by the spectrum of [Serdyuchenko14] scaled to the
/// preset's, aerosol by power laws between the presets' seven bands, ground [Feister95], sun (ASTM G173).
#include "study_bands.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "convert.h"

enum { BINS = 48, ROWS_MAX = 128, RAYS_MAX = 64, KNOWN = 7 };

static double bin_nm(int i) {
    return 365.0 + 10.0 * i;
}

/// A file of spectra/: first column wavelengths.
typedef struct spectrum {
    int rows;
    double nm[ROWS_MAX], value[3][ROWS_MAX];
} spectrum;

static int read_spectrum(spectrum *s, const char *folder, const char *name, double shift_nm, int columns) {
    char path[1024], text[256];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *const in = fopen(path, "r");
    s->rows = 0;
    while (in != NULL && s->rows < ROWS_MAX && fgets(text, sizeof text, in) != NULL) {
        const int k = s->rows;
        if (text[0] == '#')
            continue;
        const int got = sscanf(text, "%lf %lf %lf %lf", &s->nm[k], &s->value[0][k], &s->value[1][k], &s->value[2][k]);
        s->nm[k] += shift_nm;
        s->rows += got == 1 + columns;
    }
    if (in != NULL)
        fclose(in);
    if (s->rows >= 40)
        return TRADE_STUDY_DONE;
    fprintf(stderr, "%s: no spectrum of %d columns there\n", path, 1 + columns);
    return TRADE_STUDY_FAILED;
}

/// Linear between the rows, constant beyond them.
static double at(const spectrum *s, int column, double nm) {
    if (nm <= s->nm[0])
        return s->value[column][0];
    for (int i = 1; i < s->rows; i++)
        if (nm <= s->nm[i]) {
            const double t = (nm - s->nm[i - 1]) / (s->nm[i] - s->nm[i - 1]);
            return (1 - t) * s->value[column][i - 1] + t * s->value[column][i];
        }
    return s->value[column][s->rows - 1];
}

/// Everything that depends on wavelength alone.
typedef struct light {
    spectrum sun, ozone, grass, eye;
    double known_nm[KNOWN], log_extinction[KNOWN], share[KNOWN]; ///< aerosol: extinction and scattering over it
    double ozone_scale;                                          ///< 1/km per m^2
    double rayleigh_scale;                                       ///< of the preset against [Bodhaine99]
    double observer[BINS][3];                                    ///< cd/m2 per W m^-2 sr^-1 nm^-1
} light;

/// [Bodhaine99] Eq. 29, per km at 288.15 K and 1013.25 hPa.
static double rayleigh_per_km(double nm) {
    const double w2 = nm * nm * 1e-6;
    const double cm2 =
        1e-28 * (1.0455996 - 341.29061 / w2 - 0.90230850 * w2) / (1 + 0.0027059889 / w2 - 85.968563 * w2);
    return cm2 * 2.546899e19 * 1e5;
}

static void observe(light *l) {
    for (int i = 0; i < BINS; i++)
        for (int c = 0; c < 3; c++) {
            const double nm = bin_nm(i), beyond = l->eye.nm[l->eye.rows - 1];
            double sum = 0;
            for (int k = -1; k <= 1; k++)
                sum += nm + 5 * k > beyond ? 0 : (k == 0 ? 0.5 : 0.25) * at(&l->eye, c, nm + 5 * k);
            l->observer[i][c] = sum * 10 * 683;
        }
}

static void learn(light *l, const skv_atmosphere air[2]) {
    int n = 0;
    double low[2] = {0, 0}; // both lists ascend: merge them
    for (int i = 0, j = 0; n < KNOWN; n++) {
        const int four = i == 3 || (j < 4 && air[1].wavelength_nm[j] < air[0].wavelength_nm[i]);
        const skv_atmosphere *const a = &air[four];
        const int b = four ? j++ : i++;
        l->known_nm[n] = (double)a->wavelength_nm[b];
        l->log_extinction[n] = log((double)a->aerosol_extinction_per_km[b]);
        l->share[n] = (double)a->aerosol_scattering_per_km[b] / (double)a->aerosol_extinction_per_km[b];
    }
    for (int b = 0; b < 4; b++) {
        const double nm = (double)air[1].wavelength_nm[b];
        low[0] += (double)air[1].ozone_absorption_per_km[b] / at(&l->ozone, 0, nm) / 4;
        low[1] += (double)air[1].rayleigh_scattering_per_km[b] / rayleigh_per_km(nm) / 4;
    }
    l->ozone_scale = low[0];
    l->rayleigh_scale = low[1];
    observe(l);
}

static int prepare(light *l, const char *folder, const skv_atmosphere air[2]) {
    int status = read_spectrum(&l->sun, folder, "solar_g173.txt", 5, 1);
    if (status == TRADE_STUDY_DONE)
        status = read_spectrum(&l->ozone, folder, "ozone_serdyuchenko.txt", 5, 1);
    if (status == TRADE_STUDY_DONE)
        status = read_spectrum(&l->grass, folder, "grass_albedo.txt", 0, 1);
    if (status == TRADE_STUDY_DONE)
        status = read_spectrum(&l->eye, folder, "cie1931.txt", 0, 3);
    if (status == TRADE_STUDY_DONE)
        learn(l, air);
    return status;
}

/// Power law between the known bands, beyond them that of the last two.
static double aerosol_extinction(const light *l, double nm, double *share) {
    int i = 1;
    while (i < KNOWN - 1 && nm > l->known_nm[i])
        i++;
    const double t = log(nm / l->known_nm[i - 1]) / log(l->known_nm[i] / l->known_nm[i - 1]);
    *share = l->share[i];
    return exp((1 - t) * l->log_extinction[i - 1] + t * l->log_extinction[i]);
}

/// Bins 4 k to 4 k + 3.
static void set_bins(const light *l, int k, ref_atmosphere *air) {
    for (int b = 0; b < 4; b++) {
        const double nm = bin_nm(4 * k + b);
        double share;
        air->wavelength_nm[b] = nm;
        air->irradiance[b] = at(&l->sun, 0, nm);
        air->albedo[b] = at(&l->grass, 0, nm);
        air->rayleigh_scattering[b] = l->rayleigh_scale * rayleigh_per_km(nm);
        air->aerosol_extinction[b] = aerosol_extinction(l, nm, &share);
        air->aerosol_scattering[b] = share * air->aerosol_extinction[b];
        air->ozone_absorption[b] = l->ozone_scale * at(&l->ozone, 0, nm);
    }
}

typedef struct rays {
    double height_km;
    float sun_enu[3];
    size_t n;
    float direction[RAYS_MAX][3];
    double xyz[RAYS_MAX][3];
} rays;

static void lay(rays *r, const skv_atmosphere *air, int scene, int wanted) {
    const double sun = trade_sun_zenith_deg[scene % TRADE_SUNS];
    r->height_km = trade_height_km[scene / TRADE_SUNS];
    r->n = 0;
    trade_direction(r->sun_enu, sun, 0);
    const double horizon = study_horizon_deg(air, r->height_km);
    for (int i = 1; (int)r->n < wanted; i++) {
        const double lowest = r->height_km > 0 ? horizon + 20 : horizon;
        float *const d = r->direction[r->n];
        trade_direction(d, lowest * study_halton(i, 2), 360 * study_halton(i, 3));
        const double cosine = (double)(d[0] * r->sun_enu[0] + d[1] * r->sun_enu[1] + d[2] * r->sun_enu[2]);
        r->n += cosine < cos(3 * STUDY_DEGREE);
    }
}

static void find_truth(rays *r, const light *l, const skv_atmosphere *of) {
    static ref_file file;
    ref_from_skyvert(of, 0, &file);
    memset(r->xyz, 0, sizeof r->xyz);
    for (int k = 0; k < BINS / 4; k++) {
        set_bins(l, k, &file.atmosphere);
        for (size_t i = 0; i < r->n; i++) {
            const ref_options coarse = {1e-5, 16}; // a hundred-thousandth is no colour
            double v[3], s[3];
            ref_answer answer;
            for (int c = 0; c < 3; c++)
                v[c] = (double)r->direction[i][c], s[c] = (double)r->sun_enu[c];
            const ref_ray ray = ref_ray_from_vectors(r->height_km, v, s);
            (void)ref_single(&file.atmosphere, &ray, 1, &coarse, &answer);
            for (int b = 0; b < 4; b++)
                for (int c = 0; c < 3; c++)
                    r->xyz[i][c] += l->observer[4 * k + b][c] * answer.radiance[b];
        }
    }
}

static int compare(const rays *r, const skv_atmosphere *air, int which, study_bands *result) {
    static float radiance[RAYS_MAX][4];
    skv_colour_matrix matrix;
    double white = 0, want[3], got[3];
    skv_model *const model = study_model(air);
    study_sky sky = {.model = model};
    int status = TRADE_STUDY_FAILED;
    (void)skv_quality_tier(&sky.quality, SKV_TIER_HIGH);
    sky.quality.terms = SKV_WITH_ALL;
    if (model != NULL && skv_colour_matrix_fitted(&matrix, air->bands, air->wavelength_nm) == SKV_OK)
        status = study_radiance(&sky, r->height_km, r->sun_enu, r->n, (const float(*)[3])r->direction, radiance);
    free(model);
    for (size_t i = 0; i < r->n; i++)
        white = fmax(white, r->xyz[i][1]);
    result->mean[which] = result->max[which] = result->luminance[which] = 0;
    for (size_t i = 0; status == TRADE_STUDY_DONE && i < r->n; i++) {
        double l[4] = {0};
        for (int b = 0; b < air->bands; b++)
            l[b] = (double)radiance[i][b];
        study_lab_of(r->xyz[i], white, want);
        study_lab(&matrix, air->bands, l, white, got);
        const double e = study_distance(got, want);
        result->mean[which] += e / (double)r->n;
        result->max[which] = fmax(result->max[which], e);
        const double off = study_luminance(&matrix, air->bands, l) - r->xyz[i][1];
        result->luminance[which] += fabs(off) / fmax(r->xyz[i][1], 0.05 * white) / (double)r->n;
    }
    return status;
}

int study_bands_measure(skv_preset preset, const char *spectra, int wanted, study_bands result[TRADE_SCENES]) {
    static light l;
    static rays r;
    skv_atmosphere air[2];
    if (skv_atmosphere_preset(&air[0], preset, 3) != SKV_OK || skv_atmosphere_preset(&air[1], preset, 4) != SKV_OK) {
        fprintf(stderr, "trade: no such preset\n");
        return TRADE_STUDY_FAILED;
    }
    int status = prepare(&l, spectra, air);
    for (int k = 0; status == TRADE_STUDY_DONE && k < TRADE_SCENES; k++) {
        lay(&r, &air[1], k, wanted);
        find_truth(&r, &l, &air[1]);
        for (int which = 0; status == TRADE_STUDY_DONE && which < 2; which++)
            status = compare(&r, &air[which], which, &result[k]);
    }
    return status;
}
