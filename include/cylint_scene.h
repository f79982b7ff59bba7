/*
 * cylint_scene - lines or points against very many shapes, by a hierarchy of
 * boxes
 *
 *     cylint_scene *scene = cylint_scene_new(shapes, n, 0, NULL);
 *     size_t first = cylint_scene_nearest(scene, &line, CYLINT_WANT_T, &hit);
 *     if (first < n)
 *         printf("shape %zu at t = %g\n", first, hit.t);
 *     cylint_scene_free(scene);
 *
 * A scene returns what cylint_nearest() and cylint_count() of cylint.h return
 * for all its shapes, bit for bit: the hierarchy only rejects shapes that the
 * line certainly does not hit.  That holds for every line and every shape,
 * refused ones included.  Unbounded shapes and some extreme ones (see below) are
 * tested beside the hierarchy.
 *
 * Both libcylint-scene and libcylint-embree contain these functions.  Queries
 * only read a scene, so any number of threads may query one.  They allocate no
 * memory, except for pieces of many lines and sums of lengths.  Nothing is printed.
 *
 * Functions of the caller, such as cylint_scene_progress, must return, and not
 * leave by longjmp() or an exception of C++.  They can end the work by what they
 * return.
 */
#ifndef CYLINT_SCENE_H
#define CYLINT_SCENE_H

#include <stdint.h>

#include "cylint.h"
#include "cylint_distance.h"
#include "cylint_pieces.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct cylint_scene cylint_scene;

typedef enum cylint_scene_status {
    CYLINT_SCENE_OK = 0,
    CYLINT_SCENE_EMEMORY,     /* out of memory */
    CYLINT_SCENE_ESIZE,       /* more than 2^28, or no such shape or solid */
    CYLINT_SCENE_ESTOPPED,    /* progress function or writer returned 0 */
    CYLINT_SCENE_EFINISHED,   /* cylint_scene_finish() was called before */
    CYLINT_SCENE_EUNFINISHED, /* cylint_scene_finish() was not called yet */
    CYLINT_SCENE_EFILE,       /* a function of the system failed: errno */
    CYLINT_SCENE_EFORMAT,     /* not a saved scene */
    CYLINT_SCENE_EVERSION, /* of another version, or of a machine with another
                              order of bytes: make the scene again */
    CYLINT_SCENE_EDAMAGED, /* the file is shorter, or differs from what was
                              saved */
    CYLINT_SCENE_EOPENED,  /* the shapes of an opened scene do not change */
    CYLINT_SCENE_EREPLACE, /* a shape cannot take the place of the one before, see
                             cylint_scene_refit() */
    CYLINT_SCENE_ESOLID /* a member of a solid has no clause, or two solids have
                              the same number, see cylint_scene_set_solids() */
} cylint_scene_status;

/* A short English text for a status, static, lower case, no full stop. */
CYLINT_API const char *cylint_scene_strerror(int status);

/*
 * A scene is made in three steps: begin, add, finish.  It copies what it needs of
 * the shapes, so one buffer of the caller serves all blocks of them.  Their
 * numbers are 0, 1, ... in the order in which they are added.  Until the scene is
 * finished, only one thread may use it, and queries must not be made.
 *
 * A shape takes some 100 bytes; cylint_scene(3), MEMORY, has more.
 */

/* Returns an empty scene, or NULL if there is no memory.  expected: the number of
 * shapes, if it is known, so that memory is allocated once; else 0. */
CYLINT_API cylint_scene *cylint_scene_begin(size_t expected);

/* Adds n shapes.  If it fails, none is added, and the scene may be used further.
 * EFINISHED: the scene is finished. */
CYLINT_API cylint_scene_status cylint_scene_add(cylint_scene *scene,
                                                const cylint_shape *shapes,
                                                size_t n);

/* Gets the part of the work that is done, from 0 to 1, never less than before.
 * Returns 1 to continue, 0 to stop.  The time is only roughly proportional to
 * `part`. */
typedef int cylint_scene_progress(void *context, double part);

