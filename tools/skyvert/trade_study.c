/// `skyvert trade --study NAME`: files, pictures, progress and Ctrl-C of the studies.
#define _XOPEN_SOURCE 700 // readlink

#include "trade_study.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "command.h"

const char *const study_names[] = {"ablation", "dome", "day", NULL};

#if SKV_HAVE_INIH
#include "tools/trade/studies.h"

enum { AIRS = 3, AIRS_DRAWN = 2 };
static const char *const air_names[AIRS] = {"br16", "br17o", "smoke"}; // the last has the layer that the others lack

static volatile sig_atomic_t wanted_end;

static void want_end(int number) {
    wanted_end = number;
}

static int show(void *context, double done) {
    (void)context;
    progress_update((size_t)(1000 * done));
    return wanted_end != 0;
}

static int draw(const study_settings *s, const char *air, const char *terminal, const char *suffix) {
    char csv[300], picture[300], program[300];
    output image, text;
    snprintf(csv, sizeof csv, "%.250s/%s.csv", s->out, s->study);
    snprintf(picture, sizeof picture, "%.250s/%s-%s.%s", s->out, s->study, air, suffix);
    snprintf(program, sizeof program, "%.250s/%s-%s.gp", s->out, s->study, air);
    int result = output_reserve(&image, picture);
    if (result)
        return result;
    result = output_open(&text, program);
    if (result == 0) {
        (void)trade_study_plot(text.stream, s->study, air, csv, terminal, output_name(&image));
        result = output_commit(&text);
    }
    if (result) {
        output_discard(&image);
        return result;
    }
    fflush(NULL);
    int status = -1;
    const pid_t child = fork();
    if (child == 0) {
        execlp("gnuplot", "gnuplot", program, (char *)NULL);
        _exit(127);
    }
    const bool drawn =
        child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
    unlink(program);
    if (drawn)
        return output_commit(&image);
    output_discard(&image);
    fprintf(stderr, "skyvert trade: gnuplot is missing or failed: %.250s is not drawn (apt-get install gnuplot-nox)\n",
            picture);
    return 0;
}

static int draw_all(const study_settings *s) {
    int result = 0;
    for (int i = 0; i < AIRS_DRAWN && result == 0 && strcmp(s->study, "ablation") != 0; i++) {
        result = draw(s, air_names[i], "svg", "svg");
        if (result == 0)
            result = draw(s, air_names[i], "pngcairo", "png");
    }
    return result;
}

/// The text to the standard output, too.
static int show_text(const study_settings *s) {
    char path[300], part[4096];
    snprintf(path, sizeof path, "%.250s/%s.txt", s->out, s->study);
    FILE *const in = fopen(path, "r");
    for (size_t n; in && (n = fread(part, 1, sizeof part, in)) > 0;)
        fwrite(part, 1, n, stdout);
    if (in)
        fclose(in);
    return output_finish_stdout();
}

static int evaluate(const study_settings *s, const trade_study *how, output *text, output *csv) {
    static int (*const studies[])(FILE *, FILE *, const trade_study *) = {trade_ablation, trade_dome, trade_day};
    int which = 0;
    while (strcmp(study_names[which], s->study) != 0)
        which++;
    progress_begin(s->study, 1000);
    const int status = studies[which](text->stream, csv->stream, how);
    progress_end();
    return status;
}

/// Also when it was stopped: what is finished is kept.
static int run_to_files(const study_settings *s, const trade_study *how) {
    char path[300];
    output text, csv;
    snprintf(path, sizeof path, "%.250s/%s.txt", s->out, s->study);
    int result = output_open(&text, path);
    if (result)
        return result;
    snprintf(path, sizeof path, "%.250s/%s.csv", s->out, s->study);
    result = output_open(&csv, path);
    if (result) {
        output_discard(&text);
        return result;
    }
    signal(SIGINT, want_end);
    signal(SIGTERM, want_end);
    const int status = evaluate(s, how, &text, &csv);
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    if (status == TRADE_STUDY_FAILED) {
        output_discard(&text);
        output_discard(&csv);
        return EXIT_JOB;
    }
    result = output_commit(&text);
    const int other = output_commit(&csv);
    result = result ? result : other;
    if (result == 0 && status == TRADE_STUDY_STOPPED)
        return fail_job("skyvert trade: stopped; what the study finished is in %.250s", s->out);
    if (result == 0)
        result = draw_all(s);
    return result ? result : show_text(s);
}

int run_study(const study_settings *s) {
    static trade_truth truth[AIRS];
    trade_study_air air[AIRS];
    char spectra[300], folder[300], program[400] = "";
    char *command[] = {program,
                       (char *)"trade",
                       (char *)"--root",
                       (char *)s->root,
                       (char *)"--out",
                       (char *)s->out,
                       (char *)"--study",
                       (char *)s->study,
                       s->quick ? (char *)"--quick" : (char *)"--count-rows",
                       s->quick ? (char *)"--count-rows" : (char *)"all",
                       s->quick ? (char *)"all" : NULL,
                       NULL};
    snprintf(spectra, sizeof spectra, "%.250s/tools/fit/spectra", s->root);
    snprintf(folder, sizeof folder, "%.250s/counts", s->out);
    for (int i = 0; i < AIRS; i++) {
        const int wrong = trade_truth_load(&truth[i], s->root, air_names[i]);
        if (wrong)
            return wrong;
        air[i] = (trade_study_air){air_names[i], &truth[i].atmosphere, truth[i].scene};
    }
    const ssize_t n = readlink("/proc/self/exe", program, sizeof program - 1);
    const bool terms = strcmp(s->study, "ablation") == 0;
    const trade_study how = {.air = air,
                             .airs = terms ? AIRS : AIRS_DRAWN,
                             .spectra = spectra,
                             .quick = s->quick,
                             .progress = s->only_count ? NULL : show,
                             .command = s->instructions && n > 0 ? command : NULL,
                             .folder = folder};
    if (s->only_count)
        return terms && trade_ablation_count(&how) == TRADE_STUDY_DONE ? EXIT_DONE : EXIT_JOB;
    return run_to_files(s, &how);
}

#else

int run_study(const study_settings *s) {
    return fail_job("skyvert trade: --study %s: this build lacks libinih: install libinih-dev and build again",
                    s->study);
}

#endif
