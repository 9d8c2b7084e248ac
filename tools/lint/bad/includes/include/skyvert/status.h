#include "skyvert/radiance.h"
