/*
 * critical.h - the points of an ellipse at which a distance is stationary
 *
 * With t = tan(angle / 2) the form is a polynomial of degree 4 in t.  The half
 * turns |angle| <= pi/2 and |angle| >= pi/2 each have -1 <= t <= 1; in the second
 * one cos and sin change their signs.  The interval is taken a quarter longer on
 * each side, so that no zero is lost at its ends.  Between two adjacent zeros of
 * its derivative a polynomial has at most one zero.  So the zeros of all
 * derivatives follow one after the other from the linear one.  Newton's
 * iteration with bisection computes each of them in doubles.  Where the sign of
 * the polynomial or of a derivative at such a zero is below the rounding, zeros
 * may be hidden: then values are computed in triples.  Newton's iteration on the
 * form in triples yields the other digits.
 *
 * A pair of zeros that roundings of triples hide is not found.  One of the two
 * is then a minimum of the distance, but the form is smaller than its rounding
 * between them: the distance continues to decrease beyond the pair, but for the
 * product of that rounding and their gap.
 */
#ifndef CYLINT_CRITICAL_H
#define CYLINT_CRITICAL_H

#include "triple.h"

/*
 * A point of the ellipse is cos a + sin b.  Its distance from something is
 * stationary where
 *     linear[0] cos + linear[1] sin
 *         + square[0] cos^2 + square[1] cos sin + square[2] sin^2 = 0.
 */
typedef struct {
    triple linear[2], square[3];
    double terms; /* the sizes of all terms of these, where square[0] is
                     -square[2] */
} stationary;

enum { DEGREE = 4, MOST_ZEROS = 4, MOST_STEPS = 400, MOST_CORRECTIONS = 40 };

/* Relative to cos and sin; the error is 2^-50 of it. */
#define LAST_CORRECTION 0x1p-100

#define CRITICAL_REACH 1.25

/* A value in doubles by Horner's rule has 9 roundings and those of its
 * coefficients, of terms up to 2.5 times these: 2^-45.  NOISE is larger, so that a
 * zero is near enough for Newton's iteration to end at it. */
#define NOISE 0x1p-30

/* After such a step of Newton's iteration the error is below the rounding. */
#define SMALL_STEP 0x1p-50

/* ---------------------------------------------------------- the zeros --- */

/* p[0] + p[1] t + ... */
typedef struct {
    triple p[DEGREE + 1];
    int in_triples; /* values are computed in triples, else in doubles */
    int uncertain;  /* the sign between two zeros is below the rounding */
} polynomial;

/* Factors of the coefficients in derivatives, by their order. */
static const double falling[DEGREE + 1][DEGREE + 1] = {
    {1, 1, 1, 1, 1}, {1, 2, 3, 4}, {2, 6, 12}, {6, 24}, {24}};

/* The derivative of this order at t, and its slope. */
CYLINT_INLINE double value_at(const polynomial *f, int order, double t,
                              double *slope)
{
    const triple *p = f->p + order;
    const double *of = falling[order];
    int i = DEGREE - order;
    if (f->in_triples) {
        triple value = triple_times(p[i], of[i]), derivative = triple_of(0);
        while (i-- > 0) {
            derivative = triple_add(triple_times(derivative, t), value);
            value =
                triple_add(triple_times(value, t), triple_times(p[i], of[i]));
        }
        *slope = derivative.a;
        return triple_value(value);
    }
    double value = p[i].a * of[i], derivative = 0;
    while (i-- > 0) {
        derivative = derivative * t + value;
        value = value * t + p[i].a * of[i];
    }
    *slope = derivative;
    return value;
}

/* Its zero between `below` and `above`, at which the signs differ.  at_above: the
 * value there. */
