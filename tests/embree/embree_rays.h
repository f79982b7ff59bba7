/*
 * embree_rays.h - rays for Embree 3 and 4 as words, checked for stray writes
 *
 * Embree lays out n rays member by member: member m of ray i is word m n + i,
 * for n = 1 too; a hit's members follow the ray's.  So one array of words holds
 * single rays and packets of 4, 8 and 16, and every word that a query must not
 * write can be compared with its value before.
 */
#ifndef CYLINT_EMBREE_RAYS_H
#define CYLINT_EMBREE_RAYS_H

#include "cylint.h"
#include "cylint_embree.h"
#include "embree/geometry.h"

enum ray_member {
    RAY_ORG = 0, /* x, y, z */
    RAY_TNEAR = 3,
    RAY_DIR = 4, /* x, y, z */
    RAY_TIME = 7,
    RAY_TFAR = 8,
    RAY_MASK,
    RAY_ID,
    RAY_FLAGS,
    HIT_NG = 12, /* x, y, z */
    HIT_U = 15,
    HIT_V,
    HIT_PRIM,
    HIT_GEOM,
    HIT_INST,
#if RTC_VERSION_MAJOR >= 4
    HIT_INST_PRIM,
#endif
    RAY_MEMBERS
};

enum {
    RAYS_MOST = 16,
    RAYS_WORDS = sizeof(struct RTCRayHit16) / 4,
    RAYS_BEYOND = 16 /* words after the last that no query may write */
};

union ray_word {
    float f;
    unsigned u;
};

/* The numbers of rays that Embree traces at once. */
static const int rays_sizes[4] = {1, 4, 8, 16};
#define EACH_SIZE(n) for (int n = 1; n <= 16; n = n == 1 ? 4 : 2 * n)

/* Rays are added one by one; the others are inactive. */
struct rays {
    union ray_word word[RAYS_WORDS + RAYS_BEYOND];
    int valid[RAYS_MOST];
    union ray_word before[RAYS_WORDS + RAYS_BEYOND]; /* before the query */
    int n;
} __attribute__((aligned(64)));

void rays_begin(struct rays *, int n);
void rays_add(struct rays *, int i, const float o[3], const float d[3],
              float tnear, float tfar);
union ray_word *rays_at(struct rays *, enum ray_member, int i);

/* Arguments of a query; NULL: the defaults. */
struct rays_query {
    RTCFilterFunctionN filter; /* the context's (3), the arguments' (4) */
    int coherent;
    void *user;        /* for the filter: see rays_user() */
    unsigned instance; /* in which the query runs, from 1; 0: in none */
};
void rays_intersect(struct rays *, RTCScene, const struct rays_query *);
void rays_occluded(struct rays *, RTCScene, const struct rays_query *);

/*
 * Whether Embree traces packets of n rays as such on this processor.  Otherwise
 * Embree 3 traces them as a stream: it ignores `valid`, so that only an empty
 * domain makes a ray inactive (the queries above write one), and it copies every
 * member of a hit, so that u, v and Ng of a bare hit are undefined.
 */
int rays_are_native(RTCScene, int n);

/* In a filter: the query's `user`. */
void *rays_user(const struct RTCFilterFunctionNArguments *);

/* The arguments of a filter for ray i: its words, ray and hit apart. */
float rays_filter_t(const struct RTCFilterFunctionNArguments *, int i);
unsigned rays_filter_prim(const struct RTCFilterFunctionNArguments *, int i);

/* After a query: whether ray i was hit, or is occluded. */
int rays_hit(struct rays *, int i);
int rays_shadowed(struct rays *, int i);

/* The number of words that the last query changed without a right to: those of
 * inactive rays, of an active ray's input, beyond the last; after
 * rays_occluded() all but tfar of active rays. */
int rays_strayed(const struct rays *, int occlusion);

/* Ray i as a line in doubles, with its domain as it was before the query. */
cylint_line rays_line(const struct rays *, int i);

#endif
