/*
 * shapes.c - the shapes of a geometry: the arguments of their constructors, and how
 * they move
 */
#include "shapes.h"

#include <float.h>

#include "../bvh/threads.h"
#include "../intersect.h"

/* The sign of the radii in a record of a bounded shape; NaN: the filter does not
 * decide.  Of balls about one centre the filter reads the first. */
static double radii_sign(const cylint_shape *s)
{
    if (cylint_is_elliptic(s->kind))
        return NAN;
    if (!cylint_is_round(s->kind))
        return 1;
    return cylint_is_hull(s->kind) ||
                   (cylint_has_no_axis(s) && s->ends == CYLINT_ENDS_CAPPED &&
                    !cylint_is_reversed(s))
               ? -1
               : NAN;
}

/* Whether every number is 0 or at least 2^-149, the least float: so products of the
 * filter do not underflow. */
static int filter_serves(const cylint_record *x)
{
    int tiny = 0;
    EACH(j, CYLINT_RECORD_NUMBERS)
        tiny |= cylint_is_small((&x->p0[0])[j], 149);
    return !tiny;
}

void cylint_filter_record_of(cylint_record *to, const cylint_shape *s)
{
    cylint_set_record(to, s);
    const double sign = filter_serves(to) ? radii_sign(s) : NAN;
    to->r0 = cylint_has_tangent(s->kind) ? -to->r1 : to->r0;
    to->r0 *= sign;
    to->r1 *= sign;
}

/* Writes the record of a shape.  Returns 0 if it does not fit. */
static int set_record(const cylint_embree_shapes *s, size_t at,
                      const cylint_shape *shape)
{
    cylint_record x, *to = (cylint_record *)cylint_embree_record_at(s, at);
    float *small = (float *)to;
    int is = 1;
    cylint_filter_record_of(&x, shape);
    if (s->size != CYLINT_SMALL_RECORD)
        *to = x;
    else
        EACH(j, CYLINT_RECORD_NUMBERS) {
            const double number = (&x.p0[0])[j];
            small[j] = (float)number;
            is &= (double)small[j] == number &&
                  (fabs(number) >= (double)FLT_MIN || cylint_sign(number) == 0);
        }
    return is;
}

/* --------------------------------------------------------------- copying -- */

typedef struct {
    const cylint_bvh_input *from;
    cylint_embree_shapes *to;
} copying;

/* The tag of a shape that does not fit into a small record. */
enum { TOO_LARGE = 255 };

/* The views of the adapter write no *spare. */
static const cylint_shape *source_of(const copying *c, size_t i)
{
    return c->from->view->shape_at(c->from->view->owner, (uint32_t)i, NULL);
}

/* Of small records only up to the first shape that does not fit. */
static void copy_some(void *self, size_t from, size_t to)
{
    copying *c = self;
    for (size_t i = from; i < to; i++) {
        const cylint_shape *shape = source_of(c, i);
        c->to->tag[i] = (uint8_t)(cylint_constructor_kind(shape) +
                                  shape->ends * CYLINT_TAG_ENDS);
        if (!set_record(c->to, i, shape)) {
            c->to->tag[i] = TOO_LARGE;
            return;
        }
    }
}

/* Makes small records or, if a shape does not fit, large ones. */
static int copy_records(copying *c)
{
    const size_t n = c->from->n;
    cylint_embree_shapes *to = c->to;
    for (to->size = CYLINT_SMALL_RECORD;; to->size = sizeof(cylint_record)) {
        if (!cylint_memory_allocate(&to->memory, c->from->source,
                                    n * (to->size + 1)))
            return 0;
        to->tag = (uint8_t *)to->memory.data + n * to->size;
        memset(to->tag, 0, n);
        cylint_threads_share(c->from->threads, n, CYLINT_THREADS_LEAST_SHAPES,
                             CYLINT_THREADS_LEAST_SHAPES, copy_some, c);
        if (to->size != CYLINT_SMALL_RECORD || !memchr(to->tag, TOO_LARGE, n))
            return 1;
        cylint_memory_free(&to->memory);
    }
}

static int keep_whole(copying *c)
{
    const size_t n = c->from->n,
                 at = (n * (sizeof(cylint_record) + 1) + 7) / 8 * 8;
    cylint_embree_shapes *to = c->to;
    cylint_record *record = to->memory.data;
    size_t next = 0, n_whole = 0;
    for (size_t i = 0; i < n && to->size != CYLINT_SMALL_RECORD; i++)
        n_whole += record[i].r0 != record[i].r0;
    if (n_whole == 0)
        return 1;
    if (!cylint_memory_resize(&to->memory, c->from->source,
                              at + n_whole * sizeof(cylint_shape)))
        return 0;
    record = to->memory.data;
    to->tag = (uint8_t *)(record + n);
    cylint_shape *whole = (cylint_shape *)((char *)record + at);
    to->whole = whole;
    for (size_t i = 0; i < n; i++)
        if (record[i].r0 != record[i].r0) {
            record[i].p0[0] = (double)next;
            whole[next++] = *source_of(c, i);
        }
    return 1;
}

int cylint_embree_shapes_copy(cylint_embree_shapes *to,
                              const cylint_bvh_input *from)
{
    copying c = {from, to};
    return copy_records(&c) && keep_whole(&c);
}

/* --------------------------------------------------- reading, motion -- */

