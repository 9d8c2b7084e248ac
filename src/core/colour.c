/// Bands to linear RGB and luminance by a matrix. The matrices are colour_fitted.h's, written by tools/fit/colour.py.
#include "skyvert/colour.h"

#include "core/elementary.h"

typedef struct skv_colour_set {
    int bands;
    float nm[4];
    float rgb[3][4];
} skv_colour_set;

#include "core/colour_fitted.h"

/// How far a wavelength may be from the one that was fitted.
#define SKV_SAME_NM 0.5f
/// Radiance is cut here, elements of a matrix must lie within the second: no sum of products overflows.
#define SKV_RADIANCE_MOST 1e25f
#define SKV_ELEMENT_MOST  1e12f

static int skv_same_bands(const skv_colour_set *set, int bands, const float wavelength_nm[]) {
    if (set->bands != bands)
        return 0;
    for (int i = 0; i < bands; ++i)
        if (!(skv_fabsf(wavelength_nm[i] - set->nm[i]) <= SKV_SAME_NM))
            return 0;
    return 1;
}

skv_status skv_colour_matrix_fitted(skv_colour_matrix *matrix, int bands, const float wavelength_nm[]) {
    if (matrix == NULL || wavelength_nm == NULL)
        return SKV_ERR_NULL;
    if (bands != 3 && bands != 4)
        return SKV_ERR_RANGE;
    for (size_t s = 0; s < sizeof skv_colour_sets / sizeof skv_colour_sets[0]; ++s) {
        const skv_colour_set *set = &skv_colour_sets[s];
        if (!skv_same_bands(set, bands, wavelength_nm))
            continue;
        for (int i = 0; i < 4; ++i) {
            for (int c = 0; c < 3; ++c)
                matrix->rgb[c][i] = set->rgb[c][i];
            matrix->luminance[i] = SKV_WHITE_LUMINANCE * (skv_luma[0] * set->rgb[0][i] + skv_luma[1] * set->rgb[1][i] +
                                                          skv_luma[2] * set->rgb[2][i]);
        }
        return SKV_OK;
    }
    return SKV_ERR_UNSUPPORTED;
}

/// Columns of four: red, green, blue and luminance of one band, so that a vertex is four multiply-adds of four lanes
/// (blocks of vertices side by side were tried: twice the instructions, for the loads and stores).
typedef struct skv_colour_columns {
    float of[4][4];
} skv_colour_columns;

/// @return 0 iff an element is out of range or NaN.
static int skv_columns_of(skv_colour_columns *columns, const skv_colour_matrix *matrix, int bands) {
    int good = 1;
    for (int i = 0; i < 4; ++i)
        for (int c = 0; c < 4; ++c) {
            const float x = i >= bands ? 0.0f : c < 3 ? matrix->rgb[c][i] : matrix->luminance[i];
            good &= skv_fabsf(x) <= SKV_ELEMENT_MOST;
            columns->of[i][c] = x;
        }
    return good;
}

/// Bytes from one element to the next; 0 iff the stride asked for does not fit a field of `floats`.
static size_t skv_stride_of(size_t stride, size_t floats) {
    if (stride == 0)
        return floats * sizeof(float);
    return stride % sizeof(float) == 0 && stride >= floats * sizeof(float) ? stride : 0;
}

/// NaN and negative give 0, infinity 0, what is large is cut.
static float skv_clean(float x) {
    const float positive = skv_maxf(x, 0.0f);
    const float finite = positive <= FLT_MAX ? positive : 0.0f;
    return skv_minf(finite, SKV_RADIANCE_MOST);
}

static void skv_colour_of(float out[4], const skv_colour_columns *m, const float *radiance, int bands) {
    float in[4];
    for (int i = 0; i < 4; ++i)
        in[i] = i < bands ? radiance[i] : 0.0f;
    for (int i = 0; i < 4; ++i)
        in[i] = skv_clean(in[i]);
    for (int c = 0; c < 4; ++c)
        out[c] = in[0] * m->of[0][c] + in[1] * m->of[1][c] + (in[2] * m->of[2][c] + in[3] * m->of[3][c]);
}

skv_status skv_colour(const skv_colour_matrix *matrix, int bands, size_t n, const float *radiance,
                      size_t radiance_stride, float *rgb, size_t rgb_stride, float *luminance,
                      size_t luminance_stride) {
    if (matrix == NULL || radiance == NULL || rgb == NULL)
        return SKV_ERR_NULL;
    skv_colour_columns columns;
    if ((bands != 3 && bands != 4) || !skv_columns_of(&columns, matrix, bands))
        return SKV_ERR_RANGE;
    const size_t step_in = skv_stride_of(radiance_stride, (size_t)bands) / sizeof(float);
    const size_t step_rgb = skv_stride_of(rgb_stride, 3) / sizeof(float);
    const size_t step_luminance = skv_stride_of(luminance_stride, 1) / sizeof(float);
    if (step_in == 0 || step_rgb == 0 || step_luminance == 0)
        return SKV_ERR_SIZE;
    for (size_t i = 0; i < n; ++i) {
        float out[4];
        skv_colour_of(out, &columns, radiance + i * step_in, bands);
        for (size_t c = 0; c < 3; ++c)
            rgb[i * step_rgb + c] = out[c];
        if (luminance != NULL)
            luminance[i * step_luminance] = skv_maxf(out[3], 0.0f);
    }
    return SKV_OK;
}
