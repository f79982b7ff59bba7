/*
 * quadratic.c - the plain quadratic of the textbooks
 *
 * With D = o - base the lateral surface is a quadratic equation in t.  Its
 * coefficients are expanded dot products, and its roots are
 * (-B +- sqrt(B^2 - 4AC)) / 2A.  The other methods are compared with it.
 * B^2 - 4AC has no correct digit where |D| is about 1e8 radii.
 *
 * Supports cylinders and cones of all kinds with any ends.
 */
#include "methods.h"

/* Inside: A t^2 + B t + C <= 0.  rho is positive on the base's nappe. */
typedef struct quadric {
    double A, B, C;
    cylint_affine rho, z;
} quadric;

/*
 * Circular: |w|^2 |D|^2 - (w.D)^2 is |w|^2 times the squared distance from
 * the axis, and rho = r0 + dr (w.D)/|w|^2.  Multiplied by |w|^2 once more, the
 * equation
 *
 *   |w|^4 |D|^2 - |w|^2 (w.D)^2 - (r0 |w|^2 + dr w.D)^2 = 0
 *
 * has no quotient.  A cylinder (dr = 0) needs only one factor |w|^2.  So does a
 * cone by apex and tangent k: |w|^2 |D|^2 - (w.D)^2 - (k w.D)^2 = 0.
 */
static quadric circular(const cylint_shape *shape, const cylint_line *line)
{
    quadric q;
    const double *d = line->d, *w = cylint_axis(shape);
    const double r0 = cylint_r0(shape), r1 = cylint_r1(shape), dr = r1 - r0;
    double D[3];

    minus(line->o, cylint_base(shape), D);
    const double ww = dot(w, w), wd = dot(w, d), wD = dot(w, D);
    q.A = ww * dot(d, d) - wd * wd;
    q.B = 2 * (ww * dot(d, D) - wd * wD);
    q.C = ww * dot(D, D) - wD * wD;
    q.z.at = wD / ww;
    q.z.slope = wd / ww;
    q.rho.at = r0 * ww + dr * wD;
    q.rho.slope = dr * wd;
    if (dr == 0) {
        q.C -= r0 * r0 * ww;
        return q;
    }
    if (shape->kind == CYLINT_KIND_CONE) {
        q.A *= ww;
        q.B *= ww;
        q.C *= ww;
    }
    q.A -= q.rho.slope * q.rho.slope;
    q.B -= 2 * q.rho.at * q.rho.slope;
    q.C -= q.rho.at * q.rho.at;
    return q;
}

/* Elliptic: x^2 + y^2 - (1 + (k-1) z)^2 = 0 with x = D.(b x h)/det, and y and
 * z likewise. */
static quadric elliptic(const cylint_shape *shape, const cylint_line *line)
{
    quadric q;
    double D[3], bh[3], ha[3], ab[3];

    minus(line->o, cylint_base(shape), D);
    cross(cylint_b(shape), cylint_axis(shape), bh);
    cross(cylint_axis(shape), cylint_a(shape), ha);
    cross(cylint_a(shape), cylint_b(shape), ab);
    const double det = dot(ab, cylint_axis(shape));
    const double x = dot(D, bh) / det, dx = dot(line->d, bh) / det;
    const double y = dot(D, ha) / det, dy = dot(line->d, ha) / det;
    q.z.at = dot(D, ab) / det;
    q.z.slope = dot(line->d, ab) / det;
    q.rho.at = 1 + (cylint_r1(shape) - 1) * q.z.at;
    q.rho.slope = (cylint_r1(shape) - 1) * q.z.slope;
    q.A = dx * dx + dy * dy - q.rho.slope * q.rho.slope;
    q.B = 2 * (x * dx + y * dy - q.rho.at * q.rho.slope);
    q.C = x * x + y * y - q.rho.at * q.rho.at;
    return q;
}

/* A = 0: the line is parallel to a ruling.  There is one root, except where
 * the line is parallel to a cylinder's axis or lies in a cone's tangent
 * plane (B = 0). */
static cylint_method_chord linear_chord(const quadric *q, int is_cone)
{
    if (!is_cone || q->B == 0)
        return parallel_chord(q->C);
    const double t = -q->C / q->B;
    return q->B > 0 ? chord_between(CYLINT_RELATION_CROSS, -INFINITY, t)
                    : chord_between(CYLINT_RELATION_CROSS, t, INFINITY);
}

/*
 * Reduces a double cone's chord to the nappe where rho >= 0.  rho, the signed
 * radius, is positive on one nappe and negative on the other.
 *
 *   gap    the chord has two pieces on opposite nappes: one of them stays
 *   along  the line is a ruling: the part beyond the apex, rho = 0, stays
 *   else   the chord lies on one nappe: rho at its middle, infinite where the
 *          line is parallel to a ruling, decides
 */
static void clip_to_nappe(cylint_method_chord *chord, cylint_affine rho)
{
    const int ahead = rho.slope > 0; /* the nappe is at t = +inf */

    if (chord->gap) {
        chord->gap = 0;
        chord->t[ahead ? 0 : 1] = chord->t[ahead ? 1 : 0];
        chord->t[ahead ? 1 : 0] = ahead ? INFINITY : -INFINITY;
    } else if (chord->relation == CYLINT_RELATION_ALONG) {
        chord->t[ahead ? 0 : 1] = -rho.at / rho.slope;
    } else {
        const double middle = 0.5 * chord->t[0] + 0.5 * chord->t[1];
        if (!(rho.at + middle * rho.slope >= 0))
            chord->relation = CYLINT_RELATION_MISS;
    }
}

cylint_status cylint_quadratic(const cylint_shape *shape,
                               const cylint_line *line, unsigned want,
                               cylint_answer *answer)
{
    quadric q;

    switch (shape->kind) {
    case CYLINT_KIND_CYLINDER:
    case CYLINT_KIND_CONE:
    case CYLINT_KIND_ACONE:
        q = circular(shape, line);
        break;
    case CYLINT_KIND_ECYLINDER:
    case CYLINT_KIND_ECONE:
        q = elliptic(shape, line);
        break;
    default:
        return cylint_method_not_applicable(answer);
    }
    const int is_cone = cylint_r0(shape) != cylint_r1(shape);
    cylint_method_chord chord =
        q.A == 0 ? linear_chord(&q, is_cone) : quadratic_chord(q.A, q.B, q.C);
    if (is_cone && shape->ends != CYLINT_ENDS_INFINITE)
        clip_to_nappe(&chord, q.rho);
    cylint_chord_ends(&chord, shape, q.z);
    return cylint_method_report(shape, line, want, &chord, answer);
}
