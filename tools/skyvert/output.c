/// Output files: written beside their place, synced, then renamed; removed on failure and on Ctrl-C.
// realpath() is POSIX 2008, but glibc shows it with this only.
#define _XOPEN_SOURCE 700

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "command.h"

/// Files that a signal has to remove. Changed only with the signals held back.
enum { PENDING_MAX = 16 };
static char *pending[PENDING_MAX];

static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
enum { SIGNALS = sizeof signals / sizeof signals[0] };

static void remove_pending(int signal_number) {
    for (int i = 0; i < PENDING_MAX; i++)
        if (pending[i])
            unlink(pending[i]);
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

static void hold_signals(sigset_t *before) {
    sigset_t set;
    sigemptyset(&set);
    for (int i = 0; i < SIGNALS; i++)
        sigaddset(&set, signals[i]);
    sigprocmask(SIG_BLOCK, &set, before);
}

static void catch_signals(void) {
    static bool done;
    for (int i = 0; !done && i < SIGNALS; i++) {
        struct sigaction action;
        sigaction(signals[i], NULL, &action);
        if (action.sa_handler == SIG_IGN) // nohup
            continue;
        memset(&action, 0, sizeof action);
        action.sa_handler = remove_pending;
        sigaction(signals[i], &action, NULL);
    }
    done = true;
}

/// Puts `to` where `from` is in the list; NULL is a free place. @return false iff the list is full
static bool swap_pending(char *from, char *to) {
    for (int i = 0; i < PENDING_MAX; i++)
        if (pending[i] == from) {
            pending[i] = to;
            return true;
        }
    return false;
}

/// Text behind the last slash begins the name.
static char *temp_name(const char *path) {
    const char *const slash = strrchr(path, '/');
    const int folder = slash ? (int)(slash - path) + 1 : 0;
    static unsigned files; // of this process: two may have the same name
    const size_t size = strlen(path) + 60;
    char *const name = malloc(size);
    if (name)
        snprintf(name, size, "%.*s.%.200s.%ld-%u.part", folder, path, path + folder, (long)getpid(), files++);
    return name;
}

static int open_failed(const char *path, const char *what) {
    const int error = errno;
    const bool input = error == EISDIR || error == ENOENT || error == ENOTDIR || error == ENAMETOOLONG;
    return (input ? fail_usage : fail_job)("%.200s: %s: %s", path, what, strerror(error));
}

/// Creates the file beside, known to the signal handler from its first moment.
static int create_temp(output *out, int *fd) {
    sigset_t before;
    catch_signals();
    hold_signals(&before);
    unlink(out->temp); // of a killed run with the same process number
    *fd = open(out->temp, O_WRONLY | O_CREAT | O_EXCL, 0666);
    const int error = errno;
    const bool listed = *fd >= 0 && swap_pending(NULL, out->temp);
    if (*fd >= 0 && !listed) {
        close(*fd);
        unlink(out->temp);
    }
    sigprocmask(SIG_SETMASK, &before, NULL);
    errno = error;
    if (*fd < 0)
        return open_failed(out->path, "cannot be written");
    return listed ? 0 : fail_job("%.200s: too many files are being written at a time", out->path);
}

/// Decides where the bytes go: *fd is the file beside, or -1 for a device or pipe, which is written to directly.
static int start(output *out, const char *path, int *fd) {
    struct stat status;
    *out = (output){0};
    *fd = -1;
    const bool there = stat(path, &status) == 0;
    // A link is written through, not replaced.
    out->path = there ? realpath(path, NULL) : strdup(path);
    if (!out->path)
        return fail_job("%.200s: %s", path, strerror(errno));
    if (there && S_ISDIR(status.st_mode)) {
        output_discard(out);
        return fail_usage("%.200s: is a folder; the name of a file is needed", path);
    }
    if (there && !S_ISREG(status.st_mode))
        return 0;
    if (there && access(out->path, W_OK) != 0) {
        const int result = open_failed(path, "cannot be written");
        output_discard(out);
        return result;
    }
    out->temp = temp_name(out->path);
    const int result = out->temp ? create_temp(out, fd) : fail_job("out of memory");
    if (result) {
        free(out->temp); // not created: nothing to remove
        out->temp = NULL;
        output_discard(out);
    }
    return result;
}

int output_open(output *out, const char *path) {
    if (strcmp(path, "-") == 0) {
        *out = (output){.stream = stdout, .path = strdup(path)};
        return out->path ? 0 : fail_job("out of memory");
    }
    int fd;
    const int result = start(out, path, &fd);
    if (result)
        return result;
    out->stream = fd >= 0 ? fdopen(fd, "wb") : fopen(out->path, "wb");
    if (out->stream)
        return 0;
    const int failed = open_failed(path, "cannot be written");
    if (fd >= 0)
        close(fd);
    output_discard(out);
    return failed;
}

int output_reserve(output *out, const char *path) {
    int fd;
    const int result = start(out, path, &fd);
    if (result == 0 && fd >= 0)
        close(fd);
    return result;
}

const char *output_name(const output *out) {
    return out->temp ? out->temp : out->path;
}

/// Pipes and devices have nothing to sync.
static bool sync_fd(int fd) {
    return fsync(fd) == 0 || errno == EINVAL || errno == ENOTSUP || errno == EROFS || errno == ENOSYS || errno == EBADF;
}

/// Writes the stream's rest. errno is 0 where the cause was lost with an earlier write.
static bool flush_stream(FILE *stream) {
    const bool earlier = ferror(stream) != 0;
    errno = 0;
    if (fflush(stream) != 0 || earlier)
        return false;
    return sync_fd(fileno(stream));
}

static bool flush_reserved(const char *name) {
    const int fd = open(name, O_RDONLY);
    if (fd < 0)
        return false;
    const bool ok = sync_fd(fd);
    return close(fd) == 0 && ok;
}

static void sync_folder(const char *path) {
    char *const folder = strdup(path);
    if (!folder)
        return;
    char *const slash = strrchr(folder, '/');
    if (slash)
        slash[slash == folder] = '\0';
    const int fd = open(slash ? folder : ".", O_RDONLY);
    if (fd >= 0) {
        fsync(fd); // best effort: the file itself is safe
        close(fd);
    }
    free(folder);
}

static bool rename_into_place(output *out) {
    if (!out->temp)
        return true;
    sigset_t before;
    hold_signals(&before);
    const bool ok = rename(out->temp, out->path) == 0;
    const int error = errno;
    if (ok) {
        swap_pending(out->temp, NULL);
        free(out->temp);
        out->temp = NULL;
    }
    sigprocmask(SIG_SETMASK, &before, NULL);
    errno = error;
    if (ok)
        sync_folder(out->path);
    return ok;
}

int output_commit(output *out) {
    bool ok = out->stream ? flush_stream(out->stream) : !out->temp || flush_reserved(out->temp);
    int error = errno;
    if (out->stream && out->stream != stdout) {
        if (fclose(out->stream) != 0 && ok) {
            ok = false;
            error = errno;
        }
        out->stream = NULL;
    }
    if (ok && !rename_into_place(out)) {
        ok = false;
        error = errno;
    }
    if (!ok)
        return output_fail(out, error ? strerror(error) : "disk full or pipe closed");
    output_discard(out);
    return 0;
}

int output_fail(output *out, const char *why) {
    const int result =
        fail_job("%.200s: writing failed: %s", strcmp(out->path, "-") == 0 ? "standard output" : out->path, why);
    output_discard(out);
    return result;
}

void output_discard(output *out) {
    if (out->stream && out->stream != stdout)
        fclose(out->stream);
    if (out->temp) {
        sigset_t before;
        hold_signals(&before);
        unlink(out->temp);
        swap_pending(out->temp, NULL);
        sigprocmask(SIG_SETMASK, &before, NULL);
    }
    free(out->temp);
    free(out->path);
    *out = (output){0};
}

int output_finish_stdout(void) {
    if (flush_stream(stdout))
        return 0;
    const int error = errno;
    return fail_job("standard output: writing failed: %s", error ? strerror(error) : "disk full or pipe closed");
}
