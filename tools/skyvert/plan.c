/// skyvert plan: the cheapest sky that is good enough for a scene.
#include <getopt.h>
#include <string.h>

#include "command.h"
#include "tools/plan/report.h"

#define NAME "plan"

enum { OPT_SCENE = 256, OPT_ERROR, OPT_VERTICES, OPT_TARGET, OPT_BUDGET, OPT_RATE, OPT_OUT };

static const struct option long_options[] = {{"scene", required_argument, NULL, OPT_SCENE},
                                             {"max-error", required_argument, NULL, OPT_ERROR},
                                             {"vertices", required_argument, NULL, OPT_VERTICES},
                                             {"target", required_argument, NULL, OPT_TARGET},
                                             {"budget-us", required_argument, NULL, OPT_BUDGET},
                                             {"instructions-per-us", required_argument, NULL, OPT_RATE},
                                             {"out", required_argument, NULL, OPT_OUT},
                                             {"help", no_argument, NULL, 'h'},
                                             {"version", no_argument, NULL, 'V'},
                                             {NULL, 0, NULL, 0}};

// clang-format off
static const char help[] =
    "usage: skyvert plan --scene FILE.ini --max-error E --vertices N --target T [OPTION...]\n\n"
    "The cheapest configuration of the library whose error stays below a bound over a scene's ranges, what it costs on\n"
    "a target, what it drops, and a skv_config.h that compiles just that.\n"
    "  --scene FILE.ini       the scene, below\n"
    "  --max-error E          2% or 0.02: what 19 of 20 directions stay within, .1% to 100%. Error: the largest of\n"
    "                         linear red, green and blue over the brightest of the three, which counts as at least a\n"
    "                         twentieth of its frame's mean; against all orders of scattering, by path tracing\n"
    "  --vertices N           of the dome, 1 to 1000000\n"
    "  --target T             x86-avx2, x86-sse2 (gcc -O3), cortex-m4f, cortex-m7, cortex-a53 (gcc -O2)\n"
    "  --budget-us N          microseconds a frame may take\n"
    "  --instructions-per-us N  how fast the target is (x86: measured when the counts were made; else assumed)\n"
    "  --out DIR              where skv_config.h goes (default: here)\n\n"
    "A scene file (one number, or two for a range):\n"
    "  [planet]    preset = earth-clear, earth-hazy, earth-thin, earth-dense, earth-x25, earth-smoke, mars, titan, tiny or\n"
    "              giant; or atmosphere = FILE.ini\n"
    "  [observer]  height_m = LOW, HIGH (above the sea); ground_m (0)\n"
    "  [sun]       elevation_deg = LOW, HIGH\n"
    "  [air]       visibility_km = LOW, HIGH (default: as the planet's air is)\n"
    "  [view]      elevation_deg = LOW, HIGH of the directions drawn; terrain = yes or no: the ground is lit, and a\n"
    "              share of the vertices lies on mountains (terrain_share, default .2; terrain_km = NEAR, FAR, default\n"
    "              1, 40); stars = yes or no: transmittance is wanted\n\n"
    "Exit status: 0 done; 1 nothing fits (the report says which bound fails and by how much; no header), or the job failed;\n"
    "2 bad input.\n";
// clang-format on

typedef struct plan_options {
    const char *scene, *out;
    bool error, vertices, target, rate;
    plan_ask ask;
} plan_options;

static int take_error(plan_options *o, const char *text) {
    char number[64];
    double value;
    const size_t n = strlen(text);
    const bool percent = n > 0 && n < sizeof number && text[n - 1] == '%';
    snprintf(number, sizeof number, "%.*s", (int)(percent ? n - 1 : n), text);
    if (!parse_number(number, &value) || (value *= percent ? 0.01 : 1) < 0.001 || value > 1)
        return fail_usage("skyvert plan: --max-error %.60s: allowed is 0.1%% to 100%%, or a fraction of 1", text);
    o->ask.max_error = value;
    o->error = true;
    return 0;
}

static int take(plan_options *o, int c, char **argv) {
    int index = 0, status;
    switch (c) {
    case OPT_SCENE:
        o->scene = optarg;
        return 0;
    case OPT_ERROR:
        return take_error(o, optarg);
    case OPT_VERTICES:
        o->vertices = true;
        return option_integer(NAME, "--vertices", optarg, 1, 1000000, &o->ask.vertices);
    case OPT_TARGET:
        status = option_choice(NAME, "--target", optarg, plan_target_names, &index);
        o->ask.target = (plan_target)index;
        o->target = true;
        return status;
    case OPT_BUDGET:
        return option_number(NAME, "--budget-us", optarg, 1e-3, 1e12, &o->ask.budget_us);
    case OPT_RATE:
        o->rate = true;
        return option_number(NAME, "--instructions-per-us", optarg, 0.001, 1e6, &o->ask.per_us);
    case OPT_OUT:
        o->out = optarg;
        return 0;
    default:
        return option_unknown(NAME, c, argv);
    }
}

