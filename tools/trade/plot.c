/// The picture: cost against error, a panel per light and sun (or sun and height), the frontier drawn.
#include <stdlib.h>
#include <string.h>

#include "report.h"

enum { UNIFORM, KELLER, GAUSS, ONCE, TABLE, GRID, PAPER, LITERAL, FAMILIES };

static const struct {
    const char *title, *style; ///< gnuplot
} families[FAMILIES] = {
    {"uniform steps", "pt 4 lc rgb '#999999'"},     {"cubic steps (Keller, Bohn)", "pt 8 lc rgb '#d55e00'"},
    {"gauss-exp (ours)", "pt 7 lc rgb '#0072b2'"},  {"ours, scattered once only", "pt 6 lc rgb '#0072b2'"},
    {"ours, table", "pt 5 lc rgb '#009e73'"},       {"ours, table and grid", "pt 9 lc rgb '#56b4e9'"},
    {"other papers", "pt 3 lw 2 lc rgb '#cc0066'"}, {"the same as printed", "pt 2 lw 2 lc rgb '#e69f00'"}};

static int family_of(const trade_config *c) {
    if (c->baseline)
        return c->baseline->literal ? LITERAL : PAPER;
    if (c->light == TRADE_FULL)
        return c->table < 0 ? ONCE : c->grid ? GRID : TABLE;
    return c->quality.rule == SKV_UNIFORM ? UNIFORM : c->quality.rule == SKV_KELLER ? KELLER : GAUSS;
}

typedef struct label {
    const char *row, *text, *place; ///< place: gnuplot's, so that labels keep off one another and off the frontier
} label;

/// What stands beside a point; NULL nothing.
static const label *label_of(const trade_config *c) {
    static const label labels[] = {{"fast", "fast", "left offset char .7,.5"},
                                   {"high", "high", "left offset char .7,-.6"},
                                   {"keller 16x16", "16x16", "left offset char .7,0"},
                                   {"uniform 16x16", "16x16", "left offset char .7,.5"},
                                   {"accurate, standard, grid", "accurate, grid", "left offset char 3.5,-.2"},
                                   {"table 4x8, standard", "4x8", "left offset char .7,0"},
                                   {"single scattering, standard", "once only", "left offset char 1.5,.4"},
                                   {"elek09", "elek09", "left offset char .7,.8"},
                                   {"keller08", "keller08", "left offset char .7,.4"},
                                   {"hillaire20", "hillaire20", "right offset char -.7,.2"},
                                   {"linan23", "linan23", "center offset char 0,.9"}};
    for (size_t i = 0; i < sizeof labels / sizeof *labels; i++)
        if (strcmp(labels[i].row, c->name) == 0)
            return &labels[i];
    return NULL;
}

/// Errors above this, %, are not drawn.
static const double error_shown = 300;

static double shown_error(const trade_pooled *p) {
    return p->mean > 1e-7 ? 100 * p->mean : 1e-5; // the axis is logarithmic
}

/// @return the families that have points, bit by bit
static unsigned write_points(FILE *out, const trade *t, int panel, int light, int sun, int height) {
    unsigned there = 0;
    for (int f = 0; f < FAMILIES; f++) {
        fprintf(out, "$p%d_%d << E\n", panel, f);
        for (size_t i = 0; i < t->n_configs; i++) {
            const trade_pooled p = trade_pool(t, i, sun, height, -1);
            if (t->configs[i].light != light || family_of(&t->configs[i]) != f || p.scenes == 0 ||
                !(trade_pooled_cost(t, &p) > 0))
                continue;
            there |= 1u << f;
            fprintf(out, "%.6g %.6g\n", trade_pooled_cost(t, &p), shown_error(&p));
        }
        fprintf(out, "E\n");
    }
    return there;
}

typedef struct point {
    double cost, error;
} point;

static int by_cost(const void *a, const void *b) {
    const double x = ((const point *)a)->cost, y = ((const point *)b)->cost;
    return (x > y) - (x < y);
}

static void write_frontier(FILE *out, const trade *t, int panel, int light, int sun, int height) {
    int *const on = calloc(t->n_configs, sizeof *on);
    point *const points = calloc(t->n_configs, sizeof *points);
    size_t n = 0;
    if (on && points) {
        trade_frontier(t, light, sun, height, on);
        for (size_t i = 0; i < t->n_configs; i++) {
            const trade_pooled p = trade_pool(t, i, sun, height, -1);
            if (on[i])
                points[n++] = (point){trade_pooled_cost(t, &p), shown_error(&p)};
        }
        qsort(points, n, sizeof *points, by_cost);
    }
    fprintf(out, "$f%d << E\n", panel);
    for (size_t i = 0; i < n; i++)
        fprintf(out, "%.6g %.6g\n", points[i].cost, points[i].error);
    fprintf(out, "E\n");
    free(on);
    free(points);
}

