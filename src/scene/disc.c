/// Discs of the sun and the moon: their shape, and the level at which their integral is the light's irradiance.
#include "scene/disc.h"

#include "scene/limb.h"
#include "scene/view.h"

/// Radius of the sun in au: 695,700 km [Prsa16].
#define SUN_RADIUS_AU 0.00465046726f

/// Gauss-Legendre with 8 points on [-1, 1]: the half of it.
static const float gauss_node[4] = {0.183434642f, 0.525532410f, 0.796666477f, 0.960289856f};
static const float gauss_weight[4] = {0.362683783f, 0.313706646f, 0.222381034f, 0.101228536f};

/// Node and weight i, [0, 8), on [a, b].
static float gauss_at(int i, float a, float b, float *weight) {
    const float half = 0.5f * (b - a), x = gauss_node[i >> 1];
    *weight = half * gauss_weight[i >> 1];
    return 0.5f * (a + b) + half * ((i & 1) != 0 ? x : -x);
}

/// Mean of the moon's shape on the circle at c: what is lit lies within an angle of the bright limb's direction.
static float moon_ring(const skv_disc *disc, float c) {
    const float mu = skv_disc_mu(disc, c), x = skv_minf(c / disc->radius, 1.0f);
    const float z = skv_maxf(mu, SKV_DISC_MU_MIN), across = x * disc->limb[0][1];
    const float half = skv_acosf(-z * disc->limb[0][0] / skv_maxf(across, 1e-12f));
    float sum = 0.0f;
    for (int i = 0; i < 8; i++) {
        float weight;
        const float phi = gauss_at(i, 0.0f, half, &weight);
        sum += weight * skv_disc_moon_shape(disc, x * skv_cosf(phi), mu);
    }
    return sum * (1.0f / SKV_PI);
}

static float ring(const skv_disc *disc, int band, float c) {
    if (disc->even >= 1.0f)
        return skv_disc_edge(disc, c);
    const float shape = disc->moon != 0 ? disc->limb[0][2] * moon_ring(disc, c)
                                        : skv_disc_sun_shape(disc->limb[band], skv_disc_mu(disc, c));
    return ((1.0f - disc->even) * shape + disc->even) * skv_disc_edge(disc, c);
}

/// Integral over the solid angle between the chords a and b, inside the limb: there mu is the variable that keeps the
/// shape smooth, c dc = -radius^2 mu dmu.
static float inside(const skv_disc *disc, int band, float a, float b) {
    float sum = 0.0f;
    if (!(b > a))
        return 0.0f;
    for (int i = 0; i < 8; i++) {
        float weight;
        const float mu = gauss_at(i, skv_disc_mu(disc, b), skv_disc_mu(disc, a), &weight);
        sum += weight * mu * ring(disc, band, disc->radius * skv_sqrtf(1.0f - mu * mu));
    }
    return 2.0f * SKV_PI * disc->radius * disc->radius * sum;
}

static float outside(const skv_disc *disc, int band, float a, float b) {
    float sum = 0.0f;
    for (int i = 0; i < 8; i++) {
        float weight;
        const float c = gauss_at(i, a, b, &weight);
        sum += weight * c * ring(disc, band, c);
    }
    return 2.0f * SKV_PI * sum;
}

/// Integral of the disc's shape. Cut where the edge begins and where the circles touch the moon's terminator; within a
/// crescent nothing is lit.
static float integral(const skv_disc *disc, int band) {
    const float r = disc->radius, in = skv_minf(disc->edge[0], r), out = skv_maxf(disc->edge[1], r);
    const float touch = disc->moon != 0 ? r * skv_minf(skv_fabsf(disc->limb[0][0]), 1.0f) : 0.0f;
    const float from = disc->moon != 0 && disc->limb[0][0] < 0.0f && disc->even == 0.0f ? touch : 0.0f;
    const float low = skv_minf(in, touch), high = skv_maxf(in, touch);
    return inside(disc, band, from, low) + inside(disc, band, skv_maxf(low, from), high) + inside(disc, band, high, r) +
           outside(disc, band, r, out);
}

