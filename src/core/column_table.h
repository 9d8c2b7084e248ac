/// Columns of species that are not exponential, as small tables of a smooth ratio; built once per change.
#ifndef SKV_CORE_COLUMN_TABLE_H
#define SKV_CORE_COLUMN_TABLE_H

#include "skyvert/atmosphere.h"

/// Density of a user's profile at one altitude.
float skv_profile_density(const skv_profile *profile, const skv_species *species, float h_km);

/// Altitude of the centre of mass, clamped to what the closed form allows: the reference scale height.
float skv_profile_centroid_km(const skv_profile *profile, const skv_species *species, float top_km);

/// Fills a table. species->column says which base the ratios are to.
void skv_column_table_build(skv_column_table *table, const skv_profile *profile, const skv_species *species,
                            float radius_km, float top_km);

/// The knots of a layer: tent, lognormal, or a table of few rows. @return their number; 0: it is none of these.
int32_t skv_knots_build(skv_column_table *table, const skv_profile *profile, const skv_species *species,
                        float radius_km, float top_km);

/// Resamples a density for run time.
void skv_density_table_build(float density[SKV_DENSITY_ROWS], const skv_profile *profile, const skv_species *species,
                             float top_km);

#endif
