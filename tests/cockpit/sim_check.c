/// sim-check LOG LAT0 DEG_PER_S: a candump log that was heard while skyvert-sim sent a flight due north at that rate.
/// Written without the port's decoder. Prints name=value pairs in one line:
///   frames ids lost      frames of the messages, kinds of them, message codes missing between two frames of an id
///   mean_ms worst_ms     mean and worst |period - 100 ms| of the latitude, by the log's times
///   lat_ms worst_lat_ms  mean and worst error of the latitude as a time: where the flight is at the log's times, less
///   their
///                        middle (when the flight began is not in the log); from the last gap on, of five frames or
///                        more
///   answers in_time answer_ms   identification requests (id 080) with a reply (081), those within 100 ms, the longest
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct line {
    double time_s;
    unsigned id, length;
    unsigned char data[8];
} line;

#define MOST 10000

typedef struct result {
    int frames, ids, lost, latitudes, answers, in_time, code[2048];
    int late; // latitudes since the last gap
    double last_s, sum_ms, worst_ms, lat_ms, worst_lat_ms, asked_s, answer_ms;
    double late_s[MOST]; // of each latitude
} result;

static int read_line(const char *text, line *l) {
    char hex[20] = "";
    int used = 0;
    if (sscanf(text, " (%lf) %*s %x#%n", &l->time_s, &l->id, &used) != 2 || used == 0 ||
        sscanf(text + used, "%16[0-9A-F]", hex) != 1)
        return 0;
    l->length = (unsigned)strlen(hex) / 2;
    for (unsigned i = 0; i < l->length; i++) {
        const char byte[3] = {hex[2 * i], hex[2 * i + 1], 0};
        l->data[i] = (unsigned char)strtoul(byte, NULL, 16);
    }
    return l->id < 2048;
}

static void latitude(result *r, const line *l, int codes, double lat0, double rate) {
    const int count =
        (int)((unsigned)l->data[4] << 24 | (unsigned)l->data[5] << 16 | (unsigned)l->data[6] << 8 | l->data[7]);
    const double lat = 1e-7 * count;
    if (r->latitudes++ > 0) {
        const double period_ms = fabs(1e3 * (l->time_s - r->last_s) - 100.0);
        r->sum_ms += period_ms;
        r->worst_ms = fmax(r->worst_ms, period_ms);
    }
    r->late = codes > 5 ? 0 : r->late;
    if (r->late < MOST)
        r->late_s[r->late++] = l->time_s - (lat - lat0) / rate;
    r->last_s = l->time_s;
}

static void take(result *r, const line *l, double lat0, double rate) {
    if (l->id == 0x080)
        r->asked_s = l->time_s;
    if (l->id == 0x081) {
        const double took_ms = 1e3 * (l->time_s - r->asked_s);
        r->answers++;
        r->in_time += took_ms <= 100.0;
        r->answer_ms = fmax(r->answer_ms, took_ms);
    }
    if (l->id < 300 || l->length != 8)
        return;
    const int codes = r->code[l->id] ? (l->data[3] - (r->code[l->id] - 1)) & 255 : 1;
    r->ids += r->code[l->id] == 0;
    r->lost += codes - 1;
    r->code[l->id] = l->data[3] + 1;
    r->frames++;
    if (l->id == 1036)
        latitude(r, l, codes, lat0, rate);
}

static int by_size(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void judge_latitudes(result *r) {
    qsort(r->late_s, (size_t)r->late, sizeof r->late_s[0], by_size);
    for (int i = 0; i < r->late; i++) {
        const double off_ms = 1e3 * fabs(r->late_s[i] - r->late_s[r->late / 2]);
        r->lat_ms += off_ms / r->late;
        r->worst_lat_ms = fmax(r->worst_lat_ms, off_ms);
    }
}

int main(int argc, char **argv) {
    FILE *const log = argc == 4 ? fopen(argv[1], "r") : NULL;
    static result r;
    char text[256];
    line l;
    if (!log)
        return 2;
    while (fgets(text, sizeof text, log)) {
        memset(&l, 0, sizeof l);
        if (read_line(text, &l))
            take(&r, &l, atof(argv[2]), atof(argv[3]));
    }
    fclose(log);
    judge_latitudes(&r);
    const int n = r.latitudes > 1 ? r.latitudes : 2;
    printf("frames=%d ids=%d lost=%d latitudes=%d mean_ms=%.2f worst_ms=%.0f lat_ms=%.2f worst_lat_ms=%.0f", r.frames,
           r.ids, r.lost, r.latitudes, r.sum_ms / (n - 1), r.worst_ms, r.lat_ms, r.worst_lat_ms);
    printf(" answers=%d in_time=%d answer_ms=%.1f\n", r.answers, r.in_time, r.answer_ms);
    return 0;
}
