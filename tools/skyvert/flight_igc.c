/// Flights as IGC files (FAI/IGC, Technical Specification for GNSS Flight Recorders, appendix A): the date from HFDTE,
/// a fix from each B record, everything else skipped.
///
///     B HHMMSS DDMMmmmN DDDMMmmmE V PPPPP GGGGG
///     0 1      7        15        24 25    30
///
/// V is the validity: A = three-dimensional fix, V = no GNSS altitude. PPPPP is the pressure altitude (1013.25 hPa),
/// GGGGG the GNSS altitude above the WGS 84 ellipsoid, or above the geoid where a header HFALG says GEO; both in
/// metres.
#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "flight.h"
#include "moment.h"

#define B_RECORD_LENGTH 35
#define LINE_MAX_BYTES  1024

typedef struct igc_reader {
    const char *path;
    long line;
    igc_altitude altitude;
    bool has_date, has_fix,
        date_is_new;  // date_is_new: an HFDTE with another date since the last fix
    bool above_geoid; // GNSS altitudes are above the sea already
    utc_time date;
    int last_second; // of the day
} igc_reader;

static int bad(const igc_reader *igc, const char *what) {
    return fail_usage("%.200s:%ld: %s", igc->path, igc->line, what);
}

/// Decimal digits, all of them, at `from`. @return -1 iff one is not a digit
static int digits(const char *from, int count) {
    int value = 0;
    for (int i = 0; i < count; i++) {
        if (!isdigit((unsigned char)from[i]))
            return -1;
        value = 10 * value + (from[i] - '0');
    }
    return value;
}

/// Five characters, perhaps with a minus in front. @return false iff it is no number
static bool metres(const char *from, double *value) {
    const bool negative = from[0] == '-';
    const int number = negative ? digits(from + 1, 4) : digits(from, 5);
    *value = negative ? -number : number;
    return number >= 0;
}

/// HFDTEDDMMYY or HFDTEDATE:DDMMYY[,NN]; years 80 to 99 are the last century's.
static int read_date(igc_reader *igc, const char *text) {
    while (*text && !isdigit((unsigned char)*text))
        text++;
    const int number = strlen(text) >= 6 ? digits(text, 6) : -1;
    const int year = number % 100;
    char iso[40];
    utc_time date;
    snprintf(iso, sizeof iso, "%04d-%02d-%02d", year + (year < 80 ? 2000 : 1900), number / 100 % 100, number / 10000);
    if (number < 0 || utc_parse(iso, &date) != NULL)
        return bad(igc, "HFDTE: a date DDMMYY is needed");
    igc->date_is_new = !igc->has_date || date.day != igc->date.day;
    if (igc->has_fix && date.day < igc->date.day)
        igc->date_is_new = false; // the first date once more, after midnight
    else
        igc->date = date;
    igc->has_date = true;
    return 0;
}

/// Degrees, whole minutes and thousandths of a minute. @return false iff out of range
static bool angle(const char *from, int degree_digits, int limit, const char *letters, double *value) {
    const int whole = digits(from, degree_digits), thousandths = digits(from + degree_digits, 5);
    const char side = from[degree_digits + 5];
    if (whole < 0 || thousandths < 0 || thousandths >= 60000 || (side != letters[0] && side != letters[1]))
        return false;
    *value = whole + thousandths / 60000.0;
    if (*value > limit)
        return false;
    if (side == letters[1])
        *value = -*value;
    return true;
}

/// Time of day to a moment: a fall of over half a day is midnight, unless a new date came in between.
static int read_time(igc_reader *igc, const char *text, utc_time *utc) {
    const int hour = digits(text, 2), minute = digits(text + 2, 2), second = digits(text + 4, 2);
    if (hour < 0 || hour > 23 || minute < 0 || minute > 59 || second < 0 || second > 59)
        return bad(igc, "B record: a time HHMMSS from 000000 to 235959 is needed");
    if (!igc->has_date)
        return bad(igc, "B record before the date: a record HFDTEDDMMYY is needed first");
    const int of_day = 3600 * hour + 60 * minute + second;
    if (igc->has_fix && !igc->date_is_new && of_day < igc->last_second - 43200)
        igc->date.day++;
    igc->has_fix = true;
    igc->date_is_new = false;
    igc->last_second = of_day;
    *utc = igc->date;
    utc->seconds = of_day;
    return 0;
}

static int read_height(const igc_reader *igc, const char *text, fix *out) {
    double pressure_m = 0.0, gnss_m = 0.0;
    if ((text[24] != 'A' && text[24] != 'V') || !metres(text + 25, &pressure_m) || !metres(text + 30, &gnss_m))
        return bad(igc, "B record: validity A or V and two altitudes of five digits are needed");
    if (igc->altitude == IGC_PRESSURE || text[24] == 'V') {
        out->height_m = pressure_m;
        return 0;
    }
    place at = {.lat_deg = out->lat_deg, .lon_deg = out->lon_deg};
    const int status = moment_set_height(&at, gnss_m, igc->above_geoid ? HEIGHT_MSL : HEIGHT_ELLIPSOID);
    out->height_m = at.msl_m;
    return status;
}

static int read_fix(igc_reader *igc, const char *text, flight *track) {
    fix next;
    if (strlen(text) < B_RECORD_LENGTH)
        return bad(igc, "B record: shorter than 35 characters");
    int status = read_time(igc, text + 1, &next.utc);
    if (status != 0)
        return status;
    if (!angle(text + 7, 2, 90, "NS", &next.lat_deg))
        return bad(igc, "B record: a latitude DDMMmmmN or S up to 90 degrees is needed");
    if (!angle(text + 15, 3, 180, "EW", &next.lon_deg))
        return bad(igc, "B record: a longitude DDDMMmmmE or W up to 180 degrees is needed");
    // Recorders that have not found a satellite yet write zeros.
    if (text[24] == 'V' && next.lat_deg == 0.0 && next.lon_deg == 0.0) {
        track->ignored++;
        return 0;
    }
    status = read_height(igc, text, &next);
    return status != 0 ? status : flight_append(track, &next, igc->path, igc->line);
}

/// HFALG:GEO, HFALGALTGPS:GEO and the like.
static void read_altitude_datum(igc_reader *igc, const char *text) {
    igc->above_geoid = strstr(text, "GEO") != NULL;
}

static int read_record(igc_reader *igc, const char *text, flight *track) {
    if (text[0] == 'B')
        return read_fix(igc, text, track);
    if (strncmp(text, "HFDTE", 5) == 0)
        return read_date(igc, text + 5);
    if (strncmp(text, "HFALG", 5) == 0)
        read_altitude_datum(igc, text + 5);
    return 0;
}

int flight_read_igc(flight *track, const char *path, igc_altitude altitude) {
    FILE *stream = fopen(path, "rb");
    if (!stream)
        return fail_usage("%.200s: cannot be read: %s", path, strerror(errno));
    igc_reader igc = {.path = path, .altitude = altitude};
    char text[LINE_MAX_BYTES];
    int status = 0;
    errno = 0;
    while (status == 0 && fgets(text, sizeof text, stream)) {
        igc.line++;
        const size_t length = strcspn(text, "\r\n");
        if (text[length] == '\0' && !feof(stream))
            status = bad(&igc, "a line of over 1000 bytes: no IGC file");
        text[length] = '\0';
        if (status == 0)
            status = read_record(&igc, text, track);
    }
    if (status == 0 && ferror(stream))
        status = fail_usage("%.200s: cannot be read: %s", path, strerror(errno));
    fclose(stream);
    return status;
}
