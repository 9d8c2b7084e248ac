/// What the files of the reference share: knots of the profiles, optical depths.
#ifndef TOOLS_REFERENCE_INNER_H
#define TOOLS_REFERENCE_INNER_H

#include "single.h"

/// Columns: Rayleigh, aerosol, ozone, dust.
#define REF_SPECIES   4
#define REF_KNOTS_MAX (REF_SPECIES * (REF_TABLE_ROWS + 16))

/// Heights are carried as E = r^2 - ground^2 = y (2 ground + y): exact near the ground, polynomial along a line.
typedef struct ref_world {
    const ref_atmosphere *atmosphere;
    double ground; ///< radius
    double top;    ///< E of the top
    int nodes;
    double smooth_km;            ///< pieces thinner than this need few nodes
    int pieces;                  ///< number of knots that cut optical depths
    double piece[REF_KNOTS_MAX]; ///< E, ascending
    int kinks;                   ///< number of knots where a density is not smooth, and of first guides
    double kink[REF_KNOTS_MAX];
} ref_world;

/// Optical depth of columns in one band.
static inline double ref_depth(const ref_atmosphere *a, const double column[REF_SPECIES], int band) {
    return (a->rayleigh_scattering[band] + a->rayleigh_absorption[band]) * column[0] +
           a->aerosol_extinction[band] * column[1] + a->ozone_absorption[band] * column[2] +
           a->dust_extinction[band] * column[3];
}

void ref_world_make(ref_world *world, const ref_atmosphere *atmosphere, int nodes);
double ref_height(const ref_world *world, double e);
/// Adds the columns of a stretch that starts at e with r mu = b and has that length; b of any sign.
void ref_stretch(const ref_world *world, double e, double b, double length, double column[REF_SPECIES]);
/// Sine and cosine in degrees, exact at the multiples of 90.
void ref_sincos_deg(double deg, double *sine, double *cosine);
/// Distance from e to the top, upward or past the tangent point.
double ref_to_top(const ref_world *world, double e, double b);

#endif
