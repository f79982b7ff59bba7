/*
 * families_draw.h - random shapes and lines for families.c
 */
#ifndef CYLINT_FAMILIES_DRAW_H
#define CYLINT_FAMILIES_DRAW_H

#include <math.h>
#include <string.h>

#include "draw.h"
#include "families.h"
#include "ulps.h"

/* ------------------------------------------------ shapes by their frame -- */

/* Points c + x a + y b + z h; the surface is x^2 + y^2 = rho(z)^2 with
 * rho = 1 + (k - 1) z.  For a cone by its angle the apex is at z = 0 and
 * rho = z. */
typedef struct frame {
    double c[3], a[3], b[3], h[3], k;
    int by_angle;
} frame;

static double rho(const frame *f, double z)
{
    return f->by_angle ? z : 1 + (f->k - 1) * z;
}

static void place(const frame *f, double x, double y, double z, double p[3])
{
    for (int i = 0; i < 3; i++)
        p[i] = f->c[i] + x * f->a[i] + y * f->b[i] + z * f->h[i];
}

static void vary(const frame *f, double x, double y, double z, double d[3])
{
    for (int i = 0; i < 3; i++)
        d[i] = x * f->a[i] + y * f->b[i] + z * f->h[i];
}

static family_shape any_word(void)
{
    return (family_shape)one_of(5);
}

static family_shape cone_word(void)
{
    static const family_shape cones[] = {FAMILY_CONE, FAMILY_ACONE,
                                         FAMILY_ECONE};
    return cones[one_of(3)];
}

/* A random frame for shapes of this word: radius r, height h, any direction.
 * Elliptic ones have unequal semi-axes and are often oblique. */
static void make_frame(frame *f, family_shape word, double r, double h)
{
    double other[3];
    random_vector(f->c, 1);
    random_direction(f->h);
    random_direction(other);
    cross3(f->a, f->h, other);
    scale3(f->a, 1 / length3(f->a));
    cross3(f->b, f->h, f->a);
    f->by_angle = word == FAMILY_ACONE;
    f->k = word == FAMILY_CONE || word == FAMILY_ECONE
               ? chance(0.3) ? 0 : between(0, 2)
               : 1;
    if (word >= FAMILY_ECYLINDER && chance(0.7)) {
        for (int i = 0; i < 3; i++) {
            f->b[i] += 0.7 * f->a[i];
            f->h[i] += 0.5 * f->a[i] - 0.3 * f->b[i];
        }
    }
    scale3(f->a, r);
    scale3(f->b, word >= FAMILY_ECYLINDER ? r * power(-0.5, 0.5) : r);
    scale3(f->h, h);
}

/* The second point of a record, or its axis. */
static void end_of(family_shape word, const double at[3], const double h[3],
                   double to[3])
{
    copy3(to, h);
    if (family_has_points(word))
        add3(to, 1, at);
}

static void write_shape(struct family_case *out, family_shape word,
                        const frame *f)
{
    const double degree = 57.29577951308232; /* 180 / pi */
    const double r = length3(f->a);
    double *x = out->shape_data, to[3], p[4];
    end_of(word, f->c, f->h, to);
    family_set_shape(out, word, f->c, f->a, f->b, to, r,
                     word == FAMILY_ACONE   ? atan(r / length3(f->h)) * degree
                     : word == FAMILY_ECONE ? f->k
                                            : r * f->k);
    if (word == FAMILY_CONE && chance(0.5)) { /* exchanges the ends */
        memcpy(p, x, sizeof p);
        memcpy(x, x + 4, sizeof p);
        memcpy(x + 4, p, sizeof p);
        if (x[3] == 0 && x[7] == 0)
            x[3] = r;
    }
}

static cylint_ends any_ends(void)
{
    return chance(0.4) ? CYLINT_ENDS_CAPPED : (cylint_ends)one_of(6);
}

