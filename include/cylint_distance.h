/*
 * cylint_distance - how far points are from the surfaces of shapes
 *
 *     cylint_closest near;
 *     cylint_distance(&shape, point, CYLINT_WANT_POINT, &near);
 *     printf("%g from %g %g %g\n", near.distance, near.point[0], near.point[1],
 *            near.point[2]);
 *
 * The conventions of cylint.h apply.  Each double stands for exactly one real
 * number, and nothing depends on a tolerance.  The functions may run in any
 * number of threads at once.
 */
#ifndef CYLINT_DISTANCE_H
#define CYLINT_DISTANCE_H

#include "cylint.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Where the nearest point lies.  Rims and apex belong to the part lateral, caps
 * and round ends to the parts cap0 and cap1. */
typedef enum cylint_feature {
    CYLINT_FEATURE_LATERAL = 0, /* the lateral surface without rims and apex;
                                   the surface of a sphere */
    CYLINT_FEATURE_CAP0,        /* a cap or a round end, without its rim */
    CYLINT_FEATURE_CAP1,
    CYLINT_FEATURE_RIM0, /* the circles or ellipses where the lateral surface
                            ends.  Of a capsule and a round cone: the circles
                            on which it touches the balls */
    CYLINT_FEATURE_RIM1,
    CYLINT_FEATURE_APEX /* the point where a cone has the radius 0; an end of a
                           round cone whose radius is 0 */
} cylint_feature;

/*
 * CYLINT_SIGNED in `want` of the functions below and of cylint_scene.h: signed
 * distances to closed solids.  The closed solid of a shape has both caps or round
 * ends, whatever the ends; infinite and nappe shapes remain unbounded.  The
 * distance is negative inside the solid, 0 on its boundary and positive outside.
 * So with open ends or one cap it is that of the same shape with
 * CYLINT_ENDS_CAPPED.
 */

/* The point of a surface that is nearest to a given point. */
typedef struct cylint_closest {
    double distance;
    double point[3];  /* the nearest point */
    double normal[3]; /* outward unit normal there, as in cylint_hit.  At the
                         apex of a double cone: along the axis, towards the
                         base, or, if the base is the apex, opposite to the
                         axis */
    int part;         /* cylint_part; -1: there is no surface */
    int feature;      /* cylint_feature */
    int flags;        /* CYLINT_FLAG_INVALID: the shape was refused, or a
                         coordinate of the point is infinite or NaN */
} cylint_closest;

/* The size of cylint_closest in bytes in the library that runs, as
 * cylint_sizeof_hit(). */
CYLINT_API size_t cylint_sizeof_closest(void);

/*
 * cylint_distance - distance of a point from the surface of a shape
 *
 * The surface consists of the parts that `ends` leaves present.  For capped,
 * infinite and nappe it is the whole boundary of the solid.  Then the distance
 * is negative inside the solid: its sign is that of -cylint_contains().  For
 * open, cap0 and cap1 the distance is never negative.  With CYLINT_SIGNED in
 * `want` the surface is the whole boundary of the closed solid for these too.
 *
 * Writes answer->distance and answer->flags, and returns answer->distance.
 * `point` must not be a member of *answer. `want` is a sum of CYLINT_WANT_PART
 * (part and feature), CYLINT_WANT_POINT, CYLINT_WANT_NORMAL and CYLINT_SIGNED;
 * other values have no effect.  Members that are not wanted are not written.
 * If the shape was refused, if the point is not finite, or if there is no
 * surface, the distance is HUGE_VAL, part is -1 and feature 0, wanted or not,
 * and point and normal are not written.  A real distance beyond the largest
 * double is HUGE_VAL, too: part, if wanted, distinguishes them.  There is no
 * surface if a round cone is the ball about one end and `ends` leaves out that
 * end, unless CYLINT_SIGNED is set.
 *
 * If several points of the surface are nearest, the answer is the first of
 * these:
 *
 *   - of several parts: lateral, cap0, cap1;
 *   - of the two nappes of a double cone: the one that contains the base.  If
 *     the base is the apex: the one that contains the top;
 *   - of a circle about the axis: its point with phi = 0 (cylint_hit);
 *   - of a sphere about the point: its point with the largest first
 *     coordinate.
 *
 * Accuracy.  Circular and round kinds, half-spaces: part, feature and sign are
 * exact.  The distance and each component of point and normal are the doubles
 * nearest to the real numbers, ties to even; infinite beyond the largest double.
 * The distance is 0 if and only if the point is on the surface: a distance that
 * would round to 0 becomes the least subnormal number.  All these numbers are the
 * same in every rounding mode, and 0 is never -0.  Where exponents of the data
 * differ by a thousand, an answer can take 3 milliseconds (observed).
 *
 * Elliptic kinds: the sign is exact, and the distance is 0 if and only if the point
 * is on the surface.  In rounding to nearest the answers are proved to be as for
 * circular kinds at nearly all points of ordinary shapes; elsewhere their errors
 * are measured.  For extreme shapes only the sign is right: the distance can be
 * infinite, and components of point and normal can be NaN.  cylint_distance(3),
 * section Elliptic kinds, states which points and shapes these are, the measured
 * errors, and how long an answer takes.
 */
