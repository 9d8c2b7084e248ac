/// `skyvert sun`: where sun and moon stand.
#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "csv.h"
#include "place.h"

static const char help[] =
    "usage: skyvert sun --lat D --lon D --utc ISO8601 [OPTION...]\n"
    "       skyvert sun --position TEXT --utc ISO8601 [OPTION...]\n"
    "       skyvert sun --csv [OPTION...] < moments.csv > angles.csv\n\n"
    "Where sun and moon stand, as lines `name value unit`. Azimuth is clockwise from north; elevations are\n"
    "geometric (without air) but for sun_elevation_refracted_deg; the moon is topocentric (parallax included);\n"
    "moon_phase is the illuminated fraction.\n\n"
    "  --lat D, --lon D       degrees, -90 to 90 and -360 to 360, north and east positive\n"
    "  --position TEXT        instead: decimal, DMS, UTM/UPS or MGRS, like \"47:27:32N 8:32:2E\"\n"
    "  --height-m M           -12000 to 1e9 (0)\n"
    "  --height-datum msl|ellipsoid\n"
    "                         what heights are above: the sea or the WGS 84 ellipsoid (msl)\n"
    "  --utc ISO8601          like 2021-08-17T04:30:00Z or 2021-08-17T06:30:00.5+02:00; years 1900 to 2100\n"
    "  --pressure-hpa P       for the refraction, 0 to 2000 (standard air at the height)\n"
    "  --temperature-c T      -100 to 100 (standard air at the height)\n"
    "  --csv                  rows with the columns utc,lat_deg,lon_deg,height_m in any order from the standard\n"
    "                         input, or from the file named behind the options; answers are a CSV, too. All rows\n"
    "                         are checked before the first byte of output\n"
    "  -h, --help             this text\n"
    "  -V, --version          the version\n\n"
    "Exit status: 0 done, 1 writing failed, 2 bad input (nothing is written).\n";

enum { WITH_LAT = 1, WITH_LON = 2, WITH_POSITION = 4, WITH_UTC = 8, WITH_HEIGHT = 16 };

typedef struct settings {
    unsigned with; ///< WITH_* bits
    bool csv;
    double lat_deg, lon_deg, height_m;
    int datum;
    double pressure_hpa, temperature_c; ///< NaN: standard air
    utc_time utc;
} settings;

/// What is printed, in this order.
enum { AZIMUTH, ELEVATION, REFRACTED, DISTANCE, MOON_AZIMUTH, MOON_ELEVATION, MOON_PHASE, MOON_ANGLE, VALUES };

static const struct {
    const char *name, *unit;
    int decimals;
} values[VALUES] = {
    {"sun_azimuth_deg", "deg", 4}, {"sun_elevation_deg", "deg", 4},    {"sun_elevation_refracted_deg", "deg", 4},
    {"sun_distance_au", "au", 6},  {"moon_azimuth_deg", "deg", 4},     {"moon_elevation_deg", "deg", 4},
    {"moon_phase", "1", 4},        {"moon_phase_angle_deg", "deg", 4},
};

/// Rounding must not make 360 of an azimuth below it, nor a minus of a zero.
static void format_value(int which, double value, char text[32]) {
    const double scale = pow(10, values[which].decimals);
    double v = floor(value * scale + .5) / scale;
    if ((which == AZIMUTH || which == MOON_AZIMUTH) && v >= 360)
        v -= 360;
    snprintf(text, 32, "%.*f", values[which].decimals, v + 0.);
}

/// The 110 m that sea and ellipsoid are apart at most move the moon by 2e-5 deg and standard air by 1 %: without a
/// geoid grid the answers stay right.
static void set_height(place *at, double height_m, const settings *s) {
    (void)place_set_height_roughly(at, height_m, (height_datum)s->datum);
}

/// @return NULL, or what is wrong
static const char *compute(const settings *s, const utc_time *time, const place *at, double out[VALUES]) {
    const skv_utc utc = utc_to_skv(time);
    const skv_position position = place_to_skv(at);
    skv_sun sun;
    skv_moon moon;
    if (skv_sun_at(&sun, &utc, &position) != SKV_OK || skv_moon_at(&moon, &utc, &position) != SKV_OK)
        return "the core refuses this place or moment";
    double pressure, temperature;
    standard_air(at->msl_m, &pressure, &temperature);
    pressure = isnan(s->pressure_hpa) ? pressure : s->pressure_hpa;
    temperature = isnan(s->temperature_c) ? temperature : s->temperature_c;
    const float refraction = skv_refraction_deg(sun.elevation_deg, (float)pressure, (float)temperature);
    const double computed[VALUES] = {
        (double)sun.azimuth_deg,           (double)sun.elevation_deg,   (double)sun.elevation_deg + (double)refraction,
        (double)sun.distance_au,           (double)moon.azimuth_deg,    (double)moon.elevation_deg,
        (double)moon.illuminated_fraction, (double)moon.phase_angle_deg};
    memcpy(out, computed, sizeof computed);
    return NULL;
}