static double zero_between(const polynomial *f, int order, double below,
                           double above, double at_above)
{
    double x = 0.5 * (below + above);
    /* untaken 1 of 6: every known zero takes fewer steps */
    for (int step = 0; step < MOST_STEPS && below < x && x < above; step++) {
        double slope;
        const double value = value_at(f, order, x, &slope);
        if (value == 0)
            break;
        if ((value > 0) == (at_above > 0))
            above = x;
        else
            below = x;
        const double by = value / slope, next = x - by;
        const int is_between = next > below && next < above;
        if (fabs(by) <= SMALL_STEP)
            return is_between ? next : x;
        x = is_between ? next : 0.5 * (below + above);
    }
    return x;
}

static double noise(const polynomial *f, int order)
{
    double sum = 0;
    for (int i = 0; i <= DEGREE - order; i++)
        sum += falling[order][i] * fabs(f->p[order + i].a);
    return NOISE * sum;
}

/* The zeros, given those of the next derivative, ascending. */
static int next_zeros(polynomial *f, int order, const double *turn, int turns,
                      double *zero)
{
    int n = 0;
    double low = -CRITICAL_REACH, slope,
           at_low = value_at(f, order, low, &slope);
    const double least = noise(f, order);
    for (int i = 0; i <= turns; i++) {
        const double high = i < turns ? turn[i] : CRITICAL_REACH,
                     at_high = value_at(f, order, high, &slope);
        if (i < turns && fabs(at_high) <= least)
            f->uncertain = 1;
        if (at_low == 0)
            zero[n++] = low;
        else if (cylint_sign(at_low) * cylint_sign(at_high) < 0)
            zero[n++] = zero_between(f, order, low, high, at_high);
        low = high;
        at_low = at_high;
    }
    return n;
}

/* Those in [-CRITICAL_REACH, CRITICAL_REACH]. */
static int all_zeros(polynomial *f, double zero[MOST_ZEROS])
{
    double turn[MOST_ZEROS];
    int n = 0;
    for (int order = DEGREE - 1; order >= 0; order--) {
        for (int i = 0; i < n; i++)
            turn[i] = zero[i];
        n = next_zeros(f, order, turn, n, zero);
    }
    return n;
}

/* ---------------------------------------------- the form in triples ----- */

static triple form_at(const stationary *f, const direction *at)
{
    const triple by_cos =
        triple_add(f->linear[0],
                   triple_mul2(f->square[0], at->cos, f->square[1], at->sin));
    const triple by_sin =
        triple_add(f->linear[1], triple_mul(f->square[2], at->sin));
    return triple_mul2(by_cos, at->cos, by_sin, at->sin);
}

/* The integral of the form over the angle, where square[0] is -square[2]. */
static triple integral_at(const stationary *f, const direction *at)
{
    const triple by_sin = triple_mul2(f->square[0], at->cos,
                                      triple_scale(f->square[1], 0.5), at->sin);
    return triple_det(triple_add(f->linear[0], by_sin), at->sin, f->linear[1],
                      at->cos);
}

/* Its derivative by the angle, which is such a form, too.  Terms cancel where zeros
 * nearly coincide: in_triples. */
static double slope_at(const stationary *f, const direction *at, int in_triples)
{
    const triple half = triple_sub(f->square[2], f->square[0]);
    const stationary slope = {
        {f->linear[1], triple_neg(f->linear[0])},
        {f->square[1], triple_scale(half, 2), triple_neg(f->square[1])},
        0};
    const double c = at->cos.a, s = at->sin.a;
    return in_triples ? triple_value(form_at(&slope, at))
                      : slope.linear[0].a * c + slope.linear[1].a * s +
                            slope.square[1].a * c * s +
                            slope.square[0].a * (c - s) * (c + s);
}

/* Corrects a zero by Newton's iteration until the form gets no smaller, or until
 * the error of a correction, which is a double, is below the last place of cos
 * and of sin.  The length grows by half the square of a correction.
 * normalize() squares that error. */
