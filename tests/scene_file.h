/*
 * scene_file.h - opens the bytes of a file of a scene, and makes queries of it
 *
 * For damaged files: no query may read outside the bytes, fail or run without
 * end, whatever it returns.
 */
#ifndef SCENE_FILE_H
#define SCENE_FILE_H

#include <math.h>
#include <string.h>

#include "cylint_scene.h"
#include "../src/scene/file.h"

/* Makes the checksum right, in bytes at the begin of a cache line. */
static inline void scene_file_repair(void *data, size_t bytes)
{
    if (bytes >= 512 && bytes % 64 == 0) {
        const uint64_t sum = cylint_file_checksum(data, bytes);
        memcpy((char *)data + CYLINT_FILE_CHECKSUM, &sum, sizeof sum);
    }
}

/* `most` lines from all sides to the shape, and points about it. */
static inline void scene_file_query_at(const cylint_scene *scene, size_t number,
                                       int most)
{
    static const double d[][3] = {{1, 0, 0}, {0.25, -1, 0.5}, {-3, 2, 1}};
    double lo[3], hi[3], o[3];
    cylint_shape shape;
    cylint_scene_shape(scene, number, &shape);
    cylint_bounds(&shape, lo, hi);
    for (int k = 0; k < 3 && k < most; k++) {
        cylint_line line;
        cylint_hit hit;
        cylint_closest closest;
        size_t found[8];
        double away[8];
        for (int j = 0; j < 3; j++)
            o[j] =
                (lo[j] > -1e300 && hi[j] < 1e300 ? lo[j] / 2 + hi[j] / 2 : 0) -
                k * d[k][j];
        if (cylint_whole_line(&line, o, d[k]) != CYLINT_OK)
            continue;
        cylint_scene_nearest(scene, &line, CYLINT_WANT_ALL, &hit);
        cylint_scene_occluded(scene, &line, number);
        cylint_scene_count(scene, &line, 0);
        cylint_scene_all(scene, &line, 0, found, 8);
        cylint_scene_closest(scene, o, 2.0, 0, &closest);
        cylint_scene_within(scene, o, 1.0, 0, 0, found, away, 8);
    }
}

/* Opens the bytes and makes queries, `most` lines and points for each of 4 shapes.
 * Returns the status. */
static inline cylint_scene_status scene_file_try(const void *data, size_t bytes,
                                                 int most)
{
    cylint_scene_status status;
    cylint_scene *scene = cylint_scene_open_memory(data, bytes, 0, &status);
    if (!scene)
        return status;
    const size_t n = cylint_scene_size(scene);
    const cylint_scene_labels *labels = cylint_scene_get_labels(scene);
    uint64_t sum = 0;
    for (uint64_t i = 0; labels && n > 0 && i < labels->end[n - 1]; i++)
        sum += (uint64_t)labels->text[i];
    const size_t step = n / 4 + 1 + (size_t)(sum & 1);
    for (size_t i = 0; i < n; i += step)
        scene_file_query_at(scene, i, most);
    cylint_scene_free(scene);
    return status;
}

#endif
