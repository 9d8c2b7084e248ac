/// The search for the cheapest configuration that is good enough.
#ifndef TOOLS_PLAN_SEARCH_H
#define TOOLS_PLAN_SEARCH_H

#include "tools/plan/cost.h"
#include "tools/plan/error.h"

typedef struct plan_ask {
    double max_error; ///< 1 = 100 %
    int vertices;
    plan_target target;
    double budget_us; ///< 0: none
    double per_us;    ///< instructions
} plan_ask;

typedef struct plan_candidate {
    plan_config config;
    trade_error error;
    double promised; ///< plan_judge_error()
    plan_cost cost;
    double us; ///< of a mean frame
} plan_candidate;

/// What can be left out, dearest first.
typedef enum plan_term {
    PLAN_TERM_DIFFUSE,
    PLAN_TERM_FINE_TABLE, ///< accurate instead of small
    PLAN_TERM_AEROSOL,
    PLAN_TERM_DUST,
    PLAN_TERM_OZONE,
    PLAN_TERM_GROUND,
    PLAN_TERM_FOURTH_BAND,
    PLAN_TERM_SAMPLE, ///< the last node of each leg
    PLAN_TERMS
} plan_term;
extern const char *const plan_term_names[PLAN_TERMS];

/// A term of the answer: the same with it taken out or, where it was dropped, put back.
typedef struct plan_change {
    plan_term term;
    bool dropped;
    trade_error change;   ///< of the light, against the answer's
    plan_candidate other; ///< cost.mean 0: not known
} plan_change;

typedef enum plan_verdict { PLAN_FITS, PLAN_ERROR_TOO_LARGE, PLAN_OVER_BUDGET } plan_verdict;

typedef struct plan_answer {
    plan_verdict verdict;
    plan_candidate chosen; ///< with PLAN_ERROR_TOO_LARGE the most accurate there is
    plan_change change[PLAN_TERMS];
    int changes;
    double distance; ///< plan_judge.distance
} plan_answer;

/// @return SKV_OK, or what the library says; SKV_ERR_SIZE also where memory ran out.
skv_status plan_search(const plan_scene *scene, const plan_ask *ask, plan_answer *answer);

/// The configuration with a term taken out or put back. @return false iff there is no such choice.
bool plan_toggle(const plan_scene *scene, const plan_config *from, plan_term term, plan_config *to, bool *dropped);

#endif
