/*
 * nearby.c - the shapes of a scene that are near a point
 */
#include <math.h>

#include "nearby.h"

struct closest {
    const struct nearby *query;
    size_t shape; /* from 1; 0: none */
    double distance;
};

static double keep_closest(void *context, size_t number, double distance,
                           int flags)
{
    struct closest *c = context;
    const double size = search_compared(c->query->want, distance);
    (void)flags;
    if (!left_out_has(c->query->left_out, number) &&
        (c->shape == 0 || size < c->distance ||
         (!(size > c->distance) && number + 1 < c->shape))) {
        c->shape = number + 1;
        c->distance = size;
    }
    return c->shape > 0 ? c->distance : HUGE_VAL;
}

size_t nearby_closest(const struct nearby *n)
{
    struct closest c = {.query = n};
    search_visit_point(n->search, n->point, n->radius, n->want, keep_closest,
                       &c);
    return c.shape;
}

struct counter {
    const struct nearby *query;
    unsigned long long count, most;
};

static double count_near(void *context, size_t number, double distance,
                         int flags)
{
    struct counter *c = context;
    (void)distance;
    (void)flags;
    c->count += !left_out_has(c->query->left_out, number);
    return c->count == c->most ? (double)NAN : HUGE_VAL;
}

unsigned long long nearby_count(const struct nearby *n, unsigned long long most)
{
    struct counter c = {.query = n, .most = most};
    search_visit_point(n->search, n->point, n->radius, n->want, count_near, &c);
    return c.count;
}
