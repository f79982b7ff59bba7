/*
 * walk.c - from the first node to the lanes of blocks
 */
#include "walk.h"

#include <string.h>

#include "lanetest.h"

#ifndef CYLINT_WALKS
#define CYLINT_WALKS cylint_walks_plain
#endif

/*
 * A line on its way: x + t d, x counted from the group's centre, with r = 1 /
 * d.  near and far are x r, more and less what entries into boxes and exits
 * may be off by.
 */
typedef struct {
    float r[3], near[3], far[3];
    int entry[3];         /* the face by which it enters boxes: 0 or 1 */
    float first, last;    /* t between; t here is that of the line ... */
    double t0, slop;      /* ... less t0, and may be off by so much */
} way;

/* ---------------------------------------------------------------- boxes -- */

/*
 * Which boxes of a node the line may meet, and where it enters them.  A face
 * at corner + q step is crossed at t = (corner + q step - x) r.  With u =
 * 2^-24, S the longest side of all boxes, |corner| and q step at most S:
 *
 *   r is wrong by u of itself, so t by 2 u S |r|, and, r being another where x
 *   r is made, by u |x r|; x r is rounded twice, corner r - x r once, step r
 *   once, q step r twice if it is not fused, and their sum once,
 *
 * in all by less than 8 u (|x| + S) |r|.  start() allows for 16 u.  That
 * moves a face by another 2^-21 S, more than what it moves when a d below
 * 2^-60 of the largest is taken for that much, on 2^10 S of a line.  What is
 * flushed to zero is less than FLT_MIN each.  Where something overflows,
 * f_higher() and f_lower() leave out what is not a number.
 */
CYLINT_INLINE unsigned boxes_met(const cylint_node *node, const way *w,
                                 uint32_t enter[CYLINT_CHILDREN])
{
    unsigned met = 0;
    for (int i = 0; i < CYLINT_CHILDREN; i += WIDTH) {
        vf from = f_set(w->first), to = f_set(w->last);
        EACH(j, 3) {
            const vf q0 = f_from_bytes(node->face[w->entry[j]][j] + i);
            const vf q1 = f_from_bytes(node->face[1 - w->entry[j]][j] + i);
            const vf r = f_set(w->r[j]), corner = f_set(node->corner[j]);
            const vf b = f_set(node->step[j]) * r;
            from = f_higher(f_mad(q0, b, f_mad(corner, r,
                                               f_set(-w->near[j]))), from);
            to = f_lower(f_mad(q1, b, f_mad(corner, r,
                                            f_set(-w->far[j]))), to);
        }
        f_store_keys(enter + i, from);
        met |= f_not_greater(from, to) << i;
    }
    return met & node->children;
}

/* ----------------------------------------------------------------- order -- */

/* What is still to be visited, the next one last: where it is entered (a key,
 * in the upper half), and which child it is.  As one number, for it cannot be
 * foreseen which is nearer, and what cannot must not be a branch. */
typedef struct {
    uint64_t stop[CYLINT_DEPTH * (CYLINT_CHILDREN - 1) + 1];
    int n;
} stack;

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

