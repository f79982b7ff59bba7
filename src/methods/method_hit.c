/*
 * method_hit.c - point, normal, z and phi of a published method's hit
 *
 * No author defines these.  They are computed from the hit's point in plain
 * doubles, as cylint.h defines them.
 *
 * A point is c + x a + y b + z h; it is inside if x^2 + y^2 <= rho(z)^2.  For a
 * circular shape a is e x axis, b is perpendicular to a and to the axis, and
 * both have length one.
 */
#include "methods.h"

#include "../shapes/measure.h"

typedef struct frame {
    double x_of[3], y_of[3], z_of[3]; /* the gradients of x, y and z */
    double rho, drho;                 /* rho(z) = rho + drho z */
} frame;

void cylint_phi_origin(const double axis[3], double out[3])
{
    static const double none[3] = {0, 0, 0};
    double e[3] = {0, 0, 0};

    e[cylint_least_component(axis, none)] = 1;
    cross(e, axis, out);
}

static void scaled_cross(const double a[3], const double b[3], double by,
                         double out[3])
{
    cross(a, b, out);
    for (int i = 0; i < 3; i++)
        out[i] /= by;
}

static frame frame_of(const cylint_shape *shape)
{
    frame f;
    const double *h = cylint_axis(shape);

    if (cylint_is_elliptic(shape->kind)) {
        double normal[3];
        cross(cylint_a(shape), cylint_b(shape), normal);
        const double det = dot(normal, h);
        scaled_cross(cylint_b(shape), h, det, f.x_of);
        scaled_cross(h, cylint_a(shape), det, f.y_of);
        scaled_cross(cylint_a(shape), cylint_b(shape), det, f.z_of);
        f.rho = 1;
        f.drho = cylint_r1(shape) - 1;
        return f;
    }
    double origin[3];
    const double size = length(h);
    cylint_phi_origin(h, origin);
    unit(origin, f.x_of);
    scaled_cross(h, f.x_of, size, f.y_of);
    for (int i = 0; i < 3; i++)
        f.z_of[i] = h[i] / size / size;
    f.rho = cylint_r0(shape);
    f.drho =
        (cylint_r1(shape) - cylint_r0(shape)) * cylint_radius_unit(shape, size);
    return f;
}

static void normal_at_apex(const cylint_shape *shape, const double d[3],
                           double normal[3])
{
    const double climb = dot(d, cylint_axis(shape));
    const int sign = cylint_apex_normal_sign(shape, (climb > 0) - (climb < 0));

    for (int i = 0; i < 3; i++)
        normal[i] = sign * cylint_axis(shape)[i];
    unit(normal, normal);
}

/* x^2 + y^2 = rho^2: half the gradient is x dx + y dy - rho drho dz. */
static void normal_at(const cylint_shape *shape, const frame *f,
                      const double d[3], double x, double y, double z, int part,
                      double normal[3])
{
    if (part != CYLINT_PART_LATERAL) {
        const double sign = part == CYLINT_PART_CAP0 ? -1 : 1;
        for (int i = 0; i < 3; i++)
            normal[i] = sign * f->z_of[i];
        unit(normal, normal);
        return;
    }
    if (x == 0 && y == 0) {
        normal_at_apex(shape, d, normal);
        return;
    }
    const double slope = (f->rho + f->drho * z) * f->drho;
    for (int i = 0; i < 3; i++)
        normal[i] = x * f->x_of[i] + y * f->y_of[i] - slope * f->z_of[i];
    unit(normal, normal);
}

/* An angle of at most pi in size, in radians, as turns: in [0, 1). */
static double turns_of_angle(double angle)
{
    const double pi = 3.14159265358979323846, turns = angle / (2 * pi);
    const double positive = turns < 0 ? turns + 1 : turns;
    return positive < 1 ? fabs(positive) : 0; /* no -0 */
}

void cylint_method_hit(const cylint_shape *shape, const cylint_line *line,
                       unsigned want, double t, int part, int side,
                       cylint_hit *hit)
{
    const unsigned placed =
        CYLINT_WANT_NORMAL | CYLINT_WANT_Z | CYLINT_WANT_PHI;
    double point[3], D[3];

    if (want & CYLINT_WANT_T)
        hit->t = t;
    if (want & CYLINT_WANT_PART) {
        hit->part = part;
        hit->side = side;
    }
    if (!(want & (placed | CYLINT_WANT_POINT)))
        return;
    along(line->o, t, line->d, point);
    if (want & CYLINT_WANT_POINT)
        for (int i = 0; i < 3; i++)
            hit->point[i] = point[i];
    if (!(want & placed))
        return;

    const frame f = frame_of(shape);
    minus(point, cylint_base(shape), D);
    const double x = dot(D, f.x_of), y = dot(D, f.y_of), z = dot(D, f.z_of);
    if (want & CYLINT_WANT_Z)
        hit->z = z;
    if (want & CYLINT_WANT_PHI)
        hit->phi = x == 0 && y == 0 ? 0 : turns_of_angle(atan2(y, x));
    if (want & CYLINT_WANT_NORMAL)
        normal_at(shape, &f, line->d, x, y, z, part, hit->normal);
}
