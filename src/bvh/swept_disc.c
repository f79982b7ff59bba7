/*
 * swept_disc.c - bounded shapes as swept discs, and the boxes of their pieces
 */
#include "swept_disc.h"

static double dot(const double x[3], const double y[3])
{
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/* The points x a + y b, x^2 + y^2 <= 1, reach sqrt((a.v)^2 + (b.v)^2) along a
 * unit vector v.  Across the axis they reach the square root of the larger
 * eigenvalue of the Gram matrix of the components of a and b across it. */
static void set_elliptic_reach(cylint_swept_disc *t, double ww)
{
    double a[3], b[3];
    const double aw = dot(t->a, t->axis), bw = dot(t->b, t->axis);
    t->across = t->along = sqrt(dot(t->a, t->a) + dot(t->b, t->b));
    if (!(ww > CYLINT_LEAST_SQUARE))
        return;
    t->along = sqrt((aw * aw + bw * bw) / ww);
    for (int j = 0; j < 3; j++) {
        a[j] = t->a[j] - aw / ww * t->axis[j];
        b[j] = t->b[j] - bw / ww * t->axis[j];
    }
    const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b);
    const double difference = aa - bb;
    t->across =
        sqrt((aa + bb + sqrt(difference * difference + 4 * ab * ab)) / 2);
}

/* A single ball: its centre moves by a small part of its radius, because a leaf
 * needs the direction of an axis. */
static void set_one_ball(cylint_swept_disc *t)
{
    t->k[1] = t->k[0];
    t->axis[0] = t->k[0] * 0x1p-10;
    t->axis[1] = t->axis[2] = 0;
    t->length = t->axis[0];
    t->shift = 0;
}

void cylint_swept_disc_of(cylint_swept_disc *t, const cylint_view *view,
                          uint32_t number)
{
    const cylint_shape *s = view->shapes + number;
    const double scale = view->scale;
    for (int j = 0; j < 3; j++) {
        t->base[j] = (s->base[j] - view->center[j]) * scale;
        t->axis[j] = s->axis[j] * scale;
    }
    const double ww = dot(t->axis, t->axis);
    t->length = sqrt(ww);
    t->elliptic = cylint_is_elliptic(s->kind);
    const double unit = t->elliptic                   ? 1
                        : cylint_has_factors(s->kind) ? t->length
                                                      : scale;
    t->k[0] = s->r0 * unit;
    t->k[1] = s->r1 * unit;
    t->across = 1;
    t->round = cylint_is_round(s->kind);
    t->along = t->round ? 1 : 0;
    t->shift = t->round ? cylint_section_shift(t->k[0], t->k[1], ww) : 0;
    if (s->kind == CYLINT_KIND_SPHERE)
        set_one_ball(t);
    if (!t->elliptic)
        return;
    for (int j = 0; j < 3; j++) {
        t->a[j] = s->a[j] * scale;
        t->b[j] = s->b[j] * scale;
    }
    set_elliptic_reach(t, ww);
}

/* A disc perpendicular to the axis w reaches sqrt(1 - w_j^2 / ww) of its
 * radius along coordinate j, computed here without the difference.  Where
 * squares underflow, the result is 1. */
void cylint_swept_disc_reach(const cylint_swept_disc *t, double reach[3])
{
    double square[3];
    for (int j = 0; j < 3; j++)
        square[j] = t->axis[j] * t->axis[j];
    const double ww = square[0] + square[1] + square[2];
    const double per_length = 1 / t->length;
    for (int j = 0; j < 3; j++)
        reach[j] =
            t->elliptic ? cylint_elliptic_reach(t->a, t->b, j)
            : ww > CYLINT_LEAST_SQUARE && !t->round
                ? sqrt(square[(j + 1) % 3] + square[(j + 2) % 3]) * per_length
                : 1;
}

cylint_packed_disc cylint_packed_disc_of(const cylint_swept_disc *t,
                                         const cylint_shape *shape,
                                         uint32_t number)
{
    return (cylint_packed_disc){{t->base[0], t->base[1], t->base[2]},
                                {t->axis[0], t->axis[1], t->axis[2]},
                                {cylint_float_above(t->k[0] * t->across),
                                 cylint_float_above(t->k[1] * t->across)},
                                cylint_half_above(t->along / t->across),
                                (uint8_t)shape->ends,
                                shape->kind == CYLINT_KIND_CYLINDER &&
                                    shape->ends == CYLINT_ENDS_CAPPED,
                                number};
}

void cylint_piece_ends(cylint_piece piece, double shift, double z[2])
{
    const double overlap = 0x1p-20;
    z[0] = piece.index == 0 ? 0 : (piece.index - overlap) / piece.count;
    z[1] = piece.index == piece.count - 1
               ? 1
               : (piece.index + 1 + overlap) / piece.count;
    z[0] = cylint_larger(z[0] - shift, 0);
    z[1] = cylint_smaller(z[1] + shift, 1);
}

/*
 * Each coordinate below is computed with at most 16 roundings of numbers not
 * larger than `size`.  The sides are moved out by 2^-48 of size, and by DBL_MIN
 * for underflow.
 */
cylint_extent cylint_piece_box(const cylint_swept_disc *t,
                               const double reach[3], cylint_piece piece)
{
    double z[2], lo[3], hi[3];
    cylint_piece_ends(piece, t->shift, z);
    const double k[2] = {t->k[0] + (t->k[1] - t->k[0]) * z[0],
                         t->k[0] + (t->k[1] - t->k[0]) * z[1]};
    for (int j = 0; j < 3; j++) {
        const double size = fabs(t->base[j]) + fabs(t->axis[j]) +
                            (t->k[0] + t->k[1]) * reach[j];
        const double more = size * 0x1p-48 + DBL_MIN;
        const double from = t->base[j] + z[0] * t->axis[j];
        const double to = t->base[j] + z[1] * t->axis[j];
        const double out0 = k[0] * reach[j] + more;
        const double out1 = k[1] * reach[j] + more;
        /* which end is lower is unpredictable, so there is no branch */
        lo[j] = cylint_smaller(from - out0, to - out1);
        hi[j] = cylint_larger(from + out0, to + out1);
    }
    return cylint_float_box(lo, hi);
}

cylint_extent cylint_swept_disc_box(const cylint_view *view, uint32_t number)
{
    cylint_swept_disc disc;
    double reach[3];
    cylint_swept_disc_of(&disc, view, number);
    cylint_swept_disc_reach(&disc, reach);
    return cylint_piece_box(&disc, reach, (cylint_piece){0, 1});
}
