/// Moonlight: the disc-equivalent albedo of [Kieffer05], its colour and phase, and earthshine.
#include "skyvert/moonlight.h"

#include "scene/rolo.h"
#include "scene/vector.h"
#include "scene/view.h"

#define RAD_PER_DEG    0.0174532925f
#define AU_KM          149597871.0f
#define MOON_RADIUS_KM 1737.4f

/// Phase angles, deg: [Kieffer05] ends at 97, the next law is alone from 115; it was fitted to 150 at most.
#define ROLO_END_DEG   97.0f
#define ALLEN_ONLY_DEG 115.0f
#define ALLEN_END_DEG  150.0f

/// Bands scatter by some per cent from one to the next. Their logarithms are smoothed over this, nm.
#define SMOOTH_NM 30.0f

/// Earth as seen from the moon: a Lambert sphere, geometric albedo 2/3 of the Bond albedo .297 [Goode01].
#define EARTH_ALBEDO    0.198f
#define EARTH_RADIUS_KM 6371.0f

/// What depends on the phase angle alone.
typedef struct phase_terms {
    float g_rad, sun_rad; ///< phase angle; longitude of the sun on the moon
    float surge[2], wave; ///< exp(-g/p1), exp(-g/p2), cos((g - p3)/p4)
} phase_terms;

static phase_terms terms_at(float g_deg, int side) {
    phase_terms t;
    t.g_rad = g_deg * RAD_PER_DEG;
    t.sun_rad = side > 0 ? t.g_rad : side < 0 ? -t.g_rad : 0.0f;
    t.surge[0] = skv_expf(-g_deg / SKV_ROLO_P1);
    t.surge[1] = skv_expf(-g_deg / SKV_ROLO_P2);
    t.wave = skv_cosf((g_deg - SKV_ROLO_P3) / SKV_ROLO_P4);
    return t;
}

/// [Kieffer05] eq. 10 without libration: ln of the albedo in a band.
static float log_albedo(const skv_rolo_band *k, const phase_terms *t) {
    const float g = t->g_rad, s = t->sun_rad, s2 = s * s;
    return k->a[0] + g * (k->a[1] + g * (k->a[2] + g * k->a[3])) + s * (k->b[0] + s2 * (k->b[1] + s2 * k->b[2])) +
           k->d[0] * t->surge[0] + k->d[1] * t->surge[1] + k->d[2] * t->wave;
}

/// At any wavelength: the straight line through the bands, weighed by how near they are, 1/(1 + x^2)^2.
static float log_albedo_at(float nm, const phase_terms *t) {
    const float x_nm = skv_clampf(nm, skv_rolo[0].nm, skv_rolo[SKV_ROLO_BANDS - 1].nm);
    float w0 = 0.0f, w1 = 0.0f, w2 = 0.0f, y0 = 0.0f, y1 = 0.0f;
    for (int i = 0; i < SKV_ROLO_BANDS; i++) {
        const float x = (skv_rolo[i].nm - x_nm) * (1.0f / SMOOTH_NM), near = 1.0f / (1.0f + x * x);
        const float w = near * near, y = log_albedo(&skv_rolo[i], t);
        w0 += w;
        w1 += w * x;
        w2 += w * x * x;
        y0 += w * y;
        y1 += w * x * y;
    }
    return (w2 * y0 - w1 * y1) / (w0 * w2 - w1 * w1);
}

