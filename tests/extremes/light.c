/// All orders of scattering at the extremes: no steps where there is no event, the geometric horizon stepping by what
/// lies beyond it, lengths from nothing to the sky, deep twilight, and dense air bounded by the sun's energy.
///
/// A reference for single steps of all the light would need 1e-4 of noise. In its place: light scattered more than once
/// is an integral over smooth sources along paths that change smoothly everywhere but at the geometric horizon, so that
/// a step may differ from the mean of the steps before and behind it by second differences only, 1e-8 of the radiance
/// for steps of 1e-4 rad; .2 % is allowed, as for single scattering. Across the horizon the step is known: what lies
/// beyond the tangent point, seen from there by another observer, through the air in between.
#include "skyvert/colour.h"
#include "skyvert/irradiance.h"
#include "skyvert/table.h"
#include "steps.h"

#define RADIAN 1e-4
#define TABLES 3
#define PI     3.14159265358979323846

static int full;
static int wide; // sweeps step so many times as far: a jump is as high in them
static air airs[TABLES];
static const char *const names[TABLES] = {"clear", "hazy", "smoky"};
static float bytes[TABLES][2048], work[24000];
static uint64_t state_of_random = 0xD1B54A32D192ED03ULL;

static const skv_table *table_of(int a) {
    return (const skv_table *)(const void *)bytes[a];
}

static void build(int a, skv_atmosphere atmosphere, const char *name) {
    air_make(&airs[a], name, atmosphere, 0);
    must(skv_table_build((skv_table *)(void *)bytes[a], sizeof bytes[a], work, sizeof work, &airs[a].model, NULL),
         "skv_table_build");
}

typedef enum kind { SINGLE, ALL, GRID } kind;

static void rays_of(const setting *s, int a, kind k, answers *out) {
    static float grid[4096];
    skv_frame frame;
    frame_of(&frame, s->a, &s->quality, s->observer_km, s->sun);
    if (k != SINGLE)
        must(skv_frame_table(&frame, table_of(a)), "skv_frame_table");
    if (k == GRID) {
        assert_true(skv_grid_size(&frame) <= sizeof grid);
        must(skv_frame_grid(&frame, grid, sizeof grid), "skv_frame_grid");
    }
    const skv_rays rays = {s->view[0], 0, s->lengths ? s->length_km : NULL, 0};
    const skv_sky sky = {out->of[0], sizeof out->of[0], out->of[0] + 4, sizeof out->of[0]};
    memset(out, 0, sizeof *out);
    must(skv_radiance(&frame, STEP_RAYS, &rays, &sky), s->a->name);
}

/// The diffuse part in the first four, all the light in the last four.
static void parts_of(const setting *s, int a, kind k, answers *out) {
    answers all, single;
    rays_of(s, a, k, &all);
    rays_of(s, a, SINGLE, &single);
    for (int r = 0; r < STEP_RAYS; r++)
        for (int b = 0; b < 4; b++) {
            out->of[r][b] = all.of[r][b] - single.of[r][b];
            out->of[r][4 + b] = all.of[r][b];
            // Rounding of the difference only: more light must not make less.
            if (!(all.of[r][b] >= single.of[r][b] * 0.999999f && all.of[r][b] < 1e38f))
                fail_msg("%s: observer %g, band %d: all the light %g, scattered once %g", s->a->name,
                         (double)s->observer_km, b, (double)all.of[r][b], (double)single.of[r][b]);
        }
}

typedef struct tally {
    double worst; // %
    char where[240];
} tally;

/// 1: meets the ground; 2: within 3 km of the edge of the air, where light begins as a square root; 3: so near the
/// horizon that what is left of the path is a square root too; else 0.
static int side_of(const setting *s, int r) {
    const double radius = (double)s->a->atmosphere.radius_km, y = (double)s->observer_km, up = (double)s->view[r][2];
    const double flat = hypot((double)s->view[r][0], (double)s->view[r][1]);
    const double nearest = up < 0 ? flat / hypot(flat, up) * (radius + y) - radius : y;
    if (fabs(nearest) < 0.002 * wide)
        return 3;
    return nearest < 0 ? 1 : nearest > (double)s->a->atmosphere.top_km - 3 ? 2 : 0;
}

