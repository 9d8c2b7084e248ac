/// skyvert-sim on a fake bus: what arrives, when, and what happens when the bus does not work.
#include "sim_rig.h"
#include "tools/cockpit/sim_wire.c" // white box: the check sequence

/// The fake bus's own, under one that a test puts in its place.
static const skv_can_ops *under;

// ---- on the wire

static void test_wire(void **state) {
    (void)state;
    wire w = {.last = -1};
    for (const char *c = "123456789"; *c; c++)
        put(&w, (uint32_t)*c, 8);
    assert_int_equal(w.crc, 0x059E); // the published check value of CRC-15/CAN
    const skv_can_frame zeros = {.id = 0}, full = {.id = 0x40C, .length = 8},
                        wide = {.length = 8, .flags = SKV_CAN_EXTENDED};
    const skv_can_frame error = {.flags = SKV_CAN_ERROR};
    assert_int_equal(sim_wire_bits(&zeros), 34 + 34 / 5 + 13); // 34 zeros in a row
    assert_int_equal(skv_cas_frame_bits(&full), 135);
    assert_int_equal(skv_cas_frame_bits(&wide), 160);
    assert_int_equal(sim_wire_bits(&error), 0);
    unsigned seed = 1;
    int most = 0, least = 999;
    for (int i = 0; i < 20000; i++) {
        skv_can_frame f = {.id = (seed = seed * 1664525u + 1013904223u) >> 21, .length = 8};
        for (int k = 0; k < 8; k++)
            f.data[k] = (uint8_t)((seed = seed * 1664525u + 1013904223u) >> 24);
        const int bits = sim_wire_bits(&f);
        most = bits > most ? bits : most;
        least = bits < least ? bits : least;
    }
    if (least < 111 || most > 135)
        fail_msg("random frames take %d to %d bits, want within 111 to 135", least, most);
}

static void test_load(void **state) {
    (void)state;
    rig *const r = new_rig(1.0);
    sim_slot slots[SKV_CAS_MESSAGES];
    r->flight.knows_ellipsoid = true;
    const int n = sim_flight_slots(&r->flight, 0.0, slots);
    int fast = 0;
    for (int i = 0; i < n; i++) {
        fast += slots[i].period_ns == 100 * MS;
        for (int k = 0; k < i; k++) {
            assert_true(skv_cas_table[slots[k].index].id < skv_cas_table[slots[i].index].id);
            const int64_t period = slots[i].period_ns < slots[k].period_ns ? slots[i].period_ns : slots[k].period_ns;
            const int64_t apart = llabs(slots[i].phase_ns - slots[k].phase_ns) % period;
            assert_true(apart >= 2 * MS && apart <= period - 2 * MS);
        }
    }
    const double want = (10.0 * fast + (n - fast)) * 135.0 / 125000.0; // frames a second, longest frames, 125 kbit/s
    check_near("load at 125 kbit/s", sim_slots_load(slots, n, 125000.0), want, 1e-12);
    check_at_most("load at 125 kbit/s", want, 0.8);
    print_message("figure: skyvert-sim: %d messages, %d frames/s, at most %.1f %% of 125 kbit/s, %.1f %% of 500, %.1f "
                  "%% of 1000\n",
                  n, 10 * fast + n - fast, 100 * want, 25 * want, 12.5 * want);
    free_rig(r);
}

// ---- streaming

