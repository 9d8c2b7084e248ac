/// WGS 84 formulas of the tests' own, in double, from the textbooks: they share nothing with GeographicLib.
#ifndef TESTS_WGS84_H
#define TESTS_WGS84_H

#include <math.h>
#include <stdint.h>

#define WGS84_A  6378137.0
#define WGS84_F  (1 / 298.257223563)
#define WGS84_E2 (WGS84_F * (2 - WGS84_F))
#define DEG      (3.14159265358979323846 / 180)

/// xorshift64*: the same numbers everywhere.
static inline double draw(uint64_t *seed, double low, double high) {
    *seed ^= *seed >> 12;
    *seed ^= *seed << 25;
    *seed ^= *seed >> 27;
    return low + (high - low) * (double)((*seed * 2685821657736338717u) >> 11) / 9007199254740992.0;
}

static inline double radius_n(double lat_deg) {
    const double s = sin(lat_deg * DEG);
    return WGS84_A / sqrt(1 - WGS84_E2 * s * s);
}

static inline double radius_m(double lat_deg) {
    const double s = sin(lat_deg * DEG);
    return WGS84_A * (1 - WGS84_E2) / pow(1 - WGS84_E2 * s * s, 1.5);
}

static inline void to_ecef(double lat_deg, double lon_deg, double h_m, double x[3]) {
    const double n = radius_n(lat_deg), c = (n + h_m) * cos(lat_deg * DEG);
    x[0] = c * cos(lon_deg * DEG);
    x[1] = c * sin(lon_deg * DEG);
    x[2] = (n * (1 - WGS84_E2) + h_m) * sin(lat_deg * DEG);
}

/// East, north, up as rows.
static inline void enu_rows(double lat_deg, double lon_deg, double b[3][3]) {
    const double sl = sin(lon_deg * DEG), cl = cos(lon_deg * DEG), sp = sin(lat_deg * DEG), cp = cos(lat_deg * DEG);
    const double rows[3][3] = {{-sl, cl, 0}, {-sp * cl, -sp * sl, cp}, {cp * cl, cp * sl, sp}};
    for (int i = 0; i < 9; i++)
        b[i / 3][i % 3] = rows[i / 3][i % 3];
}

/// Transverse Mercator by Krueger's series to the fourth order in n: micrometres within 3 deg of the meridian.
/// [Krueger1912] section 5. UTM: scale .9996, false easting 500 km, no false northing.
static inline void to_utm(double lat_deg, double lon_from_meridian_deg, double *easting_m, double *northing_m) {
    const double n = WGS84_F / (2 - WGS84_F), n2 = n * n, n3 = n2 * n, n4 = n3 * n;
    const double alpha[4] = {n / 2 - 2 * n2 / 3 + 5 * n3 / 16 + 41 * n4 / 180,
                             13 * n2 / 48 - 3 * n3 / 5 + 557 * n4 / 1440, 61 * n3 / 240 - 103 * n4 / 140,
                             49561 * n4 / 161280};
    const double e = sqrt(WGS84_E2), s = sin(lat_deg * DEG), l = lon_from_meridian_deg * DEG;
    const double t = sinh(atanh(s) - e * atanh(e * s));
    const double xi = atan2(t, cos(l)), eta = atanh(sin(l) / sqrt(1 + t * t));
    double x = eta, y = xi;
    for (int j = 1; j <= 4; j++) {
        x += alpha[j - 1] * cos(2 * j * xi) * sinh(2 * j * eta);
        y += alpha[j - 1] * sin(2 * j * xi) * cosh(2 * j * eta);
    }
    const double k = .9996 * WGS84_A / (1 + n) * (1 + n2 / 4 + n4 / 64);
    *easting_m = 500e3 + k * x;
    *northing_m = k * y;
}

#endif
