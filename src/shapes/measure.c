/*
 * measure.c - a ball about each shape, sizes, and whether the filters apply
 */
#include "measure.h"

#include "../numbers/bits.h"
#include "../numbers/error_bounds.h"
#include "../numbers/exact.h"

static double largest_length(const cylint_shape *s)
{
    double most = cylint_largest(s->axis);
    if (cylint_is_elliptic(s->kind)) {
        const double a = cylint_largest(s->a), b = cylint_largest(s->b);
        most = a > most ? a : most;
        most = b > most ? b : most;
    }
    if (!cylint_has_factors(s->kind)) {
        most = s->r0 > most ? s->r0 : most;
        most = s->r1 > most ? s->r1 : most;
    }
    return most;
}

int cylint_length_exponent(const cylint_shape *s)
{
    const double most = largest_length(s);
    return most <= DBL_MAX ? cylint_any_exponent(most) : 1024;
}

static int within_window(double x)
{
    return x >= 1 / CYLINT_WINDOW && x <= CYLINT_WINDOW;
}

void cylint_measure_line(cylint_line *line)
{
    line->size = cylint_largest(line->d);
    line->in_range =
        within_window(line->size) && cylint_largest(line->o) <= CYLINT_FAR;
}

static double dot3(const double x[3], const double y[3])
{
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/* The square of the largest distance of a disc's points from its centre.
 * *skew: how much the direction of a point can add to the square of its distance
 * from the middle of an oblique shape. */
static double disc_reach(const cylint_shape *s, double *skew)
{
    *skew = 0;
    const double r = cylint_larger(s->r0, s->r1);
    if (!cylint_is_elliptic(s->kind))
        return r * r * cylint_radius_unit(s, dot3(s->axis, s->axis));
    *skew = r * (fabs(dot3(s->a, s->axis)) + fabs(dot3(s->b, s->axis)));
    return r * r *
           (cylint_larger(dot3(s->a, s->a), dot3(s->b, s->b)) +
            fabs(dot3(s->a, s->b)));
}

/* Of a ball about the centre that holds the balls of a round kind. */
static double ball_radius(cylint_shape *s)
{
    double r = s->r0;
    if (s->kind == CYLINT_KIND_SPHERE)
        for (int i = 0; i < 3; i++)
            s->center[i] = s->base[i];
    else
        r = 0.5 * sqrt(dot3(s->axis, s->axis)) + cylint_larger(s->r0, s->r1);
    return r * CYLINT_SLACK + 2 * CYLINT_ROUNDING * cylint_largest(s->center);
}

/*
 * A ball about the middle of the axis.  A disc's points x a + y b reach as
 * far as the root of the larger eigenvalue of (aa ab; ab bb), which is at most
 * max(aa, bb) + |ab|.  The slack covers a dozen roundings of positive terms;
 * the centre is off by a rounding of each coordinate.
 */
static void measure_ball(cylint_shape *s)
{
    s->bound_radius = HUGE_VAL;
    /* mutant '0' -> '1': for unbounded shapes, whose ball holds everything */
    s->center[0] = s->center[1] = s->center[2] = 0;
    if (!cylint_ends_are_planes(s->ends))
        return;
    for (int i = 0; i < 3; i++)
        s->center[i] = cylint_has_end_points(s->kind)
                           ? 0.5 * s->base[i] + 0.5 * s->top[i]
                           : s->base[i] + 0.5 * s->axis[i];
    if (cylint_is_round(s->kind)) {
        s->bound_radius = ball_radius(s);
        return;
    }
    double skew;
    const double reach = disc_reach(s, &skew);
    s->bound_radius =
        sqrt(0.25 * dot3(s->axis, s->axis) + reach + skew) * CYLINT_SLACK +
        2 * CYLINT_ROUNDING * cylint_largest(s->center);
}

void cylint_measure_shape(cylint_shape *s)
{
    s->size = cylint_largest(s->axis);
    s->in_range = within_window(largest_length(s)) &&
                  /* mutant '<=' -> '<': slower, exact arithmetic decides at
                   * the window's end */
                  (!cylint_has_factors(s->kind) || s->r1 <= CYLINT_WINDOW);
    measure_ball(s);
}

static void swap_doubles(double *x, double *y)
{
    const double kept = *x;
    *x = *y;
    *y = kept;
}

void cylint_ball_of(cylint_shape *ball, const cylint_shape *s, int end)
{
    *ball = *s;
    ball->kind = CYLINT_KIND_SPHERE;
    ball->surface = end ? CYLINT_PART_CAP1 : CYLINT_PART_CAP0;
    if (end) {
        swap_doubles(&ball->r0, &ball->r1);
        ball->dr = -s->dr;
        ball->dr_lo = -s->dr_lo;
        for (int i = 0; i < 3; i++) {
            swap_doubles(&ball->base[i], &ball->top[i]);
            ball->axis[i] = -s->axis[i];
            ball->axis_lo[i] = -s->axis_lo[i];
        }
    }
    cylint_measure_shape(ball);
}

int cylint_apex_normal_sign(const cylint_shape *s, int along)
{
    const int grows = cylint_sign(s->dr);
    if (s->ends != CYLINT_ENDS_INFINITE)
        return -grows;
    if (along != 0)
        return -along;
    return cylint_sign(s->r0) == 0 ? -1 : grows;
}

/* From exact differences: pairs that do not overflow would lose digits of
 * subnormal ones, and so could be equal. */
ASIDE int least_overflowing_component(const cylint_shape *s)
{
    cylint_arena arena;
    exact size[3];
    int least = 0;
    cylint_arena_open(&arena);
    for (int i = 0; i < 3; i++) {
        size[i] = cylint_exact_difference(&arena, s->top[i], s->base[i]);
        size[i].sign *= size[i].sign;
        const exact less =
            cylint_exact_add(&arena, size[i], cylint_exact_neg(size[least]));
        least = less.sign < 0 ? i : least;
    }
    return least;
}

int cylint_least_axis_component(const cylint_shape *s)
{
    return cylint_largest(s->axis) <= DBL_MAX
               ? cylint_least_component(s->axis, s->axis_lo)
               : least_overflowing_component(s);
}
