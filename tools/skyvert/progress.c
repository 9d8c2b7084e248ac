/// A bar for jobs of over two seconds, on terminals only.
#include <time.h>
#include <unistd.h>

#include "command.h"

static struct {
    const char *what;
    size_t total;
    double start, shown;
    bool drawn;
} bar;

static double now_s(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void progress_begin(const char *what, size_t total) {
    bar.what = isatty(STDERR_FILENO) && total > 0 ? what : NULL;
    bar.total = total;
    bar.start = bar.shown = now_s();
    bar.drawn = false;
}

void progress_update(size_t done) {
    if (!bar.what)
        return;
    const double now = now_s();
    if (now - bar.start < 2 || now - bar.shown < .1)
        return;
    enum { WIDTH = 40 };
    const int full = (int)((double)WIDTH * (double)done / (double)bar.total);
    const double left = done ? (now - bar.start) * (double)(bar.total - done) / (double)done : 0;
    fprintf(stderr, "\r%s [%.*s%*s] %zu of %zu, %.0f s left ", bar.what, full,
            "########################################", WIDTH - full, "", done, bar.total, left);
    bar.shown = now;
    bar.drawn = true;
}

void progress_end(void) {
    if (bar.what && bar.drawn)
        fputs("\r\033[K", stderr);
    bar.what = NULL;
}
