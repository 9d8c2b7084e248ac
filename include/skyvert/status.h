/// What every call answers. SKV_OK is 0, errors are negative.
#ifndef SKYVERT_STATUS_H
#define SKYVERT_STATUS_H

#ifdef __cplusplus
extern "C" {
#endif

typedef enum skv_status {
    SKV_OK = 0,
    SKV_ERR_NULL = -1,  ///< a pointer that must be set is NULL
    SKV_ERR_RANGE = -2, ///< a parameter is outside its documented range, infinite or NaN
    SKV_ERR_DIRECTION =
        -3, ///< a direction is zero, infinite or NaN; in a batch: that ray's outputs are 0, all others are valid
    SKV_ERR_SIZE = -4,        ///< the caller's buffer is too small
    SKV_ERR_UNSUPPORTED = -5, ///< left out at compile time (config.h), or no such choice
    SKV_ERR_LAYOUT = -6,      ///< the struct was not built, or was built with another config.h selection
    SKV_ERR_DAMAGED = -7,     ///< stored bytes were changed
    SKV_ERR_MODEL = -8,       ///< a table was built from another model
} skv_status;

#ifdef __cplusplus
}
#endif
#endif
