/// Tables of light scattered more than once: what each call answers, how they are built, stored, checked and refused.
#if !defined(SKV_TEST_SMALL)
#include <sys/mman.h>
#endif

#include "table_air.h"

static skv_table_builder builder;
static uint32_t other_words[TABLE_WORDS];
// In the work space, which nothing else uses by then.
static float *const grid = (float *)(void *)table_work;
enum { GRID_BYTES = GRID_WORDS * sizeof(float) };
// One beside table_model: 64 KiB of RAM have no room for a third.
static skv_model second;
static skv_table *const table_other = (skv_table *)(void *)other_words;

static void sizes(void **state) {
    (void)state;
    for (int bands = 3; bands <= 4; bands++) {
        static const char *const names[SKV_TABLE_KINDS] = {"accurate", "small", "large"};
        size_t bytes[SKV_TABLE_KINDS];
        for (int k = 0; k < SKV_TABLE_KINDS; k++) {
            skv_table_spec s;
            check_status("skv_table_spec_kind", skv_table_spec_kind(&s, (skv_table_kind)k), SKV_OK);
            bytes[k] = skv_table_size(&s, bands);
            print_message("figure: %s table, %d bands: %u bytes, work space %u bytes, builder %u bytes\n", names[k],
                          bands, (unsigned)bytes[k], (unsigned)skv_table_work_size(&s, bands),
                          (unsigned)sizeof(skv_table_builder));
            s.format = SKV_TABLE_FLOAT;
            assert_true(skv_table_size(&s, bands) > 2 * bytes[k]); // floats against 16 and 8 bits
            assert_true(skv_table_work_size(&s, bands) > skv_table_size(&s, bands));
        }
        assert_true(bytes[SKV_TABLE_SMALL] < bytes[SKV_TABLE_ACCURATE]);
        check_at_most("accurate table, bytes (issue: 8 KiB)", (double)bytes[SKV_TABLE_ACCURATE], 8192);
        check_at_most("large table, bytes", (double)bytes[SKV_TABLE_LARGE], 16384);
    }
    const skv_table_spec s = spec_least();
    assert_int_equal(skv_table_size(NULL, 4), 0);
    assert_int_equal(skv_table_size(&s, 2), 0);
    assert_int_equal(skv_table_size(&s, 5), 0);
    assert_int_equal(skv_table_work_size(NULL, 4), 0);
    assert_int_equal(skv_table_work_size(&s, 0), 0);
}

/// What a call with damaged arguments must not write.
static void guard(void) {
    memset(&builder, 0xa5, sizeof builder);
    memset(other_words, 0xa5, sizeof other_words);
    memset(table_work, 0xa5, sizeof table_work);
}

static void check_guard(const char *what) {
    for (size_t i = 0; i < sizeof builder; i++)
        if (((const unsigned char *)&builder)[i] != 0xa5)
            fail_msg("%s: byte %d of the builder was written", what, (int)i);
    for (size_t i = 0; i < TABLE_WORDS; i++)
        if (other_words[i] != 0xa5a5a5a5u)
            fail_msg("%s: word %d of the table was written", what, (int)i);
    for (size_t i = 0; i < WORK_WORDS; i++)
        if (table_work[i] != 0xa5a5a5a5u)
            fail_msg("%s: word %d of the work space was written", what, (int)i);
}

static void begin_answers(const char *what, skv_status want, const skv_model *model, const skv_table_spec *spec,
                          void *table, size_t table_bytes, void *work, size_t work_bytes) {
    guard();
    check_status(what, skv_table_begin(&builder, model, spec, table, table_bytes, work, work_bytes), want);
    if (want != SKV_OK)
        check_guard(what);
}

static skv_status begin_spec(const skv_table_spec *spec) {
    return skv_table_begin(&builder, &table_model, spec, table_other, sizeof other_words, table_work,
                           sizeof table_work);
}

