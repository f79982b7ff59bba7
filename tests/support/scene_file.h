/*
 * scene_file.h - opens the bytes of a file of a scene, and makes queries of it
 *
 * For damaged files: no query may read outside the bytes, fail or run without
 * end, whatever it returns.  But the same query always returns the same.
 */
#ifndef SCENE_FILE_H
#define SCENE_FILE_H

#include <math.h>
#include <string.h>

#include "cylint_scene.h"
#include "../../src/scene/scene.h"
#include "../fuzz/fuzz.h"

/* ---------------------------------------------------------------- bytes -- */

enum { SCENE_FILE_MOST = 1 << 20 };

/* Bytes at the start of a cache line. */
struct bytes {
    char *memory, *data;
    size_t n; /* SCENE_FILE_MOST at most */
};

static inline void bytes_reserve(struct bytes *b)
{
    free(b->memory);
    b->memory = malloc(SCENE_FILE_MOST + 64);
    b->data = b->memory + (64 - (uintptr_t)b->memory % 64);
    b->n = 0;
}

static inline void bytes_free(struct bytes *b)
{
    free(b->memory);
}

/* Bytes that are freed at the end of their block. */
#define OWN_BYTES __attribute__((cleanup(bytes_free))) struct bytes

static inline int bytes_append(void *context, const void *data, size_t n)
{
    struct bytes *b = context;
    if (n > SCENE_FILE_MOST - b->n)
        return 0;
    memcpy(b->data + b->n, data, n);
    b->n += n;
    return 1;
}

/* Writes the file of a small scene; b->memory is freed by the caller. */
static inline void scene_file_write(const cylint_scene *scene, struct bytes *b)
{
    bytes_reserve(b);
    MUST(cylint_scene_write(scene, bytes_append, b) == CYLINT_SCENE_OK);
}

/* The scene of this file, which is in b->data. */
static inline cylint_scene *scene_file_reopen(const cylint_scene *scene,
                                              struct bytes *b)
{
    scene_file_write(scene, b);
    return cylint_scene_open_memory(b->data, b->n, 0, NULL);
}

/* Makes the checksum right, in bytes at the start of a cache line. */
static inline void scene_file_repair(void *data, size_t bytes)
{
    if (bytes >= 512 && bytes % 64 == 0) {
        const uint64_t sum = cylint_file_checksum(data, bytes);
        memcpy((char *)data + CYLINT_FILE_CHECKSUM, &sum, sizeof sum);
    }
}

/* The bytes of each section, in the order of FILE_ARRAYS (src/scene/file.c). */
static inline uint64_t *scene_file_sizes(const struct bytes *b)
{
    return (uint64_t *)(void *)(b->data + 56);
}

static inline void *scene_file_section(const struct bytes *b, int section)
{
    char *at = b->data + 512;
    for (int i = 0; i < section; i++)
        at += (scene_file_sizes(b)[i] + 63) / 64 * 64;
    return at;
}

/* -------------------------------------------------------------- queries -- */

enum { SCENE_FILE_FOUND = 8 };

/* The numbers ascend from `first`. */
static inline void scene_file_check_order(const size_t *number, size_t count,
                                          size_t n)
{
    MUST(count <= SCENE_FILE_FOUND);
    for (size_t i = 0; i < count; i++)
        MUST(number[i] < n && (i == 0 || number[i] >= number[i - 1]));
}

/* Counts visits; the last ones are not wanted. */
static inline double scene_file_count_hit(void *context, size_t number,
                                          const cylint_hit *hit)
{
    size_t *left = context;
    (void)number;
    return --*left == 0 ? (double)NAN : hit ? hit->t : HUGE_VAL;
}

static inline double scene_file_count_near(void *context, size_t number,
                                           double distance, int flags)
{
    size_t *left = context;
    (void)number;
    (void)flags;
    return --*left == 0 ? (double)NAN : fabs(distance);
}

static inline cylint_lines scene_file_column(const cylint_line *line)
{
    return (cylint_lines){.n = 1,
                          .o = {line->o, line->o + 1, line->o + 2},
                          .d = {line->d, line->d + 1, line->d + 2},
                          .tmin = &line->tmin,
                          .tmax = &line->tmax};
}

