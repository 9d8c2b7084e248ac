// The EXR and PNG writers, read back by other programs: oiiotool, exrheader, pngcheck. Each test writes a file whose
// every sample is known and compares what the other program prints.
#include <errno.h>
#include <math.h>

#include "port/openexr/skv_exr.h"
#include "port/png/skv_png.h"
#include "ports.h"

#define WIDTH  37 // neither a multiple of anything nor of the 16 lines of a chunk
#define HEIGHT 35

/// Samples over many powers of two, some negative, no two alike.
static float sample(int x, int y, int c) {
    const float sign = (x + y) % 7 == 0 ? -1.0f : 1.0f;
    return sign * ldexpf(1.0f + (float)(x * 4 + c) / 1024.0f, y - 20);
}

static float *pattern(int channels) {
    float *pixels = malloc(sizeof(float) * WIDTH * HEIGHT * (size_t)channels);
    assert_true(pixels != NULL);
    for (int i = 0; i < WIDTH * HEIGHT * channels; i++)
        pixels[i] = sample(i / channels % WIDTH, i / channels / WIDTH, i % channels);
    return pixels;
}

static skv_exr_image picture_of(const float *pixels, int channels) {
    return (skv_exr_image){.width = WIDTH,
                           .height = HEIGHT,
                           .channels = channels,
                           .pixels = pixels,
                           .white_luminance = 1000.0f,
                           .screen_window_width = 1.0f};
}

static void write_exr(const char *name, const skv_exr_image *image) {
    char message[200];
    const int fd = open_file(name);
    const int result = skv_exr_write(fd, image, message, sizeof message);
    if (result != SKV_EXR_OK)
        fail_msg("%s: %d: %s", name, result, message);
    close(fd);
}

/// Compares what oiiotool prints with the samples. @param relative  of rounding to the file's type
static void compare_samples(const float *pixels, int channels, double relative, double absolute) {
    const char *at = output_of("oiiotool --dumpdata");
    int seen = 0;
    for (const char *line = strstr(at, "Pixel ("); line; line = strstr(line + 1, "Pixel (")) {
        int x, y, used;
        assert_int_equal(sscanf(line, "Pixel (%d, %d):%n", &x, &y, &used), 2);
        char *number = (char *)(uintptr_t)(line + used);
        for (int c = 0; c < channels; c++) {
            const double want = (double)pixels[(y * WIDTH + x) * channels + c];
            check_near("sample", strtod(number, &number), want, fabs(want) * relative + absolute);
        }
        seen++;
    }
    assert_int_equal(seen, WIDTH * HEIGHT);
}

static void test_exr_float(void **state) {
    (void)state;
    float *pixels = pattern(3);
    const skv_exr_image image = picture_of(pixels, 3);
    write_exr("float.exr", &image);
    compare_samples(pixels, 3, 1e-8, 5e-10); // ZIP is exact; oiiotool prints nine digits, at most nine decimals
    free(pixels);
}

static void test_exr_half(void **state) {
    (void)state;
    float *pixels = pattern(4);
    skv_exr_image image = picture_of(pixels, 4);
    image.half = true;
    write_exr("half.exr", &image);
    compare_samples(pixels, 4, 1.0 / 2048.0,
                    3.1e-8); // half of the last of 11 bits; of the subnormal step 2^-24, and print
    expect_line(output_of("exrheader"), "A, 16-bit floating-point");
    free(pixels);
}

/// A chunk that is as long as its pixels is taken for pixels by every reader: it must hold them and no ZIP stream of
/// that length. Pictures of one line, more and more of its bits random, from well compressible to not at all.
static void test_exr_incompressible(void **state) {
    (void)state;
    enum { WIDE = 81, BYTES = WIDE * 12 };
    float pixels[WIDE * 3], stored[WIDE * 3];
    uint32_t random = 1, raw = 0;
    for (int round = 0; round < 600; round++) {
        for (int i = 0; i < WIDE * 3; i++) {
            random = random * 1664525u + 1013904223u;
            const uint32_t mask = (1u << (8 + round % 16)) - 1u,
                           bits = 0x3f800000u | ((random >> 8) & mask & 0x7fffffu);
            memcpy(&pixels[i], &bits, sizeof bits);
        }
        skv_exr_image image = picture_of(pixels, 3);
        image.width = WIDE;
        image.height = 1;
        write_exr("noise.exr", &image);
        const int fd = open(path, O_RDONLY);
        int32_t size = 0;
        const off_t end = lseek(fd, 0, SEEK_END);
        assert_true(pread(fd, &size, sizeof size, end - BYTES - 4) == (ssize_t)sizeof size);
        assert_true(pread(fd, stored, BYTES, end - BYTES) == BYTES);
        close(fd);
        raw += size == BYTES;
        for (int i = 0; i < WIDE * 3 && size == BYTES; i++) // planes B, G, R
            if (memcmp(&stored[i], &pixels[3 * (i % WIDE) + 2 - i / WIDE], sizeof stored[i]) != 0)
                fail_msg("round %d: the chunk is as long as its pixels, but is not they (sample %d)", round, i);
    }
    print_message("figure: EXR chunks that ZIP does not shorten: %u of 600, all readable\n", (unsigned)raw);
    assert_true(raw > 50 && raw < 550); // both kinds, so the border between them was met
}

