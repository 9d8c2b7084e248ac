// The receiver: what is wrong is counted under its own name and never reaches a value.
#include <math.h>
#include <string.h>

#include "check.h"
#include "port/canaerospace/skv_canaerospace.h"

#define MS 1000000ll

static skv_cas_receiver r;
static skv_cas_sender sender;
static int64_t now;

static void begin(void) {
    memset(&r, 0, sizeof r);
    sender = (skv_cas_sender){.node = 17};
    now = 1000 * MS;
}

static skv_cas_count take(const skv_can_frame *frame) {
    return skv_cas_receive(&r, frame, now);
}

static void expect(const char *what, skv_cas_count got, skv_cas_count want) {
    if (got != want)
        fail_msg("%s: got %s, want %s", what, skv_cas_count_name(got), skv_cas_count_name(want));
}

static skv_can_frame next_of(skv_cas_index index, double value) {
    skv_can_frame f[2];
    assert_int_equal(skv_cas_encode(&sender, index, SKV_CAS_FLOAT, value, f), 1);
    return f[0];
}

static double value_of(skv_cas_index index) {
    double value = -12345.0;
    (void)skv_cas_value(&r, index, &value);
    return value;
}

// Every message and type there and back.
static void test_round_trip(void **state) {
    (void)state;
    begin();
    for (int i = 0; i < SKV_CAS_MESSAGES; i++)
        for (uint8_t type = 1; type < 32; type++) {
            const skv_cas_info *info = &skv_cas_table[i];
            skv_can_frame f[2];
            begin();
            if (!(info->types >> type & 1u) || info->low >= info->high)
                continue;
            const double value = (double)info->low + 0.37 * ((double)info->high - (double)info->low);
            const int n = skv_cas_encode(&sender, (skv_cas_index)i, type, value, f);
            assert_true(n == 1 || n == 2);
            if (n == 2)
                expect("first half", take(&f[0]), SKV_CAS_HALF);
            expect(info->name, take(&f[n - 1]), SKV_CAS_ACCEPTED);
            // Half a step of the type: 24 bits of FLOAT; LONG counts; DOUBLE is exact.
            const double step = type == SKV_CAS_FLOAT  ? 6e-8 * fabs(value)
                                : type == SKV_CAS_LONG ? 0.5000001 / (double)info->per_unit
                                                       : 0.0;
            check_near(info->name, value_of((skv_cas_index)i), value, step);
            assert_int_equal(r.total[SKV_CAS_MISSING] + r.total[SKV_CAS_UNPAIRED] + r.total[SKV_CAS_RESTART], 0);
        }
}

// A bad frame behind a good one: its own count goes up by one, no other, and the value stays.
static void check_refused(const char *what, const skv_can_frame *bad, skv_cas_count want) {
    const skv_cas_receiver before = r;
    expect(what, take(bad), want);
    for (int i = 0; i < SKV_CAS_COUNTS; i++)
        if (r.total[i] != before.total[i] + (i == (int)want))
            fail_msg("%s: %s went from %u to %u", what, skv_cas_count_name((skv_cas_count)i), (unsigned)before.total[i],
                     (unsigned)r.total[i]);
    for (int i = 0; i < SKV_CAS_MESSAGES; i++)
        if (r.slot[i].value != before.slot[i].value || memcmp(r.slot[i].bytes, before.slot[i].bytes, 4) != 0 ||
            r.slot[i].time_ns != before.slot[i].time_ns || r.slot[i].age != before.slot[i].age)
            fail_msg("%s: %s changed", what, skv_cas_table[i].name);
}

