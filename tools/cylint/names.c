/*
 * names.c - the names of shapes: their ranks, and their columns of sums
 */
#include <limits.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "block.h"
#include "input.h"
#include "left_out.h"
#include "main.h"
#include "names.h"
#include "report.h"

/* ------------------------------------------------------------ columns -- */

static int number_columns(struct names *n, const struct groups *g)
{
    n->column = malloc((g->shapes + 1) * sizeof *n->column);
    n->shape = malloc((g->shapes + 1) * sizeof *n->shape);
    if (!n->column || !n->shape)
        return out_of_memory();
    for (size_t i = 0; i < g->shapes; i++) {
        const size_t first = g->order[g->first[i]];
        if (first == i) {
            n->column[i] = (int)n->columns;
            n->shape[n->columns++] = i;
        } else {
            n->column[i] = n->column[first];
        }
    }
    if (g->shapes == 0)
        n->shape[n->columns++] = 0; /* so that each row has a column */
    return 0;
}

struct label names_of_column(const struct names *n, size_t column)
{
    return groups_name(n->labels, n->shape[column]);
}

/* -------------------------------------------------------------- ranks -- */

/* A line of the file: LABEL INTEGER. */
struct ranking {
    struct label name;
    int rank;
};

/* The file as it is read. */
struct rank_file {
    const struct groups *groups;
    int *rank;  /* of each group, at its place in groups->order */
    char *seen; /* whether the group has a rank already */
    int has_warned;
};

static int refuse(struct fault *fault, const char *what, int expected,
                  const char *at, const char *end)
{
    *fault = (struct fault){
        .what = what, .expected = expected, .at = at, .end = end};
    return 0;
}

/* Reads an integer that is a whole field.  Returns its end, or NULL. */
static const char *read_integer(const char *p, const char *end, int *value)
{
    const int is_negative = p < end && *p == '-';
    long long n = 0;
    p += p < end && (*p == '-' || *p == '+');
    const char *const digits = p;
    for (; p < end && *p >= '0' && *p <= '9' && n <= INT_MAX; p++)
        n = 10 * n + (*p - '0');
    *value = (int)(is_negative ? -n : n);
    return p > digits && p == field_end(p, end) && n <= INT_MAX ? p : NULL;
}

static int read_ranking(const char *text, const char *end, struct ranking *r,
                        struct fault *fault)
{
    if (!trim_line(text, &end, fault))
        return 0;
    const char *p = skip_blanks(text, end);
    const char *after = field_end(p, end);
    if (after == p)
        return refuse(fault, "a label", 1, p, after < end ? after + 1 : after);
    r->name = (struct label){p, (size_t)(after - p)};
    p = skip_separator(after, end);
    after = read_integer(p, end, &r->rank);
    if (!after) {
        return refuse(fault, "an integer from -2147483647 to 2147483647", 1, p,
                      field_end(p, end));
    }
    p = skip_separator(after, end);
    return p == end ||
           refuse(fault, "the end of the line", 1, p, field_end(p, end));
}

/* Returns 0 if the line is bad. */
static int take_ranking(struct rank_file *f, const struct ranking *r,
                        struct fault *fault)
{
    const char *const end = r->name.text + r->name.length;
    const size_t group = groups_find(f->groups, r->name);
    if (group == f->groups->shapes) {
        refuse(fault, "no shape has this label", 0, r->name.text, end);
        return 1;
    }
    if (f->seen[group]) {
        return refuse(fault, "this label has a rank already", 0, r->name.text,
                      end);
    }
    f->seen[group] = 1;
    f->rank[group] = r->rank;
    return 1;
}

static void print_fault(struct block *b, unsigned long long number,
                        const char *line, const struct fault *fault)
{
    take_note(&b->notes, number, 0, line, b->text + b->length, fault);
    print_note(&b->notes.note[0], b->name);
}

/* Reads the lines of a block.  Returns 0 or EXIT_BAD after a message. */
static int read_rankings(struct rank_file *f, struct block *b)
{
    const char *const end = b->text + b->length, *stop;
    unsigned long long number = b->line;
    for (const char *p = b->text; p < end; p = stop + 1, number++) {
        struct ranking ranking;
        struct fault fault = {0};
        stop = end_of_line(p, end);
        if (!is_record(p, stop))
            continue;
        if (!read_ranking(p, stop, &ranking, &fault) ||
            !take_ranking(f, &ranking, &fault)) {
            print_fault(b, number, p, &fault);
            return EXIT_BAD;
        }
        if (fault.what && !f->has_warned) {
            f->has_warned = 1;
            print_fault(b, number, p, &fault);
        }
    }
    return 0;
}

static int read_file(struct rank_file *f, const char *file)
{
    char *const files[] = {(char *)(uintptr_t)file};
    struct input in;
    struct block block;
    int status = block_make(&block, 0, 0);
    if (status == 0 && (status = input_open(&in, files, 1, 0)) == 0) {
        while (status == 0 && (status = input_next(&in, &block)) == 0 &&
               block.length > 0)
            status = read_rankings(f, &block);
        input_close(&in);
    }
    block_free(&block);
    return status;
}

/* Names without a line have the rank 0. */
static int read_ranks(struct names *n, const struct groups *g, const char *file)
{
    struct rank_file f = {.groups = g};
    int status = EXIT_MEMORY;
    n->rank = malloc((g->shapes + 1) * sizeof *n->rank);
    f.rank = calloc(g->shapes + 1, sizeof *f.rank);
    f.seen = calloc(g->shapes + 1, 1);
    if (!n->rank || !f.rank || !f.seen)
        out_of_memory();
    else if ((status = read_file(&f, file)) == 0)
        for (size_t i = 0; i < g->shapes; i++)
            n->rank[i] = f.rank[g->first[i]];
    free(f.rank);
    free(f.seen);
    return status;
}

/* --------------------------------------------------------------- both -- */

int names_make(struct names *n, const struct labels *labels, size_t shapes,
               const char *rank_file, int has_sums)
{
    struct groups groups = {0};
    n->labels = labels;
    if (!rank_file && !has_sums)
        return 0;
    int status = groups_make(&groups, shapes, labels);
    if (status == 0 && rank_file)
        status = read_ranks(n, &groups, rank_file);
    if (status == 0 && has_sums)
        status = number_columns(n, &groups);
    groups_free(&groups);
    return status;
}

void names_free(struct names *n)
{
    free(n->rank);
    free(n->column);
    free(n->shape);
}
