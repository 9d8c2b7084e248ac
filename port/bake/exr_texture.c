// OpenEXRCore writer for tables: header, attributes, then chunk after chunk. Writing goes through our own function so
// that every failure of the system is seen, with its errno, also those at the very end.
#include "skv_exr_texture.h"

#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <openexr.h>

#define HALF_MAX 65504.0f
/// Lines of a ZIP chunk: a property of the format.
#define CHUNK_LINES 16
#define NAME_SIZE   32

typedef struct sink {
    int fd;
    int error; // errno of the first write that failed
} sink;

static int64_t sink_write(exr_const_context_t context, void *user, const void *buffer, uint64_t size, uint64_t offset,
                          exr_stream_error_func_ptr_t report) {
    sink *out = user;
    const char *bytes = buffer;
    uint64_t done = 0;
    while (done < size) {
        const ssize_t n = pwrite(out->fd, bytes + done, (size_t)(size - done), (off_t)(offset + done));
        if (n > 0) {
            done += (uint64_t)n;
        } else if (n == 0 || errno != EINTR) {
            out->error = n == 0 ? ENOSPC : errno;
            (void)report(context, EXR_ERR_WRITE_IO, "write failed");
            return -1;
        }
    }
    return (int64_t)size;
}

/// The library would print to stderr. Its words are asked for afterwards, by code.
static void stay_quiet(exr_const_context_t context, exr_result_t code, const char *text) {
    (void)context, (void)code, (void)text;
}

// ---- header

static void channel_name(const skv_exr_texture *texture, int layer, int channel, char name[NAME_SIZE]) {
    static const char letters[] = "RGBA";
    if (layer == 0)
        snprintf(name, NAME_SIZE, "%c", letters[channel]);
    else
        snprintf(name, NAME_SIZE, "%.20s.%c", texture->layer_name[layer], letters[channel]);
}

static exr_result_t add_channels(exr_context_t context, int part, const skv_exr_texture *texture) {
    const exr_pixel_type_t type = texture->half ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT;
    exr_result_t rv = EXR_ERR_SUCCESS;
    char name[NAME_SIZE];
    for (int i = 0; i < texture->layers * texture->channels && rv == EXR_ERR_SUCCESS; i++) {
        channel_name(texture, i / texture->channels, i % texture->channels, name);
        rv = exr_add_channel(context, part, name, type, EXR_PERCEPTUALLY_LINEAR, 1, 1);
    }
    return rv;
}

static exr_result_t add_words(exr_context_t context, int part, const skv_exr_texture *texture) {
    static const exr_attr_chromaticities_t bt709_d65 = {.red_x = 0.64f,
                                                        .red_y = 0.33f,
                                                        .green_x = 0.30f,
                                                        .green_y = 0.60f,
                                                        .blue_x = 0.15f,
                                                        .blue_y = 0.06f,
                                                        .white_x = 0.3127f,
                                                        .white_y = 0.3290f};
    exr_result_t rv = EXR_ERR_SUCCESS;
    if (texture->colour)
        rv = exr_attr_set_chromaticities(context, part, "chromaticities", &bt709_d65);
    if (rv == EXR_ERR_SUCCESS && texture->software)
        rv = exr_attr_set_string(context, part, "software", texture->software);
    if (rv == EXR_ERR_SUCCESS && texture->comments)
        rv = exr_attr_set_string(context, part, "comments", texture->comments);
    if (rv == EXR_ERR_SUCCESS && texture->text_name)
        rv = exr_attr_set_string(context, part, texture->text_name, texture->text);
    for (size_t i = 0; i < texture->numbers && rv == EXR_ERR_SUCCESS; i++)
        rv = exr_attr_set_float(context, part, texture->number[i].name, texture->number[i].value);
    return rv;
}

static exr_result_t write_header(exr_context_t context, int *part, const skv_exr_texture *texture) {
    exr_result_t rv = exr_add_part(context, NULL, EXR_STORAGE_SCANLINE, part);
    if (rv == EXR_ERR_SUCCESS)
        rv = exr_initialize_required_attr_simple(context, *part, texture->width, texture->height, EXR_COMPRESSION_ZIP);
    if (rv == EXR_ERR_SUCCESS)
        rv = add_channels(context, *part, texture);
    if (rv == EXR_ERR_SUCCESS)
        rv = add_words(context, *part, texture);
    return rv == EXR_ERR_SUCCESS ? exr_write_header(context) : rv;
}

// ---- pixels

static float finite_within(float x, float limit) {
    return isnan(x) ? 0.0f : x > limit ? limit : x < -limit ? -limit : x;
}

/// The lines [y, y + lines) of all layers into copy[layer][line][x][channel], finite in the file's type.
static void copy_lines(const skv_exr_texture *texture, int y, int lines, float *copy) {
    const size_t line = (size_t)texture->width * (size_t)texture->channels, layer = line * (size_t)texture->height;
    const float limit = texture->half ? HALF_MAX : FLT_MAX;
    for (int l = 0; l < texture->layers; l++)
        for (size_t i = 0; i < (size_t)lines * line; i++)
            copy[(size_t)l * CHUNK_LINES * line + i] =
                finite_within(texture->pixels[(size_t)l * layer + (size_t)y * line + i], limit);
}

