/// Stage 4, per vertex: bands to linear RGB and luminance by a fitted matrix. Bands are never RGB by themselves.
///
/// RGB: linear, primaries and white of ITU-R BT.709 (sRGB, D65), scaled so that (1,1,1) is SKV_WHITE_LUMINANCE cd/m2.
/// A colour outside the gamut has negative components: they are kept (clip after exposure).
#ifndef SKYVERT_COLOUR_H
#define SKYVERT_COLOUR_H

#include <stddef.h>

#include "skyvert/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Luminance of linear RGB (1,1,1), cd/m2.
#define SKV_WHITE_LUMINANCE 1000.0f

/// Rows: R, G, B, Y (cd/m2). Columns: bands; a fourth column of 0 where there are three bands.
/// Input: radiance in W m^-2 sr^-1 nm^-1. Y is SKV_WHITE_LUMINANCE times the luminance of the RGB rows (683 lm/W).
typedef struct skv_colour_matrix {
    float rgb[3][4];
    float luminance[4];
} skv_colour_matrix;

/// The fitted matrix for a set of bands: 450/535/610 and 445/520/570/630 nm (the presets'), 440/520/600/680 and
/// 440/550/680 nm, for light that was the sun's: radiance under the spectrum of tools/fit/spectra/solar_g173.txt, at
/// any distance from the sun.
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_RANGE iff bands is not 3 or 4; SKV_ERR_UNSUPPORTED iff no matrix was fitted to
///         these wavelengths (each within 0.5 nm). On error nothing is written.
/// Source: tools/fit/colour.py, which fits to skies of 48 wavelengths and the CIE 1931 observer [CIE15].
/// Error:  see README "Colour"; printed by `tools/fit/colour.py --report`.
skv_status skv_colour_matrix_fitted(skv_colour_matrix *matrix, int bands, const float wavelength_nm[]);

/// The matrix for any ascending bands and any solar irradiance (src/scene): the fitted one where the wavelengths have
/// one, else the best linear guess of the spectrum from these bands, learnt from the same skies.
///
/// The colour is always that of sunlight: where solar_irradiance has another shape than the sun's, bands are weighed by
/// the quotient of the two. The brightness is that of the irradiance given (another planet's sun is dimmer), with one
/// exception: irradiance 1 in all bands stands for radiance in 1/sr, which is shown under the sun at 1 au.
/// @param[out] matrix
/// @param[in]  bands            3 or 4.
/// @param[in]  wavelength_nm    [bands], [200, 3000], ascending. Bands outside 380 to 780 nm get no weight.
/// @param[in]  solar_irradiance [bands], W m^-2 nm^-1, [0, 1e6]; NULL = the sun's own. A band of less than
///                              a thousandth of the brightest one gets no weight.
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_RANGE; SKV_ERR_UNSUPPORTED iff no band is left. On error nothing is written.
skv_status skv_colour_matrix_for(skv_colour_matrix *matrix, int bands, const float wavelength_nm[],
                                 const float solar_irradiance[]);

/// Radiance of n vertices to colour.
/// @param[in]  matrix            every element within +-1e12.
/// @param[in]  bands             3 or 4.
/// @param[in]  n                 number of vertices.
/// @param[in]  radiance          [n][bands]; non-finite or negative counts as 0, above 1e25 as 1e25.
/// @param[in]  radiance_stride   bytes from one vertex to the next; 0 = packed.
/// @param[out] rgb               [n][3], finite; may lie in the same vertices as radiance, also on it (same stride).
/// @param[in]  rgb_stride        as above.
/// @param[out] luminance         [n], cd/m2, finite and >= 0; NULL = not wanted.
/// @param[in]  luminance_stride  as above.
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_RANGE iff bands or an element of the matrix is out of range; SKV_ERR_SIZE iff
/// a
///         stride is no multiple of 4 or shorter than its field. On error nothing is written.
/// Cost:   O(n), no allocation. Thread-safe: no hidden state.
skv_status skv_colour(const skv_colour_matrix *matrix, int bands, size_t n, const float *radiance,
                      size_t radiance_stride, float *rgb, size_t rgb_stride, float *luminance, size_t luminance_stride);

#ifdef __cplusplus
}
#endif
#endif
