// What a cockpit does with what its bus does, on the fake one: tools/cockpit/cockpit_frame.c, cockpit_bus.c. Nothing
// depends on how fast the machine is.
#define _DEFAULT_SOURCE
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "check.h"
#include "tools/cockpit/cockpit_loop.h"

static char shared[40];

static cockpit *open_cockpit(void) {
    char *argv[] = {"skyvert-cockpit", "--fake", "--no-terminal", "--vertices", "64", "--shm", shared, NULL};
    cockpit *const c = calloc(1, sizeof *c);
    int status = 0;
    assert_true(c != NULL);
    assert_int_equal(cockpit_options_read(&c->options, 7, argv, &status), 0);
    assert_int_equal(cockpit_open(c), 0);
    return c;
}

static void close_cockpit(cockpit *c) {
    cockpit_close(c);
    free(c);
}

static skv_can_bus *listener(const cockpit *c) {
    const skv_can_options all = {.receive_all = 1};
    skv_can_bus *bus = NULL;
    assert_int_equal(skv_can_fake_open(&bus, c->bus.net, &all), SKV_CAN_OK);
    return bus;
}

/// Replies that have come; the last one's message code.
static int replies(skv_can_bus *bus, int *code) {
    skv_can_received r;
    skv_cas_identity who;
    int n = 0;
    while (skv_can_receive(bus, &r, 1) == 1)
        if (skv_cas_identified(&r.frame, &who)) {
            assert_int_equal(who.node, 20);
            *code = r.frame.data[3];
            n++;
        }
    return n;
}

static void ask(cockpit *c, uint8_t code) {
    skv_can_frame request;
    assert_int_equal(skv_cas_identification_request(&request, 20, code), SKV_OK);
    assert_int_equal(skv_can_send(c->bus.sender, &request), SKV_CAN_OK);
}

// A full queue puts the answer off to the next tick that can; behind 100 ms nobody wants it any more.
static void identification(void **state) {
    (void)state;
    const skv_can_faults full = {.queue_full = 1};
    cockpit *const c = open_cockpit();
    skv_can_bus *const bus = listener(c);
    int code = -1;
    ask(c, 5);
    cockpit_receive(c);
    assert_true(replies(bus, &code) == 1 && code == 5);
    ask(c, 6);
    skv_can_fake_set_faults(c->bus.net, &full);
    const int64_t asked_ns = cockpit_mono_ns();
    cockpit_receive(c);
    assert_true(c->reply_until_ns >= asked_ns + 100000000 && c->reply_until_ns <= cockpit_mono_ns() + 100000000);
    c->reply_until_ns += 3600 * INT64_C(1000000000);
    cockpit_frame(c);
    assert_int_equal(replies(bus, &code), 0);
    skv_can_fake_set_faults(c->bus.net, NULL);
    cockpit_frame(c);
    assert_true(replies(bus, &code) == 1 && code == 6);
    cockpit_frame(c);
    assert_int_equal(replies(bus, &code), 0);
    ask(c, 7);
    skv_can_fake_set_faults(c->bus.net, &full);
    cockpit_receive(c);
    c->reply_until_ns = cockpit_mono_ns() - 1;
    skv_can_fake_set_faults(c->bus.net, NULL);
    cockpit_frame(c);
    assert_int_equal(replies(bus, &code), 0);
    skv_can_close(bus);
    close_cockpit(c);
}

static void say(cockpit *c, skv_cas_sender *sender, skv_cas_index index, double value) {
    skv_can_frame frame[2];
    assert_int_equal(skv_cas_encode(sender, index, 0, value, frame), 1);
    assert_int_equal(skv_can_send(c->bus.sender, &frame[0]), SKV_CAN_OK);
}

// Published frames tell when the newest CAN frame in them came, whether or not it is newer than the frame before's.
static void input_time(void **state) {
    (void)state;
    cockpit *const c = open_cockpit();
    skv_cas_sender sender = {.node = 1};
    skv_vertices_moment m[2];
    skv_vertex vertex[64];
    const int fd = shm_open(shared, O_RDONLY, 0);
    const void *const map = mmap(NULL, c->share.bytes, PROT_READ, MAP_SHARED, fd, 0);
    close(fd);
    assert_true(map != MAP_FAILED && skv_vertices_check(map, c->share.bytes) == NULL);
    const int64_t from = cockpit_mono_ns();
    skv_can_fake_advance(c->bus.net, cockpit_bus_now(&c->bus));
    say(c, &sender, SKV_CAS_SUN_AZIMUTH, 120);
    say(c, &sender, SKV_CAS_SUN_ELEVATION, 30);
    const int64_t until = cockpit_mono_ns();
    cockpit_receive(c);
    for (int i = 0; i < 2; i++) {
        cockpit_frame(c);
        assert_true(skv_vertices_read(map, &m[i], vertex, 64) > 0);
    }
    assert_true(m[1].frame == m[0].frame + 1 && m[0].input_ns == m[1].input_ns);
    assert_true(m[1].input_ns >= from - 1000 && m[1].input_ns <= until); // doubles of ns
    check_near("sun", (double)m[1].sun_elevation_deg, 30, 1e-5);
    assert_int_equal(m[1].flags & (SKV_VERTICES_SUN_BY_BUS | SKV_VERTICES_BUS_FAULT), SKV_VERTICES_SUN_BY_BUS);
    munmap((void *)(uintptr_t)map, c->share.bytes);
    close_cockpit(c);
}

