/// Light gathered at a point, and the next order from it.
///
/// As printed, each of the 30 samples of each of the 262144 paths gathers over 30 x 30 directions: 7e9 lookups an
/// order. The table has no azimuth, so the phase function's sum over azimuths is done once per pair of zenith angles,
/// and a lookup is linear in altitude and sun: gathering commutes with interpolating. So G is found once per altitude,
/// sun and ELEK_TURNS zenith angles, and interpolated. That differs from the printed order of loops by the
/// interpolation between zenith angles alone; tests/baselines measures it.
#include "elek09.h"

enum {
    POLAR = ELEK_SAMPLES - 2, ///< samples of the zenith angle whose sine is not 0
    ROUND = ELEK_SAMPLES - 1, ///< intervals over all azimuths: the last sample is the first
};

/// [ELEK_TURNS][POLAR][KINDS]
size_t elek_kernel_size(void) {
    return (size_t)ELEK_TURNS * POLAR * ELEK_KINDS;
}

static double polar(int j) {
    return BASELINE_PI * (j + 1) / (ELEK_SAMPLES - 1);
}

/// Phase function between a direction at zenith angle `a` and sample j, summed over azimuths, times solid angle.
static double share_of(const baseline_air *air, int kind, double a, int j) {
    const double solid = sin(polar(j)) * BASELINE_PI / (ELEK_SAMPLES - 1) * 2.0 * BASELINE_PI / ROUND;
    double sum = 0.0;
    for (int i = 0; i < ROUND; i++) {
        const double across = sin(a) * sin(polar(j)) * cos(2.0 * BASELINE_PI * i / ROUND);
        sum += elek_phase(air, kind, fmin(fmax(across + cos(a) * cos(polar(j)), -1.0), 1.0));
    }
    return sum * solid;
}

double elek_gather_begin(elek_build *build) {
    double worst = 0.0;
    for (int m = 0; m < ELEK_TURNS; m++)
        for (int kind = 0; kind < ELEK_KINDS; kind++) {
            double row = 0.0;
            for (int j = 0; j < POLAR; j++) {
                const double share = share_of(build->air, kind, BASELINE_PI * m / (ELEK_TURNS - 1), j);
                build->kernel[(m * POLAR + j) * ELEK_KINDS + kind] = (float)share;
                row += share / (4.0 * BASELINE_PI);
            }
            worst = fmax(worst, baseline_air_has(build->air, kind) ? row : 0.0);
        }
    return worst;
}

/// The order at hand towards the samples of the zenith angle, from one altitude under one sun.
static void read_column(const elek_build *build, size_t u, size_t w, elek_light at[POLAR]) {
    const elek_light *const column = build->order + (u * ELEK_W + w) * ELEK_V;
    for (int j = 0; j < POLAR; j++) {
        float t;
        const int i = elek_cell_v(cos(polar(j)), &t);
        for (int kind = 0; kind < ELEK_KINDS; kind++)
            for (int b = 0; b < 4; b++) {
                const float low = column[i].of[kind][b];
                at[j].of[kind][b] = low + t * (column[i + 1].of[kind][b] - low);
            }
    }
}

static void gather(const elek_light at[POLAR], const float *kernel, elek_light *sum) {
    memset(sum, 0, sizeof *sum);
    for (int j = 0; j < POLAR; j++)
        for (int kind = 0; kind < ELEK_KINDS; kind++)
            for (int b = 0; b < 4; b++)
                sum->of[kind][b] += kernel[j * ELEK_KINDS + kind] * at[j].of[kind][b];
}

void elek_gather_column(void *context, size_t w) {
    elek_build *const build = context;
    for (size_t u = 0; u < ELEK_U; u++) {
        elek_light at[POLAR];
        read_column(build, u, w, at);
        for (size_t m = 0; m < ELEK_TURNS; m++)
            gather(at, build->kernel + m * POLAR * ELEK_KINDS, &build->gathered[(u * ELEK_W + w) * ELEK_TURNS + m]);
    }
}

/// Where a sample looks up what was gathered, but for the sun.
typedef struct spot {
    const elek_light *row; ///< of the lower altitude, the sun's first, the lower zenith angle
    float tu, tm;
} spot;

static spot spot_of(const elek_build *build, const elek_sample *at) {
    spot here;
    const double turn = acos(at->mu) * ((ELEK_TURNS - 1) / BASELINE_PI);
    const size_t m = turn < ELEK_TURNS - 2 ? (size_t)turn : ELEK_TURNS - 2;
    const size_t u = (size_t)elek_cell_u(build->air, build->literal, at->altitude, &here.tu);
    here.row = build->gathered + u * ELEK_W * ELEK_TURNS + m;
    here.tm = (float)(turn - (double)m);
    return here;
}

/// What was gathered at a spot under a sun, interpolated.
static void gathered_at(const spot *here, int literal, double mu_s, elek_light *out) {
    float tw;
    const size_t w = (size_t)elek_cell_w(literal, mu_s, &tw);
    memset(out, 0, sizeof *out);
    for (size_t corner = 0; corner < 4; corner++) {
        const float share = (corner / 2 ? here->tu : 1.0f - here->tu) * (corner % 2 ? tw : 1.0f - tw);
        const elek_light *const at = here->row + (corner / 2 * ELEK_W + w + corner % 2) * ELEK_TURNS;
        for (int kind = 0; kind < ELEK_KINDS; kind++)
            for (int b = 0; b < 4; b++)
                out->of[kind][b] += share * (at[0].of[kind][b] + here->tm * (at[1].of[kind][b] - at[0].of[kind][b]));
    }
}

static void again(const elek_build *build, const elek_sample sample[ELEK_SAMPLES], const spot at[ELEK_SAMPLES],
                  double mu_s, elek_light *cell) {
    elek_light sum = {{{0.0f}}}, here;
    for (int k = 0; k < ELEK_SAMPLES; k++) {
        gathered_at(&at[k], build->literal, elek_sun_at(sample, &sample[k], mu_s), &here);
        for (int kind = 0; kind < ELEK_KINDS; kind++)
            for (int b = 0; b < 4; b++)
                sum.of[kind][b] += sample[k].density[kind] * sample[k].left[b] * here.of[kind][b];
    }
    for (int kind = 0; kind < ELEK_KINDS; kind++)
        for (int b = 0; b < 4; b++)
            cell->of[kind][b] = build->beta[kind][b] * sum.of[kind][b];
}

void elek_again_path(void *context, size_t path) {
    elek_build *const build = context;
    const size_t u = path / ELEK_V, v = path % ELEK_V;
    elek_sample sample[ELEK_SAMPLES];
    spot at[ELEK_SAMPLES];
    elek_samples(build, elek_u_inverse(build->air, (double)u / (ELEK_U - 1)), elek_v_inverse((double)v / (ELEK_V - 1)),
                 sample);
    for (int k = 0; k < ELEK_SAMPLES; k++)
        at[k] = spot_of(build, &sample[k]);
    for (size_t w = 0; w < ELEK_W; w++)
        again(build, sample, at, elek_w_inverse((double)w / (ELEK_W - 1)),
              &build->order[(u * ELEK_W + w) * ELEK_V + v]);
}
