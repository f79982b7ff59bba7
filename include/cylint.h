/*
 * cylint - where does a line meet a cylinder or a cone?
 *
 * Every answer is about the real numbers that the given doubles are: nothing
 * is normalised, nothing is compared with a tolerance.
 *
 * Conventions, once for the whole file:
 *
 *   - Space is right-handed; any one unit of length serves.
 *   - A line is o + t d.  t is in multiples of d, which need not be a unit
 *     vector.  A segment's d is the difference of its end points as real
 *     numbers, not rounded.
 *   - A point of a shape has an axial coordinate z: 0 at the base, 1 at the
 *     top, z proportional to the distance from the base plane.
 *   - Making a shape or a line can fail and says why by a status.  Asking
 *     never fails: a shape or line that was refused answers "miss" with the
 *     flag CYLINT_FLAG_INVALID.
 *   - The library allocates nothing, prints nothing, keeps no state but which
 *     kernels it uses, and does not touch errno or the locale.  All functions
 *     may be called from any number of threads; shapes and lines are plain
 *     structs without pointers and may be copied, stored in arrays and sent
 *     through pipes.
 *   - Null pointers are the caller's mistake.
 *
 * Accuracy is stated in cylint(3), section ACCURACY.
 */
#ifndef CYLINT_H
#define CYLINT_H

#define CYLINT_VERSION_MAJOR 0
#define CYLINT_VERSION_MINOR 1
#define CYLINT_VERSION_PATCH 0
#define CYLINT_VERSION "0.1.0"

/* Ascends with the version: #if CYLINT_VERSION_NUMBER >= 100 means 0.1.0. */
#define CYLINT_VERSION_NUMBER                                    \
    (CYLINT_VERSION_MAJOR * 10000 + CYLINT_VERSION_MINOR * 100 + \
     CYLINT_VERSION_PATCH)

/*
 * How functions are declared.  A program that links the static library, or
 * compiles the sources as its own, defines CYLINT_STATIC: on Windows it must,
 * because functions are imported from a DLL otherwise; elsewhere functions then
 * have the visibility that the compiler's options say.  The Makefile defines
 * CYLINT_BUILDING for the sources of the libraries.
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

/* ------------------------------------------------------------ version -- */

/*
 * CYLINT_VERSION and CYLINT_VERSION_NUMBER of the library that runs, which may
 * be another than the one this header is of; and the sizes in bytes of its
 * structs, for callers that load it at run time and have no header.
 */
CYLINT_API const char *cylint_version(void);
CYLINT_API int cylint_version_number(void);
CYLINT_API size_t cylint_sizeof_shape(void);
CYLINT_API size_t cylint_sizeof_line(void);
CYLINT_API size_t cylint_sizeof_hit(void);
CYLINT_API size_t cylint_sizeof_answer(void);
CYLINT_API size_t cylint_sizeof_pack(void);

/* ------------------------------------------------------------- status -- */

typedef enum cylint_status {
    CYLINT_OK = 0,
    CYLINT_ENONFINITE,  /* a coordinate, radius or factor is not finite */
    CYLINT_EAXIS,       /* the axis (or the height vector) has no length */
    CYLINT_EDEGENERATE, /* the vectors a, b, h are linearly dependent */
    CYLINT_ERADIUS,     /* a radius is negative, or all radii are zero */
    CYLINT_EANGLE,      /* a half angle outside the open range (0, 90), or
                           so small that its tangent rounds to 0 */
    CYLINT_EENDS,       /* not a value of cylint_ends */
    CYLINT_EDIRECTION,  /* a direction, or a segment, of no length */
    CYLINT_EDOMAIN,     /* tmin > tmax, or one of them is not a number */
    CYLINT_EMETHOD      /* a published method does not answer for this */
} cylint_status;

/* A short English text for a status, static, lower case, no full stop. */
CYLINT_API const char *cylint_strerror(int status);

/* -------------------------------------------------------------- shapes -- */

/* How a shape ends.  The first four bound it by the planes z = 0 and z = 1
 * and differ only in which of the two caps can be hit: the relation is
 * always that of the line to the closed solid. */
