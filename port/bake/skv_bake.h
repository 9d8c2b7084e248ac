/// Tables of `skyvert bake`: what lies where, and lookups as a GPU's linear filter does them. One header, C99 and C++;
/// needs sqrtf() and memcpy() only. skv_bake.glsl is its twin for shaders; skv_bake_file.h reads the files.
///
/// Every table is a texture of `width` x `height` x `depth` texels in up to four layers of the same shape,
/// [layer][z][y][x][channel], a channel per band (ascending wavelengths). A texel's position i on an axis of n stands
/// for the value u = i/(n - 1) of that axis' mapping, so linear filtering at the texture coordinate (i + .5)/n meets it
/// exactly. Value = texel/scale[layer].
///
///     sky-view        x azimuth from the sun, y rows                  one observer, one sun
///     transmittance   x rows, y altitude                              to the top of the air, or to the ground
///     scattering-3d   x azimuth and sun, y rows, z altitude           any observer in the air, any sun
///     irradiance      x sun, y altitude                               of horizontal surfaces
///
/// rows      first half sky, zenith (row 0) to horizon; second half ground, horizon to nadir. u is 1 at zenith and
///           nadir, 0 at the horizon, where rows crowd and which no filter reaches over [Bruneton08, section 4].
///           Sky: sin(d/2) = u^2 sin(D/2), d the angle from the geometric horizon, D that of the zenith, much as in
///           [Hillaire20] section 5.3; seen from above the air D is that of the air's edge, beyond is space. Ground:
///           the ray's length is a + (1 - u)^2 (b - a), a that to the nadir, b to the horizon: what is scattered into a
///           ray to the ground goes with its length, as in [Bruneton08].
/// azimuth   u = sin(phi/2), phi from the sun's azimuth: half of the sky, the other half is its mirror image. Linear at
///           the sun, quadratic opposite, where everything is even.
/// sun       w = .74 - sin(Z/2), g = w/(.12 + |w|), Z the sun's zenith angle; u runs evenly in g from the lowest sun
///           (mu_s_min = its cos Z) to the zenith. Dense in twilight, where light falls to 1/e within a degree.
/// altitude  above the ground h = top_km u^2: nearly rho/H of [Bruneton08] section 4.
/// scattering-3d packs azimuth and sun in x as [azimuth][sun], as [Bruneton08] does with nu and mu_s: filter two
/// azimuths apart and mix them.
///
/// Deferred phase functions: layer 0 is all light but what aerosol (and dust) scatter once; layer 1 (and 2) are these,
/// divided by their phase functions: radiance = layer 0 + p_1(nu) layer 1 + ... The single scattering of the aureole is
/// exact then, whatever the size of the table.
#ifndef SKV_PORT_BAKE_H
#define SKV_PORT_BAKE_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { SKV_BAKE_SKY_VIEW = 0, SKV_BAKE_TRANSMITTANCE = 1, SKV_BAKE_SCATTERING = 2, SKV_BAKE_IRRADIANCE = 3 };
enum { SKV_BAKE_HG = 0, SKV_BAKE_CS = 1 }; ///< phase: Henyey-Greenstein, Cornette-Shanks

#define SKV_BAKE_LAYERS_MAX   4
#define SKV_BAKE_DEFERRED_MAX 2

/// Layers of irradiance, W m^-2 nm^-1: of the sky on a surface that faces up, of the air and ground below on one that
/// faces down, of the sun on one that faces it.
enum { SKV_BAKE_DOWN = 0, SKV_BAKE_UP = 1, SKV_BAKE_BEAM = 2 };

