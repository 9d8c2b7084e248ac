/// The checksum of tests/bits: parts, each a hash of the bits of what it computed, and random numbers that are the same
/// on every target.
#ifndef TESTS_BITS_H
#define TESTS_BITS_H

#include <stddef.h>
#include <stdint.h>

#include "skyvert/atmosphere.h"

/// One for all parts: a board has no room for one each.
extern skv_model bits_model;

/// How much a part computes: the small selection fits a microcontroller under emulation; all targets run it.
typedef enum bits_scale { BITS_SMALL = 0, BITS_FULL = 1 } bits_scale;

/// What a value has to be. A value that is not makes the program fail: the bits may be equal and still be wrong.
typedef enum bits_kind { BITS_ANY = 0, BITS_FINITE = 1, BITS_NOT_NEGATIVE = 2 } bits_kind;

void bits_begin(const char *scale, const char *part);
void bits_end(void);
void bits_word(uint32_t word);
void bits_float(float value, bits_kind kind);
void bits_floats(const float *value, size_t n, bits_kind kind);

/// xorshift32: the next of a part's numbers (each part begins with the same seed).
uint32_t bits_random(void);
/// Uniform in [low, high), exact arithmetic but for one product and one sum.
float bits_uniform(float low, float high);
/// Product of two of them: small numbers more often. (Two calls in one expression would come in the compiler's order.)
float bits_product(float low, float high, float most);
/// One of n.
uint32_t bits_pick(uint32_t n);
/// A direction that is not zero, at times a special one (zenith, nadir, horizon), not normalised.
void bits_direction(float direction[3]);

/// Whether values below 2^-100 count as 0: what is packed of them may differ then.
int bits_tiny_is_zero(void);

void bits_elementary(bits_scale scale);
void bits_models(bits_scale scale);
void bits_radiance(bits_scale scale);
void bits_scene(bits_scale scale);
void bits_display(bits_scale scale);
void bits_lights(bits_scale scale);
void bits_tables(bits_scale scale);

#endif
