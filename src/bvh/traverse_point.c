/*
 * traverse_point.c - finds the slices of shapes within a distance of a point
 *
 * In floats, for all children of a node or lanes of a leaf together.  This file is
 * compiled for several instruction sets.
 */
#include "keyed_entry.h"

#ifndef CYLINT_TRAVERSE_POINT
#define CYLINT_TRAVERSE_POINT cylint_traverse_point_plain
#endif

typedef struct {
    const cylint_bvh *bvh;
    double x[3], error, box_error;
    double nearest; /* the distance of the box of all */
    /* The nearest point of the box of all, from bvh->center, with box_error
     * subtracted and added; twice its distances along each coordinate. */
    float low[3], high[3], twice[3];
    const double *distance;
    float last; /* the bound for *distance */
    entry stack[CYLINT_STACK_SIZE];
    int n;
} traversal;

static inline int is_within_bound(const traversal *t, const entry *e)
{
    return e->key >> 32 <= order_key(t->last);
}

/* ---------------------------------------------------------------- boxes -- */

/*
 * The bound of a box is the difference of the squares of two distances: of the
 * box and of the box of all, in which it lies.  Let n be the latter along a
 * coordinate, and d the distance of the box from the nearest point of the box of
 * all.  Then the box is n + d away, and the difference is the sum of
 *
 *   (n + d)^2 - n^2 = d (d + 2 n) >= 0,
 *
 * in floats, wherever the point is: the nearest point, a face and d are rounded by
 * at most 2^-22 of the size of the box of all, and box_error is 2^-20 of it.  The
 * relative errors of products and sums are less than 2^-20.
 */
CYLINT_INLINE unsigned children_near(const traversal *t,
                                     const cylint_node *node, child_hits *hits)
{
    static const int lower_first[3] = {0, 0, 0};
    unsigned hit = 0;
    for (int i = 0; i < CYLINT_CHILDREN; i += WIDTH) {
        vf lower[3], upper[3], sum = f_set(0);
        child_faces(node, i, lower_first, lower, upper);
        EACH(j, 3) {
            const vf out = f_higher(lower[j] - f_set(t->high[j]),
                                    f_set(t->low[j]) - upper[j]);
            const vf d = f_higher(out, f_set(0));
            sum = f_mad(d, d + f_set(t->twice[j]), sum);
        }
        hit |= f_not_greater(sum, f_set(t->last)) << i;
        f_store_keys(hits->enter + i, sum);
    }
    return hit & node->children;
}

/* The difference is rounded up by more than the relative errors of the bounds that
 * are compared with it.  `error` is 2^-48 of the sizes of the point and of the box
 * of all, far more than the roundings of `nearest`. */
static inline void update_last(traversal *t)
{
    const double d = *t->distance;
    t->last = cylint_float_above((d - t->nearest + t->error) *
                                 (d + t->nearest) * (1 + 0x1p-18));
}

#define IS_NEEDED is_within_bound
#define HIT_CHILDREN(t, e, node, hits) children_near(t, node, hits)
#define ENTRY_OF keyed_entry
#include "traverse_template.h"

/* --------------------------------------------------------------- leaves -- */

/*
 * Lower bounds of the distances to the lanes' slices, in steps.  A slice lies in
 * the cylinder with the axis p to p + w and the radius r, and that in the points
 * within r of its axis.  With D = q - p the nearest point of the axis is p + z w,
 * z = D.w / ww in [0, 1].
 *
 * With u = 2^-23, and K >= |q| + 2^11 >= |D|: q, D, z w, the differences and the
 * root are rounded by less than 8 u K together; the error of z, 8 u of K / |w|,
 * moves z w by 8 u K.
 */
CYLINT_INLINE void near_lanes(const cylint_leaf *b, const double q[3], double K,
                              float least[CYLINT_LEAF_SIZE])
{
    const vf error = f_set((float)(0x1p-19 * K));
    for (int lane = 0; lane < CYLINT_LEAF_SIZE; lane += WIDTH) {
        const cylinders s = cylinders_of(b, lane);
        vf D[3];
        EACH(j, 3)
            D[j] = f_set((float)q[j]) - s.p[j];
        const vf at = f_dot(D, s.w) / f_higher(s.ww, f_set(1));
        const vf z = f_lower(f_higher(at, f_set(0)), f_set(1));
        EACH(j, 3)
            D[j] = D[j] - z * s.w[j];
        f_store(least + lane, f_sqrt(f_dot(D, D)) - (s.r + error));
    }
}

