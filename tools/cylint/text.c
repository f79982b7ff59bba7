/*
 * text.c - whole numbers and escaped bytes
 */
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

int read_whole(const char *p, const char *end, unsigned long long most,
               unsigned long long *value)
{
    *value = 0;
    if (p == end)
        return 0;
    for (; p < end && *p >= '0' && *p <= '9' && *value <= most; p++)
        *value = 10 * *value + (unsigned long long)(*p - '0');
    return p == end && *value <= most;
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
