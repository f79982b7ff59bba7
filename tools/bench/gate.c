/*
 * gate.c - one hash of all answers, for each kind of question and all kernels
 *
 *     gate [CASES [SEED]]
 *
 * CASES cases of every family (512).  A line has the kernels, the question and the
 * hash; the kernels must agree, else the exit status is 1.  The program uses the
 * public interface only, so that gate.sh can link it with the library of another
 * commit, whose hashes must be the same.
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cylint.h"
#include "cylint_distance.h"
#include "families.h"

enum question {
    ONE,      /* relation, n, t, part, side, whatever is wanted; occluded */
    MEMBERS,  /* point, normal, z, phi */
    CONTAINS, /* of origins */
    LINES,    /* many lines, one shape */
    SHAPES,   /* one line, a pack: columns, nearest, count */
    IN_PAIRS, /* line i, shape i */
    DISTANCE, /* of origins: all members, and the safety */
    POINTS,   /* the distances of many origins from one shape */
    QUESTIONS
};

static const char *const names[QUESTIONS] = {"one",      "members", "contains",
                                             "lines",    "shapes",  "pairs",
                                             "distance", "points"};

enum { FEW = 12 }; /* shapes or lines that meet all others */

/* ---------------------------------------------------------------- hashes -- */

/* FNV-1a. */
static void add_bytes(uint64_t *hash, const void *data, size_t n)
{
    const unsigned char *byte = data;
    for (size_t i = 0; i < n; i++)
        *hash = (*hash ^ byte[i]) * UINT64_C(0x100000001b3);
}

static void add_int(uint64_t *hash, int64_t x)
{
    add_bytes(hash, &x, sizeof x);
}

/* All NaN are one. */
static void add_double(uint64_t *hash, double x)
{
    if (x != x)
        add_int(hash, -1);
    else
        add_bytes(hash, &x, sizeof x);
}

/* --------------------------------------------------------------- answers -- */

/* The cases of one family. */
struct cases {
    size_t n;
    cylint_shape *shape;
    cylint_line *line;
    double *column[8]; /* o, d, tmin, tmax */
    cylint_lines lines;
    cylint_pack pack;
    void *memory;
    signed char *byte[4];
    double *t[2];
};

static void add_answer(uint64_t *hash, const cylint_answer *a, unsigned want)
{
    add_int(hash, a->relation);
    add_int(hash, a->n);
    for (int i = 0; i < a->n; i++) {
        if (want & CYLINT_WANT_T)
            add_double(hash, a->hit[i].t);
        if (want & CYLINT_WANT_PART)
            add_int(hash, 4 * a->hit[i].part + a->hit[i].side);
    }
}

static void hash_one(const struct cases *c, uint64_t *hash)
{
    static const unsigned few[] = {0, CYLINT_WANT_T, CYLINT_WANT_PART,
                                   CYLINT_WANT_T | CYLINT_WANT_PART};
    for (size_t i = 0; i < c->n; i++) {
        for (int k = 0; k < 8; k++) {
            const unsigned want =
                few[k / 2] | (k % 2 ? CYLINT_WANT_NEAREST : 0);
            cylint_answer a;
            cylint_intersect(&c->shape[i], &c->line[i], want, &a);
            add_answer(hash, &a, want);
        }
        add_int(hash, cylint_occluded(&c->shape[i], &c->line[i]));
    }
}

static void hash_members(const struct cases *c, uint64_t *hash)
{
    for (size_t i = 0; i < c->n; i++) {
        cylint_answer a;
        cylint_intersect(&c->shape[i], &c->line[i], CYLINT_WANT_ALL, &a);
        add_answer(hash, &a, CYLINT_WANT_ALL);
        for (int k = 0; k < a.n; k++) {
            for (int j = 0; j < 3; j++) {
                add_double(hash, a.hit[k].point[j]);
                add_double(hash, a.hit[k].normal[j]);
            }
            add_double(hash, a.hit[k].z);
            add_double(hash, a.hit[k].phi);
        }
    }
}

static void hash_contains(const struct cases *c, uint64_t *hash)
{
    for (size_t i = 0; i < c->n; i++)
        add_int(hash, cylint_contains(&c->shape[i], c->line[i].o));
}

/* which: bits of columns. */
static cylint_columns some_columns(const struct cases *c, unsigned which)
{
    return (cylint_columns){.relation = which & 1 ? c->byte[0] : NULL,
                            .n = which & 2 ? c->byte[1] : NULL,
                            .t0 = which & 4 ? c->t[0] : NULL,
                            .t1 = which & 8 ? c->t[1] : NULL,
                            .part0 = which & 16 ? c->byte[2] : NULL,
                            .part1 = which & 32 ? c->byte[3] : NULL};
}

static const unsigned columns_wanted[] = {63, 1, 2, 4, 12, 16, 5};
enum { WANTED = sizeof columns_wanted / sizeof *columns_wanted };

static void add_columns(const struct cases *c, unsigned which, uint64_t *hash)
{
    const signed char *const bytes[] = {c->byte[0], c->byte[1], c->byte[2],
                                        c->byte[3]};
    static const unsigned bit[] = {1, 2, 16, 32};
    for (int k = 0; k < 4; k++)
        if (which & bit[k])
            add_bytes(hash, bytes[k], c->n);
    for (int k = 0; k < 2; k++)
        for (size_t i = 0; which & 4u << k && i < c->n; i++)
            add_double(hash, c->t[k][i]);
}

