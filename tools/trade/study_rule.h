/// The rule gauss-exp once more, in double, from its formulas and with exact columns: to see what its exact splits at
/// the shadow's edge and at the tangent point are worth, which cannot be switched off in the library.
///
/// Only the placing of the samples differs from ref_single(). Light scattered once, no lit ground, no dust.
#ifndef TOOLS_TRADE_STUDY_RULE_H
#define TOOLS_TRADE_STUDY_RULE_H

#include "single.h"

typedef struct study_rule {
    const char *name;
    int samples;                     ///< per part of a ray, [2, 16]
    int shadow_split, tangent_split; ///< 0: that cut is not made; samples in the shadow add nothing
} study_rule;

/// @param[in]  ray       observer within the air; no length of its own.
/// @param[out] radiance  [bands]
/// @return samples taken
int study_rule_radiance(const ref_atmosphere *air, const study_rule *rule, const ref_ray *ray,
                        double radiance[REF_BANDS]);

#endif