/// @param unit  how many times .0001 rad or 1 m a step is: wide steps that differ are gone through in small ones.
static void walk(const sweep *w, setting *s, int a, kind k, int unit, tally *t) {
    answers last[4];
    int side[4][STEP_RAYS];
    double least = 0;
    int closer = 0;
    memset(side, 0, sizeof side);
    for (int i = 0; i < w->n; i++) {
        answers *now = &last[i & 3];
        w->put(s, w->from + w->step * i);
        parts_of(s, a, k, now);
        for (int r = 0; r < STEP_RAYS; r++)
            side[i & 3][r] = side_of(s, r);
        if (i % 4096 == 0)
            least = least_radiance(s->a, &s->quality, s->observer_km, s->sun);
        for (int r = 0; r < STEP_RAYS && i >= 3; r++) {
            const float *p = last[(i - 3) & 3].of[r], *q = last[(i - 2) & 3].of[r], *u = last[(i - 1) & 3].of[r];
            double most = least, off = 0;
            int band = 0;
            if (side[0][r] != side[1][r] || side[1][r] != side[2][r] || side[2][r] != side[3][r])
                continue; // the horizon: below
            if (side[0][r] >= 2)
                continue;
            for (int b = 0; b < 4; b++) {
                const double d = (double)u[b] - (double)q[b];
                const double o = fabs(d - 0.5 * ((double)q[b] - (double)p[b] + (double)now->of[r][b] - (double)u[b]));
                most = fmax(most, (double)q[4 + b]);
                if (o > off)
                    off = o, band = b;
            }
            if (unit > 1 && 100 * off / most > 0.05) {
                if (i < closer) // gone through already
                    continue;
                closer = i + 1;
                sweep fine = {w->name, w->put, w->from + w->step * (i - 3), w->step / unit, 3 * unit + 1};
                walk(&fine, s, a, k, 1, t);
                continue;
            }
            if (!(100 * off / most <= t->worst)) {
                t->worst = 100 * off / most;
                snprintf(t->where, sizeof t->where,
                         "%s, %s from %.9g by %.3g, band %d: %.6g to %.6g; observer %.9g km, sun %.6g %.6g, view %.6g "
                         "%.6g %.6g",
                         s->a->name, w->name, w->from + w->step * (i - 2), w->step, band, (double)q[band],
                         (double)u[band], (double)s->observer_km, (double)s->sun[1], (double)s->sun[2],
                         (double)s->view[r][0], (double)s->view[r][1], (double)s->view[r][2]);
            }
        }
    }
}

static void put_view(setting *s, double x) {
    static const double azimuths[STEP_RAYS] = {0, 1, 20, 45, 90, 135, 179, 180};
    for (int i = 0; i < STEP_RAYS; i++)
        direction_of(s->view[i], x / DEGREE, azimuths[i]);
}

static void put_sun(setting *s, double x) {
    direction_of(s->sun, x / DEGREE, 0);
}

static void put_height(setting *s, double x) {
    s->observer_km = (float)x;
}

static void put_length(setting *s, double x) {
    for (int i = 0; i < STEP_RAYS; i++)
        s->length_km[i] = (float)x;
}

static void begin(setting *s, int a, double sun_deg, double height_km) {
    static const double fixed[STEP_RAYS][2] = {{0, 0},    {60, 180}, {85, 90},  {89, 0},
                                               {90.5, 0}, {92, 180}, {100, 90}, {170, 0}};
    memset(s, 0, sizeof *s);
    s->a = &airs[a];
    s->observer_km = (float)height_km;
    (void)skv_quality_tier(&s->quality, SKV_TIER_STANDARD);
    direction_of(s->sun, sun_deg, 0);
    for (int i = 0; i < STEP_RAYS; i++)
        direction_of(s->view[i], fixed[i][0], fixed[i][1]);
}

static int chosen(int n) {
    const int yes = random_unit(&state_of_random) * n < 1;
    return full || yes;
}

