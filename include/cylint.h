/*
 * cylint - intersections of lines with cylinders, cones and round shapes
 *
 *     #include <stdio.h>
 *     #include <cylint.h>
 *     int main(void)
 *     {
 *         const double p0[3] = {0, 0, 0}, p1[3] = {0, 0, 4};
 *         const double o[3] = {-3, 0, 2}, d[3] = {1, 0, 0};
 *         cylint_shape cylinder;
 *         cylint_line ray;
 *         cylint_answer a;
 *         cylint_cylinder(&cylinder, p0, p1, 1, CYLINT_ENDS_CAPPED);
 *         cylint_ray(&ray, o, d);
 *         if (cylint_intersect(&cylinder, &ray, CYLINT_WANT_T, &a) == 2)
 *             printf("%g %g\n", a.hit[0].t, a.hit[1].t);
 *     }
 *
 * prints "2 4".  It is compiled with `cc example.c -lcylint -lm`.
 *
 * Each double that the caller gives stands for exactly one real number.  The
 * answers are exact for these real numbers.  The library normalises no vector
 * and uses no tolerance.
 *
 * Conventions of the whole file:
 *
 *   - Coordinates are right-handed.  All lengths have the same unit, which
 *     may be any.
 *   - A line is o + t d.  The parameter t counts multiples of d.  The vector
 *     d need not have length 1.  The d of a segment is the difference of its
 *     end points as real numbers; it is not rounded.
 *   - z is the axial coordinate of a shape: 0 in the plane of the base, 1 in
 *     the plane of the top, linear in between and beyond.
 *   - A ruling is a straight line on the lateral surface of a cylinder or cone.
 *     A rim is the circle or ellipse in which that surface ends, in the plane
 *     z = 0 or z = 1.  A nappe is one of the two halves of a double cone.
 *   - Only the constructors of shapes and lines can fail.  They return a
 *     status.  Queries never fail: if a constructor refused the shape or the
 *     line, the relation is "miss" and CYLINT_FLAG_INVALID is set.
 *   - The library does not allocate memory, does not print, and does not
 *     change errno, the locale or the floating-point environment, except
 *     that it raises exception flags.  Its only state is the choice of kernels.
 *   - All functions but cylint_use_kernels() may run in any number of threads
 *     at once.
 *   - Shapes and lines are plain structs without pointers.  They may be
 *     copied, stored in arrays and sent through pipes.
 *   - Pointers must not be NULL unless a comment below allows it.  The
 *     library does not check this.
 *
 * cylint(3), section ACCURACY, states the accuracy.
 */
#ifndef CYLINT_H
#define CYLINT_H

/*
 * The linkage of the functions.  Define CYLINT_STATIC in a program that
 * links the static library or compiles the sources as its own.  On Windows
 * this is required: otherwise the functions are imported from a DLL.  On other
 * systems the compiler's options then set the visibility of the functions.
 * The Makefile defines CYLINT_BUILDING when it compiles the libraries.
 */
#if defined(CYLINT_STATIC)
#define CYLINT_API
#elif defined(_WIN32) && defined(CYLINT_BUILDING)
#define CYLINT_API __declspec(dllexport)
#elif defined(_WIN32)
#define CYLINT_API __declspec(dllimport)
#elif defined(__GNUC__)
#define CYLINT_API __attribute__((visibility("default")))
#else
#define CYLINT_API
#endif

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------- status -- */

typedef enum cylint_status {
    CYLINT_OK = 0,
    CYLINT_ENONFINITE,  /* a coordinate, radius, factor, angle or tangent is
                           infinite or NaN */
    CYLINT_EAXIS,       /* the axis, height vector or normal has length 0 */
    CYLINT_EDEGENERATE, /* the vectors a, b, h are linearly dependent */
    CYLINT_ERADIUS,     /* a radius is negative, or all radii are zero */
    CYLINT_EANGLE,      /* the half angle is not in the open interval (0, 90)
                           degrees, or its tangent rounds to 0 */
    CYLINT_EENDS,       /* `ends` is not a value of cylint_ends, or the kind of
                           shape does not have these ends */
    CYLINT_EDIRECTION,  /* the direction or the segment has length 0 */
    CYLINT_EDOMAIN,     /* tmin > tmax, or one of them is NaN */
    CYLINT_EMETHOD,     /* a published method does not support the shape or
                           its ends (cylint_methods.h only) */
    CYLINT_ERANGE = CYLINT_EDOMAIN /* another name of EDOMAIN */
} cylint_status;

