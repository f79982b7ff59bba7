/*
 * distance_points.h - points at which distances are difficult
 *
 * A point is drawn for a case of the families: next to its shape's surface,
 * axis, rims, apex and bisectors, exactly on them where the numbers allow, or
 * far away; or of any exponents of doubles.  The point depends only on the case and
 * on the stream.
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
    REACH_FAR,   /* in a box of any size about the origin */
    REACH_ALONG, /* some coordinates are far away */
    REACH_MIXED, /* each coordinate has an exponent of its own, or is 0 */
    REACHES
};

static inline int draw_exponent(void)
{
    return one_of(1024 + 1074) - 1074;
}

/* The same of a point of any exponents; of shapes that may have any, too, only a
 * quarter of the points. */
static inline enum place draw_far_point(const struct family_case *c, int wild,
                                        double p[3])
{
    const enum place place = draw_point(c, p);
    const enum reach reach = (enum reach)one_of(REACHES);
    const int e = draw_exponent(), is_near = wild && one_of(4);
    for (int i = 0; i < 3 && !is_near; i++) {
        const int chosen = one_of(4), own = draw_exponent();
        const double x = between(-1, 1);
        if (reach == REACH_FAR || (reach == REACH_ALONG && chosen < 2))
            p[i] = ldexp(x, e + 1);
        else if (reach == REACH_MIXED)
            p[i] = chosen ? ldexp(x, own + 1) : 0;
    }
    return place;
}

#endif
