/*
 * fuzz.h - the entry of a fuzz target, and MUST, which reports a failure
 *
 * `make fuzz` links each target to libFuzzer, which generates inputs.  Without
 * it replay.c runs the target on the files of corpus/.
 */
#ifndef CYLINT_FUZZ_H
#define CYLINT_FUZZ_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#define MUST(cond)                                                          \
    ((cond) ? (void)0                                                       \
            : (fprintf(stderr, "%s:%d: not true: %s\n", __FILE__, __LINE__, \
                       #cond),                                              \
               abort()))

#endif