/* Returns a short English text for a status.  The text is static, in lower
 * case, without a full stop.  An unknown status gives "unknown status". */
CYLINT_API const char *cylint_strerror(int status);

/* -------------------------------------------------------------- shapes -- */

/* The ends of a shape.  With the first four the planes z = 0 and z = 1 bound
 * the solid.  These four differ only in the caps that a line can hit.  The
 * relation is always the one to the closed solid, with both caps. */
typedef enum cylint_ends {
    CYLINT_ENDS_CAPPED = 0, /* both caps: a closed solid */
    CYLINT_ENDS_OPEN,       /* no caps: a tube */
    CYLINT_ENDS_CAP0,       /* the cap at z = 0 only */
    CYLINT_ENDS_CAP1,       /* the cap at z = 1 only */
    CYLINT_ENDS_INFINITE,   /* unbounded: whole cylinder, double cone */
    CYLINT_ENDS_NAPPE /* the unbounded nappe that contains the base.  If the
                          base is the apex: the nappe that contains the top.
                          The nappe of a cylinder is the whole cylinder */
} cylint_ends;

typedef enum cylint_kind {
    CYLINT_KIND_NONE = 0,  /* refused by its constructor */
    CYLINT_KIND_CYLINDER,  /* circular, constant radius */
    CYLINT_KIND_CONE,      /* circular, radius linear in z */
    CYLINT_KIND_ACONE,     /* circular, from apex, axis and half angle */
    CYLINT_KIND_ECYLINDER, /* elliptic, oblique allowed, constant section */
    CYLINT_KIND_ECONE,     /* elliptic, size of the section linear in z */
    CYLINT_KIND_SPHERE,    /* one ball */
    CYLINT_KIND_CAPSULE,   /* the convex hull of two balls of equal radius */
    CYLINT_KIND_RCONE,     /* the convex hull of two balls */
    CYLINT_KIND_HALFSPACE  /* all points on one side of a plane */
} cylint_kind;

/* A shape, written by one of the constructors below: 400 bytes.  Programs may
 * read kind and ends; cylint_arguments() returns the numbers. */
typedef struct cylint_shape {
    int kind; /* cylint_kind */
    int ends; /* cylint_ends */
    struct {
        int flag[4];
        double number[47];
    } library; /* for the library only (src/shapes/layout.h) */
} cylint_shape;

/*
 * Constructors.  Each one writes *shape and returns CYLINT_OK.  If an
 * argument is wrong, it returns another status and writes a refused shape,
 * which no line hits.  All finite doubles are allowed, including subnormal and
 * huge ones.  If several arguments are wrong, the status is the first of
 * these: ENONFINITE, ERADIUS or EANGLE, EAXIS, EENDS, EDEGENERATE.
 */

/* All points at most r from the axis.  The axis runs from p0 (z = 0) to p1
 * (z = 1).  EAXIS: p0 = p1.  ERADIUS: r <= 0. */
CYLINT_API cylint_status cylint_cylinder(cylint_shape *shape,
                                         const double p0[3], const double p1[3],
                                         double r, cylint_ends ends);

/* A frustum: all points at most r0 + (r1 - r0) z from the axis p0 p1.  If one
 * radius is 0, the cone has its apex there.  If r0 = r1, the shape is a
 * cylinder.  EAXIS: p0 = p1.  ERADIUS: a radius < 0, or both are 0. */
CYLINT_API cylint_status cylint_cone(cylint_shape *shape, const double p0[3],
                                     double r0, const double p1[3], double r1,
                                     cylint_ends ends);

