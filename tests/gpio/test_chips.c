// What both versions of libgpiod share, on a folder that stands for /dev: where a line is, why it cannot be had,
// clocks.
#define CHIPS_DEV "dev"
#include "port/gpiod/chips.c"

#include "check.h"

#include <unistd.h>

// Chips 0 to 2; 1 is not for us.
static const char *const lines[3][3] = {{"A", "", "UP BUTTON"}, {"B", "", ""}, {"", "A", "C"}};

static int find(const char *path, const char *name) {
    const int chip = path[strlen(path) - 1] - '0';
    errno = chip == 1 ? EACCES : EBADF;
    if (chip == 1 || chip > 2)
        return CHIPS_REFUSED;
    for (int i = 0; i < 3; i++)
        if (strcmp(lines[chip][i], name) == 0)
            return i;
    return CHIPS_ABSENT;
}

static bool gather(const char *a, const char *b, chips_place places[2], char why[LINES_WHY]) {
    const lines_spec specs[2] = {{.name = a}, {.name = b}};
    return chips_gather(specs, b ? 2 : 1, find, places, why);
}

static void lines_are_found_by_name(void **state) {
    (void)state;
    chips_place at[2];
    char why[LINES_WHY] = "";
    assert_true(gather("A", "UP BUTTON", at, why)); // the first chip that has it
    assert_string_equal(at[0].chip, "dev/gpiochip0");
    assert_int_equal(at[0].offset, 0);
    assert_int_equal(at[1].offset, 2);
    assert_true(gather("C", NULL, at, why));
    assert_string_equal(at[0].chip, "dev/gpiochip2");
    assert_false(gather("A", "C", at, why));
    assert_string_equal(why, "both lines have to be on one chip, these are on dev/gpiochip0 and dev/gpiochip2");
    assert_false(gather("A", "A", at, why));
    assert_string_equal(why, "both are line 0 of dev/gpiochip0");
}

static void a_chip_that_is_not_for_us(void **state) {
    (void)state;
    chips_place at[2];
    char why[LINES_WHY] = "", want[LINES_WHY];
    assert_int_equal(chmod("dev/gpiochip1", 0660), 0);
    assert_false(gather("B", NULL, at, why));
    const struct group *group = getgrgid(getgid());
    snprintf(want, sizeof want,
             "no such line on 2 GPIO chips; dev/gpiochip1: Permission denied (it is for the group %s)",
             group ? group->gr_name : "?");
    assert_string_equal(why, want);
    assert_int_equal(chmod("dev/gpiochip1", 0640), 0); // reading is not enough
    assert_false(gather("B", NULL, at, why));
    assert_string_equal(why, "no such line on 2 GPIO chips; dev/gpiochip1: Permission denied (no group may use it: it "
                             "needs a udev rule)");
    chips_refused("dev/gpiochip9", ENOENT, why, sizeof why);
    assert_string_equal(why, "dev/gpiochip9: No such file or directory");
}

// Two paths of one device are one chip; two files are not.
static void a_chip_with_two_paths(void **state) {
    (void)state;
    chips_place at[2];
    char why[LINES_WHY] = "";
    lines_spec specs[2] = {{.chip = "/dev/null", .offset = 1}, {.chip = "dev/null", .offset = 2}};
    assert_int_equal(symlink("/dev/null", "dev/null"), 0);
    assert_true(chips_gather(specs, 2, find, at, why));
    specs[1].offset = 1;
    assert_false(chips_gather(specs, 2, find, at, why));
    assert_string_equal(why, "both are line 1 of /dev/null");
    specs[1].chip = "/dev/zero";
    assert_false(chips_gather(specs, 2, find, at, why));
    assert_string_equal(why, "both lines have to be on one chip, these are on /dev/null and /dev/zero");
    specs[0].chip = "dev/gpiochip0", specs[1].chip = "dev/gpiochip2"; // files, no devices
    assert_false(chips_gather(specs, 2, find, at, why));
}

static void reasons(void **state) {
    (void)state;
    char why[LINES_WHY];
    chips_explain(EBUSY, "onewire", true, why);
    assert_string_equal(why, "busy: in use by onewire");
    chips_explain(EBUSY, NULL, true, why);
    assert_string_equal(why, "Device or resource busy");
    chips_explain(ENXIO, NULL, true, why); // not "No such device": it is there
    assert_string_equal(why, "the chip has no interrupt for it, so its edges are not seen (No such device or address)");
    chips_explain(ENXIO, NULL, false, why);
    assert_string_equal(why, "No such device or address");
}

// Edges by the wall clock keep their order and distance; those by the steady clock stay.
static void clocks(void **state) {
    (void)state;
    const int64_t now = INT64_C(5000000000000), wall = INT64_C(1700000000123456789);
    assert_true(chips_steady(now - 7, now, wall) == now - 7);
    assert_true(chips_steady(now - INT64_C(60000000000), now, wall) == now - INT64_C(60000000000));
    assert_true(chips_steady(wall - 2000, now, wall) == now - 2000);
    assert_true(chips_steady(wall - 1000, now, wall) == now - 1000);
    assert_true(chips_steady(wall + 1000, now, wall) == now); // the wall clock was set back meanwhile
}

static int enter(void **state) {
    (void)state;
    char folder[] = "/tmp/skv-chips-XXXXXX", path[32];
    if (!mkdtemp(folder) || chdir(folder) != 0 || mkdir("dev", 0700) != 0)
        return -1;
    for (int i = 2; i >= 0; i--) {
        snprintf(path, sizeof path, "dev/gpiochip%d", i);
        FILE *file = fopen(path, "w");
        if (!file || fclose(file) != 0)
            return -1;
    }
    return 0;
}

static int leave(void **state) {
    (void)state;
    char folder[64];
    static const char *const files[] = {"dev/gpiochip0", "dev/gpiochip1", "dev/gpiochip2", "dev/null", "dev"};
    for (int i = 0; i < 5; i++)
        remove(files[i]);
    return getcwd(folder, sizeof folder) && chdir("/") == 0 ? rmdir(folder) : -1;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_are_found_by_name),
        cmocka_unit_test(a_chip_that_is_not_for_us),
        cmocka_unit_test(a_chip_with_two_paths),
        cmocka_unit_test(reasons),
        cmocka_unit_test(clocks),
    };
    return cmocka_run_group_tests(tests, enter, leave);
}
