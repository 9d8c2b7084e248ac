/// What each term is worth in error and costs in instructions, per scene: `skyvert trade --study ablation`.
///
/// A term is left out as a product leaves it out: its matter is taken from the air and the table is built without it.
/// The settings that are varied: standard tier, accurate packed table, integrated directly, everything in.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert.h"
#include "metric.h"
#include "study_bands.h"
#include "study_count.h"
#include "study_rule.h"
#include "study_sky.h"

enum { VERTICES = 2048, RULE_RAYS = 48 };

typedef enum part {
    WHOLE,
    NO_OZONE,
    NO_AEROSOL,
    NO_DUST,
    NO_GROUND,
    NO_BOUNCE,
    NO_DIFFUSE,
    NO_AUREOLE,
    SMALL,
    GRID,
    FAST,
    HIGH,
    CONFIGURATIONS
} part;

static const char *const name_of[CONFIGURATIONS] = {
    "everything",       "no ozone",           "no aerosol",  "no dust",     "no ground in view", "black ground",
    "no diffuse light", "no aureole numbers", "small table", "with a grid", "fast tier",         "high tier"};

static const study_rule rules[] = {
    {"both splits", 6, 1, 1}, {"no shadow split", 6, 0, 1}, {"no tangent split", 6, 1, 0}, {"neither split", 6, 0, 0}};
enum { RULES = sizeof rules / sizeof *rules };

/// What the configurations do without.
static const char *const needed_of[CONFIGURATIONS] = {"",
                                                      "ozone",
                                                      "aerosol",
                                                      "dust",
                                                      "ground in view",
                                                      "light off ground",
                                                      "diffuse light",
                                                      "aureole numbers",
                                                      "accurate table",
                                                      "",
                                                      "standard tier",
                                                      ""};

/// Figures of one scene under one configuration.
typedef struct figure {
    trade_error error;
    double colour, colour_max; ///< Delta E 1976, mean and largest
    double instructions;       ///< a vertex; < 0 not known
} figure;

typedef struct work {
    const trade_study *how;
    const trade_study_air *air;
    trade_scene scene[TRADE_SCENES];
    int present[CONFIGURATIONS];
    figure figure[CONFIGURATIONS][TRADE_SCENES];
    int has_rules; ///< the rule's splits were measured
    trade_error rule[RULES][TRADE_SCENES];
    double samples[RULES][TRADE_SCENES]; ///< a ray
    skv_colour_matrix matrix;
    double done, share; ///< of the whole study: so far, and what this air takes
    FILE *text, *csv;
} work;

static int has_profile(const skv_profile *p) {
    return p->kind != SKV_PROFILE_NONE;
}

static int applies(const skv_atmosphere *air, part what) {
    return what == NO_OZONE     ? has_profile(&air->ozone)
           : what == NO_AEROSOL ? has_profile(&air->aerosol)
           : what == NO_DUST    ? has_profile(&air->dust)
                                : 1;
}

/// The air without what is left out.
static skv_atmosphere without(const skv_atmosphere *air, part what) {
    skv_atmosphere a = *air;
    if (what == NO_OZONE)
        a.ozone.kind = SKV_PROFILE_NONE;
    if (what == NO_AEROSOL)
        a.aerosol.kind = SKV_PROFILE_NONE;
    if (what == NO_DUST)
        a.dust.kind = SKV_PROFILE_NONE;
    for (int b = 0; b < 4 && what == NO_BOUNCE; b++)
        a.albedo[b] = 0;
    return a;
}

