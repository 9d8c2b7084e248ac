/// The configuration file.
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "cockpit.h"
#include "tools/skyvert/ini_document.h"

static const char *const presets[] = {"earth-clear", "earth-hazy", NULL};
static const char *const tiers[] = {"fast", "standard", "high", NULL};
static const char *const bands[] = {"3", "4", NULL};
static const char *const yes_no[] = {"no", "yes", NULL};

typedef struct reading {
    const char *path;
    const ini_entry *entry;
} reading;

static int number(const reading *r, double low, double high, double *value) {
    double v = 0;
    if (!parse_number(r->entry->value, &v) || v < low || v > high)
        return fail_usage("%s:%d: %s = %.60s: allowed is a number from %g to %g", r->path, r->entry->line,
                          r->entry->name, r->entry->value, low, high);
    *value = v;
    return 0;
}

static int choice(const reading *r, const char *const names[], int *index) {
    char allowed[CHOICE_TEXT];
    const int at = parse_choice(r->entry->value, names, allowed);
    if (at < 0)
        return fail_usage("%s:%d: %s = %.60s: allowed is %s", r->path, r->entry->line, r->entry->name, r->entry->value,
                          allowed);
    *index = at;
    return 0;
}

static bool is(const reading *r, const char *name) {
    return strcmp(r->entry->name, name) == 0;
}

static int unknown(const reading *r, const char *allowed) {
    return fail_usage("%s:%d: [%s] has no %.60s: allowed is %s", r->path, r->entry->line, r->entry->section,
                      r->entry->name, allowed);
}

static int take_can(cockpit_options *o, const reading *r) {
    double node = o->node;
    int index = 0, status = 0;
    if (is(r, "interface")) {
        if (r->entry->value[0] == '\0' || strlen(r->entry->value) >= sizeof o->interface)
            return fail_usage("%s:%d: interface = %.40s: allowed is a name of 1 to 15 characters", r->path,
                              r->entry->line, r->entry->value);
        strcpy(o->interface, r->entry->value);
    } else if (is(r, "node")) {
        status = number(r, 1, 255, &node);
        o->node = (int)node;
    } else if (is(r, "transmit")) {
        status = choice(r, yes_no, &index);
        o->transmit = index == 1;
    } else {
        return unknown(r, "interface, node, transmit");
    }
    return status;
}

static int take_sky(cockpit_options *o, const reading *r) {
    int index = 0, status = 0;
    if (is(r, "air")) {
        status = choice(r, presets, &o->preset);
    } else if (is(r, "tier")) {
        status = choice(r, tiers, &o->tier);
    } else if (is(r, "bands")) {
        status = choice(r, bands, &index);
        o->bands = 3 + index;
    } else if (is(r, "visibility_km")) {
        status = number(r, 0.02, 1000, &o->visibility_km);
    } else if (is(r, "geoid_m")) {
        status = number(r, -120, 100, &o->geoid_m);
    } else if (is(r, "exposure")) {
        status = strcmp(r->entry->value, "auto") == 0 ? 0 : number(r, 1e-6, 1e9, &o->exposure);
    } else {
        return unknown(r, "air, tier, bands, visibility_km, geoid_m, exposure");
    }
    return status;
}

static int take_knobs(cockpit_options *o, const reading *r) {
    if (is(r, "minutes_per_click"))
        return number(r, 0.01, 360, &o->minutes_per_click);
    if (is(r, "visibility_per_click"))
        return number(r, 1.01, 10, &o->visibility_per_click);
    if (is(r, "night_below_deg"))
        return number(r, -90, 90, &o->night_below_deg);
    if (is(r, "night_hysteresis_deg"))
        return number(r, 0, 20, &o->night_width_deg);
    return unknown(r, "minutes_per_click, visibility_per_click, night_below_deg, night_hysteresis_deg");
}

static int take_gpio(cockpit_options *o, const reading *r) {
    char why[SKV_GPIO_WHY];
    if (skv_gpio_set(&o->gpio, r->entry->name, r->entry->value, why) == 0)
        return 0;
    return fail_usage("%s:%d: %.60s = %.60s: %s", r->path, r->entry->line, r->entry->name, r->entry->value, why);
}

static int take(cockpit_options *o, const reading *r) {
    const char *const section = r->entry->section;
    if (strcmp(section, "can") == 0)
        return take_can(o, r);
    if (strcmp(section, "sky") == 0)
        return take_sky(o, r);
    if (strcmp(section, "knobs") == 0)
        return take_knobs(o, r);
    if (strcmp(section, "gpio") == 0)
        return take_gpio(o, r);
    return fail_usage("%s:%d: there is no section [%.60s]: allowed is can, sky, knobs, gpio", r->path, r->entry->line,
                      section);
}

int cockpit_config_read(cockpit_options *options, const char *path) {
    ini_document document;
    FILE *const stream = fopen(path, "r");
    if (!stream)
        return fail_usage(COCKPIT ": --config %.200s: %s", path, strerror(errno));
    int status = ini_read(&document, stream, path);
    fclose(stream);
    if (status != 0)
        return status;
    for (size_t i = 0; i < document.entries && status == 0; i++)
        status = take(options, &(reading){path, &document.entry[i]});
    ini_free(&document);
    return status;
}
