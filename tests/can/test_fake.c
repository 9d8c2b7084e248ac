// The fake bus, through the same interface as the kernel's: filters, faults, cyclic sending, the cable, bus-off.
#include <errno.h>
#include <poll.h>
#include <string.h>

#include "check.h"
#include "port/canaerospace/skv_canaerospace.h"
#include "port/socketcan/skv_can_fake.h"
#include "port/socketcan/skv_socketcan.h"

#define MS 1000000ll

static const skv_can_options everything = {.receive_all = 1, .receive_errors = 1};

static int readable(int fd) {
    struct pollfd p = {.fd = fd, .events = POLLIN};
    return poll(&p, 1, 0) == 1;
}

static skv_can_frame frame_of(uint32_t id, uint8_t code) {
    return (skv_can_frame){id, 8, 0, {1, 2, 0, code, 0, 0, 0, 0}};
}

static skv_can_bus *open_fake(skv_can_fake_net *net, const skv_can_options *options) {
    skv_can_bus *bus = NULL;
    assert_int_equal(skv_can_fake_open(&bus, net, options), SKV_CAN_OK);
    return bus;
}

static void test_filters(void **state) {
    (void)state;
    skv_can_fake_net *net = skv_can_fake_new();
    const skv_can_filter filters[] = {{1036, 0x7FF, 0}, {1800, 0x7F0, 0}};
    const skv_can_options filtered = {.filters = filters, .n_filters = 2};
    skv_can_bus *a = open_fake(net, NULL), *b = open_fake(net, &filtered), *c = open_fake(net, &everything);
    const uint32_t ids[] = {1036, 1037, 1800, 1807, 1808};
    skv_can_received got[8];
    for (int i = 0; i < 5; i++) {
        const skv_can_frame f = frame_of(ids[i], 0), remote = {ids[i], 0, SKV_CAN_RTR, {0}};
        assert_int_equal(skv_can_send(a, &f), SKV_CAN_OK);
        assert_int_equal(skv_can_send(a, &remote), SKV_CAN_OK);
    }
    assert_true(readable(skv_can_fd(b)));
    assert_int_equal(skv_can_receive(b, got, 8), 3); // 1800 and 1807 differ in open bits, 1808 in another
    assert_true(!readable(skv_can_fd(b)));
    assert_int_equal(skv_can_receive(b, got, 8), 0);
    assert_int_equal(skv_can_receive(c, got, 8), 8);
    assert_true(readable(skv_can_fd(c)));
    assert_int_equal(skv_can_receive(c, got, 8), 2);
    assert_int_equal(skv_can_receive(a, got, 8), 0); // send only
    assert_int_equal(skv_can_get_counts(a).sent, 10);
    assert_int_equal(skv_can_get_counts(c).received, 10);
    skv_can_close(a);
    skv_can_close(b);
    skv_can_close(c);
    skv_can_fake_free(net);
}