static void hash_lines(const struct cases *c, uint64_t *hash)
{
    for (size_t i = 0; i < FEW && i < c->n; i++)
        for (int k = 0; k < WANTED; k++) {
            const cylint_columns to = some_columns(c, columns_wanted[k]);
            cylint_intersect_lines(&c->shape[i], &c->lines, &to);
            add_columns(c, columns_wanted[k], hash);
        }
}

static void hash_shapes(const struct cases *c, uint64_t *hash)
{
    for (size_t i = 0; i < FEW && i < c->n; i++) {
        cylint_hit hit = {0};
        for (int k = 0; k < WANTED; k++) {
            const cylint_columns to = some_columns(c, columns_wanted[k]);
            cylint_intersect_shapes(&c->pack, &c->line[i], &to);
            add_columns(c, columns_wanted[k], hash);
        }
        const size_t best = cylint_nearest(
            &c->pack, &c->line[i], CYLINT_WANT_T | CYLINT_WANT_PART, &hit);
        add_int(hash, (int64_t)best);
        add_double(hash, hit.t);
        add_int(hash, 4 * hit.part + hit.side);
        add_int(hash, (int64_t)cylint_count(&c->pack, &c->line[i], 0));
        add_int(hash, (int64_t)cylint_count(&c->pack, &c->line[i], 1));
    }
}

static void hash_pairs(const struct cases *c, uint64_t *hash)
{
    for (int k = 0; k < WANTED; k++) {
        const cylint_columns to = some_columns(c, columns_wanted[k]);
        cylint_intersect_pairs(&c->pack, &c->lines, &to);
        add_columns(c, columns_wanted[k], hash);
    }
}

static void hash_distance(const struct cases *c, uint64_t *hash)
{
    for (size_t i = 0; i < c->n; i++) {
        cylint_closest a = {0};
        add_double(hash, cylint_distance(&c->shape[i], c->line[i].o,
                                         CYLINT_WANT_PART | CYLINT_WANT_POINT |
                                             CYLINT_WANT_NORMAL,
                                         &a));
        add_int(hash, 16 * a.part + a.feature);
        for (int j = 0; j < 3; j++) {
            add_double(hash, a.point[j]);
            add_double(hash, a.normal[j]);
        }
        add_double(hash, cylint_safety(&c->shape[i], c->line[i].o));
    }
}

static void hash_points(const struct cases *c, uint64_t *hash)
{
    const cylint_points points = {c->n,
                                  {c->column[0], c->column[1], c->column[2]}};
    const cylint_closest_columns to = {
        .distance = c->t[0], .part = c->byte[0], .feature = c->byte[1]};
    for (size_t i = 0; i < FEW && i < c->n; i++) {
        cylint_distance_points(&c->shape[i], &points, &to);
        for (size_t k = 0; k < c->n; k++)
            add_double(hash, c->t[0][k]);
        add_bytes(hash, c->byte[0], c->n);
        add_bytes(hash, c->byte[1], c->n);
    }
}

typedef void hash_answers(const struct cases *c, uint64_t *hash);
static hash_answers *const hashes[QUESTIONS] = {
    hash_one,    hash_members, hash_contains, hash_lines,
    hash_shapes, hash_pairs,   hash_distance, hash_points};

/* ----------------------------------------------------------------- cases -- */

static void *allocate(size_t n)
{
    void *memory = malloc(n);
    if (!memory) {
        fputs("gate: out of memory\n", stderr);
        exit(4);
    }
    return memory;
}

static void make_room(struct cases *c, size_t n)
{
    c->n = n;
    c->shape = allocate(n * sizeof *c->shape);
    c->line = allocate(n * sizeof *c->line);
    for (int k = 0; k < 8; k++)
        c->column[k] = allocate(n * sizeof(double));
    for (int k = 0; k < 4; k++)
        c->byte[k] = allocate(n);
    for (int k = 0; k < 2; k++)
        c->t[k] = allocate(n * sizeof(double));
    c->memory = allocate(cylint_pack_bytes(n));
    c->lines = (cylint_lines){n,
                              {c->column[0], c->column[1], c->column[2]},
                              {c->column[3], c->column[4], c->column[5]},
                              c->column[6],
                              c->column[7]};
}

static void draw(struct cases *c, uint64_t seed, int family)
{
    for (size_t i = 0; i < c->n; i++) {
        struct family_case one;
        family_case(seed, family, i, &one);
        c->shape[i] = one.shape;
        c->line[i] = one.line;
        for (int k = 0; k < 3; k++) {
            c->column[k][i] = one.line.o[k];
            c->column[3 + k][i] = one.line.d[k];
        }
        c->column[6][i] = one.line.tmin;
        c->column[7][i] = one.line.tmax;
    }
    cylint_pack_shapes(&c->pack, c->memory, c->shape, c->n);
}

int main(int argc, char **argv)
{
    const size_t n = argc > 1 ? (size_t)strtoul(argv[1], NULL, 10) : 512;
    const uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
    struct cases c;
    int builds = 0, differ = 0;
    while (cylint_kernels_name(builds))
        builds++;
    make_room(&c, n);
    for (int family = 0; family < family_count(); family++) {
        draw(&c, seed, family);
        for (int q = 0; q < QUESTIONS; q++) {
            uint64_t first = 0;
            for (int build = 0; build < builds; build++) {
                uint64_t hash = UINT64_C(0xcbf29ce484222325);
                cylint_use_kernels(cylint_kernels_name(build));
                hashes[q](&c, &hash);
                if (build == 0)
                    first = hash;
                if (hash == first)
                    continue;
                differ = 1;
                printf("DIFFERS: kernels %s\n", cylint_kernels_name(build));
            }
            printf("%-26s %-9s %016llx\n", family_name(family), names[q],
                   (unsigned long long)first);
        }
    }
    return differ;
}
