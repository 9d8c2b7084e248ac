#include "cockpit_state.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// Tuned for frames every .1 s (position) and every second (time): half of a frame's surprise is believed at once.
// Speeds: 3 km/s over the ground, half a turn of longitude near the poles. Time may run 90 times as fast as it should;
// faster it goes by jumps.
static const cockpit_motion_kind latitude_kind = {
    .alpha = .5, .beta = .2, .jump = .2, .speed = .03, .period_s = .1, .hold_s = .3, .blend_s = .25};
static const cockpit_motion_kind longitude_kind = {
    .alpha = .5, .beta = .2, .jump = 1, .speed = 180, .period_s = .1, .hold_s = .3, .blend_s = .25, .wrap = 360};
static const cockpit_motion_kind height_kind = {
    .alpha = .5, .beta = .2, .jump = 1000, .speed = 3000, .period_s = .1, .hold_s = .3, .blend_s = .25};
static const cockpit_motion_kind clock_kind = {
    .alpha = .5, .beta = .3, .jump = 90, .speed = 90, .first_speed = 1, .period_s = 1, .hold_s = 3, .blend_s = .5};
static const cockpit_motion_kind azimuth_kind = {
    .alpha = .6, .beta = .3, .jump = 5, .speed = 10, .period_s = 1, .hold_s = 3, .blend_s = .5, .wrap = 360};
static const cockpit_motion_kind elevation_kind = {
    .alpha = .6, .beta = .3, .jump = 5, .speed = 10, .period_s = 1, .hold_s = 3, .blend_s = .5};

// Best first: the sky wants the height above the sea.
static const skv_cas_index heights[] = {SKV_CAS_TRUE_ALTITUDE, SKV_CAS_BARO_ALTITUDE, SKV_CAS_GPS_HEIGHT,
                                        SKV_CAS_STANDARD_ALTITUDE};
enum { HEIGHTS = sizeof heights / sizeof heights[0] };
static const skv_cas_index needed[] = {
    SKV_CAS_LATITUDE,    SKV_CAS_LONGITUDE,         SKV_CAS_TRUE_ALTITUDE, SKV_CAS_BARO_ALTITUDE,
    SKV_CAS_GPS_HEIGHT,  SKV_CAS_STANDARD_ALTITUDE, SKV_CAS_UTC,           SKV_CAS_DATE,
    SKV_CAS_SUN_AZIMUTH, SKV_CAS_SUN_ELEVATION,     SKV_CAS_VISIBILITY,    SKV_CAS_EXPOSURE,
    SKV_CAS_TIME_OFFSET, SKV_CAS_VISIBILITY_SETTING};
enum { NEEDED = sizeof needed / sizeof needed[0] };

/// How fast what was learnt of the geoid is given up.
static const double learnt_fade_s = 600.0;
static const double degree = 3.14159265358979323846 / 180.0, day_s = 86400.0;

int cockpit_state_ids(uint32_t *ids, int room) {
    int n = 0;
    for (int i = 0; i < NEEDED && n < room; i++)
        ids[n++] = skv_cas_table[needed[i]].id;
    if (n < room)
        ids[n++] = SKV_CAS_ID_REQUEST;
    return n;
}

void cockpit_state_begin(cockpit_state *s, double default_visibility_km) {
    memset(s, 0, sizeof *s);
    s->height_from = SKV_CAS_MESSAGES;
    s->default_visibility_km = default_visibility_km;
}

static skv_cas_age age(const cockpit_state *s, skv_cas_index index) {
    return (skv_cas_age)s->cas.slot[index].age;
}

/// The best height that is fresh.
static skv_cas_index best_height(const cockpit_state *s) {
    for (int i = 0; i < HEIGHTS; i++)
        if (age(s, heights[i]) == SKV_CAS_FRESH)
            return heights[i];
    return s->height_from;
}

/// Midnight comes to the two messages one after the other: within 5 s of it (of a clock that runs as it should) the day
/// follows the clock.
static double near_midnight(const cockpit_state *s, double seconds, double of_day, int64_t time_ns) {
    const double near_s = 5.0 * fmax(1.0, fabs(s->clock.speed));
    if (s->clock.frames == 0 || (of_day > near_s && of_day < day_s - near_s))
        return seconds;
    const double expected = cockpit_motion_at(&s->clock, &clock_kind, time_ns);
    for (int days = -1; days <= 1; days += 2)
        if (fabs(seconds + days * day_s - expected) < 2.0 * near_s)
            return seconds + days * day_s;
    return seconds;
}

static void take_time(cockpit_state *s, int64_t time_ns) {
    uint8_t utc[4], date[4];
    skv_utc moment;
    if (skv_cas_bytes(&s->cas, SKV_CAS_UTC, utc) == SKV_CAS_NEVER ||
        skv_cas_bytes(&s->cas, SKV_CAS_DATE, date) == SKV_CAS_NEVER)
        return;
    if (skv_utc_from_calendar(&moment, 100 * date[2] + date[3], date[1], date[0], utc[0], utc[1], (float)utc[2]) !=
        SKV_OK)
        return;
    const double of_day = (double)moment.seconds;
    cockpit_motion_frame(&s->clock, &clock_kind, near_midnight(s, day_s * moment.day + of_day, of_day, time_ns),
                         time_ns);
}