/// One line of the table for several tallies.
static void tell(int number, const char *name, int n, const tally *const t[], double limit) {
    char line[64] = "", ours[16];
    for (int i = 0; i < n; i++) {
        printf("figure: %s, %d: worst %.3g %%: %s\n", name, i + 1, t[i]->worst, t[i]->where);
        const size_t end = strlen(line);
        snprintf(line + end, sizeof line - end, "%s%s", i ? "; " : "", figure_text(ours, t[i]->worst));
    }
    table_line(number, name, "-", line, "-");
    for (int i = 0; i < n; i++)
        check_at_most(t[i]->where, t[i]->worst, limit);
}

static tally integrated, grid_steps, distant;

static void smooth(void **state) {
    static const double suns[] = {30, 80, 89, 91, 95, 100}, heights[] = {0, 1, 10, 25, 70};
    setting s;
    (void)state;
    for (int a = 0; a < TABLES; a++)
        for (int i = 0; i < 6; i++)
            for (int k = 0; k < 5; k++) {
                const double until = 20 + 300 * random_unit(&state_of_random);
                if (!(a == 1 && i == 2 && k == 1) && !chosen(40))
                    continue;
                begin(&s, a, suns[i], heights[k]);
                walk(&(sweep){"zenith angle of the view", put_view, 0, wide * RADIAN, (int)(31415 / wide)}, &s, a, ALL,
                     wide, &integrated);
                if (k < 4)
                    walk(&(sweep){"grid, zenith angle of the view", put_view, 0, wide * RADIAN, (int)(31415 / wide)},
                         &s, a, GRID, wide, &grid_steps);
                begin(&s, a, suns[i], heights[k]);
                walk(&(sweep){"zenith angle of the sun", put_sun, 1, 0.2 * wide * RADIAN, 50000 / wide}, &s, a, ALL,
                     full ? 1 : 2, &integrated);
                begin(&s, a, suns[i], heights[k]);
                walk(&(sweep){"observer's height", put_height, 0, wide * 1e-3, (int)(30000 / wide)}, &s, a, ALL, wide,
                     &integrated);
                begin(&s, a, suns[i], heights[k]);
                s.lengths = 1;
                walk(&(sweep){"length, near", put_length, 0, 1e-3, full ? 30000 : 3000}, &s, a, ALL, 1, &distant);
                walk(&(sweep){"length, far", put_length, until, 1e-3, full ? 30000 : 3000}, &s, a, ALL, 1, &distant);
            }
    tell(30, "all light: steps, integrated; grid; length of a ray", 3,
         (const tally *[]){&integrated, &grid_steps, &distant}, 0.2);
}

/// One ray's light of all orders, and of the first alone.
static void ray_of(const setting *s, int a, kind k, const float view[3], float length_km, float radiance[4],
                   float through[4]) {
    setting one = *s;
    answers out;
    one.lengths = length_km >= 0;
    for (int i = 0; i < STEP_RAYS; i++) {
        memcpy(one.view[i], view, sizeof one.view[i]);
        one.length_km[i] = length_km;
    }
    rays_of(&one, a, k, &out);
    memcpy(radiance, out.of[0], 4 * sizeof *radiance);
    memcpy(through, out.of[0] + 4, 4 * sizeof *through);
}

/// A pair of rays 1e-7 rad above and below the geometric horizon, in double and then rounded.
static void at_horizon(const setting *s, double azimuth_deg, float above[3], float below[3]) {
    const double radius = (double)s->a->atmosphere.radius_km, y = (double)s->observer_km;
    const double dip = acos(radius / (radius + y));
    direction_of(above, 90 + (dip - 1e-7) / DEGREE, azimuth_deg);
    direction_of(below, 90 + (dip + 1e-7) / DEGREE, azimuth_deg);
}

