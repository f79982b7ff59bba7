/*
 * ray.h - the state of a line in a traversal, and its test against boxes
 *
 * For traverse.c, traverse_point.c and packet_traverse.c, which are compiled for
 * several instruction sets.
 */
#ifndef CYLINT_BVH_RAY_H
#define CYLINT_BVH_RAY_H

#include <string.h>

#include "leaf_test.h"

/*
 * The line x + t d, where x is relative to the centre of the hierarchy, and
 * r = 1 / d.  It crosses a face at F where t = F r - x r.  enter and leave are
 * -x r, minus and plus a bound of the errors.
 */
typedef struct {
    float r[PARTS * WIDTH], enter[PARTS * WIDTH], leave[PARTS * WIDTH];
    int near_face[3]; /* where it enters boxes: 0, or FACES for the upper one */
    float first, last;   /* the domain; its t is the line's t ... */
    uint32_t last_key;   /* of last: order_key() */
    double t0, t0_error; /* ... minus t0, with this error */
} ray_state;

/* ---------------------------------------------------------------- boxes -- */

/*
 * Which boxes of a node the line may hit, and where it enters them.  The line
 * crosses a face at F = corner + q step at t = (F - x) r.  With u = 2^-23, of
 * floats in any rounding mode, S the longest side of the box of all, |corner| and q
 * step at most S:
 *
 *   r has an error of u r, so t one of 2 u S |r| and, as x r is computed from
 *   another r, one of u |x r|; F is rounded once or, without fused operations,
 *   twice, by 3 u S; x r is rounded twice, F r once if it is not fused, their
 *   difference once, and the end of the domain beside t once,
 *
 * in all less than 11 u (|x| + S) |r|.  set_box_test() allows 16 u.  A component of
 * d below 2^-60 of the largest is replaced by that; on a length of 2^10 S this
 * moves the line by less than another 2^-21 S, which the 16 u cover.  A number
 * flushed to zero is less than FLT_MIN.  The allowance is at least 2^-19 of x r
 * and F r: where it is 2^100 or more these may overflow, and set_box_test() makes
 * it infinite.  Then each box is between its faces; f_higher() and f_lower() ignore
 * a NaN.
 */

/* Bytes of a node's lower faces; the upper ones follow. */
enum { FACES = 3 * CYLINT_CHILDREN };

/* lint: a box has three sides */
/* The faces where lines with this near_face[] enter and leave the boxes of children
 * from `from` on. */
CYLINT_INLINE void child_faces(const cylint_node *node, int from,
                               const int near_face[3], vf enter[3], vf leave[3])
{
    EACH(j, 3) {
        const vf corner = f_set(node->corner[j]), step = f_set(node->step[j]);
        const uint8_t *face =
            (const uint8_t *)node->face + j * CYLINT_CHILDREN + from;
        enter[j] = f_mad(f_from_bytes(face + near_face[j]), step, corner);
        leave[j] =
            f_mad(f_from_bytes(face + (FACES - near_face[j])), step, corner);
    }
}

/* Whether the line may hit the boxes; *from: where it enters them. */
CYLINT_INLINE vm hit_boxes(const vf enter[3], const vf leave[3],
                           const ray_state *s, vf *from)
{
    vf to = f_set(s->last);
    *from = f_set(s->first);
    EACH(j, 3) {
        const vf r = f_set(s->r[j]);
        *from = f_higher(f_mad(enter[j], r, f_set(s->enter[j])), *from);
        to = f_lower(f_mad(leave[j], r, f_set(s->leave[j])), to);
    }
    return m_not_greater(*from, to);
}

/* ---------------------------------------------------------------- order -- */

/* Integers in the order of the floats. */
static inline uint32_t order_key(float x)
{
    uint32_t key;
    memcpy(&key, &x, sizeof key);
    return key >> 31 ? ~key : key | 0x80000000u;
}

/* A child (lower half) and the key of where it is entered (upper half). */
static inline uint64_t keyed_child(uint32_t enter, uint32_t child)
{
    return (uint64_t)enter << 32 | child;
}

static inline void prefetch_child(const cylint_bvh *bvh, uint32_t child)
{
    const char *data =
        child & CYLINT_LEAF_FLAG
            ? (const char *)&bvh->leaves[child & ~CYLINT_LEAF_FLAG]
            : (const char *)&bvh->nodes[child];
    CYLINT_PREFETCH(data);
    CYLINT_PREFETCH(data + 64);
}

/* ---------------------------------------------------------------- start -- */

static inline float larger_float(float x, float y) /* fmaxf() is a call */
{
    return x > y ? x : y;
}

/* x may have an error of x_error. */
static inline void set_box_test(ray_state *s, const cylint_bvh *bvh,
                                const float x[3], const float d[3],
                                float x_error)
{
    const float xy = larger_float(fabsf(d[0]), fabsf(d[1]));
    const vf least = f_set(larger_float(xy, fabsf(d[2])) * 0x1p-60f);
    EACH(k, PARTS) {
        const vf to = f_part(d, k), from = f_part(x, k);
        const vf per_size = f_set(1) / f_higher(f_abs(to), least);
        const vf r = f_flipped(per_size, to), at = from * r;
        const vf off =
            f_mad(f_abs(from), f_set(0x1p-19f), f_set(bvh->pad + x_error));
        const vf e = f_mad(per_size, off, f_set(16 * FLT_MIN));
        const vm overflows = m_not_greater(f_set(0x1p100f), e);
        const vf error = m_select(overflows, f_set(HUGE_VALF), e);
        f_store(s->r + k, r);
        f_store(s->enter + k, -at - error);
        f_store(s->leave + k, error - at);
    }
    EACH(j, 3)
        s->near_face[j] = signbit(d[j]) ? FACES : 0;
}

/* The key of -0 is not that of 0; nor is that of a subnormal number, which may be
 * read as 0. */
static inline float with_one_zero(float t)
{
    return t == 0 ? 0 : t;
}

/* Reduces the domain after tmax was reduced. */
static inline void shorten(ray_state *s, double tmax)
{
    s->last = with_one_zero((float)(tmax - s->t0 + s->t0_error));
    s->last_key = order_key(s->last);
}

/* A line from far away begins at its point nearest to the centre, because floats
 * are coarse there.  That point's terms and their sum are rounded. */
static inline void start_line(ray_state *s, const cylint_bvh *bvh,
                              const cylint_bvh_line *line)
{
    double o[3], far = 0, o_error = 0;
    float x[3], d[3];
    s->t0 = s->t0_error = 0;
    EACH(j, 3) {
        o[j] = line->o[j] - (double)bvh->center[j];
        far += fabs(o[j]);
    }
    if (!(far < 256 * (double)bvh->longest)) {
        s->t0 = -cylint_dot(o, line->d) / cylint_dot(line->d, line->d);
        s->t0_error = 0x1p-51 * fabs(s->t0);
        o_error = 0x1p-49 * far;
        EACH(j, 3)
            o[j] += s->t0 * line->d[j];
    }
    EACH(j, 3) {
        x[j] = (float)o[j];
        d[j] = (float)line->d[j];
    }
    set_box_test(s, bvh, x, d, (float)o_error);
    s->first = with_one_zero((float)(line->tmin - s->t0 - s->t0_error));
    shorten(s, line->tmax);
}

/* Whether the domain ends outside the box of all. */
static inline int ends_outside(const cylint_bvh *bvh,
                               const cylint_bvh_line *line)
{
    int out = 0;
    EACH(j, 3)
        out |= fabs(line->o[j] - (double)bvh->center[j] +
                    line->tmax * line->d[j]) > (double)bvh->longest;
    return out;
}

#endif