/// No infinite half, and no NaN: 65520 would already round to infinity.
static void test_exr_extremes(void **state) {
    (void)state;
    static const float hot[] = {65503.0f, 65504.0f, 65519.0f, 65520.0f, 65536.0f, 1e30f, -1e9f, INFINITY, -INFINITY};
    float *pixels = pattern(3);
    for (size_t i = 0; i < sizeof hot / sizeof hot[0]; i++)
        pixels[3 * i] = hot[i];
    pixels[100] = NAN;
    skv_exr_image image = picture_of(pixels, 3);
    image.half = true;
    write_exr("hot.exr", &image);
    const char *text = output_of("oiiotool --stats");
    expect_line(text, "Stats NanCount: 0 0 0");
    expect_line(text, "Stats InfCount: 0 0 0");
    expect_line(text, "Stats Max: 65504.0");
    expect_line(text, "Stats Min: -65504.0");
    image.half = false;
    write_exr("hot-float.exr", &image);
    text = output_of("oiiotool --stats");
    expect_line(text, "Stats NanCount: 0 0 0");
    expect_line(text, "Stats InfCount: 0 0 0");
    free(pixels);
}

static void test_exr_attributes(void **state) {
    (void)state;
    float *pixels = pattern(3);
    const skv_exr_extra extra[] = {{"skyvert.sunElevationDeg", -4.25f}};
    skv_exr_image image = picture_of(pixels, 3);
    image.latlong = true;
    image.has_position = true;
    image.latitude_deg = 47.5f;
    image.longitude_deg = -8.25f;
    image.altitude_m = -411.5f;
    image.cap_date = "2021:08:17 06:30:00";
    image.utc_offset_s = -7200.0f;
    image.owner = "somebody";
    image.software = "a test";
    image.comments = "two\nlines";
    image.extra = extra;
    image.extras = 1;
    write_exr("attributes.exr", &image);
    const char *text = output_of("exrheader");
    const char *const lines[] = {"latitude (type float): 47.5",
                                 "longitude (type float): -8.25",
                                 "altitude (type float): -411.5",
                                 "capDate (type string): \"2021:08:17 06:30:00\"",
                                 "utcOffset (type float): -7200",
                                 "whiteLuminance (type float): 1000",
                                 "envmap (type envmap): latitude-longitude map",
                                 "red   (0.64 0.33)",
                                 "green (0.3 0.6)",
                                 "blue  (0.15 0.06)",
                                 "white (0.3127 0.329)",
                                 "owner (type string): \"somebody\"",
                                 "software (type string): \"a test\"",
                                 "skyvert.sunElevationDeg (type float): -4.25",
                                 "compression (type compression): zip, multi-scanline blocks",
                                 "dataWindow (type box2i): (0 0) - (36 34)"};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++)
        expect_line(text, lines[i]);
    image = picture_of(pixels, 3);
    write_exr("bare.exr", &image);
    text = output_of("exrheader");
    assert_true(!strstr(text, "latitude") && !strstr(text, "capDate") && !strstr(text, "envmap"));
    free(pixels);
}

static void expect_exr(int want, int fd, const skv_exr_image *image, const char *words) {
    char message[200] = "";
    assert_int_equal(skv_exr_write(fd, image, message, sizeof message), want);
    expect_line(message, words);
}

static void test_exr_errors(void **state) {
    (void)state;
    float *pixels = pattern(3);
    const int full = open("/dev/full", O_WRONLY);
    const int fd = open_file("never.exr");
    assert_true(full >= 0);
    const skv_exr_image good = picture_of(pixels, 3);
    skv_exr_image image = good;
    expect_exr(SKV_EXR_ERR_WRITE, full, &image, strerror(ENOSPC));
    expect_exr(SKV_EXR_ERR_WRITE, -1, &image, strerror(EBADF));
    expect_exr(SKV_EXR_ERR_ARGUMENT, fd, NULL, "no pixels");
    image.width = SKV_EXR_SIDE_MAX + 1;
    expect_exr(SKV_EXR_ERR_ARGUMENT, fd, &image, "width or height");
    image = good;
    image.channels = 2;
    expect_exr(SKV_EXR_ERR_ARGUMENT, fd, &image, "channels");
    image = good;
    image.white_luminance = NAN;
    expect_exr(SKV_EXR_ERR_ARGUMENT, fd, &image, "white_luminance");
    assert_int_equal(lseek(fd, 0, SEEK_END), 0); // nothing was written for a bad argument
    assert_int_equal(skv_exr_write(fd, &good, NULL, 0), SKV_EXR_ERR_ARGUMENT);
    close(fd);
    close(full);
    free(pixels);
}

