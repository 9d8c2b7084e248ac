/// CANaerospace 1.7 [CANaerospace]: frames to values and back. Pure bytes: no I/O, no allocation, no clock, no globals
/// but const tables; for a PC as for a microcontroller.
///
/// A message is a classic CAN frame with an 11-bit id and
///     byte 0 node id | 1 data type | 2 service code | 3 message code | 4 to 7 data, big-endian.
/// The message code goes up by one with every frame of an id, from 255 on to 0.
///
/// Sender:   skv_cas_encode() or skv_cas_encode_bytes() with a skv_cas_sender, one frame or (DOUBLEH, DOUBLEL) two.
/// Receiver: skv_cas_receive() for every frame, skv_cas_tick() now and then, skv_cas_value() and its companions.
///           What is not right is counted and never reaches a value: see skv_cas_count.
/// Services: skv_cas_identify() answers the mandatory identification request; skv_cas_time_sync() reads service 1.
///
/// Not covered: redundant channels (ids moved by an offset), the other services, and sending on change.
#ifndef SKV_CANAEROSPACE_H
#define SKV_CANAEROSPACE_H

#include <stdint.h>

#include "skyvert/status.h"

#ifdef __cplusplus
extern "C" {
#endif

// The same struct stands in port/socketcan/skv_can_bus.h: ports do not depend on one another.
#ifndef SKV_CAN_FRAME
#define SKV_CAN_FRAME
/// A classic CAN frame.
typedef struct skv_can_frame {
    uint32_t id;     ///< 11 bits; 29 bits with SKV_CAN_EXTENDED; the error class with SKV_CAN_ERROR
    uint8_t length;  ///< data bytes, [0, 8]
    uint8_t flags;   ///< SKV_CAN_... or 0
    uint8_t data[8]; ///< bytes from length on are 0
} skv_can_frame;
#define SKV_CAN_EXTENDED 1u ///< a 29-bit id
#define SKV_CAN_RTR      2u ///< a remote request: no data
#define SKV_CAN_ERROR    4u ///< not from the bus: the driver reports an error
#endif

/// Data types: byte 1.
enum {
    SKV_CAS_NODATA = 0,
    SKV_CAS_FLOAT = 2,
    SKV_CAS_LONG = 3,
    SKV_CAS_ULONG = 4,
    SKV_CAS_SHORT = 6,
    SKV_CAS_UCHAR = 10,
    SKV_CAS_SHORT2 = 12,
    SKV_CAS_CHAR4 = 15,
    SKV_CAS_UCHAR4 = 16,
    SKV_CAS_DOUBLEH = 30, ///< the upper 32 bits of a double
    SKV_CAS_DOUBLEL = 31, ///< the lower 32 bits
};

/// What a frame carries, apart from its id.
typedef struct skv_cas_message {
    uint8_t node;    ///< sender; of a service request: the node asked, 0 = all
    uint8_t type;    ///< SKV_CAS_FLOAT ...
    uint8_t service; ///< 0 but for service messages
    uint8_t code;    ///< message code
    union {
        float f;      ///< FLOAT
        int32_t l;    ///< LONG
        uint32_t ul;  ///< ULONG, and the bits of DOUBLEH and DOUBLEL
        int16_t s[2]; ///< SHORT (the first), SHORT2
        uint8_t u[4]; ///< UCHAR (the first), UCHAR4
        int8_t c[4];  ///< CHAR4
    } data;
} skv_cas_message;

/// Bytes of data of a type: 0 to 4; -1 for a type that is none of the above.
int skv_cas_type_size(uint8_t type);

/// A frame from its parts; its length is 4 and the size of the type.
/// @param[in] id  [0, 0x7FF].
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_RANGE iff id is too large; SKV_ERR_UNSUPPORTED iff the type is none of the
/// above.
skv_status skv_cas_pack(skv_can_frame *frame, uint32_t id, const skv_cas_message *message);

/// The parts of a frame. Any float comes through, NaN too: skv_cas_receive() is what judges values.
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_RANGE iff the frame is extended, remote or an error, or its length fits
/// neither
///         its type nor 8; SKV_ERR_UNSUPPORTED iff the type is none of the above. On error nothing is written.
skv_status skv_cas_unpack(skv_cas_message *message, const skv_can_frame *frame);

/// The messages of this port, in the order of their ids. Ids below 1800 are the specification's own.
typedef enum skv_cas_index {
    SKV_CAS_PITCH = 0,          ///< 311 deg, nose up positive
    SKV_CAS_ROLL,               ///< 312 deg, right wing down positive
    SKV_CAS_ALTITUDE_RATE,      ///< 314 m/s, climbing positive
    SKV_CAS_BARO_ALTITUDE,      ///< 320 m above the sea, by pressure and the altimeter setting
    SKV_CAS_HEADING,            ///< 321 deg from north (the specification does not say which: see TRUE_HEADING)
    SKV_CAS_STANDARD_ALTITUDE,  ///< 322 m, pressure altitude at 1013.25 hPa
    SKV_CAS_AIR_TEMPERATURE,    ///< 324 K, static
    SKV_CAS_STATIC_PRESSURE,    ///< 326 hPa
    SKV_CAS_TRUE_ALTITUDE,      ///< 332 m above the sea
    SKV_CAS_OUTSIDE_AIR,        ///< 335 K, outside air temperature
    SKV_CAS_LATITUDE,           ///< 1036 deg, north positive
    SKV_CAS_LONGITUDE,          ///< 1037 deg, east positive
    SKV_CAS_GPS_HEIGHT,         ///< 1038 m above the ellipsoid (WGS84)
    SKV_CAS_GROUND_SPEED,       ///< 1039 m/s
    SKV_CAS_TRACK,              ///< 1040 deg from true north
    SKV_CAS_RADIO_HEIGHT,       ///< 1070 m above the ground
    SKV_CAS_TRUE_HEADING,       ///< 1133 deg from true north
    SKV_CAS_UTC,                ///< 1200 bytes: hour, minute, second (60: leap), 0
    SKV_CAS_DATE,               ///< 1206 bytes: day, month, century (20), year of the century
    SKV_CAS_SUN_AZIMUTH,        ///< 1800 deg from true north
    SKV_CAS_SUN_ELEVATION,      ///< 1801 deg, geometric
    SKV_CAS_MOON_AZIMUTH,       ///< 1802 deg from true north
    SKV_CAS_MOON_ELEVATION,     ///< 1803 deg, geometric, parallax included
    SKV_CAS_MOON_PHASE,         ///< 1804 deg, phase angle: 0 full, 180 new
    SKV_CAS_VISIBILITY,         ///< 1805 m, meteorological
    SKV_CAS_EXPOSURE,           ///< 1806 m2/cd: k of 1 - exp(-k L)
    SKV_CAS_ZENITH_LUMINANCE,   ///< 1807 cd/m2
    SKV_CAS_SKY_STATE,          ///< 1808 bytes: SKV_CAS_DAY ..., SKV_CAS_LAMP_... bits, how many values are stale, 0
    SKV_CAS_TIME_OFFSET,        ///< 1809 s to add to UTC: what a knob for the time of day says
    SKV_CAS_VISIBILITY_SETTING, ///< 1810 m: what a knob for the visibility says
    SKV_CAS_MESSAGES            ///< how many
} skv_cas_index;

/// First byte of SKV_CAS_SKY_STATE: by the sun's elevation, from -.833, -6, -12 and -18 deg down.
enum { SKV_CAS_DAY = 0, SKV_CAS_CIVIL, SKV_CAS_NAUTICAL, SKV_CAS_ASTRONOMICAL, SKV_CAS_NIGHT };
/// Second byte of SKV_CAS_SKY_STATE.
enum { SKV_CAS_LAMP_NIGHT = 1, SKV_CAS_LAMP_BUS_FAULT = 2 };

/// What a height is measured from.
typedef enum skv_cas_datum {
    SKV_CAS_NO_HEIGHT = 0,
    SKV_CAS_ELLIPSOID,
    SKV_CAS_SEA,
    SKV_CAS_PRESSURE,
    SKV_CAS_GROUND
} skv_cas_datum;

/// A row of the table of messages.
typedef struct skv_cas_info {
    uint16_t id;
    uint16_t period_ms; ///< how often it is sent
    uint32_t types;     ///< bit (1 << type) for every type that is understood
    float low, high;    ///< a value outside is refused; wrapping angles: see wraps
    float per_unit;     ///< a LONG counts so many to the unit: 1e7 for positions
    uint8_t type;       ///< sent unless told otherwise
    uint8_t datum;      ///< skv_cas_datum
    uint8_t wraps;    ///< 1: sent within +-180, but up to 360 is understood and brought within +-180; 2: from 0 to 360
    const char *name; ///< as in skyvert.dbc
    const char *unit; ///< "" for bytes
} skv_cas_info;

/// [SKV_CAS_MESSAGES], by rising id.
extern const skv_cas_info skv_cas_table[SKV_CAS_MESSAGES];

/// The row of an id.
/// @return [0, SKV_CAS_MESSAGES), or -1.
int skv_cas_find(uint32_t id);

// ---------------------------------------------------------------------------------------------------------- sender

/// A sender: its node and where the message code of every id stands. Start: node set, all else 0.
typedef struct skv_cas_sender {
    uint8_t node; ///< [1, 255]
    uint8_t next[SKV_CAS_MESSAGES];
} skv_cas_sender;

/// A value as one frame, or as two for SKV_CAS_DOUBLEH (upper half first) and SKV_CAS_DOUBLEL (lower half first): send
/// these one right behind the other.
/// @param[in,out] sender  its message codes go on.
/// @param[in] index       a message of numbers (not UTC, DATE, SKY_STATE).
/// @param[in] type        one of its types; 0 = the table's.
/// @param[in] value       within the table's range; an angle that wraps may be any finite one.
/// @param[out] frames     [2].
/// @return frames written: 1 or 2; SKV_ERR_NULL; SKV_ERR_RANGE iff index or value is out of range or the value NaN;
///         SKV_ERR_UNSUPPORTED iff the message has no such type. On error nothing changes.
int skv_cas_encode(skv_cas_sender *sender, skv_cas_index index, uint8_t type, double value, skv_can_frame frames[2]);

/// The same for UTC, DATE and SKY_STATE.
/// @param[in] bytes  [4], as in skv_cas_index.
/// @return 1; SKV_ERR_NULL; SKV_ERR_RANGE iff index is another message or the bytes are no time or date.
int skv_cas_encode_bytes(skv_cas_sender *sender, skv_cas_index index, const uint8_t bytes[4], skv_can_frame *frame);

/// Whether four bytes are a valid UTC (60 s only at 23:59), DATE (1900 to 2100) or SKY_STATE; the last byte of UTC and
/// of SKY_STATE is not looked at. 0 for any other message.
int skv_cas_bytes_valid(skv_cas_index index, const uint8_t bytes[4]);

// -------------------------------------------------------------------------------------------------------- receiver

/// What became of a frame (skv_cas_receive() answers one of the first group), and what else is counted.
typedef enum skv_cas_count {
    SKV_CAS_ACCEPTED = 0, ///< a value changed hands
    SKV_CAS_HALF,         ///< one half of a double: kept for the other
    SKV_CAS_SERVICE,      ///< a service message: see skv_cas_identify() and skv_cas_time_sync()
    SKV_CAS_UNKNOWN,      ///< an id that is not in the table: somebody else's
    SKV_CAS_BUS_ERROR,    ///< an error frame of the driver
    // refused from here on
    SKV_CAS_BAD_FORMAT,   ///< extended id or remote request
    SKV_CAS_BAD_LENGTH,   ///< a length that fits neither the type nor 8
    SKV_CAS_BAD_SERVICE,  ///< a service code that is not 0 in a data message
    SKV_CAS_BAD_TYPE,     ///< a type the message does not have
    SKV_CAS_NOT_FINITE,   ///< NaN or infinite
    SKV_CAS_OUT_OF_RANGE, ///< outside the table's range, or no time or date
    SKV_CAS_DUPLICATE,    ///< the message code of the frame before
    SKV_CAS_REORDERED,    ///< an older message code
    SKV_CAS_OTHER_NODE,   ///< a second node sends the id while the first one is fresh
    // counted beside
    SKV_CAS_MISSING,  ///< frames that never came, by the gaps in the message codes
    SKV_CAS_RESTART,  ///< a sender that began anew
    SKV_CAS_UNPAIRED, ///< halves of doubles without the other
    SKV_CAS_STALE,    ///< times that a value went stale
    SKV_CAS_COUNTS
} skv_cas_count;
#define SKV_CAS_FIRST_REFUSED SKV_CAS_BAD_FORMAT
#define SKV_CAS_LAST_REFUSED  SKV_CAS_OTHER_NODE

/// Age of a value.
typedef enum skv_cas_age {
    SKV_CAS_NEVER = 0, ///< never received
    SKV_CAS_FRESH,
    SKV_CAS_OLD, ///< nothing for three periods: stale
} skv_cas_age;

/// The state of one message.
typedef struct skv_cas_slot {
    int64_t time_ns;  ///< of the last accepted frame
    int64_t half_ns;  ///< of the half that waits
    double value;     ///< the number
    uint32_t half;    ///< the bits that wait
    uint8_t bytes[4]; ///< UTC, DATE, SKY_STATE
    uint8_t age;      ///< skv_cas_age
    uint8_t node;     ///< whose frames count
    uint8_t type;     ///< of the last accepted frame
    uint8_t code;     ///< the last message code
    uint8_t odd_code; ///< a code that looked old: the next one after it means a restart
    uint8_t half_type, half_code;
    uint8_t flags;                  ///< private
    uint32_t count[SKV_CAS_COUNTS]; ///< they stop at 2^32 - 1
} skv_cas_slot;

/// A receiver. Start: all 0 (or skv_cas_clear()). About 4 KB.
typedef struct skv_cas_receiver {
    skv_cas_slot slot[SKV_CAS_MESSAGES];
    uint32_t total[SKV_CAS_COUNTS]; ///< over all messages, and the frames that belong to none
    uint8_t ignore_codes; ///< 1: for senders that do not count their messages: duplicates, gaps and order go unnoticed
} skv_cas_receiver;

/// Sets everything to 0.
void skv_cas_clear(skv_cas_receiver *receiver);

/// Takes one frame.
/// @param[in] now_ns  any clock that does not jump (CLOCK_MONOTONIC, a timer times its tick; the times of a log);
///                    should it run backwards, ages begin anew.
/// @return what became of it; counted under the same name. Values change only with SKV_CAS_ACCEPTED.
/// A restart: a sender that begins anew is believed at its second frame in a row, or at its first when the value was
/// stale. Doubles: two halves count as one number when their codes follow each other and they are at most a quarter of
/// the period apart; a half that looks old is refused.
/// Cost: O(log of the number of messages), no allocation.
skv_cas_count skv_cas_receive(skv_cas_receiver *receiver, const skv_can_frame *frame, int64_t now_ns);

/// Finds the values that went stale: no accepted frame for more than three periods. Call it before reading values.
/// @return how many values are stale now.
int skv_cas_tick(skv_cas_receiver *receiver, int64_t now_ns);

/// A number.
/// @param[out] value  written iff the value was ever received; angles that wrap are within the table's range.
/// @return its age by the last skv_cas_tick() or frame; SKV_CAS_NEVER also for bytes, a wrong index or NULL.
skv_cas_age skv_cas_value(const skv_cas_receiver *receiver, skv_cas_index index, double *value);

/// The same for UTC, DATE and SKY_STATE.
skv_cas_age skv_cas_bytes(const skv_cas_receiver *receiver, skv_cas_index index, uint8_t bytes[4]);

/// The best fresh height: GPS height above the ellipsoid, else true altitude, else barometric altitude above the sea,
/// else pressure altitude.
/// @param[out] height_m  written unless SKV_CAS_NO_HEIGHT.
/// @return what it is measured from; SKV_CAS_NO_HEIGHT iff none is fresh.
skv_cas_datum skv_cas_height(const skv_cas_receiver *receiver, double *height_m);

/// Names for people: "duplicate", "out of range", ...; "?" for none.
const char *skv_cas_count_name(skv_cas_count count);

// -------------------------------------------------------------------------------------------------------- services

#define SKV_CAS_ID_REQUEST 0x080u ///< node service, channel 0: request
#define SKV_CAS_ID_REPLY   0x081u ///< its reply

/// Who a node is.
typedef struct skv_cas_identity {
    uint8_t node; ///< [1, 255]
    uint8_t hardware_revision;
    uint8_t software_revision;
} skv_cas_identity;

/// A request for identification (service 0).
/// @param[in] node     the node asked, 0 = all.
/// @param[in] code     message code, comes back in the reply.
/// @return SKV_OK; SKV_ERR_NULL.
skv_status skv_cas_identification_request(skv_can_frame *frame, uint8_t node, uint8_t code);

/// Answers an identification request: if the frame asks this node (or all), writes the reply, to be sent within 100 ms.
/// The reply is a UCHAR4: hardware revision, software revision, 0 (the standard ids), 0 (the standard header).
/// @return 1 iff reply was written; 0 iff the frame is anything else or asks another node, or a pointer is NULL.
int skv_cas_identify(const skv_can_frame *frame, const skv_cas_identity *self, skv_can_frame *reply);

/// Reads an identification reply.
/// @return 1 iff the frame is one; 0 otherwise.
int skv_cas_identified(const skv_can_frame *frame, skv_cas_identity *who);

/// Node synchronisation (service 1): a ULONG to all nodes, whose meaning the system's builder sets.
/// @return 1 iff the frame is one; 0 otherwise, and nothing is written.
int skv_cas_time_sync(const skv_can_frame *frame, uint32_t *stamp);

/// Such a frame. @return SKV_OK; SKV_ERR_NULL.
skv_status skv_cas_time_sync_request(skv_can_frame *frame, uint32_t stamp);

// -------------------------------------------------------------------------------------------------------- bus load

/// Bits that a frame takes on the bus: the longest it can be with stuff bits, and the 3 bits between frames.
/// Source: [Davis07]; length 8 gives 135 (11-bit id) and 160 (29-bit id).
int skv_cas_frame_bits(const skv_can_frame *frame);

#ifdef __cplusplus
}
#endif
#endif