/// A sky with a model and a table of its own. @return FAILED with a line on stderr, else DONE.
static int make_sky(study_sky *sky, const skv_atmosphere *air, part what) {
    const skv_atmosphere a = without(air, what);
    skv_table_spec spec;
    skv_model *const model = study_model(&a);
    skv_table *table = NULL;
    *sky = (study_sky){.model = model, .grid = what == GRID};
    if (model == NULL)
        return TRADE_STUDY_FAILED;
    (void)skv_table_spec_for(&spec, model, what == SMALL ? SKV_TABLE_SMALL : SKV_TABLE_ACCURATE);
    if (what == NO_AUREOLE)
        spec.detailed = 0;
    if (what != NO_DIFFUSE && (table = study_table(model, &spec)) == NULL)
        return TRADE_STUDY_FAILED;
    sky->table = table;
    (void)skv_quality_tier(&sky->quality, what == FAST   ? SKV_TIER_FAST
                                          : what == HIGH ? SKV_TIER_HIGH
                                                         : SKV_TIER_STANDARD);
    sky->quality.terms = SKV_WITH_ALL & ~(what == NO_GROUND ? (uint32_t)SKV_WITH_GROUND : 0u);
    return TRADE_STUDY_DONE;
}

static void free_sky(study_sky *sky) {
    free((void *)(uintptr_t)sky->table);
    free((void *)(uintptr_t)sky->model);
}

static const char *scene_name(int k, char text[32]) {
    snprintf(text, 32, "%s %s", trade_height_name[k / TRADE_SUNS], trade_sun_name[k % TRADE_SUNS]);
    return text;
}

// --- error ---

static void measure_colour(const work *w, const trade_scene *s, float (*got)[4], figure *f) {
    const int bands = w->air->atmosphere->bands;
    double white = 0, want[3], have[3];
    for (size_t i = 0; i < (size_t)s->n; i++)
        white = fmax(white, study_luminance(&w->matrix, bands, s->radiance[TRADE_FULL][i]));
    f->colour = f->colour_max = 0;
    for (size_t i = 0; i < (size_t)s->n; i++) {
        double radiance[4];
        for (int b = 0; b < 4; b++)
            radiance[b] = (double)got[i][b];
        study_lab(&w->matrix, bands, s->radiance[TRADE_FULL][i], white, want);
        study_lab(&w->matrix, bands, radiance, white, have);
        const double e = study_distance(want, have);
        f->colour += e / s->n;
        f->colour_max = fmax(f->colour_max, e);
    }
}

static int measure(work *w, const study_sky *sky, part what) {
    static float got[TRADE_RAYS][4];
    static double scratch[TRADE_RAYS];
    int status = TRADE_STUDY_DONE;
    for (int k = 0; status == TRADE_STUDY_DONE && k < TRADE_SCENES; k++) {
        const trade_scene *const s = &w->scene[k];
        status = study_radiance(sky, s->height_km, s->sun_enu, (size_t)s->n, (const float(*)[3])s->direction, got);
        trade_measure((size_t)s->n, w->air->atmosphere->bands, (const float(*)[TRADE_BANDS])got,
                      (const double(*)[TRADE_BANDS])s->radiance[TRADE_FULL], scratch, &w->figure[what][k].error);
        measure_colour(w, s, got, &w->figure[what][k]);
    }
    return status;
}

// --- instructions ---

static study_counts counted;

static int is_counted(const trade_study *how, const skv_atmosphere *air, part what) {
    const int costs_the_same = what == NO_BOUNCE || what == SMALL;
    return applies(air, what) && !costs_the_same && (!how->quick || what <= NO_OZONE);
}

static void label_of(char label[STUDY_LABEL], const trade_study_air *air, int k, part what) {
    char scene[32];
    snprintf(label, STUDY_LABEL, "%.16s|%s|%s", air->name, scene_name(k, scene), name_of[what]);
}

/// The sky down to the horizon, from above the ground 10 deg below the horizontal too.
static void lay_dome(double height_km, float direction[VERTICES][3]) {
    const int rings = 32, azimuths = VERTICES / rings;
    for (int i = 0; i < VERTICES; i++)
        trade_direction(direction[i], (height_km > 0 ? 100 : 90) * ((i / azimuths) + 0.5) / rings,
                        360.0 * (i % azimuths) / azimuths);
}