static void test_stream(void **state) {
    (void)state;
    rig *const r = new_rig(1.0);
    int64_t last[2048] = {0};
    begin_stream(r);
    run_for(r, 30.0);
    assert_true(check_latitudes(r, 0, false) >= 299);
    for (int i = 0; i < r->n_kept; i++) {
        const skv_can_frame *f = &r->kept[i].frame;
        const int index = skv_cas_find(f->id);
        const double at_s = 1e-9 * (double)(r->kept[i].time_ns - r->stream.start_ns);
        assert_true(index >= 0 && f->data[0] == 7 && f->data[2] == 0);
        if (last[f->id])
            check_near("period ms", 1e-6 * (double)(r->kept[i].time_ns - last[f->id]), skv_cas_table[index].period_ms,
                       1e-9);
        last[f->id] = r->kept[i].time_ns;
        if (f->id == 332) // floats of 1300 m have steps of 1.2e-4
            check_near("altitude", (double)float_of(f), START_HEIGHT + HEIGHT_M_S * at_s, HEIGHT_M_S * 0.0011 + 1e-4);
        if (f->id == 314)
            check_near("altitude rate", (double)float_of(f), HEIGHT_M_S, 1e-4);
        if (f->id == 1040 || f->id == 321 || f->id == 1133)
            check_near("track", (double)float_of(f), 0.0, 1e-6);
        if (f->id == 1039) // .002 deg of a meridian at 47 deg: 111.17 km a degree there
            check_near("ground speed", (double)float_of(f), 222.34, 0.1);
        if (f->id == 1805)
            check_near("visibility", (double)float_of(f), 12000.0, 0.0);
        if (f->id == 324) // 6.5 K a km [USSA76]; geopotential height is 0.2 m less
            check_near("temperature", (double)float_of(f), 288.15 - 0.0065 * (START_HEIGHT + HEIGHT_M_S * at_s), 0.02);
        if (f->id == 1200) {
            const int want = 16 * 3600 + (int)at_s;
            assert_int_equal(f->data[4] * 3600 + f->data[5] * 60 + f->data[6], want);
        }
        if (f->id == 1206)
            assert_int_equal(f->data[4] * 1000000 + f->data[5] * 10000 + f->data[6] * 100 + f->data[7], 20032024);
    }
    assert_int_equal(r->stream.lost, 0);
    assert_int_equal(r->stream.sent, r->n_kept);
    char text[160];
    sim_stream_show(&r->stream, text, sizeof text);
    assert_true(strncmp(text, "2024-03-20T16:00:29Z  47.059", 28) == 0 ||
                strncmp(text, "2024-03-20T16:00:30Z  47.060", 28) == 0);
    free_rig(r);
}

/// Begun within a second, the UTC still goes out when the second changes.
static void test_utc(void **state) {
    (void)state;
    rig *const r = new_rig(1.0);
    int times = 0;
    r->options.start_s = 59.3;
    begin_stream(r);
    run_for(r, 10.0);
    for (int i = 0; i < r->n_kept; i++) {
        const skv_can_frame *f = &r->kept[i].frame;
        const double at_s = 59.3 + 1e-9 * (double)(r->kept[i].time_ns - r->stream.start_ns);
        if (f->id != 1200)
            continue;
        times++;
        check_near("UTC", 60.0 * f->data[5] + f->data[6], at_s, 0.012); // planned 8 ms behind it, steps of 1 ms
    }
    assert_int_equal(times, 10);
    free_rig(r);
}

/// Begun late, and a clockwork that falls behind: the UTC comes back to the second, and none is lost or said twice.
static uint32_t slow_us;
static skv_can_status start_late(skv_can_bus *bus, const skv_can_cyclic *cyclic) {
    skv_can_cyclic slow = *cyclic;
    slow.period_us += slow_us;
    return under->cyclic_start(bus, &slow);
}

static void test_utc_late(void **state) {
    (void)state;
    rig *const r = new_rig(1.0);
    int times = 0, second = -1;
    begin_stream(r);
    skv_can_ops ops = *r->bus.bus->ops;
    under = r->bus.bus->ops;
    ops.cyclic_start = start_late;
    slow_us = 2000;
    r->bus.bus->ops = &ops;
    r->wake_ns = 300 * MS; // held up
    run_for(r, 100.0);
    for (int i = 0; i < r->n_kept; i++) {
        const skv_can_frame *f = &r->kept[i].frame;
        const double at_s = 1e-9 * (double)(r->kept[i].time_ns - r->stream.start_ns);
        if (f->id != 1200)
            continue;
        const int said = 60 * f->data[5] + f->data[6];
        if (times++ > 0 && said != second + 1)
            fail_msg("UTC: %d s after %d", said, second);
        second = said;
        if (times > 1) // 50 ms, a period more, and a step of this test
            check_near("UTC", said, at_s - 0.03, 0.035);
    }
    assert_true(times >= 99);
    assert_int_equal(r->stream.lost, 0);
    free_rig(r);
}

