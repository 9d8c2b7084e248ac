/// Figures of a run: counts and histograms of fixed size.
#ifndef COCKPIT_STATS_H
#define COCKPIT_STATS_H

#include <stdint.h>
#include <stdio.h>

/// Of durations: 24 steps a factor of two, from 1 us to 17 s.
enum { COCKPIT_STEPS = 24 * 24 };

typedef struct cockpit_histogram {
    uint32_t count[COCKPIT_STEPS];
    uint64_t total;
} cockpit_histogram;

void cockpit_histogram_add(cockpit_histogram *h, int64_t ns);
/// The duration that this share of all stays within, ms, within 3 %; 0 where there are none.
double cockpit_histogram_ms(const cockpit_histogram *h, double share);

enum { COCKPIT_PENDING = 256 };

typedef struct cockpit_stats {
    int64_t start_ns, start_cpu_ns;
    uint64_t frames;    ///< published
    uint64_t late;      ///< ticks of the timer that were missed
    uint64_t skipped;   ///< ticks without a frame, because the machine is too slow for all
    uint64_t refused;   ///< frames that the core refused: a defect
    double evaluate_ms; ///< processor time of a frame, recent mean
    int64_t rss_kb_early;
    cockpit_histogram latency, evaluate;
    int64_t pending[COCKPIT_PENDING]; ///< arrivals that no published frame has shown yet
    int pending_count;
    uint64_t pending_lost;
    int64_t newest_ns; ///< the last arrival, 0: none
} cockpit_stats;

void cockpit_stats_begin(cockpit_stats *s);
/// A frame from the bus that changes the sky arrived.
void cockpit_stats_arrived(cockpit_stats *s, int64_t arrived_ns);
/// A sky was published: what had arrived by `until_ns` is in it.
void cockpit_stats_published(cockpit_stats *s, int64_t until_ns, int64_t now_ns);
void cockpit_stats_evaluated(cockpit_stats *s, int64_t cpu_ns);

/// Processor time of this process, ns, and its memory, KB (0 where the system does not say).
int64_t cockpit_cpu_ns(void);
int64_t cockpit_rss_kb(void);

#endif
