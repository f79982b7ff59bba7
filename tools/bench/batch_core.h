/*
 * batch_core.h - the limits of this core: division, square root, reading memory
 */
#ifndef BENCH_BATCH_CORE_H
#define BENCH_BATCH_CORE_H

#include <stddef.h>

#include "race.h"

enum core_work { CORE_DIVIDE, CORE_ROOT, CORE_WORKS };

/* Vector widths of this processor in bits, ascending; 0 after the last. */
int core_width(int number);

/* A turn computes n times CORE_RESULTS independent results. */
enum { CORE_RESULTS = 4096 };
struct core_turn {
    int width;
    enum core_work work;
};
turn_fn core_turn;

/* A turn reads all bytes n times with vector loads, in seven streams. */
struct read_turn {
    const void *from;
    size_t bytes;
};
turn_fn read_turn;

#endif
