/// Error and steps over a whole day: `skyvert trade --study day`.
///
/// Zurich airport on the longest day, the sun from 10 deg below the horizon to 66 deg above it, in steps of a minute;
/// twelve fixed directions from the ground and from 12 km. Light scattered once is compared with the converged
/// reference; light of all orders with the finest table and the high tier, which is smooth but no truth, and in the
/// trade's nine scenes with their path traced rays.
///
/// A step is the change between two frames. A way to compute a sky may be wrong by a per cent unseen as long as it is
/// wrong alike in the next frame: what would pop is the change of the error, so that is what `excess` says. Within the
/// minutes of the largest excess the interval is halved towards it down to a thirtieth of a second: what is smooth
/// vanishes there, a jump stays.
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "metric.h"
#include "study_sky.h"

enum { DIRECTIONS = 12, HEIGHTS = 2, MINUTES = 1440, WORST = 5, HALVINGS = 11 };

/// Sun over 5 deg, over -1 deg, below.
enum { DAY, LOW_SUN, TWILIGHT, PHASES };

static const double height_km[HEIGHTS] = {0, 12};
static const skv_position place = {47.46f, 8.55f, 0};
static const double lowest_sun_deg = -10;

/// A way to compute a sky.
typedef struct way {
    const char *name;
    int once; ///< light scattered once
    skv_rule rule;
    int tier;   ///< skv_tier; of Keller's rule the samples both ways
    int table;  ///< skv_table_kind
    int format; ///< skv_table_format
    int grid;
} way;

static const way ways[] = {
    {"once: keller 5x5", 1, SKV_KELLER, 5, 0, 0, 0},
    {"once: fast", 1, SKV_GAUSS_EXP, SKV_TIER_FAST, 0, 0, 0},
    {"once: standard", 1, SKV_GAUSS_EXP, SKV_TIER_STANDARD, 0, 0, 0},
    {"once: high", 1, SKV_GAUSS_EXP, SKV_TIER_HIGH, 0, 0, 0},
    {"all: fast small", 0, SKV_GAUSS_EXP, SKV_TIER_FAST, SKV_TABLE_SMALL, SKV_TABLE_PACKED, 0},
    {"all: fast accurate", 0, SKV_GAUSS_EXP, SKV_TIER_FAST, SKV_TABLE_ACCURATE, SKV_TABLE_PACKED, 0},
    {"all: standard small", 0, SKV_GAUSS_EXP, SKV_TIER_STANDARD, SKV_TABLE_SMALL, SKV_TABLE_PACKED, 0},
    {"all: standard small grid", 0, SKV_GAUSS_EXP, SKV_TIER_STANDARD, SKV_TABLE_SMALL, SKV_TABLE_PACKED, 1},
    {"all: standard accurate", 0, SKV_GAUSS_EXP, SKV_TIER_STANDARD, SKV_TABLE_ACCURATE, SKV_TABLE_PACKED, 0},
    {"all: standard accurate grid", 0, SKV_GAUSS_EXP, SKV_TIER_STANDARD, SKV_TABLE_ACCURATE, SKV_TABLE_PACKED, 1},
    {"all: standard floats", 0, SKV_GAUSS_EXP, SKV_TIER_STANDARD, SKV_TABLE_ACCURATE, SKV_TABLE_FLOAT, 0},
    {"all: high accurate", 0, SKV_GAUSS_EXP, SKV_TIER_HIGH, SKV_TABLE_ACCURATE, SKV_TABLE_PACKED, 0},
};
enum { WAYS = sizeof ways / sizeof *ways };

/// A frame: where the sun is and what comes from the twelve directions.
typedef struct moment {
    int minute; ///< of the day, UTC
    float sun_enu[3];
    double elevation_deg;
    double truth[2][DIRECTIONS][4]; ///< all orders, once
} moment;

/// Figures of a way over the day.
typedef struct figures {
    double mean[PHASES], max;        ///< of the frames' errors: means over each phase of the day, largest
    double step, truth_step, excess; ///< largest of each
    double truth_at;                 ///< the truth's own step where the excess is largest
    double pop;                      ///< excess left within a thirtieth of a second
    int worst, worst_excess, pop_at; ///< index of the moment
} figures;

typedef struct work {
    const trade_study *how;
    const trade_study_air *air;
    FILE *text, *csv;
    ref_file file;
    skv_model *model;
    skv_table *finest;
    float direction[DIRECTIONS][3];
    double height;
    int moments;
    moment moment[MINUTES];
    float got[MINUTES][DIRECTIONS][4];
    double excess[MINUTES];
    figures figures[WAYS];
    double path[WAYS][2]; ///< mean and largest error against the path traced rays
    double done, share;
} work;