/* The double cone with apex v and the axis v + s u, all real s.  The angle
 * between its rulings and its axis is `degrees`, 0 < degrees < 90.  The shape
 * stores the double nearest to the tangent of that angle (observed).  z = 0 at v,
 * z = 1 at v + u.  The nappe, and the bounded shapes, contain v + u.
 * EANGLE: degrees is not in that interval, or is at most 1.4e-322, because the
 * tangent then rounds to 0.  EAXIS: u = 0. */
CYLINT_API cylint_status cylint_angle_cone(cylint_shape *shape,
                                           const double v[3], const double u[3],
                                           double degrees, cylint_ends ends);

/* The same shape, from the tangent of the half angle, which is stored without
 * rounding.  EANGLE: tangent <= 0.  EAXIS: u = 0. */
CYLINT_API cylint_status cylint_tangent_cone(cylint_shape *shape,
                                             const double v[3],
                                             const double u[3], double tangent,
                                             cylint_ends ends);

/* All points c + x a + y b + z h with x^2 + y^2 <= 1.  The vectors a, b, h must
 * be linearly independent.  They need not be perpendicular.
 * EAXIS: h = 0.  EDEGENERATE: a.(b x h) = 0, an exact test. */
CYLINT_API cylint_status cylint_elliptic_cylinder(
    cylint_shape *shape, const double c[3], const double a[3],
    const double b[3], const double h[3], cylint_ends ends);

/* All points c + x a + y b + z h with x^2 + y^2 <= (1 + (k-1) z)^2.  The factor
 * k >= 0 scales the top: k = 1 gives an elliptic cylinder, k = 0 a cone with
 * its apex at c + h.  ERADIUS: k < 0.  EAXIS, EDEGENERATE: as before. */
CYLINT_API cylint_status cylint_elliptic_cone(
    cylint_shape *shape, const double c[3], const double a[3],
    const double b[3], const double h[3], double k, cylint_ends ends);

/* A ball: all points at most r from c.  Its surface is the part lateral; z and
 * phi of a hit are 0.  ERADIUS: r <= 0.  EENDS: ends is not capped. */
CYLINT_API cylint_status cylint_sphere(cylint_shape *shape, const double c[3],
                                       double r, cylint_ends ends);

/* All points at most r from the segment from p0 (z = 0) to p1 (z = 1): a
 * round cone with equal radii, see there.
 * ERADIUS: r <= 0.  EENDS: infinite, nappe. */
CYLINT_API cylint_status cylint_capsule(cylint_shape *shape, const double p0[3],
                                        const double p1[3], double r,
                                        cylint_ends ends);

/*
 * The convex hull of the balls of radius r0 about p0 and r1 about p1.  If
 * r0 = r1, the shape is a capsule.  If one ball holds the other,
 * |p1 - p0| <= |r1 - r0|, the shape is that ball, its kind is
 * CYLINT_KIND_SPHERE, and its surface is the part CAP0 or CAP1.  Equal balls:
 * CAP0.  z and phi of a hit remain those of the axis from p0 to p1; they are 0
 * if p0 = p1.  ERADIUS: a radius < 0, or both are 0.  EENDS: infinite, nappe.
 *
 * The lateral surface of a capsule and a round cone ends at the circles on
 * which it touches the balls.  The circles are part of it.  The parts CAP0 and
 * CAP1 are the other parts of the spheres about p0 and p1; on the caps of a
 * capsule z is below 0 or above 1.  If the radii differ, the circles are not in the
 * planes z = 0 and z = 1, and next to them z of a cap can be from 0 to 1, z of the
 * lateral surface below 0 or above 1.
 */
CYLINT_API cylint_status cylint_round_cone(cylint_shape *shape,
                                           const double p0[3], double r0,
                                           const double p1[3], double r1,
                                           cylint_ends ends);

/* All points x with (x - p).n <= 0: n points out, and need not have length 1.  The
 * shape is unbounded: its `ends` are CYLINT_ENDS_INFINITE.  Its surface, a plane,
 * is the part lateral; z and phi of a hit are 0.  A whole line has one hit; a line
 * parallel to the plane has none: inside it is `cross`, in the plane `along`,
 * outside `miss`.  The box is infinite, but ends at the plane if n has only one
 * component that is not 0.  Published methods (cylint_methods.h) refuse it.
 * EAXIS: n = 0. */
