// Lines of candump: read strictly, written as candump -L does.
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "port/canaerospace/skv_candump.h"

static void test_read(void **state) {
    (void)state;
    const struct {
        const char *line;
        int64_t time_ns;
        const char *interface;
        skv_can_frame frame;
    } cases[] = {
        {"(1436509052.249713) vcan0 123#0011223344556677",
         1436509052249713000,
         "vcan0",
         {0x123, 8, 0, {0, 0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77}}},
        {"(0.000001) can0 7FF#\n", 1000, "can0", {0x7FF, 0, 0, {0}}},
        {"(1436509052.249713123) slcan12 000#aB\r\n", 1436509052249713123, "slcan12", {0, 1, 0, {0xAB}}},
        {"(0001.500000) can0 1FFFFFFF#01", 1500000000, "can0", {0x1FFFFFFF, 1, SKV_CAN_EXTENDED, {1}}},
        {"(1.500000) can0 00000123#", 1500000000, "can0", {0x123, 0, SKV_CAN_EXTENDED, {0}}},
        {"(1.500000) can0 123#R", 1500000000, "can0", {0x123, 0, SKV_CAN_RTR, {0}}},
        {"(1.500000) can0 123#R8", 1500000000, "can0", {0x123, 8, SKV_CAN_RTR, {0}}},
        {"(1.500000) vcan0 20000040#0000000000000000", 1500000000, "vcan0", {0x40, 8, SKV_CAN_ERROR, {0}}},
        {"(1.500000)  can0\t123#11 T", 1500000000, "can0", {0x123, 1, 0, {0x11}}},
        {"(1.500000) can0 123#0011223344556677_F R \n",
         1500000000,
         "can0",
         {0x123, 8, 0, {0, 0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77}}},
    };
    skv_candump_reader reader = {0};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        skv_candump_entry e;
        const skv_candump_result got = skv_candump_read(&reader, cases[i].line, strlen(cases[i].line), &e);
        if (got != SKV_CANDUMP_FRAME)
            fail_msg("%s: refused: %s", cases[i].line, reader.reason);
        if (e.time_ns != cases[i].time_ns || strcmp(e.interface, cases[i].interface) != 0 ||
            memcmp(&e.frame, &cases[i].frame, sizeof e.frame) != 0)
            fail_msg("%s: got %lld %s %X [%d] flags %d", cases[i].line, (long long)e.time_ns, e.interface,
                     (unsigned)e.frame.id, e.frame.length, e.frame.flags);
    }
    assert_int_equal(reader.line, 10);
    assert_int_equal(reader.frames, 10);
    assert_int_equal(reader.backwards, 2); // the second and the fourth
}

static void test_refused(void **state) {
    (void)state;
    const struct {
        const char *line, *reason;
        int column;
    } cases[] = {
        {"1436509052.249713 vcan0 123#00", "a line begins with (seconds.fraction)", 1},
        {"(1436509052) vcan0 123#00", "the time is (seconds.fraction)", 12},
        {"(1436509052.24971) vcan0 123#00", "the time has six or nine digits behind the point", 18},
        {"(.249713) vcan0 123#00", "the time has six or nine digits behind the point", 9},
        {"(9999999999.249713) vcan0 123#00", "the time is too late", 19},
        {"(11436509052.249713) vcan0 123#00", "too many digits", 12},
        {"(1.249713 vcan0 123#00", "the time ends with )", 10},
        {"(1.249713)vcan0 123#00", "a blank behind the time", 11},
        {"(1.249713) averylongname0123 123#00", "an interface has at most 15 letters", 27},
        {"(1.249713) vcan0", "an interface and a blank before the frame", 17},
        {"(1.249713) vcan0 12#00", "an id has three or eight digits", 20},
        {"(1.249713) vcan0 1234#00", "an id has three or eight digits", 22},
        {"(1.249713) vcan0 123456789#00", "an id has three or eight digits", 26},
        {"(1.249713) vcan0 800#00", "an id of three digits is at most 7FF", 21},
        {"(1.249713) vcan0 40000000#00", "an id is at most 1FFFFFFF", 26},
        {"(1.249713) vcan0 123:00", "# between id and data", 21},
        {"(1.249713) vcan0 123#0", "half a byte of data", 23},
        {"(1.249713) vcan0 123#001122334455667788", "at most 8 bytes of data", 38},
        {"(1.249713) vcan0 123#00 11", "letters behind the frame", 25},
        {"(1.249713) vcan0 123#0011223344556677_8", "a length code is 9 to F", 39},
        {"(1.249713) vcan0 123#R9", "letters behind the frame", 23},
        {"(1.249713) vcan0 20000040#R", "an error frame is no remote request", 27},
    };
    skv_candump_reader reader = {0};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        skv_candump_entry e = {.time_ns = 42};
        const skv_candump_result got = skv_candump_read(&reader, cases[i].line, strlen(cases[i].line), &e);
        if (got != SKV_CANDUMP_ERROR || strcmp(reader.reason, cases[i].reason) != 0 || reader.column != cases[i].column)
            fail_msg("%s: got %d, %s, column %d; want %s, column %d", cases[i].line, (int)got,
                     reader.reason ? reader.reason : "-", reader.column, cases[i].reason, cases[i].column);
        assert_int_equal(e.time_ns, 42);
    }
    skv_candump_entry e;
    assert_int_equal(skv_candump_read(&reader, "\r\n", 2, &e), SKV_CANDUMP_EMPTY);
    const char *fd = "(1.249713) vcan0 123##1112233";
    assert_int_equal(skv_candump_read(&reader, fd, strlen(fd), &e), SKV_CANDUMP_FD);
    assert_int_equal(reader.fd_skipped, 1);
    assert_int_equal(reader.frames, 0);
    assert_int_equal(reader.line, sizeof cases / sizeof cases[0] + 2);
}

