/// The metric against numbers computed by hand, and pooling and frontier on made-up rows.
#include "check.h"
#include "tools/trade/trade.h"

static const float got[4][TRADE_BANDS] = {{1.5f, 2, 0, 9}, // off by .5 in a band of 1; the fourth band does not count
                                          {4, 4, 4, 9},    // exact
                                          {0, .25f, 0, 9}, // off by .25 where the truth is far below the floor
                                          {3, 8, 1, 9}};   // off by 2
static const double truth[4][TRADE_BANDS] = {{1, 2, 0, 0}, {4, 4, 4, 0}, {0, 0, 0, 0}, {1, 10, 1, 0}};

static void errors_by_hand(void **state) {
    (void)state;
    double scratch[4];
    trade_error e;
    trade_measure(4, 3, got, truth, scratch, &e);
    // Largest bands 2, 4, 0, 10: mean 4, floor .2. Errors .5/2, 0, .25/.2, 2/10.
    check_near("mean", e.mean, (0.25 + 0 + 1.25 + 0.2) / 4, 1e-12); // sums of four doubles
    check_near("largest", e.max, 1.25, 1e-12);
    check_near("95 %", e.p95, 1.25, 1e-12); // the fourth of four
    assert_int_equal(e.worst, 2);
}

// Errors of 1 to 40 %, in another order: 38 of 40 rays, 95 %, stay below 39 %.
static void percentile_by_hand(void **state) {
    (void)state;
    static float off[40][TRADE_BANDS];
    static double white[40][TRADE_BANDS], scratch[40];
    trade_error e;
    for (int i = 0; i < 40; i++) {
        white[i][0] = 1;
        off[i][0] = 1 + .01f * (float)(i * 7 % 40 + 1);
    }
    trade_measure(40, 3, (const float(*)[TRADE_BANDS])off, (const double(*)[TRADE_BANDS])white, scratch, &e);
    check_near("95 %", e.p95, 0.39, 1e-6); // floats
    check_near("mean", e.mean, 0.205, 1e-6);
    check_near("largest", e.max, 0.40, 1e-6);
}

static void exact_is_zero(void **state) {
    (void)state;
    double scratch[2];
    static const float black[2][TRADE_BANDS];
    static const double dark[2][TRADE_BANDS];
    trade_error e;
    trade_measure(2, 4, black, dark, scratch, &e);
    check_near("mean of nothing", e.mean, 0, 0); // 0/0 is no error
    check_near("largest of nothing", e.max, 0, 0);
}

enum { CONFIGS = 5 };

/// Rows whose costs and errors are the same in all scenes.
static void made_up(trade *t, trade_config *configs, trade_row *rows, trade_truth *truths) {
    static const double cost[CONFIGS] = {100, 200, 200, 300, 50}, error[CONFIGS] = {.10, .05, .04, .06, .01};
    *t = (trade){.configs = configs, .n_configs = CONFIGS, .truths = truths, .n_truths = 1, .counted = 1};
    t->rows = (trade_rows){.at = rows, .n = CONFIGS};
    for (int i = 0; i < CONFIGS; i++) {
        configs[i] = (trade_config){.light = i == CONFIGS - 1 ? TRADE_FULL : TRADE_SINGLE};
        rows[i] = (trade_row){.config = &configs[i], .truth = truths, .sees_ground = 1};
        for (int k = 0; k < TRADE_SCENES; k++) {
            rows[i].rays[k] = 24;
            rows[i].error[k] = (trade_error){error[i], error[i], 2 * error[i] + k, 0};
            rows[i].cost[k] = (trade_cost){1, 1, 1, 2048, cost[i] - 1, 2048};
        }
    }
}

static void frontier_by_hand(void **state) {
    (void)state;
    static trade_config configs[CONFIGS];
    static trade_row rows[CONFIGS];
    static trade_truth truths[1];
    static const int want[CONFIGS] = {1, 0, 1, 0, 0}; // the last is of another light
    int on[CONFIGS];
    trade t;
    made_up(&t, configs, rows, truths);
    trade_frontier(&t, TRADE_SINGLE, -1, -1, on);
    for (int i = 0; i < CONFIGS; i++)
        if (on[i] != want[i])
            fail_msg("configuration %d: on the frontier %d, want %d", i, on[i], want[i]);
    rows[2].sees_ground = 0; // what is measured with fewer rays beats nobody
    trade_frontier(&t, TRADE_SINGLE, -1, -1, on);
    assert_int_equal(on[2], 0);
    assert_int_equal(on[1], 1);
    const trade_pooled p = trade_pool(&t, 0, TRADE_DAY, -1, -1);
    check_near("instructions, the frame's share within", p.instructions, 100, 1e-9); // 99 + 2048/2048
    check_near("ns", p.ns, 2, 1e-12);
    check_near("largest of the largest", p.max, 0.2 + 6, 1e-12); // scene 6: 40 km, day
    assert_int_equal(p.worst_scene, 6);
    assert_int_equal(p.scenes, 3);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(errors_by_hand), cmocka_unit_test(percentile_by_hand),
                                       cmocka_unit_test(exact_is_zero), cmocka_unit_test(frontier_by_hand)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