/// What lies beyond the tangent point: seen level by an observer on the ground there, whose up is turned by the dip.
static void beyond(const setting *s, int a, kind k, double azimuth_deg, float radiance[4]) {
    const double radius = (double)s->a->atmosphere.radius_km, y = (double)s->observer_km;
    const double dip = acos(radius / (radius + y)), az = azimuth_deg * DEGREE;
    const double ahead[3] = {sin(az), -cos(az), 0};
    setting there = *s;
    float level[3], unused[4];
    const double sun[3] = {(double)s->sun[0], (double)s->sun[1], (double)s->sun[2]};
    const double forward = sun[0] * ahead[0] + sun[1] * ahead[1], up = sun[2];
    // Up there leans forward by the dip: the part of the sun in the plane of the ray is turned back by it.
    const double f = forward * cos(dip) - up * sin(dip), u = forward * sin(dip) + up * cos(dip);
    for (int i = 0; i < 2; i++)
        there.sun[i] = (float)(sun[i] + (f - forward) * ahead[i]);
    there.sun[2] = (float)u;
    there.observer_km = 0;
    direction_of(level, 90, azimuth_deg);
    level[2] = 0;
    ray_of(&there, a, k, level, -1, radiance, unused);
}

static void horizon(void **state) {
    static const double heights[] = {0.01, 0.3, 2, 11, 25, 50};
    static const double suns[] = {20, 70, 86, 90, 93}, azimuths[] = {0, 60, 120, 180};
    tally t = {0}, grid = {0};
    (void)state;
    for (int n = 0; n < TABLES * 6 * 5 * 4; n++) {
        const int a = n % TABLES, h = n / TABLES % 6, i = n / TABLES / 6 % 5, k = n / TABLES / 30;
        float above[3], below[3], all[2][4], once[4], through[2][4], far[4], by_grid[2][4];
        double most = 0;
        setting s;
        begin(&s, a, suns[i], heights[h]);
        at_horizon(&s, azimuths[k], above, below);
        // Light scattered once has the reference itself (continuity.c): it is taken off.
        for (int e = 0; e < 2; e++) {
            ray_of(&s, a, ALL, e ? below : above, -1, all[e], through[e]);
            for (int b = 0; b < 4 && e == 0; b++)
                most = fmax(most, (double)all[0][b]);
            ray_of(&s, a, SINGLE, e ? below : above, -1, once, through[e]);
            for (int b = 0; b < 4; b++)
                all[e][b] -= once[b];
        }
        beyond(&s, a, ALL, azimuths[k], far);
        beyond(&s, a, SINGLE, azimuths[k], once);
        for (int b = 0; b < 4; b++)
            far[b] -= once[b];
        for (int b = 0; b < 4; b++) {
            const double want = (double)far[b] * (double)through[1][b];
            const double off = 100 * fabs((double)all[0][b] - (double)all[1][b] - want) / most;
            if (off > t.worst) {
                t.worst = off;
                snprintf(t.where, sizeof t.where,
                         "%s, observer %g km, sun zenith %g, azimuth %g, band %d: %.6g above, %.6g below, %.6g beyond",
                         names[a], heights[h], suns[i], azimuths[k], b, (double)all[0][b], (double)all[1][b], want);
            }
        }
        if (n % 4 && !full)
            continue;
        if (heights[h] > 29)
            continue;
        for (int e = 0; e < 2; e++) {
            ray_of(&s, a, GRID, e ? below : above, -1, by_grid[e], through[e]);
            ray_of(&s, a, SINGLE, e ? below : above, -1, once, through[e]);
            for (int b = 0; b < 4; b++)
                by_grid[e][b] -= once[b];
        }
        for (int b = 0; b < 4; b++) {
            const double want = (double)all[0][b] - (double)all[1][b];
            const double off = 100 * fabs((double)by_grid[0][b] - (double)by_grid[1][b] - want) / most;
            if (off > grid.worst) {
                grid.worst = off;
                snprintf(grid.where, sizeof grid.where,
                         "%s, observer %g km, sun zenith %g, azimuth %g, band %d: step %.6g, integrated %.6g", names[a],
                         heights[h], suns[i], azimuths[k], b, (double)by_grid[0][b] - (double)by_grid[1][b], want);
            }
        }
    }
    // 1 % of the sky above the horizon.
    tell(33, "all light: step at the geometric horizon, integrated; grid", 2, (const tally *[]){&t, &grid}, 1);
}

