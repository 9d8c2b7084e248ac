/// Pictures of the studies: gnuplot programs.
#include <string.h>

#include "studies.h"

static const char colours[][8] = {"#999999", "#d55e00", "#0072b2", "#009e73",
                                  "#56b4e9", "#cc79a7", "#e69f00", "#000000"};

static void begin(FILE *out, const char *csv, const char *terminal, int height, const char *picture) {
    fprintf(out,
            "set terminal %s size 1200,%d enhanced font 'DejaVu Sans,12'\nset output '%s'\nset datafile separator ','\n"
            "set datafile missing NaN\n"
            "csv = '%s'\nset grid lc rgb '#dddddd'\n",
            terminal, height, picture, csv);
}

/// Six panels: three suns from the ground, three from 12 km.
static void plot_dome(FILE *out, const char *air) {
    static const char *const sun[] = {"40", "88.5", "94"}, *const kind[] = {"even", "horizon", "adaptive"};
    static const char *const height[] = {"0", "12"}, *const from[] = {"ground", "12 km"};
    fprintf(
        out,
        "set multiplot layout 2,3 title 'Dome of V vertices, interpolated: 95th percentile of the error, %s'\n"
        "set logscale xy\nset xrange [80:5000]\nset yrange [.03:200]\nset xtics (100,200,400,'' 800,1000,2000,4000)\n"
        "set key bottom left Left reverse spacing .9 samplen 2 font ',10'\nset format y '%%g'\n",
        air);
    for (int p = 0; p < 6; p++) {
        fprintf(out, "set title '%s, sun zenith %s deg'\n%s\n%s\n", from[p / 3], sun[p % 3],
                p < 3 ? "unset xlabel" : "set xlabel 'vertices' offset 0,.3",
                p % 3 ? "unset ylabel" : "set ylabel 'error, %' offset 1,0");
        if (p > 0)
            fprintf(out, "unset key\n");
        fprintf(out, "plot ");
        for (int c = 0; c < 6; c++)
            fprintf(out,
                    "%scsv using ((strcol(1) eq '%s' && strcol(2) eq '%s' && strcol(3) eq '%s' && strcol(4) eq '%s' && "
                    "strcol(5) eq '%s' && strcol(7) eq 'all') ? $6 : NaN):9 with linespoints pt %d ps .8 lw 2 dt %d lc "
                    "rgb '%s' "
                    "title '%s, %s'",
                    c ? ", " : "", air, height[p / 3], sun[p % 3], kind[c / 2], c % 2 ? "apart" : "whole",
                    c % 2 ? 7 : 6, c % 2 ? 1 : 2, colours[1 + c / 2], kind[c / 2], c % 2 ? "phase apart" : "whole");
        fprintf(out, "\n");
    }
    fprintf(out, "unset multiplot\n");
}

typedef struct curve {
    const char *light, *way;
} curve;

static const curve curves[] = {{"once", "keller 5x5"},       {"once", "fast"},
                               {"once", "standard"},         {"once", "high"},
                               {"all", "standard small"},    {"all", "standard small grid"},
                               {"all", "standard accurate"}, {"all", "standard accurate grid"}};

/// Two columns (light scattered once, all), rows: ground, 12 km, and the sun.
static void plot_day(FILE *out, const char *air) {
    static const char *const height[] = {"0", "12"}, *const from[] = {"ground", "12 km"};
    fprintf(out,
            "set multiplot layout 3,2 title 'A day: mean error of a frame, %s'\nset xdata time\nset timefmt '%%H:%%M'\n"
            "set format x '%%H:%%M'\nset xrange ['02:00':'21:00']\nset xtics 10800\n",
            air);
    for (int p = 0; p < 4; p++) {
        const int all = p % 2;
        fprintf(
            out,
            "set logscale y\nset yrange [%s]\nset format y '%%g'\nset title '%s, %s'\nset ylabel 'error, %%' offset "
            "1,0\nset key top center maxrows 2 samplen 2 font ',10'\nplot ",
            all ? ".05:100" : ".001:1000", from[p / 2],
            all ? "all light, against the finest table" : "light scattered once");
        for (int c = 4 * all; c < 4 * all + 4; c++)
            fprintf(out,
                    "%scsv using 6:((strcol(1) eq 'minute' && strcol(2) eq '%s' && strcol(3) eq '%s' && strcol(4) eq "
                    "'%s' && "
                    "strcol(5) eq '%s') ? $8 : NaN) with lines lw 1.5 lc rgb '%s' title '%s'",
                    c > 4 * all ? ", " : "", air, height[p / 2], curves[c].light, curves[c].way, colours[1 + c % 4],
                    curves[c].way);
        fprintf(out, "\n");
    }
    fprintf(
        out,
        "unset logscale y\nset yrange [-15:70]\nset title 'sun'\nset ylabel 'elevation, deg'\nunset key\nplot csv "
        "using "
        "6:((strcol(1) eq 'minute' && strcol(2) eq '%s' && strcol(3) eq '0' && strcol(5) eq 'high') ? $7 : NaN) with "
        "lines lw 1.5 lc rgb '#000000'\n"
        "set logscale y\nset yrange [1e-3:100]\nset title 'ground: change of the error from minute to minute'\nset "
        "ylabel "
        "'%%' offset 1,0\nset key top center maxrows 2 samplen 2 font ',10'\nplot ",
        air);
    for (int c = 0; c < 4; c++) {
        static const int shown[] = {0, 1, 2, 6};
        const curve *const k = &curves[shown[c]];
        fprintf(
            out,
            "%scsv using 6:((strcol(1) eq 'minute' && strcol(2) eq '%s' && strcol(3) eq '0' && strcol(4) eq '%s' && "
            "strcol(5) eq '%s') ? $12 : NaN) with lines lw 1.5 lc rgb '%s' title '%s%s'",
            c ? ", " : "", air, k->light, k->way, colours[1 + c], c == 3 ? "all: " : "once: ", k->way);
    }
    fprintf(out, "\nunset multiplot\n");
}

int trade_study_plot(FILE *program, const char *study, const char *air, const char *csv, const char *terminal,
                     const char *picture) {
    const int day = strcmp(study, "day") == 0;
    if (!day && strcmp(study, "dome") != 0)
        return 1;
    begin(program, csv, terminal, day ? 1100 : 800, picture);
    if (day)
        plot_day(program, air);
    else
        plot_dome(program, air);
    return 0;
}