static void test_refused(void **state) {
    (void)state;
    begin();
    const struct {
        const char *what;
        skv_can_frame frame; // message codes: the next one is 1
        skv_cas_count want;
    } cases[] = {
        {"NaN", {1036, 8, 0, {17, 2, 0, 1, 0x7F, 0xC0, 0, 0}}, SKV_CAS_NOT_FINITE},
        {"signalling NaN", {1036, 8, 0, {17, 2, 0, 2, 0xFF, 0x80, 0, 1}}, SKV_CAS_NOT_FINITE},
        {"infinity", {1036, 8, 0, {17, 2, 0, 3, 0x7F, 0x80, 0, 0}}, SKV_CAS_NOT_FINITE},
        {"91 deg", {1036, 8, 0, {17, 2, 0, 4, 0x42, 0xB6, 0, 0}}, SKV_CAS_OUT_OF_RANGE},
        {"LONG of 214 deg", {1036, 8, 0, {17, 3, 0, 5, 0x7F, 0xFF, 0xFF, 0xFF}}, SKV_CAS_OUT_OF_RANGE},
        {"service code 3", {1036, 8, 0, {17, 2, 3, 6, 0x42, 0x3E, 0, 0}}, SKV_CAS_BAD_SERVICE},
        {"ULONG", {1036, 8, 0, {17, 4, 0, 6, 0x42, 0x3E, 0, 0}}, SKV_CAS_BAD_TYPE},
        {"type 200", {1036, 8, 0, {17, 200, 0, 6, 0x42, 0x3E, 0, 0}}, SKV_CAS_BAD_TYPE},
        {"7 bytes", {1036, 7, 0, {17, 2, 0, 6, 0x42, 0x3E, 0, 0}}, SKV_CAS_BAD_LENGTH},
        {"3 bytes", {1036, 3, 0, {17, 2, 0}}, SKV_CAS_BAD_LENGTH},
        {"200 bytes", {1036, 200, 0, {17, 2, 0, 6}}, SKV_CAS_BAD_LENGTH},
        {"remote", {1036, 8, SKV_CAN_RTR, {0}}, SKV_CAS_BAD_FORMAT},
        {"29 bits", {1036, 8, SKV_CAN_EXTENDED, {17, 2, 0, 6, 0x42, 0x3E, 0, 0}}, SKV_CAS_BAD_FORMAT},
        {"id above 7FF", {1036 + 2048, 8, 0, {17, 2, 0, 6, 0x42, 0x3E, 0, 0}}, SKV_CAS_BAD_FORMAT},
        {"unknown flag", {1036, 8, 128, {17, 2, 0, 6, 0x42, 0x3E, 0, 0}}, SKV_CAS_BAD_FORMAT},
        {"bus error", {64, 8, SKV_CAN_ERROR, {0}}, SKV_CAS_BUS_ERROR},
        {"another id", {1500, 8, 0, {17, 2, 0, 6, 0x42, 0x3E, 0, 0}}, SKV_CAS_UNKNOWN},
        {"duplicate", {1036, 8, 0, {17, 2, 0, 5, 0x42, 0x3E, 0, 0}}, SKV_CAS_DUPLICATE},
        {"old", {1036, 8, 0, {17, 2, 0, 2, 0x42, 0x3E, 0, 0}}, SKV_CAS_REORDERED},
        {"another node", {1036, 8, 0, {18, 2, 0, 6, 0x42, 0x3E, 0, 0}}, SKV_CAS_OTHER_NODE},
        {"24:00:00", {1200, 8, 0, {17, 15, 0, 1, 24, 0, 0, 0}}, SKV_CAS_OUT_OF_RANGE},
        {"12:00:60", {1200, 8, 0, {17, 15, 0, 2, 12, 0, 60, 0}}, SKV_CAS_OUT_OF_RANGE},
        {"30 February", {1206, 8, 0, {17, 15, 0, 1, 30, 2, 20, 24}}, SKV_CAS_OUT_OF_RANGE},
        {"day -1", {1206, 8, 0, {17, 15, 0, 2, 255, 2, 20, 24}}, SKV_CAS_OUT_OF_RANGE},
        {"UTC as FLOAT", {1200, 8, 0, {17, 2, 0, 3, 0, 0, 0, 0}}, SKV_CAS_BAD_TYPE},
        {"sky state 5", {1808, 8, 0, {17, 16, 0, 1, 5, 0, 0, 0}}, SKV_CAS_OUT_OF_RANGE},
        {"service 42", {0x080, 8, 0, {0, 0, 42, 0}}, SKV_CAS_BAD_SERVICE},
        {"identification with data", {0x080, 8, 0, {0, 2, 0, 0}}, SKV_CAS_BAD_TYPE},
        {"service of 2 bytes", {0x080, 2, 0, {0, 0}}, SKV_CAS_BAD_LENGTH},
        {"identification", {0x080, 4, 0, {0, 0, 0, 0}}, SKV_CAS_SERVICE},
        {"a service of another channel", {2000, 4, 0, {0, 0, 4, 0}}, SKV_CAS_SERVICE},
    };
    const uint8_t utc[4] = {12, 0, 0, 0}, date[4] = {29, 2, 20, 24}, sky[4] = {4, 3, 0, 0};
    skv_can_frame good[4] = {next_of(SKV_CAS_LATITUDE, 47.5)};
    assert_int_equal(skv_cas_encode_bytes(&sender, SKV_CAS_UTC, utc, &good[1]), 1);
    assert_int_equal(skv_cas_encode_bytes(&sender, SKV_CAS_DATE, date, &good[2]), 1);
    assert_int_equal(skv_cas_encode_bytes(&sender, SKV_CAS_SKY_STATE, sky, &good[3]), 1);
    for (int i = 0; i < 4; i++)
        expect("good", take(&good[i]), SKV_CAS_ACCEPTED);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        now += MS;
        check_refused(cases[i].what, &cases[i].frame, cases[i].want);
    }
    check_near("latitude", value_of(SKV_CAS_LATITUDE), 47.5, 0.0);
}

