/*
 * hierarchy.h - cylint_scene.h as a table that is loaded when it is needed
 *
 * Embree is some 45 MB that few questions need, so the command does not link
 * it: cylint-embree.so, beside the command or in its library folder, has it
 * and this table under the name HIERARCHY_SYMBOL.
 */
#ifndef CYLINT_HIERARCHY_H
#define CYLINT_HIERARCHY_H

#include "cylint_scene.h"

#define HIERARCHY_MODULE "cylint-embree.so"
#define HIERARCHY_SYMBOL "cylint_hierarchy"

struct hierarchy {
    cylint_scene *(*make)(const cylint_shape *shapes, size_t n, int threads,
                          cylint_scene_status *status);
    void (*release)(cylint_scene *scene);
    const char *(*error)(int status);
    size_t (*nearest)(const cylint_scene *scene, const cylint_line *line,
                      unsigned want, cylint_hit *hit);
    size_t (*count)(const cylint_scene *scene, const cylint_line *line,
                    size_t enough);
    size_t (*all)(const cylint_scene *scene, const cylint_line *line,
                  size_t first, size_t *numbers, size_t room);
};

#endif
