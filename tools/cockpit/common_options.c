/// Error lines of options.
#include <getopt.h>
#include <math.h>

#include "common.h"

int common_number(const char *program, const char *option, const char *text, double low, double high, double *value) {
    double v = 0;
    if (!parse_number(text, &v) || v < low || v > high)
        return fail_usage("%s: %s %.60s: allowed is a number from %g to %g", program, option, text, low, high);
    *value = v;
    return 0;
}

int common_integer(const char *program, const char *option, const char *text, int low, int high, int *value) {
    double v = 0;
    if (!parse_number(text, &v) || v < low || v > high || fabs(v - floor(v)) > 0.0)
        return fail_usage("%s: %s %.60s: allowed is a whole number from %d to %d", program, option, text, low, high);
    *value = (int)v;
    return 0;
}

int common_choice(const char *program, const char *option, const char *text, const char *const names[], int *index) {
    char allowed[CHOICE_TEXT];
    const int at = parse_choice(text, names, allowed);
    if (at < 0)
        return fail_usage("%s: %s %.60s: allowed is %s", program, option, text, allowed);
    *index = at;
    return 0;
}

int common_unknown(const char *program, int got, char **argv) {
    const char *const word = argv[optind - 1];
    if (got == ':')
        return fail_usage("%s: option %.60s needs a value (%s --help)", program, word, program);
    return fail_usage("%s: option %.60s is unknown, ambiguous or takes no value (%s --help lists them)", program, word,
                      program);
}

int common_version(const char *program) {
    printf("%s %s\n", program, SKV_VERSION);
    return output_finish_stdout();
}