typedef struct skv_bake_table {
    int32_t what;                     ///< SKV_BAKE_*
    int32_t width, height, depth;     ///< texels
    int32_t layers, channels;         ///< [1, 4], 3 or 4
    int32_t azimuths;                 ///< scattering-3d: width = azimuths x suns; else 1
    int32_t deferred;                 ///< layers from 1 on that lack a phase function; sky-view, scattering-3d
    int32_t phase[2];                 ///< of layers 1 and 2: SKV_BAKE_HG or _CS
    float g[2];                       ///< its parameter
    float radius_km;                  ///< of the ground
    float top_km;                     ///< of the air, above the ground
    float height_km;                  ///< sky-view: of the observer above the ground
    float mu_s;                       ///< sky-view: cosine of the sun's zenith angle
    float mu_s_min;                   ///< of the sun axis
    float scale[SKV_BAKE_LAYERS_MAX]; ///< value = texel/scale
    const uint16_t *half;             ///< texels as IEEE 754 binary16, or
    const float *texel;               ///< as floats; the other one is NULL
} skv_bake_table;

// ---- mappings; positions are in texels, [0, n - 1]

static inline float skv_bake_clamp(float x, float low, float high) {
    return x < low ? low : x > high ? high : x; // NaN stays NaN: no table is read there, see skv_bake_mix()
}

/// Cosine of the horizon's zenith angle (<= 0) and its sine, for an observer at an altitude above the ground.
static inline void skv_bake_horizon(const skv_bake_table *t, float altitude_km, float *mu, float *sine) {
    const float h = altitude_km > 0.0f ? altitude_km : 0.0f, r = t->radius_km + h;
    *mu = -sqrtf(h * (t->radius_km + r)) / r;
    *sine = t->radius_km / r;
}

/// Sine of half the angle between the horizon and the last row of the sky.
static inline float skv_bake_sky(const skv_bake_table *t, float altitude_km, float horizon, float sine) {
    if (!(altitude_km > t->top_km))
        return sqrtf(0.5f * (1.0f - horizon));
    const float r = t->radius_km + altitude_km, level = (t->radius_km + t->top_km) / r;
    const float mu = -sqrtf((altitude_km - t->top_km) * (t->radius_km + t->top_km + r)) / r;
    return (mu * sine - level * horizon) / sqrtf(2.0f * (1.0f + level * sine + mu * horizon));
}

/// Lengths of rays to the ground, km: to the nadir and to the horizon. A millimetre at least.
static inline void skv_bake_ground(const skv_bake_table *t, float altitude_km, float *shortest, float *longest) {
    const float h = altitude_km > 1e-6f ? altitude_km : 1e-6f;
    *shortest = h;
    *longest = sqrtf(h * (2.0f * t->radius_km + h));
}

/// Position in n rows of a direction with the cosine mu and the sine `level` of its zenith angle.
static inline float skv_bake_row(const skv_bake_table *t, int32_t n, float altitude_km, float mu, float level) {
    const float last = (float)(n / 2 - 1);
    float horizon, sine, shortest, longest;
    skv_bake_horizon(t, altitude_km, &horizon, &sine);
    const float sin_d = mu * sine - level * horizon, cos_d = level * sine + mu * horizon;
    if (sin_d >= 0.0f) { // sky
        const float chord = sin_d / sqrtf(2.0f * skv_bake_clamp(1.0f + cos_d, 1e-6f, 2.0f));
        return last * (1.0f - sqrtf(skv_bake_clamp(chord / skv_bake_sky(t, altitude_km, horizon, sine), 0.0f, 1.0f)));
    }
    // mu^2 - horizon^2 as a product of sines: no digits are lost at the horizon.
    skv_bake_ground(t, altitude_km, &shortest, &longest);
    const float root = sqrtf(skv_bake_clamp(sin_d * (mu * sine + level * horizon), 0.0f, 1.0f));
    const float length = longest * longest / ((t->radius_km + shortest) * (root - mu));
    return (float)(n / 2) +
           last * (1.0f - sqrtf(skv_bake_clamp((length - shortest) / (longest - shortest), 0.0f, 1.0f)));
}

