#include "scene/dome_shape.h"

/// Least distance of rings where t^3 would set them closer, rad: floats of elevations must tell them apart.
#define RING_STEP_RAD 8.0e-6f

static float smoothstep(float lo, float hi, float x) {
    const float t = skv_clampf((x - lo) / (hi - lo), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// Share w of the linear term in t (w + (1-w) t^2), so that the first of n rings is a step away from the horizon.
static float linear_share(int32_t rings, float span) {
    const float n = (float)rings;
    return rings < 2 ? 1.0f : skv_clampf((RING_STEP_RAD * n * n * n / span - 1.0f) / (n * n - 1.0f), 0.0f, 1.0f);
}

/// Ring coordinate of an elevation above the horizon, without the linear share (it is only to be near).
static float coordinate_of(const skv_dome *dome, float elevation) {
    const float x = skv_clampf((elevation - dome->horizon_rad) / (SKV_HALF_PI - dome->horizon_rad), 0.0f, 1.0f);
    return x < 1.0e-9f ? 0.0f : skv_powf(x, 1.0f / 3.0f);
}

/// The displacement of a pull is strength * width * f((t - at)/width), f(x) = x/(1 + x^2): slope 1 at 0, never below
/// -1/8, so t - displacement stays ascending for any strength below 1.
static float displacement(const skv_pull *pull, float t) {
    const float x = (t - pull->at) / pull->width;
    return pull->strength * pull->width * x / (1.0f + x * x);
}

/// Close to the horizon the rings are dense by themselves: a pull is full from `full` on and fades out towards its
/// width, which keeps the slope at the horizon at 1 or above.
static skv_pull make_pull(float at, float strength, float width, float full) {
    skv_pull pull = {at, strength * smoothstep(width, full, at), width, 0.0f, 0.0f};
    pull.end0 = displacement(&pull, 0.0f);
    pull.end1 = displacement(&pull, 1.0f);
    return pull;
}

/// Ends stay where they are: the line through their displacements (rising, for f is odd) is put back.
static float pulled(const skv_pull *pull, float t) {
    return t - displacement(pull, t) + (1.0f - t) * pull->end0 + t * pull->end1;
}

skv_dome_shape skv_dome_shape_of(const skv_dome *dome, skv_vec3 sun) {
    skv_dome_shape shape = {.dome = dome, .adaptive = dome->kind == SKV_DOME_ADAPTIVE};
    const float span = SKV_HALF_PI - dome->horizon_rad;
    shape.linear_above = linear_share(dome->rings, span);
    shape.linear_below = linear_share(dome->rings_below, dome->horizon_rad - dome->lowest_rad);
    if (!shape.adaptive)
        return shape;
    shape.night = smoothstep(-0.4f, -0.2f, sun.z);
    shape.sun = (skv_vec3){sun.x * shape.night, sun.y * shape.night, sun.z};
    shape.sun_at = coordinate_of(dome, skv_asinf(sun.z));
    return shape;
}

/// Azimuth of a column: u - C a sin(u - s), s the sun's azimuth, C the cosine of its elevation: twice as dense at the
/// sun as without, two thirds opposite to it. In the sun's vector it is linear: smooth at the zenith too, where there
/// is no s. With the sun under the horizon the light spreads and so do the columns.
static float azimuth_of(const skv_vec3 *sun, float u) {
    const skv_sincos a = skv_sincosf(u);
    const float twilight = 0.4f + 0.6f * smoothstep(-0.1f, 0.02f, sun->z);
    return u - 0.5f * twilight * (a.sin * sun->y - a.cos * sun->x);
}

/// The pull along the edge of the planet's shadow.
///
/// The shadow is a cylinder of the planet's radius R. It cuts the shell at the height H, about where the light of the
/// twilight comes from, in a circle: all points of the shell with x.s = -(R+H) S, S = sqrt(1 - (R/(R+H))^2), s to the
/// sun. In the vertical plane of a column, at the angle g from the zenith about the planet's centre, x.s/(R+H) is A sin
/// g + B cos g, A the sun's component along the column's azimuth and B = mu_s. With y = tan(g/2) the circle is met
/// where (S-B) y^2 + 2A y + (S+B) = 0; the root that goes through the zenith with it is y = -(S+B)/(A + sign(A)
/// sqrt(..)). Where the circle runs along the column, A = 0, there is nothing to pull to: A^2 + epsilon in the
/// denominator and a weight make that smooth.
static skv_pull shadow_pull(const skv_dome_shape *shape, float along) {
    const skv_dome *const dome = shape->dome;
    const float height = 0.12f * dome->top_km; // where the light bends most: tests/api/test_dome_sky.c
    const float radius = dome->radius_km + height;
    const float s = skv_sqrtf(height * (2.0f * dome->radius_km + height)) / radius;
    const float a2 = along * along, epsilon = 0.0025f;
    const float root = skv_sqrtf(skv_maxf(a2 - (s - shape->sun.z) * (s + shape->sun.z), 0.0f));
    const float y = -(s + shape->sun.z) * along / (a2 + skv_fabsf(along) * root + epsilon);
    const float x_km = radius * 2.0f * y / (1.0f + y * y);
    const float z_km = height - dome->height_km - x_km * y; // 1 - cos g = sin g tan(g/2)
    const float elevation = skv_atan2f(z_km, x_km);         // beyond the zenith over pi/2, under the horizon negative
    // High up the edge is wide and soft and runs over the sky in minutes: the vertices had better stay.
    const float weight = shape->night * (1.0f - smoothstep(0.2f, 0.6f, elevation)) * a2 / (a2 + epsilon);
    return make_pull(coordinate_of(dome, elevation), 0.6f * weight, 0.15f, 0.45f);
}

/// The pull to the sun's elevation: full in its column, falling off to the other side; all round with the sun at the
/// zenith, where there is no azimuth.
static skv_pull sun_pull(const skv_dome_shape *shape, float along) {
    const float c = skv_sqrtf(shape->sun.x * shape->sun.x + shape->sun.y * shape->sun.y);
    const float near = 0.5f * (2.0f + along - c);
    return make_pull(shape->sun_at, 0.5f * shape->night * near * near * near * near, 0.2f, 0.5f);
}

skv_column skv_dome_column(const skv_dome_shape *shape, int32_t j) {
    const float u = (float)j * (2.0f * SKV_PI / (float)shape->dome->azimuths);
    const skv_sincos az = skv_sincosf(shape->adaptive ? azimuth_of(&shape->sun, u) : u);
    skv_column column = {.sin_az = az.sin, .cos_az = az.cos};
    if (shape->adaptive) {
        const float along = az.sin * shape->sun.x + az.cos * shape->sun.y;
        column.shadow = shadow_pull(shape, along);
        column.sun = sun_pull(shape, along);
    }
    return column;
}

static float spaced(const skv_dome *dome, float t, float linear) {
    return dome->kind == SKV_DOME_EVEN ? t : t * (linear + (1.0f - linear) * t * t);
}

static float elevation_of(const skv_dome_shape *shape, const skv_column *column, int32_t ring) {
    const skv_dome *const dome = shape->dome;
    const int32_t above = dome->rings - 1 - ring;
    if (above >= 0) {
        const float even = (float)above / (float)dome->rings;
        const float t = shape->adaptive ? pulled(&column->shadow, pulled(&column->sun, even)) : even;
        return dome->horizon_rad + (SKV_HALF_PI - dome->horizon_rad) * spaced(dome, t, shape->linear_above);
    }
    const float t = (float)-above / (float)dome->rings_below;
    return dome->horizon_rad - (dome->horizon_rad - dome->lowest_rad) * spaced(dome, t, shape->linear_below);
}

skv_vec3 skv_dome_vertex(const skv_dome_shape *shape, const skv_column *column, int32_t ring) {
    const skv_sincos e = skv_sincosf(elevation_of(shape, column, ring));
    return (skv_vec3){column->sin_az * e.cos, column->cos_az * e.cos, e.sin};
}
