/*
 * ray.h - a line on its way through boxes: which it may meet, and where
 *
 * For traverse.c and packet_traverse.c, which are compiled for several instruction sets.
 */
#ifndef CYLINT_BVH_RAY_H
#define CYLINT_BVH_RAY_H

#include <string.h>

#include "leaf_test.h"

/*
 * A line on its way: x + t d, x counted from the group's centre, with r = 1 /
 * d.  near and far are x r, more and less what entries into boxes and exits
 * may be off by.
 */
typedef struct cylint_ray_state {
    float r[3], near[3], far[3];
    int entry[3];      /* the face by which it enters boxes: 0 or 1 */
    float first, last; /* t between; t here is that of the line ... */
    double t0, slop;   /* ... less t0, and may be off by so much */
} cylint_ray_state;

typedef cylint_ray_state way;

/* ---------------------------------------------------------------- boxes -- */

/*
 * Which boxes of a node the line may meet, and where it enters them.  A face at
 * F = corner + q step is crossed at t = (F - x) r.  With u = 2^-24, S the
 * longest side of all boxes, |corner| and q step at most S:
 *
 *   r is wrong by u of itself, so t by 2 u S |r|, and, r being another where x
 *   r is made, by u |x r|; F is rounded once or, if that is not fused, twice,
 *   by 3 u S; x r is rounded twice, F r once if it is not fused, and their
 *   difference once,
 *
 * in all by less than 10 u (|x| + S) |r|.  start() allows for 16 u.  That
 * moves a face by another 2^-21 S, more than what it moves when a d below
 * 2^-60 of the largest is taken for that much, on 2^10 S of a line.  What is
 * flushed to zero is less than FLT_MIN each.  Where something overflows,
 * f_higher() and f_lower() leave out what is not a number.
 */

/* Where lines with these `entry` enter and leave the boxes from `from` on. */
CYLINT_INLINE void faces_of(const cylint_node *node, int from,
                            const int entry[3], vf enter[3], vf leave[3])
{
    EACH(j, 3) {
        const vf corner = f_set(node->corner[j]), step = f_set(node->step[j]);
        const uint8_t(*face)[3][CYLINT_CHILDREN] = node->face;
        enter[j] = f_mad(f_from_bytes(face[entry[j]][j] + from), step, corner);
        leave[j] =
            f_mad(f_from_bytes(face[1 - entry[j]][j] + from), step, corner);
    }
}

/* Where one may do so; whether it may is the answer. */
CYLINT_INLINE vm boxes_met(const vf enter[3], const vf leave[3], const way *w,
                           vf *from)
{
    vf to = f_set(w->last);
    *from = f_set(w->first);
    EACH(j, 3) {
        const vf r = f_set(w->r[j]);
        *from = f_higher(f_mad(enter[j], r, -f_set(w->near[j])), *from);
        to = f_lower(f_mad(leave[j], r, -f_set(w->far[j])), to);
    }
    return m_not_greater(*from, to);
}

/* ----------------------------------------------------------------- order -- */

static inline uint32_t key_of(float x)
{
    uint32_t key;
    memcpy(&key, &x, sizeof key);
    return key >> 31 ? ~key : key | 0x80000000u;
}

static inline uint64_t stop_at(uint32_t enter, uint32_t child)
{
    return (uint64_t)enter << 32 | child;
}

static inline void fetch(const cylint_bvh *group, uint32_t child)
{
#ifdef __GNUC__
    if (child & CYLINT_LEAF_FLAG) {
        const char *block =
            (const char *)&group->blocks[child & ~CYLINT_LEAF_FLAG];
        __builtin_prefetch(block);
        __builtin_prefetch(block + 64);
    } else {
        const char *node = (const char *)&group->nodes[child];
        __builtin_prefetch(node);
        __builtin_prefetch(node + 64);
    }
#else
    (void)group;
    (void)child;
#endif
}

/* ------------------------------------------------------------------ ways -- */

/* t of the line on the way. */
static inline float above(const way *w, double t)
{
    return cylint_float_above(t - w->t0 + w->slop);
}

static inline float below(const way *w, double t)
{
    return cylint_float_below(t - w->t0 - w->slop);
}

static inline float larger(float x, float y) /* fmaxf() is a call */
{
    return x > y ? x : y;
}

/* From x, of which components may be off by so much; group->pad is 16 u S. */
static inline void start(way *w, const cylint_bvh *group, const double x[3],
                         const double d[3], float off)
{
    const float D[3] = {(float)d[0], (float)d[1], (float)d[2]};
    const float least =
        larger(fabsf(D[0]), larger(fabsf(D[1]), fabsf(D[2]))) * 0x1p-60f;
    EACH(j, 3) {
        const float r = 1 / (fabsf(D[j]) >= least ? D[j]
                             : D[j] < 0           ? -least
                                                  : least);
        const float X = (float)x[j];
        const float e =
            fabsf(r) * (fabsf(X) * 0x1p-20f + group->pad + off) + 16 * FLT_MIN;
        w->r[j] = r;
        w->near[j] = X * r + e;
        w->far[j] = X * r - e;
        w->entry[j] = D[j] < 0;
    }
}

/* From where the line is nearest to the group's centre: floats of what is far
 * away are coarse.  x and t0 d are rounded, and so is their sum. */
static void start_near(way *w, const cylint_bvh *group, const double x[3],
                       const double d[3])
{
    const double far = fabs(x[0]) + fabs(x[1]) + fabs(x[2]);
    double near[3];
    w->t0 = -(x[0] * d[0] + x[1] * d[1] + x[2] * d[2]) /
            (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    w->slop = 0x1p-51 * fabs(w->t0);
    EACH(j, 3)
        near[j] = x[j] + w->t0 * d[j];
    start(w, group, near, d, cylint_float_above(0x1p-49 * far));
}

static inline void begin(way *w, const cylint_bvh *group, const double o[3],
                         const double d[3], double tmin, double tmax)
{
    double x[3];
    EACH(j, 3)
        x[j] = o[j] - (double)group->center[j];
    w->t0 = w->slop = 0;
    if (fabs(x[0]) + fabs(x[1]) + fabs(x[2]) < (double)group->near_by)
        start(w, group, x, d, 0);
    else
        start_near(w, group, x, d);
    w->first = below(w, tmin);
    w->last = above(w, tmax);
}

static inline void begin_ray(way *w, const cylint_bvh *group,
                             const cylint_float_ray *ray)
{
    const double o[3] = {ray->o[0], ray->o[1], ray->o[2]};
    const double d[3] = {ray->d[0], ray->d[1], ray->d[2]};
    begin(w, group, o, d, ray->tnear, ray->tfar);
}

/* Whether the domain ends outside the box of all: S is its longest side. */
static inline int leaves(const cylint_bvh *group, const cylint_float_ray *ray)
{
    const double S = (double)group->near_by / 256;
    const float o[3] = {ray->o[0], ray->o[1], ray->o[2]};
    const float d[3] = {ray->d[0], ray->d[1], ray->d[2]};
    int out = 0;
    EACH(j, 3)
        out |= fabs((double)o[j] - (double)group->center[j] +
                    (double)ray->tfar * (double)d[j]) > S;
    return out;
}

#endif
