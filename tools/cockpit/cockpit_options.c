#include <getopt.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "cockpit.h"

// clang-format off
static const char help[] =
    "usage: skyvert-cockpit [options]\n"
    "Colours the sky of a cockpit from a CAN bus (CANaerospace): position, height and time, or the sun's place.\n"
    "  --interface IF     CAN interface (default can0)\n"
    "  --config FILE      switches, lamps, air: tools/cockpit/cockpit.ini shows all of it\n"
    "  --rate HZ          frames a second, 1 to 240 (default 60)\n"
    "  --vertices N       of the dome, 64 to 65536 (default 2048)\n"
    "  --shm NAME         publish vertices in the shared memory NAME (tools/cockpit/vertices.h)\n"
    "  --png FILE, --exr FILE   where to write a snapshot on SIGUSR1: the whole sky, north in the centre, east right of it\n"
    "  --replay LOG       a log of candump instead of a bus\n"
    "  --fake             a made-up flight instead of a bus\n"
    "  --speed N          log or made-up flight N times as fast, 0.01 to 1000 (default 1)\n"
    "  --duration S       end after S seconds\n"
    "  --stats FILE       figures at the end: frames, latency, processor time, memory\n"
    "  --no-terminal      a line a second instead of the picture, also on a terminal\n"
    "  --terminal         the picture also where there is no terminal (80 x 24)\n"
    "  --help, --version\n"
    "SIGINT or SIGTERM ends it. Exit status: 0 ended as told, 1 failed, 2 bad input, 3 no CAN in this kernel.\n";
// clang-format on

enum {
    INTERFACE = 1,
    CONFIG,
    RATE,
    VERTICES,
    SHM,
    PNG,
    EXR,
    REPLAY,
    SPEED,
    FAKE,
    DURATION,
    STATS,
    NO_TERMINAL,
    TERMINAL,
    HELP,
    VERSION
};

static const struct option longs[] = {{"interface", required_argument, NULL, INTERFACE},
                                      {"config", required_argument, NULL, CONFIG},
                                      {"rate", required_argument, NULL, RATE},
                                      {"vertices", required_argument, NULL, VERTICES},
                                      {"shm", required_argument, NULL, SHM},
                                      {"png", required_argument, NULL, PNG},
                                      {"exr", required_argument, NULL, EXR},
                                      {"replay", required_argument, NULL, REPLAY},
                                      {"speed", required_argument, NULL, SPEED},
                                      {"fake", no_argument, NULL, FAKE},
                                      {"duration", required_argument, NULL, DURATION},
                                      {"stats", required_argument, NULL, STATS},
                                      {"no-terminal", no_argument, NULL, NO_TERMINAL},
                                      {"help", no_argument, NULL, HELP},
                                      {"version", no_argument, NULL, VERSION},
                                      {"terminal", no_argument, NULL, TERMINAL},
                                      {NULL, 0, NULL, 0}};

static void defaults(cockpit_options *o) {
    memset(o, 0, sizeof *o);
    strcpy(o->interface, "can0");
    o->node = 20;
    o->terminal = isatty(STDOUT_FILENO) == 1;
    o->rate = 60.0;
    o->vertices = 2048;
    o->preset = SKV_PRESET_EARTH_CLEAR;
    o->bands = 4;
    o->tier = SKV_TIER_STANDARD;
    o->visibility_km = 60.0;
    o->minutes_per_click = 10.0;
    o->visibility_per_click = 1.25;
    o->night_below_deg = -0.833; // the upper edge of the refracted sun on the horizon
    o->night_width_deg = 1.0;
    skv_gpio_defaults(&o->gpio);
}

static int take_interface(cockpit_options *o, const char *text) {
    if (text[0] == '\0' || strlen(text) >= sizeof o->interface || strchr(text, '/'))
        return fail_usage(COCKPIT ": --interface %.40s: allowed is a name of 1 to 15 characters, as `ip link` shows it",
                          text);
    strcpy(o->interface, text);
    return 0;
}

static int number(const char *option, double low, double high, double *value) {
    return common_number(COCKPIT, option, optarg, low, high, value);
}

static int take(cockpit_options *o, int option) {
    switch (option) {
    case INTERFACE:
        return take_interface(o, optarg);
    case RATE:
        return number("--rate", 1, 240, &o->rate);
    case VERTICES:
        return common_integer(COCKPIT, "--vertices", optarg, 64, 65536, &o->vertices);
    case SHM:
        o->shm = optarg;
        return 0;
    case PNG:
        o->png = optarg;
        return 0;
    case EXR:
        o->exr = optarg;
        return 0;
    case REPLAY:
        o->replay = optarg;
        return 0;
    case SPEED:
        return number("--speed", 0.01, 1000, &o->speed);
    case FAKE:
        o->fake = true;
        return 0;
    case DURATION:
        return number("--duration", 0.01, 1e9, &o->duration_s);
    case STATS:
        o->stats = optarg;
        return 0;
    case NO_TERMINAL:
    case TERMINAL:
        o->terminal = option == TERMINAL;
        return 0;
    default:
        return -1;
    }
}

/// The file first, wherever it is named: options count more. @return 0 or 2, 1
static int read_config_first(cockpit_options *o, int argc, char **argv) {
    int got, status = 0;
    opterr = 0;
    optind = 1;
    while (status == 0 && (got = getopt_long(argc, argv, ":", longs, NULL)) != -1)
        if (got == CONFIG)
            status = cockpit_config_read(o, optarg);
    optind = 1;
    return status;
}

static int check(cockpit_options *o, int argc, char **argv) {
    if (optind < argc)
        return fail_usage(COCKPIT ": %.60s: there are only options (%s --help)", argv[optind], COCKPIT);
    if (o->speed > 0 && !o->replay && !o->fake)
        return fail_usage(COCKPIT ": --speed goes with --replay or --fake: a bus has its own pace");
    o->speed = o->speed > 0 ? o->speed : 1.0;
    if (o->replay && o->fake)
        return fail_usage(COCKPIT ": --replay or --fake, not both");
    return 0;
}

int cockpit_options_read(cockpit_options *o, int argc, char **argv, int *status) {
    defaults(o);
    int got, result = read_config_first(o, argc, argv);
    while (result == 0 && (got = getopt_long(argc, argv, ":", longs, NULL)) != -1) {
        if (got == HELP || got == VERSION) {
            if (got == HELP)
                fputs(help, stdout);
            *status = got == HELP ? output_finish_stdout() : common_version(COCKPIT);
            return 1;
        }
        if (got == '?' || got == ':')
            result = common_unknown(COCKPIT, got, argv);
        else if (got != CONFIG)
            result = take(o, got);
    }
    result = result ? result : check(o, argc, argv);
    if (result) {
        *status = result;
        return 1;
    }
    return 0;
}
