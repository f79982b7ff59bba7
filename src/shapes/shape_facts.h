/*
 * shape_facts.h - all facts about the kinds of shapes
 *
 * Other files call these functions, and compare kinds only where one kind differs
 * from all others.  The polynomials of each kind are in signs/forms_template.h.
 *
 *              elliptic  tapered  end points  factors   the radius at z
 *   cylinder      -         -         yes        -      r0
 *   cone          -        yes        yes        -      r0 + dr z
 *   acone         -        yes         -        yes     (r0 + dr z) |axis|
 *   ecylinder    yes        -          -        yes     times the semi-axes
 *   econe        yes       yes         -        yes     times the semi-axes
 *   sphere        -         -         yes        -      round: one ball
 *   capsule       -         -         yes        -      round: two balls
 *   rcone         -        yes        yes        -      round: two balls
 *   halfspace     -         -          -         -      none: a plane
 *
 * A half-space has the point p as base and the normal n as axis: its plane is that
 * of the cap at z = 0, and its ends are infinite.  It has no local coordinates.
 *
 * A shape is bounded by the planes z = 0 and z = 1 or, where it is tapered, by
 * the plane through its apex (a nappe), or it is unbounded.  A round shape is
 * the convex hull of the balls about its ends.
 *
 * The kind sphere is also the form of one ball of a capsule or rcone.  The
 * base is then the centre of that ball, r0 its radius, and `surface` its part;
 * for the ball at z = 1 the ends are exchanged (cylint_ball_of()).
 */
#ifndef CYLINT_SHAPE_FACTS_H
#define CYLINT_SHAPE_FACTS_H

#include <math.h>

#include "../numbers/bits.h"
#include "layout.h"

enum { CYLINT_KINDS = CYLINT_KIND_HALFSPACE + 1 };

/* ------------------------------------------------------- of a kind ----- */

/* A section is an ellipse with the semi-axes a and b; else a circle. */
CYLINT_INLINE int cylint_is_elliptic(int kind)
{
    return kind == CYLINT_KIND_ECYLINDER || kind == CYLINT_KIND_ECONE;
}

/* The solid is a ball, or the convex hull of two. */
CYLINT_INLINE int cylint_is_round(int kind)
{
    return kind >= CYLINT_KIND_SPHERE && kind <= CYLINT_KIND_RCONE;
}

/* One plane bounds the solid. */
CYLINT_INLINE int cylint_is_plane(int kind)
{
    return kind == CYLINT_KIND_HALFSPACE;
}

/* The section changes with z. */
CYLINT_INLINE int cylint_is_tapered(int kind)
{
    return kind != CYLINT_KIND_CYLINDER && kind != CYLINT_KIND_ECYLINDER &&
           kind != CYLINT_KIND_SPHERE && kind != CYLINT_KIND_CAPSULE &&
           kind != CYLINT_KIND_HALFSPACE;
}

/* The convex hull of two balls, neither of which holds the other. */
CYLINT_INLINE int cylint_is_hull(int kind)
{
    return kind == CYLINT_KIND_CAPSULE || kind == CYLINT_KIND_RCONE;
}

/* Both ends of the axis are data, its direction is their difference; else the
 * base and the direction are data. */
CYLINT_INLINE int cylint_has_end_points(int kind)
{
    return kind <= CYLINT_KIND_CONE || cylint_is_round(kind);
}

/* r0 and r1 are tangents: the radius is their product with |axis|. */
CYLINT_INLINE int cylint_has_tangent(int kind)
{
    return kind == CYLINT_KIND_ACONE;
}

/* r0 and r1 are factors; else they are lengths. */
CYLINT_INLINE int cylint_has_factors(int kind)
{
    return kind >= CYLINT_KIND_ACONE && kind <= CYLINT_KIND_ECONE;
}

/* The rows of the matrix have other lengths than 1 (local.h). */
CYLINT_INLINE int cylint_has_skew_rows(int kind)
{
    return cylint_is_elliptic(kind) || cylint_has_tangent(kind);
}

/* The S of forms_template.h is the square of form_root_of_S(); else the function
 * returns S itself. */
CYLINT_INLINE int cylint_S_is_square(int kind)
{
    return kind != CYLINT_KIND_CYLINDER && kind != CYLINT_KIND_ACONE &&
           !cylint_is_round(kind);
}

/* -------------------------------------------------------- of ends ------ */

/* The planes z = 0 and z = 1 bound the shape. */
CYLINT_INLINE int cylint_ends_are_planes(int ends)
{
    return ends < CYLINT_ENDS_INFINITE;
}

