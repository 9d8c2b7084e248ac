/// What the baselines share: the air in double, straight rays through it, phase functions, half floats, threads, a
/// cache of tables. Units: km, 1/km; altitudes above the ground (radius_km). None of it knows the core.
#ifndef TOOLS_BASELINES_COMMON_H
#define TOOLS_BASELINES_COMMON_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "baseline.h"

#define BASELINE_PI 3.14159265358979323846

// --- common_air.c: the atmosphere ---

/// Kinds of matter; the first BASELINE_SCATTERERS scatter.
enum { GAS, AEROSOL, DUST, OZONE, BASELINE_SPECIES, BASELINE_SCATTERERS = OZONE };

/// An atmosphere in double. Holds copies of the density tables.
typedef struct baseline_air {
    double radius_km, top_km; ///< of the ground; altitude of the air's top
    int bands;
    double light[4];  ///< solar irradiance times the constant absorption colour, W m^-2 nm^-1
    double albedo[4]; ///< of the ground
    /// Per unit of a species' relative density, turbidity within; 0 where the species is absent. Extinction of the gas
    /// holds its absorption.
    double scattering[BASELINE_SCATTERERS][4];
    double extinction[BASELINE_SPECIES][4];
    skv_profile profile[BASELINE_SPECIES]; ///< table pointers are this struct's own
    int phase[BASELINE_SCATTERERS];        ///< skv_phase; the gas's is not read
    double g[BASELINE_SCATTERERS];
} baseline_air;

/// Copies what skv_model_build() accepts. @return 0; -1 out of memory (nothing to free then).
int baseline_air_copy(baseline_air *air, const skv_atmosphere *atmosphere);
void baseline_air_free(baseline_air *air);
/// 1 iff a species scatters or absorbs at all.
int baseline_air_has(const baseline_air *air, int species);
/// Relative density of a species; 0 above the top. Below 0 the density at 0.
double baseline_density(const baseline_air *air, int species, double altitude_km);
/// Extinction of everything, 1/km, [4] (0 from air->bands on).
void baseline_extinction(const baseline_air *air, double altitude_km, double extinction[4]);
/// A number of everything that scattering depends on (not of the light, the albedo or the wavelengths' names).
uint64_t baseline_air_hash(const baseline_air *air);

// --- common_ray.c: straight rays; r = radius_km + altitude, mu = cosine of the zenith angle ---

/// Altitude at s km along a ray that starts at altitude h; without cancellation, clamped at >= 0.
double baseline_altitude(const baseline_air *air, double h, double mu, double s);
/// 1 iff a ray from altitude h meets the ground; *length, if not NULL: to the ground, or to the top of the air (0 at
/// the top outwards). Within the air: 0 <= h <= top_km.
int baseline_ray(const baseline_air *air, double h, double mu, double *length);
/// Moves an observer above the top to where the ray enters: *h becomes top_km, *mu the cosine there, *s the way.
/// @return 0 iff the ray misses the air (nothing is changed then); 1 otherwise (also within the air: *s = 0).
int baseline_enter(const baseline_air *air, double *h, double *mu, double *s);
/// Cosine of the zenith angle of the ground's horizon seen from altitude h, <= 0.
double baseline_horizon(const baseline_air *air, double h);
/// Columns of the species' relative densities, km, along `length` km of a ray, by the trapezoid rule over `steps`
/// intervals, [BASELINE_SPECIES].
void baseline_columns(const baseline_air *air, double h, double mu, double length, int steps, double column[]);
/// The same from altitude h to the top of the air, accurate to some 1e-3 for the profiles there are; mu so that the
/// ground is not met (the ray's lowest point is found and split at).
void baseline_columns_to_top(const baseline_air *air, double h, double mu, double column[]);
/// exp(-tau) per band of such columns, [4] (0 from air->bands on).
void baseline_transmit(const baseline_air *air, const double column[], double transmittance[4]);

// --- common_phase.c: phase functions, 1/sr, integral over the sphere 1; c = cosine between directions of flight, so 1
// = forward = looking at the sun ---

double baseline_phase_rayleigh(double c);
double baseline_phase_hg(double g, double c);
double baseline_phase_cs(double g, double c);
/// Of a scatterer, as the air says.
double baseline_phase(const baseline_air *air, int species, double c);

// --- common_half.c: IEEE 754 binary16, rounded to nearest even; beyond 65504: infinity ---

uint16_t baseline_to_half(float value);

static inline float baseline_from_half(uint16_t half) {
    const uint32_t bits = (uint32_t)(half & 0x7fffu) << 13;
    float value;
    memcpy(&value, &bits, sizeof value);
    value *= 5.192296858534827628530496329220096e33f; // 2^112: from binary16's exponents to binary32's, exact
    if (bits >= 0x7c00u << 13)
        value = bits > 0x7c00u << 13 ? NAN : INFINITY;
    return half & 0x8000u ? -value : value;
}

// --- common_threads.c ---

/// Work item i of a job, in any thread, in any order.
typedef void baseline_item(void *context, size_t i);

/// Runs items 0 to n - 1 in wants->threads threads. Progress is told as from + (to - from)*(items done)/n by the
/// calling thread only, between its own items.
/// @return 0; 1 stopped by progress (items that had begun are finished, others are not run).
int baseline_parallel(const baseline_wants *wants, double from, double to, size_t n, baseline_item *item,
                      void *context);
/// CPU seconds of this process, all threads.
double baseline_cpu_s(void);

// --- common_cache.c ---

/// Reads FOLDER/NAME-KEY.bin (KEY: 16 hexadecimal digits) into data. Whole and intact (length and checksum) or not at
/// all.
/// @param[out] build_s  that was saved with it.
/// @return 1 iff data was read; 0: build it (folder NULL, no such file, damaged: data is then undefined).
int baseline_cache_load(const char *folder, const char *name, uint64_t key, void *data, size_t bytes, double *build_s);
/// Writes it beside and renames; a folder that is not there is made (its parent must be). A failure is no error: the
/// next build builds again. @return 1 iff saved.
int baseline_cache_save(const char *folder, const char *name, uint64_t key, const void *data, size_t bytes,
                        double build_s);
/// Mixes bytes into a number (FNV-1a); start with BASELINE_HASH_START.
#define BASELINE_HASH_START 14695981039346656037u
uint64_t baseline_hash(uint64_t hash, const void *data, size_t bytes);

#endif
