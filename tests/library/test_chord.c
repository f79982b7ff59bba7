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
#include <mpfr.h>

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

static int same_chords(int n, const cylint_interval *x, int m,
                       const cylint_interval *y)
{
    for (int i = 0; i < n && n == m; i++)
        if (!(x[i].t0 == y[i].t0) || !(x[i].t1 == y[i].t1))
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

/* The pairs of ends of the overlap of the whole line and the closed solid, as indices
 * of roots: 0 stands for -infinity, roots + 1 for infinity.  -1: two roots are too near
 * each other. */
static int overlaps_of(const recipe *x, const cylint_shape *shape,
                       const cylint_line *line, int pair[3][2])
{
    double end[4] = {-HUGE_VAL};
    int n = 0, was_inside = 0;
    const int roots = roots_of(x, shape, line, end + 1);
    end[roots + 1] = HUGE_VAL;
    for (int i = 0; i <= roots; i++) {
        const double t = between(end[i], end[i + 1]);
        if (t != t)
            return -1;
        const int inside = is_inside(x, shape, line, t);
        if (inside && was_inside)
            pair[n - 1][1] = i + 1;
        if (inside && !was_inside) {
            pair[n][0] = i;
            pair[n++][1] = i + 1;
        }
        was_inside = inside;
    }
    return n;
}

/* The chords of these overlaps with the ends `end`. */
static int chords_of(int n, int (*pair)[2], const double *end,
                     const cylint_line *line, cylint_interval *chord)
{
    int kept = 0;
    for (int i = 0; i < n; i++) {
        chord[kept].t0 = fmax(end[pair[i][0]], line->tmin);
        chord[kept].t1 = fmin(end[pair[i][1]], line->tmax);
        kept += chord[kept].t0 < chord[kept].t1;
    }
    return n < 0 ? n : kept;
}

/* A shape and a line times 2^e, its direction times 2^f, and the chords. */
typedef struct {
    recipe shape_of;
    line_recipe line_of;
    cylint_shape shape;
    cylint_line line;
    int n; /* -1: not known */
    cylint_interval chord[3];
} chord_case;

/* Whether the ends of halfspaces are known: roots times a power of two that are not
 * subnormal. */
static int scale_root_of_plane(double *root, int by)
{
    const double scaled = ldexp(*root, by);
    const int is_exact = *root == 0 || fabs(scaled) >= DBL_MIN;
    *root = scaled;
    return is_exact;
}

static int make_case(chord_case *c, int most, int e, int f)
{
    cylint_shape shape;
    cylint_line line;
    double end[4] = {-HUGE_VAL};
    int pair[3][2], roots;
    c->shape_of = draw_shape(most);
    c->line_of = draw_line(most);
    if (make_shape(&shape, &c->shape_of, 0) != CYLINT_OK ||
        make_line(&line, &c->line_of, 0, 0) != CYLINT_OK)
        return 0;
    if (!CHECK(make_shape(&c->shape, &c->shape_of, e) == CYLINT_OK) ||
        !CHECK(make_line(&c->line, &c->line_of, e, f) == CYLINT_OK))
        return 0;
    const int n = overlaps_of(&c->shape_of, &shape, &line, pair);
    int is_known = n >= 0;
    if (c->shape_of.family == HALFSPACE) {
        const int by = c->line_of.constructor == 3 ? 0 : e - f;
        roots = roots_of(&c->shape_of, &shape, &line, end + 1);
        is_known = is_known && (roots == 0 || scale_root_of_plane(end + 1, by));
    } else {
        roots = roots_of(&c->shape_of, &c->shape, &c->line, end + 1);
    }
    end[roots + 1] = HUGE_VAL;
    c->n = is_known ? chords_of(n, pair, end, &c->line, c->chord) : -1;
    skipped += c->n < 0;
    compared += c->n >= 0;
    with_chords += c->n > 0;
    return c->n >= 0;
}

static void compare_chords(const chord_case *c)
{
    cylint_interval got[2];
    const int n = cylint_chord(&c->shape, &c->line, got);
    if (!CHECK(same_chords(n, got, c->n, c->chord)))
        report(&c->shape_of, &c->line_of, n, got, c->n, c->chord);
}

/* An unsuitable draw counts as no case. */
static void compare_many(long cases, int is_scaled)
{
    compared = with_chords = skipped = 0;
    for (long i = 0; i < cases; i++) {
        const int most = i % 4 == 0 ? 2 : i % 4 == 1 ? 9 : 4;
        const int e = is_scaled ? choice(2094) - 1074 : 0;
        const int f = is_scaled == 1 ? choice(2094) - 1074
                      : is_scaled    ? e + choice(61) - 30
                                     : 0;
        chord_case c;
        if (make_case(&c, most, e, f < -1074 ? -1074 : f > 1019 ? 1019 : f))
            compare_chords(&c);
    }
    CHECK(compared > cases / 2 && with_chords > cases / 20);
    CHECK(skipped < cases / 10);
    fprintf(stderr, "%ld lines, %ld with chords, %ld left out\n", compared,
            with_chords, skipped);
}

static void chords_of_integers_are_those_of_the_oracle(void)
{
    rng = 1;
    compare_many((long)check_setting("CYLINT_CASES", 24000), 0);
}

/* Of the shape and the direction, independently: many roots over- or underflow. */
static void chords_scale_by_all_powers_of_two(void)
{
    rng = 2;
    compare_many((long)check_setting("CYLINT_CASES", 12000), 1);
}

/* By nearly the same power, so that roots are not. */
static void chords_at_all_exponents_are_those_of_the_oracle(void)
{
    rng = 3;
    compare_many((long)check_setting("CYLINT_CASES", 12000), 2);
}

/* The expected chords are made with the default settings. */
static void compare_there(struct environment there)
{
    const long cases = (long)check_setting("CYLINT_CASES", 16000) / 16;
    rng = 4;
    for (long i = 0; i < cases; i++) {
        const int e = i % 2 ? choice(2094) - 1074 : 0;
        const int f = i % 4 == 1 ? choice(2094) - 1074 : e;
        cylint_interval got[2];
        chord_case c;
        if (!make_case(&c, 4, e, f))
            continue;
        environment_set(there);
        const int n = cylint_chord(&c.shape, &c.line, got);
        environment_reset();
        if (!CHECK(same_chords(n, got, c.n, c.chord)))
            report(&c.shape_of, &c.line_of, n, got, c.n, c.chord);
    }
}

static void chords_are_the_same_in_every_environment(void)
{
    everywhere(compare_there);
}

/* ------------------------------------------------------------ lengths -- */

static double any_double(int least, int most)
{
    const double x =
        ldexp(random_mantissa(&rng), least + choice(most - least + 1));
    return choice(8) == 0 ? 0 : choice(2) ? x : -x;
}

/* |d| minus the length that the library returns, in its units in the last place; 0 if
 * both are beyond the largest double. */
static double error_of_length(const cylint_line *line)
{
    const double got = cylint_line_length(line);
    const double above = nextafter(got, HUGE_VAL);
    mpfr_t x, sum;
    mpfr_inits2(4400, x, sum, (mpfr_ptr)0);
    mpfr_set_zero(sum, 1);
    for (int i = 0; i < 3; i++) {
        mpfr_set_d(x, line->segment ? line->end[i] : line->d[i], MPFR_RNDN);
        if (line->segment)
            mpfr_sub_d(x, x, line->o[i], MPFR_RNDN);
        mpfr_sqr(x, x, MPFR_RNDN);
        mpfr_add(sum, sum, x, MPFR_RNDN);
    }
    mpfr_sqrt(sum, sum, MPFR_RNDN);
    double error = mpfr_get_d(sum, MPFR_RNDN) > DBL_MAX ? 0 : HUGE_VAL;
    if (got <= DBL_MAX) {
        mpfr_sub_d(sum, sum, got, MPFR_RNDN);
        if (above <= DBL_MAX)
            mpfr_div_d(sum, sum, above - got, MPFR_RNDN);
        error = mpfr_get_d(sum, MPFR_RNDA);
    }
    mpfr_clears(x, sum, (mpfr_ptr)0);
    return error;
}

/* Of exponents that are near each other, of all, or about the least normal one. */
static void a_length_is_within_0501_units(void)
{
    const long cases = (long)check_setting("CYLINT_CASES", 20000);
    double worst = 0;
    rng = 5;
    for (long i = 0; i < cases; i++) {
        const int family = choice(3);
        const int e = family == 0 ? choice(2047) - 1074 : -1074;
        const int top = family == 0 && e < 1023 - 60 ? e + 60
                        : family == 1                ? -1021
                                                     : 1023;
        double o[3], d[3];
        cylint_line line;
        for (int j = 0; j < 3; j++) {
            o[j] = any_double(e, top);
            d[j] = i % 7 == 0 ? choice(9) - 4 : any_double(e, top);
        }
        if ((i % 2 ? cylint_segment(&line, o, d)
                   : cylint_whole_line(&line, o, d)) != CYLINT_OK)
            continue;
        const double error = fabs(error_of_length(&line));
        worst = error > worst ? error : worst;
        if (!CHECK(error <= 0.501))
            REPORT("%s %a %a %a, %a %a %a: %a, %g units",
                   i % 2 ? "segment" : "line", o[0], o[1], o[2], d[0], d[1],
                   d[2], cylint_line_length(&line), error);
    }
    fprintf(stderr, "%ld lengths, at most %.6f units\n", cases, worst);
}

#endif

/* ------------------------------------------------ the header's table -- */

static const double origin[3] = {0, 0, 0}, ex[3] = {1, 0, 0}, ez[3] = {0, 0, 1};

/* Whether the chords of o + t d in [tmin, tmax] are these n. */
static int has_chords(const cylint_shape *shape, double ox, double oz,
                      const double d[3], double tmin, double tmax, int n,
                      double t0, double t1)
{
    const double o[3] = {ox, 0, oz};
    const cylint_interval expected = {t0, t1};
    cylint_interval got[2];
    cylint_line line;
    cylint_span(&line, o, d, tmin, tmax);
    const int m = cylint_chord(shape, &line, got);
    return m == n && (n == 0 || same_chords(1, got, 1, &expected));
}

static void a_touch_has_no_chord(void)
{
    const double top[3] = {0, 0, 2}, low[3] = {0, 1, 0}, up[3] = {1, 0, 1};
    cylint_shape s;
    for (int ends = 0; ends < 4; ends++) {
        cylint_cylinder(&s, origin, top, 1, (cylint_ends)ends);
        CHECK(has_chords(&s, 1, 1, low, -9, 9, 0, 0, 0)); /* tangent */
        CHECK(has_chords(&s, -1, 2, up, -9, 9, 0, 0, 0)); /* a rim */
        cylint_cone(&s, origin, 1, top, 0, (cylint_ends)ends);
        CHECK(has_chords(&s, 0, 2, ex, -9, 9, 0, 0, 0)); /* the apex */
    }
    cylint_sphere(&s, origin, 1, CYLINT_ENDS_CAPPED);
    CHECK(has_chords(&s, 1, 0, low, -9, 9, 0, 0, 0));
    cylint_capsule(&s, origin, top, 1, CYLINT_ENDS_CAPPED);
    CHECK(has_chords(&s, 0, 3, ex, -9, 9, 0, 0, 0));
}

static void the_solid_is_closed(void)
{
    const double top[3] = {0, 0, 2}, low[3] = {0, 1, 0}, slope[3] = {-1, 0, 2};
    cylint_shape s;
    for (int ends = 0; ends < 4; ends++) {
        cylint_cylinder(&s, origin, top, 1, (cylint_ends)ends);
        CHECK(has_chords(&s, 1, 0, ez, -9, 9, 1, 0, 2));  /* a ruling */
        CHECK(has_chords(&s, 0, 0, ex, -9, 9, 1, -1, 1)); /* in a cap */
        CHECK(has_chords(&s, 0, 2, low, -9, 9, 1, -1, 1));
        CHECK(has_chords(&s, 0, 0, ez, -9, 9, 1, 0, 2)); /* through caps */
        cylint_cone(&s, origin, 1, top, 0, (cylint_ends)ends);
        CHECK(has_chords(&s, 1, 0, slope, -9, 9, 1, 0, 1));
    }
    cylint_halfspace(&s, origin, ez);
    CHECK(has_chords(&s, 3, 0, ex, -9, 9, 1, -9, 9));
}

static void the_domain_cuts_a_chord(void)
{
    const double in[3] = {0.25, 0, 1}, out[3] = {4, 0, 1}, top[3] = {0, 0, 2},
                 inside[3] = {0.5, 0, 1};
    cylint_interval c[2];
    cylint_line line;
    cylint_shape s;
    cylint_cylinder(&s, origin, top, 1, CYLINT_ENDS_OPEN);
    CHECK(has_chords(&s, 0.5, 1, ex, 0, HUGE_VAL, 1, 0, 0.5));
    CHECK(has_chords(&s, -4, 1, ex, 0, 4, 1, 3, 4));
    CHECK(has_chords(&s, 0, 1, ex, -0.5, 0.25, 1, -0.5, 0.25));
    CHECK(has_chords(&s, 0, 1, ex, 0.5, 0.5, 0, 0, 0));
    CHECK(has_chords(&s, -4, 1, ex, 0, 3, 0, 0, 0)); /* ends at the root */
    CHECK(has_chords(&s, -4, 1, ex, 5, 9, 0, 0, 0));
    CHECK(has_chords(&s, -4, 1, ex, 0, nextafter(3, 4), 1, 3, nextafter(3, 4)));
    CHECK(has_chords(&s, -4, 1, ex, HUGE_VAL, HUGE_VAL, 0, 0, 0));
    cylint_segment(&line, in, inside);
    CHECK(cylint_chord(&s, &line, c) == 1 && c[0].t0 == 0 && c[0].t1 == 1);
    cylint_segment(&line, in, out);
    CHECK(cylint_chord(&s, &line, c) == 1 && c[0].t0 == 0 && c[0].t1 == 0.2);
}

static void unbounded_shapes_have_infinite_ends(void)
{
    const double inf = HUGE_VAL;
    const double up[3] = {1, 0, 2}, side[3] = {0, 1, 0};
    cylint_shape s;
    cylint_cylinder(&s, origin, ez, 1, CYLINT_ENDS_INFINITE);
    CHECK(has_chords(&s, 1, 0, ez, -inf, inf, 1, -inf, inf));
    CHECK(has_chords(&s, 0.5, 7, ez, 0, inf, 1, 0, inf));
    cylint_halfspace(&s, ez, ez);
    CHECK(has_chords(&s, 0, 0, ez, -inf, inf, 1, -inf, 1));
    CHECK(has_chords(&s, 0, 1, ex, -inf, inf, 1, -inf, inf));
    CHECK(has_chords(&s, 0, 2, ex, -inf, inf, 0, 0, 0));
    cylint_tangent_cone(&s, origin, ez, 1, CYLINT_ENDS_NAPPE);
    CHECK(has_chords(&s, 0, 0, ez, -inf, inf, 1, 0, inf));
    CHECK(has_chords(&s, 1, 0, up, -inf, inf, 1, 1, inf));
    CHECK(has_chords(&s, 0, 0, ex, -inf, inf, 0, 0, 0));
    CHECK(has_chords(&s, 0, 2, side, -inf, inf, 1, -2, 2));
}

static void a_double_cone_has_two_chords(void)
{
    const double inf = HUGE_VAL, o[3] = {1, 0, 0}, along[3] = {1, 0, 1};
    cylint_interval c[2];
    cylint_line line;
    cylint_shape s;
    cylint_tangent_cone(&s, origin, ez, 1, CYLINT_ENDS_INFINITE);
    cylint_whole_line(&line, o, ez);
    CHECK(cylint_chord(&s, &line, c) == 2);
    CHECK(c[0].t0 == -inf && c[0].t1 == -1 && c[1].t0 == 1 && c[1].t1 == inf);
    line.tmin = -3;
    line.tmax = 1;
    CHECK(cylint_chord(&s, &line, c) == 1 && c[0].t0 == -3 && c[0].t1 == -1);
    line.tmin = -1;
    line.tmax = 3;
    CHECK(cylint_chord(&s, &line, c) == 1 && c[0].t0 == 1 && c[0].t1 == 3);
    CHECK(has_chords(&s, 0, 0, ez, -inf, inf, 1, -inf, inf));
    CHECK(has_chords(&s, 0, 0, along, -inf, inf, 1, -inf, inf));
    CHECK(has_chords(&s, 0, 0, ex, -inf, inf, 0, 0, 0));
}

static void refused_shapes_and_lines_have_no_chord(void)
{
    const double nan = (double)NAN;
    cylint_interval c[2];
    cylint_line line, refused;
    cylint_shape s, none;
    CHECK(cylint_sphere(&none, origin, -1, CYLINT_ENDS_CAPPED) != CYLINT_OK);
    CHECK(cylint_halfspace(&s, origin, origin) != CYLINT_OK);
    cylint_whole_line(&line, origin, ex);
    CHECK(cylint_chord(&none, &line, c) == 0);
    CHECK(cylint_chord(&s, &line, c) == 0);
    cylint_sphere(&s, origin, 1, CYLINT_ENDS_CAPPED);
    CHECK(cylint_chord(&s, &line, c) == 1);
    CHECK(cylint_whole_line(&refused, origin, origin) == CYLINT_EDIRECTION);
    CHECK(cylint_chord(&s, &refused, c) == 0);
    CHECK(cylint_span(&refused, origin, ex, 1, nan) == CYLINT_EDOMAIN);
    CHECK(cylint_chord(&s, &refused, c) == 0);
    CHECK(cylint_line_length(&refused) == 0);
}

static void roots_beyond_the_largest_double_are_infinite(void)
{
    const double small[3] = {0x1p-1074, 0, 0};
    cylint_shape s;
    cylint_sphere(&s, origin, 1, CYLINT_ENDS_CAPPED);
    CHECK(has_chords(&s, 0, 0, small, -HUGE_VAL, HUGE_VAL, 1, -HUGE_VAL,
                     HUGE_VAL));
    CHECK(has_chords(&s, 0, 0, small, 0, DBL_MAX, 1, 0, DBL_MAX));
    CHECK(has_chords(&s, 5, 0, small, -HUGE_VAL, HUGE_VAL, 0, 0, 0));
    CHECK(has_chords(&s, 1, 0, small, -HUGE_VAL, HUGE_VAL, 1, -HUGE_VAL, 0));
}

int main(void)
{
#ifdef HAVE_MPFR
    RUN(chords_of_integers_are_those_of_the_oracle);
    RUN(chords_scale_by_all_powers_of_two);
    RUN(chords_at_all_exponents_are_those_of_the_oracle);
    RUN(chords_are_the_same_in_every_environment);
    RUN(a_length_is_within_0501_units);
#endif
    RUN(a_touch_has_no_chord);
    RUN(the_solid_is_closed);
    RUN(the_domain_cuts_a_chord);
    RUN(unbounded_shapes_have_infinite_ends);
    RUN(a_double_cone_has_two_chords);
    RUN(refused_shapes_and_lines_have_no_chord);
    RUN(roots_beyond_the_largest_double_are_infinite);
    return check_end();
}
