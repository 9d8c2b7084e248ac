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
/// Input: radiance in W m^-2 sr^-1 nm^-1 under the solar irradiance of the fit.
typedef struct skv_colour_matrix {
    float rgb[3][4];
    float luminance[4];
} skv_colour_matrix;

/// The fitted matrix for a set of bands: 450/535/610 and 445/520/570/630 nm (the presets'), 440/520/600/680 nm.
/// For other sets build one with skv_colour_matrix_for() of tools/fit's making (see README "Colour").
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_UNSUPPORTED iff no matrix was fitted to these wavelengths (within 0.5 nm).
skv_status skv_colour_matrix_fitted(skv_colour_matrix *matrix, int bands, const float wavelength_nm[]);

/// radiance [n][bands] -> rgb [n][3] and, where not NULL, luminance [n] (cd/m2). Strides in bytes; 0 = packed.
/// Non-finite or negative input counts as 0.
skv_status skv_colour(const skv_colour_matrix *matrix, int bands, size_t n, const float *radiance, size_t radiance_stride,
                      float *rgb, size_t rgb_stride, float *luminance, size_t luminance_stride);

#ifdef __cplusplus
}
#endif
#endif
