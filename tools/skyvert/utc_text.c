/// ISO 8601 moments, Gregorian calendar.
#include <math.h>
#include <string.h>

#include "command.h"

#define EPOCH_DAYS 730425 // 2000-01-01 as days since 0000-03-01

/// Days since 2000-01-01: years are counted from March, so that the leap day is a year's last.
static int32_t days_from_calendar(int year, int month, int day) {
    const int y = month > 2 ? year : year - 1;
    const int m = (month + 9) % 12;
    return 365 * y + y / 4 - y / 100 + y / 400 + (153 * m + 2) / 5 + day - 1 - EPOCH_DAYS;
}

static int month_days(int year, int month) {
    static const int days[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    const bool leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
    return days[month - 1] + (month == 2 && leap);
}

/// Exactly n digits. @return behind them, or NULL (also for NULL)
static const char *digits(const char *c, int n, int *value) {
    if (!c)
        return NULL;
    *value = 0;
    for (int i = 0; i < n; i++, c++) {
        if (*c < '0' || *c > '9')
            return NULL;
        *value = 10 * *value + (*c - '0');
    }
    return c;
}

static const char *character(const char *c, const char *set) {
    return c && *c && strchr(set, *c) ? c + 1 : NULL;
}

/// The fraction of the seconds behind a point or comma, if there is one.
static const char *fraction(const char *c, double *value) {
    if (!c || (*c != '.' && *c != ','))
        return c;
    double scale = .1;
    const char *first = ++c;
    for (; *c >= '0' && *c <= '9'; c++, scale /= 10)
        *value += scale * (*c - '0');
    return c == first ? NULL : c;
}

typedef struct moment {
    int year, month, day, hour, minute, second, zone_minutes;
    double fraction;
} moment;

/// Z, z, +hh:mm, +hhmm, +hh or nothing, then the end.
static bool scan_zone(const char *c, int *zone_minutes) {
    int hours = 0, minutes = 0;
    if (*c == '+' || *c == '-') {
        const int sign = *c == '-' ? -1 : 1;
        c = digits(c + 1, 2, &hours);
        if (c && *c == ':')
            c = digits(c + 1, 2, &minutes);
        else if (c && *c)
            c = digits(c, 2, &minutes);
        if (!c || hours > 14 || minutes > 59)
            return false;
        *zone_minutes = sign * (60 * hours + minutes);
    } else if (*c == 'Z' || *c == 'z') {
        c++;
    }
    return *c == '\0';
}

static bool scan(const char *c, moment *m) {
    c = character(digits(c, 4, &m->year), "-");
    c = character(digits(c, 2, &m->month), "-");
    c = digits(c, 2, &m->day);
    if (!c || *c == '\0')
        return c != NULL;
    c = character(digits(character(c, "T t"), 2, &m->hour), ":");
    c = digits(c, 2, &m->minute);
    if (c && *c == ':')
        c = fraction(digits(c + 1, 2, &m->second), &m->fraction);
    return c && scan_zone(c, &m->zone_minutes);
}

static const char *check(const moment *m) {
    if (m->year < 1900 || m->year > 2100)
        return "no such year here: allowed is 1900 to 2100";
    if (m->month < 1 || m->month > 12)
        return "no such month: allowed is 01 to 12";
    if (m->day < 1 || m->day > month_days(m->year, m->month))
        return "no such day in that month";
    if (m->hour > 23 || m->minute > 59 || m->second > 60)
        return "no such time of day: allowed is 00:00:00 to 23:59:60";
    return NULL;
}

const char *utc_parse(const char *text, utc_time *time) {
    moment m = {0};
    while (*text == ' ' || *text == '\t')
        text++;
    char copy[48];
    size_t length = strlen(text);
    while (length > 0 && (text[length - 1] == ' ' || text[length - 1] == '\t'))
        length--;
    const char *const form = "no ISO 8601 moment: allowed is like 2021-08-17T04:30:00Z";
    if (length >= sizeof copy)
        return form;
    memcpy(copy, text, length);
    copy[length] = '\0';
    if (!scan(copy, &m))
        return form;
    const char *const wrong = check(&m);
    if (wrong)
        return wrong;
    // A leap second is 23:59:60 in UTC, other hours elsewhere.
    const int minutes = 60 * m.hour + m.minute - m.zone_minutes;
    if (m.second == 60 && (minutes + 1440) % 1440 != 1439)
        return "no such second: allowed is 00 to 59, a leap second only at 23:59:60 UTC";
    const int shift = minutes < 0 ? -1 : minutes >= 1440 ? 1 : 0;
    const int32_t day = days_from_calendar(m.year, m.month, m.day) + shift;
    if (day < days_from_calendar(1900, 1, 1) || day > days_from_calendar(2100, 12, 31))
        return "no such year here: allowed is 1900 to 2100 in UTC";
    time->day = day;
    time->seconds = 60. * (minutes - 1440 * shift) + m.second + m.fraction;
    return NULL;
}

void utc_calendar(const utc_time *time, int *year, int *month, int *day, int *hour, int *minute, double *second) {
    const bool leap_second = time->seconds >= 86400;
    const int whole = leap_second ? 86399 : (int)time->seconds;
    *hour = whole / 3600;
    *minute = whole / 60 % 60;
    *second = time->seconds - 3600 * *hour - 60 * *minute;
    const int32_t days = time->day + EPOCH_DAYS; // > 0 within 1900 to 2100
    const int32_t era = days / 146097, of_era = days % 146097;
    const int32_t y = (of_era - of_era / 1460 + of_era / 36524 - of_era / 146096) / 365;
    const int32_t of_year = of_era - (365 * y + y / 4 - y / 100);
    const int32_t m = (5 * of_year + 2) / 153;
    *day = of_year - (153 * m + 2) / 5 + 1;
    *month = m < 10 ? m + 3 : m - 9;
    *year = y + 400 * era + (*month <= 2);
}

char *utc_text(const utc_time *time, char text[UTC_TEXT_SIZE]) {
    utc_time rounded = *time;
    rounded.seconds = floor(1000 * time->seconds + .5) / 1000;
    if (time->seconds < 86400 && rounded.seconds >= 86400)
        rounded = (utc_time){time->day + 1, 0};
    int year, month, day, hour, minute;
    double second;
    utc_calendar(&rounded, &year, &month, &day, &hour, &minute, &second);
    const int milli = (int)floor(1000 * second + .5);
    int n =
        snprintf(text, UTC_TEXT_SIZE, "%04d-%02d-%02dT%02d:%02d:%02d", year, month, day, hour, minute, milli / 1000);
    if (milli % 1000)
        n += snprintf(text + n, UTC_TEXT_SIZE - (size_t)n, ".%03d", milli % 1000);
    snprintf(text + n, UTC_TEXT_SIZE - (size_t)n, "Z");
    return text;
}

utc_time utc_add(const utc_time *time, double seconds) {
    const double s = time->seconds + seconds;
    const double days = floor(s / 86400);
    return (utc_time){time->day + (int32_t)days, s - 86400 * days};
}

double utc_difference(const utc_time *later, const utc_time *earlier) {
    return 86400. * (later->day - earlier->day) + (later->seconds - earlier->seconds);
}

skv_utc utc_to_skv(const utc_time *time) {
    return (skv_utc){time->day, (float)time->seconds};
}
