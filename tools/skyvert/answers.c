/// Groups queries by altitude and sun into frames, evaluates each frame's directions as one batch.
#include "answers.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"

void sin_cos_deg(double degrees, double *sine, double *cosine) {
    const double pi = 3.14159265358979323846;
    const double turn = fmod(degrees, 360); // exact
    const double quarter = floor(turn / 90 + .5);
    const double rest = (turn - 90 * quarter) * (pi / 180); // [-45, 45] deg, the difference exact
    const double s = sin(rest), c = cos(rest);
    switch (((int)quarter % 4 + 4) % 4) {
    case 0:
        *sine = s, *cosine = c;
        break;
    case 1:
        *sine = c, *cosine = -s;
        break;
    case 2:
        *sine = -s, *cosine = -c;
        break;
    default:
        *sine = -c, *cosine = s;
        break;
    }
    *sine += 0; // -0 becomes +0
    *cosine += 0;
}

/// What one run works on.
typedef struct job {
    const query_list *queries;
    const answers_source *source;
    float *grid;      ///< room for one, or NULL
    size_t grid_size; ///< of that room, bytes
    size_t *order;    ///< [rows] places of the queries, those of a frame side by side
    float *direction; ///< [rows][3] in that order
    float *radiance;  ///< [rows][bands] in that order
} job;

/// qsort has no argument for the list.
static const query *sorted;

static int compare(const void *a, const void *b) {
    const size_t i = *(const size_t *)a, k = *(const size_t *)b;
    for (int c = QUERY_ALTITUDE; c <= QUERY_SUN; c++) {
        if (sorted[i].value[c] < sorted[k].value[c])
            return -1;
        if (sorted[i].value[c] > sorted[k].value[c])
            return 1;
    }
    return i < k ? -1 : i > k;
}

static bool same_frame(const query *a, const query *b) {
    return !(a->value[QUERY_ALTITUDE] < b->value[QUERY_ALTITUDE]) &&
           !(a->value[QUERY_ALTITUDE] > b->value[QUERY_ALTITUDE]) && !(a->value[QUERY_SUN] < b->value[QUERY_SUN]) &&
           !(a->value[QUERY_SUN] > b->value[QUERY_SUN]);
}

static void set_direction(const query *q, float direction[3]) {
    double sin_zenith, cos_zenith, sin_azimuth, cos_azimuth;
    sin_cos_deg(q->value[QUERY_VIEW], &sin_zenith, &cos_zenith);
    sin_cos_deg(q->value[QUERY_AZIMUTH], &sin_azimuth, &cos_azimuth);
    direction[0] = (float)(sin_zenith * sin_azimuth);
    direction[1] = (float)(sin_zenith * cos_azimuth);
    direction[2] = (float)cos_zenith;
}

/// High up the core refuses a grid: rays are integrated there.
static skv_status lay_grid(job *j, skv_frame *frame) {
    const size_t size = skv_grid_size(frame);
    if (size > j->grid_size) {
        free(j->grid);
        j->grid = malloc(size);
        j->grid_size = j->grid ? size : 0;
    }
    const skv_status status = skv_frame_grid(frame, j->grid, j->grid_size);
    return status == SKV_ERR_RANGE ? SKV_OK : status;
}

enum { BATCH = 4096 }; // between two looks at the clock

/// A published model has four numbers a ray, whatever the bands.
static skv_status evaluate_other(const job *j, const query *q, const float sun[3], size_t first, size_t end) {
    static float radiance[BATCH][4];
    const size_t bands = (size_t)j->source->model->bands;
    const baseline_view view = {q->value[QUERY_ALTITUDE], {(double)sun[0], (double)sun[1], (double)sun[2]}};
    const char *why;
    if (j->source->other->frame(j->source->other_state, &view, &why) != 0)
        return SKV_ERR_UNSUPPORTED;
    j->source->other->radiance(j->source->other_state, end - first, (const float(*)[3])(j->direction + 3 * first),
                               radiance);
    for (size_t i = first; i < end; i++)
        memcpy(j->radiance + bands * i, radiance[i - first], bands * sizeof(float));
    return SKV_OK;
}

