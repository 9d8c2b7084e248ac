/// What pictures and tables have in common as OpenEXR files: one scanline part, ZIP, chunk after chunk. Private.
#ifndef SKV_PORT_EXR_RASTER_H
#define SKV_PORT_EXR_RASTER_H

#include <openexr.h>

#include "skv_exr.h"

typedef struct skv_exr_raster {
    int width, height;             ///< >= 1; the largest are the caller's to check
    int layers;                    ///< >= 1
    int channels;                  ///< of each layer, 1 to 4: R, G, B, A; in further layers NAME.R and so on
    const char *const *layer_name; ///< [layers], at most 20 bytes each; [0] is not used
    const float *values;           ///< [layer][height][width][channel]; NaN and infinities as in skv_exr_write()
    bool half;
    exr_perceptual_treatment_t treatment;
} skv_exr_raster;

/// A file's header while it is filled. After an attribute that failed nothing more is added.
typedef struct skv_exr_header {
    exr_context_t context;
    int part;
    exr_result_t result;
} skv_exr_header;

void skv_exr_add_float(skv_exr_header *header, const char *name, float value);
/// @param value  NULL = none
void skv_exr_add_string(skv_exr_header *header, const char *name, const char *value);
void skv_exr_add_extras(skv_exr_header *header, const skv_exr_extra *extra, size_t extras);
/// Primaries of BT.709, white D65.
void skv_exr_add_chromaticities(skv_exr_header *header);

/// Adds to a header what its kind of file has beside the required attributes.
typedef void (*skv_exr_describe)(skv_exr_header *header, const void *what);

/// @param[in]  fd, message, message_size  as in skv_exr_write()
/// @param[in]  raster
/// @param[in]  describe  is given `what`
/// @return as skv_exr_write()
int skv_exr_raster_write(int fd, const skv_exr_raster *raster, skv_exr_describe describe, const void *what,
                         char *message, size_t message_size);

/// Says what is wrong with an argument. @return SKV_EXR_ERR_ARGUMENT
int skv_exr_refuse(const char *words, char *message, size_t message_size);

#endif