static void test_codes(void **state) {
    (void)state;
    begin();
    skv_can_frame f[12];
    for (int i = 0; i < 12; i++)
        f[i] = next_of(SKV_CAS_ROLL, i);
    expect("0", take(&f[0]), SKV_CAS_ACCEPTED);
    expect("1", take(&f[1]), SKV_CAS_ACCEPTED);
    expect("5", take(&f[5]), SKV_CAS_ACCEPTED);
    assert_int_equal(r.slot[SKV_CAS_ROLL].count[SKV_CAS_MISSING], 3);
    expect("3", take(&f[3]), SKV_CAS_REORDERED);
    expect("6", take(&f[6]), SKV_CAS_ACCEPTED);
    expect("6 again", take(&f[6]), SKV_CAS_DUPLICATE);
    expect("7", take(&f[7]), SKV_CAS_ACCEPTED);
    assert_int_equal(r.total[SKV_CAS_MISSING], 3);
    check_near("roll", value_of(SKV_CAS_ROLL), 7.0, 0.0);
    // The sender begins anew: believed at its second frame.
    expect("0 again", take(&f[0]), SKV_CAS_REORDERED);
    expect("1 again", take(&f[1]), SKV_CAS_ACCEPTED);
    expect("2", take(&f[2]), SKV_CAS_ACCEPTED);
    assert_int_equal(r.total[SKV_CAS_RESTART], 1);
    check_near("roll", value_of(SKV_CAS_ROLL), 2.0, 0.0);
    // A whole turn of codes, from 255 to 0.
    for (int i = 0; i < 600; i++) {
        const skv_can_frame more = next_of(SKV_CAS_PITCH, i % 90);
        expect("turn", take(&more), SKV_CAS_ACCEPTED);
    }
    assert_int_equal(r.slot[SKV_CAS_PITCH].count[SKV_CAS_MISSING], 0);
}

static void test_ignore_codes(void **state) {
    (void)state;
    begin();
    const skv_can_frame f = next_of(SKV_CAS_ROLL, 3.0);
    r.ignore_codes = 1;
    for (int i = 0; i < 5; i++)
        expect("always 0", take(&f), SKV_CAS_ACCEPTED);
}

