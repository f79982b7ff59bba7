/*
 * batch_scene.c - many shapes and lines with a given share of hits
 */
#include "batch_scene.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { SAMPLE = 512, HALVINGS = 25, SHAPE_SEED = 1, LINE_SEED = 2 };

static void *allocate(size_t n, size_t size)
{
    void *p = malloc(n * size);
    if (!p && n) {
        fputs("bench: out of memory\n", stderr);
        exit(4);
    }
    return p;
}

void scene_allocate(struct scene *s, size_t n_shapes, size_t n_lines)
{
    const size_t most = n_shapes > n_lines ? n_shapes : n_lines;
    s->n_shapes = n_shapes;
    s->n_lines = n_lines;
    s->shapes = allocate(n_shapes, sizeof *s->shapes);
    s->subjects = allocate(n_shapes, sizeof *s->subjects);
    s->lean = allocate(n_shapes, sizeof *s->lean);
    s->formula = NULL;
    s->memory = allocate(cylint_pack_bytes(n_shapes), 1);
    s->lines = allocate(2 * n_lines, sizeof *s->lines);
    s->away = allocate(n_lines, sizeof *s->away);
    s->numbers = allocate(16 * n_lines, sizeof *s->numbers);
    s->t[0] = allocate(2 * most, sizeof *s->t[0]);
    s->t[1] = s->t[0] + most;
    s->relation = allocate(2 * most, 1);
    s->n = s->relation + most;
}

void scene_free(struct scene *s)
{
    free(s->shapes);
    free(s->subjects);
    free(s->lean);
    free(s->memory);
    free(s->lines);
    free(s->away);
    free(s->numbers);
    free(s->t[0]);
    free(s->relation);
}

int scene_has_rival(const struct scene *s)
{
    return s->formula || plain_answers_for(&s->shapes[0]);
}

void scene_use_first(struct scene *s, size_t n)
{
    s->n_shapes = n;
    cylint_pack_shapes(&s->pack, s->memory, s->shapes, n);
}

void scene_finish(struct scene *s, int with_domains)
{
    const size_t n = s->n_lines;
    double *column[8];
    for (size_t i = 0; i < s->n_shapes; i++) {
        s->subjects[i].shape = s->shapes[i];
        prepare_subject(&s->subjects[i]);
        lean_prepare(&s->lean[i], &s->shapes[i]);
    }
    if (s->n_shapes && s->shapes[0].kind >= CYLINT_KIND_SPHERE)
        s->formula = lean_formula(&s->shapes[0]);
    for (int k = 0; k < 8; k++)
        column[k] = s->numbers + 2 * n * (size_t)k;
    for (size_t i = 0; i < 2 * n; i++) {
        const cylint_line *line = &s->lines[i % n];
        for (int k = 0; k < 3; k++) {
            column[k][i] = line->o[k];
            column[k + 3][i] = line->d[k];
        }
        column[6][i] = line->tmin;
        column[7][i] = line->tmax;
        s->lines[i] = *line;
    }
    s->columns = (cylint_lines){n,
                                {column[0], column[1], column[2]},
                                {column[3], column[4], column[5]},
                                with_domains ? column[6] : NULL,
                                with_domains ? column[7] : NULL};
    scene_use_first(s, s->n_shapes);
}

#ifndef HAVE_GSL

void scene_scatter(struct scene *s, int kind, double radius)
{
    (void)s, (void)kind, (void)radius;
}

double scene_radius(int kind, double share)
{
    (void)kind;
    return share;
}

#else

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

static gsl_rng *rng;

static void seed(unsigned long number)
{
    if (!rng)
        rng = gsl_rng_alloc(gsl_rng_taus2);
    gsl_rng_set(rng, number);
}

static double between(double low, double high)
{
    return low + (high - low) * gsl_rng_uniform(rng);
}

static void direction(double d[3])
{
    gsl_ran_dir_3d(rng, &d[0], &d[1], &d[2]);
}