/// Each number of a spec at and beyond both ends of its range.
static void ranges_of_a_spec(void **state) {
    static const struct {
        const char *name;
        size_t offset;
        int32_t lo, hi;
    } field[] = {
        {"altitudes", offsetof(skv_table_spec, altitudes), 4, 32},
        {"suns", offsetof(skv_table_spec, suns), 8, 64},
        {"detailed", offsetof(skv_table_spec, detailed), 0, 4},
        {"orders", offsetof(skv_table_spec, orders), 2, 64},
        {"samples[0]", offsetof(skv_table_spec, samples), 2, 16},
        {"samples[1]", offsetof(skv_table_spec, samples) + 4, 2, 16},
        {"polar[0]", offsetof(skv_table_spec, polar), 2, 16},
        {"polar[1]", offsetof(skv_table_spec, polar) + 4, 2, 16},
        {"azimuths[0]", offsetof(skv_table_spec, azimuths), 2, 16},
        {"azimuths[1]", offsetof(skv_table_spec, azimuths) + 4, 2, 16},
        {"format", offsetof(skv_table_spec, format), 0, 1},
    };
    static const float ground[] = {NAN, INFINITY, -INFINITY, 12.001f, -12.001f, 60.0f};
    const skv_atmosphere air = air_br17o();
    (void)state;
    build(&table_model, &air);
    for (size_t i = 0; i < sizeof field / sizeof *field; i++)
        for (int k = 0; k < 6; k++) {
            const int32_t value[] = {field[i].lo, field[i].hi, field[i].lo - 1, field[i].hi + 1, INT32_MIN, INT32_MAX};
            skv_table_spec s = spec_least();
            memcpy((char *)&s + field[i].offset, &value[k], sizeof value[k]);
            if ((skv_table_size(&s, 4) != 0) != (k < 2) || (skv_table_work_size(&s, 4) != 0) != (k < 2))
                fail_msg("skv_table_size, %s = %ld: %u bytes", field[i].name, (long)value[k],
                         (unsigned)skv_table_size(&s, 4));
            if (k >= 2)
                begin_answers(field[i].name, SKV_ERR_RANGE, &table_model, &s, table_other, sizeof other_words,
                              table_work, sizeof table_work);
        }
    for (size_t i = 0; i < sizeof ground / sizeof *ground; i++) {
        skv_table_spec s = spec_least();
        s.ground_km = ground[i];
        begin_answers("ground_km", SKV_ERR_RANGE, &table_model, &s, table_other, sizeof other_words, table_work,
                      sizeof table_work);
    }
    skv_table_spec s = spec_least();
    s.orders = 1; // 0 is a choice, 1 is not
    begin_answers("orders = 1", SKV_ERR_RANGE, &table_model, &s, table_other, sizeof other_words, table_work,
                  sizeof table_work);
}

