/// What is compiled in.
///
/// With nothing selected everything is there and is chosen at run time. A product that needs less sets macros to 0 with
/// -D, or names one header that does so with -DSKV_CONFIG_FILE='"my_skv_config.h"'; what is left out costs no bytes and
/// no instructions. All objects of a program must see the same selection: skv_model_build() and skv_frame_begin()
/// record it and later calls refuse a model or frame built with another one (SKV_ERR_LAYOUT).
#ifndef SKYVERT_CONFIG_H
#define SKYVERT_CONFIG_H

#ifdef SKV_CONFIG_FILE
#include SKV_CONFIG_FILE
#endif

/// Number of bands: 0 = 3 or 4, chosen by skv_atmosphere.bands at run time; 3 or 4 = fixed.
#ifndef SKV_BANDS
#define SKV_BANDS 0
#endif

/// Integration rules.
#ifndef SKV_RULE_UNIFORM
#define SKV_RULE_UNIFORM 1
#endif
#ifndef SKV_RULE_KELLER
#define SKV_RULE_KELLER 1
#endif
#ifndef SKV_RULE_GAUSS_EXP
#define SKV_RULE_GAUSS_EXP 1
#endif

/// Backends for the optical depth.
#ifndef SKV_DEPTH_CHAPMAN
#define SKV_DEPTH_CHAPMAN 1
#endif
#ifndef SKV_DEPTH_INNER
#define SKV_DEPTH_INNER 1
#endif

/// Terms.
#ifndef SKV_TERM_RAYLEIGH
#define SKV_TERM_RAYLEIGH 1
#endif
#ifndef SKV_TERM_AEROSOL
#define SKV_TERM_AEROSOL 1
#endif
/// A second layer that scatters and absorbs (dust, smoke).
#ifndef SKV_TERM_DUST
#define SKV_TERM_DUST 1
#endif
#ifndef SKV_TERM_OZONE
#define SKV_TERM_OZONE 1
#endif
/// Light that the ground sends into a ray which meets it.
#ifndef SKV_TERM_GROUND
#define SKV_TERM_GROUND 1
#endif
/// Light scattered more than once: tables, grid, diffuse irradiance.
#ifndef SKV_TERM_DIFFUSE
#define SKV_TERM_DIFFUSE 1
#endif
/// Transmittance as a second output of skv_radiance().
#ifndef SKV_OUT_TRANSMITTANCE
#define SKV_OUT_TRANSMITTANCE 1
#endif

/// Phase functions of aerosol and dust.
#ifndef SKV_PHASE_HENYEY_GREENSTEIN
#define SKV_PHASE_HENYEY_GREENSTEIN 1
#endif
#ifndef SKV_PHASE_CORNETTE_SHANKS
#define SKV_PHASE_CORNETTE_SHANKS 1
#endif

/// Profiles of Rayleigh, aerosol and dust other than exponential (with or without background): us76, tent, lognormal,
/// table. Ozone always has them.
#ifndef SKV_PROFILE_TABULATED
#define SKV_PROFILE_TABULATED 1
#endif

/// Lights in one frame (sun, moon). Each costs a full integral per direction.
#ifndef SKV_LIGHTS_MAX
#define SKV_LIGHTS_MAX 2
#endif

/// Directions worked on side by side; a power of two. Results do not depend on it, stack and speed do.
#ifndef SKV_LANES
#if defined(__arm__) && !defined(__ARM_NEON)
#define SKV_LANES 1
#else
#define SKV_LANES 8
#endif
#endif

/// Copies of the inner kernel for the most common selections: faster, some kilobytes each. 0 = one kernel for all.
#ifndef SKV_SPECIALISE
#if defined(__arm__) && !defined(__ARM_NEON)
#define SKV_SPECIALISE 0
#else
#define SKV_SPECIALISE 1
#endif
#endif

#if SKV_BANDS != 0 && SKV_BANDS != 3 && SKV_BANDS != 4
#error "SKV_BANDS: 0, 3 or 4"
#endif
#if !SKV_RULE_UNIFORM && !SKV_RULE_KELLER && !SKV_RULE_GAUSS_EXP
#error "at least one SKV_RULE_* must be 1"
#endif
#if !SKV_DEPTH_CHAPMAN && !SKV_DEPTH_INNER
#error "at least one SKV_DEPTH_* must be 1"
#endif
#if SKV_LIGHTS_MAX < 1 || SKV_LIGHTS_MAX > 8
#error "SKV_LIGHTS_MAX: 1 to 8"
#endif
#if SKV_LANES < 1 || SKV_LANES > 64 || (SKV_LANES & (SKV_LANES - 1)) != 0
#error "SKV_LANES: a power of two, 1 to 64"
#endif

/// Most bands a struct has room for.
#if SKV_BANDS == 3
#define SKV_BANDS_MAX 3
#else
#define SKV_BANDS_MAX 4
#endif

#endif
