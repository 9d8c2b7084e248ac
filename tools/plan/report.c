#include "tools/plan/report.h"

#include <math.h>
#include <string.h>

#include "tools/plan/cost.h"

static const char *const light_names[] = {"light scattered once", "small table", "accurate table", "large table"};
static const struct {
    unsigned bit;
    const char *name, *macro;
} species[] = {{SKV_WITH_RAYLEIGH, "rayleigh", "SKV_TERM_RAYLEIGH"},
               {SKV_WITH_AEROSOL, "aerosol", "SKV_TERM_AEROSOL"},
               {SKV_WITH_DUST, "dust", "SKV_TERM_DUST"},
               {SKV_WITH_OZONE, "ozone", "SKV_TERM_OZONE"}};

static void say_scene(FILE *out, const plan_scene *s) {
    fprintf(out, "scene %s, observer %g to %g m, sun %g to %g deg", s->planet, s->height_m.low, s->height_m.high,
            s->sun_deg.low, s->sun_deg.high);
    if (s->visibility_km.low > 0)
        fprintf(out, ", visibility %g to %g km", s->visibility_km.low, s->visibility_km.high);
    fprintf(out, ", view %g to %g deg, %s, %s\n", s->view_deg.low, s->view_deg.high,
            s->terrain ? "terrain" : "no terrain", s->stars ? "stars" : "no stars");
}

static void say_config(FILE *out, const plan_config *c) {
    fprintf(out, "bands %d\nspecies", c->bands);
    for (int i = 0; i < 4; i++)
        if ((c->species & species[i].bit) != 0)
            fprintf(out, " %s", species[i].name);
    fprintf(out, "\nground %s\nlight %s%s\nrule gauss-exp\nsamples %d per lit leg\n", c->ground ? "lit" : "not lit",
            light_names[c->light],
            c->light == PLAN_SINGLE ? ""
            : c->grid               ? ", through a grid"
                                    : ", ray by ray",
            c->samples);
}

static void say_cost(FILE *out, const plan_ask *ask, const plan_candidate *c) {
    const plan_cost *const k = &c->cost;
    fprintf(out, "instructions %.0f per frame (mean over the ranges; dearest %.0f; %.0f per vertex", k->mean, k->worst,
            k->mean / ask->vertices);
    if (k->grid > 0)
        fprintf(out, "; the grid's making is %.0f of it", k->grid);
    fprintf(out, ")\ntime %.4g us per frame (dearest %.4g)\nrate %.0f instructions per us (%s)\n", c->us,
            k->worst / ask->per_us, ask->per_us,
            fabs(ask->per_us - plan_rate_of(ask->target)) < 1e-9 ? plan_rate_source(ask->target) : "as given");
    fprintf(out, "flash %ld bytes (the core's code and constants, -O%d)\n", k->flash,
            ask->target <= PLAN_X86_SSE2 ? 3 : 2);
    fprintf(out, "ram %ld bytes (model %ld, frame %ld, table %ld, grid %ld)\n",
            k->model + k->frame + k->table + k->grid_bytes, k->model, k->frame, k->table, k->grid_bytes);
    if (k->work > 0)
        fprintf(out, "work %ld bytes while a table is built\n", k->work);
    fprintf(out, "stack %ld bytes\n", k->stack);
}

static void say_change(FILE *out, const plan_ask *ask, const plan_change *c, const plan_candidate *chosen) {
    char left_out[32] = "not counted";
    const double saved = c->dropped ? c->other.cost.mean - chosen->cost.mean : chosen->cost.mean - c->other.cost.mean;
    if (c->other.cost.mean > 0)
        snprintf(left_out, sizeof left_out, "%.0f", saved);
    fprintf(out, "%-8s %-22s %8.2f %8.2f   %10.2f  %s%s\n", c->dropped ? "dropped" : "kept", plan_term_names[c->term],
            100 * c->change.mean, 100 * c->change.p95, 100 * c->other.promised, left_out,
            !c->dropped && c->other.promised <= ask->max_error ? "  (within the bound, yet dearer)" : "");
}

static void say_changes(FILE *out, const plan_ask *ask, const plan_answer *a) {
    fprintf(out, "\n%31s %17s   %10s  %s\n%31s %8s %8s   %10s  %s\n", "", "changes the light", "promise %",
            "instructions", "without kept, with dropped", "mean %", "95 % %", "then", "it costs");
    for (int i = 0; i < a->changes; i++)
        say_change(out, ask, &a->change[i], &a->chosen);
}

static void say_failure(FILE *out, const plan_ask *ask, const plan_answer *a) {
    if (a->verdict == PLAN_ERROR_TOO_LARGE)
        fprintf(out, "fails error: the best that can be promised is %.3g %%, %.3g %% is asked for: %.3g too much\n",
                100 * a->chosen.promised, 100 * ask->max_error, 100 * (a->chosen.promised - ask->max_error));
    else
        fprintf(out, "fails time: the cheapest within the error takes %.4g us, the budget is %.4g us: %.4g too much\n",
                a->chosen.us, ask->budget_us, a->chosen.us - ask->budget_us);
}

