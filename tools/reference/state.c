/// The state file: one line per ray that was begun, doubles in hexadecimal, so nothing is lost.
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "orders.h"

#define FORM "skyvert-reference state 1"

static uint64_t add(uint64_t h, const void *data, size_t size) {
    const unsigned char *byte = data;
    for (size_t i = 0; i < size; i++)
        h = (h ^ byte[i]) * 0x100000001b3u; // FNV-1a
    return h;
}

static uint64_t add_profile(uint64_t h, const ref_profile *p) {
    const double numbers[] = {(double)p->kind, p->scale_km,      p->background,   p->us76_a,     p->us76_b,
                              p->peak_km,      p->half_width_km, p->lognormal_mu, p->lognormal_k};
    h = add(h, numbers, sizeof numbers);
    if (p->kind != REF_TABLE)
        return h;
    h = add(h, p->table_km, (size_t)p->rows * sizeof(double));
    return add(h, p->table_density, (size_t)p->rows * sizeof(double));
}

uint64_t ref_state_digest(const ref_atmosphere *a, const ref_job *job, const ref_query *queries, size_t count) {
    const double numbers[] = {a->bands, a->radius_km, a->top_km, a->ground_km, (double)a->phase, a->g};
    uint64_t h = add(0xcbf29ce484222325u, numbers, sizeof numbers);
    h = add(h, a->albedo, sizeof a->albedo);
    h = add(h, a->rayleigh_scattering, sizeof a->rayleigh_scattering);
    h = add(h, a->aerosol_scattering, sizeof a->aerosol_scattering);
    h = add(h, a->aerosol_extinction, sizeof a->aerosol_extinction);
    h = add(h, a->ozone_absorption, sizeof a->ozone_absorption);
    h = add_profile(add_profile(add_profile(h, &a->rayleigh), &a->aerosol), &a->ozone);
    h = add(h, &job->seed, sizeof job->seed);
    h = add(h, &job->lit_ground, sizeof job->lit_ground);
    for (size_t i = 0; i < count; i++)
        h = add(h, &queries[i].altitude_km, 4 * sizeof(double));
    return h;
}

static int complain(const char *name, int line, const char *what) {
    fprintf(stderr, "%s:%d: %s\n", name, line, what);
    return 2;
}

static int read_row(const char *line, ref_total *totals, size_t count) {
    unsigned long long index, batches;
    int used;
    if (sscanf(line, "%llu %llu%n", &index, &batches, &used) != 2 || index >= count)
        return 0;
    ref_tally t = {.batches = batches};
    for (int k = 0; k < 2 * REF_BANDS; k++) {
        char *end;
        const double value = strtod(line + used, &end);
        if (end == line + used)
            return 0;
        used = (int)(end - line);
        *(k < REF_BANDS ? &t.sum[k] : &t.squares[k - REF_BANDS]) = value;
    }
    if (strcmp(line + used, " .\n") != 0)
        return 0;
    totals[index].tally = t;
    return 1;
}

int ref_state_read(const char *name, uint64_t digest, ref_total *totals, size_t count) {
    char line[1024];
    unsigned long long found;
    FILE *in = fopen(name, "r");
    if (!in)
        return errno == ENOENT ? 0 : complain(name, 0, strerror(errno));
    int status = 0;
    if (!fgets(line, sizeof line, in) || sscanf(line, FORM " %llx", &found) != 1)
        status = complain(name, 1, "is no state file of this version");
    else if (found != digest)
        status = complain(name, 1,
                          "belongs to another atmosphere, ground, seed or other rays; give them again or remove it");
    for (int number = 2; status == 0 && fgets(line, sizeof line, in); number++)
        if (!read_row(line, totals, count))
            status = complain(name, number, "is damaged; remove the file to start again");
    fclose(in);
    return status;
}

int ref_state_write(const char *name, uint64_t digest, const ref_total *totals, size_t count) {
    char temp[4096];
    if (snprintf(temp, sizeof temp, "%s.part", name) >= (int)sizeof temp)
        return complain(name, 0, "the name is too long") - 1;
    FILE *out = fopen(temp, "w");
    int good = out != NULL;
    if (good) {
        fprintf(out, FORM " %llx\n", (unsigned long long)digest);
        for (size_t i = 0; i < count; i++) {
            const ref_tally *t = &totals[i].tally;
            if (t->batches == 0)
                continue;
            fprintf(out, "%zu %llu", i, (unsigned long long)t->batches);
            for (int k = 0; k < 2 * REF_BANDS; k++)
                fprintf(out, " %a", k < REF_BANDS ? t->sum[k] : t->squares[k - REF_BANDS]);
            fprintf(out, " .\n");
        }
        good = fflush(out) == 0 && fsync(fileno(out)) == 0;
        good = fclose(out) == 0 && good;
    }
    if (good && rename(temp, name) == 0)
        return 0;
    const int why = errno;
    remove(temp);
    fprintf(stderr, "%s: cannot be written: %s\n", name, strerror(why));
    return 1;
}
