// OpenEXRCore writer: header, attributes, then chunk after chunk through the library's own ZIP encoder. Writing goes
// through our own function so that every failure of the system is seen, with its errno, also those at the very end.
#include "raster.h"

#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/// Largest finite half; from 65520 on a half is infinite.
#define HALF_MAX 65504.0f
/// Lines of a ZIP chunk: a property of the format.
#define CHUNK_LINES 16
/// Of a channel.
#define NAME_SIZE 32

typedef struct sink {
    int fd;
    int error; // errno of the first write that failed
} sink;

// ---- the library's callbacks

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

/// The library would print to stderr. Its words are asked for afterwards, by code: in here the context is locked.
static void stay_quiet(exr_const_context_t context, exr_result_t code, const char *text) {
    (void)context, (void)code, (void)text;
}

// ---- header

void skv_exr_add_float(skv_exr_header *header, const char *name, float value) {
    if (header->result == EXR_ERR_SUCCESS)
        header->result = exr_attr_set_float(header->context, header->part, name, value);
}

void skv_exr_add_string(skv_exr_header *header, const char *name, const char *value) {
    if (header->result == EXR_ERR_SUCCESS && value)
        header->result = exr_attr_set_string(header->context, header->part, name, value);
}

void skv_exr_add_extras(skv_exr_header *header, const skv_exr_extra *extra, size_t extras) {
    for (size_t i = 0; i < extras; i++)
        skv_exr_add_float(header, extra[i].name, extra[i].value);
}

void skv_exr_add_chromaticities(skv_exr_header *header) {
    static const exr_attr_chromaticities_t bt709_d65 = {.red_x = 0.64f,
                                                        .red_y = 0.33f,
                                                        .green_x = 0.30f,
                                                        .green_y = 0.60f,
                                                        .blue_x = 0.15f,
                                                        .blue_y = 0.06f,
                                                        .white_x = 0.3127f,
                                                        .white_y = 0.3290f};
    if (header->result == EXR_ERR_SUCCESS)
        header->result = exr_attr_set_chromaticities(header->context, header->part, "chromaticities", &bt709_d65);
}

static int channels_of(const skv_exr_raster *raster) {
    return raster->layers * raster->channels;
}

static void channel_name(const skv_exr_raster *raster, int index, char name[NAME_SIZE]) {
    const int layer = index / raster->channels;
    const char letter = "RGBA"[index % raster->channels];
    if (layer == 0)
        snprintf(name, NAME_SIZE, "%c", letter);
    else
        snprintf(name, NAME_SIZE, "%.20s.%c", raster->layer_name[layer], letter);
}

static void add_channels(skv_exr_header *header, const skv_exr_raster *raster) {
    const exr_pixel_type_t type = raster->half ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT;
    char name[NAME_SIZE];
    for (int i = 0; i < channels_of(raster) && header->result == EXR_ERR_SUCCESS; i++) {
        channel_name(raster, i, name);
        header->result = exr_add_channel(header->context, header->part, name, type, raster->treatment, 1, 1);
    }
}

static exr_result_t write_header(exr_context_t context, int *part, const skv_exr_raster *raster,
                                 skv_exr_describe describe, const void *what) {
    exr_result_t rv = exr_add_part(context, NULL, EXR_STORAGE_SCANLINE, part);
    if (rv == EXR_ERR_SUCCESS)
        rv = exr_initialize_required_attr_simple(context, *part, raster->width, raster->height, EXR_COMPRESSION_ZIP);
    skv_exr_header header = {context, *part, rv};
    add_channels(&header, raster);
    if (header.result == EXR_ERR_SUCCESS)
        describe(&header, what);
    return header.result == EXR_ERR_SUCCESS ? exr_write_header(context) : header.result;
}

// ---- values

/// The library's own compression of a chunk.
typedef struct compression {
    exr_result_t (*run)(exr_encode_pipeline_t *encoder);
} compression;

/// A file while its chunks are written.
typedef struct writer {
    exr_context_t context;
    int part;
    const skv_exr_raster *raster;
    float *lines; // a chunk's: [layer][CHUNK_LINES][width][channel], finite in the file's type
    exr_encode_pipeline_t encoder;
    compression library;
} writer;

static size_t line_values(const skv_exr_raster *raster) {
    return (size_t)raster->width * (size_t)raster->channels;
}

static float finite_within(float x, float limit) {
    return isnan(x) ? 0.0f : x > limit ? limit : x < -limit ? -limit : x;
}

/// The lines [y, y + CHUNK_LINES) of all layers, as far as there are.
static void copy_lines(writer *w, int y) {
    const skv_exr_raster *const raster = w->raster;
    const size_t line = line_values(raster), layer = line * (size_t)raster->height;
    const size_t lines = (size_t)(raster->height - y < CHUNK_LINES ? raster->height - y : CHUNK_LINES);
    const float limit = raster->half ? HALF_MAX : FLT_MAX;
    for (int l = 0; l < raster->layers; l++) {
        const float *const from = raster->values + (size_t)l * layer + (size_t)y * line;
        float *const to = w->lines + (size_t)l * CHUNK_LINES * line;
        for (size_t i = 0; i < lines * line; i++)
            to[i] = finite_within(from[i], limit);
    }
}

