/// Water: mirror directions over a curved sea, Fresnel reflectance flat and averaged over slopes, glitter.
#include "skyvert/water.h"

#include "scene/view.h"

#define RAD_PER_DEG 0.0174532925f

/// Least mean square slope along the wind: a calm sea is nearly flat there, the glint must stay finite.
#define SLOPE2_MIN 1.0e-4f

skv_status skv_water_flat(skv_water *water) {
    if (water == NULL)
        return SKV_ERR_NULL;
    *water = (skv_water){1.333f, 0.0f, 0.0f, 0.0f};
    return SKV_OK;
}

skv_status skv_water_wind(skv_water *water, float wind_m_s, float wind_azimuth_deg) {
    if (water == NULL)
        return SKV_ERR_NULL;
    if (!(wind_m_s >= 0.0f && wind_m_s <= SKV_WIND_MAX) || !(skv_fabsf(wind_azimuth_deg) <= 360.0f))
        return SKV_ERR_RANGE;
    *water =
        (skv_water){1.333f, skv_maxf(0.00316f * wind_m_s, SLOPE2_MIN), 0.003f + 0.00192f * wind_m_s, wind_azimuth_deg};
    return SKV_OK;
}

static bool good_water(const skv_water *water) {
    return water->refractive_index >= 1.01f && water->refractive_index <= 3.0f && water->slope2_along >= 0.0f &&
           water->slope2_along <= 0.25f && water->slope2_across >= 0.0f && water->slope2_across <= 0.25f &&
           skv_fabsf(water->wind_azimuth_deg) <= 360.0f;
}

/// With g = sqrt(n^2 - 1 + c^2): R = 1/2 ((g-c)/(g+c))^2 (1 + ((c(g+c) - 1)/(c(g-c) + 1))^2).
float skv_fresnel(float cos_incidence, float refractive_index) {
    const float c = skv_clampf(cos_incidence, 0.0f, 1.0f), n = skv_clampf(refractive_index, 1.0f, 10.0f);
    const float g = skv_sqrtf((n - 1.0f) * (n + 1.0f) + c * c), sum = g + c;
    if (!(sum > 0.0f))
        return 1.0f;
    // g - c without cancellation.
    const float difference = (n - 1.0f) * (n + 1.0f) / sum, s = difference / sum;
    const float p = (c * sum - 1.0f) / (c * difference + 1.0f);
    return skv_clampf(0.5f * s * s * (1.0f + p * p), 0.0f, 1.0f);
}

float skv_fresnel_schlick(float cos_incidence, float refractive_index) {
    const float n = skv_clampf(refractive_index, 1.0f, 10.0f), root = (n - 1.0f) / (n + 1.0f), f0 = root * root;
    const float x = 1.0f - skv_clampf(cos_incidence, 0.0f, 1.0f), x2 = x * x;
    return f0 + (1.0f - f0) * x2 * x2 * x;
}

/// Density of the normal distribution, and its integral up to a, over the density: Mills' ratio by erfcx.
typedef struct gauss_tail {
    float density, below;
} gauss_tail;

static gauss_tail gauss_below(float a) {
    const float b = skv_clampf(a, -13.0f, 13.0f), density = 0.398942280f * skv_expf(-0.5f * b * b);
    // Phi(-x) = exp(-x^2/2) erfcx(x/sqrt 2)/2 for x >= 0.
    const float tail = 1.25331414f * density * skv_erfcxf(skv_fabsf(b) * 0.707106781f);
    return (gauss_tail){density, b > 0.0f ? 1.0f - tail : tail};
}

/// Area of the rough surface that is seen per area of level sea, of facets that face the viewer; >= mu. a = mu/(s sin).
static float seen_area(float mu, float slope_sin) {
    if (!(slope_sin > 0.0f))
        return mu;
    const gauss_tail t = gauss_below(mu / slope_sin);
    return mu * t.below + slope_sin * t.density;
}

/// A point on the water and its own axes.
typedef struct water_point {
    skv_vec3 forward, left; ///< level unit vectors in the observer's axes: away from the observer, and left of that
    float arc_sin, arc_cos; ///< of the angle between observer and point, at the planet's centre
    float mu, sine;         ///< of the angle of incidence
    float distance_km;
} water_point;

