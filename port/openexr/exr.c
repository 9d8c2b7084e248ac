// OpenEXRCore writer: header, attributes, then chunk after chunk through the library's own ZIP encoder. Writing goes
// through our own function so that every failure of the system is seen, with its errno, also those at the very end.
#include "skv_exr.h"

#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <openexr.h>

/// Largest finite half; from 65520 on a half is infinite.
#define HALF_MAX 65504.0f
/// Lines of a ZIP chunk: a property of the format.
#define CHUNK_LINES 16

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

static const exr_attr_chromaticities_t bt709_d65 = {.red_x = 0.64f,
                                                    .red_y = 0.33f,
                                                    .green_x = 0.30f,
                                                    .green_y = 0.60f,
                                                    .blue_x = 0.15f,
                                                    .blue_y = 0.06f,
                                                    .white_x = 0.3127f,
                                                    .white_y = 0.3290f};

static exr_result_t set_string(exr_context_t context, int part, const char *name, const char *value) {
    return value ? exr_attr_set_string(context, part, name, value) : EXR_ERR_SUCCESS;
}

static exr_result_t add_channels(exr_context_t context, int part, const skv_exr_image *image) {
    static const char *const names[4] = {"R", "G", "B", "A"};
    const exr_pixel_type_t type = image->half ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT;
    exr_result_t rv = EXR_ERR_SUCCESS;
    for (int c = 0; c < image->channels && rv == EXR_ERR_SUCCESS; c++)
        rv = exr_add_channel(context, part, names[c], type, EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    return rv;
}

static exr_result_t add_colour(exr_context_t context, int part, const skv_exr_image *image) {
    exr_result_t rv = exr_attr_set_chromaticities(context, part, "chromaticities", &bt709_d65);
    if (rv == EXR_ERR_SUCCESS)
        rv = exr_attr_set_float(context, part, "whiteLuminance", image->white_luminance);
    if (rv == EXR_ERR_SUCCESS && image->latlong)
        rv = exr_attr_set_envmap(context, part, "envmap", EXR_ENVMAP_LATLONG);
    return rv;
}

static exr_result_t add_capture(exr_context_t context, int part, const skv_exr_image *image) {
    exr_result_t rv = EXR_ERR_SUCCESS;
    if (image->has_position) {
        rv = exr_attr_set_float(context, part, "latitude", image->latitude_deg);
        if (rv == EXR_ERR_SUCCESS)
            rv = exr_attr_set_float(context, part, "longitude", image->longitude_deg);
        if (rv == EXR_ERR_SUCCESS)
            rv = exr_attr_set_float(context, part, "altitude", image->altitude_m);
    }
    if (rv == EXR_ERR_SUCCESS && image->cap_date) {
        rv = exr_attr_set_string(context, part, "capDate", image->cap_date);
        if (rv == EXR_ERR_SUCCESS)
            rv = exr_attr_set_float(context, part, "utcOffset", image->utc_offset_s);
    }
    return rv;
}

static exr_result_t add_words(exr_context_t context, int part, const skv_exr_image *image) {
    exr_result_t rv = set_string(context, part, "owner", image->owner);
    if (rv == EXR_ERR_SUCCESS)
        rv = set_string(context, part, "software", image->software);
    if (rv == EXR_ERR_SUCCESS)
        rv = set_string(context, part, "comments", image->comments);
    for (size_t i = 0; i < image->extras && rv == EXR_ERR_SUCCESS; i++)
        rv = exr_attr_set_float(context, part, image->extra[i].name, image->extra[i].value);
    return rv;
}

static exr_result_t write_header(exr_context_t context, int *part, const skv_exr_image *image) {
    exr_result_t rv = exr_add_part(context, NULL, EXR_STORAGE_SCANLINE, part);
    if (rv == EXR_ERR_SUCCESS)
        rv = exr_initialize_required_attr_simple(context, *part, image->width, image->height, EXR_COMPRESSION_ZIP);
    if (rv == EXR_ERR_SUCCESS)
        rv = exr_set_screen_window_width(context, *part, image->screen_window_width);
    if (rv == EXR_ERR_SUCCESS)
        rv = add_channels(context, *part, image);
    if (rv == EXR_ERR_SUCCESS)
        rv = add_colour(context, *part, image);
    if (rv == EXR_ERR_SUCCESS)
        rv = add_capture(context, *part, image);
    if (rv == EXR_ERR_SUCCESS)
        rv = add_words(context, *part, image);
    return rv == EXR_ERR_SUCCESS ? exr_write_header(context) : rv;
}

// ---- pixels

static float finite_within(float x, float limit) {
    if (isnan(x))
        return 0.0f;
    return x > limit ? limit : x < -limit ? -limit : x;
}

/// Index in a pixel of the channel that the file calls `name`.
static int channel_index(const char *name) {
    return name[0] == 'R' ? 0 : name[0] == 'G' ? 1 : name[0] == 'B' ? 2 : 3;
}

static void point_to(exr_encode_pipeline_t *encoder, const float *lines, const skv_exr_image *image) {
    for (int c = 0; c < encoder->channel_count; c++) {
        exr_coding_channel_info_t *channel = &encoder->channels[c];
        channel->encode_from_ptr = (const uint8_t *)(lines + channel_index(channel->channel_name));
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_bytes_per_element = sizeof(float);
        channel->user_pixel_stride = image->channels * (int)sizeof(float);
        channel->user_line_stride = image->width * image->channels * (int)sizeof(float);
    }
}

/// The library's own compression of a chunk.
typedef struct compression {
    exr_result_t (*run)(exr_encode_pipeline_t *encoder);
} compression;

/// OpenEXRCore 3.1 stores the pixels themselves where ZIP makes them longer, but not where it leaves them as long as
/// they are; readers take such a chunk for pixels.
static exr_result_t compress(exr_encode_pipeline_t *encoder) {
    const compression *const library = encoder->encoding_user_data;
    const exr_result_t rv = library->run(encoder);
    if (rv == EXR_ERR_SUCCESS && encoder->compressed_bytes == encoder->packed_bytes &&
        encoder->compressed_buffer != encoder->packed_buffer)
        memcpy(encoder->compressed_buffer, encoder->packed_buffer, encoder->packed_bytes);
    return rv;
}

static exr_result_t choose_routines(exr_context_t context, int part, exr_encode_pipeline_t *encoder,
                                    compression *library) {
    const exr_result_t rv = exr_encoding_choose_default_routines(context, part, encoder);
    if (rv == EXR_ERR_SUCCESS && encoder->compress_fn) {
        library->run = encoder->compress_fn;
        encoder->encoding_user_data = library;
        encoder->compress_fn = compress;
    }
    return rv;
}

static exr_result_t encode_chunk(exr_context_t context, int part, exr_encode_pipeline_t *encoder, compression *library,
                                 const skv_exr_image *image, int y, const float *lines) {
    exr_chunk_info_t chunk;
    exr_result_t rv = exr_write_scanline_chunk_info(context, part, y, &chunk);
    if (rv == EXR_ERR_SUCCESS)
        rv = y == 0 ? exr_encoding_initialize(context, part, &chunk, encoder)
                    : exr_encoding_update(context, part, &chunk, encoder);
    if (rv != EXR_ERR_SUCCESS)
        return rv;
    point_to(encoder, lines, image);
    if (y == 0)
        rv = choose_routines(context, part, encoder, library);
    return rv == EXR_ERR_SUCCESS ? exr_encoding_run(context, part, encoder) : rv;
}

/// Chunk after chunk from a copy of its lines in which every value is finite in the file's type.
static exr_result_t write_pixels(exr_context_t context, int part, const skv_exr_image *image) {
    const size_t line = (size_t)image->width * (size_t)image->channels;
    const float limit = image->half ? HALF_MAX : FLT_MAX;
    float *copy = malloc(CHUNK_LINES * line * sizeof *copy);
    exr_encode_pipeline_t encoder = EXR_ENCODE_PIPELINE_INITIALIZER;
    compression library = {NULL};
    exr_result_t rv = copy ? EXR_ERR_SUCCESS : EXR_ERR_OUT_OF_MEMORY;
    int y = 0;
    for (; y < image->height && rv == EXR_ERR_SUCCESS; y += CHUNK_LINES) {
        const int lines = image->height - y < CHUNK_LINES ? image->height - y : CHUNK_LINES;
        const float *from = image->pixels + (size_t)y * line;
        for (size_t i = 0; i < (size_t)lines * line; i++)
            copy[i] = finite_within(from[i], limit);
        rv = encode_chunk(context, part, &encoder, &library, image, y, copy);
    }
    if (y > 0)
        (void)exr_encoding_destroy(context, &encoder);
    free(copy);
    return rv;
}

// ---- the public call

static const char *bad_field(const skv_exr_image *image) {
    if (!image || !image->pixels)
        return "no pixels";
    if (image->width < 1 || image->width > SKV_EXR_SIDE_MAX || image->height < 1 || image->height > SKV_EXR_SIDE_MAX)
        return "width or height out of range";
    if (image->channels != 3 && image->channels != 4)
        return "channels: 3 or 4";
    if (!(image->white_luminance > 0.0f) || !(image->screen_window_width > 0.0f))
        return "white_luminance and screen_window_width must be above 0";
    if (image->extras > 0 && !image->extra)
        return "no extra attributes at their pointer";
    return NULL;
}

int skv_exr_write(int fd, const skv_exr_image *image, char *message, size_t message_size) {
    const char *bad = !message || message_size < 1 ? "no room for a message" : bad_field(image);
    if (bad) {
        if (message && message_size >= 1)
            snprintf(message, message_size, "%s", bad);
        return SKV_EXR_ERR_ARGUMENT;
    }
    message[0] = '\0';
    sink out = {.fd = fd};
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
    setup.error_handler_fn = stay_quiet;
    setup.user_data = &out;
    setup.write_fn = sink_write;
    exr_context_t context = NULL;
    int part = 0;
    exr_result_t rv = exr_start_write(&context, "picture", EXR_WRITE_FILE_DIRECTLY, &setup);
    if (rv == EXR_ERR_SUCCESS) {
        rv = write_header(context, &part, image);
        if (rv == EXR_ERR_SUCCESS)
            rv = write_pixels(context, part, image);
        const exr_result_t end = exr_finish(&context); // writes the table of chunks
        rv = rv == EXR_ERR_SUCCESS ? end : rv;
    }
    if (out.error != 0) {
        snprintf(message, message_size, "%s", strerror(out.error));
        return SKV_EXR_ERR_WRITE;
    }
    if (rv != EXR_ERR_SUCCESS)
        snprintf(message, message_size, "%s", exr_get_default_error_message(rv));
    return rv == EXR_ERR_SUCCESS ? SKV_EXR_OK : SKV_EXR_ERR_LIBRARY;
}
