/// `skyvert dome`: the sky as a mesh with vertex colours (PLY).
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "picture.h"

#define NAME "dome"

typedef struct dome_options {
    sky_options sky;
    moment_options when;
    const char *out;
    int kind, format, rings, rings_below, azimuths;
    double lowest_deg, exposure;
    bool has_lowest, exposure_auto;
} dome_options;

enum {
    OPT_OUT = 1300,
    OPT_KIND,
    OPT_FORMAT,
    OPT_RINGS,
    OPT_RINGS_BELOW,
    OPT_AZIMUTHS,
    OPT_LOWEST,
};

static const char *const kind_names[] = {"even", "horizon", "adaptive", NULL};
static const char *const format_names[] = {"binary", "ascii", NULL};

static const struct option long_options[] = {SKY_OPTIONS_LONG,
                                             MOMENT_OPTIONS_LONG,
                                             {"out", required_argument, NULL, OPT_OUT},
                                             {"kind", required_argument, NULL, OPT_KIND},
                                             {"format", required_argument, NULL, OPT_FORMAT},
                                             {"rings", required_argument, NULL, OPT_RINGS},
                                             {"rings-below", required_argument, NULL, OPT_RINGS_BELOW},
                                             {"azimuths", required_argument, NULL, OPT_AZIMUTHS},
                                             {"lowest-deg", required_argument, NULL, OPT_LOWEST},
                                             {"exposure", required_argument, NULL, OPT_EXPOSURE},
                                             {"help", no_argument, NULL, 'h'},
                                             {NULL, 0, NULL, 0}};

// clang-format off
static const char help[] =
    "usage: skyvert dome --position TEXT --height-m M --utc TIME --out MESH.ply [OPTION...]\n\n"
    "A sky dome as a PLY mesh. Vertices are unit directions, x east, y north, z up; triangles are\n"
    "counter-clockwise seen from inside. Colours: red green blue (uchar, exposed sRGB, for viewers), r g b\n"
    "(float, linear BT.709, 1 = 1000 cd/m2) and luminance (float, cd/m2).\n"
    "  --out FILE.ply         or - for the standard output\n"
    "  --kind NAME            even, horizon (default: rings dense at the horizon) or adaptive (also around the\n"
    "                         sun and along the planet's shadow)\n"
    "  --rings N              above the horizon and on it, 2 to 4096 (default 24)\n"
    "  --rings-below N        below it, 0 to 4096 (default 0)\n"
    "  --azimuths N           vertices a ring, 3 to 16384 (default 48)\n"
    "  --lowest-deg E         elevation of the lowest ring (default: the horizon, -90 with rings below)\n"
    "  --format binary|ascii  binary (default) is little-endian\n"
    "  --exposure K|auto      of red green blue: 1 - exp(-K L); auto (default) as in skyvert render\n\n";
// clang-format on

static int print_help(void) {
    printf("%s%s\n%s\n%s", help, moment_options_help, light_options_help, sky_options_help);
    return output_finish_stdout();
}

static int take_exposure(dome_options *options, const char *value) {
    options->exposure_auto = strcmp(value, "auto") == 0;
    if (options->exposure_auto ||
        (parse_number(value, &options->exposure) && options->exposure >= 0.0 && options->exposure <= 1e12))
        return 0;
    return fail_usage("skyvert dome: --exposure '%.40s': auto or a number from 0 to 1e12", value);
}

static int take(dome_options *options, int c, char **argv) {
    int status;
    switch (c) {
    case OPT_OUT:
        options->out = optarg;
        return 0;
    case OPT_KIND:
        return option_choice(NAME, "--kind", optarg, kind_names, &options->kind);
    case OPT_FORMAT:
        return option_choice(NAME, "--format", optarg, format_names, &options->format);
    case OPT_RINGS:
        return option_integer(NAME, "--rings", optarg, 2, 4096, &options->rings);
    case OPT_RINGS_BELOW:
        return option_integer(NAME, "--rings-below", optarg, 0, 4096, &options->rings_below);
    case OPT_AZIMUTHS:
        return option_integer(NAME, "--azimuths", optarg, 3, 16384, &options->azimuths);
    case OPT_LOWEST:
        options->has_lowest = true;
        return option_number(NAME, "--lowest-deg", optarg, -90.0, 0.0, &options->lowest_deg);
    case OPT_EXPOSURE:
        return take_exposure(options, optarg);
    default:
        status = sky_options_take(&options->sky, c, optarg);
        if (status < 0)
            status = moment_options_take(&options->when, c, optarg);
        return status < 0 ? option_unknown(NAME, c, argv) : status;
    }
}

