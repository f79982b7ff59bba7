/*
 * npy.h - the header of NumPy's .npy files
 */
#ifndef CYLINT_NPY_H
#define CYLINT_NPY_H

#include "text.h"

enum {
    NPY_PREFIX = 12,   /* bytes that contain the header's length */
    NPY_WRITTEN = 128, /* bytes of a header of npy_write() */
    NPY_WRONG = SHOWN_CAPACITY + 100 /* bytes of a message */
};

/* Whether the bytes are the beginning of a .npy file. */
int npy_begins(const char *bytes, size_t length);

/* Whether the bytes begin with most of the magic, but not with all of it. */
int npy_is_damaged(const char *bytes, size_t length);

/* Bytes of the whole header, from the first NPY_PREFIX of them; 0 and a
 * message if the version is unknown or the length out of range. */
size_t npy_length(const char *bytes, char wrong[NPY_WRONG]);

/* Returns 1 and the number of rows if the array is rows x columns doubles,
 * little endian, row after row; otherwise 0 and a message that names the
 * wrong field. Writes a NUL over the header's last byte. */
int npy_read(char *header, size_t length, size_t columns,
             unsigned long long *rows, char wrong[NPY_WRONG]);

/* Writes the header of an array of `rows` rows of doubles.  Its length does not
 * depend on the numbers. */
void npy_write(char header[NPY_WRITTEN], unsigned long long rows,
               size_t columns);

#endif
