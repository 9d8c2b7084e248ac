/// What the studies share: skies to compare, the rays whose truth is known, and differences of colour.
#ifndef TOOLS_TRADE_STUDY_SKY_H
#define TOOLS_TRADE_STUDY_SKY_H

#include <stddef.h>

#include "skyvert/skyvert.h"
#include "studies.h"

#define STUDY_DEGREE 0.017453292519943295

/// One way to compute a sky.
typedef struct study_sky {
    const skv_model *model;
    const skv_table *table; ///< NULL: light scattered once
    skv_quality quality;
    int grid;
} study_sky;

/// Zenith angle of the geometric horizon, degrees.
double study_horizon_deg(const skv_atmosphere *air, double height_km);

/// Point i of the sequence of [Halton60] in a base, [0, 1).
double study_halton(int i, int base);

/// Radiance towards n directions, [n][4]. @return FAILED with a line on stderr, else DONE.
int study_radiance(const study_sky *sky, double height_km, const float sun_enu[3], size_t n,
                   const float (*direction)[3], float (*radiance)[4]);

/// A built model, or NULL with a line on stderr. To be freed.
skv_model *study_model(const skv_atmosphere *air);

/// Finer than any table that is meant for use: stands for the truth where none is known.
void study_finest(skv_table_spec *spec, const skv_model *model);

/// A built table, or NULL with a line on stderr. To be freed. @param spec NULL: the accurate kind.
skv_table *study_table(const skv_model *model, const skv_table_spec *spec);

/// The nine scenes of an air with its truth: its own or, where it has none, that of the finest settings.
/// @return FAILED with a line on stderr, else DONE.
int study_scenes(trade_scene scene[TRADE_SCENES], const trade_study_air *air);

// --- colour ---

/// L*a*b* [CIE15] of radiance, white D65 of that luminance.
void study_lab(const skv_colour_matrix *matrix, int bands, const double radiance[4], double white, double lab[3]);
double study_luminance(const skv_colour_matrix *matrix, int bands, const double radiance[4]);
/// From XYZ, cd/m2.
void study_lab_of(const double xyz[3], double white, double lab[3]);
double study_distance(const double a[3], const double b[3]);

/// Nonzero: stop.
int study_stop(const trade_study *how, double done);

#endif
