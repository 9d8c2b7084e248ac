/// `skyvert bake --what model`: model, table of multiple scattering and colour matrix as constant C.
///
/// Structs are written as 32-bit words: exact, and whatever their fields are. All of skv_model's fields are 32 bits
/// wide, so its words hold for any byte order; the table has shorter ones and holds for this one.
#include "bake.h"

#include <string.h>

static const char *const byte_order_check[2] = {
    "#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_BIG_ENDIAN__\n"
    "#error \"this table was baked on a big-endian machine\"\n#endif\n",
    "#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__\n"
    "#error \"this table was baked on a little-endian machine\"\n#endif\n"};

static int is_little_endian(void) {
    const uint16_t one = 1;
    uint8_t low;
    memcpy(&low, &one, 1);
    return low;
}

static void write_words(const void *bytes, size_t size, FILE *stream) {
    for (size_t i = 0; i < size / 4; i++) {
        uint32_t word;
        memcpy(&word, (const char *)bytes + 4 * i, 4);
        fprintf(stream, "%s0x%08x,", i % 8 == 0 ? "\n        " : " ", (unsigned)word);
    }
}

/// A constant of a struct's type; words come first, so that they are what is initialised.
static void write_struct(const char *type, const char *name, const char *part, const void *bytes, size_t size,
                         FILE *stream) {
    fprintf(stream, "static const union {\n    uint32_t word[%zu];\n    %s as;\n} %s_%s_words = {{", size / 4, type,
            name, part);
    write_words(bytes, size, stream);
    fprintf(stream, "\n}};\n\n");
}

static void write_head(const bake_air *air, FILE *stream) {
    const bake_options *const options = air->options;
    char from[400];
    fprintf(stream,
            "// Written by skyvert bake --what model: a sky that needs neither building nor memory.\n"
            "// skyvert " SKV_VERSION " from %s; ground %g m above the sea.\n//\n",
            sky_options_describe(&options->sky, from, sizeof from), options->sky.ground_m);
    fprintf(stream,
            "// Include it in one file, check once, then begin frames:\n"
            "//     if (%s_check() != SKV_OK) ...\n"
            "//     skv_frame_begin(&frame, %s_model(), NULL, height_km, ground_km, &sun, 1);\n"
            "//     skv_frame_table(&frame, %s_table());\n"
            "//     skv_colour(&%s_colour, %s_model()->bands, ...);\n",
            options->name, options->name, options->name, options->name, options->name);
    fprintf(stream, "#include \"skyvert/skyvert.h\"\n\n");
}

static void write_checks(const bake_air *air, FILE *stream) {
    fprintf(stream,
            "// What of config.h decides how a model is laid out.\n"
            "#if SKV_BANDS != %d || SKV_TERM_OZONE != %d || SKV_TERM_DUST != %d || SKV_PROFILE_TABULATED != %d || \\\n"
            "    SKV_LIGHTS_MAX != %d || !SKV_TERM_DIFFUSE\n"
            "#error \"another config.h selection than that of the command that baked this\"\n#endif\n",
            SKV_BANDS, SKV_TERM_OZONE, SKV_TERM_DUST, SKV_PROFILE_TABULATED, SKV_LIGHTS_MAX);
    fprintf(stream, "#if SKV_TABLE_VERSION != %uu\n#error \"another version of the table\"\n#endif\n",
            SKV_TABLE_VERSION);
    fprintf(stream, "%s", byte_order_check[is_little_endian()]);
    fprintf(stream, "typedef char %s_model_has_the_right_size[sizeof(skv_model) == %zu ? 1 : -1];\n\n",
            air->options->name, sizeof(skv_model));
}

static void write_functions(const bake_air *air, FILE *stream) {
    const char *const name = air->options->name;
    fprintf(stream,
            "static inline const skv_model *%s_model(void) {\n    return &%s_model_words.as;\n}\n\n"
            "static inline const skv_table *%s_table(void) {\n    return &%s_table_words.as;\n}\n\n",
            name, name, name, name);
    fprintf(stream,
            "/// SKV_OK; SKV_ERR_DAMAGED, SKV_ERR_LAYOUT or SKV_ERR_MODEL: these bytes or this library are others.\n"
            "static inline skv_status %s_check(void) {\n"
            "    return skv_table_check(&%s_table_words, sizeof %s_table_words, %s_model());\n}\n",
            name, name, name, name);
}

static void write_colour(const bake_air *air, FILE *stream) {
    const skv_colour_matrix *const c = &air->options->sky.matrix;
    fprintf(stream, "static const skv_colour_matrix %s_colour = {\n    {", air->options->name);
    for (int row = 0; row < 4; row++) {
        const float *const x = row < 3 ? c->rgb[row] : c->luminance;
        fprintf(stream, "{%.8ef, %.8ef, %.8ef, %.8ef}%s\n     ", (double)x[0], (double)x[1], (double)x[2], (double)x[3],
                row < 2    ? ","
                : row == 2 ? "},"
                           : "};\n");
    }
    fputc('\n', stream);
}

int bake_write_model(const bake_air *air, output *out) {
    FILE *const stream = out->stream;
    const char *const name = air->options->name;
    write_head(air, stream);
    write_checks(air, stream);
    write_struct("skv_model", name, "model", &air->model, sizeof air->model, stream);
    write_struct("skv_table", name, "table", air->orders.table, air->orders.table->bytes, stream);
    write_colour(air, stream);
    write_functions(air, stream);
    return 0; // a failed write shows at the commit
}
