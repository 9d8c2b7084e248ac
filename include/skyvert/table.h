/// Stage 1b, once per change of the air: light scattered more than once, in a small table.
///
/// Per altitude and sun elevation the table holds the diffuse radiance that arrives there per unit of the light's
/// irradiance, as nine numbers a band: harmonics about the vertical and the sun up to degree 2, two more about the
/// vertical (degrees 3 and 4) and one for the aureole. From it come the light that is scattered again towards an
/// observer, the light of the ground below a diffuse sky, and the irradiance of any surface (irradiance.h). It holds
/// for any light: sun and moon share it.
///
///     skv_table_begin(), skv_table_step() until done    or skv_table_build() at once
///     skv_frame_begin(), skv_frame_table()              skv_radiance() then adds all orders of scattering
///     skv_frame_grid()                                  optional: cheaper from some hundred vertices on
///
/// Nothing is allocated: table, work space and grid are the caller's.
#ifndef SKYVERT_TABLE_H
#define SKYVERT_TABLE_H

#include <stddef.h>
#include <stdint.h>

#include "skyvert/frame.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Layout of the bytes; a table of another version is refused.
#define SKV_TABLE_VERSION 1u

/// Numbers per cell and band: of degrees 0 to 2, and fine ones in detailed rows.
#define SKV_TABLE_FINE  7
#define SKV_TABLE_TERMS (6 + SKV_TABLE_FINE)

typedef enum skv_table_format {
    SKV_TABLE_PACKED = 0, ///< 16-bit logarithms and 8-bit ratios
    SKV_TABLE_FLOAT = 1,  ///< floats: four times the size
} skv_table_format;

typedef enum skv_table_kind {
    SKV_TABLE_ACCURATE = 0, ///< the sizes and errors of all stand in README "Tables"
    SKV_TABLE_SMALL = 1,
    SKV_TABLE_LARGE = 2, ///< twice the bytes, five times the build: half the error by day and in thick haze
    SKV_TABLE_KINDS = 3
} skv_table_kind;

/// How a table is made. Fill it with skv_table_spec_kind(), then change what you need.
typedef struct skv_table_spec {
    int32_t altitudes;   ///< rows, [4, 32]
    int32_t detailed;    ///< of these, from the ground up, with all numbers (the others have six), [0, altitudes]
    int32_t suns;        ///< columns, [8, 64]
    int32_t orders;      ///< passes over all cells, [2, 64]: orders of scattering, the rest is taken as a geometric
                         ///< series; 0 = by the optical depth of the air
    int32_t samples[2];  ///< nodes along each gathered ray: of light scattered once, and later, [2, 16]
    int32_t polar[2];    ///< polar angles above the horizon, and as many below, [2, 16]
    int32_t azimuths[2]; ///< azimuths of a half circle, [2, 16]
    float ground_km;     ///< altitude of the ground above the sea, [-12, 12] and below the top; frames may have another
                         ///< one: 1.5 km apart light is off by 4 % (largest 9 %)
    int32_t format;      ///< skv_table_format
} skv_table_spec;

/// Header of a table; the cells follow it in the same buffer. The bytes may be stored and loaded again
/// (skv_table_check()), and lie in read-only memory.
typedef struct skv_table {
    uint32_t magic;   ///< "SKVT" in the byte order of the machine that built it
    uint16_t version; ///< SKV_TABLE_VERSION
    uint8_t format;   ///< skv_table_format
    uint8_t bands;    ///< 3 or 4
    uint8_t altitudes, detailed, suns;
    uint8_t reserved;  ///< 0
    uint32_t bytes;    ///< header and cells
    uint32_t checksum; ///< of all bytes behind this field
    uint32_t model;    ///< skv_model.hash of the model it was built from
    float ground_km;   ///< row i lies at the altitude ground_km + span_km (i/(altitudes-1))^2
    float span_km;
    float mu_first;                         ///< cosine of the sun's zenith angle of the first column
    float ratio_scale[SKV_TABLE_TERMS - 1]; ///< of the 8-bit ratios
} skv_table;

/// Rays that a step gathers.
#if SKV_LANES < 8
#define SKV_TABLE_STEP_RAYS SKV_LANES
#else
#define SKV_TABLE_STEP_RAYS 8
#endif

/// State of a build; the caller's, written by the calls below only.
typedef struct skv_table_builder {
    uint32_t layout;
    skv_table_spec spec;
    const skv_model *model;
    skv_table *table; ///< the result; written at the end, cell by cell
    skv_table *work;  ///< the table so far, in floats
    float *first;     ///< [cells][bands][terms] light scattered once; [suns][bands] its irradiance of the ground
    int32_t pass;     ///< 1 ... orders gather; then come tail, packing and checksum
    int32_t row, column, ray;
    skv_frame frame;                 ///< of the cell in work
    float moment[7][SKV_BANDS_MAX];  ///< its gathered moments
    float source[SKV_BANDS_MAX][60]; ///< what its forward-scattering species sends in some directions
    float seen;                      ///< the part of that species' phase function that the gathered rays have seen
    float change[SKV_BANDS_MAX];     ///< of the mean radiance over all cells, in this pass
    float before[SKV_BANDS_MAX];     ///< in the last one
    float rate[SKV_BANDS_MAX];       ///< of the series that the rest is taken as
    float largest[SKV_TABLE_TERMS - 1];
    uint32_t sum;
} skv_table_builder;