/// The direction of a row: inverse of skv_bake_row(). The two rows at the horizon lie 2e-6 rad on their side of it.
static inline void skv_bake_row_direction(const skv_bake_table *t, int32_t n, float altitude_km, int32_t row, float *mu,
                                          float *level) {
    const int32_t sky = row < n / 2, from = sky ? n / 2 - 1 - row : row - n / 2;
    const float u = (float)from / (float)(n / 2 - 1), off = 2e-6f;
    float horizon, sine, shortest, longest;
    skv_bake_horizon(t, altitude_km, &horizon, &sine);
    if (from == n / 2 - 1 && !(sky && altitude_km > t->top_km)) { // zenith and nadir
        *mu = sky ? 1.0f : -1.0f;
        *level = 0.0f;
    } else if (from == 0) {
        *mu = horizon + (sky ? off : -off) * sine;
        *level = sine - (sky ? off : -off) * horizon;
    } else if (sky) {
        const float chord = u * u * skv_bake_sky(t, altitude_km, horizon, sine), cos_d = 1.0f - 2.0f * chord * chord;
        const float sin_d = 2.0f * chord * sqrtf((1.0f - chord) * (1.0f + chord));
        *mu = horizon * cos_d + sine * sin_d;
        *level = sine * cos_d - horizon * sin_d;
    } else {
        skv_bake_ground(t, altitude_km, &shortest, &longest);
        const float length = shortest + (1.0f - u) * (1.0f - u) * (longest - shortest);
        *mu = -(longest * longest + length * length) / (2.0f * (t->radius_km + shortest) * length);
        *level = sqrtf(skv_bake_clamp((1.0f - *mu) * (1.0f + *mu), 0.0f, 1.0f));
    }
}

/// u of the azimuth axis: half the chord between two horizontal directions; 0 where one of them is vertical.
static inline float skv_bake_azimuth(const float view_enu[3], const float sun_enu[3]) {
    const float v = sqrtf(view_enu[0] * view_enu[0] + view_enu[1] * view_enu[1]);
    const float s = sqrtf(sun_enu[0] * sun_enu[0] + sun_enu[1] * sun_enu[1]);
    if (!(v > 0.0f) || !(s > 0.0f))
        return 0.0f;
    const float x = view_enu[0] / v - sun_enu[0] / s, y = view_enu[1] / v - sun_enu[1] / s;
    return skv_bake_clamp(0.5f * sqrtf(x * x + y * y), 0.0f, 1.0f);
}

static inline float skv_bake_sun_g(float mu_s) {
    const float w = 0.74f - sqrtf(skv_bake_clamp(0.5f * (1.0f - mu_s), 0.0f, 1.0f));
    return w / (0.12f + fabsf(w));
}

/// u of the sun axis, and its inverse.
static inline float skv_bake_sun(const skv_bake_table *t, float mu_s) {
    const float first = skv_bake_sun_g(t->mu_s_min), last = skv_bake_sun_g(1.0f);
    return skv_bake_clamp((skv_bake_sun_g(mu_s) - first) / (last - first), 0.0f, 1.0f);
}

static inline float skv_bake_sun_mu_s(const skv_bake_table *t, float u) {
    const float first = skv_bake_sun_g(t->mu_s_min), g = first + u * (skv_bake_sun_g(1.0f) - first);
    const float sine = 0.74f - 0.12f * g / (1.0f - fabsf(g)); // of half the zenith angle
    return u >= 1.0f ? 1.0f : 1.0f - 2.0f * sine * sine;
}

/// u of the altitude axis. Above the air as at its top: start the ray where it enters the air.
static inline float skv_bake_altitude(const skv_bake_table *t, float altitude_km) {
    return sqrtf(skv_bake_clamp(altitude_km / t->top_km, 0.0f, 1.0f));
}

// ---- texels

