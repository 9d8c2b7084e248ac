/// Single scattering in double, converged: the truth that the float core is measured against. Shares no code with src/.
///
/// The semantics are those of the command's ini files: a spherical planet, altitudes above the sea (radius_km), no air
/// above top_km, a point sun, no refraction, the planet's shadow a sharp edge. Units: km, 1/km.
///
/// Method: Gauss-Kronrod (10, 21), globally adaptive, on panels cut at everything that is not smooth: the tangent
/// point, the shadow's edge, the knots of profiles on the ray, and the points whose sun ray is tangent to a knot.
/// Each panel is entered through s = a + (b-a) u^2 (3-2u), which turns the square roots left at its ends into
/// polynomials. Optical depths: Gauss-Legendre on pieces of at most 8 scale heights cut at the same knots.
#ifndef TOOLS_REFERENCE_SINGLE_H
#define TOOLS_REFERENCE_SINGLE_H

#define REF_BANDS      4
#define REF_TABLE_ROWS 512

typedef enum ref_kind {
    REF_NONE,
    REF_EXPONENTIAL,    ///< exp(-h/scale_km)
    REF_EXP_BACKGROUND, ///< (exp(-h/scale_km) + background)/(1 + background)
    REF_US76,           ///< exp(-us76_a h^us76_b), 1 below h = 0
    REF_TENT,           ///< max(0, 1 - |h - peak_km|/half_width_km)
    REF_LOGNORMAL,      ///< exp(-k (ln h - mu)^2)/h, 1 at its peak, 0 below h = 0
    REF_TABLE,          ///< linear between the rows, constant beyond the ends
} ref_kind;

typedef struct ref_profile {
    ref_kind kind;
    double scale_km, background;
    double us76_a, us76_b;
    double peak_km, half_width_km;
    double lognormal_mu, lognormal_k;
    const double *table_km, *table_density;
    int rows;
} ref_profile;

typedef enum ref_phase { REF_HENYEY_GREENSTEIN, REF_CORNETTE_SHANKS } ref_phase;

typedef struct ref_atmosphere {
    int bands; ///< 1 to REF_BANDS
    double radius_km, top_km;
    double ground_km; ///< altitude of the ground above the sea: the planet is a sphere of radius_km + ground_km
    double wavelength_nm[REF_BANDS], irradiance[REF_BANDS], albedo[REF_BANDS];
    double rayleigh_scattering[REF_BANDS], rayleigh_absorption[REF_BANDS];
    ref_profile rayleigh;
    double aerosol_scattering[REF_BANDS], aerosol_extinction[REF_BANDS];
    ref_profile aerosol;
    ref_phase phase;
    double g;
    double ozone_absorption[REF_BANDS];
    ref_profile ozone;
    double dust_scattering[REF_BANDS], dust_extinction[REF_BANDS];
    ref_profile dust;
    ref_phase dust_phase;
    double dust_g;
} ref_atmosphere;

/// A ray and the sun. The three cosines alone lose the small angles, so what forms them goes along.
typedef struct ref_ray {
    double height_km; ///< of the observer above the ground; below it counts as on it
    double mu;        ///< cosine of view and vertical
    double mu_s;      ///< cosine of sun and vertical
    double nu;        ///< cosine of view and sun
    double nu_minus;  ///< 1 - nu
    double nu_plus;   ///< 1 + nu
    double length_km; ///< INFINITY: to the ground or the top
} ref_ray;

typedef struct ref_options {
    double tolerance; ///< relative, of the view integral's error estimate (the true error is far below it)
    int nodes;        ///< of the optical depth's pieces: 16 or 24
} ref_options;

typedef struct ref_answer {
    double radiance[REF_BANDS];
    double transmittance[REF_BANDS]; ///< from the ray's end to the observer
    int meets_ground;                ///< the ray ends on the ground
    int panels;                      ///< used
    double error;                    ///< estimate relative to the radiance, largest over the bands
} ref_answer;

/// From angles in degrees, reduced so that 90 is a cosine of exactly 0. Azimuth 0 is toward the sun.
ref_ray ref_ray_from_angles(double height_km, double sun_zenith_deg, double view_zenith_deg, double azimuth_deg);

/// From directions (east, north, up) of any length, e.g. the very floats that the core was given.
ref_ray ref_ray_from_vectors(double height_km, const double view[3], const double sun[3]);

/// @param[in]  lit_ground  add the light that the ground at the ray's end sends (direct sun only).
/// @param[in]  options     NULL: tolerance 3e-8, 16 nodes.
/// @return 0; -1 iff the integral did not converge (the answer is the best found).
int ref_single(const ref_atmosphere *atmosphere, const ref_ray *ray, int lit_ground, const ref_options *options,
               ref_answer *answer);

/// Relative density of a profile at an altitude above the sea (the cut at top_km is not applied).
double ref_density(const ref_profile *profile, double altitude_km);

/// Integral of the densities {rayleigh, aerosol, ozone} along length_km of a ray, km. For tests.
void ref_column(const ref_atmosphere *atmosphere, const ref_ray *ray, double length_km, double column[3]);

/// Phase function, 1/sr.
double ref_phase_rayleigh(double nu);
double ref_phase_aerosol(const ref_atmosphere *atmosphere, double nu_minus, double nu_plus);
double ref_phase_dust(const ref_atmosphere *atmosphere, double nu_minus, double nu_plus);

#endif
