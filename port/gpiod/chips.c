#include "port/gpiod/chips.h"

#include <dirent.h>
#include <errno.h>
#include <grp.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

#ifndef CHIPS_DEV
#define CHIPS_DEV "/dev"
#endif
#define PREFIX "gpiochip"

// The chip with the lowest number above *number; start at -1.
static bool next_chip(int *number) {
    DIR *folder = opendir(CHIPS_DEV);
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

void chips_refused(const char *path, int error, char *why, size_t room) {
    struct stat about;
    const int written = snprintf(why, room, "%.60s: %s", path, strerror(error));
    if (error != EACCES || stat(path, &about) != 0)
        return;
    const bool shared = (about.st_mode & S_IRGRP) && (about.st_mode & S_IWGRP);
    const struct group *group = shared ? getgrgid(about.st_gid) : NULL;
    if (group)
        snprintf(why + written, room - (size_t)written, " (it is for the group %.32s)", group->gr_name);
    else
        snprintf(why + written, room - (size_t)written, " (no group may use it: it needs a udev rule)");
}

static bool find_name(const char *name, chips_find *find, chips_place *found, char why[LINES_WHY]) {
    int number = -1, chips = 0;
    char refused[LINES_WHY - 40] = "";
    while (next_chip(&number)) {
        snprintf(found->chip, sizeof found->chip, CHIPS_DEV "/" PREFIX "%d", number);
        const int offset = find(found->chip, name);
        if (offset == CHIPS_REFUSED) {
            strcpy(refused, "; ");
            chips_refused(found->chip, errno, refused + 2, sizeof refused - 2);
            continue;
        }
        chips++;
        if (offset != CHIPS_ABSENT) {
            found->offset = (unsigned)offset;
            return true;
        }
    }
    snprintf(why, LINES_WHY, "no such line on %d GPIO chip%s%s", chips, chips == 1 ? "" : "s", refused);
    return false;
}

static bool locate(const lines_spec *spec, chips_find *find, chips_place *found, char why[LINES_WHY]) {
    if (spec->name)
        return find_name(spec->name, find, found, why);
    snprintf(found->chip, sizeof found->chip, "%s", spec->chip);
    found->offset = spec->offset;
    return true;
}

// A chip may have two paths: a Raspberry Pi 5 has /dev/gpiochip4 for its gpiochip0.
static bool same_chip(const char *a, const char *b) {
    struct stat at_a, at_b;
    return strcmp(a, b) == 0 || (stat(a, &at_a) == 0 && stat(b, &at_b) == 0 && S_ISCHR(at_a.st_mode) &&
                                 S_ISCHR(at_b.st_mode) && at_a.st_rdev == at_b.st_rdev);
}

bool chips_gather(const lines_spec *specs, int n, chips_find *find, chips_place places[LINES_MAX],
                  char why[LINES_WHY]) {
    for (int i = 0; i < n; i++) {
        if (!locate(&specs[i], find, &places[i], why))
            return false;
        if (!same_chip(places[i].chip, places[0].chip)) {
            snprintf(why, LINES_WHY, "both lines have to be on one chip, these are on %.60s and %.60s", places[0].chip,
                     places[i].chip);
            return false;
        }
        if (i > 0 && places[i].offset == places[0].offset) {
            snprintf(why, LINES_WHY, "both are line %u of %.60s", places[0].offset, places[0].chip);
            return false;
        }
    }
    return true;
}

void chips_explain(int error, const char *user, bool inputs, char why[LINES_WHY]) {
    if (error == EBUSY && user)
        snprintf(why, LINES_WHY, "busy: in use by %s", user);
    else if (inputs && (error == ENODEV || error == ENXIO)) // such as an expander whose interrupt is not wired
        snprintf(why, LINES_WHY, "the chip has no interrupt for it, so its edges are not seen (%s)", strerror(error));
    else
        snprintf(why, LINES_WHY, "%s", strerror(error));
}

int64_t chips_steady(int64_t at_ns, int64_t now_ns, int64_t wall_ns) {
    if (at_ns <= now_ns)
        return at_ns;
    const int64_t steady_ns = at_ns - (wall_ns - now_ns);
    return steady_ns < now_ns ? steady_ns : now_ns;
}

int64_t lines_now(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}
