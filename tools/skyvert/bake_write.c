/// `skyvert bake`: textures as EXR, as raw halves, and as C.
#include "bake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#ifdef SKV_HAVE_EXR
#include "port/openexr/skv_exr_texture.h"
#endif

/// raw16f: texels begin at a multiple of this.
#define DATA_ALIGNMENT 256

uint16_t bake_half(float x) {
    uint32_t bits;
    if (isnan(x))
        return 0;
    x = fminf(fmaxf(x, -65504.0f), 65504.0f);
    memcpy(&bits, &x, sizeof bits);
    const uint32_t sign = bits >> 16 & 0x8000u, size = bits & 0x7fffffffu;
    if (size < 0x38800000u) // below 2^-14: steps of 2^-24, as lrintf() rounds, to even
        return (uint16_t)(sign | (uint32_t)lrintf(ldexpf(fabsf(x), 24)));
    const uint32_t rounded = size + 0xfffu + (size >> 13 & 1u);
    return (uint16_t)(sign | ((rounded >> 13) - (112u << 10)));
}

static size_t values_of(const bake_texture *texture) {
    return (size_t)texture->map.layers * skv_bake_layer_values(&texture->map);
}

// ---- EXR

#ifdef SKV_HAVE_EXR
int bake_write_exr(const bake_texture *texture, const bake_options *options, output *out) {
    const skv_bake_table *const map = &texture->map;
    const skv_exr_extra numbers[] = {
        {"skyvert.radiusKm", map->radius_km}, {"skyvert.topKm", map->top_km},      {"skyvert.heightKm", map->height_km},
        {"skyvert.muSun", map->mu_s},         {"skyvert.muSunMin", map->mu_s_min}, {"skyvert.scale0", map->scale[0]},
        {"skyvert.scale1", map->scale[1]},    {"skyvert.scale2", map->scale[2]},
    };
    skv_exr_texture exr = {.width = map->width,
                           .height = map->height * map->depth,
                           .layers = map->layers,
                           .channels = map->channels,
                           .pixels = texture->texels,
                           .half = options->half,
                           .colour = options->rgb,
                           .software = "skyvert " SKV_VERSION,
                           .comments = "A table, not a picture; the attribute skyvert.bake says what lies where.",
                           .text_name = "skyvert.bake",
                           .text = texture->text,
                           .number = numbers,
                           .numbers = sizeof numbers / sizeof numbers[0]};
    char message[200];
    if (map->height * map->depth > SKV_EXR_TEXTURE_SIDE_MAX)
        return fail_usage("skyvert bake: %d rows x %d altitudes: an EXR has at most %d lines", map->height, map->depth,
                          SKV_EXR_TEXTURE_SIDE_MAX);
    for (int l = 0; l < map->layers; l++)
        exr.layer_name[l] = texture->layer_name[l];
    const int result = skv_exr_texture_write(fileno(out->stream), &exr, message, sizeof message);
    return result == SKV_EXR_OK ? 0 : output_fail(out, message);
}
#else
int bake_write_exr(const bake_texture *texture, const bake_options *options, output *out) {
    (void)texture, (void)options;
    return fail_job("skyvert bake: %.200s: this build has no OpenEXR (package libopenexr-dev)", out->path);
}
#endif

// ---- raw16f

int bake_write_raw16f(bake_texture *texture, const bake_air *air, output *out) {
    bake_texture_describe(texture, air, 0);
    const size_t text = strlen(texture->text);
    const size_t offset = (text + DATA_ALIGNMENT - 1) / DATA_ALIGNMENT * DATA_ALIGNMENT;
    bake_texture_describe(texture, air, (int)offset); // the number has a fixed width
    fwrite(texture->text, 1, text, out->stream);
    for (size_t i = text; i < offset; i++)
        fputc(i + 1 < offset ? ' ' : '\n', out->stream);
    for (size_t i = 0; i < values_of(texture); i++) {
        const uint16_t half = bake_half(texture->texels[i]);
        fputc(half & 0xff, out->stream);
        fputc(half >> 8, out->stream);
    }
    return 0; // a failed write shows at the commit
}

// ---- C

/// The text as a comment, without what only files have.
static void write_comment(const char *text, FILE *stream) {
    fprintf(stream, "// Written by skyvert bake.\n");
    for (const char *line = text; *line;) {
        const size_t n = strcspn(line, "\n");
        fprintf(stream, "// %.*s\n", (int)n, line);
        line += n + (line[n] == '\n');
    }
}

static void write_values(const bake_texture *texture, bool half, FILE *stream) {
    const int a_line = half ? 16 : 8;
    for (size_t i = 0; i < values_of(texture); i++) {
        fputs(i % (size_t)a_line == 0 ? "\n    " : " ", stream);
        if (half)
            fprintf(stream, "0x%04x,", (unsigned)bake_half(texture->texels[i]));
        else // nine digits are exact, the exponent makes it a floating constant
            fprintf(stream, "%.8ef,", (double)texture->texels[i]);
    }
    fputs("\n};\n\n", stream);
}

int bake_write_c(const bake_texture *texture, const bake_options *options, output *out) {
    const skv_bake_table *const map = &texture->map;
    FILE *const stream = out->stream;
    const char *const name = options->name;
    write_comment(texture->text, stream);
    fprintf(stream, "#include \"skv_bake.h\"\n\nstatic const %s %s_texels[%zu] = {",
            options->half ? "uint16_t" : "float", name, values_of(texture));
    write_values(texture, options->half, stream);
    // In the order of the fields, without their names: C++ takes it, too.
    fprintf(stream, "static const skv_bake_table %s = {\n    %d, // what\n", name, map->what);
    fprintf(stream, "    %d, %d, %d, // width, height, depth\n", map->width, map->height, map->depth);
    fprintf(stream, "    %d, %d, %d, %d, // layers, channels, azimuths, deferred\n", map->layers, map->channels,
            map->azimuths, map->deferred);
    fprintf(stream, "    {%d, %d}, {%.8ef, %.8ef}, // phase, g\n", map->phase[0], map->phase[1], (double)map->g[0],
            (double)map->g[1]);
    fprintf(stream, "    %.8ef, %.8ef, // radius_km, top_km\n", (double)map->radius_km, (double)map->top_km);
    fprintf(stream, "    %.8ef, %.8ef, %.8ef, // height_km, mu_s, mu_s_min\n", (double)map->height_km,
            (double)map->mu_s, (double)map->mu_s_min);
    fprintf(stream, "    {%.8ef, %.8ef, %.8ef, %.8ef}, // scale\n", (double)map->scale[0], (double)map->scale[1],
            (double)map->scale[2], (double)map->scale[3]);
    fprintf(stream, options->half ? "    %s_texels, NULL};\n" : "    NULL, %s_texels};\n", name);
    return 0;
}
