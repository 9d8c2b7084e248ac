// Tables as EXR, read back bit for bit by another reader: oiiotool copies the file without compression, and what a copy
// looks like is known (each line: its number, its bytes, the channels one after the other in the order of their names).
#include <errno.h>
#include <math.h>

#include "api/random.h"
#include "port/openexr/skv_exr_texture.h"
#include "ports.h"

// 2 KiB (floats) or 1 KiB (halves) a chunk of 16 lines: short enough that ZIP often gives just as many bytes.
enum { WIDTH = 8, LAYERS = 2, CHANNELS = 2, PLANES = LAYERS * CHANNELS, CHUNK = 16, CHUNKS = 2500 };
enum { HEIGHT = CHUNK * CHUNKS - 5, VALUES = PLANES * WIDTH * HEIGHT };

static float texels[VALUES];
static uint32_t patterns[HEIGHT][PLANES * WIDTH]; // the same numbers as bits, plane after plane
static unsigned char bytes[8 * VALUES];

static skv_exr_texture texture_of(bool half) {
    return (skv_exr_texture){.width = WIDTH,
                             .height = HEIGHT,
                             .layers = LAYERS,
                             .channels = CHANNELS,
                             .layer_name = {NULL, "aerosol"},
                             .pixels = texels,
                             .half = half};
}

static float *texel(int plane, int x, int y) {
    return &texels[((plane / CHANNELS * HEIGHT + y) * WIDTH + x) * CHANNELS + plane % CHANNELS];
}

/// The value of a finite half, from its definition.
static float half_value(uint32_t half) {
    const int power = half >> 10 & 31;
    const float size = ldexpf((float)((half & 1023) + (power > 0 ? 1024 : 0)), (power > 0 ? power : 1) - 25);
    return half >> 15 ? -size : size;
}

/// Finite numbers of the file's type: 1 with more and more random bits from chunk to chunk: from well compressible to
/// not at all, again and again.
static void fill_with_noise(bool half) {
    const uint32_t one = half ? 0x3c00u : 0x3f800000u, infinity = half ? 0x7c00u : 0x7f800000u;
    const int bits = half ? 16 : 32;
    for (int y = 0; y < HEIGHT; y++)
        for (int i = 0; i < WIDTH * PLANES; i++) {
            uint32_t pattern = one ^ random_word() >> (32 - 1 - y / CHUNK % bits);
            if ((pattern & infinity) == infinity)
                pattern ^= one;
            patterns[y][i] = pattern;
            if (half)
                *texel(i / WIDTH, i % WIDTH, y) = half_value(pattern);
            else
                memcpy(texel(i / WIDTH, i % WIDTH, y), &pattern, sizeof pattern);
        }
}

/// The file's bytes. @return how many
static size_t read_all(void) {
    FILE *file = fopen(path, "rb");
    assert_true(file != NULL);
    const size_t n = fread(bytes, 1, sizeof bytes, file);
    assert_true(n > 0 && n < sizeof bytes);
    fclose(file);
    return n;
}

/// Where the list of chunks begins: behind the attributes, each a name, a type, its size and its value.
static size_t end_of_header(void) {
    size_t at = 8;
    while (bytes[at] != 0) {
        uint32_t size;
        for (int i = 0; i < 2; i++)
            at += strlen((char *)&bytes[at]) + 1;
        memcpy(&size, &bytes[at], sizeof size); // little-endian, as the machines that run this
        at += 4 + size;
    }
    return at + 1;
}

/// Chunks that are as long as their texels: readers take them for texels.
static int chunks_as_they_are(size_t texel_bytes) {
    const size_t list = end_of_header();
    int count = 0;
    for (size_t i = 0; i < CHUNKS; i++) {
        uint64_t at;
        uint32_t size;
        memcpy(&at, &bytes[list + 8 * i], sizeof at);
        memcpy(&size, &bytes[at + 4], sizeof size);
        count += size == CHUNK * WIDTH * PLANES * texel_bytes;
    }
    return count;
}