static void statuses(void **state) {
    const skv_atmosphere air = air_br17o();
    const skv_table_spec s = spec_least();
    static skv_frame frame;
    skv_table_spec out;
    int done = 77;
    (void)state;
    memset(&second, 0, sizeof second);
    build(&table_model, &air);
    const size_t t = skv_table_size(&s, 4), w = skv_table_work_size(&s, 4);
    check_status("spec_kind, no spec", skv_table_spec_kind(NULL, SKV_TABLE_SMALL), SKV_ERR_NULL);
    check_status("spec_kind, no such kind", skv_table_spec_kind(&out, SKV_TABLE_KINDS), SKV_ERR_UNSUPPORTED);
    check_status("spec_kind, no such kind", skv_table_spec_kind(&out, (skv_table_kind)127), SKV_ERR_UNSUPPORTED);
    check_status("begin, no builder", skv_table_begin(NULL, &table_model, &s, table_other, t, table_work, w),
                 SKV_ERR_NULL);
    begin_answers("begin, no model", SKV_ERR_NULL, NULL, &s, table_other, t, table_work, w);
    begin_answers("begin, no table", SKV_ERR_NULL, &table_model, &s, NULL, t, table_work, w);
    begin_answers("begin, no work space", SKV_ERR_NULL, &table_model, &s, table_other, t, NULL, w);
    begin_answers("begin, model not built", SKV_ERR_LAYOUT, &second, &s, table_other, t, table_work, w);
    begin_answers("begin, table a byte too small", SKV_ERR_SIZE, &table_model, &s, table_other, t - 1, table_work, w);
    begin_answers("begin, work a byte too small", SKV_ERR_SIZE, &table_model, &s, table_other, t, table_work, w - 1);
    begin_answers("begin, table not aligned", SKV_ERR_SIZE, &table_model, &s, (char *)other_words + 2, t, table_work,
                  w);
    begin_answers("begin, work not aligned", SKV_ERR_SIZE, &table_model, &s, table_other, t, (char *)table_work + 1, w);
    begin_answers("begin", SKV_OK, &table_model, &s, table_other, t, table_work, w);
    check_status("step, no builder", skv_table_step(NULL, &done), SKV_ERR_NULL);
    memset(&builder, 0, sizeof builder);
    check_status("step, no build", skv_table_step(&builder, &done), SKV_ERR_LAYOUT);
    assert_int_equal(done, 77);
    check_status("build, no table", skv_table_build(NULL, t, table_work, w, &table_model, &s), SKV_ERR_NULL);
    check_status("build, size", skv_table_build(table_other, t - 1, table_work, w, &table_model, &s), SKV_ERR_SIZE);
    check_status("frame_table, no frame", skv_frame_table(NULL, table_here), SKV_ERR_NULL);
    check_status("frame_table, frame not begun", skv_frame_table(&frame, table_here), SKV_ERR_LAYOUT);
    check_status("frame_grid, no frame", skv_frame_grid(NULL, (float *)other_words, 1), SKV_ERR_NULL);
    check_status("frame_grid, no grid", skv_frame_grid(&frame, NULL, 1), SKV_ERR_NULL);
    check_status("frame_grid, frame not begun", skv_frame_grid(&frame, (float *)other_words, 1), SKV_ERR_LAYOUT);
    assert_int_equal(skv_grid_size(NULL), 0);
    assert_int_equal(skv_grid_size(&frame), 0);
    check_status("check, no bytes", skv_table_check(NULL, 100, NULL), SKV_ERR_NULL);
}

/// Nothing but the buffers' named bytes is used.
static void buffers_of_the_exact_size(void **state) {
    const skv_table_spec s = spec_of(SKV_TABLE_SMALL);
    const skv_atmosphere air = air_br17o();
    (void)state;
    build(&table_model, &air);
    const size_t t = skv_table_size(&s, 4) / 4, w = skv_table_work_size(&s, 4) / 4;
    guard();
    check_status("skv_table_build", skv_table_build(table_other, 4 * t, table_work, 4 * w, &table_model, &s), SKV_OK);
    for (size_t i = t; i < TABLE_WORDS; i++)
        if (other_words[i] != 0xa5a5a5a5u)
            fail_msg("word %d behind a table of %d words was written", (int)i, (int)t);
    for (size_t i = w; i < WORK_WORDS; i++)
        if (table_work[i] != 0xa5a5a5a5u)
            fail_msg("word %d behind a work space of %d words was written", (int)i, (int)w);
}

static void check_same_table(const char *what, const uint32_t *got, const uint32_t *want) {
    const size_t n = ((const skv_table *)(const void *)want)->bytes / 4;
    for (size_t i = 0; i < n; i++)
        if (got[i] != want[i])
            fail_msg("%s: word %d of %d: got %08lx, want %08lx", what, (int)i, (int)n, (unsigned long)got[i],
                     (unsigned long)want[i]);
}

/// Step by step is the same as at once; progress never goes back and ends at 1000; what is not complete is refused;
/// nothing happens afterwards.
static void steps(void **state) {
    const skv_atmosphere air = air_br16();
    const skv_table_spec s = spec_of(SKV_TABLE_SMALL);
    int done = 0, last = 0, n = 0, jump = 0;
    (void)state;
    table_make(&air, &s);
    memset(other_words, 0, sizeof other_words);
    check_status("skv_table_begin", begin_spec(&s), SKV_OK);
    for (; done < 1000; n++, last = done) {
        check_status("skv_table_step", skv_table_step(&builder, n % 3 == 2 ? NULL : &done), SKV_OK);
        if (done < last || done < 0 || done > 1000)
            fail_msg("step %d: progress %d after %d", n, done, last);
        jump = done - last > jump && n % 3 != 0 && done < 1000 ? done - last : jump;
        if (n % 3 != 2 && (skv_table_check(other_words, sizeof other_words, &table_model) == SKV_OK) != (done == 1000))
            fail_msg("step %d, %d permille done: skv_table_check says %d", n, done,
                     (int)skv_table_check(other_words, sizeof other_words, &table_model));
        if (n > 1000000)
            fail_msg("no end after a million steps, %d permille", done);
    }
    check_same_table("steps", other_words, table_words);
    print_message("figure: a table of %d x %d cells in %d steps, largest advance %d permille\n", (int)s.altitudes,
                  (int)s.suns, n, jump);
    for (int i = 0; i < 3; i++)
        check_status("a step more", skv_table_step(&builder, &done), SKV_OK);
    assert_int_equal(done, 1000);
    check_same_table("steps after the end", other_words, table_words);
}

