/// Strict numbers and options.
#include <ctype.h>
#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"

static const char *skip_digits(const char *c, size_t *digits) {
    for (; *c >= '0' && *c <= '9'; c++)
        ++*digits;
    return c;
}

static const char *skip_blanks(const char *c) {
    while (*c == ' ' || *c == '\t')
        c++;
    return c;
}

/// [sign] digits [. digits] [e [sign] digits]
static bool is_decimal(const char *text) {
    const char *c = skip_blanks(text);
    size_t digits = 0;
    c += *c == '+' || *c == '-';
    c = skip_digits(c, &digits);
    if (*c == '.')
        c = skip_digits(c + 1, &digits);
    if (digits == 0)
        return false;
    if (*c == 'e' || *c == 'E') {
        size_t exponent = 0;
        c++;
        c += *c == '+' || *c == '-';
        c = skip_digits(c, &exponent);
        if (exponent == 0)
            return false;
    }
    return *skip_blanks(c) == '\0';
}

bool parse_number(const char *text, double *value) {
    if (!is_decimal(text))
        return false;
    const double v = strtod(text, NULL); // setlocale() is never called: the point is a point
    if (!isfinite(v))
        return false;
    *value = v;
    return true;
}

/// Callers may name an option with its dashes or without.
static const char *bare(const char *option) {
    return strncmp(option, "--", 2) == 0 ? option + 2 : option;
}

int option_number(const char *command, const char *option, const char *text, double low, double high, double *value) {
    double v = 0;
    if (!parse_number(text, &v) || v < low || v > high)
        return fail_usage("skyvert %s: --%s %.60s: allowed is a number from %g to %g", command, bare(option), text, low,
                          high);
    *value = v;
    return 0;
}

int option_integer(const char *command, const char *option, const char *text, int low, int high, int *value) {
    double v = 0;
    if (!parse_number(text, &v) || v < low || v > high || v != floor(v))
        return fail_usage("skyvert %s: --%s %.60s: allowed is a whole number from %d to %d", command, bare(option),
                          text, low, high);
    *value = (int)v;
    return 0;
}

int parse_choice(const char *text, const char *const names[], char allowed[CHOICE_TEXT]) {
    size_t used = 0;
    allowed[0] = '\0';
    for (int i = 0; names[i]; i++) {
        if (strcmp(text, names[i]) == 0)
            return i;
        snprintf(allowed + used, CHOICE_TEXT - used, "%s%s", i == 0 ? "" : names[i + 1] ? ", " : " or ", names[i]);
        used = strlen(allowed);
    }
    return -1;
}

int option_choice(const char *command, const char *option, const char *text, const char *const names[], int *index) {
    char allowed[CHOICE_TEXT];
    const int at = parse_choice(text, names, allowed);
    if (at < 0)
        return fail_usage("skyvert %s: --%s %.60s: allowed is %s", command, bare(option), text, allowed);
    *index = at;
    return 0;
}

int option_unknown(const char *command, int got, char **argv) {
    const char *const prefix = strcmp(command, "skyvert") == 0 ? "" : "skyvert ";
    // A short option leaves optind at its own word while letters of it are left: name the letter.
    const char letter[3] = {'-', (char)optopt, '\0'};
    const char *const word =
        optopt > 0 && optopt < 128 && isprint(optopt) && argv[optind - 1][1] != '-' ? letter : argv[optind - 1];
    if (got == ':')
        return fail_usage("%s%s: option %.60s needs a value (%s%s --help)", prefix, command, word, prefix, command);
    if (argv[optind - 1][1] == '-' && strchr(argv[optind - 1], '='))
        return fail_usage("%s%s: option %.60s is unknown, ambiguous or takes no value (%s%s --help)", prefix, command,
                          word, prefix, command);
    return fail_usage("%s%s: unknown option %.60s (%s%s --help lists them)", prefix, command, word, prefix, command);
}

int option_no_more(const char *command, int argc, char **argv) {
    if (optind >= argc)
        return 0;
    return fail_usage("skyvert %s: unexpected argument '%.60s' (skyvert %s --help)", command, argv[optind], command);
}

int option_version(void) {
    printf("skyvert %s\n", SKV_VERSION);
    return output_finish_stdout();
}