static void test_stale(void **state) {
    (void)state;
    begin();
    skv_can_frame f = next_of(SKV_CAS_LATITUDE, 10.0);
    double value = 0.0;
    assert_int_equal(skv_cas_tick(&r, now), 0);
    assert_int_equal(skv_cas_value(&r, SKV_CAS_LATITUDE, &value), SKV_CAS_NEVER);
    expect("first", take(&f), SKV_CAS_ACCEPTED);
    now += 300 * MS;
    assert_int_equal(skv_cas_tick(&r, now), 0);
    now += 1;
    assert_int_equal(skv_cas_tick(&r, now), 1);
    assert_int_equal(skv_cas_tick(&r, now), 1);
    assert_int_equal(skv_cas_value(&r, SKV_CAS_LATITUDE, &value), SKV_CAS_OLD);
    check_near("stale value", value, 10.0, 0.0);
    assert_int_equal(r.slot[SKV_CAS_LATITUDE].count[SKV_CAS_STALE], 1);
    // Back after a gap: fresh at once.
    f = next_of(SKV_CAS_LATITUDE, 11.0);
    f = next_of(SKV_CAS_LATITUDE, 12.0);
    expect("back", take(&f), SKV_CAS_ACCEPTED);
    assert_int_equal(skv_cas_value(&r, SKV_CAS_LATITUDE, &value), SKV_CAS_FRESH);
    assert_int_equal(r.total[SKV_CAS_MISSING], 1);
    // Another node takes over, another code: only when stale.
    sender = (skv_cas_sender){.node = 3};
    f = next_of(SKV_CAS_LATITUDE, 13.0);
    expect("node 3", take(&f), SKV_CAS_OTHER_NODE);
    now += 301 * MS;
    expect("node 3, later", take(&f), SKV_CAS_ACCEPTED);
    assert_int_equal(r.total[SKV_CAS_STALE], 2);
    assert_int_equal(r.total[SKV_CAS_RESTART], 1);
    // The clock runs backwards: the value does not live longer than three periods from then on.
    now -= 3600000 * MS;
    assert_int_equal(skv_cas_tick(&r, now), 0);
    now += 301 * MS;
    assert_int_equal(skv_cas_tick(&r, now), 1);
}

static void send_half(uint8_t type, uint8_t code, double value, skv_cas_count want) {
    skv_cas_sender s = {.node = 17};
    skv_can_frame f[2];
    s.next[SKV_CAS_LONGITUDE] = code;
    assert_int_equal(skv_cas_encode(&s, SKV_CAS_LONGITUDE, type, value, f), 2);
    expect("half", take(&f[0]), want);
    now += MS / 5;
}

// Halves in either order, lost halves, and never one half of each of two numbers.
static void test_doubles(void **state) {
    (void)state;
    begin();
    const double a = -122.123456789012, b = -122.123456999999;
    for (int order = 0; order < 2; order++) {
        const uint8_t first = order ? SKV_CAS_DOUBLEL : SKV_CAS_DOUBLEH,
                      second = order ? SKV_CAS_DOUBLEH : SKV_CAS_DOUBLEL;
        memset(&r, 0, sizeof r);
        send_half(first, 0, a, SKV_CAS_HALF);
        send_half(second, 1, a, SKV_CAS_ACCEPTED);
        check_near("pair", value_of(SKV_CAS_LONGITUDE), a, 0.0);
        now += 100 * MS; // the first half of the next is lost
        send_half(second, 3, b, SKV_CAS_HALF);
        send_half(first, 4, a, SKV_CAS_HALF); // codes follow, close in time, but in the wrong order
        send_half(second, 5, a, SKV_CAS_ACCEPTED);
        check_near("after a loss", value_of(SKV_CAS_LONGITUDE), a, 0.0);
        assert_int_equal(r.total[SKV_CAS_UNPAIRED], 1);
        assert_int_equal(r.total[SKV_CAS_MISSING], 1);
        now += 100 * MS; // the second half is lost
        send_half(first, 6, b, SKV_CAS_HALF);
        now += 100 * MS;
        send_half(first, 8, b, SKV_CAS_HALF);
        send_half(second, 9, b, SKV_CAS_ACCEPTED);
        check_near("after another", value_of(SKV_CAS_LONGITUDE), b, 0.0);
        now += 100 * MS;
        send_half(first, 10, a, SKV_CAS_HALF);
        now += 26 * MS; // too late to be its other half
        send_half(second, 11, a, SKV_CAS_HALF);
        check_near("unchanged", value_of(SKV_CAS_LONGITUDE), b, 0.0);
    }
}

