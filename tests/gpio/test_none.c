// The panel of a machine that was built without libgpiod: each line is said to be missing, and it goes on.
#include "check.h"
#include "port/gpiod/skv_gpio.h"

#include <stdio.h>
#include <string.h>

static int sentences;

static void say(void *context, const char *sentence) {
    (void)context;
    sentences++;
    if (!strstr(sentence, ": built without libgpiod (package libgpiod-dev); goes on without it"))
        fail_msg("said: %s", sentence);
}

static void it_says_so_and_goes_on(void **state) {
    (void)state;
    static const char *const keys[] = {"encoder_a", "encoder_b", "button", "toggle", "lamp_night", "lamp_bus"};
    skv_gpio_config config;
    skv_gpio_input input;
    char why[SKV_GPIO_WHY], line[8];
    skv_gpio_defaults(&config);
    for (int i = 0; i < SKV_GPIO_USES; i++) {
        snprintf(line, sizeof line, "0:%d", i);
        assert_int_equal(skv_gpio_set(&config, keys[i], line, why), 0);
    }
    skv_gpio *panel = skv_gpio_open(&config, say, NULL);
    assert_non_null(panel);
    assert_int_equal(sentences, 5); // the encoder's two are one
    skv_gpio_lamp(panel, SKV_GPIO_LAMP_NIGHT, true);
    skv_gpio_read(panel, &input);
    assert_true(input.clicks == 0 && input.presses == 0 && !input.button);
    skv_gpio_close(panel);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(it_says_so_and_goes_on)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
