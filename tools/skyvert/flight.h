/// Recorded flights: fixes read from CSV or IGC files, and positions between them.
#ifndef SKYVERT_FLIGHT_H
#define SKYVERT_FLIGHT_H

#include <stdbool.h>
#include <stddef.h>

#include "command.h"

typedef struct fix {
    utc_time utc;
    double lat_deg, lon_deg; ///< WGS 84
    double height_m;         ///< above the sea
} fix;

/// Which of the two altitudes of an IGC file counts.
typedef enum igc_altitude {
    IGC_GNSS,     ///< the receiver's, above the ellipsoid (file header HFALG ... GEO:
                  ///< above the sea); a fix without one (validity V) falls back to
                  ///< the pressure altitude
    IGC_PRESSURE, ///< the barometer's at 1013.25 hPa, taken as above the sea
} igc_altitude;

typedef struct flight {
    fix *fixes;
    size_t count, capacity;
    size_t ignored; ///< fixes of an IGC file without any position
} flight;

/// Reads a file; .igc is told by its name, anything else is CSV with the columns utc,lat_deg,lon_deg,height_m.
/// @param[in] ellipsoid  CSV: heights are above the ellipsoid, not the sea.
/// @return 0; 2 after an error line `file:line: what`; 1 iff memory ran out. On error nothing has to be freed.
///         Without a geoid grid both heights count as equal, which one line on stderr says.
int flight_read(flight *track, const char *path, bool ellipsoid, igc_altitude altitude);
void flight_free(flight *track);

/// The two formats, used by flight_read().
int flight_read_csv(flight *track, const char *path, bool ellipsoid);
int flight_read_igc(flight *track, const char *path, igc_altitude altitude);

/// Appends a fix that is not before the last one. @return 0, or a status after an error line that begins `path:line`.
int flight_append(flight *track, const fix *next, const char *path, long line);

double flight_duration_s(const flight *track);

/// Position at `after_s` after the first fix, in [0, duration]: along the great circle between two fixes, height and
/// time linear. @param hint  index to search from, 0 at first, kept between calls with growing times.
fix flight_at(const flight *track, double after_s, size_t *hint);

#endif
