/*
 * cylint_embree - cylinders and cones in an Embree scene, exactly
 *
 * A user geometry for Embree 3 or 4 (one of them, chosen when this library
 * is built; CYLINT_EMBREE_VERSION tells which) whose primitives are shapes of
 * cylint.h.  Attach it to any scene beside triangles and curves, instance it,
 * trace single rays and packets of 4, 8 and 16.
 *
 * What is hit is what cylint_intersect() says for the line made of the very
 * floats of the ray that reaches the geometry:
 *
 *     cylint_span(&line, org, dir, tnear, tfar)
 *
 * with every float taken as the double it is.  Directions need not be unit
 * vectors.  Under an instance Embree hands over a transformed ray, whose
 * floats then count.  A ray that cylint_span() refuses (not finite, without
 * direction, tnear > tfar) hits nothing.  Where a thread takes subnormal
 * numbers for zero (DAZ), subnormal floats of a ray count as zero.
 *
 *   which      the nearest hit of all shapes of the geometry in [tnear, tfar],
 *              ends included; of equal t (as doubles) the lower number.  A
 *              ray that starts inside a solid hits where it leaves.
 *   tfar       the least float not below the double t of cylint_intersect(),
 *              which is correctly rounded; no subnormal one but the ray's own
 *              tfar.
 *   primID     the shape's number in the array.
 *   u, v       z in [0, 1] and phi in [0, 1) of the hit, see cylint_hit,
 *              rounded to float (phi just below 1: the largest float below).
 *   Ng         the outward unit normal, rounded to float.
 *   geomID, instID, instPrimID   as Embree wants them.
 *
 * Hits on several geometries, or several instances of one, are compared by
 * their floats, by Embree.  To Embree a geometry is one primitive with one box;
 * what is within the adapter finds itself, and loses nothing, wherever a ray
 * begins.  Embree's walk is in floats, and for user geometries
 * RTC_SCENE_FLAG_ROBUST changes nothing in that: the box is tight, but wider by
 * what that walk errs at most for rays that begin within 4095 sizes of it, a
 * size being its longest side: by 2^-9 of a size and 2^-23 of the largest
 * coordinate.  From farther away a ray that grazes the box as a whole may pass
 * by it (observed: none of 10^5 rays from up to 10^6 sizes away did).  With
 * CYLINT_EMBREE_SINGLE and with moving shapes every shape has a box of its own,
 * wide enough for rays that begin within three sizes, wider by 2^-19 of one.
 * Embree also takes a component of dir below 1e-18 in size for 1e-18; keep
 * dir as a whole far above.  cylint_scene.h has no such limits.
 *
 * Filters.  The filter of the geometry is offered the entry and, if that is
 * rejected, the exit, always with N = 1, with all members of the hit filled
 * in.  So is the filter of Embree 3's intersection context.  Embree 4 does
 * not show the filter of its arguments to user geometries: with
 * CYLINT_EMBREE_CONTEXT_FILTER it is taken from the query context.  A long
 * shape is entered into several boxes, but each of its hits is offered once;
 * the exit may come before the entry where they lie in different boxes.
 *
 * Packets.  The answers are those to the rays alone, bit for bit.  Embree
 * makes two exceptions: in a packet it skips a box unless a ray enters the box
 * below tfar.
 *   - A ray with tnear = tfar may report a miss.
 *   - Where every shape is a primitive of its own (CYLINT_EMBREE_SINGLE and
 *     moving shapes) and several shapes are hit at t = tnear, primID may be
 *     any of them instead of the lowest.  t is right.
 * Trace such rays one by one.  Rays that begin near each other and go into the
 * same octant cost less in packets, of 16 the least; others cost a little more
 * than alone.
 *
 * Threads.  Queries only read; any number may run at once.  Making, updating
 * and releasing are like committing: not while anyone traces the geometry.
 *
 * Memory.  The arrays of shapes are the caller's, are read by every query and
 * must stay where they are until cylint_embree_release().  The rest is
 * allocated from the device as buffers: its memory monitor sees it and may
 * refuse it.
 */
#ifndef CYLINT_EMBREE_H
#define CYLINT_EMBREE_H

#include "cylint.h"
#include "cylint_scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* As Embree's headers have them, which may be included before or after. */
struct RTCDeviceTy;   /* RTCDevice is a pointer to it ... */
struct RTCGeometryTy; /* ... and RTCGeometry to that */
struct RTCRayHit;

typedef enum cylint_embree_status {
    CYLINT_EMBREE_OK = 0,
    CYLINT_EMBREE_ESHAPE,  /* a shape that no box of Embree's can hold:
                              refused by its constructor, unbounded (infinite,
                              nappe), or with a coordinate of its box at or
                              beyond 1.844e18, where Embree drops primitives
                              silently; or a number that 32 bits cannot hold */
    CYLINT_EMBREE_EMOTION, /* the two states of a moving shape differ in
                              ends, or one is circular and the other not */
    CYLINT_EMBREE_EMEMORY, /* an allocation was refused */
    CYLINT_EMBREE_EDEVICE, /* Embree refused something else */
    CYLINT_EMBREE_EVERSION /* the device is not of the Embree for which this
                              library was built */
} cylint_embree_status;

