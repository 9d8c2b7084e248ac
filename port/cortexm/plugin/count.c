/// QEMU TCG plugin: how many guest instructions run from one address (a function's first instruction) to another one.
///
///   qemu-... -plugin libcount.so,from=0x1234,to=0x5678,out=FILE
///
/// Writes one number a line: the instructions executed after `from` was reached, until `to` is. Repeatable to the
/// instruction. Debian ships QEMU's plugin interface (version 1) without its header, so what is used is declared here.
/// Source: QEMU 7.2 documentation, "TCG Plugins".
#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef uint64_t plugin_id;
typedef struct qemu_info qemu_info; // not read
struct qemu_plugin_tb;
struct qemu_plugin_insn;
typedef void (*translate_cb)(plugin_id, struct qemu_plugin_tb *);
typedef void (*execute_cb)(unsigned cpu, void *user);
enum { NO_REGISTERS = 0, ADD_U64 = 0 };

void qemu_plugin_register_vcpu_tb_trans_cb(plugin_id id, translate_cb callback);
void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn *insn, execute_cb callback, int flags, void *user);
void qemu_plugin_register_vcpu_insn_exec_inline(struct qemu_plugin_insn *insn, int operation, void *counter,
                                                uint64_t add);
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *tb);
struct qemu_plugin_insn *qemu_plugin_tb_get_insn(const struct qemu_plugin_tb *tb, size_t index);
uint64_t qemu_plugin_insn_vaddr(const struct qemu_plugin_insn *insn);
int qemu_plugin_install(plugin_id id, const qemu_info *info, int argc, char **argv);

#define EXPORT __attribute__((visibility("default")))
extern const int qemu_plugin_version;
EXPORT const int qemu_plugin_version = 1;

static uint64_t from_address, to_address, executed, begun;
static FILE *out;

static void at_from(unsigned cpu, void *user) {
    (void)cpu, (void)user;
    begun = executed;
}

static void at_to(unsigned cpu, void *user) {
    (void)cpu, (void)user;
    fprintf(out, "%" PRIu64 "\n", executed - begun);
    fflush(out);
}

static void translate(plugin_id id, struct qemu_plugin_tb *tb) {
    (void)id;
    for (size_t i = 0; i < qemu_plugin_tb_n_insns(tb); ++i) {
        struct qemu_plugin_insn *const insn = qemu_plugin_tb_get_insn(tb, i);
        const uint64_t address = qemu_plugin_insn_vaddr(insn);
        if (address == from_address)
            qemu_plugin_register_vcpu_insn_exec_cb(insn, at_from, NO_REGISTERS, NULL);
        if (address == to_address)
            qemu_plugin_register_vcpu_insn_exec_cb(insn, at_to, NO_REGISTERS, NULL);
        qemu_plugin_register_vcpu_insn_exec_inline(insn, ADD_U64, &executed, 1);
    }
}

EXPORT int qemu_plugin_install(plugin_id id, const qemu_info *info, int argc, char **argv) {
    const uint64_t thumb = 1; // of a Thumb function's symbol; no instruction has an odd address
    (void)info;
    for (int i = 0; i < argc; ++i) {
        if (strncmp(argv[i], "from=", 5) == 0)
            from_address = strtoull(argv[i] + 5, NULL, 0) & ~thumb;
        else if (strncmp(argv[i], "to=", 3) == 0)
            to_address = strtoull(argv[i] + 3, NULL, 0) & ~thumb;
        else if (strncmp(argv[i], "out=", 4) == 0)
            out = fopen(argv[i] + 4, "w");
    }
    if (out == NULL || from_address == 0 || to_address == 0) {
        fputs("count: needs from=ADDRESS,to=ADDRESS,out=FILE (a file that can be written)\n", stderr);
        return 1;
    }
    qemu_plugin_register_vcpu_tb_trans_cb(id, translate);
    return 0;
}