/// The program is held up for seconds while its UTC is being put right: no message code comes twice.
static void test_utc_held_up(void **state) {
    (void)state;
    rig *const r = new_rig(1.0);
    int code = -1;
    begin_stream(r);
    skv_can_ops ops = *r->bus.bus->ops;
    under = r->bus.bus->ops;
    ops.cyclic_start = start_late;
    slow_us = 60000;
    r->bus.bus->ops = &ops;
    for (int i = 0; i < 5; i++) {
        run_for(r, 2.3);
        for (int64_t until = r->now_ns + 3300 * MS; r->now_ns < until; r->now_ns += MS)
            skv_can_fake_advance(r->net, r->now_ns);
    }
    run_for(r, 2.0);
    for (int i = 0; i < r->n_kept; i++) {
        if (r->kept[i].frame.id != 1200)
            continue;
        if (code >= 0 && r->kept[i].frame.data[3] != (uint8_t)(code + 1))
            fail_msg("message code %d behind %d", r->kept[i].frame.data[3], code);
        code = r->kept[i].frame.data[3];
    }
    assert_true(code > 20);
    free_rig(r);
}

/// What no waiting helps against is said, once, and tried on.
static int refusals;
static skv_can_status refuse(skv_can_bus *bus, const skv_can_cyclic *cyclic) {
    return refusals-- > 0 ? SKV_CAN_DENIED : under->cyclic_start(bus, cyclic);
}

static void test_refused(void **state) {
    (void)state;
    rig *const r = new_rig(1.0);
    begin_stream(r);
    skv_can_ops ops = *r->bus.bus->ops;
    under = r->bus.bus->ops;
    ops.cyclic_start = refuse;
    r->bus.bus->ops = &ops;
    refusals = 500;
    run_for(r, 0.1);
    assert_true(r->bus.refused);
    run_for(r, 5.0);
    assert_true(check_latitudes(r, 0, false) > 30);
    free_rig(r);
}

/// The clock is set an hour on, then two back: nothing on the bus changes.
static void test_clock_set(void **state) {
    (void)state;
    rig *const r = new_rig(1.0);
    begin_stream(r);
    run_for(r, 3.0);
    r->jump_ns = 3600 * SECOND;
    run_for(r, 3.0);
    r->jump_ns = -3600 * SECOND;
    run_for(r, 3.0);
    assert_true(check_latitudes(r, 0, false) >= 89);
    assert_int_equal(r->stream.lost, 0);
    free_rig(r);
}

static void test_cable(void **state) {
    (void)state;
    rig *const r = new_rig(1.0);
    begin_stream(r);
    run_for(r, 5.0);
    skv_can_fake_set_up(r->net, 0);
    const int before = r->n_kept;
    run_for(r, 7.0);
    assert_int_equal(r->n_kept, before);
    assert_int_equal(r->bus.phase, SIM_BUS_DOWN);
    skv_can_fake_set_up(r->net, 1);
    run_for(r, 5.0);
    assert_true(check_latitudes(r, before, false) >= 49); // the first one behind the gap is of now, too
    assert_int_equal(r->bus.phase, SIM_BUS_WORKS);
    assert_int_equal(r->bus.downs, 1);
    assert_int_equal(r->bus.recoveries, 1);
    const int frames_a_second = (before + 2) / 5;
    check_near("lost while it was down", (double)r->stream.lost, 7.0 * frames_a_second, 2.0);
    free_rig(r);
}

