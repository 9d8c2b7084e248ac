/// `skyvert eval`: spectral radiance for a list of queries.
#include <getopt.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "all_orders.h"
#include "answers.h"
#include "command.h"
#include "ini.h"
#include "queries.h"

static const char help[] =
    "usage: skyvert eval --atmosphere FILE.ini [OPTION...] < queries.csv > answers.csv\n\n"
    "Spectral radiance of the sky for every row of the queries, W m^-2 sr^-1 nm^-1 for the file's solar\n"
    "irradiance. The sun is a point and not drawn; no refraction.\n\n"
    "  --atmosphere FILE      planet, bands, Rayleigh, aerosol, dust and ozone (below)\n"
    "  --tier fast|standard|high\n"
    "                         gauss-exp with 4, 6 or 8 samples and the Chapman form (standard)\n"
    "  --rule uniform|keller|gauss-exp\n"
    "                         another rule than the tier's; uniform and keller find the depth by inner samples\n"
    "  --samples N            of the view ray: 1 to 64; gauss-exp: 2 to 16 per lit part (the tier's)\n"
    "  --depth-samples M      of each inner path: 1 to 64 (as --samples); gauss-exp: 2 to 16 (16)\n"
    "  --depth chapman|inner  how the optical depth is found (gauss-exp: chapman, else inner)\n"
    "  --orders single|all    orders of scattering: once, or all of them by a table built at the start (all)\n"
    "  --table accurate|small|large|ALTITUDES,DETAILED,SUNS\n"
    "                         which table, or one of these sizes: 4 to 32, 0 to ALTITUDES, 8 to 64 (accurate)\n"
    "  --table-format packed|float\n"
    "                         its numbers: 16 and 8 bits, or floats (packed)\n"
    "  --grid                 the table's light by way of a grid per altitude and sun, where there can be one\n"
    "  --ground none|lit      what the ground adds to rays that meet it: nothing, or its own light (none); that it\n"
    "                         lights the air belongs to all orders in either case\n"
    "  --model NAME           a published model instead of the core (render --help lists them); of the options above\n"
    "                         only --orders and --ground count then\n"
    "  --model-cache DIR      keeps that model's tables that take long to build in this folder\n"
    "  -h, --help             this text\n"
    "  -V, --version          the version\n\n"
    "Queries: CSV with the columns altitude_km (0 to 1e6), sun_zenith_deg and view_zenith_deg (0 to 180) and\n"
    "rel_azimuth_deg (any; 0 is toward the sun), in any order; other columns are ignored. Answers: these four\n"
    "as given, in the same order, and one column L_<nm> per band. All rows are checked before the first byte\n"
    "of output; bad ones are named on stderr.\n\n"
    "Atmosphere files: name = value in sections; lists have commas between; comments start with ; or #.\n"
    "  [planet]    radius_km, top_km (altitude of the top), albedo (one per band)\n"
    "  [bands]     wavelength_nm, solar_irradiance (3 or 4 values; 1 gives answers in 1/sr)\n"
    "  [rayleigh]  scattering_per_km (list, at altitude 0), profile = exponential | us76 | table;\n"
    "              scale_height_km; us76: exp(-a h^b), a and b (.07771971, 1.16364243);\n"
    "              absorption_per_km (of the gas beside that, list, zeros)\n"
    "  [aerosol]   scattering_per_km, extinction_per_km (lists, at altitude 0), profile = exponential |\n"
    "              exponential-background | table; scale_height_km, background;\n"
    "              phase = henyey-greenstein | cornette-shanks; g\n"
    "  [dust]      a second layer: the keys of [aerosol], coefficients at density 1; also profile = tent |\n"
    "              lognormal (normalised to 1 at the peak), with the keys that they have in [ozone]\n"
    "  [ozone]     absorption_per_km (list, at the peak), profile = tent | lognormal | table; peak_km,\n"
    "              half_width_km; lognormal: mu and k (3.22261, 5.55555555)\n"
    "  table = FILE: rows altitude_km,relative_density; relative names start at the ini file's folder\n"
    "[aerosol], [dust] and [ozone] may be missing: there is none then. What has no default here is needed.\n\n"
    "Exit status: 0 every row was answered, 1 writing failed, 2 bad input (nothing is written).\n";

typedef struct settings {
    const char *atmosphere;
    skv_quality quality;
    bool all_orders, lit_ground, grid;
    skv_table_kind table;
    int table_sizes[3], table_format; ///< sizes 0: the kind's
    const baseline *model;            ///< NULL: the core
    const char *model_cache;
} settings;

/// What was typed; -1 where nothing was.
typedef struct choices {
    int tier, rule, depth, samples, depth_samples, orders, table, ground;
} choices;