/// False where the ray does not meet the water.
static bool water_at(const skv_frame *frame, const skv_view *view, water_point *point) {
    const skv_ground ground = skv_view_ground(frame, view->unit);
    if (!ground.hit || !(view->length_km >= ground.distance_km))
        return false;
    const skv_vec3 v = view->unit;
    const float level = skv_sqrtf(v.x * v.x + v.y * v.y), d = ground.distance_km;
    const float x = level > 1e-12f ? v.x / level : 0.0f, y = level > 1e-12f ? v.y / level : 1.0f;
    point->forward = (skv_vec3){x, y, 0.0f};
    point->left = (skv_vec3){-y, x, 0.0f};
    point->mu = ground.mu;
    point->sine = skv_minf((frame->radius_km + frame->height_km) * level / frame->radius_km, 1.0f);
    // The arc is the angle of incidence less the ray's angle to the nadir: no large lengths are subtracted.
    point->arc_sin = -point->sine * v.z - point->mu * level;
    point->arc_cos = point->sine * level - point->mu * v.z;
    point->distance_km = d;
    return true;
}

/// From the point's axes (forward, left, up) to the observer's.
static skv_vec3 to_observer(const water_point *p, skv_vec3 local) {
    const float forward = local.x * p->arc_cos + local.z * p->arc_sin;
    const float up = local.z * p->arc_cos - local.x * p->arc_sin;
    const skv_vec3 level = skv_combine(forward, p->forward, local.y, p->left);
    return (skv_vec3){level.x, level.y, up};
}

static skv_vec3 to_local(const water_point *p, skv_vec3 v) {
    const float forward = skv_dot(v, p->forward);
    return (skv_vec3){forward * p->arc_cos - v.z * p->arc_sin, skv_dot(v, p->left),
                      forward * p->arc_sin + v.z * p->arc_cos};
}

/// Mean square slopes along and across a direction `cos`, `sin` of its angle to the wind.
typedef struct slopes {
    float along, across;
} slopes;

static slopes slopes_towards(const skv_water *water, skv_sincos wind, skv_vec3 forward) {
    // The wind's line is (sin, cos) of its azimuth in east and north.
    const float c = forward.x * wind.sin + forward.y * wind.cos, c2 = skv_minf(c * c, 1.0f);
    return (slopes){water->slope2_along * c2 + water->slope2_across * (1.0f - c2),
                    water->slope2_along * (1.0f - c2) + water->slope2_across * c2};
}

/// Gauss-Legendre nodes for the slopes that are seen, on [-1, 1].
#define SLOPE_NODES 6
static const float slope_node[SLOPE_NODES / 2] = {0.238619186f, 0.661209386f, 0.932469514f};
static const float slope_weight[SLOPE_NODES / 2] = {0.467913935f, 0.360761573f, 0.171324492f};
/// Slopes that count, in standard deviations.
#define SLOPE_SPAN 3.8f

/// Mean reflectance of the facets that are seen. Slope x toward the viewer in units of its deviation s: weight
/// (mu + x s sin)+ of a normal distribution, from where facets turn away; cosine of incidence (mu + x s sin)/sqrt(1 +
/// x^2 s^2 + the mean square across).
static float rough_reflectance(const water_point *p, slopes slope, float refractive_index) {
    const float s = skv_sqrtf(slope.along), turn = p->mu / skv_maxf(s * p->sine, 1e-9f);
    const float from = -skv_minf(turn, SLOPE_SPAN), half = 0.5f * (SLOPE_SPAN - from);
    float sum = 0.0f, whole = 0.0f;
    for (int i = 0; i < SLOPE_NODES; i++) {
        const float node = slope_node[i >> 1], x = from + half * (1.0f + ((i & 1) != 0 ? node : -node));
        const float facing = skv_maxf(p->mu + x * s * p->sine, 0.0f);
        const float weight = slope_weight[i >> 1] * facing * skv_expf(-0.5f * x * x);
        const float across = 1.0f + x * x * slope.along + slope.across;
        sum += weight * skv_fresnel(facing / skv_sqrtf(across), refractive_index);
        whole += weight;
    }
    return whole > 0.0f ? skv_minf(sum / whole, 1.0f) : skv_fresnel(p->mu, refractive_index);
}