/// The library sorts channels by name: which of ours this is.
static int channel_index(const skv_exr_raster *raster, const char *sorted_name) {
    char name[NAME_SIZE];
    int i = 0;
    for (; i < channels_of(raster) - 1; i++) {
        channel_name(raster, i, name);
        if (strcmp(name, sorted_name) == 0)
            break;
    }
    return i;
}

static void point_to_lines(writer *w) {
    const int channels = w->raster->channels;
    const size_t line = line_values(w->raster);
    for (int c = 0; c < w->encoder.channel_count; c++) {
        exr_coding_channel_info_t *const channel = &w->encoder.channels[c];
        const int i = channel_index(w->raster, channel->channel_name);
        const float *const from = w->lines + (size_t)(i / channels) * CHUNK_LINES * line + i % channels;
        channel->encode_from_ptr = (const uint8_t *)from;
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_bytes_per_element = sizeof(float);
        channel->user_pixel_stride = channels * (int)sizeof(float);
        channel->user_line_stride = (int)(line * sizeof(float));
    }
}

/// OpenEXRCore 3.1 stores the values themselves where ZIP makes them longer, but not where it leaves them as long as
/// they are; readers take such a chunk for values.
static exr_result_t compress(exr_encode_pipeline_t *encoder) {
    const compression *const library = encoder->encoding_user_data;
    const exr_result_t rv = library->run(encoder);
    if (rv == EXR_ERR_SUCCESS && encoder->compressed_bytes == encoder->packed_bytes &&
        encoder->compressed_buffer != encoder->packed_buffer)
        memcpy(encoder->compressed_buffer, encoder->packed_buffer, encoder->packed_bytes);
    return rv;
}

static exr_result_t choose_routines(writer *w) {
    const exr_result_t rv = exr_encoding_choose_default_routines(w->context, w->part, &w->encoder);
    if (rv == EXR_ERR_SUCCESS && w->encoder.compress_fn) {
        w->library.run = w->encoder.compress_fn;
        w->encoder.encoding_user_data = &w->library;
        w->encoder.compress_fn = compress;
    }
    return rv;
}

static exr_result_t write_chunk(writer *w, int y) {
    exr_chunk_info_t chunk;
    exr_result_t rv = exr_write_scanline_chunk_info(w->context, w->part, y, &chunk);
    if (rv == EXR_ERR_SUCCESS)
        rv = y == 0 ? exr_encoding_initialize(w->context, w->part, &chunk, &w->encoder)
                    : exr_encoding_update(w->context, w->part, &chunk, &w->encoder);
    if (rv != EXR_ERR_SUCCESS)
        return rv;
    copy_lines(w, y);
    point_to_lines(w);
    if (y == 0)
        rv = choose_routines(w);
    return rv == EXR_ERR_SUCCESS ? exr_encoding_run(w->context, w->part, &w->encoder) : rv;
}

static exr_result_t write_values(exr_context_t context, int part, const skv_exr_raster *raster) {
    writer w = {.context = context, .part = part, .raster = raster, .encoder = EXR_ENCODE_PIPELINE_INITIALIZER};
    exr_result_t rv = EXR_ERR_SUCCESS;
    w.lines = malloc((size_t)raster->layers * CHUNK_LINES * line_values(raster) * sizeof *w.lines);
    if (!w.lines)
        return EXR_ERR_OUT_OF_MEMORY;
    for (int y = 0; y < raster->height && rv == EXR_ERR_SUCCESS; y += CHUNK_LINES)
        rv = write_chunk(&w, y);
    (void)exr_encoding_destroy(context, &w.encoder);
    free(w.lines);
    return rv;
}

// ---- a file

static exr_result_t write_file(sink *out, const skv_exr_raster *raster, skv_exr_describe describe, const void *what) {
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.error_handler_fn = stay_quiet;
    setup.user_data = out;
    setup.write_fn = sink_write;
    exr_context_t context = NULL;
    int part = 0;
    exr_result_t rv = exr_start_write(&context, "raster", EXR_WRITE_FILE_DIRECTLY, &setup);
    if (rv != EXR_ERR_SUCCESS)
        return rv;
    rv = write_header(context, &part, raster, describe, what);
    if (rv == EXR_ERR_SUCCESS)
        rv = write_values(context, part, raster);
    const exr_result_t end = exr_finish(&context); // writes the table of chunks
    return rv == EXR_ERR_SUCCESS ? end : rv;
}

int skv_exr_refuse(const char *words, char *message, size_t message_size) {
    if (message && message_size >= 1)
        snprintf(message, message_size, "%s", words);
    return SKV_EXR_ERR_ARGUMENT;
}

int skv_exr_raster_write(int fd, const skv_exr_raster *raster, skv_exr_describe describe, const void *what,
                         char *message, size_t message_size) {
    if (!message || message_size < 1)
        return SKV_EXR_ERR_ARGUMENT;
    message[0] = '\0';
    sink out = {.fd = fd};
    const exr_result_t rv = write_file(&out, raster, describe, what);
    if (out.error != 0) {
        snprintf(message, message_size, "%s", strerror(out.error));
        return SKV_EXR_ERR_WRITE;
    }
    if (rv != EXR_ERR_SUCCESS)
        snprintf(message, message_size, "%s", exr_get_default_error_message(rv));
    return rv == EXR_ERR_SUCCESS ? SKV_EXR_OK : SKV_EXR_ERR_LIBRARY;
}
