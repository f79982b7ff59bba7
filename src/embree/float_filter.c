/*
 * float_filter.c - hits of float rays in doubles, one question at a time
 *
 * Compiled once as it is and again for processors with fused multiply-add.
 */
#include "../shapes/measure.h"

#define CYLINT_ONE_LANE
#include "float_filter_lanes.h"
#include "float_filter_dots.h"
#include "float_filter_round.h"

static cylint_float_filter_result result_of(hit_result v)
{
    return v.hit         ? CYLINT_FLOAT_FILTER_HIT
           : v.uncertain ? CYLINT_FLOAT_FILTER_UNCERTAIN
                         : CYLINT_FLOAT_FILTER_MISS;
}

CYLINT_INLINE void find_least(const question *q, const cylint_shape *whole,
                              int least[3])
{
    if (!least_components(q, least)) {
        const double *top = cylint_top(whole), *base = cylint_base(whole);
        double hi[3], lo[3];
        for (int j = 0; j < 3; j++) {
            const pair w = cylint_has_end_points(whole->kind)
                               ? two_diff(top[j], base[j])
                               : (pair){cylint_axis(whole)[j], 0};
            hi[j] = w.hi;
            lo[j] = w.lo;
        }
        const int first = cylint_least_component(hi, lo);
        for (int j = 0; j < 3; j++)
            least[j] = j == first;
    }
}

CYLINT_INLINE int describe_round_lanes(const question *q, const hit *at,
                                       const int least[3], floats *to)
{
    double across[3], e[3];
    int certain = to_float(at->z, at->z_error, &to->z);
    if (at->round == 2) {
        to->phi = 0;
    } else {
        const int j = least[1] ? 1 : least[2] ? 2 : 0;
        lateral_direction(q, at, across, e);
        certain &= describe_phi(q, at, across[j], at->c[j], &to->phi);
    }
    return certain & unit_floats(&at->normal, to->normal);
}

CYLINT_INLINE int write_description(const question *q,
                                    const cylint_shape *whole, const hit *at,
                                    cylint_hit_floats *to)
{
    int least[3];
    floats f;
    find_least(q, whole, least);
    if (!(at->round ? describe_round_lanes(q, at, least, &f)
                    : describe_lanes(q, at, least, &f)))
        return 0;
    *to = (cylint_hit_floats){
        (float)f.z,
        (float)f.phi,
        {(float)f.normal[0], (float)f.normal[1], (float)f.normal[2]}};
    return 1;
}

/* Whether the piece contains the hit; *certain: whether that is certain. */
CYLINT_INLINE int is_on_piece(const axial_hit *at,
                              const cylint_float_filter_limits *limits,
                              int *certain)
{
    if (limits->count == 1)
        return *certain = 1;
    const int low = cylint_piece_at(at->z - at->z_error, limits->count);
    const int high = cylint_piece_at(at->z + at->z_error, limits->count);
    *certain = low == high;
    return low == limits->index;
}

/* HIT: the hit counts; MISS: it does not, but the next may. */
CYLINT_INLINE cylint_float_filter_result
accept(const axial_hit *at, const hit *h, const question *q, int ends,
       double tmin, const cylint_float_filter_limits *limits, float *to)
{
    const double t = q->from + at->s, e = at->s_error + 0x1p-50 * fabs(t);
    int certain;
    if (t + e < tmin ||
        (h->capped && !(cylint_caps_present(ends) >> h->top & 1)))
        return CYLINT_FLOAT_FILTER_MISS;
    *to = cylint_float_above(t);
    if (!(t - e > tmin && cylint_is_float_above(*to, t, e)))
        return CYLINT_FLOAT_FILTER_UNCERTAIN;
    if (*to > limits->tfar)
        return CYLINT_FLOAT_FILTER_MISS;
    const int on_piece = is_on_piece(at, limits, &certain);
    return !certain || (on_piece && *to >= limits->tfar)
               ? CYLINT_FLOAT_FILTER_UNCERTAIN
           : on_piece ? CYLINT_FLOAT_FILTER_HIT
                      : CYLINT_FLOAT_FILTER_MISS;
}

