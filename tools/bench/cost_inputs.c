/*
 * cost_inputs.c - ordinary lines from a Sobol sequence, and an integer grid
 */
#include "cost_inputs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const shape_names[] = {
    "cylinder infinite", "cylinder capped", "cone infinite", "cone capped"};
static const char *const work_names[] = {"71 % hits", "5 % hits", "misses",
                                         "integer grid"};

const char *cost_shape_name(enum cost_shape shape)
{
    return shape_names[shape];
}

const char *cost_work_name(enum cost_work work)
{
    return work_names[work];
}

#ifndef HAVE_GSL

int cost_questions(enum cost_shape shape, enum cost_work work,
                   struct question *q, int n, int *hits)
{
    (void)shape, (void)work, (void)q, (void)n, (void)hits;
    return 0;
}

#else

#include <gsl/gsl_qrng.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

static gsl_rng *rng;

static double between(double low, double high)
{
    return low + (high - low) * gsl_rng_uniform(rng);
}

static int whole(int low, int high)
{
    return low + (int)gsl_rng_uniform_int(rng, (unsigned long)(high - low + 1));
}

static int is_cone(enum cost_shape shape)
{
    return shape >= COST_CONE_INFINITE;
}

static cylint_ends ends_of(enum cost_shape shape)
{
    return shape == COST_CYLINDER_INFINITE || shape == COST_CONE_INFINITE
               ? CYLINT_ENDS_INFINITE
               : CYLINT_ENDS_CAPPED;
}

static int make_shape(struct question *q, enum cost_shape shape,
                      const double p0[3], double r0, const double p1[3],
                      double r1)
{
    const cylint_ends ends = ends_of(shape);
    cylint_shape *s = &q->subject.shape;
    const cylint_status status = is_cone(shape)
                                     ? cylint_cone(s, p0, r0, p1, r1, ends)
                                     : cylint_cylinder(s, p0, p1, r0, ends);
    if (status != CYLINT_OK)
        return 0;
    prepare_subject(&q->subject);
    return 1;
}

static int relation(const struct question *q)
{
    cylint_answer answer;
    cylint_intersect(&q->subject.shape, &q->line, CYLINT_WANT_COUNT, &answer);
    return answer.relation;
}

/* ------------------------------------------------- ordinary lines ------ */

/* A shape about the origin: radius 0.5 to 1.5, height 1 to 3, any axis. */
static void ordinary_shape(struct question *q, enum cost_shape shape)
{
    double axis[3], p0[3], p1[3];
    do {
        const double h = between(0.5, 1.5);
        gsl_ran_dir_3d(rng, &axis[0], &axis[1], &axis[2]);
        for (int i = 0; i < 3; i++) {
            const double centre = between(-0.5, 0.5);
            p0[i] = centre - h * axis[i];
            p1[i] = centre + h * axis[i];
        }
    } while (
        !make_shape(q, shape, p0, between(0.5, 1.5), p1, between(0.1, 0.4)));
}

/* The line through a point of a cube about the shape, in any direction.  x:
 * five numbers in [0, 1) from the sequence, which fills the unit cube
 * evenly. */
static void line_of(const double x[5], struct question *q)
{
    const double pi = 3.14159265358979323846;
    double o[3], d[3];
    for (int i = 0; i < 3; i++)
        o[i] = 10 * x[i] - 5;
    const double z = 2 * x[3] - 1, turn = 2 * pi * x[4];
    const double across = sqrt(1 - z * z);
    d[0] = across * cos(turn);
    d[1] = across * sin(turn);
    d[2] = z;
    cylint_whole_line(&q->line, o, d);
}

/* Takes lines from the sequence until it has `hits` hits and n - hits
 * misses. */
static void ordinary(enum cost_shape shape, struct question *q, int n, int hits)
{
    gsl_qrng *sobol = gsl_qrng_alloc(gsl_qrng_sobol, 5);
    int misses = n - hits;
    double x[5];
    gsl_qrng_get(sobol, x); /* the first is all zeros */
    for (int i = 0; i < n;) {
        ordinary_shape(&q[i], shape);
        gsl_qrng_get(sobol, x);
        line_of(x, &q[i]);
        int *wanted = relation(&q[i]) == CYLINT_RELATION_MISS ? &misses : &hits;
        if (*wanted > 0) {
            --*wanted;
            i++;
        }
    }
    gsl_qrng_free(sobol);
}

