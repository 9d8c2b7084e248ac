/// Linear sky pictures as OpenEXR files, through the C API (OpenEXRCore).
///
/// Pixels are linear RGB of ITU-R BT.709 primaries and D65 white, as skv_colour() makes them; the standard attributes
/// say what they mean: chromaticities, whiteLuminance, capDate + utcOffset, latitude, longitude, altitude, envmap.
/// Compression is ZIP (16 lines, exact). Needs a file that can be positioned (no pipe).
#ifndef SKV_PORT_EXR_H
#define SKV_PORT_EXR_H

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Largest width and height.
#define SKV_EXR_SIDE_MAX 16384

/// A number that has no standard attribute, kept under a name of the caller's.
typedef struct skv_exr_extra {
    const char *name; ///< at most 31 bytes
    float value;
} skv_exr_extra;

typedef struct skv_exr_image {
    int width;           ///< [1, SKV_EXR_SIDE_MAX]
    int height;          ///< [1, SKV_EXR_SIDE_MAX]
    int channels;        ///< 3 = RGB, 4 = RGBA with premultiplied alpha
    const float *pixels; ///< [height][width][channels], top row first
    bool half;           ///< 16 bits a channel: finite values beyond +-65504 are clamped there, never infinite

    float white_luminance;     ///< cd/m2 of (1,1,1), > 0
    bool latlong;              ///< writes envmap = latlong
    float screen_window_width; ///< at distance 1, of a perspective picture: 2 tan(fov/2); 1 elsewhere

    bool has_position;
    float latitude_deg, longitude_deg; ///< north and east positive
    float altitude_m;                  ///< above the sea
    const char *cap_date;              ///< "YYYY:MM:DD hh:mm:ss", local time; NULL = none
    float utc_offset_s;                ///< UTC = local + offset

    const char *owner;    ///< NULL = none
    const char *software; ///< NULL = none
    const char *comments; ///< NULL = none
    const skv_exr_extra *extra;
    size_t extras;
} skv_exr_image;

/// Answers of all calls of this port.
enum {
    SKV_EXR_OK = 0,
    SKV_EXR_ERR_ARGUMENT = -1, ///< a field is outside its range, or a pointer that must be set is NULL
    SKV_EXR_ERR_WRITE = -2,    ///< the system refused a write: errno is in the message
    SKV_EXR_ERR_LIBRARY = -3,  ///< OpenEXRCore refused, in its words; no memory
};

/// Writes a picture to an open file, from its position 0.
/// NaN counts as 0, infinities as the largest finite value of the same sign.
/// @param[in]  fd       open for writing, empty; stays open.
/// @param[in]  image
/// @param[out] message  one line without a newline when the answer is not SKV_EXR_OK; message_size >= 1.
/// @return SKV_EXR_OK or a negative code above; then what the file holds is of no use.
int skv_exr_write(int fd, const skv_exr_image *image, char *message, size_t message_size);

#ifdef __cplusplus
}
#endif
#endif
