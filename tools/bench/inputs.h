/*
 * inputs.h - random solids, in numbers that the library and its rivals prepare
 */
#ifndef BENCH_INPUTS_H
#define BENCH_INPUTS_H

#include "bench.h"
#include "random.h"
#include "vectors.h"

enum kind { CYLINDER, CONE, ELLIPTIC, SPHERE, CAPSULE, ROUND_CONE, KINDS };

extern const char *const kind_names[KINDS];

struct solid {
    enum kind kind;
    int is_infinite;         /* else capped */
    double base[3], axis[3]; /* from base to top, of any length */
    double middle[3];
    double r0, r1;     /* at base and top */
    double a[3], b[3]; /* half axes of an elliptic cylinder */
};

double between(uint64_t *random, double low, double high);
double power_between(uint64_t *random, double low, double high); /* of ten */
void draw_direction(uint64_t *random, double d[3]);

/* v / |v| in place; returns |v|. */
double normalise(double v[3]);

/* Near the origin, about 1 long and 0.1 to 1 thick. */
void draw_solid(uint64_t *random, enum kind kind, struct solid *s);

cylint_shape shape_of_solid(const struct solid *s);

/* Calls a function that falls from 0 to `most`, the last time near the argument
 * at which it is `wanted`.  Returns the value there. */
double approach(double (*function)(double), double most, double wanted);

#endif