static int count_sky(const trade_study_air *air, const study_sky *sky, part what) {
    static float direction[VERTICES][3], radiance[VERTICES][4];
    int status = TRADE_STUDY_DONE;
    callgrind_on();
    for (int k = 0; status == TRADE_STUDY_DONE && k < TRADE_SCENES; k++) {
        char label[STUDY_LABEL];
        float sun[3];
        const double height = trade_height_km[k / TRADE_SUNS];
        label_of(label, air, k, what);
        lay_dome(height, direction);
        trade_direction(sun, trade_sun_zenith_deg[k % TRADE_SUNS], 0);
        status = study_radiance(sky, height, sun, 8, (const float(*)[3])direction, radiance); // symbols are bound now
        callgrind_begin();
        if (status == TRADE_STUDY_DONE)
            status = study_radiance(sky, height, sun, VERTICES, (const float(*)[3])direction, radiance);
        callgrind_end(label);
    }
    callgrind_off();
    return status;
}

int trade_ablation_count(const trade_study *how) {
    int status = TRADE_STUDY_DONE;
    for (int a = 0; a < how->airs; a++)
        for (int c = 0; status == TRADE_STUDY_DONE && c < CONFIGURATIONS; c++) {
            study_sky sky;
            if (!is_counted(how, how->air[a].atmosphere, (part)c))
                continue;
            status = make_sky(&sky, how->air[a].atmosphere, (part)c);
            if (status == TRADE_STUDY_DONE)
                status = count_sky(&how->air[a], &sky, (part)c);
            free_sky(&sky);
        }
    return status;
}

// --- text ---

static void print_scenes(const work *w, const char *what) {
    fprintf(w->text, "%-19s", what);
    for (int k = 0; k < TRADE_SCENES; k++) {
        char name[32];
        fprintf(w->text, " %10.10s", k % TRADE_SUNS == 0 ? scene_name(k, name) : trade_sun_name[k % TRADE_SUNS]);
    }
    fprintf(w->text, "\n");
}

static void print_pair(FILE *to, double a, double b) {
    char text[32];
    snprintf(text, sizeof text, a < 9.95 ? "%.1f/%.*f" : "%.0f/%.*f", a, b < 9.95 ? 1 : 0, b);
    fprintf(to, " %10s", text);
}

static void print_errors(const work *w) {
    fprintf(w->text, "\n%s: error in %%, mean/largest\n", w->air->name);
    print_scenes(w, "");
    for (int c = 0; c < CONFIGURATIONS; c++) {
        if (!w->present[c])
            continue;
        fprintf(w->text, "%-19s", name_of[c]);
        for (int k = 0; k < TRADE_SCENES; k++)
            print_pair(w->text, 100 * w->figure[c][k].error.mean, 100 * w->figure[c][k].error.max);
        fprintf(w->text, "\n");
    }
    fprintf(w->text, "\n%s: colour, Delta E 1976 mean/largest (white: the scene's brightest ray)\n", w->air->name);
    print_scenes(w, "");
    for (int c = 0; c < CONFIGURATIONS; c++) {
        if (!w->present[c])
            continue;
        fprintf(w->text, "%-19s", name_of[c]);
        for (int k = 0; k < TRADE_SCENES; k++)
            print_pair(w->text, w->figure[c][k].colour, w->figure[c][k].colour_max);
        fprintf(w->text, "\n");
    }
}

static void print_instructions(const work *w) {
    if (w->figure[WHOLE][0].instructions < 0)
        return;
    fprintf(w->text,
            "\n"
            "%s: instructions a vertex (callgrind; frames of %d), then what leaving things out changes. "
            "One\n"
            "program with everything in it: what is compiled out (include/skyvert/config.h) saves more, and a frame "
            "unlike those\n"
            "that have a kernel of their own (four bands with ozone is one) costs more.\n",
            w->air->name, VERTICES);
    print_scenes(w, "");
    for (int c = 0; c < CONFIGURATIONS; c++) {
        if (!w->present[c])
            continue;
        fprintf(w->text, "%-19s", name_of[c]);
        for (int k = 0; k < TRADE_SCENES; k++) {
            const double all = w->figure[WHOLE][k].instructions, n = w->figure[c][k].instructions;
            if (n < 0)
                fprintf(w->text, " %10s", "-");
            else
                fprintf(w->text, c == WHOLE ? " %10.0f" : " %+10.0f", c == WHOLE ? n : n - all);
        }
        fprintf(w->text, "\n");
    }
}