// Halves whose codes do not follow each other are no pair; a sender that changes the order is believed the third time.
static void test_double_order(void **state) {
    (void)state;
    begin();
    send_half(SKV_CAS_DOUBLEH, 0, 10.0, SKV_CAS_HALF);
    send_half(SKV_CAS_DOUBLEL, 2, 10.0, SKV_CAS_HALF);
    now += 100 * MS;
    send_half(SKV_CAS_DOUBLEH, 3, 10.0, SKV_CAS_HALF);
    send_half(SKV_CAS_DOUBLEL, 4, 10.0, SKV_CAS_ACCEPTED);
    for (uint8_t i = 0; i < 3; i++) {
        now += 100 * MS;
        send_half(SKV_CAS_DOUBLEL, (uint8_t)(5 + 2 * i), 20.0, SKV_CAS_HALF);
        send_half(SKV_CAS_DOUBLEH, (uint8_t)(6 + 2 * i), 20.0, i < 2 ? SKV_CAS_HALF : SKV_CAS_ACCEPTED);
    }
    check_near("new order", value_of(SKV_CAS_LONGITUDE), 20.0, 0.0);
}

// 127 ahead is a gap, 128 ahead is 128 behind.
static void test_half_a_turn(void **state) {
    (void)state;
    for (int step = 127; step <= 128; step++) {
        begin();
        skv_can_frame f = next_of(SKV_CAS_ROLL, 1.0);
        expect("first", take(&f), SKV_CAS_ACCEPTED);
        f.data[3] = (uint8_t)step;
        expect("far", take(&f), step == 127 ? SKV_CAS_ACCEPTED : SKV_CAS_REORDERED);
        assert_int_equal(r.total[SKV_CAS_MISSING], step == 127 ? 126 : 0);
    }
}

static void test_double_payload(void **state) {
    (void)state;
    begin();
    skv_can_frame h = {1036, 8, 0, {17, 30, 0, 0, 0x7F, 0xF8, 0, 0}}, l = {1036, 8, 0, {17, 31, 0, 1, 0, 0, 0, 0}};
    expect("upper", take(&h), SKV_CAS_HALF);
    expect("NaN", take(&l), SKV_CAS_NOT_FINITE);
    assert_int_equal(r.slot[SKV_CAS_LATITUDE].age, SKV_CAS_NEVER);
}

static void test_heights(void **state) {
    (void)state;
    begin();
    double h = -1.0;
    assert_int_equal(skv_cas_height(&r, &h), SKV_CAS_NO_HEIGHT);
    const struct {
        skv_cas_index index;
        double height;
        skv_cas_datum want;
    } order[] = {{SKV_CAS_RADIO_HEIGHT, 50.0, SKV_CAS_NO_HEIGHT},
                 {SKV_CAS_STANDARD_ALTITUDE, 1000.0, SKV_CAS_PRESSURE},
                 {SKV_CAS_BARO_ALTITUDE, 1100.0, SKV_CAS_SEA},
                 {SKV_CAS_TRUE_ALTITUDE, 1120.0, SKV_CAS_SEA},
                 {SKV_CAS_GPS_HEIGHT, 1170.0, SKV_CAS_ELLIPSOID}};
    for (int i = 0; i < 5; i++) {
        const skv_can_frame f = next_of(order[i].index, order[i].height);
        expect("height", take(&f), SKV_CAS_ACCEPTED);
        assert_int_equal(skv_cas_height(&r, &h), order[i].want);
        if (order[i].want)
            check_near("height", h, order[i].height, 0.0);
    }
}

