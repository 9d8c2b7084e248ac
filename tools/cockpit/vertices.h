/// The sky's vertices in shared memory, as skyvert-cockpit publishes them (--shm NAME) and image generators map them.
/// This header needs no other one of the project.
///
///     fd = shm_open("/skyvert", O_RDONLY, 0); map = mmap(NULL, size, PROT_READ, MAP_SHARED, fd, 0);
///     skv_vertices_check(map, size) == 0, then once a frame: skv_vertices_read(map, &moment, vertices, n)
///
/// The writer fills one of SKV_VERTICES_SLOTS slots in turn, then names it in `latest`. Every slot has a sequence
/// number, odd while it is written (a seqlock): a reader that was overtaken notices and reads the newest one. Readers
/// never hold up the writer. Numbers have the machine's byte order; offsets stand behind the fields.
#ifndef SKV_VERTICES_H
#define SKV_VERTICES_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define SKV_VERTICES_MAGIC   0x56564B53u ///< "SKVV" where bytes are little-endian
#define SKV_VERTICES_VERSION 1u
#define SKV_VERTICES_SLOTS   3u

/// What the writer does: skv_vertices_header.state.
enum {
    SKV_VERTICES_WAITING = 1, ///< no sky yet: position and time (or sun) have not come
    SKV_VERTICES_RUNNING = 2,
    SKV_VERTICES_ENDED = 3, ///< the writer has gone: open the name again
};

/// Bits of skv_vertices_moment.flags.
enum {
    SKV_VERTICES_POSITION_STALE = 1,
    SKV_VERTICES_HEIGHT_STALE = 2,
    SKV_VERTICES_TIME_STALE = 4, ///< time, or the sun where it comes from the bus
    SKV_VERTICES_HELD = 8,       ///< nothing fresh comes: the sky stands still
    SKV_VERTICES_BUS_FAULT = 16,
    SKV_VERTICES_NIGHT_LAMP = 32,
    SKV_VERTICES_SUN_BY_BUS = 64, ///< the sun's place came over the bus, not from the time
    SKV_VERTICES_BUILDING = 128,  ///< the table of the air is being built: still the air before, at first without light
                                  ///< scattered more than once
};

typedef struct skv_vertices_header {
    uint32_t magic;          ///< 0
    uint32_t version;        ///< 4
    uint32_t total_bytes;    ///< 8
    uint32_t vertices;       ///< 12
    uint32_t indices;        ///< 16: three a triangle, counter-clockwise seen from inside; they never change
    uint32_t slots;          ///< 20
    uint32_t slots_offset;   ///< 24: of the first slot
    uint32_t slot_bytes;     ///< 28: from one slot to the next
    uint32_t indices_offset; ///< 32: uint32_t [indices]
    uint32_t azimuths;       ///< 36: vertices a ring; first the zenith, then rings downwards, last the nadir
    uint32_t rings;          ///< 40
    int32_t writer;          ///< 44: process number
    uint32_t latest;         ///< 48, atomic: newest slot + 1; 0 = none yet
    uint32_t state;          ///< 52, atomic
    uint32_t beats;          ///< 56, atomic: goes up at the writer's rate, also while it waits: is it alive?
    uint32_t reserved;       ///< 60
} skv_vertices_header;       ///< 64 bytes

/// A frame; its vertices follow.
typedef struct skv_vertices_moment {
    uint32_t sequence;       ///< 0, atomic: odd while it is written
    uint32_t frame;          ///< 4: 1, 2, 3, ...
    uint32_t flags;          ///< 8
    int32_t utc_day;         ///< 12: days since 2000-01-01; INT32_MIN: no time known
    double utc_seconds;      ///< 16: of that day
    int64_t published_ns;    ///< 24: CLOCK_MONOTONIC
    int64_t input_ns;        ///< 32: CLOCK_MONOTONIC, when the newest CAN frame in it was received; 0: none
    double latitude_deg;     ///< 40: NaN-free: 0 where the sun came by the bus and no position is known
    double longitude_deg;    ///< 48
    float height_m;          ///< 56: above the sea; by pressure where the bus says nothing better
    float horizon_rad;       ///< 60: elevation of the geometric horizon, <= 0
    float sun_enu[3];        ///< 64: unit, east-north-up
    float sun_azimuth_deg;   ///< 76
    float sun_elevation_deg; ///< 80: geometric
    float moon_enu[3];       ///< 84: unit; 0 where it is not known
    float visibility_km;     ///< 96: of the air that is shown
    float exposure;          ///< 100: k of 1 - exp(-k rgb) that suits this sky
    float zenith_luminance;  ///< 104: cd/m2
    float moon_phase_deg;    ///< 108: 0 full, 180 new
    double utc_offset_s;     ///< 112: what the knob has added to the time, in utc_day and utc_seconds already
    uint32_t reserved[2];    ///< 120
} skv_vertices_moment;       ///< 128 bytes

