/// GeographicLib's own bilinear reading of a grid, for test_geoid.c: the converter is judged by the reader it writes
/// for.
#include <cmath>
#include <exception>

#include <GeographicLib/Geoid.hpp>

extern "C" int bilinear_heights(const char *folder, const double (*lat_lon)[2], int n, double *height_m);

int bilinear_heights(const char *folder, const double (*lat_lon)[2], int n, double *height_m) {
    try {
        const GeographicLib::Geoid geoid("egm96-15", folder, false, true);
        for (int i = 0; i < n; i++)
            height_m[i] = geoid(lat_lon[i][0], lat_lon[i][1]);
        return 0;
    } catch (const std::exception &) {
        return -1;
    }
}