static inline void scene_file_query_line(const cylint_scene *scene,
                                         const cylint_line *line, size_t number)
{
    const size_t n = cylint_scene_size(scene);
    const cylint_lines lines = scene_file_column(line);
    cylint_hit hit;
    double t = 0;
    size_t found[SCENE_FILE_FOUND], left = 3, same = 0, count = 0;
    signed char any = 0;
    const cylint_hit_columns hits = {.t = &t};
    const size_t nearest =
        cylint_scene_nearest(scene, line, CYLINT_WANT_ALL, &hit);
    cylint_scene_nearest_lines(scene, &lines, NULL, 1, &same, &hits);
    MUST(same == nearest && (same == n ? t != t : !(t < hit.t || t > hit.t)));
    cylint_scene_nearest_other(scene, line, number, CYLINT_WANT_T, &hit);
    cylint_scene_any_lines(scene, &lines, &number, 1, &any);
    MUST(cylint_scene_occluded(scene, line, number) == any);
    cylint_scene_count_lines(scene, &lines, 0, 1, &count);
    MUST(cylint_scene_count(scene, line, 0) == count);
    count = cylint_scene_all(scene, line, 0, found, SCENE_FILE_FOUND);
    scene_file_check_order(found, count, n);
    cylint_scene_visit(scene, line, CYLINT_WANT_T, scene_file_count_hit, &left);
}

/* In every mode, and the first boundary. */
static inline void scene_file_query_pieces(const cylint_scene *scene,
                                           const cylint_line *line)
{
    enum { PIECES = 5, BYTES = 1 << 15 };
    static double memory[BYTES / sizeof(double)];
    const size_t n = cylint_scene_size(scene);
    const cylint_lines lines = scene_file_column(line);
    cylint_workspace work = {memory, BYTES, 0};
    cylint_hit hit;
    for (int mode = 0; mode <= CYLINT_PIECES_CHORDS; mode++) {
        const cylint_piece_rule rule = {.mode = (cylint_piece_mode)mode};
        cylint_piece piece[PIECES];
        const size_t count =
            cylint_scene_pieces(scene, line, &rule, piece, PIECES, &work);
        MUST(count != CYLINT_NO_ROOM && count <= PIECES);
        for (size_t i = 0; i < count; i++)
            MUST(piece[i].t0 < piece[i].t1 && piece[i].shape < n &&
                 piece[i].depth > 0 &&
                 (i == 0 || piece[i].t0 >= piece[i - 1].t0));
    }
    const cylint_piece_rule by_owner = {.mode = CYLINT_PIECES_OWNER};
    cylint_piece_rows rows;
    double sum;
    MUST(cylint_scene_pieces_lines(scene, &lines, &by_owner, 0, 1, &rows) ==
         CYLINT_SCENE_OK);
    MUST(cylint_scene_line_sums(scene, line, &by_owner, NULL, 1, 0, &sum) ==
         CYLINT_SCENE_OK);
    MUST((sum > 0) == (rows.first[1] > 0));
    cylint_piece_rows_free(&rows);
    cylint_scene_first_boundary(scene, line, CYLINT_WANT_ALL, &hit, &work);
    size_t owner;
    cylint_scene_depth(scene, line->o, NULL, &owner, &work);
    MUST(owner <= n);
}

static inline void scene_file_query_point(const cylint_scene *scene,
                                          const double o[3])
{
    const size_t n = cylint_scene_size(scene);
    const cylint_points points = {.n = 1, .xyz = {o, o + 1, o + 2}};
    cylint_closest closest;
    double away[SCENE_FILE_FOUND], distance = 0;
    size_t found[SCENE_FILE_FOUND], left = 3, same = 0;
    const cylint_closest_columns answers = {.distance = &distance};
    const size_t number = cylint_scene_closest(
        scene, o, HUGE_VAL, CYLINT_WANT_POINT | CYLINT_WANT_NORMAL, &closest);
    cylint_scene_closest_points(scene, &points, NULL, 1, &same, &answers);
    MUST(same == number);
    const size_t count =
        cylint_scene_within(scene, o, 1.0, 0, 0, found, away, SCENE_FILE_FOUND);
    scene_file_check_order(found, count, n);
    cylint_scene_within_count(scene, o, 1.0, 0, 0);
    const size_t inside = cylint_scene_contains(scene, o, 0);
    /* A damaged hierarchy can have a shape twice, so it can count twice. */
    MUST((cylint_scene_contains(scene, o, 1) == 1) == (inside > 0));
    const size_t deepest =
        cylint_scene_closest(scene, o, HUGE_VAL, CYLINT_SIGNED, &closest);
    MUST(inside == 0 || (deepest < n && closest.distance <= 0));
    cylint_scene_visit_point(scene, o, 2.0, 0, scene_file_count_near, &left);
}