// --- skies ---

static int make_way(work *w, const way *a, study_sky *sky) {
    *sky = (study_sky){.model = w->model, .grid = a->grid};
    if (a->rule == SKV_KELLER)
        sky->quality = (skv_quality){SKV_KELLER, SKV_DEPTH_BY_INNER, a->tier, a->tier, 0};
    else
        (void)skv_quality_tier(&sky->quality, (skv_tier)a->tier);
    sky->quality.terms = SKV_WITH_ALL;
    if (a->once)
        return TRADE_STUDY_DONE;
    skv_table_spec spec;
    (void)skv_table_spec_for(&spec, w->model, (skv_table_kind)a->table);
    spec.format = a->format;
    sky->table = study_table(w->model, &spec);
    return sky->table == NULL ? TRADE_STUDY_FAILED : TRADE_STUDY_DONE;
}

static void free_way(study_sky *sky) {
    free((void *)(uintptr_t)sky->table);
}

static int look(const work *w, const study_sky *sky, const float sun[3], float got[DIRECTIONS][4]) {
    return study_radiance(sky, w->height, sun, DIRECTIONS, (const float(*)[3])w->direction, got);
}

static int truth_all(const work *w, const float sun[3], double truth[DIRECTIONS][4]) {
    float got[DIRECTIONS][4];
    study_sky sky = {.model = w->model, .table = w->finest};
    (void)skv_quality_tier(&sky.quality, SKV_TIER_HIGH);
    sky.quality.terms = SKV_WITH_ALL;
    const int status = look(w, &sky, sun, got);
    for (int i = 0; i < DIRECTIONS; i++)
        for (int b = 0; b < 4; b++)
            truth[i][b] = (double)got[i][b];
    return status;
}

static void truth_once(const work *w, const float sun[3], double truth[DIRECTIONS][4]) {
    const double s[3] = {(double)sun[0], (double)sun[1], (double)sun[2]};
    const ref_options enough = {1e-7, 16};
    for (int i = 0; i < DIRECTIONS; i++) {
        const double v[3] = {(double)w->direction[i][0], (double)w->direction[i][1], (double)w->direction[i][2]};
        const ref_ray ray = ref_ray_from_vectors(w->height, v, s);
        ref_answer answer;
        (void)ref_single(&w->file.atmosphere, &ray, 1, &enough, &answer);
        memcpy(truth[i], answer.radiance, sizeof answer.radiance);
    }
}

static int truth_of(const work *w, int once, const float sun[3], double truth[DIRECTIONS][4]) {
    if (!once)
        return truth_all(w, sun, truth);
    truth_once(w, sun, truth);
    return TRADE_STUDY_DONE;
}

/// North, east, south and west, each low, middling and high; from 12 km the low ones lie between the two horizons.
static void lay_directions(work *w) {
    static const double elevation[HEIGHTS][3] = {{1.5, 12, 45}, {-1.5, 8, 45}};
    for (int i = 0; i < DIRECTIONS; i++)
        trade_direction(w->direction[i], 90 - elevation[w->height > 0][i / 4], 90 * (i % 4) + 7);
}

// --- the day ---

static int lay_moments(work *w, int step, double done) {
    skv_utc utc;
    int status = TRADE_STUDY_DONE;
    w->moments = 0;
    if (skv_utc_from_calendar(&utc, 2026, 6, 21, 0, 0, 0) != SKV_OK)
        return TRADE_STUDY_FAILED;
    for (int minute = 0; status == TRADE_STUDY_DONE && minute < MINUTES; minute += step) {
        skv_sun sun;
        skv_position at = place;
        at.height_km = (float)w->height;
        utc.seconds = 60 * (float)minute;
        if (skv_sun_at(&sun, &utc, &at) != SKV_OK || (double)sun.elevation_deg < lowest_sun_deg)
            continue;
        moment *const m = &w->moment[w->moments++];
        m->minute = minute;
        m->elevation_deg = (double)sun.elevation_deg;
        memcpy(m->sun_enu, sun.direction_enu, sizeof m->sun_enu);
        status = truth_all(w, m->sun_enu, m->truth[0]);
        truth_once(w, m->sun_enu, m->truth[1]);
        if (status == TRADE_STUDY_DONE && study_stop(w->how, done + 0.5 * w->share * minute / MINUTES))
            status = TRADE_STUDY_STOPPED;
    }
    return status;
}

