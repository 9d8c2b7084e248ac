/// `skyvert track`: the skies along a recorded flight.
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "command.h"
#include "contact_sheet.h"
#include "flight.h"
#include "picture.h"

#define NAME      "track"
#define STEPS_MAX 100000

typedef struct track_options {
    sky_options sky;
    picture_options picture;
    const char *out, *input;
    double every_s;
    int datum, altitude;
} track_options;

enum { OPT_OUT = 1300, OPT_EVERY, OPT_IGC_ALTITUDE };

static const struct option long_options[] = {SKY_OPTIONS_LONG,
                                             PICTURE_OPTIONS_LONG,
                                             {"every", required_argument, NULL, OPT_EVERY},
                                             {"height-datum", required_argument, NULL, OPT_HEIGHT_DATUM},
                                             {"igc-altitude", required_argument, NULL, OPT_IGC_ALTITUDE},
                                             {"out", required_argument, NULL, OPT_OUT},
                                             {"help", no_argument, NULL, 'h'},
                                             {NULL, 0, NULL, 0}};

// clang-format off
static const char help[] =
    "usage: skyvert track FLIGHT.csv|FLIGHT.igc --every 60s --out DIR [OPTION...]\n\n"
    "The skies along a flight, into DIR (made if it is not there):\n"
    "  sky-00000-20210817T124324Z.exr ...  linear light, one a step, numbered, named by the moment\n"
    "  contact-sheet.png                   small pictures, each exposed by itself unless --exposure K is given\n"
    "  track.csv                           per step: time, place, sun, luminance of the zenith, exposure, file,\n"
    "                                      magnitude of a star just seen in the zenith, moon\n"
    "Files of an earlier run with the same names are replaced, each one whole. After Ctrl-C the pictures that\n"
    "were done are there, the sheet and the CSV of an earlier run untouched.\n\n"
    "  --every T              time between pictures: 60s, 5min, 1h or plain seconds, 0.001 s to 1 day\n"
    "  --out DIR              the folder\n"
    "  --height-datum msl|ellipsoid  what a CSV's height_m is above (default msl, the sea)\n"
    "  --igc-altitude gnss|pressure  gnss (default): the receiver's, above the ellipsoid unless the file says\n"
    "                         GEO, and the pressure altitude where a fix has none (validity V); pressure:\n"
    "                         the barometer's at 1013.25 hPa, taken as above the sea\n\n"
    "CSV: columns utc,lat_deg,lon_deg,height_m in any order. IGC: B records, dates from HFDTE. Between two\n"
    "fixes the way is a great circle. Time must not go backwards.\n\n";
// clang-format on

static int print_help(void) {
    printf("%s%s\n%s\n%s", help, picture_options_help, light_options_help, sky_options_help);
    return output_finish_stdout();
}

static int take_every(track_options *options, const char *value) {
    static const struct {
        const char *name;
        double seconds;
    } unit[] = {{"s", 1.0}, {"min", 60.0}, {"m", 60.0}, {"h", 3600.0}, {"", 1.0}};
    char number[32];
    const size_t length = strspn(value, "+-.0123456789");
    if (length < sizeof number) {
        memcpy(number, value, length);
        number[length] = '\0';
        for (size_t i = 0; i < sizeof unit / sizeof unit[0]; i++) {
            double count;
            if (strcmp(value + length, unit[i].name) != 0 || !parse_number(number, &count))
                continue;
            options->every_s = count * unit[i].seconds;
            if (options->every_s >= 0.001 && options->every_s <= 86400.0)
                return 0;
        }
    }
    return fail_usage("skyvert track: --every '%.40s': like 60s, 5min or 1h, from 0.001 s to 24 h", value);
}

static int take(track_options *options, int c, char **argv) {
    static const char *const altitudes[] = {"gnss", "pressure", NULL};
    int status;
    switch (c) {
    case OPT_OUT:
        options->out = optarg;
        return 0;
    case OPT_EVERY:
        return take_every(options, optarg);
    case OPT_HEIGHT_DATUM:
        return option_choice(NAME, "--height-datum", optarg, height_datum_names, &options->datum);
    case OPT_IGC_ALTITUDE:
        return option_choice(NAME, "--igc-altitude", optarg, altitudes, &options->altitude);
    default:
        status = sky_options_take(&options->sky, c, optarg);
        if (status < 0)
            status = picture_options_take(&options->picture, c, optarg);
        return status < 0 ? option_unknown(NAME, c, argv) : status;
    }
}

