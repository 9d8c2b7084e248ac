/// `skyvert trade`: what speed costs in accuracy, configuration by configuration.
#define _XOPEN_SOURCE 700 // readlink

#include <errno.h>
#include <getopt.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "command.h"

#if SKV_HAVE_INIH
#include "tools/trade/trade.h"
#include "trade_study.h"

static const char help[] =
    "usage: skyvert trade [OPTION...]\n\n"
    "Error against the reference, time, instructions, table bytes, build time and stack of every configuration\n"
    "of the core and of the published models beside it: a table on the standard output, and files in the folder\n"
    "of results: trade.txt, trade.csv (every number), frontier.csv, worst.txt (inputs for skyvert eval), and the\n"
    "pictures pareto, pareto-single and pareto-full (SVG, PNG; made by gnuplot).\n\n"
    "  --out DIR        folder of the results (out/trade)\n"
    "  --root DIR       the project's folder: atmosphere files and truth are read from DIR/tools (.)\n"
    "  --quick          a small subset: some seconds\n"
    "  --study ablation|dome|day\n"
    "                   instead of all that: what each term is worth; how a dome interpolates between its vertices;\n"
    "                   a whole day by the minute (NAME.txt, NAME.csv and pictures in the folder of results)\n"
    "  --threads N      for building tables of other models, 1 to 64 (as many as there are processors)\n"
    "  --instructions yes|no\n"
    "                   count instructions, by valgrind when there is one (yes)\n"
    "  -h, --help       this text\n"
    "  -V, --version    the version\n\n"
    "A run that is stopped (Ctrl-C) keeps what it finished in DIR/trade.state; the same command goes on from there. "
    "Rows\n"
    "are measured anew when program, configuration or truth changed. Times are processor time; on a busy machine the\n"
    "spread grows. Build with ARCH=-mavx2 for figures of a desktop (make trade does).\n\n"
    "Exit status: 0 done, 1 the job failed, 2 bad input.\n";

typedef struct settings {
    const char *out, *root, *count_rows;
    const char *study; ///< NULL: none
    int threads, instructions;
    bool quick;
} settings;

static const struct option options[] = {{"out", required_argument, NULL, 'o'},
                                        {"root", required_argument, NULL, 'r'},
                                        {"quick", no_argument, NULL, 'q'},
                                        {"study", required_argument, NULL, 's'},
                                        {"threads", required_argument, NULL, 'n'},
                                        {"instructions", required_argument, NULL, 'i'},
                                        {"count-rows", required_argument, NULL, 'c'}, // of the run under valgrind
                                        {"help", no_argument, NULL, 'h'},
                                        {"version", no_argument, NULL, 'V'},
                                        {NULL, 0, NULL, 0}};

static int take_study(const char *name, settings *s) {
    int index = 0;
    const int result = option_choice("trade", "study", name, study_names, &index);
    s->study = result == 0 ? study_names[index] : NULL;
    return result;
}

static int take(settings *s, int option, char **argv) {
    static const char *const no_yes[] = {"no", "yes", NULL};
    switch (option) {
    case 'o':
        s->out = optarg;
        return 0;
    case 'r':
        s->root = optarg;
        return 0;
    case 'q':
        s->quick = true;
        return 0;
    case 's':
        return take_study(optarg, s);
    case 'n':
        return option_integer("trade", "threads", optarg, 1, 64, &s->threads);
    case 'i':
        return option_choice("trade", "instructions", optarg, no_yes, &s->instructions);
    case 'c':
        s->count_rows = optarg;
        return 0;
    default:
        return option_unknown("trade", option, argv);
    }
}

/// The signal that wants the run to end; 0 none.
static volatile sig_atomic_t wanted_end;

static void want_end(int number) {
    wanted_end = number;
}

static void catch_ends(void (*handler)(int)) {
    static const int ends[] = {SIGINT, SIGTERM, SIGHUP};
    for (size_t i = 0; i < sizeof ends / sizeof *ends; i++) {
        struct sigaction action;
        sigaction(ends[i], NULL, &action);
        if (action.sa_handler == SIG_IGN) // nohup
            continue;
        memset(&action, 0, sizeof action);
        action.sa_handler = handler;
        sigaction(ends[i], &action, NULL);
    }
}

static int show(void *context, const char *what, double done) {
    static char shown[80];
    (void)context;
    if (strcmp(what, shown) != 0) {
        progress_end();
        snprintf(shown, sizeof shown, "%s", what);
        progress_begin(shown, 1000);
    }
    progress_update((size_t)(1000 * done));
    return wanted_end != 0;
}

/// Makes a folder and those above it.
static int make_folder(const char *name) {
    char path[300];
    struct stat info;
    if (strlen(name) == 0 || strlen(name) > 200)
        return fail_usage("skyvert trade: --out %.60s: allowed is a name of 1 to 200 bytes", name);
    snprintf(path, sizeof path, "%s", name);
    for (char *c = path + 1; *c; c++)
        if (*c == '/') {
            *c = '\0';
            (void)mkdir(path, 0777);
            *c = '/';
        }
    if (mkdir(path, 0777) == 0 || (errno == EEXIST && stat(path, &info) == 0 && S_ISDIR(info.st_mode)))
        return 0;
    return fail_usage("%.200s: cannot be made a folder: %s", name, strerror(errno));
}

typedef void (*writer)(FILE *out, const trade *t);

