/// Every float through every unary function of src/core/elementary.h: finite whatever goes in, and the claimed error
/// over the claimed domain, at every float of size 2^-14 to 2^10, every 16th beyond (where the bits of the exponent are
/// all that differs). `full_elementary STRIDE [FUNCTION]` looks at every STRIDE-th float. A quarter of an hour on one
/// core.
#include <pthread.h>
#include <stdlib.h>

#include "elementary_cases.h"

#define THREADS 4
#define CLAIMS  3

typedef struct job {
    const unary_case *u;
    const claim *claims;
    int n_claims;
    uint64_t first, step;
    double worst[CLAIMS];
    float worst_at[CLAIMS];
    uint64_t bad;
    float bad_at;
} job;

static void look_at(job *j, float x) {
    // The square root keeps infinity; the polynomials are only for (0, 1].
    const float y = j->u->f(x);
    const bool polynomial = strncmp(j->u->name, "skv_erfcx_p", 11) == 0;
    if (!skv_isfinite(y) && !polynomial && !(j->u->f == skv_sqrtf && x > FLT_MAX)) {
        j->bad++;
        j->bad_at = x;
    }
    const uint32_t exponent = skv_bits(x) >> 23 & 255u;
    if ((exponent < 127 - 14 || exponent > 127 + 10) && (skv_bits(x) >> 2) % 16 != 5) // as many for each thread
        return;
    for (int i = 0; i < j->n_claims; i++) {
        if (!(x >= j->claims[i].lo && x <= j->claims[i].hi))
            continue;
        const double e = case_error(j->u, j->claims[i].relative, x);
        if (!(e <= j->worst[i])) {
            j->worst[i] = e;
            j->worst_at[i] = x;
        }
    }
}

static void *run(void *p) {
    job *const j = p;
    for (uint64_t b = j->first; b < 0x100000000u; b += j->step)
        look_at(j, skv_from_bits((uint32_t)b));
    return NULL;
}

static int check(const unary_case *u, uint64_t stride) {
    claim claims[CLAIMS];
    const int n = find_claims(u->name, claims, CLAIMS);
    pthread_t thread[THREADS];
    job jobs[THREADS];
    int bad = n == 0;
    memset(jobs, 0, sizeof jobs);
    for (int t = 0; t < THREADS; t++) {
        jobs[t] =
            (job){.u = u, .claims = claims, .n_claims = n, .first = (uint64_t)t * stride, .step = THREADS * stride};
        if (pthread_create(&thread[t], NULL, run, &jobs[t]) != 0)
            exit(1);
    }
    for (int t = 0; t < THREADS; t++) {
        pthread_join(thread[t], NULL);
        if (jobs[t].bad) {
            printf("%s(%a) is not finite\n", u->name, (double)jobs[t].bad_at);
            bad = 1;
        }
        for (int i = 0; i < n; i++) {
            if (jobs[t].worst[i] > jobs[0].worst[i]) {
                jobs[0].worst[i] = jobs[t].worst[i];
                jobs[0].worst_at[i] = jobs[t].worst_at[i];
            }
        }
    }
    for (int i = 0; i < n; i++) {
        printf("figure: %s: %s error %.3g on [%g, %g], worst at %a; claimed %.3g\n", u->name,
               claims[i].relative ? "relative" : "absolute", jobs[0].worst[i], (double)claims[i].lo,
               (double)claims[i].hi, (double)jobs[0].worst_at[i], claims[i].bound);
        bad |= !(jobs[0].worst[i] <= claims[i].bound);
    }
    fflush(stdout);
    return bad;
}

int main(int argc, char **argv) {
    const uint64_t stride = argc > 1 ? strtoull(argv[1], NULL, 10) : 1;
    int bad = 0;
    for (size_t i = 0; i < UNARY_CASES; i++)
        if (argc < 3 || strcmp(argv[2], unary_cases[i].name) == 0)
            bad |= check(&unary_cases[i], stride ? stride : 1);
    return bad;
}
