/*
 * contestants.h - the contestants of a race: a method and a mode each
 *
 * A contestant is an intersection method and a mode, which is the set of
 * results it computes.  All are called through a pointer with the same shape,
 * line and answer.  The subject holds the values that a method may prepare
 * for a shape.
 */
#ifndef BENCH_CONTESTANTS_H
#define BENCH_CONTESTANTS_H

#include "cylint_methods.h"

/* A shape and the values that the plain quadratic prepares for it.  The shape
 * comes first: a method gets a pointer to it and reads the rest behind it. */
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
    const char *mode;                    /* verdict, nearest, both, all */
    cylint_method_fn *answer;            /* NULL: cylint_intersect itself */
    contestant_answers_for *answers_for; /* NULL: by its status */
    unsigned want;
    int only_hit; /* 1: writes the nearest hit or none, no relation */
};

/* All contestants; the last entry's name is NULL. */
const struct contestant *contestants(void);

/* The contestant of that name and mode; exits if there is none. */
const struct contestant *contestant_named(const char *name, const char *mode);

/* Whether the contestant answers for this shape. */
int contestant_takes(const struct contestant *c, const cylint_shape *shape);

/* Computes one answer. */
void contestant_answer(const struct contestant *c, const struct question *q,
                       cylint_answer *answer);

/* A contestant's turn in a race (race.h): all questions in the given order.
 * The context is a struct entry. */
struct entry {
    const struct contestant *contestant;
    const struct question *questions;
};

void contestant_turn(void *entry, const int *order, int n);

/* -------------------------------------------- methods to compare with -- */

/* plain.c: the plain quadratic, B^2 - AC with as few operations as possible,
 * for cylinders and cones, capped or infinite.  It writes t, no parts and no
 * sides. */
cylint_method_fn plain_quadratic;
int plain_answers_for(const cylint_shape *shape);

/* shader.c: the nearest hit of a capped cylinder by the shader formula. */
cylint_method_fn shader_cylinder;
int shader_answers_for(const cylint_shape *shape);

/* gsl_quadratic.c: the plain quadratic's coefficients, solved by GSL. */
#ifdef HAVE_GSL
cylint_method_fn gsl_quadratic;
#endif

#endif