/// The rule decides what the other numbers may be, wherever the options stood.
static int combine(const choices *c, settings *s) {
    static const skv_tier tiers[] = {SKV_TIER_FAST, SKV_TIER_STANDARD, SKV_TIER_HIGH};
    if (skv_quality_tier(&s->quality, tiers[c->tier]) != SKV_OK)
        return fail_job("skyvert eval: this build of the core lacks the tier");
    skv_quality *const q = &s->quality;
    if (c->rule >= 0) {
        q->rule = (skv_rule)c->rule;
        q->depth = q->rule == SKV_GAUSS_EXP ? SKV_DEPTH_BY_CHAPMAN : SKV_DEPTH_BY_INNER;
    }
    if (c->depth >= 0)
        q->depth = (skv_depth)c->depth;
    if (c->samples >= 0)
        q->samples = c->samples;
    const bool gauss = q->rule == SKV_GAUSS_EXP; // its inner depth has Gauss nodes, too
    if (gauss && (q->samples < 2 || q->samples > 16))
        return fail_usage("skyvert eval: --samples %d: allowed with gauss-exp is 2 to 16", (int)q->samples);
    q->depth_samples = c->depth_samples >= 0 ? c->depth_samples : gauss ? 16 : q->samples;
    if (gauss && q->depth == SKV_DEPTH_BY_INNER && (q->depth_samples < 2 || q->depth_samples > 16))
        return fail_usage("skyvert eval: --depth-samples %d: allowed with gauss-exp is 2 to 16", (int)q->depth_samples);
    if (c->ground > 0)
        q->terms |= SKV_WITH_GROUND;
    else
        q->terms &= ~(uint32_t)SKV_WITH_GROUND;
    s->all_orders = c->orders != 0;
    s->lit_ground = c->ground > 0;
    if (s->grid && !s->all_orders)
        return fail_usage("skyvert eval: --grid: a grid belongs to --orders all");
    s->table = (skv_table_kind)c->table;
    return 0;
}

static const struct option options[] = {{"atmosphere", required_argument, NULL, 'a'},
                                        {"tier", required_argument, NULL, 't'},
                                        {"rule", required_argument, NULL, 'r'},
                                        {"samples", required_argument, NULL, 'n'},
                                        {"depth-samples", required_argument, NULL, 'm'},
                                        {"depth", required_argument, NULL, 'd'},
                                        {"orders", required_argument, NULL, 'o'},
                                        {"table", required_argument, NULL, 'T'},
                                        {"table-format", required_argument, NULL, 'F'},
                                        {"grid", no_argument, NULL, 'G'},
                                        {"model", required_argument, NULL, 'M'},
                                        {"model-cache", required_argument, NULL, 'C'},
                                        {"ground", required_argument, NULL, 'g'},
                                        {"help", no_argument, NULL, 'h'},
                                        {"version", no_argument, NULL, 'V'},
                                        {NULL, 0, NULL, 0}};

/// A kind, or three sizes.
static int take_table(const char *text, choices *c, settings *s) {
    static const struct {
        const char *name;
        int low, high;
    } sizes[3] = {{"--table ALTITUDES", 4, 32}, {"--table DETAILED", 0, 32}, {"--table SUNS", 8, 64}};
    char part[3][12];
    char end;
    if (sscanf(text, "%11[0-9],%11[0-9],%11[0-9]%c", part[0], part[1], part[2], &end) != 3)
        return option_choice("eval", "table", text, table_names, &c->table);
    for (int i = 0; i < 3; i++) {
        const int high = i == 1 ? s->table_sizes[0] : sizes[i].high; // no more detailed rows than rows
        const int result = option_integer("eval", sizes[i].name, part[i], sizes[i].low, high, &s->table_sizes[i]);
        if (result)
            return result;
    }
    return 0;
}

static int take_model(const char *name, settings *s) {
    s->model = baseline_find(name);
    return s->model ? 0 : fail_usage("skyvert eval: --model %.60s: skyvert render --help lists the models", name);
}

static int take_option(int letter, choices *c, settings *s) {
    static const char *const tiers[] = {"fast", "standard", "high", NULL};
    static const char *const rules[] = {"uniform", "keller", "gauss-exp", NULL}; // as in skv_rule
    static const char *const depths[] = {"chapman", "inner", NULL};              // as in skv_depth
    static const char *const grounds[] = {"none", "lit", NULL};
    static const char *const formats[] = {"packed", "float", NULL}; // as in skv_table_format
    switch (letter) {
    case 'a':
        s->atmosphere = optarg;
        return 0;
    case 't':
        return option_choice("eval", "tier", optarg, tiers, &c->tier);
    case 'r':
        return option_choice("eval", "rule", optarg, rules, &c->rule);
    case 'd':
        return option_choice("eval", "depth", optarg, depths, &c->depth);
    case 'o':
        return option_choice("eval", "orders", optarg, order_names, &c->orders);
    case 'T':
        return take_table(optarg, c, s);
    case 'F':
        return option_choice("eval", "table-format", optarg, formats, &s->table_format);
    case 'G':
        s->grid = true;
        return 0;
    case 'M':
        return take_model(optarg, s);
    case 'C':
        s->model_cache = optarg;
        return 0;
    case 'g':
        return option_choice("eval", "ground", optarg, grounds, &c->ground);
    case 'n':
        return option_integer("eval", "samples", optarg, 1, SKV_SAMPLES_MAX, &c->samples);
    default:
        return option_integer("eval", "depth-samples", optarg, 1, SKV_SAMPLES_MAX, &c->depth_samples);
    }
}

