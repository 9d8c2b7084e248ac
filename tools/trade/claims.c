/// What the papers that the project started from claim, beside what was measured.
#include <string.h>

#include "report.h"

/// Index of a configuration; n_configs where there is none.
static size_t find(const trade *t, int light, const char *name) {
    size_t i = 0;
    while (i < t->n_configs && (t->configs[i].light != light || strcmp(t->configs[i].name, name) != 0))
        i++;
    return i;
}

/// Uniform steps with twice the samples against the cubic ones, scene by scene.
static void print_half(FILE *out, const trade *t) {
    static const char *const pairs[][2] = {
        {"uniform 8x8", "keller 4x4"}, {"uniform 16x16", "keller 8x8"}, {"uniform 32x32", "keller 16x16"}};
    fprintf(out,
            "\nKeller & Bohn: cubic spacing needs \"half the samples\" of uniform steps. Mean errors in %%, uniform 2N "
            "| keller N:\n"
            " %-32s",
            "");
    trade_print_scenes(out, 32, 10);
    int holds = 0, cases = 0;
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        const size_t u = find(t, TRADE_SINGLE, pairs[i][0]), v = find(t, TRADE_SINGLE, pairs[i][1]);
        if (u == t->n_configs || v == t->n_configs)
            continue;
        fprintf(out, " %-15s | %-14s", pairs[i][0], pairs[i][1]);
        for (int k = 0; k < TRADE_SCENES; k++) {
            const trade_pooled a = trade_pool(t, u, k % TRADE_SUNS, k / TRADE_SUNS, -1),
                               b = trade_pool(t, v, k % TRADE_SUNS, k / TRADE_SUNS, -1);
            char x[TRADE_NUMBER], y[TRADE_NUMBER], both[2 * TRADE_NUMBER + 2];
            snprintf(both, sizeof both, "%s|%s%s", trade_percent(a.mean, x), trade_percent(b.mean, y),
                     b.mean <= a.mean ? "" : "!");
            fprintf(out, " %-10s", both);
            holds += b.mean <= a.mean;
            cases++;
        }
        fprintf(out, "\n");
    }
    fprintf(out, " It holds in %d of %d cases; ! = it does not.\n", holds, cases);
}

static void print_tables(FILE *out, const trade *t, const char *paper, const char *claim, const char *name) {
    for (size_t i = 0; i < t->n_configs; i++) {
        const trade_config *const c = &t->configs[i];
        if (!c->baseline || c->baseline->literal || strncmp(c->name, name, strlen(name)) != 0)
            continue;
        const trade_row *const r = &t->rows.at[i];
        const trade_pooled day = trade_pool(t, i, TRADE_DAY, -1, -1);
        char mean[TRADE_NUMBER];
        if (day.scenes > 0)
            fprintf(out,
                    " %-18s %-32s %s, %s light: tables %.2f MiB (%.2f MB), built in %.3g s of processor time, %s %% by "
                    "day\n",
                    paper, claim, c->name, trade_light_name[c->light], r->table_bytes / 1048576, r->table_bytes / 1e6,
                    r->build_s, trade_percent(day.mean, mean));
    }
}

void trade_report_claims(FILE *out, const trade *t) {
    fprintf(out, "\n== What the papers claim, beside what was measured here\n");
    print_half(out, t);
    fprintf(out, "\nTables:\n");
    print_tables(out, t, "Elek 2009", "\"5 MB and 3 h\"", "elek");
    print_tables(out, t, "Garcia Linan 2023", "\"1.25 MiB\"", "linan");
    const size_t ours = find(t, TRADE_FULL, "accurate, standard");
    if (ours < t->n_configs) {
        const trade_pooled day = trade_pool(t, ours, TRADE_DAY, -1, -1);
        char mean[TRADE_NUMBER];
        fprintf(out, " %-18s %-32s accurate, full light: %.0f bytes, %.3g s, %s %% by day\n", "ours", "",
                t->rows.at[ours].table_bytes, t->rows.at[ours].build_s, trade_percent(day.mean, mean));
    }
}
