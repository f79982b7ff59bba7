/*
 * find_nearest.h - the nearest feature and the distance in pairs, at one lane: of
 * shapes with any ends, and of angle cones
 *
 * Signs decide the feature as in exact_distance.c: those of the foot on the lateral
 * line from its ends, then for each cap that is present those of the point against
 * its circle and of the distance found against that from its plane.  Signs of 0 are
 * certain, too, of shapes along an axis of coordinates and in the centres of balls.
 *
 * The distance is that from the side of the feature that is outside a solid.  Where
 * the surface does not enclose a solid, write_certain() (one_distance.c) takes the
 * absolute value.
 */
#ifndef CYLINT_FIND_NEAREST_H
#define CYLINT_FIND_NEAREST_H

#include "nearest.h"
#include "pair_lanes.h"

/* The numbers of an angle cone in the caller's unit of length: the unit of its
 * local coordinates is the length of its axis.  Its top is a sum of two doubles. */
static void load_angle_cone(shape_lanes *s, const cylint_shape *shape)
{
    const cylint_shape *const at[1] = {shape};
    vpair squares[3], inverse;
    pairs_load_shapes(s, at);
    EACH(i, 3) {
        s->axis[i] = (vpair){cylint_axis(shape)[i], 0};
        squares[i] = vpair_square(s->axis[i]);
    }
    s->height = pairs_trimmed(pairs_root(pairs_sum3(squares), &inverse));
    EACH(i, 3) {
        const vpair top = v_two_sum(s->base[i], s->axis[i].hi);
        s->top[i] = top.hi;
        s->top_low[i] = top.lo;
        s->axis[i] = pairs_trimmed(vpair_product(s->axis[i], inverse));
    }
    s->r[1] =
        pairs_trimmed(vpair_product(s->height, (vpair){cylint_r1(shape), 0}));
    /* mutant '*' -> '+': slower, the errors of small shapes are larger */
    s->reach = (s->height.hi + s->r[1].hi) * CYLINT_SLACK;
}

/* Whether at most one of the three is not 0: then its size is their length. */
static int is_one_number(const pair x[3])
{
    int zeros = 0;
    EACH(i, 3)
        zeros += x[i].hi == 0;
    return zeros > 1;
}

static pair size_of(pair x)
{
    return rounded(x) < 0 ? opposite(x) : x;
}

/* Of a shape whose axis runs along a coordinate and whose ends are made of
 * doubles: z and above, which have no error, and rho where it has none. */
static void load_upright(half_plane *m, const shape_lanes *s, const double x[3])
{
    EACH(i, 3)
        if (s->own[i]) {
            const pair D = m->D[i], D1 = two_diff(x[i], s->top[i]);
            const int down = s->axis[i].hi < 0;
            m->z = down ? opposite(D) : D;
            m->above = down ? opposite(D1) : D1;
        }
    m->plane_error = 0;
    m->rho_is_exact = is_one_number(m->across);
    if (m->rho_is_exact)
        m->rho = size_of(pairs_sum3(m->across));
}

/* ---------------------------------------------------------------- signs -- */

/* The sign of x, or CYLINT_SIGN_UNDECIDED. */
static int sign_within(pair x, double error)
{
    const double v = rounded(x);
    return v > error                    ? 1
           : v < -error                 ? -1
           : fabs(v) <= 0 && error <= 0 ? 0
                                        : CYLINT_SIGN_UNDECIDED;
}

/* 1 where the point's foot on the lateral line is beyond the end of it, 0 where it
 * is that end, -1 before it: at the top the sign of cosine z + sine across, at the
 * base the opposite, with z and `across` from the rim or from the centre of a ball.
 * In that centre it is 0. */
ASIDE int sign_of_foot(const half_plane *m, const shape_lanes *s,
                       const cylint_shape *shape, const double point[3],
                       int end, pair across)
{
    const int round = cylint_is_round(shape->kind);
    const double u = CYLINT_POINT_ROUNDING, sine = fabs(s->sine.hi);
    const double least = 0x1p-500; /* covers squares that underflow */
    double error = m->plane_error;
    pair z = end ? m->above : m->z;
    if (round && cylint_are_equal(point, end ? s->top : s->base))
        return 0;
    if (error > 0 && fabs(rounded(z)) <= error &&
        cylint_side_of(shape, point, end) == 0) {
        z = (pair){0, 0};
        error = 0;
    }
    const pair x = vpair_product(s->cosine, z),
               y = vpair_product(s->sine, across), foot = vpair_add(x, y);
    error = s->cosine.hi * error + sine * m->rho_error +
            2 * u * (fabs(x.hi) + sine * (m->rho.hi + s->r[end].hi)) +
            (sine > 0 ? least : 0);
    return sign_within(end ? foot : opposite(foot), error);
}

