/*
 * text.c - whole numbers, raw doubles and escaped bytes
 */
#include <stdint.h>

#include "text.h"

void put_whole(struct text *t, unsigned long long value)
{
    char digits[24];
    size_t i = sizeof digits;
    do {
        digits[--i] = (char)('0' + value % 10);
        value /= 10;
    } while (value);
    put_bytes(t, digits + i, sizeof digits - i);
}

/* Eight bytes written out: compilers make one load or store of them. */
void put_little_endian(struct text *t, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
#define BYTE(i) (unsigned char)(bits >> 8 * (i))
    const unsigned char bytes[8] = {BYTE(0), BYTE(1), BYTE(2), BYTE(3),
                                    BYTE(4), BYTE(5), BYTE(6), BYTE(7)};
#undef BYTE
    put_bytes(t, bytes, sizeof bytes);
}

double get_little_endian(const char bytes[8])
{
#define BYTE(i) ((uint64_t)(unsigned char)bytes[i] << 8 * (i))
    const uint64_t bits = BYTE(0) | BYTE(1) | BYTE(2) | BYTE(3) |
                          BYTE(4) | BYTE(5) | BYTE(6) | BYTE(7);
#undef BYTE
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

size_t escape_bytes(char *to, const char *from, const char *end, size_t most)
{
    static const char hex[] = "0123456789abcdef";
    struct text t = {to, 0};
    const char *last = (size_t)(end - from) > most ? from + most : end;
    for (const char *p = from; p < last; p++) {
        const unsigned char c = (unsigned char)*p;
        if (c >= 0x20 && c < 0x7f && c != '\\') {
            put_char(&t, *p);
        } else {
            put_string(&t, "\\x");
            put_char(&t, hex[c >> 4]);
            put_char(&t, hex[c & 15]);
        }
    }
    put_string(&t, last < end ? "..." : "");
    to[t.length] = '\0';
    return t.length;
}
