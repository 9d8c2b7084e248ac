/// Stack that a configuration uses: it runs on a painted stack of its own, what is still painted afterwards is free.
#define _XOPEN_SOURCE 700 // ucontext
#include <stdlib.h>
#include <string.h>
#include <ucontext.h>

#include "measure.h"

enum { PAINT = 0xA5, STACK = 512 * 1024 };

static trade_subject *subject;
static const trade_scene *scene;
static float direction[TRADE_DOME][3], radiance[TRADE_DOME][TRADE_BANDS];

static void do_nothing(void) {}

static void do_frame(void) {
    if (trade_subject_frame(subject, scene))
        trade_subject_radiance(subject, TRADE_DOME, (const float(*)[3])direction, radiance);
}

static size_t used_by(unsigned char *stack, void (*run)(void)) {
    static ucontext_t here, there;
    memset(stack, PAINT, STACK);
    getcontext(&there);
    there.uc_stack.ss_sp = stack;
    there.uc_stack.ss_size = STACK;
    there.uc_link = &here;
    makecontext(&there, run, 0);
    swapcontext(&here, &there);
    size_t i = 0;
    while (i < STACK && stack[i] == PAINT)
        i++;
    return STACK - i;
}

void trade_measure_stack(trade_row *row, trade_subject *measured) {
    // Twilight from the ground and from above: rays in three lit parts, the planet's shadow, a grid.
    static const int scenes[] = {TRADE_GROUND * TRADE_SUNS + TRADE_DAY, TRADE_12KM * TRADE_SUNS + TRADE_TWILIGHT};
    unsigned char *const stack = malloc(STACK);
    size_t most = 0;
    if (!stack)
        return;
    subject = measured;
    for (int i = 0; i < 2; i++) {
        scene = &row->truth->scene[scenes[i]];
        trade_lay_dome(scene, direction);
        const size_t none = used_by(stack, do_nothing), used = used_by(stack, do_frame);
        most = used - none > most ? used - none : most;
    }
    row->stack_bytes = (double)most;
    row->done |= TRADE_DONE_STACK;
    free(stack);
}
