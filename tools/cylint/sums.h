/*
 * sums.h - rows of sums of lengths, one column for each name of shapes
 */
#ifndef CYLINT_SUMS_H
#define CYLINT_SUMS_H

#include "columns.h"
#include "names.h"

/* The largest length of a row or of the header in bytes, without the tail. */
size_t sums_capacity(const struct names *names, const struct style *style);

void put_sums(struct text *out, const struct names *names,
              const struct style *style, const double *sums,
              const struct row *row);
/* `error` and missing values, for a bad record. */
void put_sums_error(struct text *out, const struct names *names,
                    const struct style *style);
void put_sums_header(struct text *out, const struct names *names,
                     const struct style *style);

#endif
