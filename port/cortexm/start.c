/// Start-up of an ARMv7-M part (Cortex-M3, M4F, M7): vectors, FPU on, memory set up, the stack painted, then main().
/// Symbols that begin with skvm_ are set by cortexm.ld.
#include "cortexm.h"

#include <stddef.h>
#include <stdint.h>

int main(void);
void skvm_reset(void);

extern uint32_t skvm_stack_low[], skvm_stack_top[];
extern uint32_t skvm_data_load[], skvm_data[], skvm_data_end[], skvm_bss[], skvm_bss_end[];

#define PAINT 0xA5C35A3Cu

static void fault(void) {
    skvm_write("fault: a hard, memory, bus or usage fault\n");
    skvm_exit(70);
}

/// What the core reads at address 0: the first stack pointer, then the handlers of reset and of the exceptions.
typedef struct vectors {
    uint32_t *stack;
    void (*handler[15])(void);
} vectors;

extern const vectors skvm_vectors;
__attribute__((section(".vectors"), used)) const vectors skvm_vectors = {
    skvm_stack_top, {skvm_reset, fault, fault, fault, fault, fault, 0, 0, 0, 0, fault, fault, 0, fault, fault}};

static void set_up_memory(void) {
    const uint32_t *from = skvm_data_load;
    for (uint32_t *to = skvm_data; to != skvm_data_end; ++to)
        *to = *from++;
    for (uint32_t *to = skvm_bss; to != skvm_bss_end; ++to)
        *to = 0;
}

static void enable_fpu(void) {
#if defined(__ARM_FP)
    volatile uint32_t *const cpacr = (volatile uint32_t *)(uintptr_t)0xE000ED88u;
    *cpacr |= 0xFu << 20; // full access to CP10 and CP11
    __asm volatile("dsb\n\tisb" ::: "memory");
#endif
}

void skvm_paint_stack(void) {
    uint32_t *const here = (uint32_t *)__builtin_frame_address(0) - 32; // leaves this function's own frame alone
    for (volatile uint32_t *p = skvm_stack_low; p < here; ++p)
        *p = PAINT;
}

size_t skvm_stack_used(void) {
    const uint32_t *p = skvm_stack_low;
    while (p < skvm_stack_top && *p == PAINT)
        ++p;
    return (size_t)(skvm_stack_top - p) * sizeof *p;
}

/// Runs before any float instruction: the FPU is still off when it is entered.
__attribute__((noreturn, target("general-regs-only"))) void skvm_reset(void) {
    enable_fpu();
    set_up_memory();
    skvm_paint_stack();
    const int status = main();
    if (skvm_stack_low[0] != PAINT) {
        skvm_write("fault: the stack overflowed\n");
        skvm_exit(71);
    }
    skvm_exit(status);
}
