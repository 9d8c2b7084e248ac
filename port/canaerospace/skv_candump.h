/// Log files of candump (can-utils), line by line: `(1436509052.249713) vcan0 123#0011223344556677`.
/// No allocation and no I/O but by the caller's lines; strict: what is not understood is an error with its reason.
///
///     123#1122       11-bit id (three digits)     00000123#1122  29-bit id (eight digits)
///     123#R, 123#R4  remote request               20000040#...   error frame (bit 29 of the eight digits)
///     123##1112233   CAN FD: skipped and counted  (at its end a line may carry T or R: direction, ignored)
#ifndef SKV_CANDUMP_H
#define SKV_CANDUMP_H

#include <stddef.h>
#include <stdint.h>

#include "skv_canaerospace.h"

#ifdef __cplusplus
extern "C" {
#endif

#define SKV_CANDUMP_LINE 96 ///< bytes of the longest line written, its end included

typedef struct skv_candump_entry {
    int64_t time_ns;    ///< of the log's clock, since 1970; six or nine digits behind the point
    char interface[16]; ///< as in the log
    skv_can_frame frame;
} skv_candump_entry;

typedef enum skv_candump_result {
    SKV_CANDUMP_FRAME = 0, ///< entry was written
    SKV_CANDUMP_EMPTY,     ///< nothing on the line
    SKV_CANDUMP_FD,        ///< a CAN FD or CAN XL frame: skipped
    SKV_CANDUMP_ERROR,     ///< not a line of candump: reason says why
} skv_candump_result;

/// A reader's state. Start: all 0.
typedef struct skv_candump_reader {
    uint64_t line;       ///< lines seen: the number of the last one
    uint64_t frames;     ///< of SKV_CANDUMP_FRAME
    uint64_t fd_skipped; ///< of SKV_CANDUMP_FD
    uint64_t backwards;  ///< frames whose time lies before the one before
    int64_t last_ns;     ///< private
    const char *reason;  ///< why the last line was refused: a constant text
    int column;          ///< where, from 1
} skv_candump_reader;

/// One line, with or without its end (LF or CR LF).
/// @param[in] length  bytes of line; no 0 byte is needed behind it.
/// @return see skv_candump_result; entry is written only with SKV_CANDUMP_FRAME.
skv_candump_result skv_candump_read(skv_candump_reader *reader, const char *line, size_t length,
                                    skv_candump_entry *entry);

/// The line of an entry, with LF and a 0 byte; six digits behind the point, as candump -L writes it.
/// @param[in] size  bytes at line; SKV_CANDUMP_LINE is always enough.
/// @return bytes written but for the 0; SKV_ERR_NULL; SKV_ERR_SIZE; SKV_ERR_RANGE iff time_ns < 0 or the frame is none.
int skv_candump_write(char *line, size_t size, const skv_candump_entry *entry);

#ifdef __cplusplus
}
#endif
#endif
