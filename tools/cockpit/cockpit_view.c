#define _DEFAULT_SOURCE
#include "cockpit_view.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

// The sky is evaluated on a mesh and drawn between: all round, from 6 deg below the horizon to the zenith's side.
enum { MESH_X = 37, MESH_Y = 14, COLUMNS_MAX = 400, LINES = 10 };
static const double pi = 3.14159265358979323846, lowest_deg = -6.0, highest_deg = 66.0;

typedef struct page {
    char *text;
    size_t used, size;
} page;

static void put(page *p, const char *format, ...) SKV_PRINTF(2, 3);
static void put(page *p, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const int n = vsnprintf(p->text + p->used, p->size - p->used, format, arguments);
    va_end(arguments);
    if (n > 0)
        p->used = p->used + (size_t)n < p->size ? p->used + (size_t)n : p->size - 1;
}

void cockpit_view_begin(void) {
    fputs("\033[?1049h\033[?25l\033[2J", stdout);
    fflush(stdout);
}

void cockpit_view_end(void) {
    fputs("\033[0m\033[?25h\033[?1049l", stdout);
    fflush(stdout);
}

void cockpit_view_size(int *columns, int *rows) {
    struct winsize size = {0};
    const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 && size.ws_row > 0;
    *columns = known ? size.ws_col : 80;
    *rows = known ? size.ws_row : 24;
}

/// The sky, exposed, on the mesh. Rows from above.
static bool evaluate(const cockpit_shown *s, float mesh[MESH_Y][MESH_X][3]) {
    float direction[MESH_Y * MESH_X][3], work[MESH_Y * MESH_X * 8];
    for (int y = 0; y < MESH_Y; y++)
        for (int x = 0; x < MESH_X; x++) {
            const double a = 2 * pi * x / (MESH_X - 1),
                         e = pi / 180 * (highest_deg - (highest_deg - lowest_deg) * y / (MESH_Y - 1));
            float *const d = direction[y * MESH_X + x];
            d[0] = (float)(cos(e) * sin(a));
            d[1] = (float)(cos(e) * cos(a));
            d[2] = (float)sin(e);
        }
    const size_t n = (size_t)MESH_X * MESH_Y;
    return cockpit_sky_look(s->sky, n, direction[0], work, mesh[0][0], 0.0f) &&
           skv_expose(s->sky->at.exposure, n, mesh[0][0], 0, mesh[0][0], 0) == SKV_OK;
}

static void colour_at(float mesh[MESH_Y][MESH_X][3], double x, double y, uint8_t rgb[3]) {
    const int i = (int)fmin(MESH_X - 2, x), j = (int)fmin(MESH_Y - 2, y);
    const double u = x - i, v = y - j;
    float c[3];
    for (int k = 0; k < 3; k++) {
        const double upper = (1 - u) * (double)mesh[j][i][k] + u * (double)mesh[j][i + 1][k];
        const double lower = (1 - u) * (double)mesh[j + 1][i][k] + u * (double)mesh[j + 1][i + 1][k];
        c[k] = (float)((1 - v) * upper + v * lower);
    }
    (void)skv_pack(SKV_FORMAT_SRGB8, 1, c, 0, rgb, 0);
}

/// Each character shows two pixels, one above the other. The sun is drawn where it stands.
static void strip(page *p, const cockpit_shown *s, int columns, int lines) {
    static float mesh[MESH_Y][MESH_X][3];
    const bool ok = s->running && evaluate(s, mesh);
    const double elevation = (double)s->now->sun.elevation_deg;
    const int sun_x = (int)((double)s->now->sun.azimuth_deg / 360.0 * columns) % columns;
    const int sun_y = (int)floor((highest_deg - fmin(highest_deg, elevation)) / (highest_deg - lowest_deg) * lines);
    for (int y = 0; y < lines; y++) {
        for (int x = 0; x < columns && ok; x++) {
            uint8_t upper[3], lower[3];
            const double mx = (x + 0.5) / columns * (MESH_X - 1), step = (MESH_Y - 1) / (2.0 * lines);
            colour_at(mesh, mx, (2 * y + 0.5) * step, upper);
            colour_at(mesh, mx, (2 * y + 1.5) * step, lower);
            if (x == sun_x && y == (sun_y >= lines ? lines - 1 : sun_y))
                put(p, "\033[48;2;%d;%d;%dm\033[38;2;255;240;150m%s", lower[0], lower[1], lower[2],
                    elevation < -0.3 ? "v" : "O");
            else
                put(p, "\033[38;2;%d;%d;%d;48;2;%d;%d;%dm\xe2\x96\x80", upper[0], upper[1], upper[2], lower[0],
                    lower[1], lower[2]);
        }
        put(p, "\033[0m\033[K\r\n");
    }
}

