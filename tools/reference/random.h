/// Random numbers that depend on a key and a counter only, so that any thread may draw them in any order.
/// [Salmon11] Philox4x32-10; [Burley20] Owen scrambling by hashing, on the first five dimensions of Sobol's sequence
/// with the direction numbers of [JoeKuo08].
#ifndef TOOLS_REFERENCE_RANDOM_H
#define TOOLS_REFERENCE_RANDOM_H

#include <stdint.h>

typedef struct ref_random {
    uint32_t key[2], counter[4]; ///< counter: draws, path (2), user
    uint32_t block[4];
    int left;
} ref_random;

static inline void ref_philox(const uint32_t key[2], const uint32_t counter[4], uint32_t out[4]) {
    uint32_t a = counter[0], b = counter[1], c = counter[2], d = counter[3], k = key[0], l = key[1];
    for (int i = 0; i < 10; i++) {
        const uint64_t p = (uint64_t)0xD2511F53u * a, q = (uint64_t)0xCD9E8D57u * c;
        a = (uint32_t)(q >> 32) ^ b ^ k;
        b = (uint32_t)q;
        c = (uint32_t)(p >> 32) ^ d ^ l;
        d = (uint32_t)p;
        k += 0x9E3779B9u;
        l += 0xBB67AE85u;
    }
    out[0] = a, out[1] = b, out[2] = c, out[3] = d;
}

static inline ref_random ref_random_start(uint64_t key, uint64_t path) {
    return (ref_random){{(uint32_t)key, (uint32_t)(key >> 32)}, {0, (uint32_t)path, (uint32_t)(path >> 32), 0}, {0}, 0};
}

/// Uniform in (0, 1).
static inline double ref_uniform(ref_random *r) {
    if (r->left == 0) {
        ref_philox(r->key, r->counter, r->block);
        r->counter[0]++;
        r->left = 4;
    }
    return (r->block[--r->left] + 0.5) * 0x1p-32;
}

static inline uint32_t ref_reverse_bits(uint32_t x) {
    x = (x >> 1 & 0x55555555u) | (x & 0x55555555u) << 1;
    x = (x >> 2 & 0x33333333u) | (x & 0x33333333u) << 2;
    x = (x >> 4 & 0x0F0F0F0Fu) | (x & 0x0F0F0F0Fu) << 4;
    x = (x >> 8 & 0x00FF00FFu) | (x & 0x00FF00FFu) << 8;
    return x >> 16 | x << 16;
}

/// Point `index` of dimension 0 to 4, scrambled by `seed`. Uniform in (0, 1).
static inline double ref_sobol(uint32_t index, int dimension, uint32_t seed) {
    static const uint32_t odd[5][8] = {{1, 1, 1, 1, 1, 1, 1, 1}, // m of [JoeKuo08], eight bits: 256 points
                                       {1, 3, 5, 15, 17, 51, 85, 255},
                                       {1, 3, 3, 9, 29, 23, 71, 197},
                                       {1, 3, 1, 5, 31, 29, 81, 147},
                                       {1, 1, 1, 11, 31, 55, 61, 157}};
    uint32_t x = 0;
    for (int i = 0; i < 8; i++)
        if (index >> i & 1)
            x ^= odd[dimension][i] << (31 - i);
    x = ref_reverse_bits(x);
    x += seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return (ref_reverse_bits(x) + 0.5) * 0x1p-32;
}

#endif
