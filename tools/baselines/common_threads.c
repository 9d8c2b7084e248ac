/// Work shared among threads.
#include <pthread.h>
#include <time.h>

#include "common.h"

enum { THREADS_MAX = 64 };

typedef struct job {
    pthread_mutex_t lock;
    size_t next, n, done;
    int stopped;
    baseline_item *item;
    void *context;
} job;

/// @return 1 with the next item; 0 when there is none.
static int take(job *shared, size_t *i) {
    pthread_mutex_lock(&shared->lock);
    const int more = !shared->stopped && shared->next < shared->n;
    if (more)
        *i = shared->next++;
    pthread_mutex_unlock(&shared->lock);
    return more;
}

static size_t finished(job *shared) {
    pthread_mutex_lock(&shared->lock);
    const size_t done = ++shared->done;
    pthread_mutex_unlock(&shared->lock);
    return done;
}

static void *helper(void *context) {
    job *const shared = context;
    for (size_t i; take(shared, &i); (void)finished(shared))
        shared->item(shared->context, i);
    return NULL;
}

static void stop(job *shared) {
    pthread_mutex_lock(&shared->lock);
    shared->stopped = 1;
    pthread_mutex_unlock(&shared->lock);
}

int baseline_parallel(const baseline_wants *wants, double from, double to, size_t n, baseline_item *item,
                      void *context) {
    job shared = {.n = n, .item = item, .context = context};
    pthread_t thread[THREADS_MAX];
    int threads = 0;
    pthread_mutex_init(&shared.lock, NULL);
    for (; threads < wants->threads - 1 && threads < THREADS_MAX; threads++)
        if (pthread_create(&thread[threads], NULL, helper, &shared) != 0)
            break; // those that are there do the work
    int stopped = wants->progress && wants->progress(wants->context, from) != 0;
    if (stopped)
        stop(&shared);
    for (size_t i; take(&shared, &i);) {
        item(context, i);
        const double share = (double)finished(&shared) / (double)n;
        if (wants->progress && wants->progress(wants->context, from + (to - from) * share) != 0) {
            stopped = 1;
            stop(&shared);
        }
    }
    while (threads > 0)
        pthread_join(thread[--threads], NULL);
    pthread_mutex_destroy(&shared.lock);
    return stopped;
}

double baseline_cpu_s(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