/* A question about a sphere, capsule or rounded cone. */
static cylint_float_filter_result nearest_round(
    const cylint_float_filter_target *target, const cylint_float_filter_ray *l,
    const shape_columns *shape, const line_columns *line,
    const cylint_float_filter_limits *limits, cylint_float_filter_nearest *to)
{
    round_dots x;
    question q;
    hit h;
    axial_hit at;
    cylint_float_filter_result is = CYLINT_FLOAT_FILTER_MISS;
    if (!load_round(&x, &q, shape, line))
        return CYLINT_FLOAT_FILTER_UNCERTAIN;
    if (!x.is_ball)
        cross_cone(&x, &q);
    for (int i = 0; i < 2 && is == CYLINT_FLOAT_FILTER_MISS; i++) {
        is = round_end(&x, &q, i ? 1 : -1, &h, &at);
        if (is != CYLINT_FLOAT_FILTER_HIT)
            return is;
        is = accept(&at, &h, &q, target->ends, l->tmin, limits, &to->t);
        if (is == CYLINT_FLOAT_FILTER_UNCERTAIN) {
            step_on_round(&x, &q, i ? 1 : -1, &h, &at);
            is = accept(&at, &h, &q, target->ends, l->tmin, limits, &to->t);
        }
        to->leaves = i;
    }
    if (is != CYLINT_FLOAT_FILTER_HIT || !limits->describes)
        return is;
    describe_round(&x, &q, to->leaves ? 1 : -1, &at, &h);
    return write_description(&q, target->whole, &h, &to->floats)
               ? CYLINT_FLOAT_FILTER_HIT
               : CYLINT_FLOAT_FILTER_UNCERTAIN;
}

static cylint_float_filter_result nearest(
    const cylint_float_filter_target *target, const cylint_float_filter_ray *l,
    const cylint_float_filter_limits *limits, cylint_float_filter_nearest *to)
{
    const char *const shape_row = target->shape;
    const char *const line_row = (const char *)l;
    const shape_columns shape = shape_of(&shape_row, target->small);
    const line_columns line = line_of(&line_row);
    dots x;
    question q;
    hit h;
    axial_hit at;
    if (is_round(&shape))
        return nearest_round(target, l, &shape, &line, limits, to);
    h.round = 0;
    load_dots(&x, &q, &shape, &line);
    cylint_float_filter_result is = cross_by_dots(&x, &q);
    if (is != CYLINT_FLOAT_FILTER_HIT)
        return is;
    for (int i = 0; i < 2; i++) {
        is = end_by_dots(&x, &q, i ? 1 : -1, &h, &at);
        if (is != CYLINT_FLOAT_FILTER_HIT)
            return is;
        is = accept(&at, &h, &q, target->ends, l->tmin, limits, &to->t);
        if (is == CYLINT_FLOAT_FILTER_UNCERTAIN && !h.capped) {
            step_on_cone(&x, &q, 1, i ? 1 : -1, &at);
            is = accept(&at, &h, &q, target->ends, l->tmin, limits, &to->t);
        }
        to->leaves = i;
        if (is != CYLINT_FLOAT_FILTER_MISS)
            break;
    }
    if (is != CYLINT_FLOAT_FILTER_HIT || !limits->describes)
        return is;
    if (!h.capped && needs_step(&q, q.r0 + fabs(q.dr), &at, 0x1p-33))
        step_on_cone(&x, &q, 1, to->leaves ? 1 : -1, &at);
    describe_by_dots(&x, &q, &at, &h);
    return write_description(&q, target->whole, &h, &to->floats)
               ? CYLINT_FLOAT_FILTER_HIT
               : CYLINT_FLOAT_FILTER_UNCERTAIN;
}

/* HIT: the chord begins or ends (sign = 1) at t >= tmin on a part that is
 * present. */
static cylint_float_filter_result test_round(round_dots *x, const question *q,
                                             int ends, double sign, hit *h)
{
    axial_hit at;
    const cylint_float_filter_result is = round_end(x, q, sign, h, &at);
    if (is != CYLINT_FLOAT_FILTER_HIT)
        return is;
    h->s = at.s;
    h->t = q->from + at.s;
    h->t_error = at.s_error + 0x1p-50 * fabs(h->t);
    if (h->t + h->t_error < q->tmin ||
        (h->capped && !(cylint_caps_present(ends) >> h->top & 1)))
        return CYLINT_FLOAT_FILTER_MISS;
    describe_round(x, q, sign, &at, h);
    return h->t - h->t_error > q->tmin ? CYLINT_FLOAT_FILTER_HIT
                                       : CYLINT_FLOAT_FILTER_UNCERTAIN;
}

