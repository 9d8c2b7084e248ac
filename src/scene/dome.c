/// Dome meshes: checks, sizes, vertices and triangles. Where the vertices lie is in dome_shape.c.
#include "skyvert/dome.h"

#include "scene/dome_shape.h"
#include "scene/strided.h"

/// A lowest ring this low is one vertex at the nadir.
#define NADIR_RAD (-1.570795f)

static bool within(float x, float lo, float hi) {
    return x >= lo && x <= hi;
}

static bool shape_in_range(const skv_dome *d) {
    if (d->rings < 2 || d->rings > 4096 || d->rings_below < 0 || d->rings_below > 4096 || d->azimuths < 3 ||
        d->azimuths > 16384 || !within(d->horizon_rad, -SKV_HALF_PI + 0.01f, 0.0f))
        return false;
    return d->rings_below == 0 || within(d->lowest_rad, -1.5707965f, d->horizon_rad - 4.0e-6f * (float)d->rings_below);
}

static bool planet_in_range(const skv_dome *d) {
    return within(d->height_km, 0.0f, 1.0e6f) && within(d->radius_km, 1.0f, 1.0e5f) &&
           within(d->top_km, 0.1f, 1000.0f) && d->top_km <= d->radius_km;
}

/// @param[out] sun  unit vector, of an ADAPTIVE dome.
static skv_status check(const skv_dome *dome, skv_vec3 *sun) {
    if (dome == NULL)
        return SKV_ERR_NULL;
    if (dome->kind != SKV_DOME_EVEN && dome->kind != SKV_DOME_HORIZON && dome->kind != SKV_DOME_ADAPTIVE)
        return SKV_ERR_UNSUPPORTED;
    if (!shape_in_range(dome))
        return SKV_ERR_RANGE;
    if (dome->kind != SKV_DOME_ADAPTIVE)
        return SKV_OK;
    if (!planet_in_range(dome))
        return SKV_ERR_RANGE;
    return skv_unit3(dome->sun_enu, sun) ? SKV_OK : SKV_ERR_DIRECTION;
}

static bool has_nadir(const skv_dome *dome) {
    return dome->rings_below > 0 && dome->lowest_rad <= NADIR_RAD;
}

/// Rings of more than one vertex.
static int32_t full_rings(const skv_dome *dome) {
    return dome->rings + dome->rings_below - (has_nadir(dome) ? 1 : 0);
}

static size_t vertices_of(const skv_dome *dome) {
    return 1u + (size_t)full_rings(dome) * (size_t)dome->azimuths + (has_nadir(dome) ? 1u : 0u);
}

/// A fan at each pole and two triangles between neighbours of neighbouring rings.
static size_t indices_of(const skv_dome *dome) {
    const size_t fans = has_nadir(dome) ? 2u : 1u;
    return 3u * (size_t)dome->azimuths * (fans + 2u * (size_t)(full_rings(dome) - 1));
}

skv_status skv_dome_size(const skv_dome *dome, size_t *vertices, size_t *indices) {
    skv_vec3 sun;
    const skv_status status = check(dome, &sun);
    if (status != SKV_OK)
        return status;
    if (vertices != NULL)
        *vertices = vertices_of(dome);
    if (indices != NULL)
        *indices = indices_of(dome);
    return SKV_OK;
}

static void put(float *direction_enu, size_t stride, size_t i, skv_vec3 v) {
    float *const p = skv_at(direction_enu, stride, i);
    p[0] = v.x;
    p[1] = v.y;
    p[2] = v.z;
}

static void write_vertices(const skv_dome *dome, skv_vec3 sun, float *direction_enu, size_t stride) {
    const skv_dome_shape shape = skv_dome_shape_of(dome, sun);
    const size_t columns = (size_t)dome->azimuths;
    put(direction_enu, stride, 0, (skv_vec3){0.0f, 0.0f, 1.0f});
    for (int32_t j = 0; j < dome->azimuths; j++) {
        const skv_column column = skv_dome_column(&shape, j);
        for (int32_t ring = 0; ring < full_rings(dome); ring++)
            put(direction_enu, stride, 1u + (size_t)ring * columns + (size_t)j, skv_dome_vertex(&shape, &column, ring));
    }
    if (has_nadir(dome))
        put(direction_enu, stride, vertices_of(dome) - 1u, (skv_vec3){0.0f, 0.0f, -1.0f});
}

static uint32_t *triangle(uint32_t *out, uint32_t a, uint32_t b, uint32_t c) {
    out[0] = a;
    out[1] = b;
    out[2] = c;
    return out + 3;
}

/// Azimuth grows to the right seen from inside with the zenith on top: (top, its lower neighbour, one to the right)
/// runs counter-clockwise.
static void write_indices(const skv_dome *dome, uint32_t *out) {
    const uint32_t columns = (uint32_t)dome->azimuths, rings = (uint32_t)full_rings(dome);
    for (uint32_t j = 0; j < columns; j++) {
        const uint32_t right = j + 1 == columns ? 0 : j + 1;
        out = triangle(out, 0, 1 + j, 1 + right);
    }
    for (uint32_t ring = 0; ring + 1 < rings; ring++) {
        const uint32_t upper = 1 + ring * columns, lower = upper + columns;
        for (uint32_t j = 0; j < columns; j++) {
            const uint32_t right = j + 1 == columns ? 0 : j + 1;
            out = triangle(out, upper + j, lower + j, upper + right);
            out = triangle(out, upper + right, lower + j, lower + right);
        }
    }
    const uint32_t last = 1 + (rings - 1) * columns;
    for (uint32_t j = 0; j < columns && has_nadir(dome); j++) {
        const uint32_t right = j + 1 == columns ? 0 : j + 1;
        out = triangle(out, last + right, last + j, last + columns);
    }
}

skv_status skv_dome_build(const skv_dome *dome, float *direction_enu, size_t stride, size_t vertex_capacity,
                          uint32_t *indices, size_t index_capacity) {
    skv_vec3 sun = {0.0f, 0.0f, 1.0f};
    const skv_status status = check(dome, &sun);
    if (status != SKV_OK)
        return status;
    if (direction_enu == NULL)
        return SKV_ERR_NULL;
    if (!skv_stride_ok(stride, 3 * sizeof(float)) || vertex_capacity < vertices_of(dome) ||
        (indices != NULL && index_capacity < indices_of(dome)))
        return SKV_ERR_SIZE;
    write_vertices(dome, sun, direction_enu, skv_stride(stride, 3 * sizeof(float)));
    if (indices != NULL)
        write_indices(dome, indices);
    return SKV_OK;
}
