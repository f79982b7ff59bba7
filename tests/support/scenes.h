/*
 * scenes.h - many shapes, and lines that are hard for a hierarchy of them
 *
 * Input of the tests of cylint_scene and of the adapter for Embree.  The seed
 * determines scene and line.  Threads may not draw at the same time.
 */
#ifndef CYLINT_SCENES_H
#define CYLINT_SCENES_H

#include <math.h>
#include <stdint.h>

#include "cylint_scene.h"

struct scene_shapes {
    const char *name;
    cylint_shape *shapes;
    size_t n;
    double lo[3], hi[3]; /* a box of the bounded shapes */
};

enum scene_kind { /* the first six lie in a cube of side cbrt(n) about 0 */
                  SCENE_THIN,
                  SCENE_FAT,
                  SCENE_FIBRES,
                  SCENE_NEEDLES,
                  SCENE_DISCS,
                  SCENE_MIXED,
                  SCENE_UNBOUNDED,
                  SCENE_DISTANT,
                  SCENE_LENGTHS,
                  SCENE_LATTICE,
                  SCENE_SMALL,
                  SCENE_HUGE,
                  SCENE_ROUND,
                  SCENE_STRANDS,
                  SCENE_STRAYS, /* a few shapes are far from the others */
                  SCENE_KINDS
};

/* Of the box. */
static inline double longest_side(const struct scene_shapes *scene)
{
    double longest = 0;
    for (int j = 0; j < 3; j++)
        longest = fmax(longest, scene->hi[j] - scene->lo[j]);
    return longest;
}

/* Whether doubles do not decide for most shapes of a scene of this kind.  Tests
 * take fewer of them. */
static inline int scene_is_slow(int kind)
{
    return kind == SCENE_SMALL || kind == SCENE_HUGE;
}

/* Generates a scene of a kind.  The caller frees it with scene_release(). */
struct scene_shapes scene_generate(int kind, size_t n, uint64_t seed);

void scene_release(struct scene_shapes *scene);

/* Shapes, or a scene, that are freed at the end of their block. */
#define OWN_SHAPES __attribute__((cleanup(scene_release))) struct scene_shapes
#define OWN_SCENE __attribute__((cleanup(scene_free))) cylint_scene

static inline void scene_free(cylint_scene **scene)
{
    cylint_scene_free(*scene);
}

enum scene_lines {
    LINES_CAMERA,   /* from one eye */
    LINES_RANDOM,   /* through two points of the box, |d| 1e-8 to 1e8 */
    LINES_GRAZING,  /* tangents at a hit, then moved by 0 to 1e-8 */
    LINES_AXIS,     /* down an axis, exactly or nearly */
    LINES_FAR,      /* to a shape from 1e3 to 1e16 sizes of the scene away */
    LINES_SHADOW,   /* from a rounded hit to a light */
    LINES_BEYOND,   /* the rest of a line behind a hit */
    LINES_SEGMENT,  /* between points of the box */
    LINES_SPAN,     /* domains of either sign, and whole lines */
    LINES_PARALLEL, /* to the coordinate axes, zeros of both signs */
    LINES_WILD,     /* subnormal or huge data, and lines that are refused */
    LINES_KINDS
};

/* Writes line `index` of a kind.  Returns its status. */
cylint_status scene_line(const struct scene_shapes *scene,
                         enum scene_lines kind, uint64_t seed, uint64_t index,
                         cylint_line *line);

#endif
