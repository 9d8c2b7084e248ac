/// A bare Cortex-M board under QEMU or a debugger: text out, exit status, stack use.
#ifndef SKV_PORT_CORTEXM_H
#define SKV_PORT_CORTEXM_H

#include <stddef.h>

/// Writes a string to the host (semihosting SYS_WRITE0).
void skvm_write(const char *text);

/// Ends the run; QEMU's exit status becomes `status`.
__attribute__((noreturn)) void skvm_exit(int status);

/// Fills the unused stack with a pattern, so that skvm_stack_used() counts from here on.
void skvm_paint_stack(void);

/// Bytes of stack that were ever in use since the last painting, from the top of RAM down.
size_t skvm_stack_used(void);

#endif
