#include "cockpit_panel.h"

#include <math.h>
#include <string.h>

#include "port/gpiod/skv_lamp.h"

static void say(void *context, const char *sentence) {
    (void)context;
    (void)fail_job(COCKPIT ": %s", sentence); // its status is not wanted: it goes on
}

static bool any_line(const skv_gpio_config *config) {
    for (int i = 0; i < SKV_GPIO_USES; i++)
        if (config->line[i][0] != '\0')
            return true;
    return false;
}

void cockpit_panel_open(cockpit_panel *panel, const cockpit_options *options) {
    skv_gpio_input input;
    memset(panel, 0, sizeof *panel);
    if (!any_line(&options->gpio))
        return;
    panel->gpio = skv_gpio_open(&options->gpio, say, NULL);
    if (!panel->gpio)
        return;
    skv_gpio_read(panel->gpio, &input);
    panel->visibility = input.toggle;
}

void cockpit_panel_close(cockpit_panel *panel) {
    skv_gpio_close(panel->gpio);
    panel->gpio = NULL;
}

int cockpit_panel_fd(const cockpit_panel *panel) {
    return panel->gpio ? skv_gpio_fd(panel->gpio) : -1;
}

static double limited(double x, double low, double high) {
    return fmax(low, fmin(high, x));
}

void cockpit_panel_turn(cockpit_panel *panel, const cockpit_options *options, cockpit_state *state,
                        const skv_gpio_input *input, double shown_km) {
    panel->visibility = input->toggle;
    panel->presses += input->presses;
    panel->invalid = input->invalid;
    panel->bounces = input->bounces;
    panel->position = input->position;
    if (input->presses > 0) {
        state->time_offset_s = 0.0;
        state->visibility_km = 0.0;
    }
    if (input->clicks == 0)
        return;
    if (panel->visibility)
        state->visibility_km = limited(shown_km * pow(options->visibility_per_click, input->clicks), 0.1, 200.0);
    else
        state->time_offset_s =
            limited(state->time_offset_s + 60.0 * options->minutes_per_click * input->clicks, -86400.0, 86400.0);
}

void cockpit_panel_read(cockpit_panel *panel, const cockpit_options *options, cockpit_state *state) {
    skv_gpio_input input;
    cockpit_now now;
    if (!panel->gpio)
        return;
    skv_gpio_read(panel->gpio, &input);
    cockpit_state_now(state, state->last_ns, &now);
    cockpit_panel_turn(panel, options, state, &input, now.visibility_km);
}

void cockpit_panel_lamps(cockpit_panel *panel, const cockpit_options *options, double sun_deg, bool bus_fault) {
    panel->night =
        skv_lamp_below(panel->night, (float)sun_deg, (float)options->night_below_deg, (float)options->night_width_deg);
    panel->bus = bus_fault;
    if (!panel->gpio)
        return;
    skv_gpio_lamp(panel->gpio, SKV_GPIO_LAMP_NIGHT, panel->night);
    skv_gpio_lamp(panel->gpio, SKV_GPIO_LAMP_BUS, panel->bus);
}
