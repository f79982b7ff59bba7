/*
 * numbers_c.c - decimal numbers by the C library, where no C++ compiler has
 * std::from_chars for double.  Writes the same bytes as numbers.cc.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "numbers.h"

/* The byte after the number cannot continue it, so nothing is copied. */
const char *cylint_read_decimal(const char *text, const char *end,
                                double *value)
{
    char *after;
    (void)end;
    *value = strtod(text, &after);
    return after > text ? after : NULL;
}

/* Increases the last digit of d.ddde+xx.  Returns 0 if that is a 9: then a
 * shorter decimal would do. */
static int increase(char *text)
{
    char *last = text + strcspn(text, "e") - 1;
    if (*last == '9')
        return 0;
    ++*last;
    return 1;
}

/*
 * Writes the shortest decimal that reads back as the value; of several the
 * closest. In general only the nearest decimal of a given length needs a test.
 * A power of two is an exception: the doubles below it are twice as dense, so
 * the next larger decimal may read back although the nearest does not (2^-44,
 * 16 digits).  These have exponents for which the scientific notation is the
 * shorter one.
 */
static size_t write_shortest(char out[NUMBER_CAPACITY], double value)
{
    char text[NUMBER_CAPACITY];
    int digits = 0;
    do
        snprintf(text, sizeof text, "%.*e", digits++, value);
    while (digits < NUMBER_MAX_DIGITS && strtod(text, NULL) != value &&
           !(increase(text) && strtod(text, NULL) == value));
    const int places = digits - 1 - atoi(text + strcspn(text, "e") + 1);
    const int length = (int)strlen(text);
    const int fixed =
        snprintf(out, NUMBER_CAPACITY, "%.*f", places > 0 ? places : 0, value);
    if (fixed > length)
        memcpy(out, text, (size_t)length);
    return (size_t)(fixed > length ? length : fixed);
}

size_t cylint_write_digits(char *out, double value, int digits)
{
    return digits == NUMBER_SHORTEST
               ? write_shortest(out, value)
               : (size_t)snprintf(out, NUMBER_CAPACITY, "%.*g", digits, value);
}
