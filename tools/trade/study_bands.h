/// What three bands instead of four are worth in colour: light scattered once against 48 wavelengths.
#ifndef TOOLS_TRADE_STUDY_BANDS_H
#define TOOLS_TRADE_STUDY_BANDS_H

#include "study_sky.h"

/// Delta E 1976 of one scene, the white as bright as its brightest ray, the sun's surroundings left out.
typedef struct study_bands {
    double mean[2], max[2]; ///< of three and of four bands
    double luminance[2];    ///< mean error of the luminance (of at least 5 % of the white's), 1 = 100 %
} study_bands;

/// The nine scenes (study_sky.h) of a preset that is an Earth: EARTH_CLEAR or EARTH_HAZY.
/// @param[in] spectra  folder with cie1931.txt, solar_g173.txt, ozone_serdyuchenko.txt, grass_albedo.txt.
/// @param[in] rays     per scene, [4, 64].
/// @return FAILED with a line on stderr, else DONE.
int study_bands_measure(skv_preset preset, const char *spectra, int rays, study_bands result[TRADE_SCENES]);

#endif
