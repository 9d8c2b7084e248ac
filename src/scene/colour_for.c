/// A colour matrix for any bands. Here and not in the core: a product has one set of bands, and a fitted matrix for it.
#include "skyvert/colour.h"

#include "core/elementary.h"
#include "scene/colour_basis.h"

#define SKV_FIRST_SEEN_NM 380.0f
#define SKV_LAST_SEEN_NM  780.0f

/// The bands that count.
typedef struct skv_seen {
    int n;
    int band[4];
    float shape[4][SKV_BASIS_SHAPES]; ///< the shapes at the band
    float scale[4];                   ///< from radiance to radiance over solar irradiance
} skv_seen;

/// Linear between the nodes of a column of a table.
static float skv_at_node(const float *table, size_t columns, float nm) {
    const float x = skv_clampf((nm - SKV_BASIS_FIRST_NM) / SKV_BASIS_STEP_NM, 0.0f, (float)(SKV_BASIS_NODES - 1));
    const int i = x < (float)(SKV_BASIS_NODES - 2) ? (int)x : SKV_BASIS_NODES - 2;
    const float t = x - (float)i;
    const float *at = table + (size_t)i * columns;
    return (1.0f - t) * at[0] + t * at[columns];
}

static float skv_sun_at_nm(float nm) {
    return skv_at_node(skv_basis_solar, 1, nm);
}

/// Ascending and in range; irradiance in range or absent.
static int skv_bands_good(int bands, const float nm[], const float solar[]) {
    for (int i = 0; i < bands; ++i) {
        if (!(nm[i] >= 200.0f && nm[i] <= 3000.0f) || (i > 0 && !(nm[i] > nm[i - 1])))
            return 0;
        if (solar != NULL && !(solar[i] >= 0.0f && solar[i] <= 1e6f))
            return 0;
    }
    return 1;
}

/// Irradiance 1 in all bands stands for radiance in 1/sr.
static int skv_per_sr(int bands, const float solar[]) {
    int ones = 0;
    for (int i = 0; i < bands; ++i)
        ones += solar[i] == 1.0f;
    return ones == bands;
}

/// The least irradiance that counts: a band without light carries no colour, and its quotient would overflow.
static float skv_least(int bands, const float solar[]) {
    float most = 0.0f;
    for (int i = 0; i < bands; ++i)
        most = skv_maxf(solar[i], most);
    return skv_maxf(most * 1e-3f, FLT_MIN);
}

/// Picks the bands, and what turns their radiance into that under the sun at 1 au with the brightness kept: the sun's
/// irradiance there over the one given, times the sum of those given over the sum of the sun's.
static void skv_seen_of(skv_seen *seen, int bands, const float nm[], const float solar[]) {
    const float least = solar != NULL ? skv_least(bands, solar) : FLT_MIN;
    float sum_given = 0.0f;
    float sum_sun = 0.0f;
    seen->n = 0;
    for (int i = 0; i < bands; ++i) {
        const float given = solar != NULL ? solar[i] : skv_sun_at_nm(nm[i]);
        if (!(nm[i] >= SKV_FIRST_SEEN_NM && nm[i] <= SKV_LAST_SEEN_NM && given >= least))
            continue;
        const int k = seen->n++;
        seen->band[k] = i;
        seen->scale[k] = 1.0f / given;
        sum_given += given;
        sum_sun += skv_sun_at_nm(nm[i]);
        for (int s = 0; s < SKV_BASIS_SHAPES; ++s)
            seen->shape[k][s] = skv_at_node(&skv_basis_shape[0][s], SKV_BASIS_SHAPES, nm[i]);
    }
    const float brightness = solar == NULL || skv_per_sr(bands, solar) ? 1.0f : sum_given / sum_sun;
    for (int k = 0; k < seen->n; ++k)
        seen->scale[k] *= brightness;
}

/// Solves A x = b for symmetric positive A [n][n] and three right sides, all in place (A = L D L').
static void skv_solve(int n, float a[4][4], float b[4][3]) {
    for (int i = 0; i < n; ++i)
        for (int j = i + 1; j < n; ++j) {
            const float f = a[j][i] / a[i][i];
            for (int k = i; k < n; ++k)
                a[j][k] -= f * a[i][k];
            for (int c = 0; c < 3; ++c)
                b[j][c] -= f * b[i][c];
        }
    for (int i = n - 1; i >= 0; --i)
        for (int c = 0; c < 3; ++c) {
            for (int j = i + 1; j < n; ++j)
                b[i][c] -= a[i][j] * b[j][c];
            b[i][c] /= a[i][i];
        }
}

/// The guess of least squares: with shapes B [n][S] of the bands, whose amounts have unit variance, and their colours
/// C [3][S], the matrix on radiance over irradiance is C B' (B B' + ridge)^-1.
static void skv_guess(float rgb[4][3], const skv_seen *seen) {
    float a[4][4];
    float trace = 0.0f;
    for (int i = 0; i < seen->n; ++i) {
        for (int j = 0; j < seen->n; ++j) {
            a[i][j] = 0.0f;
            for (int s = 0; s < SKV_BASIS_SHAPES; ++s)
                a[i][j] += seen->shape[i][s] * seen->shape[j][s];
        }
        for (int c = 0; c < 3; ++c) {
            rgb[i][c] = 0.0f;
            for (int s = 0; s < SKV_BASIS_SHAPES; ++s)
                rgb[i][c] += skv_basis_rgb[c][s] * seen->shape[i][s];
        }
        trace += a[i][i];
    }
    for (int i = 0; i < seen->n; ++i)
        a[i][i] += SKV_BASIS_RIDGE / (float)seen->n * trace;
    skv_solve(seen->n, a, rgb);
}

/// The same where the bands have a fitted matrix, taken to radiance over irradiance.
static int skv_fitted(float rgb[4][3], const skv_seen *seen, int bands, const float nm[]) {
    skv_colour_matrix fitted;
    if (seen->n != bands || skv_colour_matrix_fitted(&fitted, bands, nm) != SKV_OK)
        return 0;
    for (int k = 0; k < bands; ++k)
        for (int c = 0; c < 3; ++c)
            rgb[k][c] = fitted.rgb[c][k] * skv_sun_at_nm(nm[k]);
    return 1;
}

skv_status skv_colour_matrix_for(skv_colour_matrix *matrix, int bands, const float wavelength_nm[],
                                 const float solar_irradiance[]) {
    static const float luma[3] = SKV_BASIS_LUMA;
    if (matrix == NULL || wavelength_nm == NULL)
        return SKV_ERR_NULL;
    if ((bands != 3 && bands != 4) || !skv_bands_good(bands, wavelength_nm, solar_irradiance))
        return SKV_ERR_RANGE;
    skv_seen seen;
    skv_seen_of(&seen, bands, wavelength_nm, solar_irradiance);
    if (seen.n == 0)
        return SKV_ERR_UNSUPPORTED;
    float rgb[4][3];
    if (!skv_fitted(rgb, &seen, bands, wavelength_nm))
        skv_guess(rgb, &seen);
    *matrix = (skv_colour_matrix){.luminance = {0.0f}};
    for (int k = 0; k < seen.n; ++k)
        for (int c = 0; c < 3; ++c) {
            const float x = rgb[k][c] * seen.scale[k];
            matrix->rgb[c][seen.band[k]] = x;
            matrix->luminance[seen.band[k]] += SKV_WHITE_LUMINANCE * luma[c] * x;
        }
    return SKV_OK;
}
