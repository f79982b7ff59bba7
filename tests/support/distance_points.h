/*
 * distance_points.h - points at which distances are difficult
 *
 * A point is drawn for a case of the families: next to its shape's surface,
 * axis, rims, apex and bisectors, exactly on them where the numbers allow, or
 * far away.  Then shape and point can be moved to any exponents of doubles.
 * The point depends only on the case and on the stream.
 */
#ifndef CYLINT_DISTANCE_POINTS_H
#define CYLINT_DISTANCE_POINTS_H

#include <math.h>

#include "draw.h"
#include "families.h"
#include "shapes/shape_facts.h"
#include "ulps.h"

enum place {
    PLACE_ORIGIN,   /* of the case's line */
    PLACE_HIT,      /* the rounded point of a hit */
    PLACE_AXIS,     /* on the axis, nearly or exactly */
    PLACE_RIM,      /* about a rim or an end of the axis */
    PLACE_BISECTOR, /* as far from a cap as from the lateral surface */
    PLACE_FAR,      /* up to 1e8 sizes away */
    PLACE_ANY,      /* in a box about the shape */
    PLACE_LATERAL,  /* on the lateral surface, nearly */
    PLACE_WHOLE,    /* small whole or half numbers from the base */
    PLACE_APEX,     /* about the apex, or the plane through it */
    PLACES
};

static const char *const place_names[PLACES] = {
    "line's origin", "hit", "axis",    "rim",   "bisector",
    "far",           "box", "lateral", "whole", "apex"};

/* The case and the point, within a test of check.h, for its first failures only. */
#define REPORT_POINT(c, p) \
    (REPORT_CASE(c), REPORT("point %a %a %a", (p)[0], (p)[1], (p)[2]))

/* Points base + x a + y b + z h; the lateral surface has x^2 + y^2 =
 * rho(z)^2. */
struct point_frame {
    const cylint_shape *shape;
    double a[3], b[3], h[3], length, unit;
};

static void make_point_frame(struct point_frame *f, const cylint_shape *s)
{
    double across = 0, size = 0, unit[3];
    f->shape = s;
    copy3(f->a, cylint_a(s));
    copy3(f->b, cylint_b(s));
    copy3(f->h, cylint_axis(s));
    for (int i = 0; i < 3; i++)
        size = fmax(size, fabs(f->h[i]));
    for (int i = 0; i < 3; i++)
        unit[i] =
            size > 0 && isfinite(size) ? cylint_axis(s)[i] / size : i == 2;
    const double norm = sqrt(dot3(unit, unit));
    f->length = norm * size;
    f->unit = cylint_radius_unit(s, f->length);
    if (cylint_is_elliptic(s->kind))
        return;
    while (!(across > 0.1)) {
        double any[3];
        random_vector(any, 1);
        cross3(f->a, unit, any);
        across = sqrt(dot3(f->a, f->a));
    }
    for (int i = 0; i < 3; i++)
        f->a[i] /= across;
    cross3(f->b, unit, f->a);
    for (int i = 0; i < 3; i++)
        f->b[i] /= norm;
}

/* Of a half-space: any length of its size. */
static double rho_at(const struct point_frame *f, double z)
{
    const cylint_shape *s = f->shape;
    if (cylint_is_plane(s->kind))
        return f->length;
    return fabs(cylint_r0(s) + (cylint_r1(s) - cylint_r0(s)) * z) * f->unit;
}

static void put(const struct point_frame *f, double rho, double z, double p[3])
{
    const double turn = between(0, 6.283185307179586);
    for (int i = 0; i < 3; i++)
        p[i] = cylint_base(f->shape)[i] + z * f->h[i] +
               rho * (cos(turn) * f->a[i] + sin(turn) * f->b[i]);
}

/* As far below the cap at `end` as inside the lateral surface, nearly; often
 * near the point of the axis that is. */
static void put_on_bisector(const struct point_frame *f, double p[3])
{
    const cylint_shape *s = f->shape;
    const int end = one_of(2);
    const double grows =
        (end ? cylint_r0(s) - cylint_r1(s) : cylint_r1(s) - cylint_r0(s)) *
        f->unit;
    const double tan = grows / f->length;
    const double slant = f->length * sqrt(1 + tan * tan);
    const double on_axis = rho_at(f, end) / (slant - grows);
    double z = between(0, 1);
    z *= between(0, 1);
    if (one_of(2) && on_axis < 1)
        z = on_axis * (1 - fabs(small(-17, -1)));
    const double at = end ? 1 - z : z;
    put(f, fabs(rho_at(f, at) - z * slant) * (1 + small(-17, -1) * 0.01), at,
        p);
}

static double any_z_of(void)
{
    static const double special[] = {0, 1, 0.5, 0.25};
    return one_of(3) ? between(-0.3, 1.3) : special[one_of(4)];
}

static void put_whole(const struct family_case *c, double p[3])
{
    const int at_end = one_of(8) == 0;
    for (int i = 0; i < 3; i++)
        p[i] =
            cylint_base(&c->shape)[i] + (at_end ? 0 : 0.5 * (one_of(25) - 12));
    if (one_of(3) == 0)
        for (int i = 0; i < 3; i++)
            p[i] = floor(p[i]);
}

