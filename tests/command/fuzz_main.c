/// Runs a fuzz target without libFuzzer: seeded changes of the files named, the same in every run.
///   fuzz_X ROUNDS FILE...
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { ROOM = 1 << 17 };
static uint8_t text[ROOM];
static size_t length;
static uint64_t seed = 0x9e3779b97f4a7c15u;

/// xorshift64*, below n
static size_t draw(size_t n) {
    seed ^= seed >> 12;
    seed ^= seed << 25;
    seed ^= seed >> 27;
    return (size_t)((seed * 2685821657736338717u) >> 33) % (n ? n : 1);
}

static const char *const pieces[] = {
    "\n",
    "\r\n",
    ",",
    "=",
    ":",
    "[",
    "]",
    ";",
    "#",
    "\"",
    "\"\"",
    " ",
    "\t",
    "\xEF\xBB\xBF",
    "nan",
    "inf",
    "1e999",
    "-1",
    "0x1",
    "1e-320",
    "90",
    "180.0001",
    "-0",
    "[ozone]\n",
    "[x]\n",
    "table = fuzz.c\n",
    "profile = table\n",
    "profile = us76\n",
    "profile = tent\n",
    "profile = lognormal\n",
    "mu = 1\n",
    "a = .1\n",
    "g = 1\n",
    "altitude_km",
    "rel_azimuth_deg",
    ",,,,",
    "\x01",
    "1,2,3,4\n",
    "6360",
    "1e6",
};

static void insert(size_t at, const void *data, size_t n) {
    if (length + n > ROOM)
        return;
    memmove(text + at + n, text + at, length - at);
    memcpy(text + at, data, n);
    length += n;
}

static void change(void) {
    const size_t at = draw(length + 1), span = length > at ? 1 + draw(length - at) % 40 : 0;
    uint8_t copy[40];
    switch (draw(6)) {
    case 0: // a bit
        if (at < length)
            text[at] = (uint8_t)(text[at] ^ 1u << draw(8));
        break;
    case 1: // a byte
        if (at < length)
            text[at] = (uint8_t)draw(256);
        break;
    case 2: // take out
        memmove(text + at, text + at + span, length - at - span);
        length -= span;
        break;
    case 3: // double elsewhere
        memcpy(copy, text + at, span);
        insert(draw(length + 1), copy, span);
        break;
    case 4: // a run
        memset(copy, at < length ? text[at] : ' ', sizeof copy);
        for (size_t i = draw(20) ? 1 : 400; i > 0; i--)
            insert(at, copy, sizeof copy);
        break;
    default: {
        const char *const piece = pieces[draw(sizeof pieces / sizeof pieces[0])];
        insert(at, piece, strlen(piece));
    }
    }
}

static void load(const char *path) {
    FILE *const f = fopen(path, "rb");
    if (!f) {
        perror(path);
        exit(2);
    }
    length = fread(text, 1, ROOM / 2, f);
    fclose(f);
}

int main(int argc, char **argv) {
    if (argc < 3)
        return 2;
    const long rounds = atol(argv[1]);
    for (long i = 0; i < rounds; i++) {
        load(argv[2 + i % (argc - 2)]);
        for (size_t n = i < argc - 2 ? 0 : 1 + draw(draw(4) ? 3 : 30); n > 0; n--)
            change();
        LLVMFuzzerTestOneInput(text, length);
    }
    printf("figure: %s: %ld changed files, nothing found\n", argv[0], rounds);
    return 0;
}
