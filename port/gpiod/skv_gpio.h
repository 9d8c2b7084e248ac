/// Switches and lamps of a cockpit over GPIO: a rotary encoder, a push button, a toggle switch, two lamps.
/// By libgpiod 1.6 or 2.x, whichever is there. Linux only. Not for several threads at once.
///
/// In order: skv_gpio_defaults(), skv_gpio_set() for each setting, skv_gpio_open(); then, whenever skv_gpio_fd() is
/// readable, skv_gpio_read(); skv_gpio_lamp() at any time; skv_gpio_close(). A line that is missing, busy or wrongly
/// configured is reported in one sentence, and all the others work.
#ifndef SKV_GPIO_H
#define SKV_GPIO_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// The lines, by their use.
typedef enum {
    SKV_GPIO_ENCODER_A,
    SKV_GPIO_ENCODER_B,
    SKV_GPIO_BUTTON,
    SKV_GPIO_TOGGLE,
    SKV_GPIO_LAMP_NIGHT,
    SKV_GPIO_LAMP_BUS,
    SKV_GPIO_USES
} skv_gpio_use;

enum { SKV_GPIO_NAME = 64, SKV_GPIO_WHY = 240 };

typedef struct {
    /// NAME, or CHIP:OFFSET with CHIP a number, gpiochipN or /dev/gpiochipN. Empty: not used.
    char line[SKV_GPIO_USES][SKV_GPIO_NAME];
    bool active_low[SKV_GPIO_USES]; ///< a contact to ground, or a lamp that is lit at level 0
    bool pull_up[SKV_GPIO_USES];    ///< the chip's own pull-up resistor, where it has one; inputs only
    uint32_t debounce_ms;           ///< of button and toggle, 0 to 1000
    int32_t encoder_steps;          ///< quarter steps per click, 1, 2 or 4
} skv_gpio_config;

/// No lines, 10 ms, 4 quarter steps per click.
void skv_gpio_defaults(skv_gpio_config *config);

/// One setting as text. Keys: encoder_a, encoder_b, button, toggle, lamp_night, lamp_bus (a line each); active_low,
/// pull_up (comma-separated names of these keys); debounce_ms; encoder_steps.
/// @param[out] why on error what is wrong and what is allowed, without the key.
/// @return 0; -1 iff the key is unknown or the value is not allowed. On error nothing is changed.
int skv_gpio_set(skv_gpio_config *config, const char *key, const char *value, char why[SKV_GPIO_WHY]);

/// Takes one sentence, without a line end.
typedef void skv_gpio_say(void *context, const char *sentence);

typedef struct skv_gpio skv_gpio;

/// Opens the lines of config. Lamps start dark.
/// @param say called for each line that is not there now, and later for one that is lost.
/// @return the panel, also where no line could be had; NULL iff memory or file descriptors are used up.
skv_gpio *skv_gpio_open(const skv_gpio_config *config, skv_gpio_say *say, void *context);

/// Whether this line is in use.
bool skv_gpio_has(const skv_gpio *panel, skv_gpio_use use);

/// One descriptor to poll for reading: edges, and the times at which a switch has settled.
int skv_gpio_fd(const skv_gpio *panel);

/// What the panel says.
typedef struct {
    int32_t clicks;   ///< of the encoder since the last call, forwards positive
    uint32_t presses; ///< of the button since the last call
    bool button;      ///< held down; false once its line is lost
    bool toggle;      ///< on; as it was once its line is lost
    bool toggled;     ///< toggle has changed since the last call
    int64_t input_ns; ///< newest edge since the last call, CLOCK_MONOTONIC as the kernel saw it; 0: none
    int32_t position; ///< of the encoder, quarter steps since the start
    uint32_t invalid; ///< transitions of the encoder that cannot be, since the start
    uint32_t bounces; ///< edges of button and toggle that led to nothing, since the start
} skv_gpio_input;

/// Reads what has come in. Never blocks.
void skv_gpio_read(skv_gpio *panel, skv_gpio_input *input);

/// Lights a lamp, or puts it out. A lamp that is not there is passed over.
void skv_gpio_lamp(skv_gpio *panel, skv_gpio_use lamp, bool lit);

/// Puts the lamps out and gives the lines back. NULL does nothing.
void skv_gpio_close(skv_gpio *panel);

#endif