static inline float skv_bake_half(uint16_t half) {
    const uint32_t sign = (uint32_t)(half & 0x8000u) << 16, size = half & 0x7fffu;
    uint32_t bits;
    float x;
    if (size < 0x0400u) { // subnormal
        x = (float)size * 5.9604644775390625e-8f;
        return sign ? -x : x;
    }
    bits = sign | ((size << 13) + (112u << 23));
    memcpy(&x, &bits, sizeof x);
    return x;
}

static inline size_t skv_bake_layer_values(const skv_bake_table *t) {
    return (size_t)t->width * (size_t)t->height * (size_t)t->depth * (size_t)t->channels;
}

/// Adds weight x the texel at (x, y, z).
static inline void skv_bake_add(const skv_bake_table *t, int32_t layer, int32_t x, int32_t y, int32_t z, float weight,
                                float sum[4]) {
    const size_t texel = ((size_t)z * (size_t)t->height + (size_t)y) * (size_t)t->width + (size_t)x;
    const size_t at = (size_t)layer * skv_bake_layer_values(t) + texel * (size_t)t->channels;
    const float w = weight / t->scale[layer];
    for (int32_t c = 0; c < t->channels; c++)
        sum[c] += w * (t->half ? skv_bake_half(t->half[at + (size_t)c]) : t->texel[at + (size_t)c]);
}

/// Whole part of a position, so that the next one is there too; NaN as 0.
static inline int32_t skv_bake_floor(float position, int32_t n, float *rest) {
    const float p = position >= 0.0f ? position : 0.0f;
    const int32_t most = n > 1 ? n - 2 : 0, whole = p < (float)most ? (int32_t)p : most;
    *rest = n > 1 ? skv_bake_clamp(p - (float)whole, 0.0f, 1.0f) : 0.0f;
    return whole;
}

/// Adds weight x the texels about a position, x within [first, first + n).
static inline void skv_bake_mix(const skv_bake_table *t, int32_t layer, int32_t first, int32_t n, float x, float y,
                                float z, float weight, float sum[4]) {
    float fx, fy, fz;
    const int32_t ix = first + skv_bake_floor(x, n, &fx), iy = skv_bake_floor(y, t->height, &fy);
    const int32_t iz = skv_bake_floor(z, t->depth, &fz);
    for (int32_t k = 0; k < 8; k++) {
        const int32_t dx = k & 1, dy = k >> 1 & 1, dz = k >> 2;
        const float w = (dx ? fx : 1.0f - fx) * (dy ? fy : 1.0f - fy) * (dz ? fz : 1.0f - fz);
        if (w > 0.0f)
            skv_bake_add(t, layer, ix + dx, iy + dy, iz + dz, weight * w, sum);
    }
}

// ---- lookups; directions east-north-up (or any frame whose z is up), unit length

static inline float skv_bake_level(const float direction[3]) {
    return sqrtf(direction[0] * direction[0] + direction[1] * direction[1]);
}

/// Phase function that a deferred layer lacks, 1/sr. 1 - nu comes from the difference of the directions: exact about
/// the sun.
static inline float skv_bake_phase(const skv_bake_table *t, int32_t layer, const float view_enu[3],
                                   const float sun_enu[3]) {
    const float x = view_enu[0] - sun_enu[0], y = view_enu[1] - sun_enu[1], z = view_enu[2] - sun_enu[2];
    const float away = skv_bake_clamp(0.5f * (x * x + y * y + z * z), 0.0f, 2.0f), nu = 1.0f - away;
    const float g = t->g[layer - 1];
    const float d =
        g >= 0.0f ? (1.0f - g) * (1.0f - g) + 2.0f * g * away : (1.0f + g) * (1.0f + g) - 2.0f * g * (2.0f - away);
    const float hg = (1.0f - g * g) / (d * sqrtf(d)) * 0.0795774715f; // 1/4pi
    return t->phase[layer - 1] == SKV_BAKE_HG ? hg : hg * 1.5f * (1.0f + nu * nu) / (2.0f + g * g);
}