/// Edge and evenness for samples this far apart. Where they are finer than the disc the edge is one sample wide, where
/// coarser it grows to three: a bump of that width has the same sum over a grid wherever its centre lies.
static void set_edge(skv_disc *disc, float sample_rad) {
    const float w = sample_rad, r = disc->radius;
    const float coarse = w / (w + r), half = w * (0.5f + coarse), even = 1.5f * w / r;
    disc->edge[0] = skv_maxf(r - half, 0.0f);
    disc->edge[1] = w > 0.0f ? r + half : r;
    disc->even = skv_minf(even * even, 1.0f);
}

/// Unit vectors across the line of sight: toward the zenith, and toward `side` where that is given.
static void set_axes(skv_disc *disc, skv_vec3 centre, const skv_vec3 *side) {
    const skv_vec3 up = {0.0f, 0.0f, 1.0f}, north = {0.0f, 1.0f, 0.0f};
    const float flat = centre.x * centre.x + centre.y * centre.y;
    const skv_vec3 any = flat > 1e-8f ? up : north;
    const skv_vec3 across = skv_combine(1.0f, any, -skv_dot(any, centre), centre);
    const float length = skv_sqrtf(skv_dot(across, across));
    const skv_vec3 zenith = {across.x / length, across.y / length, across.z / length};
    skv_vec3 right = skv_cross(centre, zenith);
    if (side != NULL) {
        const skv_vec3 toward = skv_combine(1.0f, *side, -skv_dot(*side, centre), centre);
        const float far = skv_sqrtf(skv_dot(toward, toward));
        if (far > 1e-6f)
            right = (skv_vec3){toward.x / far, toward.y / far, toward.z / far};
    }
    const skv_vec3 other = skv_cross(right, centre);
    const skv_vec3 axes[4] = {centre, right, other, zenith};
    float *const to[4] = {disc->direction_enu, disc->right_enu, disc->up_enu, disc->zenith_enu};
    for (int i = 0; i < 4; i++) {
        to[i][0] = axes[i].x;
        to[i][1] = axes[i].y;
        to[i][2] = axes[i].z;
    }
    disc->squeeze = 1.0f;
}

static int good_irradiance(const float irradiance[4], int bands) {
    for (int b = 0; b < bands; b++)
        if (!(irradiance[b] >= 0.0f && irradiance[b] <= 1e6f))
            return 0;
    return 1;
}

static void set_level(skv_disc *disc, const skv_model *model, const float irradiance[4]) {
    const int there = disc->moon == 0 || disc->limb[0][2] > 0.0f;
    float whole = 1.0f;
    for (int b = 0; b < disc->bands; b++) {
        if (b == 0 || disc->moon == 0) // the moon has one shape for all bands
            whole = integral(disc, b);
        disc->level[b] = there ? irradiance[b] * model->absorption_colour[b] / whole : 0.0f;
    }
}

skv_status skv_disc_sun(skv_disc *disc, const skv_model *model, const skv_light *light, float distance_au,
                        float sample_rad) {
    if (disc == NULL || model == NULL || light == NULL)
        return SKV_ERR_NULL;
    if (!skv_model_ok(model))
        return SKV_ERR_LAYOUT;
    skv_vec3 centre;
    if (!skv_unit3(light->direction_enu, &centre))
        return SKV_ERR_DIRECTION;
    if (!(distance_au >= 0.01f && distance_au <= 100.0f) ||
        !(sample_rad >= 0.0f && sample_rad <= SKV_DISC_SAMPLE_MAX) || !good_irradiance(light->irradiance, model->bands))
        return SKV_ERR_RANGE;
    skv_disc made = {.bands = model->bands, .radius = SUN_RADIUS_AU / distance_au};
    set_axes(&made, centre, NULL);
    set_edge(&made, sample_rad);
    for (int b = 0; b < made.bands; b++)
        skv_limb_at(made.limb[b], model->wavelength_nm[b]);
    set_level(&made, model, light->irradiance);
    *disc = made;
    return SKV_OK;
}

