/// All light against the path tracer's committed rays (tools/reference/data): what [Hillaire20] and [Linan23] are
/// worth, and single scattering alone. Rays are marched, not read from the picture of the sky.
#include "hillaire20.h"

#include "linan23.h"
#include "linan_sky.h"

enum { RAYS = 100, CLASSES = 4 };
static const char *const class_names[CLASSES] = {"sun 0-75", "80-85", "88-92", "94-96"};

typedef struct truth {
    int n;
    double q[RAYS][4], light[RAYS][4];
} truth;

static void read_truth(const char *name, truth *t) {
    FILE *const in = fopen(name, "r");
    if (!in)
        fail_msg("%s: cannot be read; run from the root", name);
    char line[400];
    t->n = 0;
    while (t->n < RAYS && fgets(line, sizeof line, in)) {
        double *const q = t->q[t->n], *const light = t->light[t->n];
        if (sscanf(line, "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", q, q + 1, q + 2, q + 3, light, light + 1, light + 2,
                   light + 3) == 8)
            t->n++;
    }
    fclose(in);
    assert_int_equal(t->n, RAYS);
}

static int class_of(double sun) {
    return sun < 79 ? 0 : sun < 87 ? 1 : sun < 93 ? 2 : 3;
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/// Mean error by class, %; error of a ray: its largest band's over its largest band.
static void compare(const char *name, const truth *t, const double (*got)[4], double mean[CLASSES]) {
    char text[200] = "";
    for (int c = 0; c < CLASSES; c++) {
        double off[RAYS];
        int n = 0;
        mean[c] = 0;
        for (int i = 0; i < t->n; i++) {
            if (class_of(t->q[i][1]) != c)
                continue;
            off[n] = 0;
            for (int b = 0; b < 4; b++)
                off[n] = fmax(off[n], 100 * fabs(got[i][b] - t->light[i][b]) / sky_largest(t->light[i]));
            mean[c] += off[n++];
        }
        mean[c] /= n;
        qsort(off, (size_t)n, sizeof *off, ascending);
        snprintf(text + strlen(text), sizeof text - strlen(text), " | %s %.1f/%.0f/%.0f", class_names[c], mean[c],
                 off[(int)(0.95 * n)], off[n - 1]);
    }
    print_message("figure: all light, %s, mean/p95/max %%%s\n", name, text);
}

typedef void one_ray(const void *model, const baseline_view *view, const double direction[3], double light[4]);

static void trace(const char *name, const truth *t, one_ray *ray, const void *model, double mean[CLASSES]) {
    double got[RAYS][4];
    for (int i = 0; i < t->n; i++) {
        const baseline_view view = sky_view(t->q[i][0], t->q[i][1]);
        double direction[3];
        sky_direction(direction, t->q[i][2], t->q[i][3]);
        ray(model, &view, direction, got[i]);
    }
    compare(name, t, (const double(*)[4])got, mean);
}

static void hillaire(const void *model, const baseline_view *view, const double direction[3], double light[4]) {
    hillaire20_direct(model, view, direction, light);
}

static void linan(const void *model, const baseline_view *view, const double direction[3], double light[4]) {
    linan23_direct(model, view, direction, light);
}

typedef struct means {
    double hillaire[CLASSES], linan[CLASSES], single[CLASSES];
} means;

static void measure(const char *air_name, const skv_atmosphere *air, const char *file, means *m) {
    static truth t;
    const baseline_wants all = {.all = 1, .lit_ground = 1, .threads = 1}, once = {.lit_ground = 1, .threads = 1};
    baseline_cost cost;
    const char *why;
    char name[80];
    hillaire20 *h, *s;
    linan23 *l;
    read_truth(file, &t);
    assert_int_equal(hillaire20_build(&h, air, &all, &HILLAIRE20_SIZES, &cost, &why), 0);
    snprintf(name, sizeof name, "hillaire20, %s", air_name);
    trace(name, &t, hillaire, h, m->hillaire);
    hillaire20_release(h);
    assert_int_equal(linan23_build(&l, air, &all, &LINAN23_SIZES, 0, &cost), 0);
    snprintf(name, sizeof name, "linan23, %s", air_name);
    trace(name, &t, linan, l, m->linan);
    linan23_release(l);
    assert_int_equal(hillaire20_build(&s, air, &once, &HILLAIRE20_SIZES, &cost, &why), 0);
    snprintf(name, sizeof name, "single scattering alone, %s", air_name);
    trace(name, &t, hillaire, s, m->single);
    hillaire20_release(s);
}

/// DESIGN found 6-9 % by day for an isotropic table of its own; lit by the sky too, the ground costs less here.
static void clear_air(void **state) {
    (void)state;
    means m;
    const skv_atmosphere air = sky_clear();
    measure("clear (br17o)", &air, "tools/reference/data/br17o.csv", &m);
    check_at_most("hillaire20, day, mean %", m.hillaire[0], 5);
    check_at_most("linan23, day, mean %", m.linan[0], 9); // fitted to this air: 6 % rms, the largest bands on top
    check_at_most("multiple scattering is worth it: hillaire20 over single", m.hillaire[0] / m.single[0], 0.6);
    check_at_most("multiple scattering is worth it: linan23 over single", m.linan[0] / m.single[0], 0.6);
}

static void hazy_air(void **state) {
    (void)state;
    means m;
    const skv_atmosphere air = sky_hazy();
    measure("hazy (br16)", &air, "tools/reference/data/br16.csv", &m);
    check_at_most("hillaire20, day, mean %", m.hillaire[0],
                  7); // as clear air; half the light is scattered more than once
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(clear_air), cmocka_unit_test(hazy_air)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
