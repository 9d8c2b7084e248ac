#include "tools/plan/error.h"

#include <math.h>
#include <stdlib.h>

/// Best less truth of a ray, RGB, in 1/20000 of the largest channel.
typedef struct plan_floor_ray {
    plan_kind_of_ray kind;
    short off[3];
} plan_floor_ray;

#include "tools/plan/floor_data.h"

enum { FLOOR_RAYS = sizeof plan_floor_rays / sizeof plan_floor_rays[0], SIMILAR = 3 };

static double distance2(const plan_kind_of_ray *a, const plan_kind_of_ray *b) {
    const float d[6] = {a->particles - b->particles, a->gas - b->gas,   a->sun - b->sun,
                        a->height - b->height,       a->view - b->view, a->azimuth - b->azimuth};
    double sum = 0;
    for (int i = 0; i < 6; i++)
        sum += (double)d[i] * (double)d[i];
    return sum;
}

/// The SIMILAR nearest, the nearest first.
static double find_similar(const plan_kind_of_ray *kind, int found[SIMILAR]) {
    double far[SIMILAR];
    for (int k = 0; k < SIMILAR; k++)
        far[k] = INFINITY, found[k] = 0;
    for (int i = 0; i < (int)FLOOR_RAYS; i++) {
        const double d = distance2(kind, &plan_floor_rays[i].kind);
        int k = SIMILAR;
        for (; k > 0 && d < far[k - 1]; k--)
            if (k < SIMILAR)
                far[k] = far[k - 1], found[k] = found[k - 1];
        if (k < SIMILAR)
            far[k] = d, found[k] = i;
    }
    return sqrt(far[0]);
}

plan_config plan_best(const plan_scene *scene) {
    const int bands = scene->preset < 0 ? scene->file.atmosphere.bands : 4;
    return (plan_config){bands, plan_species(scene), scene->terrain, PLAN_LARGE, false, 16};
}

static double largest(const float rgb[TRADE_BANDS]) {
    return (double)fmaxf(fmaxf(rgb[0], rgb[1]), rgb[2]);
}

/// The rays of the floor end on lit ground: what is off there is off of that light.
static skv_status know_floor(plan_judge *j, plan_shop *shop) {
    const plan_samples *const s = j->samples;
    const int per = s->views + s->terrains;
    plan_config best = plan_best(s->scene);
    best.ground = true;
    j->distance = 0;
    const skv_status lit = plan_colours(shop, &best, s, j->got);
    if (lit != SKV_OK)
        return lit;
    for (size_t i = 0; i < s->rays; i++) {
        int found[SIMILAR];
        skv_status status;
        const plan_frame *const frame = &s->frame[i / (size_t)per];
        const plan_built *const built = plan_build(shop, frame->air, &best, &status);
        if (!built)
            return status;
        const plan_kind_of_ray kind = plan_ray_kind(&built->air, frame, &s->ray[i]);
        j->distance += find_similar(&kind, found) / (double)s->rays;
        for (int c = 0; c < 3; c++)
            j->off[i][c] = plan_floor_rays[found[i % SIMILAR]].off[c] / 20000.0 * largest(j->got[i]);
    }
    return SKV_OK;
}

static void know_means(plan_judge *j) {
    const plan_samples *const s = j->samples;
    const int per = s->views + s->terrains;
    for (int i = 0; i < s->frames; i++) {
        j->mean[i] = 0;
        for (int k = 0; k < s->views; k++)
            j->mean[i] += largest(j->best[i * per + k]) / s->views;
        j->mean[i] = fmax(j->mean[i], 1e-30);
    }
}

skv_status plan_judge_make(plan_judge *j, plan_shop *shop, const plan_samples *samples) {
    const size_t n = samples->rays;
    *j = (plan_judge){.samples = samples};
    j->best = malloc(n * sizeof *j->best);
    j->off = malloc(n * sizeof *j->off);
    j->mean = malloc((size_t)samples->frames * sizeof *j->mean);
    j->got = malloc(n * sizeof *j->got);
    j->truth = malloc(n * sizeof *j->truth);
    j->scratch = malloc(n * sizeof *j->scratch);
    const plan_config best = plan_best(samples->scene);
    skv_status status = SKV_ERR_SIZE;
    if (j->best && j->off && j->mean && j->got && j->truth && j->scratch)
        status = plan_colours(shop, &best, samples, j->best);
    if (status == SKV_OK)
        status = know_floor(j, shop);
    if (status == SKV_OK)
        know_means(j);
    else
        plan_judge_free(j);
    return status;
}

void plan_judge_free(plan_judge *j) {
    free(j->best);
    free(j->off);
    free(j->mean);
    free(j->got);
    free(j->truth);
    free(j->scratch);
    *j = (plan_judge){0};
}

double plan_judge_error(const plan_judge *j, const float (*rgb)[TRADE_BANDS], trade_error *error) {
    const plan_samples *const s = j->samples;
    const size_t per = (size_t)(s->views + s->terrains);
    for (size_t i = 0; i < s->rays; i++) {
        const double scale = 1 / j->mean[i / per];
        for (int c = 0; c < 3; c++) {
            j->truth[i][c] = ((double)j->best[i][c] - j->off[i][c]) * scale;
            j->got[i][c] = (float)((double)rgb[i][c] * scale);
        }
    }
    trade_measure(s->rays, 3, (const float(*)[TRADE_BANDS])j->got, (const double(*)[TRADE_BANDS])j->truth, j->scratch,
                  error);
    // trade_measure() leaves them sorted.
    return fmax(PLAN_MARGIN * error->p95, j->scratch[(size_t)(PLAN_BEYOND * (double)s->rays)]);
}

void plan_judge_between(const plan_judge *j, const float (*from)[TRADE_BANDS], const float (*to)[TRADE_BANDS],
                        trade_error *error) {
    const plan_samples *const s = j->samples;
    const size_t per = (size_t)(s->views + s->terrains);
    for (size_t i = 0; i < s->rays; i++)
        for (int c = 0; c < 3; c++) {
            j->truth[i][c] = (double)from[i][c] / j->mean[i / per];
            j->got[i][c] = (float)((double)to[i][c] / j->mean[i / per]);
        }
    trade_measure(s->rays, 3, (const float(*)[TRADE_BANDS])j->got, (const double(*)[TRADE_BANDS])j->truth, j->scratch,
                  error);
}