/// A new air half-way: begun anew, the old build leaves no trace.
static void beginning_anew(void **state) {
    const skv_atmosphere old = air_br16(), air = air_smoky();
    const skv_table_spec s = spec_of(SKV_TABLE_SMALL);
    static const int after[] = {0, 1, 17, 400, 1000};
    int done = 0;
    (void)state;
    build(&second, &old);
    table_make(&air, &s);
    for (size_t i = 0; i < sizeof after / sizeof *after; i++) {
        check_status(
            "begin",
            skv_table_begin(&builder, &second, NULL, table_other, sizeof other_words, table_work, sizeof table_work),
            SMALL_TARGET ? SKV_ERR_SIZE : SKV_OK);
        if (SMALL_TARGET)
            check_status(
                "begin",
                skv_table_begin(&builder, &second, &s, table_other, sizeof other_words, table_work, sizeof table_work),
                SKV_OK);
        for (int k = 0; k < after[i]; k++)
            check_status("step", skv_table_step(&builder, &done), SKV_OK);
        check_status("begin anew", begin_spec(&s), SKV_OK);
        for (done = 0; done < 1000;)
            check_status("step", skv_table_step(&builder, &done), SKV_OK);
        check_same_table("begun anew", other_words, table_words);
    }
}

/// A frame goes on with its table while the next one is built beside it.
static void the_table_in_use_is_left_alone(void **state) {
    const skv_atmosphere air = air_br17o(), next = air_smoky();
    const skv_table_spec s = spec_of(SKV_TABLE_SMALL);
    skv_frame frame;
    float view[3];
    int done = 0;
    (void)state;
    table_make(&air, &s);
    build(&second, &next);
    table_frame(&frame, 1, 0, 60);
    toward(view, 70, 40);
    const shone want = shine(&frame, view, INFINITY);
    check_status("begin",
                 skv_table_begin(&builder, &second, &s, table_other, sizeof other_words, table_work, sizeof table_work),
                 SKV_OK);
    for (int n = 0; done < 1000; n++) {
        check_status("step", skv_table_step(&builder, &done), SKV_OK);
        if (n % 64 == 0 || done == 1000) {
            const shone got = shine(&frame, view, INFINITY);
            check_same_bits("the table in use", &got, &want);
        }
    }
}

/// Every bit of a stored table: flipped, it is refused.
static void every_bit_counts(void **state) {
    const skv_atmosphere air = air_br17o();
    (void)state;
    for (int format = 0; format <= 1; format++) {
        skv_table_spec s = format ? spec_least() : spec_of(SKV_TABLE_ACCURATE);
        s.format = format;
        table_make(&air, &s);
        const size_t bytes = table_here->bytes;
        for (size_t bit = 0; bit < 8 * bytes; bit++) {
            table_words[bit / 32] ^= 1u << bit % 32;
            const skv_status got = skv_table_check(table_words, bytes, &table_model);
            if (got != SKV_ERR_DAMAGED && got != SKV_ERR_LAYOUT && got != SKV_ERR_SIZE)
                fail_msg("format %d: bit %d of byte %d flipped: status %d", format, (int)(bit % 8), (int)(bit / 8),
                         (int)got);
            if (bit >= 8 * offsetof(skv_table, model) && got != SKV_ERR_DAMAGED)
                fail_msg("format %d: bit %d of byte %d flipped: status %d, want SKV_ERR_DAMAGED", format,
                         (int)(bit % 8), (int)(bit / 8), (int)got);
            table_words[bit / 32] ^= 1u << bit % 32;
        }
        check_status("as it was", skv_table_check(table_words, bytes, &table_model), SKV_OK);
    }
}