static double floor_of(int bands, double (*truth)[4]) {
    double sum = 0;
    for (int i = 0; i < DIRECTIONS; i++) {
        double most = 0;
        for (int b = 0; b < bands; b++)
            most = fmax(most, truth[i][b]);
        sum += most / DIRECTIONS;
    }
    return 0.05 * sum;
}

/// Largest changes from one frame to the next, over the largest band of the truth (of at least the floor).
typedef struct step {
    double own, truth, excess, truth_there;
} step;

static step step_of(int bands, double (*t0)[4], float (*g0)[4], double (*t1)[4], float (*g1)[4]) {
    step s = {0, 0, 0, 0};
    const double least = fmax(floor_of(bands, t0), floor_of(bands, t1));
    for (int i = 0; i < DIRECTIONS; i++) {
        double over = least;
        for (int b = 0; b < bands; b++)
            over = fmax(over, fmax(t0[i][b], t1[i][b]));
        for (int b = 0; b < bands; b++) {
            const double truth = t1[i][b] - t0[i][b], own = (double)g1[i][b] - (double)g0[i][b],
                         excess = fabs(own - truth) / over;
            s.own = fmax(s.own, fabs(own) / over);
            s.truth = fmax(s.truth, fabs(truth) / over);
            if (excess > s.excess)
                s.excess = excess, s.truth_there = fabs(truth) / over;
        }
    }
    return s;
}

/// The sun between two moments of one minute.
static void sun_between(const moment *a, const moment *b, double f, float sun[3]) {
    for (int c = 0; c < 3; c++)
        sun[c] = (float)((1 - f) * (double)a->sun_enu[c] + f * (double)b->sun_enu[c]);
}

/// Halves the step from moment k on towards its largest excess: what is smooth halves with it, a jump stays.
/// @param[out] left  the excess of what remains
static int chase(const work *w, const study_sky *sky, int once, int k, double *left) {
    const moment *const a = &w->moment[k], *const b = &w->moment[k + 1];
    const int bands = w->air->atmosphere->bands;
    double from = 0, to = 1, truth[3][DIRECTIONS][4];
    float got[3][DIRECTIONS][4], sun[3];
    memcpy(truth[0], a->truth[once], sizeof truth[0]);
    memcpy(truth[2], b->truth[once], sizeof truth[2]);
    memcpy(got[0], w->got[k], sizeof got[0]);
    memcpy(got[2], w->got[k + 1], sizeof got[2]);
    for (int i = 0; i < HALVINGS; i++) {
        sun_between(a, b, 0.5 * (from + to), sun);
        if (look(w, sky, sun, got[1]) != TRADE_STUDY_DONE || truth_of(w, once, sun, truth[1]) != TRADE_STUDY_DONE)
            return TRADE_STUDY_FAILED;
        const step first = step_of(bands, truth[0], got[0], truth[1], got[1]),
                   second = step_of(bands, truth[1], got[1], truth[2], got[2]);
        const int drop = first.excess >= second.excess ? 2 : 0;
        *(drop ? &to : &from) = 0.5 * (from + to);
        memcpy(truth[drop], truth[1], sizeof truth[1]);
        memcpy(got[drop], got[1], sizeof got[1]);
        *left = fmax(first.excess, second.excess);
    }
    return TRADE_STUDY_DONE;
}

/// How far a minute's excess stands out of its neighbours'.
static double spike_at(const work *w, int k) {
    const double before = k > 0 ? w->excess[k - 1] : 0, after = k + 2 < w->moments ? w->excess[k + 1] : 0;
    return w->excess[k] - fmax(before, after);
}

/// Chases the excess in the minutes where it is largest, and in those where it stands out most.
static int find_pop(const work *w, const study_sky *sky, int once, figures *f) {
    static char seen[MINUTES];
    memset(seen, 0, sizeof seen);
    f->pop = 0;
    f->pop_at = 0;
    const int minutes = w->how->quick ? 1 : WORST;
    for (int i = 0; i < 2 * minutes; i++) {
        int worst = -1;
        double most = 0, left = 0;
        for (int k = 0; k + 1 < w->moments; k++) {
            const double x = i < minutes ? w->excess[k] : spike_at(w, k);
            if (!seen[k] && x > most)
                worst = k, most = x;
        }
        if (worst < 0)
            continue;
        seen[worst] = 1;
        if (chase(w, sky, once, worst, &left) != TRADE_STUDY_DONE)
            return TRADE_STUDY_FAILED;
        if (left > f->pop)
            f->pop = left, f->pop_at = worst;
    }
    return TRADE_STUDY_DONE;
}

static int phase_of(double elevation_deg) {
    return elevation_deg > 5 ? DAY : elevation_deg > -1 ? LOW_SUN : TWILIGHT;
}

