/// Inside of the baseline Elek 2009 [Elek09]: sizes, mappings, stages of the build. Only elek09*.c and its test.
///
/// The table holds, per kind of matter X (gas, aerosol) and band, the light scattered into a direction but for the
/// phase function of the direction to the sun, which is applied to the sum of the orders when it is read ("deferred"):
///
///   S1_X = beta_X/4pi  int rho_X T(P to sun) T(P to observer) ds                       light scattered once
///   Gk_X = int_4pi F_X(view, omega) Sk_X(omega) domega                                 gathered at P
///   Sk_X = beta_X/4pi  int rho_X G(k-1)_X T(P to observer) ds                          light scattered k times
///   sky  = F'(sun, view) sum_k Sk_gas + F_aerosol(sun, view) sum_k Sk_aerosol
///
/// with F of mean 1 over the sphere, F' = 8/10 (7/5 + 1/2 cos) his own for the gas, and every integral a trapezoid rule
/// of 30 samples. Each kind gathers its own light only. Sun, view and vertical lie in one plane (no azimuth).
#ifndef TOOLS_BASELINES_ELEK09_H
#define TOOLS_BASELINES_ELEK09_H

#include "common.h"

enum {
    ELEK_U = 32,  ///< altitudes
    ELEK_V = 256, ///< view zenith angles
    ELEK_W = 32,  ///< sun zenith angles
    ELEK_CELLS = ELEK_U * ELEK_V * ELEK_W,
    ELEK_KINDS = 2,    ///< gas, aerosol
    ELEK_SAMPLES = 30, ///< of each integral
    ELEK_ORDERS = 6,
    ELEK_T = 512,       ///< transmittance: altitudes and zenith angles
    ELEK_ANGLES = 4096, ///< phase table: cosines
    ELEK_SHAPES = 32,   ///< phase table: values of g, the last one the air's
    ELEK_AMBIENT = 256, ///< irradiance of the sky on the ground: sun zenith angles
    // Ours, for speed, not stored: see elek09_gather.c.
    ELEK_TURNS = 513,   ///< zenith angles at which light is gathered, even in angle
    ELEK_LAYERS = 4097, ///< altitudes at which densities are tabulated, even in km
};

/// Light of both kinds in four bands.
typedef struct elek_light {
    float of[ELEK_KINDS][4];
} elek_light;

/// What the table needs once it is built: half floats, each block times a power of two of its own.
typedef struct elek_store {
    float scattering_unit, ambient_unit;            ///< value of 1 in the half floats
    uint16_t scattering[ELEK_CELLS][ELEK_KINDS][4]; ///< [u][w][v]
    uint16_t transmittance[ELEK_T * ELEK_T][4];     ///< [u][v]
    uint16_t phase[ELEK_SHAPES][ELEK_ANGLES];
    uint16_t ambient[ELEK_AMBIENT][4];
} elek_store;

/// Densities and extinction of one altitude.
typedef struct elek_layer {
    float density[ELEK_KINDS];
    float extinction[4];
} elek_layer;

/// A build under way.
typedef struct elek_build {
    const baseline_air *air;
    int literal;
    float beta[ELEK_KINDS][4]; ///< scattering over 4 pi, 1/km
    elek_layer *layer;         ///< [ELEK_LAYERS]
    float (*transmittance)[4]; ///< [ELEK_T u][ELEK_T v]
    elek_light *order;         ///< [ELEK_CELLS] of the order at hand
    elek_light *sum;           ///< [ELEK_CELLS] of all orders so far
    elek_light *gathered;      ///< [u][w][ELEK_TURNS]
    float *kernel;             ///< [elek_kernel_size()] of elek09_gather.c
} elek_build;

// --- elek09_map.c: coordinates in [0, 1] ---

double elek_u(const baseline_air *air, double altitude_km);
double elek_u_inverse(const baseline_air *air, double u);
double elek_v(double mu);
double elek_v_inverse(double v);
/// Below 0 where mu_s < -.8/2.8.
double elek_w(double mu_s);
double elek_w_inverse(double w);

/// Lower corner and share of the next one in the table of scattering: corrected, or as printed. There U gets the
/// altitude where it needs the radius (the root of a negative number: a texture unit reads 0), and W is not kept above
/// 0 (a texture repeats).
int elek_cell_u(const baseline_air *air, int literal, double altitude_km, float *share);
int elek_cell_w(int literal, double mu_s, float *share);
int elek_cell_v(double mu, float *share);
/// The cells that a lookup in the table mixes.
typedef struct elek_corners {
    size_t cell[8];
    float share[8];
} elek_corners;
void elek_corners_of(const baseline_air *air, int literal, double altitude_km, double mu, double mu_s,
                     elek_corners *at);

// --- elek09_once.c ---

/// Phase functions of mean 1.
double elek_phase(const baseline_air *air, int kind, double cosine);
/// His own for the gas, for reading the table.
double elek_phase_gas(double cosine);

/// One of the samples along a path.
typedef struct elek_sample {
    double altitude, radius, mu, s; ///< s: way from the start, km
    float density[ELEK_KINDS];
    float left[4]; ///< length of the sample, km, times the transmittance back to the start
} elek_sample;

void elek_make_layers(elek_build *build);
/// Of a path from altitude h; depths are trapezoids over the same samples.
void elek_samples(const elek_build *build, double h, double mu, elek_sample sample[ELEK_SAMPLES]);
/// Cosine of the sun's zenith angle at a sample; at the start it is mu_s, in the plane of view and vertical.
double elek_sun_at(const elek_sample *start, const elek_sample *at, double mu_s);
/// Rows of the transmittance table: item u of ELEK_T.
void elek_transmittance_row(void *build, size_t u);
void elek_sun(const elek_build *build, double altitude_km, double mu_s, float transmittance[4]);
/// Light scattered once, under all suns: item u ELEK_V + v.
void elek_once_path(void *build, size_t path);

// --- elek09_gather.c ---

/// Before gathering. @return largest integral of a phase function over the samples.
double elek_gather_begin(elek_build *build);
/// G of the order at hand: item w.
void elek_gather_column(void *build, size_t w);
/// The next order from what was gathered: item u ELEK_V + v.
void elek_again_path(void *build, size_t path);
size_t elek_kernel_size(void); ///< floats

// --- elek09_store.c ---

/// Beyond it: a phase function that his samples make heavier than this by a factor.
#define ELEK_HEAVIEST 2.0
/// Everything: transmittance, orders, phase, ambient. @return 0; 1 stopped; -1 out of memory; -2 ELEK_HEAVIEST.
int elek_make(elek_store *store, const baseline_air *air, int literal, const baseline_wants *wants);
size_t elek_work_bytes(void);
/// Bytes of the tables as the paper stores them, with so many bands.
size_t elek_table_bytes(int bands);

#endif
