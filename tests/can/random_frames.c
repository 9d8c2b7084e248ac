// random_frames N SEED PERIOD_US: N random frames as a candump log on the standard output, so far apart. Three of four
// have an id of the table, most of these the right length, node, type and the next message code before any data, NaN
// among it; the others are of any id, kind and length.
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "port/canaerospace/skv_candump.h"

static uint64_t state;

// xorshift64* [Vigna16].
static uint32_t random_bits(void) {
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return (uint32_t)((state * 2685821657736338717u) >> 32);
}

static bool chance(uint32_t percent) {
    return random_bits() % 100 < percent;
}

static void any_frame(skv_can_frame *f) {
    f->flags = (uint8_t)((chance(30) ? SKV_CAN_EXTENDED : 0u) | (chance(10) ? SKV_CAN_RTR : 0u));
    f->id = random_bits() & (f->flags & SKV_CAN_EXTENDED ? 0x1FFFFFFFu : 0x7FFu);
    f->length = (uint8_t)(random_bits() % 9);
}

static void header(skv_can_frame *f, int index) {
    static const uint8_t nan[4] = {0x7F, 0xC0, 0, 1};
    static uint8_t code[SKV_CAS_MESSAGES];
    f->length = 8;
    f->data[0] = chance(90) ? 17 : f->data[0];
    f->data[1] = chance(80) ? skv_cas_table[index].type : (uint8_t)(random_bits() % 32);
    f->data[2] = 0;
    f->data[3] = code[index]++;
    if (chance(10))
        memcpy(f->data + 4, nan, sizeof nan);
    else if (chance(40)) // floats of a size that occurs
        f->data[4] = (uint8_t)(0x41 + random_bits() % 4);
}

static skv_can_frame frame_of(void) {
    skv_can_frame f = {0};
    const int index = (int)(random_bits() % SKV_CAS_MESSAGES);
    const bool known = chance(75);
    f.id = skv_cas_table[index].id;
    f.length = (uint8_t)(random_bits() % 9);
    if (!known)
        any_frame(&f);
    for (int i = 0; i < 8; i++)
        f.data[i] = (uint8_t)random_bits();
    if (known && chance(80))
        header(&f, index);
    for (int i = f.flags & SKV_CAN_RTR ? 0 : f.length; i < 8; i++)
        f.data[i] = 0;
    return f;
}

int main(int argc, char **argv) {
    if (argc != 4)
        return 2;
    const int64_t step_ns = 1000 * strtoll(argv[3], NULL, 10);
    skv_candump_entry entry = {.time_ns = INT64_C(1700000000000000000), .interface = "vcan0"};
    state = strtoull(argv[2], NULL, 10) | 1;
    for (long n = strtol(argv[1], NULL, 10); n > 0; n--) {
        char line[SKV_CANDUMP_LINE];
        entry.frame = frame_of();
        entry.time_ns += step_ns;
        if (skv_candump_write(line, sizeof line, &entry) < 0)
            abort();
        fputs(line, stdout);
    }
    return fflush(stdout) == 0 ? 0 : 1;
}
