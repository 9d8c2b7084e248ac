/// IEEE 754 binary16.
#include <string.h>

#include "common.h"

uint16_t baseline_to_half(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    const uint32_t sign = bits >> 16 & 0x8000u, size = bits & 0x7fffffffu;
    if (size > 0x7f800000u)
        return (uint16_t)(sign | 0x7e00u); // NaN
    if (size >= 0x477ff000u)
        return (uint16_t)(sign | 0x7c00u); // 65520 and more round to infinity
    if (size < 0x38800000u) {              // below 2^-14: a multiple of 2^-24
        float magnitude;
        memcpy(&magnitude, &size, sizeof magnitude);
        const float shifted = magnitude + 0.5f; // whose last bit is 2^-24
        uint32_t rounded;
        memcpy(&rounded, &shifted, sizeof rounded);
        return (uint16_t)(sign | (rounded - 0x3f000000u));
    }
    const uint32_t odd = size >> 13 & 1u;
    return (uint16_t)(sign | ((size - 0x38000000u + 0xfffu + odd) >> 13));
}
