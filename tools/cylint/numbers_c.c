/*
 * numbers_c.c - numbers by the C library, for compilers without C++17
 *
 * Writes the same bytes as numbers.cc, which includes this file as C++.
 */
#include <stdio.h>

#include "numbers_common.h"

const char *cylint_read_number(const char *text, const char *end, double *value)
{
    const char *const after_short = read_short(text, end, value);
    if (after_short)
        return after_short;
    const char *digits = text;
    if (digits < end && (*digits == '+' || *digits == '-'))
        digits++;
    if (begins_hex(digits, end))
        return read_hex(text, digits + 2, end, value);
    const char *after = skip_mantissa(digits, end, is_digit);
    if (!after)
        return NULL;
    *value = strtod(text, NULL);
    return skip_exponent(after, end, 'e');
}

/* A decimal number: d[0].d[1]d[2]... times 10^exponent. */
struct decimal {
    char digits[NUMBER_MAX_DIGITS + 1];
    int count;
    int exponent;
};

/* Writes the decimal of `count` digits nearest to a positive value. */
static void round_decimal(struct decimal *d, double value, int count)
{
    char text[NUMBER_CAPACITY];
    snprintf(text, sizeof text, "%.*e", count - 1, value);
    d->count = count;
    d->digits[0] = text[0];
    if (count > 1)
        memcpy(d->digits + 1, text + 2, (size_t)count - 1);
    d->exponent = atoi(text + (count > 1 ? count + 2 : 2));
}

/* Replaces *d by the next larger decimal of as many digits. */
static void next_decimal(struct decimal *d)
{
    int i = d->count - 1;
    while (i >= 0 && d->digits[i] == '9')
        d->digits[i--] = '0';
    if (i >= 0) {
        d->digits[i]++;
        return;
    }
    d->digits[0] = '1';
    d->exponent++;
}

static size_t write_scientific(char *out, const struct decimal *d)
{
    char *p = out;
    *p++ = d->digits[0];
    if (d->count > 1) {
        *p++ = '.';
        memcpy(p, d->digits + 1, (size_t)d->count - 1);
        p += d->count - 1;
    }
    const int size = snprintf(p, 8, "e%c%02d", d->exponent < 0 ? '-' : '+',
                              d->exponent < 0 ? -d->exponent : d->exponent);
    return (size_t)(p - out) + (size_t)size;
}

static int reads_back(const struct decimal *d, double value)
{
    char text[NUMBER_CAPACITY];
    text[write_scientific(text, d)] = '\0';
    return strtod(text, NULL) == value;
}

/*
 * Writes the shortest decimal that reads back as the value; of several the
 * closest.  In general only the nearest decimal of a given length needs a test.
 * A power of two is an exception: the doubles below it are twice as dense, so
 * the next larger decimal may read back although the nearest does not (2^-44,
 * 16 digits).
 */
static void shortest_decimal(struct decimal *d, double value)
{
    for (int count = 1; count < NUMBER_MAX_DIGITS; count++) {
        round_decimal(d, value, count);
        if (reads_back(d, value))
            return;
        next_decimal(d);
        if (reads_back(d, value))
            return;
    }
    round_decimal(d, value, NUMBER_MAX_DIGITS);
}

static size_t write_fixed(char *out, const struct decimal *d, double value)
{
    if (d->exponent >= d->count - 1)
        return (size_t)snprintf(out, NUMBER_CAPACITY, "%.0f", value);
    char *p = out;
    if (d->exponent < 0) {
        p += write_bytes(p, "0.");
        for (int i = -1; i > d->exponent; i--)
            *p++ = '0';
    }
    for (int i = 0; i < d->count; i++) {
        *p++ = d->digits[i];
        if (i == d->exponent)
            *p++ = '.';
    }
    return (size_t)(p - out);
}

/* Lengths of the two notations, without the sign. */
static int scientific_length(const struct decimal *d)
{
    const int wide = d->exponent >= 100 || d->exponent <= -100;
    return d->count + (d->count > 1) + (wide ? 5 : 4);
}

static int fixed_length(const struct decimal *d)
{
    if (d->exponent < 0)
        return d->count - d->exponent + 1;
    return d->exponent >= d->count - 1 ? d->exponent + 1 : d->count + 1;
}

size_t cylint_write_number(char out[NUMBER_CAPACITY], double value, int digits)
{
    if (!is_finite(value))
        return write_not_finite(out, value);
    if (digits == NUMBER_HEX)
        return write_hex(out, value);
    if (digits != NUMBER_SHORTEST)
        return (size_t)snprintf(out, NUMBER_CAPACITY, "%.*g", digits, value);
    char *p = out;
    if (value < 0 || (value == 0 && 1 / value < 0)) {
        *p++ = '-';
        value = -value;
    }
    if (value == 0) {
        *p++ = '0';
        return (size_t)(p - out);
    }
    struct decimal d;
    shortest_decimal(&d, value);
    p += fixed_length(&d) <= scientific_length(&d) ? write_fixed(p, &d, value)
                                                   : write_scientific(p, &d);
    return (size_t)(p - out);
}
