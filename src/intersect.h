/*
 * intersect.h - cylint_intersect() by exact signs, signs at a point, and the
 * wanted members of a hit
 */
#ifndef CYLINT_INTERSECT_H
#define CYLINT_INTERSECT_H

#include <math.h>
#include <string.h>

#include "filter/filter.h"
#include "signs/sign.h"
#include "cylint_pieces.h"

/* As cylint_intersect(), without the filter. */
int cylint_intersect_by_signs(const cylint_shape *shape,
                              const cylint_line *line, unsigned want,
                              cylint_answer *answer);

/*
 * For libcylint-scene: cylint_occluded() of the shape that a constructor makes of
 * a record, without low parts of its local coordinates.  Returns CYLINT_UNDECIDED
 * where these leave the answer open.  The kind is cylinder, cone, capsule or
 * round cone; the local coordinates of the constructor's shape are accurate.
 */
CYLINT_API int cylint_occluded_in_doubles(int kind, int ends,
                                          const cylint_record *from,
                                          const cylint_line *line);

/* For libcylint-scene and -embree: makes a shape by the constructor of its kind.
 * axes: of an elliptic shape.  Returns the constructor's status; a shape of no kind
 * is refused. */
CYLINT_API cylint_status cylint_make_of_record(cylint_shape *shape, int kind,
                                               int ends,
                                               const cylint_record *from,
                                               const cylint_semi_axes *axes);

/*
 * For libcylint-scene: the chords of a line in shapes that constructors made of
 * records, all of one kind: cylinder, cone, capsule or round cone, with accurate
 * local coordinates.  Writes the chord of the record number[i] and count[i], 0 or
 * 1; or CYLINT_UNDECIDED: then cylint_chord() answers.  The
 * thread rounds to nearest.  n <= CYLINT_MOST_RECORDS.
 */
enum { CYLINT_MOST_RECORDS = 64 };
CYLINT_API void cylint_chords_of_records(const cylint_record *records,
                                         int solid, const uint32_t *number,
                                         size_t n, const cylint_line *line,
                                         cylint_interval *chord,
                                         signed char *count);

/* Makes a line through a point, and opens its query, for signs that depend only on
 * that point or on the shape.  They return an error if the point is not finite. */
cylint_status cylint_line_at(cylint_line *line, const double point[3]);
cylint_status cylint_open_at(cylint_query *q, const cylint_shape *shape,
                             cylint_line *line, const double point[3]);

/* Makes line i. */
static inline cylint_status cylint_read_line(const cylint_lines *from, size_t i,
                                             cylint_line *line)
{
    const double o[3] = {from->o[0][i], from->o[1][i], from->o[2][i]};
    const double d[3] = {from->d[0][i], from->d[1][i], from->d[2][i]};
    return cylint_span(line, o, d, from->tmin ? from->tmin[i] : 0,
                       from->tmax ? from->tmax[i] : HUGE_VAL);
}

/* Copies the wanted members. */
static inline void cylint_copy_hit(cylint_hit *to, const cylint_hit *from,
                                   unsigned want)
{
    if (want & CYLINT_WANT_T)
        to->t = from->t;
    if (want & CYLINT_WANT_PART) {
        to->part = from->part;
        to->side = from->side;
    }
    if (want & CYLINT_WANT_POINT)
        memcpy(to->point, from->point, sizeof to->point);
    if (want & CYLINT_WANT_NORMAL)
        memcpy(to->normal, from->normal, sizeof to->normal);
    if (want & CYLINT_WANT_Z)
        to->z = from->z;
    if (want & CYLINT_WANT_PHI)
        to->phi = from->phi;
}

/* Writes the wanted members of a hit from t, part and side of `partial`.  Other
 * members keep their values. */
static inline void cylint_write_hit(const cylint_shape *shape,
                                    const cylint_line *line,
                                    const cylint_hit *partial, unsigned want,
                                    cylint_hit *hit)
{
    cylint_hit all = *partial;
    cylint_describe(shape, line, want, &all);
    cylint_copy_hit(hit, &all, want);
}

#endif