/// sky-view: radiance, W m^-2 sr^-1 nm^-1 (or RGB); transmittance to the end of the ray, NULL = not wanted.
static inline void skv_bake_sky_view(const skv_bake_table *t, const float view_enu[3], const float sun_enu[3],
                                     float radiance[4], float transmittance[4]) {
    const float x = skv_bake_azimuth(view_enu, sun_enu) * (float)(t->width - 1);
    const float y = skv_bake_row(t, t->height, t->height_km, view_enu[2], skv_bake_level(view_enu));
    for (int32_t c = 0; c < 4; c++)
        radiance[c] = 0.0f;
    skv_bake_mix(t, 0, 0, t->width, x, y, 0.0f, 1.0f, radiance);
    for (int32_t l = 1; l <= t->deferred; l++)
        skv_bake_mix(t, l, 0, t->width, x, y, 0.0f, skv_bake_phase(t, l, view_enu, sun_enu), radiance);
    if (!transmittance)
        return;
    for (int32_t c = 0; c < 4; c++)
        transmittance[c] = 0.0f;
    if (t->layers > 1 + t->deferred)
        skv_bake_mix(t, 1 + t->deferred, 0, t->width, x, y, 0.0f, 1.0f, transmittance);
}

/// transmittance: from an altitude above the ground towards a zenith angle of cosine mu, to the top of the air or to
/// the ground.
static inline void skv_bake_transmittance(const skv_bake_table *t, float altitude_km, float mu, float out[4]) {
    const float level = sqrtf(skv_bake_clamp((1.0f - mu) * (1.0f + mu), 0.0f, 1.0f));
    const float x = skv_bake_row(t, t->width, altitude_km, mu, level);
    const float y = skv_bake_altitude(t, altitude_km) * (float)(t->height - 1);
    for (int32_t c = 0; c < 4; c++)
        out[c] = 0.0f;
    skv_bake_mix(t, 0, 0, t->width, x, y, 0.0f, 1.0f, out);
}

/// scattering-3d: radiance that reaches an altitude above the ground from a direction.
static inline void skv_bake_scattering(const skv_bake_table *t, float altitude_km, const float view_enu[3],
                                       const float sun_enu[3], float radiance[4]) {
    const int32_t suns = t->width / t->azimuths;
    float part;
    const float a = skv_bake_azimuth(view_enu, sun_enu) * (float)(t->azimuths - 1);
    const float x = skv_bake_sun(t, sun_enu[2]) * (float)(suns - 1);
    const float y = skv_bake_row(t, t->height, altitude_km, view_enu[2], skv_bake_level(view_enu));
    const float z = skv_bake_altitude(t, altitude_km) * (float)(t->depth - 1);
    const int32_t first = suns * skv_bake_floor(a, t->azimuths, &part);
    for (int32_t c = 0; c < 4; c++)
        radiance[c] = 0.0f;
    for (int32_t layer = 0; layer <= t->deferred; layer++) {
        const float weight = layer == 0 ? 1.0f : skv_bake_phase(t, layer, view_enu, sun_enu);
        skv_bake_mix(t, layer, first, suns, x, y, z, weight * (1.0f - part), radiance);
        skv_bake_mix(t, layer, first + suns, suns, x, y, z, weight * part, radiance);
    }
}

/// irradiance: of a layer (SKV_BAKE_DOWN, _UP, _BEAM), W m^-2 nm^-1.
static inline void skv_bake_irradiance(const skv_bake_table *t, int32_t layer, float altitude_km, float mu_s,
                                       float out[4]) {
    const float x = skv_bake_sun(t, mu_s) * (float)(t->width - 1);
    const float y = skv_bake_altitude(t, altitude_km) * (float)(t->height - 1);
    for (int32_t c = 0; c < 4; c++)
        out[c] = 0.0f;
    skv_bake_mix(t, layer, 0, t->width, x, y, 0.0f, 1.0f, out);
}

#ifdef __cplusplus
}
#endif
#endif
