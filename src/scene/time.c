/// UTC as day and seconds, the calendar, and angular arguments in fixed point.
#include "scene/ephemeris.h"

#include <stddef.h>

#define DAY_MIN          (-36525)
#define DAY_MAX          36890
#define TICKS_PER_SECOND 32768.0f

/// Largest floats below 86400 and 86401: a time that rounds up must not become the next day, or a leap second.
#define LAST_OF_DAY         86399.9921875f
#define LAST_OF_LEAP_SECOND 86400.9921875f

static int is_leap(int year) {
    return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
}

static int days_in_month(int year, int month) {
    static const signed char days[12] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    return month == 2 && is_leap(year) ? 29 : days[month - 1];
}

/// Days from 2000-01-01 to January 1 of a year >= 1601: 365 a year and the leap days before it.
static int32_t day_of_year_start(int32_t year) {
    const int32_t y = year - 1;
    return 365 * (year - 2000) + (y / 4 - y / 100 + y / 400) - (1999 / 4 - 1999 / 100 + 1999 / 400);
}

static int is_time(int hour, int minute, float second) {
    const float end = hour == 23 && minute == 59 ? 61.0f : 60.0f;
    return hour >= 0 && hour < 24 && minute >= 0 && minute < 60 && second >= 0.0f && second < end;
}

skv_status skv_utc_from_calendar(skv_utc *utc, int year, int month, int day, int hour, int minute, float second) {
    if (utc == NULL)
        return SKV_ERR_NULL;
    if (year < 1900 || year > 2100 || month < 1 || month > 12 || day < 1 || day > days_in_month(year, month) ||
        !is_time(hour, minute, second))
        return SKV_ERR_RANGE;
    int32_t days = day_of_year_start(year) + day - 1;
    for (int m = 1; m < month; m++)
        days += days_in_month(year, m);
    const float last = second < 60.0f ? LAST_OF_DAY : LAST_OF_LEAP_SECOND;
    const float seconds = (float)(hour * 3600 + minute * 60) + second;
    utc->day = days;
    utc->seconds = seconds < last ? seconds : last;
    return SKV_OK;
}

static int is_utc(const skv_utc *utc) {
    return utc->day >= DAY_MIN && utc->day <= DAY_MAX && utc->seconds >= 0.0f && utc->seconds < 86401.0f;
}

skv_status skv_utc_to_calendar(skv_calendar *calendar, const skv_utc *utc) {
    if (calendar == NULL || utc == NULL)
        return SKV_ERR_NULL;
    if (!is_utc(utc))
        return SKV_ERR_RANGE;
    skv_calendar c = {1899, 1, 1, 0, 0, 0.0f};
    while (utc->day >= day_of_year_start(c.year + 1))
        c.year++;
    int32_t rest = utc->day - day_of_year_start(c.year);
    for (; rest >= days_in_month(c.year, c.month); c.month++)
        rest -= days_in_month(c.year, c.month);
    c.day = rest + 1;
    const int32_t whole = (int32_t)utc->seconds;
    const int32_t minutes = whole < 86400 ? whole / 60 : 1439; // a leap second is 23:59:60
    c.hour = minutes / 60;
    c.minute = minutes % 60;
    c.second = utc->seconds - (float)(minutes * 60); // exact: both are multiples of the float step
    *calendar = c;
    return SKV_OK;
}

skv_status skv_instant_from_utc(skv_instant *instant, const skv_utc *utc) {
    if (!is_utc(utc))
        return SKV_ERR_RANGE;
    const uint32_t whole = (uint32_t)utc->seconds;
    const float fraction = utc->seconds - (float)whole;
    instant->day = utc->day;
    instant->ticks = whole * (uint32_t)TICKS_PER_SECOND + (uint32_t)(fraction * TICKS_PER_SECOND);
    instant->centuries = ((float)utc->day + (utc->seconds * (1.0f / 86400.0f) - 0.5f)) * (1.0f / 36525.0f);
    return SKV_OK;
}

/// Exact in wrapping integers, whatever the signs; the lower half only carries.
skv_turn skv_argument_at(const skv_argument *argument, const skv_instant *instant) {
    const uint64_t days = (uint64_t)(int64_t)instant->day;
    const uint64_t turns = argument->base + argument->per_day * days + argument->per_tick * instant->ticks;
    return (skv_turn)(turns >> 32);
}

skv_turn skv_linear_at(skv_linear_name name, const skv_instant *instant) {
    const skv_linear_argument *linear = &skv_linear[name];
    const float t = instant->centuries;
    return skv_argument_at(&linear->argument, instant) + skv_turn_from_units(linear->square * t * t);
}

float skv_harmonics_at(const skv_harmonic *harmonics, int count, const skv_instant *instant) {
    float sum = 0.0f;
    for (int i = count - 1; i >= 0; i--) { // smallest first
        const skv_harmonic *h = &harmonics[i];
        const float amplitude = h->amplitude + h->trend * instant->centuries;
        sum += amplitude * skv_sincos_of_turn(skv_argument_at(&h->argument, instant)).cos;
    }
    return sum;
}

skv_turn skv_turn_from_units(float units) {
    return (skv_turn)(int32_t)units;
}

/// Whole degrees to the nearest unit (90 is exactly a quarter), the rest in float.
skv_turn skv_turn_from_deg(float deg) {
    const int32_t whole = (int32_t)deg;
    const uint64_t turns = (uint64_t)(int64_t)whole * UINT64_C(0x00b60b60b60b60b6); // 2^64/360
    return (skv_turn)((turns + 0x80000000u) >> 32) + skv_turn_from_units((deg - (float)whole) * SKV_TURN_PER_DEG);
}

/// The quadrant is taken off in integers: the float angle is at most pi/4, and multiples of 90 degrees are exact.
skv_sincos skv_sincos_of_turn(skv_turn turn) {
    const uint32_t quadrant = (turn + 0x20000000u) >> 30;
    const uint32_t rest = turn - (quadrant << 30);
    const int32_t units = rest < 0x80000000u ? (int32_t)rest : -(int32_t)(0u - rest);
    const float angle = (float)units * SKV_RAD_PER_TURN;
    const skv_sincos a = skv_sincosf(angle);
    switch (quadrant & 3u) {
    case 0:
        return a;
    case 1:
        return (skv_sincos){a.cos, -a.sin};
    case 2:
        return (skv_sincos){-a.sin, -a.cos};
    default:
        return (skv_sincos){-a.cos, a.sin};
    }
}
