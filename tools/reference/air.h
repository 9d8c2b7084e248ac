/// Air of the path tracer: optical depths and scattering coefficients per band, tabulated finely from the reference's
/// own integrals, and straight rays through it.
///
/// Table: the optical depth from a height up to the top, divided by t = 1/(1 + 14 mu), bilinear in sqrt(height) and t.
/// Downward rays use the same table from their tangent point. tests/property/test_path.c measures its error against
/// ref_column().
#ifndef TOOLS_REFERENCE_AIR_H
#define TOOLS_REFERENCE_AIR_H

#include "inner.h"

typedef struct ref_air {
    ref_world world;
    double ground;     ///< radius, km
    double top;        ///< E of the top
    double top_km;     ///< above the ground
    double stretch_km; ///< length over which the air thins, for laying cells
    int rows, columns; ///< cells of the table in height and in t
    double *depth;     ///< [rows + 1][columns + 1][REF_BANDS]
    double *rayleigh;  ///< [rows + 1][REF_BANDS] scattering, 1/km
    double *aerosol;   ///< [rows + 1][REF_BANDS]
    double albedo[REF_BANDS];
} ref_air;

/// @param rows, columns  e.g. 1024 and 256. @return 0; -1 out of memory.
int ref_air_make(ref_air *air, const ref_atmosphere *atmosphere, int rows, int columns, int threads);
void ref_air_free(ref_air *air);

/// A straight line of sight. Lengths in km; E = r^2 - ground^2; b = r cos(zenith).
typedef struct ref_line {
    double e, b;               ///< of the start
    double b_sun, nu;          ///< r mu_s at the start; cosine of line and sun
    double length;             ///< to the ground or the top
    int ground;                ///< ends on the ground
    double near[REF_BANDS];    ///< depth from the start to the top along the line or, descending, against it
    double tangent[REF_BANDS]; ///< twice the depth from the tangent point, when it is passed
} ref_line;

/// What is at one point of a line.
typedef struct ref_point {
    double e, radius, mu_s;
    double height01; ///< sqrt(height/top)
    int lit;
    double depth[REF_BANDS];    ///< from the start
    double sun[REF_BANDS];      ///< toward the sun, when lit
    double rayleigh[REF_BANDS]; ///< scattering, 1/km
    double aerosol[REF_BANDS];
} ref_point;

void ref_line_begin(const ref_air *air, ref_line *line, double e, double b, double b_sun, double nu);
void ref_line_at(const ref_air *air, const ref_line *line, double s, ref_point *point);
/// Depth from the start to the end.
void ref_line_end(const ref_air *air, const ref_line *line, double depth[REF_BANDS]);
/// Depth toward a sun that stands over the horizon of a point of the ground.
void ref_air_sun(const ref_air *air, double mu_s, double depth[REF_BANDS]);

/// Edges of cells along a line: cut at the tangent point and at the edges of the planet's shadow, each piece laid
/// exponentially from its denser end. @return number of cells; edges[0..n].
#define REF_CELLS_MAX 256
int ref_line_cells(const ref_air *air, const ref_line *line, int lit_cells, int dark_cells, double *edges);

#endif
