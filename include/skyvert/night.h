/// The night floor, optional, per vertex: airglow, zodiacal light and the light of faint stars, so that a moonless sky
/// is not black and deep twilight ends in it. Earth only: other planets have none, scale = 0.
///
///     skv_night_earth(&night);
///     skv_radiance(&frame, n, &rays, &sky);        with sky.transmittance
///     skv_night_add(&night, &frame, n, &rays, &sky);
///
/// Surface brightness is given in S10: stars of magnitude V = 10 and the sun's colour per square degree. That
/// is 6.61e-12 per sr of the sun's irradiance, at any wavelength, so no spectrum is needed and the units are those of
/// the model's solar irradiance (1 in all bands: 1/sr). With the presets' irradiance the radiance is absolute: at the
/// zenith V = 21.9 magnitudes per square second of arc, and 2.2e-4 cd/m2 (more than V gives: it is redder than the
/// sun).
#ifndef SKYVERT_NIGHT_H
#define SKYVERT_NIGHT_H

#include "skyvert/radiance.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct skv_night {
    float scale;         ///< of all of it, [0, 1e6]; 0: nothing is added
    float airglow_s10;   ///< at the zenith and 550 nm, from below the layer, [0, 1e6]
    float zodiacal_s10;  ///< [0, 1e6], at 500 nm
    float starlight_s10; ///< of the stars that are not drawn one by one, [0, 1e6]
    float layer_km[2];   ///< lower and upper altitude of the airglow, [20, 1000], at least 1 km apart
} skv_night;

/// A dark site at solar minimum, high ecliptic and galactic latitude: airglow 145 S10, zodiacal light 60 [Benn98],
/// stars fainter than magnitude 6.5 and galactic light 30; airglow from 85 to 95 km. At solar maximum take 275 of
/// airglow, near the ecliptic 140 of zodiacal light [Benn98], for all stars 100 [Leinert98].
/// @return SKV_OK; SKV_ERR_NULL.
skv_status skv_night_earth(skv_night *night);

/// Adds the night's light, seen through the air, to the radiance of n rays.
///
/// Airglow: the path of the ray through the layer over its thickness (van Rhijn's law with no singularity, also from
/// within the layer and from space, where the limb is 70 times the zenith) times the spectrum of [Benn98] and [Patat03]
/// in U, B, V, R, I, lines smeared into the bands. Zodiacal light: even, as red as 1 + .6 log10(lambda/500 nm)
/// [Leinert98]. Starlight: even, of the sun's colour. Each is weakened by the transmittance T; (1 - T) times what
/// comes from all round is scattered in, so the horizon is not black. The ground sends back its albedo of the night's
/// light. What lies behind the end of a ray of finite length is not added.
/// @param[in]     night
/// @param[in]     frame  of the skv_radiance() that filled sky.
/// @param[in]     n
/// @param[in]     rays
/// @param[in,out] sky    transmittance is read (NULL: 1), radiance is added to; finite and >= 0 after it.
/// @return as skv_radiance(); rays that it refuses keep what they have. SKV_ERR_RANGE iff a field of night is out of
///         range.
/// Error:  paths 1 %. Against single scattering integrated in double: 5 % to 70 deg from the zenith, at the horizon
///         brighter by up to 70 %, where later orders count; against the effective extinction of [Noll12] eq. 23 to 25
///         10 % to 70 deg. The sky itself varies by 30 %. Measured by tests/scene/test_night.c.
/// Cost:   390 instructions a ray (scalar x86-64). Thread-safe. No allocation.
skv_status skv_night_add(const skv_night *night, const skv_frame *frame, size_t n, const skv_rays *rays,
                         const skv_sky *sky);

#ifdef __cplusplus
}
#endif
#endif
