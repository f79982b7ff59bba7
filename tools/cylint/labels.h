/*
 * labels.h - the tails of a scene's lines, which are the labels of its shapes,
 * and groups of shapes: those that a record leaves out, ranks, columns of sums
 *
 * By label, a group is all shapes whose labels begin with the same field, its
 * name. By number, each shape is a group.
 */
#ifndef CYLINT_LABELS_H
#define CYLINT_LABELS_H

#include "cylint_scene.h"
#include "grammar.h"
#include "text.h"

/* The labels of shapes.  Zero it before use. */
struct labels {
    struct texts texts;        /* of a scene that is read */
    size_t longest;            /* bytes of the longest label */
    cylint_scene_labels table; /* the labels; end is NULL if there are none */
};

/* Adds the label of the next shape.  Returns 0, or an exit status after a
 * message. */
int labels_add(struct labels *labels, struct string label);
/* Uses the labels of a scene that was opened from `file`, without a copy.
 * Returns 0, or an exit status after a message. */
int labels_use(struct labels *labels, const cylint_scene *scene,
               const char *file);
void labels_free(struct labels *labels);

/* The label of a shape, counted from 0.  Its length is 0 if there is none. */
struct string labels_get(const struct labels *labels, size_t shape);

/* --------------------------------------------------------------- groups -- */

/* Zero it before use. */
struct groups {
    size_t shapes;
    struct names names; /* by label: those of the groups */
    int *group_of;      /* by label: the group of each shape; NULL: by number */
    size_t columns;     /* by label: the number of groups, but at least 1 */
    int is_total;       /* one column for all */
    int *rank;          /* of each shape; NULL: all have the same */
};

/* Groups the shapes by label.  Returns 0, or an exit status after a message. */
int groups_make(struct groups *groups, const struct labels *labels,
                int is_total);
/* Reads the ranks of groups from a file. */
int groups_read_ranks(struct groups *groups, const char *file);
void groups_free(struct groups *groups);

enum { LEFT_OUT_MOST = 64 };

/* The groups that a record leaves out, without repetition. */
struct left_out {
    int count;
    size_t group[LEFT_OUT_MOST];
};

/* Reads a record's words not=NAME.  Returns 0, or EXIT_BAD and writes a
 * note.  A label that no shape has is a remark. */
int left_out_read(struct left_out *left_out, const struct groups *groups,
                  int by_label, struct string words, struct notes *notes);

/* Whether the group is left out. */
int left_out_has(const struct left_out *left_out, size_t group);

#endif