// ---- the job

typedef struct job {
    const track_options *options;
    flight track;
    size_t steps, hint;
    scene view;
    contact_sheet sheet;
    output table;
} job;

/// DIR/name in `path`. @return false iff it does not fit
static bool path_in(const job *work, const char *name, char *path, size_t size) {
    const int n = snprintf(path, size, "%s/%s", work->options->out, name);
    return n > 0 && (size_t)n < size;
}

static int make_folder(const char *path) {
    struct stat info;
    if (mkdir(path, 0777) == 0 || (errno == EEXIST && stat(path, &info) == 0 && S_ISDIR(info.st_mode)))
        return 0;
    const int error = errno;
    const bool input = error == EEXIST || error == ENOENT || error == ENOTDIR || error == ENAMETOOLONG;
    return (input ? fail_usage : fail_job)("skyvert track: --out %.200s: the folder cannot be made: %s", path,
                                           error == EEXIST ? "a file has that name" : strerror(error));
}

static int step_moment(job *work, size_t step, moment *now) {
    const fix at = flight_at(&work->track, (double)step * work->options->every_s, &work->hint);
    memset(now, 0, sizeof *now);
    now->has_position = now->has_utc = true;
    now->utc = at.utc;
    now->at = (place){.lat_deg = at.lat_deg, .lon_deg = at.lon_deg};
    const int status = moment_set_height(&now->at, at.height_m, HEIGHT_MSL);
    return status != 0 ? status : moment_find_lights(now, NAME);
}

/// sky-00012-20210817T124324Z.exr
static void file_name(size_t step, const utc_time *utc, char *name, size_t size) {
    int year, month, day, hour, minute;
    double second;
    utc_calendar(utc, &year, &month, &day, &hour, &minute, &second);
    snprintf(name, size, "sky-%05zu-%04d%02d%02dT%02d%02d%02dZ.exr", step, year, month, day, hour, minute, (int)second);
}

static void add_row(job *work, const moment *now, double exposure, const char *name) {
    char utc[UTC_TEXT_SIZE];
    const scene_zenith_light zenith = scene_zenith(&work->view);
    fprintf(work->table.stream, "%s,%.7f,%.7f,%.2f,%.4f,%.4f,%.6g,%.6g,%s,%.2f,%.4f,%.4f,%.4f\n",
            utc_text(&now->utc, utc), now->at.lat_deg, now->at.lon_deg, now->at.msl_m, now->sun_azimuth_deg,
            now->sun_elevation_deg, zenith.luminance, exposure, name, zenith.limiting_magnitude,
            (double)now->moon.azimuth_deg, (double)now->moon.elevation_deg, (double)now->moon.illuminated_fraction);
}

static void add_tile(job *work, size_t step, const moment *now, const picture *image, double exposure) {
    int year, month, day, hour, minute;
    double second;
    char line1[32], line2[32];
    utc_calendar(&now->utc, &year, &month, &day, &hour, &minute, &second);
    snprintf(line1, sizeof line1, "%02d:%02d:%02dZ %+.1fKM", hour, minute, (int)second, now->at.msl_m / 1000.0);
    snprintf(line2, sizeof line2, "SUN %+.1f", now->sun_elevation_deg);
    contact_sheet_add(&work->sheet, step, image, exposure, line1, line2);
}

static int do_step(job *work, size_t step) {
    const picture_options *const options = &work->options->picture;
    moment now;
    picture image;
    char name[64], path[4200];
    const scene_plan plan = picture_plan(options);
    int status = step_moment(work, step, &now);
    if (status == 0)
        status = scene_begin(&work->view, &work->options->sky, &now, &plan);
    if (status == 0)
        status = picture_render(&image, options, &work->view, &now, false);
    if (status != 0)
        return status;
    const double exposure = options->exposure_auto ? picture_auto_exposure(&image) : options->exposure;
    file_name(step, &now.utc, name, sizeof name);
    status = path_in(work, name, path, sizeof path) ? picture_write_exr(&image, options, &work->view, &now, path)
                                                    : fail_usage("skyvert track: --out: the path is too long");
    if (status == 0) {
        add_row(work, &now, exposure, name);
        add_tile(work, step, &now, &image, exposure);
    }
    picture_free(&image);
    return status;
}

