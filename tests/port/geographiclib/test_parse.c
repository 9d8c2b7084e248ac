/// The position parser: every form, every refusal, UTM and MGRS against a projection of the test's own, and rubbish.
#include <stdio.h>
#include <string.h>

#include "check.h"
#include "port/geographiclib/skv_geo.h"
#include "wgs84.h"

typedef struct {
    const char *text;
    double lat_deg, lon_deg, tolerance_deg;
} good_case;

#define ZURICH (47 + 27 / 60. + 32 / 3600.), (8 + 32 / 60. + 2 / 3600.)
// Rounding of the decimal input and of sums of three parts.
#define EXACT 1e-13

static const good_case good[] = {
    {"47.46, 8.55", 47.46, 8.55, EXACT},
    {"47.46 8.55", 47.46, 8.55, EXACT},
    {"  47.46\t8.55 ", 47.46, 8.55, EXACT},
    {"-33.9 151.2", -33.9, 151.2, EXACT},
    {"+33.9,-151.2", 33.9, -151.2, EXACT},
    {"0 0", 0, 0, 0},
    {"90 180", 90, 180, 0},
    {"-90 -180", -90, -180, 0},
    {"47 359", 47, -1, EXACT},
    {"47:27:32N 8:32:2E", ZURICH, EXACT},
    {"47:27:32n 8:32:2e", ZURICH, EXACT},
    {"47d27'32\"N 8d32'2\"E", ZURICH, EXACT},
    {"47\xc2\xb0"
     "27\xe2\x80\xb2"
     "32\xe2\x80\xb3N 8\xc2\xb0"
     "32\xe2\x80\xb2"
     "2\xe2\x80\xb3"
     "E",
     ZURICH, EXACT},
    {"47\xc2\xb0 27' 32\" N, 8\xc2\xb0 32' 2\" E", ZURICH, EXACT},
    {"47 27 32 N 8 32 2 E", ZURICH, EXACT},
    {"N 47 27 32 E 8 32 2", ZURICH, EXACT},
    {"E8:32:02 N47:27:32", ZURICH, EXACT},
    {"8:32:2E 47:27:32N", ZURICH, EXACT},
    {"8E 47 N", 47, 8, 0},
    {"47 N 8E", 47, 8, 0},
    {"47N8E", 47, 8, 0},
    {"16:46:33N 3:00:34W", 16.7758333333333333, -3.00944444444444444, EXACT},
    {"33:54S 151:12E", -33.9, 151.2, EXACT},
    {"47:27:32 8:32:2", ZURICH, EXACT},
    {"-33:54 151:12", -33.9, 151.2, EXACT},
    {"47.5N, 8.25", 47.5, 8.25, 0},
    // Aeronautical charts and IGC records
    {"472732N 0083202E", ZURICH, EXACT},
    {"472732N0083202E", ZURICH, EXACT},
    {"4727.5N 00832.25E", 47 + 27.5 / 60, 8 + 32.25 / 60, EXACT},
    {"N4727 E00832", 47 + 27 / 60., 8 + 32 / 60., EXACT},
    // The example of GeographicLib's GeoConvert(1), printed there with five decimals: the middle of a 1 km square
    {"38SMB4488", 33.33424, 44.40363, 5e-6},
    {"38smb4488", 33.33424, 44.40363, 5e-6},
    {"38S MB 44 88", 33.33424, 44.40363, 5e-6},
    {"38SMB 44 88", 33.33424, 44.40363, 5e-6},
    {"38n 444500 3688500", 33.33424, 44.40363, 5e-6},
    {"444500 3688500 38n", 33.33424, 44.40363, 5e-6},
    {"38north 444500 3688500", 33.33424, 44.40363, 5e-6},
    {"38R 444500 3500000", 31.63344, 44.41496, 5e-4},
    // On a central meridian and the equator nothing is left to project
    {"31n 500000 0", 0, 3, 1e-12},
    {"31s 500000 10000000", 0, 3, 1e-12},
    {"n 2000000 2000000", 90, 180, 1e-12},
    {"A 2000000 2000000", -90, 0, 1e-12},
};