/// Two words changed places, a run of zeros, a byte of another value anywhere: random damage.
static void random_damage(void **state) {
    const skv_atmosphere air = air_br17o();
    const skv_table_spec s = spec_of(SKV_TABLE_SMALL);
    (void)state;
    table_make(&air, &s);
    const int words = (int)(table_here->bytes / 4);
    random_state = 99;
    for (int i = 0; i < CASES(20000); i++) {
        memcpy(other_words, table_words, table_here->bytes);
        const int a = random_int(0, words - 1), b = random_int(0, words - 1), n = random_int(1, 40);
        if (i % 3 == 0) {
            other_words[a] = table_words[b];
            other_words[b] = table_words[a];
        } else if (i % 3 == 1)
            memset(other_words + a, i % 2 ? 0 : 255, 4 * (size_t)(n < words - a ? n : words - a));
        else
            other_words[a] += random_word() % 255 << 8 * (n % 4);
        const int same = memcmp(other_words, table_words, table_here->bytes) == 0;
        const skv_status got = skv_table_check(other_words, table_here->bytes, NULL);
        if ((got == SKV_OK) != same)
            fail_msg("damage %d (words %d, %d, n %d): status %d", i, a, b, n, (int)got);
    }
}

static void what_check_refuses(void **state) {
    const skv_atmosphere air = air_br17o(), strange = air_smoky();
    const skv_table_spec s = spec_of(SKV_TABLE_SMALL);
    (void)state;
    table_make(&air, &s);
    build(&second, &strange);
    const size_t bytes = table_here->bytes;
    check_status("its own model", skv_table_check(table_words, bytes, &table_model), SKV_OK);
    check_status("any model", skv_table_check(table_words, bytes, NULL), SKV_OK);
    check_status("bytes behind it", skv_table_check(table_words, bytes + 1000, NULL), SKV_OK);
    check_status("another model", skv_table_check(table_words, bytes, &second), SKV_ERR_MODEL);
    memset(&second, 0, sizeof second);
    check_status("no model at all", skv_table_check(table_words, bytes, &second), SKV_ERR_LAYOUT);
    for (size_t n = 0; n < bytes; n += n < 200 ? 1 : 97)
        check_status("cut short", skv_table_check(table_words, n, NULL), SKV_ERR_SIZE);
    check_status("not aligned", skv_table_check((const char *)table_words + 2, bytes, NULL), SKV_ERR_SIZE);
    memcpy(other_words, table_words, bytes);
    table_other->version++;
    check_status("another version", skv_table_check(other_words, bytes, NULL), SKV_ERR_LAYOUT);
    for (size_t i = 0; i < bytes / 4; i++) {
        const uint32_t w = table_words[i];
        other_words[i] = w >> 24 | (w >> 8 & 0xff00) | (w << 8 & 0xff0000) | w << 24;
    }
    check_status("the other byte order", skv_table_check(other_words, bytes, NULL), SKV_ERR_LAYOUT);
    memset(other_words, 0, bytes);
    check_status("zeros", skv_table_check(other_words, bytes, NULL), SKV_ERR_LAYOUT);
    memset(other_words, 255, bytes);
    check_status("ones", skv_table_check(other_words, bytes, NULL), SKV_ERR_LAYOUT);
}