// ---- the mesh

typedef struct mesh {
    size_t vertices, indices;
    float *direction, *radiance, *rgb, *luminance;
    uint32_t *index;
} mesh;

static skv_dome dome_of(const dome_options *options, const scene *view, const moment *now) {
    const double degree = 3.14159265358979323846 / 180.0;
    const double horizon_deg = fmax(scene_horizon_deg(view), -89.0);
    const double lowest_deg = options->has_lowest        ? options->lowest_deg
                              : options->rings_below > 0 ? -90.0
                                                         : horizon_deg;
    const float lowest = (float)(lowest_deg * degree), horizon = (float)(horizon_deg * degree);
    return (skv_dome){
        .kind = (skv_dome_kind)options->kind,
        .rings = options->rings,
        .rings_below = options->rings_below,
        .azimuths = options->azimuths,
        .horizon_rad = horizon,
        .lowest_rad = lowest < -1.57079632f ? -1.57079632f : lowest,
        .sun_enu = {now->sun_enu[0], now->sun_enu[1], now->sun_enu[2]},
        .height_km = (float)fmax(0.0, view->observer_km - options->sky.ground_m / 1000.0),
        .radius_km = view->model.radius_km + (float)(options->sky.ground_m / 1000.0),
        .top_km = view->model.top_km - (float)(options->sky.ground_m / 1000.0),
    };
}

static bool mesh_begin(mesh *out) {
    out->direction = malloc(out->vertices * 3 * sizeof(float));
    out->radiance = malloc(out->vertices * 4 * sizeof(float));
    out->rgb = malloc(out->vertices * 3 * sizeof(float));
    out->luminance = malloc(out->vertices * sizeof(float));
    out->index = malloc(out->indices * sizeof(uint32_t));
    return out->direction && out->radiance && out->rgb && out->luminance && out->index;
}

static void mesh_end(mesh *out) {
    free(out->direction);
    free(out->radiance);
    free(out->rgb);
    free(out->luminance);
    free(out->index);
}

static int mesh_build(mesh *out, const dome_options *options, scene *view, const moment *now) {
    const skv_dome dome = dome_of(options, view, now);
    if (skv_dome_size(&dome, &out->vertices, &out->indices) != SKV_OK)
        return fail_usage("skyvert dome: --lowest-deg %g: from -90 to the horizon, %g; --rings-below needs it lower",
                          (double)dome.lowest_rad * 57.29577951, (double)dome.horizon_rad * 57.29577951);
    if (!mesh_begin(out))
        return fail_job("skyvert dome: no memory for %zu vertices", out->vertices);
    const skv_status status = skv_dome_build(&dome, out->direction, 0, out->vertices, out->index, out->indices);
    if (status != SKV_OK)
        return fail_job("skyvert dome: the core refused the mesh (status %d)", (int)status);
    if (!scene_colours(view, out->vertices, out->direction, out->radiance, out->rgb, out->luminance))
        return fail_job("skyvert dome: the core refused the directions");
    return 0;
}

// ---- PLY

typedef struct ply_vertex {
    float number[7]; // x y z, r g b, luminance
    uint8_t colour[3];
} ply_vertex;

static ply_vertex vertex_of(const mesh *from, size_t i, double exposure) {
    ply_vertex out;
    float exposed[3] = {0.0f, 0.0f, 0.0f};
    memcpy(out.number, from->direction + 3 * i, 3 * sizeof(float));
    memcpy(out.number + 3, from->rgb + 3 * i, 3 * sizeof(float));
    out.number[6] = from->luminance[i];
    (void)skv_expose((float)exposure, 1, from->rgb + 3 * i, 0, exposed, 0);
    for (int c = 0; c < 3; c++)
        out.colour[c] = (uint8_t)(255.0 * srgb_from_linear((double)exposed[c]) + 0.5);
    return out;
}

static void write_header(FILE *stream, const mesh *from, bool ascii, const moment *now) {
    fprintf(stream, "ply\nformat %s 1.0\ncomment skyvert " SKV_VERSION "\n", ascii ? "ascii" : "binary_little_endian");
    fprintf(stream, "comment unit directions: x east, y north, z up; sun at azimuth %.4f deg, elevation %.4f deg\n",
            now->sun_azimuth_deg, now->sun_elevation_deg);
    fprintf(stream, "comment r g b: linear BT.709, 1 = %g cd/m2; red green blue: exposed sRGB; luminance: cd/m2\n",
            (double)SKV_WHITE_LUMINANCE);
    fprintf(stream, "element vertex %zu\n", from->vertices);
    fputs("property float x\nproperty float y\nproperty float z\n"
          "property uchar red\nproperty uchar green\nproperty uchar blue\n"
          "property float r\nproperty float g\nproperty float b\nproperty float luminance\n",
          stream);
    fprintf(stream, "element face %zu\nproperty list uchar uint vertex_indices\nend_header\n", from->indices / 3);
}