typedef enum cylint_ends {
    CYLINT_ENDS_CAPPED = 0, /* both caps: a closed solid */
    CYLINT_ENDS_OPEN,       /* no caps: a tube */
    CYLINT_ENDS_CAP0,       /* the cap at z = 0 only */
    CYLINT_ENDS_CAP1,       /* the cap at z = 1 only */
    CYLINT_ENDS_INFINITE,   /* unbounded: whole cylinder, double cone */
    CYLINT_ENDS_NAPPE /* the unbounded nappe that holds the base, or, where
                          the base is the apex, the one that holds the top;
                          a cylinder has one nappe, all of itself */
} cylint_ends;

typedef enum cylint_kind {
    CYLINT_KIND_NONE = 0,  /* what a refused shape is */
    CYLINT_KIND_CYLINDER,  /* circular, constant radius */
    CYLINT_KIND_CONE,      /* circular, radius linear in z: frustum or cone */
    CYLINT_KIND_ACONE,     /* circular cone by apex, axis and half angle */
    CYLINT_KIND_ECYLINDER, /* elliptic, possibly oblique, constant section */
    CYLINT_KIND_ECONE      /* elliptic, section scaled linearly in z */
} cylint_kind;

/*
 * A prepared shape.  Made by one of the constructors below; its members are
 * for the library.  Of use to a reader: kind and ends.
 */
typedef struct cylint_shape {
    int kind;               /* cylint_kind */
    int ends;               /* cylint_ends */
    double base[3];         /* p0, c, or the apex v */
    double axis[3];         /* p1 - p0, h, or u: the nearest doubles ... */
    double r0, r1;          /* radii at z = 0, 1; elliptic: 1, k; acone:
                              0 and the tangent of the half angle */
    double dr, dr_lo;       /* r1 - r0 exactly, as a pair; acone: the tangent */
    double axis_lo[3];      /* ... and what they miss: axis + axis_lo is
                              p1 - p0 exactly, unless that overflows */
    double top[3];          /* p1; cylinder and cone only */
    double a[3], b[3];      /* elliptic kinds: conjugate semi-axes */
    double center[3], ball; /* a ball that holds the solid; infinite: none */
    double size;            /* the largest component of axis */
    int ordinary;           /* 1: doubles neither over- nor underflow */
    int flip;               /* elliptic: 1 where a.(b x h) < 0 */
} cylint_shape;

/*
 * Constructors.  Each fills *shape and returns CYLINT_OK, or returns what is
 * wrong and leaves a shape that every query answers with "miss".  Any finite
 * doubles will do, subnormal and huge ones included.  Of several faults the
 * first in this order is returned: ENONFINITE, ERADIUS or EANGLE, EAXIS, EENDS,
 * EDEGENERATE.
 *
 * cylint_cylinder   the points within r of the axis from p0 to p1.
 *                   EAXIS: p0 = p1.  ERADIUS: not r > 0.
 * cylint_cone       the points within r0 + (r1 - r0) z of the axis from p0
 *                   to p1; r0 = 0 or r1 = 0 gives a pointed cone, r0 = r1 a
 *                   cylinder.  ERADIUS: a radius < 0, or both 0.
 * cylint_elliptic_cylinder
 *                   c + x a + y b + z h with x^2 + y^2 <= 1.  a, b, h: any
 *                   three independent vectors, oblique ones included.
 *                   EDEGENERATE: a.(b x h) = 0, decided exactly.
 * cylint_elliptic_cone
 *                   the same with x^2 + y^2 <= (1 + (k-1) z)^2; k >= 0
 *                   scales the top, k = 1 gives an elliptic cylinder, k = 0
 *                   an elliptic cone with its apex at c + h.
 * cylint_angle_cone the double cone with apex v about the line through v
 *                   along u whose rulings make `degrees` with the axis,
 *                   0 < degrees < 90.  Stored by the nearest double to the
 *                   tangent.  EANGLE: not in that range, or at most
 *                   1.4e-322, where that double is 0.  z = 0 at v, z = 1 at v + u; the nappe and the
 *                   bounded shapes are on the side u points into.
 * cylint_tangent_cone
 *                   the same from the tangent itself, which is then exact.
 */
CYLINT_API cylint_status cylint_cylinder(cylint_shape *shape,
                                         const double p0[3], const double p1[3],
                                         double r, cylint_ends ends);
