/// gtx2pgm IN.gtx OUT.pgm: a global geoid grid of PROJ's kind into the kind that GeographicLib::Geoid reads.
///
/// GTX: big-endian; south-west corner (lat, lon) and steps (lat, lon) as doubles, rows and columns as 32-bit integers,
/// then float32 metres, rows from the south, columns eastwards.
/// PGM: 16-bit big-endian, rows from the north, columns from 0 E; metres = offset + scale * value, both in comments.
/// Written beside and renamed. Exit status 2: not such a grid; 1: writing failed.
#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { HEADER = 40, MOST_ROWS = 21601, MOST_COLUMNS = 43200 };

// The range -108 to 88.6 m holds every geoid of the Earth; half a step, 1.5 mm, is the price of 16 bits.
static const double offset_m = -108, scale_m = 0.003;
static const float missing = -88.8888f; // GTX's mark

typedef struct {
    double south_deg, west_deg, lat_step_deg, lon_step_deg;
    long rows, columns;
    unsigned char *raw; // rows * columns float32
} gtx;

static uint32_t get_u32(const unsigned char *b) {
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

static double get_f64(const unsigned char *b) {
    const uint64_t bits = (uint64_t)get_u32(b) << 32 | get_u32(b + 4);
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static double get_f32(const unsigned char *b) {
    const uint32_t bits = get_u32(b);
    float x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static int complain(const char *file, const char *what) {
    fprintf(stderr, "gtx2pgm: %s: %s\n", file, what);
    return 2;
}

/// GeographicLib needs both poles, the whole circle, an odd number of rows and an even one of columns.
static const char *check_shape(const gtx *g) {
    if (g->rows < 3 || g->rows > MOST_ROWS || g->columns < 2 || g->columns > MOST_COLUMNS)
        return "no GTX header (3 to 21601 rows, 2 to 43200 columns)";
    if (g->rows % 2 == 0 || g->columns % 2 != 0)
        return "needs an odd number of rows and an even number of columns";
    const double north = g->south_deg + (double)(g->rows - 1) * g->lat_step_deg;
    if (!(fabs(g->south_deg + 90) < 1e-9 && fabs(north - 90) < 1e-9))
        return "does not reach from pole to pole";
    if (!(fabs((double)g->columns * g->lon_step_deg - 360) < 1e-9))
        return "does not go around the Earth";
    const double first = fmod(-g->west_deg / g->lon_step_deg, 1);
    if (!(fabs(g->west_deg) <= 360 && fabs(first - nearbyint(first)) < 1e-9))
        return "has no column at longitude 0";
    return NULL;
}

static const char *read_body(FILE *f, gtx *g) {
    unsigned char head[HEADER];
    if (fread(head, 1, HEADER, f) != HEADER)
        return "shorter than a GTX header (40 bytes)";
    g->south_deg = get_f64(head);
    g->west_deg = get_f64(head + 8);
    g->lat_step_deg = get_f64(head + 16);
    g->lon_step_deg = get_f64(head + 24);
    g->rows = (long)(int32_t)get_u32(head + 32);
    g->columns = (long)(int32_t)get_u32(head + 36);
    const char *wrong = check_shape(g);
    if (wrong)
        return wrong;
    const size_t bytes = (size_t)g->rows * (size_t)g->columns * 4;
    g->raw = malloc(bytes);
    if (!g->raw)
        return "out of memory";
    if (fread(g->raw, 1, bytes, f) != bytes)
        return "is cut short";
    return fgetc(f) == EOF ? NULL : "has bytes after its last row";
}

static int read_gtx(const char *file, gtx *g) {
    FILE *f = fopen(file, "rb");
    if (!f)
        return complain(file, strerror(errno));
    const char *wrong = read_body(f, g);
    (void)fclose(f);
    return wrong ? complain(file, wrong) : 0;
}

/// 16-bit values in the PGM's order. False where one is not a height of a geoid.
static int quantise(const gtx *g, unsigned char *out) {
    const long shift = lrint(-g->west_deg / g->lon_step_deg);
    for (long y = 0; y < g->rows; y++)
        for (long x = 0; x < g->columns; x++) {
            const long row = g->rows - 1 - y, column = ((x + shift) % g->columns + g->columns) % g->columns;
            const double metres = get_f32(g->raw + 4 * (row * g->columns + column));
            const double value = nearbyint((metres - offset_m) / scale_m);
            if (!(value >= 0 && value <= 65535) || metres == (double)missing)
                return 0;
            const unsigned v = (unsigned)value;
            *out++ = (unsigned char)(v >> 8);
            *out++ = (unsigned char)(v & 255);
        }
    return 1;
}

static int put(FILE *f, const gtx *g, const unsigned char *values) {
    const char *head = "P5\n# Geoid file in PGM format for the GeographicLib::Geoid class\n"
                       "# Description Geoid heights in metres, from a GTX grid, by gtx2pgm\n"
                       "# AREA_OR_POINT Point\n# Vertical_Datum WGS84\n";
    const size_t bytes = (size_t)g->rows * (size_t)g->columns * 2;
    return fprintf(f, "%s# Offset %.0f\n# Scale %g\n# Origin 90N 0E\n%ld %ld\n65535\n", head, offset_m, scale_m,
                   g->columns, g->rows) > 0 &&
           fwrite(values, 1, bytes, f) == bytes && fflush(f) == 0 && fsync(fileno(f)) == 0;
}

static int write_pgm(const char *file, const gtx *g, const unsigned char *values) {
    char beside[4096];
    const int n = snprintf(beside, sizeof beside, "%s.%ld.tmp", file, (long)getpid());
    FILE *f = n > 0 && (size_t)n < sizeof beside ? fopen(beside, "wb") : NULL;
    if (!f) {
        fprintf(stderr, "gtx2pgm: %s: %s\n", file, strerror(errno));
        return 1;
    }
    const int written = put(f, g, values);
    const int closed = fclose(f) == 0;
    if (written && closed && rename(beside, file) == 0)
        return 0;
    fprintf(stderr, "gtx2pgm: %s: %s\n", file, strerror(errno));
    (void)remove(beside);
    return 1;
}

int main(int argc, char **argv) {
    if (argc != 3) {
        fprintf(stderr, "usage: gtx2pgm IN.gtx OUT.pgm\n");
        return 2;
    }
    gtx g = {0, 0, 0, 0, 0, 0, NULL};
    int status = read_gtx(argv[1], &g);
    unsigned char *values = status == 0 ? malloc((size_t)g.rows * (size_t)g.columns * 2) : NULL;
    if (status == 0 && !values)
        status = complain(argv[1], "out of memory");
    if (status == 0 && !quantise(&g, values))
        status = complain(argv[1], "holds missing values, or heights outside -108 to 88.6 m");
    if (status == 0)
        status = write_pgm(argv[2], &g, values);
    free(values);
    free(g.raw);
    return status;
}
