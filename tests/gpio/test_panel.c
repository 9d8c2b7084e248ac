// The panel on fake lines: settings, what it says of lines that it cannot have, inputs in their order, lamps.
#include "check.h"
#include "port/gpiod/fake.h"
#include "port/gpiod/skv_gpio.h"

#include <poll.h>
#include <string.h>

#define MS INT64_C(1000000)

static char said[8][400];
static int sentences;

static void say(void *context, const char *sentence) {
    (void)context;
    if (sentences < 8)
        strncpy(said[sentences], sentence, sizeof said[0] - 1);
    sentences++;
}

static void set(skv_gpio_config *config, const char *key, const char *value) {
    char why[SKV_GPIO_WHY] = "";
    if (skv_gpio_set(config, key, value, why) != 0)
        fail_msg("%s = %s: refused: %s", key, value, why);
}

static skv_gpio *whole_panel(void) {
    static const char *const names[] = {"A", "B", "PUSH", "/dev/gpiochip0:4", "NIGHT", "/dev/gpiochip1:7"};
    skv_gpio_config config;
    sentences = 0;
    fake_reset();
    fake_time(1000 * MS);
    for (int i = 0; i < 6; i++)
        fake_line(names[i], i == 2); // the button is open: high
    skv_gpio_defaults(&config);
    set(&config, "encoder_a", "A");
    set(&config, "encoder_b", "B");
    set(&config, "button", "PUSH");
    set(&config, "toggle", "gpiochip0:4");
    set(&config, "lamp_night", "NIGHT");
    set(&config, "lamp_bus", "1:7");
    set(&config, "active_low", "button, lamp_bus");
    skv_gpio *panel = skv_gpio_open(&config, say, NULL);
    assert_non_null(panel);
    return panel;
}

static void settings_are_checked(void **state) {
    (void)state;
    static const char *const bad[][2] = {
        {"debounce_ms", "-1"},
        {"debounce_ms", "1001"},
        {"debounce_ms", "10ms"},
        {"debounce_ms", ""},
        {"encoder_steps", "3"},
        {"encoder_steps", "0"},
        {"active_low", "lamp"},
        {"pull_up", "lamp_bus"},
        {"pull_up", "buttons"},
        {"colour", "red"},
        {"button", "0123456789012345678901234567890123456789012345678901234567890123"},
    };
    skv_gpio_config config, before;
    memset(&config, 0, sizeof config);
    skv_gpio_defaults(&config);
    before = config;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char why[SKV_GPIO_WHY] = "";
        if (skv_gpio_set(&config, bad[i][0], bad[i][1], why) == 0 || why[0] == '\0')
            fail_msg("%s = %s was taken, or refused without a reason", bad[i][0], bad[i][1]);
        assert_memory_equal(&config, &before, sizeof config);
    }
    set(&config, "pull_up", "button,  encoder_a");
    assert_true(config.pull_up[SKV_GPIO_BUTTON] && config.pull_up[SKV_GPIO_ENCODER_A]);
    assert_false(config.pull_up[SKV_GPIO_ENCODER_B]);
    set(&config, "debounce_ms", "1000");
    set(&config, "encoder_steps", "2");
    assert_int_equal(config.debounce_ms, 1000);
    assert_int_equal(config.encoder_steps, 2);
}

static void lines_that_are_not_there(void **state) {
    (void)state;
    skv_gpio_config config;
    fake_reset();
    sentences = 0;
    fake_line("A", false);
    fake_line("B", false);
    fake_refuse("B", "busy: in use by other");
    fake_line("NIGHT", false);
    skv_gpio_defaults(&config);
    set(&config, "encoder_a", "A");
    set(&config, "encoder_b", "B");
    set(&config, "button", "gpiochip3:99");
    set(&config, "lamp_night", "NIGHT");
    skv_gpio *panel = skv_gpio_open(&config, say, NULL);
    assert_int_equal(sentences, 2);
    assert_string_equal(said[0], "gpio: encoder (A, B): busy: in use by other; goes on without it");
    assert_string_equal(said[1], "gpio: button (gpiochip3:99): no such line; goes on without it");
    assert_false(skv_gpio_has(panel, SKV_GPIO_ENCODER_A));
    assert_false(skv_gpio_has(panel, SKV_GPIO_BUTTON));
    assert_false(skv_gpio_has(panel, SKV_GPIO_TOGGLE));
    assert_true(skv_gpio_has(panel, SKV_GPIO_LAMP_NIGHT));
    skv_gpio_input input;
    skv_gpio_read(panel, &input);
    assert_int_equal(input.clicks, 0);
    skv_gpio_lamp(panel, SKV_GPIO_LAMP_BUS, true); // not there
    skv_gpio_lamp(panel, SKV_GPIO_LAMP_NIGHT, true);
    assert_true(fake_level("NIGHT"));
    skv_gpio_close(panel);
    assert_false(fake_level("NIGHT"));
    assert_int_equal(fake_open(), 0);
}

