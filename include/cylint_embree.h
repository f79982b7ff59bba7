/*
 * cylint_embree - cylinders and cones in an Embree scene, exactly
 *
 *     RTCGeometry rods = cylint_embree_geometry(device, shapes, n, NULL, NULL);
 *     rtcAttachGeometry(scene, rods);
 *     rtcCommitScene(scene);
 *
 * A user geometry for Embree 3 or 4 whose primitives are shapes of cylint.h.
 * cylint_embree_version() returns which Embree the library was built for.
 * Attach the geometry to any scene beside triangles and curves, instance it, and
 * trace single rays and packets of 4, 8 and 16.  cylint_embree(3) has the shapes of
 * a linear curve, section Embree's curves as shapes, and floats at which a
 * mirrored ray begins, section Rays that leave a hit.
 *
 * The hits are those of cylint_intersect() for the line made of the floats of
 * the ray that reaches the geometry:
 *
 *     cylint_span(&line, org, dir, tnear, tfar)
 *
 * where each float stands for the double of the same value.  dir need not be a unit
 * vector.  Under an instance Embree passes a transformed ray, and its floats count.
 * A ray without direction or with tnear > tfar hits nothing.  Of other rays Embree
 * requires that tnear is not negative, that neither tnear nor tfar is NaN, that org
 * and dir are finite, none of their components beyond 1.844e18, and that the time
 * is from 0 to 1; else its results are undefined (observed: Debian's build of
 * Embree 3.13 aborts the program).  If a thread flushes subnormal numbers to zero
 * (DAZ), subnormal floats of a ray count as zero.
 *
 *   which      the nearest hit of all shapes of the geometry in [tnear, tfar],
 *              ends included; at equal t (as doubles) that of the lower number.
 *              A ray that starts inside a solid hits where it leaves.  Where
 *              every shape is a primitive (CYLINT_EMBREE_SINGLE and moving
 *              shapes) and one is hit at t = tfar, another one whose root is
 *              greater but rounds to that double counts as hit, too.
 *   tfar       the least float not below the double t of cylint_intersect(),
 *              which is correctly rounded; never a subnormal one, except the
 *              ray's own tfar.  What a filter function writes to it stays if
 *              the function accepts the hit; else tfar is as before.
 *   primID     the shape's number in the array.
 *   u, v       z and phi of the hit, see cylint_hit, rounded to float.  u is in
 *              [0, 1]; on a capsule or a round cone it can also be below 0 or
 *              above 1.  v is in [0, 1): phi just below 1 is rounded to the
 *              largest float below 1.
 *   Ng         the outward unit normal, rounded to float.  u, v and Ng are rounded
 *              in the rounding mode of the thread.
 *   geomID, instID, instPrimID   as Embree defines them.
 *
 * Boxes.  Embree compares hits on several geometries, or on several instances of
 * one, by their floats.  To Embree a geometry is one primitive with one box; the
 * adapter traverses its own hierarchy inside and misses no hit, wherever a ray
 * begins.  Embree's own traversal uses floats, and RTC_SCENE_FLAG_ROBUST has no
 * effect on user geometries.  So a ray that only grazes a box may miss it:
 *   - The box of a geometry is padded by the error for rays that begin within 4095
 *     sizes of it, where a size is its longest side: by 2^-9 of a size, 2^-23 of
 *     the largest coordinate, and 2^-124.  (Observed: none of 5.6 million rays from
 *     farther away missed it.)
 *   - With CYLINT_EMBREE_SINGLE and with moving shapes every shape has its own box,
 *     padded for rays that begin within three sizes, by 2^-19 of a size in place of
 *     2^-9.  A ray from farther away may hit another shape if the t of both are
 *     nearly the same float.
 *   - Around an instance Embree computes a box in floats, whose error grows with
 *     the distance of the instance from the origin of coordinates.  A ray may miss
 *     it if that distance is more than 4095 sizes of the box, or three of a shape's
 *     own box (observed: none of 10^5 rays up to 10^4 sizes, or ten).
 *   - Embree replaces a component of dir below 1e-18 by 1e-18, so dir as a whole
 *     must be far larger.
 *   - A ray that hits where t is below 2^-126, the least normal float, may miss the
 *     box (observed: one of 100 in packets).
 * cylint_scene.h has no such limits.
 *
 * Filters.  The filter of the geometry gets the entry hit and, if it rejects
 * that, the exit hit, always with N = 1 and all members of the hit written.  The
 * filter of Embree 3's intersection context gets the same.  Embree 4 does not
 * pass the filter of its arguments to user geometries: with
 * CYLINT_EMBREE_CONTEXT_FILTER it is read from the query context.  A long shape
 * has several boxes, but its filter gets each hit once; the exit hit may come
 * before the entry hit if they lie in different boxes.
 *
 * Packets.  The answers are those to the rays alone, bit for bit.  Embree
 * makes eight exceptions.  In a packet it skips a box unless a ray enters the
 * box below tfar, and Embree 3 traces packets that are wider than the
 * processor's vectors as streams of rays.
 *   - A ray with tnear = tfar may report a miss.
 *   - In a stream (packets of 16 without AVX-512, and of 8 without AVX: where the
 *     device's property RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED, or RAY8, is
 *     0) Embree 3 ignores the array `valid`: a ray is inactive only if tnear >
 *     tfar.  It also copies whole hits, so that with CYLINT_EMBREE_BARE u, v and
 *     Ng are undefined.
 *   - Where every shape is a primitive of its own (CYLINT_EMBREE_SINGLE and
 *     moving shapes) and several shapes are hit at t = tnear, primID may be
 *     any of them instead of the lowest.  t is right.
 *   - In a query with the flag for coherent rays, where a component of dir is
 *     below 0 and above -1e-18, all rays of the packet may miss what they hit.
 *   - An occlusion query with that flag may write -inf to a tfar below 0.
 *   - In an occlusion query with that flag whose rays go into several octants a
 *     filter may get a hit several times.
 *   - On a processor with AVX-512, rtcOccluded16() and streams of occlusion queries
 *     with that flag may never return from Debian's build of Embree 3.13.5 if the
 *     scene has an instance that does not move.  This happens without this library,
 *     too.  Leave the flag out, or make the device with "isa=avx2".
 *   - Under a moving instance Embree rounds the transformed rays of a packet
 *     otherwise than rays alone.  The answers are right for those rays.
 * Trace such rays one by one.  Rays that begin near each other and go into the
 * same octant cost less in packets, least in packets of 16; other rays cost a
 * little more than alone.
 *
 * Threads.  Queries only read the geometry; any number may run at once.  Making,
 * updating and releasing a geometry are like committing: no thread may trace it
 * meanwhile.
 *
 * Memory.  The arrays of shapes are the caller's.  Only the functions that make and
 * update a geometry read them, so that a program which calls no update may free
 * them.  A geometry keeps the arguments of the constructors: 33 bytes a shape if
 * all numbers of all shapes are floats, else 65.  An elliptic shape takes 400 more,
 * and so do most round cones of which one ball holds the other, and a shape with a
 * number other than 0 below 2^-149; beside such shapes all take 65.  Moving shapes
 * take twice as much.  If shapes are not primitives of their own, each takes 8 for
 * its order and a share of the hierarchy, as in a scene (cylint_scene(3), MEMORY).
 * All memory is allocated from the device as buffers: its memory monitor counts it
 * and may refuse it.
 */