/// Scale of the moon's shape to a mean of 1 over the sharp disc; 0 where nothing of it is left.
static void set_moon_scale(skv_disc *disc) {
    skv_disc sharp = *disc;
    sharp.even = 0.0f;
    sharp.edge[0] = sharp.edge[1] = sharp.radius;
    sharp.limb[0][2] = 1.0f;
    const float mean = integral(&sharp, 0) / (SKV_PI * disc->radius * disc->radius);
    disc->limb[0][2] = mean > 1e-6f ? 1.0f / mean : 0.0f;
}

/// Earthshine at the level that gives its integral, whatever the edge.
static void set_dark(skv_disc *disc, const skv_model *model, const float earthshine[4]) {
    skv_disc even = *disc;
    even.even = 1.0f;
    const float area = SKV_PI * disc->radius * disc->radius, share = area / integral(&even, 0);
    for (int b = 0; b < disc->bands; b++)
        disc->dark[b] = earthshine[b] * model->absorption_colour[b] * share;
}

skv_status skv_disc_moon(skv_disc *disc, const skv_model *model, const skv_moonlight *moonlight,
                         const float moon_enu[3], const float sun_enu[3], float sample_rad) {
    if (disc == NULL || model == NULL || moonlight == NULL || moon_enu == NULL || sun_enu == NULL)
        return SKV_ERR_NULL;
    if (!skv_model_ok(model))
        return SKV_ERR_LAYOUT;
    skv_vec3 centre, sun;
    if (!skv_unit3(moon_enu, &centre) || !skv_unit3(sun_enu, &sun))
        return SKV_ERR_DIRECTION;
    const float g = moonlight->phase_angle_deg, radius = moonlight->radius_rad;
    if (!(g >= 0.0f && g <= 180.0f) || !(radius >= 1e-5f && radius <= 1.0f) ||
        !(sample_rad >= 0.0f && sample_rad <= SKV_DISC_SAMPLE_MAX) ||
        !good_irradiance(moonlight->irradiance, model->bands) || !good_irradiance(moonlight->earthshine, model->bands))
        return SKV_ERR_RANGE;
    skv_disc made = {.bands = model->bands, .moon = 1, .radius = 2.0f * skv_sinf(0.5f * radius)};
    const skv_sincos phase = skv_sincosf(g * (SKV_PI / 180.0f));
    set_axes(&made, centre, &sun);
    set_edge(&made, sample_rad);
    made.limb[0][0] = phase.cos;
    made.limb[0][1] = skv_maxf(phase.sin, 0.0f);
    set_moon_scale(&made);
    set_level(&made, model, moonlight->irradiance);
    set_dark(&made, model, moonlight->earthshine);
    *disc = made;
    return SKV_OK;
}

/// Along a vertical circle: b of the old zenith axis becomes b of the new one.
static void tilt(float axis[3], skv_vec3 zenith, skv_vec3 lifted) {
    const skv_vec3 a = {axis[0], axis[1], axis[2]};
    const float b = skv_dot(a, zenith);
    axis[0] += b * (lifted.x - zenith.x);
    axis[1] += b * (lifted.y - zenith.y);
    axis[2] += b * (lifted.z - zenith.z);
}