typedef struct {
    const char *text, *reason;
} bad_case;

static const bad_case bad[] = {
    {"", "nothing in it"},
    {" , ", "nothing in it"},
    {"47", "1 part"},
    {"47 8 9", "3 parts"},
    {"LSZH", "'LSZH' is no angle"},
    {"hello world", "'hello' is no angle"},
    {"nan nan", "'nan' is no angle"},
    {"inf, 8", "'inf' is no angle"},
    {"1e1 8", "Illegal character"},
    {"7.0E+1, 8", "sign and a hemisphere"},
    {"91, 8", "latitude 91 is outside [-90, 90]"},
    {"-90.0001 8", "latitude -90.0001 is outside"},
    {"91N 8E", "latitude 91 is outside"},
    {"90:0:1N 8E", "is outside [-90, 90]"},
    {"47 361", "longitude 361 is outside [-180, 360]"},
    {"47N 180:00:01W", "is outside [-180, 360]"},
    {"47:60:00N 8E", "60"},
    {"47:75N 8E", "75"},
    {"47N 48N", "two latitudes"},
    {"8E 9W", "two longitudes"},
    {"-47N 8E", "sign and a hemisphere"},
    {"47-27N 8E", "sign and a hemisphere"},
    {"47-27 8", "sign inside"},
    {"47,46N 8,55E", "comma"},
    {"47,46 8,55", "4 parts"},
    {"47::27 8", "minutes"},
    {"0n 465000 5256000", "zone 0"},
    {"61n 465000 5256000", "zone 61"},
    {"32I 465000 5256000", "no latitude band I"},
    {"32C 465000 5256000", "outside band C"},
    {"32U 465000 5256000", "outside band U"},
    {"32S 465000 4000000", "southern hemisphere or band S"},
    {"32n 1e6 5256000", "Illegal character e"},
    {"32n 465000 5256000 7", "4 parts"},
    {"32n 9465000 5256000", "Easting"},
    {"32n 465000 99256000", "Northing"},
    {"32n 46.5.0 5256000", "no number of metres"},
    {"32T", "too coarse"},
    {"32TMT", "too coarse"},
    {"32TMT650", "even number"},
    {"32T MT 6500 56000", "different numbers of digits"},
    {"32TII6500056000", "Column letter I"},
    {"99TMT6500056000", "99"},
};

static int one_line(const char *message) {
    return message[0] && !strchr(message, '\n') && strlen(message) < SKV_GEO_MESSAGE;
}

static void test_good(void **unused) {
    (void)unused;
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        double lat = 99, lon = 99;
        char message[SKV_GEO_MESSAGE] = "";
        if (skv_geo_parse(good[i].text, &lat, &lon, message, sizeof message) != SKV_OK)
            fail_msg("'%s' refused: %s", good[i].text, message);
        check_near(good[i].text, lat, good[i].lat_deg, good[i].tolerance_deg);
        const double turn = fabs(lon - good[i].lon_deg) > 180 ? 360 : 0; // the pole's and the date line's longitudes
        check_near(good[i].text, fabs(lon - good[i].lon_deg) - turn, 0, good[i].tolerance_deg);
    }
}

static void test_bad(void **unused) {
    (void)unused;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        double lat = 99, lon = 98;
        char message[SKV_GEO_MESSAGE] = "";
        const skv_status status = skv_geo_parse(bad[i].text, &lat, &lon, message, sizeof message);
        if (status != SKV_ERR_RANGE || lat != 99 || lon != 98)
            fail_msg("'%s': status %d, position %g %g", bad[i].text, status, lat, lon);
        if (!strstr(message, bad[i].reason) || !strstr(message, "allowed: ") || !one_line(message))
            fail_msg("'%s': got '%s', want '%s'", bad[i].text, message, bad[i].reason);
    }
}

