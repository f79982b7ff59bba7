/*
 * check.h - the test harness, one page
 *
 * A test is TEST(name) { ... }, whose name states a property.  CHECK(cond) counts
 * a failure and prints its place; REPORT(...) prints the input of a failure, in
 * the command's own input format where it has one.  main() below runs the tests
 * that its arguments name, or all, in their order, and prints
 * `N passed, N failed`, which tests/support/run.sh adds up.  A program with a
 * main() of its own defines CHECK_OWN_MAIN before it includes this, and calls
 * check_all().
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

struct check_test {
    void (*test)(void);
    const char *name;
    int line;
};

enum { CHECK_MOST = 40 };
static struct check_test check_tests[CHECK_MOST];
static int check_count;

/* Tests are added in any order, before main(). */
static inline void check_add(void (*test)(void), const char *name, int line)
{
    int i = check_count++;
    if (i == CHECK_MOST) {
        fputs("more tests than CHECK_MOST\n", stderr);
        exit(1);
    }
    for (; i > 0 && check_tests[i - 1].line > line; i--)
        check_tests[i] = check_tests[i - 1];
    check_tests[i] = (struct check_test){test, name, line};
}

#define TEST(name)                                                  \
    static void name(void);                                         \
    __attribute__((constructor)) static void check_add_##name(void) \
    {                                                               \
        check_add(name, #name, __LINE__);                           \
    }                                                               \
    static void name(void)

static inline void check_run(void (*test)(void), const char *name)
{
    check_bad = 0;
    test();
    if (check_bad) {
        check_failed++;
        fprintf(stderr, "FAILED %s (%d)\n", name, check_bad);
    } else {
        check_passed++;
    }
}

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

/* Runs the tests that have one of n names, or all if n is 0. */
static inline void check_named(int n, char **names)
{
    for (int i = 0; i < check_count; i++) {
        int is_named = n == 0;
        for (int k = 0; k < n; k++)
            is_named |= strcmp(names[k], check_tests[i].name) == 0;
        if (is_named)
            check_run(check_tests[i].test, check_tests[i].name);
    }
}

static inline void check_each(void)
{
    check_named(0, NULL);
}

static inline int check_all(void)
{
    check_each();
    return check_end();
}

#ifndef CHECK_OWN_MAIN
int main(int argc, char **argv)
{
    check_named(argc - 1, argv + 1);
    return check_end();
}
#endif

#endif