/// Mean slope toward the viewer of the facets that are seen: s^2 sin Phi(a)/(mu Phi(a) + s sin phi(a)), a = mu/(s sin).
static float mean_tilt(const water_point *p, float slope2) {
    const float spread = skv_sqrtf(slope2) * p->sine;
    if (!(spread > 1e-9f))
        return 0.0f;
    const gauss_tail t = gauss_below(p->mu / spread);
    return slope2 * p->sine * t.below / (p->mu * t.below + spread * t.density);
}

/// The ray mirrored in a facet that leans toward the viewer, in the point's axes; up at least a little.
static skv_vec3 mirrored(const water_point *p, float tilt) {
    const float inv = 1.0f / (1.0f + tilt * tilt), facing = 2.0f * (p->mu + tilt * p->sine) * inv;
    const skv_vec3 m = {p->sine - facing * tilt, 0.0f, facing - p->mu};
    const float up = skv_maxf(m.z, 1e-6f), length = skv_sqrtf(m.x * m.x + up * up);
    return (skv_vec3){m.x / length, 0.0f, up / length};
}

static void set3(float to[3], skv_vec3 v) {
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
}

static void set_hit(skv_water_hit *hit, const skv_water *water, skv_sincos wind, const water_point *point) {
    const slopes slope = slopes_towards(water, wind, point->forward);
    const bool flat = !(water->slope2_along > 0.0f || water->slope2_across > 0.0f);
    const skv_vec3 m = mirrored(point, flat ? 0.0f : mean_tilt(point, slope.along));
    const skv_vec3 level = skv_combine(m.x, point->forward, m.y, point->left);
    set3(hit->local_enu, (skv_vec3){level.x, level.y, m.z});
    set3(hit->mirror_enu, to_observer(point, m));
    hit->distance_km = point->distance_km;
    hit->cos_incidence = point->mu;
    hit->reflectance = flat ? skv_fresnel(point->mu, water->refractive_index)
                            : rough_reflectance(point, slope, water->refractive_index);
}

static skv_sincos wind_of(const skv_water *water) {
    return skv_sincosf(water->wind_azimuth_deg * RAD_PER_DEG);
}

skv_status skv_water_mirror(const skv_water *water, const skv_frame *frame, size_t n, const skv_rays *rays,
                            skv_water_hit *hits) {
    skv_batch batch;
    if (water == NULL || hits == NULL)
        return SKV_ERR_NULL;
    const skv_status status = skv_batch_of(&batch, frame, rays, NULL);
    if (status != SKV_OK)
        return status;
    if (!good_water(water))
        return SKV_ERR_RANGE;
    const skv_sincos wind = wind_of(water);
    bool bad = false;
    for (size_t i = 0; i < n; i++) {
        skv_view view;
        water_point point;
        hits[i] = (skv_water_hit){{0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 1.0f}, 0.0f, 1.0f, 0.0f};
        if (!skv_batch_view(&batch, i, &view))
            bad = true;
        else if (water_at(frame, &view, &point))
            set_hit(&hits[i], water, wind, &point);
    }
    return bad ? SKV_ERR_DIRECTION : SKV_OK;
}

skv_status skv_water_add(const skv_frame *frame, size_t n, const skv_water_hit *hits, const float *mirrored_radiance,
                         size_t mirrored_stride, const skv_sky *sky) {
    skv_batch batch;
    if (hits == NULL || mirrored_radiance == NULL || sky == NULL)
        return SKV_ERR_NULL;
    // The rays are not read: any will do.
    const float up[3] = {0.0f, 0.0f, 1.0f};
    const skv_rays rays = {up, 0, NULL, 0};
    const skv_status status = skv_batch_of(&batch, frame, &rays, sky);
    if (status != SKV_OK)
        return status;
    if (!skv_stride_ok(mirrored_stride, batch.bands * sizeof(float)))
        return SKV_ERR_SIZE;
    const size_t stride = skv_stride(mirrored_stride, batch.bands * sizeof(float));
    for (size_t i = 0; i < n; i++) {
        const float f = skv_clampf(hits[i].reflectance, 0.0f, 1.0f);
        const float *const from = skv_const_at(mirrored_radiance, stride, i);
        for (size_t b = 0; b < batch.bands; b++)
            skv_batch_add(&batch, i, b,
                          f * skv_batch_transmittance(&batch, i, b) * skv_clampf(from[b], 0.0f, SKV_RADIANCE_MAX));
    }
    return SKV_OK;
}

