/*
 * float_filter.c - a hit in doubles, where doubles are certain of it: one question
 *
 * Compiled once as it is and again where the processor has fused multiply-add.
 */
#include "../numbers/bits.h"

#define CYLINT_ONE_LANE
#include "float_filter_lanes.h"

static cylint_quick_verdict told(verdict v)
{
    return v.hit      ? CYLINT_QUICK_HIT
           : v.unsure ? CYLINT_QUICK_UNSURE
                      : CYLINT_QUICK_MISS;
}

static cylint_quick_verdict enter(cylint_quick *q,
                                  const cylint_quick_subject *subject,
                                  const cylint_quick_line *l,
                                  cylint_quick_hit *at)
{
    const char *const shape_row = subject->shape;
    const char *const line_row = (const char *)l;
    const cut_shape shape = shape_of(&shape_row, subject->small);
    const cut_line line = line_of(&line_row);
    q->whole = subject->whole;
    q->cap[0] = cylint_quick_has_cap(subject->ends, 0);
    q->cap[1] = cylint_quick_has_cap(subject->ends, 1);
    const verdict is = crosses(q, &shape, &line);
    return told(is.hit ? stop(q, 0, at) : is);
}

static cylint_quick_verdict leave(const cylint_quick *q, cylint_quick_hit *at)
{
    return q->crosses ? told(stop(q, 1, at)) : CYLINT_QUICK_MISS;
}

/* Whether |w[i]| < |w[j]|, which are equal but for their low parts. */
static int is_lower(const cylint_shape *s, int i, int j)
{
    return s->axis_lo[i] * copysign(1, s->axis[i]) <
           s->axis_lo[j] * copysign(1, s->axis[j]);
}

/* The first coordinate along which the axis is least, doubles being tied. */
static int least_in_full(const cylint_shape *s)
{
    const double *w = s->axis;
    const double least =
        cylint_smaller(fabs(w[0]), cylint_smaller(fabs(w[1]), fabs(w[2])));
    int first = 2;
    for (int j = 1; j >= 0; j--)
        if (fabs(w[j]) <= least &&
            (fabs(w[first]) > least || !is_lower(s, first, j)))
            first = j;
    return first;
}

static int describe(const cylint_quick *q, const cylint_quick_hit *at,
                    cylint_quick_floats *to)
{
    int least[3];
    floats f;
    if (!least_components(q, least)) {
        const int first = least_in_full(q->whole);
        for (int j = 0; j < 3; j++)
            least[j] = j == first;
    }
    if (!describe_lanes(q, at, least, &f))
        return 0;
    *to = (cylint_quick_floats){
        (float)f.z,
        (float)f.phi,
        {(float)f.normal[0], (float)f.normal[1], (float)f.normal[2]}};
    return 1;
}

/* --------------------------------------------------------------- builds -- */

#ifndef CYLINT_QUICK
#define CYLINT_QUICK cylint_quick_plain

void cylint_quick_shape_of(cylint_quick_shape *to, const cylint_shape *s)
{
    EACH(j, 3) {
        to->base[j] = s->base[j];
        to->axis[j] = s->axis[j];
    }
    to->r0 = s->kind > CYLINT_KIND_ACONE ? -1 : s->r0;
    to->dr = s->kind > CYLINT_KIND_ACONE ? 0
             : s->kind == CYLINT_KIND_ACONE
                 ? s->dr * sqrt(dot(s->axis, s->axis))
                 : s->dr;
}

/* Zero by the bits: a thread may take a subnormal number for it. */
static int is_float(double x, float *to)
{
    *to = (float)x;
    return (double)*to == x &&
           (fabs(x) >= (double)FLT_MIN || cylint_sign(x) == 0);
}

int cylint_quick_small_of(cylint_quick_small *to, const cylint_shape *s)
{
    int is = s->kind == CYLINT_KIND_CYLINDER || s->kind == CYLINT_KIND_CONE;
    EACH(j, 3)
        is &= is_float(s->base[j], &to->base[j]) &
              is_float(s->top[j], &to->top[j]) &
              ((double)to->top[j] - (double)to->base[j] == s->axis[j]);
    return is & is_float(s->r0, &to->r0) & is_float(s->r1, &to->r1) &
           ((double)to->r1 - (double)to->r0 == s->dr);
}

#endif

const cylint_quick_build CYLINT_QUICK = {enter, leave, describe};