static int count_phase(const work *w, int phase) {
    int n = 0;
    for (int k = 0; k < w->moments; k++)
        n += phase_of(w->moment[k].elevation_deg) == phase;
    return n;
}

static void utc_text(int minute, char text[16]) {
    snprintf(text, 16, "%02d:%02d", minute / 60, minute % 60);
}

static void write_minute(work *w, const way *a, int k, const trade_error *e, const step *s) {
    char utc[16];
    utc_text(w->moment[k].minute, utc);
    fprintf(w->csv, "minute,%s,%g,%s,%s,%s,%.3f,%.4g,%.4g,%.4g,%.4g,%.4g,\n", w->air->name, w->height,
            a->once ? "once" : "all", strchr(a->name, ' ') + 1, utc, w->moment[k].elevation_deg, 100 * e->mean,
            100 * e->max, 100 * s->own, 100 * s->truth, 100 * s->excess);
}

/// Errors and steps of one way, moment by moment. @return DONE or FAILED
static int run_way(work *w, const way *a, const study_sky *sky, figures *f) {
    static double scratch[DIRECTIONS];
    const int bands = w->air->atmosphere->bands;
    *f = (figures){.max = -1};
    for (int k = 0; k < w->moments; k++) {
        trade_error e;
        step s = {0, 0, 0, 0};
        if (look(w, sky, w->moment[k].sun_enu, w->got[k]) != TRADE_STUDY_DONE)
            return TRADE_STUDY_FAILED;
        trade_measure(DIRECTIONS, bands, (const float(*)[4])w->got[k], (const double(*)[4])w->moment[k].truth[a->once],
                      scratch, &e);
        if (k > 0) {
            s = step_of(bands, w->moment[k - 1].truth[a->once], w->got[k - 1], w->moment[k].truth[a->once], w->got[k]);
            w->excess[k - 1] = s.excess;
        }
        write_minute(w, a, k, &e, &s);
        f->mean[phase_of(w->moment[k].elevation_deg)] += e.mean;
        if (e.max > f->max)
            f->max = e.max, f->worst = k;
        if (s.excess > f->excess)
            f->excess = s.excess, f->truth_at = s.truth_there, f->worst_excess = k;
        f->step = fmax(f->step, s.own);
        f->truth_step = fmax(f->truth_step, s.truth);
    }
    for (int phase = 0; phase < PHASES; phase++)
        f->mean[phase] /= fmax(count_phase(w, phase), 1);
    return find_pop(w, sky, a->once, f);
}

/// Against the path traced rays of the nine scenes (of light scattered once: against the reference's there).
static int run_scenes(work *w, int which, const study_sky *sky) {
    static float got[TRADE_RAYS][4];
    static double scratch[TRADE_RAYS];
    const int light = ways[which].once ? TRADE_SINGLE : TRADE_FULL;
    w->path[which][0] = w->path[which][1] = 0;
    for (int k = 0; w->air->scene != NULL && k < TRADE_SCENES; k++) {
        const trade_scene *const s = &w->air->scene[k];
        trade_error e;
        if (study_radiance(sky, s->height_km, s->sun_enu, (size_t)s->n, s->direction, got) != TRADE_STUDY_DONE)
            return TRADE_STUDY_FAILED;
        trade_measure((size_t)s->n, w->air->atmosphere->bands, (const float(*)[4])got, s->radiance[light], scratch, &e);
        w->path[which][0] += e.mean / TRADE_SCENES;
        w->path[which][1] = fmax(w->path[which][1], e.max);
    }
    return TRADE_STUDY_DONE;
}

// --- output ---

static void print_day(const work *w) {
    fprintf(w->text, "\n%s, %s: %d frames; in %%\n%-29s %5s %5s %5s %5s %-5s %6s %5s | %5s %5s %6s %5s %-5s %7s %s\n",
            w->air->name, w->height > 0 ? "12 km" : "ground", w->moments, "error, then steps", "day", "low", "twil.",
            "most", "UTC", "scenes", "most", "step", "truth", "excess", "there", "UTC", "1/30 s", "UTC");
    for (int i = 0; i < WAYS; i++) {
        const figures *const f = &w->figures[i];
        char worst[16], excess[16], pop[16];
        utc_text(w->moment[f->worst].minute, worst);
        utc_text(w->moment[f->worst_excess].minute, excess);
        utc_text(w->moment[f->pop_at].minute, pop);
        fprintf(w->text, "%-29s %5.2f %5.2f %5.1f %5.1f %-5s", ways[i].name, 100 * f->mean[DAY], 100 * f->mean[LOW_SUN],
                100 * f->mean[TWILIGHT], 100 * f->max, worst);
        if (w->air->scene != NULL)
            fprintf(w->text, " %6.2f %5.1f", 100 * w->path[i][0], 100 * w->path[i][1]);
        else
            fprintf(w->text, " %6s %5s", "-", "-");
        fprintf(w->text, " | %5.1f %5.1f %6.2f %5.1f %-5s %7.4f %s\n", 100 * f->step, 100 * f->truth_step,
                100 * f->excess, 100 * f->truth_at, excess, 100 * f->pop, pop);
    }
}

