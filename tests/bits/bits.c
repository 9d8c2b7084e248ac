/// One checksum over everything the library computes, and one per part so that a difference can be located.
///
///   bits [--tiny-is-zero] [--flush] [--round up|down|zero]
///
/// Options (x86): --flush and --round set flush-to-zero or a rounding mode as a host may have done: values stay finite
/// and not negative, the bits may differ. --tiny-is-zero counts values below 2^-96 (1e-29; sums of subnormal terms
/// change bits up to there) as 0, so that a run with
/// --flush can be compared with one without. Exit status 1 when a value was not what it has to be.
#include "bits.h"

#include <stdio.h>
#include <string.h>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

skv_model bits_model;

static uint64_t hash, total;
static uint32_t state;
static char name[48];
static unsigned long wrong;
static int tiny_is_zero;

/// printf is not the same everywhere, and large where flash is short.
static void print_hash(const char *what, uint64_t h) {
    char text[17];
    for (int i = 0; i < 16; ++i)
        text[i] = "0123456789abcdef"[h >> (60 - 4 * i) & 15];
    text[16] = 0;
    fputs(what, stdout);
    fputs(" ", stdout);
    puts(text);
}

/// Built with -DBITS_TRACE the program prints every word too: diff two outputs to find the first that differs.
static void trace(uint32_t word) {
#if defined(BITS_TRACE)
    print_hash(name, word);
#else
    (void)word;
#endif
}

static void mix(uint64_t *h, uint32_t word) {
    *h = (*h ^ word) * 0x100000001B3u; // FNV-1a by words
    *h ^= *h >> 32;
}

void bits_begin(const char *scale, const char *part) {
    strcpy(name, scale);
    strcat(name, ".");
    strcat(name, part);
    hash = 0xCBF29CE484222325u;
    state = 2463534242u;
}

void bits_end(void) {
    print_hash(name, hash);
    mix(&total, (uint32_t)hash);
    mix(&total, (uint32_t)(hash >> 32));
}

void bits_word(uint32_t word) {
    trace(word);
    mix(&hash, word);
}

void bits_float(float value, bits_kind kind) {
    uint32_t word;
    memcpy(&word, &value, sizeof word);
    const int finite = (word >> 23 & 255) != 255;
    if ((kind != BITS_ANY && !finite) || (kind == BITS_NOT_NEGATIVE && value < 0.0f)) {
        if (wrong++ < 5)
            print_hash(name, word), puts("^ wrong: a value that is negative, infinite or NaN (its bits)");
    }
    bits_word(tiny_is_zero && (word >> 23 & 255) < 127 - 96 ? 0 : word);
}

void bits_floats(const float *value, size_t n, bits_kind kind) {
    for (size_t i = 0; i < n; ++i)
        bits_float(value[i], kind);
}

int bits_tiny_is_zero(void) {
    return tiny_is_zero;
}

uint32_t bits_random(void) {
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state;
}

float bits_uniform(float low, float high) {
    const float unit = (float)(bits_random() >> 8) * (1.0f / 16777216.0f);
    return low + (high - low) * unit;
}

float bits_product(float low, float high, float most) {
    const float first = bits_uniform(low, high);
    return first * bits_uniform(0.0f, most);
}

uint32_t bits_pick(uint32_t n) {
    return (uint32_t)((uint64_t)bits_random() * n >> 32);
}

void bits_direction(float direction[3]) {
    static const float special[8][3] = {{0, 0, 1},      {0, 0, -1},          {1, 0, 0},         {0, -3, 0},
                                        {1, 1, -0.02f}, {0, 1e-20f, 1e-20f}, {2e18f, 0, 1e18f}, {0.6f, 0.8f, 1e-4f}};
    if (bits_pick(8) == 0) {
        memcpy(direction, special[bits_pick(8)], 3 * sizeof *direction);
        return;
    }
    for (int i = 0; i < 3; ++i)
        direction[i] = bits_uniform(-1.0f, 1.0f);
    if (bits_pick(2) == 0)
        direction[2] *= 0.05f; // near the horizon, where the rays are long
    direction[0] += direction[0] >= 0.0f ? 0.01f : -0.01f;
}

static void run(bits_scale scale) {
    bits_elementary(scale);
#if !defined(BITS_ELEMENTARY_ONLY)
    bits_models(scale);
    bits_radiance(scale);
    bits_scene(scale);
    bits_display(scale);
    bits_lights(scale);
    bits_tables(scale);
#endif
}

#if defined(__x86_64__)
/// 0 when the option is not known.
static int set_host_mode(int argc, char **argv) {
    for (int i = 1; i < argc; ++i) {
        if (strcmp(argv[i], "--tiny-is-zero") == 0)
            tiny_is_zero = 1;
        else if (strcmp(argv[i], "--flush") == 0)
            _mm_setcsr(_mm_getcsr() | 0x8040); // flush to zero, denormals are zero
        else if (strcmp(argv[i], "--round") == 0 && i + 1 < argc && strchr("udz", argv[i + 1][0]) != NULL) {
            const char mode = argv[++i][0];
            _MM_SET_ROUNDING_MODE(mode == 'u' ? _MM_ROUND_UP : mode == 'd' ? _MM_ROUND_DOWN : _MM_ROUND_TOWARD_ZERO);
        } else {
            return 0;
        }
    }
    return 1;
}
#else
static int set_host_mode(int argc, char **argv) {
    (void)argv;
    return argc <= 1;
}
#endif

static int run_all(void) {
    total = 0xCBF29CE484222325u;
    run(BITS_SMALL);
    print_hash("small", total);
#if !defined(SKV_TEST_SMALL)
    run(BITS_FULL);
    print_hash("all", total);
#endif
    return wrong == 0 ? 0 : 1;
}

#if defined(SKV_TEST_SMALL)
int main(void) {
    (void)set_host_mode;
    return run_all();
}
#else
int main(int argc, char **argv) {
    if (!set_host_mode(argc, argv)) {
        fputs("usage: bits [--tiny-is-zero] [--flush] [--round up|down|zero]\n", stderr);
        return 2;
    }
    return run_all();
}
#endif
