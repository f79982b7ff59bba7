/*
 * module.c - all that cylint-embree.so adds to the libraries it is made of
 */
#include "../hierarchy.h"

CYLINT_API extern const struct hierarchy cylint_hierarchy;

const struct hierarchy cylint_hierarchy = {
    cylint_scene_new, cylint_scene_free, cylint_scene_strerror,
    cylint_scene_nearest, cylint_scene_count, cylint_scene_all};
