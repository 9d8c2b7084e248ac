/// skyvert-sim: sends a flight on a CAN bus, or writes the frames as a candump log.
#include <string.h>

#include "port/socketcan/skv_socketcan.h"
#include "sim.h"
#include "sim_player.h"
#include "sim_run.h"
#include "sim_stream.h"

/// Room for the frames of a second of a full bus, should this program be held up.
#define RECEIVE_BYTES 4000000
#define REVISION      1

typedef struct opener {
    const char *interface;
    skv_can_options options;
    skv_can_filter filters[SKV_CAS_MESSAGES + 1];
} opener;

static skv_can_status open_interface(void *context, skv_can_bus **bus) {
    const opener *const o = context;
    return skv_socketcan_open(bus, o->interface, &o->options, NULL);
}

/// Own messages come back from the bus, and that is how they are known to have been sent.
static void listen_to(opener *o, bool replay) {
    o->options = (skv_can_options){.filters = o->filters,
                                   .n_filters = SKV_CAS_MESSAGES + 1,
                                   .receive_all = replay,
                                   .receive_own = replay,
                                   .receive_errors = 1,
                                   .receive_bytes = RECEIVE_BYTES};
    for (int i = 0; i < SKV_CAS_MESSAGES; i++)
        o->filters[i] = (skv_can_filter){skv_cas_table[i].id, 0x7FF, 0};
    o->filters[SKV_CAS_MESSAGES] = (skv_can_filter){SKV_CAS_ID_REQUEST, 0x7FF, 0};
}

static int cannot_open(const sim_options *options, skv_can_status status) {
    if (status == SKV_CAN_UNAVAILABLE) {
        fail_job(SIM ": %s; --log FILE needs none", skv_can_status_text(status));
        return EXIT_NO_CAN;
    }
    return (status == SKV_CAN_NO_INTERFACE ? fail_usage : fail_job)(SIM ": --interface %s: %s", options->interface,
                                                                    skv_can_status_text(status));
}

static int check_load(const sim_options *options, double bits_per_s) {
    const double load = bits_per_s / options->bitrate;
    if (load <= options->max_load)
        return 0;
    return fail_usage(SIM ": %.100s takes up to %.1f %% of a bus of %.0f bit/s; --max-load allows %.0f %%",
                      options->input, 100.0 * load, options->bitrate, 100.0 * options->max_load);
}

static void summary(const sim_bus *bus, double ran_s, uint64_t sent, uint64_t lost, const char *lost_name) {
    fprintf(stderr,
            SIM
            ": %llu frames sent in %.1f s, %llu %s, %llu waits, interface %llu times down, %llu bus-off, %llu gone, "
            "%llu recoveries, %llu identification requests answered\n",
            (unsigned long long)sent, ran_s, (unsigned long long)lost, lost_name, (unsigned long long)bus->waits,
            (unsigned long long)bus->downs, (unsigned long long)bus->bus_offs, (unsigned long long)bus->gone,
            (unsigned long long)bus->recoveries, (unsigned long long)bus->answers);
}

/// Opens the interface, whose bit rate decides where none was given. @return 0, or the exit status
static int begin(sim_options *options, sim_bus *bus, opener *o, double bits_per_s) {
    *bus = (sim_bus){
        .open = open_interface, .context = o, .name = options->interface, .self = {options->node, REVISION, REVISION}};
    const skv_can_status opened = sim_bus_begin(bus, sim_mono_ns());
    if (opened != SKV_CAN_OK)
        return cannot_open(options, opened);
    if (options->bitrate <= 0.0)
        options->bitrate = bus->state.bitrate ? (double)bus->state.bitrate : SIM_LOG_BITRATE;
    bus->most_bits_s = bits_per_s / options->max_load;
    const int status = check_load(options, bits_per_s);
    if (status != 0)
        sim_bus_end(bus);
    return status;
}

static int stream(sim_options *options, sim_flight *f, double bits_per_s) {
    opener o = {.interface = options->interface};
    sim_bus bus;
    listen_to(&o, false);
    int status = begin(options, &bus, &o, bits_per_s);
    if (status != 0)
        return status;
    sim_stream s = {.options = options, .flight = f, .bus = &bus, .sender = {.node = options->node}};
    const sim_task task = {&s, sim_stream_begin, sim_stream_tick, sim_stream_heard, sim_stream_show};
    status = sim_run(&bus, &task);
    sim_stream_end(&s, sim_mono_ns());
    sim_bus_end(&bus);
    if (s.failed != SKV_CAN_OK)
        return cannot_open(options, s.failed);
    summary(&bus, 1e-9 * (double)(sim_mono_ns() - s.start_ns), s.sent, s.lost, "lost");
    if (s.others)
        fprintf(stderr, SIM ": %llu frames of these messages came from another node\n", (unsigned long long)s.others);
    return status;
}

static int run_flight(sim_options *options) {
    sim_flight f;
    sim_slot slots[SKV_CAS_MESSAGES];
    int status = sim_flight_open(&f, options->input, &options->flight);
    if (status != 0)
        return status;
    const double bits_per_s = sim_slots_load(slots, sim_flight_slots(&f, 0.0, slots), 1.0);
    status = sim_options_settle(options, f.duration_s, &f.track.fixes[0].utc);
    if (status == 0 && options->log)
        status = check_load(options, bits_per_s);
    if (status == 0)
        status = options->log ? sim_log_flight(options, &f) : stream(options, &f, bits_per_s);
    sim_flight_close(&f);
    return status;
}

static int play(sim_options *options, const sim_recording *r) {
    opener o = {.interface = options->interface};
    sim_bus bus;
    listen_to(&o, true);
    int status = begin(options, &bus, &o, r->most_bits_second * options->speed);
    if (status != 0)
        return status;
    sim_player p = {.options = options, .recording = r, .bus = &bus};
    const sim_task task = {&p, sim_player_begin, sim_player_tick, sim_player_heard, sim_player_show};
    const int64_t began_ns = sim_mono_ns();
    status = sim_run(&bus, &task);
    sim_bus_end(&bus);
    summary(&bus, 1e-9 * (double)(sim_mono_ns() - began_ns), bus.frames - bus.answers,
            bus.frames > p.heard ? bus.frames - p.heard : 0, "not heard back");
    return status;
}

static int run_recording(sim_options *options) {
    sim_recording r;
    int status = sim_recording_read(&r, options->input);
    if (status != 0)
        return status;
    if (r.skipped || r.backwards)
        fprintf(stderr,
                SIM ": %.200s: %llu CAN FD and error frames left out, %llu frames earlier than the one before\n",
                options->input, (unsigned long long)r.skipped, (unsigned long long)r.backwards);
    status = sim_options_settle(options, 1e-9 * (double)r.records[r.count - 1].after_ns, NULL);
    if (status == 0 && options->log)
        status = check_load(options, r.most_bits_second);
    if (status == 0)
        status = options->log ? sim_log_recording(options, &r) : play(options, &r);
    sim_recording_free(&r);
    return status;
}

int main(int argc, char **argv) {
    sim_options options;
    bool candump = false;
    int status = 0;
    const int read = sim_options_read(&options, argc, argv, &status);
    if (read != 0)
        return read == 1 ? status : read;
    if (options.log && options.bitrate <= 0.0)
        options.bitrate = SIM_LOG_BITRATE;
    status = sim_is_candump(options.input, &candump);
    if (status != 0)
        return status;
    return candump ? run_recording(&options) : run_flight(&options);
}