static inline void fetch(const cylint_group *group, uint32_t child)
{
#ifdef __GNUC__
    if (child & CYLINT_LEAF) {
        const char *block = (const char *)&group->blocks[child & ~CYLINT_LEAF];
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

/* Keeps those met for later, nearer ones above, but the nearest one, which it
 * returns. */
CYLINT_INLINE uint32_t nearest_of(stack *s, const cylint_group *group,
                                  const cylint_node *node, unsigned met,
                                  const uint32_t enter[CYLINT_CHILDREN])
{
    const int first = cylint_lowest(met);
    uint64_t *const from = s->stop + s->n, *to = from;
    uint64_t next = stop_at(enter[first], node->child[first]);
    fetch(group, (uint32_t)next);
    while ((met &= met - 1)) {
        const int i = cylint_lowest(met);
        const uint64_t other = stop_at(enter[i], node->child[i]);
        fetch(group, (uint32_t)other);
        uint64_t later = other > next ? other : next, *at = to++;
        next = other > next ? next : other;
        for (; at > from && at[-1] < later; at--)
            at[0] = at[-1];
        *at = later;
    }
    s->n += (int)(to - from);
    return (uint32_t)next;
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
static inline void start(way *w, const cylint_group *group,
                         const double x[3], const double d[3], float off)
{
    const float D[3] = {(float)d[0], (float)d[1], (float)d[2]};
    const float least = larger(fabsf(D[0]), larger(fabsf(D[1]), fabsf(D[2]))) *
                        0x1p-60f;
    EACH(j, 3) {
        const float r = 1 / (fabsf(D[j]) >= least ? D[j]
                               : D[j] < 0 ? -least : least);
        const float X = (float)x[j];
        const float e = fabsf(r) * (fabsf(X) * 0x1p-20f + group->pad + off) +
                        16 * FLT_MIN;
        w->r[j] = r;
        w->near[j] = X * r + e;
        w->far[j] = X * r - e;
        w->entry[j] = D[j] < 0;
    }
}

/* From where the line is nearest to the group's centre: floats of what is far
 * away are coarse.  x and t0 d are rounded, and so is their sum. */
static void start_near(way *w, const cylint_group *group, const double x[3],
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

static inline void begin(way *w, const cylint_group *group, const double o[3],
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

/* The next block, or NULL.  Whoever asks for one before he looks at the last
 * finds that in the cache. */
CYLINT_INLINE const cylint_block *next_block(stack *s,
                                             const cylint_group *group,
                                             const way *w)
{
    while (s->n > 0) {
        const uint64_t next = s->stop[--s->n];
        if (next >> 32 > key_of(w->last))
            continue;
        uint32_t child = (uint32_t)next;
        for (;;) {
            if (child & CYLINT_LEAF) {
                cylint_visited(blocks, 1);
                return &group->blocks[child & ~CYLINT_LEAF];
            }
            const cylint_node *node = &group->nodes[child];
            uint32_t enter[CYLINT_CHILDREN];
            const unsigned met = boxes_met(node, w, enter);
            cylint_visited(nodes, 1);
            if (!met)
                break;
            child = nearest_of(s, group, node, met, enter);
        }
    }
    return NULL;
}

static inline void set_out(stack *s, const way *w)
{
    s->stop[0] = stop_at(key_of(w->first), 0);
    s->n = 1;
}

/* Whether the domain ends outside the box of all: S is its longest side. */
static int leaves(const cylint_group *group, const double o[3],
                  const double d[3], double tmax)
{
    const double S = (double)group->near_by / 256;
    int out = 0;
    EACH(j, 3)
        out |= fabs(o[j] - (double)group->center[j] + tmax * d[j]) > S;
    return out;
}

/* A shape that holds a point of a line which ends outside is met behind that
 * point; `certain`: that is enough. */
CYLINT_INLINE int walk_rays(const cylint_group *group,
                            const cylint_float_ray *ray, cylint_meet_ray *meet,
                            void *self, int certain)
{
    const double o[3] = {ray->o[0], ray->o[1], ray->o[2]};
    const double d[3] = {ray->d[0], ray->d[1], ray->d[2]};
    const float E = size_of(ray);
    const cylint_block *block, *next;
    float least[CYLINT_BLOCK];
    way w;
    stack s;
    begin(&w, group, o, d, ray->tnear, ray->tfar);
    set_out(&s, &w);
    certain = certain && leaves(group, o, d, ray->tfar);
    for (next = next_block(&s, group, &w); (block = next); ) {
        unsigned sure = 0;
        next = next_block(&s, group, &w);
        const unsigned lanes = test_ray(block, ray, E, least,
                                        certain ? &sure : NULL);
        if (!lanes)
            continue;
        if (sure && block->used & CYLINT_SOLID)
            return 1;
        if (meet(self, block, lanes, least))
            return 0;
        w.last = above(&w, ray->tfar);
    }
    return 0;
}

static void walk_ray(const cylint_group *group, const cylint_float_ray *ray,
                     cylint_meet_ray *meet, void *self)
{
    walk_rays(group, ray, meet, self, 0);
}

static int walk_shadow(const cylint_group *group,
                       const cylint_float_ray *ray,
                       cylint_meet_ray *meet, void *self)
{
    return walk_rays(group, ray, meet, self, 1);
}

static void walk_line(const cylint_group *group, const double o[3],
                      const double d[3], double tmin, const double *tmax,
                      cylint_meet_line *meet, void *self)
{
    const cylint_block *block, *next;
    double least[CYLINT_BLOCK];
    way w;
    stack s;
    begin(&w, group, o, d, tmin, *tmax);
    set_out(&s, &w);
    for (next = next_block(&s, group, &w); (block = next); ) {
        next = next_block(&s, group, &w);
        const unsigned lanes = test_line(block, o, d, tmin, *tmax, least);
        if (!lanes)
            continue;
        if (meet(self, block, lanes, least))
            return;
        w.last = above(&w, *tmax);
    }
}

const cylint_walks CYLINT_WALKS = {walk_ray, walk_shadow, walk_line};