/// No length shows nothing; a longer ray adds light and dims what is behind; without end it is the sky.
static void lengths(void **state) {
    double worst = 0, ends = 0;
    (void)state;
    for (int n = 0; n < 60; n++) {
        const int a = n % TABLES;
        setting s;
        float view[3], sky[4], t[4], near[4], u[4], last[4] = {0}, dimmed[4] = {1, 1, 1, 1};
        begin(&s, a, 97 * halton(n + 1, 2), n % 4 ? 12 * halton(n + 1, 3) : 80);
        direction_of(view, n % 4 ? 180 * halton(n + 1, 5) : 97 + 80 * halton(n + 1, 5), 180 * halton(n + 1, 7));
        ray_of(&s, a, ALL, view, -1, sky, t);
        ray_of(&s, a, ALL, view, INFINITY, near, u);
        for (int b = 0; b < 4; b++)
            ends = fmax(ends, fabs((double)near[b] - (double)sky[b]) + fabs((double)u[b] - (double)t[b]));
        ray_of(&s, a, ALL, view, 0, near, u);
        for (int b = 0; b < 4; b++)
            ends = fmax(ends, (double)near[b] + fabs((double)u[b] - 1));
        for (double d = 1e-3; d < 5000; d *= 1.21) {
            const double most =
                fmax(largest_of((double[4]){(double)sky[0], (double)sky[1], (double)sky[2], (double)sky[3]}, 4), 1e-9);
            ray_of(&s, a, ALL, view, (float)d, near, u);
            for (int b = 0; b < 4; b++) {
                worst = fmax(worst, 100 * ((double)last[b] - (double)near[b]) / most);
                worst = fmax(worst, 100 * ((double)u[b] - (double)dimmed[b]));
            }
            memcpy(last, near, sizeof last);
            memcpy(dimmed, u, sizeof dimmed);
        }
    }
    printf("figure: lengths: 0 and infinity off by %.3g; longest fall of radiance or rise of transmittance %.3g %%\n",
           ends, worst);
    check_at_most("length 0 is nothing, infinity is the sky", ends, 0);
    // Each length has nodes of its own: radiance to the quadrature of the diffuse part.
    check_at_most("fall with the length, %", worst, 0.5);
}

static double zenith_luminance(const setting *s, int a, const skv_colour_matrix *matrix) {
    static const float up[3] = {0, 0, 1};
    float radiance[4], through[4], rgb[3], luminance;
    ray_of(s, a, ALL, up, -1, radiance, through);
    must(skv_colour(matrix, 4, 1, radiance, 0, rgb, 0, &luminance, 0), "skv_colour");
    for (int b = 0; b < 4; b++)
        assert_true(radiance[b] >= 0);
    return (double)luminance;
}

static void twilight(void **state) {
    double rise = -1, bend = 0, at = 0;
    (void)state;
    for (int n = 0; n < 6; n++) {
        const int a = n % TABLES;
        skv_colour_matrix matrix;
        setting s;
        double last[2] = {0, 0};
        must(skv_colour_matrix_for(&matrix, 4, airs[a].atmosphere.wavelength_nm, airs[a].atmosphere.solar_irradiance),
             "skv_colour_matrix_for");
        begin(&s, a, 90, n < 3 ? 0 : 11);
        for (int i = 0; i <= 3237; i++) { // to -18.55 deg
            put_sun(&s, 90 * DEGREE + i * RADIAN);
            const double now = zenith_luminance(&s, a, &matrix);
            if (i > 0)
                rise = fmax(rise, 100 * (now / last[0] - 1));
            if (i > 1 && fabs(now - 2 * last[0] + last[1]) / last[0] > bend)
                bend = fabs(now - 2 * last[0] + last[1]) / last[0], at = -i * RADIAN / DEGREE;
            last[1] = last[0];
            last[0] = now;
        }
    }
    char first[16], text[64];
    printf("figure: twilight, 0 to -18.5 deg: least fall per .0001 rad %.4f %%, steps differ by %.3f %% at most (%.2f "
           "deg)\n",
           -rise, 100 * bend, at);
    snprintf(text, sizeof text, "never rises; steps differ by %s", figure_text(first, 100 * bend));
    table_line(36, "all light: zenith, sun from 0 to -18.5 deg (.0001 rad)", "-", text, "-");
    check_at_most("rise of the zenith, %", rise, 0);
    // The table is linear in logarithms between its columns: slopes bend there, by half of what the sky falls.
    check_at_most("steps differ by, %", 100 * bend, 0.6);
}