static void write_day(const work *w, int i) {
    const figures *const f = &w->figures[i];
    const int n[PHASES] = {count_phase(w, DAY), count_phase(w, LOW_SUN), count_phase(w, TWILIGHT)};
    const double mean = (n[0] * f->mean[0] + n[1] * f->mean[1] + n[2] * f->mean[2]) / w->moments;
    char utc[16];
    utc_text(w->moment[f->worst].minute, utc);
    fprintf(w->csv, "day,%s,%g,%s,%s,%s,%.3f,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g\n", w->air->name, w->height,
            ways[i].once ? "once" : "all", strchr(ways[i].name, ' ') + 1, utc, w->moment[f->worst].elevation_deg,
            100 * mean, 100 * f->max, 100 * f->step, 100 * f->truth_step, 100 * f->excess, 100 * f->pop);
}

// --- the study ---

static int study_height(work *w, double done) {
    lay_directions(w);
    int status = lay_moments(w, w->how->quick ? 15 : 1, done);
    for (int i = 0; status == TRADE_STUDY_DONE && i < WAYS; i++) {
        study_sky sky;
        status = make_way(w, &ways[i], &sky);
        if (status == TRADE_STUDY_DONE)
            status = run_way(w, &ways[i], &sky, &w->figures[i]);
        if (status == TRADE_STUDY_DONE)
            status = run_scenes(w, i, &sky);
        free_way(&sky);
        if (status == TRADE_STUDY_DONE)
            write_day(w, i);
        if (status == TRADE_STUDY_DONE && study_stop(w->how, done + w->share * (0.5 + 0.5 * (i + 1) / WAYS)))
            status = TRADE_STUDY_STOPPED;
    }
    if (status == TRADE_STUDY_DONE)
        print_day(w);
    return status;
}

static int study_air(work *w, double done) {
    skv_table_spec spec;
    int status = TRADE_STUDY_FAILED;
    ref_from_skyvert(w->air->atmosphere, 0, &w->file);
    w->model = study_model(w->air->atmosphere);
    w->finest = NULL;
    if (w->model != NULL) {
        study_finest(&spec, w->model);
        w->finest = study_table(w->model, &spec);
    }
    if (w->finest != NULL)
        status = TRADE_STUDY_DONE;
    for (int h = 0; status == TRADE_STUDY_DONE && h < HEIGHTS; h++) {
        w->height = height_km[h];
        status = study_height(w, done + w->share * h);
    }
    free(w->finest);
    free(w->model);
    return status;
}

int trade_day(FILE *text, FILE *csv, const trade_study *how) {
    static work w;
    int status = TRADE_STUDY_DONE;
    fprintf(text,
            "A day, 2026-06-21 at 47.46 N 8.55 E, minute by minute while the sun is over %g deg; 12 fixed directions.\n"
            "Error: mean of the frames by day (sun over 5 deg), with a low sun (over -1 deg), in twilight; largest of "
            "a ray.\n"
            "once: light scattered once against the reference. all: against the finest table (smooth, but no truth). "
            "scenes: the\n"
            "trade's nine scenes against the reference's or path traced rays, mean and largest.\n"
            "step: largest change of a ray from one minute to the next. truth: the truth's own. excess: largest change "
            "of the\n"
            "error, and the truth's step there. 1/30 s: what is left of the excess between frames a thirtieth of a "
            "second apart,\n"
            "in the %d minutes where it is largest and the %d where it stands out most: a pop, if that is seen (about "
            ".5 %%).\n",
            lowest_sun_deg, WORST, WORST);
    fprintf(csv, "what,air,height_km,light,way,utc,sun_elevation_deg,error_mean_percent,error_max_percent,step_percent,"
                 "truth_step_percent,excess_percent,pop_percent\n");
    for (int a = 0; status == TRADE_STUDY_DONE && a < how->airs; a++) {
        w.how = how;
        w.air = &how->air[a];
        w.text = text;
        w.csv = csv;
        w.share = 1.0 / (HEIGHTS * how->airs);
        status = study_air(&w, (double)a / how->airs);
    }
    return status;
}
