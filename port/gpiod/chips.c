#include "port/gpiod/chips.h"

#include <dirent.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PREFIX "gpiochip"

bool chips_next(int *number) {
    DIR *folder = opendir("/dev");
    int next = INT_MAX;
    for (const struct dirent *entry; folder && (entry = readdir(folder)) != NULL;)
        if (strncmp(entry->d_name, PREFIX, sizeof PREFIX - 1) == 0) {
            const int found = atoi(entry->d_name + sizeof PREFIX - 1);
            if (found > *number && found < next)
                next = found;
        }
    if (folder)
        closedir(folder);
    *number = next;
    return next != INT_MAX;
}

void chips_path(char path[CHIPS_PATH], int number) {
    snprintf(path, CHIPS_PATH, "/dev/" PREFIX "%d", number);
}
