/*
 * numbers_agree.c - compares the two back-ends for numbers of the command
 *
 * test_numbers.sh links numbers.c with numbers.cc, and with numbers_c.c under
 * other names, to this file.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "numbers.h"
#include "random.h"

const char *plain_read_number(const char *text, const char *end, double *value);
size_t plain_write_number(char out[NUMBER_CAPACITY], double value, int digits);

static uint64_t next_random(void)
{
    static uint64_t stream = 20240601;
    return random_bits(&stream);
}

/* A whole number of any number of bits. */
static uint64_t next_whole(void)
{
    const uint64_t bits = next_random();
    return bits >> next_random() % 64;
}

static double from_bits(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static int same(double x, double y)
{
    return memcmp(&x, &y, sizeof x) == 0;
}

/* Both back-ends write the same text, and it reads back as the value. */
static void check_written(double value)
{
    static const int forms[] = {NUMBER_SHORTEST, NUMBER_HEX, 17, 6, 1};
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        char one[NUMBER_CAPACITY + 1], two[NUMBER_CAPACITY + 1];
        size_t m = cylint_write_number(one, value, forms[i]);
        size_t n = plain_write_number(two, value, forms[i]);
        one[m] = two[n] = '\0';
        if (!CHECK(m == n && memcmp(one, two, n) == 0))
            REPORT("%a, form %d: '%s' and '%s'", value, forms[i], one, two);
        double back = 0;
        if (i < 3 && isfinite(value) &&
            !(CHECK(cylint_read_number(one, one + m, &back) == one + m) &&
              CHECK(same(back, value))))
            REPORT("'%s' is not read back as %a", one, value);
    }
}

/* Both back-ends read the text alike: they return the same end and the same
 * bits, and these are strtod()'s. */
static void check_read(const char *text)
{
    const char *end = text + strlen(text);
    double x = 0, y = 0;
    const char *one = cylint_read_number(text, end, &x);
    const char *two = plain_read_number(text, end, &y);
    if (!(CHECK(one == two) && CHECK(same(x, y)) &&
          CHECK(!one || same(x, strtod(text, NULL))))) {
        REPORT("'%s': %d bytes, %a and %d bytes, %a", text,
               one ? (int)(one - text) : -1, x, two ? (int)(two - text) : -1,
               y);
    }
}

TEST(numbers_are_written_alike)
{
    for (int e = -1074; e < 1024; e++) {
        const double x = ldexp(1.0, e);
        check_written(x);
        check_written(-nextafter(x, 0));
        check_written(nextafter(x, INFINITY));
    }
    for (int i = 0; i < 30000; i++) {
        const double whole = (double)next_whole();
        const int places = (int)(next_random() % 40);
        check_written(from_bits(next_random()));
        check_written(whole);
        check_written(whole * pow(10, -places));
        check_written(-floor(ldexp(whole, -40)) / 1024);
        /* halfway between two shortest: to even */
        check_written(ldexp((double)(next_random() >> 11 | 1), -places));
    }
}

/* The spellings are separated by |; one of them is empty.  strtod() reads the value
 * to write, so also inf and nan. */
TEST(every_spelling_is_read_and_written_alike)
{
    char spellings[] =
        "1|+1|-1|1.|.5|-.5|+.5|1.5e3|1E+3|1e-3|0x1.8p+3|-0X1.8P-3|+0x.8|"
        "0x1p|0x1p+|0x|0xg|0x.|0x1.|0x1.fffffffffffff8p0|"
        "0x1.fffffffffffff7p0|0x-1||+|-|.|e5|+-1|-+1|--1|++1| 1|1e|1e+|"
        "1ex|1..2|1,5|1 2|inf|nan|-inf|+nan|infinity|1e999|-1e999|1e-999|"
        "-1e-999|1e-320|2.4e-324|2.5e-324|0x1p-1075|0x1.8p-1075|"
        "0x1p99999|0x1p-99999|0e999999999999999999|1e999999999999999999|"
        "1e-999999999999999999|1.7976931348623158e308|"
        "1.7976931348623159e308|9007199254740993|"
        "9007199254740993.00000000000000000000000000000001|"
        "00000000000000000000000000000000000000000000000000000000001.5|"
        "1d5|1f|0b1|1_000|1'000|\357\273\2771|abc|0|-0|1e5|100001|1e22|1e23|"
        "0.001|0.0001|1e-5|123456|1234567|0.30000000000000004|5e-324|"
        "2.2250738585072014e-308";
    for (char *text = spellings, *bar; text; text = bar ? bar + 1 : NULL) {
        bar = strchr(text, '|');
        if (bar)
            *bar = '\0';
        check_read(text);
        check_written(strtod(text, NULL));
    }
}

TEST(random_text_is_read_alike)
{
    static const char letters[] = "00123456789..+-eEpPxX ,af";
    for (int i = 0; i < 75000; i++) {
        char text[24];
        const size_t n = (size_t)(next_random() % (sizeof text - 1));
        for (size_t j = 0; j < n; j++)
            text[j] = letters[next_random() % (sizeof letters - 1)];
        text[n] = '\0';
        check_read(text);
    }
}

TEST(decimals_are_read_alike)
{
    static const char *const behind[] = {"", " ", ",", "\t7", "e1", "E", "x"};
    char text[900];
    for (int i = 0; i < 250000; i++) { /* of up to 20 digits */
        const uint64_t digits = next_whole();
        const int n =
            snprintf(text, 30, "%s%0*llu", i % 3 ? "-" : "",
                     (int)(next_random() % 21), (unsigned long long)digits);
        const int point = (int)(next_random() % (uint64_t)n) + 1;
        memmove(text + point + 1, text + point, (size_t)(n - point));
        text[point] = '.';
        strcpy(text + n + 1, behind[next_random() % 7]);
        check_read(text);
    }
    for (int i = -2000; i < 2000; i++)
        for (int places = 0; places < 24; places++) {
            snprintf(text, sizeof text, "%lld%.*s", (1LL << 53) + i, places,
                     ".00000000000000000000000");
            check_read(text);
            snprintf(text, sizeof text, ".%0*lld", places, (1LL << 53) + i);
            check_read(text);
        }
    for (int i = 0; i < 5000; i++) { /* long ones near midpoints */
        const double x = from_bits(next_random() & 0x7fefffffffffffffU);
        snprintf(text, sizeof text, "%.*e", (int)(15 + next_random() % 800), x);
        check_read(text);
    }
}
