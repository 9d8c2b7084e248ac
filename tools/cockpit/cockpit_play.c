/// Logs and the made-up flight, sent over the bus in this process.
#define _POSIX_C_SOURCE 200809L
#include <math.h>
#include <stdlib.h>

#include "cockpit_bus.h"

static const int64_t second = 1000000000;

/// A line that is none: an error, but for a last one without an end, where whoever wrote the log was stopped.
static void bad_line(cockpit_bus *b, bool whole) {
    if (whole)
        b->status = fail_usage("%.200s:%llu: column %d: %s", b->path, (unsigned long long)b->reader.line,
                               b->reader.column, b->reader.reason);
    else
        fail_job("%.200s:%llu: the log ends within this line, which is left out", b->path,
                 (unsigned long long)b->reader.line); // its status is not wanted
}

/// The next frame of the log; at its end, or at a line that is none, the log has ended.
static void read_entry(cockpit_bus *b) {
    ssize_t length;
    while (!b->ended && (length = getline(&b->line, &b->line_size, b->log)) >= 0) {
        const skv_candump_result result = skv_candump_read(&b->reader, b->line, (size_t)length, &b->entry);
        if (result == SKV_CANDUMP_FRAME) {
            if (b->reader.frames == 1)
                b->first_ns = b->entry.time_ns;
            b->has_entry = true;
            const int64_t gap_ns = b->entry.time_ns - b->first_ns - b->next_ns;
            if (gap_ns > 3600 * second)
                fail_job("%.200s:%llu: %.0f s behind the frame before: was the clock set?", b->path,
                         (unsigned long long)b->reader.line, 1e-9 * (double)gap_ns); // its status is not wanted
            return;
        }
        if (result == SKV_CANDUMP_ERROR) {
            bad_line(b, b->line[length - 1] == '\n');
            break;
        }
    }
    b->ended = true;
}

static bool play_log(cockpit_bus *b, int64_t now) {
    if (!b->has_entry)
        read_entry(b);
    if (!b->has_entry || b->entry.time_ns - b->first_ns > now)
        return false;
    const int64_t due = b->entry.time_ns - b->first_ns;
    b->next_ns = due > b->next_ns ? due : b->next_ns; // logs may go backwards
    skv_can_fake_advance(b->net, b->next_ns);
    if (b->entry.frame.flags & SKV_CAN_ERROR)
        skv_can_fake_inject(b->net, &b->entry.frame);
    else
        (void)skv_can_send(b->sender, &b->entry.frame);
    b->has_entry = false;
    return true;
}

static void say(cockpit_bus *b, skv_cas_index index, double value) {
    skv_can_frame frame[2];
    const int n = skv_cas_encode(&b->talker, index, 0, value, frame);
    for (int i = 0; i < n; i++)
        (void)skv_can_send(b->sender, &frame[i]);
}

/// A wide circle over the Alps, through a day that takes 24 minutes: a minute of the sky's time a second.
static void say_position(cockpit_bus *b, double t) {
    const double turn = 2 * 3.14159265358979323846 * t / 360.0;
    say(b, SKV_CAS_TRUE_ALTITUDE, 4500.0 + 3500.0 * sin(2 * turn));
    say(b, SKV_CAS_LATITUDE, 46.5 + 0.3 * sin(turn));
    say(b, SKV_CAS_LONGITUDE, 8.5 + 0.45 * cos(turn));
}

static void say_time(cockpit_bus *b, double t) {
    const double day = 86400.0, from = 5.0 * 3600.0 + 60.0 * t;
    const long of_day = lround(fmod(from, day));
    const uint8_t date[4] = {(uint8_t)(20 + ((int)(from / day)) % 9), 3, 20, 26};
    const uint8_t utc[4] = {(uint8_t)(of_day / 3600 % 24), (uint8_t)(of_day / 60 % 60), (uint8_t)(of_day % 60), 0};
    skv_can_frame frame;
    if (skv_cas_encode_bytes(&b->talker, SKV_CAS_DATE, date, &frame) == 1)
        (void)skv_can_send(b->sender, &frame);
    if (skv_cas_encode_bytes(&b->talker, SKV_CAS_UTC, utc, &frame) == 1)
        (void)skv_can_send(b->sender, &frame);
}

static bool play_flight(cockpit_bus *b, int64_t now) {
    if (b->next_ns > now)
        return false;
    skv_can_fake_advance(b->net, b->next_ns);
    const double t = 1e-9 * (double)b->next_ns;
    say_position(b, t);
    if (b->next_ns % second == 0)
        say_time(b, t);
    b->next_ns += second / 10;
    return true;
}

bool cockpit_bus_play(cockpit_bus *b) {
    if (b->source == COCKPIT_CAN)
        return false;
    const int64_t now = cockpit_bus_now(b);
    if (b->source == COCKPIT_REPLAY ? play_log(b, now) : play_flight(b, now))
        return true;
    if (now > b->next_ns)
        skv_can_fake_advance(b->net, now);
    b->next_ns = now > b->next_ns && b->source == COCKPIT_REPLAY ? now : b->next_ns;
    return false;
}