/// Height of the sea above the ellipsoid: as the bus had it last, which fades to what the file says (an altimeter's
/// error, that is in it, belongs to one height).
static double geoid(const cockpit_state *s, int64_t time_ns) {
    const double ago_s = fmax(0.0, 1e-9 * (double)(time_ns - s->learnt_ns));
    return s->learnt > 0 ? s->geoid_m + (s->learnt_m - s->geoid_m) * exp(-ago_s / learnt_fade_s) : s->geoid_m;
}

/// A height above the ellipsoid while one above the sea is fresh and shown.
static void learn(cockpit_state *s, double ellipsoid_m, int64_t time_ns) {
    const skv_cas_slot *const slot = &s->cas.slot[s->height_from];
    const double since_s = 1e-9 * (double)(time_ns - slot->time_ns);
    const double above_m = ellipsoid_m - (slot->value + s->height.speed * since_s);
    if (fabs(above_m) > height_kind.jump) // one of them was put elsewhere, the other not yet
        return;
    s->learnt += s->learnt < 10;
    s->learnt_m += (above_m - s->learnt_m) / s->learnt;
    s->learnt_ns = time_ns;
}

static void take_height(cockpit_state *s, skv_cas_index index, double value, int64_t time_ns) {
    const bool ellipsoid = skv_cas_table[index].datum == SKV_CAS_ELLIPSOID;
    if (best_height(s) == index) {
        s->height_from = index;
        cockpit_motion_frame(&s->height, &height_kind, ellipsoid ? value - geoid(s, time_ns) : value, time_ns);
    } else if (ellipsoid && best_height(s) == s->height_from) {
        learn(s, value, time_ns);
    }
}

static void take(cockpit_state *s, skv_cas_index index, int64_t time_ns) {
    double value = 0.0;
    (void)skv_cas_value(&s->cas, index, &value);
    switch (index) {
    case SKV_CAS_LATITUDE:
        cockpit_motion_frame(&s->latitude, &latitude_kind, value, time_ns);
        break;
    case SKV_CAS_LONGITUDE:
        cockpit_motion_frame(&s->longitude, &longitude_kind, value, time_ns);
        break;
    case SKV_CAS_UTC:
        take_time(s, time_ns);
        break;
    case SKV_CAS_DATE:
        if (s->clock.frames == 0)
            take_time(s, s->cas.slot[SKV_CAS_UTC].time_ns);
        break;
    case SKV_CAS_SUN_AZIMUTH:
        cockpit_motion_frame(&s->sun_azimuth, &azimuth_kind, value, time_ns);
        break;
    case SKV_CAS_SUN_ELEVATION:
        cockpit_motion_frame(&s->sun_elevation, &elevation_kind, value, time_ns);
        break;
    case SKV_CAS_TRUE_ALTITUDE:
    case SKV_CAS_BARO_ALTITUDE:
    case SKV_CAS_GPS_HEIGHT:
    case SKV_CAS_STANDARD_ALTITUDE:
        take_height(s, index, value, time_ns);
        break;
    default:
        break;
    }
}

skv_cas_count cockpit_state_frame(cockpit_state *s, const skv_can_frame *frame, int64_t time_ns) {
    const skv_cas_count became = skv_cas_receive(&s->cas, frame, time_ns);
    const int index = became == SKV_CAS_ACCEPTED ? skv_cas_find(frame->id) : -1;
    if (index < 0)
        return became;
    if (s->accepted++ == 0)
        s->first_ns = time_ns;
    s->last_ns = time_ns;
    take(s, (skv_cas_index)index, time_ns);
    return became;
}

static bool fresh(const cockpit_state *s, skv_cas_index index) {
    return age(s, index) == SKV_CAS_FRESH;
}

static void place(const cockpit_state *s, int64_t now_ns, cockpit_now *now) {
    now->has_position = s->latitude.frames > 0 && s->longitude.frames > 0;
    now->position_stale = now->has_position && !(fresh(s, SKV_CAS_LATITUDE) && fresh(s, SKV_CAS_LONGITUDE));
    now->latitude_deg = fmax(-90.0, fmin(90.0, cockpit_motion_at(&s->latitude, &latitude_kind, now_ns)));
    now->longitude_deg = cockpit_motion_at(&s->longitude, &longitude_kind, now_ns);
    now->has_height = s->height.frames > 0;
    if (!now->has_height)
        return;
    now->height_m = cockpit_motion_at(&s->height, &height_kind, now_ns);
    now->datum = (skv_cas_datum)skv_cas_table[s->height_from].datum;
    now->geoid_m = now->datum == SKV_CAS_ELLIPSOID ? geoid(s, now_ns) : 0.0;
    now->height_stale = !fresh(s, s->height_from);
}