/// The interface is down when it begins, and when it ends: all that was due is counted.
static void test_down_from_the_start(void **state) {
    (void)state;
    rig *const r = new_rig(1.0);
    skv_can_fake_set_up(r->net, 0);
    begin_stream(r);
    assert_int_equal(r->bus.phase, SIM_BUS_DOWN);
    run_for(r, 5.0);
    assert_int_equal(r->n_kept, 0);
    skv_can_fake_set_up(r->net, 1);
    run_for(r, 10.0);
    assert_true(check_latitudes(r, 0, false) >= 99);
    skv_can_fake_set_up(r->net, 0);
    run_for(r, 3.0);
    sim_stream_end(&r->stream, r->now_ns);
    sim_stream_end(&r->stream, r->now_ns);
    const double due = (double)r->n_kept * 18.0 / 10.0; // as many a second as in the ten that it was up
    check_near("sent and lost", (double)(r->stream.sent + r->stream.lost), due, 20.0); // one of each message
    check_near("sent", (double)r->stream.sent, (double)r->n_kept, 0.0);
    free_rig(r);
}

static void check_bus_off(uint32_t restart_ms) {
    rig *const r = new_rig(1.0);
    begin_stream(r);
    run_for(r, 3.0);
    skv_can_fake_bus_off(r->net, restart_ms);
    const int before = r->n_kept;
    run_for(r, 5.0);
    assert_int_equal(r->bus.bus_offs, 1);
    assert_int_equal(r->bus.phase, SIM_BUS_WORKS);
    assert_int_equal(r->bus.recoveries, 1);
    assert_true(check_latitudes(r, before, false) >= 47);
    free_rig(r);
}

static void test_bus_off(void **state) {
    (void)state;
    check_bus_off(100); // the kernel restarts it
    check_bus_off(0);   // the program does
}

static skv_can_status not_there(skv_can_bus *bus, skv_can_state *state) {
    (void)bus;
    *state = (skv_can_state){0};
    return SKV_CAN_OK;
}

/// The adapter is unplugged: all is opened and started again, the codes go on.
static void test_gone(void **state) {
    (void)state;
    rig *const r = new_rig(1.0);
    begin_stream(r);
    run_for(r, 3.05);
    skv_can_ops ops = *r->bus.bus->ops;
    ops.state = not_there;
    r->bus.bus->ops = &ops;
    r->opens_fail = 4;
    sim_bus_look(&r->bus, r->now_ns);
    assert_true(r->bus.bus == NULL);
    run_for(r, 1.5);
    assert_int_equal(r->bus.phase, SIM_BUS_GONE);
    const int before = r->n_kept;
    run_for(r, 5.0);
    assert_int_equal(r->bus.phase, SIM_BUS_WORKS);
    assert_int_equal(r->bus.gone, 1);
    assert_int_equal(r->opens_fail, 0);
    assert_true(check_latitudes(r, 0, false) >= 30 + 39);
    assert_true(r->n_kept > before);
    free_rig(r);
}

static void test_time_lapse(void **state) {
    (void)state;
    rig *const r = new_rig(60.0);
    begin_stream(r);
    run_for(r, 20.0);
    assert_int_equal(r->wake_ns, 0); // over after 10 s
    assert_true(r->now_ns >= 10 * SECOND && r->now_ns < 10 * SECOND + 100 * MS);
    assert_true(check_latitudes(r, 0, false) >= 99);
    free_rig(r);
}

static void test_loop(void **state) {
    (void)state;
    rig *const r = new_rig(100.0);
    r->options.loop = true;
    begin_stream(r);
    run_for(r, 20.0); // three laps of 6 s
    double least = 90.0, most = -90.0;
    int rounds = 0, last = 0;
    for (int i = 0; i < r->n_kept; i++) {
        if (r->kept[i].frame.id != 1036)
            continue;
        const int32_t lat = long_of(&r->kept[i].frame);
        rounds += last && lat < last;
        last = lat;
        least = fmin(least, lat * 1e-7);
        most = fmax(most, lat * 1e-7);
    }
    assert_int_equal(rounds, 3);
    check_near("least latitude", least, LAT0_DEG, LAT_DEG_S * 100 * 0.11);
    check_near("greatest latitude", most, LAT0_DEG + LAT_DEG_S * FLIGHT_S, LAT_DEG_S * 100 * 0.11);
    assert_int_equal(r->stream.lost, 0);
    free_rig(r);
}