static void test_wrapped(void **state) {
    (void)state;
    begin();
    const struct {
        skv_cas_index index;
        float sent;
        double want;
    } cases[] = {{SKV_CAS_HEADING, 270.0f, -90.0},   {SKV_CAS_HEADING, 360.0f, 0.0},
                 {SKV_CAS_TRACK, -180.0f, -180.0},   {SKV_CAS_TRACK, 180.0f, 180.0},
                 {SKV_CAS_SUN_AZIMUTH, 360.0f, 0.0}, {SKV_CAS_MOON_AZIMUTH, -90.0f, 270.0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        skv_cas_message m = {.node = 17, .type = SKV_CAS_FLOAT, .code = (uint8_t)i};
        skv_can_frame f;
        m.data.f = cases[i].sent;
        assert_int_equal(skv_cas_pack(&f, skv_cas_table[cases[i].index].id, &m), SKV_OK);
        expect("angle", take(&f), SKV_CAS_ACCEPTED);
        check_near("angle", value_of(cases[i].index), cases[i].want, 0.0);
    }
    skv_can_frame f[2];
    const double angles[][2] = {{-725.0, -5.0}, {540.0, 180.0}, {180.0, 180.0}, {-180.0, 180.0}, {359.0, -1.0}};
    for (size_t i = 0; i < sizeof angles / sizeof angles[0]; i++) {
        skv_cas_message m;
        assert_int_equal(skv_cas_encode(&sender, SKV_CAS_HEADING, 0, angles[i][0], f), 1);
        assert_int_equal(skv_cas_unpack(&m, &f[0]), SKV_OK);
        check_near("sent angle", (double)m.data.f, angles[i][1], 0.0);
    }
    assert_int_equal(skv_cas_encode(&sender, SKV_CAS_SUN_AZIMUTH, 0, 359.99999999, f), 1);
    assert_true(f[0].data[4] == 0 && f[0].data[5] == 0);
}

static void test_nothing(void **state) {
    (void)state;
    begin();
    double value;
    uint8_t bytes[4];
    skv_can_frame f = next_of(SKV_CAS_ROLL, 3.0);
    assert_int_equal(skv_cas_receive(NULL, &f, 0), SKV_CAS_UNKNOWN);
    assert_int_equal(skv_cas_receive(&r, NULL, 0), SKV_CAS_UNKNOWN);
    assert_int_equal(skv_cas_value(&r, SKV_CAS_UTC, &value), SKV_CAS_NEVER);
    assert_int_equal(skv_cas_bytes(&r, SKV_CAS_ROLL, bytes), SKV_CAS_NEVER);
    assert_int_equal(skv_cas_value(&r, SKV_CAS_MESSAGES, &value), SKV_CAS_NEVER);
    assert_int_equal(skv_cas_tick(NULL, 0), 0);
    skv_cas_clear(NULL);
    r.total[SKV_CAS_ACCEPTED] = UINT32_MAX; // counts stop there
    expect("counted", take(&f), SKV_CAS_ACCEPTED);
    assert_true(r.total[SKV_CAS_ACCEPTED] == UINT32_MAX);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip),   cmocka_unit_test(test_refused),     cmocka_unit_test(test_codes),
        cmocka_unit_test(test_ignore_codes), cmocka_unit_test(test_stale),       cmocka_unit_test(test_doubles),
        cmocka_unit_test(test_double_order), cmocka_unit_test(test_half_a_turn), cmocka_unit_test(test_double_payload),
        cmocka_unit_test(test_heights),      cmocka_unit_test(test_wrapped),     cmocka_unit_test(test_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
