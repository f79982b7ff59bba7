/*
 * numbers_common.h - the common part of both number back-ends, C and C++
 *
 * It reads short decimals, reads and writes hexadecimal, and writes inf and nan.
 */
#ifndef CYLINT_NUMBERS_COMMON_H
#define CYLINT_NUMBERS_COMMON_H

#include <float.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "numbers.h"

static int is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static int is_hex_digit(char c)
{
    return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}

#if FLT_EVAL_METHOD == 0
static const char *skip_and_count(const char *p, uint64_t *count)
{
    for (; is_digit(*p); p++)
        *count = 10 * *count + (uint64_t)(*p - '0');
    return p;
}

/* Whether none of eight bytes is below '.', as separators and signs are.  A
 * borrow can only make a further byte count as below. */
static int is_solid(const char *p)
{
    const uint64_t ones = 0x0101010101010101u;
    uint64_t x;
    memcpy(&x, p, sizeof x);
    return ((x - ones * '.') & ~x & (ones << 7)) == 0;
}

/* Numbers of 17 characters or more are rarely short and are not tested. */
static int is_long(const char *text, const char *end)
{
    return end - text > 17 && (is_solid(text + 1) & is_solid(text + 9));
}

/*
 * Reads digits with a point but without an exponent, the most frequent form.
 * The number is M / 10^k, where M has all the digits and k of them are after
 * the point.  If M < 2^53 and k <= 22, both are doubles and the quotient is
 * rounded once: it is the nearest double [Clinger 1990].  This needs arithmetic
 * without excess precision.  Returns NULL for other numbers.
 */
static const char *read_short(const char *text, const char *end, double *value)
{
    static const double powers[2][19] = {
        {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12,
         1e13, 1e14, 1e15, 1e16, 1e17, 1e18},
        {-1e0, -1e1, -1e2, -1e3, -1e4, -1e5, -1e6, -1e7, -1e8, -1e9, -1e10,
         -1e11, -1e12, -1e13, -1e14, -1e15, -1e16, -1e17, -1e18}};
    enum { DIGITS_MOST = 18 /* 10^18 < 2^64, so M is not wrapped round */ };
    if (is_long(text, end))
        return NULL;
    const int minus = *text == '-';
    const char *const digits = text + (minus || *text == '+');
    uint64_t m = 0;
    const char *after = skip_and_count(digits, &m);
    ptrdiff_t count = after - digits, parts = 0;
    if (*after == '.') {
        const char *const part = after + 1;
        after = skip_and_count(part, &m);
        parts = after - part;
        count += parts;
    }
    if (count == 0 || count > DIGITS_MOST || m >= (uint64_t)1 << 53 ||
        (*after | 0x20) == 'e' || (*after | 0x20) == 'x')
        return NULL;
    *value = (double)(int64_t)m / powers[minus][parts];
    return after;
}
#else
static const char *read_short(const char *text, const char *end, double *value)
{
    (void)text;
    (void)end;
    (void)value;
    return NULL;
}
#endif

/* p points behind the sign. */
static int begins_hex(const char *p, const char *end)
{
    return end - p > 2 && p[0] == '0' && (p[1] == 'x' || p[1] == 'X');
}

/* An exponent is part of the number only if it has digits. */
static const char *skip_exponent(const char *p, const char *end, char letter)
{
    if (p == end || (*p | 0x20) != letter)
        return p;
    const char *q = p + 1;
    if (q < end && (*q == '+' || *q == '-'))
        q++;
    if (q == end || !is_digit(*q))
        return p;
    while (q < end && is_digit(*q))
        q++;
    return q;
}

static const char *skip_digits(const char *p, const char *end,
                               int (*belongs)(char))
{
    while (p < end && belongs(*p))
        p++;
    return p;
}

/* Skips digits and at most one point.  Returns NULL if there is no digit. */
static const char *skip_mantissa(const char *p, const char *end,
                                 int (*belongs)(char))
{
    const char *whole = skip_digits(p, end, belongs);
    ptrdiff_t digits = whole - p;
    if (whole < end && *whole == '.') {
        const char *part = skip_digits(whole + 1, end, belongs);
        digits += part - (whole + 1);
        whole = part;
    }
    return digits > 0 ? whole : NULL;
}

/* Reads a number by strtod().  The byte after it cannot continue the number, so
 * nothing is copied. */
static const char *read_hex(const char *text, const char *digits,
                            const char *end, double *value)
{
    const char *after = skip_mantissa(digits, end, is_hex_digit);
    if (!after)
        return NULL;
    *value = strtod(text, NULL);
    return skip_exponent(after, end, 'p');
}

static size_t write_bytes(char *out, const char *text)
{
    const size_t length = strlen(text);
    memcpy(out, text, length);
    return length;
}

/* Writes a hexadecimal number from its bits: printf("%a") of C libraries differs
 * for subnormals and in the leading digit. */
static size_t write_hex(char *out, double value)
{
    static const char hex[] = "0123456789abcdef";
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    uint64_t fraction = bits & 0xfffffffffffffU;
    int exponent = (int)(bits >> 52 & 0x7ff) - 1023;
    char *p = out;
    if (bits >> 63)
        *p++ = '-';
    if (exponent == -1023 && fraction == 0)
        return (size_t)(p - out) + write_bytes(p, "0x0p+0");
    if (exponent == -1023) {
        for (exponent = -1022; !(fraction >> 52); exponent--)
            fraction <<= 1;
        fraction &= 0xfffffffffffffU;
    }
    p += write_bytes(p, "0x1");
    if (fraction)
        *p++ = '.';
    for (; fraction; fraction = fraction << 4 & 0xfffffffffffffU)
        *p++ = hex[fraction >> 48];
    *p++ = 'p';
    *p++ = exponent < 0 ? '-' : '+';
    const int size = exponent < 0 ? -exponent : exponent;
    for (int unit = 1000; unit; unit /= 10)
        if (size >= unit || unit == 1)
            *p++ = (char)('0' + size / unit % 10);
    return (size_t)(p - out);
}

/* Writes nan without its sign, which differs between machines; inf with it. */
static size_t write_not_finite(char *out, double value)
{
    return write_bytes(out, value > 0 ? "inf" : value < 0 ? "-inf" : "nan");
}

static int is_finite(double value)
{
    return value - value == 0;
}

#endif