/// How much a scene needs what is left out, by what error and colours lose.
static const char *need(double mean, double most, double colour) {
    if (mean < 0.0025 && most < 0.01 && colour < 0.25)
        return "no";
    return mean < 0.02 && most < 0.1 && colour < 1 ? "little" : "YES";
}

static void print_needs(const work *w) {
    fprintf(w->text,
            "\n"
            "%s: does the scene need it? no: without it the mean error grows by < .25 %%, the largest by < 1 %%, Delta "
            "E by <\n"
            ".25; little: < 2 %%, < 10 %%, < 1. Splits: light scattered once\n",
            w->air->name);
    print_scenes(w, "");
    for (int c = NO_OZONE; c <= FAST; c++) {
        if (!w->present[c] || c == GRID)
            continue;
        fprintf(w->text, "%-19s", needed_of[c]);
        for (int k = 0; k < TRADE_SCENES; k++) {
            const figure *const all = &w->figure[WHOLE][k], *const left = &w->figure[c][k];
            fprintf(
                w->text, " %10s",
                need(left->error.mean - all->error.mean, left->error.max - all->error.max, left->colour - all->colour));
        }
        fprintf(w->text, "\n");
    }
    for (int r = 1; w->has_rules && r < RULES - 1; r++) {
        fprintf(w->text, "%-19s", rules[r].name + strlen("no "));
        for (int k = 0; k < TRADE_SCENES; k++)
            fprintf(w->text, " %10s",
                    need(w->rule[r][k].mean - w->rule[0][k].mean, w->rule[r][k].max - w->rule[0][k].max, 0));
        fprintf(w->text, "\n");
    }
}

static void write_row(const work *w, int k, const char *light, const char *term, const figure *f, double samples) {
    const trade_scene *const s = &w->scene[k];
    fprintf(w->csv, "%s,%g,%g,%s,%s,%.4f,%.4f,%.4f", w->air->name, s->height_km, s->sun_zenith_deg, light, term,
            100 * f->error.mean, 100 * f->error.p95, 100 * f->error.max);
    const double rest[4] = {f->colour, f->colour_max, f->instructions, samples};
    for (int i = 0; i < 4; i++)
        fprintf(w->csv, rest[i] >= 0 ? ",%.3f" : ",", rest[i]);
}

static void write_terms(const work *w) {
    for (int c = 0; c < CONFIGURATIONS; c++)
        for (int k = 0; w->present[c] && k < TRADE_SCENES; k++) {
            const size_t i = w->figure[c][k].error.worst;
            write_row(w, k, "all", name_of[c], &w->figure[c][k], -1);
            fprintf(w->csv, ",%g,%g\n", w->scene[k].view_zenith_deg[i], w->scene[k].azimuth_deg[i]);
        }
}

static int study_terms(work *w) {
    int status = study_scenes(w->scene, w->air);
    const skv_atmosphere *const air = w->air->atmosphere;
    if (status == TRADE_STUDY_DONE &&
        skv_colour_matrix_for(&w->matrix, air->bands, air->wavelength_nm, air->solar_irradiance) != SKV_OK) {
        fprintf(stderr, "trade: %s: no colours for these bands\n", w->air->name);
        status = TRADE_STUDY_FAILED;
    }
    for (int c = 0; status == TRADE_STUDY_DONE && c < CONFIGURATIONS; c++) {
        study_sky sky;
        w->present[c] = applies(air, (part)c);
        if (!w->present[c])
            continue;
        status = make_sky(&sky, air, (part)c);
        if (status == TRADE_STUDY_DONE)
            status = measure(w, &sky, (part)c);
        free_sky(&sky);
        for (int k = 0; k < TRADE_SCENES; k++) {
            char label[STUDY_LABEL];
            label_of(label, w->air, k, (part)c);
            w->figure[c][k].instructions = study_count_of(&counted, label) / VERTICES;
        }
        if (status == TRADE_STUDY_DONE && study_stop(w->how, w->done + w->share * (c + 1) / CONFIGURATIONS))
            status = TRADE_STUDY_STOPPED;
    }
    return status;
}

