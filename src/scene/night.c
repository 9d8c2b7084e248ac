/// The night floor. Everything is a ratio to the sun's irradiance in the band.
#include "skyvert/night.h"

#include "scene/view.h"

/// 1 S10: 10^(-0.4 (10 + 26.74)) of the sun's irradiance over one square degree [Leinert98] sec. 2; the sun's V is
/// -26.74.
#define S10_PER_SR 6.61e-12f

/// Airglow over sunlight at the middles of U, B, V, R, I, 1 at V: the zenith of [Benn98] (U 22.0, B 22.7, V 21.9, R
/// 21.0, I 20.0, solar minimum) and of [Patat03] (22.3, 22.6, 21.6, 20.9, 19.7, maximum) in S10 of sunlight (the
/// sun's U-B .18, B-V .65, V-R .36, V-I .70), less 75 S10 from beyond the air, and the mean of both.
#define AIRGLOW_NODES 5
static const float airglow_nm[AIRGLOW_NODES] = {365.0f, 440.0f, 550.0f, 640.0f, 790.0f};
static const float airglow_ratio[AIRGLOW_NODES] = {1.8f, 0.70f, 1.0f, 1.8f, 3.9f};

/// What comes from all round, over the zenith's: the mean over the sphere as the air's source of scattered light.
/// Airglow brightens to the horizon, what is beyond the air does not; both come from above alone. Chosen by
/// tests/scene/test_night.c, which integrates single scattering. The ground's light comes from below, on half of the
/// sphere.
#define AIRGLOW_ROUND 0.9f
#define BEYOND_ROUND  0.4f
#define GROUND_ROUND  0.5f
/// Irradiance of the airglow on level ground, over pi times the zenith's radiance: 1.71 without extinction.
#define AIRGLOW_GROUND 1.5f

typedef struct night_bands {
    float airglow[4], beyond[4]; ///< radiance at the zenith
    float round[4], ground[4];   ///< scattered in where nothing comes through; sent back by the ground
} night_bands;

skv_status skv_night_earth(skv_night *night) {
    if (night == NULL)
        return SKV_ERR_NULL;
    *night = (skv_night){1.0f, 145.0f, 60.0f, 30.0f, {85.0f, 95.0f}};
    return SKV_OK;
}

static float airglow_at(float nm) {
    int i = 0;
    while (i < AIRGLOW_NODES - 2 && nm > airglow_nm[i + 1])
        i++;
    const float t = skv_clampf((nm - airglow_nm[i]) / (airglow_nm[i + 1] - airglow_nm[i]), 0.0f, 1.0f);
    return airglow_ratio[i] + t * (airglow_ratio[i + 1] - airglow_ratio[i]);
}

/// 1 + .6 log10(lambda/500 nm) [Leinert98] eq. 22, 90 deg and more from the sun.
static float zodiacal_at(float nm) {
    return 1.0f + 0.6f * 0.301029996f * skv_log2f(nm * (1.0f / 500.0f));
}

static void set_bands(night_bands *to, const skv_night *night, const skv_model *model) {
    for (int b = 0; b < model->bands; b++) {
        const float nm = model->wavelength_nm[b];
        const float unit = S10_PER_SR * night->scale * model->solar_irradiance[b] * model->absorption_colour[b];
        to->airglow[b] = unit * night->airglow_s10 * airglow_at(nm);
        to->beyond[b] = unit * (night->zodiacal_s10 * zodiacal_at(nm) + night->starlight_s10);
        to->ground[b] = model->albedo[b] * (AIRGLOW_GROUND * to->airglow[b] + to->beyond[b]);
        to->round[b] = AIRGLOW_ROUND * to->airglow[b] + BEYOND_ROUND * to->beyond[b] + GROUND_ROUND * to->ground[b];
    }
}

