/// A small generator, seeded by each test: the same sample on every machine.
#ifndef TESTS_API_RANDOM_H
#define TESTS_API_RANDOM_H

#include <math.h>
#include <stdint.h>
#include <string.h>

/// Cases to run: fewer on a microcontroller under emulation.
#if defined(SKV_TEST_SMALL)
#define CASES(n)     ((n) / 50 + 1)
#define SMALL_TARGET 1
#else
#define CASES(n)     (n)
#define SMALL_TARGET 0
#endif

static uint32_t random_state = 1;

/// xorshift32
static inline uint32_t random_word(void) {
    random_state ^= random_state << 13;
    random_state ^= random_state >> 17;
    random_state ^= random_state << 5;
    return random_state;
}

static inline double random_in(double lo, double hi) {
    return lo + (hi - lo) * (double)random_word() / 4294967295.0;
}

static inline int random_int(int lo, int hi) {
    return lo + (int)(random_word() % (uint32_t)(hi - lo + 1));
}

/// Any float at all: NaN, infinities, subnormals.
static inline float random_float(void) {
    const uint32_t w = random_word();
    float x;
    memcpy(&x, &w, sizeof x);
    return x;
}

/// A unit vector, uniform on the sphere.
static inline void random_direction(double v[3]) {
    const double z = random_in(-1, 1), a = random_in(0, 6.283185307179586), r = sqrt(1 - z * z);
    v[0] = r * cos(a);
    v[1] = r * sin(a);
    v[2] = z;
}

#endif
