// Frames and their parts: bytes written out by hand (Python's struct), errors, services, bus load.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "port/canaerospace/skv_canaerospace.h"

static void check_bytes(const char *what, const skv_can_frame *frame, uint32_t id, int length, const char *want) {
    char got[17] = "";
    for (int i = 0; i < frame->length; i++)
        snprintf(got + 2 * i, 3, "%02X", frame->data[i]);
    if (frame->id != id || frame->length != length || frame->flags || strcmp(got, want) != 0)
        fail_msg("%s: got %03X [%d] %s, want %03X [%d] %s", what, (unsigned)frame->id, frame->length, got, (unsigned)id,
                 length, want);
}

static void test_pack(void **state) {
    (void)state;
    const struct {
        const char *what;
        skv_cas_message message;
        int length;
        const char *bytes;
    } cases[] = {
        {"NODATA", {.node = 5, .type = SKV_CAS_NODATA, .code = 9}, 4, "05000009"},
        {"FLOAT", {.node = 17, .type = SKV_CAS_FLOAT, .code = 255, .data.f = 47.5f}, 8, "110200FF423E0000"},
        {"LONG", {.node = 1, .type = SKV_CAS_LONG, .data.l = -1225678912}, 8, "01030000B6F19FC0"},
        {"ULONG", {.node = 1, .type = SKV_CAS_ULONG, .service = 1, .data.ul = 0x89ABCDEFu}, 8, "0104010089ABCDEF"},
        {"SHORT", {.node = 1, .type = SKV_CAS_SHORT, .data.s = {-2, 7}}, 6, "01060000FFFE"},
        {"UCHAR", {.node = 1, .type = SKV_CAS_UCHAR, .data.u = {200, 1, 2, 3}}, 5, "010A0000C8"},
        {"SHORT2", {.node = 1, .type = SKV_CAS_SHORT2, .data.s = {-2, 258}}, 8, "010C0000FFFE0102"},
        {"CHAR4", {.node = 1, .type = SKV_CAS_CHAR4, .data.c = {1, -1, 3, 4}}, 8, "010F000001FF0304"},
        {"UCHAR4", {.node = 1, .type = SKV_CAS_UCHAR4, .data.u = {1, 255, 3, 4}}, 8, "0110000001FF0304"},
        {"DOUBLEH", {.node = 1, .type = SKV_CAS_DOUBLEH, .data.ul = 0x4048118Fu}, 8, "011E00004048118F"},
        {"DOUBLEL", {.node = 1, .type = SKV_CAS_DOUBLEL, .data.ul = 0xD3A0B0C1u}, 8, "011F0000D3A0B0C1"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        skv_can_frame frame;
        skv_cas_message back;
        memset(&back, 0, sizeof back);
        assert_int_equal(skv_cas_pack(&frame, 1036, &cases[i].message), SKV_OK);
        check_bytes(cases[i].what, &frame, 1036, cases[i].length, cases[i].bytes);
        assert_int_equal(skv_cas_unpack(&back, &frame), SKV_OK);
        skv_can_frame again;
        assert_int_equal(skv_cas_pack(&again, 1036, &back), SKV_OK);
        check_bytes(cases[i].what, &again, 1036, cases[i].length, cases[i].bytes);
        assert_true(back.node == cases[i].message.node && back.service == cases[i].message.service &&
                    back.code == cases[i].message.code);
    }
}

static void test_pack_errors(void **state) {
    (void)state;
    const skv_cas_message ok = {.type = SKV_CAS_FLOAT}, bad = {.type = 5};
    skv_can_frame frame = {0};
    skv_cas_message message;
    assert_int_equal(skv_cas_pack(NULL, 1, &ok), SKV_ERR_NULL);
    assert_int_equal(skv_cas_pack(&frame, 1, NULL), SKV_ERR_NULL);
    assert_int_equal(skv_cas_pack(&frame, 0x800, &ok), SKV_ERR_RANGE);
    assert_int_equal(skv_cas_pack(&frame, 1, &bad), SKV_ERR_UNSUPPORTED);
    const struct {
        skv_can_frame frame;
        skv_status want;
    } cases[] = {
        {{1036, 8, 0, {1, 2}}, SKV_OK},
        {{1036, 8, 0, {1, 0}}, SKV_OK},        // filled up to 8
        {{1036, 6, 0, {1, 2}}, SKV_ERR_RANGE}, // a float of two bytes
        {{1036, 3, 0, {1, 0}}, SKV_ERR_RANGE}, // no header
        {{1036, 9, 0, {1, 2}}, SKV_ERR_RANGE},
        {{1036, 8, SKV_CAN_EXTENDED, {1, 2}}, SKV_ERR_RANGE},
        {{1036, 8, SKV_CAN_RTR, {1, 2}}, SKV_ERR_RANGE},
        {{1036, 8, SKV_CAN_ERROR, {1, 2}}, SKV_ERR_RANGE},
        {{0x800, 8, 0, {1, 2}}, SKV_ERR_RANGE},
        {{1036, 8, 0, {1, 99}}, SKV_ERR_UNSUPPORTED},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        if (skv_cas_unpack(&message, &cases[i].frame) != cases[i].want)
            fail_msg("unpack case %zu: got %d, want %d", i, skv_cas_unpack(&message, &cases[i].frame), cases[i].want);
}

static void test_encode(void **state) {
    (void)state;
    skv_cas_sender sender = {.node = 17};
    skv_can_frame f[2];
    assert_int_equal(skv_cas_encode(&sender, SKV_CAS_LATITUDE, SKV_CAS_FLOAT, 47.5, f), 1);
    check_bytes("latitude", &f[0], 1036, 8, "11020000423E0000");
    assert_int_equal(skv_cas_encode(&sender, SKV_CAS_LATITUDE, SKV_CAS_DOUBLEH, 48.1372016, f), 2);
    check_bytes("latitude, upper", &f[0], 1036, 8, "111E00014048118F");
    check_bytes("latitude, lower", &f[1], 1036, 8, "111F0002D2707ABC");
    assert_int_equal(skv_cas_encode(&sender, SKV_CAS_LATITUDE, SKV_CAS_DOUBLEL, 48.1372016, f), 2);
    check_bytes("latitude, lower first", &f[0], 1036, 8, "111F0003D2707ABC");
    assert_int_equal(skv_cas_encode(&sender, SKV_CAS_LONGITUDE, 0, -122.5678912, f), 1);
    check_bytes("longitude", &f[0], 1037, 8, "11030000B6F19FC0");
    assert_int_equal(skv_cas_encode(&sender, SKV_CAS_STATIC_PRESSURE, 0, 1013.25, f), 1);
    check_bytes("pressure", &f[0], 326, 8, "11020000447D5000");
    assert_int_equal(skv_cas_encode(&sender, SKV_CAS_TIME_OFFSET, 0, -3661.0, f), 1);
    check_bytes("time offset", &f[0], 1809, 8, "11030000FFFFF1B3");
    assert_int_equal(skv_cas_encode(&sender, SKV_CAS_HEADING, 0, 237.5, f), 1); // = -122.5
    check_bytes("heading", &f[0], 321, 8, "11020000C2F50000");
    const uint8_t utc[4] = {13, 43, 22, 0}, date[4] = {22, 11, 20, 26};
    assert_int_equal(skv_cas_encode_bytes(&sender, SKV_CAS_UTC, utc, f), 1);
    check_bytes("UTC", &f[0], 1200, 8, "110F00000D2B1600");
    assert_int_equal(skv_cas_encode_bytes(&sender, SKV_CAS_DATE, date, f), 1);
    check_bytes("date", &f[0], 1206, 8, "110F0000160B141A");
    sender.next[SKV_CAS_PITCH] = 255;
    assert_int_equal(skv_cas_encode(&sender, SKV_CAS_PITCH, 0, 0.0, f), 1);
    assert_int_equal(f[0].data[3], 255);
    assert_int_equal(skv_cas_encode(&sender, SKV_CAS_PITCH, 0, 0.0, f), 1);
    assert_int_equal(f[0].data[3], 0);
}

static void test_encode_errors(void **state) {
    (void)state;
    skv_cas_sender sender = {.node = 17};
    skv_can_frame f[2];
    const skv_cas_sender before = sender;
    const uint8_t leap[4] = {29, 2, 20, 23}, second[4] = {22, 59, 60, 0};
    assert_int_equal(skv_cas_encode(NULL, SKV_CAS_PITCH, 0, 0.0, f), SKV_ERR_NULL);
    assert_int_equal(skv_cas_encode(&sender, SKV_CAS_MESSAGES, 0, 0.0, f), SKV_ERR_RANGE);
    assert_int_equal(skv_cas_encode(&sender, SKV_CAS_UTC, 0, 0.0, f), SKV_ERR_RANGE);
    assert_int_equal(skv_cas_encode(&sender, SKV_CAS_LATITUDE, 0, 90.001, f), SKV_ERR_RANGE);
    assert_int_equal(skv_cas_encode(&sender, SKV_CAS_LATITUDE, 0, NAN, f), SKV_ERR_RANGE);
    assert_int_equal(skv_cas_encode(&sender, SKV_CAS_HEADING, 0, INFINITY, f), SKV_ERR_RANGE);
    assert_int_equal(skv_cas_encode(&sender, SKV_CAS_PITCH, SKV_CAS_LONG, 0.0, f), SKV_ERR_UNSUPPORTED);
    assert_int_equal(skv_cas_encode(&sender, SKV_CAS_PITCH, 200, 0.0, f), SKV_ERR_UNSUPPORTED);
    assert_int_equal(skv_cas_encode_bytes(&sender, SKV_CAS_DATE, leap, f), SKV_ERR_RANGE);
    assert_int_equal(skv_cas_encode_bytes(&sender, SKV_CAS_UTC, second, f), SKV_ERR_RANGE);
    assert_int_equal(skv_cas_encode_bytes(&sender, SKV_CAS_PITCH, second, f), SKV_ERR_RANGE);
    assert_true(memcmp(&before, &sender, sizeof sender) == 0);
}

static void test_table(void **state) {
    (void)state;
    for (int i = 0; i < SKV_CAS_MESSAGES; i++) {
        const skv_cas_info *info = &skv_cas_table[i];
        assert_true(i == 0 || info->id > skv_cas_table[i - 1].id);
        assert_int_equal(skv_cas_find(info->id), i);
        assert_true(info->types >> info->type & 1u);
        assert_true(info->period_ms >= 100 && info->name && info->unit);
    }
    assert_int_equal(skv_cas_find(0), -1);
    assert_int_equal(skv_cas_find(1035), -1);
    assert_int_equal(skv_cas_find(0x20000000u | 1036), -1);
    // The ids of the specification that users look for.
    assert_int_equal(skv_cas_table[SKV_CAS_LATITUDE].id, 1036);
    assert_int_equal(skv_cas_table[SKV_CAS_GPS_HEIGHT].id, 1038);
    assert_int_equal(skv_cas_table[SKV_CAS_TRUE_HEADING].id, 1133);
    assert_int_equal(skv_cas_table[SKV_CAS_UTC].id, 1200);
    assert_int_equal(skv_cas_table[SKV_CAS_VISIBILITY_SETTING].id, 1810);
    for (int i = 0; i < SKV_CAS_COUNTS; i++)
        assert_true(skv_cas_count_name((skv_cas_count)i)[0] != '?');
    assert_true(skv_cas_count_name(SKV_CAS_COUNTS)[0] == '?');
}

static void test_services(void **state) {
    (void)state;
    const skv_cas_identity self = {.node = 9, .hardware_revision = 2, .software_revision = 5};
    skv_cas_identity who = {0};
    skv_can_frame request, reply;
    uint32_t stamp = 0;
    assert_int_equal(skv_cas_identification_request(&request, 0, 77), SKV_OK);
    check_bytes("request", &request, 0x080, 4, "0000004D");
    assert_int_equal(skv_cas_identify(&request, &self, &reply), 1);
    check_bytes("reply", &reply, 0x081, 8, "0910004D02050000");
    assert_int_equal(skv_cas_identified(&reply, &who), 1);
    assert_true(who.node == 9 && who.hardware_revision == 2 && who.software_revision == 5);
    request.data[0] = 9; // this node
    assert_int_equal(skv_cas_identify(&request, &self, &reply), 1);
    request.data[0] = 10; // another one
    assert_int_equal(skv_cas_identify(&request, &self, &reply), 0);
    assert_int_equal(skv_cas_identify(&reply, &self, &request), 0);
    request.data[0] = 0;
    request.data[2] = 1; // another service
    assert_int_equal(skv_cas_identify(&request, &self, &reply), 0);
    assert_int_equal(skv_cas_time_sync(&request, &stamp), 0);
    assert_int_equal(skv_cas_time_sync_request(&request, 0x01020304), SKV_OK);
    check_bytes("synchronisation", &request, 0x080, 8, "0004010001020304");
    assert_int_equal(skv_cas_time_sync(&request, &stamp), 1);
    assert_int_equal(stamp, 0x01020304);
}

// [Davis07]: at worst 55 + 10 s bits for s bytes (11-bit id), 80 + 10 s
// (29-bit).
static void test_bits(void **state) {
    (void)state;
    for (uint8_t s = 0; s <= 8; s++) {
        const skv_can_frame plain = {.length = s}, extended = {.length = s, .flags = SKV_CAN_EXTENDED};
        assert_int_equal(skv_cas_frame_bits(&plain), 55 + 10 * s);
        assert_int_equal(skv_cas_frame_bits(&extended), 80 + 10 * s);
    }
}

// Every message at its period, positions as doubles (two frames), all frames as long as they can be: below 80 % of the
// slowest bus, as the specification asks.
static void test_load(void **state) {
    (void)state;
    const skv_can_frame longest = {.length = 8};
    double bits = 0.0;
    for (int i = 0; i < SKV_CAS_MESSAGES; i++)
        bits += (skv_cas_table[i].types >> SKV_CAS_DOUBLEH & 1u ? 2 : 1) * skv_cas_frame_bits(&longest) * 1000.0 /
                skv_cas_table[i].period_ms;
    print_message(
        "figure: CANaerospace: all %d messages at their periods: %.1f %% of 125 kbit/s, %.1f %% of 1 Mbit/s, at most\n",
        SKV_CAS_MESSAGES, bits / 1250.0, bits / 10000.0);
    check_at_most("load of 125 kbit/s, %", bits / 1250.0, 80.0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pack),          cmocka_unit_test(test_pack_errors), cmocka_unit_test(test_encode),
        cmocka_unit_test(test_encode_errors), cmocka_unit_test(test_table),       cmocka_unit_test(test_services),
        cmocka_unit_test(test_bits),          cmocka_unit_test(test_load),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
