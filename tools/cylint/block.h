/*
 * block.h - some whole records on their way from input to output
 *
 * A block holds everything that changes while its records are answered, so
 * that several can be under way at once: what was read, where it stood, the
 * answers, the complaints.
 */
#ifndef CYLINT_BLOCK_H
#define CYLINT_BLOCK_H

#include "grammar.h"
#include "left_out.h"
#include "pairs.h"
#include "report.h"
#include "text.h"

/* Why there is no more input though there should be; status 0: there is no
 * failure.  Told when all that came before is answered. */
struct failure {
    int status;
    const char *what; /* NULL: the text for `error` */
    int error;        /* errno */
};

struct block {
    char *text; /* whole records, and one byte more: a NUL; but the
                         last may be the beginning of a line too long, or
                         a binary record that the input's end cut off */
    size_t length;
    int full;         /* as much as is read at a time: there may be more */
    const char *name; /* of the file, for messages */
    unsigned long long line;    /* number of the first line, from 1 */
    unsigned long long record;  /* number of the first record, from 1 */
    unsigned long long records; /* how many there are */

    unsigned long long ticket; /* blocks are delivered in this order */
    unsigned long long input;  /* bytes of input read with it, in all */
    struct failure failure;    /* of the input behind it */

    struct text out;
    struct notes notes;
    struct remarks remarks;
    int stopped;          /* at a bad record, by -e stop */
    struct record parsed; /* the record that is being answered; or */
    struct pairs *pairs;  /* those that are to be, at once; NULL: one by one */
    struct left_out left_out; /* by the parsed record */
    signed char *hits;        /* how many it has with each shape of the scene */
};

#endif
