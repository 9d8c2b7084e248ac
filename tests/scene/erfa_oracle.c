#include "erfa_oracle.h"

#include <erfa.h>
#include <erfam.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define AU_KM 149597870.7

/// A status < 0 is a wrong call; > 0 is ERFA's remark that the leap seconds of that year are not known.
static void need(int status, const char *what) {
    if (status >= 0)
        return;
    fprintf(stderr, "oracle: %s gives %d\n", what, status);
    abort();
}

static void utc_to_julian(const skv_utc *utc, double jd[2]) {
    int y, m, d;
    double fraction;
    need(eraJd2cal(2451544.5, utc->day, &y, &m, &d, &fraction), "eraJd2cal");
    const double s = (double)utc->seconds;
    const int minutes = s < 86400 ? (int)(s / 60) : 1439;
    need(eraDtf2d("UTC", y, m, d, minutes / 60, minutes % 60, s - 60 * minutes, &jd[0], &jd[1]), "eraDtf2d");
}

/// From a natural (geometric) BCRS vector to the horizon: aberration, Earth orientation, no air.
static void to_horizon(const double natural[3], eraASTROM *astrom, double enu[3]) {
    double r, unit[3], proper[3], intermediate[3], ra, dec, az, zd, ha, obs_dec, obs_ra;
    double p[3] = {natural[0], natural[1], natural[2]};
    eraPn(p, &r, unit);
    eraAb(unit, astrom->v, astrom->em, astrom->bm1, proper);
    eraRxp(astrom->bpn, proper, intermediate);
    eraC2s(intermediate, &ra, &dec);
    eraAtioq(ra, dec, astrom, &az, &zd, &ha, &obs_dec, &obs_ra);
    enu[0] = sin(zd) * sin(az);
    enu[1] = sin(zd) * cos(az);
    enu[2] = cos(zd);
}

double oracle_angle(const double a[3], const double b[3]) {
    const double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
    return atan2(sqrt(x * x + y * y + z * z), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

/// Light left the moon tau ago: moon and Earth together were elsewhere then.
static void moon_vectors(double tt1, double tt2, const eraASTROM *astrom, double seen[3], double now[3]) {
    double helio[2][3], bary[2][3], moon[2][3];
    eraEpv00(tt1, tt2, helio, bary);
    eraMoon98(tt1, tt2, moon);
    for (int i = 0; i < 3; i++)
        now[i] = moon[0][i] + bary[0][i] - astrom->eb[i];
    const double tau = sqrt(now[0] * now[0] + now[1] * now[1] + now[2] * now[2]) * ERFA_AULT / ERFA_DAYSEC;
    for (int i = 0; i < 3; i++)
        seen[i] = now[i] - tau * (moon[1][i] + bary[1][i]);
}

oracle_sky oracle_at(const skv_utc *utc, const skv_position *position) {
    double jd[2], tai[2], tt[2], eo;
    utc_to_julian(utc, jd);
    need(eraUtctai(jd[0], jd[1], &tai[0], &tai[1]), "eraUtctai");
    need(eraTaitt(tai[0], tai[1], &tt[0], &tt[1]), "eraTaitt");
    eraASTROM astrom;
    need(eraApco13(jd[0], jd[1], 0, (double)position->lon_deg * ERFA_DD2R, (double)position->lat_deg * ERFA_DD2R,
                   (double)position->height_km * 1000, 0, 0, 0, 0, 0, 0.55, &astrom, &eo),
         "eraApco13");
    oracle_sky sky;
    double moon_seen[3], moon_now[3], sun[3], to_sun[3], to_observer[3];
    moon_vectors(tt[0], tt[1], &astrom, moon_seen, moon_now);
    for (int i = 0; i < 3; i++) {
        sun[i] = -astrom.eh[i] * astrom.em;
        to_observer[i] = -moon_now[i];
        to_sun[i] = sun[i] - moon_now[i];
    }
    to_horizon(sun, &astrom, sky.sun.enu);
    to_horizon(moon_seen, &astrom, sky.moon.enu);
    sky.sun.distance_km = astrom.em * AU_KM;
    sky.moon.distance_km = AU_KM * eraPm(moon_now);
    sky.phase_angle_rad = oracle_angle(to_sun, to_observer);
    return sky;
}
