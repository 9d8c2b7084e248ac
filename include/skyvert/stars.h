/// Which stars are seen, optional: limiting magnitude from the sky's luminance, a smooth weight per star, extinction.
///
///     skv_radiance(), skv_night_add() and skv_colour() towards the stars -> transmittance, luminance
///     skv_star_bands(weights, &matrix, bands, model.solar_irradiance);
///     skv_star_weight(&stars, n, weight, 0, illuminance, 0);
/// Draw star i with weight[i] times illuminance[i].
#ifndef SKYVERT_STARS_H
#define SKYVERT_STARS_H

#include <stddef.h>
#include <stdint.h>

#include "skyvert/colour.h"
#include "skyvert/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Illuminance of a star of magnitude V = 0 above the air, lx [Crumey14].
#define SKV_STAR_LUX 2.54e-6f
/// Thresholds above those of the laboratory: the usual observer, outdoors. 1.4 sharp-eyed, 2.4 casual [Crumey14].
#define SKV_FIELD_FACTOR 2.0f

/// The magnitude of a star that is seen half of the time, after extinction, against a sky of this luminance.
/// @param[out] magnitude
/// @param[in]  luminance     cd/m2, >= 0; below 1e-5 it counts as 1e-5 (darker is no help to the eye), up to 1e6.
/// @param[in]  field_factor  [0.1, 100]; SKV_FIELD_FACTOR where you have no better one.
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_RANGE iff a parameter is out of range or NaN. On error nothing is written.
/// Source: [Crumey14] eq. 25, 28, 34, 53: threshold illuminance F (sqrt(a1 f^2 + a2 f^3 + a3 f^4) + a4 f + a5 f^2)^2 of
///         f = B^(1/4), from rods to cones in one formula, fitted to Blackwell's trials, 3e-6 to 3400 cd/m2.
///         Chosen over Hecht's form ([Schaefer90], [Garstang00]), which the paper shows to be further from the data.
/// Error:  .05 mag against Blackwell's data; people differ by +-.5 mag. [Garstang00] is within .8 mag from 1e-4 to 1e4
///         cd/m2 (tests/scene/test_stars.c).
skv_status skv_limiting_magnitude(float *magnitude, float luminance, float field_factor);

/// What each band's transmittance counts in a star's: its share of the luminance of sunlight (a G star; the extinction
/// of a star's own colour differs by .05 mag at 45 deg).
/// @param[out] weight            [4], sums to 1.
/// @param[in]  matrix            from skv_colour_matrix_for() or skv_colour_matrix_fitted().
/// @param[in]  bands             3 or 4.
/// @param[in]  solar_irradiance  [bands], of the model.
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_RANGE iff bands is not 3 or 4 or no light is left. On error nothing is
/// written.
skv_status skv_star_bands(float weight[4], const skv_colour_matrix *matrix, int bands, const float solar_irradiance[]);

/// Stars: fields of the caller's arrays.
typedef struct skv_stars {
    const float *magnitude;      ///< [n], V above the air
    size_t magnitude_stride;     ///< bytes; 0 = packed
    const float *transmittance;  ///< [n][bands] towards the star (0 below the horizon); NULL = no air
    size_t transmittance_stride; ///< bytes; 0 = packed
    int32_t bands;               ///< of transmittance, 3 or 4
    float band_weight[4];        ///< from skv_star_bands()
    const float *luminance;      ///< [n], cd/m2 of the sky before the star; NULL = sky_luminance for all
    size_t luminance_stride;     ///< bytes; 0 = packed
    float sky_luminance;         ///< cd/m2, e.g. of the zenith
    float field_factor;          ///< as skv_limiting_magnitude()
} skv_stars;

/// How well each star is seen: 0 not at all, 1/2 at the threshold, 1 from .75 mag above it. Smooth, no star pops.
/// @param[in]  stars
/// @param[in]  n
/// @param[out] weight       [n], [0, 1]. A star of magnitude NaN or a luminance that is NaN gives 0.
/// @param[out] illuminance  [n], lx of the star after extinction, finite; NULL = not wanted.
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_SIZE iff a stride is no multiple of 4 or shorter than its field; SKV_ERR_RANGE
///         iff bands, a band weight (+-100), sky_luminance or field_factor is out of range. On error nothing is
///         written.
/// Source: the shape is that of Blackwell's observers, a normal distribution of contrast with sigma .48 of the
/// threshold
///         [Blackwell46], here 3t^2 - 2t^3 of half the ratio to the threshold, which is within .03 of it and ends.
/// Cost:   160 instructions a star (scalar x86-64). Thread-safe. No allocation.
skv_status skv_star_weight(const skv_stars *stars, size_t n, float *weight, size_t weight_stride, float *illuminance,
                           size_t illuminance_stride);

#ifdef __cplusplus
}
#endif
#endif
