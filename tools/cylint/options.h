/*
 * options.h - the options of cylint
 */
#ifndef CYLINT_OPTIONS_H
#define CYLINT_OPTIONS_H

#include "columns.h"
#include "cylint_methods.h"
#include "grammar.h"

/* Whether the hierarchy finds the shapes that a line hits. */
enum accel { ACCEL_AUTO, ACCEL_NONE, ACCEL_EMBREE }; /* EMBREE: as AUTO */

enum bad_policy { BAD_MARK, BAD_SKIP, BAD_STOP };

/* --sum: no sums; by label, of lengths or of lengths in units of the line's
 * direction; the same of all pieces. */
enum sum { SUM_NONE, SUM_LENGTH, SUM_T, SUM_TOTAL, SUM_TOTAL_T };

/* --tail and --no-tail */
enum { TAIL_WITH_REMARK, TAIL_ALLOWED, TAIL_REFUSED };

/* The enumerations are ints, because options of any kind are written through
 * one pointer. */
struct options {
    unsigned long long given;    /* a bit for each option in the table */
    const char *about;           /* help, version or a list to print, or NULL */
    const char *kinds, *columns; /* of -k and -f */

    struct grammar grammar;
    const char *scene; /* NULL: pairs */
    const char *save;  /* the file to save the scene to, instead of answers */
    int writes_text;   /* the scene as text instead of answers */
    int swc;           /* enum swc_form of a neuron, or NOT_GIVEN */
    int accel;         /* enum accel */
    enum query query;
    int piece_mode;                     /* the words of --pieces, from 0 */
    int sum;                            /* enum sum */
    int most_pieces;                    /* of a line; 0: all */
    const char *rank;                   /* the file of --rank, or NULL */
    struct fields fields, point_fields; /* of lines, of points */
    double radius;                      /* of points, by --within */
    unsigned signed_flag;               /* of points: CYLINT_SIGNED or 0 */
    int is_binary, is_binary_in;        /* -b; records are doubles */
    struct style style;
    const cylint_method *method; /* NULL: cylint_intersect() */
    int bad_policy;              /* enum bad_policy */
    int not_label; /* not=NAME in a record is a label, not a number */
    int tail_policy;
    unsigned remarks; /* a bit for each enum remark to test for */
    int workers;      /* at most; 0: one per processor */
    int copies_comments;
    int hits_only, writes_header, shows_progress;
    const char *output; /* NULL: standard output */
    char **files;
    int file_count;
};

/* Returns 0, or EXIT_USAGE after a message.  Moves the files to the front of
 * argv, where options->files points. */
int read_options(struct options *options, int argc, char **argv);

/* The columns of the header and of binary answers: those of points if the
 * options allow only points. */
static inline const struct fields *options_fields(const struct options *options)
{
    return options->grammar.no_lines ? &options->point_fields
                                     : &options->fields;
}

/* Writes the help, the version or a list to standard output.  Returns 0 or
 * EXIT_IO. */
int print_about(const char *what);

#endif
