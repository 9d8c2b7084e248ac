/// Tables that take long to build, kept in a folder.
///
/// A file: magic, key, length of the data, seconds of its build, data, checksum (FNV-1a) of all before it; in the byte
/// order of the machine. Names hold the key, the header holds it again: a renamed file is not taken for another.
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "common.h"

typedef struct header {
    uint64_t magic, key, bytes;
    double build_s;
} header;

#define MAGIC 0x31656e696c657362u // "bseline1", read in the machine's order

uint64_t baseline_hash(uint64_t hash, const void *data, size_t bytes) {
    const unsigned char *const byte = data;
    for (size_t i = 0; i < bytes; i++)
        hash = (hash ^ byte[i]) * 1099511628211u;
    return hash;
}

/// FOLDER/NAME-KEY.bin with an ending. @return to be freed; NULL: no memory.
static char *path_of(const char *folder, const char *name, uint64_t key, const char *ending) {
    const size_t size = strlen(folder) + strlen(name) + strlen(ending) + 32;
    char *const path = malloc(size);
    if (path)
        snprintf(path, size, "%s/%s-%016llx.bin%s", folder, name, (unsigned long long)key, ending);
    return path;
}

static int read_whole(FILE *file, uint64_t key, void *data, size_t bytes, double *build_s) {
    header head;
    uint64_t sum;
    if (fread(&head, sizeof head, 1, file) != 1 || head.magic != MAGIC || head.key != key || head.bytes != bytes)
        return 0;
    if (fread(data, 1, bytes, file) != bytes || fread(&sum, sizeof sum, 1, file) != 1 || fgetc(file) != EOF)
        return 0;
    *build_s = head.build_s;
    return sum == baseline_hash(baseline_hash(BASELINE_HASH_START, &head, sizeof head), data, bytes);
}

int baseline_cache_load(const char *folder, const char *name, uint64_t key, void *data, size_t bytes, double *build_s) {
    char *const path = folder ? path_of(folder, name, key, "") : NULL;
    FILE *const file = path ? fopen(path, "rb") : NULL;
    const int got = file ? read_whole(file, key, data, bytes, build_s) : 0;
    if (file)
        fclose(file);
    free(path);
    return got;
}

static int write_whole(FILE *file, uint64_t key, const void *data, size_t bytes, double build_s) {
    header head;
    memset(&head, 0, sizeof head);
    head.magic = MAGIC;
    head.key = key;
    head.bytes = bytes;
    head.build_s = build_s;
    const uint64_t sum = baseline_hash(baseline_hash(BASELINE_HASH_START, &head, sizeof head), data, bytes);
    return fwrite(&head, sizeof head, 1, file) == 1 && fwrite(data, 1, bytes, file) == bytes &&
           fwrite(&sum, sizeof sum, 1, file) == 1;
}

/// Writes beside and renames.
static int put(const char *beside, const char *path, uint64_t key, const void *data, size_t bytes, double build_s) {
    FILE *const file = fopen(beside, "wb");
    if (!file)
        return 0;
    int saved = write_whole(file, key, data, bytes, build_s);
    saved = fclose(file) == 0 && saved;
    saved = saved && rename(beside, path) == 0;
    if (!saved)
        (void)remove(beside);
    return saved;
}

int baseline_cache_save(const char *folder, const char *name, uint64_t key, const void *data, size_t bytes,
                        double build_s) {
    if (!folder)
        return 0;
    (void)mkdir(folder, 0777);
    char ending[40];
    snprintf(ending, sizeof ending, ".%ld.part", (long)getpid());
    char *const path = path_of(folder, name, key, ""), *const beside = path_of(folder, name, key, ending);
    // An interrupt waits until nothing half-done is left: some milliseconds.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before);
    const int saved = path && beside ? put(beside, path, key, data, bytes, build_s) : 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    free(path);
    free(beside);
    return saved;
}