/*
 * Builds the hierarchy.  At most `threads` threads build it, the caller's thread
 * included; 0 stands for one per processor, on Linux of those that the process may
 * use.  Few shapes use fewer threads, and a library built without POSIX threads
 * uses one; the scene is the same.  If `progress` is not NULL, calls
 * progress(context, part) in the calling thread: some 1700 times or more for a
 * million shapes with one thread, less often with more.  If it returns 0, the work
 * stops with ESTOPPED.  After a failure the scene can only be freed.
 *
 * Unbounded shapes (infinite, nappe) and shapes with a coordinate, a factor or a
 * tangent beyond 2^400 are beside the hierarchy: every line is tested with them.
 * So are up to 16 shapes that are very far from the others or very large
 * (cylint_scene(3)), and all shapes if the box of the others is smaller than
 * 2^-400.  They are packed without a call of progress().
 */
CYLINT_API cylint_scene_status
cylint_scene_finish(cylint_scene *scene, int threads,
                    cylint_scene_progress *progress, void *context);

/* The three steps for n shapes in one array; n may be 0.  Returns NULL on failure
 * and writes the reason to *status, unless `status` is NULL. */
CYLINT_API cylint_scene *cylint_scene_new(const cylint_shape *shapes, size_t n,
                                          int threads,
                                          cylint_scene_status *status);
CYLINT_API cylint_scene *cylint_scene_new_with_progress(
    const cylint_shape *shapes, size_t n, int threads,
    cylint_scene_progress *progress, void *context,
    cylint_scene_status *status);

/* scene may be NULL. */
CYLINT_API void cylint_scene_free(cylint_scene *scene);

/* The bytes of memory that the scene holds, with those of a file that it maps. */
CYLINT_API size_t cylint_scene_bytes(const cylint_scene *scene);

/* The number of shapes. */
CYLINT_API size_t cylint_scene_size(const cylint_scene *scene);

/* Makes shape `number` again by its constructor: the same bits in the same
 * floating-point environment with the same kernels, the same answers with others.
 * cylint_arguments() returns its numbers. */
CYLINT_API void cylint_scene_shape(const cylint_scene *scene, size_t number,
                                   cylint_shape *shape);

/*
 * Moves shapes: shapes[0..n-1] take the places of shapes [first, first + n), and
 * queries return what those of a new scene do; distances of an extreme elliptic
 * shape, see cylint_distance(), may differ.  Boxes are made larger or smaller; the
 * tree above them stays, so queries take longer if shapes move away from their
 * neighbours: see cylint_scene_worsening().
 *
 * Uses one thread and allocates nothing.  A few shapes that stay within the box of
 * all cost least; if one leaves it, or the box becomes much smaller, the boxes of
 * all are computed again.  No other thread may use the scene at the same time.
 *
 * EUNFINISHED and EOPENED: not such a scene.  ESIZE: first + n is more than the
 * number of shapes.  EREPLACE: a shape is elliptic and the one before is not, or
 * the reverse; the constructor refused one of them, not the other; or a shape is
 * unbounded or has points beyond 2^400 (some shapes: 2^398), and the one with which
 * the scene was made is in the hierarchy (cylint_scene_finish()).  A failure
 * changes nothing.
 */
CYLINT_API cylint_scene_status cylint_scene_refit(cylint_scene *scene,
                                                  size_t first, size_t n,
                                                  const cylint_shape *shapes);

/* The mean number of boxes that random lines through some boxes of the scene hit,
 * divided by that number before the first cylint_scene_refit(): 1 for a scene as it
 * was built, and for one that was opened, even if it was refitted before it was
 * saved.  Where it is 2, a query takes up to about twice the time: make a new scene
 * if many queries follow.  Takes some milliseconds. */
CYLINT_API double cylint_scene_worsening(const cylint_scene *scene);

/*
 * Labels: bytes that belong to a shape, its name for example.  They have no effect
 * on queries and are saved with the scene.  The label of shape i is bytes
 * end[i - 1] to end[i] - 1 of the text, that of shape 0 begins at byte 0.
 */
typedef struct cylint_scene_labels {
    const uint64_t *end; /* ascending, one for each shape */
    const char *text;    /* not terminated */
} cylint_scene_labels;

/* Gives a finished scene these labels, or none if `labels` is NULL.  Copies the
 * two pointers; the arrays must stay as long as the scene. */
CYLINT_API void cylint_scene_set_labels(cylint_scene *scene,
                                        const cylint_scene_labels *labels);

/* The labels, of the file for a scene that was opened, or NULL. */
CYLINT_API const cylint_scene_labels *cylint_scene_get_labels(
    const cylint_scene *scene);

