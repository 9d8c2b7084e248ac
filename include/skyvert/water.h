/// Water, optional, per vertex: what the sea reflects of the sky and of the sun, flat or rough, over a curved planet.
///
///     skv_water_wind(&water, 5.0f, 270.0f);                       or skv_water_flat(&water)
///     skv_radiance(&frame, n, &rays, &sky);                       with sky.transmittance; the rays that meet the
///     ground skv_water_mirror(&water, &frame, n, &rays, hits);           where each ray goes, and how much of it
///     skv_radiance(&at_sea, n, hits' local_enu, mirrored);        at_sea: a frame at height 0 with the same lights
///     skv_water_add(&frame, n, hits, mirrored, 0, &sky);          adds F x sky x transmittance
///     skv_water_glint(&water, &frame, 0, through_air, n, &rays, &sky);   adds the sun's glitter
///
/// Begin the frame without SKV_WITH_GROUND, or with the albedo of what comes out of the water (.02 to .05 in the blue).
#ifndef SKYVERT_WATER_H
#define SKYVERT_WATER_H

#include "skyvert/radiance.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Fastest wind of skv_water_wind(), m/s.
#define SKV_WIND_MAX 40.0f

/// Surface of the water: Gaussian slopes.
typedef struct skv_water {
    float refractive_index; ///< [1.01, 3]; 1.333 (1.344 at 400 nm, 1.330 at 700 nm in pure water, .006 more in the sea)
    float slope2_along;     ///< mean square slope along the wind, [0, 0.25]
    float slope2_across;    ///< and across it, [0, 0.25]; both 0: flat
    float wind_azimuth_deg; ///< of the wind's line, clockwise from north, [-360, 360]; either end
} skv_water;

/// A mirror of index 1.333.
/// @return SKV_OK; SKV_ERR_NULL.
skv_status skv_water_flat(skv_water *water);

/// A sea under wind.
/// @param[out] water
/// @param[in]  wind_m_s          at 12.5 m above the sea, [0, SKV_WIND_MAX]; measured to 14, linear beyond.
/// @param[in]  wind_azimuth_deg  [-360, 360].
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_RANGE. On error nothing is written.
/// Source: [Cox54]: mean square slopes .00316 W along the wind (at least 1e-4), .003 + .00192 W across it.
skv_status skv_water_wind(skv_water *water, float wind_m_s, float wind_azimuth_deg);

/// Reflectance of a flat surface for unpolarised light, exact. Source: Fresnel's equations.
/// @param[in] cos_incidence     [0, 1]; beyond as at the end, NaN as 0.
/// @param[in] refractive_index  [1, 10]; beyond as at the end, NaN as 1.
/// @return [0, 1]. Error: 2e-6.
float skv_fresnel(float cos_incidence, float refractive_index);

/// The same by [Schlick94]: F0 + (1 - F0)(1 - cos)^5. For water within .059 of the exact one (at 84 deg), mean .016.
float skv_fresnel_schlick(float cos_incidence, float refractive_index);

/// A ray that meets the water.
typedef struct skv_water_hit {
    float local_enu[3];  ///< unit, mirrored, up > 0: in the axes of the point on the water (its up; north and east
                         ///< carried along the ray). For a frame that begins there;
                         ///< lights in the observer's axes are off by the arc to the point, d/R
    float mirror_enu[3]; ///< the same direction in the observer's axes; may point below the observer's horizontal
    float distance_km;   ///< from the observer; 0 where the ray does not meet the water
    float cos_incidence; ///< to the mean surface, (0, 1]
    float reflectance;   ///< flat: Fresnel's; rough: its mean over the slopes that are seen; 0 where there is no water
} skv_water_hit;

/// Where rays meet the water and what they see in it. A ray that is refused, ends before the water or misses it gets a
/// hit towards its zenith of reflectance 0.
/// Over a rough sea the mirror is tilted toward the observer by the mean of the slopes that are seen: near the horizon
/// only those are, so under 5 to 10 m/s the sea at the horizon shows the sky 18 to 25 deg up and reflects .44 to .34 of
/// it. All of it is smooth to the very horizon.
/// @param[in]  water
/// @param[in]  frame  its ground is the water.
/// @param[in]  n
/// @param[in]  rays
/// @param[out] hits   [n].
/// @return as skv_radiance(); SKV_ERR_RANGE iff a field of water is out of range.
/// Source: slopes that are seen: those facing the observer, weighed by their projected area [Ross05]; the mean slope is
///         s2 sin Phi/(cos Phi + s sin phi) of a normal distribution, by Stein's lemma. The mean reflectance is a
///         Gauss rule over them.
/// Error:  mean reflectance 2e-3 against double integration over both slopes, from the horizon to below (the formula of
///         [Bruneton10]: up to .18, in a calm). Mirror direction 1e-6 rad and, within 1 deg of the horizon, up to 3e-5.
/// Cost:   1,200 instructions a ray over a rough sea, 250 flat (scalar x86-64). Thread-safe. No allocation.
skv_status skv_water_mirror(const skv_water *water, const skv_frame *frame, size_t n, const skv_rays *rays,
                            skv_water_hit *hits);

/// Adds mirrored light x reflectance x transmittance to the radiance of n rays.
/// @param[in]     frame          of the skv_radiance() that filled sky.
/// @param[in]     n
/// @param[in]     hits           [n], from skv_water_mirror() with the same rays.
/// @param[in]     mirrored       [n][bands], radiance of the sky from the water; negative and NaN count as 0.
/// @param[in]     mirrored_stride bytes; 0 = packed.
/// @param[in,out] sky            transmittance is read (NULL: 1), radiance is added to.
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_LAYOUT; SKV_ERR_SIZE.
skv_status skv_water_add(const skv_frame *frame, size_t n, const skv_water_hit *hits, const float *mirrored,
                         size_t mirrored_stride, const skv_sky *sky);

/// Adds the glitter of a light of the frame to the radiance of n rays: the facets that mirror it, by the density of
/// their slope. Nothing on flat water: draw the disc there, mirrored, times skv_fresnel().
/// @param[in]     water
/// @param[in]     frame
/// @param[in]     light        of the frame, [0, frame.lights).
/// @param[in]     through_air  [bands], transmittance from the water toward the light (skv_radiance() from a frame at
///                             height 0 gives it); NULL = 1.
/// @param[in]     n
/// @param[in]     rays
/// @param[in,out] sky          transmittance is read (NULL: 1), radiance is added to; finite and >= 0 after it.
/// @return as skv_radiance(); SKV_ERR_RANGE also iff light or through_air ([0, 1]) is out of range.
/// Source: [Cox54] L = E F p/(4 cos^4(tilt) cos(view)), whose cosine makes the horizon infinite [Zeisse95]; in its
/// place
///         the area seen, with shadowing towards viewer and light after [Smith67]: finite to the very horizon.
/// Error:  over all directions no more than the facets reflect; with the sun high all of it (2 %), with the sun low up
/// to
///         a third is lost: what leaves downward would meet another wave. Over 30 deg above the horizon [Cox54]'s
///         formula within .1 %.
/// Cost:   740 instructions a ray (scalar x86-64). Thread-safe. No allocation.
skv_status skv_water_glint(const skv_water *water, const skv_frame *frame, int32_t light, const float through_air[4],
                           size_t n, const skv_rays *rays, const skv_sky *sky);

#ifdef __cplusplus
}
#endif
#endif
