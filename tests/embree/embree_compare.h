/*
 * embree_compare.h - compares the adapter with the library
 *
 * Embree traces a ray of floats; the library answers the same line in doubles;
 * the answers must have the same bits.
 */
#ifndef CYLINT_EMBREE_COMPARE_H
#define CYLINT_EMBREE_COMPARE_H

#include <math.h>
#include <string.h>

#include "check.h"
#include "embree_world.h"
#include "families.h"

static const unsigned both_ways[2] = {0, CYLINT_EMBREE_SINGLE};

static inline struct world world_with(const cylint_shape *shapes, size_t n,
                                      unsigned how)
{
    return world_made(shapes, n, &(cylint_embree_options){.flags = how});
}

/* For the world w of the shapes, with a hierarchy and then without. */
#define EACH_WAY(w, shapes, n)                                                \
    for (int way = 0; way < 2; way++)                                         \
        for (struct world w = world_with(shapes, n, both_ways[way]); w.scene; \
             world_free(&w))

/* A shape of a kind with these ends, near the origin and about 1 large. */
static inline cylint_shape any_shape(int kind, cylint_ends ends)
{
    const int family =
        family_named(kind < CYLINT_KIND_SPHERE ? "ordinary" : "round");
    struct family_case c;
    do
        family_case(random_bits(&stream), family, 0, &c);
    while (c.shape.kind != kind ||
           (int)c.shape_word != kind - CYLINT_KIND_CYLINDER);
    c.ends = kind == CYLINT_KIND_SPHERE ? CYLINT_ENDS_CAPPED : ends;
    family_make(&c);
    return c.shape;
}

enum { SOME = 200 };

/* A ray to a point among SOME shapes, from up to three sides of their cube
 * away, with a direction of a length from 1e-3 to 1e3; some rays begin
 * inside. */
static inline void aim(struct rays *r, int i)
{
    float o[3], d[3];
    const double side = cbrt(SOME), far = between(0, 3);
    const double length = power(-3, 3);
    world_direction(d);
    for (int k = 0; k < 3; k++) {
        o[k] = (float)(side * (between(-0.5, 0.5) - far * d[k]));
        d[k] = (float)(length * d[k]);
    }
    rays_add(r, i, o, d, 0, HUGE_VALF);
}

static inline void aim_all(struct rays *r, int n)
{
    rays_begin(r, n);
    for (int i = 0; i < n; i++)
        aim(r, i);
}

static inline int shadow_expected(const struct world *w, const struct rays *r,
                                  int i)
{
    const cylint_line line = rays_line(r, i);
    return cylint_count(&w->pack, &line, 1) != 0;
}

static inline void check_answers_of(const struct world *w, struct rays *r)
{
    for (int i = 0; i < r->n; i++)
        if (r->valid[i] && !CHECK(world_agrees(w, r, i, 1)))
            world_show(w, r, i);
    CHECK(rays_strayed(r, 0) == 0);
}

static inline void check_some_rays(const struct world *w)
{
    for (int i = 0; i < 100; i++) {
        struct rays r;
        aim_all(&r, rays_sizes[i % 4]);
        rays_intersect(&r, w->scene, NULL);
        check_answers_of(w, &r);
    }
}

/* Traces the rays for nearest and for any hit, and checks the answers.  Returns the
 * number of nearest hits. */
static inline int check_both_queries(const struct world *w, struct rays *r,
                                     const struct rays_query *query)
{
    int hits = 0;
    rays_intersect(r, w->scene, query);
    check_answers_of(w, r);
    for (int i = 0; i < r->n; i++)
        hits += r->valid[i] && rays_hit(r, i);
    memcpy(r->word, r->before, sizeof r->word);
    rays_occluded(r, w->scene, query);
    for (int i = 0; i < r->n; i++)
        if (r->valid[i] &&
            !CHECK(rays_shadowed(r, i) == shadow_expected(w, r, i)))
            world_show(w, r, i);
    CHECK(rays_strayed(r, 1) == 0);
    return hits;
}

/* Traces n rays that are the same. */
static inline struct rays equal_rays(RTCScene scene, int n, const float o[3],
                                     const float d[3], float tnear, float tfar)
{
    struct rays r;
    rays_begin(&r, n);
    for (int i = 0; i < n; i++)
        rays_add(&r, i, o, d, tnear, tfar);
    rays_intersect(&r, scene, NULL);
    return r;
}

/* The same, and checks the answers. */
static inline struct rays traced(const struct world *w, int n, const float o[3],
                                 const float d[3], float tnear, float tfar)
{
    struct rays r = equal_rays(w->scene, n, o, d, tnear, tfar);
    check_answers_of(w, &r);
    return r;
}

#endif