/*
 * Files.  A file of a scene holds the scene as it is in memory, about 100 bytes a
 * shape, and is opened without building anything: it is mapped into memory, and
 * all processes that open it share its pages.  Queries of an opened scene return
 * what those of the saved scene return, bit for bit.
 *
 * A file has a version, an order of bytes and a checksum.  Where these are not as
 * expected, or a number in the file is out of range, opening fails: no file makes
 * a query read outside it, run without end or crash.  Only a file that changes
 * while it is mapped can do that, and one opened with CYLINT_SCENE_TRUSTED: open
 * files that others may write to with CYLINT_SCENE_READ.  (cylint_scene_save()
 * replaces a file and does not change it.)
 */
enum {
    CYLINT_SCENE_READ = 1, /* read the file into memory; systems without mmap()
                              always do */
    CYLINT_SCENE_TRUSTED = 2 /* check the header only: a file of many gigabytes
                                is then opened without reading it.  For files that
                                this library saved and nobody else changes. */
};

/* Writes a finished scene to a file: writes PATH.NUMBER.new, which then takes the
 * place of PATH, or of the file to which a link PATH leads, and keeps that file's
 * permissions and, if the system allows it, its owner.  A pipe or a device is
 * written directly, and so is the file of a link that does not exist yet or has no
 * name any more, as /dev/stdout may.  EFILE: errno has the reason, and
 * PATH.NUMBER.new is removed. */
CYLINT_API cylint_scene_status cylint_scene_save(const cylint_scene *scene,
                                                 const char *path);

/* Gets the next bytes of the file.  Returns 1, or 0 to stop. */
typedef int cylint_scene_writer(void *context, const void *data, size_t bytes);

/* Passes the file's bytes to a function.  ESTOPPED: the function returned 0. */
CYLINT_API cylint_scene_status cylint_scene_write(const cylint_scene *scene,
                                                  cylint_scene_writer *writer,
                                                  void *context);

/* Opens a file of a scene; `flags` is a sum of the flags above.  Returns NULL on
 * failure.  Writes the status, unless `status` is NULL. */
CYLINT_API cylint_scene *cylint_scene_open(const char *path, unsigned flags,
                                           cylint_scene_status *status);

/* The same for the bytes of a file in memory, which must stay as they are as long
 * as the scene.  Bytes at an address that is no multiple of 64 are copied. */
CYLINT_API cylint_scene *cylint_scene_open_memory(const void *data,
                                                  size_t bytes, unsigned flags,
                                                  cylint_scene_status *status);

/* Returns the number of the shape that the line hits first, and writes the
 * wanted members of *hit; returns n if the line hits none.  At equal t the lower
 * number is first.  t is the double nearest to the root. */
CYLINT_API size_t cylint_scene_nearest(const cylint_scene *scene,
                                       const cylint_line *line, unsigned want,
                                       cylint_hit *hit);

/* Returns what cylint_scene_nearest() returns without shape number `except`;
 * with except = n nothing is left out.  Use it for a ray that leaves this shape,
 * as cylint_scene_occluded(). */
CYLINT_API size_t cylint_scene_nearest_other(const cylint_scene *scene,
                                             const cylint_line *line,
                                             size_t except, unsigned want,
                                             cylint_hit *hit);

/* Returns the number of shapes that the line hits, at most `enough` unless that
 * is 0.  With enough = 1: whether it hits any. */
CYLINT_API size_t cylint_scene_count(const cylint_scene *scene,
                                     const cylint_line *line, size_t enough);

/* Returns 1 if the line hits a shape other than number `except`; with except = n
 * any shape.  Use it for a ray that begins at a rounded point on the surface of a
 * shape: if it leaves a convex solid, it does not hit the solid again. */
CYLINT_API int cylint_scene_occluded(const cylint_scene *scene,
                                     const cylint_line *line, size_t except);

/* Writes the numbers of the shapes that the line hits, ascending from `first`,
 * at most `capacity` of them, and returns how many.  If it returns `capacity`,
 * call again with first = last + 1. */
CYLINT_API size_t cylint_scene_all(const cylint_scene *scene,
                                   const cylint_line *line, size_t first,
                                   size_t *numbers, size_t capacity);

/*
 * Visits: all other queries can be written with them.
 */

