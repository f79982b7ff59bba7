/*
 * critical.c - the points of an ellipse at which a distance is stationary
 *
 * With t = tan(angle / 2) the form is a polynomial of degree 4 in t.  The half
 * turns |angle| <= pi/2 and |angle| >= pi/2 each have -1 <= t <= 1; in the second
 * one cos and sin change their signs.  The interval is taken a quarter longer on
 * each side, so that no zero is lost at its ends.  Between two adjacent zeros of
 * its derivative a polynomial has at most one zero.  So the zeros of all
 * derivatives follow one after the other from the linear one.  Newton's
 * iteration with bisection computes each of them to neighbouring doubles of
 * t + 3.  Newton's iteration on the form in triples yields the rest of the
 * digits.
 *
 * A pair of zeros that roundings of the polynomial hide is not found.  One of
 * the two is then a minimum of the distance, but the form is smaller than its
 * rounding between them: the distance continues to decrease beyond the
 * pair, but for the product of that rounding and their gap.
 */
#include "critical.h"

enum { DEGREE = 4, MOST_ZEROS = 4, MOST_STEPS = 200, MOST_CORRECTIONS = 16 };

static const double reach = 1.25;

/* ------------------------------------------- polynomials in doubles ----- */

/* p[0] + p[1] t + ..., and its derivative. */
static double value_of(const double *p, int degree, double t, double *slope)
{
    double value = p[degree], derivative = 0;
    for (int i = degree - 1; i >= 0; i--) {
        derivative = derivative * t + value;
        value = value * t + p[i];
    }
    *slope = derivative;
    return value;
}

/* The zero between `low` and `high`, at which the signs differ.  `high_sign`:
 * the sign at `high`. */
static double zero_between(const double *p, int degree, double low, double high,
                           int high_sign)
{
    double below = low + 3, above = high + 3, x = 0.5 * (below + above);
    for (int step = 0; step < MOST_STEPS; step++) {
        double slope;
        const double value = value_of(p, degree, x - 3, &slope);
        if (value == 0)
            break;
        if ((value > 0) == (high_sign > 0))
            above = x;
        else
            below = x;
        double next = x - value / slope;
        if (!(next > below && next < above))
            next = 0.5 * (below + above);
        if (next == x || next <= below || next >= above)
            break;
        x = next;
    }
    return x - 3;
}

/* The zeros in [-reach, reach], given those of the derivative, ascending. */
static int next_zeros(const double *p, int degree, const double *turn,
                      int turns, double *zero)
{
    int n = 0;
    double low = -reach, slope, at_low = value_of(p, degree, low, &slope);
    for (int i = 0; i <= turns; i++) {
        const double high = i < turns ? turn[i] : reach;
        const double at_high = value_of(p, degree, high, &slope);
        if (at_low == 0)
            zero[n++] = low;
        else if ((at_low < 0 && at_high > 0) || (at_low > 0 && at_high < 0))
            zero[n++] =
                zero_between(p, degree, low, high, at_high > 0 ? 1 : -1);
        low = high;
        at_low = at_high;
    }
    return n;
}

/* The zeros in [-reach, reach]. */
static int zeros(const double p[DEGREE + 1], double zero[MOST_ZEROS])
{
    double q[DEGREE][DEGREE + 1], turn[MOST_ZEROS];
    int n = 0;
    for (int i = 0; i <= DEGREE; i++)
        q[0][i] = p[i];
    for (int k = 1; k < DEGREE; k++)
        for (int i = 0; i <= DEGREE - k; i++)
            q[k][i] = q[k - 1][i + 1] * (i + 1);
    for (int k = DEGREE - 1; k >= 0; k--) {
        const int turns = n;
        for (int i = 0; i < turns; i++)
            turn[i] = zero[i];
        n = next_zeros(q[k], DEGREE - k, turn, turns, zero);
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

/* Its derivative by the angle. */
static double slope_at(const stationary *f, const direction *at)
{
    const double c = at->cos.a, s = at->sin.a;
    return -f->linear[0].a * s + f->linear[1].a * c +
           2 * c * s * (f->square[2].a - f->square[0].a) +
           f->square[1].a * (c - s) * (c + s);
}

/* Divides by the length, which is nearly 1. */
static void normalize(direction *d)
{
    const triple square = triple_mul2(d->cos, d->cos, d->sin, d->sin);
    const triple half = triple_scale(triple_sub(square, triple_of(1)), 0.5);
    d->cos = triple_sub(d->cos, triple_mul(d->cos, half));
    d->sin = triple_sub(d->sin, triple_mul(d->sin, half));
}

/* Corrects a zero by Newton's iteration until the form gets no smaller, or until
 * the square of a correction is below the last place of a triple.  The length
 * grows by half the square of a correction.  normalize() squares that
 * error. */
direction cylint_correct_direction(const stationary *f, rough_direction rough)
{
    direction at = {triple_of(rough.cos), triple_of(rough.sin)};
    normalize(&at);
    normalize(&at);
    triple form = form_at(f, &at);
    for (int step = 0; step < MOST_CORRECTIONS && form.a != 0; step++) {
        const double by = -form.a / slope_at(f, &at);
        if (!(fabs(by) < 0.5))
            break;
        direction next = {triple_sub(at.cos, triple_scale(at.sin, by)),
                          triple_add(at.sin, triple_scale(at.cos, by))};
        double error = by * by;
        while (error > CYLINT_TRIPLE_ROUNDING) {
            normalize(&next);
            error *= error;
        }
        normalize(&next);
        const int is_last = by * by < CYLINT_TRIPLE_ROUNDING;
        const triple smaller = is_last ? triple_of(0) : form_at(f, &next);
        if (!(fabs(smaller.a) < fabs(form.a)))
            break;
        at = next;
        form = smaller;
    }
    return at;
}

static rough_direction direction_of(double t, int sign)
{
    const double length = sign * (1 + t * t);
    return (rough_direction){(1 - t) * (1 + t) / length, 2 * t / length};
}

/* The form as a polynomial in t, times a power of two.  The linear terms are
 * multiplied by `sign`. */
static void polynomial(const stationary *f, int sign, double p[DEGREE + 1])
{
    double size = 0, x[5];
    for (int i = 0; i < 5; i++) {
        x[i] = i < 2 ? sign * f->linear[i].a : f->square[i - 2].a;
        size = cylint_larger(size, fabs(x[i]));
    }
    const int e = cylint_any_exponent(size);
    for (int i = 0; i < 5; i++)
        x[i] = cylint_scaled(x[i], -e);
    p[0] = x[2] + x[0];
    p[1] = 2 * (x[1] + x[3]);
    p[2] = 2 * (2 * x[4] - x[2]);
    p[3] = 2 * (x[1] - x[3]);
    p[4] = x[2] - x[0];
}

static int is_zero(const stationary *f)
{
    double sum = 0;
    for (int i = 0; i < 5; i++)
        sum += fabs(i < 2 ? f->linear[i].a : f->square[i - 2].a);
    return sum == 0;
}

int cylint_critical_directions(const stationary *form,
                               rough_direction to[CYLINT_MOST_CRITICAL])
{
    int n = 0;
    if (is_zero(form)) {
        to[0] = (rough_direction){1, 0};
        to[1] = (rough_direction){-1, 0};
        return 2;
    }
    for (int sign = 1; sign >= -1; sign -= 2) {
        double p[DEGREE + 1], zero[MOST_ZEROS];
        polynomial(form, sign, p);
        const int count = zeros(p, zero);
        for (int i = 0; i < count; i++)
            to[n++] = direction_of(zero[i], sign);
    }
    return n;
}