// ---- PNG

static skv_png_image png_of(const void *pixels, int channels, int bits) {
    return (skv_png_image){.width = WIDTH, .height = HEIGHT, .channels = channels, .bits = bits, .pixels = pixels};
}

static void write_png(const char *name, const skv_png_image *image) {
    char message[200];
    const int fd = open_file(name);
    const int result = skv_png_write(fd, image, message, sizeof message);
    if (result != SKV_PNG_OK)
        fail_msg("%s: %d: %s", name, result, message);
    close(fd);
}

/// oiiotool prints whole samples before those in brackets.
static void compare_png(const int *want, int channels) {
    const char *at = output_of("oiiotool --no-autopremult --dumpdata");
    int seen = 0;
    for (const char *line = strstr(at, "Pixel ("); line; line = strstr(line + 1, "Pixel (")) {
        int x, y, used;
        assert_int_equal(sscanf(line, "Pixel (%d, %d):%n", &x, &y, &used), 2);
        char *number = (char *)(uintptr_t)(line + used);
        for (int c = 0; c < channels; c++)
            assert_int_equal(strtol(number, &number, 10), want[(y * WIDTH + x) * channels + c]);
        seen++;
    }
    assert_int_equal(seen, WIDTH * HEIGHT);
}

static void test_png(void **state) {
    (void)state;
    static const struct {
        const char *name, *words;
        int channels, bits;
    } kind[] = {{"rgb8.png", "24-bit RGB", 3, 8},
                {"rgba8.png", "32-bit RGB+alpha", 4, 8},
                {"rgb16.png", "48-bit RGB", 3, 16},
                {"rgba16.png", "64-bit RGB+alpha", 4, 16}};
    const skv_png_text text[] = {{"Software", "a test"}, {"Comment", "words"}};
    for (size_t k = 0; k < sizeof kind / sizeof kind[0]; k++) {
        static int want[WIDTH * HEIGHT * 4];
        static uint8_t bytes[WIDTH * HEIGHT * 4];
        static uint16_t words[WIDTH * HEIGHT * 4];
        for (int i = 0; i < WIDTH * HEIGHT * kind[k].channels; i++) {
            words[i] = (uint16_t)((unsigned)i * 40503u >> 3);
            bytes[i] = (uint8_t)(words[i] >> 4);
            want[i] = kind[k].bits == 8 ? bytes[i] : words[i];
        }
        skv_png_image image = png_of(kind[k].bits == 8 ? (void *)bytes : (void *)words, kind[k].channels, kind[k].bits);
        image.text = text;
        image.texts = 2;
        write_png(kind[k].name, &image);
        const char *report = output_of("pngcheck -tv");
        expect_line(report, kind[k].words);
        expect_line(report, "No errors detected");
        expect_line(report, "chunk sRGB");
        expect_line(report, "chunk gAMA");
        expect_line(report, "a test");
        compare_png(want, kind[k].channels);
    }
}

static void expect_png(int want, int fd, const skv_png_image *image, const char *words) {
    char message[200] = "";
    assert_int_equal(skv_png_write(fd, image, message, sizeof message), want);
    expect_line(message, words);
}

static void test_png_errors(void **state) {
    (void)state;
    static uint8_t bytes[WIDTH * HEIGHT * 4];
    const int full = open("/dev/full", O_WRONLY);
    assert_true(full >= 0);
    skv_png_image image = png_of(bytes, 3, 8);
    expect_png(SKV_PNG_ERR_WRITE, full, &image, strerror(ENOSPC));
    expect_png(SKV_PNG_ERR_WRITE, -1, &image, strerror(EBADF));
    expect_png(SKV_PNG_ERR_ARGUMENT, full, NULL, "no pixels");
    image.bits = 12;
    expect_png(SKV_PNG_ERR_ARGUMENT, full, &image, "bits");
    image = png_of(bytes, 3, 8);
    image.texts = 1;
    expect_png(SKV_PNG_ERR_ARGUMENT, full, &image, "texts");
    image = png_of(bytes, 3, 8);
    image.width = 0;
    expect_png(SKV_PNG_ERR_ARGUMENT, full, &image, "width or height");
    close(full);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_exr_float),
        cmocka_unit_test(test_exr_half),
        cmocka_unit_test(test_exr_extremes),
        cmocka_unit_test(test_exr_incompressible),
        cmocka_unit_test(test_exr_attributes),
        cmocka_unit_test(test_exr_errors),
        cmocka_unit_test(test_png),
        cmocka_unit_test(test_png_errors),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