skv_status skv_disc_refract(skv_disc *disc, float pressure_hpa, float temperature_c) {
    if (disc == NULL)
        return SKV_ERR_NULL;
    if (!(pressure_hpa >= 0.0f && pressure_hpa <= 2000.0f) || !(temperature_c >= -100.0f && temperature_c <= 100.0f) ||
        !(disc->radius > 0.0f))
        return SKV_ERR_RANGE;
    const float *const s = disc->direction_enu, *const z = disc->zenith_enu;
    const float deg = 180.0f / SKV_PI, r = disc->radius * deg;
    const float h = skv_atan2f(s[2], skv_sqrtf(s[0] * s[0] + s[1] * s[1])) * deg;
    const float lift = skv_refraction_deg(skv_clampf(h, -90.0f, 90.0f), pressure_hpa, temperature_c);
    const float above = skv_minf(h + r, 90.0f), below = skv_maxf(h - r, -90.0f);
    const float slope = (skv_refraction_deg(above, pressure_hpa, temperature_c) -
                         skv_refraction_deg(below, pressure_hpa, temperature_c)) /
                        (above - below);
    const skv_sincos angle = skv_sincosf(lift / deg);
    const skv_vec3 centre = {s[0], s[1], s[2]}, zenith = {z[0], z[1], z[2]};
    const skv_vec3 at = skv_combine(angle.cos, centre, angle.sin, zenith);
    const skv_vec3 lifted = skv_combine(angle.cos, zenith, -angle.sin, centre);
    tilt(disc->right_enu, zenith, lifted);
    tilt(disc->up_enu, zenith, lifted);
    disc->squeeze = 1.0f / skv_clampf(1.0f + slope, 0.1f, 1.0f);
    for (int i = 0; i < 3; i++) {
        disc->direction_enu[i] = i == 0 ? at.x : i == 1 ? at.y : at.z;
        disc->zenith_enu[i] = i == 0 ? lifted.x : i == 1 ? lifted.y : lifted.z;
    }
    return SKV_OK;
}

/// Offset of a ray from the centre, undone by what refraction has squeezed. False outside the soft edge.
static bool offset(const skv_disc *disc, skv_vec3 v, skv_vec3 *d, float *c) {
    const float *const s = disc->direction_enu, *const z = disc->zenith_enu;
    *d = (skv_vec3){v.x - s[0], v.y - s[1], v.z - s[2]};
    const float most = disc->edge[1] * disc->edge[1];
    if (!(skv_dot(*d, *d) <= most))
        return false;
    const skv_vec3 zenith = {z[0], z[1], z[2]};
    *d = skv_combine(1.0f, *d, (disc->squeeze - 1.0f) * skv_dot(*d, zenith), zenith);
    *c = skv_sqrtf(skv_dot(*d, *d));
    return *c <= disc->edge[1];
}

/// The disc's own radiance in a band.
static float disc_radiance(const skv_disc *disc, size_t band, skv_vec3 d, float c) {
    const float mu = skv_disc_mu(disc, c);
    float shape;
    if (disc->moon != 0) {
        const skv_vec3 right = {disc->right_enu[0], disc->right_enu[1], disc->right_enu[2]};
        const float toward = skv_dot(d, right) / skv_maxf(c, disc->radius);
        shape = disc->limb[0][2] * skv_disc_moon_shape(disc, toward, mu);
    } else {
        shape = skv_disc_sun_shape(disc->limb[band], mu);
    }
    const float lit = (1.0f - disc->even) * shape + disc->even;
    return skv_disc_edge(disc, c) * (disc->level[band] * lit + disc->dark[band]);
}

skv_status skv_disc_add(const skv_disc *disc, const skv_frame *frame, size_t n, const skv_rays *rays,
                        const skv_sky *sky) {
    skv_batch batch;
    if (disc == NULL || sky == NULL)
        return SKV_ERR_NULL;
    const skv_status status = skv_batch_of(&batch, frame, rays, sky);
    if (status != SKV_OK)
        return status;
    if ((size_t)disc->bands != batch.bands || !(disc->radius > 0.0f) || !(disc->edge[1] >= disc->radius))
        return SKV_ERR_RANGE;
    bool bad = false;
    for (size_t i = 0; i < n; i++) {
        skv_view view;
        skv_vec3 d;
        float c;
        if (!skv_batch_view(&batch, i, &view)) {
            bad = true;
            continue;
        }
        if (!offset(disc, view.unit, &d, &c) || skv_isfinite(view.length_km) || skv_view_ground(frame, view.unit).hit)
            continue;
        for (size_t b = 0; b < batch.bands; b++)
            skv_batch_add(&batch, i, b, disc_radiance(disc, b, d, c) * skv_batch_transmittance(&batch, i, b));
    }
    return bad ? SKV_ERR_DIRECTION : SKV_OK;
}