CYLINT_API double cylint_distance(const cylint_shape *shape,
                                  const double point[3], unsigned want,
                                  cylint_closest *answer);

/*
 * cylint_safety - a lower bound of the distance, cheaper than cylint_distance()
 *
 * Returns a number from 0 to the absolute distance of the point from the
 * surface, never above it.  HUGE_VAL where there is no surface and where
 * cylint_distance() sets a flag.
 *
 * Let d be the absolute distance and R the length of the axis plus the larger
 * radius; of a sphere the radius.  For circular and round kinds the result is at
 * most E = 16 * 2^-52 (d + R) below d: some units in the last place of the point's
 * coordinates relative to the shape, not of d.  For infinite ends |P - base| * 1.42
 * takes the place of d in E.
 *
 * In these cases the result is the double below d, or 0 if d is 0, and takes as
 * long as the distance: the bound that is computed otherwise is not above 0; E is
 * below 2^-1073; the ends are cap0, cap1 or nappe; angle cones, half-spaces, and
 * round kinds that are not capped; rounding is not to nearest; neither gcc nor
 * clang compiled the library.  cylint_distance(3), section Safety, has elliptic
 * kinds.
 */
CYLINT_API double cylint_safety(const cylint_shape *shape,
                                const double point[3]);

/* Returns 1 if the absolute distance is at most `ulps` units in the last place
 * of the coordinate of the point that is the largest in absolute value, else 0.
 * ulps = 0: the point is exactly on the surface; below 0 or NaN: returns 0.  The
 * unit of a coordinate 0 is the least subnormal number.  The compared distance is
 * the one that cylint_distance() returns; an infinite one gives 0.  The comparison
 * is exact in every floating-point environment. */
CYLINT_API int cylint_on_surface(const cylint_shape *shape,
                                 const double point[3], double ulps);

/* The arrays for the answers, one element for each answer.  They must not
 * overlap the input.  An array that is NULL is neither computed nor written.
 * Where an answer has no point and no normal, NaN is written. */
typedef struct cylint_closest_columns {
    double *distance;
    signed char *part, *feature;
    double *point[3], *normal[3];
} cylint_closest_columns;

/* Each point and one shape.  Answer i is that of point i. */
CYLINT_API void cylint_distance_points(const cylint_shape *shape,
                                       const cylint_points *points,
                                       const cylint_closest_columns *answers);

/* Point i and shape i, for 0 <= i < points->n. */
CYLINT_API void cylint_distance_pairs(const cylint_shape *shapes,
                                      const cylint_points *points,
                                      const cylint_closest_columns *answers);

/*
 * Each point and one shape; or, _pairs, point i and shape i, for
 * 0 <= i < points->n.  Element i is what the function for one point returns for
 * point i: the same bits in the same floating-point environment, also where the
 * shape was refused or a coordinate is infinite or NaN.  The array for the answers
 * has points->n elements and must not overlap the input.  on[i] is 1 or 0.
 */
CYLINT_API void cylint_safety_points(const cylint_shape *shape,
                                     const cylint_points *points,
                                     double *safety);
CYLINT_API void cylint_safety_pairs(const cylint_shape *shapes,
                                    const cylint_points *points,
                                    double *safety);
CYLINT_API void cylint_on_surface_points(const cylint_shape *shape,
                                         const cylint_points *points,
                                         double ulps, signed char *on);
CYLINT_API void cylint_on_surface_pairs(const cylint_shape *shapes,
                                        const cylint_points *points,
                                        double ulps, signed char *on);

/* Returns the number of the shape with the least absolute distance or, with
 * CYLINT_SIGNED, the least signed distance, if that is at most `within`; of equal
 * ones the lowest number.  A refused shape and one without a surface do not count,
 * nor does any shape if the point is not finite.  Writes the wanted members of its
 * answer as cylint_distance() does.  Returns n, and writes nothing, if there is
 * none.  Compares the doubles that cylint_distance() returns, but computes none for
 * a shape whose bounding ball is farther away than the least one so far.  So an
 * extreme elliptic shape, see cylint_distance(), can be left out although its
 * double is the least, if that double is wrong and the real distance is greater.
 * `point` must not be a member of *answer.  Where shapes overlap, the nearest
 * surface may lie inside another shape: cylint_scene(3), section Overlapping
 * shapes. */
CYLINT_API size_t cylint_closest_shape(const cylint_shape *shapes, size_t n,
                                       const double point[3], double within,
                                       unsigned want, cylint_closest *answer);

#ifdef __cplusplus
}
#endif

#endif
