/// Sweeps: an input moves in small steps, eight rays are watched. Where the difference between two neighbours is unlike
/// the differences before and behind it, the reference says what it should be. That looks at every step and asks the
/// slow reference for a few only.
#ifndef TESTS_EXTREMES_STEPS_H
#define TESTS_EXTREMES_STEPS_H

#include "naive.h"
#include "table.h"

#define STEP_RAYS 8
#define STEP_KEPT 6
/// Unlike its neighbours by less than this share: not looked at.
#define STEP_SEEN 3e-4

/// Everything that answers depend on.
typedef struct setting {
    air *a;
    int build; ///< the air has changed
    float observer_km, sun[3];
    float view[STEP_RAYS][3], length_km[STEP_RAYS];
    int lengths; ///< rays have lengths
    skv_quality quality;
} setting;

typedef struct sweep {
    const char *name;
    void (*put)(setting *s, double x);
    double from, step;
    int n;
} sweep;

/// Radiance and transmittance of the eight rays.
typedef struct answers {
    float of[STEP_RAYS][8];
} answers;

/// Worst of many sweeps: how far a step is from the reference's own, %.
typedef struct verdict {
    double step, horizon; ///< elsewhere, and across the geometric horizon
    double naive;         ///< of the naive program, where ours was looked at
    int looked, undecided;
    char where[320], where_horizon[320];
} verdict;

static inline void setting_answer(setting *s, answers *out) {
    skv_frame frame;
    if (s->build)
        air_make(s->a, s->a->name, s->a->atmosphere, s->a->ground_km);
    frame_of(&frame, s->a, &s->quality, s->observer_km, s->sun);
    const skv_rays rays = {s->view[0], 0, s->lengths ? s->length_km : NULL, 0};
    const skv_sky sky = {out->of[0], sizeof out->of[0], out->of[0] + 4, sizeof out->of[0]};
    memset(out, 0, sizeof *out);
    must(skv_radiance(&frame, STEP_RAYS, &rays, &sky), s->a->name);
}

typedef struct candidate {
    double unlike;
    int at, ray;
} candidate;

static inline void candidates_take(candidate kept[STEP_KEPT], double unlike, int at, int ray) {
    int least = 0;
    for (int i = 0; i < STEP_KEPT; i++) {
        if (kept[i].ray == ray && kept[i].unlike > 0 && at - kept[i].at < 8) {
            if (unlike > kept[i].unlike)
                kept[i] = (candidate){unlike, at, ray};
            return;
        }
        least = kept[i].unlike < kept[least].unlike ? i : least;
    }
    if (unlike > kept[least].unlike)
        kept[least] = (candidate){unlike, at, ray};
}

/// How unlike the middle one of three differences is, over the largest channel.
static inline double unlike_of(const float a[8], const float b[8], const float c[8], const float d[8], double least) {
    double most = least, radiance = 0, through = 0;
    for (int i = 0; i < 8; i++) {
        const double step = (double)c[i] - (double)b[i];
        const double off = fabs(step - 0.5 * ((double)b[i] - (double)a[i] + (double)d[i] - (double)c[i]));
        if (i < 4)
            radiance = fmax(radiance, off), most = fmax(most, fmax((double)b[i], (double)c[i]));
        else
            through = fmax(through, off);
    }
    return fmax(radiance / most, through);
}

static inline void check_sound(const sweep *w, double x, const answers *now) {
    for (int r = 0; r < STEP_RAYS; r++)
        for (int b = 0; b < 8; b++)
            if (!(now->of[r][b] >= 0 && now->of[r][b] < (b < 4 ? 1e38f : 1.0000001f)))
                fail_msg("%s at %.9g, ray %d: %s %g", w->name, x, r, b < 4 ? "radiance" : "transmittance",
                         (double)now->of[r][b]);
}

/// All steps of a sweep; the most unlike ones are kept.
static inline void sweep_scan(const sweep *w, setting *s, candidate kept[STEP_KEPT], double *least_of) {
    answers last[4];
    double least = 0;
    memset(kept, 0, STEP_KEPT * sizeof *kept);
    memset(last, 0, sizeof last);
    for (int i = 0; i < w->n; i++) {
        answers *now = &last[i & 3];
        w->put(s, w->from + w->step * i);
        setting_answer(s, now);
        check_sound(w, w->from + w->step * i, now);
        if (i % 4096 == 0)
            least = *least_of = least_radiance(s->a, &s->quality, s->observer_km, s->sun);
        for (int r = 0; r < STEP_RAYS && i >= 3; r++)
            candidates_take(
                kept,
                unlike_of(last[(i - 3) & 3].of[r], last[(i - 2) & 3].of[r], last[(i - 1) & 3].of[r], now->of[r], least),
                i - 2, r);
    }
}

typedef struct two_sides {
    double ours[2][8], truth[2][8], naive[2][8];
    int ground[2], bad;
} two_sides;