CYLINT_API cylint_status cylint_halfspace(cylint_shape *shape,
                                          const double p[3], const double n[3]);

enum { CYLINT_ARGUMENTS_MOST = 13 }; /* numbers of cylint_arguments() */

/*
 * cylint_arguments - the numbers from which a constructor made a shape
 *
 * Returns the kind of the shape's constructor.  Writes the numbers that this
 * constructor takes, in its order and with the bits that were given:
 *
 *   CYLINDER, CAPSULE   p0 p1 r       7 numbers
 *   CONE, RCONE         p0 r0 p1 r1   8
 *   ACONE               v u tangent   7, those of cylint_tangent_cone()
 *   ECYLINDER           c a b h       12
 *   ECONE               c a b h k     13
 *   SPHERE              c r           4
 *   HALFSPACE           p n           6
 *   NONE                              0, a refused shape
 *
 * The kind is shape->kind, except that it is RCONE for a capsule or round cone
 * which is one ball.  So a cone of equal radii is returned as a cylinder, a round
 * cone of equal radii as a capsule, an elliptic cone whose k is 1 as an elliptic
 * cylinder.  The constructor of that kind makes the same shape of these numbers and
 * shape->ends.
 */
CYLINT_API cylint_kind cylint_arguments(const cylint_shape *shape,
                                        double numbers[CYLINT_ARGUMENTS_MOST]);

/* --------------------------------------------------------------- lines -- */

/* A line o + t d with its domain tmin <= t <= tmax.  tmin and tmax may be
 * infinite.  Written by one of the constructors below.  A program may then change
 * tmin and tmax, but not to NaN: if tmin > tmax, the line has no hits and no
 * pieces. */
typedef struct cylint_line {
    double o[3];
    double d[3];  /* the direction: the nearest doubles */
    double size;  /* max of d[i] in absolute value */
    int in_range; /* 1: doubles neither over- nor underflow */
    int valid;    /* 0: refused by its constructor */
    double tmin, tmax;
    double d_lo[3]; /* segments: d + d_lo = b - a exactly, unless b - a
                       overflows; other lines: 0 */
    double end[3];  /* segments: b */
    int segment;    /* 1: the direction is end - o */
} cylint_line;

/*
 * Constructors.  Each one writes *line and returns CYLINT_OK.  If an argument
 * is wrong, it returns another status and writes a refused line, which hits
 * nothing.  For all: ENONFINITE if a coordinate is infinite or NaN; EDIRECTION
 * if d = 0.  If several arguments are wrong, the status is the first of these:
 * ENONFINITE, EDIRECTION, EDOMAIN.
 */

/* All real t. */
CYLINT_API cylint_status cylint_whole_line(cylint_line *line, const double o[3],
                                           const double d[3]);

/* t >= 0. */
CYLINT_API cylint_status cylint_ray(cylint_line *line, const double o[3],
                                    const double d[3]);

/* From a to b: o = a, d = b - a exactly, 0 <= t <= 1.  EDIRECTION: a = b. */
CYLINT_API cylint_status cylint_segment(cylint_line *line, const double a[3],
                                        const double b[3]);

/* tmin <= t <= tmax.  Both may be infinite.
 * EDOMAIN: tmin > tmax, or one of them is NaN. */
CYLINT_API cylint_status cylint_span(cylint_line *line, const double o[3],
                                     const double d[3], double tmin,
                                     double tmax);

/* ----------------------------------------------------------- intersect -- */

/* Which points the whole line, t from -infinity to infinity, and the closed solid
 * have in common.  The line's domain and missing caps make no difference. */
typedef enum cylint_relation {
    CYLINT_RELATION_MISS = 0, /* no common point */
    CYLINT_RELATION_TOUCH,    /* one common point, on the boundary */
    CYLINT_RELATION_ALONG,    /* more than one common point, all on the
                        boundary: on a ruling, or in the plane of a cap */
    CYLINT_RELATION_CROSS     /* a common point in the interior */
} cylint_relation;

typedef enum cylint_part {
    CYLINT_PART_LATERAL = 0, /* the lateral surface with its rims and apex */
    CYLINT_PART_CAP0,
    CYLINT_PART_CAP1
} cylint_part;

