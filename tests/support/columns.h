/*
 * columns.h - lines and answers of batches, as arrays
 */
#ifndef CYLINT_TEST_COLUMNS_H
#define CYLINT_TEST_COLUMNS_H

#include "same.h"

enum {
    HIT_COLUMNS = 8,               /* of point, normal, z and phi */
    COLUMNS = 6 + 2 * HIT_COLUMNS, /* in the order of cylint_columns */
    ALL_COLUMNS = (1 << COLUMNS) - 1
};

/* The line as a batch reads it, with the stored direction.  domain: bits, 1:
 * tmin is present, 2: tmax is. */
static inline cylint_line column_line(const cylint_line *from, int domain)
{
    cylint_line line;
    cylint_span(&line, from->o, from->d, domain & 1 ? from->tmin : 0,
                domain & 2 ? from->tmax : HUGE_VAL);
    return line;
}

/* Writes line i to the arrays o, d, tmin, tmax. */
static inline void set_columns(const cylint_line *line, double *const array[8],
                               size_t i)
{
    for (int k = 0; k < 3; k++) {
        array[k][i] = line->o[k];
        array[3 + k][i] = line->d[k];
    }
    array[6][i] = line->tmin;
    array[7][i] = line->tmax;
}

static inline cylint_lines lines_of(double *const array[8], size_t n,
                                    int domain)
{
    return (cylint_lines){n,
                          {array[0], array[1], array[2]},
                          {array[3], array[4], array[5]},
                          domain & 1 ? array[6] : NULL,
                          domain & 2 ? array[7] : NULL};
}

static inline size_t column_size(int column)
{
    return column == 2 || column == 3 || column >= 6 ? sizeof(double) : 1;
}

/* The arrays p, in the order of cylint_columns. */
static inline cylint_columns columns_of(void *const p[COLUMNS])
{
    return (cylint_columns){p[0],
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

/* Whether element i of the arrays p is what a single question returned; NULL: not
 * wanted. */
static inline int is_column_answer(void *const p[COLUMNS], size_t i,
                                   const cylint_answer *want)
{
    for (int c = 0; c < COLUMNS; c++) {
        const int k = c < 6 ? c & 1 : c >= 6 + HIT_COLUMNS;
        const cylint_hit *h = &want->hit[k];
        const int member = c < 6 ? c : (c - 6) % HIT_COLUMNS;
        if (!p[c])
            continue;
        if (c < 2 || c / 2 == 2) {
            const int due = c == 0        ? want->relation
                            : c == 1      ? want->n
                            : k < want->n ? h->part
                                          : -1;
            if (((const signed char *)p[c])[i] != due)
                return 0;
        } else {
            const double got = ((const double *)p[c])[i];
            const double due = c < 6        ? h->t
                               : member < 3 ? h->point[member]
                               : member < 6 ? h->normal[member - 3]
                               : member < 7 ? h->z
                                            : h->phi;
            if (k < want->n ? !same_double(got, due) : got == got)
                return 0;
        }
    }
    return 1;
}

#endif
