/*
 * shene_cone.c - line and double cone, by a plane through the apex
 *
 * [Shene 1995].  Supports infinite circular cones (double cones), given by
 * apex and angle or by two radii, from which apex and angle are computed.
 * Does not support a nappe or a bounded cone, nor a cone of equal radii,
 * which is a cylinder and has no apex.
 *
 * The cone has the apex V, the axis v and the half angle a; the line is
 * D + t d; v and d have length one.  The plane through V and the line has the
 * normal n = d x (D - V).  It cuts the cone in two rulings V + s delta, in one
 * ruling (a tangent plane) or in V alone.  A ruling that is not parallel to
 * the line meets it at
 *
 *   t = ((V - D) x delta).(d x delta) / |d x delta|^2.
 *
 * Missing in the print, and added:
 *   - The derivation of delta.  Let n have length one.  theta is the angle of
 *     the axis to the plane, sin theta = |v.n|.  m is the unit vector along
 *     the axis's projection v - (v.n) n, which has the length cos theta, and
 *     k = n x m.  delta = cos b m + sin b k is on the cone if delta.v = cos a.
 *     With m.v = cos theta and k.v = 0 that gives
 *         cos b = cos a / cos theta,   delta = cos b m +- sin b k,
 *     which exists for theta <= a.  [Checked against the quadratic.]
 *   - v parallel to n: theta is a right angle, and the plane cuts the cone in
 *     V alone.
 *   - The line through V: n = 0.  The line is a ruling if |d.v| = cos a.
 *     Otherwise its only hit is V, and it is inside the cone elsewhere if
 *     |d.v| > cos a.
 *   - The line parallel to a ruling: there is one intersection, with the
 *     other ruling.
 *
 * A cylinder is the limit of V at infinity: the plane parallel to the axis
 * through the line cuts it in two parallel lines.
 */
#include "methods.h"

typedef struct cone {
    double V[3], v[3];
    double cosine; /* of the half angle */
} cone;

static cone cone_of(const cylint_shape *shape)
{
    cone c;
    const double size = unit(cylint_axis(shape), c.v);
    double tangent = cylint_r1(shape);
    double to_apex = 0;

    if (shape->kind == CYLINT_KIND_CONE) {
        const double dr = cylint_r1(shape) - cylint_r0(shape);
        to_apex = -cylint_r0(shape) / dr;
        tangent = dr / size;
    }
    along(cylint_base(shape), to_apex, cylint_axis(shape), c.V);
    c.cosine = 1 / sqrt(1 + tangent * tangent);
    return c;
}

/* The line passes through V. */
static cylint_method_chord through_apex(const cone *c, const double to_V[3],
                                        const double d[3])
{
    const double steep = fabs(dot(d, c->v));
    const double t = dot(to_V, d);

    if (steep == c->cosine)
        return chord_between(CYLINT_RELATION_ALONG, -INFINITY, INFINITY);
    if (steep > c->cosine)
        return chord_with_gap(t, t);
    return chord_between(CYLINT_RELATION_TOUCH, t, t);
}

/* The t where D + t d meets the ruling V + s delta; returns 0 if the two are
 * parallel. */
static int intersect_ruling(const double to_V[3], const double d[3],
                            const double delta[3], double *t)
{
    double across[3], reach[3];

    cross(d, delta, across);
    const double size2 = dot(across, across);
    if (size2 == 0)
        return 0;
    cross(to_V, delta, reach);
    *t = dot(reach, across) / size2;
    return 1;
}

/* The chord of a line that meets the ruling `met` at t and is parallel to the
 * ruling `other`.  From a hit with s > 0 the chord extends towards +other,
 * from one with s < 0 towards -other. */
static cylint_method_chord half_line(const double to_V[3], const double d[3],
                                     const double met[3], const double other[3],
                                     double t)
{
    const double s = t * dot(d, met) - dot(to_V, met);
    const int ahead = (s > 0) == (dot(d, other) > 0);

    return ahead ? chord_between(CYLINT_RELATION_CROSS, t, INFINITY)
                 : chord_between(CYLINT_RELATION_CROSS, -INFINITY, t);
}

/* The chord where the plane cuts the cone in two rulings. */
static cylint_method_chord across_rulings(const cone *c, const double to_V[3],
                                          const double d[3],
                                          const double delta[2][3])
{
    double t0, t1;
    const int met0 = intersect_ruling(to_V, d, delta[0], &t0);
    const int met1 = intersect_ruling(to_V, d, delta[1], &t1);

    if (!met0 && !met1)
        return no_chord();
    if (!met1)
        return half_line(to_V, d, delta[0], delta[1], t0);
    if (!met0)
        return half_line(to_V, d, delta[1], delta[0], t1);

    const double low = t0 < t1 ? t0 : t1, high = t0 < t1 ? t1 : t0;
    if (fabs(dot(d, c->v)) > c->cosine)
        return chord_with_gap(low, high);
    return chord_between(CYLINT_RELATION_CROSS, low, high);
}

static cylint_method_chord shene_cone_chord(const cone *c, const double to_V[3],
                                            const double d[3])
{
    double n[3], m[3], k[3], delta[2][3];

    cross(to_V, d, n); /* d x (D - V) */
    if (dot(n, n) == 0)
        return through_apex(c, to_V, d);
    unit(n, n);
    along(c->v, -dot(c->v, n), n, m);
    const double cos_theta = unit(m, m); /* 0: v is parallel to n, m is NaN */
    if (!(c->cosine <= cos_theta))
        return no_chord();

    const double cos_b = c->cosine / cos_theta;
    if (cos_b == 1) {
        double t;
        if (!intersect_ruling(to_V, d, m, &t))
            return no_chord();
        return chord_between(CYLINT_RELATION_TOUCH, t, t);
    }
    const double sin_b = sqrt(1 - cos_b * cos_b);
    cross(n, m, k);
    for (int i = 0; i < 3; i++) {
        delta[0][i] = cos_b * m[i] + sin_b * k[i];
        delta[1][i] = cos_b * m[i] - sin_b * k[i];
    }
    return across_rulings(c, to_V, d, (const double(*)[3])delta);
}

cylint_status cylint_shene_cone(const cylint_shape *shape,
                                const cylint_line *line, unsigned want,
                                cylint_answer *answer)
{
    double d[3], to_V[3];
    const int is_cone =
        shape->kind == CYLINT_KIND_ACONE || shape->kind == CYLINT_KIND_CONE;

    if (!is_cone || shape->ends != CYLINT_ENDS_INFINITE)
        return cylint_method_not_applicable(answer);
    const cone c = cone_of(shape);
    const double speed = unit(line->d, d);
    minus(c.V, line->o, to_V);
    cylint_method_chord chord = shene_cone_chord(&c, to_V, d);
    chord.t[0] /= speed; /* from distance along d to multiples of it */
    chord.t[1] /= speed;
    return cylint_method_report(shape, line, want, &chord, answer);
}
