/*
 * batch_core.h - what this core can do at most: divide, take roots, read
 */
#ifndef BENCH_BATCH_CORE_H
#define BENCH_BATCH_CORE_H

#include <stddef.h>

#include "race.h"

enum core_work { CORE_DIVIDE, CORE_ROOT, CORE_WORKS };

/* Vector widths in bits, ascending; 0 after the last this processor has. */
int core_width(int number);

/* A turn is n times so many results, independent of each other. */
enum { CORE_RESULTS = 4096 };
struct core_turn {
    int width;
    enum core_work work;
};
turn_fn core_turn;

/* A turn reads all bytes n times as fast as vectors load, seven streams at
 * once, as the first pass reads seven columns. */
struct read_turn {
    const void *from;
    size_t bytes;
};
turn_fn read_turn;

#endif