static void half_an_encoder(void **state) {
    (void)state;
    skv_gpio_config config;
    fake_reset();
    sentences = 0;
    fake_line("B", false);
    skv_gpio_defaults(&config);
    set(&config, "encoder_b", "B");
    skv_gpio *panel = skv_gpio_open(&config, say, NULL);
    assert_int_equal(sentences, 1);
    assert_string_equal(said[0], "gpio: encoder_b (B): an encoder needs encoder_a and encoder_b; goes on without it");
    skv_gpio_close(panel);
    skv_gpio_close(NULL);
}

// The kernel queues each line's edges apart: all of A come first, then all of B. Their times put them in order.
static void edges_are_put_in_order(void **state) {
    (void)state;
    skv_gpio *panel = whole_panel();
    skv_gpio_input input;
    assert_int_equal(sentences, 0);
    for (int i = 0; i < 16; i++) { // B, A, B, A, ...: forwards by 00 01 11 10
        const bool level = i % 4 < 2;
        fake_edge(i % 2 ? "A" : "B", (1001 + i) * MS, level);
    }
    fake_time(1100 * MS);
    skv_gpio_read(panel, &input);
    assert_int_equal(input.position, 16);
    assert_int_equal(input.clicks, 4);
    assert_int_equal(input.invalid, 0);
    assert_true(input.input_ns == 1016 * MS);
    skv_gpio_read(panel, &input);
    assert_int_equal(input.clicks, 0);
    assert_int_equal(input.position, 16);
    skv_gpio_close(panel);
}

// An edge of the last millisecond waits for an older one of the other line, and wakes the reader when its time has
// come.
static void a_new_edge_waits(void **state) {
    (void)state;
    skv_gpio *panel = whole_panel();
    skv_gpio_input input;
    fake_edge("A", 1000 * MS + MS / 2, true); // second in time, first seen
    fake_time(1001 * MS);
    skv_gpio_read(panel, &input);
    assert_int_equal(input.position, 0);
    struct pollfd waits = {.fd = skv_gpio_fd(panel), .events = POLLIN};
    assert_int_equal(poll(&waits, 1, 2000), 1); // the fake's times are long past: the timer rings at once
    fake_edge("B", 1000 * MS + MS / 4, true);
    fake_time(1003 * MS);
    skv_gpio_read(panel, &input);
    assert_int_equal(input.position, 2);
    assert_int_equal(input.invalid, 0);
    skv_gpio_close(panel);
}

// 42 edges, 16 of each line are kept: the levels say where it is, and it goes on from there.
static void lost_edges_are_noticed(void **state) {
    (void)state;
    skv_gpio *panel = whole_panel();
    skv_gpio_input input, later;
    for (int i = 0; i < 42; i++)
        fake_edge(i % 2 ? "A" : "B", (1001 + i) * MS, i % 4 < 2);
    fake_time(1100 * MS);
    skv_gpio_read(panel, &input);
    assert_int_equal(input.invalid, 1); // the queues end at 00, the levels are at 11
    fake_edge("B", 1101 * MS, false);
    fake_time(1110 * MS);
    skv_gpio_read(panel, &later);
    assert_int_equal(later.position - input.position, 1);
    assert_int_equal(later.invalid, 1);
    skv_gpio_close(panel);
}

// An edge comes while the levels are compared: it counts once, as the edge that it is.
static void turned_while_it_is_checked(void **state) {
    (void)state;
    skv_gpio *panel = whole_panel();
    skv_gpio_input input;
    fake_edge("B", 1001 * MS, true);
    fake_edge_before_level("A", 1010 * MS, true);
    for (int at = 1010; at <= 1020; at += 10) {
        fake_time(at * MS);
        skv_gpio_read(panel, &input);
    }
    assert_int_equal(input.position, 2);
    assert_int_equal(input.invalid, 0);
    skv_gpio_close(panel);
}

