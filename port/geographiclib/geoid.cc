/// Heights through a geoid grid: GeographicLib's Geoid, whole in memory, cubic.
#include "fence.hh"

#include <cstdlib>
#include <memory>
#include <unistd.h>

#include <GeographicLib/Geoid.hpp>

using namespace skv_geo;

struct skv_geoid {
    GeographicLib::Geoid grid;
};

namespace {

const char suffix[] = ".pgm";

/// GeographicLib wants the folder and the name without its suffix; an empty folder would mean its own default one.
skv_geoid *load(const std::string &path) {
    const size_t n = path.size(), tail = sizeof suffix - 1;
    if (n <= tail || path.compare(n - tail, tail, suffix) != 0)
        throw Refusal(SKV_ERR_UNSUPPORTED, "geoid '" + path + "': the name must end in .pgm");
    const size_t slash = path.rfind('/');
    const std::string folder = slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
    const size_t first = slash == std::string::npos ? 0 : slash + 1;
    const bool cubic = true, in_memory = true;
    return new skv_geoid{GeographicLib::Geoid(path.substr(first, n - tail - first), folder, cubic, in_memory)};
}

std::string own_folder() {
    char buffer[4096];
    const ssize_t n = readlink("/proc/self/exe", buffer, sizeof buffer);
    if (n <= 0 || static_cast<size_t>(n) >= sizeof buffer)
        return "";
    const std::string program(buffer, static_cast<size_t>(n));
    return program.substr(0, program.rfind('/'));
}

std::string find_grid() {
    const char *named = std::getenv("SKYVERT_GEOID");
    if (named && *named)
        return named;
    const std::string folder = own_folder();
    for (const char *place : {"/geoid/egm96-15.pgm", "/../share/skyvert/geoid/egm96-15.pgm"})
        if (!folder.empty() && access((folder + place).c_str(), R_OK) == 0)
            return folder + place;
    throw Refusal(SKV_ERR_UNSUPPORTED, "no geoid grid, so heights above the ellipsoid and above the sea cannot be "
                                       "converted: install the package proj-data and run make, or name a grid in "
                                       "SKYVERT_GEOID");
}

skv_status undulation(const skv_geoid *geoid, double lat_deg, double lon_deg, double *n_m) {
    if (!geoid || !n_m)
        return SKV_ERR_NULL;
    if (!position_ok(lat_deg, lon_deg))
        return SKV_ERR_RANGE;
    return fenced([&] {
        const double n = geoid->grid(lat_deg, lon_deg);
        if (!std::isfinite(n))
            return SKV_ERR_RANGE;
        *n_m = n;
        return SKV_OK;
    });
}

/// sign +1: from above the sea to above the ellipsoid.
skv_status shift(const skv_geoid *geoid, double lat_deg, double lon_deg, double sign, double from_m, double *to_m) {
    if (!to_m)
        return SKV_ERR_NULL;
    double n_m = 0;
    const skv_status status = undulation(geoid, lat_deg, lon_deg, &n_m);
    if (status != SKV_OK)
        return status;
    if (!height_ok(from_m))
        return SKV_ERR_RANGE;
    *to_m = from_m + sign * n_m;
    return SKV_OK;
}

} // namespace

skv_status skv_geo_geoid_open(const char *path, skv_geoid **geoid, char *message, size_t size) {
    if (!path || !geoid)
        return SKV_ERR_NULL;
    return fenced(message, size, SKV_ERR_UNSUPPORTED, [&] {
        try {
            *geoid = load(path);
        } catch (const GeographicLib::GeographicErr &e) {
            throw Refusal(SKV_ERR_UNSUPPORTED, "geoid '" + std::string(path) + "': " + e.what() +
                                                   " (make builds one out of the package proj-data)");
        }
        return SKV_OK;
    });
}

void skv_geo_geoid_close(skv_geoid *geoid) {
    (void)fenced([&] {
        delete geoid;
        return SKV_OK;
    });
}

skv_status skv_geo_geoid_find(char *path, size_t path_size, char *message, size_t size) {
    if (!path)
        return SKV_ERR_NULL;
    return fenced(message, size, SKV_ERR_UNSUPPORTED, [&] {
        const std::string found = find_grid();
        if (found.size() >= path_size)
            throw Refusal(SKV_ERR_SIZE, "geoid '" + found + "': the name is too long");
        std::snprintf(path, path_size, "%s", found.c_str());
        return SKV_OK;
    });
}

skv_status skv_geo_undulation(const skv_geoid *geoid, double lat_deg, double lon_deg, double *undulation_m) {
    return undulation(geoid, lat_deg, lon_deg, undulation_m);
}

skv_status skv_geo_msl_from_height(const skv_geoid *geoid, double lat_deg, double lon_deg, double height_m,
                                   double *msl_m) {
    return shift(geoid, lat_deg, lon_deg, -1, height_m, msl_m);
}

skv_status skv_geo_height_from_msl(const skv_geoid *geoid, double lat_deg, double lon_deg, double msl_m,
                                   double *height_m) {
    return shift(geoid, lat_deg, lon_deg, 1, msl_m, height_m);
}
