/*
 * measure.c - a ball about each shape, sizes, and whether the filters apply
 */
#include "measure.h"

#include "../numbers/bits.h"
#include "../numbers/error_bounds.h"
#include "../numbers/exact.h"

/* Infinite or DBL_MAX if the axis overflows. */
static double largest_length(const cylint_shape *s)
{
    double most = cylint_larger(cylint_axis_size(s),
                                cylint_larger(cylint_largest(cylint_a(s)),
                                              cylint_largest(cylint_b(s))));
    /* mutant '!' -> '': slower, exact arithmetic decides where a radius or its
     * factor is out of range */
    if (!cylint_has_factors(s->kind))
        most = cylint_larger(most, cylint_larger(cylint_r0(s), cylint_r1(s)));
    return most;
}

static int within_window(double x)
{
    return x >= 1 / CYLINT_WINDOW && x <= CYLINT_WINDOW;
}

void cylint_measure_line(cylint_line *line)
{
    line->size = cylint_largest(line->d);
    if (!(line->size >= DBL_MIN))
        line->size = cylint_largest_by_bits(line->d);
    line->in_range =
        within_window(line->size) && cylint_largest(line->o) <= CYLINT_FAR;
}

/* The square of the largest distance of a disc's points from its centre, plus what
 * an oblique axis can add to the square of their distance from the middle. */
static double disc_reach(const cylint_shape *s)
{
    const double *a = cylint_a(s), *b = cylint_b(s), *w = cylint_axis(s);
    const double r = cylint_larger(cylint_r0(s), cylint_r1(s));
    if (!cylint_is_elliptic(s->kind))
        return r * r * cylint_radius_unit(s, cylint_dot(w, w));
    return r * r *
               (cylint_larger(cylint_dot(a, a), cylint_dot(b, b)) +
                fabs(cylint_dot(a, b))) +
           r * (fabs(cylint_dot(a, w)) + fabs(cylint_dot(b, w)));
}

/* The radius of a ball about the middle that holds a bounded shape. */
static double radius_about(const cylint_shape *s)
{
    const double ww = cylint_dot(cylint_axis(s), cylint_axis(s));
    if (s->kind == CYLINT_KIND_SPHERE)
        return cylint_r0(s);
    if (cylint_is_round(s->kind))
        return 0.5 * sqrt(ww) + cylint_larger(cylint_r0(s), cylint_r1(s));
    return sqrt(0.25 * ww + disc_reach(s));
}

/*
 * A ball about the middle of the axis.  A disc's points x a + y b reach as
 * far as the root of the larger eigenvalue of (aa ab; ab bb), which is at most
 * max(aa, bb) + |ab|.  The slack covers a dozen roundings of positive terms;
 * the centre is off by a rounding of each coordinate.
 */
double cylint_ball_about(const cylint_shape *s, double center[3])
{
    /* mutant '0' -> '1': for unbounded shapes, whose ball holds everything */
    center[0] = center[1] = center[2] = 0;
    if (!cylint_ends_are_planes(s->ends))
        return HUGE_VAL;
    for (int i = 0; i < 3; i++)
        center[i] = s->kind == CYLINT_KIND_SPHERE ? cylint_base(s)[i]
                    : cylint_has_end_points(s->kind)
                        ? 0.5 * cylint_base(s)[i] + 0.5 * cylint_top(s)[i]
                        : cylint_base(s)[i] + 0.5 * cylint_axis(s)[i];
    return radius_about(s) * CYLINT_SLACK +
           2 * CYLINT_ROUNDING * cylint_largest(center);
}

int cylint_is_in_window(const cylint_shape *s)
{
    return within_window(largest_length(s)) &&
           /* mutant '<=' -> '<': slower, exact arithmetic decides at
            * the window's end */
           cylint_r1(s) <= CYLINT_WINDOW;
}

void cylint_ball_of(cylint_shape *ball, const cylint_shape *s, int end)
{
    double *x = ball->library.number;
    *ball = *s;
    ball->kind = CYLINT_KIND_SPHERE;
    ball->library.flag[CYLINT_AT_SURFACE] =
        end ? CYLINT_PART_CAP1 : CYLINT_PART_CAP0;
    if (end) {
        x[CYLINT_AT_R0] = cylint_r1(s);
        x[CYLINT_AT_R1] = cylint_r0(s);
        for (int i = 0; i < 3; i++) {
            x[CYLINT_AT_BASE + i] = cylint_top(s)[i];
            x[CYLINT_AT_TOP + i] = cylint_base(s)[i];
            x[CYLINT_AT_AXIS + i] = -cylint_axis(s)[i];
        }
    }
    ball->library.flag[CYLINT_AT_IN_RANGE] = cylint_is_in_window(ball);
}

int cylint_apex_normal_sign(const cylint_shape *s, int along)
{
    const int grows = cylint_sign(cylint_radius_growth(s).hi);
    if (s->ends != CYLINT_ENDS_INFINITE)
        return -grows;
    if (along != 0)
        return -along;
    return cylint_sign(cylint_r0(s)) == 0 ? -1 : grows;
}

/* From exact differences: pairs of subnormal coordinates, or of an axis that
 * overflows, would lose digits, so that different sizes could be equal. */
int cylint_least_axis_component(const cylint_shape *s)
{
    const int has_end_points = cylint_has_end_points(s->kind);
    cylint_arena arena;
    exact size[3];
    int least = 0;
    cylint_arena_open(&arena);
    for (int i = 0; i < 3; i++) {
        size[i] = has_end_points
                      ? cylint_exact_difference(&arena, cylint_top(s)[i],
                                                cylint_base(s)[i])
                      : cylint_exact_from(&arena, cylint_axis(s)[i]);
        size[i] = cylint_exact_signed(size[i], size[i].sign != 0);
        const exact less = cylint_exact_sub(&arena, size[i], size[least]);
        least = less.sign < 0 ? i : least;
    }
    return least;
}