/* The line through p with direction d, as any kind of line. */
static void write_line(struct family_case *out, const double p[3],
                       const double d[3])
{
    double *x = out->line_data;
    out->line_word = (family_line)one_of(4);
    copy3(x, p);
    copy3(x + 3, d);
    if (out->line_word == FAMILY_SEGMENT) {
        for (int i = 0; i < 3; i++)
            x[i + 3] += p[i];
    } else if (out->line_word == FAMILY_SPAN) {
        x[6] = between(-2, 1);
        x[7] = chance(0.2) ? HUGE_VAL : x[6] + between(0, 4);
    }
}

/* The same with the origin moved by -back d. */
static void write_line_from(struct family_case *out, const double p[3],
                            const double d[3], double back)
{
    double o[3];
    along3(o, p, -back, d);
    write_line(out, o, d);
}

static void simple_frame(frame *f, family_shape word)
{
    const double h = between(0.2, 3);
    make_frame(f, word, between(0.2, 2), h);
}

static void simple_shape(struct family_case *out, frame *f, family_shape word)
{
    simple_frame(f, word);
    write_shape(out, word, f);
}

static double any_z(const frame *f)
{
    return f->by_angle ? between(0.05, 1) : between(0, 1);
}

/* A point of the lateral surface with its distance from the axis times
 * `factor`. */
static void surface_point(const frame *f, double z, double factor, double p[3])
{
    const double turn = between(0, 6.283185307179586);
    const double r = rho(f, z) * factor;
    place(f, r * cos(turn), r * sin(turn), z, p);
}

/* A point of the lateral surface and the unit normal there. */
static void lateral_point(const frame *f, double p[3], double n[3])
{
    const double turn = between(0, 6.283185307179586), z = any_z(f);
    const double x = cos(turn), y = sin(turn), r = rho(f, z);
    const double slope = rho(f, 1) - rho(f, 0);
    double around[3], ruling[3];
    place(f, r * x, r * y, z, p);
    vary(f, -y, x, 0, around);
    vary(f, slope * x, slope * y, 1, ruling);
    cross3(n, around, ruling);
    scale3(n, 1 / length3(n));
}

/* A unit vector perpendicular to w. */
static void across(const double w[3], double e[3])
{
    double other[3];
    do {
        random_direction(other);
        cross3(e, w, other);
    } while (length3(e) == 0);
    scale3(e, 1 / length3(e));
}

/* ----------------------------------------------- shapes in whole numbers -- */

static void whole_vector(double v[3], int most)
{
    do {
        whole_point(v, most);
    } while (v[0] == 0 && v[1] == 0 && v[2] == 0);
}

/* A shape of whole numbers, usually with its axis along a coordinate.  most: of a
 * component of a vector. */
static void whole_shape(struct family_case *out, int most)
{
    const family_shape word = any_word();
    double at[3], a[3], b[3], h[3], to[3], r0 = 0, last = 0;
    whole_point(at, most);
    whole_vector(h, most);
    if (chance(0.6)) {
        set3(h, 0, 0, 0);
        set_any(h, whole_between(1, most + 1));
    }
    end_of(word, at, h, to);
    if (word == FAMILY_CONE)
        r0 = whole_between(0, most + 2);
    if (word <= FAMILY_CONE)
        last = whole_between(r0 == 0, most + 2);
    if (word == FAMILY_ACONE)
        last = chance(0.8) ? 45 : whole_between(1, 89);
    if (word == FAMILY_ECONE)
        last = chance(0.5) ? 0 : 0.5 * whole_between(0, 4);
    if (word >= FAMILY_ECYLINDER) {
        whole_vector(a, most);
        whole_vector(b, most);
        if (chance(0.5)) { /* axes along coordinates */
            const int i = one_of(3);
            set3(a, 0, 0, 0);
            set3(b, 0, 0, 0);
            set3(to, 0, 0, 0);
            a[i] = whole_between(1, most + 1);
            b[(i + 1) % 3] = whole_between(1, most + 1);
            to[(i + 2) % 3] = whole_between(1, most + 1);
        }
    }
    family_set_shape(out, word, at, a, b, to, r0, last);
    out->ends = any_ends();
}

/* The axis of a case's shape, from its record. */
static void axis_of(const struct family_case *c, double h[3])
{
    copy3(h, c->shape_data + family_axis(c->shape_word));
    if (family_has_points(c->shape_word))
        add3(h, -1, c->shape_data);
}

#endif
