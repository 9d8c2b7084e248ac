/// What newlib's stdio asks of a board. Only the tests use it: the core needs no C library but memcpy and memset.
#include "cortexm.h"

#include <errno.h>
#include <stdint.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>

extern char skvm_heap[], skvm_heap_end[];

void *_sbrk(ptrdiff_t more);
int _write(int file, const char *text, int length);
int _read(int file, char *text, int length);
int _close(int file);
int _isatty(int file);
off_t _lseek(int file, off_t offset, int whence);
int _fstat(int file, struct stat *status);
int _kill(int process, int signal);
int _getpid(void);
void _exit(int status);

void *_sbrk(ptrdiff_t more) {
    static char *end = skvm_heap;
    if (more > skvm_heap_end - end || more < skvm_heap - end) {
        errno = ENOMEM;
        return (void *)(intptr_t)-1;
    }
    char *const was = end;
    end += more;
    return was;
}

int _write(int file, const char *text, int length) {
    char piece[65];
    (void)file;
    for (int done = 0; done < length;) {
        const int n = length - done < 64 ? length - done : 64;
        memcpy(piece, text + done, (size_t)n);
        piece[n] = 0;
        skvm_write(piece);
        done += n;
    }
    return length;
}

int _read(int file, char *text, int length) {
    (void)file, (void)text, (void)length;
    return 0;
}

int _close(int file) {
    (void)file;
    return -1;
}

int _isatty(int file) {
    (void)file;
    return 1;
}

off_t _lseek(int file, off_t offset, int whence) {
    (void)file, (void)offset, (void)whence;
    return 0;
}

int _fstat(int file, struct stat *status) {
    (void)file;
    status->st_mode = S_IFCHR;
    return 0;
}

int _kill(int process, int signal) {
    (void)process, (void)signal;
    return -1;
}

int _getpid(void) {
    return 1;
}

void _exit(int status) {
    skvm_exit(status);
}
