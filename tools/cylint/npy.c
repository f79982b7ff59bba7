/*
 * npy.c - the header of NumPy's .npy files
 *
 * Six bytes \x93NUMPY, two of version, two (1.0) or four (2.0) of the length
 * of what follows: a Python dictionary with the keys descr, fortran_order
 * and shape, padded with blanks.  [NumPy Enhancement Proposal 1]
 */
#include <stdio.h>
#include <string.h>

#include "npy.h"

static const char magic[] = "\x93NUMPY";

enum { MAGIC = sizeof magic - 1 };

int npy_begins(const char *bytes, size_t length)
{
    return memcmp(bytes, magic, length < MAGIC ? length : MAGIC) == 0;
}

size_t npy_length(const char *bytes)
{
    const unsigned char *b = (const unsigned char *)bytes + MAGIC;
    size_t length = 0;
    if (b[0] == 1 && b[1] == 0) {
        length = 10 + (size_t)b[2] + ((size_t)b[3] << 8);
    } else if (b[0] == 2 && b[1] == 0 && b[4] == 0 && b[5] == 0) {
        length = 12 + (size_t)b[2] + ((size_t)b[3] << 8);
    }
    return length >= NPY_PREFIX && length <= NPY_HEADER_MOST ? length : 0;
}

static const char *skip_spaces(const char *p)
{
    while (*p == ' ') {
        p++;
    }
    return p;
}

/* What stands behind 'key': in the dictionary. */
static const char *value_of_key(const char *dictionary, const char *key)
{
    const char *p = strstr(dictionary, key);
    if (!p) {
        return NULL;
    }
    p = skip_spaces(p + strlen(key));
    return *p == ':' ? skip_spaces(p + 1) : NULL;
}

/* A number and a comma behind it. */
static const char *read_extent(const char *p, unsigned long long *extent)
{
    const char *first = p = skip_spaces(p);
    *extent = 0;
    while (*p >= '0' && *p <= '9' && p - first < 18) {
        *extent = 10 * *extent + (unsigned long long)(*p++ - '0');
    }
    if (p == first) {
        return NULL;
    }
    return skip_spaces(p);
}

static int read_shape(const char *p, unsigned long long extents[2])
{
    if (!p || *p != '(') {
        return 0;
    }
    p = read_extent(p + 1, &extents[0]);
    if (!p || *p != ',') {
        return 0;
    }
    p = read_extent(p + 1, &extents[1]);
    return p && (*p == ')' || (*p == ',' && *skip_spaces(p + 1) == ')'));
}

const char *npy_read(char *header, size_t length, size_t columns,
                     unsigned long long *rows)
{
    const char *dictionary = header + (header[MAGIC] == 1 ? 10 : 12);
    header[length - 1] = '\0'; /* a line feed, says the format */
    const char *descr = value_of_key(dictionary, "'descr'");
    const char *fortran = value_of_key(dictionary, "'fortran_order'");
    const char *shape = value_of_key(dictionary, "'shape'");
    unsigned long long extents[2];
    if (!descr || !fortran || !shape) {
        return ".npy header: not understood";
    }
    if (strncmp(descr, "'<f8'", 5) != 0) {
        return ".npy header: the numbers are not of type '<f8'";
    }
    if (strncmp(fortran, "False", 5) != 0) {
        return ".npy header: the array is in Fortran order";
    }
    if (!read_shape(shape, extents)) {
        return ".npy header: the array has not two dimensions";
    }
    if (extents[1] != columns) {
        return ".npy header: the array has not as many columns as a record"
               " has numbers";
    }
    *rows = extents[0];
    return NULL;
}

void npy_write(char header[NPY_WRITTEN], unsigned long long rows,
               size_t columns)
{
    enum { BEFORE = 10, TEXT = NPY_WRITTEN - BEFORE };
    char text[TEXT + 1];
    snprintf(text, sizeof text,
             "{'descr': '<f8', 'fortran_order': False, 'shape': (%llu, %lu), }",
             rows, (unsigned long)columns);
    memcpy(header, magic, MAGIC);
    memcpy(header + MAGIC, "\1\0", 2);
    header[MAGIC + 2] = TEXT;
    header[MAGIC + 3] = 0;
    const size_t length = strlen(text);
    memcpy(header + BEFORE, text, length);
    memset(header + BEFORE + length, ' ', TEXT - length);
    header[NPY_WRITTEN - 1] = '\n';
}
