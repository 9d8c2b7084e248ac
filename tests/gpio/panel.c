// panel [KEY=VALUE...]: opens a panel with these settings and prints what changes, a line each, until a line "end"
// comes in. Lamps by lines "night 0|1", "bus 0|1" on standard input; "steps" prints the counts. Exit status 2 for a bad
// setting.
#include "port/gpiod/skv_gpio.h"

#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void say(void *context, const char *sentence) {
    (void)context;
    printf("%s\n", sentence);
}

static int settings(skv_gpio_config *config, char **words, int n) {
    char why[SKV_GPIO_WHY];
    for (int i = 0; i < n; i++) {
        char *value = strchr(words[i], '=');
        if (value)
            *value++ = '\0';
        if (skv_gpio_set(config, words[i], value ? value : "", why) != 0) {
            fprintf(stderr, "panel: %s: %s\n", words[i], why);
            return -1;
        }
    }
    return 0;
}

static void show(const skv_gpio_input *now, bool *held) {
    if (now->clicks)
        printf("clicks %d at %d\n", (int)now->clicks, (int)now->position);
    if (now->presses)
        printf("presses %u\n", (unsigned)now->presses);
    if (now->toggled)
        printf("toggle %d\n", now->toggle);
    if (now->button != *held)
        printf("button %s\n", now->button ? "down" : "up");
    *held = now->button;
}

// One line of standard input. Returns whether to go on.
static bool obey(skv_gpio *panel, const skv_gpio_input *now) {
    char text[64];
    if (!fgets(text, sizeof text, stdin) || strcmp(text, "end\n") == 0)
        return false;
    if (strncmp(text, "night ", 6) == 0)
        skv_gpio_lamp(panel, SKV_GPIO_LAMP_NIGHT, text[6] == '1');
    else if (strncmp(text, "bus ", 4) == 0)
        skv_gpio_lamp(panel, SKV_GPIO_LAMP_BUS, text[4] == '1');
    else
        printf("position %d invalid %u bounces %u toggle %d\n", (int)now->position, (unsigned)now->invalid,
               (unsigned)now->bounces, now->toggle);
    return true;
}

int main(int argc, char **argv) {
    skv_gpio_config config;
    skv_gpio_defaults(&config);
    setvbuf(stdout, NULL, _IOLBF, 0);
    setvbuf(stdin, NULL, _IONBF, 0);
    if (settings(&config, argv + 1, argc - 1) != 0)
        return 2;
    skv_gpio *panel = skv_gpio_open(&config, say, NULL);
    if (!panel)
        return 1;
    printf("ready\n");
    skv_gpio_input now = {.clicks = 0};
    bool held = false;
    for (bool on = true; on;) {
        struct pollfd waits[2] = {{.fd = skv_gpio_fd(panel), .events = POLLIN}, {.fd = 0, .events = POLLIN}};
        if (poll(waits, 2, -1) < 0)
            break;
        skv_gpio_read(panel, &now);
        show(&now, &held);
        if (waits[1].revents)
            on = obey(panel, &now);
    }
    skv_gpio_close(panel);
    return 0;
}