/* Gets shape `number`, which the line hits, and its first hit: the wanted members,
 * or NULL if none is wanted.  Returns the largest t at which hits are wanted from
 * now on: HUGE_VAL for all; or NaN to end the visit.  A value larger than one
 * before has no effect. */
typedef double cylint_scene_hit(void *context, size_t number,
                                const cylint_hit *hit);

/*
 * Calls back once for each shape that the line hits, with the members `want` of
 * the first of its hits.  The order is not that of t, but nearer shapes tend to
 * come first; in one rounding mode it is the same each time.  A shape whose first
 * hit is beyond the t that the callback returned may still come.  The callback may
 * query the scene.
 *
 * To leave shapes out, let the callback return the t that it returned before, or
 * HUGE_VAL.
 */
CYLINT_API void cylint_scene_visit(const cylint_scene *scene,
                                   const cylint_line *line, unsigned want,
                                   cylint_scene_hit *callback, void *context);

/* Returns the number of shapes whose closed solid holds the point, at most
 * `enough` unless that is 0: those for which cylint_contains() returns 1 or 0, so
 * that the boundary belongs to the solid.  With enough = 1: whether the union of
 * all solids holds it.  Exact, whatever the `ends` of the shapes.  Infinite and
 * nappe shapes count.  A refused shape holds no point, and no shape holds a point
 * with an infinite or NaN coordinate. */
CYLINT_API size_t cylint_scene_contains(const cylint_scene *scene,
                                        const double point[3], size_t enough);

/*
 * Distances of points.  The functions below return what a loop over all shapes
 * returns, bit for bit.  `want` decides which distances they compare.  They compute
 * none for a shape whose boxes are too far away.  So an extreme elliptic shape, see
 * cylint_distance(), can be left out although the loop includes it, if its double
 * is wrong and the real distance is greater.
 *
 * Without CYLINT_SIGNED: the absolute values of the doubles that
 * cylint_distance() of cylint_distance.h returns: of the distance to the surface,
 * also inside a solid.  Each shape counts alone.  Where shapes overlap, the
 * nearest surface may lie inside another shape, and the surface of their union is
 * farther away: cylint_scene(3), section Overlapping shapes.  If the radius is
 * negative, no shape is within it.
 *
 * With CYLINT_SIGNED: the doubles that cylint_distance() returns with
 * CYLINT_SIGNED: negative inside the closed solid, 0 on its boundary, whatever
 * the ends.  A shape is within the radius if its distance is at most the radius,
 * so each shape that holds the point is within the radius 0.  The radius -x selects
 * the shapes in which the point is at least x deep.
 * The least distance of all shapes is
 *
 *   - outside all solids: the distance from their union;
 *   - on a boundary, if no solid has the point inside: 0;
 *   - inside: minus the depth in the deepest solid, where the depth is the
 *     distance from the solid's surface.  The depth in the union is at least
 *     that; where solids overlap, it may be greater.
 *
 * A shape without a surface, and a refused one, has no distance.  If a coordinate
 * of the point is infinite or NaN, or the radius is NaN, no shape is within the
 * radius.  The radius may be HUGE_VAL.
 */

/* Gets shape `number`, which is within the radius, and the distance and flags that
 * cylint_distance() returns with the visit's `want`.  Returns the largest
 * distance, in absolute value without CYLINT_SIGNED, that is wanted from now on,
 * or NaN to end the visit.  A value larger than one before has no effect. */
typedef double cylint_scene_near(void *context, size_t number, double distance,
                                 int flags);

/* Calls back once for each shape within the radius, in an order that is the same
 * each time in one rounding mode; nearer shapes tend to come first.  `want` is 0 or
 * CYLINT_SIGNED. */
CYLINT_API void cylint_scene_visit_point(const cylint_scene *scene,
                                         const double point[3], double radius,
                                         unsigned want,
                                         cylint_scene_near *callback,
                                         void *context);

/* Returns the number of the shape with the least distance, if it is within the
 * radius; of equal distances the lowest number.  Writes *answer as
 * cylint_distance() does with the same `want`.  If there is none, returns n and
 * writes nothing.  `point` must not be a member of *answer. */
CYLINT_API size_t cylint_scene_closest(const cylint_scene *scene,
                                       const double point[3], double radius,
                                       unsigned want, cylint_closest *answer);

/* Returns the number of shapes within the radius, at most `enough` unless that is
 * 0.  `want` is 0 or CYLINT_SIGNED. */
