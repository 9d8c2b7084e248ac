/// flight > dusk-lszh-loww.csv: the project's sample flight, an evening from Zurich to Vienna.
///
/// The way is one geodesic of WGS 84 between the two aerodrome reference points. Along it, ground speed and vertical
/// speed go through the knots of a table, by smoothsteps between knots: accelerations are continuous and every distance
/// and height is a closed form. Three unknowns close it: the climb is scaled to reach the cruise height, the descent to
/// end on the destination, and the cruise lasts until the distances add up.
///
/// Airports: aerodrome reference point and elevation as published in the AIPs of Switzerland (LSZH AD 2.2) and Austria
/// (LOWW AD 2.2); the same in the public-domain table of OurAirports.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "port/geographiclib/skv_geo.h"

typedef struct {
    const char *reference_point;
    double elevation_m; ///< above the sea
} airport;

static const airport from = {"47:27:29N 8:32:53E", 432}; // LSZH
static const airport to = {"48:06:37N 16:34:11E", 183};  // LOWW

// 20 March 2024: the sun stands 6 deg high at the start, and 9 deg below the horizon at the end.
static const char *const date = "2024-03-20";
static const int start_s = 16 * 3600 + 59 * 60; ///< seconds of that day, UTC
static const int every_s = 10;
static const double cruise_m = 11278; ///< 37,000 ft
static const double stand_s = 30;     ///< on the runway before and after

typedef struct {
    double duration_s;
    double ground_speed_mps, vertical_speed_mps; ///< at the end of the leg; climb and descent get scaled
} leg;

static const leg climb[] = {
    {45, 78, 0},     // take-off run, 1.7 m/s2
    {15, 88, 11},    // rotation
    {120, 125, 12},  // clean up
    {360, 190, 10},  // climb, the air gets thinner
    {420, 225, 6.5}, //
    {300, 232, 3},   //
    {80, 236, 0},    // level off
};
static const leg descent[] = {
    {60, 232, -7},    // top of descent
    {480, 215, -10},  //
    {360, 150, -8.5}, // below 10,000 ft at 250 kt and slower
    {240, 100, -6},   // approach
    {200, 73, -3.8},  // final approach, 3 deg
    {60, 70, -3.7},   //
    {9, 67, 0},       // flare
    {45, 0, 0},       // landing run
};
enum { CLIMB = sizeof climb / sizeof climb[0], DESCENT = sizeof descent / sizeof descent[0] };

typedef struct {
    double way_m, height_m, speed_mps, vertical_mps;
} state;

/// Integral of the smoothstep 3u^2 - 2u^3 from 0 to u, u in [0, 1].
static double ramp(double u) {
    return u * u * u * (1 - u / 2);
}

/// Moves s by t <= the leg's duration along the leg; vertical speeds are scaled.
static state fly(state s, const leg *l, double scale, double t) {
    const double u = t / l->duration_s, step = u * u * (3 - 2 * u);
    const double dv = l->ground_speed_mps - s.speed_mps, dw = scale * l->vertical_speed_mps - s.vertical_mps;
    s.way_m += s.speed_mps * t + dv * l->duration_s * ramp(u);
    s.height_m += s.vertical_mps * t + dw * l->duration_s * ramp(u);
    s.speed_mps += dv * step;
    s.vertical_mps += dw * step;
    return s;
}

/// What a row of legs does in t seconds; *rest is the time left after them.
static state fly_legs(state s, const leg *legs, int n, double scale, double t, double *rest) {
    for (int i = 0; i < n && t > 0; i++) {
        const double part = fmin(t, legs[i].duration_s);
        s = fly(s, &legs[i], scale, part);
        t -= part;
    }
    *rest = t;
    return s;
}

typedef struct {
    double climb_scale, descent_scale, cruise_s, total_s;
} plan;

static plan make_plan(double distance_m) {
    const double ages = 1e9;
    const state level = {0, 0, climb[CLIMB - 1].ground_speed_mps, 0};
    double climb_rest, descent_rest;
    const state up = fly_legs((state){0, 0, 0, 0}, climb, CLIMB, 1, ages, &climb_rest);
    const state down = fly_legs(level, descent, DESCENT, 1, ages, &descent_rest);
    plan p;
    p.climb_scale = (cruise_m - from.elevation_m) / up.height_m;
    p.descent_scale = (to.elevation_m - cruise_m) / down.height_m;
    p.cruise_s = (distance_m - up.way_m - down.way_m) / level.speed_mps;
    p.total_s = stand_s + (ages - climb_rest) + p.cruise_s + (ages - descent_rest) + stand_s;
    return p;
}

static state at(const plan *p, double t) {
    state s = {0, from.elevation_m, 0, 0};
    t -= stand_s;
    if (t <= 0)
        return s;
    s = fly_legs(s, climb, CLIMB, p->climb_scale, t, &t);
    const double cruise = fmin(t, p->cruise_s);
    s.way_m += s.speed_mps * cruise;
    return fly_legs(s, descent, DESCENT, p->descent_scale, t - cruise, &t);
}

static int fail(const char *what) {
    fprintf(stderr, "flight: %s\n", what);
    return 1;
}

static int put_row(int t, const state *s, double lat_deg, double lon_deg) {
    const int now = start_s + t;
    return printf("%sT%02d:%02d:%02dZ,%.6f,%.6f,%.1f\n", date, now / 3600, now / 60 % 60, now % 60, lat_deg, lon_deg,
                  s->height_m) > 0;
}

int main(void) {
    double lat1, lon1, lat2, lon2;
    skv_geo_way way;
    if (skv_geo_parse(from.reference_point, &lat1, &lon1, NULL, 0) != SKV_OK ||
        skv_geo_parse(to.reference_point, &lat2, &lon2, NULL, 0) != SKV_OK ||
        skv_geo_inverse(lat1, lon1, lat2, lon2, &way) != SKV_OK)
        return fail("an airport's position cannot be read");
    const plan p = make_plan(way.distance_m);
    if (!(p.cruise_s > 0))
        return fail("the airports are too near for this climb and descent");
    int ok = puts("utc,lat_deg,lon_deg,height_m") >= 0;
    for (int t = 0; ok && t < p.total_s + every_s; t += every_s) {
        const state s = at(&p, t);
        double lat, lon, course;
        if (skv_geo_direct(lat1, lon1, way.azimuth1_deg, s.way_m, &lat, &lon, &course) != SKV_OK)
            return fail("no position on the way");
        ok = put_row(t, &s, lat, lon);
    }
    return ok && fflush(stdout) == 0 ? 0 : fail("writing failed");
}
