/// What is shown as text: the line a second.
#include <math.h>
#include <stdio.h>

#include "cockpit_view.h"

static const char *condition(const cockpit_shown *s) {
    if (!s->running)
        return "waiting";
    if (s->now->held)
        return "held";
    return s->flags & (SKV_VERTICES_POSITION_STALE | SKV_VERTICES_HEIGHT_STALE | SKV_VERTICES_TIME_STALE) ? "stale"
                                                                                                          : "live";
}

static void time_text(const cockpit_now *now, char text[32]) {
    skv_calendar c;
    if (now->has_time && skv_utc_to_calendar(&c, &now->utc) == SKV_OK)
        snprintf(text, 32, "%04d-%02d-%02dT%02d:%02d:%06.3fZ", (int)c.year, (int)c.month, (int)c.day, (int)c.hour,
                 (int)c.minute, floor(1000.0 * (double)c.second) / 1000.0);
    else
        snprintf(text, 32, "-");
}

static uint32_t refused(const skv_cas_receiver *cas) {
    uint32_t sum = 0;
    for (int i = SKV_CAS_FIRST_REFUSED; i <= SKV_CAS_LAST_REFUSED; i++)
        sum += cas->total[i];
    return sum;
}

void cockpit_view_line(const cockpit_shown *s, char *text, size_t size) {
    char utc[32], words[64], stale[200];
    const cockpit_now *const now = s->now;
    const skv_can_counts counts = cockpit_bus_counts(s->bus);
    time_text(now, utc);
    cockpit_state_stale(s->state, stale, sizeof stale);
    snprintf(text, size,
             "%s sun %.3f %.3f utc %s lat %.6f lon %.6f height %.1f visibility %.2f air %.2f offset %.0f lamps %d%d "
             "frames %llu "
             "received %llu "
             "missing %u duplicate %u refused %u dropped %llu bus \"%s\" stale \"%s\"",
             condition(s), now->has_sun ? (double)now->sun.azimuth_deg : 0.0,
             now->has_sun ? (double)now->sun.elevation_deg : 0.0, utc, now->latitude_deg, now->longitude_deg,
             now->height_m, now->visibility_km, s->sky->air[s->sky->current].visibility_km, now->time_offset_s,
             s->panel->night, s->panel->bus, (unsigned long long)s->stats->frames, (unsigned long long)counts.received,
             s->state->cas.total[SKV_CAS_MISSING], s->state->cas.total[SKV_CAS_DUPLICATE], refused(&s->state->cas),
             (unsigned long long)counts.dropped, cockpit_bus_words(s->bus, words, sizeof words), stale);
}