static cylint_float_filter_result test_round_entry(question *q, int ends,
                                                   const shape_columns *shape,
                                                   const line_columns *line,
                                                   hit *at)
{
    round_dots x;
    q->tmin = line->tmin;
    if (!load_round(&x, q, shape, line))
        return CYLINT_FLOAT_FILTER_UNCERTAIN;
    if (!x.is_ball)
        cross_cone(&x, q);
    const cylint_float_filter_result is = test_round(&x, q, ends, -1, at);
    q->exit = is == CYLINT_FLOAT_FILTER_UNCERTAIN
                  ? is
                  : test_round(&x, q, ends, 1, &q->exit_hit);
    return is;
}

static cylint_float_filter_result test_entry(
    cylint_float_filter_state *q, const cylint_float_filter_target *target,
    const cylint_float_filter_ray *l, cylint_float_filter_hit *at)
{
    const char *const shape_row = target->shape;
    const char *const line_row = (const char *)l;
    const shape_columns shape = shape_of(&shape_row, target->small);
    const line_columns line = line_of(&line_row);
    q->whole = target->whole;
    q->round = is_round(&shape);
    if (q->round)
        return test_round_entry(q, target->ends, &shape, &line, at);
    at->round = q->exit_hit.round = 0;
    const unsigned caps = cylint_caps_present(target->ends);
    q->cap[0] = (int)(caps & 1);
    q->cap[1] = (int)(caps >> 1);
    const hit_result is = load_and_cross(q, &shape, &line);
    return result_of(is.hit ? hit_at_end(q, 0, at) : is);
}

static cylint_float_filter_result test_exit(const cylint_float_filter_state *q,
                                            cylint_float_filter_hit *at)
{
    if (q->round) {
        *at = q->exit_hit;
        return (cylint_float_filter_result)q->exit;
    }
    at->round = 0;
    return q->crosses ? result_of(hit_at_end(q, 1, at))
                      : CYLINT_FLOAT_FILTER_MISS;
}

static int describe(const cylint_float_filter_state *q,
                    const cylint_float_filter_hit *at, cylint_hit_floats *to)
{
    return write_description(q, q->whole, at, to);
}

/* --------------------------------------------------------------- builds -- */

#ifndef CYLINT_FLOAT_FILTER
#define CYLINT_FLOAT_FILTER cylint_float_filter_plain

/* The sign of the radii in a record; 0: the filter does not decide. */
static int radii_sign(const cylint_shape *s)
{
    if (!cylint_is_bounded(s) || cylint_is_elliptic(s->kind))
        return 0;
    if (!cylint_is_round(s->kind))
        return 1;
    return cylint_is_hull(s->kind) ||
                   (cylint_has_no_axis(s) && s->ends == CYLINT_ENDS_CAPPED)
               ? -1
               : 0;
}

void cylint_float_filter_shape_of(cylint_float_filter_shape *to,
                                  const cylint_shape *s)
{
    const int sign = radii_sign(s);
    const double length = sqrt(dot(cylint_axis(s), cylint_axis(s)));
    EACH(j, 3) {
        to->base[j] = cylint_base(s)[j];
        to->axis[j] = cylint_axis(s)[j] + 0; /* no -0 */
    }
    to->r0 = sign ? sign * cylint_r0(s) : 1;
    to->dr = sign ? sign * (cylint_r1(s) - cylint_r0(s)) *
                            cylint_radius_unit(s, length) +
                        0
                  : -2;
}

/* Whether x is a float and not subnormal. */
static int is_float(double x, float *to)
{
    *to = (float)x;
    return (double)*to == x &&
           (fabs(x) >= (double)FLT_MIN || cylint_sign(x) == 0);
}

int cylint_float_filter_small_of(cylint_float_filter_small *to,
                                 const cylint_shape *s)
{
    const int sign = radii_sign(s);
    int is = sign != 0 && cylint_has_end_points(s->kind);
    EACH(j, 3)
        is &= is_float(cylint_base(s)[j], &to->base[j]) &
              is_float(cylint_top(s)[j], &to->top[j]) &
              ((double)to->top[j] - (double)to->base[j] == cylint_axis(s)[j]);
    is = is & is_float(cylint_r0(s), &to->r0) &
         is_float(cylint_r1(s), &to->r1) &
         ((double)to->r1 - (double)to->r0 == cylint_r1(s) - cylint_r0(s));
    to->r0 *= (float)sign;
    to->r1 *= (float)sign;
    return is;
}

#endif

const cylint_float_filter CYLINT_FLOAT_FILTER = {nearest, test_entry, test_exit,
                                                 describe};