typedef enum cylint_side {
    CYLINT_SIDE_ENTERING = 0, /* the line enters the solid as t grows */
    CYLINT_SIDE_LEAVING,      /* the line leaves the solid as t grows */
    CYLINT_SIDE_BOTH          /* both: a touch, or the line passes through the
                            apex from one nappe to the other */
} cylint_side;

/* The members that a query computes: a sum of these.  The relation and n are
 * always written.  Members that are not wanted are neither computed nor
 * written. */
enum {
    CYLINT_WANT_T = 1 << 0,
    CYLINT_WANT_PART = 1 << 1, /* part and side */
    CYLINT_WANT_POINT = 1 << 2,
    CYLINT_WANT_NORMAL = 1 << 3,
    CYLINT_WANT_Z = 1 << 4,
    CYLINT_WANT_PHI = 1 << 5,
    /* only the hit with the least t: n is 0 or 1 */
    CYLINT_WANT_NEAREST = 1 << 6,
    CYLINT_WANT_COUNT = 0, /* relation and n only */
    CYLINT_WANT_ALL = (1 << 6) - 1,
    CYLINT_SIGNED = 1 << 7 /* of distances only: cylint_distance.h */
};

enum { CYLINT_FLAG_INVALID = 1 }; /* the line or the shape was refused */

typedef struct cylint_hit {
    double t;
    double point[3];  /* o + t d */
    double normal[3]; /* outward unit normal.  On a cap: of the cap.  On the
                         lateral surface and the rims: of the lateral
                         surface.  At an apex: along the axis, away from
                         the solid.  At the apex of a double cone: along
                         the axis, its scalar product with d negative; if d
                         is perpendicular to the axis, towards the base,
                         or, if the base is the apex, opposite to the
                         axis */
    double z;         /* axial coordinate: 0 at the base, 1 at the top */
    double phi;       /* angle about the axis divided by 2 pi, in [0, 1).
                         A value that would round to 1 is the double below
                         1; on the axis phi is 0.
                         Elliptic kinds: 0 along a, 1/4 along b.
                         Circular kinds: 0 along e x axis, right-handed
                         about the axis.  e is the coordinate direction
                         along which the axis has its component of least
                         size; of equal ones the first. */
    int part;         /* cylint_part */
    int side;         /* cylint_side */
} cylint_hit;

typedef struct cylint_answer {
    int relation;      /* cylint_relation, of the whole line */
    int n;             /* number of hits: 0, 1 or 2 */
    int flags;         /* CYLINT_FLAG_... */
    cylint_hit hit[2]; /* hit[0] to hit[n-1] are written, t ascending */
} cylint_answer;

/*
 * cylint_intersect - intersects one line with one shape
 *
 * Writes *answer and returns answer->n, the number of hits.
 *
 * The hits are the points where the overlap of the line and the solid begins
 * and ends, so there are at most two.  The answer contains a hit if it lies
 * on a part that is present and tmin <= t <= tmax.  A whole line has 0 or 2
 * hits with a capped shape, and 1 if it touches it.  A point of a rim is one
 * hit, on the lateral surface.
 *
 * Degenerate cases of a whole line:
 *
 *   inside an open tube, parallel    cross, no hit
 *     to the axis
 *   on a ruling, bounded shape       along, a hit at each end: rim or apex
 *   on a ruling, unbounded shape     along, no hit; a cone's nappe: the apex
 *   in the plane of a cap            along, two hits on the rim; or touch
 *   through the apex of a double     inside the cone: cross, one hit;
 *     cone                           outside: touch; on it: along, no hit
 *
 * `want` is a sum of CYLINT_WANT_ values.
 *
 * The part of the line inside the solid is not hit[0].t to hit[1].t if the line
 * begins or ends inside, or a cap is missing: cylint_chord() of
 * cylint_pieces.h computes it.
 *
 * Accuracy.  Relation, n, part and side are exact.  t, each component of point
 * and normal, z and phi are the doubles nearest to the real numbers at the real
 * root, not at the rounded t.  Beyond the largest double they are infinite; 0 is
 * never -0.  Ties of t, point and z are rounded to even.  If the real number
 * differs from the middle of two doubles by less than 2^-90 of itself, a component
 * of normal, or phi, may be the other one of the two.  The bits do not depend on
 * the other members wanted, on the function that returns them, on the processor,
 * the C library or the rounding mode.
 */
