/// The GPIO chips of this machine, for both versions of libgpiod.
#ifndef SKV_GPIO_CHIPS_H
#define SKV_GPIO_CHIPS_H

#include <stdbool.h>

enum { CHIPS_PATH = 80 };

/// The chip with the lowest number above *number; start at -1. @return false iff there is none.
bool chips_next(int *number);

void chips_path(char path[CHIPS_PATH], int number);

#endif
