/// Prints the moon at 2,000 places and times for moon_ephem.py: day, seconds, latitude, longitude, height (km),
/// direction east, north, up.
#include <stdint.h>
#include <stdio.h>

#include "skyvert/sun.h"

static uint32_t state = 1;

static float uniform(float low, float high) {
    state = state * 1664525u + 1013904223u;
    return low + (high - low) * (float)(state >> 8) * 0x1p-24f;
}

int main(void) {
    for (int i = 0; i < 2000; i++) {
        const skv_utc utc = {7305 + (int32_t)uniform(0.0f, 11323.0f), uniform(0.0f, 86390.0f)};
        const skv_position p = {uniform(-90.0f, 90.0f), uniform(-180.0f, 180.0f), uniform(-0.4f, 12.0f)};
        skv_moon m;
        if (skv_moon_at(&m, &utc, &p) != SKV_OK)
            return 1;
        printf("%d %.9g %.9g %.9g %.9g %.9g %.9g %.9g\n", (int)utc.day, (double)utc.seconds, (double)p.lat_deg,
               (double)p.lon_deg, (double)p.height_km, (double)m.direction_enu[0], (double)m.direction_enu[1],
               (double)m.direction_enu[2]);
    }
    return 0;
}
