/// skyvert-cockpit: the sky of a cockpit from a CAN bus.
#include <stdlib.h>

#include "cockpit_loop.h"

int main(int argc, char **argv) {
    static cockpit c;
    int status = 0;
    if (cockpit_options_read(&c.options, argc, argv, &status) != 0)
        return status;
    status = cockpit_open(&c);
    if (status == 0) {
        status = cockpit_run(&c);
        if (c.options.stats) {
            const int written = cockpit_stats_write(&c, c.options.stats);
            status = status ? status : written;
        }
    }
    cockpit_close(&c);
    return status;
}
