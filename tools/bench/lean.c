/*
 * lean.c - prepared quadratics in doubles: cylinder, cone, elliptic cylinder,
 * sphere, capsule, rounded cone
 */
#include "lean.h"

#include <math.h>

#include "vectors.h"
#include "../../src/shapes/layout.h"

static inline void from_base(const struct lean_shape *s, const double o[3],
                             double q[3])
{
    for (int i = 0; i < 3; i++)
        q[i] = o[i] - s->base[i];
}

/* The overlap of [a, b] with the slab, and its ends within [t0, t1]. */
static inline int clip(const struct lean_shape *s, double z, double speed,
                       double a, double b, double t0, double t1, double t[2])
{
    if (s->height < HUGE_VAL) {
        const double inverse = 1 / speed;
        double first = -z * inverse, last = (s->height - z) * inverse;
        if (first > last) {
            const double kept = first;
            first = last;
            last = kept;
        }
        a = first > a ? first : a;
        b = last < b ? last : b;
        if (a > b)
            return 0;
    }
    t[0] = a;
    t[1] = b;
    return (a >= t0 && a <= t1) + (b >= t0 && b <= t1);
}

/* The line's axial coordinate z + t speed, and A t^2 + 2 B t + C, the squared
 * distance from the axis less r0^2; G = B^2 - A C. */
struct lateral {
    double z, speed, A, B, G;
};

static inline struct lateral cylinder_lateral(const struct lean_shape *s,
                                              const double o[3],
                                              const double d[3])
{
    struct lateral l;
    double q[3];
    from_base(s, o, q);
    l.speed = dot3(d, s->axis);
    l.z = dot3(q, s->axis);
    l.A = dot3(d, d) - l.speed * l.speed;
    l.B = dot3(q, d) - l.z * l.speed;
    const double C = dot3(q, q) - l.z * l.z - s->r0_squared;
    l.G = l.B * l.B - l.A * C;
    return l;
}

int lean_cylinder(const struct lean_shape *s, const double o[3],
                  const double d[3], double t0, double t1, double t[2])
{
    const struct lateral l = cylinder_lateral(s, o, d);
    if (!(l.G >= 0))
        return 0;
    const double root = sqrt(l.G), inverse = 1 / l.A;
    return clip(s, l.z, l.speed, (-l.B - root) * inverse,
                (-l.B + root) * inverse, t0, t1, t);
}

int lean_shader(const struct lean_shape *s, const double o[3],
                const double d[3], double t0, double t1, double t[2])
{
    const struct lateral l = cylinder_lateral(s, o, d);
    if (!(l.G >= 0))
        return 0;
    const double root = sqrt(l.G);
    double first = (-l.B - root) / l.A;
    const double at = l.z + first * l.speed;
    if (!(at > 0 && at < s->height)) {
        first = ((at < 0 ? 0 : s->height) - l.z) / l.speed;
        if (!(fabs(l.B + l.A * first) < root))
            return 0;
    }
    t[0] = t[1] = first;
    return first >= t0 && first <= t1;
}

int lean_cone(const struct lean_shape *s, const double o[3], const double d[3],
              double t0, double t1, double t[2])
{
    double q[3];
    from_base(s, o, q);
    const double speed = dot3(d, s->axis), z = dot3(q, s->axis);
    const double rho = s->r0 + s->slope * z, growth = s->slope * speed;
    const double A = dot3(d, d) - speed * speed - growth * growth;
    const double B = dot3(q, d) - z * speed - rho * growth;
    const double C = dot3(q, q) - z * z - rho * rho, G = B * B - A * C;
    if (!(G >= 0))
        return 0;
    const double root = sqrt(G), inverse = 1 / A;
    double a = (-B - root) * inverse, b = (-B + root) * inverse;
    if (A < 0 && s->height < HUGE_VAL) {
        const double low = b < a ? b : a, high = b < a ? a : b;
        a = growth > 0 ? high : -HUGE_VAL;
        b = growth > 0 ? HUGE_VAL : low;
    }
    return clip(s, z, speed, a, b, t0, t1, t);
}

int lean_elliptic(const struct lean_shape *s, const double o[3],
                  const double d[3], double t0, double t1, double t[2])
{
    double q[3];
    from_base(s, o, q);
    const double x = dot3(q, s->row[0]), y = dot3(q, s->row[1]);
    const double u = dot3(d, s->row[0]), v = dot3(d, s->row[1]);
    const double A = u * u + v * v, B = x * u + y * v;
    const double C = x * x + y * y - 1, G = B * B - A * C;
    if (!(G >= 0))
        return 0;
    const double root = sqrt(G), inverse = 1 / A;
    return clip(s, dot3(q, s->axis), dot3(d, s->axis), (-B - root) * inverse,
                (-B + root) * inverse, t0, t1, t);
}

