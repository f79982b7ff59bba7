/*
 * columns.h - the columns of an answer, and how they are written
 *
 * A column is a name, a member of a row, and what a query must compute for it.
 * Each query has its own set of columns.
 */
#ifndef CYLINT_COLUMNS_H
#define CYLINT_COLUMNS_H

#include "cylint_scene.h"
#include "labels.h"
#include "text.h"

enum query {
    QUERY_PAIRS,   /* a line and a shape in every record */
    QUERY_NEAREST, /* a scene: the first shape that is hit */
    QUERY_ANY,     /* whether one is hit */
    QUERY_COUNT,   /* how many are hit */
    QUERY_ALL,     /* all that are hit, a row for each */
    QUERY_FIRST,   /* of lines only: where it enters or leaves a solid first */
    QUERY_PIECES,  /* of lines only: the pieces inside solids */
    QUERY_INSIDE, /* of points only: how many shapes or solids hold the point */
    QUERIES       /* a query of points has the same number plus QUERIES */
};

struct query_kind {
    const char *word;
    const char *fields, *point_fields; /* the columns unless -f is given */
    /* why a line, a point or not=NAME is wrong, or NULL */
    const char *no_lines, *no_points, *no_left_out;
};

extern const struct query_kind query_kinds[]; /* by enum query; then NULL */

struct column;

enum { MOST_FIELDS = 256 };

/* The columns of a row, and what they need. */
struct fields {
    const struct column *column[MOST_FIELDS];
    size_t count;
    /* of --sum, in place of column[]: a sum of each */
    const struct groups *sums;
    int label_count; /* of columns that are labels */
    int has_count;   /* a column is a count */
    int has_solids;  /* a column is about the solids that hold a point */
    unsigned want;   /* for cylint_intersect() or cylint_distance() */
};

/* How rows look. */
struct style {
    int is_binary;
    int digits; /* see cylint_write_number() */
    char separator;
    const char *missing; /* NULL: nan for a number, - for a word */
};

/* The values of a row.  answer.n gives which are missing: -1: there is no
 * answer.  A point has one hit, a piece of a line two. */
struct row {
    double record, shape, count, depth; /* whole numbers */
    double distance;                    /* of a point */
    int feature;
    double unit;  /* of pieces the length of the line's direction, else 1 */
    double *sums; /* of --sum */
    cylint_answer answer;
    struct string label; /* the shape's, if a column needs it */
    struct string tail;
};

/* Writes *fields from names separated by commas.  query: of points with
 * QUERIES added.  Returns NULL, or the first name that is not a column of
 * this query or is one too many. */
const char *find_fields(struct fields *fields, const char *names, int query);

/* The name of this query's column nearest to this one, or NULL. */
const char *similar_field(struct string name, int query);

/* Makes them the columns of --sum: one for each group of shapes, and at least
 * one. */
void sum_fields(struct fields *fields, const struct groups *groups);

/* The largest length of a row or of the header in bytes, without the tail,
 * if no label is longer than this. */
size_t row_capacity(const struct fields *fields, const struct style *style,
                    size_t longest_label);

/* row NULL: `error` and missing values, for a bad record. */
void put_row(struct text *out, const struct fields *fields,
             const struct style *style, const struct row *row);
void put_header(struct text *out, const struct fields *fields,
                const struct style *style);

/* For --list=columns: name, TAB, the queries that have it, TAB, its meaning. */
void list_columns(void);

#endif
