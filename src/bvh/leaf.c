/*
 * leaf.c - bounds slices by cylinders and stores them in leaves
 */
#include "leaf.h"

#include <string.h>

/*
 * The sides of the box are at most REACH steps from its centre.  Then ten bits
 * hold every radius, which is at most sqrt(3/2) REACH for a disc in such a box,
 * and every end of an axis, which bound_slice() has lengthened.
 */
#define REACH 440.0
#define LARGEST_P 511.0
#define LARGEST_R 1023.0

/* At most 2^100 steps per unit, so that flushed subnormal floats are far below
 * a step. */
static uint16_t steps_per_unit(double half)
{
    const double most = 0x1p100;
    return cylint_bfloat16_below(REACH < most * half ? REACH / half : most);
}

static void set_center(cylint_leaf *leaf, const cylint_boxed_slice *boxes,
                       int used)
{
    double most = 0;
    cylint_extent all = boxes[0].box;
    for (int lane = 1; lane < used; lane++)
        cylint_extent_include(&all, &boxes[lane].box);
    for (int j = 0; j < 3; j++) {
        const double lower = all.lower[j], upper = all.upper[j];
        const float c = (float)((lower + upper) / 2);
        leaf->center[j] = c;
        most = cylint_larger(
            most, cylint_larger(upper - (double)c, (double)c - lower));
    }
    leaf->steps = steps_per_unit(most);
}

/* A cylinder in steps. */
typedef struct {
    double p[2][3], r;
} step_cylinder;

/* The nearest whole number, in every rounding mode.  rint() would not give the same
 * number with every compiler: gcc's code rounds |x|, so that halves below 0 differ
 * in directed modes. */
static long nearest_whole(double x)
{
    const long n = lrint(x);
    return n + (x - (double)n > 0.5) - ((double)n - x > 0.5);
}

/* Rounds an end to whole steps.  Returns the distance by which that moves it, or -1
 * if the end is too many steps from the centre for a leaf. */
static double round_end(const double p[3], long to[3])
{
    double square = 0;
    for (int j = 0; j < 3; j++) {
        if (!(fabs(p[j]) < LARGEST_P))
            return -1;
        to[j] = nearest_whole(p[j]);
        const double shift = p[j] - (double)to[j];
        square += shift * shift;
    }
    return sqrt(square);
}

/* lint: the analyzer takes a shift that is not negative for one that is */
static int store_cylinder(cylint_leaf *leaf, int lane, const step_cylinder *h)
{
    long p[2][3];
    const double shift[2] = {round_end(h->p[0], p[0]),
                             round_end(h->p[1], p[1])};
    const double r = ceil(h->r + cylint_larger(shift[0], shift[1]));
    if (shift[0] < 0 || shift[1] < 0 || !(r <= LARGEST_R))
        return 0;
    for (int end = 0; end < 2; end++)
        for (int j = 0; j < 3; j++)
            leaf->p[end][lane] |= (uint32_t)(CYLINT_LEAF_MIDDLE + p[end][j])
                                  << j * CYLINT_LEAF_P_BITS;
    leaf->r[lane] = (uint16_t)(leaf->r[lane] | (int)r);
    return 1;
}

/* Stores the slice's index and count and the shape's ends. */
static void store_numbers(cylint_leaf *leaf, int lane, cylint_slice slice,
                          int ends)
{
    const uint32_t count = (uint32_t)slice.count - 1; /* 1 is stored as 0 */
    leaf->p[0][lane] = count << 30;
    leaf->p[1][lane] = count >> 2 << 30;
    leaf->r[lane] = (uint16_t)((slice.index | ends << 4) << CYLINT_LEAF_R_BITS);
}