// --- one place and moment ---

static int print_one(const settings *s) {
    place at = {.lat_deg = s->lat_deg, .lon_deg = s->lon_deg};
    double v[VALUES];
    set_height(&at, s->height_m, s);
    const char *const wrong = compute(s, &s->utc, &at, v);
    if (wrong)
        return fail_usage("skyvert sun: %s", wrong);
    for (int i = 0; i < VALUES; i++) {
        char text[32];
        format_value(i, v[i], text);
        printf("%s %s %s\n", values[i].name, text, values[i].unit);
    }
    return output_finish_stdout();
}

// --- rows ---

enum { COLUMN_UTC, COLUMN_LAT, COLUMN_LON, COLUMN_HEIGHT, COLUMNS };
static const char *const column_names[COLUMNS] = {"utc", "lat_deg", "lon_deg", "height_m"};

/// Answers wait in a file until all rows are checked: any number of rows, no partial output.
typedef struct rows {
    const settings *s;
    csv_reader csv;
    csv_columns columns;
    bad_rows bad;
    FILE *answers;
} rows;

static bool take_number(rows *r, int column, double low, double high, double *value) {
    const char *const text = r->csv.field[r->columns.place[column]];
    if (parse_number(text, value) && *value >= low && *value <= high)
        return true;
    bad_row(&r->bad, r->csv.line, "%s = %.40s: allowed is a number from %g to %g", column_names[column],
            *text ? text : "(nothing)", low, high);
    return false;
}

static bool parse_row(rows *r, utc_time *time, place *at) {
    const char *const problem = csv_row_problem(&r->csv, &r->columns);
    if (problem) {
        bad_row(&r->bad, r->csv.line, "%s", problem);
        return false;
    }
    const char *const utc = r->csv.field[r->columns.place[COLUMN_UTC]];
    const char *const wrong = utc_parse(utc, time);
    double height_m;
    if (wrong) {
        bad_row(&r->bad, r->csv.line, "utc = %.40s: %s", *utc ? utc : "(nothing)", wrong);
        return false;
    }
    if (!take_number(r, COLUMN_LAT, -90, 90, &at->lat_deg) || !take_number(r, COLUMN_LON, -360, 360, &at->lon_deg) ||
        !take_number(r, COLUMN_HEIGHT, HEIGHT_LOW_M, HEIGHT_HIGH_M, &height_m))
        return false;
    set_height(at, height_m, r->s);
    return true;
}

static void answer_row(rows *r, const utc_time *time, const place *at) {
    double v[VALUES];
    const char *const wrong = compute(r->s, time, at, v);
    if (wrong) {
        bad_row(&r->bad, r->csv.line, "%s", wrong);
        return;
    }
    for (int c = 0; c < COLUMNS; c++)
        fprintf(r->answers, "%s%s", c ? "," : "", r->csv.field[r->columns.place[c]]);
    for (int i = 0; i < VALUES; i++) {
        char text[32];
        format_value(i, v[i], text);
        fprintf(r->answers, ",%s", text);
    }
    fputc('\n', r->answers);
}

static int answer_rows(rows *r) {
    const int result = csv_header(&r->csv, &r->columns);
    if (result)
        return result;
    while (csv_next(&r->csv)) {
        utc_time time;
        place at = {0};
        if (parse_row(r, &time, &at) && r->bad.count == 0)
            answer_row(r, &time, &at);
    }
    if (r->csv.failed)
        return csv_read_failed(&r->csv);
    return bad_rows_end(&r->bad);
}

static int copy_answers(FILE *answers) {
    char block[65536];
    size_t n;
    for (int c = 0; c < COLUMNS; c++)
        printf("%s%s", c ? "," : "", column_names[c]);
    for (int i = 0; i < VALUES; i++)
        printf(",%s", values[i].name);
    putchar('\n');
    rewind(answers);
    while ((n = fread(block, 1, sizeof block, answers)) > 0)
        fwrite(block, 1, n, stdout);
    return output_finish_stdout();
}

static int print_rows(const settings *s, FILE *stream, const char *name) {
    rows r = {.s = s, .columns = {.names = column_names, .count = COLUMNS}, .bad = {.name = name}};
    r.answers = tmpfile();
    if (!r.answers)
        return fail_job("skyvert sun: no temporary file: %s", strerror(errno));
    int result = csv_begin(&r.csv, stream, name) ? answer_rows(&r) : fail_job("skyvert sun: out of memory");
    csv_end(&r.csv);
    if (result == 0)
        result = fflush(r.answers) == 0 && !ferror(r.answers)
                     ? copy_answers(r.answers)
                     : fail_job("skyvert sun: the temporary file cannot be written");
    fclose(r.answers);
    return result;
}

