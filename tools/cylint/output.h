/*
 * output.h - bytes to standard output or a file, all of them or a message
 */
#ifndef CYLINT_OUTPUT_H
#define CYLINT_OUTPUT_H

#include <stddef.h>

struct options;

struct output {
    int fd;
    const char *name;
    size_t row;      /* bytes of a binary row; 0: rows are lines */
    long long array; /* where in the file a .npy header stands; -1: none */
};

/* Descriptors 0 to 2 must be open before any other is: else a file that we
 * open becomes "standard output".  Call it first. */
void guard_standard_streams(void);

/* open(), again if a signal interrupts it, as on a pipe without a partner. */
int open_file(const char *name, int flags);

/* All three return 0 or an exit status, having said why.  The file of -o is
 * refused if it is also read from.  A file that cannot take all that is
 * written ends with a whole row.  A .npy header is completed at the end. */
int output_open(struct output *out, const struct options *options);
int output_write(struct output *out, const char *data, size_t length);
int output_close(struct output *out);

#endif
