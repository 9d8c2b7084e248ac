/// A published model (tools/baselines) that draws instead of the core, for comparison.
#ifndef SKYVERT_OTHER_MODEL_H
#define SKYVERT_OTHER_MODEL_H

#include <getopt.h>
#include <stdbool.h>

#include "tools/baselines/baseline.h"

struct scene;
struct sky_options;

typedef struct other_options {
    const char *command;   ///< for error lines
    const baseline *model; ///< NULL: the core
    const char *cache;     ///< folder; NULL: none
    bool all;              ///< all the orders it has; settled by other_options_finish()
} other_options;

enum { OPT_MODEL = 1500, OPT_MODEL_CACHE };

// clang-format off
#define OTHER_OPTIONS_LONG                                                                                             \
    {"model", required_argument, NULL, OPT_MODEL}, {"model-cache", required_argument, NULL, OPT_MODEL_CACHE}
// clang-format on

/// Lines of --help, with the list of the models.
void other_options_print_help(void);
void other_options_begin(other_options *options, const char *command);
/// Takes one option. @return 0; 2 after an error line; -1 iff it is none of these.
int other_options_take(other_options *options, int option, const char *value);
/// Checks them together with those of the sky, and turns off in those what the core would do in vain.
/// @return 0; 2 after an error line.
int other_options_finish(other_options *options, struct sky_options *sky);

typedef struct other_model {
    const baseline *is;
    void *state;
    baseline_cost cost;
    bool all;
} other_model;

/// Builds what the options name for a scene that has begun. Afterwards scene->other may point to it.
/// @return 0, or a status after an error line; then nothing to release.
int other_model_begin(other_model *other, const other_options *options, const struct scene *view, const float sun[3]);
void other_model_end(other_model *other);
/// A few words for a picture's comment. @return text
char *other_model_describe(const other_model *other, char *text, size_t size);

/// Radiance towards n directions, [n][bands] W m^-2 sr^-1 nm^-1.
void other_model_radiance(const other_model *other, size_t n, const float *direction_enu, size_t bands,
                          float *radiance);

#endif
