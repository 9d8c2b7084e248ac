/// Two-dimensional tables of four bands, read as a graphics card reads a texture.
#ifndef TOOLS_BASELINES_TEXTURE_H
#define TOOLS_BASELINES_TEXTURE_H

#include <stddef.h>

typedef struct texture {
    int width, height;
    float (*texel)[4]; ///< [height][width]
} texture;

/// @return 0; -1 out of memory (nothing to free then).
int texture_make(texture *t, int width, int height);
void texture_free(texture *t);
/// Bytes when a texel takes `bytes`.
size_t texture_bytes(const texture *t, size_t bytes);

/// Bilinear between the centres of texels; (0, 0) is the centre of the first. Beyond the edges the edge's value; with
/// `wrap`, x goes round.
void texture_at(const texture *t, double x, double y, int wrap, double value[4]);

#endif