/// Everything of an atmosphere that scattering depends on makes another model of it, what it does not depend on
/// does not.
static void whose_table_it_is(void **state) {
    static const float km[3] = {0, 5, 60}, density[3] = {1, 0.5f, 0};
    const skv_table_spec s = spec_least();
    (void)state;
    const skv_atmosphere air = air_smoky();
    table_make(&air, &s);
    for (int i = 0; i < 24; i++) {
        skv_atmosphere a = air;
        float *const value[] = {&a.albedo[0],
                                &a.albedo[3],
                                &a.radius_km,
                                &a.top_km,
                                &a.rayleigh_scattering_per_km[1],
                                &a.rayleigh_absorption_per_km[2],
                                &a.rayleigh.scale_height_km,
                                &a.aerosol_scattering_per_km[3],
                                &a.aerosol_extinction_per_km[0],
                                &a.aerosol.scale_height_km,
                                &a.aerosol_g,
                                &a.turbidity,
                                &a.dust_scattering_per_km[2],
                                &a.dust_extinction_per_km[1],
                                &a.dust.scale_height_km,
                                &a.dust_g,
                                &a.ozone_absorption_per_km[3],
                                &a.ozone.peak_km,
                                &a.ozone.half_width_km};
        const int floats = (int)(sizeof value / sizeof *value);
        if (i < floats)
            *value[i] = *value[i] * (1 + 2e-6f) + 1e-6f;
        else if (i == floats)
            a.bands = 3;
        else if (i == floats + 1)
            a.aerosol_phase = SKV_PHASE_HG;
        else if (i == floats + 2)
            a.dust_phase = SKV_PHASE_CS;
        else if (i == floats + 3)
            a.ozone.kind = SKV_PROFILE_NONE;
        else {
            a.dust.kind = SKV_PROFILE_TABLE;
            a.dust.table_altitude_km = km;
            a.dust.table_density = density;
            a.dust.table_rows = 3;
        }
        const skv_status built = skv_model_build(&second, &a);
        if (built != SKV_OK || skv_table_check(table_words, sizeof table_words, &second) != SKV_ERR_MODEL)
            fail_msg("change %d: model status %d, table's status %d, want SKV_ERR_MODEL", i, (int)built,
                     (int)skv_table_check(table_words, sizeof table_words, &second));
    }
    skv_atmosphere a = air;
    a.solar_irradiance[1] = 7;
    a.wavelength_nm[0] = 433;
    a.absorption_colour[2] = 0.5f;
    build(&second, &a);
    check_status("another light", skv_table_check(table_words, sizeof table_words, &second), SKV_OK);
}

static void frames_refuse_foreign_tables(void **state) {
    const skv_atmosphere air = air_br17o(), strange = air_smoky();
    const skv_table_spec s = spec_of(SKV_TABLE_SMALL);
    skv_frame frame, foreign, was;
    (void)state;
    table_make(&air, &s);
    build(&second, &strange);
    begin(&foreign, &second, NULL, 1, 0, 60);
    was = foreign;
    check_status("another model's table", skv_frame_table(&foreign, table_here), SKV_ERR_MODEL);
    assert_int_equal(memcmp(&was, &foreign, sizeof was), 0);
    table_frame(&frame, 1, 0, 60);
    check_status("grid", skv_frame_grid(&frame, grid, GRID_BYTES), SKV_OK);
    was = frame;
    memcpy(other_words, table_words, sizeof other_words);
    table_other->version++;
    check_status("another version", skv_frame_table(&frame, table_other), SKV_ERR_LAYOUT);
    if (memcmp(&was, &frame, sizeof was) != 0)
        fail_msg("a frame that refused a table (LAYOUT) was written");
    table_other->version--;
    table_other->magic++;
    check_status("no table", skv_frame_table(&frame, table_other), SKV_ERR_LAYOUT);
    table_other->magic--;
    table_other->model++;
    check_status("another model", skv_frame_table(&frame, table_other), SKV_ERR_MODEL);
    if (memcmp(&was, &frame, sizeof was) != 0)
        fail_msg("a frame that refused a table (MODEL) was written");
}

/// NULL: single scattering, the same bits as a frame that never had a table.
static void back_to_single_scattering(void **state) {
    const skv_atmosphere air = air_br17o();
    const skv_table_spec s = spec_of(SKV_TABLE_SMALL);
    (void)state;
    table_make(&air, &s);
    random_state = 5;
    for (int i = 0; i < CASES(300); i++) {
        const skv_quality q = quality_of((skv_rule)(i % 3), SKV_DEPTH_BY_CHAPMAN, 5, 5, SKV_WITH_ALL);
        skv_frame never, once;
        float view[3];
        const double h = i % 4 ? random_in(0, 29) : random_in(31, 80), sun = random_in(0, 180);
        begin(&never, &table_model, &q, h, 0, sun);
        once = never;
        check_status("table", skv_frame_table(&once, table_here), SKV_OK);
        if (i % 2)
            check_status("grid", skv_frame_grid(&once, grid, GRID_BYTES), h > 30 ? SKV_ERR_RANGE : SKV_OK);
        check_status("no table", skv_frame_table(&once, NULL), SKV_OK);
        toward(view, random_in(0, 180), random_in(0, 360));
        const shone got = shine(&once, view, INFINITY), want = shine(&never, view, INFINITY);
        check_same_bits("NULL table", &got, &want);
    }
}

