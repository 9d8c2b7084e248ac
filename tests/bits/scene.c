/// Calendar, sun, moon, refraction, domes and the frustum.
#include "bits.h"

#include "skyvert/skyvert.h"

static void sun_and_moon(int n) {
    for (int i = 0; i < n; ++i) {
        skv_utc utc = {0, 0.0f};
        skv_sun sun;
        skv_moon moon;
        const int year = 1895 + (int)bits_pick(210);
        const int month = (int)bits_pick(14);
        const int day = (int)bits_pick(33);
        const int hour = (int)bits_pick(24);
        const int minute = (int)bits_pick(60);
        const float second = bits_uniform(0.0f, 60.0f);
        bits_word((uint32_t)skv_utc_from_calendar(&utc, year, month, day, hour, minute, second));
        bits_word((uint32_t)utc.day);
        bits_float(utc.seconds, BITS_NOT_NEGATIVE);
        skv_position position;
        position.lat_deg = bits_pick(10) == 0 ? 90.0f : bits_uniform(-90.0f, 90.0f);
        position.lon_deg = bits_uniform(-360.0f, 360.0f);
        position.height_km = bits_uniform(-1.0f, 20.0f);
        bits_word((uint32_t)skv_sun_at(&sun, &utc, &position));
        bits_floats(sun.direction_enu, 3, BITS_FINITE);
        bits_float(sun.azimuth_deg, BITS_NOT_NEGATIVE);
        bits_float(sun.elevation_deg, BITS_FINITE);
        bits_float(sun.distance_au, BITS_NOT_NEGATIVE);
        bits_word((uint32_t)skv_moon_at(&moon, &utc, &position));
        bits_floats(moon.direction_enu, 3, BITS_FINITE);
        bits_float(moon.azimuth_deg, BITS_NOT_NEGATIVE);
        bits_float(moon.elevation_deg, BITS_FINITE);
        bits_float(moon.distance_km, BITS_NOT_NEGATIVE);
        bits_float(moon.phase_angle_deg, BITS_NOT_NEGATIVE);
        bits_float(moon.illuminated_fraction, BITS_NOT_NEGATIVE);
        const float pressure = bits_uniform(0.0f, 1100.0f);
        const float celsius = bits_uniform(-60.0f, 50.0f);
        bits_float(skv_refraction_deg(sun.elevation_deg, pressure, celsius), BITS_NOT_NEGATIVE);
    }
}

enum { VERTICES = 400, INDICES = 2400 };
static float direction[VERTICES][3];

static size_t build_dome(skv_dome_kind kind, int n) {
    static uint32_t index[INDICES];
    skv_dome dome = {.kind = kind, .radius_km = 6360.0f, .top_km = 60.0f};
    dome.rings = 2 + (int32_t)bits_pick(8);
    dome.rings_below = (int32_t)bits_pick(4);
    dome.azimuths = 3 + (int32_t)bits_pick(n > 100 ? 20 : 8);
    dome.horizon_rad = bits_uniform(-0.3f, 0.0f);
    dome.lowest_rad = bits_pick(3) == 0 ? -1.57079633f : dome.horizon_rad - 0.5f;
    dome.sun_enu[0] = bits_uniform(-1.0f, 1.0f);
    dome.sun_enu[1] = 0.7f;
    dome.sun_enu[2] = bits_uniform(-0.1f, 0.7f);
    dome.height_km = bits_uniform(0.0f, 15.0f);
    size_t vertices = 0, indices = 0;
    bits_word((uint32_t)skv_dome_size(&dome, &vertices, &indices));
    const skv_status status = skv_dome_build(&dome, direction[0], 0, VERTICES, index, INDICES);
    bits_word((uint32_t)status);
    bits_word((uint32_t)vertices);
    bits_word((uint32_t)indices);
    if (status != SKV_OK)
        return 0;
    bits_floats(direction[0], 3 * vertices, BITS_FINITE);
    for (size_t i = 0; i < indices; ++i)
        bits_word(index[i]);
    return vertices;
}

static void domes(int n) {
    static uint32_t visible[VERTICES];
    for (int i = 0; i < n; ++i) {
        const size_t vertices = build_dome((skv_dome_kind)(i % 3), n);
        skv_frustum frustum = {.forward_enu = {0.0f, 0.8f, 0.0f}, .up_enu = {0.0f, 0.1f, 1.0f}};
        frustum.forward_enu[0] = bits_uniform(-1.0f, 1.0f);
        frustum.forward_enu[2] = bits_uniform(-0.5f, 0.5f);
        frustum.tan_left = bits_uniform(0.1f, 2.0f);
        frustum.tan_right = bits_uniform(0.1f, 2.0f);
        frustum.tan_down = bits_uniform(0.1f, 1.0f);
        frustum.tan_up = bits_uniform(0.1f, 1.0f);
        frustum.margin_rad = bits_uniform(0.0f, 0.2f);
        size_t count = 0;
        bits_word((uint32_t)skv_frustum_select(&frustum, vertices, direction[0], 0, visible, &count));
        for (size_t v = 0; v < count; ++v)
            bits_word(visible[v]);
    }
}

void bits_scene(bits_scale scale) {
    const char *const name = scale == BITS_SMALL ? "small" : "full";
    bits_begin(name, "sun-moon");
    sun_and_moon(scale == BITS_SMALL ? 100 : 5000);
    bits_end();
    bits_begin(name, "dome");
    domes(scale == BITS_SMALL ? 24 : 600);
    bits_end();
}