/* The shape of one time. */
static void make_shape(const cylint_embree_shapes *s, size_t at,
                       cylint_shape *shape)
{
    const int tag = s->tag[at];
    cylint_record x;
    cylint_embree_record(s, at, &x);
    if (x.r0 != x.r0) {
        *shape = s->whole[(size_t)x.p0[0]];
        return;
    }
    x.r0 = fabs(x.r0);
    x.r1 = fabs(x.r1);
    cylint_make_of_record(shape, tag & CYLINT_TAG_KIND, tag / CYLINT_TAG_ENDS,
                          &x, NULL);
}

/* x becomes (1 - time) x + time y, n doubles. */
static void interpolate(void *x, const void *y, size_t n, double time)
{
    double *at_0 = x;
    const double *at_1 = y;
    for (size_t i = 0; i < n; i++)
        at_0[i] = (1 - time) * at_0[i] + time * at_1[i];
}

cylint_status cylint_embree_between(const cylint_shape *at_0,
                                    const cylint_shape *at_1, double time,
                                    cylint_shape *shape)
{
    const cylint_shape *const at[2] = {at_0, at_1};
    struct {
        cylint_record record;
        cylint_semi_axes axes;
    } x[2];
    for (int i = 0; i < 2; i++) {
        cylint_set_record(&x[i].record, at[i]);
        cylint_set_semi_axes(&x[i].axes, at[i]);
    }
    interpolate(&x[0], &x[1], sizeof x[0] / sizeof(double), time);
    return cylint_make_of_record(shape, cylint_constructor_kind(at_0),
                                 at_0->ends, &x[0].record, &x[0].axes);
}

void cylint_embree_shape(const cylint_embree_shapes s[2], size_t at,
                         double time, cylint_shape *shape)
{
    cylint_shape at_1;
    make_shape(&s[0], at, shape);
    if (!s[1].tag)
        return;
    make_shape(&s[1], at, &at_1);
    cylint_embree_between(shape, &at_1, time, shape);
}

/* Whether the two points are one. */
static int is_point(const cylint_record *x)
{
    return x->p0[0] == x->p1[0] && x->p0[1] == x->p1[1] && x->p0[2] == x->p1[2];
}

/* A round cone may become a ball on the way; the filter serves only balls that
 * stay balls. */
void cylint_embree_moving_record(const cylint_embree_shapes s[2], size_t at,
                                 double time, cylint_record *to)
{
    cylint_record y;
    cylint_embree_record(&s[0], at, to);
    cylint_embree_record(&s[1], at, &y);
    const int stays = is_point(to) && is_point(&y);
    interpolate(to, &y, CYLINT_RECORD_NUMBERS, time);
    if (!filter_serves(to) || (is_point(to) && !stays))
        to->r0 = NAN;
}

/*
 * Boxes.  Embree uses (1-t) box_0 + t box_1, which must contain the shape at
 * every t.  A shape is the convex hull of its two discs.  A disc's centre is
 * linear in t.  Along coordinate j the disc reaches at most f(t) from its centre,
 *
 *   circular: the radius, linear in t; the balls of round shapes likewise;
 *   acone:    0 at v; at v + u the tangent times |u|, the product of a
 *             linear function k and a convex one g, both >= 0;
 *   elliptic: sqrt(a_j^2 + b_j^2), convex; at the top that times k.
 *
 * g is convex, so it is at most its linear interpolation.  k times that is at
 * most the linear interpolation of the products, except if one of k and g grows
 * and the other shrinks: then it may exceed it by t (1-t) |k1-k0| |g1-g0|, at
 * most a quarter of |k1-k0| |g1-g0|, which is added.  So centre + f of each
 * disc is below a linear function, which the boxes contain at t = 0 and 1.
 */

/*
 * Roundings.  Embree stores lower0 and upper0 and their differences to lower1 and
 * upper1, and adds t times these, in floats.  M is the largest of these sizes: the
 * differences are at most 2 M, with errors of 2^-24 of that; the product adds as
 * much, the sum half of it.  The sides are moved out by 2^-21 M, more than the
 * total of 5 2^-24 M; the other 3 2^-24 M cover doubles, those of
 * cylint_embree_between() too.
 */
cylint_extent cylint_embree_box(const cylint_shape *at_0,
                                const cylint_shape *at_1, int step)
{
    const cylint_shape *const at[2] = {at_0, at_1};
    cylint_extent box[2];
    double g[2][3], lo[3], hi[3]; /* g is 1 if f is linear */
    for (int i = 0; i < (at_1 ? 2 : 1); i++) {
        const cylint_view view = cylint_plain_view(at[i]);
        cylint_swept_disc disc;
        cylint_swept_disc_of(&disc, &view, at[i]);
        if (at_1 && !disc.elliptic)
            g[i][0] = g[i][1] = g[i][2] = 1;
        else
            cylint_swept_disc_reach(&disc, g[i]);
        box[i] = cylint_slice_box(&disc, g[i], (cylint_slice){0, 1});
        if (cylint_has_tangent(at[i]->kind))
            g[i][0] = g[i][1] = g[i][2] = disc.length;
    }
    if (!at_1)
        return box[0];
    const double dk = cylint_r1(at_1) - cylint_r1(at_0);
    EACH(j, 3) {
        const double product = dk * (g[1][j] - g[0][j]);
        const double excess = product < 0 ? -product / 4 : 0;
        double M = 0;
        EACH(i, 2)
            M = fmax(M, fmax(fabsf(box[i].lower[j]), fabsf(box[i].upper[j])));
        lo[j] = box[step].lower[j] - excess - 0x1p-21 * (M + excess);
        hi[j] = box[step].upper[j] + excess + 0x1p-21 * (M + excess);
    }
    return cylint_float_box(lo, hi);
}
