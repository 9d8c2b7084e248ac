#include "../../src/core/column.h"