static float smooth_step(float x, float from, float to) {
    const float t = skv_clampf((x - from) / (to - from), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// ln of the brightness by [Allen73]: m = 0.026 g + 4e-9 g^4.
static float log_allen(float g_deg) {
    const float g2 = g_deg * g_deg;
    return -0.921034037f * (0.026f * g_deg + 4.0e-9f * g2 * g2);
}

/// To 0 at 180 deg.
static float led_out(float g_deg) {
    const float t = skv_clampf((g_deg - ALLEN_END_DEG) / (180.0f - ALLEN_END_DEG), 0.0f, 1.0f);
    return (1.0f - t * t) * (1.0f - t * t);
}

static float albedo_at(float nm, float g_deg, int side) {
    const phase_terms t = terms_at(skv_minf(g_deg, ALLEN_ONLY_DEG), side);
    const float rolo = log_albedo_at(nm, &t);
    if (g_deg <= ROLO_END_DEG)
        return skv_expf(rolo);
    const phase_terms end = terms_at(ROLO_END_DEG, side);
    const float allen = log_albedo_at(nm, &end) + log_allen(g_deg) - log_allen(ROLO_END_DEG);
    return skv_expf(rolo + smooth_step(g_deg, ROLO_END_DEG, ALLEN_ONLY_DEG) * (allen - rolo)) * led_out(g_deg);
}

float skv_moon_albedo(float wavelength_nm, float phase_angle_deg, int side) {
    if (!(wavelength_nm >= 200.0f && wavelength_nm <= 3000.0f) ||
        !(phase_angle_deg >= 0.0f && phase_angle_deg <= 180.0f))
        return 0.0f;
    return skv_minf(albedo_at(wavelength_nm, phase_angle_deg, side), 1.0f);
}

/// Sunlight that the Earth sends to the moon, per unit of sunlight there: p (R/d)^2 times Lambert's phase law at the
/// Earth's phase angle, which is 180 deg less the moon's.
static float earthlight(float g_deg, float distance_km) {
    const float a = (180.0f - g_deg) * RAD_PER_DEG, ratio = EARTH_RADIUS_KM / distance_km;
    const skv_sincos s = skv_sincosf(a);
    const float phase = (s.sin + (SKV_PI - a) * s.cos) * (1.0f / SKV_PI);
    return EARTH_ALBEDO * ratio * ratio * skv_maxf(phase, 0.0f);
}

skv_status skv_moonlight_at(skv_moonlight *moonlight, const skv_model *model, const skv_moon *moon,
                            float sun_distance_au, int side) {
    if (moonlight == NULL || model == NULL || moon == NULL)
        return SKV_ERR_NULL;
    if (!skv_model_ok(model))
        return SKV_ERR_LAYOUT;
    const float g = moon->phase_angle_deg, d = moon->distance_km;
    if (!(g >= 0.0f && g <= 180.0f) || !(d >= 3000.0f && d <= 1.0e7f) ||
        !(sun_distance_au >= 0.9f && sun_distance_au <= 1.1f))
        return SKV_ERR_RANGE;
    // The moon is further from the sun than the observer when it is full.
    const float sun = sun_distance_au + d / AU_KM * skv_cosf(g * RAD_PER_DEG), inv2 = 1.0f / (sun * sun);
    const float sine = MOON_RADIUS_KM / d, earth = earthlight(g, d);
    skv_moonlight made = {.phase_angle_deg = g, .radius_rad = skv_asinf(sine)};
    for (int b = 0; b < model->bands; b++) {
        const float sunlight = model->solar_irradiance[b] * inv2, nm = model->wavelength_nm[b];
        made.irradiance[b] = skv_moon_albedo(nm, g, side) * sine * sine * sunlight;
        // Lit from where it is seen: phase angle 0.
        made.earthshine[b] = skv_moon_albedo(nm, 0.0f, 0) * (1.0f / SKV_PI) * earth * sunlight;
    }
    *moonlight = made;
    return SKV_OK;
}

skv_status skv_light_moon(skv_light *light, const skv_model *model, const skv_moon *moon, float sun_distance_au,
                          int side) {
    skv_moonlight moonlight;
    skv_vec3 toward;
    if (light == NULL)
        return SKV_ERR_NULL;
    const skv_status status = skv_moonlight_at(&moonlight, model, moon, sun_distance_au, side);
    if (status != SKV_OK)
        return status;
    if (!skv_unit3(moon->direction_enu, &toward))
        return SKV_ERR_DIRECTION;
    *light = (skv_light){{toward.x, toward.y, toward.z}, {0.0f}};
    for (int b = 0; b < model->bands; b++)
        light->irradiance[b] = moonlight.irradiance[b];
    return SKV_OK;
}

/// Both move eastward about the pole: waxing where the moon is less than half a turn ahead.
int skv_moon_side(const float moon_enu[3], const float sun_enu[3], float lat_deg) {
    skv_vec3 moon, sun;
    if (moon_enu == NULL || sun_enu == NULL || !(lat_deg >= -90.0f && lat_deg <= 90.0f) ||
        !skv_unit3(moon_enu, &moon) || !skv_unit3(sun_enu, &sun))
        return 0;
    const skv_sincos lat = skv_sincosf(lat_deg * RAD_PER_DEG);
    const skv_vec3 pole = {0.0f, lat.cos, lat.sin};
    return skv_dot(skv_cross(sun, moon), pole) >= 0.0f ? 1 : -1;
}
