#include "measure.h"

#include <math.h>
#include <stdlib.h>

#include "clock.h"

void trade_lay_dome(const trade_scene *scene, float direction[TRADE_DOME][3]) {
    enum { RINGS = 8, AZIMUTHS = TRADE_DOME / RINGS };
    const double lowest = scene->height == TRADE_GROUND ? 90 : 100;
    for (int i = 0; i < TRADE_DOME; i++)
        trade_direction(direction[i], lowest * ((i / AZIMUTHS) + 0.5) / RINGS, 360.0 * (i % AZIMUTHS) / AZIMUTHS);
}

/// The rays of a scene that count: all, or those into the sky. @return their number
static int choose(const trade_row *row, const trade_scene *scene, size_t chosen[TRADE_RAYS]) {
    int n = 0;
    for (int i = 0; i < scene->n; i++)
        if (row->sees_ground || !scene->to_ground[i])
            chosen[n++] = (size_t)i;
    return n;
}

static void measure_scene(trade_row *row, trade_subject *subject, int k) {
    const trade_scene *const scene = &row->truth->scene[k];
    float direction[TRADE_RAYS][3], got[TRADE_RAYS][TRADE_BANDS];
    double truth[TRADE_RAYS][TRADE_BANDS], scratch[TRADE_RAYS], mean = 0;
    size_t chosen[TRADE_RAYS];
    const int n = choose(row, scene, chosen);
    row->rays[k] = 0;
    if (n == 0 || !trade_subject_frame(subject, scene))
        return;
    for (int i = 0; i < n; i++) {
        double largest = 0;
        for (int c = 0; c < 3; c++)
            direction[i][c] = scene->direction[chosen[i]][c];
        for (int b = 0; b < TRADE_BANDS; b++) {
            truth[i][b] = scene->radiance[row->config->light][chosen[i]][b];
            largest = b < row->truth->bands ? fmax(largest, truth[i][b]) : largest;
        }
        mean += largest / n;
    }
    trade_subject_radiance(subject, (size_t)n, (const float(*)[3])direction, got);
    trade_measure((size_t)n, row->truth->bands, (const float(*)[TRADE_BANDS])got, (const double(*)[TRADE_BANDS])truth,
                  scratch, &row->error[k]);
    row->off_scale[k] = 0.05 * mean;
    for (int b = 0; b < row->truth->bands; b++)
        row->off_scale[k] = fmax(row->off_scale[k], truth[row->error[k].worst][b]);
    row->error[k].worst = chosen[row->error[k].worst];
    row->rays[k] = n;
}

void trade_measure_error(trade_row *row, trade_subject *subject) {
    row->sees_ground = trade_subject_sees_ground(row->config);
    row->build_s = subject->build_s;
    row->table_bytes = (double)subject->table_bytes;
    row->grid_bytes = (double)subject->grid_bytes;
    row->work_bytes = (double)subject->work_bytes;
    for (int k = 0; k < TRADE_SCENES; k++)
        measure_scene(row, subject, k);
    row->done |= TRADE_DONE_ERROR;
}

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void keep_times(trade_cost *cost, double *vertices, int n, double *frame, int frames) {
    qsort(vertices, (size_t)n, sizeof *vertices, ascending);
    qsort(frame, (size_t)frames, sizeof *frame, ascending);
    cost->ns = vertices[n / 2] / TRADE_DOME;
    cost->ns_low = vertices[n / 10] / TRADE_DOME;
    cost->ns_high = vertices[n - 1 - n / 10] / TRADE_DOME;
    cost->frame_ns = frame[frames / 2];
}

/// A dome's vertices, the checksum of the results within the time.
static double time_vertices(const trade_subject *subject, const float (*direction)[3], double *checksum) {
    static float radiance[TRADE_DOME][TRADE_BANDS];
    const double begun = trade_thread_ns();
    trade_subject_radiance(subject, TRADE_DOME, direction, radiance);
    for (int i = 0; i < TRADE_DOME; i++)
        for (int b = 0; b < TRADE_BANDS; b++)
            *checksum += (double)radiance[i][b];
    return trade_thread_ns() - begun;
}

static double time_frame(trade_subject *subject, const trade_scene *scene) {
    const double begun = trade_thread_ns();
    (void)trade_subject_frame(subject, scene);
    return trade_thread_ns() - begun;
}

/// What one row took, round by round.
typedef struct times {
    double *vertices, *frame; ///< [repeats + 1]
    int frames;               ///< timed
} times;

/// Round -1 warms; its frame counts when it is slow, which a few microseconds do not disturb.
static void time_round(const trade_row *row, trade_subject *subject, int k, const float (*direction)[3], int round,
                       times *took, double *checksum) {
    if (round < 1 || took->frames != 2 || took->frame[0] < TRADE_SLOW_FRAME_NS)
        took->frame[took->frames++] = time_frame(subject, &row->truth->scene[k]);
    const double vertices = time_vertices(subject, direction, checksum);
    if (round >= 0)
        took->vertices[round] = vertices;
    else if (took->frame[0] < TRADE_SLOW_FRAME_NS)
        took->frames = 0;
}

int trade_measure_time(trade_row *rows, trade_subject *subjects, size_t n, int k, int repeats, double *checksum) {
    static float direction[TRADE_DOME][3];
    const size_t room = (size_t)repeats + 1;
    double *const numbers = malloc(2 * room * n * sizeof *numbers);
    times *const took = calloc(n, sizeof *took);
    if (numbers && took) {
        trade_lay_dome(&rows[0].truth->scene[k], direction);
        for (size_t r = 0; r < n; r++)
            took[r] = (times){numbers + 2 * room * r, numbers + 2 * room * r + room, 0};
        for (int i = -1; i < repeats; i++)
            for (size_t r = 0; r < n; r++)
                if (subjects[r].config && rows[r].rays[k] > 0)
                    time_round(&rows[r], &subjects[r], k, (const float(*)[3])direction, i, &took[r], checksum);
        for (size_t r = 0; r < n; r++)
            if (subjects[r].config && rows[r].rays[k] > 0)
                keep_times(&rows[r].cost[k], took[r].vertices, repeats, took[r].frame, took[r].frames);
    }
    const int done = numbers && took;
    free(numbers);
    free(took);
    return done ? 0 : 1;
}
