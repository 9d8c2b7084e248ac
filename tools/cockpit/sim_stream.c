#include "sim_stream.h"

#include <math.h>
#include <string.h>

#define MS ((int64_t)1000000)
/// Byte of the message code.
#define CODE_BYTE 3
/// A code alone tells how many frames are missing up to here.
#define SURE_PERIODS 128
/// How late a UTC may be.
#define LATE_NS (50 * MS)

void sim_stream_begin(void *stream, int64_t now_ns) {
    sim_stream *const s = stream;
    sim_slot slots[SKV_CAS_MESSAGES];
    s->beats = sim_flight_slots(s->flight, s->options->start_s, slots);
    s->start_ns = now_ns;
    s->generation = s->bus->generation;
    for (int i = 0; i < s->beats; i++)
        s->beat[i] = (sim_beat){.slot = slots[i], .expect_ns = now_ns + slots[i].phase_ns};
}

/// Seconds into the flight at a moment.
static double after_s(const sim_stream *s, int64_t mono_ns) {
    const double into_s = 1e-9 * (double)(mono_ns - s->start_ns) * s->options->speed;
    const double lap_s = s->options->duration_s;
    return s->options->start_s + (s->options->loop && lap_s > 0.0 ? fmod(into_s, lap_s) : into_s);
}

static bool fill(sim_stream *s, const sim_beat *beat, skv_can_frame *frame) {
    return sim_flight_frame(s->flight, &s->sender, beat->slot.index, after_s(s, beat->expect_ns), frame) == 1;
}

/// The first frame goes out at once.
static void start(sim_stream *s, sim_beat *beat, int64_t now_ns) {
    skv_can_cyclic cyclic = {.period_us = (uint32_t)(beat->slot.period_ns / 1000), .counter_byte = CODE_BYTE};
    beat->expect_ns = now_ns;
    const bool known = fill(s, beat, &cyclic.frame);
    cyclic.frame.data[CODE_BYTE] = beat->code;
    const skv_can_status status = known ? skv_can_cyclic_start(s->bus->bus, &cyclic) : SKV_CAN_OK;
    s->left_out += !known;
    beat->started = known && status == SKV_CAN_OK;
    if (beat->heard_ns == 0) // as if it had been heard one period ago
        beat->heard_ns = now_ns - beat->slot.period_ns;
    sim_bus_say_why(s->bus, status);
    if (status == SKV_CAN_UNAVAILABLE)
        s->failed = status;
    if (status != SKV_CAN_OK)
        beat->expect_ns = now_ns + 10 * MS;
    else
        beat->expect_ns = now_ns + beat->slot.period_ns;
}

/// What its next frame holds. What cannot be said is not sent: old values would look new.
static void refill(sim_stream *s, sim_beat *beat) {
    skv_can_frame frame;
    if (fill(s, beat, &frame)) {
        (void)skv_can_cyclic_update(s->bus->bus, &frame); // should it not work: once more at the next beat
        return;
    }
    s->left_out++;
    (void)skv_can_cyclic_stop(s->bus->bus, skv_cas_table[beat->slot.index].id, 0);
    beat->started = false;
}

/// UTC has whole seconds: sent late it is wrong by as much, and the kernel's clockwork begins when it is told to and
/// falls behind by its delays. Then it is begun anew when its second changes. @return whether it was
static bool on_the_second(sim_stream *s, sim_beat *beat, int64_t mono_ns) {
    const int64_t late_ns = (mono_ns - s->start_ns - beat->slot.phase_ns) % beat->slot.period_ns;
    if (beat->slot.index != SKV_CAS_UTC || late_ns < LATE_NS)
        return false;
    (void)skv_can_cyclic_stop(s->bus->bus, skv_cas_table[beat->slot.index].id, 0);
    beat->started = false;
    beat->expect_ns = mono_ns + beat->slot.period_ns - late_ns;
    return true;
}

/// A frame that did not come within half a period: nothing is heard while the bus does not work.
static void skip(sim_stream *s, sim_beat *beat, int64_t now_ns) {
    while (beat->expect_ns + beat->slot.period_ns / 2 <= now_ns)
        beat->expect_ns += beat->slot.period_ns;
    refill(s, beat);
}