static inline void sides_of(const sweep *w, setting *s, const candidate *c, two_sides *t) {
    for (int e = 0; e < 2; e++) {
        answers got;
        ref_answer want;
        double v[3], l[3];
        w->put(s, w->from + w->step * (c->at + e));
        setting_answer(s, &got);
        for (int i = 0; i < 3; i++)
            v[i] = (double)s->view[c->ray][i], l[i] = (double)s->sun[i];
        ref_ray ray = ref_ray_from_vectors((double)s->observer_km - (double)s->a->ground_km, v, l);
        if (s->lengths)
            ray.length_km = (double)s->length_km[c->ray];
        t->bad |= ref_single(&s->a->truth.atmosphere, &ray, 0, NULL, &want) != 0 && want.error > 1e-5;
        t->ground[e] = want.meets_ground;
        naive_float(&s->a->atmosphere, s->a->ground_km, s->observer_km, s->view[c->ray], s->sun, t->naive[e]);
        for (int b = 0; b < 4; b++) {
            t->ours[e][b] = (double)got.of[c->ray][b];
            t->ours[e][4 + b] = (double)got.of[c->ray][4 + b];
            t->truth[e][b] = b < s->a->atmosphere.bands ? want.radiance[b] : 0;
            t->truth[e][4 + b] = b < s->a->atmosphere.bands ? want.transmittance[b] : 0;
        }
    }
}

/// A wide step in `parts`: which of them ours likes least.
static inline void candidate_narrow(sweep *w, setting *s, candidate *c, int parts) {
    answers last[4];
    double worst = -1, least = 0;
    sweep fine = *w;
    fine.from = w->from + w->step * (c->at - 1);
    fine.step = w->step / parts;
    fine.n = 3 * parts + 1;
    for (int i = 0; i < fine.n; i++) {
        fine.put(s, fine.from + fine.step * i);
        setting_answer(s, &last[i & 3]);
        least = i == 0 ? least_radiance(s->a, &s->quality, s->observer_km, s->sun) : least;
        if (i < 3)
            continue;
        const double unlike = unlike_of(last[(i - 3) & 3].of[c->ray], last[(i - 2) & 3].of[c->ray],
                                        last[(i - 1) & 3].of[c->ray], last[i & 3].of[c->ray], least);
        if (unlike > worst)
            worst = unlike, c->at = i - 2;
    }
    *w = fine;
}

/// Runs a sweep and keeps the worst. @param unit  how many times .0001 rad, 1 m or .0001 of a parameter a step is.
static inline void sweep_run(const sweep *wide, setting *s, verdict *v, int unit) {
    candidate kept[STEP_KEPT];
    double least = 0;
    sweep_scan(wide, s, kept, &least);
    for (int k = 0; k < STEP_KEPT; k++) {
        two_sides t = {.bad = 0};
        double most, off = 0, naive = 0;
        int band = 0;
        sweep narrow = *wide;
        const sweep *const w = &narrow;
        if (kept[k].unlike < STEP_SEEN)
            continue;
        if (unit > 1)
            candidate_narrow(&narrow, s, &kept[k], unit);
        sides_of(w, s, &kept[k], &t);
        v->looked++;
        v->undecided += t.bad;
        if (t.bad)
            continue;
        most = fmax(least_radiance(s->a, &s->quality, s->observer_km, s->sun),
                    fmax(largest_of(t.truth[0], 4), largest_of(t.truth[1], 4)));
        for (int b = 0; b < 8; b++) {
            const double d = t.truth[1][b] - t.truth[0][b], by = b < 4 ? most : 1;
            const double o = fabs(t.ours[1][b] - t.ours[0][b] - d) / by;
            if (o > off)
                off = o, band = b;
            if (b < 4 && !s->lengths)
                naive = fmax(naive, fabs(t.naive[1][b] - t.naive[0][b] - d) / by);
        }
        const int crossing = t.ground[0] != t.ground[1];
        const double percent = 100 * off;
        v->naive = fmax(v->naive, 100 * naive);
        if (percent <= (crossing ? v->horizon : v->step))
            continue;
        *(crossing ? &v->horizon : &v->step) = percent;
        snprintf(crossing ? v->where_horizon : v->where, sizeof v->where,
                 "%s from %.9g by %.3g, %s band %d: step %+.3f %%, want %+.3f %%; %s, observer %.9g km, sun %.9g %.9g "
                 "%.9g, view %.9g %.9g %.9g",
                 w->name, w->from + w->step * kept[k].at, w->step, band < 4 ? "radiance" : "transmittance", band % 4,
                 100 * (t.ours[1][band] - t.ours[0][band]) / (band < 4 ? most : 1),
                 100 * (t.truth[1][band] - t.truth[0][band]) / (band < 4 ? most : 1), s->a->name,
                 (double)s->observer_km, (double)s->sun[0], (double)s->sun[1], (double)s->sun[2],
                 (double)s->view[kept[k].ray][0], (double)s->view[kept[k].ray][1], (double)s->view[kept[k].ray][2]);
    }
}

#endif
