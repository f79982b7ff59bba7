/*
 * inputs.c - random solids
 */
#include "inputs.h"

const char *const kind_names[KINDS] = {
    "cylinder", "cone", "elliptic cylinder", "sphere", "capsule", "round cone"};

double between(uint64_t *random, double low, double high)
{
    return low + (high - low) * random_unit(random);
}

double power_between(uint64_t *random, double low, double high)
{
    return pow(10, between(random, low, high));
}

double normalise(double v[3])
{
    const double size = sqrt(dot3(v, v));
    for (int i = 0; i < 3; i++)
        v[i] /= size;
    return size;
}

void draw_direction(uint64_t *random, double d[3])
{
    do
        for (int i = 0; i < 3; i++)
            d[i] = between(random, -1, 1);
    while (dot3(d, d) > 1 || dot3(d, d) < 0.01);
    normalise(d);
}

double approach(double (*function)(double), double most, double wanted)
{
    double low = 0, high = most, value = 0;
    for (int step = 0; step < 16; step++) {
        const double middle = 0.5 * (low + high);
        value = function(middle);
        *(value > wanted ? &low : &high) = middle;
    }
    return value;
}

void draw_solid(uint64_t *random, enum kind kind, struct solid *s)
{
    *s = (struct solid){.kind = kind,
                        .r0 = between(random, 0.2, 0.5),
                        .r1 = between(random, 0.05, 0.45)};
    for (int i = 0; i < 3; i++) {
        s->base[i] = between(random, -1, 1);
        s->axis[i] = between(random, -1, 1);
        s->middle[i] = s->base[i] + 0.5 * s->axis[i];
    }
    if (kind == SPHERE)
        for (int i = 0; i < 3; i++)
            s->middle[i] = s->base[i];
    if (kind == ELLIPTIC) {
        draw_direction(random, s->a);
        cross3(s->b, s->axis, s->a);
        for (int i = 0; i < 3; i++) {
            s->a[i] *= s->r0;
            s->b[i] *= s->r1;
        }
    }
    if (kind == ROUND_CONE)
        s->r1 = fmax(s->r1, s->r0 - 0.5 * sqrt(dot3(s->axis, s->axis)));
    else if (kind != CONE)
        s->r1 = s->r0;
}

cylint_shape shape_of_solid(const struct solid *s)
{
    const cylint_ends ends =
        s->is_infinite ? CYLINT_ENDS_INFINITE : CYLINT_ENDS_CAPPED;
    const double *p = s->base;
    double q[3];
    cylint_shape shape;
    cylint_status status = CYLINT_OK;
    for (int i = 0; i < 3; i++)
        q[i] = p[i] + s->axis[i];
    switch (s->kind) {
    case CYLINDER:
        status = cylint_cylinder(&shape, p, q, s->r0, ends);
        break;
    case CONE:
        status = cylint_cone(&shape, p, s->r0, q, s->r1, ends);
        break;
    case ELLIPTIC:
        status = cylint_elliptic_cylinder(&shape, p, s->a, s->b, s->axis, ends);
        break;
    case SPHERE:
        status = cylint_sphere(&shape, p, s->r0, ends);
        break;
    case CAPSULE:
        status = cylint_capsule(&shape, p, q, s->r0, ends);
        break;
    default:
        status = cylint_round_cone(&shape, p, s->r0, q, s->r1, ends);
    }
    must(status == CYLINT_OK, "a shape was refused");
    return shape;
}
