// reader NAME [SECONDS]: what an image generator finds in the shared memory of skyvert-cockpit: a line a frame, ten
// times a second, for as long (default: one line). Exit status 0; 1: no such memory; 2: nothing published in 5 s, or a
// broken frame.
#define _POSIX_C_SOURCE 200809L
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "tools/cockpit/vertices.h"

static void *map_of(const char *name, size_t *bytes) {
    struct stat status;
    const int fd = shm_open(name, O_RDONLY, 0);
    if (fd < 0 || fstat(fd, &status) != 0)
        return NULL;
    *bytes = (size_t)status.st_size;
    void *const map = mmap(NULL, *bytes, PROT_READ, MAP_SHARED, fd, 0);
    close(fd);
    return map == MAP_FAILED ? NULL : map;
}

static int show(const void *map, skv_vertex *vertex, uint32_t n) {
    skv_vertices_moment m;
    const int32_t got = skv_vertices_read(map, &m, vertex, n);
    if (got <= 0)
        return got == 0 ? 1 : 2;
    double mean = 0.0;
    for (int32_t i = 0; i < got; i++) {
        const float *const c = vertex[i].rgb;
        if (!(vertex[i].luminance >= 0.0f) || !(c[0] - c[0] + c[1] - c[1] + c[2] - c[2] < 1.0f))
            return 2; // negative or not a number
        mean += (double)vertex[i].luminance / got;
    }
    printf("frame %u vertices %d flags %u sun %.4f %.4f height %.1f horizon %.5f mean %.5g zenith %.5g lat %.6f lon "
           "%.6f\n",
           m.frame, got, m.flags, (double)m.sun_azimuth_deg, (double)m.sun_elevation_deg, (double)m.height_m,
           (double)m.horizon_rad, mean, (double)vertex[0].luminance, m.latitude_deg, m.longitude_deg);
    fflush(stdout);
    return 0;
}

int main(int argc, char **argv) {
    size_t bytes = 0;
    void *const map = argc > 1 ? map_of(argv[1], &bytes) : NULL;
    if (!map || skv_vertices_check(map, bytes) != NULL) {
        fprintf(stderr, "reader: no vertices there\n");
        return 1;
    }
    const skv_vertices_header *const h = map;
    skv_vertex *const vertex = malloc(sizeof *vertex * (size_t)h->vertices);
    int left = argc > 2 ? (int)(10.0 * atof(argv[2])) : 1, patience = 50;
    while (vertex && left > 0 && patience > 0) {
        const int result = show(map, vertex, h->vertices);
        if (result == 2)
            break;
        left -= result == 0;
        patience = result == 0 ? 50 : patience - 1;
        nanosleep(&(struct timespec){0, left > 0 ? 100000000 : 0}, NULL);
    }
    free(vertex);
    munmap(map, bytes);
    return left == 0 ? 0 : 2;
}