/// @return 0, -1 when --help or --version did it all, else the exit status
static int read_options(int argc, char **argv, settings *s, int *status) {
    choices c = {.tier = 1, .rule = -1, .depth = -1, .samples = -1, .depth_samples = -1, .orders = 1, .ground = 0};
    for (int letter; (letter = getopt_long(argc, argv, ":hV", options, NULL)) != -1;) {
        if (letter == 'h') {
            fputs(help, stdout);
            *status = output_finish_stdout();
            return -1;
        }
        if (letter == 'V') {
            *status = option_version();
            return -1;
        }
        const int bad =
            letter == '?' || letter == ':' ? option_unknown("eval", letter, argv) : take_option(letter, &c, s);
        if (bad)
            return bad;
    }
    const int more = option_no_more("eval", argc, argv);
    if (more)
        return more;
    if (!s->atmosphere)
        return fail_usage("skyvert eval: --atmosphere FILE.ini is missing (skyvert eval --help)");
    return combine(&c, s);
}

static int build_model(skv_model *model, const atmosphere_file *file, const char *path) {
    const skv_status status = skv_model_build(model, &file->atmosphere);
    if (status == SKV_OK)
        return 0;
    if (status == SKV_ERR_UNSUPPORTED)
        return fail_job(
            "%.200s: this build of the core lacks a profile, phase function or number of bands that it names", path);
    return fail_usage("%.200s: the core refuses these values together (status %d)", path, (int)status);
}

static int show(void *context, double done) {
    (void)context;
    progress_update((size_t)(1000 * done));
    return 0;
}

/// The state of a published model in source->other_state.
static int build_other(const settings *s, const atmosphere_file *file, answers_source *source) {
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    const baseline_wants wants = {.all = s->all_orders,
                                  .lit_ground = s->lit_ground,
                                  .threads = processors < 1   ? 1
                                             : processors > 8 ? 8
                                                              : (int)processors,
                                  .progress = show,
                                  .cache = s->model_cache};
    const char *why = "";
    baseline_cost cost;
    if (s->all_orders && !(s->model->can & BASELINE_ALL))
        return fail_usage("skyvert eval: --model %s knows light scattered once only: --orders single", s->model->name);
    progress_begin(s->model->name, 1000);
    const int status = s->model->build(&source->other_state, &file->atmosphere, &wants, &cost, &why);
    progress_end();
    if (status == -2)
        return fail_usage("skyvert eval: --model %s: this air is beyond it: %s", s->model->name, why);
    if (status)
        return fail_job("skyvert eval: --model %s: out of memory", s->model->name);
    source->other = s->model;
    return 0;
}

static int evaluate(const settings *s, const atmosphere_file *file) {
    skv_model model;
    query_list queries = {0};
    all_orders orders = {.floats = s->table_format == SKV_TABLE_FLOAT};
    answers_source source = {.model = &model, .quality = &s->quality, .grid = s->grid};
    memcpy(orders.sizes, s->table_sizes, sizeof orders.sizes);
    int result = build_model(&model, file, s->atmosphere);
    if (result == 0)
        result = queries_read(&queries, stdin, "stdin");
    if (result == 0 && s->model && queries.rows > 0)
        result = build_other(s, file, &source);
    else if (result == 0 && s->all_orders && queries.rows > 0)
        result = all_orders_build(&orders, "eval", &model, s->table, 0, true);
    source.table = orders.table;
    if (result == 0)
        result = answers_write(&queries, &source, file);
    if (source.other)
        source.other->release(source.other_state);
    all_orders_free(&orders);
    queries_free(&queries);
    return result;
}

int cmd_eval(int argc, char **argv) {
    settings s = {0};
    atmosphere_file file;
    int status = 0;
    const int bad = read_options(argc, argv, &s, &status);
    if (bad)
        return bad < 0 ? status : bad;
    int result = atmosphere_load(&file, s.atmosphere);
    if (result)
        return result;
    result = evaluate(&s, &file);
    atmosphere_free(&file);
    return result;
}
