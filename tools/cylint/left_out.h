/*
 * left_out.h - shapes that a record leaves out: not=NUMBER or not=LABEL
 *
 * A word not=NAME names a group.  By number each shape is a group.  By label a
 * group is all shapes whose labels begin with the same field.
 */
#ifndef CYLINT_LEFT_OUT_H
#define CYLINT_LEFT_OUT_H

#include "grammar.h"
#include "labels.h"

struct groups {
    size_t shapes;
    const struct labels *labels; /* NULL: by number */
    size_t *order; /* by label: the shapes, those of a group together */
    size_t *first; /* by label: where in order[] a shape's group begins */
};

/* Zero *groups before use.  labels: NULL means by number.  Returns 0, or an exit
 * status after a message. */
int groups_make(struct groups *groups, size_t shapes,
                const struct labels *labels);
void groups_free(struct groups *groups);

/* The first field of a shape's label. */
struct label groups_name(const struct labels *labels, size_t shape);
/* By label: the group with this name, or `shapes` if there is none. */
size_t groups_find(const struct groups *groups, struct label name);

enum { LEFT_OUT_MOST = 64 };

/* The groups that a record leaves out, without repetition. */
struct left_out {
    const struct groups *groups;
    int count;
    size_t group[LEFT_OUT_MOST]; /* a shape, or an index into groups->order */
};

/* Reads a record's words not=NAME.  Returns 1, or 0 and writes *fault.  A label
 * that no shape has is a remark. */
int left_out_read(struct left_out *left_out, const struct groups *groups,
                  const char *words, size_t length, struct remarks *remarks,
                  struct fault *fault);

int left_out_has(const struct left_out *left_out, size_t shape);

#endif