/// A height that its message cannot say is not sent, and is again when it can.
static void test_out_of_range(void **state) {
    (void)state;
    rig *const r = new_rig(1.0);
    r->flight.track.fixes[1].height_m = 1e9; // 10 s into it
    begin_stream(r);
    run_for(r, 20.0);
    int heights = 0, others = 0;
    for (int i = 0; i < r->n_kept; i++) {
        const double at_s = 1e-9 * (double)r->kept[i].time_ns;
        heights += r->kept[i].frame.id == 332;
        others += r->kept[i].frame.id == 1036;
        if (r->kept[i].frame.id == 332 && at_s > 0.45 && at_s < 19.55) // 4e7 m of 1e9 in 10 s: after .4 s
            fail_msg("a height of %g m was sent at %.3f s", (double)float_of(&r->kept[i].frame), at_s);
    }
    assert_true(heights >= 4 && heights <= 10 && others >= 199);
    assert_true(r->stream.left_out > 0);
    free_rig(r);
}

// ---- identification

static void test_identification(void **state) {
    (void)state;
    rig *const r = new_rig(1.0);
    const skv_can_faults full = {.queue_full = 0.9, .again = 0.5, .seed = 5};
    begin_stream(r);
    run_for(r, 0.5);
    int64_t worst = 0;
    for (int k = 0; k < 40; k++) {
        skv_can_frame request;
        const int64_t asked = r->now_ns;
        const int from = r->n_kept;
        skv_can_fake_set_faults(r->net, NULL); // for the request
        assert_int_equal(skv_cas_identification_request(&request, k % 2 ? 7 : 0, (uint8_t)k), SKV_OK);
        assert_int_equal(skv_can_send(r->listener, &request), SKV_CAN_OK);
        skv_can_fake_set_faults(
            r->net, &(skv_can_faults){.queue_full = full.queue_full, .again = full.again, .seed = (uint32_t)k});
        run_for(r, 0.1);
        int replies = 0;
        for (int i = from; i < r->n_kept; i++) {
            skv_cas_identity who;
            if (!skv_cas_identified(&r->kept[i].frame, &who))
                continue;
            replies++;
            worst = r->kept[i].time_ns - asked > worst ? r->kept[i].time_ns - asked : worst;
            assert_true(who.node == 7 && who.hardware_revision == 1 && who.software_revision == 2);
            assert_int_equal(r->kept[i].frame.data[3], k);
        }
        if (replies != 1)
            fail_msg("request %d: %d replies within 100 ms, want 1", k, replies);
    }
    skv_can_frame other;
    skv_can_fake_set_faults(r->net, NULL);
    assert_int_equal(skv_cas_identification_request(&other, 8, 0), SKV_OK);
    assert_int_equal(skv_can_send(r->listener, &other), SKV_CAN_OK);
    run_for(r, 0.1);
    assert_int_equal(r->bus.answers, 40); // none for another node
    assert_true(r->bus.waits > 40);
    print_message(
        "figure: skyvert-sim: identification with 9 of 10 sends refused: answered within %.0f ms at most, %llu waits\n",
        1e-6 * (double)worst, (unsigned long long)r->bus.waits);
    free_rig(r);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_wire),         cmocka_unit_test(test_load),
        cmocka_unit_test(test_stream),       cmocka_unit_test(test_utc),
        cmocka_unit_test(test_utc_late),     cmocka_unit_test(test_utc_held_up),
        cmocka_unit_test(test_refused),      cmocka_unit_test(test_clock_set),
        cmocka_unit_test(test_cable),        cmocka_unit_test(test_down_from_the_start),
        cmocka_unit_test(test_bus_off),      cmocka_unit_test(test_gone),
        cmocka_unit_test(test_time_lapse),   cmocka_unit_test(test_loop),
        cmocka_unit_test(test_out_of_range), cmocka_unit_test(test_identification),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
