/*
 * npy.h - the header of NumPy's .npy files
 */
#ifndef CYLINT_NPY_H
#define CYLINT_NPY_H

#include <stddef.h>

#include "sizes.h"

enum {
    NPY_PREFIX = 12,  /* bytes that tell the header's length */
    NPY_WRITTEN = 128 /* bytes of a header that we write */
};

/* Whether the bytes begin like a .npy file, as far as they go. */
int npy_begins(const char *bytes, size_t length);

/* Bytes of the whole header, from the first NPY_PREFIX of them; 0 if the
 * version is unknown or the header absurdly long. */
size_t npy_length(const char *bytes);

/*
 * NULL and the number of rows if the array is rows x columns doubles, little
 * endian, row after row; otherwise what is wrong with it.  Writes a NUL over
 * the header's last byte.
 */
const char *npy_read(char *header, size_t length, size_t columns,
                     unsigned long long *rows);

/* The header of an array of so many rows of doubles; of the same length
 * whatever the numbers. */
void npy_write(char header[NPY_WRITTEN], unsigned long long rows,
               size_t columns);

#endif