static void put_u32(FILE *stream, uint32_t bits) {
    const uint8_t bytes[4] = {(uint8_t)bits, (uint8_t)(bits >> 8), (uint8_t)(bits >> 16), (uint8_t)(bits >> 24)};
    fwrite(bytes, 1, sizeof bytes, stream);
}

static void put_floats(FILE *stream, const float *value, int count) {
    for (int i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, value + i, sizeof bits);
        put_u32(stream, bits);
    }
}

static void write_vertex(FILE *stream, const ply_vertex *v, bool ascii) {
    if (!ascii) {
        put_floats(stream, v->number, 3);
        fwrite(v->colour, 1, 3, stream);
        put_floats(stream, v->number + 3, 4);
        return;
    }
    const float *n = v->number;
    fprintf(stream, "%.9g %.9g %.9g %d %d %d %.9g %.9g %.9g %.9g\n", (double)n[0], (double)n[1], (double)n[2],
            v->colour[0], v->colour[1], v->colour[2], (double)n[3], (double)n[4], (double)n[5], (double)n[6]);
}

static void write_face(FILE *stream, const uint32_t *index, bool ascii) {
    if (ascii) {
        fprintf(stream, "3 %u %u %u\n", (unsigned)index[0], (unsigned)index[1], (unsigned)index[2]);
        return;
    }
    fputc(3, stream);
    for (int i = 0; i < 3; i++)
        put_u32(stream, index[i]);
}

static int write_mesh(const mesh *from, const dome_options *options, const moment *now) {
    const bool ascii = options->format == 1;
    const double k =
        options->exposure_auto ? colours_auto_exposure(from->rgb, from->vertices, 3, NULL) : options->exposure;
    output out;
    const int status = output_open(&out, options->out);
    if (status != 0)
        return status;
    write_header(out.stream, from, ascii, now);
    for (size_t i = 0; i < from->vertices; i++) {
        const ply_vertex v = vertex_of(from, i, k);
        write_vertex(out.stream, &v, ascii);
    }
    for (size_t i = 0; i + 2 < from->indices; i += 3)
        write_face(out.stream, from->index + i, ascii);
    return output_commit(&out);
}

static scene_plan plan_of(const dome_options *options) {
    const int rings = options->rings + options->rings_below;
    const double turn = 6.28318530717958648, spacing = turn / fmin(4.0 * options->rings, options->azimuths);
    return (scene_plan){.rays = (size_t)rings * (size_t)options->azimuths,
                        .sample_rad = (float)fmin(spacing, (double)SKV_DISC_SAMPLE_MAX)};
}

static int check(dome_options *options, int argc, char **argv, moment *now) {
    int status = option_no_more(NAME, argc, argv);
    if (status == 0 && !options->out)
        status = fail_usage("skyvert dome: --out FILE.ply is needed");
    if (status == 0)
        status = moment_options_finish(&options->when, options->sky.ground_m, now);
    return status == 0 ? sky_options_finish(&options->sky) : status;
}

int cmd_dome(int argc, char **argv) {
    static dome_options options = {.kind = 1, .rings = 24, .azimuths = 48, .exposure_auto = true};
    static scene view;
    sky_options_begin(&options.sky, NAME);
    options.sky.light.discs = CHOICE_OFF; // between vertices they would be smeared
    moment_options_begin(&options.when, NAME);
    int status = 0;
    for (int c; status == 0 && (c = getopt_long(argc, argv, ":h", long_options, NULL)) != -1;) {
        if (c == 'h')
            return print_help();
        status = take(&options, c, argv);
    }
    moment now;
    if (status == 0)
        status = check(&options, argc, argv, &now);
    if (status != 0)
        return status;
    mesh out = {0};
    const scene_plan plan = plan_of(&options);
    view.progress = true;
    status = scene_begin(&view, &options.sky, &now, &plan);
    if (status == 0)
        status = mesh_build(&out, &options, &view, &now);
    if (status == 0)
        status = write_mesh(&out, &options, &now);
    char text[400];
    if (status == 0 && options.sky.timing)
        fprintf(stderr, "%s\n", scene_timing(&view, text, sizeof text));
    mesh_end(&out);
    scene_end(&view);
    place_end();
    sky_options_free(&options.sky);
    return status;
}
