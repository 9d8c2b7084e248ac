/// The command line of skyvert-sim.
#include <getopt.h>
#include <string.h>

#include "sim.h"
#include "tools/skyvert/place.h"

// clang-format off
static const char help[] =
    "usage: skyvert-sim FLIGHT [--interface can0] [OPTION...]\n"
    "       skyvert-sim FLIGHT --log FILE --speed N|max [OPTION...]\n\n"
    "Sends a flight on a CAN bus as CANaerospace messages: position, height, motion and attitude every 100 ms; time,\n"
    "date, sun, moon, air and visibility every second. Or writes these frames as a candump log, which needs no CAN.\n"
    "Tracks have no attitude: pitch is the angle of the flight path, roll that of a coordinated turn without wind.\n"
    "FLIGHT is a CSV file (columns utc,lat_deg,lon_deg,height_m), an IGC file (name ends in .igc), or a candump log\n"
    "to send as it is, at its own pace.\n\n"
    "  --interface NAME       of the bus (default can0); with --log the name in the log\n"
    "  --log FILE             write a candump log instead (- is the standard output); its times begin at the UTC of\n"
    "                         the flight, or at 0 before 1970, and are those at which the frames end on the bus\n"
    "  --speed N|max          on a bus: the flight goes N times as fast, frames as often as ever; a candump log is\n"
    "                         replayed N times as fast (default 1). With --log: how fast the log is written, whose\n"
    "                         times stay the flight's (default max, as fast as can be). 0.01 to 1000\n"
    "  --start T              begin T seconds into the flight, or at a UTC such as 2024-03-20T17:30:00Z\n"
    "  --duration S           only S seconds of it; behind its end the aircraft stands there and time goes on\n"
    "  --loop                 begin again at the end\n"
    "  --bitrate B            of the bus, 5000 to 1000000 bit/s, to reckon with (default: the interface's; 500000 for\n"
    "                         a log and where the interface has none)\n"
    "  --max-load P           refuse to take more than P % of the bus (default 80; 1 to 100)\n"
    "  --node N               this node's id, 1 to 255 (default 1)\n"
    "  --visibility-m M       the visibility that is sent, 1 to 1000000 (default 40000)\n"
    "  --height-datum msl|ellipsoid  what a CSV's height_m is above (default msl, the sea)\n"
    "  --igc-altitude gnss|pressure  the altitude of an IGC file that counts (default gnss)\n"
    "  --help, --version\n\n"
    "Ctrl-C ends it with a line that says what was sent. Exit status: 0 done, 1 the job failed, 2 bad input, 3 this\n"
    "kernel has no CAN.\n";
// clang-format on

enum {
    OPT_INTERFACE = 1000,
    OPT_LOG,
    OPT_SPEED,
    OPT_START,
    OPT_DURATION,
    OPT_LOOP,
    OPT_BITRATE,
    OPT_MAX_LOAD,
    OPT_NODE,
    OPT_VISIBILITY,
    OPT_DATUM,
    OPT_ALTITUDE,
    OPT_HELP,
    OPT_VERSION
};

static const struct option long_options[] = {{"interface", required_argument, NULL, OPT_INTERFACE},
                                             {"log", required_argument, NULL, OPT_LOG},
                                             {"speed", required_argument, NULL, OPT_SPEED},
                                             {"start", required_argument, NULL, OPT_START},
                                             {"duration", required_argument, NULL, OPT_DURATION},
                                             {"loop", no_argument, NULL, OPT_LOOP},
                                             {"bitrate", required_argument, NULL, OPT_BITRATE},
                                             {"max-load", required_argument, NULL, OPT_MAX_LOAD},
                                             {"node", required_argument, NULL, OPT_NODE},
                                             {"visibility-m", required_argument, NULL, OPT_VISIBILITY},
                                             {"height-datum", required_argument, NULL, OPT_DATUM},
                                             {"igc-altitude", required_argument, NULL, OPT_ALTITUDE},
                                             {"help", no_argument, NULL, OPT_HELP},
                                             {"version", no_argument, NULL, OPT_VERSION},
                                             {NULL, 0, NULL, 0}};

static int take_interface(sim_options *options, const char *text) {
    const size_t n = strlen(text);
    if (n < 1 || n > 15 || strcspn(text, " \t\r\n/") != n)
        return fail_usage(SIM ": --interface '%.60s': a name of 1 to 15 letters, such as can0", text);
    options->interface = text;
    return 0;
}