CYLINT_API int cylint_intersect(const cylint_shape *shape,
                                const cylint_line *line, unsigned want,
                                cylint_answer *answer);

/* Writes the other wanted members of a hit whose t, part and side a query of the
 * same shape and line has written, with the bits of cylint_intersect().  The query
 * is cylint_intersect(), cylint_nearest() or one of a scene other than
 * cylint_scene_first_boundary().  Members that are not wanted keep their values.
 * So a program that finds many hits describes only the one that it uses.  If no
 * hit of the line has this t, part and side, nothing is promised of the values. */
CYLINT_API void cylint_describe(const cylint_shape *shape,
                                const cylint_line *line, unsigned want,
                                cylint_hit *hit);

/* Returns 1 if cylint_intersect() finds a hit, else 0.  Exact. */
CYLINT_API int cylint_occluded(const cylint_shape *shape,
                               const cylint_line *line);

/* Returns 1 if the point is inside the solid, 0 if it is on the boundary, -1
 * if it is outside.  Exact.  Returns -1 for a refused shape and for a point
 * with an infinite or NaN coordinate. */
CYLINT_API int cylint_contains(const cylint_shape *shape,
                               const double point[3]);

/*
 * cylint_outside - a point from which a ray can leave a hit
 *
 * The point of a hit is rounded, so it is as often inside the solid as outside,
 * and a ray from it can hit the same surface again.  This writes a point
 * near hit->point for which cylint_contains() returns `side`: -1 outside, 1
 * inside.  If a bounded shape is not round, an outside point is on the outer
 * side of the hit's part: for a hit on the lateral surface beside a rim it is
 * not only beyond the cap.  Point, normal and part of the hit must be written, by a
 * query other than cylint_scene_first_boundary(), whose normal is that of a solid.
 * `point` may be a member of *hit, such as hit->point.
 *
 * Returns 1 and writes the first of these points that is finite and on the side:
 *
 *   - hit->point itself;
 *   - the nearest of the points that differ from it by k or 0 steps of the doubles
 *     in each coordinate, towards the side, for the least k from 1 to 4;
 *   - a point further along the normal;
 *   - for side 1, a point towards the middle of the shape;
 *   - a point along a diagonal of the coordinates, as at the apex of a double cone.
 *
 * Returns 0 and writes hit->point if there is none.  This happens
 *
 *   - for side 1, if the solid is thinner than the steps of the doubles, or if the
 *     shape was refused;
 *   - for side -1, between the nappes of a double cone, where they are nearer to
 *     each other than these steps, and where the outside is beyond the largest
 *     double;
 *   - perhaps if hit->point is infinite, or if subnormal numbers are flushed to
 *     zero and all coordinates of the hit are below 2^-969 in absolute value.
 *
 * It takes up to some 0.3 ms at the apex of a double cone and where a shape is hit
 * from 1e16 times its size away, up to some 0.8 ms for an inside point if the hit
 * is on a rim in the origin of coordinates, and up to 200 ms (observed) if
 * exponents of the numbers differ by hundreds.
 *
 * Let q be the point of a convex solid nearest to an outside point p: a ray
 * p + t d with d.(p - q) >= 0 misses the solid.  A ray from an inside point of
 * a capped shape hits it once; where a cap is missing, it can pass through.
 */
CYLINT_API int cylint_outside(const cylint_shape *shape, const cylint_hit *hit,
                              int side, double point[3]);

/* Writes the least box parallel to the coordinate axes that contains the
 * solid.  Each side is rounded outward, by at most 5 units in the last place
 * (observed).  A side is -HUGE_VAL or HUGE_VAL where the solid is unbounded or ends
 * beyond the largest double.  A refused shape gives lo = HUGE_VAL and
 * hi = -HUGE_VAL. */
