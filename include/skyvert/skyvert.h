/// Skyvert: an embedded sky model for flight simulators. Umbrella header, in the order of the data flow.
///
///     once per change    skv_atmosphere --skv_model_build()--> skv_model
///                        skv_model --skv_table_build()--> skv_table, for all orders of scattering
///     once per frame     skv_model, observer, lights --skv_frame_begin()--> skv_frame
///                        skv_frame, skv_table --skv_frame_table()--> skv_frame
///     per vertex         skv_frame, directions --skv_radiance()--> radiance
///                        radiance --skv_colour()--> linear RGB, luminance
#ifndef SKYVERT_SKYVERT_H
#define SKYVERT_SKYVERT_H

#define SKV_VERSION_MAJOR 0
#define SKV_VERSION_MINOR 4
#define SKV_VERSION_PATCH 0
#define SKV_VERSION       "0.4.0"

#include "skyvert/config.h"
#include "skyvert/status.h"
#include "skyvert/atmosphere.h"
#include "skyvert/frame.h"
#include "skyvert/table.h"
#include "skyvert/radiance.h"
#include "skyvert/irradiance.h"
#include "skyvert/colour.h"
#include "skyvert/sun.h"
#include "skyvert/moonlight.h"
#include "skyvert/disc.h"
#include "skyvert/stars.h"
#include "skyvert/night.h"
#include "skyvert/water.h"
#include "skyvert/work.h"
#include "skyvert/dome.h"
#include "skyvert/display.h"

#endif
