#include "core/column.h"