CYLINT_API void cylint_bounds(const cylint_shape *shape, double lo[3],
                              double hi[3]);

/* ------------------------------------------------------------- batches -- */

/*
 * A pack: n shapes, arranged for SIMD.  cylint_pack_shapes() computes what
 * does not depend on a line and writes it to `memory`, which has
 * cylint_pack_bytes(n) bytes at any address.  If a size_t cannot hold that
 * number, it is SIZE_MAX, which malloc() refuses.  Queries read `memory` and
 * also `shapes`.  The caller must not move or change either of them while the
 * pack is in use.  The shapes have the numbers 0 to n - 1.  No line hits a refused
 * shape.  Queries do not write to a pack: any number of threads may share it.
 */
typedef struct cylint_pack {
    size_t n;
    const cylint_shape *shapes;
    void *memory; /* the pointer that the caller gave */
} cylint_pack;

CYLINT_API size_t cylint_pack_bytes(size_t n);
CYLINT_API void cylint_pack_shapes(cylint_pack *pack, void *memory,
                                   const cylint_shape *shapes, size_t n);

/* n lines o + t d: one array of n doubles for each coordinate, at any address that
 * a double can have.  tmin = NULL: all tmin are 0.  tmax = NULL: all tmax are
 * infinite.  A line is invalid if a coordinate is infinite or NaN, if d = 0, or if
 * tmin <= tmax is false.  Its relation is "miss". */
typedef struct cylint_lines {
    size_t n;
    const double *o[3], *d[3];
    const double *tmin, *tmax;
} cylint_lines;

/*
 * The arrays for the answers, one element for each answer.  They must not
 * overlap the input.  A member that is NULL is neither computed nor written.
 * If there is no first or second hit, its part is -1 and its other members are
 * NaN.  Set members that are not wanted to NULL: `cylint_columns columns = {0}`, in
 * C++ `= {}`.
 */
typedef struct cylint_columns {
    signed char *relation; /* cylint_relation */
    signed char *n;
    double *t0, *t1;
    signed char *part0, *part1; /* cylint_part */
    /* of the first and of the second hit, each coordinate in an array of its own */
    double *point0[3], *normal0[3], *z0, *phi0;
    double *point1[3], *normal1[3], *z1, *phi1;
} cylint_columns;

/* All batch functions return the same bits as cylint_intersect(), on every
 * processor, for every number of lines and shapes, at every address. */

/* Intersects one line with each shape.  Answer i is that of shape i. */
CYLINT_API void cylint_intersect_shapes(const cylint_pack *pack,
                                        const cylint_line *line,
                                        const cylint_columns *answers);

/* Intersects each line with one shape.  Answer i is that of line i. */
CYLINT_API void cylint_intersect_lines(const cylint_shape *shape,
                                       const cylint_lines *lines,
                                       const cylint_columns *answers);

/* Intersects line i with shape i, for 0 <= i < pack->n.  There must be at least
 * pack->n lines. */
CYLINT_API void cylint_intersect_pairs(const cylint_pack *pack,
                                       const cylint_lines *lines,
                                       const cylint_columns *answers);

/* Returns the number of the shape with the first hit, that of least t.  Of
 * hits with equal t it chooses the shape with the lowest number.  Writes the
 * wanted members of the hit to *hit.  If no shape is hit, it returns pack->n
 * and writes nothing. */
CYLINT_API size_t cylint_nearest(const cylint_pack *pack,
                                 const cylint_line *line, unsigned want,
                                 cylint_hit *hit);

/* Returns the number of shapes that the line hits.  If `enough` is not 0, it
 * stops counting at `enough`: with 1 it returns whether any shape is hit. */
CYLINT_API size_t cylint_count(const cylint_pack *pack, const cylint_line *line,
                               size_t enough);

/* n points: one array of n doubles for each coordinate, as of cylint_lines. */
typedef struct cylint_points {
    size_t n;
    const double *xyz[3];
} cylint_points;

/* Each point and one shape.  side[i] is what cylint_contains() returns for point
 * i: 1 inside, 0 on the boundary, -1 outside; for a refused shape and a point with
 * an infinite or NaN coordinate -1.  The array `side` has points->n elements and
 * must not overlap the input.  cylint_distance.h has the distances of points. */
