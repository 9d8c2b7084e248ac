/// Positions: text to latitude and longitude, heights through a geoid, the local sphere, frames, geodesics.
///
/// The C face of GeographicLib (WGS 84, double precision). No C++ exception leaves this file's functions.
/// All angles are in degrees, all lengths in metres unless the name says _km. Latitude is geodetic, in [-90, 90], north
/// positive; longitude is in [-180, 360], east positive, and comes back in [-180, 180]. Heights above the ellipsoid are
/// `height_m`, in [-20e3, 1e9]: GNSS and CAN send those; above the sea (`msl_m`) are charts, baro and airports.
/// Every function: SKV_ERR_NULL iff a pointer is NULL that is not marked optional, SKV_ERR_RANGE iff a number is NaN,
/// infinite or out of range, SKV_ERR_SIZE iff memory ran out. On error nothing is written, except the message where
/// there is one. Thread-safe: no hidden state. A geoid may be shared by any number of threads.
#ifndef SKV_GEO_H
#define SKV_GEO_H

#include <stddef.h>
#include "skyvert/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Bytes that hold any message of this header; a shorter buffer gets it cut, and 0-terminated all the same.
enum { SKV_GEO_MESSAGE = 320 };

/// Reads a position.
///   decimal   47.46, 8.55         -33.9 151.2         latitude first; a comma or blanks between
///   DMS       47:27:32N 8:32:2E   47d27'32"N 8d32'2"E  E8:32:02 N47:27.5   with letters in any order
///             47 27 32 N 8 32 2 E
///   charts    472732N 0083202E    N4727.5 E00832.0     DDMM[SS] and DDDMM[SS]: the letters are needed
///   UTM/UPS   32T 465000 5256000  32n 465000 5256000   465000 5256000 32north   latitude band or hemisphere
///   MGRS      32TMT6500056000     32T MT 65000 56000   the middle of that square, which may be at most 10 km wide
/// "32s" is the southern hemisphere. So is "32S" where the northing cannot lie in the northern band S; where it can,
/// the text is refused as ambiguous.
/// @param[in]  text        0-terminated, at most 200 bytes.
/// @param[out] lat_deg, lon_deg
/// @param[out] message     optional: on error one line without newline: what was wrong, what is allowed.
/// @param[in]  size        bytes in message.
/// @return SKV_OK; SKV_ERR_RANGE iff text is no position in one of these forms.
skv_status skv_geo_parse(const char *text, double *lat_deg, double *lon_deg, char *message, size_t size);

/// A geoid grid in memory (2 MB for 15').
typedef struct skv_geoid skv_geoid;

/// Loads a geoid grid of GeographicLib's PGM kind, e.g. build/geoid/egm96-15.pgm (made by `make` out of proj-data).
/// @param[in]  path     file name, must end in ".pgm".
/// @param[out] geoid    to be closed by skv_geo_geoid_close().
/// @param[out] message  optional: on error one line: the file, what is wrong with it, the package to install.
/// @return SKV_OK; SKV_ERR_UNSUPPORTED iff the file is not there, not readable or not a whole geoid grid.
skv_status skv_geo_geoid_open(const char *path, skv_geoid **geoid, char *message, size_t size);

/// Frees the grid. NULL is allowed.
void skv_geo_geoid_close(skv_geoid *geoid);

/// Where a program finds its geoid: the file that SKYVERT_GEOID names, else geoid/egm96-15.pgm beside the program,
/// else ../share/skyvert/geoid/egm96-15.pgm from there.
/// @param[out] path     0-terminated.
/// @param[out] message  optional: on error one line that names the package.
/// @return SKV_OK; SKV_ERR_UNSUPPORTED iff there is none; SKV_ERR_SIZE iff path is too short for it.
skv_status skv_geo_geoid_find(char *path, size_t path_size, char *message, size_t size);

