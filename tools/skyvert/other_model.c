#include "other_model.h"

#include <string.h>
#include <unistd.h>

#include "command.h"
#include "scene.h"

enum { MODELS_MAX = 16, THREADS_MAX = 8, PERMILLE = 1000 };

/// An item of a list, broken at blanks before column 100.
static void print_wrapped(const char *text) {
    enum { INDENT = 25, WIDTH = 97 - INDENT };
    for (int line = 0; *text; line++) {
        size_t n = strlen(text);
        if (n > WIDTH)
            for (n = WIDTH; n > 0 && text[n] != ' ';)
                n--;
        if (n == 0)
            n = strlen(text);
        printf("%*s%s%.*s\n", INDENT, "", line ? "  " : "", (int)n, text);
        text += n;
        while (*text == ' ')
            text++;
    }
}

void other_options_print_help(void) {
    printf("Other models, for comparison (no discs, moon, night or sea; the ground at the sea's height):\n"
           "  --model NAME           skyvert (default), or one that was written from its paper:\n");
    for (const baseline *const *b = baselines; *b; b++) {
        char text[400];
        snprintf(text, sizeof text, "%s: %s%s%s", (*b)->name, (*b)->title, (*b)->cannot[0] ? ". Note: " : "",
                 (*b)->cannot);
        print_wrapped(text);
    }
    printf("  --model-cache DIR      keeps tables that take long to build (elek09: 7 MB, some 10 s) in this\n"
           "                         folder; it is made if it is not there\n");
}

void other_options_begin(other_options *options, const char *command) {
    *options = (other_options){.command = command};
}

static int take_model(other_options *options, const char *value) {
    const char *names[MODELS_MAX + 2] = {"skyvert"};
    int index = 0;
    for (int i = 0; i < MODELS_MAX && baselines[i]; i++)
        names[i + 1] = baselines[i]->name;
    const int status = option_choice(options->command, "--model", value, names, &index);
    options->model = status == 0 && index > 0 ? baselines[index - 1] : NULL;
    return status;
}

int other_options_take(other_options *options, int option, const char *value) {
    if (option == OPT_MODEL)
        return take_model(options, value);
    if (option != OPT_MODEL_CACHE)
        return -1;
    if (value[0] == '\0')
        return fail_usage("skyvert %s: --model-cache: the name of a folder is needed", options->command);
    options->cache = value;
    return 0;
}

int other_options_finish(other_options *options, sky_options *sky) {
    if (!options->model)
        return 0;
    const char *const command = options->command, *const name = options->model->name;
    if (sky->water)
        return fail_usage("skyvert %s: --model %s has no sea: --ground land or none", command, name);
    if (sky->ground_m < 0.0 || sky->ground_m > 0.0)
        return fail_usage("skyvert %s: --model %s: --ground-m %g: the ground lies at 0", command, name, sky->ground_m);
    if (sky->light.moon == CHOICE_ON || sky->light.night == CHOICE_ON)
        return fail_usage("skyvert %s: --model %s has no moon and no night: --moon and --night off or auto", command,
                          name);
    options->all = sky->light.orders != 0;
    sky->light.orders = 0;
    sky->light.discs = sky->light.moon = sky->light.night = CHOICE_OFF;
    return 0;
}

/// What this one lacks. @return 0; 2 after an error line.
static int refuse_place(const other_options *options, const scene *view, const float sun[3]) {
    const baseline *const model = options->model;
    if (!(model->can & BASELINE_SPACE) && view->observer_km > (double)view->model.top_km)
        return fail_usage("skyvert %s: --model %s cannot look from above the air, %g m", options->command, model->name,
                          1000.0 * (double)view->model.top_km);
    if (!(model->can & BASELINE_TWILIGHT) && sun[2] < 0.0f)
        return fail_usage("skyvert %s: --model %s knows no sun below the horizon", options->command, model->name);
    return 0;
}

static int show(void *context, double done) {
    (void)context;
    progress_update((size_t)(PERMILLE * done));
    return 0;
}

static int build(other_model *other, const other_options *options, const scene *view, const char **why) {
    const sky_options *const sky = view->options;
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    const baseline_wants wants = {.all = options->all,
                                  .lit_ground = sky->ground_lit,
                                  .threads = processors < 1             ? 1
                                             : processors > THREADS_MAX ? THREADS_MAX
                                                                        : (int)processors,
                                  .progress = view->progress ? show : NULL,
                                  .cache = options->cache};
    // The scene's own sphere and the sun at its distance.
    skv_atmosphere air = sky->atmosphere;
    air.radius_km = view->model.radius_km;
    memcpy(air.solar_irradiance, view->light[0].irradiance, sizeof air.solar_irradiance);
    if (view->progress)
        progress_begin(options->model->name, PERMILLE);
    const int status = options->model->build(&other->state, &air, &wants, &other->cost, why);
    if (view->progress)
        progress_end();
    return status;
}

int other_model_begin(other_model *other, const other_options *options, const scene *view, const float sun[3]) {
    const char *const command = options->command, *const name = options->model->name;
    const char *why = "";
    *other = (other_model){.is = options->model, .all = options->all && (options->model->can & BASELINE_ALL)};
    int status = refuse_place(options, view, sun);
    if (status != 0)
        return status;
    status = build(other, options, view, &why);
    if (status == -2)
        return fail_usage("skyvert %s: --model %s: this air is beyond it: %s", command, name, why);
    if (status != 0)
        return fail_job("skyvert %s: --model %s: no memory", command, name);
    const baseline_view seen = {.observer_km = view->observer_km,
                                .sun_enu = {(double)sun[0], (double)sun[1], (double)sun[2]}};
    if (options->model->frame(other->state, &seen, &why) == 0)
        return 0;
    other_model_end(other);
    return fail_usage("skyvert %s: --model %s: this view is beyond it: %s", command, name, why);
}

void other_model_end(other_model *other) {
    if (other->state)
        other->is->release(other->state);
    other->state = NULL;
}

char *other_model_describe(const other_model *other, char *text, size_t size) {
    snprintf(text, size, "%s (%s), %s", other->is->name, other->is->title,
             other->all ? "all its orders of scattering" : "light scattered once");
    return text;
}

void other_model_radiance(const other_model *other, size_t n, const float *direction_enu, size_t bands,
                          float *radiance) {
    enum { BATCH = 256 };
    float direction[BATCH][3], all[BATCH][4];
    for (size_t first = 0; first < n; first += BATCH) {
        const size_t count = n - first < BATCH ? n - first : BATCH;
        memcpy(direction, direction_enu + 3 * first, count * sizeof direction[0]);
        other->is->radiance(other->state, count, (const float(*)[3])direction, all);
        for (size_t i = 0; i < count; i++)
            memcpy(radiance + bands * (first + i), all[i], bands * sizeof(float));
    }
}
