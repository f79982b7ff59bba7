/*
 * cylint_pieces - the pieces of a line that are inside a solid
 *
 * A chord is the overlap of a line's domain with one closed solid.  A solid can
 * also be made of several shapes: hollow, cut, or a sector.  Scenes return the
 * pieces of a line in many solids (cylint_scene.h).
 *
 *     cylint_interval wall[CYLINT_SOLID_PIECES];
 *     cylint_shape pipe[2];
 *     const int clause[2] = {1, -2};
 *     cylint_cylinder(&pipe[0], p0, p1, 10, CYLINT_ENDS_CAPPED);
 *     cylint_cylinder(&pipe[1], p0, p1, 9, CYLINT_ENDS_CAPPED);
 *     n = cylint_solid_pieces(pipe, clause, 2, &line, wall, CYLINT_SOLID_PIECES);
 *
 * An end of a piece is tmin, tmax, or the double nearest to a root, where the line
 * enters or leaves a shape.  It is infinite where the solid has no end, or a root
 * is beyond the largest double.  The two ends of a piece differ.
 *
 * The pieces are functions of these doubles alone.  They are the exact pieces with
 * each end rounded, without those whose ends round to the same double; a gap whose
 * ends round to the same double is no gap.  There is no tolerance.
 */
#ifndef CYLINT_PIECES_H
#define CYLINT_PIECES_H

#include "cylint.h"

#ifdef __cplusplus
extern "C" {
#endif

/* t0 <= t <= t1, where t0 < t1. */
typedef struct cylint_interval {
    double t0, t1;
} cylint_interval;

/*
 * Writes the chords of a line in a shape, and returns how many there are: 0, 1 or,
 * in a double cone, 2.
 *
 * A chord is [max(tmin, a), min(tmax, b)], if its ends differ as doubles.  a and b
 * are the doubles nearest to the ends of the overlap of the whole line with the
 * closed solid, with both caps, whatever the ends: as for the relation.
 *
 *   touch                           no chord
 *   on a ruling, in a cap's plane   a chord: the solid is closed
 *   from inside, or a segment       the chord begins at tmin, or ends at tmax
 *     within the solid
 *   infinite, nappe, halfspace      t0 may be -infinity, t1 infinity
 *   double cone                     two chords, if the line is in both nappes; one
 *                                   through the apex, inside, and where the roots
 *                                   between the nappes are one double
 *   refused shape or line           no chord
 */
CYLINT_API int cylint_chord(const cylint_shape *shape, const cylint_line *line,
                            cylint_interval chord[2]);

enum {
    CYLINT_SOLID_MEMBERS = 64, /* the most members of a solid */
    CYLINT_SOLID_PIECES = 2 * CYLINT_SOLID_MEMBERS + 1 /* the most of a line */
};

/*
 * Writes the pieces of a line that are inside a solid made of shapes, ascending, at
 * most `capacity`.  Returns how many.  An array of CYLINT_SOLID_PIECES always
 * suffices.  With a smaller one, if it returns `capacity`, more may follow: call
 * again with line->tmin = the last t1.
 *
 * A solid is a conjunction of clauses; a clause is a union of shapes and of
 * complements of shapes.  clause[i] = c > 0: shape i is a member of clause c.
 * clause[i] = -c: its complement is.  A point is in the solid if every clause has
 * a member that contains the point.  So {1, -2, 3} is shape 0 without shape 1,
 * within shape 2; {1, -2, 3, 3} is within shape 2 or 3.  A shape that is in two
 * clauses stands in the array twice.
 *
 * The closed shapes count, with both caps; the complement of a shape is without its
 * boundary: a line on the boundary of a bore is outside the wall.  Pieces are not
 * longer than the domain and do not touch.  A refused shape contains no point; a
 * refused line has no pieces.
 *
 * Returns -1 if n is more than CYLINT_SOLID_MEMBERS, or a clause is 0 or INT_MIN;
 * with n = 0 there is no piece.
 */
CYLINT_API int cylint_solid_pieces(const cylint_shape *shapes,
                                   const int *clause, size_t n,
                                   const cylint_line *line,
                                   cylint_interval *pieces, size_t capacity);

/*
 * Writes the shapes and clauses of a hollow cylinder or cone, or of a sector of
 * one, as cylint_solid_pieces() takes them, and *n, how many: 1 to
 * CYLINT_TUBE_MEMBERS; 0 after a failure.  It only calls constructors.
 *
 * The axis runs from p0 to p1.  outer[0], outer[1]: the radii at p0 and p1.  inner:
 * those of the bore, whose boundary does not belong to the solid; NULL, or two
 * zeros: none.  A bore that is nowhere narrower than the tube leaves no wall;
 * this is no error.
 *
 * sector: two directions from the axis, NULL: a full turn.  For the angles s and e
 * about z: {cos s, sin s, 0} and {cos e, sin e, 0}.  The solid is the part
 * from the half plane through the axis and sector[0] to that through sector[1],
 * right-handed about the axis.  Up to half a turn it is within two half-spaces,
 * beyond that within one or the other.  Their planes contain p0; their normals are
 * positive multiples of the cross products sector[0] x axis and axis x sector[1],
 * each component within 0.501 units in its last place, if the thread rounds to
 * nearest.  So the planes contain the axis except for that rounding, and exactly if
 * the axis lies along a coordinate or the products have no more than 53 bits.  Here
 * the axis is the double nearest to p1 - p0.  A component of the axis or a
 * direction that is below 2^-400 of the largest one may count as 0.
 *
 * Fails as the constructors do.  EDIRECTION: a direction is parallel to the axis,
 * or both are in one half plane that begins at the axis.
 */
enum { CYLINT_TUBE_MEMBERS = 4 };
CYLINT_API cylint_status cylint_tube(const double p0[3], const double p1[3],
                                     const double outer[2],
                                     const double inner[2],
                                     const double sector[2][3],
                                     cylint_shape shapes[CYLINT_TUBE_MEMBERS],
                                     int clauses[CYLINT_TUBE_MEMBERS],
                                     size_t *n);

/* Returns |d|, the length of one unit of t: of a segment, that from end to end.  If
 * the thread rounds to nearest, its error is at most 0.501 units in the last place.
 * Infinite if it is beyond the largest double; 0 for a refused line. */
CYLINT_API double cylint_line_length(const cylint_line *line);

#ifdef __cplusplus
}
#endif

#endif
