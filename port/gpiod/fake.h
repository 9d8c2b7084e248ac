/// GPIO lines without hardware, for tests: fake.c takes the place of gpiod1.c or gpiod2.c. Names are a line's NAME; a
/// CHIP:OFFSET is known by the text "CHIP:OFFSET" with the chip's path.
#ifndef SKV_GPIO_FAKE_H
#define SKV_GPIO_FAKE_H

#include <stdbool.h>
#include <stdint.h>

/// No lines, time 0.
void fake_reset(void);

/// A line that is there, at this level (before active_low).
void fake_line(const char *name, bool level);

/// The line cannot be had, for this reason; NULL: it can.
void fake_refuse(const char *name, const char *why);

/// The clock.
void fake_time(int64_t now_ns);

/// An edge that the kernel queues; at most 16 wait, as in the kernel, and later ones are lost.
void fake_edge(const char *name, int64_t at_ns, bool level);

/// An edge that comes just before the line's level is asked for the next time.
void fake_edge_before_level(const char *name, int64_t at_ns, bool level);

/// From now on more edges wait each time that the line is read.
void fake_storm(const char *name);

/// The line is pulled out.
void fake_lose(const char *name);

/// Level of an output.
bool fake_level(const char *name);

/// Whether the line was last asked for by its name, not as CHIP:OFFSET.
bool fake_by_name(const char *name);

/// How many requests are open.
int fake_open(void);

#endif
