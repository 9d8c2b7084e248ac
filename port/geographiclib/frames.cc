/// The local sphere, ECEF/ENU/NED frames and geodesics on WGS 84.
#include "fence.hh"

#include <cstring>
#include <vector>

#include <GeographicLib/Ellipsoid.hpp>
#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <GeographicLib/Math.hpp>

using namespace skv_geo;
using GeographicLib::Geocentric;
using GeographicLib::Geodesic;
using GeographicLib::LocalCartesian;
using GeographicLib::Math;

namespace {

bool fix_ok(const skv_geo_position &p) {
    return position_ok(p.lat_deg, p.lon_deg) && height_ok(p.height_m);
}

/// An azimuth in [0, 360): a tiny negative angle must not come out as 360.
double azimuth(double deg) {
    const double turned = deg < 0 ? deg + 360 : deg;
    return turned >= 360 ? 0 : turned + 0.0;
}

/// Rows east, north, up. GeographicLib gives the matrix that takes ENU to ECEF: its columns are the basis.
void basis_at(double lat_deg, double lon_deg, double basis[3][3]) {
    std::vector<double> m(9);
    double x, y, z;
    Geocentric::WGS84().Forward(lat_deg, lon_deg, 0, x, y, z, m);
    for (size_t axis = 0; axis < 3; axis++)
        for (size_t i = 0; i < 3; i++)
            basis[axis][i] = m[3 * i + axis];
}

void swap_enu_ned(double v[3]) {
    const double east = v[0];
    v[0] = v[1];
    v[1] = east;
    v[2] = -v[2];
}

void ecef_from_enu(const double basis[3][3], double v[3]) {
    double sum[3];
    for (int i = 0; i < 3; i++)
        sum[i] = v[0] * basis[0][i] + v[1] * basis[1][i] + v[2] * basis[2][i];
    for (int i = 0; i < 3; i++)
        v[i] = sum[i];
}

void enu_from_ecef(const double basis[3][3], double v[3]) {
    double sum[3];
    for (int axis = 0; axis < 3; axis++)
        sum[axis] = v[0] * basis[axis][0] + v[1] * basis[axis][1] + v[2] * basis[axis][2];
    for (int i = 0; i < 3; i++)
        v[i] = sum[i];
}

/// C may pass any int as an enum; C++ may not even load it as one.
bool frame_ok(const skv_geo_frame &frame) {
    int f;
    static_assert(sizeof f == sizeof frame, "an enum of C is an int");
    std::memcpy(&f, &frame, sizeof f);
    return f == SKV_GEO_ENU || f == SKV_GEO_NED || f == SKV_GEO_ECEF;
}

/// By way of ENU; nothing is computed that the two frames share.
void rotate(skv_geo_frame from, skv_geo_frame to, const double basis[3][3], double v[3]) {
    if (from == to)
        return;
    if (from == SKV_GEO_NED)
        swap_enu_ned(v);
    if (from == SKV_GEO_ECEF)
        enu_from_ecef(basis, v);
    if (to == SKV_GEO_NED)
        swap_enu_ned(v);
    if (to == SKV_GEO_ECEF)
        ecef_from_enu(basis, v);
}

} // namespace

skv_status skv_geo_local_sphere(double lat_deg, double *radius_km) {
    if (!radius_km)
        return SKV_ERR_NULL;
    if (!within(lat_deg, -90, 90))
        return SKV_ERR_RANGE;
    return fenced([&] {
        const GeographicLib::Ellipsoid &wgs84 = GeographicLib::Ellipsoid::WGS84();
        *radius_km =
            std::sqrt(wgs84.MeridionalCurvatureRadius(lat_deg) * wgs84.TransverseCurvatureRadius(lat_deg)) / 1e3;
        return SKV_OK;
    });
}

skv_status skv_geo_ecef_from_geodetic(double lat_deg, double lon_deg, double height_m, double ecef_m[3]) {
    if (!ecef_m)
        return SKV_ERR_NULL;
    if (!position_ok(lat_deg, lon_deg) || !height_ok(height_m))
        return SKV_ERR_RANGE;
    return fenced([&] {
        Geocentric::WGS84().Forward(lat_deg, lon_deg, height_m, ecef_m[0], ecef_m[1], ecef_m[2]);
        return SKV_OK;
    });
}

skv_status skv_geo_geodetic_from_ecef(const double ecef_m[3], double *lat_deg, double *lon_deg, double *height_m) {
    if (!ecef_m || !lat_deg || !lon_deg || !height_m)
        return SKV_ERR_NULL;
    for (int i = 0; i < 3; i++)
        if (!within(ecef_m[i], -1e10, 1e10))
            return SKV_ERR_RANGE;
    return fenced([&] {
        double lat, lon, h;
        Geocentric::WGS84().Reverse(ecef_m[0], ecef_m[1], ecef_m[2], lat, lon, h);
        if (!within(h, -20e3, 2e10))
            return SKV_ERR_RANGE;
        *lat_deg = lat;
        *lon_deg = lon;
        *height_m = h;
        return SKV_OK;
    });
}