/// The settings of a kind of table, packed, ground at the sea.
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_UNSUPPORTED iff there is no such kind.
skv_status skv_table_spec_kind(skv_table_spec *spec, skv_table_kind kind);

/// The same, fitted to a model: its fine numbers reach as far up as the forward-scattering matter does (Mars' dust
/// stands ten times as high as Earth's haze), with fewer columns where the table would become larger than the kind's.
/// @return as skv_table_spec_kind(); SKV_ERR_LAYOUT iff the model was not built.
skv_status skv_table_spec_for(skv_table_spec *spec, const skv_model *model, skv_table_kind kind);

/// Bytes of a table; 0 where a field of spec is out of range or bands is not 3 or 4.
size_t skv_table_size(const skv_table_spec *spec, int bands);

/// Bytes of the work space that building it takes; may be used for something else afterwards.
size_t skv_table_work_size(const skv_table_spec *spec, int bands);

/// Begins a build, or begins it anew: another model, other settings, other buffers.
/// @param[out] builder
/// @param[in]  model        kept by reference until the build is done.
/// @param[in]  spec         NULL: the accurate kind, fitted to the model: 8192 bytes are enough for it.
/// @param[out] table        of table_bytes bytes, aligned to 4. It is not complete before skv_table_step() says so:
/// keep
///                          the one that frames use until then.
/// @param[out] work         of work_bytes bytes, aligned to 4.
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_RANGE (spec); SKV_ERR_SIZE (a buffer is too small or not aligned);
///         SKV_ERR_LAYOUT (model not built); SKV_ERR_UNSUPPORTED (left out at compile time). On error nothing is
///         written.
skv_status skv_table_begin(skv_table_builder *builder, const skv_model *model, const skv_table_spec *spec,
                           skv_table *table, size_t table_bytes, void *work, size_t work_bytes);

/// Goes on with a build by a bounded piece of work.
/// @param[out] permille  how much is done; 1000: the table is complete and further calls do nothing. NULL = not wanted.
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_LAYOUT iff no build was begun.
/// Cost:   at most 110,000 instructions on x86-64 (324,000 in scalar code), a third of it on average (README "Tables").
/// No allocation. Two builders may run in two threads.
skv_status skv_table_step(skv_table_builder *builder, int *permille);

/// A whole build at once: skv_table_begin() and all its steps.
/// Cost:   README "Tables".
skv_status skv_table_build(skv_table *table, size_t table_bytes, void *work, size_t work_bytes, const skv_model *model,
                           const skv_table_spec *spec);

/// Checks the bytes of a table that was stored: before skv_frame_table() sees them.
/// @param[in] bytes  of n bytes, aligned to 4.
/// @param[in] model  that it has to belong to; NULL: any.
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_SIZE iff n is less than the table's own length or not aligned; SKV_ERR_LAYOUT
///         iff it is no table of this version and byte order or has impossible dimensions; SKV_ERR_DAMAGED iff the
///         checksum or a number is wrong; SKV_ERR_MODEL iff it was built from another model.
/// Cost:   some 10,000 instructions.
skv_status skv_table_check(const void *bytes, size_t n, const skv_model *model);

/// Gives a frame all orders of scattering.
/// @param[in,out] frame  from skv_frame_begin().
/// @param[in]     table  complete, built from the frame's model; kept by reference. NULL: back to single scattering.
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_LAYOUT iff frame or table was not built; SKV_ERR_MODEL iff the table belongs
/// to
///         another model; SKV_ERR_UNSUPPORTED iff left out at compile time. On error the frame is not written.
/// Cost:   some hundred instructions.
skv_status skv_frame_table(skv_frame *frame, const skv_table *table);

/// Bytes of a frame's grid.
size_t skv_grid_size(const skv_frame *frame);

/// Precomputes the light scattered more than once for all directions from a frame's observer: a grid of rows that crowd
/// at the geometric horizon and azimuths about each light. skv_radiance() then interpolates instead of integrating.
/// Rays with a length (skv_rays.length_km) are integrated all the same.
/// @param[in,out] frame  with a table; a new frame needs a new grid.
/// @param[out]    grid   of n bytes, aligned to 4; kept by reference.
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_LAYOUT iff the frame was not built or has no table; SKV_ERR_RANGE iff the
///         observer is higher than half the air: from there neighbouring directions meet air under suns too different;
///         SKV_ERR_SIZE; SKV_ERR_UNSUPPORTED. On error the frame is not written.
/// Cost:   468 integrations a light (README "Tables"): cheaper than without it from about 500 vertices on.
skv_status skv_frame_grid(skv_frame *frame, float *grid, size_t n);

#ifdef __cplusplus
}
#endif
#endif
