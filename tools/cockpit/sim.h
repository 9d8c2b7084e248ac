/// skyvert-sim: what its parts share.
#ifndef SIM_H
#define SIM_H

#include "common.h"
#include "sim_flight.h"

#define SIM "skyvert-sim"

typedef struct sim_options {
    const char *input;     ///< a flight, or a candump log
    const char *interface; ///< "can0"
    const char *log;       ///< NULL: send on the interface
    double speed;          ///< times real time; 0 = max
    double start_s;        ///< into the input
    double duration_s;     ///< of the input from there; below 0: to its end
    double bitrate;        ///< 0: the interface's
    double max_load;       ///< (0, 1]
    bool loop;
    uint8_t node;
    const char *start; ///< as given, or NULL
    sim_flight_options flight;
} sim_options;

/// Bit rate of a log when none is given.
#define SIM_LOG_BITRATE 500000.0

/// Reads the command line. @return 0 go on; 1 there was a question (help, version) and *status is what to exit with; 2
int sim_options_read(sim_options *options, int argc, char **argv, int *status);
/// Settles --start and --duration for an input of this length.
/// @param[in] first  its first moment; NULL: a log, whose start is given in seconds alone.
/// @return 0; 2 after an error line.
int sim_options_settle(sim_options *options, double input_s, const utc_time *first);

/// Whether the first byte but for blanks is a candump log's. @return 0 or 2 after an error line
int sim_is_candump(const char *path, bool *candump);

/// The flight's frames as a candump log. @return the exit status
int sim_log_flight(const sim_options *options, sim_flight *f);

/// SIGINT, SIGTERM and SIGHUP are held back from here on: sim_stopped() and descriptors see them.
void sim_hold_signals(void);
/// Waits until a moment of CLOCK_MONOTONIC, 0 = only looks. @return the signal that came, or 0
int sim_wait_until(int64_t mono_ns);
int64_t sim_mono_ns(void);
/// Readable when a signal that is held back has come; -1 iff there is no such descriptor.
int sim_signal_fd(void);

#endif
