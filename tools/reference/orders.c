/// Deals rays out to threads.
#include "orders.h"

#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum {
    ROUND = 4,   // batches between looks at the error
    FEWEST = 24, // batches before the error is believed
    MOST_THREADS = 256
};
#define SAVE_EVERY_S 10.0

static volatile sig_atomic_t interrupted;

static void interrupt(int number) {
    (void)number;
    interrupted = 1;
}

typedef struct pool {
    const ref_tracer *tracer;
    const ref_job *job;
    const ref_query *queries;
    size_t count, next, done;
    ref_total *totals;
    uint64_t digest;
    int failed;
    double start, shown, saved;
    pthread_mutex_t lock;
} pool;

static double now_s(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void show(pool *p, double now) {
    enum { WIDTH = 40 };
    if (now - p->start < 2 || now - p->shown < 0.2 || !isatty(STDERR_FILENO))
        return;
    const int full = (int)(WIDTH * p->done / p->count);
    fprintf(stderr, "\rpaths [%.*s%*s] %zu of %zu rays", full, "########################################", WIDTH - full,
            "", p->done, p->count);
    if (p->done)
        fprintf(stderr, ", %.0f s left ", (now - p->start) * (double)(p->count - p->done) / (double)p->done);
    p->shown = now;
}

static int enough(const pool *p, const ref_view *v, const ref_tally *t) {
    return v->empty || (t->batches >= FEWEST && ref_view_error(v, t) <= p->job->target) ||
           t->batches * REF_BATCH >= p->job->max_paths;
}

// One ray until it is done or the job is interrupted. Errors are looked at after the same batches always.
static void answer(const pool *p, ref_view *v, size_t i, ref_total *total) {
    const ref_query *q = &p->queries[i];
    const double height = q->altitude_km - p->tracer->air.world.atmosphere->ground_km;
    if (ref_view_make(v, p->tracer, height, q->sun_zenith_deg, q->view_zenith_deg, q->azimuth_deg, p->job->lit_ground,
                      p->job->seed) != 0)
        fprintf(stderr, "stdin:%d: single scattering did not converge\n", q->line);
    while (!(total->done = enough(p, v, &total->tally)) && !interrupted)
        for (int k = 0; k < ROUND; k++)
            ref_view_batch(v, &total->tally);
    ref_view_result(v, &total->tally, total->radiance, total->error);
}

static void *work(void *user) {
    pool *p = user;
    ref_view *view = malloc(sizeof *view);
    pthread_mutex_lock(&p->lock);
    while (view && p->next < p->count && !interrupted && !p->failed) {
        const size_t i = p->next++;
        ref_total total = p->totals[i];
        pthread_mutex_unlock(&p->lock);
        answer(p, view, i, &total);
        pthread_mutex_lock(&p->lock);
        p->totals[i] = total;
        p->done += total.done != 0;
        const double now = now_s();
        if (p->job->state && now - p->saved > SAVE_EVERY_S) {
            p->failed |= ref_state_write(p->job->state, p->digest, p->totals, p->count);
            p->saved = now;
        }
        show(p, now);
    }
    if (!view)
        p->failed = 1;
    pthread_mutex_unlock(&p->lock);
    free(view);
    return NULL;
}

static void run_threads(pool *p) {
    pthread_t thread[MOST_THREADS];
    int wanted = p->job->threads < 1 ? 1 : p->job->threads > MOST_THREADS ? MOST_THREADS : p->job->threads, started = 0;
    while (started < wanted - 1 && pthread_create(&thread[started], NULL, work, p) == 0)
        started++;
    work(p);
    for (int i = 0; i < started; i++)
        pthread_join(thread[i], NULL);
}

static int finish(pool *p) {
    if (p->shown > p->start)
        fprintf(stderr, "\r\033[K");
    if (p->job->state && !p->failed)
        p->failed |= ref_state_write(p->job->state, p->digest, p->totals, p->count);
    if (p->failed)
        fprintf(stderr, "skyvert-reference: out of memory, or the state could not be written\n");
    else if (p->done < p->count)
        fprintf(stderr, "skyvert-reference: interrupted with %zu of %zu rays done%s\n", p->done, p->count,
                p->job->state ? "; the same command goes on" : "");
    return p->failed || p->done < p->count;
}

int ref_orders_run(const ref_tracer *tracer, const ref_job *job, const ref_query *queries, size_t count,
                   ref_total *totals) {
    struct sigaction action, old_int, old_term;
    pool p = {.tracer = tracer, .job = job, .queries = queries, .count = count, .totals = totals};
    memset(totals, 0, count * sizeof *totals);
    p.digest = ref_state_digest(tracer->air.world.atmosphere, job, queries, count);
    if (job->state && ref_state_read(job->state, p.digest, totals, count) != 0)
        return 2;
    interrupted = 0;
    memset(&action, 0, sizeof action);
    action.sa_handler = interrupt;
    sigemptyset(&action.sa_mask);
    if (job->state) { // else there is nothing to keep
        sigaction(SIGINT, &action, &old_int);
        sigaction(SIGTERM, &action, &old_term);
    }
    p.start = p.shown = p.saved = now_s();
    pthread_mutex_init(&p.lock, NULL);
    run_threads(&p);
    pthread_mutex_destroy(&p.lock);
    if (job->state) {
        sigaction(SIGINT, &old_int, NULL);
        sigaction(SIGTERM, &old_term, NULL);
    }
    return finish(&p);
}
