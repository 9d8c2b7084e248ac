/// Any bytes as queries and as a density table: numbers in range, or named bad rows.
#define _XOPEN_SOURCE 700
#include "tests/command/fuzz.h"

#include "tools/skyvert/csv.h"
#include "tools/skyvert/queries.h"

static void check_good(const query_list *q) {
    FUZZ_CHECK(said.errors == 0);
    for (size_t i = 0; i < q->rows; i++) {
        const double *const v = q->row[i].value;
        FUZZ_CHECK(v[0] >= 0 && v[0] <= 1e6 && v[1] >= 0 && v[1] <= 180 && v[2] >= 0 && v[2] <= 180 &&
                   v[3] - v[3] == 0);
        const char *text = q->text + q->row[i].text;
        for (int c = 0; c < QUERY_COLUMNS; c++, text += strlen(text) + 1)
            FUZZ_CHECK(strtod(text, NULL) == v[c] && !strpbrk(text, ",\"\r\n"));
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    query_list queries;
    uint8_t empty = ' ';
    FILE *const stream = fmemopen(size ? (void *)(uintptr_t)data : &empty, size ? size : 1, "rb");
    FUZZ_CHECK(stream);
    memset(&said, 0, sizeof said);
    const int result = queries_read(&queries, stream, "fuzz.csv");
    fclose(stream);
    if (result == 0)
        check_good(&queries);
    else
        FUZZ_CHECK(result == EXIT_USAGE && said.errors >= 1 && said.errors <= BAD_ROWS_NAMED + 1);
    queries_free(&queries);
    return 0;
}
