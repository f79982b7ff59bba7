/*
 * batch_layout.h - batches whose arrays lie between guard pages
 *
 * Each array has guard pages of its own, so that every address can be tested at
 * both of them.  Inputs become read-only after they are written.
 */
#ifndef CYLINT_BATCH_LAYOUT_H
#define CYLINT_BATCH_LAYOUT_H

#include "cylint.h"
#include "families.h"
#include "guarded.h"

enum {
    MOST = 600,                    /* lines or shapes in a batch */
    HIT_COLUMNS = 8,               /* of point, normal, z and phi */
    COLUMNS = 6 + 2 * HIT_COLUMNS, /* in the order of cylint_columns */
    WITHOUT_MEMBERS = 63,
    ALL_COLUMNS = (1 << COLUMNS) - 1
};

/* The places of the arrays, and which of them are present. */
struct layout {
    size_t offset; /* bytes from a guard page, 0 to 63 */
    int at_end;    /* from the upper guard page */
    int columns;   /* a bit for each member of cylint_columns */
    int domain;    /* bits: 1 tmin is present, 2 tmax is present */
};

static const struct layout usual = {0, 1, ALL_COLUMNS, 3};
static const struct layout without_members = {0, 1, WITHOUT_MEMBERS, 3};

static struct guarded line_pages[8], answer_pages[COLUMNS], shape_pages,
    pack_pages;

static size_t answer_size(int i)
{
    return i == 2 || i == 3 || i >= 6 ? sizeof(double) : 1;
}

static void allocate_pages(void)
{
    for (int i = 0; i < 8; i++)
        line_pages[i] = guarded_allocate(MOST * sizeof(double));
    for (int i = 0; i < COLUMNS; i++)
        answer_pages[i] = guarded_allocate(MOST * answer_size(i));
    shape_pages = guarded_allocate(MOST * sizeof(cylint_shape));
    pack_pages = guarded_allocate(cylint_pack_bytes(MOST));
}

/* The gap of array i, a multiple of `size`; no two arrays have the same. */
static size_t gap_of(const struct layout *at, int i, size_t size)
{
    return (at->offset + (size_t)i * size) % (64 / size) * size;
}

/* Packs shapes; returns whether only the pack's own memory was written. */
static int lay_pack(cylint_pack *pack, const struct family_case *shapes,
                    size_t n, const struct layout *at)
{
    const size_t bytes = cylint_pack_bytes(n);
    cylint_shape *to = guarded_place(&shape_pages, n * sizeof *to,
                                     gap_of(at, 3, sizeof(double)), at->at_end);
    for (size_t i = 0; i < n; i++)
        to[i] = shapes[i].shape;
    guarded_permit(&shape_pages, 0);
    char *memory = guarded_place(&pack_pages, bytes, at->offset, at->at_end);
    cylint_pack_shapes(pack, memory, to, n);
    guarded_permit(&pack_pages, 0);
    return guarded_kept(&pack_pages, memory, bytes);
}

static void lay_lines(cylint_lines *lines, const struct family_case *from,
                      size_t n, const struct layout *at)
{
    double *array[8];
    for (int i = 0; i < 8; i++)
        array[i] = guarded_place(&line_pages[i], n * sizeof(double),
                                 gap_of(at, i, sizeof(double)), at->at_end);
    for (size_t i = 0; i < n; i++) {
        const cylint_line *l = &from[i].line;
        for (int k = 0; k < 3; k++) {
            array[k][i] = l->o[k];
            array[3 + k][i] = l->d[k];
        }
        array[6][i] = l->tmin;
        array[7][i] = l->tmax;
    }
    for (int i = 0; i < 8; i++)
        guarded_permit(&line_pages[i], 0);
    *lines = (cylint_lines){n,
                            {array[0], array[1], array[2]},
                            {array[3], array[4], array[5]},
                            at->domain & 1 ? array[6] : NULL,
                            at->domain & 2 ? array[7] : NULL};
}

static void lay_answers(cylint_columns *to, size_t n, const struct layout *at)
{
    void *p[COLUMNS];
    for (int i = 0; i < COLUMNS; i++) {
        p[i] = guarded_place(&answer_pages[i], n * answer_size(i),
                             gap_of(at, i, answer_size(i)), at->at_end);
        if (!(at->columns >> i & 1))
            p[i] = NULL;
    }
    *to = (cylint_columns){p[0],
                           p[1],
                           p[2],
                           p[3],
                           p[4],
                           p[5],
                           .point0 = {p[6], p[7], p[8]},
                           .normal0 = {p[9], p[10], p[11]},
                           .z0 = p[12],
                           .phi0 = p[13],
                           .point1 = {p[14], p[15], p[16]},
                           .normal1 = {p[17], p[18], p[19]},
                           .z1 = p[20],
                           .phi1 = p[21]};
}

/* The columns of the members of hit k. */
static void hit_columns(const cylint_columns *from, int k,
                        double *to[HIT_COLUMNS])
{
    double *const *point = k ? from->point1 : from->point0;
    double *const *normal = k ? from->normal1 : from->normal0;
    for (int i = 0; i < 3; i++) {
        to[i] = point[i];
        to[3 + i] = normal[i];
    }
    to[6] = k ? from->z1 : from->z0;
    to[7] = k ? from->phi1 : from->phi0;
}

/* Whether only the answers were written. */
static int only_answers_written(const cylint_columns *a, size_t n)
{
    double *members[2][HIT_COLUMNS];
    const void *p[COLUMNS] = {a->relation, a->n,     a->t0,
                              a->t1,       a->part0, a->part1};
    for (int k = 0; k < 2; k++) {
        hit_columns(a, k, members[k]);
        for (int i = 0; i < HIT_COLUMNS; i++)
            p[6 + k * HIT_COLUMNS + i] = members[k][i];
    }
    int kept = 1;
    for (int i = 0; i < COLUMNS; i++)
        kept &=
            guarded_kept(&answer_pages[i], p[i], p[i] ? n * answer_size(i) : 0);
    return kept;
}

#endif