static void prepare_elliptic(struct lean_shape *to, const cylint_shape *s)
{
    double bh[3], ha[3], ab[3];
    cross3(bh, cylint_b(s), cylint_axis(s));
    cross3(ha, cylint_axis(s), cylint_a(s));
    cross3(ab, cylint_a(s), cylint_b(s));
    const double det = dot3(cylint_a(s), bh);
    for (int i = 0; i < 3; i++) {
        to->row[0][i] = bh[i] / det;
        to->row[1][i] = ha[i] / det;
        to->axis[i] = ab[i] / det;
    }
    to->height = 1;
}

int lean_sphere(const struct lean_shape *s, const double o[3],
                const double d[3], double t0, double t1, double t[2])
{
    double q[3];
    from_base(s, o, q);
    const double A = dot3(d, d), B = dot3(q, d);
    const double G = B * B - A * (dot3(q, q) - s->r0_squared);
    if (!(G >= 0))
        return 0;
    const double root = sqrt(G), inverse = 1 / A;
    t[0] = (-B - root) * inverse;
    t[1] = (-B + root) * inverse;
    return (t[0] >= t0 && t[0] <= t1) + (t[1] >= t0 && t[1] <= t1);
}

/*
 * Capsule and rounded cone [Quilez, iquilezles.org/articles/intersectors], with
 * both ends of the overlap.  If a root of the cone lies beyond its circles, it
 * is replaced by that of the ball there.
 */
int lean_hull(const struct lean_shape *s, const double o[3], const double d[3],
              double t0, double t1, double t[2])
{
    double q[3];
    from_base(s, o, q);
    const double *w = s->axis;
    const double ww = s->height, shrink = -s->slope, shift = shrink * s->r0;
    const double wq = dot3(w, q), wd = dot3(w, d), dq = dot3(d, q);
    const double qq = dot3(q, q), dd = dot3(d, d);
    const double d2 = ww - shrink * shrink;
    const double A = d2 * dd - wd * wd, B = d2 * dq - wq * wd + wd * shift;
    const double C = d2 * qq - wq * wq + 2 * wq * shift - ww * s->r0_squared;
    const double G = B * B - A * C;
    if (!(G >= 0))
        return 0;
    const double root = sqrt(G), inverse = 1 / A;
    for (int k = 0; k < 2; k++) {
        t[k] = (-B + (k ? root : -root)) * inverse;
        const double y = wq - shift + t[k] * wd;
        if (y > 0 && y < d2)
            continue;
        const int first = A > 0 ? y <= 0 : (wd > 0) != k;
        const double r1 = s->r0 - shrink;
        const double b = first ? dq : dq - wd;
        const double c =
            first ? qq - s->r0_squared : qq - 2 * wq + ww - r1 * r1;
        const double g = b * b - dd * c;
        if (!(g >= 0))
            return 0;
        t[k] = (-b + (k ? sqrt(g) : -sqrt(g))) / dd;
    }
    return (t[0] >= t0 && t[0] <= t1) + (t[1] >= t0 && t[1] <= t1);
}

static void prepare_hull(struct lean_shape *to, const cylint_shape *s)
{
    for (int i = 0; i < 3; i++)
        to->axis[i] = cylint_axis(s)[i];
    to->height = dot3(cylint_axis(s), cylint_axis(s));
    to->slope = cylint_r1(s) - cylint_r0(s);
}

static int is_hull(const cylint_shape *s)
{
    return s->kind == CYLINT_KIND_CAPSULE || s->kind == CYLINT_KIND_RCONE;
}

void lean_prepare(struct lean_shape *to, const cylint_shape *s)
{
    const double length = sqrt(dot3(cylint_axis(s), cylint_axis(s)));
    for (int i = 0; i < 3; i++) {
        to->base[i] = cylint_base(s)[i];
        to->axis[i] = cylint_axis(s)[i] / length;
    }
    to->height = length;
    to->r0 = cylint_r0(s);
    to->r0_squared = cylint_r0(s) * cylint_r0(s);
    to->slope = (cylint_r1(s) - cylint_r0(s)) / length;
    if (s->kind == CYLINT_KIND_ECYLINDER)
        prepare_elliptic(to, s);
    if (is_hull(s))
        prepare_hull(to, s);
    if (s->ends == CYLINT_ENDS_INFINITE)
        to->height = HUGE_VAL;
}

lean_intersect *lean_formula(const cylint_shape *shape)
{
    return shape->kind == CYLINT_KIND_CYLINDER    ? lean_cylinder
           : shape->kind == CYLINT_KIND_ECYLINDER ? lean_elliptic
           : shape->kind == CYLINT_KIND_SPHERE    ? lean_sphere
           : is_hull(shape)                       ? lean_hull
                                                  : lean_cone;
}
