/*
 * numbers_common.h - what both number back-ends share, in C and in C++
 *
 * Hexadecimal in both directions and the words for what is not finite.
 */
#ifndef CYLINT_NUMBERS_COMMON_H
#define CYLINT_NUMBERS_COMMON_H

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

/* p is behind the sign. */
static int begins_hex(const char *p, const char *end)
{
    return end - p > 2 && p[0] == '0' && (p[1] == 'x' || p[1] == 'X');
}

/* An exponent is part of the number only if it has digits. */
static const char *skip_exponent(const char *p, const char *end, char letter)
{
    if (p == end || (*p | 0x20) != letter) {
        return p;
    }
    const char *q = p + 1;
    if (q < end && (*q == '+' || *q == '-')) {
        q++;
    }
    if (q == end || !is_digit(*q)) {
        return p;
    }
    while (q < end && is_digit(*q)) {
        q++;
    }
    return q;
}

static const char *skip_digits(const char *p, const char *end,
                               int (*belongs)(char))
{
    while (p < end && belongs(*p)) {
        p++;
    }
    return p;
}

/* Digits with a point among, before or behind them; NULL without a digit. */
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

/* strtod() reads what was found to be a number: the byte after it ends it,
 * so that nothing needs to be copied. */
static const char *read_hex(const char *text, const char *digits,
                            const char *end, double *value)
{
    const char *after = skip_mantissa(digits, end, is_hex_digit);
    if (!after) {
        return NULL;
    }
    *value = strtod(text, NULL);
    return skip_exponent(after, end, 'p');
}

static size_t write_bytes(char *out, const char *text)
{
    const size_t length = strlen(text);
    memcpy(out, text, length);
    return length;
}

/* Of printf("%a") libraries differ in subnormals and in the leading digit,
 * so the bits are taken apart here. */
static size_t write_hex(char *out, double value)
{
    static const char hex[] = "0123456789abcdef";
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    uint64_t fraction = bits & 0xfffffffffffffU;
    int exponent = (int)(bits >> 52 & 0x7ff) - 1023;
    char *p = out;
    if (bits >> 63) {
        *p++ = '-';
    }
    if (exponent == -1023 && fraction == 0) {
        return (size_t)(p - out) + write_bytes(p, "0x0p+0");
    }
    if (exponent == -1023) {
        for (exponent = -1022; !(fraction >> 52); exponent--) {
            fraction <<= 1;
        }
        fraction &= 0xfffffffffffffU;
    }
    p += write_bytes(p, "0x1");
    if (fraction) {
        *p++ = '.';
    }
    for (; fraction; fraction = fraction << 4 & 0xfffffffffffffU) {
        *p++ = hex[fraction >> 48];
    }
    *p++ = 'p';
    *p++ = exponent < 0 ? '-' : '+';
    const int size = exponent < 0 ? -exponent : exponent;
    for (int unit = 1000; unit; unit /= 10) {
        if (size >= unit || unit == 1) {
            *p++ = (char)('0' + size / unit % 10);
        }
    }
    return (size_t)(p - out);
}

/* nan without a sign, which differs between machines; inf with it. */
static size_t write_not_finite(char *out, double value)
{
    return write_bytes(out, value > 0 ? "inf" : value < 0 ? "-inf" : "nan");
}

static int is_finite(double value)
{
    return value - value == 0;
}

#endif