/* What went wrong and, for ESHAPE and EMOTION, with which shape: the lowest
 * such number. */
typedef struct cylint_embree_problem {
    int status;
    size_t shape;
} cylint_embree_problem;

/* A short English text for a status, static, lower case, no full stop. */
CYLINT_API const char *cylint_embree_strerror(int status);

/* 3 or 4: the Embree for which the library was built. */
CYLINT_API int cylint_embree_version(void);

/* How a geometry works.  The hits are the same whatever is chosen. */
enum {
    /* One shape a primitive instead of blocks of 8: for comparison. */
    CYLINT_EMBREE_SINGLE = 1 << 0,
    /* u, v and Ng of hits are 0, for filters as well.
     * cylint_embree_complete() adds them to a final hit. */
    CYLINT_EMBREE_BARE = 1 << 1,
    /* Embree 4: a filter function (RTCFilterFunctionN, may be NULL) lies in
     * memory right behind the RTCRayQueryContext of every query that reaches
     * the geometry, as the next member of a struct would; it is asked after
     * the geometry's own.  Embree 3: no effect, there is one already. */
    CYLINT_EMBREE_CONTEXT_FILTER = 1 << 2,
    /* No filter is called: neither the geometry nor a query has one.  Then
     * nothing is found out about the hits of occluded rays but that they are,
     * and of most capped cylinders in floats, which are certain of it. */
    CYLINT_EMBREE_NO_FILTERS = 1 << 3
};

/* All zero is a good start. */
typedef struct cylint_embree_options {
    unsigned flags;            /* CYLINT_EMBREE_... */
    const cylint_shape *moved; /* NULL, or n shapes: those at time 1 */
    void *user;                /* geometryUserPtr of the filters; the
                                  geometry's own user data is taken */
    int threads;               /* so many, the caller's one of them, may make
                                  and update it, 0: one.  They are not the
                                  device's, but ask it for memory */
} cylint_embree_options;

/*
 * cylint_embree_geometry - n shapes as a geometry, committed, to be attached
 *
 * Bounded shapes of any kind, with any caps.  n may be 0.  options may be
 * NULL.  All ray masks see the geometry (rtcSetGeometryMask(g, -1)).
 *
 * With options->moved the shapes move: at a ray's time, 0 to 1, shape i is
 * cylint_embree_between(shapes + i, moved + i, time).  Two time steps; leave
 * the geometry's time range as it is.  Moving shapes are one a primitive.
 *
 * Returns NULL where something is refused.  problem, unless NULL, says what;
 * so does the device: its error function is called (or its error code set)
 * by Embree, for ESHAPE and EMOTION with RTC_ERROR_INVALID_ARGUMENT, for
 * EMEMORY with RTC_ERROR_OUT_OF_MEMORY.  Nothing is left allocated then.
 */
CYLINT_API struct RTCGeometryTy *cylint_embree_geometry(
    struct RTCDeviceTy *device, const cylint_shape *shapes, size_t n,
    const cylint_embree_options *options, cylint_embree_problem *problem);

/*
 * Takes over what the caller changed in his arrays of shapes, in whatever
 * members, and commits the geometry; the caller then commits its scenes.
 * Returns the status.  If that is not CYLINT_EMBREE_OK, the geometry must
 * not be traced until an update succeeds.
 */
CYLINT_API int cylint_embree_update(struct RTCGeometryTy *geometry,
                                    cylint_embree_problem *problem);

/*
 * In place of rtcReleaseGeometry(): gives back the adapter's memory and the
 * reference.  Call it when nobody will trace or commit the geometry any more;
 * scenes that hold it may be released before or after.  NULL: does nothing.
 */
CYLINT_API void cylint_embree_release(struct RTCGeometryTy *geometry);

/* Sets u, v and Ng of a hit found with CYLINT_EMBREE_BARE from its ray (as
 * the geometry saw it: under an instance, the transformed one) and primID. */
CYLINT_API void cylint_embree_complete(struct RTCGeometryTy *geometry,
                                       struct RTCRayHit *rayhit);

/* The bytes the adapter holds for a geometry, beside the caller's shapes and
 * Embree's own hierarchy. */
CYLINT_API size_t cylint_embree_bytes(struct RTCGeometryTy *geometry);

/*
 * A moving shape at a time between 0 and 1: what its constructor makes of
 * (1 - time) x + time y, in doubles, for each number x, y that was given to
 * the constructors of the two (of an acone: the tangent).  Where nothing can
 * be made of that (an axis that vanishes on the way) the result is a refused
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
