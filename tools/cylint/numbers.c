/*
 * numbers.c - converts text to double and double to text
 *
 * Short decimals are read here, because they are the most frequent numbers.
 */
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "numbers.h"
#include "text.h"

static const char *read_digits(const char *p, uint64_t *count)
{
    for (; is_digit(*p); p++)
        *count = 10 * *count + (uint64_t)(*p - '0');
    return p;
}

/*
 * Reads digits with a point but without an exponent, the most frequent form.
 * The number is M / 10^k, where M has all the digits and k of them are after
 * the point.  If M < 2^53 and k <= 22, both are doubles and the quotient is
 * rounded once: it is the nearest double [Clinger, How to read floating-point
 * numbers accurately, 1990].  This needs arithmetic without excess precision.
 * Returns NULL for other numbers.
 */
static const char *read_short(const char *text, double *value)
{
    static const double powers[2][19] = {
        {1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12,
         1e13, 1e14, 1e15, 1e16, 1e17, 1e18},
        {-1e0, -1e1, -1e2, -1e3, -1e4, -1e5, -1e6, -1e7, -1e8, -1e9, -1e10,
         -1e11, -1e12, -1e13, -1e14, -1e15, -1e16, -1e17, -1e18}};
    enum { DIGITS_MOST = 18 /* 10^18 < 2^64, so M is not wrapped round */ };
    if (FLT_EVAL_METHOD != 0)
        return NULL;
    const int is_negative = *text == '-';
    const char *const digits = text + (is_negative || *text == '+');
    uint64_t m = 0;
    const char *after = read_digits(digits, &m);
    ptrdiff_t count = after - digits, places = 0;
    if (*after == '.') {
        const char *const part = after + 1;
        after = read_digits(part, &m);
        places = after - part;
        count += places;
    }
    if (count == 0 || count > DIGITS_MOST || m >= (uint64_t)1 << 53 ||
        (*after | 0x20) == 'e' || (*after | 0x20) == 'x')
        return NULL;
    *value = (double)(int64_t)m / powers[is_negative][places];
    return after;
}

/* The libraries read inf and nan, too, and not all of them read a plus sign. */
const char *cylint_read_number(const char *text, const char *end, double *value)
{
    const char *after = read_short(text, value);
    if (after)
        return after;
    const char *p = text + (*text == '+' || *text == '-');
    if (!(is_digit(*p) || *p == '.'))
        return NULL;
    if (*p != '0' || (p[1] | 0x20) != 'x')
        return cylint_read_decimal(*text == '+' ? p : text, end, value);
    char *stop;
    *value = strtod(text, &stop);
    return stop;
}

/* Writes nan without its sign, which differs between machines; inf with it. */
static size_t write_not_finite(char *out, double value)
{
    const char *word = value > 0 ? "inf" : value < 0 ? "-inf" : "nan";
    memcpy(out, word, strlen(word));
    return strlen(word);
}

/* Libraries differ in the leading digits of numbers and of subnormals: here the
 * leading digit is 1, or 0 of zero. */
static size_t write_hex(char *out, double value)
{
    struct text t = {out, 0};
    int exponent;
    double digits = 2 * frexp(fabs(value), &exponent);
    const int leading = (int)digits;
    exponent -= leading;
    put_word(&t, signbit(value) ? "-0x" : "0x");
    put_whole(&t, (unsigned)leading);
    digits -= leading;
    if (digits > 0)
        put_char(&t, '.');
    while (digits > 0) {
        digits *= 16;
        put_char(&t, "0123456789abcdef"[(int)digits]);
        digits -= (int)digits;
    }
    put_word(&t, exponent < 0 ? "p-" : "p+");
    put_whole(&t, (unsigned)abs(exponent));
    return t.length;
}

size_t cylint_write_number(char out[NUMBER_CAPACITY], double value, int digits)
{
    return value - value != 0     ? write_not_finite(out, value)
           : digits == NUMBER_HEX ? write_hex(out, value)
                                  : cylint_write_digits(out, value, digits);
}
