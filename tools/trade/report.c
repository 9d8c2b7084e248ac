/// The report in text.
#include "report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char trade_metric_sentence[] = "The error of a ray is the largest absolute error of its bands over the largest "
                                     "band of the truth, which counts as at "
                                     "least 5 % of the mean (of the largest bands) of its scene.";

char *trade_percent(double fraction, char text[TRADE_NUMBER]) {
    const double p = 100 * fraction;
    if (!(p >= 0))
        return strcpy(text, "-");
    snprintf(text, TRADE_NUMBER, "%.*f", p >= 9.95 ? 0 : p >= 0.995 ? 1 : p >= 0.0995 ? 2 : 3, p > 99999 ? 99999 : p);
    if (text[0] == '0' && text[1] == '.')
        memmove(text, text + 1, strlen(text));
    return text;
}

char *trade_whole(double value, char text[TRADE_NUMBER]) {
    if (!(value >= 0))
        return strcpy(text, "-");
    snprintf(text, TRADE_NUMBER, "%.0f", value);
    return text;
}

static const char *const light_title[TRADE_LIGHTS] = {
    "Light scattered once (and the ground's), against converged double precision",
    "All light, ground lit, against the path tracer"};

static void print_errors(FILE *out, const trade *t, size_t i) {
    for (int sun = 0; sun < TRADE_SUNS; sun++) {
        const trade_pooled p = trade_pool(t, i, sun, -1, -1);
        char a[TRADE_NUMBER], b[TRADE_NUMBER], c[TRADE_NUMBER], all[3 * TRADE_NUMBER + 3];
        snprintf(all, sizeof all, "%s/%s/%s", trade_percent(p.mean, a), trade_percent(p.p95, b),
                 trade_percent(p.max, c));
        fprintf(out, " | %-14s", p.scenes > 0 ? all : "-");
    }
}

static double bytes_of(const trade *t, size_t i) {
    return t->rows.at[i].table_bytes + t->rows.at[i].grid_bytes;
}

static double build_ms(const trade *t, size_t i) {
    double sum = 0;
    for (size_t a = 0; a < t->n_truths; a++)
        sum += 1e3 * t->rows.at[a * t->n_configs + i].build_s / (double)t->n_truths;
    return sum;
}

static void print_row(FILE *out, const trade *t, size_t i, int on_frontier) {
    const trade_pooled all = trade_pool(t, i, -1, -1, -1);
    char bytes[TRADE_NUMBER], stack[TRADE_NUMBER], ns[TRADE_NUMBER], low[TRADE_NUMBER], high[TRADE_NUMBER],
        instructions[TRADE_NUMBER], spread[3 * TRADE_NUMBER + 4];
    const trade_row *const r = &t->rows.at[i];
    fprintf(out, "%c%-29s", on_frontier ? '*' : ' ', t->configs[i].name);
    if (all.scenes == 0) {
        fprintf(out, " cannot: %s\n", r->beyond[0] ? r->beyond : "none of the scenes");
        return;
    }
    snprintf(spread, sizeof spread, "%s (%s-%s)", trade_whole(all.ns, ns), trade_whole(all.ns_low, low),
             trade_whole(all.ns_high, high));
    fprintf(out, " %8s %8.*f %6s %20s %7s", trade_whole(bytes_of(t, i), bytes), build_ms(t, i) < 10 ? 1 : 0,
            build_ms(t, i), trade_whole(r->stack_bytes, stack), all.ns < 0 ? "-" : spread,
            trade_whole(all.instructions, instructions));
    print_errors(out, t, i);
    fprintf(out, "%s\n", r->sees_ground ? "" : " sky only");
}

static void print_light(FILE *out, const trade *t, int light, int *on_frontier) {
    trade_frontier(t, light, -1, -1, on_frontier);
    fprintf(out, "\n== %s\n", light_title[light]);
    fprintf(out, " %-29s %8s %8s %6s %20s %7s", "", "bytes", "build ms", "stack", "ns/vertex (spread)", "instr.");
    for (int sun = 0; sun < TRADE_SUNS; sun++)
        fprintf(out, " | %-14s", trade_sun_name[sun]);
    fprintf(out, "\n");
    for (size_t i = 0; i < t->n_configs; i++)
        if (t->configs[i].light == light)
            print_row(out, t, i, on_frontier[i]);
}