/// Dense air: what comes down is no more than what the sun sends, through a horizontal plane and by all orders.
static void energy(void **state) {
    static air dense;
    static float cells[2048];
    double once = 0, all = 0, most = 0;
    static const float turbidities[] = {1, 30, 1000, 10000};
    (void)state;
    for (int n = 0; n < 4; n++) {
        skv_atmosphere gas = air_hazy(4);
        gas.turbidity = turbidities[n];
        fill(gas.albedo, 1, 1, 1, 1);
        air_make(&dense, "dense", gas, 0);
        skv_table *const table = (skv_table *)(void *)cells;
        skv_table_spec spec;
        must(skv_table_spec_for(&spec, &dense.model, SKV_TABLE_SMALL), "skv_table_spec_for");
        must(skv_table_build(table, sizeof cells, work, sizeof work, &dense.model, &spec), "skv_table_build");
        for (int i = 0; i < 4; i++) {
            static const double suns[] = {0, 40, 65, 80};
            for (int h = 0; h < 3; h++) {
                static const float heights[] = {0, 0.8f, 8};
                skv_frame frame;
                float sun[3], radiance[4], diffuse[4], direct[4];
                double sum[4] = {0};
                direction_of(sun, suns[i], 0);
                frame_of(&frame, &dense, NULL, heights[h], sun);
                const float up[3] = {0, 0, 1};
                must(skv_irradiance(&frame, SKV_IRRADIANCE_DIRECT, 1, up, 0, direct, 0), "skv_irradiance");
                for (int k = 0; k < 1600; k++) { // cosine-weighed over the sky
                    float view[3];
                    const skv_rays rays = {view, 0, NULL, 0};
                    const skv_sky sky = {radiance, 0, NULL, 0};
                    direction_of(view, asin(sqrt((k + 0.5) / 1600)) / DEGREE, 360 * halton(k + 1, 2));
                    must(skv_radiance(&frame, 1, &rays, &sky), "skv_radiance");
                    for (int b = 0; b < 4; b++)
                        sum[b] += PI * (double)radiance[b] / 1600;
                }
                must(skv_frame_table(&frame, table), "skv_frame_table");
                must(skv_irradiance(&frame, SKV_IRRADIANCE_DIFFUSE, 1, up, 0, diffuse, 0), "skv_irradiance");
                for (int b = 0; b < 4; b++) {
                    const double e = (double)gas.solar_irradiance[b], in = e * cos(suns[i] * DEGREE);
                    once = fmax(once, 100 * (sum[b] + (double)direct[b]) / in);
                    all = fmax(all, 100 * ((double)diffuse[b] + (double)direct[b]) / in);
                    most = fmax(most, (double)diffuse[b] / e);
                }
            }
        }
    }
    char first[16], second[16], text[64];
    printf(
        "figure: energy: scattered once %.4g %%, all orders over white ground %.4g %% of the sun's; diffuse %.3g E\n",
        once, all, most);
    snprintf(text, sizeof text, "%s once, %s all orders (white ground)", figure_text(first, once),
             figure_text(second, all));
    table_line(9, "turbidity x1 to x10,000: light coming down, % of the sun's", "-", text, "-");
    // Once: what is scattered down is taken from the beam.
    check_at_most("scattered once, % of the sun's", once, 100);
    // All orders between white ground and clouds: light comes down more than once. Plane layers over a white ground
    // give T/T*, beam against diffuse transmittance: 1.5 at most for a sun overhead [vanDeHulst80].
    check_at_most("all orders, % of the sun's", all, 150);
}

static int make_tables(void **state) {
    (void)state;
    full = getenv("EXTREMES_FULL") != NULL;
    wide = full ? 1 : 20;
    build(0, air_clear(4), names[0]);
    build(1, air_hazy(4), names[1]);
    build(2, air_smoky(4), names[2]);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(smooth), cmocka_unit_test(horizon), cmocka_unit_test(lengths),
                                       cmocka_unit_test(twilight), cmocka_unit_test(energy)};
    return cmocka_run_group_tests(tests, make_tables, NULL);
}
