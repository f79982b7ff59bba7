/*
 * search.c - searches the largest errors and the slowest query (make search)
 *
 * Hill climbing for every kind of shape and every family: it starts with the
 * worst of some random cases, changes one number at a time, and keeps the
 * change if the result is not better for the library.  Goals are the errors of
 * point, normal, z and phi in ulp (ulps.h), and the time of a
 * query.  The worst cases are printed in the format of hard.txt with the
 * oracle's answer.  Exponents stay near those of the first case.
 *
 *   CYLINT_SECONDS  in all, default 120     CYLINT_SEED  default 1
 */
#ifdef HAVE_MPFR

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "constructed.h"
#include "oracle.h"
#include "program.h"
#include "random.h"
#include "ulps.h"

enum { BEGINNINGS = 60, KINDS = 8, REPEATS = 7, QUERIES = 20 };
enum goal { POINT, NORMAL, Z, PHI, TIME, GOALS };

static const char *const goal_names[GOALS] = {"point", "normal", "z", "phi",
                                              "time"};
static const char *const kind_names[KINDS] = {"cylinder",  "cone",  "acone",
                                              "ecylinder", "econe", "sphere",
                                              "capsule",   "rcone"};

struct found {
    struct family_case at;
    double score;
    int family;
};

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static uint64_t stream;

static int one_of(int n)
{
    return random_int(&stream, n);
}

/* -------------------------------------------------------------- scores -- */

/* Nanoseconds for both roots, the least of several runs. */
static double time_of(const struct family_case *c)
{
    cylint_answer answer;
    double least = HUGE_VAL;
    for (int i = 0; i < REPEATS; i++) {
        const double began = now();
        for (int k = 0; k < QUERIES; k++)
            cylint_intersect(&c->shape, &c->line,
                             CYLINT_WANT_T | CYLINT_WANT_PART, &answer);
        least = fmin(least, (now() - began) / QUERIES * 1e9);
    }
    return least;
}

static double error_of(const struct family_case *c, enum goal goal)
{
    cylint_answer got, want;
    double worst = 0;
    memset(&got, 0, sizeof got);
    cylint_intersect(&c->shape, &c->line, CYLINT_WANT_ALL, &got);
    oracle_intersect(&c->shape, &c->line, CYLINT_WANT_ALL, &want);
    if (got.n != want.n || got.relation != want.relation)
        return HUGE_VAL;
    for (int i = 0; i < want.n; i++) {
        static const enum measure measure[] = {ULPS_POINT, ULPS_NORMAL, ULPS_Z,
                                               ULPS_PHI};
        double off[MEASURES];
        if (isinf(want.hit[i].t))
            continue;
        ulps_of_hit(&got.hit[i], &want.hit[i], oracle_other(i), off);
        worst = fmax(worst, off[measure[goal]]);
    }
    return worst;
}

static double score(const struct family_case *c, enum goal goal)
{
    return goal == TIME ? time_of(c) : error_of(c, goal);
}

/* ------------------------------------------------------------ climbing -- */

enum { EXPONENTS_AROUND = 8 };

static double changed(double x, double was)
{
    int e, e_was;
    if (x == 0)
        return x;
    switch (one_of(4)) {
    case 0:
        x = constructed_stepped(x, one_of(17) - 8);
        break;
    case 1:
        x += ldexp(ulp(x), one_of(50)) * (one_of(2) ? 1 : -1);
        break;
    case 2:
        x = ldexp(x, one_of(3) - 1);
        break;
    default:
        x = copysign(ldexp(random_mantissa(&stream), ilogb(x)), x);
    }
    frexp(x, &e);
    frexp(was, &e_was);
    return x == 0 || abs(e - e_was) > EXPONENTS_AROUND ? was : x;
}

static int change(const struct family_case *from,
                  const struct family_case *begun, struct family_case *to)
{
    const int of_line = family_line_size(from->line_word);
    const int n = one_of(of_line + family_shape_size(from->shape_word));
    *to = *from;
    if (n < of_line)
        to->line_data[n] = changed(from->line_data[n], begun->line_data[n]);
    else
        to->shape_data[n - of_line] = changed(from->shape_data[n - of_line],
                                              begun->shape_data[n - of_line]);
    return family_make(to);
}

/* The worst of some random cases of the kind; returns 0 if there are none. */
static int begin(uint64_t seed, int family, int kind, enum goal goal,
                 struct found *best)
{
    int seen = 0;
    best->score = -1;
    best->family = family;
    for (uint64_t i = 0; i < 20 * BEGINNINGS && seen < BEGINNINGS; i++) {
        struct family_case c;
        family_case(seed, family, i, &c);
        if ((int)c.shape_word != kind)
            continue;
        seen++;
        const double s = score(&c, goal);
        if (s > best->score) {
            best->score = s;
            best->at = c;
        }
    }
    return seen;
}

static void climb(enum goal goal, double until, struct found *best)
{
    const struct family_case begun = best->at;
    struct family_case c;
    while (now() < until) {
        if (!change(&best->at, &begun, &c))
            continue;
        const double s = score(&c, goal);
        if (s >= best->score) {
            best->score = s;
            best->at = c;
        }
    }
}

/* ----------------------------------------------------------- reporting -- */

static void print_number(double x)
{
    if (isnan(x))
        printf(" nan");
    else
        printf(" %.17g", x);
}

static void print_found(const struct found *f, int kind, enum goal goal)
{
    static const char *const relations[] = {"miss", "touch", "along", "cross"};
    cylint_answer want;
    oracle_intersect(&f->at.shape, &f->at.line, CYLINT_WANT_T, &want);
    printf("# worst %s of %s: %.4g %s (%s)\n", goal_names[goal],
           goal == TIME ? "ordinary exponents" : kind_names[kind], f->score,
           goal == TIME ? "ns" : "ulp", family_name(f->family));
    family_print(stdout, &f->at);
    printf(" => %s %d", relations[want.relation], want.n);
    for (int i = 0; i < 2; i++)
        print_number(i < want.n ? want.hit[i].t : NAN);
    putchar('\n');
    fflush(stdout);
}

int main(void)
{
    const double seconds = check_number("CYLINT_SECONDS", 120);
    const uint64_t seed = (uint64_t)check_number("CYLINT_SEED", 1);
    double until = now();
    stream = seed;
    printf("# seed %llu, %g s\n", (unsigned long long)seed, seconds);
    for (int goal = 0; goal < GOALS; goal++)
        for (int kind = 0; kind < KINDS; kind++) {
            struct found worst = {.score = -1}, f;
            const double share = seconds / GOALS / KINDS / family_count();
            for (int family = 0; family < family_count(); family++) {
                until += share;
                if (family_is_wild(family) ||
                    !begin(seed, family, kind, (enum goal)goal, &f))
                    continue;
                climb((enum goal)goal, until, &f);
                if (f.score > worst.score)
                    worst = f;
            }
            print_found(&worst, kind, (enum goal)goal);
        }
    return 0;
}

#else

#include "program.h"

int main(void)
{
    return check_skip("no MPFR: no oracle to compare with (make deps)");
}

#endif