void plan_report(FILE *out, const plan_scene *scene, const plan_ask *ask, const plan_answer *a) {
    const plan_candidate *const c = &a->chosen;
    say_scene(out, scene);
    fprintf(out, "asked error %.4g %%, %d vertices on %s", 100 * ask->max_error, ask->vertices,
            plan_target_names[ask->target]);
    if (ask->budget_us > 0)
        fprintf(out, ", %.4g us", ask->budget_us);
    fprintf(out, "\n\n");
    say_config(out, &c->config);
    fprintf(out, "error %.3g %% promised: 19 of 20 directions are within it (expected %.3g; mean %.3g, largest %.3g)\n",
            100 * c->promised, 100 * c->error.p95, 100 * c->error.mean, 100 * c->error.max);
    say_cost(out, ask, c);
    if (a->distance > 1.2)
        fprintf(out, "note the model's own error was measured in other air than this: it may be larger\n");
    if (plan_general(scene, c->config.species))
        fprintf(out, "note profiles that are no plain exponentials cost more than counted here\n");
    if (a->changes > 0)
        say_changes(out, ask, a);
    if (a->verdict != PLAN_FITS) {
        fprintf(out, "\n");
        say_failure(out, ask, a);
    }
}

// --- the header ---

static bool phase_kept(const plan_scene *scene, unsigned kept, skv_phase phase) {
    skv_atmosphere air;
    plan_air(scene, 0, 4, &air);
    return ((kept & SKV_WITH_AEROSOL) != 0 && air.aerosol_phase == phase) ||
           ((kept & SKV_WITH_DUST) != 0 && air.dust_phase == phase);
}

static bool tabulated(const plan_scene *scene, unsigned kept) {
    skv_atmosphere air;
    plan_air(scene, 0, 4, &air);
    const skv_profile *const profile[3] = {&air.rayleigh, &air.aerosol, &air.dust};
    for (int s = 0; s < 3; s++)
        if ((kept >> s & 1u) != 0 && profile[s]->kind > SKV_PROFILE_EXP_BACKGROUND)
            return true;
    return false;
}

static void define(FILE *out, const char *name, int value) {
    fprintf(out, "#define %s %d\n", name, value);
}

static void compile_time(FILE *out, const plan_scene *scene, const plan_config *c) {
    define(out, "SKV_BANDS", c->bands);
    define(out, "SKV_RULE_UNIFORM", 0);
    define(out, "SKV_RULE_KELLER", 0);
    define(out, "SKV_DEPTH_INNER", 0);
    for (int i = 0; i < 4; i++)
        define(out, species[i].macro, (c->species & species[i].bit) != 0);
    define(out, "SKV_TERM_GROUND", c->ground);
    define(out, "SKV_TERM_DIFFUSE", c->light != PLAN_SINGLE);
    define(out, "SKV_OUT_TRANSMITTANCE", scene->stars || scene->terrain);
    const bool hg = phase_kept(scene, c->species, SKV_PHASE_HG), cs = phase_kept(scene, c->species, SKV_PHASE_CS);
    define(out, "SKV_PHASE_HENYEY_GREENSTEIN", hg);
    define(out, "SKV_PHASE_CORNETTE_SHANKS", cs || !hg);
    define(out, "SKV_PROFILE_TABULATED", tabulated(scene, c->species));
    define(out, "SKV_LIGHTS_MAX", 1);
}

static void run_time(FILE *out, const plan_config *c, const plan_cost *k) {
    fprintf(out, "\n/* For the program: skv_quality.samples and .terms, the kind of table, whether a grid pays.\n"
                 "   Species that are left out above must be left out of skv_atmosphere too: profile kind NONE. */\n");
    define(out, "SKV_PLAN_SAMPLES", c->samples);
    fprintf(out, "#define SKV_PLAN_TERMS %uu /* SKV_WITH_*: rayleigh 1, aerosol 2, dust 4, ozone 8, ground 16 */\n",
            c->species | (c->ground ? (unsigned)SKV_WITH_GROUND : 0u));
    fprintf(out,
            "#define SKV_PLAN_TABLE %d /* 0: none; 1: SKV_TABLE_SMALL; 2: SKV_TABLE_ACCURATE; 3: SKV_TABLE_LARGE */\n",
            (int)c->light);
    define(out, "SKV_PLAN_GRID", c->grid);
    fprintf(out, "#define SKV_PLAN_TABLE_BYTES %ld\n#define SKV_PLAN_WORK_BYTES %ld\n#define SKV_PLAN_GRID_BYTES %ld\n",
            k->table, k->work > 0 ? k->work - (long)sizeof(skv_table_builder) : 0, k->grid_bytes);
}

void plan_header(FILE *out, const plan_scene *scene, const plan_ask *ask, const plan_answer *a, const char *command) {
    const plan_candidate *const c = &a->chosen;
    fprintf(out, "/* Made by %s.\n   ", command);
    say_scene(out, scene);
    fprintf(
        out,
        "   Promised: 19 of 20 directions within %.3g %%; predicted: %.0f instructions a frame of %d vertices on %s.\n"
        "   Use: -DSKV_CONFIG_FILE='\"skv_config.h\"' for the library and all that includes it. */\n"
        "#ifndef SKV_CONFIG_PLANNED_H\n#define SKV_CONFIG_PLANNED_H\n\n",
        100 * c->promised, c->cost.mean, ask->vertices, plan_target_names[ask->target]);
    compile_time(out, scene, &c->config);
    run_time(out, &c->config, &c->cost);
    fprintf(out, "\n#endif\n");
}
