// Which four bytes are a time, a date, a state of the sky.
#include "skv_canaerospace.h"

static int is_time(const uint8_t b[4]) {
    const int last_minute = b[0] == 23 && b[1] == 59;
    return b[0] < 24 && b[1] < 60 && b[2] < (last_minute ? 61 : 60);
}

static int is_date(const uint8_t b[4]) {
    static const uint8_t days[12] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    const int year = 100 * b[2] + b[3];
    if (b[3] > 99 || year < 1900 || year > 2100 || b[1] < 1 || b[1] > 12)
        return 0;
    const int leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    return b[0] >= 1 && b[0] <= days[b[1] - 1] + (b[1] == 2 && leap);
}

int skv_cas_bytes_valid(skv_cas_index index, const uint8_t bytes[4]) {
    if (!bytes)
        return 0;
    switch (index) {
    case SKV_CAS_UTC:
        return is_time(bytes);
    case SKV_CAS_DATE:
        return is_date(bytes);
    case SKV_CAS_SKY_STATE:
        return bytes[0] <= SKV_CAS_NIGHT && bytes[1] <= (SKV_CAS_LAMP_NIGHT | SKV_CAS_LAMP_BUS_FAULT);
    default:
        return 0;
    }
}
