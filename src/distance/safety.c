/*
 * safety.c - a lower bound of a distance, in doubles
 *
 * The distance is computed in the half plane through the axis and the point, with a
 * bound on its error (error_bounds.h), which is subtracted.  Where the distance is
 * below the bound or overflows, where rounding is directed, where local coordinates
 * (shapes/local.h) are not accurate enough, and for the other shapes that
 * cylint_distance.h names, the result is the double below the distance.
 *
 * Which feature is nearest is hard to predict, so maxima and masks take the
 * place of branches.
 *
 * Elliptic kinds: elliptic_certain.c.
 */
#define CYLINT_NARROW
#include "../dispatch.h"
#include "../numbers/bits.h"
#include "../numbers/simd.h"
#include "../shapes/measure.h"
#include "../shapes/shape_facts.h"
#include "cylint_distance.h"
#include "one_distance.h"
#include "error_bounds.h"

ASIDE double below_distance(const cylint_shape *shape, const double point[3])
{
    cylint_closest answer;
    int proved;
    /* mutant '0' -> '1': only its sign is used */
    answer.part = 0;
    const double size =
        fabs(cylint_distance_alone(shape, point, &answer, &proved));
    if (answer.part < 0 || cylint_sign(size) == 0)
        return size;
    const double below = fabs(cylint_next_above(-size)); /* no -0 */
    return cylint_is_elliptic(shape->kind) && !proved
               ? cylint_below_elliptic(shape, point, below)
               : below;
}

#if LANES == 2

/* A function of simd.h: sqrt() would also set errno. */
INLINE double root(double x)
{
    return v_first(v_sqrt(v_set(x)));
}

INLINE double sum_of_lanes(vd x)
{
    return v_first(x) + v_first(v_turned(x));
}

INLINE double max_of_lanes(vd x)
{
    return v_first(v_max(x, v_turned(x)));
}

/* The point in the half plane: z, and the square of the distance from the axis,
 * rho. */
typedef struct {
    double z, square;
} position;

/* Circular kinds: the local coordinates. */
INLINE position locate(const cylint_shape *s, const double point[3])
{
    const double X = point[0] - cylint_base(s)[0],
                 Y = point[1] - cylint_base(s)[1],
                 Z = point[2] - cylint_base(s)[2];
    const vd xy = v_set(X) * v_load(cylint_column(s, 0)) +
                  v_set(Y) * v_load(cylint_column(s, 1)) +
                  v_set(Z) * v_load(cylint_column(s, 2));
    return (position){X * cylint_column(s, 0)[2] + Y * cylint_column(s, 1)[2] +
                          Z * cylint_column(s, 2)[2],
                      sum_of_lanes(xy * xy)};
}

/* The distances from the planes of base and top, positive outside. */
INLINE vd from_planes(const cylint_shape *s, double z)
{
    return v_two(-z, z - cylint_height(s));
}

/* --------------------------------------------- absolute distances ------- */

INLINE double from_cylinder(const cylint_shape *s, position at)
{
    const vd B = v_max(v_set(-at.z), v_set(at.z - cylint_height(s)));
    const vd x = v_firsts(v_set(root(at.square) - cylint_r0(s)), B),
             zero = v_set(0);
    const vd out = v_max(x, zero), depth = zero - v_max(x, v_turned(x));
    return root(sum_of_lanes(out * out)) + v_first(v_max(depth, zero));
}

/*
 * The lanes are the two ends.  x and z: the point from the rim.  foot: the
 * point's foot on the lateral line, positive beyond the rim.  A rim is nearest
 * where its foot is positive and, if there are caps, x is positive too.  The
 * distances from the lateral line and from the planes are never larger than the
 * distance from the solid.
 */
INLINE double from_cone(const cylint_shape *s, position at, double C, double S,
                        int has_caps)
{
    const vd zero = v_set(0);
    const vd z = from_planes(s, at.z),
             x = v_set(root(at.square)) - v_two(cylint_r0(s), cylint_r1(s));
    const vd foot = v_set(C) * z + v_two(-S, S) * x;
    const vm beyond = v_lt(zero, foot);
    const vm rim = has_caps ? m_and(beyond, v_lt(zero, x)) : beyond;
    const vd square = v_select(rim, x * x + z * z, zero);
    const double line = C * v_first(x) - S * at.z;
    const vd flat =
        has_caps ? v_max(v_set(line), v_max(z, v_turned(z))) : v_set(line);
    return v_first(v_max(v_set(root(max_of_lanes(square))), v_abs(flat)));
}

INLINE double from_capsule(const cylint_shape *s, position at)
{
    const vd z = v_max(from_planes(s, at.z), v_set(0));
    return fabs(root(at.square + sum_of_lanes(z * z)) - cylint_r0(s));
}

/* x^2 with the signs of x. */
INLINE vd signed_squares(vd x)
{
    return x * v_abs(x);
}

/*
 * The lanes are the two balls.  One is nearest where the foot -C z - S rho or
 * C (z - height) + S rho is positive.  The squares are compared, which needs no
 * root.  If roundings make both positive, the result is not above the distance
 * from the ball whose z is larger.
 */
