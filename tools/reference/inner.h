/// What the files of the reference share: knots of the profiles, optical depths.
#ifndef TOOLS_REFERENCE_INNER_H
#define TOOLS_REFERENCE_INNER_H

#include "single.h"

#define REF_SPECIES   3
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

void ref_world_make(ref_world *world, const ref_atmosphere *atmosphere, int nodes);
double ref_height(const ref_world *world, double e);
/// Adds the columns of a stretch that starts at e with r mu = b and has that length; b of any sign.
void ref_stretch(const ref_world *world, double e, double b, double length, double column[REF_SPECIES]);
/// Sine and cosine in degrees, exact at the multiples of 90.
void ref_sincos_deg(double deg, double *sine, double *cosine);
/// Distance from e to the top, upward or past the tangent point.
double ref_to_top(const ref_world *world, double e, double b);

#endif
