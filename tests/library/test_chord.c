/*
 * test_chord.c - the chords of a line in one shape, against the oracle, and those
 * of chords.txt
 *
 * CYLINT_CASES: lines of each family.
 */
#include <float.h>
#include <math.h>

#include "check.h"
#include "cylint_pieces.h"
#include "environment.h"
#include "families.h"
#include "draw.h"
#include "records.h"
#include "shapes/shape_facts.h"
#include "ulps.h"
#ifdef HAVE_MPFR
#include "oracle.h"
#include "real.h"
#endif

static int same_chords(int n, const cylint_interval *x, int m,
                       const cylint_interval *y)
{
    int same = n == m;
    for (int i = 0; i < n && same; i++)
        same = x[i].t0 == y[i].t0 && x[i].t1 == y[i].t1;
    return same;
}

/* --------------------------------------------------------- the oracle -- */

#ifdef HAVE_MPFR

static long compared, with_chords;

/* The chords of the closed solid and the domain, from the oracle's hits of the
 * whole line: their sides and the relation say between which of them the line
 * is inside. */
static int expected_chords(const struct family_case *c, cylint_interval *chord)
{
    cylint_shape closed = c->shape;
    const cylint_line whole = whole_of(c->line);
    cylint_answer a;
    double end[4] = {-HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL};
    int kept = 0;
    if (closed.ends < CYLINT_ENDS_INFINITE)
        closed.ends = CYLINT_ENDS_CAPPED;
    oracle_intersect(&closed, &whole, CYLINT_WANT_T, &a);
    if (a.relation == CYLINT_RELATION_MISS ||
        a.relation == CYLINT_RELATION_TOUCH)
        return 0;
    int inside = a.n == 0 || a.hit[0].side != CYLINT_SIDE_ENTERING;
    for (int i = 0; i < a.n; i++)
        end[i + 1] = a.hit[i].t;
    for (int i = 0; i <= a.n; i++) {
        if (inside) {
            const double t0 = fmax(end[i], c->line.tmin);
            const double t1 = fmin(end[i + 1], c->line.tmax);
            if (t0 < t1 && kept > 0 && chord[kept - 1].t1 == t0)
                chord[kept - 1].t1 = t1; /* through the apex, or close to it */
            else if (t0 < t1)
                chord[kept++] = (cylint_interval){t0, t1};
        }
        if (i < a.n && a.hit[i].side != CYLINT_SIDE_BOTH)
            inside = a.hit[i].side == CYLINT_SIDE_ENTERING;
    }
    return kept;
}

/* Moves, in half of the cases, one end of the domain to a hit of the whole line, or
 * to a double beside it. */
static void limit(struct family_case *c)
{
    const cylint_line whole = whole_of(c->line);
    cylint_answer a;
    cylint_intersect(&c->shape, &whole, CYLINT_WANT_T, &a);
    if (a.n == 0 || one_of(2))
        return;
    const double t = a.hit[one_of(a.n)].t;
    double *end = one_of(2) ? &c->line.tmin : &c->line.tmax;
    if (fabs(t) < DBL_MAX)
        *end = stepped(t, one_of(3) - 1);
    if (!(c->line.tmin <= c->line.tmax))
        c->line.tmin = c->line.tmax;
}

/* The expected chords are those of the default environment. */
static void compare_chords(struct family_case *c, struct environment there)
{
    cylint_interval got[2], want[3];
    limit(c);
    const int m = expected_chords(c, want);
    environment_set(there);
    const int n = cylint_chord(&c->shape, &c->line, got);
    environment_reset();
    compared++;
    with_chords += m > 0;
    if (CHECK(same_chords(n, got, m, want)))
        return;
    REPORT_CASE(c);
    REPORT("domain %a %a", c->line.tmin, c->line.tmax);
    for (int i = 0; i < n; i++)
        REPORT("got [%a, %a]", got[i].t0, got[i].t1);
    for (int i = 0; i < m; i++)
        REPORT("not [%a, %a]", want[i].t0, want[i].t1);
}

static void compare_many(struct environment there, uint64_t cases)
{
    EACH_CASE(c, 6, cases)
        compare_chords(&c, there);
    const int plain = family_named("plain"),
              exact = family_named("constructed");
    for (uint64_t i = 0; i < 20 * cases; i++) {
        struct family_case c;
        family_case(6, i % 4 == 3 ? plain : exact, cases + i, &c);
        compare_chords(&c, there);
    }
}

/* In environments but the default one, fewer. */
TEST(chords_are_those_of_the_oracle_in_every_environment)
{
    const uint64_t cases = check_setting("CYLINT_CASES", 800);
    stream = 1;
    EACH_ENVIRONMENT(there)
        compare_many(there, there.number == 0 ? cases : cases / 50);
    CHECK(with_chords > compared / 20);
    printf("note: %ld lines, %ld with chords\n", compared, with_chords);
}