static void test_arguments(void **unused) {
    (void)unused;
    double lat = 1, lon = 2;
    char message[8] = "xxxxxxx", most[300];
    assert_int_equal(skv_geo_parse(NULL, &lat, &lon, NULL, 0), SKV_ERR_NULL);
    assert_int_equal(skv_geo_parse("1 2", NULL, &lon, NULL, 0), SKV_ERR_NULL);
    assert_int_equal(skv_geo_parse("1 2", &lat, NULL, NULL, 0), SKV_ERR_NULL);
    assert_int_equal(skv_geo_parse("91 2", &lat, &lon, NULL, 0), SKV_ERR_RANGE);
    assert_int_equal(skv_geo_parse("91 2", &lat, &lon, message, 0), SKV_ERR_RANGE);
    assert_true(message[0] == 'x'); // a size of 0 writes nothing
    assert_int_equal(skv_geo_parse("91 2", &lat, &lon, message, sizeof message), SKV_ERR_RANGE);
    assert_int_equal((int)strlen(message), 7); // cut, and terminated
    memset(most, ' ', sizeof most);
    memcpy(most, "1 2", 3);
    most[200] = '\0';
    assert_int_equal(skv_geo_parse(most, &lat, &lon, NULL, 0), SKV_OK);
    most[200] = ' ';
    most[201] = '\0';
    assert_int_equal(skv_geo_parse(most, &lat, &lon, NULL, 0), SKV_ERR_RANGE);
}

static void must_parse(const char *text, double *lat, double *lon) {
    char message[SKV_GEO_MESSAGE] = "";
    if (skv_geo_parse(text, lat, lon, message, sizeof message) != SKV_OK)
        fail_msg("'%s' refused: %s", text, message);
}

/// Distance on the map of a zone between a parsed position and where it should be.
static double map_error(double lat, double lon, double meridian, double easting, double northing) {
    double x, y;
    to_utm(lat, lon - meridian, &x, &y);
    return hypot(x - easting, y - northing);
}

static void test_utm_against_series(void **unused) {
    (void)unused;
    uint64_t seed = 1;
    double worst = 0;
    for (int i = 0; i < 4000; i++) {
        const double lat = draw(&seed, -79.9, 83.9), meridian = -177 + 6 * floor(draw(&seed, 0, 60));
        double x, y, got_lat, got_lon;
        to_utm(lat, draw(&seed, -3, 3), &x, &y);
        const double north = lat >= 0 ? 0 : 1e7;
        const int zone = (int)((meridian + 183) / 6);
        const char band = "CDEFGHJKLMNPQRSTUVWXX"[(int)((lat + 80) / 8)];
        char text[80];
        // Where band S could be meant, the hemisphere must be spelt.
        if (i % 2 || band == 'S')
            snprintf(text, sizeof text, "%d%s %.4f %.4f", zone, lat >= 0 ? "n" : "s", x, y + north);
        else
            snprintf(text, sizeof text, "%.4f %.4f %d%c", x, y + north, zone, band);
        must_parse(text, &got_lat, &got_lon);
        const double error = map_error(got_lat, got_lon, meridian, x, y);
        worst = error > worst ? error : worst;
    }
    check_at_most("UTM against Krueger's series, m", worst, 1e-4); // four printed decimals of a metre
}

static void test_mgrs_against_series(void **unused) {
    (void)unused;
    static const char *const columns[3] = {"ABCDEFGH", "JKLMNPQR", "STUVWXYZ"};
    uint64_t seed = 2;
    double worst = 0;
    for (int i = 0; i < 4000; i++) {
        // South of Norway's and Svalbard's irregular zones.
        const double lat = draw(&seed, -79.9, 55.9), lon = draw(&seed, -180, 180);
        const int zone = (int)((lon + 180) / 6) + 1;
        double x, y, got_lat, got_lon;
        to_utm(lat, lon - (6 * zone - 183), &x, &y);
        const double shifted = lat >= 0 ? y : y + 1e7;
        const int column = (int)(x / 1e5) - 1, row = ((int)(shifted / 1e5) + (zone % 2 ? 0 : 5)) % 20;
        char text[80];
        snprintf(text, sizeof text, "%d%c%c%c%05d%05d", zone, "CDEFGHJKLMNPQRSTUVWXX"[(int)((lat + 80) / 8)],
                 columns[(zone - 1) % 3][column], "ABCDEFGHJKLMNPQRSTUV"[row], (int)x % 100000, (int)shifted % 100000);
        must_parse(text, &got_lat, &got_lon);
        const double error =
            map_error(got_lat, got_lon, 6 * zone - 183, floor(x) + .5, floor(shifted) + .5 - (shifted - y));
        worst = error > worst ? error : worst;
    }
    check_at_most("MGRS against Krueger's series, m", worst, 1e-4); // the middle of the square, exactly
}

