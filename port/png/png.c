// libpng writer. libpng reports errors by longjmp: everything that lives across it is in one struct.
#include "skv_png.h"

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <png.h>

#define TEXTS_MAX 16

typedef struct sink {
    int fd;
    int error; // errno of the write that failed
    char *message;
    size_t message_size;
} sink;

static void sink_write(png_structp png, png_bytep bytes, size_t size) {
    sink *out = png_get_io_ptr(png);
    size_t done = 0;
    while (done < size) {
        const ssize_t n = write(out->fd, bytes + done, size - done);
        if (n > 0) {
            done += (size_t)n;
        } else if (n == 0 || errno != EINTR) {
            out->error = n == 0 ? ENOSPC : errno;
            png_error(png, strerror(out->error));
        }
    }
}

static void sink_flush(png_structp png) {
    (void)png;
}

static void keep_error(png_structp png, png_const_charp text) {
    sink *out = png_get_error_ptr(png);
    snprintf(out->message, out->message_size, "%s", text);
    png_longjmp(png, 1);
}

/// What libpng warns of is not wrong in the file: not shown.
static void drop_warning(png_structp png, png_const_charp text) {
    (void)png;
    (void)text;
}

static void write_texts(png_structp png, png_infop info, const skv_png_image *image) {
    png_text text[TEXTS_MAX];
    memset(text, 0, sizeof text);
    for (size_t i = 0; i < image->texts; i++) { // libpng copies both strings and writes to neither
        text[i].compression = PNG_TEXT_COMPRESSION_NONE;
        text[i].key = (png_charp)(uintptr_t)image->text[i].key;
        text[i].text = (png_charp)(uintptr_t)image->text[i].value;
    }
    if (image->texts > 0)
        png_set_text(png, info, text, (int)image->texts);
}

static bool little_endian(void) {
    const uint16_t one = 1;
    unsigned char first;
    memcpy(&first, &one, 1);
    return first == 1;
}

static void write_all(png_structp png, png_infop info, const skv_png_image *image) {
    const int type = image->channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB;
    const size_t line = (size_t)image->width * (size_t)image->channels * (size_t)(image->bits / 8);
    png_set_IHDR(png, info, (png_uint_32)image->width, (png_uint_32)image->height, image->bits, type,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    write_texts(png, info, image);
    png_write_info(png, info);
    if (image->bits == 16 && little_endian())
        png_set_swap(png);
    for (int y = 0; y < image->height; y++)
        png_write_row(png, (png_const_bytep)image->pixels + (size_t)y * line);
    png_write_end(png, NULL);
}

static const char *bad_field(const skv_png_image *image) {
    if (!image || !image->pixels)
        return "no pixels";
    if (image->width < 1 || image->width > SKV_PNG_SIDE_MAX || image->height < 1 || image->height > SKV_PNG_SIDE_MAX)
        return "width or height out of range";
    if ((image->channels != 3 && image->channels != 4) || (image->bits != 8 && image->bits != 16))
        return "channels: 3 or 4; bits: 8 or 16";
    if (image->texts > TEXTS_MAX || (image->texts > 0 && !image->text))
        return "at most 16 texts";
    return NULL;
}

int skv_png_write(int fd, const skv_png_image *image, char *message, size_t message_size) {
    const char *bad = !message || message_size < 1 ? "no room for a message" : bad_field(image);
    if (bad) {
        if (message && message_size >= 1)
            snprintf(message, message_size, "%s", bad);
        return SKV_PNG_ERR_ARGUMENT;
    }
    message[0] = '\0';
    sink out = {.fd = fd, .message = message, .message_size = message_size};
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &out, keep_error, drop_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!info) {
        png_destroy_write_struct(&png, NULL);
        snprintf(message, message_size, "no memory for libpng");
        return SKV_PNG_ERR_LIBRARY;
    }
    png_set_write_fn(png, &out, sink_write, sink_flush);
    if (setjmp(png_jmpbuf(png)) != 0) {
        png_destroy_write_struct(&png, &info);
        return out.error != 0 ? SKV_PNG_ERR_WRITE : SKV_PNG_ERR_LIBRARY;
    }
    write_all(png, info, image);
    png_destroy_write_struct(&png, &info);
    return SKV_PNG_OK;
}