#ifndef CYLINT_EMBREE_H
#define CYLINT_EMBREE_H

#include "cylint.h"
#include "cylint_scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* As in Embree's headers, which may be included before or after this one. */
struct RTCDeviceTy;   /* RTCDevice is a pointer to it ... */
struct RTCGeometryTy; /* ... and RTCGeometry to that */
struct RTCRayHit;

typedef enum cylint_embree_status {
    CYLINT_EMBREE_OK = 0,
    CYLINT_EMBREE_ESHAPE,   /* a shape that Embree's boxes cannot contain: it
                              was refused by its constructor, is unbounded
                              (infinite, nappe), or has a box with a coordinate
                              at or beyond 1.844e18, where Embree silently drops
                              primitives; or its number in the array is
                              2^32 - 1 or more */
    CYLINT_EMBREE_EMOTION,  /* the two states of a moving shape differ in
                              ends or in kind: cylinders and cones are one
                              kind, elliptic cylinders and cones, capsules and
                              round cones (also if one ball holds the other),
                              angle cones, spheres */
    CYLINT_EMBREE_EMEMORY,  /* an allocation was refused */
    CYLINT_EMBREE_EDEVICE,  /* the device made no geometry */
    CYLINT_EMBREE_EVERSION, /* the device belongs to another major version of
                               Embree than this library was built for */
    CYLINT_EMBREE_EPART     /* the geomID of a part is not greater than that of
                               the part before it, or is that of no geometry */
} cylint_embree_status;

