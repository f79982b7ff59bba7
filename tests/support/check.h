/*
 * check.h - the test harness, one page
 *
 * A test is a function whose name states a property.  CHECK(cond) counts a
 * failure and prints its place; REPORT(...) prints the input of a failure, in
 * the command's own input format where it has one.  A program ends with
 *
 *     int main(void) { RUN(name); RUN(other_name); return check_end(); }
 *
 * and prints `N passed, N failed`, which tests/support/run.sh adds up.
 */
#ifndef CYLINT_CHECK_H
#define CYLINT_CHECK_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "program.h"

static int check_passed, check_failed, check_bad;

#define CHECK_SHOWN 10 /* failures printed in full per test */

#ifdef CHECK_STOPS /* by mutants.py: the first failure ends the run */
#define CHECK(cond) ((cond) ? 1 : (exit(1), 0))
#else
#define CHECK(cond)                                                      \
    ((cond) ? 1                                                          \
            : (check_bad++ < CHECK_SHOWN                                 \
                   ? (fprintf(stderr, "%s:%d: not true: %s\n", __FILE__, \
                              __LINE__, #cond),                          \
                      0)                                                 \
                   : 0))
#endif

#define REPORT(...)                                                         \
    (check_bad <= CHECK_SHOWN                                               \
         ? (void)(fprintf(stderr, "    " __VA_ARGS__), fputc('\n', stderr)) \
         : (void)0)

#define RUN(test)                                                  \
    do {                                                           \
        check_bad = 0;                                             \
        test();                                                    \
        if (check_bad) {                                           \
            check_failed++;                                        \
            fprintf(stderr, "FAILED %s (%d)\n", #test, check_bad); \
        } else {                                                   \
            check_passed++;                                        \
        }                                                          \
    } while (0)

/* The texts of the statuses 0 to n - 1 are these, all others are unknown. */
static inline void check_texts(const char *(*text_of)(int status),
                               const char *const *texts, int n)
{
    for (int status = -2; status < n + 2; status++) {
        const char *text =
            status < 0 || status >= n ? "unknown status" : texts[status];
        if (!CHECK(strcmp(text_of(status), text) == 0))
            REPORT("status %d: %s", status, text_of(status));
    }
}

static inline int check_end(void)
{
    printf("%d passed, %d failed\n", check_passed, check_failed);
    return check_failed != 0;
}

#endif