CYLINT_API size_t cylint_scene_within_count(const cylint_scene *scene,
                                            const double point[3],
                                            double radius, unsigned want,
                                            size_t enough);

/* Writes the numbers of the shapes within the radius, ascending from `first`, at
 * most `capacity` of them, and the distances that were compared, unless
 * `distances` is NULL.  Returns how many.  If it returns `capacity`, call again
 * with first = last + 1.  `want` is 0 or CYLINT_SIGNED. */
CYLINT_API size_t cylint_scene_within(const cylint_scene *scene,
                                      const double point[3], double radius,
                                      unsigned want, size_t first,
                                      size_t *numbers, double *distances,
                                      size_t capacity);

/*
 * Solids made of shapes: hollow ones, sectors, cuts.
 *
 * A solid is a conjunction of clauses, a clause a union of shapes and complements
 * of shapes, as cylint_solid_pieces() explains.  A shape that is in no solid is
 * itself a solid.  Pieces, cylint_scene_depth() and cylint_scene_first_boundary()
 * are about solids.  All other queries are about shapes: cylint_scene_nearest()
 * returns the hit on a bore's cylinder as well.
 */

/* Shape number `shape` belongs to a clause of a solid.  solid: an index from 0 on,
 * the same for all members of the solid, which only cylint_scene_set_solids()
 * reads.  clause: its number > 0; negative: the complement of the shape does. */
typedef struct cylint_member {
    size_t shape, solid;
    int clause;
} cylint_member;

/*
 * Sets the solids of a finished scene, in place of those before; n = 0: none.
 * Copies the members.  A solid with a clause of bounded shapes, none of them a
 * complement, is bounded: its other members cost nothing for lines that miss these
 * shapes.
 *
 * The number of a solid, for ranks, pieces and labels, is that of its least shape
 * that is not a complement; if there is none, of its least shape.
 *
 * EUNFINISHED; EMEMORY; ESIZE: there is no such shape, a solid's index is n or
 * more, or n is more than 2^28.  ESOLID: a clause is 0 or INT_MIN, or two solids
 * have the same number.  A failure changes nothing.
 */
CYLINT_API cylint_scene_status cylint_scene_set_solids(
    cylint_scene *scene, const cylint_member *members, size_t n);

/* The number of members of all solids, and member i, in the order in which they
 * were set. */
CYLINT_API size_t cylint_scene_members(const cylint_scene *scene);
CYLINT_API void cylint_scene_member(const cylint_scene *scene, size_t i,
                                    cylint_member *member);

/*
 * Pieces: the parts of a line's domain that are inside solids, in order.  They are
 * computed from the chords of the shapes, as cylint_chord() returns them;
 * cylint_pieces.h defines their ends.  t0 < t1 always.
 */
typedef enum cylint_piece_mode {
    CYLINT_PIECES_UNION, /* maximal intervals inside at least one solid: disjoint,
                            not touching.  shape: the owner at t0 */
    CYLINT_PIECES_OWNER, /* each place belongs to the solid of least rank, of equal
                            ranks to the lowest number; neighbours of equal owner
                            are joined */
    CYLINT_PIECES_CELLS, /* a piece ends wherever a solid begins or ends;
                            shape: the owner */
    CYLINT_PIECES_CHORDS /* one for each solid, or more if it is not convex: sorted
                            by t0, then by number; they may overlap */
} cylint_piece_mode;

typedef struct cylint_piece {
    double t0, t1;
    size_t shape; /* its number, or its solid's */
    size_t depth; /* how many solids contain it; the greatest number within the
                     piece.  Chords: 1 */
} cylint_piece;

typedef struct cylint_piece_rule {
    cylint_piece_mode mode;
    const int *rank; /* rank[i]: of shape i or, if a solid has the number i, of
                        that; NULL: all have the same */
    const cylint_piece
        *after; /* chords only: those after this one; NULL: all */
} cylint_piece_rule;

/* Memory for a query, aligned as malloc() aligns it.  It need not be initialised,
 * and nothing stays in it.  Each thread needs its own. */
typedef struct cylint_workspace {
    void *memory;
    size_t bytes;
    size_t wanted; /* written if the memory does not suffice */
} cylint_workspace;

/* What queries return if their workspace does not suffice. */
#define CYLINT_NO_ROOM SIZE_MAX