/* A status and, for ESHAPE and EMOTION, the lowest number of such a shape; for
 * EPART, the part's. */
typedef struct cylint_embree_problem {
    int status;
    size_t shape;
} cylint_embree_problem;

/* A short English text for a status, static, lower case, no full stop. */
CYLINT_API const char *cylint_embree_strerror(int status);

/* Returns 3 or 4, the major version of Embree that the library was built for. */
CYLINT_API int cylint_embree_version(void);

/* Flags of a geometry.  They do not change which shape is hit, nor t, except
 * CYLINT_EMBREE_SINGLE at t = tfar, as stated above. */
enum {
    /* Each shape is a primitive of its own, for comparison, instead of the
     * adapter's hierarchy. */
    CYLINT_EMBREE_SINGLE = 1 << 0,
    /* u, v and Ng of a hit are not written: they keep the values from before the
     * query, or those of a farther hit on another geometry.  A filter of an
     * occlusion query gets zeros.  cylint_embree_complete() writes them into a
     * final hit. */
    CYLINT_EMBREE_BARE = 1 << 1,
    /* Embree 4: a pointer to a filter function (RTCFilterFunctionN, may be NULL)
     * follows the RTCRayQueryContext of every query that reaches the geometry,
     * like the next member of a struct.  The adapter calls it after the
     * geometry's own filter.  Embree 3: no effect, its context has a filter. */
    CYLINT_EMBREE_CONTEXT_FILTER = 1 << 2,
    /* No filter is called: neither the geometry nor a query has one.  An
     * occlusion query then computes only whether something is hit, for most
     * capped cylinders in floats with a proved bound. */
    CYLINT_EMBREE_NO_FILTERS = 1 << 3
};

/* All members 0: the default. */
typedef struct cylint_embree_options {
    unsigned flags;            /* CYLINT_EMBREE_... */
    const cylint_shape *moved; /* NULL, or n shapes: those at time 1 */
    void *user;                /* geometryUserPtr of the filters; the adapter
                                  uses the geometry's own user data */
    int threads;               /* the most threads that make and update the
                                  geometry, the caller's included; 0: one.
                                  They allocate from the device but are not
                                  its threads */
} cylint_embree_options;

/*
 * cylint_embree_geometry - makes a committed geometry of n shapes
 *
 * The shapes are bounded, of any kind, with any caps.  n may be 0.  options may
 * be NULL.  The geometry has all bits of its mask set (rtcSetGeometryMask(g,
 * -1)).
 *
 * With options->moved the shapes move: at a ray's time, 0 to 1, shape i is
 * cylint_embree_between(shapes + i, moved + i, time).  The geometry has two time
 * steps; do not change its time range.  Each moving shape is a primitive of its
 * own.
 *
 * Returns NULL on failure and writes *problem, unless problem is NULL.  Embree
 * also calls the device's error function (or sets its error code), for ESHAPE,
 * EMOTION and EPART with RTC_ERROR_INVALID_ARGUMENT, for EMEMORY with
 * RTC_ERROR_OUT_OF_MEMORY.  Nothing stays allocated then.
 */
