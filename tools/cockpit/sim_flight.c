#include "sim_flight.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/skyvert/place.h"

int sim_flight_open(sim_flight *f, const char *path, const sim_flight_options *options) {
    memset(f, 0, sizeof *f);
    f->visibility_m = options->visibility_m;
    const int status = flight_read(&f->track, path, options->ellipsoid, options->altitude);
    if (status != 0)
        return status;
    f->duration_s = flight_duration_s(&f->track);
    place at = {.lat_deg = f->track.fixes[0].lat_deg, .lon_deg = f->track.fixes[0].lon_deg};
    f->knows_ellipsoid = place_set_height_roughly(&at, 0.0, HEIGHT_MSL) == NULL;
    f->posture = sim_postures(&f->track);
    if (f->posture)
        return 0;
    sim_flight_close(f);
    return fail_job("%.200s: out of memory", path);
}

void sim_flight_close(sim_flight *f) {
    free(f->posture);
    flight_free(&f->track);
    place_end();
    memset(f, 0, sizeof *f);
}

/// The fix at a time; which: 0 itself, 1 before, 2 behind. Each has a hint of its own, for times that grow.
static fix fix_at(sim_flight *f, skv_cas_index index, int which, double after_s) {
    return flight_at(&f->track, after_s, &f->hint[index][which]);
}

typedef struct state {
    fix at;
    sim_motion speed; // m/s
    double course_deg, pitch_deg, roll_deg;
} state;

/// Speeds are over the second around the moment.
static state state_at(sim_flight *f, skv_cas_index index, double after_s) {
    if (after_s < f->last_s[index]) // a new lap
        memset(f->hint[index], 0, sizeof f->hint[index]);
    f->last_s[index] = after_s;
    state s = {.at = fix_at(f, index, 0, after_s)};
    const double before_s = fmax(0.0, after_s - 0.5), behind_s = fmin(f->duration_s, after_s + 0.5);
    s.course_deg = (double)f->posture[f->hint[index][0]].course_deg;
    if (after_s > f->duration_s || behind_s - before_s < 0.1)
        return s;
    const fix a = fix_at(f, index, 1, before_s), b = fix_at(f, index, 2, behind_s);
    const sim_motion m = sim_way(&a, &b, &s.at);
    const double per_s = 1.0 / (behind_s - before_s);
    s.speed = (sim_motion){m.north_m * per_s, m.east_m * per_s, m.up_m * per_s};
    if (hypot(s.speed.north_m, s.speed.east_m) >= 1.0)
        s.course_deg = sim_course_deg(&m);
    sim_attitude_at(&f->track, f->posture, f->hint[index][0], after_s, &s.pitch_deg, &s.roll_deg);
    return s;
}

// ---- messages

static int utc_frame(skv_cas_sender *sender, skv_cas_index index, const utc_time *utc, skv_can_frame *frame) {
    int year, month, day, hour, minute;
    double second;
    utc_calendar(utc, &year, &month, &day, &hour, &minute, &second);
    const uint8_t date[4] = {(uint8_t)day, (uint8_t)month, (uint8_t)(year / 100), (uint8_t)(year % 100)};
    const uint8_t time[4] = {(uint8_t)hour, (uint8_t)minute, (uint8_t)second, 0};
    return skv_cas_encode_bytes(sender, index, index == SKV_CAS_DATE ? date : time, frame) == 1;
}

static bool sun_value(skv_cas_index index, const skv_utc *utc, const skv_position *position, double *value) {
    skv_sun sun;
    if (skv_sun_at(&sun, utc, position) != SKV_OK)
        return false;
    *value = (double)(index == SKV_CAS_SUN_AZIMUTH ? sun.azimuth_deg : sun.elevation_deg);
    return true;
}

static bool moon_value(skv_cas_index index, const skv_utc *utc, const skv_position *position, double *value) {
    skv_moon moon;
    if (skv_moon_at(&moon, utc, position) != SKV_OK)
        return false;
    *value = (double)(index == SKV_CAS_MOON_AZIMUTH     ? moon.azimuth_deg
                      : index == SKV_CAS_MOON_ELEVATION ? moon.elevation_deg
                                                        : moon.phase_angle_deg);
    return true;
}

static bool light_value(skv_cas_index index, const fix *at, double *value) {
    place where = {.lat_deg = at->lat_deg, .lon_deg = at->lon_deg};
    (void)place_set_height_roughly(&where, at->height_m, HEIGHT_MSL);
    const skv_utc utc = utc_to_skv(&at->utc);
    const skv_position position = place_to_skv(&where);
    return index <= SKV_CAS_SUN_ELEVATION ? sun_value(index, &utc, &position, value)
                                          : moon_value(index, &utc, &position, value);
}

static double air_value(skv_cas_index index, double msl_m) {
    double pressure_hpa, temperature_c;
    standard_air(msl_m, &pressure_hpa, &temperature_c);
    return index == SKV_CAS_STATIC_PRESSURE ? pressure_hpa : temperature_c + 273.15;
}

