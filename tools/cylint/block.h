/*
 * block.h - a block of whole records with its answers
 *
 * A block has all data that change while its records are answered: the text,
 * its position in the input, the answers and the messages.  Therefore several
 * blocks can be processed at once.
 */
#ifndef CYLINT_BLOCK_H
#define CYLINT_BLOCK_H

#include "grammar.h"
#include "left_out.h"
#include "pairs.h"
#include "pieces.h"
#include "report.h"
#include "text.h"

/* Why the input ends too early; status 0: no failure.  The message is printed
 * after the answers to the records before it. */
struct failure {
    int status;
    const char *what; /* NULL: the text for `error` */
    int error;        /* errno */
};

struct block {
    char *text; /* whole records and a NUL byte.  The last record may be
                         the beginning of a line that is too long, or a
                         binary record cut off by the end of the input */
    size_t length;
    int full; /* has BLOCK_GOAL bytes or more: there may be more input */
    const char *name;           /* of the file, for messages */
    unsigned long long line;    /* number of the first line, from 1 */
    unsigned long long record;  /* number of the first record, from 1 */
    unsigned long long records; /* number of records */

    unsigned long long ticket; /* blocks are written in this order */
    unsigned long long input;  /* bytes of all input read so far */
    struct failure failure;    /* of the input after it */

    struct text out;
    struct notes notes;
    struct remarks remarks;
    int stopped;              /* at a bad record, by -e stop */
    struct record parsed;     /* the present record */
    struct pairs *pairs;      /* the present batch of pairs; NULL: one by one */
    struct left_out left_out; /* shapes that the record leaves out */
    signed char *hits; /* the number of hits with each shape of the scene */
    struct piece_memory pieces; /* of the present line */
    double *sums; /* of the present line; NULL: no sums are wanted */
};

#endif
