// Encoder, debounce and lamps, without any line.
#include "check.h"
#include "port/gpiod/skv_debounce.h"
#include "port/gpiod/skv_lamp.h"
#include "port/gpiod/skv_quadrature.h"

#include <math.h>

#define MS INT64_C(1000000)

// The contacts of an encoder by its angle, from their definition: two square waves a quarter period apart.
static bool contact_a(int quarter) {
    return (((quarter % 4) + 4) % 4) >= 2;
}
static bool contact_b(int quarter) {
    return contact_a(quarter + 1);
}

// A walk that turns both ways: the position is the angle, nothing is invalid.
static void encoder_follows_the_angle(void **state) {
    (void)state;
    skv_quadrature encoder;
    uint32_t seed = 7;
    int angle = 0;
    skv_quadrature_start(&encoder, contact_a(0), contact_b(0));
    for (int i = 0; i < 10000; i++) {
        seed = seed * 1664525u + 1013904223u;
        const int next = angle + ((seed >> 20) % 3 == 0 ? -1 : 1);
        if (contact_a(next) != contact_a(angle))
            skv_quadrature_edge(&encoder, true, contact_a(next));
        else
            skv_quadrature_edge(&encoder, false, contact_b(next));
        angle = next;
        assert_int_equal(encoder.position, angle);
    }
    assert_int_equal(encoder.invalid, 0);
}

// Every pair of states: the angle between them, where it is one quarter; two quarters have no direction.
static void encoder_table(void **state) {
    (void)state;
    for (int before = 0; before < 4; before++)
        for (int turn = -1; turn <= 2; turn++) {
            skv_quadrature encoder;
            skv_quadrature_start(&encoder, contact_a(before), contact_b(before));
            skv_quadrature_levels(&encoder, contact_a(before + turn), contact_b(before + turn));
            const int want = turn == 2 ? 0 : turn;
            if (encoder.position != want || encoder.invalid != (turn == 2))
                fail_msg("from %d by %d: got step %d, invalid %u", before, turn, (int)encoder.position,
                         (unsigned)encoder.invalid);
        }
}

static void encoder_counts_lost_edges(void **state) {
    (void)state;
    skv_quadrature encoder;
    skv_quadrature_start(&encoder, false, false);
    skv_quadrature_edge(&encoder, false, true); // 1
    skv_quadrature_edge(&encoder, false, true); // B is 1 already
    assert_int_equal(encoder.position, 1);
    assert_int_equal(encoder.invalid, 1);
    skv_quadrature_edge(&encoder, true, true); // goes on from where it is
    assert_int_equal(encoder.position, 2);
    // A contact that bounces on one edge: there and back, no net step, nothing invalid.
    for (int i = 0; i < 7; i++)
        skv_quadrature_edge(&encoder, true, i % 2 != 0);
    assert_int_equal(encoder.position, 1);
    assert_int_equal(encoder.invalid, 1);
}

static void encoder_position_wraps(void **state) {
    (void)state;
    skv_quadrature encoder;
    skv_quadrature_start(&encoder, false, false);
    encoder.position = INT32_MAX;
    skv_quadrature_levels(&encoder, false, true);
    assert_int_equal(encoder.position, INT32_MIN);
}

static void clicks_are_whole(void **state) {
    (void)state;
    int32_t steps = 0, clicks = 0;
    for (int i = 0; i < 22; i++) { // 22 quarters forwards: 5 clicks and 2 quarters
        steps++;
        clicks += skv_quadrature_clicks(&steps, 4);
    }
    assert_int_equal(clicks, 5);
    assert_int_equal(steps, 2);
    for (int i = 0; i < 100; i++) { // trembling by a quarter: no click
        steps += i % 2 ? -1 : 1;
        assert_int_equal(skv_quadrature_clicks(&steps, 4), 0);
    }
    steps -= 7;
    assert_int_equal(skv_quadrature_clicks(&steps, 4), -1);
    assert_int_equal(steps, -1);
}

// Edges at these times (ms), levels alternate from 1. What counts is given by hand.
static void debounce_takes_steady_levels(void **state) {
    (void)state;
    skv_debounce button;
    skv_debounce_start(&button, false, 10 * MS);
    const int press[] = {0, 1, 3, 4, 6}; // ends at 1
    for (int i = 0; i < 5; i++)
        assert_false(skv_debounce_edge(&button, press[i] * MS, i % 2 == 0));
    assert_true(skv_debounce_due(&button) == 16 * MS);
    assert_false(skv_debounce_time(&button, 16 * MS - 1));
    assert_true(skv_debounce_time(&button, 16 * MS));
    assert_true(button.level);
    assert_int_equal(button.bounces, 4);
    assert_true(skv_debounce_due(&button) == INT64_MAX);
    assert_false(skv_debounce_time(&button, 100 * MS));
}

static void debounce_ignores_spikes(void **state) {
    (void)state;
    skv_debounce button;
    skv_debounce_start(&button, true, 10 * MS);
    assert_false(skv_debounce_edge(&button, 0, false));
    assert_false(skv_debounce_edge(&button, 9 * MS, true));
    assert_false(skv_debounce_time(&button, 30 * MS));
    assert_true(button.level);
    assert_int_equal(button.bounces, 2);
}

// The program was late: all edges come at once, and their times still tell two presses apart.
static void debounce_late_reader(void **state) {
    (void)state;
    skv_debounce button;
    int presses = 0;
    skv_debounce_start(&button, false, 10 * MS);
    const int at[] = {0, 50, 100, 150}; // down, up, down, up
    for (int i = 0; i < 4; i++)
        if (skv_debounce_edge(&button, at[i] * MS, i % 2 == 0))
            presses += button.level;
    if (skv_debounce_time(&button, 500 * MS))
        presses += button.level;
    assert_int_equal(presses, 2);
    assert_false(button.level);
    assert_int_equal(button.bounces, 0);
}

static void debounce_of_nothing(void **state) {
    (void)state;
    skv_debounce button;
    skv_debounce_start(&button, false, 0);
    skv_debounce_edge(&button, 5, true);
    assert_true(skv_debounce_time(&button, 5));
    assert_true(button.level);
}

static void lamp_has_hysteresis(void **state) {
    (void)state;
    bool lit = false;
    int switched = 0;
    for (int i = 0; i <= 400; i++) { // the sun sets from 2 to -2 deg, trembling by .1 deg
        const float elevation = 2.f - .01f * (float)i + (i % 2 ? .05f : -.05f);
        const bool now = skv_lamp_below(lit, elevation, -.833f, .5f);
        switched += now != lit;
        lit = now;
    }
    assert_true(lit);
    assert_int_equal(switched, 1);
    assert_true(skv_lamp_below(true, -.34f, -.833f, .5f));
    assert_false(skv_lamp_below(true, -.33f, -.833f, .5f));
    assert_false(skv_lamp_below(false, -.833f, -.833f, .5f));
    assert_true(skv_lamp_below(true, NAN, -.833f, .5f));
    assert_false(skv_lamp_below(false, NAN, -.833f, .5f));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(encoder_follows_the_angle), cmocka_unit_test(encoder_table),
        cmocka_unit_test(encoder_counts_lost_edges), cmocka_unit_test(encoder_position_wraps),
        cmocka_unit_test(clicks_are_whole),          cmocka_unit_test(debounce_takes_steady_levels),
        cmocka_unit_test(debounce_ignores_spikes),   cmocka_unit_test(debounce_late_reader),
        cmocka_unit_test(debounce_of_nothing),       cmocka_unit_test(lamp_has_hysteresis),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