/*
 * Bounds a slice by a cylinder whose axis ends at whole steps.
 *
 * The slice is the convex hull of two sections.  A(z) is a point of its axis, X
 * a point of the section at z: X is at most `across` from the axis and at most
 * `along` from A(z) along it; a round shape has other sections than its ends,
 * with along = 0.  The axis is lengthened by g, which may differ at both ends,
 * then its ends are rounded.  The nearest point Q(z) of the rounded axis is less
 * than e = 7/8 + input_error steps from A(z): the rounding adds at most sqrt(3)/2,
 * the doubles before it and the line's own error add `input_error`.  So
 *
 *   X is at most across + e from the rounded axis (the stored radius uses the
 *   actual rounding instead of its bound),
 *   and along it at most e + along + across sin(a) from Q(z),
 *
 * where a is the angle between the two axes.  Both ends move by less than e, so
 * sin(a) <= 2 e / (l + g + g - 2 e).  g must not be less than the second bound.
 * With g = e + along + 4 + x and x = sqrt(across e), sin(a) < e / x and
 * across sin(a) < x.  x = across 2 e / (l - 2 e) also does, if it is less.
 * The 4 gives every lane an axis.  An axis so short that its direction is lost
 * to underflow has none: such a lane is always tested.
 *
 * A slice of a round shape lies in the convex hull of two balls, which are about
 * points of the axis.  If all slices of the leaf are round, the slice is bounded
 * by a capsule: the smaller ball lies in a ball of the larger radius, nearer to
 * the other by the difference of the radii.  Each point of the axis is as near
 * to the rounded one as its ends are, so nothing is added but 2 steps at each end
 * of an axis shorter than 4: so every lane has one.
 */
static int bound_slice(cylint_leaf *leaf, int lane, const cylint_swept_disc *s,
                       cylint_slice slice, double line_error)
{
    const int capsule = leaf->used & CYLINT_LEAF_ROUND;
    const double steps = cylint_leaf_steps(leaf);
    const double *base = s->base, *axis = s->axis;
    const double slope = s->along / s->across;
    const double ww = cylint_dot(axis, axis), length = s->length;
    const double input_error =
        line_error * steps +
        0x1p-48 * steps *
            (fabs(base[0]) + fabs(base[1]) + fabs(base[2]) + length +
             cylint_larger(s->k[0], s->k[1]) * s->across * (1 + slope));
    const double e = 0.875 + input_error;
    const int round = s->round;
    const cylint_slice_hull hull = cylint_slice_hull_of(s, slice);
    const double k[2] = {hull.k[0] * s->across * steps,
                         hull.k[1] * s->across * steps};
    const double across = cylint_larger(k[0], k[1]);
    const double l = length * steps * (hull.z[1] - hull.z[0]);
    const double out = sqrt(across * e);
    const double least =
        e + 4 +
        (l > 4 * e ? cylint_smaller(out, across * 2 * e / (l - 2 * e)) : out);
    double longer[2];
    for (int end = 0; end < 2; end++) {
        const int is_disc = round && !hull.is_ball[end];
        longer[end] = (least + (is_disc ? 0 : across * slope)) / length;
    }
    if (capsule) {
        const double shorter = cylint_smaller(fabs(k[0] - k[1]), l);
        for (int end = 0; end < 2; end++)
            longer[end] =
                ((l - shorter < 4 ? 2 : 0) - (k[end] < across ? shorter : 0)) /
                length;
    }
    step_cylinder h = {.r = across + input_error + 0x1p-20};
    for (int j = 0; j < 3; j++) {
        const double from = base[j] - (double)leaf->center[j];
        h.p[0][j] = (from + hull.z[0] * axis[j]) * steps - longer[0] * axis[j];
        h.p[1][j] = (from + hull.z[1] * axis[j]) * steps + longer[1] * axis[j];
    }
    return ww > CYLINT_LEAST_SQUARE && input_error < 1 &&
           store_cylinder(leaf, lane, &h);
}

void cylint_leaf_fill(cylint_leaf *leaf, const cylint_swept_disc *discs,
                      const cylint_boxed_slice *boxes, int used,
                      double line_error)
{
    memset(leaf, 0, sizeof *leaf);
    set_center(leaf, boxes, used);
    int solid = CYLINT_LEAF_SOLID, round = CYLINT_LEAF_ROUND;
    for (int lane = 0; lane < used; lane++) {
        solid = discs[lane].solid ? solid : 0;
        round = discs[lane].round ? round : 0;
    }
    leaf->used = (uint8_t)(used | solid | round);
    for (int lane = 0; lane < used; lane++) {
        const cylint_swept_disc *disc = discs + lane;
        const cylint_slice slice = boxes[lane].slice;
        leaf->number[lane] = boxes[lane].number;
        store_numbers(leaf, lane, slice, disc->ends);
        if (!bound_slice(leaf, lane, disc, slice, line_error))
            leaf->always |= (uint8_t)(1u << lane);
    }
}