/* ------------------------------------------------------------- distances -- */

/* Writes root - r as the distance, where neither rho nor this number, a pair, has
 * an error. */
static void without_error(vnearest *n, const half_plane *m, pair root, pair r)
{
    const double low = two_sum(root.hi, -r.hi).lo;
    if (m->rho_is_exact && fabs(two_sum(low, root.lo).lo) <= 0)
        n->d = pairs_rounded(vpair_sub(root, r), 0);
}

/* Writes the cap at the end `top` if it is nearer than the feature found.  plane:
 * the signed distance from its plane.  x: rho minus its radius. */
INLINE void compare_with_cap(vnearest *n, const half_plane *m, pair plane,
                             pair x, int top)
{
    const double M = margin_of(m), across = rounded(x);
    const double difference = fabs(rounded(n->d.value)) - fabs(rounded(plane));
    if (across > M || difference < -M)
        return;
    if (across < -M && difference > M) {
        n->certain = 1;
    } else {
        const double by_foot = n->certain ? 0 : 4 * m->error;
        const int within = sign_within(x, m->rho_is_exact ? 0 : m->error),
                  less = sign_within(
                      vpair_sub(size_of(n->d.value), size_of(plane)),
                      n->d.error + m->plane_error + by_foot);
        if (within == 0 || within == 1 || less == 0 || less == -1)
            return;
        n->certain = within == -1 && less == 1;
    }
    n->feature = CYLINT_FEATURE_CAP0 + top;
    n->d = pairs_rounded(plane, m->plane_error);
}

/* The feature and the distance, apart from flat caps.  foot: whether the foot on
 * the lateral line is beyond its end `end` (1), at it (0) or within the line (-1).
 * Where it is at the end or undecided, both formulas give the same distance.
 * Numbers are trimmed before they are squared: near a rim or a centre their terms
 * cancel. */
INLINE void nearest_without_planes(vnearest *n, const half_plane *m,
                                   const shape_lanes *s, const pair x[2],
                                   int kind, int end, int foot, int has_cap)
{
    const int round = cylint_is_round(kind), is_beyond = foot == 1;
    const pair rho = m->rho, z[2] = {m->z, m->above};
    const pair r = s->r[end], y = pairs_trimmed(z[end]);
    if (foot < 0 || (round && !is_beyond)) {
        const pair line = round ? vpair_sub(pairs_turned(s, rho, m->z), s->r[0])
                                : pairs_turned(s, x[0], m->z);
        n->d = pairs_rounded(line, m->error);
        n->feature = CYLINT_FEATURE_LATERAL;
        if (!cylint_is_tapered(kind))
            without_error(n, m, rho, r);
    } else if (round && has_cap) {
        n->d = pairs_rounded(pairs_from_ball(y, 0, r, m).v, m->error);
        n->feature = CYLINT_FEATURE_CAP0 + end;
        if (rho.hi == 0)
            without_error(n, m, size_of(y), r);
    } else {
        pair across = x[end], along = y;
        if (round) {
            across = vpair_sub(rho, vpair_product(s->cosine, r));
            along = vpair_add(y, vpair_product(s->sine, r));
        }
        n->d = pairs_rounded(
            pairs_length(pairs_trimmed(across), pairs_trimmed(along), m).v,
            m->error);
        n->feature = CYLINT_FEATURE_RIM0 + end;
        if (!round && y.hi == 0)
            without_error(n, m, rho, r);
    }
    if (foot == 0 || foot == CYLINT_SIGN_UNDECIDED)
        n->feature = CYLINT_FEATURE_RIM0 + end;
}

