/// The discs of the sun and the moon, optional, per vertex or pixel: limb darkening, phase, soft edge, colour through
/// the air.
///
///     skv_radiance(&frame, n, &rays, &sky);        with sky.transmittance
///     skv_disc_sun(&disc, &model, &light, sun.distance_au, pixel_rad);
///     skv_disc_add(&disc, &frame, n, &rays, &sky); adds disc x transmittance to sky.radiance
#ifndef SKYVERT_DISC_H
#define SKYVERT_DISC_H

#include "skyvert/moonlight.h"
#include "skyvert/radiance.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Widest spacing of samples that a disc is spread over, rad.
#define SKV_DISC_SAMPLE_MAX 0.5f

/// Derived: a disc above the air. Angular distances are chords on the unit sphere, 2 sin(angle/2).
typedef struct skv_disc {
    int32_t bands;
    int32_t moon;           ///< 0: the sun
    float direction_enu[3]; ///< of the centre, unit; apparent after skv_disc_refract()
    float right_enu[3];     ///< unit, across the line of sight; the moon's toward its bright limb, the sun's level
    float up_enu[3];        ///< unit, across both; vertical for the sun
    float zenith_enu[3];    ///< unit, across the line of sight, in its vertical plane: what refraction squeezes
    float squeeze;          ///< horizontal over vertical radius; 1 without refraction
    float radius;           ///< of the disc
    float edge[2];          ///< the soft edge, inner and outer
    float even;             ///< share of an even disc: coarse samples do not show the limb darkening or the phase
    float level[4];         ///< radiance of an even disc, W m^-2 sr^-1 nm^-1
    float limb[4][6];       ///< sun: coefficients of mu^0 to mu^5, relative to the disc's mean; moon: [0][0], [0][1]
                            ///< are cos and sin of the phase angle, [0][2] scales its shape to mean 1
    float dark[4];          ///< moon: earthshine
} skv_disc;

/// The sun's disc. Its radiance is such that its integral over the disc is the light's irradiance.
/// @param[out] disc
/// @param[in]  model        wavelengths and absorption colour.
/// @param[in]  light        direction and irradiance, as it goes to skv_frame_begin().
/// @param[in]  distance_au  sets the angular radius (0.2666 deg at 1 au), [0.01, 100]; the irradiance is the light's.
/// @param[in]  sample_rad   angle between neighbouring pixels or vertices, [0, SKV_DISC_SAMPLE_MAX]; 0 = sharp. The
///                          edge is as wide as a sample; where samples are coarser than the disc it grows to three, and
///                          the light is spread: on any even grid of that spacing the sum of radiance times solid angle
///                          stays within 4 % (20 pixels a disc: .5 %) of the light's irradiance, wherever the disc
///                          lies.
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_LAYOUT; SKV_ERR_DIRECTION (of the light); SKV_ERR_RANGE. On error nothing is
///         written.
/// Source: limb darkening of [Neckel05], polynomials of degree 5 for 300 to 1100 nm (beyond, as at the end; linear
///         across the Balmer jump, 373 to 385 nm), which follow the measurements of [Neckel94] within .013 of the
///         centre (.024 at the Balmer jump), .004 rms; the power law of [Hestroffer98] was tried: .085, .026 rms.
///         Radius [Prsa16].
/// Error:  integral 1e-4. Measured by tests/scene/test_disc.c.
/// Cost:   9,000 instructions, once a frame; stack <= 400 bytes, no allocation.
skv_status skv_disc_sun(skv_disc *disc, const skv_model *model, const skv_light *light, float distance_au,
                        float sample_rad);

/// The moon's disc, lit from where the sun is: the terminator lies right, the bright limb faces the sun. The shape is
/// Lommel and Seeliger's law mu0/(mu0 + mu), which makes the full moon flat as it is; the maria are left to a texture.
/// The dark side shows earthshine. Nothing of the crescent is left where the moon is within 3 deg of the sun.
/// @param[out] disc
/// @param[in]  model
/// @param[in]  moonlight   from skv_moonlight_at().
/// @param[in]  moon_enu    toward the moon, any length.
/// @param[in]  sun_enu     toward the sun, any length; only its side of the moon matters.
/// @param[in]  sample_rad  as skv_disc_sun().
/// @return as skv_disc_sun(); SKV_ERR_RANGE also iff a field of moonlight is out of range.
/// Source: [Hapke63] for the law; its phase integral 1 - sin(g/2) tan(g/2) ln cot(g/4) is tested against.
/// Error:  integral 1e-3, shape .2 % of the lit limb, up to a phase angle of 150 deg.
/// Cost:   43,000 instructions, once a frame; stack <= 1 KiB, no allocation.
skv_status skv_disc_moon(skv_disc *disc, const skv_model *model, const skv_moonlight *moonlight,
                         const float moon_enu[3], const float sun_enu[3], float sample_rad);

/// Lifts a disc by refraction and flattens it by the refraction's slope (the sun on the horizon is 5/6 as high as
/// wide). The radiance stays, the area and with it the light shrink. Call it once, after skv_disc_sun() or
/// skv_disc_moon(); the sky of straight rays is lit from where the light is without refraction.
/// @param[in,out] disc
/// @param[in]  pressure_hpa   at the observer, [0, 2000].
/// @param[in]  temperature_c  at the observer, [-100, 100].
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_RANGE. On error nothing is changed.
/// Source: skv_refraction_deg().
skv_status skv_disc_refract(skv_disc *disc, float pressure_hpa, float temperature_c);

/// Adds a disc, seen through the air, to the radiance of n rays. Rays that meet the ground or have an end of their own
/// get nothing.
/// @param[in]     disc
/// @param[in]     frame  of the skv_radiance() that filled sky.
/// @param[in]     n
/// @param[in]     rays
/// @param[in,out] sky    transmittance is read (NULL: 1, as in space), radiance is added to; finite and >= 0 after it.
/// @return as skv_radiance(); rays that it refuses keep what they have. SKV_ERR_RANGE iff the disc has another number
///         of bands than the frame, or was not made.
/// Cost:   80 instructions a ray, 430 where it meets the disc (scalar x86-64). Thread-safe. No allocation.
skv_status skv_disc_add(const skv_disc *disc, const skv_frame *frame, size_t n, const skv_rays *rays,
                        const skv_sky *sky);

#ifdef __cplusplus
}
#endif
#endif
