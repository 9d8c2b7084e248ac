#include "tools/plan/search.h"

#include <stdlib.h>

#include "tools/skyvert/command.h"

const char *const plan_term_names[PLAN_TERMS] = {
    "light scattered again", "accurate table", "aerosol", "dust", "ozone", "lit ground", "fourth band", "last sample"};

/// Frames and directions that errors are looked at.
/// Two samples a leg are far off in few directions, near the horizon: no share of directions can be promised.
enum { FRAMES = 40, VIEWS = 24, SAMPLES_LEAST = 3, SAMPLES_MOST = 10, CANDIDATES_MOST = 4096 };

typedef struct search {
    const plan_scene *scene;
    const plan_ask *ask;
    plan_samples samples;
    plan_shop *shop;
    plan_counter *counter;
    plan_judge judge;
    float (*rgb)[TRADE_BANDS], (*other)[TRADE_BANDS];
    plan_candidate *list;
    size_t count;
} search;

static unsigned bit_of(plan_term term) {
    return term == PLAN_TERM_AEROSOL ? SKV_WITH_AEROSOL : term == PLAN_TERM_DUST ? SKV_WITH_DUST : SKV_WITH_OZONE;
}

bool plan_toggle(const plan_scene *scene, const plan_config *from, plan_term term, plan_config *to, bool *dropped) {
    *to = *from;
    switch (term) {
    case PLAN_TERM_DIFFUSE:
        *dropped = from->light == PLAN_SINGLE;
        to->light = *dropped ? PLAN_SMALL : PLAN_SINGLE;
        to->grid = false;
        return true;
    case PLAN_TERM_FINE_TABLE:
        *dropped = from->light == PLAN_SMALL;
        to->light = from->light == PLAN_ACCURATE ? PLAN_SMALL : PLAN_ACCURATE;
        return from->light != PLAN_SINGLE;
    case PLAN_TERM_AEROSOL:
    case PLAN_TERM_DUST:
    case PLAN_TERM_OZONE:
        *dropped = (from->species & bit_of(term)) == 0;
        to->species ^= bit_of(term);
        return (plan_species(scene) & bit_of(term)) != 0 && to->species != 0;
    case PLAN_TERM_GROUND:
        *dropped = !from->ground;
        to->ground = *dropped;
        return scene->terrain;
    case PLAN_TERM_FOURTH_BAND:
        *dropped = from->bands == 3;
        to->bands = *dropped ? 4 : 3;
        return scene->preset >= 0;
    default:
        *dropped = false;
        to->samples--;
        return from->samples > 2;
    }
}

// --- candidates ---

static skv_status rate(search *s, plan_candidate *c) {
    const skv_status status = plan_colours(s->shop, &c->config, &s->samples, s->rgb);
    if (status == SKV_OK)
        c->promised = plan_judge_error(&s->judge, (const float(*)[TRADE_BANDS])s->rgb, &c->error);
    return status;
}

static skv_status price(search *s, plan_candidate *c) {
    const skv_status status = plan_cost_of(s->counter, &c->config, &c->cost);
    c->us = c->cost.mean / s->ask->per_us;
    return status;
}

/// Which terms can be left out by themselves: what breaks the bound alone is not tried with others.
static skv_status find_droppable(search *s, plan_light_kind light, bool droppable[PLAN_TERMS]) {
    plan_config best = plan_best(s->scene);
    best.light = light;
    best.samples = 8;
    for (plan_term t = 0; t < PLAN_TERM_SAMPLE; t++) {
        plan_candidate c = {0};
        bool dropped;
        droppable[t] = false;
        if (!plan_toggle(s->scene, &best, t, &c.config, &dropped))
            continue;
        const skv_status status = rate(s, &c);
        if (status != SKV_OK && status != SKV_ERR_UNSUPPORTED)
            return status;
        droppable[t] = status == SKV_OK && c.promised <= s->ask->max_error;
        progress_update((size_t)t + 1);
    }
    return SKV_OK;
}

/// The grid stands for what an observer below half the air sees.
static bool grid_holds(const plan_scene *scene) {
    skv_atmosphere air;
    plan_air(scene, 0, 4, &air);
    return 0.001 * (scene->height_m.high - scene->ground_m) <= 0.5 * ((double)air.top_km - 0.001 * scene->ground_m);
}

static int by_cost(const void *a, const void *b) {
    const plan_candidate *const x = a, *const y = b;
    if (x->cost.mean != y->cost.mean)
        return x->cost.mean < y->cost.mean ? -1 : 1;
    return y->config.samples - x->config.samples; // as dear: the one that has more
}

static skv_status add(search *s, const plan_config *config) {
    plan_candidate *const c = &s->list[s->count];
    if (!plan_cost_known(s->ask->target, config) || s->count >= CANDIDATES_MOST)
        return SKV_OK;
    *c = (plan_candidate){.config = *config};
    const skv_status status = price(s, c);
    if (status == SKV_OK)
        s->count++;
    return status == SKV_ERR_UNSUPPORTED ? SKV_OK : status;
}

