/// skyvert-reference: the truth in double, with the query and answer form of `skyvert eval`.
#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "orders.h"
#include "read_ini.h"

typedef struct settings {
    const char *atmosphere;
    int all;
    double ground_km;
    ref_job job;
} settings;

static int usage(FILE *out, int status) {
    fprintf(
        out,
        "usage: skyvert-reference --atmosphere FILE.ini [--orders single|all] [--ground none|lit] [--ground-km X]\n"
        "           [--target-error 0.3%%] [--max-paths N] [--seed N] [--threads N] [--state FILE]\n"
        "           < queries.csv > answers.csv\n"
        "Radiance in double precision; the columns of skyvert eval.\n"
        "single: converged to 1e-9. all: every order of scattering by random paths, and E_<nm>, the standard errors.\n"
        "  --target-error  relative standard error of every band at which a ray is done (0.3%%)\n"
        "  --max-paths     paths of a ray at most (4000000)\n"
        "  --seed          of the random numbers (1); the same seed gives the same bits with any number of threads\n"
        "  --state FILE    keeps what is done when interrupted (Ctrl-C); the same command then goes on, also with\n"
        "                  another target\n");
    return status;
}

static int bad(const char *option, const char *value, const char *allowed) {
    fprintf(stderr, "skyvert-reference: --%s %s: %s\n", option, value, allowed);
    return 2;
}

static int whole(const char *option, const char *text, uint64_t low, uint64_t high, uint64_t *value) {
    char *end, allowed[64];
    errno = 0;
    const unsigned long long n = strtoull(text, &end, 10);
    if (text[0] >= '0' && text[0] <= '9' && *end == '\0' && errno == 0 && n >= low && n <= high) {
        *value = n;
        return 0;
    }
    snprintf(allowed, sizeof allowed, "a whole number, %llu to %llu", (unsigned long long)low,
             (unsigned long long)high);
    return bad(option, text, allowed);
}

static int target(const char *text, double *value) {
    char *end;
    double x = strtod(text, &end);
    if (*end == '%' && end != text) {
        x /= 100;
        end++;
    }
    if (end == text || *end != '\0' || !(x >= 1e-6 && x <= 1))
        return bad("target-error", text, "0.0001% to 100%, or a fraction of 1");
    *value = x;
    return 0;
}

static int choice(const char *option, const char *text, const char *off, const char *on, int *value) {
    char allowed[64];
    snprintf(allowed, sizeof allowed, "%s or %s", off, on);
    if (strcmp(text, off) != 0 && strcmp(text, on) != 0)
        return bad(option, text, allowed);
    *value = strcmp(text, on) == 0;
    return 0;
}

static int take(settings *s, int option, const char *text) {
    uint64_t threads;
    char *end;
    switch (option) {
    case 'a':
        s->atmosphere = text;
        return 0;
    case 'o':
        return choice("orders", text, "single", "all", &s->all);
    case 'g':
        return choice("ground", text, "none", "lit", &s->job.lit_ground);
    case 'k':
        s->ground_km = strtod(text, &end);
        return end != text && *end == '\0' && isfinite(s->ground_km) ? 0 : bad("ground-km", text, "a finite number");
    case 'e':
        return target(text, &s->job.target);
    case 'm':
        return whole("max-paths", text, REF_BATCH, 1000000000000u, &s->job.max_paths);
    case 's':
        return whole("seed", text, 0, UINT64_MAX, &s->job.seed);
    case 't':
        if (whole("threads", text, 1, 256, &threads) != 0)
            return 2;
        s->job.threads = (int)threads;
        return 0;
    case 'f':
        s->job.state = text;
        return 0;
    default:
        return usage(stderr, 2);
    }
}

static void header(const ref_atmosphere *a, int errors) {
    printf("altitude_km,sun_zenith_deg,view_zenith_deg,rel_azimuth_deg");
    for (int k = 0; k < a->bands; k++)
        printf(",L_%.9g", a->wavelength_nm[k]);
    for (int k = 0; errors && k < a->bands; k++)
        printf(",E_%.9g", a->wavelength_nm[k]);
    printf("\n");
}

