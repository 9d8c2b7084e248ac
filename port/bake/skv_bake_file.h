/// Reads what `skyvert bake` wrote: a raw16f file, or the text in an EXR's attribute "skyvert.bake". Needs the C
/// library.
///
/// raw16f: lines `key = value` and comments (#) from "skyvert-bake 1" to "end", blanks up to data_offset bytes, then
/// the texels as IEEE 754 binary16, little-endian, [layer][z][y][x][channel].
#ifndef SKV_PORT_BAKE_FILE_H
#define SKV_PORT_BAKE_FILE_H

#include <stdlib.h>
#include <string.h>

#include "skv_bake.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Text behind `key = ` at the start of a line; NULL: no such line before "end".
static inline const char *skv_bake_value(const char *text, const char *key) {
    const size_t n = strlen(key);
    for (const char *line = text; line && strncmp(line, "end\n", 4) != 0;) {
        if (strncmp(line, key, n) == 0 && strncmp(line + n, " = ", 3) == 0)
            return line + n + 3;
        line = strchr(line, '\n');
        line = line ? line + 1 : NULL;
    }
    return NULL;
}

static inline float skv_bake_number(const char *text, const char *key) {
    const char *const value = skv_bake_value(text, key);
    return value ? strtof(value, NULL) : 0.0f;
}

static inline int32_t skv_bake_whole(const char *text, const char *key) {
    const char *const value = skv_bake_value(text, key);
    const long x = value ? strtol(value, NULL, 10) : 0;
    return x >= -1 && x <= 1 << 24 ? (int32_t)x : -1;
}

/// Index of the word in `words` that a value is, -1 where it is none.
static inline int32_t skv_bake_word(const char *text, const char *key, const char *const words[], int32_t n) {
    const char *const value = skv_bake_value(text, key);
    for (int32_t i = 0; value && i < n; i++)
        if (strncmp(value, words[i], strlen(words[i])) == 0 && value[strlen(words[i])] == '\n')
            return i;
    return -1;
}

/// The numbers of a table without its texels, from text that ends in NUL.
/// @return 0; -1 iff it is no such text, or one with sizes that cannot be.
static inline int skv_bake_parse(const char *text, skv_bake_table *t) {
    static const char *const what[] = {"sky-view", "transmittance", "scattering-3d", "irradiance"};
    static const char *const phase[] = {"henyey-greenstein", "cornette-shanks"};
    static const char *const phase_of[] = {"phase_1", "phase_2"}, *const g_of[] = {"g_1", "g_2"};
    static const char *const scale[] = {"scale_0", "scale_1", "scale_2", "scale_3"};
    memset(t, 0, sizeof *t);
    if (strncmp(text, "skyvert-bake 1\n", 15) != 0)
        return -1;
    t->what = skv_bake_word(text, "what", what, 4);
    t->width = skv_bake_whole(text, "width");
    t->height = skv_bake_whole(text, "height");
    t->depth = skv_bake_whole(text, "depth");
    t->layers = skv_bake_whole(text, "layers");
    t->channels = skv_bake_whole(text, "channels");
    t->azimuths = skv_bake_whole(text, "azimuths");
    t->deferred = skv_bake_whole(text, "deferred");
    int phases = t->deferred >= 0 && t->deferred <= SKV_BAKE_DEFERRED_MAX && t->deferred < t->layers;
    for (int32_t l = 0; phases && l < t->deferred; l++) {
        t->phase[l] = skv_bake_word(text, phase_of[l], phase, 2);
        t->g[l] = skv_bake_number(text, g_of[l]);
        phases = t->phase[l] >= 0 && fabsf(t->g[l]) < 1.0f;
    }
    t->radius_km = skv_bake_number(text, "radius_km");
    t->top_km = skv_bake_number(text, "top_km");
    t->height_km = skv_bake_number(text, "height_km");
    t->mu_s = skv_bake_number(text, "mu_s");
    t->mu_s_min = skv_bake_number(text, "mu_s_min");
    for (int32_t l = 0; l < SKV_BAKE_LAYERS_MAX; l++)
        t->scale[l] = l < t->layers ? skv_bake_number(text, scale[l]) : 1.0f;
    const int sizes = t->width >= 2 && t->height >= 2 && t->depth >= 1 && t->width <= 65536 && t->height <= 65536 &&
                      t->depth <= 4096 && t->layers >= 1 && t->layers <= SKV_BAKE_LAYERS_MAX && t->channels >= 3 &&
                      t->channels <= 4 && t->azimuths >= 1 && t->width % t->azimuths == 0 && phases;
    const int numbers =
        t->what >= 0 && t->radius_km > 0.0f && t->top_km > 0.0f && t->mu_s_min < 1.0f && t->mu_s_min > -1.0f;
    const int three =
        t->what != SKV_BAKE_SCATTERING || (t->azimuths >= 2 && t->width >= 2 * t->azimuths && t->depth >= 2);
    int scales = 1;
    for (int32_t l = 0; l < SKV_BAKE_LAYERS_MAX; l++)
        scales = scales && t->scale[l] > 0.0f;
    return sizes && numbers && three && scales ? 0 : -1;
}

/// A raw16f file in memory, aligned to 2; its texels are used where they are.
/// @return 0; -1 iff it is no such file or shorter than it says; -2 iff this machine is big-endian: swap the texels.
static inline int skv_bake_open(const void *bytes, size_t n, skv_bake_table *t) {
    const char *const text = (const char *)bytes;
    const uint16_t one = 1;
    uint8_t low;
    const char *end = NULL;
    for (size_t i = 0; i + 5 <= n && i < 65536 && !end; i++)
        end = memcmp(text + i, "\nend\n", 5) == 0 ? text + i : NULL;
    if (!end || skv_bake_parse(text, t) != 0)
        return -1;
    const int32_t offset = skv_bake_whole(text, "data_offset");
    const uint64_t texels = (uint64_t)t->layers * (uint64_t)t->width * (uint64_t)t->height * (uint64_t)t->depth *
                            (uint64_t)t->channels * sizeof(uint16_t);
    if (offset < (int32_t)(end - text) + 5 || offset % 2 != 0 || (size_t)offset > n || n - (size_t)offset < texels)
        return -1;
    t->half = (const uint16_t *)(const void *)(text + offset);
    memcpy(&low, &one, 1);
    return low == 1 ? 0 : -2;
}

#ifdef __cplusplus
}
#endif
#endif