static void put_hit(const struct family_case *c, double p[3])
{
    cylint_answer a;
    const cylint_line line = whole_of(c->line);
    const int n = cylint_intersect(&c->shape, &line,
                                   CYLINT_WANT_T | CYLINT_WANT_POINT, &a);
    for (int i = 0; i < 3; i++)
        p[i] = n > 0 ? stepped(a.hit[n - 1].point[i], whole_between(-2, 2))
                     : c->line.o[i] + c->line.d[i];
}

static void put_near_apex(const struct point_frame *f, double p[3])
{
    const cylint_shape *s = f->shape;
    const double apex = cylint_r0(s) == cylint_r1(s)
                            ? 0.5
                            : cylint_r0(s) / (cylint_r0(s) - cylint_r1(s));
    const double big = fmax(rho_at(f, 0), rho_at(f, 1));
    const int plane = one_of(3) == 0;
    const double z = apex + (one_of(2) ? small(-17, -1) : 0);
    put(f, big * (plane ? between(0, 2) : small(-17, -1)), z, p);
}

/* Writes a point for the case; returns its place. */
static enum place draw_point(const struct family_case *c, double p[3])
{
    const enum place place = (enum place)one_of(PLACES);
    struct point_frame f;
    make_point_frame(&f, &c->shape);
    const double big = fmax(rho_at(&f, 0), rho_at(&f, 1));
    const double z = any_z_of();
    switch (place) {
    case PLACE_ORIGIN:
        copy3(p, c->line.o);
        break;
    case PLACE_HIT:
        put_hit(c, p);
        break;
    case PLACE_AXIS:
        put(&f, one_of(2) ? 0 : big * small(-17, -1), z, p);
        break;
    case PLACE_RIM: {
        const int end = one_of(2);
        const double at = end + small(-17, -1);
        put(&f, rho_at(&f, end) + big * small(-17, -1), at, p);
        break;
    }
    case PLACE_BISECTOR:
        put_on_bisector(&f, p);
        break;
    case PLACE_FAR: {
        const double far = power(0, 8), at = far * between(-1, 1);
        put(&f, big * far * between(0, 1), at, p);
        break;
    }
    case PLACE_LATERAL:
        put(&f, rho_at(&f, z), z, p);
        break;
    case PLACE_WHOLE:
        put_whole(c, p);
        break;
    case PLACE_APEX:
        put_near_apex(&f, p);
        break;
    default: {
        const double at = between(-2, 3);
        put(&f, big * between(0, 3), at, p);
        break;
    }
    }
    return place;
}

/* ------------------------------------------------------ any exponents --- */

enum reach {
    REACH_SCALED,    /* shape and point times a power of two */
    REACH_FAR,       /* the point in a box of any size about the origin */
    REACH_ALONG,     /* some coordinates of the point far away */
    REACH_MIXED,     /* each coordinate has an exponent of its own, or is 0 */
    REACH_SUBNORMAL, /* some lengths of the shape are subnormal */
    REACH_WILD,      /* each length of the shape has an exponent of its own */
    REACHES
};

static inline int draw_exponent(void)
{
    return one_of(1024 + 1074) - 1074;
}

/* Any double but 0. */
static inline double draw_any(void)
{
    const int e = draw_exponent();
    const double x = ldexp(random_mantissa(&stream), e);
    return one_of(2) ? x : -x;
}

static inline void scale_case(struct family_case *c, double p[3], int e)
{
    for (int i = 0; i < family_lengths(c->shape_word); i++)
        c->shape_data[i] = ldexp(c->shape_data[i], e);
    for (int i = 0; i < 3; i++)
        p[i] = ldexp(p[i], e);
}

/* Replaces lengths other than 0 and keeps their signs. */
static inline void draw_lengths(struct family_case *c, int subnormal)
{
    for (int i = 0; i < family_lengths(c->shape_word); i++) {
        const double x =
            subnormal ? 0x1p-1074 * (1 + one_of(4000)) : draw_any();
        if (c->shape_data[i] != 0 && one_of(2))
            c->shape_data[i] = copysign(x, c->shape_data[i]);
    }
}

static inline void draw_coordinates(enum reach reach, double p[3])
{
    const int e = draw_exponent();
    for (int i = 0; i < 3; i++) {
        const int chosen = one_of(4);
        if (reach == REACH_FAR)
            p[i] = ldexp(between(-1, 1), e + 1);
        else if (reach == REACH_ALONG && chosen < 2)
            p[i] = ldexp(between(1, 2), e);
        else if (reach == REACH_MIXED || reach == REACH_WILD)
            p[i] = chosen ? draw_any() : 0;
    }
}

/* Moves shape and point to any exponents.  Returns 0 where the numbers are no
 * shape, or no point. */
static inline int draw_reach(struct family_case *c, double p[3])
{
    const enum reach reach = (enum reach)one_of(REACHES);
    if (reach == REACH_SUBNORMAL || reach == REACH_WILD)
        draw_lengths(c, reach == REACH_SUBNORMAL);
    else if (reach == REACH_SCALED || one_of(2))
        scale_case(c, p, draw_exponent());
    draw_coordinates(reach, p);
    family_make(c);
    return c->shape.kind != CYLINT_KIND_NONE && is_finite3(p);
}

/* A case of any family and of any ends, with a point, of any exponents. */
static inline int draw_far_case(struct family_case *c, double p[3])
{
    const uint64_t index = below(1000);
    const int family = one_of(family_count());
    family_case(random_bits(&stream), family, index, c);
    if (!cylint_is_round(c->shape.kind))
        c->ends = (cylint_ends)one_of(6);
    draw_point(c, p);
    return draw_reach(c, p);
}

#endif
