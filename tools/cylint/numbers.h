/*
 * numbers.h - converts text to double and double to text
 *
 * The numbers are those of the C locale.  The command never calls setlocale(); the
 * Python module sets that locale for its thread.
 */
#ifndef CYLINT_NUMBERS_H
#define CYLINT_NUMBERS_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

enum {
    NUMBER_CAPACITY = 32, /* bytes that any written number fits into */
    NUMBER_SHORTEST = 0,  /* the shortest text that reads back the same */
    NUMBER_MAX_DIGITS = 17,
    NUMBER_HEX = -1 /* 0x1.8p+3, the leading digit 1 unless zero */
};

/*
 * Reads the number at the beginning of [text, end).  Returns the byte after it,
 * or NULL if there is none.  The value is correctly rounded: HUGE_VAL with the
 * number's sign on overflow, a subnormal or zero on underflow.
 *
 *   number = [+-] (digits [. [digits]] | . digits) [e [+-] digits]
 *          | [+-] 0x (hex [. [hex]] | . hex) [p [+-] digits]
 *
 * *end must be readable and must not be a character of a number.
 */
const char *cylint_read_number(const char *text, const char *end,
                               double *value);

/*
 * Writes value and returns the length.  digits: NUMBER_SHORTEST, NUMBER_HEX
 * or 1 to 17 significant digits as printf("%.*g") writes them.  The shortest
 * text is the shorter of fixed and scientific notation, fixed when equal.
 */
size_t cylint_write_number(char out[NUMBER_CAPACITY], double value, int digits);

/*
 * The conversions of numbers.c: by the C++17 library (numbers.cc), or slower by
 * the C library (numbers_c.c) where no compiler has it.  Both write the same
 * bytes. cylint_read_decimal() reads a decimal number that begins with a digit,
 * a point or a minus sign before them.  cylint_write_digits() writes a finite
 * value in decimal digits.
 */
const char *cylint_read_decimal(const char *text, const char *end,
                                double *value);
size_t cylint_write_digits(char *out, double value, int digits);

#ifdef __cplusplus
}
#endif

#endif
