/*
 * npy.c - the header of NumPy's .npy files
 *
 * Six bytes \x93NUMPY, two of version, two (1.0) or four (2.0, 3.0) of the
 * length of what follows: a Python dictionary with the keys descr,
 * fortran_order and shape, padded with blanks.  3.0 is 2.0 with UTF-8 where
 * 2.0 has Latin 1.  [NumPy Enhancement Proposal 1]
 */
#include <stdio.h>
#include <string.h>

#include "npy.h"
#include "text.h"

static const char magic[] = "\x93NUMPY";

enum {
    MAGIC = sizeof magic - 1,
    MAGIC_SURE =
        4, /* this many bytes of the magic do not occur in data by chance */
    VALUE_MOST = 40 /* bytes of a value in a message */
};

int npy_begins(const char *bytes, size_t length)
{
    return memcmp(bytes, magic, length < MAGIC ? length : MAGIC) == 0;
}

int npy_is_damaged(const char *bytes, size_t length)
{
    return length >= MAGIC && npy_begins(bytes, MAGIC_SURE) &&
           !npy_begins(bytes, length);
}

/* Bytes before the dictionary. */
static size_t prefix_length(const char *header)
{
    return header[MAGIC] == 1 ? 10 : 12;
}

size_t npy_length(const char *bytes, char wrong[NPY_WRONG])
{
    const unsigned char *b = (const unsigned char *)bytes + MAGIC;
    if (b[0] < 1 || b[0] > 3 || b[1] != 0) {
        snprintf(wrong, NPY_WRONG,
                 ".npy header: version: expected 1.0, 2.0 or 3.0, found %d.%d",
                 b[0], b[1]);
        return 0;
    }
    unsigned long text = b[2] + ((unsigned long)b[3] << 8);
    if (b[0] > 1)
        text += ((unsigned long)b[4] << 16) + ((unsigned long)b[5] << 24);
    if (text < 2 || text > NPY_HEADER_MOST) {
        snprintf(wrong, NPY_WRONG,
                 ".npy header: length: expected 2 to %d bytes, found %lu",
                 NPY_HEADER_MOST, text);
        return 0;
    }
    return prefix_length(bytes) + (size_t)text;
}

static const char *skip_spaces(const char *p)
{
    while (*p == ' ')
        p++;
    return p;
}

/* Returns the text after 'key': in the dictionary. */
static const char *value_of_key(const char *dictionary, const char *key)
{
    const char *p = strstr(dictionary, key);
    if (!p)
        return NULL;
    p = skip_spaces(p + strlen(key));
    return *p == ':' ? skip_spaces(p + 1) : NULL;
}

/* Reads a number and the comma after it. */
static const char *read_extent(const char *p, unsigned long long *extent)
{
    const char *first = p = skip_spaces(p);
    *extent = 0;
    while (*p >= '0' && *p <= '9' && p - first < 18)
        *extent = 10 * *extent + (unsigned long long)(*p++ - '0');
    if (p == first)
        return NULL;
    return skip_spaces(p);
}

static int read_shape(const char *p, unsigned long long extents[2])
{
    if (!p || *p != '(')
        return 0;
    p = read_extent(p + 1, &extents[0]);
    if (!p || *p != ',')
        return 0;
    p = read_extent(p + 1, &extents[1]);
    return p && (*p == ')' || (*p == ',' && *skip_spaces(p + 1) == ')'));
}

/* Writes the message that the value of a key is wrong.  The value ends before
 * `last`, or with it if it is a bracket. */
static int refuse(char wrong[NPY_WRONG], const char *key, const char *expected,
                  const char *value, char last)
{
    char found[4 * VALUE_MOST + 4] = "nothing";
    if (value) {
        const char *end = strchr(value, last);
        const size_t length = end ? (size_t)(end - value) : strlen(value);
        escape_bytes(found, value, value + length + (end && last == ')'),
                     VALUE_MOST);
    }
    snprintf(wrong, NPY_WRONG, ".npy header: %s: expected %s, found %s", key,
             expected, found);
    return 0;
}

int npy_read(char *header, size_t length, size_t columns,
             unsigned long long *rows, char wrong[NPY_WRONG])
{
    const char *dictionary = header + prefix_length(header);
    header[length - 1] = '\0'; /* the format has a line feed here */
    const char *descr = value_of_key(dictionary, "'descr'");
    const char *fortran = value_of_key(dictionary, "'fortran_order'");
    const char *shape = value_of_key(dictionary, "'shape'");
    unsigned long long extents[2];
    if (!descr || strncmp(descr, "'<f8'", 5) != 0)
        return refuse(wrong, "descr", "'<f8'", descr, ',');
    if (!fortran || strncmp(fortran, "False", 5) != 0)
        return refuse(wrong, "fortran_order", "False", fortran, ',');
    if (!read_shape(shape, extents) || extents[1] != columns) {
        char expected[40];
        snprintf(expected, sizeof expected, "(ROWS, %lu)",
                 (unsigned long)columns);
        return refuse(wrong, "shape", expected, shape, ')');
    }
    *rows = extents[0];
    return 1;
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
