/// Moon: the largest periodic terms of [Meeus98] ch. 47, which is ELP-2000/82 [Chapront83] truncated.
/// Error: see skv_moon_at(); measured by tests/scene/test_ephemeris.c.
#include <stddef.h>

#include "scene/ephemeris.h"

/// Multiples of D, M, M', F, then the amplitudes.
typedef struct in_plane_term {
    int8_t d, m, a, f;
    float longitude; ///< 1e-6 deg, of the sine
    float distance;  ///< 1e-3 km, of the cosine
} in_plane_term;

typedef struct latitude_term {
    int8_t d, m, a, f;
    float latitude; ///< 1e-6 deg, of the sine
} latitude_term;

/// Longitude over 0.0011 deg, distance over 10 km.
static const in_plane_term in_plane[] = {
    {0, 0, 1, 0, 6288774.0f, -20905355.0f}, {2, 0, -1, 0, 1274027.0f, -3699111.0f},
    {2, 0, 0, 0, 658314.0f, -2955968.0f},   {0, 0, 2, 0, 213618.0f, -569925.0f},
    {0, 1, 0, 0, -185116.0f, 48888.0f},     {0, 0, 0, 2, -114332.0f, -3149.0f},
    {2, 0, -2, 0, 58793.0f, 246158.0f},     {2, -1, -1, 0, 57066.0f, -152138.0f},
    {2, 0, 1, 0, 53322.0f, -170733.0f},     {2, -1, 0, 0, 45758.0f, -204586.0f},
    {0, 1, -1, 0, -40923.0f, -129620.0f},   {1, 0, 0, 0, -34720.0f, 108743.0f},
    {0, 1, 1, 0, -30383.0f, 104755.0f},     {2, 0, 0, -2, 15327.0f, 10321.0f},
    {0, 0, 1, 2, -12528.0f, 0.0f},          {0, 0, 1, -2, 10980.0f, 79661.0f},
    {4, 0, -1, 0, 10675.0f, -34782.0f},     {0, 0, 3, 0, 10034.0f, -23210.0f},
    {4, 0, -2, 0, 8548.0f, -21636.0f},      {2, 1, -1, 0, -7888.0f, 24208.0f},
    {2, 1, 0, 0, -6766.0f, 30824.0f},       {1, 0, -1, 0, -5163.0f, -8379.0f},
    {1, 1, 0, 0, 4987.0f, -16675.0f},       {2, -1, 1, 0, 4036.0f, -12831.0f},
    {2, 0, 2, 0, 3994.0f, -10445.0f},       {4, 0, 0, 0, 3861.0f, -11650.0f},
    {2, 0, -3, 0, 3665.0f, 14403.0f},       {0, 1, -2, 0, -2689.0f, -7003.0f},
    {2, 0, -1, 2, -2602.0f, 0.0f},          {2, -1, -2, 0, 2390.0f, 10056.0f},
    {1, 0, 1, 0, -2348.0f, 6322.0f},        {2, -2, 0, 0, 2236.0f, -9884.0f},
    {0, 1, 2, 0, -2120.0f, 5751.0f},        {0, 2, 0, 0, -2069.0f, 0.0f},
    {2, -2, -1, 0, 2048.0f, -4950.0f},      {2, 0, 1, -2, -1773.0f, 4130.0f},
    {2, 0, 0, 2, -1595.0f, 0.0f},           {4, -1, -1, 0, 1215.0f, -3958.0f},
    {0, 0, 2, 2, -1110.0f, 0.0f},
};

/// Latitude over 0.001 deg.
static const latitude_term off_plane[] = {
    {0, 0, 0, 1, 5128122.0f}, {0, 0, 1, 1, 280602.0f},  {0, 0, 1, -1, 277693.0f}, {2, 0, 0, -1, 173237.0f},
    {2, 0, -1, 1, 55413.0f},  {2, 0, -1, -1, 46271.0f}, {2, 0, 0, 1, 32573.0f},   {0, 0, 2, 1, 17198.0f},
    {2, 0, 1, -1, 9266.0f},   {0, 0, 2, -1, 8822.0f},   {2, -1, 0, -1, 8216.0f},  {2, 0, -2, -1, 4324.0f},
    {2, 0, 1, 1, 4200.0f},    {2, 1, 0, -1, -3359.0f},  {2, -1, -1, 1, 2463.0f},  {2, -1, 0, 1, 2211.0f},
    {2, -1, -1, -1, 2065.0f}, {0, 1, -1, -1, -1870.0f}, {4, 0, -1, -1, 1828.0f},  {0, 1, 0, 1, -1794.0f},
    {0, 0, 0, 3, -1749.0f},   {0, 1, -1, 1, -1565.0f},  {1, 0, 0, 1, -1491.0f},   {0, 1, 1, 1, -1475.0f},
    {0, 1, 1, -1, -1410.0f},  {0, 1, 0, -1, -1344.0f},  {1, 0, 0, -1, -1335.0f},  {0, 0, 3, 1, 1107.0f},
    {4, 0, 0, -1, 1021.0f},
};

#define COUNT(a) ((int)(sizeof(a) / sizeof((a)[0])))

/// Mean radius [Archinal18]; an observer this near would be inside.
#define MOON_RADIUS_KM 1737.4f