/// The library sorts channels by name: finds each again.
static void point_to(exr_encode_pipeline_t *encoder, const float *copy, const skv_exr_texture *texture) {
    const size_t line = (size_t)texture->width * (size_t)texture->channels;
    char name[NAME_SIZE];
    for (int c = 0; c < encoder->channel_count; c++)
        for (int i = 0; i < texture->layers * texture->channels; i++) {
            exr_coding_channel_info_t *const channel = &encoder->channels[c];
            channel_name(texture, i / texture->channels, i % texture->channels, name);
            if (strcmp(name, channel->channel_name) != 0)
                continue;
            const float *const from =
                copy + (size_t)(i / texture->channels) * CHUNK_LINES * line + (size_t)(i % texture->channels);
            channel->encode_from_ptr = (const uint8_t *)from;
            channel->user_data_type = EXR_PIXEL_FLOAT;
            channel->user_bytes_per_element = sizeof(float);
            channel->user_pixel_stride = texture->channels * (int)sizeof(float);
            channel->user_line_stride = (int)(line * sizeof(float));
        }
}

static exr_result_t encode_chunk(exr_context_t context, int part, exr_encode_pipeline_t *encoder,
                                 const skv_exr_texture *texture, int y, const float *copy) {
    exr_chunk_info_t chunk;
    exr_result_t rv = exr_write_scanline_chunk_info(context, part, y, &chunk);
    if (rv == EXR_ERR_SUCCESS)
        rv = y == 0 ? exr_encoding_initialize(context, part, &chunk, encoder)
                    : exr_encoding_update(context, part, &chunk, encoder);
    if (rv != EXR_ERR_SUCCESS)
        return rv;
    point_to(encoder, copy, texture);
    if (y == 0)
        rv = exr_encoding_choose_default_routines(context, part, encoder);
    return rv == EXR_ERR_SUCCESS ? exr_encoding_run(context, part, encoder) : rv;
}

static exr_result_t write_pixels(exr_context_t context, int part, const skv_exr_texture *texture) {
    const size_t line = (size_t)texture->width * (size_t)texture->channels;
    float *const copy = malloc((size_t)texture->layers * CHUNK_LINES * line * sizeof *copy);
    exr_encode_pipeline_t encoder = EXR_ENCODE_PIPELINE_INITIALIZER;
    exr_result_t rv = copy ? EXR_ERR_SUCCESS : EXR_ERR_OUT_OF_MEMORY;
    int y = 0;
    for (; y < texture->height && rv == EXR_ERR_SUCCESS; y += CHUNK_LINES) {
        copy_lines(texture, y, texture->height - y < CHUNK_LINES ? texture->height - y : CHUNK_LINES, copy);
        rv = encode_chunk(context, part, &encoder, texture, y, copy);
    }
    if (y > 0)
        (void)exr_encoding_destroy(context, &encoder);
    free(copy);
    return rv;
}

// ---- the public call

static const char *bad_field(const skv_exr_texture *t) {
    if (!t || !t->pixels)
        return "no pixels";
    if (t->width < 1 || t->width > SKV_EXR_TEXTURE_SIDE_MAX || t->height < 1 || t->height > SKV_EXR_TEXTURE_SIDE_MAX)
        return "width or height out of range";
    if (t->layers < 1 || t->layers > SKV_EXR_TEXTURE_LAYERS_MAX || t->channels < 1 || t->channels > 4)
        return "layers or channels out of range";
    for (int l = 1; l < t->layers; l++)
        if (!t->layer_name[l])
            return "a layer without a name";
    if ((t->text_name && !t->text) || (t->numbers > 0 && !t->number))
        return "an attribute without a value";
    return NULL;
}

int skv_exr_texture_write(int fd, const skv_exr_texture *texture, char *message, size_t message_size) {
    const char *const bad = !message || message_size < 1 ? "no room for a message" : bad_field(texture);
    if (bad) {
        if (message && message_size >= 1)
            snprintf(message, message_size, "%s", bad);
        return SKV_EXR_TEXTURE_ERR_ARGUMENT;
    }
    message[0] = '\0';
    sink out = {.fd = fd};
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.error_handler_fn = stay_quiet;
    setup.user_data = &out;
    setup.write_fn = sink_write;
    exr_context_t context = NULL;
    int part = 0;
    exr_result_t rv = exr_start_write(&context, "texture", EXR_WRITE_FILE_DIRECTLY, &setup);
    if (rv == EXR_ERR_SUCCESS) {
        rv = write_header(context, &part, texture);
        if (rv == EXR_ERR_SUCCESS)
            rv = write_pixels(context, part, texture);
        const exr_result_t end = exr_finish(&context); // writes the table of chunks
        rv = rv == EXR_ERR_SUCCESS ? end : rv;
    }
    if (out.error != 0) {
        snprintf(message, message_size, "%s", strerror(out.error));
        return SKV_EXR_TEXTURE_ERR_WRITE;
    }
    if (rv != EXR_ERR_SUCCESS)
        snprintf(message, message_size, "%s", exr_get_default_error_message(rv));
    return rv == EXR_ERR_SUCCESS ? SKV_EXR_TEXTURE_OK : SKV_EXR_TEXTURE_ERR_LIBRARY;
}