void trade_print_scenes(FILE *out, int indent, int width) {
    for (int k = 0; k < TRADE_SCENES; k++)
        fprintf(out, " %-*s", width, k % TRADE_SUNS == 0 ? trade_height_name[k / TRADE_SUNS] : "");
    fprintf(out, "\n %-*s", indent, "");
    for (int k = 0; k < TRADE_SCENES; k++)
        fprintf(out, " %-*s", width, trade_sun_name[k % TRADE_SUNS]);
    fprintf(out, "\n");
}

static void print_heights(FILE *out, const trade *t, int light) {
    fprintf(out, "\n== %s: by height, mean/largest in %%\n %-29s",
            light == TRADE_SINGLE ? "Light scattered once" : "All light", "");
    trade_print_scenes(out, 29, 9);
    for (size_t i = 0; i < t->n_configs; i++) {
        if (t->configs[i].light != light)
            continue;
        fprintf(out, " %-29s", t->configs[i].name);
        for (int k = 0; k < TRADE_SCENES; k++) {
            const trade_pooled p = trade_pool(t, i, k % TRADE_SUNS, k / TRADE_SUNS, -1);
            char a[TRADE_NUMBER], b[TRADE_NUMBER], both[2 * TRADE_NUMBER + 2];
            snprintf(both, sizeof both, "%s/%s", trade_percent(p.mean, a), trade_percent(p.max, b));
            fprintf(out, " %-9s", p.scenes > 0 ? both : "-");
        }
        fprintf(out, "\n");
    }
}

static void print_notes(FILE *out, const trade *t) {
    fprintf(out, "\nRows: %zu configurations on %zu airs, %zu taken over from an earlier run. Airs:", t->n_configs,
            t->n_truths, t->kept);
    for (size_t a = 0; a < t->n_truths; a++)
        fprintf(out, " %s", t->truths[a].ini);
    fprintf(
        out,
        "; each nine scenes of 24 rays: 0, 12 and 40 km, sun zenith 40 (day),\n88.5 (sunset), 94 deg (twilight).\n");
    fprintf(out,
            "Columns: bytes of tables and grid; build: model and table, processor time; stack below the call;\n"
            "ns: processor time, median of %d interleaved rounds (10th to 90th percentile), instructions: callgrind; "
            "both a\n"
            "vertex of a dome of %d, the frame's work included, mean of all scenes; errors: mean/95 %%/largest in %%,\n"
            "heights and airs together. * = on the frontier of cost and mean error over all scenes.\n",
            t->repeats, TRADE_DOME_VERTICES);
    if (!t->counted)
        fprintf(out,
                "note: instructions were not counted (valgrind is missing or failed): the frontier is drawn with ns\n");
    if (!trade_cores[1])
        fprintf(out,
                "note: the degree of 2^x in the inner loops is fixed when the core is compiled (%d): other degrees are "
                "compiled in by make trade\n",
                TRADE_EXP_DEGREE);
    if (isfinite(t->checksum) && t->checksum > 0)
        fprintf(out, "checksum of the timed runs: %.9g\n", t->checksum);
}

void trade_report_text(FILE *out, const trade *t) {
    int *const on_frontier = calloc(t->n_configs, sizeof *on_frontier);
    if (!on_frontier)
        return;
    trade_report_machine(out);
    fprintf(out, "Metric: %s\n", trade_metric_sentence);
    print_notes(out, t);
    for (int light = 0; light < TRADE_LIGHTS; light++)
        print_light(out, t, light, on_frontier);
    for (int light = 0; light < TRADE_LIGHTS; light++)
        print_heights(out, t, light);
    trade_report_claims(out, t);
    fprintf(out, "\n== Worst input of each row: `ATMOSPHERE | OPTIONS | QUERY`, a query's columns being\n"
                 "   altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg; the error is of what `skyvert eval "
                 "--atmosphere\n"
                 "   ATMOSPHERE OPTIONS` answers against `truth`, relative to `scale`\n");
    trade_report_worst(out, t);
    free(on_frontier);
}