/* ------------------------------------------------------------ lengths -- */

static double any_double(int least, int most)
{
    const int e = whole_between(least, most);
    const double x = ldexp(random_mantissa(&stream), e);
    return one_of(8) == 0 ? 0 : one_of(2) ? x : -x;
}

/* |d| minus the length that the library returns, in its units in the last
 * place; 0 if both are beyond the largest double. */
static double error_of_length(const cylint_line *line)
{
    const double got = cylint_line_length(line);
    const double above = nextafter(got, HUGE_VAL);
    vector d;
    real_fixed(4400);
    if (line->segment)
        set_difference(d, line->end, line->o);
    else
        set(d, line->d);
    const real length = norm(d), unit = minus(real_of(above), real_of(got));
    if (!(got <= DBL_MAX))
        return mpfr_get_d(length->x, RND) > DBL_MAX ? 0 : HUGE_VAL;
    real error = minus(length, real_of(got));
    if (above <= DBL_MAX)
        error = over(error, unit);
    return mpfr_get_d(error->x, MPFR_RNDA);
}

/* Of exponents that are near each other, of all, about the least normal one, or at
 * the end, where some lengths are infinite. */
TEST(a_length_is_within_0501_units)
{
    const long cases = 60 * (long)check_setting("CYLINT_CASES", 800);
    double worst = 0;
    long infinite = 0;
    stream = 5;
    for (long i = 0; i < cases; i++) {
        const int family = one_of(4);
        const int e = family == 0   ? one_of(2047) - 1074
                      : family == 3 ? 1020
                                    : -1074;
        const int top = family == 0 && e < 1023 - 60 ? e + 60
                        : family == 1                ? -1021
                                                     : 1023;
        double o[3], d[3];
        cylint_line line;
        for (int j = 0; j < 3; j++) {
            o[j] = any_double(e, top);
            d[j] = i % 7 == 0 ? one_of(9) - 4 : any_double(e, top);
        }
        if ((i % 2 ? cylint_segment(&line, o, d)
                   : cylint_whole_line(&line, o, d)) != CYLINT_OK)
            continue;
        const double error = fabs(error_of_length(&line));
        worst = error > worst ? error : worst;
        infinite += cylint_line_length(&line) > DBL_MAX;
        if (!CHECK(error <= 0.501))
            REPORT("%s %a %a %a, %a %a %a: %a, %g units",
                   i % 2 ? "segment" : "line", o[0], o[1], o[2], d[0], d[1],
                   d[2], cylint_line_length(&line), error);
    }
    CHECK(infinite > cases / 100);
    printf("note: %ld lengths, %ld infinite, at most %.6f units\n", cases,
           infinite, worst);
}

#endif

/* ------------------------------------------------ the header's table -- */

/* Made and answered in each environment; the closed solid is the same whatever ends
 * are present. */
static const char *check_record(const char *text, const char *known)
{
    struct family_case c;
    double n, x[4] = {0};
    if (!family_parse(text, &c) || !(known = family_numbers(known, 1, &n)) ||
        !(n >= 0 && n <= 2) || !(known = family_numbers(known, 2 * (int)n, x)))
        return NULL;
    const cylint_interval want[2] = {{x[0], x[1]}, {x[2], x[3]}};
    const int every =
        cylint_ends_are_planes((int)c.ends) && c.shape_word != FAMILY_SPHERE;
    EACH_ENVIRONMENT(there)
        for (int ends = 0; ends < (every ? 4 : 1); ends++) {
            cylint_interval got[2];
            c.ends = every ? (cylint_ends)ends : c.ends;
            environment_set(there);
            CHECK(family_make(&c));
            const int m = cylint_chord(&c.shape, &c.line, got);
            environment_reset();
            if (!CHECK(same_chords(m, got, (int)n, want)))
                REPORT_CASE(&c);
        }
    return known;
}

TEST(known_chords_are_found_in_every_environment)
{
    each_record("tests/library/chords.txt", 36, check_record);
}

/* A processor that reads subnormal numbers as 0 has no order of these ends. */
TEST(a_solid_has_the_pieces_of_a_subnormal_domain)
{
    const cylint_shape ball[2] = {shape_of("sphere 0 0 0 1"),
                                  shape_of("sphere 0.5 0 0 1")};
    const int clause[2] = {1, 2};
    const double origin[3] = {0, 0, 0}, ex[3] = {1, 0, 0};
    EACH_ENVIRONMENT(there) {
        cylint_line line;
        cylint_interval piece[2] = {{0, 0}, {0, 0}};
        CHECK(cylint_span(&line, origin, ex, -0x1p-1074, 0x1p-1073) ==
              CYLINT_OK);
        environment_set(there);
        const int n = cylint_solid_pieces(ball, clause, 2, &line, piece, 2);
        environment_reset();
        CHECK(n == 1 && piece[0].t0 == line.tmin && piece[0].t1 == line.tmax);
    }
}