static direction corrected(const stationary *f, direction at, int in_triples)
{
    normalize(&at);
    normalize(&at);
    double form = triple_value(form_at(f, &at));
    /* mutant '&&' -> '||': a step that reduces nothing ends the loop */
    for (int step = 0; step < MOST_CORRECTIONS && form != 0; step++) {
        const double by = -form / slope_at(f, &at, in_triples);
        if (!(fabs(by) < 0.5))
            break;
        direction next = {triple_sub(at.cos, triple_times(at.sin, by)),
                          triple_add(at.sin, triple_times(at.cos, by))};
        double error = by * by;
        while (error > CYLINT_TRIPLE_ROUNDING) {
            normalize(&next);
            error *= error;
        }
        normalize(&next);
        const double least = cylint_smaller(fabs(next.cos.a), fabs(next.sin.a));
        const int is_last = fabs(by) <= LAST_CORRECTION * least;
        const double smaller = is_last ? 0 : triple_value(form_at(f, &next));
        if (!(fabs(smaller) < fabs(form)))
            break;
        at = next;
        form = smaller;
    }
    return at;
}

/* The error of its angle, in units of the rounding of triples, at most 1.  It
 * is far below 1 only where cos or sin, and most terms, are nearly 0. */
static double direction_error(const stationary *f, const direction *at)
{
    const double c = fabs(at->cos.a), s = fabs(at->sin.a);
    const double terms = c * (fabs(f->linear[0].a) + fabs(f->square[0].a) * c +
                              fabs(f->square[1].a) * s) +
                         s * (fabs(f->linear[1].a) + fabs(f->square[2].a) * s);
    const double residual =
        fabs(triple_value(form_at(f, at))) / CYLINT_TRIPLE_ROUNDING;
    const double error = (terms + residual) / fabs(slope_at(f, at, 0));
    return error < 1 ? error : 1;
}

static direction direction_at(double t, int sign)
{
    const double length = sign * (1 + t * t);
    return (direction){triple_of((1 - t) * (1 + t) / length),
                       triple_of(2 * t / length)};
}

/* The form as a polynomial in t, times a power of two.  The linear terms are
 * multiplied by `sign`. */
static void load_polynomial(const stationary *f, int sign, triple p[DEGREE + 1])
{
    triple x[5];
    double size = 0;
    for (int i = 0; i < 5; i++) {
        x[i] = i < 2 ? triple_scale(f->linear[i], sign) : f->square[i - 2];
        size = cylint_larger(size, fabs(x[i].a));
    }
    const double power = normalizer(size);
    for (int i = 0; i < 5; i++)
        x[i] = triple_scale(x[i], power);
    p[0] = triple_add(x[2], x[0]);
    p[1] = triple_scale(triple_add(x[1], x[3]), 2);
    p[2] = triple_scale(triple_sub(triple_scale(x[4], 2), x[2]), 2);
    p[3] = triple_scale(triple_sub(x[1], x[3]), 2);
    p[4] = triple_sub(x[2], x[0]);
}

static int is_zero(const stationary *f)
{
    double sum = 0;
    for (int i = 0; i < 5; i++)
        sum += fabs(i < 2 ? f->linear[i].a : f->square[i - 2].a);
    return sum == 0;
}

/* The directions of the zeros in one half turn. */
static int half_turn(const stationary *form, int sign, direction to[MOST_ZEROS])
{
    polynomial f = {.in_triples = 0};
    double zero[MOST_ZEROS];
    load_polynomial(form, sign, f.p);
    int n = all_zeros(&f, zero);
    if (f.uncertain) {
        f.in_triples = 1;
        n = all_zeros(&f, zero);
    }
    for (int i = 0; i < n; i++)
        to[i] = corrected(form, direction_at(zero[i], sign), f.in_triples);
    return n;
}

enum { MOST_CRITICAL = 8 };

/* Writes the directions in which the form is 0, with the digits of triples: all
 * that are simple, some of them twice; 0 and half a turn if all coefficients are
 * 0.  Returns their number. */
static int critical_directions(const stationary *form,
                               direction to[MOST_CRITICAL])
{
    if (is_zero(form)) {
        to[0] = (direction){triple_of(1), triple_of(0)};
        to[1] = (direction){triple_of(-1), triple_of(0)};
        return 2;
    }
    const int right = half_turn(form, 1, to);
    return right + half_turn(form, -1, to + right);
}

#endif
