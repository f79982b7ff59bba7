/*
 * connected.c - groups of connected shapes
 *
 * A hash table maps the bits of an end point to the first shape with that end.
 * Groups are trees of shapes (union-find); the root has the lowest number.
 */
#include <stdlib.h>
#include <string.h>

#include "connected.h"
#include "main.h"
#include "report.h"
#include "sampling.h"
#include "scene.h"
#include "vector.h"
#include "../../src/shapes/layout.h"

struct ends {
    const struct scene *scene;
    uint32_t *slot; /* 2 i + e + 1 for end e of shape i; 0: free */
    size_t slots;   /* a power of two above the number of ends */
};

static struct vector end_point(const struct ends *ends, uint32_t end)
{
    cylint_shape shape;
    scene_shape(ends->scene, end >> 1, &shape);
    const double *p = end & 1 ? cylint_top(&shape) : cylint_base(&shape);
    return vector(p[0], p[1], p[2]);
}

static uint32_t hash_point(const double p[3])
{
    uint32_t hash = 0;
    for (int i = 0; i < 3; i++) {
        const double value = p[i] + 0.0; /* -0 becomes 0 */
        uint32_t words[2];
        memcpy(words, &value, sizeof words);
        hash = hash_words(hash_words(hash, words[0]), words[1]);
    }
    return hash;
}

static int same_point(const double p[3], const double q[3])
{
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

/* The first end at the same point; it may be this one. */
static uint32_t first_end(const struct ends *ends, uint32_t end)
{
    const struct vector p = end_point(ends, end);
    size_t at = hash_point(p.v) & (ends->slots - 1);
    while (ends->slot[at] != 0) {
        const struct vector other = end_point(ends, ends->slot[at] - 1);
        if (same_point(p.v, other.v))
            return ends->slot[at] - 1;
        at = (at + 1) & (ends->slots - 1);
    }
    ends->slot[at] = end + 1;
    return end;
}

/* The root of i's tree; shortens the path to it. */
static uint32_t root_of(uint32_t *parent, uint32_t i)
{
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static void join(uint32_t *parent, uint32_t a, uint32_t b)
{
    a = root_of(parent, a);
    b = root_of(parent, b);
    parent[a < b ? b : a] = a < b ? a : b;
}

/* Whether the shape is made of two points. */
static int has_ends(const cylint_shape *s)
{
    return s->kind == CYLINT_KIND_CYLINDER || s->kind == CYLINT_KIND_CONE ||
           s->kind == CYLINT_KIND_SPHERE || s->kind == CYLINT_KIND_CAPSULE ||
           s->kind == CYLINT_KIND_RCONE;
}

static void join_shapes(const struct ends *ends, size_t n, uint32_t *parent)
{
    for (uint32_t i = 0; i < n; i++) {
        cylint_shape shape;
        scene_shape(ends->scene, i, &shape);
        if (has_ends(&shape)) {
            join(parent, i, first_end(ends, 2 * i) >> 1);
            join(parent, i, first_end(ends, 2 * i + 1) >> 1);
        }
    }
}

/* A root has a lower number than its descendants, so its group gets a number
 * before they read it. */
static void number_groups(uint32_t *group, size_t n)
{
    uint32_t groups = 0;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t parent = group[i];
        group[i] = parent == i ? groups++ : group[parent];
    }
}

int connected_groups(const struct scene *scene, uint32_t *group)
{
    const size_t n = scene->count;
    struct ends ends = {scene, NULL, 2};
    if (n > UINT32_MAX / 8)
        return out_of_memory();
    while (ends.slots < 4 * n)
        ends.slots *= 2;
    ends.slot = calloc(ends.slots, sizeof *ends.slot);
    if (!ends.slot)
        return out_of_memory();
    for (uint32_t i = 0; i < n; i++)
        group[i] = i;
    join_shapes(&ends, n, group);
    free(ends.slot);
    number_groups(group, n);
    return 0;
}
