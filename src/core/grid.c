#include "skyvert/table.h"

size_t skv_grid_size(const skv_frame *frame) {
    (void)frame;
    return 0;
}

skv_status skv_frame_grid(skv_frame *frame, float *grid, size_t n) {
    (void)n;
    return frame && grid ? SKV_ERR_UNSUPPORTED : SKV_ERR_NULL;
}
