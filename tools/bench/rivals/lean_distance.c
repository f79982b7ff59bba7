/*
 * lean_distance.c - signed distances in doubles: capped cylinder, capped cone,
 * sphere, capsule, rounded cone
 */
#include "lean.h"

static inline double positive(double x)
{
    return x > 0 ? x : 0;
}

static inline double clamped(double x)
{
    return x < 0 ? 0 : x > 1 ? 1 : x;
}

/* The coordinates along and across the axis. */
static inline double along_and_across(const struct lean_body *s,
                                      const double point[3], double *across)
{
    double q[3];
    for (int i = 0; i < 3; i++)
        q[i] = point[i] - s->base[i];
    const double z = dot3(q, s->axis);
    *across = sqrt(positive(dot3(q, q) - z * z));
    return z;
}

static double cylinder_distance(const struct lean_body *s,
                                const double point[3])
{
    double across;
    const double y = fabs(along_and_across(s, point, &across)) - s->half;
    const double x = across - s->r0;
    if (x < 0 || y < 0)
        return x > y ? x : y;
    return sqrt(x * x + y * y);
}

/* From a cap and from the side; the lesser of the squares. */
static double cone_distance(const struct lean_body *s, const double point[3])
{
    double across;
    const double y = along_and_across(s, point, &across) - s->half;
    const double rim = y < 0 ? s->r0 : s->r1;
    const double cap_x = positive(across - rim), cap_y = fabs(y) - s->half;
    const double dr = s->r1 - s->r0, h = 2 * s->half;
    const double x = across - s->r1, up = y - s->half;
    const double at = clamped(-(x * dr + up * h) * s->inverse);
    const double side_x = x + dr * at, side_y = up + h * at;
    const double cap = cap_x * cap_x + cap_y * cap_y;
    const double side = side_x * side_x + side_y * side_y;
    const double distance = sqrt(cap < side ? cap : side);
    return side_x < 0 && cap_y < 0 ? -distance : distance;
}

static double sphere_distance(const struct lean_body *s, const double point[3])
{
    double q[3];
    for (int i = 0; i < 3; i++)
        q[i] = point[i] - s->base[i];
    return sqrt(dot3(q, q)) - s->r0;
}

static double capsule_distance(const struct lean_body *s, const double point[3])
{
    double q[3];
    for (int i = 0; i < 3; i++)
        q[i] = point[i] - s->base[i];
    const double at = clamped(dot3(q, s->axis) * s->inverse);
    for (int i = 0; i < 3; i++)
        q[i] -= at * s->axis[i];
    return sqrt(dot3(q, q)) - s->r0;
}

static double rcone_distance(const struct lean_body *s, const double point[3])
{
    double x;
    const double y = along_and_across(s, point, &x), h = 2 * s->half;
    const double k = s->level * y - s->slope * x;
    if (k < 0)
        return sqrt(x * x + y * y) - s->r0;
    if (k > s->level * h)
        return sqrt(x * x + (y - h) * (y - h)) - s->r1;
    return x * s->level + y * s->slope - s->r0;
}

void lean_prepare_body(struct lean_body *to, const struct solid *s)
{
    const double length = sqrt(dot3(s->axis, s->axis)), dr = s->r1 - s->r0;
    const int is_capsule = s->kind == CAPSULE;
    for (int i = 0; i < 3; i++) {
        to->axis[i] = is_capsule ? s->axis[i] : s->axis[i] / length;
        to->base[i] = s->kind == CYLINDER ? s->middle[i] : s->base[i];
    }
    to->half = length / 2;
    to->r0 = s->r0;
    to->r1 = s->r1;
    to->slope = -dr / length;
    to->level = sqrt(positive(1 - to->slope * to->slope));
    to->inverse = 1 / (length * length + (is_capsule ? 0 : dr * dr));
}

lean_distance *const lean_distances[KINDS] = {
    cylinder_distance, cone_distance,    NULL,
    sphere_distance,   capsule_distance, rcone_distance};