static int write_sheet(job *work) {
    char path[4200], comment[200];
    snprintf(comment, sizeof comment, "skies along a flight, %zu of %zu steps shown", work->sheet.tiles, work->steps);
    if (!path_in(work, "contact-sheet.png", path, sizeof path))
        return fail_usage("skyvert track: --out: the path is too long");
    return png_write_file(NAME, work->sheet.rgb, work->sheet.width, work->sheet.height, 3, 8, comment, path);
}

static int begin_table(job *work) {
    char path[4200];
    if (!path_in(work, "track.csv", path, sizeof path))
        return fail_usage("skyvert track: --out: the path is too long");
    const int status = output_open(&work->table, path);
    if (status == 0)
        fputs("utc,lat_deg,lon_deg,height_m,sun_azimuth_deg,sun_elevation_deg,zenith_luminance_cd_m2,exposure_k,file,"
              "limiting_magnitude,moon_azimuth_deg,moon_elevation_deg,moon_phase\n",
              work->table.stream);
    return status;
}

static int run(job *work) {
    int status = make_folder(work->options->out);
    if (status == 0 && !contact_sheet_begin(&work->sheet, &work->options->picture.map, work->steps))
        status = fail_job("skyvert track: no memory for the contact sheet");
    if (status == 0)
        status = begin_table(work);
    if (status != 0)
        return status;
    progress_begin("track", work->steps);
    for (size_t step = 0; step < work->steps && status == 0; step++) {
        status = do_step(work, step);
        progress_update(step + 1);
    }
    progress_end();
    if (status == 0)
        status = write_sheet(work);
    if (status == 0)
        return output_commit(&work->table);
    output_discard(&work->table);
    return status;
}

static int count_steps(job *work) {
    const double steps = floor(flight_duration_s(&work->track) / work->options->every_s + 1e-9) + 1.0;
    if (steps > STEPS_MAX)
        return fail_usage("skyvert track: --every %g s: %.0f pictures of this flight; at most %d",
                          work->options->every_s, steps, STEPS_MAX);
    work->steps = (size_t)steps;
    return 0;
}

static void report(const job *work) {
    char text[400];
    printf("%zu skies in %s from %zu fixes", work->steps, work->options->out, work->track.count);
    if (work->track.ignored > 0)
        printf(" (%zu without a position left out)", work->track.ignored);
    putchar('\n');
    if (work->options->sky.timing)
        fprintf(stderr, "%s\n", scene_timing(&work->view, text, sizeof text));
}

static int track(const track_options *options) {
    static job work;
    work.options = options;
    int status =
        flight_read(&work.track, options->input, options->datum == HEIGHT_ELLIPSOID, (igc_altitude)options->altitude);
    if (status != 0)
        return status;
    status = count_steps(&work);
    if (status == 0)
        status = run(&work);
    if (status == 0)
        report(&work);
    scene_end(&work.view);
    contact_sheet_end(&work.sheet);
    flight_free(&work.track);
    return status == 0 ? output_finish_stdout() : status;
}

static int check(track_options *options, int argc, char **argv) {
    if (optind >= argc)
        return fail_usage("skyvert track: a flight is needed: FLIGHT.csv or FLIGHT.igc");
    options->input = argv[optind++];
    int status = option_no_more(NAME, argc, argv);
    if (status == 0 && !options->out)
        status = fail_usage("skyvert track: --out DIR is needed");
    if (status == 0 && !(options->every_s > 0.0))
        status = fail_usage("skyvert track: --every is needed, like --every 60s");
    if (status == 0)
        status = picture_options_finish(&options->picture, 256);
    return status == 0 ? sky_options_finish(&options->sky) : status;
}

int cmd_track(int argc, char **argv) {
    static track_options options;
    sky_options_begin(&options.sky, NAME);
    picture_options_begin(&options.picture, NAME);
    int status = 0;
    for (int c; status == 0 && (c = getopt_long(argc, argv, ":h", long_options, NULL)) != -1;) {
        if (c == 'h')
            return print_help();
        status = take(&options, c, argv);
    }
    if (status == 0)
        status = check(&options, argc, argv);
    if (status != 0)
        return status;
    status = track(&options);
    place_end();
    sky_options_free(&options.sky);
    return status;
}
