/// The moon as a light, optional, once per frame: irradiance per band by phase and distance, and its colour.
///
///     side = skv_moon_side(moon.direction_enu, sun.direction_enu, position.lat_deg);
///     skv_light_moon(&lights[1], &model, &moon, sun.distance_au, side);
///     skv_frame_begin(&frame, &model, &quality, height, ground, lights, 2);
#ifndef SKYVERT_MOONLIGHT_H
#define SKYVERT_MOONLIGHT_H

#include "skyvert/frame.h"
#include "skyvert/sun.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct skv_moonlight {
    float irradiance[4];   ///< above the air, on a plane facing the moon, in the units of the model's solar irradiance
    float earthshine[4];   ///< radiance of the moon's dark side, the same units per sr
    float phase_angle_deg; ///< sun-moon-observer, [0, 180]
    float radius_rad;      ///< angular, of the moon's disc
} skv_moonlight;

/// Light of the moon and of its dark side. Eclipses are not modelled: within 0.9 deg of phase angle 0 the moon is in
/// the Earth's shadow, and the caller decides.
/// @param[out] moonlight
/// @param[in]  model            wavelengths, and the solar irradiance: that of the sun at 1 au, as skv_light_sun()
/// takes
///                              it. With an irradiance of 1 the moon's comes out as a fraction of the sun's.
/// @param[in]  moon             from skv_moon_at(): phase angle and distance are read.
/// @param[in]  sun_distance_au  from skv_sun_at(), [0.9, 1.1]; 1 where the sun's light is not scaled by it either.
/// @param[in]  side             +1 waxing, -1 waning (skv_moon_side()), 0: the mean. A waxing half moon is .14 mag
///                              brighter, its maria being fewer.
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_LAYOUT; SKV_ERR_RANGE iff a parameter is out of range or NaN (distance 3000 to
///         1e7 km). On error nothing is written.
/// Source: albedo of the disc by the ROLO model [Kieffer05] eq. 10, 32 bands from 350 to 2384 nm, libration 0, a local
///         line through its bands, which scatter by 3 %, over some 30 nm; fitted to phase angles 1.55 to 97 deg, used
///         as it is down to 0 (the surge saturates). From 97 to 115 deg it goes over to the magnitude law of [Allen73],
///         0.026 g + 4e-9 g^4, which is good to some 150 deg; from there to 180 deg it is led to 0. Chosen over
///         [Krisciunas91] (that law with an opposition surge of 1.35 within 7 deg) because it gives the colour: the
///         moon is redder than the sun by 1.4 from 445 to 630 nm. Earthshine: a Lambert sphere of Bond albedo .297
///         [Goode01].
/// Error:  ROLO's own: 5 to 10 % absolute, 1 % relative within its range. V is within .13 mag of [Krisciunas91] from 0
///         to 150 deg, and its phase law within .08 mag of [Allen73]'s table from 10 deg on
///         (tests/scene/test_moonlight.c).
/// Cost:   14,000 instructions, once a frame; stack <= 200 bytes, no allocation.
skv_status skv_moonlight_at(skv_moonlight *moonlight, const skv_model *model, const skv_moon *moon,
                            float sun_distance_au, int side);

/// The moon as a light: its direction and skv_moonlight_at()'s irradiance.
/// @return as skv_moonlight_at(); SKV_ERR_DIRECTION iff the moon's direction is zero or not finite.
skv_status skv_light_moon(skv_light *light, const skv_model *model, const skv_moon *moon, float sun_distance_au,
                          int side);

/// The disc-equivalent albedo of the moon: irradiance = albedo * solar irradiance there * sin^2(angular radius).
/// @param[in] wavelength_nm    [200, 3000]; beyond 350 to 2384 as at the end.
/// @param[in] phase_angle_deg  [0, 180].
/// @param[in] side             as skv_moonlight_at().
/// @return the albedo, [0, 1]; 0 for a parameter out of range or NaN.
float skv_moon_albedo(float wavelength_nm, float phase_angle_deg, int side);

/// Whether the moon waxes: it is east of the sun along the way both go.
/// @param[in] moon_enu, sun_enu  directions, any length but 0.
/// @param[in] lat_deg            of the observer, [-90, 90].
/// @return +1 waxing, -1 waning; 0 for a direction that is none or a latitude out of range.
int skv_moon_side(const float moon_enu[3], const float sun_enu[3], float lat_deg);

#ifdef __cplusplus
}
#endif
#endif
