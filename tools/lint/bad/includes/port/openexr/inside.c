#include "core/elementary.h"
