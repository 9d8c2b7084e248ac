/// Tables read with bilinear interpolation.
#include "texture.h"

#include <math.h>
#include <stdlib.h>

int texture_make(texture *t, int width, int height) {
    *t = (texture){width, height, calloc((size_t)width * (size_t)height, sizeof *t->texel)};
    return t->texel ? 0 : -1;
}

void texture_free(texture *t) {
    free(t->texel);
    t->texel = NULL;
}

size_t texture_bytes(const texture *t, size_t bytes) {
    return (size_t)t->width * (size_t)t->height * bytes;
}

/// The two neighbours of x on an axis of n texels, and the weight of the second.
static double neighbours(double x, int n, int wrap, int pair[2]) {
    if (wrap) {
        const double low = floor(x);
        pair[0] = ((int)low % n + n) % n;
        pair[1] = (pair[0] + 1) % n;
        return x - low;
    }
    const double inside = fmin(fmax(x, 0.0), n - 1);
    pair[0] = n > 1 && inside >= n - 1 ? n - 2 : (int)inside;
    pair[1] = n > 1 ? pair[0] + 1 : pair[0];
    return inside - pair[0];
}

void texture_at(const texture *t, double x, double y, int wrap, double value[4]) {
    int column[2], row[2];
    const double u = neighbours(x, t->width, wrap, column), v = neighbours(y, t->height, 0, row);
    const float *const a = t->texel[row[0] * t->width + column[0]], *const b = t->texel[row[0] * t->width + column[1]];
    const float *const c = t->texel[row[1] * t->width + column[0]], *const d = t->texel[row[1] * t->width + column[1]];
    for (int i = 0; i < 4; i++) {
        const double low = (double)a[i] + u * (double)(b[i] - a[i]), high = (double)c[i] + u * (double)(d[i] - c[i]);
        value[i] = low + v * (high - low);
    }
}
