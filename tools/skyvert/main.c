/// The command `skyvert`: finds the subcommand.
#include <fcntl.h>
#include <getopt.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

#include "command.h"

typedef struct subcommand {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *purpose;
} subcommand;

static const subcommand subcommands[] = {
    {"eval", cmd_eval, "spectral radiance for a list of altitudes and directions (CSV in, CSV out)"},
    {"sun", cmd_sun, "directions of sun and moon for a place and a moment"},
    {"render", cmd_render, "a picture of the sky (EXR or PNG)"},
    {"track", cmd_track, "the skies along a recorded flight (EXR each, a contact sheet, a CSV)"},
    {"dome", cmd_dome, "a sky dome as a mesh with vertex colours (PLY)"},
    {"trade", cmd_trade, "error and cost of every configuration and of other models: tables and pictures"},
    {"bake", cmd_bake, "tables for engines (sky-view, scattering, ...), a model as C"},
    {"plan", cmd_plan, "the cheapest configuration that is good enough for a scene, and its skv_config.h"},
};

static int print_help(void) {
    printf("usage: skyvert COMMAND [OPTION...]\n"
           "       skyvert COMMAND --help\n\n"
           "Sky radiance for flight simulators.\n\n");
    for (size_t i = 0; i < sizeof subcommands / sizeof subcommands[0]; i++)
        printf("  %-8s %s\n", subcommands[i].name, subcommands[i].purpose);
    printf("\n  -h, --help     this text\n  -V, --version  the version\n\n"
           "Exit status: 0 done, 1 the job failed (disk full, a package this build lacks), 2 bad input.\n");
    return output_finish_stdout();
}

static int run_subcommand(int argc, char **argv) {
    for (size_t i = 0; i < sizeof subcommands / sizeof subcommands[0]; i++)
        if (strcmp(argv[0], subcommands[i].name) == 0) {
            optind = 0; // starts getopt_long() anew
            return subcommands[i].run(argc, argv);
        }
    return fail_usage(
        "skyvert: unknown command '%s': eval, sun, render, track, dome, trade, plan or bake (skyvert --help)", argv[0]);
}

/// A standard stream that is closed would lend its number to the next file that is opened: hold it with one that fails.
static void hold_standard_streams(void) {
    for (int fd = 0; fd < 3; fd++)
        if (fcntl(fd, F_GETFD) < 0 && open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY) < 0)
            return;
}

int main(int argc, char **argv) {
    static const struct option options[] = {
        {"help", no_argument, NULL, 'h'}, {"version", no_argument, NULL, 'V'}, {NULL, 0, NULL, 0}};
    hold_standard_streams();
    signal(SIGPIPE, SIG_IGN); // a closed pipe is an error of a write: one line, status 1
    opterr = 0;
    // "+": stop at the subcommand, whose options are its own.
    for (int c; (c = getopt_long(argc, argv, "+:hV", options, NULL)) != -1;) {
        if (c == 'h')
            return print_help();
        if (c == 'V')
            return option_version();
        return option_unknown("skyvert", c, argv);
    }
    if (optind >= argc)
        return fail_usage(
            "skyvert: no command given: eval, sun, render, track, dome, trade, plan or bake (skyvert --help)");
    const int first = optind;
    return run_subcommand(argc - first, argv + first);
}