static int print_csv(const settings *s, int argc, char **argv) {
    if (s->with)
        return fail_usage("skyvert sun: --csv takes utc, position and height from its rows; allowed beside it are "
                          "--height-datum, --pressure-hpa and --temperature-c");
    const char *const name = optind < argc ? argv[optind++] : "-";
    const int more = option_no_more("sun", argc, argv);
    if (more)
        return more;
    if (strcmp(name, "-") == 0)
        return print_rows(s, stdin, "stdin");
    FILE *const stream = fopen(name, "rb");
    if (!stream)
        return fail_usage("%.200s: cannot be read: %s", name, strerror(errno));
    const int result = print_rows(s, stream, name);
    fclose(stream);
    return result;
}

// --- options ---

static const struct option options[] = {{"lat", required_argument, NULL, 'a'},
                                        {"lon", required_argument, NULL, 'o'},
                                        {"position", required_argument, NULL, 'p'},
                                        {"height-m", required_argument, NULL, 'm'},
                                        {"height-datum", required_argument, NULL, 'd'},
                                        {"utc", required_argument, NULL, 'u'},
                                        {"pressure-hpa", required_argument, NULL, 'P'},
                                        {"temperature-c", required_argument, NULL, 'T'},
                                        {"csv", no_argument, NULL, 'c'},
                                        {"help", no_argument, NULL, 'h'},
                                        {"version", no_argument, NULL, 'V'},
                                        {NULL, 0, NULL, 0}};

static int take_utc(settings *s) {
    const char *const wrong = utc_parse(optarg, &s->utc);
    return wrong ? fail_usage("skyvert sun: --utc %.60s: %s", optarg, wrong) : 0;
}

static int take_option(int letter, settings *s) {
    switch (letter) {
    case 'a':
        s->with |= WITH_LAT;
        return option_number("sun", "lat", optarg, -90, 90, &s->lat_deg);
    case 'o':
        s->with |= WITH_LON;
        return option_number("sun", "lon", optarg, -360, 360, &s->lon_deg);
    case 'p':
        s->with |= WITH_POSITION;
        return place_parse("sun", optarg, &s->lat_deg, &s->lon_deg);
    case 'm':
        s->with |= WITH_HEIGHT;
        return option_number("sun", "height-m", optarg, HEIGHT_LOW_M, HEIGHT_HIGH_M, &s->height_m);
    case 'd':
        return option_choice("sun", "height-datum", optarg, height_datum_names, &s->datum);
    case 'u':
        s->with |= WITH_UTC;
        return take_utc(s);
    case 'P':
        return option_number("sun", "pressure-hpa", optarg, 0, 2000, &s->pressure_hpa);
    case 'T':
        return option_number("sun", "temperature-c", optarg, -100, 100, &s->temperature_c);
    default:
        s->csv = true;
        return 0;
    }
}

static int check_one(const settings *s, int argc, char **argv) {
    const int more = option_no_more("sun", argc, argv);
    if (more)
        return more;
    if (s->with & WITH_POSITION && s->with & (WITH_LAT | WITH_LON))
        return fail_usage("skyvert sun: --position and --lat, --lon: allowed is one or the other");
    if (!(s->with & WITH_POSITION) && (s->with & (WITH_LAT | WITH_LON)) != (WITH_LAT | WITH_LON))
        return fail_usage("skyvert sun: --%s is missing; needed are --lat and --lon, or --position",
                          s->with & WITH_LAT ? "lon" : "lat");
    if (!(s->with & WITH_UTC))
        return fail_usage("skyvert sun: --utc is missing; needed is a moment like 2021-08-17T04:30:00Z");
    return 0;
}

int cmd_sun(int argc, char **argv) {
    settings s = {.datum = HEIGHT_MSL, .pressure_hpa = (double)NAN, .temperature_c = (double)NAN};
    for (int letter; (letter = getopt_long(argc, argv, ":hV", options, NULL)) != -1;) {
        if (letter == 'h') {
            fputs(help, stdout);
            return output_finish_stdout();
        }
        if (letter == 'V')
            return option_version();
        const int bad = letter == '?' || letter == ':' ? option_unknown("sun", letter, argv) : take_option(letter, &s);
        if (bad)
            return bad;
    }
    int result = s.csv ? 0 : check_one(&s, argc, argv);
    if (result == 0)
        result = s.csv ? print_csv(&s, argc, argv) : print_one(&s);
    place_end();
    return result;
}