static void point_of_ball(double radius, double p[3])
{
    do {
        for (int i = 0; i < 3; i++)
            p[i] = between(-1, 1);
    } while (p[0] * p[0] + p[1] * p[1] + p[2] * p[2] > 1);
    for (int i = 0; i < 3; i++)
        p[i] *= radius;
}

/* A random vector perpendicular to d, of the given length. */
static void across(const double d[3], double length, double e[3])
{
    double any[3];
    direction(any);
    for (int i = 0; i < 3; i++)
        e[i] = d[(i + 1) % 3] * any[(i + 2) % 3] -
               d[(i + 2) % 3] * any[(i + 1) % 3];
    length /= sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
    for (int i = 0; i < 3; i++)
        e[i] *= length;
}

static void scatter_shape(cylint_shape *shape, int kind, double radius)
{
    double axis[3], base[3], top[3], a[3], b[3], h[3];
    const double half = between(0.5, 1.5), r = between(0.5, 1.5);
    const double other = between(0.5, 1.5);
    point_of_ball(radius, base);
    direction(axis);
    for (int i = 0; i < 3; i++) {
        base[i] -= half * axis[i];
        h[i] = 2 * half * axis[i];
        top[i] = base[i] + h[i];
    }
    if (kind == CYLINT_KIND_CYLINDER) {
        cylint_cylinder(shape, base, top, r, CYLINT_ENDS_CAPPED);
    } else if (kind == CYLINT_KIND_CONE) {
        cylint_cone(shape, base, r, top, other, CYLINT_ENDS_CAPPED);
    } else if (kind == CYLINT_KIND_SPHERE) {
        cylint_sphere(shape, base, r, CYLINT_ENDS_CAPPED);
    } else if (kind == CYLINT_KIND_CAPSULE) {
        cylint_capsule(shape, base, top, r, CYLINT_ENDS_CAPPED);
    } else if (kind == CYLINT_KIND_RCONE) {
        cylint_round_cone(shape, base, r, top,
                          fabs(other - r) < 2 * half ? other : r + half,
                          CYLINT_ENDS_CAPPED);
    } else {
        across(axis, r, a);
        for (int i = 0; i < 3; i++)
            b[i] = other / r *
                   (axis[(i + 1) % 3] * a[(i + 2) % 3] -
                    axis[(i + 2) % 3] * a[(i + 1) % 3]);
        cylint_elliptic_cylinder(shape, base, a, b, h, CYLINT_ENDS_CAPPED);
    }
}

static void scatter_line(cylint_line *line, cylint_line *away, double radius)
{
    double o[3], d[3], e[3];
    point_of_ball(radius, o);
    direction(d);
    across(d, 1000 * (radius + 4), e);
    for (int i = 0; i < 3; i++)
        o[i] -= (radius + 4) * d[i];
    cylint_ray(line, o, d);
    for (int i = 0; i < 3; i++)
        o[i] += e[i];
    cylint_ray(away, o, d);
}

void scene_scatter(struct scene *s, int kind, double radius)
{
    seed(SHAPE_SEED);
    for (size_t i = 0; i < s->n_shapes; i++)
        scatter_shape(&s->shapes[i], kind, radius);
    seed(LINE_SEED);
    for (size_t i = 0; i < s->n_lines; i++)
        scatter_line(&s->lines[i], &s->away[i], radius);
    scene_finish(s, 0);
}

static double share_of(struct scene *s, int kind, double radius)
{
    size_t hits = 0;
    scene_scatter(s, kind, radius);
    for (size_t i = 0; i < s->n_lines; i++)
        hits += cylint_count(&s->pack, &s->lines[i], 0);
    return (double)hits / ((double)s->n_lines * (double)s->n_shapes);
}

double scene_radius(int kind, double share)
{
    double low = log(0.01), high = log(1000);
    struct scene s;
    scene_allocate(&s, SAMPLE, SAMPLE);
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = (low + high) / 2;
        *(share_of(&s, kind, exp(middle)) > share ? &low : &high) = middle;
    }
    scene_free(&s);
    return exp(high);
}

#endif
