/// Pictures for the eye as PNG files, through libpng: sRGB, 8 or 16 bits, with the sRGB, gAMA and cHRM chunks.
#ifndef SKV_PORT_PNG_H
#define SKV_PORT_PNG_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Largest width and height.
#define SKV_PNG_SIDE_MAX 32768

/// A Latin-1 text of the file, e.g. {"Title", "..."}.
typedef struct skv_png_text {
    const char *key; ///< 1 to 79 bytes
    const char *value;
} skv_png_text;

typedef struct skv_png_image {
    int width;          ///< [1, SKV_PNG_SIDE_MAX]
    int height;         ///< [1, SKV_PNG_SIDE_MAX]
    int channels;       ///< 3 = RGB, 4 = RGBA, alpha not premultiplied
    int bits;           ///< 8 or 16
    const void *pixels; ///< [height][width][channels] uint8_t or uint16_t (of this machine's order), top row first,
                        ///< with the sRGB transfer function
    const skv_png_text *text;
    size_t texts; ///< [0, 16]
} skv_png_image;

enum {
    SKV_PNG_OK = 0,
    SKV_PNG_ERR_ARGUMENT = -1, ///< a field is outside its range, or a pointer that must be set is NULL
    SKV_PNG_ERR_WRITE = -2,    ///< the system refused a write: errno is in the message
    SKV_PNG_ERR_LIBRARY = -3,  ///< libpng refused, in its words; no memory
};

/// Writes a picture to an open file, at its position.
/// @param[in]  fd       open for writing; stays open.
/// @param[in]  image
/// @param[out] message  one line without a newline when the answer is not SKV_PNG_OK; message_size >= 1.
/// @return SKV_PNG_OK or a negative code above; then what the file holds is of no use.
int skv_png_write(int fd, const skv_png_image *image, char *message, size_t message_size);

#ifdef __cplusplus
}
#endif
#endif
