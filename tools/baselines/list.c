/// All baselines, in the order of their rows.
#include <string.h>

#include "baseline.h"

// Each file of a baseline defines its own; a line here and one below add it.
extern const baseline elek09, elek09_literal;
extern const baseline keller08_baseline, keller08_table1, keller08_literal;
extern const baseline linan23_baseline, linan23_literal, hillaire20_baseline;

const baseline *const baselines[] = {
    &keller08_baseline,   &keller08_table1,  &keller08_literal, &elek09, &elek09_literal,
    &hillaire20_baseline, &linan23_baseline, &linan23_literal,  NULL};

const baseline *baseline_find(const char *name) {
    for (const baseline *const *b = baselines; *b; b++)
        if (strcmp((*b)->name, name) == 0)
            return *b;
    return NULL;
}
