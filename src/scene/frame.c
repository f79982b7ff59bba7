/*
 * frame.c - the coordinates of a scene's hierarchy
 */
#include "../numbers/bits.h"
#include "frame.h"

/* Multiples of 2^-50 of the largest coordinate have exact means and differences. */
void cylint_frame_round_box(double lo[3], double hi[3])
{
    int e;
    frexp(fmax(cylint_largest(lo), cylint_largest(hi)), &e);
    for (int j = 0; j < 3; j++) {
        lo[j] = ldexp(floor(ldexp(lo[j], 50 - e)), e - 50);
        hi[j] = ldexp(ceil(ldexp(hi[j], 50 - e)), e - 50);
    }
}

int cylint_frame_make(cylint_frame *frame, const double lo[3],
                      const double hi[3])
{
    double half[3];
    int e, is_box = 1;
    for (int j = 0; j < 3; j++) {
        is_box &= lo[j] <= hi[j]; /* false for NaN, from a file */
        frame->lo[j] = lo[j];
        frame->hi[j] = hi[j];
        const double c = frame->view.center[j] = lo[j] / 2 + hi[j] / 2;
        half[j] = fmax(hi[j] - c, c - lo[j]);
    }
    const double size = cylint_largest(half);
    if (!is_box || !(cylint_largest(lo) <= CYLINT_BOX_MOST) ||
        !(cylint_largest(hi) <= CYLINT_BOX_MOST) ||
        !(size >= CYLINT_FRAME_LEAST))
        return 0;
    frexp(size, &e);
    frame->view.scale = ldexp(1, -e);
    frame->view.line_error = CYLINT_FRAME_ERROR;
    return 1;
}

/* Whether a component of d is so small beside its size that clip() would divide
 * a number that may be flushed to zero by it. */
static int is_too_oblique(const double d[3], double size)
{
    int is = 0;
    for (int j = 0; j < 3; j++)
        is |= fabs(d[j]) < 0x1p-500 * size && cylint_sign(d[j]) != 0;
    return is;
}

/* Clips the line's domain to the frame's box.  A quotient has an error of less
 * than 2^-51 of itself, with the error of a segment's direction.  A number
 * flushed to zero adds less than 2^-1020 / |d[j]|, which the slack covers; the
 * slack moves a point by less than 2^-499. */
static void clip(const cylint_frame *f, const cylint_line *line, double size,
                 double *from, double *to)
{
    const double slack = 0x1p-500 / size;
    *from = line->tmin;
    *to = line->tmax;
    for (int j = 0; j < 3; j++) {
        const int up = line->d[j] > 0;
        double first = ((up ? f->lo[j] : f->hi[j]) - line->o[j]) / line->d[j];
        double last = ((up ? f->hi[j] : f->lo[j]) - line->o[j]) / line->d[j];
        first -= fabs(first) * 0x1p-50 + slack;
        last += fabs(last) * 0x1p-50 + slack;
        if (line->d[j] == 0) { /* no limit from this coordinate */
            if (line->o[j] < f->lo[j] || line->o[j] > f->hi[j])
                *to = -HUGE_VAL;
            continue;
        }
        *from = first > *from ? first : *from;
        *to = last < *to ? last : *to;
    }
}

/*
 * Let e be the start of the clipped domain.  The ray begins at
 *
 *     (o - center + e d) scale,   in pairs,
 *
 * with an error of less than 2^-102 of |o - center| + |e d| (error_bounds.h):
 * 2^-52 of the frame if these are at most 2^50 of it.  The last rounding adds as
 * much: in all less than 2^-50 = CYLINT_FRAME_ERROR.  The direction has an error
 * of 2^-52 besides, for which the traversal allows.
 *
 * e is early by 2^-50 of itself, so a line from very far would begin far outside
 * the box: the limits on o and length reject it.
 */
cylint_frame_status cylint_frame_line(const cylint_frame *frame,
                                      const cylint_line *line,
                                      cylint_frame_ray *ray)
{
    double to;
    if (!line->valid)
        return CYLINT_FRAME_MISSED;
    const double size = cylint_largest(line->d);
    if (!(size <= CYLINT_BOX_MOST) || !(size >= CYLINT_FRAME_LEAST) ||
        !(cylint_largest(line->o) <= CYLINT_BOX_MOST) ||
        is_too_oblique(line->d, size) || !cylint_rounds_to_nearest())
        return CYLINT_FRAME_UNUSABLE;
    clip(frame, line, size, &ray->entry, &to);
    if (ray->entry > to)
        return CYLINT_FRAME_MISSED;
    ray->per_t = size * frame->view.scale;
    for (int j = 0; j < 3; j++) {
        const pair from = two_diff(line->o[j], frame->view.center[j]);
        pair step = two_prod(ray->entry, line->d[j]);
        step.lo += ray->entry * line->d_lo[j];
        ray->line.o[j] = pair_add(from, step).hi * frame->view.scale;
        ray->line.d[j] = line->d[j] / size;
        const double far = (fabs(from.hi) + fabs(step.hi)) * frame->view.scale;
        if (!(fabs(ray->line.o[j]) < 2) || !(far <= 0x1p50))
            return CYLINT_FRAME_UNUSABLE;
    }
    ray->line.tmin = 0;
    ray->line.tmax = cylint_frame_reach(ray, to);
    return ray->line.tmax <= 2.5 ? CYLINT_FRAME_ENTERED : CYLINT_FRAME_UNUSABLE;
}

/* A root that rounds to t or less is less than the double after t.  The difference
 * and the products have errors of less than 2^-51 of s. */
double cylint_frame_reach(const cylint_frame_ray *ray, double t)
{
    const double s = (cylint_next_above(t) - ray->entry) * ray->per_t;
    return s + fabs(s) * 0x1p-50;
}
