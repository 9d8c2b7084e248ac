/// Knob, button, toggle and lamps: what they mean.
#ifndef COCKPIT_PANEL_H
#define COCKPIT_PANEL_H

#include "cockpit.h"
#include "cockpit_state.h"

typedef struct cockpit_panel {
    skv_gpio *gpio;
    bool visibility; ///< the knob turns the visibility instead of the time of day
    bool night, bus; ///< lamps
    uint32_t invalid, bounces, presses;
    int32_t position;
} cockpit_panel;

/// Opens what there is; what is not there is said in a line each.
void cockpit_panel_open(cockpit_panel *panel, const cockpit_options *options);
void cockpit_panel_close(cockpit_panel *panel);
/// For epoll; -1: none.
int cockpit_panel_fd(const cockpit_panel *panel);

/// Reads knob, button and toggle into the state: the button takes both settings back.
void cockpit_panel_read(cockpit_panel *panel, const cockpit_options *options, cockpit_state *state);

/// The same for an input at hand. @param[in] shown_km  visibility that the knob starts from.
void cockpit_panel_turn(cockpit_panel *panel, const cockpit_options *options, cockpit_state *state,
                        const skv_gpio_input *input, double shown_km);

/// Lights the lamps. @param[in] sun_deg  the sun's elevation; NaN: not known, the lamp stays.
void cockpit_panel_lamps(cockpit_panel *panel, const cockpit_options *options, double sun_deg, bool bus_fault);

#endif
