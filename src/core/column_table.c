#include "core/column_table.h"

#include "core/chapman.h"
#include "core/geometry.h"
#include "core/profile.h"

#if SKV_TERM_OZONE || SKV_PROFILE_TABULATED

enum { SKV_COLUMN_STEPS = 128 };

static float skv_table_density(const skv_profile *profile, float h_km) {
    const float *h = profile->table_altitude_km, *d = profile->table_density;
    uint32_t lo = 0, hi = profile->table_rows - 1;
    if (!(h_km > h[lo]))
        return d[lo];
    if (h_km >= h[hi])
        return d[hi];
    while (hi - lo > 1) {
        const uint32_t mid = (lo + hi) / 2;
        if (h[mid] <= h_km)
            lo = mid;
        else
            hi = mid;
    }
    return d[lo] + (d[hi] - d[lo]) * ((h_km - h[lo]) / (h[hi] - h[lo]));
}

float skv_profile_density(const skv_profile *profile, const skv_species *species, float h_km) {
    if (profile->kind == SKV_PROFILE_TABLE)
        return skv_table_density(profile, h_km);
    return skv_density_formula(species, h_km);
}

float skv_profile_centroid_km(const skv_profile *profile, const skv_species *species, float top_km) {
    float mass = 0.0f, moment = 0.0f;
    for (int i = 0; i < 512; i++) {
        const float x = ((float)i + 0.5f) * (1.0f / 512.0f), h = top_km * x * x;
        const float m = skv_profile_density(profile, species, h) * x;
        mass += m;
        moment += m * h;
    }
    return skv_clampf(moment / skv_maxf(mass, 1e-30f), 0.005f * top_km, 0.5f * top_km);
}

/// Integral of the density from (h, rm >= 0) to the top: steps of growing altitude, two Gauss nodes each in distance.
static float skv_column_integral(const skv_profile *profile, const skv_species *species, float radius, float top,
                                 float h, float rm) {
    const float e0 = h * (2.0f * radius + h);
    float sum = 0.0f, s0 = 0.0f;
    for (int i = 1; i <= SKV_COLUMN_STEPS; i++) {
        const float x = (float)i * (1.0f / SKV_COLUMN_STEPS);
        const float s1 = skv_to_top(radius, h + (top - h) * (0.5f * x + 0.5f * x * x), h, rm);
        for (int g = 0; g < 2; g++) {
            const float s = s0 + (s1 - s0) * (g == 0 ? 0.211324865f : 0.788675135f);
            float r;
            const float z = skv_altitude(radius, e0 + s * (2.0f * rm + s), &r);
            sum += 0.5f * (s1 - s0) * skv_profile_density(profile, species, z);
        }
        s0 = s1;
    }
    return sum;
}

/// What a column is divided by: the closed form of the reference exponential, or t = 1/(1 + 14 mu).
static float skv_column_base(const skv_species *species, float radius, float h, float mu, float t) {
    if (species->column == 2)
        return t;
    const float scale = species->scale_height_km, k = 1.0f / skv_sqrtf(2.0f * scale);
    const float r = radius + h, root = skv_sqrtf(r), sin_chi = skv_sqrtf(1.0f - mu * mu);
    return scale * 1.77245385f * k * root * skv_exp2f(skv_maxf(-h * species->inv_scale_log2e, -120.0f)) *
           skv_chapman(SKV_ERFCX_C * k * root, 0.375f * scale, mu, sin_chi, skv_power8(sin_chi) / r);
}

static float skv_row_altitude(const skv_species *species, float top, int i, int rows) {
    const float x = (float)i / (float)(rows - 1);
    return top * (species->column == 2 ? x : x * x);
}

void skv_column_table_build(skv_column_table *table, const skv_profile *profile, const skv_species *species,
                            float radius_km, float top_km) {
    for (int i = 0; i < SKV_COLUMN_ROWS; i++) {
        const float h = skv_row_altitude(species, top_km, i, SKV_COLUMN_ROWS);
        for (int j = 0; j < SKV_COLUMN_COLS; j++) {
            const float t = 1.0f / 15.0f + (float)j * (14.0f / 15.0f / (float)(SKV_COLUMN_COLS - 1));
            const float mu = skv_clampf((1.0f / t - 1.0f) * (1.0f / 14.0f), 0.0f, 1.0f);
            table->column[i * SKV_COLUMN_COLS + j] =
                skv_column_integral(profile, species, radius_km, top_km, h, (radius_km + h) * mu) /
                skv_column_base(species, radius_km, h, mu, t);
        }
    }
    for (int i = 0; i < SKV_COLUMN_TANGENTS; i++) {
        const float h = skv_row_altitude(species, top_km, i, SKV_COLUMN_TANGENTS);
        table->tangent[i] = skv_column_integral(profile, species, radius_km, top_km, h, 0.0f) /
                            skv_column_base(species, radius_km, h, 0.0f, 1.0f);
    }
}

void skv_density_table_build(float density[SKV_DENSITY_ROWS], const skv_profile *profile, const skv_species *species,
                             float top_km) {
    for (int i = 0; i < SKV_DENSITY_ROWS; i++) {
        const float x = (float)i / (float)(SKV_DENSITY_ROWS - 1);
        density[i] = skv_profile_density(profile, species, top_km * x * x);
    }
}