/*
 * Writes the pieces of a line, ascending, at most `capacity`, and returns how many.
 * If it returns `capacity`, more may follow: call again with line->tmin = the last
 * t1; for chords, which may overlap, with the same line and rule->after = the last.
 * The pieces are then those that one call returns.  A capacity of up to 4 is
 * faster, except for chords: only a part of the line is searched.  If most chords
 * begin in that part, or a piece is as long as the line, it takes up to eight times
 * as long as one call for all pieces.
 *
 * Returns CYLINT_NO_ROOM if the workspace does not suffice, and writes how many
 * bytes to try next, which is more than before.  A chord takes 48 bytes, in a scene
 * with solids about 150, and 128 more for each further solid that its shape is a
 * member of.  An unbounded member of a bounded solid takes at most 256, its chords
 * included, and only if the line hits another shape of the solid.  So does a shape
 * that is a member more than 16 times, in solids with a clause of bounded shapes
 * that are fewer times.  A complement in an unbounded solid takes 64 more than its
 * chords.  A refused line has no pieces.
 */
CYLINT_API size_t cylint_scene_pieces(const cylint_scene *scene,
                                      const cylint_line *line,
                                      const cylint_piece_rule *rule,
                                      cylint_piece *pieces, size_t capacity,
                                      cylint_workspace *work);

/*
 * Returns the number of the shape where a line first enters or leaves the union of
 * all solids, strictly between tmin and tmax, and writes the wanted members of
 * *hit.  Returns the number of all shapes if there is no such place.
 *
 * The solid is the one with the lowest number of those that begin or end there.
 * The shape is a member of it, and the point is on the surface of the shape; caps
 * count as present.  side: whether the line enters the solid.  The normal points
 * out of the solid: on the surface of a bore it points into the bore.  Members are
 * otherwise those of cylint_intersect().  On a complement side and normal are the
 * opposite of the shape's; cylint_describe() and cylint_outside() need the shape's,
 * and cylint_describe() a shape with both caps.
 * Several of the solid's shapes can have a surface at this t.  If the line enters
 * the solid, those count that it enters, and complements that it leaves; if it
 * leaves the solid, those that it leaves, and complements that it enters.  Of these
 * the shape is the one with the lowest number.  A shape both of whose roots round
 * to t does not count.
 *
 * The workspace: as for cylint_scene_pieces().  If it does not suffice,
 * CYLINT_NO_ROOM.
 */
CYLINT_API size_t cylint_scene_first_boundary(const cylint_scene *scene,
                                              const cylint_line *line,
                                              unsigned want, cylint_hit *hit,
                                              cylint_workspace *work);

/* Returns how many solids contain a point, boundaries included; a complement is
 * without its boundary.  Writes the number of the solid with the least rank, of
 * equal ranks the lowest number; the number of all shapes if none contains it.
 * No solid contains a point with an infinite or NaN coordinate.
 * rank: as in cylint_piece_rule.  Exact.  The workspace: as for
 * cylint_scene_pieces(). */
CYLINT_API size_t cylint_scene_depth(const cylint_scene *scene,
                                     const double point[3], const int *rank,
                                     size_t *owner, cylint_workspace *work);

/*
 * Many lines or points in one call, by several threads.
 *
 * Element i of an array of answers is what the query of one line or point returns
 * for line i or point i, bit for bit, whatever the number of threads.  Each array
 * has one element for each line or point (lines->n or points->n) and must not
 * overlap the input.  An array that is NULL is neither computed nor written.  With
 * n = 0 nothing is written.
 *
 * At most `threads` threads work, the caller's thread included; 0 stands for one
 * per processor, as above.  There is at most one thread for every 1024 lines or
 * points, at most 64, and one in a library built without POSIX threads.  The
 * threads take blocks of lines in turn, so lines may differ in cost.  They end
 * before the call returns.
 *
 * The calls cannot fail.  They allocate no memory themselves, but each thread that
 * they start takes memory for its stack.  If the system refuses a thread, the
 * others do its work.  Several threads may make such calls for one scene.
 */

/* The first hit of each line.  Where a line hits no shape, part and side are
 * -1, and the other members are NaN.  Set members that are not wanted to NULL:
 * `cylint_hit_columns hits = {0}`, in C++ `= {}`. */