/// A table in read-only memory: nothing writes to it.
static void read_only_memory(void **state) {
    const skv_atmosphere air = air_br17o();
    const skv_table_spec s = spec_of(SKV_TABLE_SMALL);
    float view[3], irradiance[4];
    skv_frame frame;
    (void)state;
    table_make(&air, &s);
    table_frame(&frame, 1, 0, 60);
    toward(view, 70, 40);
    const shone want = shine(&frame, view, INFINITY);
#if SMALL_TARGET
    uint32_t *const memory = other_words;
    memcpy(memory, table_words, sizeof table_words);
#else
    static uint32_t memory[TABLE_WORDS] __attribute__((aligned(65536)));
    memcpy(memory, table_words, sizeof table_words);
    assert_int_equal(mprotect(memory, sizeof memory, PROT_READ), 0);
#endif
    check_status("check", skv_table_check(memory, sizeof table_words, &table_model), SKV_OK);
    check_status("frame_table", skv_frame_table(&frame, (const skv_table *)(const void *)memory), SKV_OK);
    const shone got = shine(&frame, view, INFINITY);
    check_same_bits("a table in read-only memory", &got, &want);
    check_status("grid", skv_frame_grid(&frame, grid, GRID_BYTES), SKV_OK);
    check_status("irradiance", skv_irradiance(&frame, SKV_IRRADIANCE_ALL, 1, view, 0, irradiance, 0), SKV_OK);
    assert_int_equal(memcmp(memory, table_words, sizeof table_words), 0);
}

static void grid_buffers(void **state) {
    const skv_atmosphere air = air_br17o();
    const skv_table_spec s = spec_of(SKV_TABLE_SMALL);
    skv_frame frame;
    (void)state;
    table_make(&air, &s);
    begin(&frame, &table_model, NULL, 1, 0, 60);
    check_status("grid without a table", skv_frame_grid(&frame, grid, GRID_BYTES), SKV_ERR_LAYOUT);
    table_frame(&frame, 1, 0, 60);
    const size_t n = skv_grid_size(&frame);
    print_message("figure: grid of a light, 4 bands: %u bytes\n", (unsigned)n);
    assert_true(n > 0 && n <= GRID_BYTES);
    const skv_frame was = frame;
    memset(grid, 0xa5, GRID_BYTES);
    check_status("a byte too small", skv_frame_grid(&frame, grid, n - 1), SKV_ERR_SIZE);
    check_status("not aligned", skv_frame_grid(&frame, (float *)(void *)((char *)grid + 2), n), SKV_ERR_SIZE);
    assert_int_equal(memcmp(&was, &frame, sizeof was), 0);
    check_status("the very size", skv_frame_grid(&frame, grid, n), SKV_OK);
    for (size_t i = n; i < GRID_BYTES; i++)
        if (((const unsigned char *)grid)[i] != 0xa5)
            fail_msg("byte %d behind a grid of %d was written", (int)i, (int)n);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sizes),
        cmocka_unit_test(ranges_of_a_spec),
        cmocka_unit_test(statuses),
        cmocka_unit_test(buffers_of_the_exact_size),
        cmocka_unit_test(steps),
        cmocka_unit_test(beginning_anew),
        cmocka_unit_test(the_table_in_use_is_left_alone),
        cmocka_unit_test(every_bit_counts),
        cmocka_unit_test(random_damage),
        cmocka_unit_test(what_check_refuses),
        cmocka_unit_test(whose_table_it_is),
        cmocka_unit_test(frames_refuse_foreign_tables),
        cmocka_unit_test(back_to_single_scattering),
        cmocka_unit_test(read_only_memory),
        cmocka_unit_test(grid_buffers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
