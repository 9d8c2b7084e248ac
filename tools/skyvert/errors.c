/// Error lines.
#include <stdarg.h>

#include "command.h"

#define MESSAGE_SIZE 1024

/// One line whatever the text: a file's bytes must not play with the terminal.
static void print_error(const char *format, va_list arguments) {
    char text[MESSAGE_SIZE];
    if (vsnprintf(text, sizeof text, format, arguments) < 0)
        return;
    for (char *c = text; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f)
            *c = '?';
    progress_end();
    fprintf(stderr, "%s\n", text);
}

int fail_usage(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    print_error(format, arguments);
    va_end(arguments);
    return EXIT_USAGE;
}

int fail_job(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    print_error(format, arguments);
    va_end(arguments);
    return EXIT_JOB;
}