INLINE double from_round_cone(const cylint_shape *s, position at)
{
    const double C = cylint_cosine(s), S = cylint_sine(s);
    const vd zero = v_set(0), z = from_planes(s, at.z);
    const vd across = signed_squares(v_two(-S, S)) * v_set(at.square);
    const vd foot = signed_squares(v_set(C) * z) + across;
    const vm ball = v_lt(zero, foot);
    const vm any = v_lt(zero, v_max(foot, v_turned(foot)));
    const double up = max_of_lanes(v_select(ball, z * z, zero));
    const double r =
        max_of_lanes(v_select(ball, v_two(cylint_r0(s), cylint_r1(s)), zero));
    const double rho = root(at.square + up);
    const double line = C * rho - S * at.z - cylint_r0(s);
    return fabs(v_first(v_select(any, v_set(rho - r), v_set(line))));
}

INLINE double from_sphere(const cylint_shape *s, const double point[3])
{
    const double X = point[0] - cylint_base(s)[0],
                 Y = point[1] - cylint_base(s)[1],
                 Z = point[2] - cylint_base(s)[2];
    return fabs(root(X * X + Y * Y + Z * Z) - cylint_r0(s));
}

/* Of an infinite cylinder or a double cone. */
INLINE double from_infinite(const cylint_shape *s, position at, double C,
                            double S)
{
    return fabs(C * root(at.square) - fabs(S * at.z + C * cylint_r0(s)));
}

/* ------------------------------------------------------- lower bounds --- */

/* 0 in the other rounding modes, where errors are larger. */
INLINE double less_error(double distance, double error)
{
    return cylint_rounds_to_nearest() ? distance - error : 0;
}

/* The bound, if it is positive.  Otherwise the distance is below its error or can
 * overflow; NaN: it overflows. */
INLINE double if_positive(double bound, const cylint_shape *s,
                          const double point[3])
{
    return bound > 0 ? bound : below_distance(s, point);
}

/* All but the capped shapes of circular and round kinds. */
ASIDE double other_safety(const cylint_shape *s, const double point[3])
{
    const double C = cylint_cosine(s), S = cylint_sine(s);
    double bound = 0;
    if (!cylint_prepared(s) || cylint_has_tangent(s->kind))
        return below_distance(s, point);
    if (cylint_is_elliptic(s->kind)) {
        bound = CYLINT_OF_FMA(cylint_elliptic_kernels)->safety(s, point);
    } else if (s->ends == CYLINT_ENDS_INFINITE) {
        const position at = locate(s, point);
        const double size = root(at.square) + fabs(at.z) + cylint_reach(s);
        bound =
            less_error(from_infinite(s, at, C, S), CYLINT_SAFETY_ERROR * size);
    } else if (s->ends == CYLINT_ENDS_OPEN && !cylint_is_round(s->kind)) {
        const double d = from_cone(s, locate(s, point), C, S, 0);
        bound = less_error(d, CYLINT_SAFETY_ERROR * (d + cylint_reach(s)));
    }
    return if_positive(bound, s, point);
}

double cylint_safety(const cylint_shape *s, const double point[3])
{
    double d;
    if (s->ends != CYLINT_ENDS_CAPPED || !cylint_prepared(s))
        return other_safety(s, point);
    switch (s->kind) {
    case CYLINT_KIND_CYLINDER:
        d = from_cylinder(s, locate(s, point));
        break;
    case CYLINT_KIND_CONE:
        d = from_cone(s, locate(s, point), cylint_cosine(s), cylint_sine(s), 1);
        break;
    case CYLINT_KIND_SPHERE:
        d = from_sphere(s, point);
        return if_positive(
            less_error(d, CYLINT_SPHERE_SAFETY_ERROR * (d + cylint_r0(s))), s,
            point);
    case CYLINT_KIND_CAPSULE:
        d = from_capsule(s, locate(s, point));
        break;
    case CYLINT_KIND_RCONE:
        d = from_round_cone(s, locate(s, point));
        break;
    default:
        return other_safety(s, point);
    }
    return if_positive(
        less_error(d, CYLINT_SAFETY_ERROR * (d + cylint_reach(s))), s, point);
}

#else

/* Without vectors of two lanes. */
double cylint_safety(const cylint_shape *shape, const double point[3])
{
    return below_distance(shape, point);
}

#endif

/* Answer i is that of point i and shape number each * i. */
static void write_safety(const cylint_shape *shapes, size_t each,
                         const cylint_points *points, double *safety)
{
    for (size_t i = 0; i < points->n; i++) {
        double point[3];
        cylint_read_point(points, i, point);
        safety[i] = cylint_safety(shapes + each * i, point);
    }
}

void cylint_safety_points(const cylint_shape *shape,
                          const cylint_points *points, double *safety)
{
    write_safety(shape, 0, points, safety);
}

void cylint_safety_pairs(const cylint_shape *shapes,
                         const cylint_points *points, double *safety)
{
    write_safety(shapes, 1, points, safety);
}
