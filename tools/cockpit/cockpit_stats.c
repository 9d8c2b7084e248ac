#define _POSIX_C_SOURCE 200809L
#include "cockpit_stats.h"

#include <math.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "cockpit.h"

void cockpit_histogram_add(cockpit_histogram *h, int64_t ns) {
    const double us = ns > 1000 ? 1e-3 * (double)ns : 1.0;
    const int step = (int)(24.0 * log2(us));
    h->count[step < COCKPIT_STEPS ? step : COCKPIT_STEPS - 1]++;
    h->total++;
}

double cockpit_histogram_ms(const cockpit_histogram *h, double share) {
    const double wanted = share * (double)h->total;
    double sum = 0.0;
    if (h->total == 0)
        return 0.0;
    for (int i = 0; i < COCKPIT_STEPS; i++) {
        sum += h->count[i];
        if (sum >= wanted)
            return 1e-3 * exp2((i + 0.5) / 24.0);
    }
    return 0.0;
}

int64_t cockpit_cpu_ns(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (int64_t)t.tv_sec * 1000000000 + t.tv_nsec;
}

int64_t cockpit_rss_kb(void) {
    long long all = 0, resident = 0;
    FILE *const f = fopen("/proc/self/statm", "r");
    if (!f)
        return 0;
    const int got = fscanf(f, "%lld %lld", &all, &resident);
    fclose(f);
    return got == 2 ? resident * (sysconf(_SC_PAGESIZE) / 1024) : 0;
}

void cockpit_stats_begin(cockpit_stats *s) {
    memset(s, 0, sizeof *s);
    s->start_ns = cockpit_mono_ns();
    s->start_cpu_ns = cockpit_cpu_ns();
}

void cockpit_stats_arrived(cockpit_stats *s, int64_t arrived_ns) {
    s->newest_ns = arrived_ns > s->newest_ns ? arrived_ns : s->newest_ns;
    if (s->pending_count < COCKPIT_PENDING)
        s->pending[s->pending_count++] = arrived_ns;
    else
        s->pending_lost++;
}

void cockpit_stats_published(cockpit_stats *s, int64_t until_ns, int64_t now_ns) {
    int kept = 0;
    for (int i = 0; i < s->pending_count; i++) {
        if (s->pending[i] <= until_ns)
            cockpit_histogram_add(&s->latency, now_ns - s->pending[i]);
        else
            s->pending[kept++] = s->pending[i];
    }
    s->pending_count = kept;
    s->frames++;
    if (s->rss_kb_early == 0 && now_ns - s->start_ns > 3000000000)
        s->rss_kb_early = cockpit_rss_kb();
}

void cockpit_stats_evaluated(cockpit_stats *s, int64_t cpu_ns) {
    const double ms = 1e-6 * (double)cpu_ns;
    s->evaluate_ms = s->evaluate_ms > 0 ? s->evaluate_ms + 0.05 * (ms - s->evaluate_ms) : ms;
    cockpit_histogram_add(&s->evaluate, cpu_ns);
}
