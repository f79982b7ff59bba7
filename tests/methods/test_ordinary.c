/*
 * test_ordinary.c - floor methods: ordinary input, against long double
 *
 * Each published method agrees with a reference on well-conditioned input of
 * its shapes, and returns CYLINT_EMETHOD for all others.  Degenerate input is
 * in test_degenerate.c, misprints are in test_misprints.c.
 *
 * The reference shares no code with a method.  It maps the line to the shape's
 * own coordinates, collects all parameters at which inside and outside can
 * change (lateral roots, planes of the ends), and tests a point between each
 * two of them.
 */
#include <math.h>
#include <string.h>

#include "method_cases.h"
#include "random.h"
#include "shapes/layout.h"

typedef long double real;

#define SEED 20240229u
#define TRIALS 20000
#define AGREEMENT 1e-9L /* required of the methods, relative */

/* -------------------------------------------------------------- random -- */

static double between(double low, double high)
{
    static uint64_t stream = SEED;
    return low + (high - low) * random_unit(&stream);
}

static void random_vector(double size, double out[3])
{
    double length2;
    do {
        length2 = 0;
        for (int i = 0; i < 3; i++) {
            out[i] = between(-1, 1);
            length2 += out[i] * out[i];
        }
    } while (length2 > 1 || length2 < 0.01);
    for (int i = 0; i < 3; i++)
        out[i] *= size / sqrt(length2);
}

/* The ratio of the top's radius to the base's: 0, below 1 or above 1, but not
 * so near 1 that the apex is far away. */
static double random_ratio(void)
{
    const double pick = between(0, 4);
    return pick < 1 ? 0 : pick < 2.5 ? between(0, 0.9) : between(1.1, 2);
}

static void random_shape(int kind, cylint_ends ends, cylint_shape *shape)
{
    double p[3], h[3], q[3], a[3], b[3];
    const double r = between(0.5, 2);
    const double ratio = random_ratio();

    random_vector(between(0, 5), p);
    random_vector(between(1, 4), h);
    random_vector(between(0.5, 2), a);
    random_vector(between(0.5, 2), b);
    for (int i = 0; i < 3; i++)
        q[i] = p[i] + h[i];
    switch (kind) {
    case CYLINT_KIND_CYLINDER:
        cylint_cylinder(shape, p, q, r, ends);
        break;
    case CYLINT_KIND_CONE:
        cylint_cone(shape, p, r, q, ratio * r, ends);
        break;
    case CYLINT_KIND_ACONE:
        cylint_tangent_cone(shape, p, h, between(0.3, 2), ends);
        break;
    case CYLINT_KIND_ECYLINDER:
        cylint_elliptic_cylinder(shape, p, a, b, h, ends);
        break;
    default:
        cylint_elliptic_cone(shape, p, a, b, h, ratio, ends);
    }
}

/* A line through a point near the shape: about half of the lines hit it. */
static void random_line(const cylint_shape *shape, cylint_line *line)
{
    double o[3], d[3], off[3], target[3];
    const double z = between(-0.3, 1.3), speed = between(0.1, 10);

    random_vector(between(0, 2), off);
    random_vector(between(5, 10), o);
    for (int i = 0; i < 3; i++) {
        target[i] = cylint_base(shape)[i] + z * cylint_axis(shape)[i] + off[i];
        o[i] += cylint_base(shape)[i];
        d[i] = speed * (target[i] - o[i]) / 10;
    }
    switch ((int)between(0, 4)) {
    case 0:
        cylint_whole_line(line, o, d);
        break;
    case 1:
        cylint_ray(line, o, d);
        break;
    case 2:
        cylint_segment(line, o, target);
        break;
    default:
        cylint_span(line, o, d, between(-20, 0), between(0, 20) / speed);
    }
}

/* ----------------------------------------------------------- reference -- */

/* A point in the shape's coordinates: off[] is the offset from the axis in
 * units in which the lateral surface is |off| = |rho|. */
