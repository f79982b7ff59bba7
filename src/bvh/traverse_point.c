/*
 * traverse_point.c - finds the pieces of shapes within a distance of a point
 *
 * In floats near the hierarchy, for all children of a node or lanes of a leaf
 * together; in doubles, one by one, where floats are too coarse.  This file is
 * compiled for several instruction sets.
 */
#include <string.h>

#include "keyed_entry.h"

#ifndef CYLINT_TRAVERSE_POINT
#define CYLINT_TRAVERSE_POINT cylint_traverse_point_plain
#endif

/*
 * Lower bounds of nodes are floats: of a near point the squares of distances, of
 * a far one the distances minus that of the box of all.
 */
typedef struct {
    const cylint_bvh *bvh;
    int is_far;
    double x[3], from_center[3]; /* the point; relative to bvh->center */
    double error, nearest;       /* nearest: the distance of the box of all */
    float near_x[3], near_error; /* from_center and error as floats */
    const double *distance;
    float last; /* the bound for *distance */
    entry stack[CYLINT_STACK_SIZE];
    int n;
} traversal;

static inline int is_needed(const traversal *t, const entry *e)
{
    return e->key >> 32 <= order_key(t->last);
}

/* ---------------------------------------------------------------- boxes -- */

/* The square is rounded up by more than the relative errors of the squares that
 * are compared with it. */
static inline void update_last(traversal *t)
{
    const double d = *t->distance;
    t->last = cylint_float_above(t->is_far ? d - t->nearest + t->error
                                           : d * d * (1 + 0x1p-18));
}

/*
 * The lower bounds of boxes are distances from the box, less t->error along each
 * coordinate.  In doubles, the coordinates of the point and two differences are
 * rounded, each by at most 2^-53 of the sizes of the point and of the box of all;
 * error is 2^-48 of them, so it also covers the roundings of the root.  step
 * times a face is exact.
 */
ASIDE void far_children(const traversal *t, const cylint_node *node,
                        float enter[CYLINT_CHILDREN])
{
    for (int i = 0; i < CYLINT_CHILDREN; i++) {
        double sum = 0;
        for (int j = 0; j < 3; j++) {
            const double step = (double)node->step[j];
            const double from = t->from_center[j] - (double)node->corner[j];
            const double below = step * node->face[0][j][i] - from;
            const double above = from - step * node->face[1][j][i];
            const double out = cylint_larger(below, above) - t->error;
            const double apart = cylint_larger(out, 0);
            sum += apart * apart;
        }
        enter[i] = cylint_float_below(sqrt(sum) - t->nearest);
    }
}

/* The same in floats: the point, a face and the difference are rounded by at
 * most 2^-24 of these sizes; near_error is 2^-20 of them.  The relative errors of
 * squares and sums are less than 2^-20. */
CYLINT_INLINE void near_children(const traversal *t, const cylint_node *node,
                                 float enter[CYLINT_CHILDREN])
{
    for (int i = 0; i < CYLINT_CHILDREN; i += WIDTH) {
        vf sum = f_set(0);
        EACH(j, 3) {
            const vf corner = f_set(node->corner[j]);
            const vf step = f_set(node->step[j]), x = f_set(t->near_x[j]);
            const vf lower =
                f_mad(f_from_bytes(node->face[0][j] + i), step, corner);
            const vf upper =
                f_mad(f_from_bytes(node->face[1][j] + i), step, corner);
            const vf out =
                f_higher(lower - x, x - upper) - f_set(t->near_error);
            const vf apart = f_higher(out, f_set(0));
            sum = f_mad(apart, apart, sum);
        }
        f_store(enter + i, sum);
    }
}

CYLINT_INLINE unsigned hit_children(const traversal *t, const entry *e,
                                    const cylint_node *node, child_hits *hits)
{
    float enter[CYLINT_CHILDREN];
    unsigned hit = 0;
    (void)e;
    if (t->is_far)
        far_children(t, node, enter);
    else
        near_children(t, node, enter);
    for (int i = 0; i < CYLINT_CHILDREN; i += WIDTH) {
        const vf from = f_load(enter + i);
        hit |= m_bits(m_not_greater(from, f_set(t->last))) << i;
        f_store_keys(hits->enter + i, from);
    }
    return hit & node->children;
}

#include "traverse_template.h"

/* --------------------------------------------------------------- leaves -- */

/*
 * Lower bounds of the distances to the lanes' pieces, in steps.  A piece lies in
 * the cylinder with the axis p to p + w and the radius r, and that in the points
 * within r of its axis.  With D = q - p the nearest point of the axis is p + z w,
 * z = D.w / ww in [0, 1].
 *
 * With u = 2^-53 or 2^-24, and K >= |q| + 2^11 >= |D|: q, D, z w, their difference
 * and the root are rounded by less than 8 u K together; the error of z, 8 u of
 * K / |w|, moves z w by 8 u K.  Twice that is subtracted.
 */