CYLINT_API cylint_status cylint_cone(cylint_shape *shape, const double p0[3],
                                     double r0, const double p1[3], double r1,
                                     cylint_ends ends);
CYLINT_API cylint_status cylint_elliptic_cylinder(
    cylint_shape *shape, const double c[3], const double a[3],
    const double b[3], const double h[3], cylint_ends ends);
CYLINT_API cylint_status cylint_elliptic_cone(
    cylint_shape *shape, const double c[3], const double a[3],
    const double b[3], const double h[3], double k, cylint_ends ends);
CYLINT_API cylint_status cylint_angle_cone(cylint_shape *shape,
                                           const double v[3], const double u[3],
                                           double degrees, cylint_ends ends);
CYLINT_API cylint_status cylint_tangent_cone(cylint_shape *shape,
                                             const double v[3],
                                             const double u[3], double tangent,
                                             cylint_ends ends);

/* --------------------------------------------------------------- lines -- */

/* A line with its domain [tmin, tmax], which infinities may bound. */
typedef struct cylint_line {
    double o[3];
    double d[3];    /* the direction: the nearest doubles ... */
    double d_lo[3]; /* ... and what they miss: d + d_lo is b - a exactly,
                       unless that overflows; 0 unless a segment */
    double end[3];  /* a segment's b */
    double tmin, tmax;
    double size;  /* the largest component of d */
    int ordinary; /* 1: doubles neither over- nor underflow */
    int segment;  /* 1: the direction is end - o */
    int valid;    /* 0: refused, answers "miss" */
} cylint_line;

/*
 * cylint_whole_line all t.            cylint_ray      t >= 0.
 * cylint_segment    from a to b: o = a, d = b - a exactly, 0 <= t <= 1.
 * cylint_span       tmin <= t <= tmax; either may be infinite.
 *
 * Of several faults the first in this order is returned: ENONFINITE,
 * EDIRECTION, EDOMAIN.
 */
CYLINT_API cylint_status cylint_whole_line(cylint_line *line, const double o[3],
                                           const double d[3]);
CYLINT_API cylint_status cylint_ray(cylint_line *line, const double o[3],
                                    const double d[3]);
CYLINT_API cylint_status cylint_segment(cylint_line *line, const double a[3],
                                        const double b[3]);
CYLINT_API cylint_status cylint_span(cylint_line *line, const double o[3],
                                     const double d[3], double tmin,
                                     double tmax);

/* ------------------------------------------------------------- queries -- */

/* The whole line against the closed solid, whatever domain and caps. */
typedef enum cylint_relation {
    CYLINT_RELATION_MISS = 0, /* no common point */
    CYLINT_RELATION_TOUCH,    /* one common point, not interior */
    CYLINT_RELATION_ALONG,    /* a piece of the boundary longer than a point: a
                        ruling, or a chord in a cap's plane */
    CYLINT_RELATION_CROSS     /* a point of the interior is met */
} cylint_relation;

typedef enum cylint_part {
    CYLINT_PART_LATERAL = 0, /* the lateral surface, rims and apex included */
    CYLINT_PART_CAP0,
    CYLINT_PART_CAP1
} cylint_part;

typedef enum cylint_side {
    CYLINT_SIDE_ENTERING = 0, /* the overlap of line and solid begins */
    CYLINT_SIDE_LEAVING,      /* the overlap ends */
    CYLINT_SIDE_BOTH          /* both at once: a touch, or the apex of a double
                            cone met from within */
} cylint_side;

/* What to compute.  What is not wanted is not computed and not written;
 * relation and n always are.  NEAREST asks for the first hit only. */
enum {
    CYLINT_WANT_T = 1 << 0,
    CYLINT_WANT_PART = 1 << 1, /* part and side */
    CYLINT_WANT_POINT = 1 << 2,
    CYLINT_WANT_NORMAL = 1 << 3,
    CYLINT_WANT_Z = 1 << 4,
    CYLINT_WANT_PHI = 1 << 5,
    CYLINT_WANT_NEAREST = 1 << 6, /* n is 0 or 1: the hit with the least t */
    CYLINT_WANT_FAST = 1 << 7,    /* t in doubles: within 2^-34 of the larger
                                     of |t| and the base's distance from o in
                                     multiples of d; a few ulp as a rule */
    CYLINT_WANT_COUNT = 0,        /* relation and number only */
    CYLINT_WANT_ALL = (1 << 6) - 1
};

