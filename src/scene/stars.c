/// Visibility of stars [Crumey14].
#include "skyvert/stars.h"

#include "core/elementary.h"
#include "scene/strided.h"

/// Luminances, cd/m2: no sky is darker to the eye; the last that is answered.
#define DARKEST   1.0e-5f
#define BRIGHTEST 1.0e6f

#define WEIGHT_MOST 100.0f

/// [Crumey14] eq. 25 and 28: the hyperbola's coefficients.
#define A1 5.949e-8f
#define A2 (-2.389e-7f)
#define A3 2.459e-7f
#define A4 4.120e-4f
#define A5 (-4.225e-4f)
/// Where rods give way to cones the hyperbola falls by .02 mag as the sky brightens, from a luminance of this fourth
/// root on: there the threshold stays, so that no star comes back while its sky brightens.
#define PLATEAU_ROOT4 0.383222f
#define PLATEAU       1.202304e-04f

/// Root of the threshold illuminance in the laboratory, lx^(1/2).
static float threshold_root(float luminance) {
    const float f = skv_sqrtf(skv_sqrtf(skv_clampf(luminance, DARKEST, BRIGHTEST)));
    const float root = f * (skv_sqrtf(A1 + f * (A2 + f * A3)) + A4 + f * A5);
    return f > PLATEAU_ROOT4 ? skv_maxf(root, PLATEAU) : root;
}

static float threshold_lux(float luminance, float field_factor) {
    const float root = threshold_root(luminance);
    return field_factor * root * root;
}

/// 10^(-0.4 m) for +-75 mag, else as at the end.
static float brightness(float magnitude) {
    return skv_exp2f(-1.32877124f * skv_clampf(magnitude, -75.0f, 75.0f));
}

static bool good_factor(float field_factor) {
    return field_factor >= 0.1f && field_factor <= 100.0f;
}

static bool good_luminance(float luminance) {
    return luminance >= 0.0f && luminance <= BRIGHTEST;
}

skv_status skv_limiting_magnitude(float *magnitude, float luminance, float field_factor) {
    if (magnitude == NULL)
        return SKV_ERR_NULL;
    if (!good_luminance(luminance) || !good_factor(field_factor))
        return SKV_ERR_RANGE;
    // -2.5 log10(x) = -0.7525749892 log2(x)
    *magnitude = -0.752574989f * skv_log2f(threshold_lux(luminance, field_factor) / SKV_STAR_LUX);
    return SKV_OK;
}

skv_status skv_star_bands(float weight[4], const skv_colour_matrix *matrix, int bands, const float solar_irradiance[]) {
    if (weight == NULL || matrix == NULL || solar_irradiance == NULL)
        return SKV_ERR_NULL;
    if (bands != 3 && bands != 4)
        return SKV_ERR_RANGE;
    float share[4] = {0.0f, 0.0f, 0.0f, 0.0f}, sum = 0.0f;
    for (int b = 0; b < bands; b++) {
        share[b] = matrix->luminance[b] * solar_irradiance[b];
        sum += share[b];
    }
    for (int b = 0; b < bands; b++)
        if (!(sum >= 1e-20f && sum <= 1e20f && skv_fabsf(share[b]) <= WEIGHT_MOST * sum))
            return SKV_ERR_RANGE;
    for (int b = 0; b < 4; b++)
        weight[b] = share[b] / sum;
    return SKV_OK;
}

static skv_status check_stars(const skv_stars *stars, size_t n, const float *weight, size_t weight_stride,
                              size_t illuminance_stride) {
    if (stars == NULL || (n > 0 && (stars->magnitude == NULL || weight == NULL)))
        return SKV_ERR_NULL;
    if (stars->transmittance != NULL && stars->bands != 3 && stars->bands != 4)
        return SKV_ERR_RANGE;
    const size_t one = sizeof(float), many = stars->bands == 3 ? 3 * one : 4 * one;
    if (!skv_stride_ok(stars->magnitude_stride, one) || !skv_stride_ok(stars->transmittance_stride, many) ||
        !skv_stride_ok(stars->luminance_stride, one) || !skv_stride_ok(weight_stride, one) ||
        !skv_stride_ok(illuminance_stride, one))
        return SKV_ERR_SIZE;
    for (int b = 0; b < stars->bands && stars->transmittance != NULL; b++)
        if (!(skv_fabsf(stars->band_weight[b]) <= WEIGHT_MOST))
            return SKV_ERR_RANGE;
    if (!good_factor(stars->field_factor) || (stars->luminance == NULL && !good_luminance(stars->sky_luminance)))
        return SKV_ERR_RANGE;
    return SKV_OK;
}

/// Share of a star's visual light that comes through the air, [0, 1].
static float through_air(const skv_stars *stars, size_t i) {
    if (stars->transmittance == NULL)
        return 1.0f;
    const size_t bands = (size_t)stars->bands;
    const float *const t =
        skv_const_at(stars->transmittance, skv_stride(stars->transmittance_stride, bands * sizeof(float)), i);
    float sum = 0.0f;
    for (size_t b = 0; b < bands; b++)
        sum += stars->band_weight[b] * skv_clampf(t[b], 0.0f, 1.0f);
    return skv_clampf(sum, 0.0f, 1.0f);
}

/// Threshold before star i, lx; 0 where the luminance is NaN: nothing is seen there.
static float threshold_before(const skv_stars *stars, size_t i) {
    if (stars->luminance == NULL)
        return threshold_lux(stars->sky_luminance, stars->field_factor);
    const float luminance = *skv_const_at(stars->luminance, skv_stride(stars->luminance_stride, sizeof(float)), i);
    return luminance == luminance ? threshold_lux(luminance, stars->field_factor) : 0.0f;
}

skv_status skv_star_weight(const skv_stars *stars, size_t n, float *weight, size_t weight_stride, float *illuminance,
                           size_t illuminance_stride) {
    const skv_status status = check_stars(stars, n, weight, weight_stride, illuminance_stride);
    if (status != SKV_OK)
        return status;
    const size_t one = sizeof(float), from = skv_stride(stars->magnitude_stride, one);
    for (size_t i = 0; i < n; i++) {
        const float m = *skv_const_at(stars->magnitude, from, i), threshold = threshold_before(stars, i);
        const float lux = m == m ? SKV_STAR_LUX * brightness(m) * through_air(stars, i) : 0.0f;
        const float t = threshold > 0.0f ? skv_minf(0.5f * (lux / threshold), 1.0f) : 0.0f;
        *skv_at(weight, skv_stride(weight_stride, one), i) = t * t * (3.0f - 2.0f * t);
        if (illuminance != NULL)
            *skv_at(illuminance, skv_stride(illuminance_stride, one), i) = lux;
    }
    return SKV_OK;
}
