/*
 * output.h - writes bytes to standard output or a file
 */
#ifndef CYLINT_OUTPUT_H
#define CYLINT_OUTPUT_H

#include <stddef.h>

#include "target.h"

struct options;

struct output {
    struct target target;
    size_t row;      /* bytes of a binary row; 0: rows are lines */
    long long array; /* position of the .npy header in the file; -1: none */
};

/* Opens those of the descriptors 0 to 2 that are closed.  Otherwise the next
 * file opened would become standard output.  Call it first. */
void guard_standard_streams(void);

/* Whether this regular file is an input file, too; prints a message if so. */
int output_is_input(const char *file, const struct options *options);

/* All three return 0, or an exit status after a message.  The file of -o must
 * not be an input file; it takes its place if it is whole.  Output that cannot
 * take all bytes ends with a whole row.  A .npy header is completed at the
 * end. */
int output_open(struct output *out, const struct options *options);
int output_write(struct output *out, const char *data, size_t length);
int output_close(struct output *out, int is_whole);

#endif
