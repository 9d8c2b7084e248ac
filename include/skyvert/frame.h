/// Stage 2, once per frame: where the observer is and what shines.
///
/// Frame of all directions: east, north, up (ENU) at the observer; up is away from the planet's centre.
#ifndef SKYVERT_FRAME_H
#define SKYVERT_FRAME_H

#include "skyvert/atmosphere.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Where along a ray the samples lie.
typedef enum skv_rule {
    SKV_UNIFORM = 0,   ///< midpoints of N equal steps, depth by M equal steps
    SKV_KELLER = 1,    ///< midpoints of steps ending at L(i/N)^3, depth at L(j/M)^2 [Keller08]
    SKV_GAUSS_EXP = 2, ///< N Gauss-Legendre nodes per lit part of the ray, in an exponential map from its densest end
} skv_rule;

/// How the optical depth between two points is found.
typedef enum skv_depth {
    SKV_DEPTH_BY_CHAPMAN = 0, ///< closed form (erfcx form of the Chapman function), tables for non-exponential profiles
    SKV_DEPTH_BY_INNER = 1,   ///< M samples for each of the two paths of each sample
} skv_depth;

typedef enum skv_tier { SKV_TIER_FAST = 0, SKV_TIER_STANDARD = 1, SKV_TIER_HIGH = 2 } skv_tier;

/// Bits of skv_quality.terms.
enum {
    SKV_WITH_RAYLEIGH = 1,
    SKV_WITH_AEROSOL = 2,
    SKV_WITH_DUST = 4,
    SKV_WITH_OZONE = 8,
    SKV_WITH_GROUND = 16, ///< the light a ray's ground end sends back (lit by the lights' direct beams)
    SKV_WITH_ALL = 31
};

#define SKV_SAMPLES_MAX 64

/// Speed against accuracy.
typedef struct skv_quality {
    skv_rule rule;
    skv_depth depth;
    int32_t samples;       ///< N, [1, 64]; gauss-exp: [2, 16], per lit part of a ray (at most three)
    int32_t depth_samples; ///< M, [1, 64]; gauss-exp: [2, 16]; inner depth only
    uint32_t terms;        ///< SKV_WITH_* bits
} skv_quality;

/// The settings of a tier: gauss-exp, Chapman depth, all terms but the ground, N = 4, 6, 8.
/// SKV_TIER_FAST goes over to N = 6 by itself where N = 4 is not good enough: observers above 16 km, lights below 5
/// deg.
skv_status skv_quality_tier(skv_quality *quality, skv_tier tier);

/// A distant light. The sun is one, the moon may be another.
typedef struct skv_light {
    float direction_enu[3]; ///< toward the light; any normal length
    float irradiance[4];    ///< above the air, on a plane facing the light, W m^-2 nm^-1, [0, 1e6]
} skv_light;

/// Derived: one light of a frame.
typedef struct skv_frame_light {
    float direction_enu[3];
    float irradiance[4]; ///< times the model's absorption colour
    float mu_s;
} skv_frame_light;

/// Derived: one species above the ground of a frame.
typedef struct skv_frame_species {
    int32_t kind;          ///< NONE: absent or switched off
    float inv_scale_log2e; ///< log2(e)/H
    float chapman_ck;      ///< c/sqrt(2 H), c of the erfcx form
    float chapman_a;       ///< H sqrt(pi)/sqrt(2 H), times the reference density at the ground
    float chapman_z;       ///< 3 H/8
    float background;      ///< constant density beside exp(-h/H)
    float top_column; ///< 2 H exp(-top/H): twice the column above the top that the closed form counts; 0 = negligible
    float top_k;      ///< 8 H/(pi (R + top))
} skv_frame_species;

/// Bounds that the inner loops clamp to. In memory and not as literals: gcc makes one instruction of a minimum of two
/// variables and two of one with a literal.
typedef struct skv_frame_limits {
    float zero, one;
    float exp2_floor; ///< -126
} skv_frame_limits;

struct skv_table;

