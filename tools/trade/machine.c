/// What the figures were measured on. TRADE_FLAGS: how the core was compiled (build.mk).
#include <string.h>

#include "trade.h"

#ifndef TRADE_FLAGS
#define TRADE_FLAGS "unknown"
#endif
#ifdef __clang__
#define COMPILER __VERSION__
#else
#define COMPILER "gcc " __VERSION__
#endif

void trade_report_machine(FILE *out) {
    static const char key[] = "model name";
    char line[256], processor[200] = "unknown";
    FILE *const in = fopen("/proc/cpuinfo", "r");
    while (in && fgets(line, sizeof line, in)) {
        const char *const colon = strchr(line, ':');
        if (strncmp(line, key, sizeof key - 1) == 0 && colon) {
            snprintf(processor, sizeof processor, "%.*s", (int)strcspn(colon + 1, "\n"), colon + 1);
            break;
        }
    }
    if (in)
        fclose(in);
    fprintf(out, "Processor:%s%s; compiler: %s; core: %s\n", processor[0] == ' ' ? "" : " ", processor, COMPILER,
            TRADE_FLAGS);
}
