/*
 * npy.h - the header of NumPy's .npy files
 */
#ifndef CYLINT_NPY_H
#define CYLINT_NPY_H

#include "text.h"

enum {
    NPY_PREFIX = 12, /* bytes that contain the header's length */
    FAULT_CAPACITY = SHOWN_CAPACITY + 100 /* bytes of a message */
};

/* Reads the header at the beginning of a file, of which `length` bytes are here, of
 * an array of rows x columns doubles, little endian, row after row.  Returns its
 * length, or 0 if there is none; if there are too few bytes, a number above
 * `length`: NPY_PREFIX, or the header's length.  Writes a NUL over its last byte.
 * If the header is wrong, writes a message that names the wrong field. */
size_t npy_read(char *bytes, size_t length, size_t columns,
                unsigned long long *rows, char wrong[FAULT_CAPACITY]);

#endif
