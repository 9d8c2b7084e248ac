#include "port/gpiod/skv_quadrature.h"

enum { INVALID = 2 };

// Step from the levels before (row, AB) to those after (column): one bit changes per quarter step, as in a Gray code.
static const int8_t step[4][4] = {
    {0, 1, -1, INVALID},
    {-1, 0, INVALID, 1},
    {1, INVALID, 0, -1},
    {INVALID, -1, 1, 0},
};

static uint8_t pair(bool a, bool b) {
    return (uint8_t)((a ? 2 : 0) | (b ? 1 : 0));
}

void skv_quadrature_start(skv_quadrature *encoder, bool a, bool b) {
    *encoder = (skv_quadrature){.levels = pair(a, b)};
}

void skv_quadrature_levels(skv_quadrature *encoder, bool a, bool b) {
    const uint8_t after = pair(a, b);
    const int8_t moved = step[encoder->levels & 3u][after];
    encoder->levels = after;
    if (moved == INVALID)
        encoder->invalid++;
    else // unsigned: wraps without overflow
        encoder->position = (int32_t)((uint32_t)encoder->position + (uint32_t)(int32_t)moved);
}

void skv_quadrature_edge(skv_quadrature *encoder, bool is_a, bool level) {
    const bool a = (encoder->levels & 2u) != 0, b = (encoder->levels & 1u) != 0;
    if ((is_a ? a : b) == level)
        encoder->invalid++;
    else
        skv_quadrature_levels(encoder, is_a ? level : a, is_a ? b : level);
}

int32_t skv_quadrature_clicks(int32_t *steps, int32_t per_click) {
    const int32_t clicks = *steps / per_click;
    *steps -= clicks * per_click;
    return clicks;
}