static char any_byte(uint64_t *seed) {
    return (char)(unsigned char)draw(seed, 1, 256);
}

/// Pieces of the parser's own alphabet, in any order.
static void make_rubbish(uint64_t *seed, char *text, size_t size) {
    static const char *const piece[] = {"47",
                                        "8.55",
                                        "-",
                                        "+",
                                        "N",
                                        "S",
                                        "E",
                                        "W",
                                        "n",
                                        "s",
                                        ":",
                                        "'",
                                        "\"",
                                        "d",
                                        " ",
                                        ",",
                                        "32",
                                        "32T",
                                        "MT",
                                        "6500056000",
                                        "465000",
                                        "5256000",
                                        "\xc2\xb0",
                                        "\xe2\x80\xb2",
                                        "\xff",
                                        ".",
                                        "nan",
                                        "inf",
                                        "north",
                                        "0",
                                        "9999999999999999999999",
                                        "1e9",
                                        "\t",
                                        "\n",
                                        "%s%n",
                                        "A",
                                        "Z",
                                        "INV",
                                        "x",
                                        "INVALID"};
    const int pieces = (int)draw(seed, 0, 14);
    for (int k = 0; k < pieces; k++) {
        const char any[2] = {any_byte(seed), '\0'};
        const size_t which = (size_t)draw(seed, 0, 1.2 * sizeof piece / sizeof piece[0]);
        strncat(text, which < sizeof piece / sizeof piece[0] ? piece[which] : any, size - strlen(text) - 1);
    }
}

/// A good position with up to three bytes changed, or cut.
static void make_slip(uint64_t *seed, char *text, size_t size) {
    snprintf(text, size, "%s", good[(size_t)draw(seed, 0, sizeof good / sizeof good[0])].text);
    const int slips = (int)draw(seed, 0, 4);
    for (int k = 0; k < slips; k++)
        text[(size_t)draw(seed, 0, (double)strlen(text) + 1)] =
            draw(seed, 0, 1) < .5 ? " 0123456789.:NSEW-,d"[(size_t)draw(seed, 0, 21)] : any_byte(seed);
    text[size - 1] = '\0';
}

/// Every answer is a position or one line, and never both.
static void test_rubbish(void **unused) {
    (void)unused;
    uint64_t seed = 3;
    int accepted = 0;
    for (int i = 0; i < 20000; i++) {
        char text[260] = "", message[SKV_GEO_MESSAGE] = "";
        (i % 2 ? make_rubbish : make_slip)(&seed, text, sizeof text);
        double lat = 99, lon = 98;
        const skv_status status = skv_geo_parse(text, &lat, &lon, message, sizeof message);
        accepted += status == SKV_OK;
        if (status == SKV_OK ? !(fabs(lat) <= 90 && fabs(lon) <= 180)
                             : status != SKV_ERR_RANGE || lat != 99 || lon != 98 || !one_line(message))
            fail_msg("'%s': status %d, position %g %g, message '%s'", text, status, lat, lon, message);
    }
    print_message("note: 20000 random strings, %d of them positions\n", accepted);
    assert_true(accepted > 2000 && accepted < 18000); // else one side of the parser is not reached
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_good),
        cmocka_unit_test(test_bad),
        cmocka_unit_test(test_arguments),
        cmocka_unit_test(test_utm_against_series),
        cmocka_unit_test(test_mgrs_against_series),
        cmocka_unit_test(test_rubbish),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