/// Derived: what light scattered more than once needs (src/core/diffuse.h); table.h.
typedef struct skv_frame_diffuse {
    const struct skv_table *table;       ///< NULL: single scattering only
    const float *grid;                   ///< NULL: integrated ray by ray
    int32_t samples;                     ///< nodes per leg
    int32_t only;                        ///< 1: without light scattered once
    int32_t kept;                        ///< the species whose aureole the table keeps
    float inv_span;                      ///< of the table's rows, 1/km
    float offset_km;                     ///< the frame's ground above the table's
    float column_first, column_scale;    ///< of the table's columns (src/core/cells.h)
    float grid_horizon;                  ///< cosine of the zenith angle of the geometric horizon
    float grid_up, grid_down;            ///< 1/range of that cosine above and below it
    float grid_flat[SKV_LIGHTS_MAX][2];  ///< unit vector towards a light's azimuth
    float grid_left[SKV_LIGHTS_MAX][2];  ///< that vector turned left by a right angle
    float moment[SKV_SCATTERERS][4];     ///< of the scatterers' phase functions, degrees 1 to 4
    float aureole[SKV_SCATTERERS];       ///< g of light that they scatter out of the aureole
    float toward_enu[SKV_LIGHTS_MAX][3]; ///< centre of the aureole
} skv_frame_diffuse;

/// Most altitudes at which legs are cut.
#define SKV_FRAME_BREAKS 16

/// Derived, constant after skv_frame_begin(); points to the model, which must outlive it.
typedef struct skv_frame {
    uint32_t layout;
    const skv_model *model;
    skv_quality quality;
    uint32_t has; ///< what the kernels need to know of all this (src/core/lanes.h)
    int32_t lights;
    skv_frame_light light[SKV_LIGHTS_MAX];
    float radius_km; ///< of the sphere that is the ground
    float ground_km; ///< its altitude above the sea
    float height_km; ///< of the observer above the ground, clamped to it
    float top_km;    ///< of the air above the ground
    skv_frame_limits limits;
    float node[16], weight[16]; ///< gauss-exp: of the quality's samples, or on the way from one number to another
    skv_frame_species species[SKV_SPECIES];
    int32_t breaks;                   ///< altitudes above the ground at which legs are cut, ascending
    float break_km[SKV_FRAME_BREAKS]; ///< (src/core/slices.h)
    uint32_t break_inbound;           ///< bit i: only on legs towards the observer
    float fog_km;                     ///< distance from the observer where legs are cut in fog; 0: there is none
    float inner_scale_km;             ///< of the exponential map of the inner depth
    float map_scale;                  ///< largest scale height over 8 km
    float map_per_km[SKV_SCATTERERS]; ///< extinction that shortens the map of gauss-exp, per unit of relative density
    /// Per unit of relative density (exponential species: of that at the ground); extinction times log2(e).
    float scattering_per_km[SKV_SCATTERERS][4];
    float extinction_log2e_per_km[SKV_SPECIES][4];
    skv_frame_diffuse diffuse;
} skv_frame;

/// Prepares a frame.
/// @param[out] frame
/// @param[in]  model         from skv_model_build(); kept by reference.
/// @param[in]  quality       NULL: the standard tier.
/// @param[in]  observer_km   altitude of the observer above the sea; below the ground counts as on it; [-1e6, 1e6].
/// @param[in]  ground_km     altitude of the ground around the observer above the sea, [-12, 12] and below the top.
/// @param[in]  lights        [n_lights].
/// @param[in]  n_lights      [0, SKV_LIGHTS_MAX].
/// @return SKV_OK; SKV_ERR_NULL; SKV_ERR_RANGE; SKV_ERR_DIRECTION (of a light); SKV_ERR_UNSUPPORTED (rule, depth or
/// term
///         left out at compile time); SKV_ERR_LAYOUT (model not built). On error the frame is not written.
skv_status skv_frame_begin(skv_frame *frame, const skv_model *model, const skv_quality *quality, float observer_km,
                           float ground_km, const skv_light *lights, int32_t n_lights);

/// The sun as a light of the model's solar irradiance.
skv_status skv_light_sun(skv_light *light, const skv_model *model, const float direction_enu[3]);

#ifdef __cplusplus
}
#endif
#endif