static void button_and_toggle(void **state) {
    (void)state;
    skv_gpio *panel = whole_panel();
    skv_gpio_input input;
    skv_gpio_read(panel, &input);
    assert_false(input.button || input.toggle || input.toggled);
    for (int i = 0; i < 5; i++)
        fake_edge("PUSH", (1000 + i) * MS, i % 2 != 0); // active low: ends at 0, pressed
    fake_edge("/dev/gpiochip0:4", 1000 * MS, true);
    fake_time(1005 * MS);
    skv_gpio_read(panel, &input);
    assert_int_equal(input.presses, 0);
    assert_true(input.input_ns == 1004 * MS);
    struct pollfd waits = {.fd = skv_gpio_fd(panel), .events = POLLIN};
    assert_int_equal(poll(&waits, 1, 2000), 1); // without an edge: the timer, the fake's times are long past
    fake_time(1014 * MS);
    skv_gpio_read(panel, &input);
    assert_int_equal(input.presses, 1);
    assert_true(input.button && input.toggle && input.toggled);
    assert_int_equal(input.bounces, 4);
    fake_time(2000 * MS);
    skv_gpio_read(panel, &input);
    assert_int_equal(input.presses, 0);
    assert_false(input.toggled);
    assert_true(input.button && input.toggle);
    skv_gpio_close(panel);
}

// More edges than the kernel keeps: the button is up, though the last edge that was kept is one down.
static void a_lost_last_edge(void **state) {
    (void)state;
    skv_gpio *panel = whole_panel();
    skv_gpio_input input;
    fake_edge("PUSH", 1000 * MS, true);
    for (int i = 0; i < 16; i++)
        fake_edge("PUSH", 1001 * MS + i, i % 2 != 0); // the 17th edge, back up, is lost
    for (int at = 1020; at <= 1040; at += 20) {
        fake_time(at * MS);
        skv_gpio_read(panel, &input);
        assert_int_equal(input.presses, 0);
        assert_false(input.button);
    }
    assert_int_equal(input.bounces, 17); // 16 kept, and the one that was missed
    skv_gpio_close(panel);
}

// The button is let go just when its press has settled and the level is read once more: nothing was lost, it counts.
static void released_while_it_settles(void **state) {
    (void)state;
    skv_gpio *panel = whole_panel();
    skv_gpio_input input;
    int presses = 0;
    fake_edge("PUSH", 1000 * MS, false);
    fake_time(1009 * MS);
    skv_gpio_read(panel, &input);
    fake_edge_before_level("PUSH", 1012 * MS, true);
    for (int at = 1012; at <= 1032; at += 10) {
        fake_time(at * MS);
        skv_gpio_read(panel, &input);
        presses += (int)input.presses;
    }
    assert_int_equal(presses, 1);
    assert_false(input.button);
    assert_int_equal(input.bounces, 0);
    skv_gpio_close(panel);
}

// A line that is open and picks up a signal: a read ends, and the other lines work.
static void a_line_that_never_rests(void **state) {
    (void)state;
    skv_gpio *panel = whole_panel();
    skv_gpio_input input;
    fake_storm("A");
    fake_storm("PUSH");
    fake_edge("/dev/gpiochip0:4", 1000 * MS, true);
    fake_time(1050 * MS);
    skv_gpio_read(panel, &input);
    assert_true(input.toggle);
    assert_int_equal(input.presses, 0);
    skv_gpio_close(panel);
}

static void one_line_for_two_uses(void **state) {
    (void)state;
    skv_gpio_config config;
    fake_reset();
    sentences = 0;
    fake_line("UP BUTTON", false);
    fake_line("NIGHT", false);
    skv_gpio_defaults(&config);
    set(&config, "button", "UP BUTTON");
    set(&config, "toggle", "UP BUTTON");
    set(&config, "lamp_night", "NIGHT");
    set(&config, "lamp_bus", "NIGHT");
    skv_gpio *panel = skv_gpio_open(&config, say, NULL);
    assert_int_equal(sentences, 2);
    assert_string_equal(said[0], "gpio: toggle (UP BUTTON): this line is button already; goes on without it");
    assert_string_equal(said[1], "gpio: lamp_bus (NIGHT): this line is lamp_night already; goes on without it");
    assert_true(skv_gpio_has(panel, SKV_GPIO_BUTTON) && skv_gpio_has(panel, SKV_GPIO_LAMP_NIGHT));
    assert_false(skv_gpio_has(panel, SKV_GPIO_TOGGLE) || skv_gpio_has(panel, SKV_GPIO_LAMP_BUS));
    skv_gpio_close(panel);
    assert_int_equal(fake_open(), 0);
}