static bool ellipsoid_value(const sim_flight *f, const fix *at, double *value) {
    place where = {.lat_deg = at->lat_deg, .lon_deg = at->lon_deg};
    (void)place_set_height_roughly(&where, at->height_m, HEIGHT_MSL);
    *value = where.ellipsoid_m;
    return f->knows_ellipsoid;
}

/// @return false iff it is not known.
static bool value_of(const sim_flight *f, skv_cas_index index, const state *s, double *value) {
    switch (index) {
    case SKV_CAS_LATITUDE:
        *value = s->at.lat_deg;
        return true;
    case SKV_CAS_LONGITUDE:
        *value = s->at.lon_deg;
        return true;
    case SKV_CAS_TRUE_ALTITUDE:
        *value = s->at.height_m;
        return true;
    case SKV_CAS_GPS_HEIGHT:
        return ellipsoid_value(f, &s->at, value);
    case SKV_CAS_GROUND_SPEED:
        *value = hypot(s->speed.north_m, s->speed.east_m);
        return true;
    case SKV_CAS_ALTITUDE_RATE:
        *value = s->speed.up_m;
        return true;
    case SKV_CAS_TRACK:
    case SKV_CAS_HEADING: // there is no wind
    case SKV_CAS_TRUE_HEADING:
        *value = s->course_deg;
        return true;
    case SKV_CAS_PITCH:
        *value = s->pitch_deg;
        return true;
    case SKV_CAS_ROLL:
        *value = s->roll_deg;
        return true;
    case SKV_CAS_AIR_TEMPERATURE:
    case SKV_CAS_OUTSIDE_AIR:
    case SKV_CAS_STATIC_PRESSURE:
        *value = air_value(index, s->at.height_m);
        return true;
    case SKV_CAS_VISIBILITY:
        *value = f->visibility_m;
        return true;
    default:
        return light_value(index, &s->at, value);
    }
}

int sim_flight_frame(sim_flight *f, skv_cas_sender *sender, skv_cas_index index, double after_s, skv_can_frame *frame) {
    const state s = state_at(f, index, after_s);
    skv_can_frame frames[2];
    double value = 0.0;
    if (index == SKV_CAS_UTC || index == SKV_CAS_DATE)
        return utc_frame(sender, index, &s.at.utc, frame);
    if (!value_of(f, index, &s, &value) || skv_cas_encode(sender, index, 0, value, frames) != 1)
        return 0;
    *frame = frames[0];
    return 1;
}

// ---- when

#define MS 1000000

int sim_flight_slots(const sim_flight *f, double start_s, sim_slot *slots) {
    // Values that belong together are close; between the groups the bus is free for others.
    static const struct {
        skv_cas_index index;
        int phase_ms;
    } plan[] = {
        {SKV_CAS_PITCH, 60},
        {SKV_CAS_ROLL, 62},
        {SKV_CAS_ALTITUDE_RATE, 50},
        {SKV_CAS_HEADING, 52},
        {SKV_CAS_AIR_TEMPERATURE, 520},
        {SKV_CAS_STATIC_PRESSURE, 522},
        {SKV_CAS_TRUE_ALTITUDE, 6},
        {SKV_CAS_OUTSIDE_AIR, 524},
        {SKV_CAS_LATITUDE, 0},
        {SKV_CAS_LONGITUDE, 2},
        {SKV_CAS_GPS_HEIGHT, 4},
        {SKV_CAS_GROUND_SPEED, 54},
        {SKV_CAS_TRACK, 56},
        {SKV_CAS_TRUE_HEADING, 58},
        {SKV_CAS_UTC, 8},
        {SKV_CAS_DATE, 10},
        {SKV_CAS_SUN_AZIMUTH, 120},
        {SKV_CAS_SUN_ELEVATION, 122},
        {SKV_CAS_MOON_AZIMUTH, 320},
        {SKV_CAS_MOON_ELEVATION, 322},
        {SKV_CAS_MOON_PHASE, 324},
        {SKV_CAS_VISIBILITY, 720},
    };
    const utc_time start = utc_add(&f->track.fixes[0].utc, start_s);
    const int64_t to_second = (int64_t)ceil((ceil(start.seconds) - start.seconds) * 1e3) * MS;
    int n = 0;
    for (size_t i = 0; i < sizeof plan / sizeof plan[0]; i++) {
        if (plan[i].index == SKV_CAS_GPS_HEIGHT && !f->knows_ellipsoid)
            continue;
        const bool clock = plan[i].index == SKV_CAS_UTC || plan[i].index == SKV_CAS_DATE;
        slots[n++] = (sim_slot){plan[i].index, plan[i].phase_ms * (int64_t)MS + (clock ? to_second : 0),
                                skv_cas_table[plan[i].index].period_ms * (int64_t)MS};
    }
    return n;
}

double sim_slots_load(const sim_slot *slots, int n, double bitrate) {
    const skv_can_frame longest = {.length = 8};
    double bits_per_s = 0.0;
    for (int i = 0; i < n; i++)
        bits_per_s += 1e9 * skv_cas_frame_bits(&longest) / (double)slots[i].period_ns;
    return bits_per_s / bitrate;
}