// --- splits ---

static void truth_of(const ref_atmosphere *air, const ref_ray *ray, double truth[4]) {
    ref_answer answer;
    (void)ref_single(air, ray, 0, NULL, &answer);
    memcpy(truth, answer.radiance, sizeof answer.radiance);
}

/// Evenly in the zenith angle; every third ray between the geometric horizon and 6 deg above it or, from high up, the
/// horizontal.
static void measure_rules(const ref_atmosphere *air, double horizon, const trade_scene *s, int rays,
                          trade_error e[RULES], double samples[RULES]) {
    static float got[RULES][RULE_RAYS][4];
    static double truth[RULE_RAYS][4], scratch[RULE_RAYS];
    memset(samples, 0, RULES * sizeof *samples);
    for (int i = 0; i < rays; i++) {
        const double t = study_halton(i + 1, 2), limb = fmin(horizon - 6, 90);
        const double view = i % 3 == 0 ? limb + (horizon - limb) * (0.999 * t) : horizon * t;
        const ref_ray ray = ref_ray_from_angles(s->height_km, s->sun_zenith_deg, view, 360 * study_halton(i + 1, 3));
        truth_of(air, &ray, truth[i]);
        for (int r = 0; r < RULES; r++) {
            double radiance[4];
            samples[r] += (double)study_rule_radiance(air, &rules[r], &ray, radiance) / rays;
            for (int b = 0; b < 4; b++)
                got[r][i][b] = (float)radiance[b];
        }
    }
    for (int r = 0; r < RULES; r++)
        trade_measure((size_t)rays, air->bands, (const float(*)[TRADE_BANDS])got[r],
                      (const double(*)[TRADE_BANDS])truth, scratch, &e[r]);
}

static void print_splits(const work *w) {
    fprintf(w->text,
            "\n"
            "%s: the rule's splits, light scattered once, %d nodes a part, written anew in double with exact columns: "
            "error in\n"
            "%%, mean/largest, and below it samples a ray\n",
            w->air->name, rules[0].samples);
    print_scenes(w, "");
    for (int r = 0; r < RULES; r++) {
        fprintf(w->text, "%-19s", rules[r].name);
        for (int k = 0; k < TRADE_SCENES; k++)
            print_pair(w->text, 100 * w->rule[r][k].mean, 100 * w->rule[r][k].max);
        fprintf(w->text, "\n%-19s", "");
        for (int k = 0; k < TRADE_SCENES; k++)
            fprintf(w->text, " %10.1f", w->samples[r][k]);
        fprintf(w->text, "\n");
    }
}

static int study_splits(work *w) {
    static ref_file file;
    if (has_profile(&w->air->atmosphere->dust))
        return TRADE_STUDY_DONE; // the rule of study_rule.h knows none
    ref_from_skyvert(w->air->atmosphere, 0, &file);
    for (int k = 0; k < TRADE_SCENES; k++) {
        trade_error error[RULES];
        double samples[RULES];
        const double horizon = study_horizon_deg(w->air->atmosphere, w->scene[k].height_km);
        measure_rules(&file.atmosphere, horizon, &w->scene[k], w->how->quick ? 24 : RULE_RAYS, error, samples);
        for (int r = 0; r < RULES; r++) {
            const figure f = {error[r], -1, -1, -1};
            write_row(w, k, "once", rules[r].name, &f, samples[r]);
            fprintf(w->csv, ",,\n");
            w->rule[r][k] = error[r];
            w->samples[r][k] = samples[r];
        }
        if (study_stop(w->how, w->done))
            return TRADE_STUDY_STOPPED;
    }
    w->has_rules = 1;
    return TRADE_STUDY_DONE;
}

