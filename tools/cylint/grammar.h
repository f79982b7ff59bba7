/*
 * grammar.h - reads a line or point and a shape from a record of text or doubles
 *
 *   record = LINE SHAPE [ends=WORD] [TAIL]     a pair
 *            LINE [not=NAME]... [TAIL]         a line or point, with a scene
 *            SHAPE [ends=WORD] [SOLID]... [TAIL]   a shape of a scene
 *   SOLID  = in=NAME[/CLAUSE] | out=NAME[/CLAUSE]
 *
 * With -k the words for LINE and SHAPE are left out.
 */
#ifndef CYLINT_GRAMMAR_H
#define CYLINT_GRAMMAR_H

#include <stddef.h>

#include "cylint.h"
#include "sizes.h"

/* Lines, and a point. */
enum line_kind {
    LINE_WHOLE,
    LINE_RAY,
    LINE_SEGMENT,
    LINE_SPAN,
    LINE_POINT,
    LINE_KINDS
};

enum shape_kind {
    SHAPE_CYLINDER,
    SHAPE_CONE,
    SHAPE_ECYLINDER,
    SHAPE_ECONE,
    SHAPE_ACONE,
    SHAPE_SPHERE,
    SHAPE_CAPSULE,
    SHAPE_RCONE,
    SHAPE_HALFSPACE,
    SHAPE_KINDS
};

enum { NOT_GIVEN = -1, MOST_NUMBERS = 8 + 13 /* a span and an econe */ };

/* The notation of a kind: its word, the count and the names of its numbers. */
struct kind {
    const char *word;
    int numbers;
    const char *names;
};

extern const struct kind line_kinds[LINE_KINDS];
extern const struct kind shape_kinds[SHAPE_KINDS];
extern const char *const ends_words[]; /* in cylint_ends' order, then NULL */

/* The parts of a record, and their defaults. */
struct grammar {
    int has_line, has_shape;
    int line; /* enum line_kind by -k, or NOT_GIVEN: a word names it */
    const char *no_lines, *no_points; /* why a line or a point is a fault; NULL:
                                         it is none */
    const char *no_left_out;          /* why not=NAME is a fault, or NULL */
    int shape;                        /* enum shape_kind likewise */
    int ends; /* cylint_ends by --ends; NOT_GIVEN: capped, acone infinite */
    int has_domain; /* -t: for lines and rays */
    double tmin, tmax;
    int no_tail;         /* a tail makes a record bad */
    char bare[48];       /* "a ray and a cylinder have 13", with -k */
    const char *convert; /* how to convert a file that is no scene, or NULL */
};

struct record {
    int is_point;
    cylint_line line;
    double point[3]; /* if is_point */
    cylint_shape shape;
    const char *tail; /* without the blanks around it */
    size_t tail_length;
    const char *left_out; /* the words not=NAME, of a line without a shape */
    size_t left_out_length;
    const char *solids; /* the words in=NAME and out=NAME, of a shape without a
                           line */
    size_t solids_length;
};

#define NOT_WORD "not="
#define IN_WORD "in="
#define OUT_WORD "out="

/* The fault of a record.  at..end is the wrong text; NULL in binary input.
 * expected: 1 if `what` was expected there; 0 if `what` describes the fault. */
struct fault {
    const char *what;
    int expected;
    const char *at, *end;
    unsigned long long shape; /* of the scene, or 0 */
    int numbers;              /* "N numbers where WHAT", or 0 */
    const char *meant;        /* the known word nearest to the text, or NULL */
    const char *remedy;       /* what the user can do, or NULL */
};

/* A message about a good record; printed for the first such record only. */
enum remark {
    REMARK_SURPLUS, /* its tail begins with a number */
    REMARK_DOMAIN,  /* -t does not apply to its line or point */
    REMARK_LABEL,   /* it leaves out a label that no shape has */
    REMARKS
};

/* wanted: a bit for each remark to test for.  found: those that apply to the
 * last record, each with its text. */
struct remarks {
    unsigned wanted, found;
    struct fault fault[REMARKS];
};

/* The index of the text in `words` (NULL at the end), or NOT_GIVEN. */
int find_word(const char *const *words, const char *text, size_t length);
int find_kind(const struct kind *kinds, int count, const char *text,
              size_t length);

/* Writes g->bare from the kinds. */
void describe_bare(struct grammar *g);

/* Makes a shape of this enum shape_kind.  ends: cylint_ends or NOT_GIVEN. */
cylint_status shape_of_numbers(int kind, int ends, const double *v,
                               cylint_shape *shape);

/* The number of doubles in a record without words. */
int numbers_of_record(const struct grammar *g);

static inline int is_blank(char c)
{
    return c == ' ' || c == '\t';
}

static inline const char *skip_blanks(const char *p, const char *end)
{
    while (p < end && is_blank(*p)) {
        p++;
    }
    return p;
}

/* Returns the end of the field at p. */
static inline const char *field_end(const char *p, const char *end)
{
    while (p < end && !is_blank(*p) && *p != ',') {
        p++;
    }
    return p;
}

static inline const char *skip_separator(const char *p, const char *end)
{
    p = skip_blanks(p, end);
    return p < end && *p == ',' ? skip_blanks(p + 1, end) : p;
}

/* Returns the end of the line at p: its line feed, or the end of the text. */
const char *end_of_line(const char *p, const char *end);

/* Whether a line has a record: it is neither blank nor a comment.  A line that
 * is too long counts as a record. */
int is_record(const char *line, const char *end);

/* Removes a carriage return from the end.  Returns 0 and a fault if the line is
 * too long. */
int trim_line(const char *text, const char **end, struct fault *fault);

/* The places for the parts of a record; only those in the grammar are
 * written. */
struct parts {
    int *is_point;
    cylint_line *line;
    double *point;
    cylint_shape *shape;
    const char **tail;
    size_t *tail_length;
    const char **left_out; /* used only if there is no shape */
    size_t *left_out_length;
    const char **solids; /* used only if there is no line */
    size_t *solids_length;
    struct remarks *remarks; /* NULL: no remarks */
};

/* All return 1 if the record is good, else 0 and write *fault.  [text, end) is
 * one line without its line feed; *end must be readable. */
int read_record(const struct grammar *g, const char *text, const char *end,
                struct record *record, struct fault *fault);
struct parts parts_of(struct record *record);
int take_record(const struct grammar *g, const double *numbers,
                struct record *record, struct fault *fault);
int read_parts(const struct grammar *g, const char *text, const char *end,
               const struct parts *parts, struct fault *fault);
int take_parts(const struct grammar *g, const double *numbers,
               const struct parts *parts, struct fault *fault);

#endif