static void write_labels(FILE *out, const trade *t, int light, int sun, int height) {
    fprintf(out, "unset label\n");
    for (size_t i = 0; i < t->n_configs; i++) {
        const trade_pooled p = trade_pool(t, i, sun, height, -1);
        const label *const l = label_of(&t->configs[i]);
        if (l && t->configs[i].light == light && p.scenes > 0 && shown_error(&p) < error_shown)
            fprintf(out, "set label '%s' at %.6g,%.6g %s font ',10'\n", l->text, trade_pooled_cost(t, &p),
                    shown_error(&p), l->place);
    }
}

static void write_plot(FILE *out, int panel, unsigned there) {
    fprintf(out, "plot $f%d using 1:2 with steps lw 2 lc rgb '#000000' notitle", panel);
    for (int f = 0; f < FAMILIES; f++)
        if (there & 1u << f)
            fprintf(out, ", $p%d_%d using 1:2 with points %s notitle", panel, f, families[f].style);
    fprintf(out, "\n");
}

/// The panel that says what the signs are.
static void write_key(FILE *out, unsigned there) {
    fprintf(
        out,
        "set origin 0,0\nset size 1,.1\nset lmargin 0\nset rmargin 0\nset tmargin 0\nset bmargin 0\nunset logscale\n"
        "unset border\nunset tics\nunset xlabel\nunset ylabel\nunset title\nset key center center horizontal maxrows 3 "
        "width 1 samplen 1\nset xrange [0:1]\nset yrange [0:1]\n"
        "plot NaN with lines lw 2 lc rgb '#000000' title 'frontier (above 300 %%: not drawn)'");
    for (int f = 0; f < FAMILIES; f++)
        if (there & 1u << f)
            fprintf(out, ", NaN with points %s title '%s'", families[f].style, families[f].title);
    fprintf(out, "\n");
}

static int panel_light(int light, int row) {
    return light < 0 ? row : light;
}

void trade_plot(FILE *out, const trade *t, int light, const char *terminal, const char *picture) {
    const int rows = light < 0 ? 2 : TRADE_HEIGHTS;
    unsigned panel[TRADE_SCENES], all = 0;
    for (int i = 0; i < rows * TRADE_SUNS; i++) {
        const int height = light < 0 ? -1 : i / TRADE_SUNS, sun = i % TRADE_SUNS;
        panel[i] = write_points(out, t, i, panel_light(light, i / TRADE_SUNS), sun, height);
        all |= panel[i];
        write_frontier(out, t, i, panel_light(light, i / TRADE_SUNS), sun, height);
    }
    fprintf(out, "set terminal %s size %s,%d enhanced font 'DejaVu Sans,12'\nset output '%s'\nset multiplot\n",
            terminal, "1200", 190 + 370 * rows, picture);
    fprintf(out,
            "set logscale xy\nset grid lc rgb '#dddddd'\nset format x '10^{%%T}'\nset key off\nset pointsize 1.1\n"
            "set yrange [*:%g]\n",
            error_shown);
    const double tall = 0.9 / rows;
    for (int i = 0; i < rows * TRADE_SUNS; i++) {
        const int row = i / TRADE_SUNS, sun = i % TRADE_SUNS, height = light < 0 ? -1 : row;
        fprintf(out, "set origin %.4f,%.4f\nset size %.4f,%.4f\n", sun / 3.0, 0.1 + tall * (rows - 1 - row), 1 / 3.0,
                tall);
        fprintf(out, "set lmargin 7\nset rmargin 1.5\nset tmargin 2\nset bmargin 3.3\n");
        fprintf(out, "set title '%s, %s%s%s'\n",
                panel_light(light, row) == TRADE_SINGLE ? "light scattered once" : "all light", trade_sun_name[sun],
                light < 0 ? "" : ", ", light < 0 ? "" : trade_height_name[row]);
        fprintf(out, "set xlabel '%s' offset 0,.4\n%s\n", t->counted ? "instructions a vertex" : "ns a vertex",
                sun == 0 ? "set ylabel 'mean error, %' offset 2.2,0" : "unset ylabel");
        write_labels(out, t, panel_light(light, row), sun, height);
        write_plot(out, i, panel[i]);
    }
    write_key(out, all);
    fprintf(out, "unset multiplot\n");
}
