#include "projection.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

static double radians(double degrees) {
    return degrees * (pi / 180.0);
}

static double clamp01(double x) {
    return x < 0.0 ? 0.0 : x > 1.0 ? 1.0 : x;
}

/// Azimuth clockwise from north.
static void from_angles(double azimuth, double elevation, float enu[3]) {
    enu[0] = (float)(cos(elevation) * sin(azimuth));
    enu[1] = (float)(cos(elevation) * cos(azimuth));
    enu[2] = (float)sin(elevation);
}

void projection_prepare(projection *map) {
    const double a = radians(map->azimuth_deg), e = radians(map->elevation_deg);
    const double pixel = 2.0 * tan(radians(map->fov_deg) / 2.0) / map->width;
    const double forward[3] = {cos(e) * sin(a), cos(e) * cos(a), sin(e)};
    const double right[3] = {cos(a), -sin(a), 0.0};
    const double down[3] = {sin(e) * sin(a), sin(e) * cos(a), -cos(e)};
    for (int i = 0; i < 3; i++) {
        map->forward[i] = forward[i];
        map->right[i] = right[i] * pixel;
        map->down[i] = down[i] * pixel;
    }
}

/// Position relative to the centre in units of the circle's radius: left and up positive.
static double fisheye_radius(const projection *map, double x, double y, double *left, double *up) {
    const double radius = 0.5 * (map->width < map->height ? map->width : map->height);
    *left = (0.5 * (map->width - 1) - x) / radius;
    *up = (0.5 * (map->height - 1) - y) / radius;
    return radius;
}

static double fisheye(const projection *map, double x, double y, float enu[3]) {
    double left, up;
    const double radius = fisheye_radius(map, x, y, &left, &up);
    const double rho = sqrt(left * left + up * up);
    const double cover = clamp01((1.0 - rho) * radius + 0.5); // a soft edge, one pixel wide
    if (cover > 0.0)
        from_angles(atan2(left, up), pi / 2.0 - rho * radians(map->fov_deg) / 2.0,
                    enu); // east is left
    return cover;
}

static double latlong_elevation(const projection *map, double y) {
    const double elevation = pi / 2.0 - pi * y / (map->height - 1);
    return elevation > pi / 2.0 ? pi / 2.0 : elevation < -pi / 2.0 ? -pi / 2.0 : elevation;
}

static double perspective(const projection *map, double x, double y, float enu[3]) {
    const double px = x - 0.5 * (map->width - 1), py = y - 0.5 * (map->height - 1);
    double v[3], norm = 0.0;
    for (int i = 0; i < 3; i++) {
        v[i] = map->forward[i] + px * map->right[i] + py * map->down[i];
        norm += v[i] * v[i];
    }
    norm = sqrt(norm);
    for (int i = 0; i < 3; i++)
        enu[i] = (float)(v[i] / norm);
    return 1.0;
}

double projection_direction(const projection *map, double x, double y, float direction_enu[3]) {
    switch (map->kind) {
    case PROJECTION_FISHEYE:
        return fisheye(map, x, y, direction_enu);
    case PROJECTION_LATLONG: // OpenEXR: longitude pi - 2 pi x/(W-1) with +Z =
                             // north and +X = west
        from_angles(2.0 * pi * x / (map->width - 1) - pi, latlong_elevation(map, y), direction_enu);
        return 1.0;
    default:
        return perspective(map, x, y, direction_enu);
    }
}

double projection_spacing(const projection *map) {
    const double radius = 0.5 * (map->width < map->height ? map->width : map->height);
    switch (map->kind) {
    case PROJECTION_FISHEYE:
        return radians(map->fov_deg) / 2.0 / radius;
    case PROJECTION_LATLONG:
        return fmax(pi / (map->height - 1), 2.0 * pi / (map->width - 1));
    default:
        return 2.0 * atan(tan(radians(map->fov_deg) / 2.0) / map->width);
    }
}

double projection_weight(const projection *map, double x, double y) {
    double left, up, rho;
    switch (map->kind) {
    case PROJECTION_FISHEYE:
        (void)fisheye_radius(map, x, y, &left, &up);
        rho = sqrt(left * left + up * up) * radians(map->fov_deg) / 2.0;
        return rho < 1e-6 ? 1.0 : fabs(sin(rho)) / rho;
    case PROJECTION_LATLONG:
        return cos(latlong_elevation(map, y));
    default:
        return 1.0;
    }
}
