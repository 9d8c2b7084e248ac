/// Instructions counted by callgrind: the program runs itself once more under valgrind.
#ifndef TOOLS_TRADE_CALLGRIND_H
#define TOOLS_TRADE_CALLGRIND_H

enum { CALLGRIND_LABEL = 64 };

// --- within the run under valgrind ---

/// 1 iff this program was built with valgrind's header.
int callgrind_built(void);
/// Instructions are looked at from here on; what lies outside runs at valgrind's full speed.
void callgrind_on(void);
void callgrind_off(void);
/// Between these two they are counted, as the label's; NULL: they are not wanted after all.
void callgrind_begin(void);
void callgrind_end(const char *label);

// --- outside ---

typedef struct callgrind_run {
    char *const *command; ///< [..., NULL] program and options
    const char *last;     ///< one more; NULL: none
    const char *folder;   ///< for the dumps; made and removed; the log stays there after an error
    double expected;      ///< labels, for the progress
    /// What was counted, label by label, as it comes.
    void (*take)(void *taker, const char *label, double instructions);
    void *taker;
    int (*progress)(void *context, double done); ///< another result than 0 stops it; NULL: not wanted
    void *context;
} callgrind_run;

enum { CALLGRIND_DONE, CALLGRIND_STOPPED, CALLGRIND_FAILED };

/// @return CALLGRIND_*
int callgrind_count(const callgrind_run *run);

#endif