/* ----------------------------------------------------- the grid -------- */

/* A shape with integer coordinates whose axis is parallel to coordinate axis
 * k. */
struct grid_shape {
    int i, j, k; /* i, j: the other two coordinates */
    double p0[3], p1[3], r0, r1;
};

static void grid_shape(struct grid_shape *g, struct question *q,
                       enum cost_shape shape)
{
    do {
        g->k = whole(0, 2);
        g->i = (g->k + 1) % 3;
        g->j = (g->k + 2) % 3;
        for (int c = 0; c < 3; c++)
            g->p0[c] = g->p1[c] = whole(-5, 5);
        g->p1[g->k] += whole(1, 6) * (whole(0, 1) ? 1 : -1);
        g->r0 = whole(1, 5);
        g->r1 = is_cone(shape) ? whole(0, 5) : g->r0;
    } while ((is_cone(shape) && g->r0 == g->r1) ||
             !make_shape(q, shape, g->p0, g->r0, g->p1, g->r1));
}

static void grid_parallel(const struct grid_shape *g, double o[3], double d[3])
{
    for (int c = 0; c < 3; c++)
        o[c] = g->p0[c] + whole(-6, 6);
    d[g->k] = whole(0, 1) ? 1 : -1;
}

/* A line through a point of the base's rim in the tangent plane there: a
 * combination of the rim's tangent and the ruling. */
static void grid_tangent(const struct grid_shape *g, double o[3], double d[3])
{
    const int up = whole(-1, 1), back = whole(-4, 4);
    d[g->j] = 1;
    d[g->i] = up * (g->r1 - g->r0);
    d[g->k] = up * (g->p1[g->k] - g->p0[g->k]);
    for (int c = 0; c < 3; c++)
        o[c] = g->p0[c] + (c == g->i ? g->r0 : 0) - back * d[c];
}

static void grid_other(double o[3], double d[3])
{
    do {
        for (int c = 0; c < 3; c++) {
            o[c] = whole(-8, 8);
            d[c] = whole(-8, 8) - o[c];
        }
    } while (d[0] == 0 && d[1] == 0 && d[2] == 0);
}

enum { PARALLEL = 20, TANGENT = 2 }; /* per cent */

static void grid_question(enum cost_shape shape, struct question *q, int which)
{
    for (;;) {
        struct grid_shape g;
        double o[3] = {0, 0, 0}, d[3] = {0, 0, 0};
        grid_shape(&g, q, shape);
        if (which < PARALLEL)
            grid_parallel(&g, o, d);
        else if (which < PARALLEL + TANGENT)
            grid_tangent(&g, o, d);
        else
            grid_other(o, d);
        cylint_whole_line(&q->line, o, d);
        if (which < PARALLEL)
            return;
        if (which < PARALLEL + TANGENT) {
            if (relation(q) == CYLINT_RELATION_TOUCH)
                return;
        } else if ((d[g.i] != 0 || d[g.j] != 0) &&
                   relation(q) != CYLINT_RELATION_TOUCH) {
            return;
        }
    }
}

int cost_questions(enum cost_shape shape, enum cost_work work,
                   struct question *q, int n, int *hits)
{
    static const double share[] = {0.71, 0.05, 0};
    if (!rng)
        rng = gsl_rng_alloc(gsl_rng_taus2);
    gsl_rng_set(rng, 1 + (unsigned long)(COST_WORKS * (int)shape + (int)work));
    if (work == COST_GRID)
        for (int i = 0; i < n; i++)
            grid_question(shape, &q[i], i % 100);
    else
        ordinary(shape, q, n, (int)(share[work] * n + 0.5));
    *hits = 0;
    for (int i = 0; i < n; i++)
        *hits += relation(&q[i]) != CYLINT_RELATION_MISS;
    return 1;
}

#endif