/* The ends of the closed solid: both caps where planes bound it. */
CYLINT_INLINE int cylint_closed_ends(int ends)
{
    return cylint_ends_are_planes(ends) ? CYLINT_ENDS_CAPPED : ends;
}

/* No part of the surface is missing. */
CYLINT_INLINE int cylint_surface_is_whole(int ends)
{
    return cylint_closed_ends(ends) == ends;
}

/* The caps that can be hit: bit 0 and bit 1. */
CYLINT_INLINE unsigned cylint_caps_present(int ends)
{
    return ends == CYLINT_ENDS_CAPPED ? 3
           : ends == CYLINT_ENDS_CAP0 ? 1
           : ends == CYLINT_ENDS_CAP1 ? 2
                                      : 0;
}

CYLINT_INLINE int cylint_part_is_present(int ends, int part)
{
    return part == CYLINT_PART_LATERAL ||
           (cylint_caps_present(ends) >> (part == CYLINT_PART_CAP1) & 1);
}

/* A shape of this kind can have these ends; `ends` may be any number. */
CYLINT_INLINE int cylint_ends_fit(int kind, int ends)
{
    /* untaken 4 of 18: the constructor of a half-space has no ends */
    return ends >= CYLINT_ENDS_CAPPED && ends <= CYLINT_ENDS_NAPPE &&
           (kind == CYLINT_KIND_SPHERE ? ends == CYLINT_ENDS_CAPPED
            : cylint_is_round(kind)    ? cylint_ends_are_planes(ends)
            : cylint_is_plane(kind)    ? ends == CYLINT_ENDS_INFINITE
                                       : 1);
}

/* ------------------------------------------------------- of a shape ---- */

CYLINT_INLINE int cylint_is_bounded(const cylint_shape *s)
{
    return s->kind != CYLINT_KIND_NONE && cylint_ends_are_planes(s->ends);
}

/* One side of a double cone: the plane through the apex bounds it. */
CYLINT_INLINE int cylint_is_nappe(const cylint_shape *s)
{
    return s->ends == CYLINT_ENDS_NAPPE && cylint_is_tapered(s->kind);
}

/* What a shape is in local coordinates (local.h): its section and what bounds
 * it. */
enum {
    CYLINT_SOLID_NONE, /* refused, or a half-space */
    CYLINT_SOLID_CYLINDER,
    CYLINT_SOLID_CONE,
    CYLINT_SOLID_WHOLE_CYLINDER,
    CYLINT_SOLID_DOUBLE_CONE,
    CYLINT_SOLID_NAPPE,
    CYLINT_SOLID_SPHERE,
    CYLINT_SOLID_CAPSULE,
    CYLINT_SOLID_ROUND_CONE,
    CYLINT_SOLIDS
};

/* X(name, number) for each solid but CYLINT_SOLID_NONE: functions and tables that
 * have one member for each. */
#define CYLINT_EACH_SOLID(X)                       \
    X(cylinder, CYLINT_SOLID_CYLINDER)             \
    X(cone, CYLINT_SOLID_CONE)                     \
    X(whole_cylinder, CYLINT_SOLID_WHOLE_CYLINDER) \
    X(double_cone, CYLINT_SOLID_DOUBLE_CONE)       \
    X(nappe, CYLINT_SOLID_NAPPE)                   \
    X(sphere, CYLINT_SOLID_SPHERE)                 \
    X(capsule, CYLINT_SOLID_CAPSULE)               \
    X(round_cone, CYLINT_SOLID_ROUND_CONE)

CYLINT_INLINE int cylint_solid(int kind, int ends)
{
    /* untaken 2 of 4: callers have neither */
    if (kind == CYLINT_KIND_NONE || cylint_is_plane(kind))
        return CYLINT_SOLID_NONE;
    if (cylint_is_round(kind))
        return CYLINT_SOLID_SPHERE + (kind - CYLINT_KIND_SPHERE);
    if (cylint_ends_are_planes(ends))
        return cylint_is_tapered(kind) ? CYLINT_SOLID_CONE
                                       : CYLINT_SOLID_CYLINDER;
    return !cylint_is_tapered(kind)    ? CYLINT_SOLID_WHOLE_CYLINDER
           : ends == CYLINT_ENDS_NAPPE ? CYLINT_SOLID_NAPPE
                                       : CYLINT_SOLID_DOUBLE_CONE;
}

/* Of a solid: the radius of its section changes along the axis; it is bounded; its
 * ends are balls, or it is one; they are two balls; they are discs; two planes
 * bound its lateral surface. */
CYLINT_INLINE int cylint_solid_is_tapered(int solid)
{
    return solid == CYLINT_SOLID_CONE || solid == CYLINT_SOLID_DOUBLE_CONE ||
           solid == CYLINT_SOLID_NAPPE || solid == CYLINT_SOLID_ROUND_CONE;
}

