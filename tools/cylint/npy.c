/*
 * npy.c - the header of NumPy's .npy files
 *
 * Six bytes \x93NUMPY, two of version, two (1.0) or four (2.0, 3.0) of the
 * length of what follows: a Python dictionary with the keys descr,
 * fortran_order and shape, padded with blanks.  3.0 is 2.0 with UTF-8 where
 * 2.0 has Latin 1.  [NumPy Enhancement Proposal 1]
 */
#include <stdio.h>

#include "input.h"

static const char magic[] = "\x93NUMPY";

enum {
    MAGIC = sizeof magic - 1,
    MAGIC_SURE = 4,  /* bytes of it that do not occur in data by chance */
    VALUE_SHOWN = 40 /* bytes of a value in a message */
};

static int begins(const char *bytes, size_t length)
{
    return memcmp(bytes, magic, length < MAGIC ? length : MAGIC) == 0;
}

/* Bytes before the dictionary. */
static size_t prefix_length(const char *header)
{
    return header[MAGIC] == 1 ? 10 : 12;
}

/* Bytes of the whole header, or 0 and a message. */
static size_t header_length(const char *bytes, char wrong[FAULT_CAPACITY])
{
    const unsigned char *b = (const unsigned char *)bytes + MAGIC;
    if (b[0] < 1 || b[0] > 3 || b[1] != 0) {
        snprintf(wrong, FAULT_CAPACITY,
                 ".npy header: version: expected 1.0, 2.0 or 3.0, found %d.%d",
                 b[0], b[1]);
        return 0;
    }
    unsigned long text = b[2] + ((unsigned long)b[3] << 8);
    if (b[0] > 1)
        text += ((unsigned long)b[4] << 16) + ((unsigned long)b[5] << 24);
    if (text < 2 || text > NPY_HEADER_MOST) {
        snprintf(wrong, FAULT_CAPACITY,
                 ".npy header: length: expected 2 to %d bytes, found %lu",
                 NPY_HEADER_MOST, text);
        return 0;
    }
    return prefix_length(bytes) + (size_t)text;
}

/* Returns the value of 'key': in the dictionary, or NULL. */
static const char *value_of(const char *dictionary, const char *key)
{
    const char *p = strstr(dictionary, key);
    if (!p)
        return NULL;
    p += strlen(key);
    p += strspn(p, " ");
    return *p == ':' ? p + 1 + strspn(p + 1, " ") : NULL;
}

/* Writes the message that the value of a key is wrong.  The value ends before
 * `last`, or with it if it is a bracket.  Returns 0. */
static int refuse_value(char wrong[FAULT_CAPACITY], const char *key,
                        const char *expected, const char *value, char last)
{
    char found[SHOWN_CAPACITY] = "nothing";
    if (value) {
        const char *end = strchr(value, last);
        end = end ? end + (last == ')') : value + strlen(value);
        escape(found, between(value, end), VALUE_SHOWN);
    }
    snprintf(wrong, FAULT_CAPACITY, ".npy header: %s: expected %s, found %s",
             key, expected, found);
    return 0;
}

/* Reads (ROWS, columns), perhaps with a comma at the end.  Of up to 16 digits, so
 * that the number of bytes has 64 bits. */
static int read_array_shape(const char *shape, size_t columns,
                            unsigned long long *rows)
{
    unsigned long long found;
    char last, bracket = 0;
    return shape &&
           sscanf(shape, "(%16llu ,%16llu %c %c", rows, &found, &last,
                  &bracket) >= 3 &&
           found == columns && (last == ')' || (last == ',' && bracket == ')'));
}

static int read_dictionary(char *header, size_t length, size_t columns,
                           unsigned long long *rows, char wrong[FAULT_CAPACITY])
{
    const char *dictionary = header + prefix_length(header);
    char expected[40];
    header[length - 1] = '\0'; /* the format has a line feed here */
    const char *descr = value_of(dictionary, "'descr'");
    const char *fortran = value_of(dictionary, "'fortran_order'");
    const char *shape = value_of(dictionary, "'shape'");
    if (!descr || strncmp(descr, "'<f8'", 5) != 0)
        return refuse_value(wrong, "descr", "'<f8'", descr, ',');
    if (!fortran || strncmp(fortran, "False", 5) != 0)
        return refuse_value(wrong, "fortran_order", "False", fortran, ',');
    snprintf(expected, sizeof expected, "(ROWS, %lu)", (unsigned long)columns);
    return read_array_shape(shape, columns, rows) ||
           refuse_value(wrong, "shape", expected, shape, ')');
}

size_t npy_read(char *bytes, size_t length, size_t columns,
                unsigned long long *rows, char wrong[FAULT_CAPACITY])
{
    const size_t whole = !begins(bytes, length) ? 0
                         : length < NPY_PREFIX  ? NPY_PREFIX
                                                : header_length(bytes, wrong);
    if (whole > 0 && whole <= length)
        read_dictionary(bytes, whole, columns, rows, wrong);
    else if (length >= MAGIC && !begins(bytes, length) &&
             begins(bytes, MAGIC_SURE))
        snprintf(wrong, FAULT_CAPACITY,
                 ".npy header: magic: expected \\x93NUMPY");
    return whole;
}
