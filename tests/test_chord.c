/*
 * test_chord.c - the chords of a line in one shape, against the oracle
 *
 * The oracle gives the roots of the whole line.  Between two roots the line is inside if
 * one point of it is: this point is exact, and the oracle decides it.  So the sides of
 * hits and the relation, which the library uses, are not used here.
 *
 * CYLINT_CASES: lines in each test.
 */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "cylint_pieces.h"
#include "environment.h"
#include "random.h"
#ifdef HAVE_MPFR
#include "oracle.h"
#endif

static uint64_t rng;

static int choice(int n)
{
    return random_int(&rng, n);
}

/* ------------------------------------------------ shapes of integers -- */

enum { CYLINDER, CONE, TANGENT, ELLIPTIC, BALL, ROUND, HALFSPACE, FAMILIES };

/* Numbers that a constructor takes, before they are multiplied by a power of two. */
typedef struct {
    int family;
    cylint_ends ends;
    double p[3], q[3], a[3], b[3], r, s;
} recipe;

static void draw_vector(double v[3], int most)
{
    for (int i = 0; i < 3; i++)
        v[i] = choice(2 * most + 1) - most;
}

static recipe draw_shape(int most)
{
    recipe x = {.family = choice(FAMILIES), .ends = (cylint_ends)choice(6)};
    draw_vector(x.p, most);
    draw_vector(x.q, most);
    draw_vector(x.a, most);
    draw_vector(x.b, most);
    x.r = choice(most + 1);
    x.s = choice(most + 1);
    return x;
}

static void scale(double to[3], const double from[3], int e)
{
    for (int i = 0; i < 3; i++)
        to[i] = ldexp(from[i], e);
}

/* The shape times 2^e. */
static cylint_status make_shape(cylint_shape *shape, const recipe *x, int e)
{
    const double r = ldexp(x->r, e), s = ldexp(x->s, e);
    const cylint_ends ends = x->ends;
    double p[3], q[3], a[3], b[3];
    scale(p, x->p, e);
    scale(q, x->q, e);
    scale(a, x->a, e);
    scale(b, x->b, e);
    switch (x->family) {
    case CYLINDER:
        return cylint_cylinder(shape, p, q, r, ends);
    case CONE:
        return cylint_cone(shape, p, r, q, s, ends);
    case TANGENT:
        return cylint_tangent_cone(shape, p, a, x->r / 2, ends);
    case ELLIPTIC:
        return cylint_elliptic_cone(shape, p, a, b, q, x->r / 2, ends);
    case BALL:
        return cylint_sphere(shape, p, r, CYLINT_ENDS_CAPPED);
    case ROUND:
        return cylint_round_cone(shape, p, r, q, s, ends);
    default:
        return cylint_halfspace(shape, p, a);
    }
}

/* A line, a ray, a span or a segment; the domain's ends have few bits. */
typedef struct {
    int constructor;
    double o[3], d[3], tmin, tmax;
} line_recipe;

static line_recipe draw_line(int most)
{
    line_recipe x = {.constructor = choice(4)};
    draw_vector(x.o, most);
    draw_vector(x.d, choice(2) ? 2 : most);
    x.tmin = choice(17) / 4.0 - 2;
    x.tmax = x.tmin + choice(17) / 4.0;
    if (choice(4) == 0)
        x.tmin = -HUGE_VAL;
    if (choice(4) == 0)
        x.tmax = HUGE_VAL;
    return x;
}

/* o times 2^e, d times 2^f. */
static cylint_status make_line(cylint_line *line, const line_recipe *x, int e,
                               int f)
{
    double o[3], d[3];
    scale(o, x->o, e);
    scale(d, x->d, f);
    switch (x->constructor) {
    case 0:
        return cylint_whole_line(line, o, d);
    case 1:
        return cylint_ray(line, o, d);
    case 2:
        return cylint_span(line, o, d, ldexp(x->tmin, e - f),
                           ldexp(x->tmax, e - f));
    default:
        scale(d, x->d, e);
        return cylint_segment(line, o, d);
    }
}

static int same_double(double x, double y)
{
    return memcmp(&x, &y, sizeof x) == 0;
}

static int same_chords(int n, const cylint_interval *x, int m,
                       const cylint_interval *y)
{
    for (int i = 0; i < n && n == m; i++)
        if (!same_double(x[i].t0, y[i].t0) || !same_double(x[i].t1, y[i].t1))
            return 0;
    return n == m;
}

static void report(const recipe *x, const line_recipe *l, int n,
                   const cylint_interval *c, int m, const cylint_interval *e)
{
    REPORT("family %d ends %d p %g %g %g q %g %g %g a %g %g %g b %g %g %g "
           "r %g %g, line %d: %g %g %g, %g %g %g in %g %g",
           x->family, (int)x->ends, x->p[0], x->p[1], x->p[2], x->q[0], x->q[1],
           x->q[2], x->a[0], x->a[1], x->a[2], x->b[0], x->b[1], x->b[2], x->r,
           x->s, l->constructor, l->o[0], l->o[1], l->o[2], l->d[0], l->d[1],
           l->d[2], l->tmin, l->tmax);
    for (int i = 0; i < n; i++)
        REPORT("got [%a, %a]", c[i].t0, c[i].t1);
    for (int i = 0; i < m; i++)
        REPORT("not [%a, %a]", e[i].t0, e[i].t1);
}