/* Of a shape between two planes or with two balls. */
ASIDE void nearest_to_bounded(vnearest *n, half_plane *m, const shape_lanes *s,
                              const double point[3], const cylint_shape *shape,
                              int kind)
{
    const unsigned caps = cylint_caps_present(shape->ends);
    const int round = cylint_is_round(kind);
    const double C = s->cosine.hi, S = s->sine.hi;
    pair x[2];
    pairs_load_rho(m);
    m->plane_error = CYLINT_PAIR_DISTANCE * m->size + m->z_error;
    m->rho_is_exact = 0;
    if (s->along && cylint_has_end_points(shape->kind))
        load_upright(m, s, point);
    for (int k = 0; k < 2; k++)
        x[k] = round ? m->rho : vpair_sub(m->rho, s->r[k]);
    const double M = margin_of(m);
    double before = -rounded(m->z), after = rounded(m->above);
    const double t = after - before;
    if (cylint_is_tapered(kind)) {
        before = C * before - S * rounded(x[0]);
        after = C * after + S * rounded(x[1]);
    }
    const int end = after > before;
    int foot = 2 * ((before > 0) | (after > 0)) - 1;
    n->certain = 1;
    if (!((fabs(before) > M) & (fabs(after) > M))) {
        foot = sign_of_foot(m, s, shape, point, end, x[end]);
        /* A line that is not longer than the margin can begin and end here. */
        n->certain = foot != CYLINT_SIGN_UNDECIDED && before + after < -4 * M;
    }
    nearest_without_planes(n, m, s, x, kind, end, foot, caps >> end & 1);
    if (round || !caps)
        return;
    /* Both caps can be nearest only to points near the middle. */
    const int top = caps == 3 ? t > M : caps == 2;
    compare_with_cap(n, m, top ? m->above : opposite(m->z), x[top], top);
    if (caps == 3 && fabs(t) <= M)
        compare_with_cap(n, m, m->above, x[1], 1);
}

/* Of an unbounded shape.  Beyond the apex of a double cone its other nappe is
 * nearest: *s then gets the numbers of that one.  Beyond that of a nappe the apex
 * is: this decides it where the apex is an end. */
static void nearest_to_unbounded(vnearest *n, half_plane *m, shape_lanes *s,
                                 int kind, int is_nappe)
{
    pairs_load_rho(m);
    const vpair rho = m->rho;
    const int end = s->r[1].hi == 0;
    const double C = s->cosine.hi, S = s->sine.hi, M = margin_of(m);
    const double c = C * s->r[0].hi + S * rounded(m->z),
                 foot = is_nappe ? C * c + S * S * rounded(rho) : fabs(c);
    if (cylint_is_tapered(kind))
        n->certain = foot > M;
    if (foot < -M && s->r[end].hi == 0) {
        n->certain = 1;
        n->feature = CYLINT_FEATURE_RIM0 + end;
        n->d = pairs_rounded(
            pairs_length(rho, pairs_trimmed(end ? m->above : m->z), m).v,
            m->error);
        return;
    }
    if (cylint_is_tapered(kind) && !is_nappe && c < 0) {
        s->sine = opposite(s->sine);
        s->r[0] = opposite(s->r[0]);
    }
    n->d =
        pairs_rounded(pairs_turned(s, vpair_sub(rho, s->r[0]), m->z), m->error);
}

static void nearest_to_sphere(vnearest *n, half_plane *m, const shape_lanes *s)
{
    pairs_load_rho(m);
    n->d = pairs_rounded(vpair_sub(m->rho, s->r[0]), m->error);
    if (n->d.high <= n->d.low)
        return;
    m->rho_is_exact = is_one_number(m->D);
    without_error(n, m, size_of(pairs_sum3(m->D)), s->r[0]);
}

/* Of a shape of any kind and ends; the kind of an angle cone is that of a cone. */
INLINE void find_nearest_in_pairs(vnearest *n, half_plane *m, shape_lanes *s,
                                  const double point[3],
                                  const cylint_shape *shape, int kind,
                                  int tangent)
{
    const cylint_shape *const at[1] = {shape};
    if (tangent)
        load_angle_cone(s, shape);
    else
        pairs_load_shapes(s, at);
    pairs_load(m, s, point, kind != CYLINT_KIND_SPHERE);
    *n = (vnearest){{{0, 0}, 0, 0, 0}, CYLINT_FEATURE_LATERAL, 1};
    if (kind == CYLINT_KIND_SPHERE)
        nearest_to_sphere(n, m, s);
    else if (cylint_ends_are_planes(shape->ends))
        nearest_to_bounded(n, m, s, point, shape, kind);
    else
        nearest_to_unbounded(n, m, s, kind, shape->ends == CYLINT_ENDS_NAPPE);
    if (!n->certain) /* another feature can be much nearer */
        n->d = pairs_rounded(n->d.value, HUGE_VAL);
}

#endif