/*
 * The same for a point that is far away: the bounds are least[] plus the number
 * returned, which floats would round too much.  A point x of a slice is at least
 * (q - x).e = |q| - x.e away, where e is the unit vector of q, and x.e is at most
 * that of an end of the axis, plus r.  Axes are within 2^10 of the centre, so this
 * is less than the distance by at most 2^19 / |q| <= 4 steps, and the errors of the
 * floats are below one step.
 */
ASIDE double far_lanes(const cylint_leaf *b, const double q[3], double K,
                       float least[CYLINT_LEAF_SIZE])
{
    const double far = sqrt(cylint_dot(q, q));
    vf e[3];
    EACH(j, 3)
        e[j] = f_set((float)(q[j] / far));
    for (int lane = 0; lane < CYLINT_LEAF_SIZE; lane += WIDTH) {
        const cylinders s = cylinders_of(b, lane);
        const vf along = f_dot(e, s.p) + f_higher(f_dot(e, s.w), f_set(0));
        f_store(least + lane, f_set(-1) - (along + s.r));
    }
    return far - 0x1p-48 * K;
}

/* Returns the lanes that may be within the distance.  A lane without a cylinder may
 * be anywhere in the leaf's box.  A bound is reduced by more than its rounding to a
 * float, which is not subnormal. */
CYLINT_INLINE unsigned test_lanes_of(const traversal *t, const cylint_leaf *b,
                                     float least[CYLINT_LEAF_SIZE])
{
    const double steps = (double)cylint_leaf_steps(b);
    const double unit = (1 - 0x1p-50) / steps;
    double q[3], K = (double)CYLINDER_REACH, less = t->error;
    unsigned near = 0;
    EACH(j, 3) {
        q[j] = (t->x[j] - (double)b->center[j]) * steps;
        K += fabs(q[j]);
    }
    if (K < (double)FAR_LIMIT)
        near_lanes(b, q, K, least);
    else
        less -= far_lanes(b, q, K, least) * unit;
    for (int lane = 0; lane < CYLINT_LEAF_SIZE; lane++) {
        const double d = ((double)least[lane] * unit - less) * (1 - 0x1p-22);
        const int is_apart = d > (double)FLT_MIN && !(b->always >> lane & 1);
        least[lane] = is_apart ? (float)d : 0;
        near |= (unsigned)((double)least[lane] <= *t->distance) << lane;
    }
    return near & lanes_in_use(b);
}

/* ---------------------------------------------------------------- start -- */

static inline void start_point(traversal *t, const cylint_bvh *bvh,
                               const double point[3], const double *distance)
{
    double from_center[3], size = DBL_MIN, far = 0, nearest = 0;
    EACH(j, 3) {
        const double lower = bvh->box.lower[j], upper = bvh->box.upper[j];
        const double x = point[j];
        const double inside = cylint_smaller(cylint_larger(x, lower), upper);
        const double out = fabs(x - inside);
        t->x[j] = x;
        from_center[j] = inside - (double)bvh->center[j];
        t->twice[j] = (float)(2 * out);
        size += fabs(lower) + fabs(upper);
        far += fabs(x);
        nearest += out * out;
    }
    t->bvh = bvh;
    t->nearest = sqrt(nearest);
    t->error = (far + size) * 0x1p-48;
    t->box_error = size * 0x1p-20;
    EACH(j, 3) {
        t->low[j] = (float)(from_center[j] - t->box_error);
        t->high[j] = (float)(from_center[j] + t->box_error);
    }
    t->distance = distance;
    update_last(t);
    /* mutant '0' -> '1': the first 0: the root is visited with any bound */
    t->stack[0] = (entry){keyed_child(0, 0)};
    t->n = 1;
}

void CYLINT_TRAVERSE_POINT(const cylint_bvh *bvh, const double point[3],
                           const double *distance,
                           cylint_leaf_callback *callback, void *self)
{
    entry at, ahead = {0};
    float least[CYLINT_LEAF_SIZE];
    traversal t;
    start_point(&t, bvh, point, distance);
    while ((at = take_leaf(&t, &ahead)).key) {
        const cylint_leaf *leaf = leaf_of(&t, at);
        const unsigned lanes = test_lanes_of(&t, leaf, least);
        if (lanes && callback(self, leaf, lanes, least))
            return;
        update_last(&t);
    }
}
