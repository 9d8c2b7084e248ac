// Random bytes as frames and as lines of a log: no crash, no undefined behaviour, and whatever comes in, no value is
// ever NaN or out of range and the counts add up. For libFuzzer, and by itself: fuzz N SEED.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "port/canaerospace/skv_candump.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void need(int condition, const char *what) {
    if (condition)
        return;
    fprintf(stderr, "fuzz: %s\n", what);
    abort();
}

static skv_cas_receiver receiver;

static void check_values(int64_t now) {
    (void)skv_cas_tick(&receiver, now);
    for (int i = 0; i < SKV_CAS_MESSAGES; i++) {
        double value = 0.0;
        uint8_t bytes[4];
        if (skv_cas_value(&receiver, (skv_cas_index)i, &value) != SKV_CAS_NEVER)
            need(value >= (double)skv_cas_table[i].low && value <= (double)skv_cas_table[i].high,
                 "a value out of range");
        if (skv_cas_bytes(&receiver, (skv_cas_index)i, bytes) != SKV_CAS_NEVER)
            need(skv_cas_bytes_valid((skv_cas_index)i, bytes), "bytes that are no time or date");
    }
}

// 16 bytes a frame: mostly the ids of the table, whole headers, and times that go on, so that much gets through.
static skv_can_frame frame_of(const uint8_t d[16], int64_t *now) {
    skv_can_frame f = {.id = (uint32_t)d[0] << 8 | d[1], .length = (uint8_t)(d[2] < 16 ? d[2] : d[2] % 9)};
    if (d[15] > 16)
        f.id &= 0x7FFu;
    if (d[3] & 1)
        f.id = skv_cas_table[d[0] % SKV_CAS_MESSAGES].id;
    if (d[3] & 2)
        f.length = 8;
    if ((d[3] & 28) == 28)
        f.flags = (uint8_t)(d[3] >> 5);
    memcpy(f.data, d + 4, 8);
    if (d[3] & 1 && d[12] & 1) { // a good header; the next code, the same, any; now and then another node
        const skv_cas_slot *slot = &receiver.slot[d[0] % SKV_CAS_MESSAGES];
        f.data[0] = (d[12] & 14) == 14 ? 18 : 17;
        f.data[1] = d[12] & 16 ? skv_cas_table[d[0] % SKV_CAS_MESSAGES].type : (uint8_t)(d[5] % 32);
        f.data[2] = 0;
        if (d[12] >> 5 < 6)
            f.data[3] = (uint8_t)(slot->code + (d[12] >> 5 != 0));
    }
    *now += d[13] == 0 ? INT64_C(-4000000000) : d[13] < 4 ? INT64_C(1000000000) : d[13] % 8 * INT64_C(1000000);
    return f;
}

static void feed(const uint8_t *data, size_t size) {
    int64_t now = 0;
    skv_cas_clear(&receiver);
    for (size_t at = 0; at + 16 <= size; at += 16) {
        const skv_can_frame f = frame_of(data + at, &now);
        const skv_cas_identity self = {.node = 17};
        skv_can_frame reply;
        uint32_t stamp;
        const skv_cas_count verdict = skv_cas_receive(&receiver, &f, now);
        need((unsigned)verdict <= SKV_CAS_LAST_REFUSED, "a verdict that is none");
        (void)skv_cas_identify(&f, &self, &reply);
        (void)skv_cas_time_sync(&f, &stamp);
        (void)skv_cas_frame_bits(&f);
        check_values(now);
    }
    uint64_t frames = 0;
    for (int i = 0; i <= SKV_CAS_LAST_REFUSED; i++)
        frames += receiver.total[i];
    need(frames == size / 16, "frames that are not counted");
}

// The line as it is; and, if it is a frame, written and read again it is the same.
static void read_line(const uint8_t *data, size_t size) {
    skv_candump_reader reader = {0};
    skv_candump_entry entry, back;
    char line[SKV_CANDUMP_LINE];
    if (skv_candump_read(&reader, (const char *)data, size, &entry) != SKV_CANDUMP_FRAME)
        return;
    const int length = skv_candump_write(line, sizeof line, &entry);
    need(length > 0, "a frame that was read cannot be written");
    need(skv_candump_read(&reader, line, (size_t)length, &back) == SKV_CANDUMP_FRAME &&
             memcmp(&back.frame, &entry.frame, sizeof back.frame) == 0 && back.time_ns / 1000 == entry.time_ns / 1000,
         "a frame changed on its way through a log");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    feed(data, size);
    read_line(data, size);
    return 0;
}

#ifndef SKV_LIBFUZZER
static uint64_t state;

// xorshift64* [Vigna16].
static uint8_t random_byte(void) {
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return (uint8_t)((state * 2685821657736338717u) >> 56);
}

// A good line with a few letters changed.
static void random_line(void) {
    char line[] = "(1436509052.249713) vcan0 123#0011223344556677\n";
    const char letters[] = "0123456789ABCDEF#R_() .\tT\r\nx";
    for (int i = random_byte() % 4; i > 0; i--)
        line[random_byte() % (sizeof line - 1)] = letters[random_byte() % (sizeof letters - 1)];
    read_line((const uint8_t *)line, (size_t)random_byte() % sizeof line);
    read_line((const uint8_t *)line, sizeof line - 1);
}

int main(int argc, char **argv) {
    static uint8_t data[16 * 1000];
    const long frames = argc > 1 ? strtol(argv[1], NULL, 10) : 100000;
    uint32_t sum[SKV_CAS_COUNTS] = {0};
    state = argc > 2 ? strtoull(argv[2], NULL, 10) | 1 : 1;
    for (long n = 0; n < frames; n += 1000) {
        for (size_t i = 0; i < sizeof data; i++)
            data[i] = random_byte();
        feed(data, sizeof data);
        for (int i = 0; i < SKV_CAS_COUNTS; i++)
            sum[i] += receiver.total[i];
        for (int i = 0; i < 200; i++)
            random_line();
    }
    printf("figure: fuzz: %ld random frames with sanitizers:", frames);
    for (int i = 0; i < SKV_CAS_COUNTS; i++)
        printf(" %u %s%s", (unsigned)sum[i], skv_cas_count_name((skv_cas_count)i), i + 1 < SKV_CAS_COUNTS ? "," : "\n");
    fflush(stdout);
    for (int i = 0; i < SKV_CAS_COUNTS; i++)
        need(sum[i] > 0, "one of the counts was never reached");
    return 0;
}
#endif
