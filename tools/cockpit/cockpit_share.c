#define _POSIX_C_SOURCE 200809L
#include "cockpit_share.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cockpit.h"

static size_t round_up(size_t bytes) {
    return (bytes + 63) / 64 * 64;
}

static skv_vertices_header *header_of(const cockpit_share *share) {
    return (skv_vertices_header *)(void *)share->map;
}

/// The process that writes to a memory of this name now, or 0.
static int writer_of(const char *name) {
    skv_vertices_header h;
    const int fd = shm_open(name, O_RDONLY, 0);
    if (fd < 0)
        return 0;
    const bool whole = read(fd, &h, sizeof h) == (ssize_t)sizeof h && h.magic == SKV_VERTICES_MAGIC;
    close(fd);
    const bool lives =
        whole && h.state != SKV_VERTICES_ENDED && h.writer > 0 && (kill(h.writer, 0) == 0 || errno == EPERM);
    return lives ? h.writer : 0;
}

static int make(cockpit_share *share) {
    const int writer = writer_of(share->name);
    if (writer > 0 && writer != (int)getpid())
        return fail_job(COCKPIT ": --shm %s: process %d is writing there; choose another name", share->name, writer);
    shm_unlink(share->name); // left by one that was killed
    const int fd = shm_open(share->name, O_RDWR | O_CREAT | O_EXCL, 0644);
    if (fd < 0)
        return fail_job(COCKPIT ": --shm %s: %s", share->name, strerror(errno));
    int error = posix_fallocate(fd, 0, (off_t)share->bytes); // room now, or a write would end this program later
    void *const map = error ? MAP_FAILED : mmap(NULL, share->bytes, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    error = error ? error : errno;
    close(fd);
    if (map != MAP_FAILED) {
        share->map = map;
        return 0;
    }
    shm_unlink(share->name);
    return fail_job(COCKPIT ": --shm %s: %zu bytes: %s", share->name, share->bytes, strerror(error));
}

static void lay_out(skv_vertices_header *h, const cockpit_sky *sky) {
    h->version = SKV_VERTICES_VERSION;
    h->vertices = sky->vertices;
    h->indices = sky->indices;
    h->slots = SKV_VERTICES_SLOTS;
    h->indices_offset = sizeof *h;
    h->slots_offset = (uint32_t)round_up(sizeof *h + 4 * (size_t)sky->indices);
    h->slot_bytes = (uint32_t)round_up(sizeof(skv_vertices_moment) + sizeof(skv_vertex) * (size_t)sky->vertices);
    h->total_bytes = h->slots_offset + h->slots * h->slot_bytes;
    h->azimuths = (uint32_t)sky->dome.azimuths;
    h->rings = (h->vertices - 2) / h->azimuths;
    h->writer = (int32_t)getpid();
    h->state = SKV_VERTICES_WAITING;
}

int cockpit_share_open(cockpit_share *share, const char *name, const cockpit_sky *sky) {
    skv_vertices_header h = {0};
    const char *const bare = name + (name[0] == '/');
    memset(share, 0, sizeof *share);
    if (bare[0] == '\0' || strchr(bare, '/') || strlen(bare) + 2 > sizeof share->name || bare[0] == '.')
        return fail_usage(COCKPIT ": --shm %.80s: allowed is a name of 1 to 62 characters without a slash in it", name);
    snprintf(share->name, sizeof share->name, "/%s", bare);
    lay_out(&h, sky);
    share->bytes = h.total_bytes;
    const int status = make(share);
    if (status != 0)
        return status;
    memcpy(share->map, &h, sizeof h);
    cockpit_sky_indices(sky, (uint32_t *)(void *)(share->map + h.indices_offset));
    __atomic_store_n(&header_of(share)->magic, SKV_VERTICES_MAGIC, __ATOMIC_RELEASE); // last: it is complete now
    return 0;
}

uint32_t cockpit_share_publish(cockpit_share *share, const cockpit_sky *sky, const skv_vertices_moment *moment) {
    share->frame++;
    if (!share->map)
        return share->frame;
    skv_vertices_header *const h = header_of(share);
    unsigned char *const slot = share->map + h->slots_offset + (size_t)share->next * h->slot_bytes;
    uint32_t *const sequence = (uint32_t *)(void *)slot;
    const uint32_t before = __atomic_load_n(sequence, __ATOMIC_RELAXED);
    __atomic_store_n(sequence, before + 1, __ATOMIC_RELAXED);
    __atomic_thread_fence(__ATOMIC_RELEASE); // odd is seen before any of what follows
    skv_vertices_moment m = *moment;
    m.frame = share->frame;
    memcpy(slot + sizeof m.sequence, (const unsigned char *)&m + sizeof m.sequence, sizeof m - sizeof m.sequence);
    memcpy(slot + sizeof m, sky->vertex, sizeof *sky->vertex * (size_t)sky->vertices);
    __atomic_store_n(sequence, before + 2, __ATOMIC_RELEASE);
    __atomic_store_n(&h->latest, share->next + 1, __ATOMIC_RELEASE);
    __atomic_store_n(&h->state, SKV_VERTICES_RUNNING, __ATOMIC_RELEASE);
    share->next = (share->next + 1) % SKV_VERTICES_SLOTS;
    return share->frame;
}

void cockpit_share_beat(cockpit_share *share) {
    if (share->map)
        __atomic_fetch_add(&header_of(share)->beats, 1, __ATOMIC_RELEASE);
}

void cockpit_share_close(cockpit_share *share) {
    if (!share->map)
        return;
    __atomic_store_n(&header_of(share)->state, SKV_VERTICES_ENDED, __ATOMIC_RELEASE);
    munmap(share->map, share->bytes);
    shm_unlink(share->name);
    share->map = NULL;
}