static void test_write(void **state) {
    (void)state;
    const struct {
        skv_candump_entry entry;
        const char *line;
    } cases[] = {
        {{1436509052249713999, "vcan0", {0x123, 2, 0, {0xAB, 1}}}, "(1436509052.249713) vcan0 123#AB01\n"},
        {{5, "can0", {0x123, 0, SKV_CAN_EXTENDED, {0}}}, "(0.000000) can0 00000123#\n"},
        {{1000000000, "can0", {0x123, 0, SKV_CAN_RTR, {0}}}, "(1.000000) can0 123#R\n"},
        {{1000000000, "can0", {0x123, 4, SKV_CAN_RTR | SKV_CAN_EXTENDED, {0}}}, "(1.000000) can0 00000123#R4\n"},
        {{1000000000, "can0", {0x40, 8, SKV_CAN_ERROR, {0}}}, "(1.000000) can0 20000040#0000000000000000\n"},
    };
    char line[SKV_CANDUMP_LINE];
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const int length = skv_candump_write(line, sizeof line, &cases[i].entry);
        if (length != (int)strlen(cases[i].line) || strcmp(line, cases[i].line) != 0)
            fail_msg("case %zu: got %d %s, want %s", i, length, line, cases[i].line);
        assert_int_equal(skv_candump_write(line, strlen(cases[i].line), &cases[i].entry), SKV_ERR_SIZE);
        skv_candump_reader reader = {0};
        skv_candump_entry back;
        assert_int_equal(skv_candump_read(&reader, cases[i].line, strlen(cases[i].line), &back), SKV_CANDUMP_FRAME);
        assert_true(memcmp(&back.frame, &cases[i].entry.frame, sizeof back.frame) == 0);
    }
    const skv_candump_entry longest = {INT64_MAX, "fifteen-letters", {0x1FFFFFFF, 8, SKV_CAN_EXTENDED, {0}}};
    assert_true(skv_candump_write(line, sizeof line, &longest) > 0);
    const skv_candump_entry bad[] = {{-1, "can0", {0}},
                                     {0, "", {0}},
                                     {0, "sixteen-letters!", {0}},
                                     {0, "a b", {0}},
                                     {0, "can0", {0x800, 0, 0, {0}}},
                                     {0, "can0", {0, 9, 0, {0}}},
                                     {0, "can0", {0, 0, SKV_CAN_ERROR | SKV_CAN_RTR, {0}}},
                                     {0, "can0", {0, 0, 8, {0}}}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        assert_int_equal(skv_candump_write(line, sizeof line, &bad[i]), SKV_ERR_RANGE);
    assert_int_equal(skv_candump_write(NULL, 10, &longest), SKV_ERR_NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_read), cmocka_unit_test(test_refused),
                                       cmocka_unit_test(test_write)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