typedef struct delaunay {
    skv_turn d, m, a, f;
    float e[3]; ///< E^|m|: the eccentricity of the Earth's orbit
} delaunay;

static delaunay delaunay_at(const skv_instant *instant) {
    const float t = instant->centuries;
    const float e = 1.0f - 0.002516f * t - 0.0000074f * (t * t);
    return (delaunay){skv_linear_at(SKV_MOON_ELONGATION, instant),
                      skv_linear_at(SKV_SUN_ANOMALY, instant),
                      skv_linear_at(SKV_MOON_ANOMALY, instant),
                      skv_linear_at(SKV_MOON_LATITUDE, instant),
                      {1.0f, e, e * e}};
}

static skv_sincos argument_of(const delaunay *x, int d, int m, int a, int f) {
    return skv_sincos_of_turn((skv_turn)d * x->d + (skv_turn)m * x->m + (skv_turn)a * x->a + (skv_turn)f * x->f);
}

static float eccentricity_of(const delaunay *x, int m) {
    return x->e[m < 0 ? -m : m];
}

static float sin_of(skv_turn turn) {
    return skv_sincos_of_turn(turn).sin;
}

/// 1e-6 deg.
static float latitude_sum(const delaunay *x, const skv_instant *instant) {
    const skv_turn longitude = skv_linear_at(SKV_MOON_LONGITUDE, instant);
    float sum = 382.0f * sin_of(skv_linear_at(SKV_MOON_A3, instant)) - 2235.0f * sin_of(longitude) +
                127.0f * sin_of(longitude - x->a) - 115.0f * sin_of(longitude + x->a);
    for (int i = COUNT(off_plane) - 1; i >= 0; i--) {
        const latitude_term *t = &off_plane[i];
        sum += t->latitude * eccentricity_of(x, t->m) * argument_of(x, t->d, t->m, t->a, t->f).sin;
    }
    return sum;
}

static skv_ecliptic moon_ecliptic(const skv_instant *instant) {
    const delaunay x = delaunay_at(instant);
    const skv_turn mean = skv_linear_at(SKV_MOON_LONGITUDE, instant);
    float longitude = 3958.0f * sin_of(skv_linear_at(SKV_VENUS_A1, instant)) + 1962.0f * sin_of(mean - x.f) +
                      318.0f * sin_of(skv_linear_at(SKV_JUPITER_A2, instant));
    float distance = 0.0f;
    for (int i = COUNT(in_plane) - 1; i >= 0; i--) { // smallest first
        const in_plane_term *t = &in_plane[i];
        const skv_sincos c = argument_of(&x, t->d, t->m, t->a, t->f);
        const float e = eccentricity_of(&x, t->m);
        longitude += t->longitude * e * c.sin;
        distance += t->distance * e * c.cos;
    }
    return (skv_ecliptic){mean + skv_turn_from_units(longitude * (1e-6f * SKV_TURN_PER_DEG)),
                          latitude_sum(&x, instant) * (1e-6f * SKV_RAD_PER_DEG), 385000.56f + distance * 1e-3f};
}

/// At the moon, between the sun and the observer. By the arc tangent and without a difference near full or new moon:
/// an arc cosine would be 0.03 deg off there.
static void set_phase(skv_moon *moon, const skv_topocentric *m, const skv_topocentric *s) {
    float u[3], v[3]; // from the moon to the sun, to the observer; the sun's distance is the unit of the first
    for (int i = 0; i < 3; i++) {
        u[i] = (s->enu_km[i] - m->enu_km[i]) / s->distance_km;
        v[i] = -moon->direction_enu[i];
    }
    const float x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2], z = u[0] * v[1] - u[1] * v[0];
    const float across = skv_sqrtf(x * x + y * y + z * z);
    const float along = u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    const float half = 0.5f * skv_atan2f(across, along);
    moon->phase_angle_deg = skv_clampf(2.0f * half * SKV_DEG_PER_RAD, 0.0f, 180.0f);
    const float c = skv_cosf(half);
    moon->illuminated_fraction = skv_clampf(c * c, 0.0f, 1.0f);
}

skv_status skv_moon_at(skv_moon *moon, const skv_utc *utc, const skv_position *position) {
    if (moon == NULL || utc == NULL || position == NULL)
        return SKV_ERR_NULL;
    skv_instant instant;
    skv_horizon horizon;
    if (skv_instant_from_utc(&instant, utc) != SKV_OK || skv_horizon_at(&horizon, &instant, position) != SKV_OK)
        return SKV_ERR_RANGE;
    const skv_ecliptic place = moon_ecliptic(&instant);
    const skv_ecliptic sun_place = skv_sun_ecliptic(&instant);
    const skv_topocentric seen = skv_to_horizon(&horizon, &place);
    const skv_topocentric sun = skv_to_horizon(&horizon, &sun_place);
    if (seen.distance_km < MOON_RADIUS_KM)
        return SKV_ERR_RANGE;
    skv_unit_enu(moon->direction_enu, &seen);
    moon->azimuth_deg = skv_azimuth_deg(moon->direction_enu);
    moon->elevation_deg = skv_elevation_deg(moon->direction_enu);
    moon->distance_km = seen.distance_km;
    set_phase(moon, &seen, &sun);
    return SKV_OK;
}
