/// Numbers (not colours) as an OpenEXR file, through the C API (OpenEXRCore): any layers, a text that says what they
/// are. One scanline part, ZIP, half or float. Needs a file that can be positioned (no pipe).
#ifndef SKV_PORT_EXR_TEXTURE_H
#define SKV_PORT_EXR_TEXTURE_H

#include "skv_exr.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SKV_EXR_TEXTURE_SIDE_MAX   65536
#define SKV_EXR_TEXTURE_LAYERS_MAX 4

typedef struct skv_exr_texture {
    int width, height; ///< [1, SKV_EXR_TEXTURE_SIDE_MAX]
    int layers;        ///< [1, SKV_EXR_TEXTURE_LAYERS_MAX]
    int channels;      ///< of each layer, 1 to 4: R, G, B, A
    /// A layer's channels are called NAME.R and so on, those of the first layer without a name R and so on.
    const char *layer_name[SKV_EXR_TEXTURE_LAYERS_MAX]; ///< at most 20 bytes; [0] is not used
    const float *pixels;   ///< [layer][height][width][channel], top row first; NaN counts as 0
    bool half;             ///< 16 bits a channel; beyond +-65504: that
    bool colour;           ///< R, G, B are linear BT.709 of white D65: says so by `chromaticities`
    const char *software;  ///< NULL = none
    const char *comments;  ///< for people; NULL = none
    const char *text_name; ///< name of a further text, e.g. for programs; NULL = none
    const char *text;
    const skv_exr_extra *number; ///< float attributes
    size_t numbers;
} skv_exr_texture;

/// Writes to an open file, from its position 0.
/// @param[in]  fd       open for writing, empty; stays open.
/// @param[in]  texture
/// @param[out] message  one line without a newline when the answer is not SKV_EXR_OK; message_size >= 1.
/// @return SKV_EXR_OK or a negative code of skv_exr.h; then what the file holds is of no use.
int skv_exr_texture_write(int fd, const skv_exr_texture *texture, char *message, size_t message_size);

#ifdef __cplusplus
}
#endif
#endif