/// All samples, with a grid and without.
static skv_status add_family(search *s, plan_config config) {
    for (int grid = 0; grid < (config.light != PLAN_SINGLE && grid_holds(s->scene) ? 2 : 1); grid++)
        for (int n = SAMPLES_LEAST; n <= SAMPLES_MOST; n++) {
            config.grid = grid;
            config.samples = n;
            const skv_status status = add(s, &config);
            if (status != SKV_OK)
                return status;
        }
    return SKV_OK;
}

/// Every choice of what can be left out.
static skv_status add_all(search *s, plan_light_kind light, const bool droppable[PLAN_TERMS]) {
    s->count = 0;
    for (unsigned drop = 0; drop < 1u << PLAN_TERM_SAMPLE; drop++) {
        plan_config c = plan_best(s->scene);
        c.light = light;
        bool possible = true, dropped;
        for (plan_term t = 0; t < PLAN_TERM_SAMPLE && possible; t++)
            if ((drop >> t & 1u) != 0) {
                const plan_config from = c;
                possible = droppable[t] && plan_toggle(s->scene, &from, t, &c, &dropped) && !dropped;
            }
        const skv_status status = possible ? add_family(s, c) : SKV_OK;
        if (status != SKV_OK)
            return status;
    }
    qsort(s->list, s->count, sizeof *s->list, by_cost);
    return SKV_OK;
}

// --- the answer ---

static skv_status explain(search *s, plan_answer *a) {
    skv_status status = plan_colours(s->shop, &a->chosen.config, &s->samples, s->other);
    for (plan_term t = 0; t < PLAN_TERMS && status == SKV_OK; t++) {
        plan_change *const c = &a->change[a->changes];
        *c = (plan_change){.term = t};
        if (!plan_toggle(s->scene, &a->chosen.config, t, &c->other.config, &c->dropped))
            continue;
        status = rate(s, &c->other);
        if (status != SKV_OK)
            break;
        plan_judge_between(&s->judge, (const float(*)[TRADE_BANDS])s->other, (const float(*)[TRADE_BANDS])s->rgb,
                           &c->change);
        const skv_status priced = price(s, &c->other);
        status = priced == SKV_ERR_UNSUPPORTED ? SKV_OK : priced;
        a->changes++;
    }
    return status;
}

static skv_status choose(search *s, plan_answer *a) {
    progress_begin("plan: trying", s->count);
    a->verdict = PLAN_ERROR_TOO_LARGE;
    a->chosen = (plan_candidate){.promised = 1e30};
    for (size_t i = 0; i < s->count && a->verdict == PLAN_ERROR_TOO_LARGE; i++) {
        plan_candidate *const c = &s->list[i];
        const skv_status status = rate(s, c);
        if (status != SKV_OK)
            return status;
        if (c->promised < a->chosen.promised)
            a->chosen = *c;
        if (c->promised <= s->ask->max_error)
            a->verdict = PLAN_FITS, a->chosen = *c;
        progress_update(i + 1);
    }
    progress_end();
    if (a->verdict == PLAN_FITS && s->ask->budget_us > 0 && a->chosen.us > s->ask->budget_us)
        a->verdict = PLAN_OVER_BUDGET;
    return s->count > 0 ? SKV_OK : SKV_ERR_UNSUPPORTED;
}

/// What fits with tables up to a kind.
static skv_status search_up_to(search *s, plan_light_kind light, plan_answer *answer) {
    bool droppable[PLAN_TERMS];
    progress_begin("plan: tables", PLAN_TERM_SAMPLE);
    skv_status status = find_droppable(s, light, droppable);
    progress_end();
    if (status == SKV_OK)
        status = add_all(s, light, droppable);
    return status == SKV_OK ? choose(s, answer) : status;
}

/// The large table only where the others do not do: it costs as much a vertex, but bytes and time to build.
static skv_status run(search *s, plan_answer *answer) {
    skv_status status = plan_judge_make(&s->judge, s->shop, &s->samples);
    if (status == SKV_OK)
        status = search_up_to(s, PLAN_ACCURATE, answer);
    if (status == SKV_OK && answer->verdict == PLAN_ERROR_TOO_LARGE)
        status = search_up_to(s, PLAN_LARGE, answer);
    if (status == SKV_OK && answer->verdict != PLAN_ERROR_TOO_LARGE)
        status = explain(s, answer);
    answer->distance = s->judge.distance;
    return status;
}

skv_status plan_search(const plan_scene *scene, const plan_ask *ask, plan_answer *answer) {
    search s = {.scene = scene, .ask = ask};
    skv_status status = SKV_ERR_SIZE;
    *answer = (plan_answer){0};
    s.shop = plan_shop_open(scene);
    s.counter = plan_counter_open(s.shop, scene, ask->target, ask->vertices);
    s.list = malloc(CANDIDATES_MOST * sizeof *s.list);
    if (plan_samples_make(&s.samples, scene, 2, FRAMES, VIEWS)) {
        s.rgb = malloc(s.samples.rays * sizeof *s.rgb);
        s.other = malloc(s.samples.rays * sizeof *s.other);
        if (s.shop && s.counter && s.list && s.rgb && s.other)
            status = run(&s, answer);
    }
    progress_end();
    plan_judge_free(&s.judge);
    plan_samples_free(&s.samples);
    plan_counter_close(s.counter);
    plan_shop_close(s.shop);
    free(s.list);
    free(s.rgb);
    free(s.other);
    return status;
}