static int settle(plan_options *o) {
    if (!o->scene)
        return fail_usage("skyvert plan: --scene FILE.ini is missing (skyvert plan --help)");
    if (!o->error)
        return fail_usage("skyvert plan: --max-error is missing: 0.1%% to 100%%");
    if (!o->vertices)
        return fail_usage("skyvert plan: --vertices is missing: 1 to 1000000");
    if (!o->target)
        return fail_usage("skyvert plan: --target is missing: x86-avx2, x86-sse2, cortex-m4f, cortex-m7 or cortex-a53");
    if (!o->rate)
        o->ask.per_us = plan_rate_of(o->ask.target);
    return 0;
}

/// What the planner cannot say anything about.
static int refuse(const plan_options *o, const plan_scene *scene) {
    skv_atmosphere air;
    skv_model model;
    skv_colour_matrix matrix;
    plan_air(scene, 0, 4, &air);
    for (int i = 0; i < plan_airs(scene); i++) {
        plan_air(scene, i, 4, &air);
        if (skv_model_build(&model, &air) != SKV_OK)
            return fail_usage("%.200s: the library refuses this air", o->scene);
        if (!model.chapman_valid)
            return fail_usage("%.200s: this planet is too small for the closed forms (a scale height is over 1/100 of "
                              "its radius): it has no plan; allowed are larger ones",
                              o->scene);
    }
    if (skv_colour_matrix_for(&matrix, air.bands, air.wavelength_nm, air.solar_irradiance) != SKV_OK)
        return fail_usage("%.200s: no colours without a band from 380 to 780 nm that the sun shines in", o->scene);
    if (0.001 * scene->ground_m >= (double)air.top_km)
        return fail_usage("%.200s: ground_m: allowed is below the top of the air, %g km", o->scene, (double)air.top_km);
    return 0;
}

/// Only names without folders: the header is to be the same whoever makes it.
static void describe(const plan_options *o, char *text, size_t size) {
    const char *const slash = strrchr(o->scene, '/');
    snprintf(text, size, "skyvert plan --scene %.80s --max-error %g%% --vertices %d --target %s",
             slash ? slash + 1 : o->scene, 100 * o->ask.max_error, o->ask.vertices, plan_target_names[o->ask.target]);
}

/// The file is opened before the search: a name that cannot be written fails before the work.
static int plan(const plan_options *o, const plan_scene *scene) {
    static plan_answer answer;
    char path[4096], command[300];
    output header;
    const int length = snprintf(path, sizeof path, "%s/skv_config.h", o->out);
    if (length < 0 || (size_t)length >= sizeof path)
        return fail_usage("skyvert plan: --out: the name is too long");
    int status = output_open(&header, path);
    if (status != 0)
        return status;
    const skv_status searched = plan_search(scene, &o->ask, &answer);
    if (searched != SKV_OK) {
        output_discard(&header);
        return searched == SKV_ERR_UNSUPPORTED
                   ? fail_usage("%.200s: no configuration of this air was counted for the target", o->scene)
                   : fail_job("skyvert plan: the library refuses this scene or memory ran out (status %d)",
                              (int)searched);
    }
    plan_report(stdout, scene, &o->ask, &answer);
    if (answer.verdict != PLAN_FITS) {
        output_discard(&header);
        status = output_finish_stdout();
        return status != 0 ? status : EXIT_JOB;
    }
    describe(o, command, sizeof command);
    plan_header(header.stream, scene, &o->ask, &answer, command);
    status = output_commit(&header);
    return status != 0 ? status : output_finish_stdout();
}

int cmd_plan(int argc, char **argv) {
    plan_options options = {.out = "."};
    plan_scene scene;
    int status = 0;
    for (int c; status == 0 && (c = getopt_long(argc, argv, ":hV", long_options, NULL)) != -1;) {
        if (c == 'h') {
            printf("%s", help);
            return output_finish_stdout();
        }
        if (c == 'V')
            return option_version();
        status = take(&options, c, argv);
    }
    if (status == 0)
        status = option_no_more(NAME, argc, argv);
    if (status == 0)
        status = settle(&options);
    if (status == 0)
        status = plan_scene_load(&scene, options.scene);
    if (status != 0)
        return status;
    status = refuse(&options, &scene);
    if (status == 0)
        status = plan(&options, &scene);
    plan_scene_free(&scene);
    return status;
}