// CHIP:OFFSET is a number, gpiochipN or a path before the colon. Other names have colons too.
static void names_with_colons(void **state) {
    (void)state;
    static const char *const lines[][2] = {{"PMOD1:3", "PMOD1:3"},
                                           {"7:3", "/dev/gpiochip7:3"},
                                           {"gpiochip7:4", "/dev/gpiochip7:4"},
                                           {"/dev/x:5", "/dev/x:5"}};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        skv_gpio_config config;
        fake_reset();
        sentences = 0;
        fake_line(lines[i][1], false);
        skv_gpio_defaults(&config);
        set(&config, "button", lines[i][0]);
        skv_gpio *panel = skv_gpio_open(&config, say, NULL);
        if (sentences != 0 || fake_by_name(lines[i][1]) != (i == 0))
            fail_msg("button = %s: %s", lines[i][0], sentences ? said[0] : "taken the wrong way");
        skv_gpio_close(panel);
    }
}

static void lamps(void **state) {
    (void)state;
    skv_gpio *panel = whole_panel();
    assert_false(fake_level("NIGHT"));
    assert_true(fake_level("/dev/gpiochip1:7")); // active low: dark
    skv_gpio_lamp(panel, SKV_GPIO_LAMP_NIGHT, true);
    skv_gpio_lamp(panel, SKV_GPIO_LAMP_BUS, true);
    assert_true(fake_level("NIGHT"));
    assert_false(fake_level("/dev/gpiochip1:7"));
    skv_gpio_lamp(panel, SKV_GPIO_BUTTON, true); // no lamp
    fake_lose("NIGHT");
    skv_gpio_lamp(panel, SKV_GPIO_LAMP_NIGHT, false);
    assert_int_equal(sentences, 1);
    assert_string_equal(said[0], "gpio: lamp_night (NIGHT): lost; goes on without it");
    skv_gpio_close(panel);
    assert_true(fake_level("/dev/gpiochip1:7"));
    assert_int_equal(fake_open(), 0);
}

static void lines_pulled_while_in_use(void **state) {
    (void)state;
    skv_gpio *panel = whole_panel();
    skv_gpio_input input;
    fake_edge("PUSH", 980 * MS, false);
    fake_edge("A", 1000 * MS + MS / 2, true);
    fake_time(1001 * MS);
    skv_gpio_read(panel, &input); // waits for older ones
    assert_true(input.button);
    fake_lose("B");
    fake_lose("PUSH");
    fake_time(1002 * MS);
    skv_gpio_read(panel, &input);
    skv_gpio_read(panel, &input);
    assert_int_equal(sentences, 2); // once each
    assert_string_equal(said[0], "gpio: encoder (A, B): lost; goes on without it");
    assert_string_equal(said[1], "gpio: button (PUSH): lost; goes on without it");
    assert_false(input.button); // not held down for ever
    struct pollfd waits = {.fd = skv_gpio_fd(panel), .events = POLLIN};
    assert_int_equal(poll(&waits, 1, 0), 0); // nothing that wakes it for ever
    fake_edge("/dev/gpiochip0:4", 1003 * MS, true);
    fake_time(1100 * MS);
    skv_gpio_read(panel, &input);
    assert_true(input.toggle);
    skv_gpio_close(panel);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(settings_are_checked),
        cmocka_unit_test(lines_that_are_not_there),
        cmocka_unit_test(half_an_encoder),
        cmocka_unit_test(edges_are_put_in_order),
        cmocka_unit_test(a_new_edge_waits),
        cmocka_unit_test(lost_edges_are_noticed),
        cmocka_unit_test(turned_while_it_is_checked),
        cmocka_unit_test(button_and_toggle),
        cmocka_unit_test(a_lost_last_edge),
        cmocka_unit_test(released_while_it_settles),
        cmocka_unit_test(a_line_that_never_rests),
        cmocka_unit_test(one_line_for_two_uses),
        cmocka_unit_test(names_with_colons),
        cmocka_unit_test(lamps),
        cmocka_unit_test(lines_pulled_while_in_use),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