/// Height of the geoid (mean sea level) above the ellipsoid: the cubic fit of GeographicLib::Geoid.
/// Error: EGM96 at 15', against the full model: 7 mm rms, .169 m at most (GeographicLib's own figures, GeoidEval(1)).
/// @param[out] undulation_m  height above ellipsoid = height above the sea + undulation.
skv_status skv_geo_undulation(const skv_geoid *geoid, double lat_deg, double lon_deg, double *undulation_m);

/// Height above the sea from that above the ellipsoid, and back.
skv_status skv_geo_msl_from_height(const skv_geoid *geoid, double lat_deg, double lon_deg, double height_m,
                                   double *msl_m);
skv_status skv_geo_height_from_msl(const skv_geoid *geoid, double lat_deg, double lon_deg, double msl_m,
                                   double *height_m);

/// Radius of the sphere that stands for the ellipsoid at a latitude: sqrt(M N), M and N its two principal radii of
/// curvature (the Gaussian radius). 6356.752 km on the equator, 6399.594 km at the poles.
skv_status skv_geo_local_sphere(double lat_deg, double *radius_km);

/// Earth-centred, Earth-fixed position (x towards 0 N 0 E, z towards the north pole) and back.
/// Back: SKV_ERR_RANGE also iff a coordinate is over 1e10 m or the point lies more than 20 km below the ellipsoid.
skv_status skv_geo_ecef_from_geodetic(double lat_deg, double lon_deg, double height_m, double ecef_m[3]);
skv_status skv_geo_geodetic_from_ecef(const double ecef_m[3], double *lat_deg, double *lon_deg, double *height_m);

/// Where a target is seen from an origin: east, north, up in metres (flat axes at the origin), and back.
typedef struct skv_geo_position {
    double lat_deg, lon_deg, height_m; ///< above the ellipsoid
} skv_geo_position;
skv_status skv_geo_enu_from_geodetic(const skv_geo_position *origin, const skv_geo_position *target, double enu_m[3]);
skv_status skv_geo_geodetic_from_enu(const skv_geo_position *origin, const double enu_m[3], skv_geo_position *target);

/// The unit vectors east, north, up at a position, as rows, in ECEF.
/// At a pole east and north follow the longitude that was given.
skv_status skv_geo_enu_basis(double lat_deg, double lon_deg, double basis[3][3]);

/// Directions (or any vector) from one frame to another; the length is kept. `from` and `to` may be the same array.
/// SKV_ERR_UNSUPPORTED iff a frame is none of these.
typedef enum skv_geo_frame {
    SKV_GEO_ENU,  ///< east, north, up at the position
    SKV_GEO_NED,  ///< north, east, down at the position
    SKV_GEO_ECEF, ///< Earth-centred, Earth-fixed
} skv_geo_frame;
skv_status skv_geo_rotate(skv_geo_frame from_frame, skv_geo_frame to_frame, double lat_deg, double lon_deg,
                          const double from[3], double to[3]);

/// Unit vector in ENU from azimuth (clockwise from north, in [-360, 360]) and elevation, and back; azimuth comes in
/// [0, 360), 0 for straight up and down. Back: SKV_ERR_DIRECTION iff the vector is zero.
skv_status skv_geo_enu_from_angles(double azimuth_deg, double elevation_deg, double enu[3]);
skv_status skv_geo_angles_from_enu(const double enu[3], double *azimuth_deg, double *elevation_deg);

/// Shortest way between two positions on the ellipsoid.
typedef struct skv_geo_way {
    double distance_m;
    double azimuth1_deg, azimuth2_deg; ///< course at the start and at the end, clockwise from north, in [0, 360)
} skv_geo_way;
skv_status skv_geo_inverse(double lat1_deg, double lon1_deg, double lat2_deg, double lon2_deg, skv_geo_way *way);

/// The position at a distance along the shortest way that starts with an azimuth. |distance| <= 1e9 m.
/// @param[out] lat2_deg, lon2_deg, azimuth2_deg   the last: course there, in [0, 360).
skv_status skv_geo_direct(double lat1_deg, double lon1_deg, double azimuth1_deg, double distance_m, double *lat2_deg,
                          double *lon2_deg, double *azimuth2_deg);

#ifdef __cplusplus
}
#endif
#endif
