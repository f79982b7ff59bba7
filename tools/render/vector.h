/*
 * vector.h - three coordinates, or red, green and blue, as one value
 */
#ifndef CYLINT_VECTOR_H
#define CYLINT_VECTOR_H

#include <math.h>

struct vector {
    double v[3];
};

static inline struct vector vector(double x, double y, double z)
{
    return (struct vector){{x, y, z}};
}

static inline struct vector vector_of(const double *v)
{
    return vector(v[0], v[1], v[2]);
}

/* a + s b */
static inline struct vector plus(struct vector a, double s, struct vector b)
{
    return vector(a.v[0] + s * b.v[0], a.v[1] + s * b.v[1],
                  a.v[2] + s * b.v[2]);
}

static inline struct vector times(double s, struct vector a)
{
    return vector(s * a.v[0], s * a.v[1], s * a.v[2]);
}

static inline struct vector minus(struct vector a, struct vector b)
{
    return plus(a, -1, b);
}

/* The product by coordinates: coloured light on a coloured surface. */
static inline struct vector filtered(struct vector a, struct vector b)
{
    return vector(a.v[0] * b.v[0], a.v[1] * b.v[1], a.v[2] * b.v[2]);
}

/* a where s is 0, b where s is 1 */
static inline struct vector mixed(struct vector a, struct vector b, double s)
{
    return plus(times(1 - s, a), s, b);
}

static inline double dot(struct vector a, struct vector b)
{
    return a.v[0] * b.v[0] + a.v[1] * b.v[1] + a.v[2] * b.v[2];
}

static inline struct vector cross(struct vector a, struct vector b)
{
    return vector(a.v[1] * b.v[2] - a.v[2] * b.v[1],
                  a.v[2] * b.v[0] - a.v[0] * b.v[2],
                  a.v[0] * b.v[1] - a.v[1] * b.v[0]);
}

/* 0 times infinity is not 0. */
static inline int is_finite(struct vector a)
{
    return dot(a, vector(0, 0, 0)) == 0;
}

/* dot(a, a) would under- or overflow for some scenes. */
static inline double length(struct vector a)
{
    return hypot(hypot(a.v[0], a.v[1]), a.v[2]);
}

static inline struct vector unit(struct vector a)
{
    const double size = length(a);
    return vector(a.v[0] / size, a.v[1] / size, a.v[2] / size);
}

/* A unit vector perpendicular to the unit vector n: n times (cross product) the
 * coordinate direction in which n is least. */
static inline struct vector perpendicular(struct vector n)
{
    int least = fabs(n.v[1]) < fabs(n.v[0]) ? 1 : 0;
    struct vector e = vector(0, 0, 0);
    least = fabs(n.v[2]) < fabs(n.v[least]) ? 2 : least;
    e.v[least] = 1;
    return unit(cross(n, e));
}

#endif
