/// A picture of the whole sky as a file, made by a child process: the frames go on.
#ifndef COCKPIT_SNAPSHOT_H
#define COCKPIT_SNAPSHOT_H

#include <sys/types.h>

#include "cockpit.h"
#include "cockpit_sky.h"

/// Writes the files that the options name, in this process: latitude and longitude, 720 x 361, one pixel half a degree.
/// @return 0, or a status after an error line.
int cockpit_snapshot_write(const cockpit_options *options, const cockpit_sky *sky);

/// The same in a child process, of the sky as it is now. @return its number; -1 iff there is none to be had
pid_t cockpit_snapshot_begin(const cockpit_options *options, const cockpit_sky *sky);

#endif
