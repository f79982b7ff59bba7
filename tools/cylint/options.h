/*
 * options.h - reads the options of cylint
 */
#ifndef CYLINT_OPTIONS_H
#define CYLINT_OPTIONS_H

#include "columns.h"
#include "cylint_methods.h"
#include "grammar.h"
#include "search.h"
#include "swc.h"

enum bad_policy { BAD_MARK, BAD_SKIP, BAD_STOP };

/* --sum: no sums; of lengths; of lengths in units of the line's direction. */
enum sum { SUM_NONE, SUM_LENGTH, SUM_T };

struct options {
    struct grammar grammar;
    const char *scene; /* NULL: pairs */
    const char *save;  /* the file to save the scene to, or NULL */
    int only_saves;    /* answers no records */
    int text;          /* writes the scene as text instead of answers */
    int swc;           /* enum swc_form of a neuron */
    enum accel accel;
    enum query query;
    cylint_piece_mode mode;
    enum sum sum;
    int most_pieces;                    /* of a line; 0: all */
    const char *rank;                   /* the file of --rank, or NULL */
    struct fields fields, point_fields; /* of lines, of points */
    double radius;                      /* of points, by --within */
    unsigned point_want;                /* CYLINT_SIGNED by --signed, or 0 */
    struct style style;
    const cylint_method *method; /* NULL: cylint_intersect() */
    enum bad_policy bad;
    int not_label;    /* not=NAME in a record is a label, not a number */
    unsigned remarks; /* a bit for each enum remark to test for */
    int binary_in;
    int array;    /* binary answers with a .npy header */
    int workers;  /* 0: one for each processor */
    int comments; /* copied through */
    int hits_only, header, progress;
    const char *output; /* NULL: standard output */
    char **files;
    int file_count;

    const char *print; /* help, version or the name of a list, to print
                              instead of answers; or NULL */
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

/* Writes the help, the version or a list to standard output. */
int print_about(const char *what);

#endif
