/*
 * connected.c - groups of connected shapes
 *
 * The bits of an end point are a name; its number leads to the first shape with
 * that end.  Groups are trees of shapes (union-find); the root has the lowest
 * number.
 */
#include <stdlib.h>

#include "colours.h"
#include "../../src/shapes/shape_facts.h"

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

/* The end points so far, and the first shape of each. */
struct joints {
    struct names points;
    uint32_t *first;
};

/* Joins shape i with the first shape that has an end at p.  Returns 0 if there is
 * no memory. */
static int join_end(struct joints *joints, uint32_t *parent, uint32_t i,
                    const double *p)
{
    const struct vector point = plus(vector(0, 0, 0), 1, vector_of(p));
    const struct string bits = {(const char *)point.v, sizeof point.v};
    const size_t before = joints->points.texts.count;
    size_t number;
    if (!names_add(&joints->points, bits, &number))
        return 0;
    if (number == before)
        joints->first[number] = i;
    join(parent, i, joints->first[number]);
    return 1;
}

static int join_shapes(struct joints *joints, const struct scene *scene,
                       uint32_t *parent)
{
    int has_memory = 1;
    for (uint32_t i = 0; i < scene->count && has_memory; i++) {
        cylint_shape shape;
        cylint_scene_shape(scene->shapes, i, &shape);
        if (shape.kind != CYLINT_KIND_NONE && cylint_has_end_points(shape.kind))
            has_memory = join_end(joints, parent, i, cylint_base(&shape)) &&
                         join_end(joints, parent, i, cylint_top(&shape));
    }
    return has_memory;
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
    struct joints joints = {.first = NULL};
    if (n < UINT32_MAX / 8)
        joints.first = malloc((2 * n + 1) * sizeof *joints.first);
    for (uint32_t i = 0; i < n && joints.first; i++)
        group[i] = i;
    const int has_memory = joints.first && join_shapes(&joints, scene, group);
    free(joints.first);
    names_free(&joints.points);
    if (!has_memory)
        return out_of_memory();
    number_groups(group, n);
    return 0;
}
