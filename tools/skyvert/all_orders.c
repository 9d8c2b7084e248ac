#include "all_orders.h"

#include <stdlib.h>
#include <time.h>

#include "command.h"

const char *const order_names[] = {"single", "all", NULL};
const char *const table_names[] = {"accurate", "small", "large", NULL};

double processor_s(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static skv_status build(skv_table *table, size_t size, const skv_model *model, const skv_table_spec *spec,
                        bool progress) {
    const size_t work_size = skv_table_work_size(spec, model->bands);
    void *const work = malloc(work_size);
    skv_table_builder builder;
    int permille = 0;
    if (!work)
        return SKV_ERR_SIZE;
    skv_status status = skv_table_begin(&builder, model, spec, table, size, work, work_size);
    if (progress)
        progress_begin("table", 1000);
    while (status == SKV_OK && permille < 1000) {
        status = skv_table_step(&builder, &permille);
        if (progress)
            progress_update((size_t)permille);
    }
    if (progress)
        progress_end();
    free(work);
    return status;
}

static int refuse(const char *command, skv_status status) {
    if (status == SKV_ERR_UNSUPPORTED)
        return fail_job("skyvert %s: this build of the core lacks light scattered more than once: use --orders single",
                        command);
    if (status == SKV_ERR_SIZE)
        return fail_job("skyvert %s: no memory for the table of light scattered more than once", command);
    return fail_usage("skyvert %s: --orders all: the core refuses this air or ground (status %d): the ground lies from "
                      "-12 to 12 km and below the top of the air",
                      command, (int)status);
}

int all_orders_build(all_orders *out, const char *command, const skv_model *model, skv_table_kind kind, float ground_km,
                     bool progress) {
    skv_table_spec spec;
    if (out->table && out->table->model == model->hash && out->ground_km <= ground_km && out->ground_km >= ground_km)
        return 0;
    all_orders_free(out);
    if (skv_table_spec_for(&spec, model, kind) != SKV_OK)
        return refuse(command, SKV_ERR_UNSUPPORTED);
    spec.ground_km = ground_km;
    spec.format = out->floats ? SKV_TABLE_FLOAT : SKV_TABLE_PACKED;
    if (out->sizes[2] > 0) {
        spec.altitudes = out->sizes[0];
        spec.detailed = out->sizes[1];
        spec.suns = out->sizes[2];
    }
    const size_t size = skv_table_size(&spec, model->bands);
    out->table = size > 0 ? malloc(size) : NULL;
    const double start_s = processor_s();
    const skv_status status = size == 0    ? SKV_ERR_RANGE
                              : out->table ? build(out->table, size, model, &spec, progress)
                                           : SKV_ERR_SIZE;
    if (status != SKV_OK) {
        all_orders_free(out);
        return refuse(command, status);
    }
    out->build_s += processor_s() - start_s;
    out->ground_km = ground_km;
    return 0;
}

void all_orders_free(all_orders *out) {
    free(out->table);
    out->table = NULL;
}
