/*
 * columns.h - the columns of an answer, and how they are written
 *
 * A column is a name, a value and the members of an answer that it needs.  Each
 * query has its own set of columns.
 */
#ifndef CYLINT_COLUMNS_H
#define CYLINT_COLUMNS_H

#include "cylint.h"
#include "cylint_distance.h"
#include "cylint_scene.h"
#include "text.h"

enum query {
    QUERY_PAIRS,   /* a line and a shape in every record */
    QUERY_NEAREST, /* a scene: the first shape that is hit */
    QUERY_ANY,     /* whether one is hit */
    QUERY_COUNT,   /* how many are hit */
    QUERY_ALL,     /* all that are hit, a row for each */
    QUERY_FIRST,   /* of lines only: where it enters or leaves a solid first */
    QUERY_PIECES,  /* of lines only: the pieces inside solids */
    QUERY_INSIDE,  /* of points only */
    QUERIES,

    /* the same of points */
    QUERY_POINT = QUERIES,
    QUERY_POINT_NEAREST, /* the shape with the least distance */
    QUERY_POINT_ANY,     /* whether one is within the radius */
    QUERY_POINT_COUNT,
    QUERY_POINT_ALL,
    QUERY_POINT_FIRST,
    QUERY_POINT_PIECES,
    QUERY_POINT_INSIDE, /* how many shapes or solids hold the point */
    ALL_QUERIES
};

extern const char *const query_words[]; /* those of lines, then NULL */

/* The same query of points. */
static inline enum query query_of_points(enum query query)
{
    return (enum query)(query + QUERY_POINT);
}

struct column;

enum { MOST_FIELDS = 256 };

/* The columns of a row, and the mask for cylint_intersect() or cylint_distance()
 * that they need. */
struct fields {
    const struct column *column[MOST_FIELDS];
    int count;
    int labels;   /* number of columns that are labels */
    int relation; /* whether a column is the relation */
    int counts;   /* whether a column is a count */
    int solids; /* whether a column is of pieces or of solids that hold a point */
    unsigned want;
};

/* Whether a column is a side. */
int fields_need_sides(const struct fields *fields);

/* How rows look. */
struct style {
    int binary;
    int digits; /* see cylint_write_number() */
    char separator;
    const char *missing; /* NULL: nan for a number, - for a word */
};

/* The values of a row. */
struct row {
    unsigned long long record, shape, count, depth;
    const cylint_answer *answer;   /* NULL: there is none */
    const cylint_closest *closest; /* of a point; NULL: there is none */
    const cylint_piece *piece;     /* of a line; NULL: there is none */
    double unit;                   /* the length of its direction */
    const char *label;             /* the shape's, if a column needs it */
    size_t label_length;           /* 0: there is none */
    const char *tail;
    size_t tail_length;
};

/* binary: the output has numbers only. */
const char *default_fields(enum query query, int binary);

/* Writes *fields from names separated by commas.  Returns NULL, or the first
 * name that is not a column of this query or is one too many, and its length. */
const char *find_fields(struct fields *fields, const char *names,
                        enum query query, size_t *length);

/* The name of this query's column nearest to this one, or NULL. */
const char *similar_field(const char *name, size_t length, enum query query);

/* The largest length of a row or of the header in bytes, without the tail, if
 * no label is longer than this. */
size_t row_capacity(const struct fields *fields, const struct style *style,
                    size_t longest_label);

void put_row(struct text *out, const struct fields *fields,
             const struct style *style, const struct row *row);
/* `error` and missing values, for a bad record. */
void put_error(struct text *out, const struct fields *fields,
               const struct style *style);
void put_header(struct text *out, const struct fields *fields,
                const struct style *style);

/* For --list=columns: name, TAB, the queries that have it, TAB, its meaning. */
void list_columns(void (*print)(const char *name, const char *queries,
                                const char *about));

#endif
