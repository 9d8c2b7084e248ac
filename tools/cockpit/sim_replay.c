#include "sim_replay.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "port/canaerospace/skv_candump.h"

/// Most frames of a log: an hour of a full bus and more.
#define RECORDS_MAX 50000000
/// More than this between two frames is worth a line: a board's clock that was set while it was logging.
#define GAP_NS INT64_C(3600000000000)

int sim_is_candump(const char *path, bool *candump) {
    FILE *stream = fopen(path, "rb");
    if (!stream)
        return fail_usage("%.200s: cannot be read: %s", path, strerror(errno));
    int c;
    while ((c = getc(stream)) == ' ' || c == '\n' || c == '\r' || c == '\t')
        ;
    *candump = c == '(';
    fclose(stream);
    return 0;
}

void sim_recording_free(sim_recording *r) {
    free(r->records);
    memset(r, 0, sizeof *r);
}

static int append(sim_recording *r, const skv_candump_entry *entry, const char *path, unsigned long line) {
    if (r->count == RECORDS_MAX)
        return fail_usage("%.200s:%lu: more than %d frames", path, line, RECORDS_MAX);
    if (r->count == r->capacity) {
        const size_t capacity = r->capacity ? 2 * r->capacity : 4096;
        sim_record *records = realloc(r->records, capacity * sizeof *records);
        if (!records)
            return fail_job("%.200s:%lu: out of memory", path, line);
        r->records = records;
        r->capacity = capacity;
    }
    if (r->count == 0)
        r->first_ns = entry->time_ns;
    const int64_t before = r->count > 0 ? r->records[r->count - 1].after_ns : 0;
    const int64_t after = entry->time_ns - r->first_ns;
    r->backwards += after < before;
    if (after - before > GAP_NS && !r->gap)
        fprintf(stderr,
                SIM ": %.200s:%lu: %.0f s behind the frame before: was the clock set? --start %.0f begins here\n", path,
                line, 1e-9 * (double)(after - before), floor(1e-9 * (double)after));
    r->gap = r->gap || after - before > GAP_NS;
    r->records[r->count++] = (sim_record){after < before ? before : after, entry->frame};
    return 0;
}

static int read_lines(sim_recording *r, FILE *stream, const char *path) {
    skv_candump_reader reader = {0};
    skv_candump_entry entry;
    char line[512];
    int status = 0;
    while (status == 0 && fgets(line, sizeof line, stream)) {
        const skv_candump_result result = skv_candump_read(&reader, line, strlen(line), &entry);
        if (result == SKV_CANDUMP_ERROR && !strchr(line, '\n') && feof(stream)) { // whoever wrote it was stopped
            fprintf(stderr, SIM ": %.200s:%lu: the log ends within this line, which is left out\n", path,
                    (unsigned long)reader.line);
            break;
        }
        if (result == SKV_CANDUMP_ERROR)
            return fail_usage("%.200s:%lu: column %d: %s", path, (unsigned long)reader.line, reader.column,
                              reader.reason);
        if (result == SKV_CANDUMP_FD || (result == SKV_CANDUMP_FRAME && entry.frame.flags & SKV_CAN_ERROR))
            r->skipped++;
        else if (result == SKV_CANDUMP_FRAME)
            status = append(r, &entry, path, (unsigned long)reader.line);
    }
    return status == 0 && ferror(stream) ? fail_usage("%.200s: cannot be read: %s", path, strerror(errno)) : status;
}

/// The fullest second: a window that ends at each frame.
static double fullest_second(const sim_recording *r) {
    double bits = 0.0, most = 0.0;
    for (size_t first = 0, i = 0; i < r->count; i++) {
        bits += skv_cas_frame_bits(&r->records[i].frame);
        for (; r->records[i].after_ns - r->records[first].after_ns >= 1000000000; first++)
            bits -= skv_cas_frame_bits(&r->records[first].frame);
        most = bits > most ? bits : most;
    }
    return most;
}

int sim_recording_read(sim_recording *r, const char *path) {
    memset(r, 0, sizeof *r);
    FILE *stream = fopen(path, "rb");
    if (!stream)
        return fail_usage("%.200s: cannot be read: %s", path, strerror(errno));
    int status = read_lines(r, stream, path);
    fclose(stream);
    if (status == 0 && r->count == 0)
        status = fail_usage("%.200s: a candump log without a frame that can be sent", path);
    if (status != 0)
        sim_recording_free(r);
    else
        r->most_bits_second = fullest_second(r);
    return status;
}