typedef struct cylint_hit_columns {
    double *t;
    signed char *part, *side; /* cylint_part, cylint_side */
    double *point[3], *normal[3], *z, *phi;
} cylint_hit_columns;

/*
 * cylint_scene_nearest() for each line.  numbers[i] is that of the shape which line
 * i hits first, or the number of all shapes if it hits none; an invalid line hits
 * none.  `hits` may be NULL.
 *
 * except: NULL, or for each line the number of a shape that is left out, as by
 * cylint_scene_nearest_other(); the number of all shapes, or a larger number such
 * as SIZE_MAX, leaves out none.
 */
CYLINT_API void cylint_scene_nearest_lines(const cylint_scene *scene,
                                           const cylint_lines *lines,
                                           const size_t *except, int threads,
                                           size_t *numbers,
                                           const cylint_hit_columns *hits);

/* Whether each line hits a shape other than except[i], as cylint_scene_occluded():
 * any[i] is 1 or 0; for an invalid line 0.  except: as above. */
CYLINT_API void cylint_scene_any_lines(const cylint_scene *scene,
                                       const cylint_lines *lines,
                                       const size_t *except, int threads,
                                       signed char *any);

/* cylint_scene_count() for each line: the number of shapes that it hits, at most
 * `enough` unless that is 0; for an invalid line 0. */
CYLINT_API void cylint_scene_count_lines(const cylint_scene *scene,
                                         const cylint_lines *lines,
                                         size_t enough, int threads,
                                         size_t *counts);

/*
 * cylint_scene_closest() for each point, without CYLINT_SIGNED, within radii[i];
 * radii = NULL stands for HUGE_VAL for all.  numbers[i] is that of the shape whose
 * surface is nearest.  If no surface is within the radius, or the radius is
 * negative or NaN, or a coordinate of the point is infinite or NaN, numbers[i] is
 * the number of all shapes, part and feature are -1, the other members NaN.
 * `answers` may be NULL.
 */
CYLINT_API void cylint_scene_closest_points(
    const cylint_scene *scene, const cylint_points *points, const double *radii,
    int threads, size_t *numbers, const cylint_closest_columns *answers);

/*
 * Pieces of many lines, and sums.  These functions allocate memory, and can fail
 * with EMEMORY; then nothing is to be freed.  An invalid line has no pieces.
 * threads: as above, but at most one for every 256 lines.
 */

/* The pieces of line i are pieces[first[i]] to pieces[first[i + 1] - 1]. */
typedef struct cylint_piece_rows {
    size_t *first; /* n + 1 */
    cylint_piece *pieces;
} cylint_piece_rows;

/* Makes the pieces of each line, as cylint_scene_pieces() writes them: the first
 * `most` of each line, or all if `most` is 0.  rule->after is not read. */
CYLINT_API cylint_scene_status
cylint_scene_pieces_lines(const cylint_scene *scene, const cylint_lines *lines,
                          const cylint_piece_rule *rule, size_t most,
                          int threads, cylint_piece_rows *rows);
CYLINT_API void cylint_piece_rows_free(cylint_piece_rows *rows);

/*
 * Adds the lengths of pieces by label.  sums[i * labels + label] is the sum of t1 -
 * t0 over the pieces of line i whose shapes have the label: the double nearest to
 * the sum of these real numbers.  It is infinite if a piece is.  With the mode
 * `owner` each place counts once, for its owner; with `union` for the owner of the
 * piece's start; with `chords` as often as solids contain it.
 *
 * label[i]: of shape i or, if a solid has the number i, of that, 0 to labels - 1;
 * pieces with other labels are not counted; NULL: all have label 0.  in_units: 0
 * for lengths in units of |d|; 1: each sum is multiplied by cylint_line_length(),
 * which rounds once more.
 */
CYLINT_API cylint_scene_status cylint_scene_sums(const cylint_scene *scene,
                                                 const cylint_lines *lines,
                                                 const cylint_piece_rule *rule,
                                                 const int *label,
                                                 size_t labels, int in_units,
                                                 int threads, double *sums);

/* The same for one line, a segment too: writes sums[0] to sums[labels - 1]. */
CYLINT_API cylint_scene_status
cylint_scene_line_sums(const cylint_scene *scene, const cylint_line *line,
                       const cylint_piece_rule *rule, const int *label,
                       size_t labels, int in_units, double *sums);

#ifdef __cplusplus
}
#endif

#endif