enum { CYLINT_FLAG_INVALID = 1 }; /* a refused line or shape was asked */

typedef struct cylint_hit {
    double t;
    double point[3];  /* o + t d */
    double normal[3]; /* outward unit normal: of the cap on a cap, of the
                         lateral surface elsewhere, rims included; at an
                         apex along the axis, away from the solid; at the
                         apex of a double cone along the axis, against d
                         (perpendicular to d: towards the base, or, where
                         that is the apex itself, against the axis) */
    double z;         /* axial coordinate: 0 at the base, 1 at the top */
    double phi;       /* angle about the axis over 2 pi, in [0, 1): one that
                         rounds to 1 is given as 0.
                         Elliptic kinds: from a towards b.  Circular kinds:
                         from e x axis, turning right-handed about the axis,
                         e being the coordinate direction in which the axis
                         has its smallest component in size (the first such).
                         0 on the axis. */
    int part;         /* cylint_part */
    int side;         /* cylint_side */
} cylint_hit;

typedef struct cylint_answer {
    int relation;      /* cylint_relation, of the whole line */
    int n;             /* hits in the domain on parts that are present */
    int flags;         /* CYLINT_FLAG_... */
    cylint_hit hit[2]; /* the first n are written, t ascending */
} cylint_answer;

/*
 * cylint_intersect - where a line meets a shape
 *
 * Writes *answer and returns its n.  Hits are the points where line and
 * solid begin and stop to overlap, so there are at most two, and of a capped
 * shape an unbounded line never meets just one, but for a touch.  A hit is
 * kept if it lies on a part that is present and in the line's domain, ends
 * included.  A point of a rim counts once and as lateral.
 *
 *   down an open tube           cross, no hit
 *   along a ruling, bounded     along, hits on the two rims
 *   along a ruling, unbounded   along, no hit (a nappe: its apex)
 *   in a cap's plane            along, hits on the rim; touch at one point
 *   through the apex of a       inside: cross, one hit; outside: touch;
 *   double cone                 on it: along, no hit
 *
 * Relation, n, part and side are exact; t is the double nearest to the root
 * (ties to even, beyond the largest double: infinite, zero: never -0).  Each
 * component of point and normal, z and phi are within 4 units in their own last
 * place of their values at the root; what is 0 is 0, never -0.  They are
 * functions of line, shape and root: the same bits whatever else is wanted, with
 * CYLINT_WANT_FAST too, and from every function (rounding to nearest; phi as far
 * as atan2() is the same).
 */
CYLINT_API int cylint_intersect(const cylint_shape *shape,
                                const cylint_line *line, unsigned want,
                                cylint_answer *answer);

/* 1 if the line meets a present part of the shape within its domain. */
CYLINT_API int cylint_occluded(const cylint_shape *shape,
                               const cylint_line *line);

/* +1 inside the solid, 0 on its boundary, -1 outside; exact.  A refused
 * shape, or a point that is not finite: -1. */
CYLINT_API int cylint_contains(const cylint_shape *shape,
                               const double point[3]);

/* The least axis-parallel box that holds the solid, each side rounded
 * outward by at most 5 units in the last place, or, where coordinate and
 * reach nearly cancel, by 2^-95 of them; +-HUGE_VAL where it is unbounded.
 * A refused shape: lo = +HUGE_VAL, hi = -HUGE_VAL. */
CYLINT_API void cylint_bounds(const cylint_shape *shape, double lo[3],
                              double hi[3]);