/* --------------------------------------------------------- the oracle -- */

#ifdef HAVE_MPFR

/* The lines that the tests compared and those with chords. */
static long compared, with_chords, skipped;

static cylint_ends closed_ends(const cylint_shape *shape)
{
    const int is_unbounded =
        shape->ends == CYLINT_ENDS_INFINITE || shape->ends == CYLINT_ENDS_NAPPE;
    return is_unbounded ? (cylint_ends)shape->ends : CYLINT_ENDS_CAPPED;
}

static double dot(const double x[3], const double y[3])
{
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/* The roots of the whole line as nearest doubles, ascending. */
static int roots_of(const recipe *x, const cylint_shape *shape,
                    const cylint_line *line, double root[2])
{
    cylint_answer answer;
    cylint_shape closed = *shape;
    cylint_line whole = *line;
    if (x->family == HALFSPACE) {
        const double slope = dot(line->d, x->a);
        root[0] = (dot(x->p, x->a) - dot(line->o, x->a)) / slope + 0.0;
        return slope != 0;
    }
    closed.ends = closed_ends(shape);
    whole.tmin = -HUGE_VAL;
    whole.tmax = HUGE_VAL;
    oracle_intersect(&closed, &whole, CYLINT_WANT_T, &answer);
    for (int i = 0; i < answer.n; i++)
        root[i] = answer.hit[i].t;
    return answer.n;
}

/* A t between two doubles with few bits; or NAN. */
static double between(double t0, double t1)
{
    if (t0 < -DBL_MAX)
        return t1 > DBL_MAX ? 0 : floor(t1) - 1;
    if (t1 > DBL_MAX)
        return ceil(t0) + 1;
    for (int bits = 0; bits < 36; bits++) {
        const double t = ldexp(floor(ldexp(t0, bits)) + 1, -bits);
        if (t < t1)
            return t;
    }
    return (double)NAN;
}

static int is_inside(const recipe *x, const cylint_shape *shape,
                     const cylint_line *line, double t)
{
    double point[3];
    for (int i = 0; i < 3; i++)
        point[i] = line->o[i] + t * line->d[i];
    if (x->family == HALFSPACE)
        return dot(point, x->a) <= dot(x->p, x->a);
    return oracle_contains(shape, point) >= 0;
}

/* Writes the chords of integers; -1: two roots are too near each other. */
static int expected_chords(const recipe *x, const cylint_shape *shape,
                           const cylint_line *line, cylint_interval chord[2])
{
    double end[4] = {-HUGE_VAL}, before = 0;
    int n = 0, kept = 0, was_inside = 0;
    const int roots = roots_of(x, shape, line, end + 1);
    end[roots + 1] = HUGE_VAL;
    for (int i = 0; i <= roots; i++) {
        const double t = between(end[i], end[i + 1]);
        if (t != t && end[i] < end[i + 1])
            return -1;
        const int inside = t == t && is_inside(x, shape, line, t);
        if (inside && was_inside)
            chord[n - 1].t1 = end[i + 1];
        else if (inside)
            chord[n++] = (cylint_interval){end[i], end[i + 1]};
        was_inside = t == t ? inside : was_inside;
    }
    for (int i = 0; i < n; i++, before = 0) {
        chord[kept].t0 = fmax(chord[i].t0, line->tmin) + before;
        chord[kept].t1 = fmin(chord[i].t1, line->tmax) + before;
        kept += chord[kept].t0 < chord[kept].t1;
    }
    return kept;
}

static void compare_with_oracle(int most)
{
    const recipe x = draw_shape(most);
    const line_recipe l = draw_line(most);
    cylint_shape shape;
    cylint_line line;
    cylint_interval got[2], expected[3];
    if (make_shape(&shape, &x, 0) != CYLINT_OK ||
        make_line(&line, &l, 0, 0) != CYLINT_OK)
        return;
    const int m = expected_chords(&x, &shape, &line, expected);
    const int n = cylint_chord(&shape, &line, got);
    skipped += m < 0;
    compared += m >= 0;
    with_chords += m > 0;
    if (m >= 0 && !CHECK(same_chords(n, got, m, expected)))
        report(&x, &l, n, got, m, expected);
}

static void chords_of_integers_are_those_of_the_oracle(void)
{
    const long cases = (long)check_setting("CYLINT_CASES", 24000);
    rng = 1;
    compared = with_chords = skipped = 0;
    for (long i = 0; i < cases; i++)
        compare_with_oracle(i % 4 == 0 ? 2 : i % 4 == 1 ? 9 : 4);
    CHECK(compared > cases / 2 && with_chords > cases / 20);
    CHECK(skipped < cases / 100);
    fprintf(stderr, "%ld lines, %ld with chords, %ld left out\n", compared,
            with_chords, skipped);
}

#endif

int main(void)
{
#ifdef HAVE_MPFR
    RUN(chords_of_integers_are_those_of_the_oracle);
#endif
    return check_end();
}
