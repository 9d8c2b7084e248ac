/// Sun. Error: see skv_sun_at(); measured by tests/scene/test_ephemeris.c.
#include <stddef.h>

#include "scene/ephemeris.h"

/// Opposite to the Earth's heliocentric place [Bretagnon88], whose latitude (1.2 arc seconds) is left out.
skv_ecliptic skv_sun_ecliptic(const skv_instant *instant) {
    const float l = skv_harmonics_at(skv_earth_longitude, SKV_EARTH_LONGITUDE_TERMS, instant);
    const float r = 1.00013989f + skv_harmonics_at(skv_earth_distance, SKV_EARTH_DISTANCE_TERMS, instant);
    const skv_turn opposite = skv_linear_at(SKV_EARTH_LONGITUDE, instant) + 0x80000000u;
    return (skv_ecliptic){opposite + skv_turn_from_units(l * SKV_TURN_PER_RAD), 0.0f, r * SKV_AU_KM};
}

/// The constant of aberration over the distance [Meeus98] ch. 25: the Earth's motion and the light time in one.
static skv_turn aberration(float distance_km) {
    return skv_turn_from_units(-20.4898f * SKV_RAD_PER_ARCSEC * SKV_TURN_PER_RAD * SKV_AU_KM / distance_km);
}

skv_status skv_sun_at(skv_sun *sun, const skv_utc *utc, const skv_position *position) {
    if (sun == NULL || utc == NULL || position == NULL)
        return SKV_ERR_NULL;
    skv_instant instant;
    skv_horizon horizon;
    if (skv_instant_from_utc(&instant, utc) != SKV_OK || skv_horizon_at(&horizon, &instant, position) != SKV_OK)
        return SKV_ERR_RANGE;
    skv_ecliptic place = skv_sun_ecliptic(&instant);
    place.longitude += aberration(place.distance_km);
    const skv_topocentric seen = skv_to_horizon(&horizon, &place);
    skv_unit_enu(sun->direction_enu, &seen);
    sun->azimuth_deg = skv_azimuth_deg(sun->direction_enu);
    sun->elevation_deg = skv_elevation_deg(sun->direction_enu);
    sun->distance_au = seen.distance_km / SKV_AU_KM;
    return SKV_OK;
}
