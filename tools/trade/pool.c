/// Sums over scenes, and the frontier.
#include <math.h>

#include "trade.h"

double trade_cost_ns(const trade_row *row, int scene) {
    const trade_cost *const c = &row->cost[scene];
    return c->ns < 0 ? -1 : c->ns + c->frame_ns / TRADE_DOME_VERTICES;
}

double trade_cost_instructions(const trade_row *row, int scene) {
    const trade_cost *const c = &row->cost[scene];
    return c->instructions < 0 ? -1 : c->instructions + fmax(c->frame_instructions, 0) / TRADE_DOME_VERTICES;
}

static void add(trade_pooled *p, const trade_row *row, int k) {
    const trade_cost *const c = &row->cost[k];
    const double frame = c->frame_ns / TRADE_DOME_VERTICES;
    p->mean += row->error[k].mean;
    p->p95 += row->error[k].p95;
    p->ns = c->ns < 0 || p->ns < 0 ? -1 : p->ns + c->ns + frame;
    p->ns_low += c->ns_low + frame;
    p->ns_high += c->ns_high + frame;
    p->instructions =
        c->instructions < 0 || p->instructions < 0 ? -1 : p->instructions + trade_cost_instructions(row, k);
    if (row->error[k].max > p->max || p->scenes == 0) {
        p->max = row->error[k].max;
        p->worst = row;
        p->worst_scene = k;
    }
    p->scenes++;
}

trade_pooled trade_pool(const trade *t, size_t config, int sun, int height, int air) {
    trade_pooled p = {0};
    for (size_t a = 0; a < t->n_truths; a++) {
        const trade_row *const row = &t->rows.at[a * t->n_configs + config];
        for (int k = 0; k < TRADE_SCENES && (air < 0 || air == (int)a); k++)
            if ((sun < 0 || k % TRADE_SUNS == sun) && (height < 0 || k / TRADE_SUNS == height) && row->rays[k] > 0)
                add(&p, row, k);
    }
    const double n = p.scenes > 0 ? p.scenes : 1;
    p.mean /= n;
    p.p95 /= n;
    p.ns = p.ns < 0 ? -1 : p.ns / n;
    p.ns_low /= n;
    p.ns_high /= n;
    p.instructions = p.instructions < 0 ? -1 : p.instructions / n;
    return p;
}

double trade_pooled_cost(const trade *t, const trade_pooled *p) {
    return t->counted ? p->instructions : p->ns;
}

/// Whether a configuration did all that is asked for in a panel: what it could not do must not make it look good. Rows
/// that show slips of the press are no candidates.
static int does_all(const trade *t, size_t config, int light, const trade_pooled *p, int sun, int height) {
    const int want = (int)t->n_truths * (sun < 0 ? TRADE_SUNS : 1) * (height < 0 ? TRADE_HEIGHTS : 1);
    const baseline *const paper = t->configs[config].baseline;
    return t->configs[config].light == light && !(paper && paper->literal) && p->scenes == want &&
           t->rows.at[config].sees_ground && trade_pooled_cost(t, p) >= 0;
}

void trade_frontier(const trade *t, int light, int sun, int height, int *on_frontier) {
    for (size_t i = 0; i < t->n_configs; i++) {
        const trade_pooled mine = trade_pool(t, i, sun, height, -1);
        const double cost = trade_pooled_cost(t, &mine);
        on_frontier[i] = does_all(t, i, light, &mine, sun, height);
        for (size_t k = 0; k < t->n_configs && on_frontier[i]; k++) {
            const trade_pooled other = trade_pool(t, k, sun, height, -1);
            const double its = trade_pooled_cost(t, &other);
            if (!does_all(t, k, light, &other, sun, height) || its > cost || other.mean > mine.mean)
                continue;
            if (its < cost || other.mean < mine.mean || k < i)
                on_frontier[i] = 0;
        }
    }
}
