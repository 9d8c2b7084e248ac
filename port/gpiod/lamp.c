#include "port/gpiod/skv_lamp.h"

bool skv_lamp_below(bool lit, float value, float below, float width) {
    if (value < below)
        return true;
    if (value >= below + width)
        return false;
    return lit; // between the two, or NaN
}