/// Length of a ray, up to `end`, within the sphere at altitude `top_km` above the ground.
static float within(const skv_frame *frame, skv_vec3 v, float top_km, float end_km) {
    const float radius = frame->radius_km, h = frame->height_km, r = radius + h, rt = radius + top_km;
    const float rm = r * v.z, p = r * skv_sqrtf(v.x * v.x + v.y * v.y);
    const float c = (top_km - h) * (2.0f * radius + h + top_km);
    // As the core does it: by the altitudes where the ray is flat, by its distance from the centre where it is steep.
    const float square = skv_fabsf(rm) < p ? rm * rm + c : (rt - p) * (rt + p);
    if (!(square > 0.0f))
        return 0.0f;
    const float root = skv_sqrtf(square);
    // Both ends without a difference of large numbers: their product is -c.
    const float q = skv_fabsf(rm) + root;
    const float far = rm > 0.0f ? c / q : q, near = rm > 0.0f ? -q : -c / q;
    return skv_maxf(skv_minf(far, end_km) - skv_maxf(near, 0.0f), 0.0f);
}

/// Path through the layer over its thickness: all of it, and what lies before the air for one who looks down at it.
typedef struct airglow_path {
    float all, before;
} airglow_path;

static float through_layer(const skv_night *night, const skv_frame *frame, skv_vec3 v, float end_km) {
    const float lower = skv_maxf(night->layer_km[0] - frame->ground_km, 0.0f);
    const float upper = skv_maxf(night->layer_km[1] - frame->ground_km, lower);
    const float path = within(frame, v, upper, end_km) - within(frame, v, lower, end_km);
    return skv_maxf(path, 0.0f) / (night->layer_km[1] - night->layer_km[0]);
}

static airglow_path airglow_of(const skv_night *night, const skv_frame *frame, skv_vec3 v, float end_km) {
    const float nearest = -(frame->radius_km + frame->height_km) * v.z;
    const float all = through_layer(night, frame, v, end_km);
    const bool above = frame->height_km > frame->top_km && nearest > 0.0f;
    return (airglow_path){all, above ? through_layer(night, frame, v, skv_minf(end_km, nearest)) : 0.0f};
}

static bool good_night(const skv_night *night) {
    const float field[4] = {night->scale, night->airglow_s10, night->zodiacal_s10, night->starlight_s10};
    for (int i = 0; i < 4; i++)
        if (!(field[i] >= 0.0f && field[i] <= 1.0e6f))
            return false;
    const float *const layer = night->layer_km;
    return layer[0] >= 20.0f && layer[1] <= 1000.0f && layer[1] - layer[0] >= 1.0f;
}

skv_status skv_night_add(const skv_night *night, const skv_frame *frame, size_t n, const skv_rays *rays,
                         const skv_sky *sky) {
    skv_batch batch;
    if (night == NULL || sky == NULL)
        return SKV_ERR_NULL;
    const skv_status status = skv_batch_of(&batch, frame, rays, sky);
    if (status != SKV_OK)
        return status;
    if (!good_night(night))
        return SKV_ERR_RANGE;
    night_bands bands;
    set_bands(&bands, night, frame->model);
    bool bad = false;
    for (size_t i = 0; i < n; i++) {
        skv_view view;
        if (!skv_batch_view(&batch, i, &view)) {
            bad = true;
            continue;
        }
        const skv_ground ground = skv_view_ground(frame, view.unit);
        const float end = ground.hit ? skv_minf(view.length_km, ground.distance_km) : view.length_km;
        const airglow_path path = airglow_of(night, frame, view.unit, end);
        const bool open = !skv_isfinite(end), lit = ground.hit && view.length_km >= ground.distance_km;
        for (size_t b = 0; b < batch.bands; b++) {
            const float t = skv_batch_transmittance(&batch, i, b);
            const float behind = (open ? bands.beyond[b] : 0.0f) + (lit ? bands.ground[b] : 0.0f);
            const float airglow = bands.airglow[b] * (path.before + t * (path.all - path.before));
            skv_batch_add(&batch, i, b, t * behind + (1.0f - t) * bands.round[b] + airglow);
        }
    }
    return bad ? SKV_ERR_DIRECTION : SKV_OK;
}