ASIDE void far_lanes(const cylint_leaf *b, const double q[3], double K,
                     double least[CYLINT_LEAF_SIZE])
{
    for (int lane = 0; lane < CYLINT_LEAF_SIZE; lane++) {
        const double r = b->r[lane] & CYLINT_LEAF_R_MASK;
        double D[3], w[3], ww = 0, Dw = 0, square = 0;
        for (int j = 0; j < 3; j++) {
            const int bits = j * CYLINT_LEAF_P_BITS;
            const int p = (int)(b->p[0][lane] >> bits & CYLINT_LEAF_P_MASK);
            const int top = (int)(b->p[1][lane] >> bits & CYLINT_LEAF_P_MASK);
            D[j] = q[j] - (p - CYLINT_LEAF_MIDDLE);
            w[j] = top - p;
            ww += w[j] * w[j];
            Dw += D[j] * w[j];
        }
        const double at = Dw / cylint_larger(ww, 1);
        const double z = cylint_smaller(cylint_larger(at, 0), 1);
        for (int j = 0; j < 3; j++)
            square += (D[j] - z * w[j]) * (D[j] - z * w[j]);
        least[lane] = sqrt(square) - (r + 0x1p-48 * K);
    }
}

CYLINT_INLINE void near_lanes(const cylint_leaf *b, const double q[3], double K,
                              double least[CYLINT_LEAF_SIZE])
{
    const vf error = f_set((float)(0x1p-19 * K));
    float found[CYLINT_LEAF_SIZE];
    for (int lane = 0; lane < CYLINT_LEAF_SIZE; lane += WIDTH) {
        const cylinders s = cylinders_of(b, lane);
        vf D[3];
        EACH(j, 3)
            D[j] = f_set((float)q[j]) - s.p[j];
        const vf at = dot(D, s.w) / f_higher(s.ww, f_set(1));
        const vf z = f_lower(f_higher(at, f_set(0)), f_set(1));
        EACH(j, 3)
            D[j] = D[j] - z * s.w[j];
        f_store(found + lane, f_sqrt(dot(D, D)) - (s.r + error));
    }
    for (int lane = 0; lane < CYLINT_LEAF_SIZE; lane++)
        least[lane] = (double)found[lane];
}

/* A lane without a cylinder may be anywhere in the leaf's box. */
CYLINT_INLINE void test_lanes_of(const traversal *t, const cylint_leaf *b,
                                 double least[CYLINT_LEAF_SIZE])
{
    const double steps = (double)cylint_leaf_steps(b);
    const double unit = (1 - 0x1p-50) / steps;
    double q[3], K = (double)CYLINDER_REACH;
    EACH(j, 3) {
        q[j] = (t->x[j] - (double)b->center[j]) * steps;
        K += fabs(q[j]);
    }
    if (K < (double)FAR_LIMIT)
        near_lanes(b, q, K, least);
    else
        far_lanes(b, q, K, least);
    for (int lane = 0; lane < CYLINT_LEAF_SIZE; lane++) {
        const double d = least[lane] * unit - t->error;
        least[lane] = d > 0 && !(b->always >> lane & 1) ? d : 0;
    }
}

/* ---------------------------------------------------------------- start -- */

/* Points farther than this from the centre, in sizes of the box of all, are
 * far. */
#define FAR_SIZES 16

static inline void start_point(traversal *t, const cylint_bvh *bvh,
                               const double point[3], const double *distance)
{
    double size = DBL_MIN, far = 0, nearest = 0;
    EACH(j, 3) {
        const double lower = bvh->box.lower[j], upper = bvh->box.upper[j];
        const double x = point[j], center = bvh->center[j];
        const double below = lower - x, above = x - upper;
        /* mutant '0' -> '1': both sides subtract the distance of this box */
        const double out = cylint_larger(cylint_larger(below, above), 0);
        t->x[j] = x;
        t->from_center[j] = x - center;
        t->near_x[j] = (float)t->from_center[j];
        size += fabs(lower) + fabs(upper);
        far += fabs(x);
        nearest += out * out;
    }
    t->bvh = bvh;
    t->is_far = !(far < size * FAR_SIZES);
    t->nearest = sqrt(nearest);
    t->error = (far + size) * 0x1p-48;
    t->near_error = (float)((far + size) * 0x1p-20);
    t->distance = distance;
    update_last(t);
    /* mutant '0' -> '1': the first 0: the root is visited with any bound */
    t->stack[0] = (entry){keyed_child(0, 0)};
    t->n = 1;
}

void CYLINT_TRAVERSE_POINT(const cylint_bvh *bvh, const double point[3],
                           const double *distance,
                           cylint_point_leaf_callback *callback, void *self)
{
    const cylint_leaf *leaf;
    double least[CYLINT_LEAF_SIZE];
    traversal t;
    start_point(&t, bvh, point, distance);
    leaf_ahead next = first_leaf(&t);
    while ((leaf = take_leaf(&t, &next))) {
        test_lanes_of(&t, leaf, least);
        if (callback(self, leaf, least))
            return;
        update_last(&t);
    }
}