#if SKV_PROFILE_TABULATED
enum { SKV_KNOTS_ROWS = SKV_KNOTS_MAX - 2 };

/// A lognormal to three standard deviations of the logarithm. Less a twelfth of its second difference a row is that of
/// the nearest broken line, which has the same column.
static void skv_knots_lognormal(const skv_species *species, float h[SKV_KNOTS_ROWS], float d[SKV_KNOTS_ROWS]) {
    const float step = 6.0f / (float)(SKV_KNOTS_ROWS - 1) / skv_sqrtf(2.0f * species->p1);
    float at[3] = {0.0f, 0.0f, 0.0f}; // densities: before, here, after
    for (int i = -1; i < SKV_KNOTS_ROWS; i++) {
        const float next = skv_expf(species->p0 + ((float)(i + 1) - 0.5f * (float)(SKV_KNOTS_ROWS - 1)) * step);
        at[0] = at[1];
        at[1] = at[2];
        at[2] = i + 1 < SKV_KNOTS_ROWS ? skv_density_formula(species, next) : 0.0f;
        if (i >= 0)
            d[i] =
                i > 0 && i < SKV_KNOTS_ROWS - 1 ? skv_maxf(at[1] - (at[0] - 2.0f * at[1] + at[2]) / 12.0f, 0.0f) : 0.0f;
        if (i + 1 < SKV_KNOTS_ROWS)
            h[i + 1] = next;
    }
}

/// Rows of a short table, or made for a tent or a lognormal. @return their number; 0: no layer.
static int32_t skv_knots_rows(const skv_profile *profile, const skv_species *species, float h[SKV_KNOTS_ROWS],
                              float d[SKV_KNOTS_ROWS], const float **altitude, const float **density) {
    *altitude = h;
    *density = d;
    if (profile->kind == SKV_PROFILE_LOGNORMAL) {
        skv_knots_lognormal(species, h, d);
        return SKV_KNOTS_ROWS;
    }
    if (profile->kind == SKV_PROFILE_TENT) {
        for (int i = 0; i < 3; i++) {
            h[i] = profile->peak_km + (float)(i - 1) * profile->half_width_km;
            d[i] = i == 1 ? 1.0f : 0.0f;
        }
        return 3;
    }
    *altitude = profile->table_altitude_km;
    *density = profile->table_density;
    return profile->kind == SKV_PROFILE_TABLE && profile->table_rows <= SKV_KNOTS_ROWS ? (int32_t)profile->table_rows
                                                                                       : 0;
}

/// Density at z of the line between two rows, z between them.
static float skv_knots_between(float z, const float *h, const float *d, int32_t i, int32_t j) {
    return d[i] + (d[j] - d[i]) * skv_clampf((z - h[i]) / (h[j] - h[i]), 0.0f, 1.0f);
}

/// Rows cut to [lowest, top], constant beyond their ends. @return number
static int32_t skv_knots_cut(const float *altitude, const float *density, int32_t rows, float lowest, float top,
                             float h[SKV_KNOTS_MAX], float *rho) {
    int32_t n = 0;
    h[n] = lowest;
    rho[n++] = density[0];
    for (int32_t i = 0; i < rows; i++) {
        if (altitude[i] <= lowest)
            rho[0] = i + 1 < rows ? skv_knots_between(lowest, altitude, density, i, i + 1) : density[i];
        if (!(altitude[i] > lowest && altitude[i] < top))
            continue;
        h[n] = altitude[i];
        rho[n++] = density[i];
    }
    h[n] = top;
    rho[n++] = density[rows - 1];
    for (int32_t i = rows - 1; i > 0; i--)
        if (altitude[i] >= top)
            rho[n - 1] = skv_knots_between(top, altitude, density, i - 1, i);
    return n;
}

int32_t skv_knots_build(skv_column_table *table, const skv_profile *profile, const skv_species *species,
                        float radius_km, float top_km) {
    float made_h[SKV_KNOTS_ROWS], made_d[SKV_KNOTS_ROWS], h[SKV_KNOTS_MAX], d[SKV_KNOTS_MAX];
    const float *altitude, *density;
    const int32_t rows = skv_knots_rows(profile, species, made_h, made_d, &altitude, &density);
    if (rows == 0)
        return 0;
    // No ground is lower than 12 km or half the radius (frame.h).
    int32_t n = skv_knots_cut(altitude, density, rows, -skv_minf(12.0f, 0.5f * radius_km), top_km, h, d), from = 0;
    while (from + 1 < n && d[from] == 0.0f && d[from + 1] == 0.0f)
        from++;
    while (n - 1 > from && d[n - 1] == 0.0f && d[n - 2] == 0.0f)
        n--;
    n -= from;
    float *const e = table->column, *const rho = e + SKV_KNOTS_MAX, *const slope = rho + SKV_KNOTS_MAX;
    for (int32_t i = 0; i < n; i++) {
        e[i] = h[from + i] * (2.0f * radius_km + h[from + i]);
        rho[i] = d[from + i];
    }
    for (int32_t i = 0; i < n; i++)
        slope[i] = i + 1 < n && e[i + 1] > e[i] ? (rho[i + 1] - rho[i]) / (e[i + 1] - e[i]) : 0.0f;
    return n;
}
#endif

#endif