static void test_arguments(void **state) {
    (void)state;
    skv_can_fake_net *net = skv_can_fake_new();
    skv_can_bus *bus = open_fake(net, &everything), *none = NULL;
    skv_can_frame f = frame_of(0x800, 0);
    skv_can_received got;
    const skv_can_options no_filters = {.n_filters = 3};
    assert_int_equal(skv_can_send(bus, &f), SKV_CAN_BAD_ARGUMENT);
    f.flags = SKV_CAN_EXTENDED;
    assert_int_equal(skv_can_send(bus, &f), SKV_CAN_OK);
    f.length = 9;
    assert_int_equal(skv_can_send(bus, &f), SKV_CAN_BAD_ARGUMENT);
    f = (skv_can_frame){1, 0, SKV_CAN_ERROR, {0}};
    assert_int_equal(skv_can_send(bus, &f), SKV_CAN_BAD_ARGUMENT);
    assert_int_equal(skv_can_send(NULL, &f), SKV_CAN_BAD_ARGUMENT);
    assert_int_equal(skv_can_receive(bus, &got, 0), SKV_CAN_BAD_ARGUMENT);
    assert_int_equal(skv_can_fake_open(&none, net, &no_filters), SKV_CAN_BAD_ARGUMENT);
    const skv_can_cyclic bad[] = {{frame_of(1, 0), 999, -1},
                                  {frame_of(1, 0), 3600000001u, -1},
                                  {frame_of(1, 0), 1000, 8},
                                  {{1, 0, SKV_CAN_RTR, {0}}, 1000, -1}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        assert_int_equal(skv_can_cyclic_start(bus, &bad[i]), SKV_CAN_BAD_ARGUMENT);
    f = frame_of(7, 0);
    assert_int_equal(skv_can_cyclic_update(bus, &f), SKV_CAN_BAD_ARGUMENT);
    assert_int_equal(skv_can_cyclic_stop(bus, 7, 0), SKV_CAN_BAD_ARGUMENT);
    assert_int_equal(skv_can_restart(bus), SKV_CAN_BAD_ARGUMENT);
    for (int i = SKV_CAN_SYSTEM; i <= 0; i++)
        assert_true(skv_can_status_text((skv_can_status)i)[0] != '?');
    skv_can_close(bus);
    skv_can_close(NULL);
    skv_can_fake_free(net);
}

// 100 ms for 60 s: 600 frames, the code goes up by one whatever the updates; then a watch times out.
static void test_cyclic(void **state) {
    (void)state;
    skv_can_fake_net *net = skv_can_fake_new();
    skv_can_bus *a = open_fake(net, NULL), *b = open_fake(net, &everything);
    skv_can_cyclic cyclic = {frame_of(1036, 250), 100000, 3};
    skv_can_received got[4];
    uint32_t late[4];
    int frames = 0;
    assert_int_equal(skv_can_cyclic_start(a, &cyclic), SKV_CAN_OK);
    assert_int_equal(skv_can_watch(b, 1036, 300), SKV_CAN_OK);
    for (int64_t t = 0; t < 60000; t += 7) {
        skv_can_fake_advance(net, t * MS);
        if (t % 5 == 0) {
            cyclic.frame.data[7] = (uint8_t)t;
            assert_int_equal(skv_can_cyclic_update(a, &cyclic.frame), SKV_CAN_OK);
        }
        for (int n; (n = skv_can_receive(b, got, 4)) > 0;)
            for (int i = 0; i < n; i++, frames++) {
                assert_int_equal(got[i].frame.data[3], (250 + frames) & 255);
                assert_int_equal(got[i].time_ns, frames * 100 * MS);
            }
    }
    assert_int_equal(frames, 600);
    assert_int_equal(skv_can_timeouts(b, late, 4), 0);
    assert_int_equal(skv_can_cyclic_stop(a, 1036, 0), SKV_CAN_OK);
    skv_can_fake_advance(net, 60190 * MS);
    assert_int_equal(skv_can_timeouts(b, late, 4), 0);
    skv_can_fake_advance(net, 60300 * MS);
    assert_true(readable(skv_can_timeout_fd(b)));
    assert_int_equal(skv_can_timeouts(b, late, 4), 1);
    assert_int_equal(late[0], 1036);
    assert_int_equal(skv_can_timeouts(b, late, 4), 0);
    skv_can_close(a);
    skv_can_close(b);
    skv_can_fake_free(net);
}

static void test_cable_and_bus_off(void **state) {
    (void)state;
    skv_can_fake_net *net = skv_can_fake_new();
    skv_can_bus *a = open_fake(net, NULL), *b = open_fake(net, &everything);
    const skv_can_frame f = frame_of(1036, 0);
    skv_can_received got[4];
    skv_can_state s;
    skv_can_fake_set_up(net, 0);
    assert_int_equal(skv_can_send(a, &f), SKV_CAN_DOWN);
    assert_int_equal(skv_can_errno(a), ENETDOWN);
    assert_true(readable(skv_can_fd(b)));
    assert_int_equal(skv_can_receive(b, got, 4), SKV_CAN_DOWN); // once
    assert_int_equal(skv_can_receive(b, got, 4), 0);
    assert_true(readable(skv_can_event_fd(b)));
    assert_int_equal(skv_can_events(b), 1);
    assert_int_equal(skv_can_get_state(b, &s), SKV_CAN_OK);
    assert_true(s.present && !s.up);
    skv_can_fake_set_up(net, 1);
    assert_int_equal(skv_can_send(a, &f), SKV_CAN_OK);
    assert_int_equal(skv_can_receive(b, got, 4), 1);

    skv_can_fake_bus_off(net, 0);
    assert_int_equal(skv_can_receive(b, got, 4), 1);
    assert_int_equal(skv_can_error_says(&got[0].frame), SKV_CAN_SAYS_BUS_OFF);
    assert_int_equal(skv_can_get_state(b, &s), SKV_CAN_OK);
    assert_true(s.up && s.controller == SKV_CAN_BUS_OFF);
    assert_int_equal(skv_can_send(a, &f), SKV_CAN_QUEUE_FULL);
    assert_int_equal(skv_can_restart(a), SKV_CAN_OK);
    assert_int_equal(skv_can_receive(b, got, 4), 1);
    assert_int_equal(skv_can_error_says(&got[0].frame), SKV_CAN_SAYS_RESTARTED);
    assert_int_equal(skv_can_send(a, &f), SKV_CAN_OK);
    skv_can_fake_bus_off(net, 100); // restarts by itself
    assert_int_equal(skv_can_restart(a), SKV_CAN_BAD_ARGUMENT);
    skv_can_fake_advance(net, 100 * MS);
    assert_int_equal(skv_can_send(a, &f), SKV_CAN_OK);
    assert_int_equal(skv_can_receive(b, got, 4), 4);
    const skv_can_counts counts = skv_can_get_counts(b);
    assert_int_equal(counts.error_frames, 4);
    assert_int_equal(counts.down, 1);
    skv_can_close(a);
    skv_can_close(b);
    skv_can_fake_free(net);
}

// What an error frame of the kernel says: linux/can/error.h, by hand.
static void test_errors(void **state) {
    (void)state;
    const struct {
        skv_can_frame frame;
        unsigned says;
    } cases[] = {
        {{0x40, 8, SKV_CAN_ERROR, {0}}, SKV_CAN_SAYS_BUS_OFF},
        {{0x100, 8, SKV_CAN_ERROR, {0}}, SKV_CAN_SAYS_RESTARTED},
        {{0x20, 8, SKV_CAN_ERROR, {0}}, SKV_CAN_SAYS_NO_ACK},
        {{0x04, 8, SKV_CAN_ERROR, {0, 0x04}}, SKV_CAN_SAYS_WARNING},
        {{0x04, 8, SKV_CAN_ERROR, {0, 0x20}}, SKV_CAN_SAYS_PASSIVE},
        {{0x04, 8, SKV_CAN_ERROR, {0, 0x01}}, SKV_CAN_SAYS_OVERFLOW},
        {{0x04, 8, SKV_CAN_ERROR, {0, 0x40}}, SKV_CAN_SAYS_ACTIVE},
        {{0x08, 8, SKV_CAN_ERROR, {0}}, SKV_CAN_SAYS_BUS_ERROR},
        {{0x02, 8, SKV_CAN_ERROR, {0}}, SKV_CAN_SAYS_ARBITRATION},
        {{0x01, 8, SKV_CAN_ERROR, {0}}, SKV_CAN_SAYS_TX_TIMEOUT},
        {{0x60, 8, SKV_CAN_ERROR, {0}}, SKV_CAN_SAYS_BUS_OFF | SKV_CAN_SAYS_NO_ACK},
        {{0x40, 8, 0, {0}}, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        assert_int_equal(skv_can_error_says(&cases[i].frame), cases[i].says);
}

// A noisy bus: what the receiver counts is what the bus did, and every value it shows was sent.
static void test_faults(void **state) {
    (void)state;
    static skv_cas_receiver r;
    skv_can_fake_net *net = skv_can_fake_new();
    skv_can_bus *a = open_fake(net, NULL), *b = open_fake(net, &everything);
    const skv_can_faults faults = {
        .drop = 0.05, .duplicate = 0.05, .reorder = 0.03, .queue_full = 0.02, .again = 0.02, .seed = 7};
    skv_cas_sender sender = {.node = 17};
    skv_can_received got[32];
    uint32_t sent = 0;
    skv_cas_clear(&r);
    skv_can_fake_set_faults(net, &faults);
    for (int64_t t = 0; t < 4000; t++) {
        skv_can_frame f[2];
        skv_can_fake_advance(net, 100 * t * MS);
        assert_int_equal(skv_cas_encode(&sender, SKV_CAS_ROLL, 0, (double)(t % 180), f), 1);
        skv_can_status status = skv_can_send(a, &f[0]);
        assert_true(status == SKV_CAN_OK || status == SKV_CAN_QUEUE_FULL || status == SKV_CAN_AGAIN);
        sent += status == SKV_CAN_OK;
        const int n = skv_can_receive(b, got, 32);
        for (int i = 0; i < n; i++) {
            const double held = r.slot[SKV_CAS_ROLL].value;
            const skv_cas_count c = skv_cas_receive(&r, &got[i].frame, 100 * t * MS);
            double v = 0.0;
            (void)skv_cas_value(&r, SKV_CAS_ROLL, &v);
            if (c == SKV_CAS_ACCEPTED) // t or, held back, an earlier one
                assert_true(v <= 179.0 && v >= 0.0);
            else
                check_near("value behind a refused frame", v, held, 0.0);
        }
    }
    const skv_can_counts counts = skv_can_get_counts(a);
    assert_int_equal(counts.sent, sent);
    assert_int_equal(counts.queue_full + counts.again + counts.sent, 4000);
    const uint32_t missing = r.total[SKV_CAS_MISSING],
                   lost = 4000 - (uint32_t)skv_can_get_counts(b).received + r.total[SKV_CAS_DUPLICATE];
    print_message("figure: fake bus: %u of 4000 frames not sent or lost, %u told by message codes, %u duplicates, %u "
                  "out of order\n",
                  (unsigned)lost, (unsigned)missing, (unsigned)r.total[SKV_CAS_DUPLICATE],
                  (unsigned)r.total[SKV_CAS_REORDERED]);
    // A frame that comes late was first counted as missing. 5: frames lost at the end, or still held back there.
    assert_true(r.total[SKV_CAS_DUPLICATE] > 100 && r.total[SKV_CAS_REORDERED] > 60);
    assert_true(missing + 5 >= lost && missing <= lost + r.total[SKV_CAS_REORDERED] + 5);
    skv_can_close(a);
    skv_can_close(b);
    skv_can_fake_free(net);
}

// Here, or on any machine: without CAN the kernel's bus says so.
static void test_kernel(void **state) {
    (void)state;
    skv_can_bus *bus = NULL;
    int error = 0;
    const skv_can_status available = skv_socketcan_available();
    const skv_can_status opened = skv_socketcan_open(&bus, "nosuchcan0", NULL, &error);
    if (available == SKV_CAN_OK) {
        assert_int_equal(opened, SKV_CAN_NO_INTERFACE);
    } else {
        print_message("note: this kernel: %s\n", skv_can_status_text(available));
        assert_int_equal(opened, available);
        assert_true(error == EAFNOSUPPORT || error == EPROTONOSUPPORT || error == EPERM);
    }
    assert_true(bus == NULL);
    assert_int_equal(skv_socketcan_open(&bus, "a name that is too long", NULL, NULL), SKV_CAN_BAD_ARGUMENT);
    assert_int_equal(skv_socketcan_open(NULL, "can0", NULL, NULL), SKV_CAN_BAD_ARGUMENT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_filters), cmocka_unit_test(test_arguments),
        cmocka_unit_test(test_cyclic),  cmocka_unit_test(test_cable_and_bus_off),
        cmocka_unit_test(test_errors),  cmocka_unit_test(test_faults),
        cmocka_unit_test(test_kernel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