/// The interface was opened anew: all begins again, in the old order.
static void start_over(sim_stream *s, int64_t now_ns) {
    s->generation = s->bus->generation;
    for (int i = 0; i < s->beats; i++) {
        s->beat[i].started = false;
        s->beat[i].expect_ns = now_ns + s->beat[i].slot.phase_ns;
    }
}

static int64_t beat_tick(sim_stream *s, sim_beat *beat, int64_t now_ns) {
    if (beat->started) {
        if (beat->expect_ns + beat->slot.period_ns / 2 <= now_ns)
            skip(s, beat, now_ns);
        return beat->expect_ns + beat->slot.period_ns / 2;
    }
    if (beat->expect_ns <= now_ns)
        start(s, beat, now_ns);
    return beat->started ? beat->expect_ns + beat->slot.period_ns / 2 : beat->expect_ns;
}

/// Whole periods since it was last heard, less this one: lost.
static uint64_t missing(const sim_beat *beat, int64_t to_ns) {
    const int64_t periods = (to_ns - beat->heard_ns + beat->slot.period_ns / 2) / beat->slot.period_ns;
    return periods > 1 ? (uint64_t)periods - 1 : 0;
}

void sim_stream_end(sim_stream *s, int64_t now_ns) {
    for (int i = 0; i < s->beats && !s->over; i++)
        if (s->beat[i].started)
            s->lost += missing(&s->beat[i], now_ns);
    s->over = true;
}

int64_t sim_stream_tick(void *stream, int64_t now_ns) {
    sim_stream *const s = stream;
    const double run_s = 1e-9 * (double)(now_ns - s->start_ns) * s->options->speed;
    s->shown_s = after_s(s, now_ns);
    if (!s->over && !s->options->loop && run_s > s->options->duration_s)
        sim_stream_end(s, now_ns);
    if (s->over || s->failed != SKV_CAN_OK)
        return 0;
    if (!s->bus->bus)
        return now_ns + 500 * MS;
    if (s->generation != s->bus->generation)
        start_over(s, now_ns);
    int64_t next = INT64_MAX;
    for (int i = 0; i < s->beats; i++) {
        const int64_t due = beat_tick(s, &s->beat[i], now_ns);
        next = due < next ? due : next;
    }
    if (s->options->loop)
        return next;
    const int64_t end_ns = s->start_ns + (int64_t)(1e9 * s->options->duration_s / s->options->speed) + MS;
    return next < end_ns ? next : end_ns;
}

static sim_beat *find(sim_stream *s, const skv_can_frame *frame) {
    for (int i = 0; i < s->beats; i++)
        if (skv_cas_table[s->beat[i].slot.index].id == frame->id && !frame->flags)
            return &s->beat[i];
    return NULL;
}

void sim_stream_heard(void *stream, const skv_can_received *received, int64_t mono_ns, int64_t now_ns) {
    sim_stream *const s = stream;
    const skv_can_frame *frame = &received->frame;
    sim_beat *const beat = find(s, frame);
    if (!beat)
        return;
    if (frame->data[0] != s->sender.node || beat->heard_ns == 0) {
        s->others += frame->data[0] != s->sender.node;
        return;
    }
    const bool sure = mono_ns - beat->heard_ns < SURE_PERIODS * beat->slot.period_ns;
    s->lost += sure ? (uint8_t)(frame->data[CODE_BYTE] - beat->code) : missing(beat, mono_ns);
    s->sent++;
    beat->heard_ns = mono_ns;
    beat->code = (uint8_t)(frame->data[CODE_BYTE] + 1);
    if (!beat->started) // stopped while this one was on its way: its code has been used all the same
        return;
    beat->expect_ns = mono_ns + beat->slot.period_ns;
    if (on_the_second(s, beat, mono_ns))
        return;
    if (beat->expect_ns > now_ns) // else this one is old, and the next is about to be read
        refill(s, beat);
}

void sim_stream_show(const void *stream, char *text, size_t size) {
    const sim_stream *const s = stream;
    char utc[UTC_TEXT_SIZE];
    size_t hint = 0;
    const fix at = flight_at(&s->flight->track, s->shown_s, &hint);
    const utc_time now = {at.utc.day, floor(at.utc.seconds)};
    snprintf(text, size, "%s  %.4f %.4f  %.0f m  %llu frames, %llu lost", utc_text(&now, utc), at.lat_deg, at.lon_deg,
             at.height_m, (unsigned long long)s->sent, (unsigned long long)s->lost);
}