static int write_file(const trade *t, const char *name, writer write) {
    char path[300];
    output out;
    snprintf(path, sizeof path, "%.250s/%s", t->options.out, name);
    const int result = output_open(&out, path);
    if (result)
        return result;
    write(out.stream, t);
    return output_commit(&out);
}

/// Runs gnuplot on a program. @return whether it did
static bool run_gnuplot(const char *program) {
    fflush(NULL);
    const pid_t child = fork();
    int status = -1;
    if (child == 0) {
        execlp("gnuplot", "gnuplot", program, (char *)NULL);
        _exit(127);
    }
    return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

static int draw(const trade *t, const char *name, int light, const char *terminal, const char *suffix) {
    char picture[300], program[300];
    output image, text;
    snprintf(picture, sizeof picture, "%.250s/%s.%s", t->options.out, name, suffix);
    snprintf(program, sizeof program, "%.250s/%s.gp", t->options.out, name);
    int result = output_reserve(&image, picture);
    if (result)
        return result;
    result = output_open(&text, program);
    if (result == 0) {
        trade_plot(text.stream, t, light, terminal, output_name(&image));
        result = output_commit(&text);
    }
    if (result == 0 && !run_gnuplot(program)) {
        output_discard(&image);
        fprintf(stderr,
                "skyvert trade: gnuplot is missing or failed: %.250s is not drawn (apt-get install gnuplot-nox)\n",
                picture);
        return 0;
    }
    if (result) {
        output_discard(&image);
        return result;
    }
    unlink(program);
    return output_commit(&image);
}

static int draw_all(const trade *t) {
    static const char *const names[] = {"pareto", "pareto-single", "pareto-full"};
    int result = 0;
    for (int i = 0; i < 3 && result == 0; i++) {
        result = draw(t, names[i], i - 1, "svg", "svg");
        if (result == 0)
            result = draw(t, names[i], i - 1, "pngcairo", "png");
    }
    return result;
}

static int report(const trade *t) {
    if (trade_write_airs(t))
        return EXIT_JOB;
    int result = write_file(t, "trade.csv", trade_report_csv);
    if (result == 0)
        result = write_file(t, "frontier.csv", trade_report_frontier);
    if (result == 0)
        result = write_file(t, "worst.txt", trade_report_worst);
    if (result == 0)
        result = write_file(t, "trade.txt", trade_report_text);
    if (result == 0)
        result = draw_all(t);
    if (result)
        return result;
    trade_report_text(stdout, t);
    return output_finish_stdout();
}

/// This program as the run under valgrind calls it.
static bool self(char *text, size_t size) {
    const ssize_t n = readlink("/proc/self/exe", text, size - 1);
    if (n > 0)
        text[n] = '\0';
    return n > 0;
}

static int end_as_wanted(trade *t) {
    progress_end();
    fprintf(stderr, "skyvert trade: stopped; what was finished is kept: the same command goes on\n");
    trade_end(t);
    catch_ends(SIG_DFL);
    raise(wanted_end);
    return EXIT_JOB;
}

static int run(const settings *s) {
    char program[400], cache[300];
    char *command[] = {
        program, (char *)"trade", (char *)"--root", (char *)s->root, (char *)"--out", (char *)s->out, NULL, NULL, NULL};
    size_t n = 6;
    if (s->quick)
        command[n++] = (char *)"--quick";
    command[n++] = (char *)"--count-rows";
    const int made = make_folder(s->out);
    if (made)
        return made;
    if (s->study)
        return run_study(&(study_settings){.study = s->study,
                                           .root = s->root,
                                           .out = s->out,
                                           .quick = s->quick,
                                           .instructions = s->instructions != 0,
                                           .only_count = s->count_rows != NULL});
    snprintf(cache, sizeof cache, "%.250s/cache", s->out);
    const bool counts = s->instructions && !s->count_rows && self(program, sizeof program);
    const trade_options how = {.root = s->root,
                               .out = s->out,
                               .cache = cache,
                               .quick = s->quick,
                               .threads = s->threads,
                               .command = counts ? command : NULL,
                               .progress = show};
    trade t;
    int result = trade_begin(&t, &how);
    if (result == 0 && s->count_rows) {
        result = trade_count_only(&t, s->count_rows);
    } else if (result == 0) {
        catch_ends(want_end);
        result = trade_run(&t);
        if (result == TRADE_STOPPED)
            return end_as_wanted(&t);
        catch_ends(SIG_DFL);
        progress_end();
        result = result ? EXIT_JOB : report(&t);
    }
    trade_end(&t);
    return result;
}

int cmd_trade(int argc, char **argv) {
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    settings s = {.out = "out/trade",
                  .root = ".",
                  .threads = processors < 1    ? 1
                             : processors > 64 ? 64
                                               : (int)processors,
                  .instructions = 1};
    for (int c; (c = getopt_long(argc, argv, ":hV", options, NULL)) != -1;) {
        if (c == 'h') {
            fputs(help, stdout);
            return output_finish_stdout();
        }
        if (c == 'V')
            return option_version();
        const int result = take(&s, c, argv);
        if (result)
            return result;
    }
    const int result = option_no_more("trade", argc, argv);
    return result ? result : run(&s);
}

#else

int cmd_trade(int argc, char **argv) {
    (void)argc, (void)argv;
    return fail_job("skyvert trade: this build lacks libinih: install libinih-dev and build again");
}

#endif
