/// Figures of a run as a file.
#include "cockpit_loop.h"

static void line(FILE *f, const char *name, double value, const char *unit) {
    fprintf(f, "%s %.6g %s\n", name, value, unit);
}

static void counts(FILE *f, const cockpit *c) {
    const skv_can_counts n = cockpit_bus_counts(&c->bus);
    line(f, "received", (double)n.received, "frames");
    line(f, "dropped", (double)n.dropped, "frames");
    line(f, "error_frames", (double)n.error_frames, "frames");
    line(f, "bus_offs", c->bus.bus_offs, "times");
    for (int i = 0; i < SKV_CAS_COUNTS; i++) {
        char name[40];
        snprintf(name, sizeof name, "can_%s", skv_cas_count_name((skv_cas_count)i));
        for (char *at = name; *at; at++)
            *at = *at == ' ' ? '_' : *at;
        line(f, name, c->state.cas.total[i], "frames");
    }
}

int cockpit_stats_write(const cockpit *c, const char *path) {
    output out;
    const cockpit_stats *const s = &c->stats;
    const double run_s = 1e-9 * (double)(cockpit_mono_ns() - s->start_ns),
                 cpu_s = 1e-9 * (double)(cockpit_cpu_ns() - s->start_cpu_ns);
    const int status = output_open(&out, path);
    if (status != 0)
        return status;
    FILE *const f = out.stream;
    line(f, "run", run_s, "s");
    line(f, "frames", (double)s->frames, "frames");
    line(f, "frames_late", (double)s->late, "frames");
    line(f, "frames_skipped", (double)s->skipped, "frames");
    line(f, "frames_refused", (double)s->refused, "frames");
    line(f, "level", c->sky.level, "of 4, 0 = as told");
    line(f, "tables_built", c->sky.builds, "tables");
    line(f, "vertices", c->sky.vertices, "vertices");
    line(f, "latency_median", cockpit_histogram_ms(&s->latency, 0.5), "ms from frame received to vertices published");
    line(f, "latency_p99", cockpit_histogram_ms(&s->latency, 0.99), "ms");
    line(f, "latency_frames", (double)s->latency.total, "frames");
    line(f, "evaluate_median", cockpit_histogram_ms(&s->evaluate, 0.5), "ms processor time a frame");
    line(f, "evaluate_p99", cockpit_histogram_ms(&s->evaluate, 0.99), "ms");
    line(f, "processor", 100.0 * cpu_s / run_s, "% of one core");
    line(f, "memory_early", (double)s->rss_kb_early, "KB resident after 3 s");
    line(f, "memory", (double)cockpit_rss_kb(), "KB resident");
    line(f, "knob_position", c->panel.position, "quarter steps");
    line(f, "knob_invalid", c->panel.invalid, "transitions");
    line(f, "button_presses", c->panel.presses, "presses");
    line(f, "button_bounces", c->panel.bounces, "edges");
    counts(f, c);
    return output_commit(&out);
}
