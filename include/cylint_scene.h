/*
 * cylint_scene - one line against very many shapes, by a hierarchy of boxes
 *
 * A scene answers what cylint_nearest() and cylint_count() of cylint.h
 * answer for all of its shapes, bit for bit: the hierarchy only says which
 * shapes need not be asked.  That holds for every line and shape that can be
 * made, refused ones included; unbounded shapes and a few wild ones (below)
 * are asked by batch, beside the hierarchy.
 *
 * In libcylint-scene, and again in libcylint-embree.  A scene is only read by
 * queries: any number of threads may ask one.  Making one allocates, by
 * malloc(); no query does.  Nothing is printed.
 */
#ifndef CYLINT_SCENE_H
#define CYLINT_SCENE_H

#include "cylint.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct cylint_scene cylint_scene;

typedef enum cylint_scene_status {
    CYLINT_SCENE_OK = 0,
    CYLINT_SCENE_EMEMORY, /* there is not enough memory */
    CYLINT_SCENE_ESIZE    /* more than 2^28 shapes */
} cylint_scene_status;

/* A short English text for a status, static, lower case, no full stop. */
CYLINT_API const char *cylint_scene_strerror(int status);

/*
 * A scene of n shapes, which the caller keeps, unchanged, as long as the
 * scene is used; they are known by their numbers, 0 to n - 1.  `threads` is
 * how many may build it, the caller's one of them, 0 for as many as there are
 * processors; not so many if the shapes are few, one where the library was
 * built without POSIX threads: the scene is the same.  NULL if that fails;
 * *status says why, unless `status` is NULL.
 *
 * Not in the hierarchy, and so asked in a batch for every line, are shapes
 * without end (infinite, nappe) and those with a coordinate beyond 2^400; and
 * all, if their common box is smaller than 2^-400.
 */
CYLINT_API cylint_scene *cylint_scene_new(const cylint_shape *shapes, size_t n,
                                          int threads,
                                          cylint_scene_status *status);

/* NULL is allowed. */
CYLINT_API void cylint_scene_free(cylint_scene *scene);

/* Bytes of memory that the scene keeps, the caller's shapes not counted. */
CYLINT_API size_t cylint_scene_bytes(const cylint_scene *scene);

/* The number of the shape that the line meets first, its hit in *hit as far
 * as wanted; n if it meets none.  Of equal t the lower number.
 * CYLINT_WANT_FAST makes no difference: t is the double nearest to the
 * root. */
CYLINT_API size_t cylint_scene_nearest(const cylint_scene *scene,
                                       const cylint_line *line, unsigned want,
                                       cylint_hit *hit);

/* The number of shapes that the line meets; at most `enough`, where that is
 * not 0: with 1, whether it meets any. */
CYLINT_API size_t cylint_scene_count(const cylint_scene *scene,
                                     const cylint_line *line, size_t enough);

/* 1 if the line meets a shape other than number `except`; n: any shape.  For
 * a ray that begins on the surface of a shape, in a point that was rounded:
 * where the ray leaves a convex solid, it does not meet it again. */
CYLINT_API int cylint_scene_occluded(const cylint_scene *scene,
                                     const cylint_line *line, size_t except);

/* Writes the numbers of the shapes that the line meets, from the number
 * `first` on, ascending, at most `room` of them, and returns how many: all
 * of them where that is less than `room`; otherwise the next ones are had by
 * asking again, from behind the last. */
CYLINT_API size_t cylint_scene_all(const cylint_scene *scene,
                                   const cylint_line *line, size_t first,
                                   size_t *numbers, size_t room);

#ifdef __cplusplus
}
#endif

#endif
