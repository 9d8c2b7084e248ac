#include "port/gpiod/skv_debounce.h"

void skv_debounce_start(skv_debounce *button, bool level, int64_t steady_ns) {
    *button = (skv_debounce){.steady_ns = steady_ns, .raw = level, .level = level};
}

bool skv_debounce_time(skv_debounce *button, int64_t now_ns) {
    if (!button->waiting || now_ns - button->edge_ns < button->steady_ns)
        return false;
    const bool changed = button->raw != button->level;
    button->waiting = false;
    button->level = button->raw;
    if (!changed) // there and back within the time
        button->bounces++;
    return changed;
}

void skv_debounce_lost(skv_debounce *button, int64_t now_ns, bool level) {
    if (button->waiting)
        button->bounces++;
    button->waiting = true;
    button->edge_ns = now_ns;
    button->raw = level;
}

bool skv_debounce_edge(skv_debounce *button, int64_t at_ns, bool level) {
    const bool changed = skv_debounce_time(button, at_ns);
    skv_debounce_lost(button, at_ns, level);
    return changed;
}

int64_t skv_debounce_due(const skv_debounce *button) {
    return button->waiting ? button->edge_ns + button->steady_ns : INT64_MAX;
}
