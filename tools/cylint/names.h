/*
 * names.h - the names of shapes: their ranks, and their columns of sums
 *
 * The name of a shape is the first field of its label.
 */
#ifndef CYLINT_NAMES_H
#define CYLINT_NAMES_H

#include "labels.h"

/* Zero it before use. */
struct names {
    const struct labels *labels;
    int *rank;     /* of each shape; NULL: all have the same */
    int *column;   /* of each shape, for sums; NULL: there are no sums */
    size_t *shape; /* of each column, the first shape with this name */
    size_t columns;
};

/* rank_file: NULL if there is none.  Returns 0, or an exit status after a
 * message. */
int names_make(struct names *names, const struct labels *labels, size_t shapes,
               const char *rank_file, int has_sums);
void names_free(struct names *names);

/* The name of a column, in the order in which names first appear in the scene.
 * Its length is 0 if the shapes have no label. */
struct label names_of_column(const struct names *names, size_t column);

#endif
