#include "../geographiclib/skv_geo.h"
