#include "scene/ephemeris.h"
