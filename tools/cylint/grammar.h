/*
 * grammar.h - reads a line or point and a shape from a record of text or
 * doubles
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

#include "cylint.h"
#include "report.h"
#include "text.h"

/* Lines, and a point. */
enum line_kind { LINE_WHOLE, LINE_RAY, LINE_SEGMENT, LINE_SPAN, LINE_POINT };

/* The number of a kind of shape, from 0; NOT_GIVEN for CYLINT_KIND_NONE.  And the
 * kind with a number. */
#define NUMBER_OF_KIND(kind) ((int)(kind)-1)
#define KIND_OF_NUMBER(number) ((cylint_kind)((number) + 1))

enum { MOST_NUMBERS = 8 + 13 /* a span and an econe */ };

/* The notation of a kind: its word, the count and the names of its numbers, and
 * which of them are radii, factors or angles. */
struct kind {
    const char *word;
    int numbers;
    const char *names;
    int checked[2];
};

extern const struct kind line_kinds[], shape_kinds[]; /* by number; then NULL */
extern const char *const ends_words[]; /* in cylint_ends' order, then NULL */

/* The parts of a record, and their defaults. */
struct grammar {
    int has_line, has_shape;
    int line; /* enum line_kind by -k, or NOT_GIVEN: a word names it */
    /* why a line, a point or not=NAME is wrong, or NULL; "": -k excludes it */
    const char *no_lines, *no_points, *no_left_out;
    int shape; /* its number likewise */
    int ends;  /* cylint_ends by --ends; NOT_GIVEN: capped, acone infinite */
    int has_domain; /* -t: for lines and rays */
    double domain[2];
    int no_tail;         /* a tail makes a record bad */
    const char *convert; /* how to convert a file that is no scene, or NULL */
};

struct record {
    int is_point;
    cylint_line line;
    double point[3]; /* if is_point */
    cylint_shape shape;
    struct string tail; /* without the blanks around it */
    /* not=NAME of a line without a shape, or in=NAME and out=NAME of a shape
     * without a line */
    struct string words;
};

#define ENDS_WORD "ends="
#define NOT_WORD "not="
#define IN_WORD "in="
#define OUT_WORD "out="

/* Makes a shape of this kind.  ends: cylint_ends or NOT_GIVEN. */
cylint_status shape_of_numbers(cylint_kind kind, int ends, const double *v,
                               cylint_shape *shape);

/* The number of doubles in a record without words. */
int numbers_of_record(const struct grammar *g);

/* All functions that read return 0, or EXIT_BAD and write a note. */

/* [text, end) is one line without its line feed; *end must be readable. */
int read_record(const struct grammar *g, const char *text, const char *end,
                struct record *record, struct notes *notes);
int record_of_numbers(const struct grammar *g, const double *numbers,
                      struct record *record, struct notes *notes);

/* -------------------------------------------------------------- fields -- */

/* Fields are separated by blanks, tabs, and at most one comma. */
static inline int is_blank(char c)
{
    return c == ' ' || c == '\t';
}

static inline const char *skip_blanks(const char *p, const char *end)
{
    while (p < end && is_blank(*p))
        p++;
    return p;
}

/* Returns the end of the field at p. */
static inline const char *field_end(const char *p, const char *end)
{
    while (p < end && !is_blank(*p) && *p != ',')
        p++;
    return p;
}

/* The field with which a text begins. */
static inline struct string first_field(struct string s)
{
    return between(s.text, field_end(s.text, end_of(s)));
}

static inline const char *skip_separator(const char *p, const char *end)
{
    p = skip_blanks(p, end);
    return p < end && *p == ',' ? skip_blanks(p + 1, end) : p;
}

/* Takes the first field off a text, with the separator behind it. */
static inline struct string take_field(struct string *text)
{
    const struct string first = first_field(*text);
    *text =
        between(skip_separator(end_of(first), end_of(*text)), end_of(*text));
    return first;
}

/* The next field of a line, and where its faults are noted. */
struct reader {
    const char *p, *end;
    struct notes *notes;
    int has_word; /* ends=WORD, not=NAME, in=NAME or out=NAME was read */
};

/* Sets a reader to the first field. */
int begin_line(struct reader *r, const char *text, const char *end,
               struct notes *notes);

static inline struct string field(const struct reader *r)
{
    return between(r->p, field_end(r->p, r->end));
}

/* Moves on from the end of a field. */
static inline void skip_to(struct reader *r, const char *after)
{
    r->p = skip_separator(after, r->end);
}

static inline void skip_field(struct reader *r)
{
    skip_to(r, field_end(r->p, r->end));
}

/* refuse_text() and refuse_other() with the field. */
int refuse_field(struct reader *r, const char *what);
int refuse_other_field(struct reader *r, const char *expected);

/* Returns the end of the number at p if it is a whole field, else NULL. */
const char *end_of_number(const char *p, const char *end, double *value);

/* Reads fields that are finite numbers. */
int read_numbers(struct reader *r, double *v, int count);

/* If the next field is a number, but should not be, notes as a remark the first
 * decimal comma before it. */
void remark_decimal_comma(struct reader *r);

/* Returns the end of the line at p: its line feed, or the end of the text. */
const char *end_of_line(const char *p, const char *end);

/* The end of a line [line, end), without CR. */
static inline const char *before_return(const char *line, const char *end)
{
    return end - (end > line && end[-1] == '\r');
}

/* Whether a line has a record: it is neither blank nor a comment.  A line that
 * is too long counts as a record. */
int is_record(const char *line, const char *end);

#endif