/// Knobs of other nodes count too.
static double offset_s(const cockpit_state *s) {
    double by_bus = 0.0;
    return skv_cas_value(&s->cas, SKV_CAS_TIME_OFFSET, &by_bus) == SKV_CAS_NEVER ? s->time_offset_s
                                                                                 : s->time_offset_s + by_bus;
}

static void tell_time(const cockpit_state *s, int64_t now_ns, cockpit_now *now) {
    now->has_time = s->clock.frames > 0;
    if (!now->has_time)
        return;
    now->time_stale = !(fresh(s, SKV_CAS_UTC) && fresh(s, SKV_CAS_DATE));
    now->time_offset_s = offset_s(s);
    const double seconds = cockpit_motion_at(&s->clock, &clock_kind, now_ns) + now->time_offset_s;
    const double day = fmax(-36525.0, fmin(36890.0, floor(seconds / day_s)));
    now->utc.day = (int32_t)day;
    now->utc.seconds = (float)fmax(0.0, fmin(86399.99, seconds - day * day_s));
}

static void sun_by_bus(const cockpit_state *s, int64_t now_ns, cockpit_now *now) {
    const double a = degree * cockpit_motion_at(&s->sun_azimuth, &azimuth_kind, now_ns);
    const double e_deg = fmax(-90.0, fmin(90.0, cockpit_motion_at(&s->sun_elevation, &elevation_kind, now_ns)));
    const double e = degree * e_deg, turn = a / degree;
    now->sun_by_bus = now->has_sun = true;
    now->time_stale = !(fresh(s, SKV_CAS_SUN_AZIMUTH) && fresh(s, SKV_CAS_SUN_ELEVATION));
    now->sun = (skv_sun){{(float)(cos(e) * sin(a)), (float)(cos(e) * cos(a)), (float)sin(e)},
                         (float)(turn < 0 ? turn + 360 : turn),
                         (float)e_deg,
                         1.0f};
}

/// From time and position; from the bus's own sun messages where time or position never came, or is stale while they
/// are fresh.
static void find_lights(const cockpit_state *s, int64_t now_ns, cockpit_now *now) {
    const bool by_time = now->has_time && now->has_position;
    const bool by_bus = s->sun_azimuth.frames > 0 && s->sun_elevation.frames > 0;
    const bool bus_fresh = by_bus && fresh(s, SKV_CAS_SUN_AZIMUTH) && fresh(s, SKV_CAS_SUN_ELEVATION);
    if (by_bus && (!by_time || (bus_fresh && now->time_stale))) {
        sun_by_bus(s, now_ns, now);
        return;
    }
    if (!by_time)
        return;
    const double height_km = fmax(-12.0, fmin(1e6, 1e-3 * now->height_m));
    const skv_position position = {(float)now->latitude_deg, (float)now->longitude_deg, (float)height_km};
    now->has_sun = skv_sun_at(&now->sun, &now->utc, &position) == SKV_OK;
    now->has_moon = now->has_sun && skv_moon_at(&now->moon, &now->utc, &position) == SKV_OK;
}

static double visibility(const cockpit_state *s) {
    double setting = 0.0;
    if (s->visibility_km > 0)
        return s->visibility_km;
    if (skv_cas_value(&s->cas, SKV_CAS_VISIBILITY_SETTING, &setting) != SKV_CAS_NEVER && setting > 0)
        return 1e-3 * setting;
    if (skv_cas_value(&s->cas, SKV_CAS_VISIBILITY, &setting) != SKV_CAS_NEVER && setting > 0)
        return 1e-3 * setting;
    return s->default_visibility_km;
}

void cockpit_state_now(cockpit_state *s, int64_t now_ns, cockpit_now *now) {
    memset(now, 0, sizeof *now);
    now->stale = skv_cas_tick(&s->cas, now_ns);
    place(s, now_ns, now);
    tell_time(s, now_ns, now);
    find_lights(s, now_ns, now);
    now->held = now->has_sun && now->time_stale && (now->position_stale || !now->has_position) &&
                (now->height_stale || !now->has_height);
    now->visibility_km = visibility(s);
    if (skv_cas_value(&s->cas, SKV_CAS_EXPOSURE, &now->exposure) != SKV_CAS_FRESH)
        now->exposure = 0.0;
}

const char *cockpit_state_stale(const cockpit_state *s, char *text, size_t size) {
    size_t used = 0;
    text[0] = '\0';
    for (int i = 0; i < SKV_CAS_MESSAGES; i++) {
        if (s->cas.slot[i].age != SKV_CAS_OLD)
            continue;
        const char *const name = skv_cas_table[i].name;
        const bool fits = used + strlen(name) + 5 < size;
        used += (size_t)snprintf(text + used, size - used, "%s%s", used ? " " : "", fits ? name : "...");
        if (!fits)
            break;
    }
    return text;
}