/// Compares the copy, from its end: lines of 8 bytes and the planes G, R, aerosol.G, aerosol.R.
static void compare_copy(size_t texel_bytes) {
    static const int plane_at[PLANES] = {1, 0, 3, 2};
    const size_t line = 8 + WIDTH * PLANES * texel_bytes, first = read_all() - HEIGHT * line;
    for (int y = 0; y < HEIGHT; y++)
        for (int i = 0; i < PLANES * WIDTH; i++) {
            const uint32_t want = patterns[y][plane_at[i / WIDTH] * WIDTH + i % WIDTH];
            uint32_t got = 0;
            memcpy(&got, &bytes[first + (size_t)y * line + 8 + (size_t)i * texel_bytes], texel_bytes);
            if (got != want)
                fail_msg("chunk %d, line %d, plane %d, column %d: got the bits %08x, want %08x", y / CHUNK, y,
                         i / WIDTH, i % WIDTH, (unsigned)got, (unsigned)want);
        }
}

static void read_back(bool half) {
    const size_t texel_bytes = half ? 2 : 4;
    const skv_exr_texture texture = texture_of(half);
    char message[200], copy[800];
    fill_with_noise(half);
    const int fd = open_file(half ? "half.exr" : "float.exr"),
              result = skv_exr_texture_write(fd, &texture, message, sizeof message);
    if (result != SKV_EXR_OK)
        fail_msg("%d: %s", result, message);
    close(fd);
    (void)read_all();
    const int raw = chunks_as_they_are(texel_bytes);
    snprintf(copy, sizeof copy, "oiiotool '%s' --compression none -o", path);
    close(open_file("copy.exr"));
    (void)output_of(copy);
    compare_copy(texel_bytes);
    print_message("figure: table of %s noise: %d of %d chunks are not shorter than their texels, all bits read back\n",
                  half ? "half" : "float", raw, CHUNKS);
    assert_true(raw > CHUNKS / 10 && raw < CHUNKS * 9 / 10); // both kinds, so the border between them was met
}

static void noise_of_floats(void **state) {
    (void)state;
    read_back(false);
}

static void noise_of_halves(void **state) {
    (void)state;
    read_back(true);
}

static void expect_texture(int want, int fd, const skv_exr_texture *texture, const char *words) {
    char message[200] = "";
    assert_int_equal(skv_exr_texture_write(fd, texture, message, sizeof message), want);
    expect_line(message, words);
}

static void refused(void **state) {
    (void)state;
    const int full = open("/dev/full", O_WRONLY), fd = open_file("never.exr");
    assert_true(full >= 0);
    const skv_exr_texture good = texture_of(true);
    skv_exr_texture texture = good;
    expect_texture(SKV_EXR_ERR_WRITE, full, &texture, strerror(ENOSPC));
    expect_texture(SKV_EXR_ERR_WRITE, -1, &texture, strerror(EBADF));
    expect_texture(SKV_EXR_ERR_ARGUMENT, fd, NULL, "no pixels");
    texture.height = SKV_EXR_TEXTURE_SIDE_MAX + 1;
    expect_texture(SKV_EXR_ERR_ARGUMENT, fd, &texture, "width or height");
    texture = good;
    texture.layers = SKV_EXR_TEXTURE_LAYERS_MAX + 1;
    expect_texture(SKV_EXR_ERR_ARGUMENT, fd, &texture, "layers");
    texture = good;
    texture.layer_name[1] = NULL;
    expect_texture(SKV_EXR_ERR_ARGUMENT, fd, &texture, "layer without a name");
    texture = good;
    texture.text_name = "a name";
    expect_texture(SKV_EXR_ERR_ARGUMENT, fd, &texture, "attribute without a value");
    assert_int_equal(lseek(fd, 0, SEEK_END), 0); // nothing was written for a bad argument
    assert_int_equal(skv_exr_texture_write(fd, &good, NULL, 0), SKV_EXR_ERR_ARGUMENT);
    close(fd);
    close(full);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(noise_of_floats),
        cmocka_unit_test(noise_of_halves),
        cmocka_unit_test(refused),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