typedef struct place {
    real off[3], z, rho;
} place;

static real determinant(const real m[3][3])
{
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

static int is_elliptic(const cylint_shape *shape)
{
    return shape->kind == CYLINT_KIND_ECYLINDER ||
           shape->kind == CYLINT_KIND_ECONE;
}

/* The place of a vector from the base; rho without its constant term. */
static place place_of_vector(const cylint_shape *shape, const real D[3])
{
    place at = {{0, 0, 0}, 0, 0};
    const double *h = cylint_axis(shape);

    if (is_elliptic(shape)) { /* Cramer: D = x a + y b + z h */
        const double *column[3] = {cylint_a(shape), cylint_b(shape), h};
        real m[3][3], x[3];
        for (int i = 0; i < 9; i++)
            m[i / 3][i % 3] = column[i / 3][i % 3];
        const real det = determinant((const real(*)[3])m);
        for (int i = 0; i < 3; i++) {
            real n[3][3];
            memcpy(n, m, sizeof n);
            memcpy(n[i], D, sizeof n[i]);
            x[i] = determinant((const real(*)[3])n) / det;
        }
        at.off[0] = x[0];
        at.off[1] = x[1];
        at.z = x[2];
        at.rho = (cylint_r1(shape) - 1.0L) * at.z;
        return at;
    }
    real hh = 0, hD = 0;
    for (int i = 0; i < 3; i++) {
        hh += (real)h[i] * h[i];
        hD += h[i] * D[i];
    }
    at.z = hD / hh;
    for (int i = 0; i < 3; i++)
        at.off[i] = D[i] - at.z * h[i];
    at.rho = shape->kind == CYLINT_KIND_ACONE
                 ? cylint_r1(shape) * sqrtl(hh) * at.z
                 : ((real)cylint_r1(shape) - cylint_r0(shape)) * at.z;
    return at;
}

static place place_of_point(const cylint_shape *shape, const real p[3])
{
    real D[3];
    for (int i = 0; i < 3; i++)
        D[i] = p[i] - cylint_base(shape)[i];
    place at = place_of_vector(shape, D);
    at.rho += is_elliptic(shape) ? 1 : cylint_r0(shape);
    return at;
}

static int bounded(const cylint_shape *shape)
{
    return shape->ends != CYLINT_ENDS_INFINITE &&
           shape->ends != CYLINT_ENDS_NAPPE;
}

/* Negative inside the lateral surface of both nappes. */
static real excess(const place *at)
{
    return at->off[0] * at->off[0] + at->off[1] * at->off[1] +
           at->off[2] * at->off[2] - at->rho * at->rho;
}

static int inside_at(const cylint_shape *shape, const cylint_line *line, real t)
{
    real p[3];
    for (int i = 0; i < 3; i++)
        p[i] = line->o[i] + t * line->d[i];
    const place at = place_of_point(shape, p);
    if (!(excess(&at) < 0))
        return 0;
    if (shape->ends != CYLINT_ENDS_INFINITE && at.rho < 0)
        return 0;
    return !bounded(shape) || (at.z > 0 && at.z < 1);
}

typedef struct event {
    real t;
    int part;
} event;

/* The parameters at which inside and outside can change, ascending.  Returns -1
 * if the case is ill-conditioned: nearly tangent or nearly along a ruling. */
static int events(const cylint_shape *shape, const cylint_line *line,
                  event e[4])
{
    real o[3], d[3], A, B, C;
    int n = 0;

    for (int i = 0; i < 3; i++) {
        o[i] = line->o[i];
        d[i] = line->d[i];
    }
    const place p = place_of_point(shape, o), v = place_of_vector(shape, d);
    A = excess(&v);
    C = excess(&p);
    B = -p.rho * v.rho;
    for (int i = 0; i < 3; i++)
        B += p.off[i] * v.off[i];
    const real disc = B * B - A * C;
    if (fabsl(A) < 1e-2L * (A + 2 * v.rho * v.rho) ||
        fabsl(disc) < 1e-2L * B * B)
        return -1;
    if (disc > 0) {
        const real q = -(B + (B < 0 ? -sqrtl(disc) : sqrtl(disc)));
        e[n++] = (event){q / A, CYLINT_PART_LATERAL};
        e[n++] = (event){C / q, CYLINT_PART_LATERAL};
    }
    if (bounded(shape)) {
        e[n++] = (event){-p.z / v.z, CYLINT_PART_CAP0};
        e[n++] = (event){(1 - p.z) / v.z, CYLINT_PART_CAP1};
    }
    for (int i = 1; i < n; i++)
        for (int j = i; j > 0 && e[j].t < e[j - 1].t; j--) {
            const event swap = e[j];
            e[j] = e[j - 1];
            e[j - 1] = swap;
        }
    for (int i = 1; i < n; i++)
        if (e[i].t - e[i - 1].t < 1e-3L * (1 + fabsl(e[i].t)))
            return -1;
    return n;
}

/* Writes the answer; returns 0 if the case is not well-conditioned. */
static int reference(const cylint_shape *shape, const cylint_line *line,
                     cylint_answer *want, real t[2])
{
    event e[4];
    const int n = events(shape, line, e);
    int before, after;

    if (n < 0)
        return 0;
    want->relation = CYLINT_RELATION_MISS;
    want->n = 0;
    if (n == 0)
        return 1;
    before = inside_at(shape, line, e[0].t - 1);
    for (int i = 0; i < n; i++, before = after) {
        const real next = i + 1 < n ? (e[i].t + e[i + 1].t) / 2 : e[i].t + 1;
        after = inside_at(shape, line, next);
        if (before || after)
            want->relation = CYLINT_RELATION_CROSS;
        if (fabsl(e[i].t - line->tmin) < 1e-6L ||
            fabsl(e[i].t - line->tmax) < 1e-6L)
            return 0;
        const int open =
            shape->ends == CYLINT_ENDS_OPEN ||
            (e[i].part == CYLINT_PART_CAP0 &&
             shape->ends == CYLINT_ENDS_CAP1) ||
            (e[i].part == CYLINT_PART_CAP1 && shape->ends == CYLINT_ENDS_CAP0);
        if (before == after || (open && e[i].part != CYLINT_PART_LATERAL) ||
            e[i].t < line->tmin || e[i].t > line->tmax)
            continue;
        want->hit[want->n].part = e[i].part;
        want->hit[want->n].side =
            after ? CYLINT_SIDE_ENTERING : CYLINT_SIDE_LEAVING;
        t[want->n++] = e[i].t;
    }
    return 1;
}

/* ----------------------------------------------------------- agreement -- */

/* The change in local coordinates on a step along `direction`. */
static real change(const cylint_shape *shape, const cylint_hit *hit,
                   const real direction[3], int part)
{
    const real step = 1e-5L;
    real p[3], m[3];
    for (int i = 0; i < 3; i++) {
        p[i] = hit->point[i] + step * direction[i];
        m[i] = hit->point[i] - step * direction[i];
    }
    const place a = place_of_point(shape, p), b = place_of_point(shape, m);
    if (part == CYLINT_PART_LATERAL)
        return (excess(&a) - excess(&b)) / (2 * step);
    return (part == CYLINT_PART_CAP1 ? a.z - b.z : b.z - a.z) / (2 * step);
}

/* Whether the normal is the direction of the gradient, z and the point agree
 * with t, and phi is the angle of the hit. */
static int members_agree(const cylint_shape *shape, const cylint_line *line,
                         const cylint_hit *hit)
{
    real gradient[3], size = 0, along = 0, p[3];
    int good = 1;

    for (int i = 0; i < 3; i++) {
        const real direction[3] = {i == 0, i == 1, i == 2};
        gradient[i] = change(shape, hit, direction, hit->part);
        size += gradient[i] * gradient[i];
        along += gradient[i] * hit->normal[i];
        p[i] = line->o[i] + (real)hit->t * line->d[i];
        good = good && fabsl(p[i] - hit->point[i]) < 1e-12L;
    }
    good = good && fabsl(along / sqrtl(size) - 1) < 1e-9L;
    const place at = place_of_point(shape, p);
    good = good && fabsl(at.z - hit->z) < 1e-9L;
    if (is_elliptic(shape)) {
        const real turn = 2 * acosl(-1) * hit->phi;
        const real off = hypotl(at.off[0], at.off[1]);
        good = good && fabsl(off * cosl(turn) - at.off[0]) < 1e-9L &&
               fabsl(off * sinl(turn) - at.off[1]) < 1e-9L;
    }
    return good && hit->phi >= 0 && hit->phi < 1;
}

static real worst; /* relative difference in t of this method */

static int same_answer(const cylint_shape *shape, const cylint_line *line,
                       const cylint_answer *got, const cylint_answer *want,
                       const real t[2])
{
    if (got->relation != want->relation || got->n != want->n || got->flags)
        return 0;
    for (int i = 0; i < got->n; i++) {
        const cylint_hit *g = &got->hit[i];
        const real apart = fabsl(g->t - t[i]) / (1 + fabsl(t[i]));
        if (g->part != want->hit[i].part || g->side != want->hit[i].side ||
            !(apart <= AGREEMENT) || !members_agree(shape, line, g))
            return 0;
        if (apart > worst)
            worst = apart;
    }
    return 1;
}

static void compare(const cylint_method *method, int kind, int ends)
{
    cylint_shape shape;
    cylint_line line;
    cylint_answer got, want;
    real t[2];
    int hits = 0, compared = 0;

    for (int i = 0; i < TRIALS; i++) {
        random_shape(kind, (cylint_ends)ends, &shape);
        random_line(&shape, &line);
        if (!reference(&shape, &line, &want, t))
            continue;
        compared++;
        CHECK(method->answer(&shape, &line, CYLINT_WANT_ALL, &got) ==
              CYLINT_OK);
        hits += got.n;
        if (!CHECK(same_answer(&shape, &line, &got, &want, t)))
            report_case(method->name, &shape, &line);
    }
    if (!CHECK(compared > TRIALS / 4 && hits > TRIALS / 8))
        REPORT("%s, kind %d ends %d: %d compared, %d hits", method->name, kind,
               ends, compared, hits);
}

static void every_method_agrees_with_long_double(void)
{
    for (const cylint_method *m = cylint_methods(); m->name; m++) {
        worst = 0;
        for (int kind = CYLINT_KIND_CYLINDER; kind <= CYLINT_KIND_ECONE; kind++)
            for (int ends = CYLINT_ENDS_CAPPED; ends <= CYLINT_ENDS_NAPPE;
                 ends++)
                if (answers_for(m->name, kind, ends))
                    compare(m, kind, ends);
        printf("note: %s: t within %.1Le of the reference\n", m->name, worst);
    }
}

/* phi jumps from 1 to 0. */
static int same_turn(double a, double b)
{
    const double apart = fabs(a - b);
    return apart < 1e-9 || 1 - apart < 1e-9;
}

static void members_of_hits_agree_with_the_library(void)
{
    cylint_shape shape;
    cylint_line line;
    cylint_answer got, want;
    real t[2];

    for (int i = 0; i < TRIALS; i++) {
        random_shape(1 + i % 5, (cylint_ends)(i / 5 % 6), &shape);
        random_line(&shape, &line);
        if (!reference(&shape, &line, &got, t))
            continue;
        cylint_quadratic(&shape, &line, CYLINT_WANT_ALL, &got);
        cylint_intersect(&shape, &line, CYLINT_WANT_ALL, &want);
        int good = got.relation == want.relation && got.n == want.n;
        for (int k = 0; good && k < got.n; k++) {
            const cylint_hit *g = &got.hit[k], *w = &want.hit[k];
            good = g->part == w->part && g->side == w->side &&
                   fabs(g->t - w->t) <= 1e-9 * (1 + fabs(w->t)) &&
                   fabs(g->z - w->z) <= 1e-9 && same_turn(g->phi, w->phi);
            for (int j = 0; good && j < 3; j++)
                good = fabs(g->point[j] - w->point[j]) <= 1e-9 &&
                       fabs(g->normal[j] - w->normal[j]) <= 1e-9;
        }
        if (!CHECK(good))
            report_case("quadratic", &shape, &line);
    }
}

static void a_method_refuses_shapes_that_it_is_not_published_for(void)
{
    cylint_shape shape;
    cylint_line line;
    cylint_answer answer;
    int refused = 0;

    for (const cylint_method *m = cylint_methods(); m->name; m++)
        for (int kind = CYLINT_KIND_CYLINDER; kind <= CYLINT_KIND_ECONE; kind++)
            for (int ends = CYLINT_ENDS_CAPPED; ends <= CYLINT_ENDS_NAPPE;
                 ends++) {
                if (answers_for(m->name, kind, ends))
                    continue;
                random_shape(kind, (cylint_ends)ends, &shape);
                random_line(&shape, &line);
                CHECK(m->answer(&shape, &line, CYLINT_WANT_ALL, &answer) ==
                      CYLINT_EMETHOD);
                CHECK(answer.relation == CYLINT_RELATION_MISS &&
                      answer.n == 0 && answer.flags == CYLINT_FLAG_INVALID);
                refused++;
            }
    CHECK(refused == 28 + 28 + 18 + 24 + 24);
}

static void refused_shapes_and_lines_miss_with_the_flag(void)
{
    const double o[3] = {0, 0, 0}, up[3] = {0, 0, 1}, x[3] = {1, 0, 0};
    cylint_shape good, cone, bad;
    cylint_line line, no_line;
    cylint_answer answer;

    cylint_cylinder(&good, o, up, 1, CYLINT_ENDS_INFINITE);
    cylint_tangent_cone(&cone, o, up, 1, CYLINT_ENDS_INFINITE);
    CHECK(cylint_cylinder(&bad, o, o, 1, CYLINT_ENDS_INFINITE) == CYLINT_EAXIS);
    cylint_whole_line(&line, o, x);
    CHECK(cylint_whole_line(&no_line, o, o) == CYLINT_EDIRECTION);
    for (const cylint_method *m = cylint_methods(); m->name; m++) {
        const cylint_shape *shape =
            answers_for(m->name, CYLINT_KIND_CYLINDER, CYLINT_ENDS_INFINITE)
                ? &good
                : &cone;
        CHECK(m->answer(shape, &no_line, CYLINT_WANT_ALL, &answer) ==
              CYLINT_OK);
        CHECK(answer.relation == CYLINT_RELATION_MISS && answer.n == 0 &&
              answer.flags == CYLINT_FLAG_INVALID);
        CHECK(m->answer(&bad, &line, CYLINT_WANT_ALL, &answer) ==
              CYLINT_EMETHOD);
        CHECK(answer.flags == CYLINT_FLAG_INVALID && answer.n == 0);
    }
}

static void the_table_names_each_method_once(void)
{
    int n = 0;
    for (const cylint_method *m = cylint_methods(); m->name; m++, n++) {
        CHECK(m->answer && m->source[0] && m->shapes[0]);
        for (const cylint_method *k = cylint_methods(); k != m; k++)
            CHECK(strcmp(k->name, m->name) && k->answer != m->answer);
    }
    CHECK(n == 6);
}

int main(void)
{
    printf("note: seed %u\n", SEED);
    RUN(every_method_agrees_with_long_double);
    RUN(members_of_hits_agree_with_the_library);
    RUN(a_method_refuses_shapes_that_it_is_not_published_for);
    RUN(refused_shapes_and_lines_miss_with_the_flag);
    RUN(the_table_names_each_method_once);
    return check_end();
}
