// random_log N SEED LOG CSV: N random values of every message and type, encoded, as a candump log; and what they are,
// one line a frame: frame,id,type,signal,value. Halves of doubles: the value of the pair stands in the line of its last
// half.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "port/canaerospace/skv_candump.h"

static uint64_t state;

// xorshift64* [Vigna16].
static double chance(void) {
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return (double)((state * 2685821657736338717u) >> 11) * 0x1p-53;
}

typedef struct output {
    FILE *log, *csv;
    int64_t time_ns;
    long frames;
} output;

static void write_frame(output *out, const skv_can_frame *frame) {
    skv_candump_entry entry = {.time_ns = out->time_ns, .interface = "vcan0", .frame = *frame};
    char line[SKV_CANDUMP_LINE];
    if (skv_candump_write(line, sizeof line, &entry) < 0)
        abort();
    fputs(line, out->log);
    out->time_ns += 1000000;
    out->frames++;
}

static void number(output *out, skv_cas_sender *sender, int index, uint8_t type) {
    const skv_cas_info *info = &skv_cas_table[index];
    skv_can_frame frames[2];
    double value = (double)info->low + chance() * ((double)info->high - (double)info->low);
    if (info->wraps == 2 && value >= 359.99)
        value = 0.25;
    const int n = skv_cas_encode(sender, (skv_cas_index)index, type, value, frames);
    if (n < 1)
        abort();
    for (int i = 0; i < n; i++)
        write_frame(out, &frames[i]);
    const double want = type == SKV_CAS_FLOAT ? (double)(float)value : value;
    fprintf(out->csv, "%ld,%d,%d,%s,%.17g\n", out->frames, info->id, type, info->name, want);
}

static void four_bytes(output *out, skv_cas_sender *sender, int index) {
    uint8_t b[4] = {(uint8_t)(24 * chance()), (uint8_t)(60 * chance()), (uint8_t)(60 * chance()), 0};
    if (index == SKV_CAS_DATE) {
        b[0] = (uint8_t)(1 + 28 * chance());
        b[1] = (uint8_t)(1 + 12 * chance());
        b[2] = (uint8_t)(19 + 2 * chance());
        b[3] = (uint8_t)(100 * chance());
    } else if (index == SKV_CAS_SKY_STATE) {
        b[0] = (uint8_t)(5 * chance());
        b[1] = (uint8_t)(4 * chance());
    }
    skv_can_frame frame;
    if (skv_cas_encode_bytes(sender, (skv_cas_index)index, b, &frame) != 1)
        abort();
    write_frame(out, &frame);
    fprintf(out->csv, "%ld,%d,%d,%s,%d %d %d %d\n", out->frames, skv_cas_table[index].id, skv_cas_table[index].type,
            skv_cas_table[index].name, b[0], b[1], b[2], b[3]);
}

int main(int argc, char **argv) {
    if (argc != 5)
        return 2;
    output out = {fopen(argv[3], "w"), fopen(argv[4], "w"), 1700000000000000000, 0};
    skv_cas_sender sender = {.node = 17};
    state = strtoull(argv[2], NULL, 10) | 1;
    if (!out.log || !out.csv)
        return 1;
    for (long n = strtol(argv[1], NULL, 10); n > 0; n--)
        for (int i = 0; i < SKV_CAS_MESSAGES; i++) {
            if (skv_cas_table[i].low >= skv_cas_table[i].high)
                four_bytes(&out, &sender, i);
            for (uint8_t t = 1; t < 32 && skv_cas_table[i].low < skv_cas_table[i].high; t++)
                if (skv_cas_table[i].types >> t & 1u)
                    number(&out, &sender, i, t);
        }
    return fclose(out.log) || fclose(out.csv);
}