typedef struct skv_vertex {
    float direction_enu[3]; ///< 0: unit, east-north-up
    float luminance;        ///< 12: cd/m2
    float rgb[3];           ///< 16: linear, BT.709; 1 = 1000 cd/m2; may be slightly negative outside the gamut
    float reserved;         ///< 28
} skv_vertex;               ///< 32 bytes

// Three rows that do not compile where the layout above is not what it says.
typedef char skv_vertices_header_is_64[sizeof(skv_vertices_header) == 64 ? 1 : -1];
typedef char skv_vertices_moment_is_128
    [sizeof(skv_vertices_moment) == 128 && offsetof(skv_vertices_moment, utc_offset_s) == 112 ? 1 : -1];
typedef char skv_vertices_vertex_is_32[sizeof(skv_vertex) == 32 ? 1 : -1];

/// Whether a mapping of `bytes` bytes is what this header describes. @return 0, or what is wrong (constant text)
static inline const char *skv_vertices_check(const void *map, size_t bytes) {
    const skv_vertices_header *const h = (const skv_vertices_header *)map;
    if (bytes < sizeof *h || __atomic_load_n(&h->magic, __ATOMIC_ACQUIRE) != SKV_VERTICES_MAGIC)
        return "no vertices of skyvert-cockpit, or of another byte order";
    if (h->version != SKV_VERTICES_VERSION)
        return "another version of the layout";
    if (h->total_bytes > bytes || h->slots != SKV_VERTICES_SLOTS ||
        h->slots_offset + (uint64_t)h->slots * h->slot_bytes > h->total_bytes ||
        h->indices_offset + 4 * (uint64_t)h->indices > h->slots_offset ||
        sizeof(skv_vertices_moment) + sizeof(skv_vertex) * (uint64_t)h->vertices > h->slot_bytes)
        return "impossible sizes";
    return NULL;
}

/// Copies the newest whole frame.
/// @param[out] moment
/// @param[out] vertices  [n].
/// @param[in]  n         room; more than the header's number is not written.
/// @return vertices copied; 0: none is published yet; -1: overtaken many times in a row (a reader that is stopped for
///         frames on end in each try): try again.
static inline int32_t skv_vertices_read(const void *map, skv_vertices_moment *moment, skv_vertex *vertices,
                                        uint32_t n) {
    const skv_vertices_header *const h = (const skv_vertices_header *)map;
    const uint32_t count = n < h->vertices ? n : h->vertices;
    for (int i = 0; i < 100; i++) {
        const uint32_t latest = __atomic_load_n(&h->latest, __ATOMIC_ACQUIRE);
        if (latest == 0 || latest > SKV_VERTICES_SLOTS)
            return 0;
        const unsigned char *const slot =
            (const unsigned char *)map + h->slots_offset + (size_t)(latest - 1) * h->slot_bytes;
        const uint32_t *const sequence = (const uint32_t *)(const void *)slot;
        const uint32_t before = __atomic_load_n(sequence, __ATOMIC_ACQUIRE);
        if (before & 1u)
            continue;
        memcpy(moment, slot, sizeof *moment);
        memcpy(vertices, slot + sizeof *moment, sizeof *vertices * (size_t)count);
        __atomic_thread_fence(__ATOMIC_ACQUIRE);
        if (__atomic_load_n(sequence, __ATOMIC_RELAXED) == before)
            return (int32_t)count;
    }
    return -1;
}

#endif