/// Density of the slopes x (toward the viewer) and y (to the left), of a normal distribution in the wind's axes.
static float slope_density(const skv_water *water, float along, float across) {
    const float va = skv_maxf(water->slope2_along, SLOPE2_MIN), vc = skv_maxf(water->slope2_across, SLOPE2_MIN);
    const float q = along * along / va + across * across / vc;
    return 0.159154943f * skv_expf(-0.5f * skv_minf(q, 170.0f)) / skv_sqrtf(va * vc);
}

/// Glint per irradiance, 1/sr: F p/(4 cos^4(tilt)) over the area that is seen and lit. With N = mu (1 + Lambda) for
/// viewer and light, [Smith67]'s 1/(mu (1 + Lambda_v + Lambda_l)) is 1/(N_v + mu_v (N_l - mu_l)/mu_l).
static float glint_at(const skv_water *water, skv_sincos wind, const water_point *p, skv_vec3 light) {
    if (!(light.z > 0.0f))
        return 0.0f;
    // Half way between light and viewer; the viewer is at (-sine, 0, mu).
    const skv_vec3 h = {light.x - p->sine, light.y, light.z + p->mu};
    const float length2 = skv_dot(h, h), up = skv_maxf(h.z, 1e-6f);
    const float cos_half = skv_clampf(0.5f * skv_sqrtf(length2), 0.0f, 1.0f);
    const float slope_x = h.x / up, slope_y = h.y / up; // of the facet's normal, forward and left
    const skv_vec3 level = skv_combine(slope_x, p->forward, slope_y, p->left);
    const float along = level.x * wind.sin + level.y * wind.cos, across = level.y * wind.sin - level.x * wind.cos;
    const float sec2 = skv_minf(1.0f + along * along + across * across, 1e8f);
    const float density = slope_density(water, along, across);
    const float side = skv_sqrtf(light.x * light.x + light.y * light.y);
    const skv_vec3 toward =
        side > 1e-6f ? skv_combine(light.x / side, p->forward, light.y / side, p->left) : p->forward;
    const float s_view = skv_sqrtf(slopes_towards(water, wind, p->forward).along);
    const float s_light = skv_sqrtf(slopes_towards(water, wind, toward).along);
    const float lit = seen_area(light.z, s_light * side) - light.z;
    const float area = seen_area(p->mu, s_view * p->sine) + p->mu * skv_maxf(lit, 0.0f) / skv_maxf(light.z, 1e-6f);
    return 0.25f * skv_fresnel(cos_half, water->refractive_index) * density * sec2 * sec2 / skv_maxf(area, 1e-6f);
}

static bool good_share(const float share[4], size_t bands) {
    for (size_t b = 0; b < bands && share != NULL; b++)
        if (!(share[b] >= 0.0f && share[b] <= 1.0f))
            return false;
    return true;
}

skv_status skv_water_glint(const skv_water *water, const skv_frame *frame, int32_t light, const float through_air[4],
                           size_t n, const skv_rays *rays, const skv_sky *sky) {
    skv_batch batch;
    if (water == NULL || sky == NULL)
        return SKV_ERR_NULL;
    const skv_status status = skv_batch_of(&batch, frame, rays, sky);
    if (status != SKV_OK)
        return status;
    if (!good_water(water) || light < 0 || light >= frame->lights || !good_share(through_air, batch.bands))
        return SKV_ERR_RANGE;
    const skv_frame_light *const from = &frame->light[light];
    const skv_vec3 toward = {from->direction_enu[0], from->direction_enu[1], from->direction_enu[2]};
    const bool rough = water->slope2_along > 0.0f || water->slope2_across > 0.0f;
    const skv_sincos wind = wind_of(water);
    bool bad = false;
    for (size_t i = 0; i < n; i++) {
        skv_view view;
        water_point point;
        if (!skv_batch_view(&batch, i, &view)) {
            bad = true;
            continue;
        }
        if (!rough || !water_at(frame, &view, &point))
            continue;
        const float glint = glint_at(water, wind, &point, to_local(&point, toward));
        for (size_t b = 0; b < batch.bands; b++) {
            const float share = through_air != NULL ? through_air[b] : 1.0f;
            skv_batch_add(&batch, i, b, glint * from->irradiance[b] * share * skv_batch_transmittance(&batch, i, b));
        }
    }
    return bad ? SKV_ERR_DIRECTION : SKV_OK;
}