CYLINT_API struct RTCGeometryTy *cylint_embree_geometry(
    struct RTCDeviceTy *device, const cylint_shape *shapes, size_t n,
    const cylint_embree_options *options, cylint_embree_problem *problem);

/* Shapes of which hits have this geomID and, as primID, the number in the array. */
typedef struct cylint_embree_part {
    const cylint_shape *shapes;
    size_t n;
    unsigned geomID;
} cylint_embree_part;

/*
 * cylint_embree_merge - makes one committed geometry of n parts
 *
 * For programs with thousands of small geometries.  To Embree each of these is a
 * box and a call of the adapter; merged they are one box, and an incoherent ray
 * takes about half the time, or less if their boxes overlap (observed: a quarter).
 * Hits and filters get the geomID of the part and the number of the shape in the
 * part, whatever number Embree gives to the merged geometry.  Embree has no
 * geometry of the part's geomID: rtcGetGeometry() must not be called with it
 * (observed: Debian's build of Embree 3.13 aborts the program).  The geomIDs ascend
 * from part to part, and no other geometry of the scene has one of them.  At equal
 * t the shape of the earlier part is hit.
 *
 * The parts share a mask and a filter function.  options->moved and
 * CYLINT_EMBREE_SINGLE have no effect.  problem->shape counts the shapes of all
 * parts.  All else is as for cylint_embree_geometry(); the array of parts is not
 * read again, those of shapes are by cylint_embree_update().  A part takes 32
 * bytes, and each shape 4 more.
 */
CYLINT_API struct RTCGeometryTy *cylint_embree_merge(
    struct RTCDeviceTy *device, const cylint_embree_part *parts, size_t n,
    const cylint_embree_options *options, cylint_embree_problem *problem);

/*
 * Reads the arrays of shapes again, which the caller may have changed in any
 * member, and commits the geometry; the caller then commits its scenes.  Returns
 * the status, and reports a failure as cylint_embree_geometry() does.  If it is not
 * CYLINT_EMBREE_OK, do not trace the geometry until an update succeeds.
 */
CYLINT_API int cylint_embree_update(struct RTCGeometryTy *geometry,
                                    cylint_embree_problem *problem);

/*
 * Releases the adapter's memory and the reference to the geometry; call it
 * instead of rtcReleaseGeometry(), after the last trace or commit of a scene that
 * contains it.  Such scenes may be released before or after.  geometry may be
 * NULL.
 */
CYLINT_API void cylint_embree_release(struct RTCGeometryTy *geometry);

/* Writes u, v and Ng of a hit found with CYLINT_EMBREE_BARE, computed from
 * primID and the ray as it reached the geometry: under an instance, the
 * transformed ray. */
CYLINT_API void cylint_embree_complete(struct RTCGeometryTy *geometry,
                                       struct RTCRayHit *rayhit);

/* The bytes that the adapter holds for a geometry, without the caller's shapes
 * and Embree's own hierarchy. */
CYLINT_API size_t cylint_embree_bytes(struct RTCGeometryTy *geometry);

/*
 * Writes a moving shape at a time from 0 to 1: its constructor's result for
 * (1 - time) x + time y, in doubles, where x and y are the numbers given to the
 * constructors of the two states (for an acone: the tangent), which must not
 * differ in ends or in kind, see EMOTION.  If the
 * constructor refuses these (an axis may vanish on the way), *shape is a refused
 * shape, which every line misses.  Returns the constructor's status.
 */
CYLINT_API cylint_status cylint_embree_between(const cylint_shape *at_0,
                                               const cylint_shape *at_1,
                                               double time,
                                               cylint_shape *shape);

#ifdef __cplusplus
}
#endif

#endif
