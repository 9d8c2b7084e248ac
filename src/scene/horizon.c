/// From the ecliptic of date to the observer's horizon.
#include "scene/ephemeris.h"

/// WGS84 [NGA14]: equatorial radius and first eccentricity squared.
#define WGS84_A_KM 6378.137f
#define WGS84_E2   0.00669437999f
/// Speed of the equator over that of light: the diurnal aberration, 0.32 arc seconds. At any height the ground's is
/// taken: what flies does not turn with the Earth.
#define EQUATOR_SPEED 1.5508e-6f

#define HEIGHT_MIN_KM (-12.0f)
#define HEIGHT_MAX_KM 1.0e6f

/// Nutation by its five largest terms (0.3 arc seconds) [Meeus98] ch. 22, with the mean obliquity of [Petit10]
/// eq. 5.40.
skv_equator skv_equator_at(const skv_instant *instant) {
    const skv_turn node = skv_linear_at(SKV_MOON_NODE, instant);
    const skv_sincos n1 = skv_sincos_of_turn(node);
    const skv_sincos n2 = skv_sincos_of_turn(2u * node);
    const skv_sincos sun2 = skv_sincos_of_turn(2u * skv_linear_at(SKV_EARTH_LONGITUDE, instant));
    const skv_sincos moon2 = skv_sincos_of_turn(2u * skv_linear_at(SKV_MOON_LONGITUDE, instant));
    const skv_sincos anomaly = skv_sincos_of_turn(skv_linear_at(SKV_SUN_ANOMALY, instant));
    const float psi =
        -17.1996f * n1.sin - 1.3187f * sun2.sin - 0.2274f * moon2.sin + 0.2062f * n2.sin + 0.1426f * anomaly.sin;
    const float epsilon = 9.2025f * n1.cos + 0.5736f * sun2.cos + 0.0977f * moon2.cos - 0.0895f * n2.cos;
    const float drift = (epsilon - 46.836769f * instant->centuries) * (SKV_RAD_PER_ARCSEC * SKV_TURN_PER_RAD);
    const skv_turn at_j2000 = 279641496u; // 84381.406 arc seconds
    return (skv_equator){psi * SKV_RAD_PER_ARCSEC, skv_sincos_of_turn(at_j2000 + skv_turn_from_units(drift))};
}

static int is_position(const skv_position *p) {
    return p->lat_deg >= -90.0f && p->lat_deg <= 90.0f && p->lon_deg >= -360.0f && p->lon_deg <= 360.0f &&
           p->height_km >= HEIGHT_MIN_KM && p->height_km <= HEIGHT_MAX_KM;
}

/// With W = sqrt(1 - e^2 sin^2 lat) the observer's geocentric vector along the geodetic axes is exactly
/// north = -a e^2 sin lat cos lat / W, up = a W + h.
skv_status skv_horizon_at(skv_horizon *horizon, const skv_instant *instant, const skv_position *position) {
    if (!is_position(position))
        return SKV_ERR_RANGE;
    const skv_equator equator = skv_equator_at(instant);
    const float equinoxes = equator.nutation_rad * equator.obliquity.cos * SKV_TURN_PER_RAD;
    const skv_turn sidereal = skv_linear_at(SKV_SIDEREAL, instant) + skv_turn_from_units(equinoxes);
    const skv_sincos lat = skv_sincos_of_turn(skv_turn_from_deg(position->lat_deg));
    const float w = skv_sqrtf(1.0f - WGS84_E2 * (lat.sin * lat.sin));
    horizon->equator = equator;
    horizon->sidereal = skv_sincos_of_turn(sidereal + skv_turn_from_deg(position->lon_deg));
    horizon->latitude = lat;
    horizon->north_km = -WGS84_A_KM * WGS84_E2 * lat.sin * lat.cos / w;
    horizon->up_km = WGS84_A_KM * w + position->height_km;
    return SKV_OK;
}

/// Ecliptic -> true equator (about the equinox) -> meridian (about the pole) -> horizon (about east), then from the
/// Earth's centre to the observer.
skv_topocentric skv_to_horizon(const skv_horizon *horizon, const skv_ecliptic *body) {
    const skv_turn nutation = skv_turn_from_units(horizon->equator.nutation_rad * SKV_TURN_PER_RAD);
    const skv_sincos lon = skv_sincos_of_turn(body->longitude + nutation);
    const skv_sincos lat = skv_sincosf(body->latitude_rad);
    const skv_sincos eps = horizon->equator.obliquity;
    const float x = lat.cos * lon.cos;
    const float y = lat.cos * lon.sin * eps.cos - lat.sin * eps.sin;
    const float z = lat.cos * lon.sin * eps.sin + lat.sin * eps.cos;
    const skv_sincos st = horizon->sidereal;
    const float east = y * st.cos - x * st.sin + EQUATOR_SPEED * horizon->latitude.cos;
    const float out = x * st.cos + y * st.sin;
    const skv_sincos phi = horizon->latitude;
    const float d = body->distance_km;
    skv_topocentric t = {{d * east, d * (z * phi.cos - out * phi.sin) - horizon->north_km,
                          d * (out * phi.cos + z * phi.sin) - horizon->up_km},
                         0.0f};
    const float *v = t.enu_km;
    t.distance_km = skv_sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    return t;
}

void skv_unit_enu(float direction_enu[3], const skv_topocentric *body) {
    for (int i = 0; i < 3; i++)
        direction_enu[i] = body->enu_km[i] / body->distance_km;
}

float skv_azimuth_deg(const float direction_enu[3]) {
    const float azimuth = skv_atan2f(direction_enu[0], direction_enu[1]) * SKV_DEG_PER_RAD;
    const float turned = azimuth < 0.0f ? azimuth + 360.0f : azimuth;
    return turned < 360.0f ? turned : 0.0f;
}

/// By arc tangent: an arc sine loses 0.02 deg near the zenith.
float skv_elevation_deg(const float direction_enu[3]) {
    const float e = direction_enu[0], n = direction_enu[1];
    const float elevation = skv_atan2f(direction_enu[2], skv_sqrtf(e * e + n * n)) * SKV_DEG_PER_RAD;
    return skv_clampf(elevation, -90.0f, 90.0f);
}
