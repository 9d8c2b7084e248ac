/// What `skyvert plan` says and writes.
#ifndef TOOLS_PLAN_REPORT_H
#define TOOLS_PLAN_REPORT_H

#include <stdio.h>

#include "tools/plan/search.h"

/// The answer: `name value unit` lines, then a table of terms.
void plan_report(FILE *out, const plan_scene *scene, const plan_ask *ask, const plan_answer *answer);
/// skv_config.h. @param command  what made it, for its comment
void plan_header(FILE *out, const plan_scene *scene, const plan_ask *ask, const plan_answer *answer,
                 const char *command);

#endif
