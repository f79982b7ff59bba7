/*
 * text.h - appends bytes to a buffer of the caller
 *
 * Nothing here allocates: the caller provides memory for TEXT_FULL bytes and the
 * longest row, and empties the text when it holds TEXT_FULL bytes.
 */
#ifndef CYLINT_TEXT_H
#define CYLINT_TEXT_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "sizes.h"

struct text {
    char *data;
    size_t length;
};

static inline void put_char(struct text *t, char c)
{
    t->data[t->length++] = c;
}

static inline void put_bytes(struct text *t, const void *bytes, size_t n)
{
    memcpy(t->data + t->length, bytes, n);
    t->length += n;
}

static inline void put_string(struct text *t, const char *s)
{
    put_bytes(t, s, strlen(s));
}

/* Appends a whole number in decimal digits. */
void put_whole(struct text *t, unsigned long long value);

/* Appends the eight bytes of a double, the lowest first on every machine.
 * Compilers translate this to one store. */
static inline void put_little_endian(struct text *t, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    char *const to = t->data + t->length;
#define PUT(i) to[i] = (char)(unsigned char)(bits >> 8 * (i))
    PUT(0), PUT(1), PUT(2), PUT(3), PUT(4), PUT(5), PUT(6), PUT(7);
#undef PUT
    t->length += 8;
}

static inline double get_little_endian(const char bytes[8])
{
#define BYTE(i) ((uint64_t)(unsigned char)bytes[i] << 8 * (i))
    const uint64_t bits = BYTE(0) | BYTE(1) | BYTE(2) | BYTE(3) | BYTE(4) |
                          BYTE(5) | BYTE(6) | BYTE(7);
#undef BYTE
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/*
 * Copies [from, end).  Writes each byte that is not printable ASCII, and the
 * backslash, as \xHH, so that the text is unambiguous.  After `most` bytes it
 * writes "..." and stops.  `to` has 4 * most + 4 bytes.  Writes a NUL at the
 * end.  Returns the length.
 */
size_t escape_bytes(char *to, const char *from, const char *end, size_t most);

#endif
