#include "config.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core.h"
#include "truth.h"

const char *const trade_terms_suffix[TRADE_TERM_SETS] = {"", "-no-ozone", "-gas-only"};

enum { CONFIGS_MAX = 256 };

typedef struct list {
    trade_config *at;
    size_t n;
    int quick; ///< 1: only the quick ones are kept
} list;

/// Makes room for the next; the caller fills it.
static trade_config *next(list *l, int light, int quick, const char *format, ...) {
    static trade_config unused;
    trade_config *const c = (l->quick && !quick) || l->n == CONFIGS_MAX ? &unused : &l->at[l->n++];
    *c = (trade_config){.light = light, .quick = quick, .table = -1, .exp_degree = TRADE_EXP_DEGREE};
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(c->name, sizeof c->name, format, arguments);
    va_end(arguments);
    return c;
}

/// A rule; the tier's name where it is one.
static void set_rule(trade_config *c, skv_rule rule, int samples, skv_depth depth, int depth_samples) {
    static const char *const names[] = {"uniform", "keller", "gauss-exp"};
    c->quality = (skv_quality){rule, depth, samples, depth_samples, SKV_WITH_ALL};
    snprintf(c->eval, sizeof c->eval, "--rule %s --samples %d --depth %s --depth-samples %d", names[rule], samples,
             depth == SKV_DEPTH_BY_CHAPMAN ? "chapman" : "inner", depth_samples);
}

static const char *const tier_name[] = {"fast", "standard", "high"};

static void set_tier(trade_config *c, skv_tier tier) {
    (void)skv_quality_tier(&c->quality, tier); // a build that lacks it has no trade (core.h)
    c->quality.terms |= SKV_WITH_GROUND;
    snprintf(c->eval, sizeof c->eval, "--tier %s", tier_name[tier]);
}

static void add_rules(list *l) {
    static const struct {
        skv_rule rule;
        int samples, depth_samples, quick; // 0: Chapman
    } rules[] = {
        {SKV_UNIFORM, 4, 4, 0},    {SKV_UNIFORM, 8, 8, 1},    {SKV_UNIFORM, 16, 16, 0}, {SKV_UNIFORM, 32, 32, 0},
        {SKV_UNIFORM, 64, 64, 0},  {SKV_UNIFORM, 8, 0, 0},    {SKV_UNIFORM, 16, 0, 0},  {SKV_UNIFORM, 64, 0, 0},
        {SKV_KELLER, 4, 4, 1},     {SKV_KELLER, 5, 5, 0},     {SKV_KELLER, 8, 8, 0},    {SKV_KELLER, 16, 16, 0},
        {SKV_KELLER, 32, 32, 0},   {SKV_KELLER, 8, 0, 0},     {SKV_KELLER, 16, 0, 0},   {SKV_KELLER, 64, 0, 0},
        {SKV_GAUSS_EXP, 2, 0, 0},  {SKV_GAUSS_EXP, 3, 0, 0},  {SKV_GAUSS_EXP, 5, 0, 0}, {SKV_GAUSS_EXP, 12, 0, 0},
        {SKV_GAUSS_EXP, 16, 0, 0}, {SKV_GAUSS_EXP, 4, 4, 0},  {SKV_GAUSS_EXP, 6, 8, 0}, {SKV_GAUSS_EXP, 8, 8, 0},
        {SKV_GAUSS_EXP, 8, 16, 0}, {SKV_GAUSS_EXP, 16, 16, 0}};
    static const char *const names[] = {"uniform", "keller", "gauss-exp"};
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++) {
        const int m = rules[i].depth_samples;
        char depth[24];
        snprintf(depth, sizeof depth, m ? "x%d" : ", Chapman", m);
        trade_config *const c =
            next(l, TRADE_SINGLE, rules[i].quick, "%s %d%s", names[rules[i].rule], rules[i].samples, depth);
        set_rule(c, rules[i].rule, rules[i].samples, m ? SKV_DEPTH_BY_INNER : SKV_DEPTH_BY_CHAPMAN, m ? m : 2);
    }
}

static void set_orders(trade_config *c, const char *rest) {
    const size_t used = strlen(c->eval);
    snprintf(c->eval + used, sizeof c->eval - used, " --orders %s --ground lit%s", c->table < 0 ? "single" : "all",
             rest);
}

static void add_tiers(list *l, int light) {
    for (int t = 0; t < 3; t++)
        set_tier(next(l, light, t == 1 || light == TRADE_SINGLE, light == TRADE_SINGLE ? "%s" : "single scattering, %s",
                      tier_name[t]),
                 (skv_tier)t);
}

static void add_single(list *l) {
    add_rules(l);
    add_tiers(l, TRADE_SINGLE);
    trade_config *c = next(l, TRADE_SINGLE, 0, "standard, no ozone");
    set_tier(c, SKV_TIER_STANDARD);
    c->terms = TRADE_NO_OZONE;
    c = next(l, TRADE_SINGLE, 0, "standard, gas only");
    set_tier(c, SKV_TIER_STANDARD);
    c->terms = TRADE_GAS_ONLY;
}

static const char *const kind_name[SKV_TABLE_KINDS] = {"accurate", "small", "large"}; // as in skv_table_kind