CYLINT_API void cylint_contains_points(const cylint_shape *shape,
                                       const cylint_points *points,
                                       signed char *side);

/* Point i and shape i, for 0 <= i < points->n. */
CYLINT_API void cylint_contains_pairs(const cylint_shape *shapes,
                                      const cylint_points *points,
                                      signed char *side);

/* ------------------------------------------------------------- kernels -- */

/*
 * The kernels are compiled for several instruction sets.  The library chooses
 * the best that the processor runs.  The answers are the same for all.
 *
 * cylint_kernels_in_use()  returns the name of the kernels in use.
 * cylint_kernels_name()    returns the names of those that this processor
 *                          runs, best first, numbered from 0.  Other numbers
 *                          give NULL.
 * cylint_use_kernels()     chooses kernels by name, NULL for the best, and
 *                          returns 1.  Returns 0 and changes nothing if the
 *                          processor runs none of that name.  Do not call it
 *                          while queries run.  A scene or a geometry for
 *                          Embree keeps the kernels in use when it is made.
 */
CYLINT_API const char *cylint_kernels_in_use(void);
CYLINT_API const char *cylint_kernels_name(int number);
CYLINT_API int cylint_use_kernels(const char *name);

/* ------------------------------------------------------------ version -- */

#define CYLINT_VERSION_MAJOR 0
#define CYLINT_VERSION_MINOR 1
#define CYLINT_VERSION_PATCH 0
#define CYLINT_VERSION "0.1.0"

/* 10000 major + 100 minor + patch.  Later versions have larger numbers.
 * Example: #if CYLINT_VERSION_NUMBER >= 100 tests for 0.1.0 or later. */
#define CYLINT_VERSION_NUMBER                                    \
    (CYLINT_VERSION_MAJOR * 10000 + CYLINT_VERSION_MINOR * 100 + \
     CYLINT_VERSION_PATCH)

/*
 * cylint_version() and cylint_version_number() return CYLINT_VERSION and
 * CYLINT_VERSION_NUMBER of the library that runs.  They can differ from those
 * of this header.  The other functions return the sizes in bytes of structs
 * of that library, for programs that load it at run time and do not compile
 * this header.
 */
CYLINT_API const char *cylint_version(void);
CYLINT_API int cylint_version_number(void);
CYLINT_API size_t cylint_sizeof_shape(void);
CYLINT_API size_t cylint_sizeof_line(void);
CYLINT_API size_t cylint_sizeof_hit(void);
CYLINT_API size_t cylint_sizeof_answer(void);
CYLINT_API size_t cylint_sizeof_pack(void);

/* ----------------------------------------------------------- self-test -- */

/* The faults that cylint_selftest() reports.  If one of the bits of
 * CYLINT_SELFTEST_BROKEN is set, the library's answers can be wrong. */
enum {
    CYLINT_SELFTEST_FORMAT = 1 << 0, /* double is not binary64 of IEEE 754, or
                                            its byte order is not that of
                                            integers */
    CYLINT_SELFTEST_CONTRACTED = 1 << 1, /* a * b + c is rounded only once:
                                            compile with -ffp-contract=off */
    CYLINT_SELFTEST_UNROUNDED = 1 << 2,  /* excess precision, reordered sums,
                                            or a quotient or square root that
                                            is not correctly rounded */
    CYLINT_SELFTEST_FLUSHED = 1 << 3,    /* subnormal results become 0 */
    CYLINT_SELFTEST_ZEROED = 1 << 4,     /* subnormal operands are read as 0 */
    CYLINT_SELFTEST_DIRECTED = 1 << 5,   /* rounding is not to nearest even */
    CYLINT_SELFTEST_BROKEN = (1 << 3) - 1
};

/* Tests this build of the library in the present floating-point environment
 * of the calling thread.  Returns 0 or a sum of the values above.  The caller
 * may choose FLUSHED, ZEROED and DIRECTED: relation, n and all members of hits
 * stay the same. */
CYLINT_API int cylint_selftest(void);

#ifdef __cplusplus
}
#endif

#endif
