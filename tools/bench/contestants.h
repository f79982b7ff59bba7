/*
 * contestants.h - who answers, and what each is asked
 *
 * A contestant is a way to intersect and a mode: what is wanted of it.  All
 * are called alike, through a pointer, with the same shape, line and answer;
 * what a formulation may know of a shape beforehand stands in the subject.
 */
#ifndef BENCH_CONTESTANTS_H
#define BENCH_CONTESTANTS_H

#include "cylint_methods.h"

/* A shape, and what the plain formulations keep of it.  The library is
 * handed the shape, which comes first, so that they can find the rest. */
struct subject {
    cylint_shape shape;
    double axis_axis; /* w.w */
    double radius;    /* r0 w.w, or r0^2 w.w for a cylinder */
};

struct question {
    struct subject subject;
    cylint_line line;
};

void prepare_subject(struct subject *s);

typedef int contestant_answers_for(const cylint_shape *shape);

struct contestant {
    const char *name;
    const char *mode;                    /* verdict, nearest, both, fast, all */
    cylint_method_fn *answer;            /* NULL: cylint_intersect itself */
    contestant_answers_for *answers_for; /* NULL: asked, it tells */
    unsigned want;
    int only_hit; /* 1: no relation, just whether the nearest hit
                                is there */
};

/* Every contestant: the last one's name is NULL. */
const struct contestant *contestants(void);

/* The one called so; stops the program if there is none. */
const struct contestant *contestant_named(const char *name, const char *mode);

/* Whether it answers for this shape at all. */
int contestant_takes(const struct contestant *c, const cylint_shape *shape);

/* One answer. */
void contestant_answer(const struct contestant *c, const struct question *q,
                       cylint_answer *answer);

/* A contestant's turn in a race (race.h): all questions, in that order.
 * The context is an entry. */
struct entry {
    const struct contestant *contestant;
    const struct question *questions;
};

void contestant_turn(void *entry, const int *order, int n);

/* ------------------------------------------- our own, for comparison -- */

/* plain.c: B^2 - 4AC as lean as it can be had, for circular kinds given by
 * radii, capped or infinite: no parts, no sides, nothing but t. */
cylint_method_fn plain_quadratic;
int plain_answers_for(const cylint_shape *shape);

/* shader.c: a capped cylinder's nearest hit, as shaders do it. */
cylint_method_fn shader_cylinder;
int shader_answers_for(const cylint_shape *shape);

/* gsl_quadratic.c: the plain coefficients, solved by GSL. */
#ifdef HAVE_GSL
cylint_method_fn gsl_quadratic;
#endif

#endif