static void add_table(list *l, int kind, int tier, int grid, int quick) {
    trade_config *const c =
        next(l, TRADE_FULL, quick, "%s, %s%s", kind_name[kind], tier_name[tier], grid ? ", grid" : "");
    set_tier(c, (skv_tier)tier);
    c->table = kind;
    c->grid = grid;
}

/// Rows, detailed rows and suns beside those of the kinds.
static void add_sizes(list *l) {
    static const int sizes[][3] = {{4, 2, 8}, {6, 3, 12}, {8, 5, 16}, {14, 8, 28}, {20, 12, 40}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        trade_config *const c = next(l, TRADE_FULL, 0, "table %dx%d, standard", sizes[i][0], sizes[i][2]);
        set_tier(c, SKV_TIER_STANDARD);
        c->table = SKV_TABLE_ACCURATE;
        c->altitudes = sizes[i][0];
        c->detailed = sizes[i][1];
        c->suns = sizes[i][2];
    }
    for (int kind = 0; kind < 2; kind++) {
        trade_config *const c = next(l, TRADE_FULL, 0, "%s in floats, standard", kind_name[kind]);
        set_tier(c, SKV_TIER_STANDARD);
        c->table = kind;
        c->format = SKV_TABLE_FLOAT;
    }
}

static void add_full(list *l) {
    add_tiers(l, TRADE_FULL);
    for (int grid = 0; grid < 2; grid++)
        for (int tier = 0; tier < 3; tier++) {
            add_table(l, SKV_TABLE_ACCURATE, tier, grid, tier == 1);
            if (tier > 0)
                add_table(l, SKV_TABLE_LARGE, tier, grid, 0);
            if (tier < 2)
                add_table(l, SKV_TABLE_SMALL, tier, grid, tier == 0 && grid == 0);
        }
    static const int samples[] = {3, 12};
    for (int i = 0; i < 2; i++) {
        trade_config *const c = next(l, TRADE_FULL, 0, "accurate, gauss-exp %d", samples[i]);
        set_rule(c, SKV_GAUSS_EXP, samples[i], SKV_DEPTH_BY_CHAPMAN, 2);
        c->table = SKV_TABLE_ACCURATE;
    }
    add_sizes(l);
    static const char *const without[] = {"", "no ozone", "gas only"};
    for (int terms = TRADE_NO_OZONE; terms < TRADE_TERM_SETS; terms++) {
        trade_config *const c = next(l, TRADE_FULL, 0, "accurate, standard, %s", without[terms]);
        set_tier(c, SKV_TIER_STANDARD);
        c->table = SKV_TABLE_ACCURATE;
        c->terms = terms;
    }
}

/// The same core compiled with another degree of 2^x.
static void add_degrees(list *l) {
    for (size_t i = 0; trade_cores[i]; i++)
        for (int light = 0; trade_cores[i]->exp_degree != TRADE_EXP_DEGREE && light < TRADE_LIGHTS; light++)
            for (int tier = SKV_TIER_STANDARD; tier <= (light == TRADE_SINGLE ? SKV_TIER_HIGH : SKV_TIER_STANDARD);
                 tier++) {
                trade_config *const c =
                    next(l, light, light == TRADE_SINGLE && tier == SKV_TIER_STANDARD, "%s%s, exp degree %d",
                         light == TRADE_FULL ? "accurate, " : "", tier_name[tier], trade_cores[i]->exp_degree);
                set_tier(c, (skv_tier)tier);
                c->table = light == TRADE_FULL ? SKV_TABLE_ACCURATE : -1;
                c->exp_degree = trade_cores[i]->exp_degree;
            }
}

static void finish_ours(trade_config *c) {
    char rest[100] = "", size[40];
    if (c->table >= 0 && c->suns > 0)
        snprintf(size, sizeof size, "%d,%d,%d", c->altitudes, c->detailed, c->suns);
    if (c->table >= 0)
        snprintf(rest, sizeof rest, " --table %s%s%s", c->suns > 0 ? size : kind_name[c->table],
                 c->format == SKV_TABLE_FLOAT ? " --table-format float" : "", c->grid ? " --grid" : "");
    set_orders(c, rest);
}

static void add_baselines(list *l) {
    for (const baseline *const *b = baselines; *b; b++)
        for (int light = 0; light < TRADE_LIGHTS; light++) {
            if (!((*b)->can & (light == TRADE_SINGLE ? BASELINE_SINGLE : BASELINE_ALL)))
                continue;
            trade_config *const c = next(l, light, 0, "%s", (*b)->name);
            c->baseline = *b;
            snprintf(c->eval, sizeof c->eval, "--model %s --orders %s --ground lit", (*b)->name,
                     light == TRADE_SINGLE ? "single" : "all");
        }
}

size_t trade_configs(trade_config **configs, int quick) {
    list l = {.at = calloc(CONFIGS_MAX, sizeof *l.at), .quick = quick};
    if (!l.at)
        return 0;
    add_single(&l);
    add_full(&l);
    add_degrees(&l);
    for (size_t i = 0; i < l.n; i++)
        finish_ours(&l.at[i]);
    add_baselines(&l);
    *configs = l.at;
    return l.n;
}

char *trade_config_text(const trade_config *c, char text[400]) {
    snprintf(text, 400, "%s|%s|%d|%d|%d|%d|%s", c->name, trade_light_name[c->light], c->terms, c->grid, c->exp_degree,
             c->format, c->eval);
    return text;
}