enum { SCENE_FILE_SIDES = 3 };

enum { SCENE_FILE_LINE = 1, SCENE_FILE_POINT = 2 };

/* Queries the line from one of the sides to the shape, its origin, or both.  The
 * origin lies about the shape. */
static inline void scene_file_query_at(const cylint_scene *scene, size_t number,
                                       int side, int what)
{
    static const double d[SCENE_FILE_SIDES][3] = {
        {1, 0, 0}, {0.25, -1, 0.5}, {-3, 2, 1}};
    double lo[3], hi[3], o[3];
    cylint_shape shape;
    cylint_line line;
    cylint_scene_shape(scene, number, &shape);
    cylint_bounds(&shape, lo, hi);
    for (int j = 0; j < 3; j++)
        o[j] = (lo[j] > -1e300 && hi[j] < 1e300 ? lo[j] / 2 + hi[j] / 2 : 0) -
               side * d[side][j];
    if (cylint_whole_line(&line, o, d[side]) != CYLINT_OK)
        return;
    if (what & SCENE_FILE_LINE) {
        scene_file_query_line(scene, &line, number);
        scene_file_query_pieces(scene, &line);
    }
    if (what & SCENE_FILE_POINT)
        scene_file_query_point(scene, line.o);
}

/* Reads all labels, which follow each other. */
static inline void scene_file_read_labels(const cylint_scene *scene)
{
    const size_t n = cylint_scene_size(scene);
    const cylint_scene_labels *labels = cylint_scene_get_labels(scene);
    volatile char last = 0;
    uint64_t at = 0;
    for (size_t i = 0; labels && i < n; i++) {
        MUST(at <= labels->end[i]);
        for (; at < labels->end[i]; at++)
            last = labels->text[at];
    }
    (void)last;
}

/* An opened scene can be saved, and what is saved is then the same each time. */
static inline void scene_file_save_again(const cylint_scene *scene,
                                         size_t bytes)
{
    OWN_BYTES first = {NULL, NULL, 0}, second = first;
    cylint_scene *again = scene_file_reopen(scene, &first);
    MUST(again && first.n == bytes);
    scene_file_write(again, &second);
    MUST(second.n == bytes && memcmp(first.data, second.data, bytes) == 0);
    cylint_scene_free(again);
}

/* Opens the bytes and makes some queries.  Returns the status. */
static inline cylint_scene_status scene_file_try(const void *data, size_t bytes)
{
    cylint_scene_status status;
    cylint_scene *scene = cylint_scene_open_memory(data, bytes, 0, &status);
    if (!scene)
        return status;
    const size_t n = cylint_scene_size(scene);
    scene_file_read_labels(scene);
    for (size_t i = 0; i < n; i += n / 4 + 1)
        for (int side = 0; side < SCENE_FILE_SIDES; side++)
            scene_file_query_at(scene, i, side,
                                SCENE_FILE_LINE | SCENE_FILE_POINT);
    scene_file_save_again(scene, bytes);
    cylint_scene_free(scene);
    return status;
}

/* The status after n bytes at `at` have become those of x, and the checksum is
 * right.  Then they are as before. */
static inline cylint_scene_status scene_file_with(const struct bytes *b,
                                                  void *at, const void *x,
                                                  size_t n)
{
    char before[8];
    memcpy(before, at, n);
    memcpy(at, x, n);
    scene_file_repair(b->data, b->n);
    const cylint_scene_status status = scene_file_try(b->data, b->n);
    memcpy(at, before, n);
    return status;
}

#endif