// --- bands ---

static int study_colours(work *w) {
    static const char *const name[2] = {"earth-clear", "earth-hazy"};
    static study_bands bands[TRADE_SCENES];
    static const char *const count[2] = {"3 bands", "4 bands"};
    for (int p = 0; w->how->spectra != NULL && p < 2; p++) {
        const int status = study_bands_measure(p == 0 ? SKV_PRESET_EARTH_CLEAR : SKV_PRESET_EARTH_HAZY, w->how->spectra,
                                               w->how->quick ? 6 : 24, bands);
        if (status != TRADE_STUDY_DONE)
            return status;
        fprintf(w->text,
                "\n"
                "%s: bands, light scattered once against 48 wavelengths: Delta E 1976 mean/largest, and luminance in "
                "%%, mean\n",
                name[p]);
        print_scenes(w, "");
        for (int which = 0; which < 2; which++) {
            fprintf(w->text, "%-19s", count[which]);
            for (int k = 0; k < TRADE_SCENES; k++)
                print_pair(w->text, bands[k].mean[which], bands[k].max[which]);
            fprintf(w->text, "\n%-19s", "");
            for (int k = 0; k < TRADE_SCENES; k++) {
                fprintf(w->text, " %10.2f", 100 * bands[k].luminance[which]);
                fprintf(w->csv, "%s,%g,%g,once,%s,%.4f,,,%.3f,%.3f,,,,\n", name[p], trade_height_km[k / TRADE_SUNS],
                        trade_sun_zenith_deg[k % TRADE_SUNS], count[which], 100 * bands[k].luminance[which],
                        bands[k].mean[which], bands[k].max[which]);
            }
            fprintf(w->text, "\n");
        }
        if (study_stop(w->how, p == 0 ? 0.95 : 1))
            return TRADE_STUDY_STOPPED;
    }
    return TRADE_STUDY_DONE;
}

static int count_all(const trade_study *how) {
    int expected = 0;
    for (int a = 0; a < how->airs; a++)
        for (int c = 0; c < CONFIGURATIONS; c++)
            expected += is_counted(how, how->air[a].atmosphere, (part)c) ? TRADE_SCENES : 0;
    return study_count_run(how, expected, &counted);
}

int trade_ablation(FILE *text, FILE *csv, const trade_study *how) {
    static work w;
    int status = count_all(how);
    fprintf(text,
            "What each term is worth. Error of a ray: largest error of a band / largest band of the truth, which "
            "counts as at\n"
            "least 5 %% of its scene's mean. Light of all orders, ground lit; sun %g, %g, %g deg from the zenith. Row "
            "by row one\n"
            "thing differs from the first: standard tier, accurate table, no grid.\n",
            trade_sun_zenith_deg[0], trade_sun_zenith_deg[1], trade_sun_zenith_deg[2]);
    fprintf(csv, "air,height_km,sun_zenith_deg,light,term,error_mean_percent,error_p95_percent,error_max_percent,"
                 "delta_e_mean,delta_e_max,instructions_per_vertex,samples_per_ray,worst_view_zenith_deg,"
                 "worst_rel_azimuth_deg\n");
    for (int a = 0; status == TRADE_STUDY_DONE && a < how->airs; a++) {
        w = (work){.how = how, .air = &how->air[a], .text = text, .csv = csv};
        w.done = 0.9 * a / how->airs;
        w.share = 0.9 / how->airs;
        status = study_terms(&w);
        if (status != TRADE_STUDY_DONE)
            break;
        print_errors(&w);
        print_instructions(&w);
        write_terms(&w);
        status = study_splits(&w);
        if (w.has_rules)
            print_splits(&w);
        print_needs(&w);
    }
    if (status == TRADE_STUDY_DONE)
        status = study_colours(&w);
    return status;
}