skv_status skv_geo_enu_from_geodetic(const skv_geo_position *origin, const skv_geo_position *target, double enu_m[3]) {
    if (!origin || !target || !enu_m)
        return SKV_ERR_NULL;
    if (!fix_ok(*origin) || !fix_ok(*target))
        return SKV_ERR_RANGE;
    return fenced([&] {
        const LocalCartesian local(origin->lat_deg, origin->lon_deg, origin->height_m);
        local.Forward(target->lat_deg, target->lon_deg, target->height_m, enu_m[0], enu_m[1], enu_m[2]);
        return SKV_OK;
    });
}

skv_status skv_geo_geodetic_from_enu(const skv_geo_position *origin, const double enu_m[3], skv_geo_position *target) {
    if (!origin || !enu_m || !target)
        return SKV_ERR_NULL;
    if (!fix_ok(*origin))
        return SKV_ERR_RANGE;
    for (int i = 0; i < 3; i++)
        if (!within(enu_m[i], -1e10, 1e10))
            return SKV_ERR_RANGE;
    return fenced([&] {
        const LocalCartesian local(origin->lat_deg, origin->lon_deg, origin->height_m);
        skv_geo_position p;
        local.Reverse(enu_m[0], enu_m[1], enu_m[2], p.lat_deg, p.lon_deg, p.height_m);
        if (!within(p.height_m, -20e3, 2e10))
            return SKV_ERR_RANGE;
        *target = p;
        return SKV_OK;
    });
}

skv_status skv_geo_enu_basis(double lat_deg, double lon_deg, double basis[3][3]) {
    if (!basis)
        return SKV_ERR_NULL;
    if (!position_ok(lat_deg, lon_deg))
        return SKV_ERR_RANGE;
    return fenced([&] {
        basis_at(lat_deg, lon_deg, basis);
        return SKV_OK;
    });
}

skv_status skv_geo_rotate(skv_geo_frame from_frame, skv_geo_frame to_frame, double lat_deg, double lon_deg,
                          const double from[3], double to[3]) {
    if (!from || !to)
        return SKV_ERR_NULL;
    if (!frame_ok(from_frame) || !frame_ok(to_frame))
        return SKV_ERR_UNSUPPORTED;
    if (!position_ok(lat_deg, lon_deg) || !finite3(from))
        return SKV_ERR_RANGE;
    return fenced([&] {
        double basis[3][3], v[3] = {from[0], from[1], from[2]};
        basis_at(lat_deg, lon_deg, basis);
        rotate(from_frame, to_frame, basis, v);
        if (!finite3(v)) // the sum of three may overflow
            return SKV_ERR_RANGE;
        for (int i = 0; i < 3; i++)
            to[i] = v[i];
        return SKV_OK;
    });
}

skv_status skv_geo_enu_from_angles(double azimuth_deg, double elevation_deg, double enu[3]) {
    if (!enu)
        return SKV_ERR_NULL;
    if (!within(azimuth_deg, -360, 360) || !within(elevation_deg, -90, 90))
        return SKV_ERR_RANGE;
    return fenced([&] {
        double sin_a, cos_a, sin_e, cos_e;
        Math::sincosd(azimuth_deg, sin_a, cos_a);
        Math::sincosd(elevation_deg, sin_e, cos_e);
        enu[0] = cos_e * sin_a;
        enu[1] = cos_e * cos_a;
        enu[2] = sin_e;
        return SKV_OK;
    });
}

skv_status skv_geo_angles_from_enu(const double enu[3], double *azimuth_deg, double *elevation_deg) {
    if (!enu || !azimuth_deg || !elevation_deg)
        return SKV_ERR_NULL;
    if (!finite3(enu))
        return SKV_ERR_RANGE;
    if (enu[0] == 0 && enu[1] == 0 && enu[2] == 0)
        return SKV_ERR_DIRECTION;
    return fenced([&] {
        const double flat = std::hypot(enu[0], enu[1]);
        *azimuth_deg = flat == 0 ? 0 : azimuth(Math::atan2d(enu[0], enu[1]));
        *elevation_deg = Math::atan2d(enu[2], flat);
        return SKV_OK;
    });
}

skv_status skv_geo_inverse(double lat1_deg, double lon1_deg, double lat2_deg, double lon2_deg, skv_geo_way *way) {
    if (!way)
        return SKV_ERR_NULL;
    if (!position_ok(lat1_deg, lon1_deg) || !position_ok(lat2_deg, lon2_deg))
        return SKV_ERR_RANGE;
    return fenced([&] {
        double s, a1, a2;
        Geodesic::WGS84().Inverse(lat1_deg, lon1_deg, lat2_deg, lon2_deg, s, a1, a2);
        *way = {s, azimuth(a1), azimuth(a2)};
        return SKV_OK;
    });
}

skv_status skv_geo_direct(double lat1_deg, double lon1_deg, double azimuth1_deg, double distance_m, double *lat2_deg,
                          double *lon2_deg, double *azimuth2_deg) {
    if (!lat2_deg || !lon2_deg || !azimuth2_deg)
        return SKV_ERR_NULL;
    if (!position_ok(lat1_deg, lon1_deg) || !within(azimuth1_deg, -360, 360) || !within(distance_m, -1e9, 1e9))
        return SKV_ERR_RANGE;
    return fenced([&] {
        double lat, lon, a2;
        Geodesic::WGS84().Direct(lat1_deg, lon1_deg, azimuth1_deg, distance_m, lat, lon, a2);
        *lat2_deg = lat;
        *lon2_deg = lon;
        *azimuth2_deg = azimuth(a2);
        return SKV_OK;
    });
}