static void compass(page *p, int columns) {
    static const char *const names[] = {"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
    char line[COLUMNS_MAX + 1];
    memset(line, ' ', (size_t)columns);
    for (int i = 0; i < 8; i++) {
        const int at = i * columns / 8;
        for (int k = 0; names[i][k] && at + k < columns; k++)
            line[at + k] = names[i][k];
    }
    line[columns] = '\0';
    put(p, "%s\033[K\r\n", line);
}

/// A line of text, cut at the edge.
static void text_line(page *p, int columns, bool last, const char *format, ...) SKV_PRINTF(4, 5);
static void text_line(page *p, int columns, bool last, const char *format, ...) {
    char line[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    put(p, "%.*s\033[K%s", columns, line, last ? "" : "\r\n");
}

static const char *mark(bool stale) {
    return stale ? "STALE" : "";
}

static void place_lines(page *p, const cockpit_now *n, int columns) {
    char from[40];
    snprintf(from, sizeof from, "above the sea (GPS %+.0f m)", -n->geoid_m);
    const char *const datum = n->datum == SKV_CAS_ELLIPSOID  ? from
                              : n->datum == SKV_CAS_PRESSURE ? "by pressure"
                                                             : "above the sea";
    if (n->has_position)
        text_line(p, columns, false, "Place    %.5f %c  %.5f %c  %s", fabs(n->latitude_deg),
                  n->latitude_deg < 0 ? 'S' : 'N', fabs(n->longitude_deg), n->longitude_deg < 0 ? 'W' : 'E',
                  mark(n->position_stale));
    else
        text_line(p, columns, false, "Place    never received");
    if (n->has_height)
        text_line(p, columns, false, "Height   %.0f m (%.0f ft) %s  %s", n->height_m, n->height_m / 0.3048, datum,
                  mark(n->height_stale));
    else
        text_line(p, columns, false, "Height   never received");
}

static void sky_lines(page *p, const cockpit_shown *s, int columns) {
    const cockpit_now *const n = s->now;
    skv_calendar c = {0};
    const bool dated = n->has_time && skv_utc_to_calendar(&c, &n->utc) == SKV_OK;
    if (n->has_sun)
        text_line(p, columns, false, "Sun      azimuth %7.2f  elevation %7.2f deg %s%s", (double)n->sun.azimuth_deg,
                  (double)n->sun.elevation_deg, n->sun_by_bus ? "(by the bus)" : "",
                  n->held                            ? " THE SKY STANDS STILL: NOTHING FRESH COMES"
                  : s->flags & SKV_VERTICES_BUILDING ? "  the air is being built"
                                                     : "");
    else
        text_line(p, columns, false, "Sun      waiting for position and time, or for the sun's place");
    place_lines(p, n, columns);
    if (dated)
        text_line(p, columns, false, "UTC      %04d-%02d-%02d %02d:%02d:%02d  knob %+.0f min %s", (int)c.year,
                  (int)c.month, (int)c.day, (int)c.hour, (int)c.minute, (int)c.second, n->time_offset_s / 60.0,
                  mark(n->time_stale));
    else
        text_line(p, columns, false, "UTC      never received");
    text_line(p, columns, false, "Air      visibility %.3g km  zenith %.3g cd/m2  exposure %.3g",
              s->sky->air[s->sky->current].visibility_km, s->sky->zenith_cd_m2, s->sky->exposure);
}

static void bus_lines(page *p, const cockpit_shown *s, int columns) {
    char words[64], stale[200];
    const skv_can_counts counts = cockpit_bus_counts(s->bus);
    const uint32_t *const t = s->state->cas.total;
    text_line(p, columns, false, "Bus      %s: %s  received %llu  dropped %llu  errors %llu  bus-off %u", s->bus->name,
              cockpit_bus_words(s->bus, words, sizeof words), (unsigned long long)counts.received,
              (unsigned long long)counts.dropped, (unsigned long long)counts.error_frames, s->bus->bus_offs);
    text_line(p, columns, false, "Faults   missing %u dup %u reordered %u range %u NaN %u type %u service %u node %u",
              t[SKV_CAS_MISSING], t[SKV_CAS_DUPLICATE], t[SKV_CAS_REORDERED], t[SKV_CAS_OUT_OF_RANGE],
              t[SKV_CAS_NOT_FINITE], t[SKV_CAS_BAD_TYPE], t[SKV_CAS_BAD_SERVICE], t[SKV_CAS_OTHER_NODE]);
    cockpit_state_stale(s->state, stale, sizeof stale);
    text_line(p, columns, false, "Stale    %s", stale[0] ? stale : "nothing");
    text_line(p, columns, false, "Panel    %s: %s  lamps: night %s, bus fault %s",
              s->panel->gpio ? "knob" : "no switches, knob", s->panel->visibility ? "visibility" : "time of day",
              s->panel->night ? "ON" : "off", s->panel->bus ? "ON" : "off");
    text_line(p, columns, true, "Picture  no. %llu  %u vertices  %.1f ms each  late %llu  skipped %llu  delay %.1f ms",
              (unsigned long long)s->stats->frames, s->sky->vertices, s->stats->evaluate_ms,
              (unsigned long long)s->stats->late, (unsigned long long)s->stats->skipped,
              cockpit_histogram_ms(&s->stats->latency, 0.5));
}

size_t cockpit_view_picture(const cockpit_shown *s, int columns, int rows, char *text, size_t size) {
    page p = {text, 0, size};
    const int width = columns < 20 ? 20 : columns > COLUMNS_MAX ? COLUMNS_MAX : columns;
    const int lines = rows > LINES + 3 ? (rows - LINES - 1 > 30 ? 30 : rows - LINES - 1) : 0;
    // A character takes at most 60 bytes: what does not fit is drawn narrower.
    const int drawn = lines > 0 && (size_t)width * (size_t)lines * 45 + 4096 > size
                          ? (int)((size - 4096) / 45 / (size_t)lines)
                          : width;
    put(&p, "\033[H");
    if (lines > 0) {
        strip(&p, s, drawn, lines);
        compass(&p, drawn);
    }
    if (rows >= LINES + (lines > 0 ? lines + 1 : 0)) {
        sky_lines(&p, s, width);
        bus_lines(&p, s, width);
    } else {
        text_line(&p, width, true, "sun %.2f %.2f deg, %.0f m %s", (double)s->now->sun.azimuth_deg,
                  (double)s->now->sun.elevation_deg, s->now->height_m, s->now->held ? "HELD" : "");
    }
    put(&p, "\033[0m\033[J");
    return p.used;
}