CYLINT_INLINE int cylint_solid_is_bounded(int solid)
{
    return solid <= CYLINT_SOLID_CONE || solid >= CYLINT_SOLID_SPHERE;
}

CYLINT_INLINE int cylint_solid_is_round(int solid)
{
    return solid >= CYLINT_SOLID_SPHERE;
}

CYLINT_INLINE int cylint_solid_is_hull(int solid)
{
    return solid > CYLINT_SOLID_SPHERE;
}

CYLINT_INLINE int cylint_solid_has_discs(int solid)
{
    return solid <= CYLINT_SOLID_CONE;
}

CYLINT_INLINE int cylint_solid_has_planes(int solid)
{
    return cylint_solid_has_discs(solid) || cylint_solid_is_hull(solid);
}

/* A double cone or a nappe.  They differ in so few branches that one kernel serves
 * both; compilers derive from this that it is one of them. */
CYLINT_INLINE int cylint_whole_cone(int solid)
{
    return solid == CYLINT_SOLID_NAPPE ? CYLINT_SOLID_NAPPE
                                       : CYLINT_SOLID_DOUBLE_CONE;
}

/* The base is the end at z = 1. */
CYLINT_INLINE int cylint_is_reversed(const cylint_shape *s)
{
    return cylint_surface(s) == CYLINT_PART_CAP1;
}

/* The kind whose constructor makes this shape and the shapes on the way from it to
 * another one of that kind (motion). */
CYLINT_INLINE int cylint_constructor_kind(const cylint_shape *s)
{
    const int is_sphere = s->kind == CYLINT_KIND_SPHERE &&
                          cylint_surface(s) == CYLINT_PART_LATERAL;
    return cylint_is_elliptic(s->kind)              ? CYLINT_KIND_ECONE
           : s->kind == CYLINT_KIND_CYLINDER        ? CYLINT_KIND_CONE
           : cylint_is_round(s->kind) && !is_sphere ? CYLINT_KIND_RCONE
                                                    : s->kind;
}

/* Coordinate i of the axis: exact, unless p1 - p0 overflows. */
static inline pair cylint_axis_pair(const cylint_shape *s, int i)
{
    return cylint_has_end_points(s->kind)
               ? cylint_difference(cylint_top(s)[i], cylint_base(s)[i])
               : (pair){cylint_axis(s)[i], 0};
}

/* Number i, from CYLINT_AT_COLUMNS to CYLINT_AT_SINE, with its low part. */
CYLINT_INLINE pair cylint_number_pair(const cylint_shape *s, int i)
{
    return (pair){s->library.number[i], s->library.number[i + CYLINT_LOW]};
}

/* All points of the plane of an end have the same coordinate i. */
CYLINT_INLINE int cylint_end_is_level(const cylint_shape *s, int i)
{
    return cylint_is_elliptic(s->kind) ? cylint_sign(cylint_a(s)[i]) == 0 &&
                                             cylint_sign(cylint_b(s)[i]) == 0
                                       : cylint_runs_along(cylint_axis(s), i);
}

/* r1 - r0 exactly; acone: the tangent. */
static inline pair cylint_radius_growth(const cylint_shape *s)
{
    return cylint_difference(cylint_r1(s), cylint_r0(s));
}

/* The largest coordinate of the axis in absolute value. */
static inline double cylint_axis_size(const cylint_shape *s)
{
    return cylint_largest(cylint_axis(s));
}

/* r0 or r1. */
CYLINT_INLINE double cylint_end_factor(const cylint_shape *s, int end)
{
    return end ? cylint_r1(s) : cylint_r0(s);
}

/* The unit of r0 and r1 of a circular kind: the length of the axis for an acone,
 * whose r1 is a tangent, else 1. */
CYLINT_INLINE double cylint_radius_unit(const cylint_shape *s, double length)
{
    return cylint_has_tangent(s->kind) ? length : 1;
}

/* An upper bound of how far the section at an end reaches from the axis along
 * coordinate j, but for roundings. */
CYLINT_INLINE double cylint_rough_reach(const cylint_shape *s, int end, int j)
{
    const double r = cylint_end_factor(s, end);
    if (cylint_is_elliptic(s->kind))
        return r * (fabs(cylint_a(s)[j]) + fabs(cylint_b(s)[j]));
    return r * cylint_radius_unit(s, fabs(cylint_axis(s)[0]) +
                                         fabs(cylint_axis(s)[1]) +
                                         fabs(cylint_axis(s)[2]));
}

#endif
