/// Any bytes as an atmosphere file: accepted whole by the core, or refused with one line.
#define _XOPEN_SOURCE 700
#include "tests/command/fuzz.h"

#include "tools/skyvert/ini.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static skv_model model;
    atmosphere_file file;
    uint8_t empty = ' ';
    FILE *const stream = fmemopen(size ? (void *)(uintptr_t)data : &empty, size ? size : 1, "rb");
    FUZZ_CHECK(stream);
    memset(&said, 0, sizeof said);
    const int result = atmosphere_read(&file, stream, "fuzz.ini");
    fclose(stream);
    if (result) {
        FUZZ_CHECK(result == EXIT_USAGE && said.errors == 1);
        return 0;
    }
    FUZZ_CHECK(said.errors == 0);
    // A core that was built without a term may refuse it; nothing else.
    const skv_status status = skv_model_build(&model, &file.atmosphere);
    if (status != SKV_OK)
        fprintf(stderr, "skv_model_build: %d\n", (int)status);
    FUZZ_CHECK(status == SKV_OK);
    for (int b = 0; b < file.atmosphere.bands; b++)
        FUZZ_CHECK(isdigit((unsigned char)file.band_name[b][0]));
    atmosphere_free(&file);
    return 0;
}
