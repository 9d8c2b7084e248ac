#include "port/gpiod/skv_gpio.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const uses[SKV_GPIO_USES] = {"encoder_a", "encoder_b", "button", "toggle", "lamp_night", "lamp_bus"};

void skv_gpio_defaults(skv_gpio_config *config) {
    *config = (skv_gpio_config){.debounce_ms = 10, .encoder_steps = 4};
}

static int use_of(const char *key, size_t length) {
    for (int use = 0; use < SKV_GPIO_USES; use++)
        if (strlen(uses[use]) == length && strncmp(uses[use], key, length) == 0)
            return use;
    return -1;
}

static int refuse(char why[SKV_GPIO_WHY], const char *value, const char *allowed) {
    snprintf(why, SKV_GPIO_WHY, "'%.60s' is not allowed: %s", value, allowed);
    return -1;
}

static int set_line(char line[SKV_GPIO_NAME], const char *value, char why[SKV_GPIO_WHY]) {
    if (strlen(value) >= SKV_GPIO_NAME)
        return refuse(why, value, "a line's NAME or CHIP:OFFSET, up to 63 characters");
    strcpy(line, value);
    return 0;
}

static int set_number(long *number, const char *value, long low, long high, char why[SKV_GPIO_WHY]) {
    char *end = NULL;
    errno = 0;
    const long read = strtol(value, &end, 10);
    if (end == value || *end != '\0' || errno != 0 || read < low || read > high) {
        char allowed[64];
        snprintf(allowed, sizeof allowed, "a whole number from %ld to %ld", low, high);
        return refuse(why, value, allowed);
    }
    *number = read;
    return 0;
}

// A list of keys, such as "button, toggle".
static int set_flags(bool flags[SKV_GPIO_USES], const char *value, int count, const char *allowed,
                     char why[SKV_GPIO_WHY]) {
    bool read[SKV_GPIO_USES] = {false};
    for (const char *at = value; *at != '\0';) {
        at += strspn(at, ", \t");
        const size_t length = strcspn(at, ", \t");
        const int use = use_of(at, length);
        if (length > 0 && (use < 0 || use >= count))
            return refuse(why, value, allowed);
        if (length > 0)
            read[use] = true;
        at += length;
    }
    memcpy(flags, read, sizeof read);
    return 0;
}

static int set_encoder_steps(skv_gpio_config *config, const char *value, char why[SKV_GPIO_WHY]) {
    long number = 0;
    if (set_number(&number, value, 1, 4, why) != 0 || number == 3)
        return refuse(why, value, "1, 2 or 4 quarter steps per click");
    config->encoder_steps = (int32_t)number;
    return 0;
}

int skv_gpio_set(skv_gpio_config *config, const char *key, const char *value, char why[SKV_GPIO_WHY]) {
    const int use = use_of(key, strlen(key));
    if (use >= 0)
        return set_line(config->line[use], value, why);
    if (strcmp(key, "active_low") == 0)
        return set_flags(config->active_low, value, SKV_GPIO_USES,
                         "a list of encoder_a, encoder_b, button, toggle, lamp_night, lamp_bus", why);
    if (strcmp(key, "pull_up") == 0)
        return set_flags(config->pull_up, value, SKV_GPIO_LAMP_NIGHT, "a list of encoder_a, encoder_b, button, toggle",
                         why);
    if (strcmp(key, "encoder_steps") == 0)
        return set_encoder_steps(config, value, why);
    if (strcmp(key, "debounce_ms") == 0) {
        long number = 0;
        if (set_number(&number, value, 0, 1000, why) != 0)
            return -1;
        config->debounce_ms = (uint32_t)number;
        return 0;
    }
    snprintf(why, SKV_GPIO_WHY,
             "unknown key: encoder_a, encoder_b, button, toggle, lamp_night, lamp_bus, active_low, pull_up, "
             "debounce_ms and encoder_steps are known");
    return -1;
}