/// The queries [first, end) of j->order, all with one altitude and sun: azimuth 0, toward the sun, is north.
static skv_status evaluate_frame(job *j, size_t first, size_t end) {
    const answers_source *const by = j->source;
    const query *const q = &j->queries->row[j->order[first]];
    double sin_sun, cos_sun;
    sin_cos_deg(q->value[QUERY_SUN], &sin_sun, &cos_sun);
    const float sun[3] = {0, (float)sin_sun, (float)cos_sun};
    skv_light light;
    skv_frame frame;
    if (by->other)
        return evaluate_other(j, q, sun, first, end);
    skv_status status = skv_light_sun(&light, by->model, sun);
    if (status == SKV_OK)
        status = skv_frame_begin(&frame, by->model, by->quality, (float)q->value[QUERY_ALTITUDE], 0, &light, 1);
    if (status == SKV_OK)
        status = skv_frame_table(&frame, by->table);
    if (status == SKV_OK && by->grid)
        status = lay_grid(j, &frame);
    const skv_rays rays = {.direction_enu = j->direction + 3 * first};
    const skv_sky sky = {.radiance = j->radiance + (size_t)by->model->bands * first};
    return status == SKV_OK ? skv_radiance(&frame, end - first, &rays, &sky) : status;
}

static int evaluate(job *j) {
    const size_t n = j->queries->rows;
    const query *const row = j->queries->row;
    progress_begin("eval", n);
    for (size_t first = 0, end; first < n; first = end) {
        for (end = first + 1; end < n && end - first < BATCH && same_frame(&row[j->order[first]], &row[j->order[end]]);
             end++) {
        }
        const skv_status status = evaluate_frame(j, first, end);
        if (status != SKV_OK)
            return fail_job("skyvert eval: the %s refuses altitude %g km, sun zenith %g deg (status %d)",
                            j->source->other ? j->source->other->name : "core",
                            row[j->order[first]].value[QUERY_ALTITUDE], row[j->order[first]].value[QUERY_SUN],
                            (int)status);
        progress_update(end);
    }
    progress_end();
    return 0;
}

static int print(const job *j, const size_t *place, const atmosphere_file *file) {
    for (int c = 0; c < QUERY_COLUMNS; c++)
        printf("%s%s", c ? "," : "", query_names[c]);
    const int bands = j->source->model->bands;
    for (int b = 0; b < bands; b++)
        printf(",L_%s", file->band_name[b]);
    putchar('\n');
    for (size_t i = 0; i < j->queries->rows && !ferror(stdout); i++) {
        const char *text = j->queries->text + j->queries->row[i].text;
        for (int c = 0; c < QUERY_COLUMNS; c++) {
            printf("%s%s", c ? "," : "", text);
            text += strlen(text) + 1;
        }
        for (int b = 0; b < bands; b++)
            printf(",%.9g", (double)j->radiance[place[i] * (size_t)bands + (size_t)b]);
        putchar('\n');
    }
    return output_finish_stdout();
}

static int run(job *j, size_t *place, const atmosphere_file *file) {
    const size_t n = j->queries->rows;
    for (size_t i = 0; i < n; i++)
        j->order[i] = i;
    sorted = j->queries->row;
    qsort(j->order, n, sizeof *j->order, compare);
    for (size_t i = 0; i < n; i++) {
        place[j->order[i]] = i;
        set_direction(&j->queries->row[j->order[i]], j->direction + 3 * i);
    }
    const int result = evaluate(j);
    return result ? result : print(j, place, file);
}

int answers_write(const query_list *queries, const answers_source *source, const atmosphere_file *file) {
    const size_t n = queries->rows + 1; // malloc(0) may be NULL
    size_t *const place = calloc(n, sizeof *place);
    job j = {.queries = queries,
             .source = source,
             .order = calloc(n, sizeof *j.order),
             .direction = calloc(n, 3 * sizeof *j.direction),
             .radiance = calloc(n, 4 * sizeof *j.radiance)};
    const bool room = place && j.order && j.direction && j.radiance;
    const int result =
        room ? run(&j, place, file) : fail_job("skyvert eval: out of memory for %zu rows", queries->rows);
    free(place);
    free(j.grid);
    free(j.order);
    free(j.direction);
    free(j.radiance);
    return result;
}
