/*
 * trunk.c - what all bounded shapes look like from far: discs along an axis
 */
#include "trunk.h"

static double dot(const double x[3], const double y[3])
{
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/* A disc across the axis w reaches sqrt(1 - w_j^2 / ww) of its radius, which
 * is computed without the difference; all of it, where squares underflow. */
static void circular(cylint_trunk *t, double ww)
{
    for (int j = 0; j < 3; j++) {
        const double x = t->axis[(j + 1) % 3], y = t->axis[(j + 2) % 3];
        t->reach[j] = ww > DBL_MIN * 0x1p60 ? sqrt((x * x + y * y) / ww) : 1;
    }
    t->across = 1;
    t->along = 0;
}

/* x a + y b with x^2 + y^2 <= 1 reaches sqrt((a.v)^2 + (b.v)^2) along a unit
 * vector v, and across the axis as far as the larger eigenvalue of the Gram
 * matrix of what a and b have across it. */
static void elliptic(cylint_trunk *t, double a[3], double b[3], double ww)
{
    const double aw = dot(a, t->axis), bw = dot(b, t->axis);
    for (int j = 0; j < 3; j++)
        t->reach[j] = sqrt(a[j] * a[j] + b[j] * b[j]);
    t->across = t->along = sqrt(dot(a, a) + dot(b, b));
    if (!(ww > DBL_MIN * 0x1p60))
        return;
    t->along = sqrt((aw * aw + bw * bw) / ww);
    for (int j = 0; j < 3; j++) {
        a[j] -= aw / ww * t->axis[j];
        b[j] -= bw / ww * t->axis[j];
    }
    const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b);
    const double difference = aa - bb;
    t->across = sqrt((aa + bb + sqrt(difference * difference + 4 * ab * ab)) /
                     2);
}

void cylint_trunk_of(cylint_trunk *t, const cylint_view *view,
                     uint32_t number)
{
    const cylint_shape *s = view->shapes + number;
    double a[3], b[3];
    for (int j = 0; j < 3; j++) {
        t->base[j] = (s->base[j] - view->center[j]) * view->scale;
        t->axis[j] = s->axis[j] * view->scale;
        a[j] = s->a[j] * view->scale;
        b[j] = s->b[j] * view->scale;
    }
    const double ww = dot(t->axis, t->axis);
    t->length = sqrt(ww);
    t->k[0] = s->r0;
    t->k[1] = s->r1;
    if (s->kind == CYLINT_KIND_ECYLINDER || s->kind == CYLINT_KIND_ECONE) {
        elliptic(t, a, b, ww);
        return;
    }
    circular(t, ww);
    t->k[0] *= view->scale;
    t->k[1] *= s->kind == CYLINT_KIND_ACONE ? t->length /* from the tangent */
                                            : view->scale;
}

void cylint_piece_ends(cylint_piece piece, double z[2])
{
    const double overlap = 0x1p-20;
    z[0] = piece.index == 0 ? 0 : (piece.index - overlap) / piece.count;
    z[1] = piece.index == piece.count - 1
         ? 1 : (piece.index + 1 + overlap) / piece.count;
}

/*
 * Every coordinate below comes of at most 16 roundings in sums of numbers of
 * one sign, or no larger than what is summed up in `size`: the sides are moved
 * out by 2^-48 of that, and by what can underflow.
 */
struct RTCBounds cylint_piece_box(const cylint_trunk *t, cylint_piece piece)
{
    double z[2], lo[3], hi[3];
    cylint_piece_ends(piece, z);
    for (int j = 0; j < 3; j++) {
        lo[j] = HUGE_VAL;
        hi[j] = -HUGE_VAL;
        for (int end = 0; end < 2; end++) {
            const double center = t->base[j] + z[end] * t->axis[j];
            const double k = t->k[0] + (t->k[1] - t->k[0]) * z[end];
            const double size = fabs(t->base[j]) + fabs(t->axis[j]) +
                                t->k[0] * t->reach[j] + t->k[1] * t->reach[j];
            const double out = k * t->reach[j] + size * 0x1p-48 + DBL_MIN;
            lo[j] = fmin(lo[j], center - out);
            hi[j] = fmax(hi[j], center + out);
        }
    }
    return cylint_float_box(lo, hi);
}
