/*
 * nearby.c - the shapes of a scene that are near a point
 */
#include <stdint.h>

#include "nearby.h"

static int is_near(const struct nearby *n, size_t shape, double radius,
                   double *distance)
{
    *distance = search_distance(n->search, shape, n->point);
    return *distance <= radius;
}

/* Compares all shapes that are not left out. */
static size_t closest_of_others(const struct nearby *n)
{
    const size_t count = n->search->count;
    size_t nearest = count;
    double least = n->radius, distance;
    for (size_t i = 0; i < count; i++) {
        if (!left_out_has(n->left_out, i) && is_near(n, i, least, &distance) &&
            (nearest == count || distance < least)) {
            nearest = i;
            least = distance;
        }
    }
    return nearest;
}

size_t nearby_closest(const struct nearby *n, unsigned want,
                      cylint_closest *closest)
{
    const size_t count = n->search->count;
    size_t shape =
        search_closest(n->search, n->point, n->radius, want, closest);
    if (shape < count && left_out_has(n->left_out, shape)) {
        shape = closest_of_others(n);
        if (shape < count) {
            cylint_distance(&n->search->shapes[shape], n->point, want, closest);
        }
    }
    return shape;
}

unsigned long long nearby_count(const struct nearby *n, unsigned long long most)
{
    size_t left_out = 0;
    for (int i = 0; i < n->left_out->count; i++) {
        const size_t *shapes;
        const size_t count = left_out_shapes(n->left_out, i, &shapes);
        for (size_t k = 0; k < count; k++) {
            double distance;
            left_out += (size_t)is_near(n, shapes[k], n->radius, &distance);
        }
    }
    const size_t enough = most < SIZE_MAX ? (size_t)most + left_out : 0;
    return search_within_count(n->search, n->point, n->radius, enough) -
           left_out;
}