/* What cylint_selftest finds.  BROKEN: answers are not to be relied on. */
enum {
    CYLINT_SELFTEST_FORMAT = 1 << 0,     /* a double is not IEEE 754's, or not
                                            in the byte order of integers */
    CYLINT_SELFTEST_CONTRACTED = 1 << 1, /* a * b + c was rounded once: build
                                            with -ffp-contract=off */
    CYLINT_SELFTEST_UNROUNDED = 1 << 2,  /* excess digits, regrouped sums, or
                                            a quotient or root that is not
                                            the nearest double */
    CYLINT_SELFTEST_FLUSHED = 1 << 3,    /* subnormal results become 0 */
    CYLINT_SELFTEST_ZEROED = 1 << 4,     /* subnormal operands count as 0 */
    CYLINT_SELFTEST_DIRECTED = 1 << 5,   /* rounding is not to nearest even */
    CYLINT_SELFTEST_BROKEN = (1 << 3) - 1
};

/* How this build computes in the calling thread's floating-point environment
 * as it is now: 0, or some of the above.  FLUSHED, ZEROED and DIRECTED are
 * the caller's choice and leave every relation, n, part, side and t as it
 * is.  No function of this library changes the environment. */
CYLINT_API int cylint_selftest(void);

/* ------------------------------------------------------------- batches -- */

/*
 * Many shapes, prepared: what does not depend on a line is computed once and
 * laid out for the widest vectors of the processor.  The caller gives the
 * memory, cylint_pack_bytes(n) bytes at any address, and keeps it there, and
 * the shapes, which are read again where doubles cannot decide, as long as the
 * pack is used.  Shapes are known by their numbers, 0 to n - 1.  A pack is
 * only read by queries: any number of threads may share it.
 */
typedef struct cylint_pack {
    size_t n;
    const cylint_shape *shapes;
    void *memory; /* as it was given */
} cylint_pack;

CYLINT_API size_t cylint_pack_bytes(size_t n);
CYLINT_API void cylint_pack_shapes(cylint_pack *pack, void *memory,
                                   const cylint_shape *shapes, size_t n);

/* Many lines, one array per coordinate, n long, at any address.  tmin and
 * tmax may be NULL: then all are 0, and all infinite.  A line that is not
 * finite, has no length, or whose tmin <= tmax does not hold is invalid: it
 * answers "miss". */
typedef struct cylint_lines {
    size_t n;
    const double *o[3], *d[3];
    const double *tmin, *tmax;
} cylint_lines;

/*
 * Where the answers go: one array per member, as long as there are answers,
 * apart from all inputs; NULL for what is not wanted, which then costs
 * nothing.  Of an answer with fewer than two hits, t and part of the missing
 * ones are NaN and -1.
 */
typedef struct cylint_columns {
    signed char *relation; /* cylint_relation */
    signed char *n;
    double *t0, *t1;
    signed char *part0, *part1; /* cylint_part */
} cylint_columns;

/* The answers are those of cylint_intersect(), bit for bit, whatever the
 * processor, the number of shapes or lines and their addresses. */

/* One line against all shapes; answers in the order of the shapes. */
CYLINT_API void cylint_intersect_shapes(const cylint_pack *pack,
                                        const cylint_line *line,
                                        const cylint_columns *answers);

/* All lines against one shape; answers in the order of the lines. */
CYLINT_API void cylint_intersect_lines(const cylint_shape *shape,
                                       const cylint_lines *lines,
                                       const cylint_columns *answers);

/* Line i against shape i, for as many as there are shapes. */
CYLINT_API void cylint_intersect_pairs(const cylint_pack *pack,
                                       const cylint_lines *lines,
                                       const cylint_columns *answers);

/* The number of the shape that the line meets first, its hit in *hit as far
 * as wanted; the pack's n if it meets none.  Of equal t the lower number. */
CYLINT_API size_t cylint_nearest(const cylint_pack *pack,
                                 const cylint_line *line, unsigned want,
                                 cylint_hit *hit);

/* The number of shapes that the line meets; at most `enough`, where that is
 * not 0: with 1, whether it meets any. */
CYLINT_API size_t cylint_count(const cylint_pack *pack, const cylint_line *line,
                               size_t enough);

/* The kernels in use, and those this processor can run, best first, by
 * number from 0; NULL after the last.  cylint_use_kernels() chooses, for
 * tests and measurements, and says whether there are such; NULL: the best.
 * Not to be called while queries run. */
CYLINT_API const char *cylint_kernels_in_use(void);
CYLINT_API const char *cylint_kernels_name(int number);
CYLINT_API int cylint_use_kernels(const char *name);

#ifdef __cplusplus
}
#endif

#endif
