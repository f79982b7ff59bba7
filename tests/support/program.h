/*
 * program.h - settings and skipping, for every program of tests/
 */
#ifndef CYLINT_TEST_PROGRAM_H
#define CYLINT_TEST_PROGRAM_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

/* The environment variable as a number; `otherwise` if it is not set. */
static inline uint64_t check_setting(const char *name, uint64_t otherwise)
{
    const char *text = getenv(name);
    return text ? strtoull(text, NULL, 10) : otherwise;
}

static inline uint64_t check_seed(void)
{
    return check_setting("CYLINT_SEED", 1);
}

/* Prints why the program cannot run here and returns the exit status that
 * tests/support/run.sh counts as skipped. */
static inline int check_skip(const char *reason)
{
    puts(reason);
    return 77;
}

#endif
