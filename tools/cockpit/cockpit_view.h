/// The picture on a terminal, and the line a second where there is none.
#ifndef COCKPIT_VIEW_H
#define COCKPIT_VIEW_H

#include "cockpit_bus.h"
#include "cockpit_panel.h"
#include "cockpit_sky.h"
#include "cockpit_stats.h"

/// All that is shown.
typedef struct cockpit_shown {
    const cockpit_options *options;
    const cockpit_state *state;
    const cockpit_now *now;
    const cockpit_bus *bus;
    const cockpit_sky *sky;
    const cockpit_panel *panel;
    const cockpit_stats *stats;
    bool running; ///< a sky is shown
    uint32_t flags;
} cockpit_shown;

enum { COCKPIT_TEXT = 768 * 1024 };

/// A line: its words and their order stay as they are, for other programs to read.
void cockpit_view_line(const cockpit_shown *shown, char *text, size_t size);

/// A picture of columns x rows characters, at least 20 x 4, with the control sequences that paint it in place.
/// @return bytes
size_t cockpit_view_picture(const cockpit_shown *shown, int columns, int rows, char *text, size_t size);

/// Takes the terminal: its other screen, without a cursor. Gives it back.
void cockpit_view_begin(void);
void cockpit_view_end(void);
/// Size of the terminal; 80 x 24 where it does not say.
void cockpit_view_size(int *columns, int *rows);

#endif
