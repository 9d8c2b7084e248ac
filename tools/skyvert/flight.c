#include "flight.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static const double degree = 3.14159265358979323846 / 180.0;

/// Most fixes of a flight: a day and more at 100 Hz.
#define FIXES_MAX 10000000

int flight_read(flight *track, const char *path, bool ellipsoid, igc_altitude altitude) {
    const size_t n = strlen(path);
    const bool igc = n > 4 && strcasecmp(path + n - 4, ".igc") == 0;
    memset(track, 0, sizeof *track);
    int status = igc ? flight_read_igc(track, path, altitude) : flight_read_csv(track, path, ellipsoid);
    if (status == 0 && track->count == 0)
        status = fail_usage("%.200s: an empty track: at least one fix with a position is needed", path);
    if (status != 0)
        flight_free(track);
    return status;
}

void flight_free(flight *track) {
    free(track->fixes);
    memset(track, 0, sizeof *track);
}

static bool grow(flight *track) {
    const size_t capacity = track->capacity ? 2 * track->capacity : 1024;
    fix *fixes = realloc(track->fixes, capacity * sizeof *fixes);
    if (!fixes)
        return false;
    track->fixes = fixes;
    track->capacity = capacity;
    return true;
}

int flight_append(flight *track, const fix *next, const char *path, long line) {
    const fix *last = track->count > 0 ? &track->fixes[track->count - 1] : NULL;
    if (last && utc_difference(&next->utc, &last->utc) < 0.0) {
        char now[UTC_TEXT_SIZE], before[UTC_TEXT_SIZE];
        return fail_usage("%.200s:%ld: the track goes backwards in time: %s after %s", path, line,
                          utc_text(&next->utc, now), utc_text(&last->utc, before));
    }
    if (track->count == FIXES_MAX)
        return fail_usage("%.200s:%ld: more than %d fixes", path, line, FIXES_MAX);
    if (track->count == track->capacity && !grow(track))
        return fail_job("%.200s:%ld: out of memory", path, line);
    track->fixes[track->count++] = *next;
    return 0;
}

double flight_duration_s(const flight *track) {
    return utc_difference(&track->fixes[track->count - 1].utc, &track->fixes[0].utc);
}

// ---- between fixes

static void to_normal(const fix *at, double v[3]) {
    const double lat = at->lat_deg * degree, lon = at->lon_deg * degree;
    v[0] = cos(lat) * cos(lon);
    v[1] = cos(lat) * sin(lon);
    v[2] = sin(lat);
}

/// Great circle between two surface normals: no seam at the date line or a pole.
static void between(const fix *a, const fix *b, double share, fix *out) {
    double va[3], vb[3], v[3], dot = 0.0, chord = 0.0;
    to_normal(a, va);
    to_normal(b, vb);
    for (int i = 0; i < 3; i++) {
        dot += va[i] * vb[i];
        chord += (va[i] - vb[i]) * (va[i] - vb[i]);
    }
    const double angle = dot > 0.0 ? 2.0 * asin(fmin(1.0, 0.5 * sqrt(chord))) : acos(fmax(-1.0, dot));
    const bool tiny = angle < 1e-6; // 6 m: a straight line
    const double wa = tiny ? 1.0 - share : sin((1.0 - share) * angle), wb = tiny ? share : sin(share * angle);
    for (int i = 0; i < 3; i++)
        v[i] = wa * va[i] + wb * vb[i];
    out->lat_deg = atan2(v[2], hypot(v[0], v[1])) / degree;
    out->lon_deg = atan2(v[1], v[0]) / degree;
}

fix flight_at(const flight *track, double after_s, size_t *hint) {
    const fix *fixes = track->fixes;
    size_t i = *hint;
    while (i + 2 < track->count && utc_difference(&fixes[i + 1].utc, &fixes[0].utc) <= after_s)
        i++;
    *hint = i;
    fix out = fixes[i];
    out.utc = utc_add(&fixes[0].utc, after_s);
    if (i + 1 >= track->count)
        return out;
    const double step_s = utc_difference(&fixes[i + 1].utc, &fixes[i].utc);
    const double into_s = after_s - utc_difference(&fixes[i].utc, &fixes[0].utc);
    const double share = step_s > 0.0 ? fmin(1.0, fmax(0.0, into_s / step_s)) : 1.0;
    if (share > 0.0) {
        between(&fixes[i], &fixes[i + 1], share, &out);
        out.height_m = fixes[i].height_m + share * (fixes[i + 1].height_m - fixes[i].height_m);
    }
    return out;
}