static void row(const ref_query *q, const double *radiance, const double *error, int bands) {
    printf("%.9g,%.9g,%.9g,%.9g", q->altitude_km, q->sun_zenith_deg, q->view_zenith_deg, q->azimuth_deg);
    for (int k = 0; k < bands; k++)
        printf(error ? ",%.9e" : ",%.12e", radiance[k]);
    for (int k = 0; error && k < bands; k++)
        printf(",%.3e", error[k]);
    printf("\n");
}

static int answer_single(const ref_atmosphere *a, int lit, const ref_query *queries, size_t count) {
    header(a, 0);
    for (size_t i = 0; i < count; i++) {
        const ref_query *q = &queries[i];
        ref_answer answer;
        const ref_ray ray =
            ref_ray_from_angles(q->altitude_km - a->ground_km, q->sun_zenith_deg, q->view_zenith_deg, q->azimuth_deg);
        if (ref_single(a, &ray, lit, NULL, &answer) != 0) {
            fprintf(stderr, "stdin:%d: did not converge (relative error %.1e)\n", q->line, answer.error);
            return 1;
        }
        row(q, answer.radiance, NULL, a->bands);
    }
    return 0;
}

static int answer_all(const ref_atmosphere *a, const ref_job *job, const ref_query *queries, size_t count) {
    ref_tracer tracer;
    ref_total *totals = malloc((count + 1) * sizeof *totals);
    if (!totals || ref_tracer_make(&tracer, a, job->threads) != 0) {
        fprintf(stderr, "skyvert-reference: out of memory\n");
        free(totals);
        return 1;
    }
    const int status = ref_orders_run(&tracer, job, queries, count, totals);
    if (status == 0) {
        header(a, 1);
        for (size_t i = 0; i < count; i++)
            row(&queries[i], totals[i].radiance, totals[i].error, a->bands);
    }
    ref_tracer_free(&tracer);
    free(totals);
    return status;
}

int main(int argc, char **argv) {
    static const struct option options[] = {{"atmosphere", required_argument, 0, 'a'},
                                            {"orders", required_argument, 0, 'o'},
                                            {"ground", required_argument, 0, 'g'},
                                            {"ground-km", required_argument, 0, 'k'},
                                            {"target-error", required_argument, 0, 'e'},
                                            {"max-paths", required_argument, 0, 'm'},
                                            {"seed", required_argument, 0, 's'},
                                            {"threads", required_argument, 0, 't'},
                                            {"state", required_argument, 0, 'f'},
                                            {"help", no_argument, 0, 'h'},
                                            {0, 0, 0, 0}};
    static ref_file file;
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    settings s = {
        .job = {.target = 0.003, .max_paths = 4000000, .seed = 1, .threads = processors > 1 ? (int)processors : 1}};
    ref_query *queries;
    size_t count;
    int option, status;
    while ((option = getopt_long(argc, argv, "", options, NULL)) != -1) {
        if (option == 'h')
            return usage(stdout, 0);
        if ((status = take(&s, option, optarg)) != 0)
            return status;
    }
    if (!s.atmosphere || optind != argc)
        return usage(stderr, 2);
    if (ref_read_ini(&file, s.atmosphere) != 0)
        return 2;
    file.atmosphere.ground_km = s.ground_km;
    if (!(s.ground_km > -file.atmosphere.radius_km && s.ground_km < file.atmosphere.top_km))
        return bad("ground-km", "", "above the planet's centre and below top_km");
    if ((status = ref_queries_read(stdin, "stdin", &queries, &count)) != 0)
        return status;
    status = s.all ? answer_all(&file.atmosphere, &s.job, queries, count)
                   : answer_single(&file.atmosphere, s.job.lit_ground, queries, count);
    free(queries);
    return fflush(stdout) == 0 && !ferror(stdout) ? status : 1;
}
