/// skyvert-sim replays a log on a fake bus.
#include "sim_rig.h"

// ---- replay

#define REPLAYED 2000

static sim_recording recording_of(sim_record *records) {
    for (int i = 0; i < REPLAYED; i++) {
        records[i] = (sim_record){.after_ns = i * 2 * MS, .frame = {.id = (uint32_t)(i % 0x700), .length = 4}};
        records[i].frame.data[0] = (uint8_t)(i >> 8);
        records[i].frame.data[1] = (uint8_t)i;
    }
    return (sim_recording){.records = records, .count = REPLAYED};
}

/// Every frame arrives once and in order, whatever the bus does.
static void check_replay(const rig *r) {
    for (int i = 0; i < r->n_kept; i++)
        if (r->kept[i].frame.data[0] != (uint8_t)(i % REPLAYED >> 8) ||
            r->kept[i].frame.data[1] != (uint8_t)(i % REPLAYED))
            fail_msg("frame %d of the replay is number %d", i,
                     r->kept[i].frame.data[0] << 8 | r->kept[i].frame.data[1]);
}

static rig *new_player(sim_recording *recording, double speed) {
    rig *const r = new_rig(speed);
    r->plays = true;
    r->options.duration_s = 1e6;
    assert_int_equal(sim_bus_begin(&r->bus, 0), SKV_CAN_OK);
    r->player = (sim_player){.options = &r->options, .recording = recording, .bus = &r->bus};
    sim_player_begin(&r->player, 0);
    return r;
}

/// As the kernel does it: at bus-off a frame is taken, and thrown away.
static const skv_can_ops *under;
static skv_can_status send_like_the_kernel(skv_can_bus *bus, const skv_can_frame *frame) {
    skv_can_state now;
    (void)under->state(bus, &now);
    return now.controller == SKV_CAN_BUS_OFF ? SKV_CAN_OK : under->send(bus, frame);
}

/// Most frames within a millisecond.
static int longest_burst(const rig *r) {
    int most = 0;
    for (int i = 0, n = 0; i < r->n_kept; i++) {
        n = i > 0 && r->kept[i].time_ns - r->kept[i - 1].time_ns < MS ? n + 1 : 1;
        most = n > most ? n : most;
    }
    return most;
}

static void test_replay(void **state) {
    (void)state;
    static sim_record records[REPLAYED];
    sim_recording recording = recording_of(records);
    rig *r = new_player(&recording, 1.0);
    run_for(r, 10.0);
    assert_int_equal(r->n_kept, REPLAYED);
    check_replay(r);
    for (int i = 0; i < r->n_kept; i++)
        check_near("time ms", 1e-6 * (double)r->kept[i].time_ns, 2.0 * i, 1.01);
    assert_int_equal(r->player.heard, REPLAYED);
    free_rig(r);

    r = new_player(&recording, 1.0); // down for 2 s, and bus-off
    skv_can_ops ops = *r->bus.bus->ops;
    under = r->bus.bus->ops;
    ops.send = send_like_the_kernel;
    r->bus.bus->ops = &ops;
    run_for(r, 1.0);
    skv_can_fake_set_up(r->net, 0);
    run_for(r, 2.0);
    skv_can_fake_set_up(r->net, 1);
    run_for(r, 1.0);
    skv_can_fake_bus_off(r->net, 300);
    run_for(r, 10.0);
    assert_int_equal(r->n_kept, REPLAYED);
    check_replay(r);
    check_at_most("frames in a millisecond", longest_burst(r), 25); // 50 ms of frames wait at most: then all is moved
    free_rig(r);

    r = new_player(&recording, 1.0); // 3 of 4 sends refused; down for 2 s; bus-off
    skv_can_fake_set_faults(r->net, &(skv_can_faults){.queue_full = 0.5, .again = 0.5, .seed = 3});
    run_for(r, 2.0);
    skv_can_fake_set_up(r->net, 0);
    run_for(r, 2.0);
    skv_can_fake_set_up(r->net, 1);
    run_for(r, 2.0);
    skv_can_fake_bus_off(r->net, 0);
    run_for(r, 60.0);
    assert_int_equal(r->n_kept, REPLAYED);
    check_replay(r);
    assert_true(r->bus.waits > REPLAYED);
    assert_int_equal(r->bus.recoveries, 2);
    free_rig(r);

    r = new_player(&recording, 4.0);
    r->options.loop = true;
    run_for(r, 3.0); // three laps of a second, and the first frame of the fourth
    assert_int_equal(r->n_kept, 3 * REPLAYED + 1);
    check_replay(r);
    free_rig(r);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_replay)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