/// A frame that seems to have taken this long, so long after the last change.
static void frame_of(cockpit *c, double ms, int64_t since_s) {
    c->stats.evaluate_ms = ms;
    c->level_ns = cockpit_mono_ns() - since_s * INT64_C(1000000000);
    c->tick = 0; // is shown at every level
    cockpit_frame(c);
}

// Too dear: a cheaper way at once; cheap for ten seconds: the dearer one again, and where that was too much, not so
// soon.
static void levels(void **state) {
    (void)state;
    cockpit *const c = open_cockpit();
    skv_cas_sender sender = {.node = 1};
    say(c, &sender, SKV_CAS_SUN_AZIMUTH, 120);
    say(c, &sender, SKV_CAS_SUN_ELEVATION, 30);
    cockpit_receive(c);
    for (int level = 1; level <= 6; level++) {
        frame_of(c, 1e6, 1);
        assert_int_equal(c->sky.level, level < 4 ? level : 4);
    }
    frame_of(c, 1e-3, 9);
    assert_int_equal(c->sky.level, 4);
    frame_of(c, 1e-3, 11);
    assert_int_equal(c->sky.level, 3);
    frame_of(c, 1e6, 1);
    assert_int_equal(c->sky.level, 4);
    frame_of(c, 1e-3, 11);
    assert_int_equal(c->sky.level, 4);
    frame_of(c, 1e-3, 21);
    assert_int_equal(c->sky.level, 3);
    close_cockpit(c);
}

static skv_can_status denied(skv_can_bus *bus) {
    (void)bus;
    return SKV_CAN_DENIED;
}

static skv_can_status not_there(skv_can_bus *bus, skv_can_state *state) {
    (void)bus;
    *state = (skv_can_state){0};
    return SKV_CAN_OK;
}

static void check_words(cockpit *c, const char *want, bool fault) {
    char text[64];
    (void)cockpit_bus_check(&c->bus);
    cockpit_receive(c);
    cockpit_frame(c);
    const char *const words = cockpit_bus_words(&c->bus, text, sizeof text);
    if (strcmp(words, want) != 0 || c->panel.bus != fault)
        fail_msg("got '%s', lamp %d, want '%s', lamp %d", words, c->panel.bus, want, fault);
}

// What is said of the bus, and its lamp.
static void words_and_lamp(void **state) {
    (void)state;
    cockpit *const c = open_cockpit();
    c->bus.source = COCKPIT_CAN;                     // as if it were
    c->stats.start_ns += 3600 * INT64_C(1000000000); // else silence for 3 s is a fault, too
    check_words(c, "up, 500 kbit/s", false);
    skv_can_fake_set_up(c->bus.net, 0);
    check_words(c, "down", true);
    skv_can_fake_set_up(c->bus.net, 1);
    check_words(c, "up, 500 kbit/s", false);
    skv_can_fake_bus_off(c->bus.net, 60000);
    check_words(c, "up, 500 kbit/s, bus-off", true);
    skv_can_ops ops = *c->bus.bus->ops;
    ops.restart = denied;
    c->bus.bus->ops = &ops;
    skv_can_fake_bus_off(c->bus.net, 0);
    check_words(c, "up, 500 kbit/s, bus-off: no right to restart it", true);
    const uint64_t received = cockpit_bus_counts(&c->bus).received;
    ops.state = not_there;
    check_words(c, "the interface is gone", true);
    assert_true(received > 0 && cockpit_bus_counts(&c->bus).received == received);
    assert_true(cockpit_bus_fd(&c->bus) == -1 && !cockpit_bus_send(&c->bus, &(skv_can_frame){0}));
    close_cockpit(c);
}

int main(void) {
    snprintf(shared, sizeof shared, "/skyvert-loop-%d", (int)getpid());
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(identification),
        cmocka_unit_test(input_time),
        cmocka_unit_test(words_and_lamp),
        cmocka_unit_test(levels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
