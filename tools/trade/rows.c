#include "rows.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/// First line of the file. Change it with the lines below.
static const char head[] = "skyvert trade rows 1\n";

uint64_t trade_hash(uint64_t hash, const void *bytes, size_t n) {
    for (size_t i = 0; i < n; i++)
        hash = (hash ^ ((const unsigned char *)bytes)[i]) * 1099511628211u;
    return hash;
}

uint64_t trade_hash_file(const char *name) {
    FILE *const in = fopen(name, "rb");
    uint64_t hash = TRADE_HASH_START;
    unsigned char part[4096];
    size_t n;
    if (!in)
        return 0;
    while ((n = fread(part, 1, sizeof part, in)) > 0)
        hash = trade_hash(hash, part, n);
    fclose(in);
    return hash;
}

static uint64_t digest_of(const trade_row *row, uint64_t program) {
    char text[400];
    trade_config_text(row->config, text);
    uint64_t hash = trade_hash(program, text, strlen(text));
    for (int i = 0; i < TRADE_SCENES; i++) {
        const trade_scene *const s = &row->truth->scene[i];
        hash = trade_hash(hash, s->direction, sizeof s->direction);
        hash = trade_hash(hash, s->radiance, sizeof s->radiance);
    }
    return trade_hash(hash, row->truth->file.atmosphere.rayleigh_scattering, 4 * sizeof(double));
}

// One line a row. %a keeps the very bits.
static void write_row(FILE *out, const trade_row *r) {
    fprintf(out, "%016" PRIx64 " %u %a %.0f %.0f %.0f %.0f %d", r->digest, r->done, r->build_s, r->table_bytes,
            r->grid_bytes, r->work_bytes, r->stack_bytes, r->sees_ground);
    for (int i = 0; i < TRADE_SCENES; i++) {
        const trade_error *const e = &r->error[i];
        const trade_cost *const c = &r->cost[i];
        fprintf(out, " %d %a %a %a %zu %a %a %a %a %a %a %a", r->rays[i], e->mean, e->p95, e->max, e->worst,
                r->off_scale[i], c->ns, c->ns_low, c->ns_high, c->frame_ns, c->instructions, c->frame_instructions);
    }
    fprintf(out, " ;%s\n", r->beyond);
}

/// Takes a number (strtod reads what %a wrote); *ok becomes 0 where there is none.
static double number(const char **text, int *ok) {
    char *end;
    const double x = strtod(*text, &end);
    if (end == *text)
        *ok = 0;
    *text = end;
    return x;
}

/// @return 1 iff the line is whole; *r is then overwritten but for what identifies it
static int read_row(trade_row *r, const char *text) {
    trade_row got = *r;
    int ok = 1;
    got.done = (unsigned)number(&text, &ok);
    got.build_s = number(&text, &ok);
    got.table_bytes = number(&text, &ok);
    got.grid_bytes = number(&text, &ok);
    got.work_bytes = number(&text, &ok);
    got.stack_bytes = number(&text, &ok);
    got.sees_ground = (int)number(&text, &ok);
    for (int i = 0; i < TRADE_SCENES; i++) {
        trade_error *const e = &got.error[i];
        trade_cost *const c = &got.cost[i];
        got.rays[i] = (int)number(&text, &ok);
        e->mean = number(&text, &ok);
        e->p95 = number(&text, &ok);
        e->max = number(&text, &ok);
        e->worst = (size_t)number(&text, &ok);
        got.off_scale[i] = number(&text, &ok);
        c->ns = number(&text, &ok);
        c->ns_low = number(&text, &ok);
        c->ns_high = number(&text, &ok);
        c->frame_ns = number(&text, &ok);
        c->instructions = number(&text, &ok);
        c->frame_instructions = number(&text, &ok);
        ok = ok && got.rays[i] >= 0 && got.rays[i] <= r->truth->scene[i].n && e->worst < TRADE_RAYS;
    }
    if (!ok || strncmp(text, " ;", 2) != 0)
        return 0;
    snprintf(got.beyond, sizeof got.beyond, "%.*s", (int)strcspn(text + 2, "\n"), text + 2);
    *r = got;
    return 1;
}

/// What an earlier run kept. Lines that are damaged or of something else are passed over.
static void take_over(trade_rows *rows) {
    FILE *const in = fopen(rows->file, "r");
    char text[8192];
    if (!in)
        return;
    const int good = fgets(text, sizeof text, in) && strcmp(text, head) == 0;
    while (good && fgets(text, sizeof text, in)) {
        char *end;
        const uint64_t digest = strtoull(text, &end, 16);
        for (size_t i = 0; end != text && i < rows->n; i++)
            if (rows->at[i].digest == digest && read_row(&rows->at[i], end))
                break;
    }
    fclose(in);
}

int trade_rows_begin(trade_rows *rows, const trade_config *configs, size_t n_configs, const trade_truth *truths,
                     size_t n_truths, uint64_t program, const char *file) {
    *rows = (trade_rows){.at = calloc(n_configs * n_truths + 1, sizeof *rows->at), .n = n_configs * n_truths};
    if (!rows->at) {
        fprintf(stderr, "skyvert trade: out of memory\n");
        return 1;
    }
    snprintf(rows->file, sizeof rows->file, "%s", file);
    for (size_t i = 0; i < rows->n; i++) {
        trade_row *const r = &rows->at[i];
        r->config = &configs[i % n_configs];
        r->truth = &truths[i / n_configs];
        r->digest = digest_of(r, program);
        for (int s = 0; s < TRADE_SCENES; s++)
            r->cost[s] = (trade_cost){-1, -1, -1, -1, -1, -1};
    }
    take_over(rows);
    return 0;
}

int trade_rows_keep(const trade_rows *rows) {
    char part[320];
    snprintf(part, sizeof part, "%s.part", rows->file);
    FILE *const out = fopen(part, "w");
    if (out) {
        fputs(head, out);
        for (size_t i = 0; i < rows->n; i++)
            if (rows->at[i].done)
                write_row(out, &rows->at[i]);
        const int failed = ferror(out);
        if (fclose(out) == 0 && !failed && rename(part, rows->file) == 0)
            return 0;
    }
    fprintf(stderr, "%.250s: cannot be written: %s\n", rows->file, strerror(errno));
    unlink(part);
    return 1;
}

void trade_rows_free(trade_rows *rows) {
    free(rows->at);
    *rows = (trade_rows){0};
}
