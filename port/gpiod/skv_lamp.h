/// When a lamp is lit. Pure.
#ifndef SKV_LAMP_H
#define SKV_LAMP_H

#include <stdbool.h>

/// Lit below a value, with hysteresis: the night lighting by the sun's elevation.
/// @param lit    whether it is lit now.
/// @param value  such as the sun's elevation, deg; NaN changes nothing.
/// @param below  lit where value < below.
/// @param width  out only where value >= below + width; >= 0.
/// @return whether it is lit from now on.
bool skv_lamp_below(bool lit, float value, float below, float width);

#endif
