/*
 * traverse.h - which pieces of shapes a line may meet, nearest first
 *
 * From the first node of a group down to its blocks, by boxes and then by
 * lanes.  All of it is conservative: what is left out is certainly not met
 * within the domain, wherever the line begins.
 */
#ifndef CYLINT_BVH_TRAVERSE_H
#define CYLINT_BVH_TRAVERSE_H

#include "bvh.h"

/* o + t d in floats as they are, tnear <= t <= tfar: the first members of
 * Embree's rays, which need not be copied. */
typedef struct cylint_float_ray {
    float o[3], tnear, d[3], time, tfar;
} cylint_float_ray;

/*
 * Told of the lanes (bits) of a block that may be met; least[lane] is no
 * larger than the least t of a hit.  May make *tmax of the
 * line or tfar of the ray less.  Not 0: that is enough.
 */
typedef int cylint_ray_leaf_callback(void *self, const cylint_leaf *block,
                                     unsigned lanes,
                                     const float least[CYLINT_LEAF_SIZE]);
typedef int cylint_line_leaf_callback(void *self, const cylint_leaf *block,
                                      unsigned lanes,
                                      const double least[CYLINT_LEAF_SIZE]);

/*
 * The ray; or o + t d in doubles, tmin <= t <= *tmax, d off by 2^-52 of its
 * length (the high parts of a segment's).  The group is not empty.
 */
typedef void cylint_traverse_ray(const cylint_bvh *group,
                                 const cylint_float_ray *ray,
                                 cylint_ray_leaf_callback *meet, void *self);
typedef void cylint_traverse_line(const cylint_bvh *group, const double o[3],
                                  const double d[3], double tmin,
                                  const double *tmax,
                                  cylint_line_leaf_callback *meet, void *self);

/* Whether the ray certainly meets some shape: then it is not to be asked.  If
 * not, `meet` was told as above of what it may meet. */
typedef int cylint_traverse_occluded(const cylint_bvh *group,
                                     const cylint_float_ray *ray,
                                     cylint_ray_leaf_callback *meet,
                                     void *self);

/* As these two, from a child of some node on; the way, which has begun, ends
 * where the ray does.  `certain`: whether that it is certain is sought. */
struct cylint_ray_state;
typedef int cylint_traverse_subtree(const cylint_bvh *group, uint32_t child,
                                    struct cylint_ray_state *way,
                                    const cylint_float_ray *ray,
                                    cylint_ray_leaf_callback *meet, void *self,
                                    int certain);

typedef struct cylint_traversal {
    cylint_traverse_ray *ray;
    cylint_traverse_occluded *shadow;
    cylint_traverse_subtree *below;
    cylint_traverse_line *line;
} cylint_traversal;

/* A build that counts what is visited (make bench-embree); not for several
 * threads. */
#ifdef CYLINT_COUNT_VISITS
extern struct cylint_visits {
    unsigned long long nodes, blocks, lanes;
} cylint_visits;
#define cylint_visited(what, n) ((void)(cylint_visits.what += (n)))
#else
#define cylint_visited(what, n) ((void)0)
#endif

/* Those for this processor. */
const cylint_traversal *cylint_traversal_used(void);

/* The builds. */
extern const cylint_traversal cylint_traversal_plain, cylint_traversal_avx2;

#endif
