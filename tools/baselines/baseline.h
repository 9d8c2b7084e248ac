/// Published sky models beside ours: each written from its paper, for comparison only.
///
/// A baseline sees the atmosphere that the library is given and answers what the library answers: radiance per
/// direction for the air's solar irradiance, no discs. Where a paper's printed form has a slip the corrected form is
/// the baseline; the literal one is a row of its own (`literal`), where it differs.
///
/// Papers leave things out: species a paper does not have are named in `cannot`, and the comparison says so.
#ifndef TOOLS_BASELINES_BASELINE_H
#define TOOLS_BASELINES_BASELINE_H

#include <stddef.h>

#include "skyvert/atmosphere.h"

/// What a baseline can do.
enum {
    BASELINE_SINGLE = 1,   ///< light scattered once
    BASELINE_ALL = 2,      ///< light of higher orders
    BASELINE_GROUND = 4,   ///< rays that end on the ground show it
    BASELINE_SPACE = 8,    ///< observers above the air
    BASELINE_TWILIGHT = 16 ///< suns below the horizon
};

/// What is asked for.
typedef struct baseline_wants {
    int all;        ///< 1: all the orders it has; 0: light scattered once
    int lit_ground; ///< 1: with the light of the ground at the ray's end
    int threads;    ///< of the build, >= 1
    /// Called now and then during a build with what is done of it, 0 to 1; a result other than 0 stops the build.
    int (*progress)(void *context, double done);
    void *context;
    const char
        *cache; ///< folder for tables that take minutes to build; NULL: none. Files there are checked, not trusted
} baseline_wants;

/// What a build made and took.
typedef struct baseline_cost {
    size_t table_bytes; ///< that the evaluation needs, as the paper stores them
    size_t work_bytes;  ///< while building
    double build_s;     ///< of all threads together, as measured when it was built (also when it came from the cache)
} baseline_cost;

typedef struct baseline_view {
    double observer_km; ///< altitude above the ground, >= 0
    double sun_enu[3];  ///< unit vector toward the sun; east, north, up
} baseline_view;

typedef struct baseline {
    const char *name;   ///< for --model: "elek09", "elek09-literal", ...
    const char *title;  ///< of its row: "Elek 2009, 32x256x32, six orders"
    const char *source; ///< citation with DOI or URL
    const char *slips;  ///< what is put right, or, in a literal row, what is not; one line
    int literal;        ///< 1: as printed
    unsigned can;       ///< BASELINE_*
    const char *cannot; ///< one line, e.g. "dust is left out"; "" = nothing
    /// @param[out] state  to be released. @return 0; 1 stopped by progress; -1 out of memory; -2 this air is beyond it
    /// (*why, constant text, says so; nothing is to be released after an error).
    int (*build)(void **state, const skv_atmosphere *air, const baseline_wants *wants, baseline_cost *cost,
                 const char **why);
    /// Work of a frame (textures of the sky and the like). @return 0; -2 beyond it (*why).
    int (*frame)(void *state, const baseline_view *view, const char **why);
    /// Radiance towards n unit directions, W m^-2 sr^-1 nm^-1, [n][4]. Thread-safe on one state after frame().
    void (*radiance)(const void *state, size_t n, const float (*direction_enu)[3], float (*radiance)[4]);
    void (*release)(void *state);
} baseline;

/// All of them, NULL at the end.
extern const baseline *const baselines[];

/// By name; NULL when there is none.
const baseline *baseline_find(const char *name);

#endif
