// slcan-adapter: the far end of a serial CAN adapter, played on a pseudo terminal. Makes an interface and prints
// "interface NAME"; each line of standard input goes to the kernel as the adapter's own, each line that the kernel
// sends is printed after "sent ". Ends, and takes the interface away, at the end of input.
//
// Lines of an adapter, as the kernel's driver reads them: t IDD L DATA (a frame: t32130102FF), sb TTT RRR (bus off,
// with the error counters: sb256000), sp (passive), sw (warning), sa (active again), e N CODES (errors: e1a no
// acknowledge, e1o overrun).
#define _XOPEN_SOURCE   700
#define _DEFAULT_SOURCE 1
#include <fcntl.h>
#include <linux/sockios.h>
#include <linux/tty.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

static int fail(const char *what) {
    perror(what);
    return 1;
}

// What the kernel writes, a line each.
static int from_kernel(int master) {
    static char line[64];
    static size_t length;
    char bytes[256];
    const ssize_t n = read(master, bytes, sizeof bytes);
    for (ssize_t i = 0; i < n; i++) {
        if (bytes[i] == '\r') {
            printf("sent %.*s\n", (int)length, line);
            length = 0;
        } else if (length < sizeof line) {
            line[length++] = bytes[i];
        }
    }
    return n > 0;
}

static int to_kernel(int master) {
    char line[64];
    if (!fgets(line, sizeof line, stdin))
        return 0;
    line[strcspn(line, "\n")] = '\r';
    return write(master, line, strlen(line)) > 0;
}

int main(void) {
    const int master = posix_openpt(O_RDWR | O_NOCTTY);
    if (master < 0 || grantpt(master) != 0 || unlockpt(master) != 0)
        return fail("pty");
    const int slave = open(ptsname(master), O_RDWR | O_NOCTTY);
    struct termios raw;
    if (slave < 0 || tcgetattr(slave, &raw) != 0)
        return fail("pty");
    cfmakeraw(&raw);
    const int discipline = N_SLCAN;
    char name[32] = "";
    if (tcsetattr(slave, TCSANOW, &raw) != 0 || ioctl(slave, TIOCSETD, &discipline) != 0 ||
        ioctl(slave, SIOCGIFNAME, name) != 0)
        return fail("slcan");
    setvbuf(stdout, NULL, _IOLBF, 0);
    setvbuf(stdin, NULL, _IONBF, 0);
    printf("interface %s\n", name);
    for (int on = 1; on;) {
        struct pollfd waits[2] = {{.fd = 0, .events = POLLIN}, {.fd = master, .events = POLLIN}};
        if (poll(waits, 2, -1) < 0)
            return fail("poll");
        if (waits[1].revents)
            on = from_kernel(master);
        if (on && waits[0].revents)
            on = to_kernel(master);
    }
    return 0;
}
