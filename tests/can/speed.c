// How fast frames are decoded and encoded: speed [SECONDS]. The sum of what was decoded is printed, so nothing is left
// out.
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "port/canaerospace/skv_canaerospace.h"

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

#define FRAMES (256 * (SKV_CAS_MESSAGES - 3)) // of each number all message codes, so that the log goes round
static skv_can_frame log_of[FRAMES];

// Every number in turn, as its type of the table; every 16th frame is damaged.
static void fill(void) {
    skv_cas_sender sender = {.node = 17};
    for (int n = 0, i = 0; n < FRAMES; i = (i + 1) % SKV_CAS_MESSAGES) {
        skv_can_frame f[2];
        if (skv_cas_table[i].low >= skv_cas_table[i].high)
            continue;
        if (skv_cas_encode(&sender, (skv_cas_index)i, 0, (double)skv_cas_table[i].high * 0.5, f) != 1)
            abort();
        if (n % 16 == 15)
            f[0].data[2] = 7;
        log_of[n++] = f[0];
    }
}

int main(int argc, char **argv) {
    static skv_cas_receiver receiver;
    const double seconds = argc > 1 ? atof(argv[1]) : 0.3;
    double best = 0.0, sum = 0.0, all = 0.0;
    int64_t t = 0;
    fill();
    for (const double start = now(); now() - start < seconds;) {
        const double begin = now();
        for (int n = 0; n < FRAMES; n++)
            (void)skv_cas_receive(&receiver, &log_of[n], t += 1000000);
        const double rate = FRAMES / (now() - begin) * 1e-6;
        best = rate > best ? rate : best;
        all += FRAMES;
        sum += receiver.slot[SKV_CAS_LATITUDE].value;
    }
    const double accepted = (double)receiver.total[SKV_CAS_ACCEPTED] / all;
    printf("figure: CANaerospace: %.1f frames decoded per microsecond (best of %.1f s; %.1f %% accepted, one in 16 is "
           "damaged; "
           "sum %.0f)\n",
           best, seconds, 100.0 * accepted, sum);
    if (accepted < 0.93 || accepted > 0.94) // 15 of 16
        return 1;
    return 0;
}
