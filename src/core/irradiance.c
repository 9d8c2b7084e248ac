#include "skyvert/irradiance.h"

#include <string.h>

#include "skyvert/radiance.h"

#include "core/cells.h"
#include "core/gather.h"
#include "core/geometry.h"

static float skv_irradiance_dot(const float a[3], const float b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Transmittance from the top of the air to the observer; 0 where the ground stands before the light.
static void skv_irradiance_transmittance(const skv_frame *frame, int light, float out[SKV_BANDS_MAX]) {
    const float h = frame->height_km, radius = frame->radius_km, rms = (radius + h) * frame->light[light].mu_s;
    float radiance[SKV_BANDS_MAX];
    skv_frame alone = *frame;
    const skv_rays rays = {frame->light[light].direction_enu, 0, NULL, 0};
    const skv_sky sky = {radiance, 0, out, 0};
    memset(out, 0, sizeof(float) * SKV_BANDS_MAX);
    if (rms < 0.0f && h * (2.0f * radius + h) < rms * rms)
        return;
    alone.lights = 0;
    (void)skv_radiance(&alone, 1, &rays, &sky);
}

#if SKV_TERM_DIFFUSE
/// Within the air: the radiance of the table's cell, degree by degree, times the clamped cosine's moments
/// pi, 2 pi/3, pi/4, 0 [Ramamoorthi01, eq. 8]; degree 4 would count 1/24.
typedef struct skv_irradiance_cell {
    float mean[SKV_BANDS_MAX], k[5 * SKV_BANDS_MAX];
    float mu_s;
} skv_irradiance_cell;

static SKV_NOINLINE void skv_irradiance_read(const skv_frame *frame, int light, skv_irradiance_cell *cell) {
    const skv_table *const t = frame->diffuse.table;
    const int bands = skv_bands(frame->model);
    const float mu_s = frame->light[light].mu_s;
    const float h = skv_clampf((frame->height_km + frame->diffuse.offset_km) * frame->diffuse.inv_span, 0.0f, 1.0f);
    skv_lanes x, y;
    skv_cells_places place;
    skv_cells_square square;
    float ratio[SKV_CELLS_RATIOS];
    SKV_EACH_LANE(l) {
        x.v[l] = skv_cells_row(t, h);
        y.v[l] = skv_cells_column(&frame->diffuse, mu_s);
    }
    square.at = -1;
    skv_cells_find(t, bands, &x, &y, &place);
    (void)skv_cells_at(t, bands, &place, 0, &square, cell->mean, ratio);
    for (int b = 0; b < bands; b++)
        cell->mean[b] = skv_exp2f(skv_cells_log2(t, cell->mean[b]));
    for (int i = 0; i < 5 * bands; i++)
        cell->k[i] = ratio[i] * t->ratio_scale[i / bands];
    cell->mu_s = mu_s;
}

static void skv_irradiance_from_cell(const skv_frame *frame, int light, const skv_irradiance_cell *cell,
                                     const float n[3], float out[]) {
    const int bands = skv_bands(frame->model);
    const float mu = n[2], mu2 = mu * mu, mu_s = cell->mu_s;
    const float q = skv_irradiance_dot(n, frame->light[light].direction_enu) - mu * mu_s;
    const float p2 = 1.5f * mu2 - 0.5f;
    const float xy = 2.0f * q * q - (1.0f - mu_s * mu_s) * (1.0f - mu2);
    const float *const k = cell->k;
    for (int b = 0; b < bands; b++) {
        const float one = k[b] * mu + k[bands + b] * q;
        const float two = k[2 * bands + b] * p2 + k[3 * bands + b] * mu * q + k[4 * bands + b] * xy;
        const float sum = SKV_PI + 2.09439510f * one + 0.785398163f * two;
        out[b] += frame->light[light].irradiance[b] * cell->mean[b] * skv_maxf(sum, 0.0f);
    }
}

/// Above the air the planet fills only a part of the sphere: its directions are integrated.
enum { SKV_IRRADIANCE_POLAR = 12, SKV_IRRADIANCE_AZIMUTHS = 16 };

static void skv_irradiance_from_space(const skv_frame *frame, const float n[3], float out[]) {
    const float r = frame->radius_km + frame->height_km, rt = frame->radius_km + frame->top_km;
    const float high = -skv_sqrtf((r - rt) * (r + rt)) / r;
    const float horizon = -skv_sqrtf(frame->height_km * (frame->radius_km + r)) / r;
    const int bands = skv_bands(frame->model), half = SKV_IRRADIANCE_POLAR / 2;
    skv_frame whole = *frame;
    whole.quality.terms |= SKV_TERM_GROUND ? (uint32_t)SKV_WITH_GROUND : 0u;
    for (int i = 0; i < SKV_IRRADIANCE_POLAR; i++) {
        // Half of them for the limb alone: in twilight most light comes from there.
        const int at = skv_gauss_offset(half) + i % half;
        const float t = skv_gauss_node[at], range = i < half ? high - horizon : -1.0f - horizon;
        const float mu = horizon + range * t * t;
        const float weight =
            2.0f * t * skv_fabsf(range) * skv_gauss_weight[at] * 2.0f * SKV_PI / SKV_IRRADIANCE_AZIMUTHS;
        const float s = skv_sqrtf(skv_maxf((1.0f - mu) * (1.0f + mu), 0.0f));
        float v[SKV_IRRADIANCE_AZIMUTHS][3], radiance[SKV_IRRADIANCE_AZIMUTHS * SKV_BANDS_MAX];
        for (int k = 0; k < SKV_IRRADIANCE_AZIMUTHS; k++) {
            const skv_sincos phi = skv_sincosf(((float)k + 0.5f) * (2.0f * SKV_PI / SKV_IRRADIANCE_AZIMUTHS));
            v[k][0] = s * phi.cos;
            v[k][1] = s * phi.sin;
            v[k][2] = mu;
        }
        const skv_rays rays = {v[0], 0, NULL, 0};
        const skv_sky sky = {radiance, 0, NULL, 0};
        (void)skv_radiance(&whole, SKV_IRRADIANCE_AZIMUTHS, &rays, &sky);
        for (int k = 0; k < SKV_IRRADIANCE_AZIMUTHS; k++)
            for (int b = 0; b < bands; b++)
                out[b] += weight * skv_maxf(skv_irradiance_dot(v[k], n), 0.0f) * radiance[k * bands + b];
    }
}
#endif

static skv_status skv_irradiance_check(const skv_frame *frame, uint32_t parts, size_t normal_stride,
                                       size_t irradiance_stride) {
    if (frame->layout != SKV_LAYOUT || !frame->model || frame->model->layout != SKV_LAYOUT)
        return SKV_ERR_LAYOUT;
    if ((parts & ~(uint32_t)SKV_IRRADIANCE_ALL) != 0)
        return SKV_ERR_RANGE;
    if ((parts & SKV_IRRADIANCE_DIRECT) != 0 && !SKV_OUT_TRANSMITTANCE)
        return SKV_ERR_UNSUPPORTED;
    if ((parts & SKV_IRRADIANCE_DIFFUSE) != 0 && !frame->diffuse.table)
        return SKV_ERR_LAYOUT;
    const size_t wide = (size_t)skv_bands(frame->model) * sizeof(float);
    if (normal_stride % sizeof(float) != 0 || (normal_stride != 0 && normal_stride < 3 * sizeof(float)) ||
        irradiance_stride % sizeof(float) != 0 || (irradiance_stride != 0 && irradiance_stride < wide))
        return SKV_ERR_SIZE;
    return SKV_OK;
}

skv_status skv_irradiance(const skv_frame *frame, uint32_t parts, size_t n, const float *normal_enu,
                          size_t normal_stride, float *irradiance, size_t irradiance_stride) {
    if (!frame || !normal_enu || !irradiance)
        return SKV_ERR_NULL;
    const skv_status status = skv_irradiance_check(frame, parts, normal_stride, irradiance_stride);
    if (status != SKV_OK)
        return status;
    const int bands = skv_bands(frame->model);
    const size_t from = normal_stride ? normal_stride : 3 * sizeof(float);
    const size_t to = irradiance_stride ? irradiance_stride : (size_t)bands * sizeof(float);
    float direct[SKV_LIGHTS_MAX][SKV_BANDS_MAX];
    int bad = 0;
#if SKV_TERM_DIFFUSE
    skv_irradiance_cell cell[SKV_LIGHTS_MAX];
    const int diffuse = (parts & SKV_IRRADIANCE_DIFFUSE) != 0, space = frame->height_km > frame->top_km;
    for (int i = 0; i < frame->lights && diffuse && !space; i++)
        skv_irradiance_read(frame, i, &cell[i]);
#endif
    for (int i = 0; i < frame->lights && (parts & SKV_IRRADIANCE_DIRECT) != 0; i++)
        skv_irradiance_transmittance(frame, i, direct[i]);
    for (size_t j = 0; j < n; j++) {
        float normal[3], sum[SKV_BANDS_MAX] = {0.0f};
        float *const out = (float *)(void *)((char *)irradiance + j * to);
        if (!skv_unit((const float *)(const void *)((const char *)normal_enu + j * from), normal)) {
            bad = 1;
        } else {
            for (int i = 0; i < frame->lights && (parts & SKV_IRRADIANCE_DIRECT) != 0; i++) {
                const float c = skv_maxf(skv_irradiance_dot(normal, frame->light[i].direction_enu), 0.0f);
                for (int b = 0; b < bands; b++)
                    sum[b] += c * direct[i][b] * frame->light[i].irradiance[b];
            }
#if SKV_TERM_DIFFUSE
            if (diffuse && space)
                skv_irradiance_from_space(frame, normal, sum);
            for (int i = 0; i < frame->lights && diffuse && !space; i++)
                skv_irradiance_from_cell(frame, i, &cell[i], normal, sum);
#endif
        }
        for (int b = 0; b < bands; b++)
            out[b] = skv_minf(sum[b], SKV_RADIANCE_MAX);
    }
    return bad ? SKV_ERR_DIRECTION : SKV_OK;
}
