/// A flight's frames as a candump log: what a receiver on a bus of that bit rate would see.
#include <math.h>
#include <string.h>

#include "port/canaerospace/skv_candump.h"
#include "sim.h"
#include "sim_replay.h"
#include "sim_wire.h"

typedef struct job {
    const sim_options *options;
    sim_flight *flight;             // or
    const sim_recording *recording; // this
    skv_cas_sender sender;
    sim_slot slot[SKV_CAS_MESSAGES];
    int64_t due_ns[SKV_CAS_MESSAGES]; // after the start
    int slots;
    int64_t base_ns, end_ns, free_ns, began_ns, last_ns;
    output out;
    uint64_t frames, left_out;
} job;

/// Moments of a log count from 1970; a flight before that begins at 0.
static int64_t base_of(const sim_flight *f, double start_s) {
    const utc_time first = utc_add(&f->track.fixes[0].utc, start_s);
    const double since_1970_s = 86400.0 * (double)(first.day + 10957);
    return since_1970_s < 0.0 ? 0 : (int64_t)since_1970_s * 1000000000 + (int64_t)llround(first.seconds * 1e6) * 1000;
}

/// The frame that wins the bus when it is free: of those that wait the one with the lowest id (slots rise by id).
static int next_slot(const job *j) {
    int64_t now = INT64_MAX;
    for (int i = 0; i < j->slots; i++)
        now = j->due_ns[i] < now ? j->due_ns[i] : now;
    now = now > j->free_ns ? now : j->free_ns;
    for (int i = 0; i < j->slots; i++)
        if (j->due_ns[i] <= now)
            return i;
    return 0;
}

static int write_line(job *j, const skv_can_frame *frame, int64_t after_ns) {
    skv_candump_entry entry = {.time_ns = j->base_ns + after_ns, .frame = *frame};
    char line[SKV_CANDUMP_LINE];
    memcpy(entry.interface, j->options->interface, strlen(j->options->interface) + 1); // checked: up to 15 letters
    const int length = skv_candump_write(line, sizeof line, &entry);
    j->frames++;
    return length > 0 && fwrite(line, (size_t)length, 1, j->out.stream) == 1 ? 0 : 1;
}

/// A frame that was due at due_ns gets the bus when that is free.
static int put_on_bus(job *j, const skv_can_frame *frame, int64_t due_ns) {
    const double bit_ns = 1e9 / j->options->bitrate;
    const int bits = sim_wire_bits(frame);
    const int64_t from = due_ns > j->free_ns ? due_ns : j->free_ns;
    j->free_ns = from + (int64_t)(bits * bit_ns);
    return write_line(j, frame, from + (int64_t)((bits - SIM_WIRE_GAP_BITS) * bit_ns));
}

/// At --speed N the log grows as time goes by; readers see it up to now. @return whether a signal says stop
static bool pace(job *j, int64_t due_ns) {
    if (j->options->speed <= 0.0)
        return false;
    const int64_t when = j->began_ns + (int64_t)((double)due_ns / j->options->speed);
    if (when > sim_mono_ns())
        fflush(j->out.stream);
    return sim_wait_until(when) != 0; // looks at least: it may be behind all the time
}

static void tell(const job *j, int64_t after_ns) {
    if (j->frames % 256 == 0)
        progress_update((size_t)(after_ns / 1000000000));
}

static int write_flight(job *j) {
    int status = 0;
    for (int i = next_slot(j); status == 0 && j->due_ns[i] <= j->end_ns; i = next_slot(j)) {
        const int64_t due = j->due_ns[i];
        skv_can_frame frame;
        if (pace(j, due))
            break;
        const double after_s = j->options->start_s + 1e-9 * (double)due;
        if (sim_flight_frame(j->flight, &j->sender, j->slot[i].index, after_s, &frame))
            status = put_on_bus(j, &frame, due);
        else
            j->left_out++;
        j->due_ns[i] += j->slot[i].period_ns;
        j->last_ns = due;
        tell(j, due);
    }
    return status;
}

static int write_recording(job *j) {
    const sim_record *r = j->recording->records;
    const int64_t from = (int64_t)(1e9 * j->options->start_s);
    int status = 0;
    for (size_t i = 0; status == 0 && i < j->recording->count && r[i].after_ns <= from + j->end_ns; i++) {
        if (r[i].after_ns < from)
            continue;
        if (pace(j, r[i].after_ns - from))
            break;
        status = write_line(j, &r[i].frame, r[i].after_ns);
        j->last_ns = r[i].after_ns - from;
        tell(j, j->last_ns);
    }
    return status;
}

static int run(job *j) {
    int status = output_open(&j->out, j->options->log);
    if (status != 0)
        return status;
    if (j->options->speed > 0.0)
        sim_hold_signals(); // else Ctrl-C removes the file
    j->began_ns = sim_mono_ns();
    progress_begin("seconds", (size_t)(j->end_ns / 1000000000));
    (void)(j->flight ? write_flight(j) : write_recording(j));
    progress_end();
    status = output_commit(&j->out); // says what went wrong
    if (status != 0)
        return status;
    fprintf(stderr, SIM ": %llu frames of %.1f s written", (unsigned long long)j->frames, 1e-9 * (double)j->last_ns);
    if (j->left_out)
        fprintf(stderr, ", %llu left out: beyond the range of their message", (unsigned long long)j->left_out);
    fputc('\n', stderr);
    return 0;
}

int sim_log_flight(const sim_options *options, sim_flight *f) {
    job j = {.options = options, .flight = f, .sender = {.node = options->node}};
    j.slots = sim_flight_slots(f, options->start_s, j.slot);
    for (int i = 0; i < j.slots; i++)
        j.due_ns[i] = j.slot[i].phase_ns;
    j.base_ns = base_of(f, options->start_s);
    j.end_ns = (int64_t)(1e9 * options->duration_s);
    return run(&j);
}

int sim_log_recording(const sim_options *options, const sim_recording *r) {
    job j = {.options = options, .recording = r, .base_ns = r->first_ns};
    j.end_ns = (int64_t)(1e9 * options->duration_s);
    return run(&j);
}
