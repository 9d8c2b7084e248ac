/// texels FILE.raw16f: one line a texel, "layer x y z value...", values as they stand in the file over their scale.
/// Compiled with -DBAKED='"FILE"' it prints those of a C file (--name baked).
#include "sky.h"

#ifdef BAKED
#include BAKED
#endif

int main(int argc, char **argv) {
    skv_bake_table t;
#ifdef BAKED
    (void)argc, (void)argv;
    t = baked;
#else
    if (argc != 2)
        stop("usage: texels FILE.raw16f");
    table_read(argv[1], &t);
#endif
    for (int32_t layer = 0; layer < t.layers; layer++)
        for (int32_t z = 0; z < t.depth; z++)
            for (int32_t y = 0; y < t.height; y++)
                for (int32_t x = 0; x < t.width; x++) {
                    float value[4] = {0.0f, 0.0f, 0.0f, 0.0f};
                    skv_bake_add(&t, layer, x, y, z, 1.0f, value);
                    printf("%d %d %d %d", (int)layer, (int)x, (int)y, (int)z);
                    for (int32_t c = 0; c < t.channels; c++)
                        printf(" %.6g", (double)value[c]);
                    printf("\n");
                }
    return 0;
}