static int take_speed(sim_options *options, const char *text) {
    if (strcmp(text, "max") != 0 && (!parse_number(text, &options->speed) || options->speed < 0.01 || //
                                     options->speed > 1000.0))
        return fail_usage(SIM ": --speed %.60s: allowed is a number from 0.01 to 1000, or max", text);
    if (strcmp(text, "max") == 0)
        options->speed = 0.0;
    return 0;
}

static int take_choice(const char *option, const char *text, const char *const names[], int *index) {
    return common_choice(SIM, option, text, names, index);
}

static int take(sim_options *options, int c, char **argv) {
    static const char *const altitudes[] = {"gnss", "pressure", NULL};
    int index = 0, status = 0;
    switch (c) {
    case OPT_INTERFACE:
        return take_interface(options, optarg);
    case OPT_LOG:
        options->log = optarg;
        return 0;
    case OPT_SPEED:
        return take_speed(options, optarg);
    case OPT_START:
        options->start = optarg;
        return 0;
    case OPT_DURATION:
        return common_number(SIM, "--duration", optarg, 0.0, 1e7, &options->duration_s);
    case OPT_LOOP:
        options->loop = true;
        return 0;
    case OPT_BITRATE:
        return common_number(SIM, "--bitrate", optarg, 5000.0, 1e6, &options->bitrate);
    case OPT_MAX_LOAD:
        status = common_number(SIM, "--max-load", optarg, 1.0, 100.0, &options->max_load);
        options->max_load /= 100.0;
        return status;
    case OPT_NODE:
        status = common_integer(SIM, "--node", optarg, 1, 255, &index);
        options->node = (uint8_t)index;
        return status;
    case OPT_VISIBILITY:
        return common_number(SIM, "--visibility-m", optarg, 1.0, 1e6, &options->flight.visibility_m);
    case OPT_DATUM:
        status = take_choice("--height-datum", optarg, height_datum_names, &index);
        options->flight.ellipsoid = index == HEIGHT_ELLIPSOID;
        return status;
    case OPT_ALTITUDE:
        status = take_choice("--igc-altitude", optarg, altitudes, &index);
        options->flight.altitude = index == 0 ? IGC_GNSS : IGC_PRESSURE;
        return status;
    default:
        return common_unknown(SIM, c, argv);
    }
}

static int print_help(void) {
    fputs(help, stdout);
    return output_finish_stdout();
}

static int check(sim_options *options, int argc, char **argv) {
    if (optind >= argc)
        return fail_usage(SIM ": which flight? skyvert-sim FLIGHT (skyvert-sim --help)");
    if (optind + 1 < argc)
        return fail_usage(SIM ": unexpected argument '%.60s' (skyvert-sim --help)", argv[optind + 1]);
    options->input = argv[optind];
    if (options->speed < 0.0)
        options->speed = options->log ? 0.0 : 1.0;
    if (options->log && options->loop)
        return fail_usage(SIM ": --loop goes with a bus, not with --log");
    if (!options->log && options->speed <= 0.0)
        return fail_usage(SIM ": --speed max goes with --log");
    return 0;
}

int sim_options_read(sim_options *options, int argc, char **argv, int *status) {
    *options = (sim_options){.interface = "can0",
                             .speed = -1.0,
                             .duration_s = -1.0,
                             .max_load = 0.8,
                             .node = 1,
                             .flight = {.visibility_m = 40000.0}};
    opterr = 0;
    for (int c; (c = getopt_long(argc, argv, ":", long_options, NULL)) != -1;) {
        if (c == OPT_HELP || c == OPT_VERSION) {
            *status = c == OPT_HELP ? print_help() : common_version(SIM);
            return 1;
        }
        if (take(options, c, argv) != 0)
            return 2;
    }
    return check(options, argc, argv);
}

static int settle_start(sim_options *options, double input_s, const utc_time *first) {
    utc_time utc;
    if (!options->start)
        return 0;
    if (!parse_number(options->start, &options->start_s)) {
        const char *problem = utc_parse(options->start, &utc);
        if (problem || !first)
            return fail_usage(SIM ": --start '%.60s': %s", options->start,
                              first ? problem : "of a candump log: seconds from its beginning");
        options->start_s = utc_difference(&utc, first);
    }
    if (options->start_s < 0.0 || options->start_s > input_s)
        return fail_usage(SIM ": --start %.60s: %.1f s into it, which lasts %.1f s", options->start, options->start_s,
                          input_s);
    return 0;
}

int sim_options_settle(sim_options *options, double input_s, const utc_time *first) {
    const int status = settle_start(options, input_s, first);
    if (status == 0 && options->duration_s < 0.0)
        options->duration_s = input_s - options->start_s;
    return status;
}
