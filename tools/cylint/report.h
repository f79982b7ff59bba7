/*
 * report.h - messages about records: the first ten bad ones, then a count
 *
 * Blocks keep notes.  They are printed when the block is delivered, so the
 * messages are in the order of the input.
 */
#ifndef CYLINT_REPORT_H
#define CYLINT_REPORT_H

#include <stddef.h>

#include "grammar.h"

enum { NOTES_MOST = 10, NOTE_CAPACITY = 384 };

struct note {
    unsigned long long line;   /* from 1; 0 in binary input */
    unsigned long long record; /* from 1; used where line is 0 */
    unsigned long long column; /* from 1 */
    int remark; /* enum remark: the record is good; NOT_GIVEN: it is bad */
    int binary; /* its file looks like a binary one */
    char text[NOTE_CAPACITY];
};

struct notes {
    struct note note[NOTES_MOST + REMARKS];
    int kept;               /* of note[], in the input's order */
    int kept_bad;           /* of these, bad records: the first ten */
    unsigned long long bad; /* bad records in all */
};

/* The messages printed so far, of all blocks. */
struct report {
    unsigned long long bad;   /* bad records */
    unsigned long long shown; /* those that had a message */
    unsigned remarks;         /* a bit for each remark that was printed */
    const char *binary;       /* the file that looked binary last, or NULL */
};

/* Notes that a record, which begins at `text`, is bad.  The block's text goes
 * on to `end`; NULL in binary input. */
void take_note(struct notes *notes, unsigned long long line,
               unsigned long long record, const char *text, const char *end,
               const struct fault *fault);

/* Notes the remarks on a good record, and removes them from those wanted. */
void take_remarks(struct notes *notes, struct remarks *remarks,
                  unsigned long long line, unsigned long long record,
                  const char *text);

/* Prints the notes of a block and clears them.  Each remark is printed once; of
 * the bad records the first ten of the whole input are printed. */
void report_notes(struct report *report, struct notes *notes, const char *name);

/* Prints one note at once, for a bad line of a scene. */
void print_note(const struct note *note, const char *name);

/* Prints the count, if some bad records had no message. */
void report_end(const struct report *report);

/* `PROGRAM: NAME: WHAT`, NAME escaped. */
void complain(const char *name, const char *what);

/* `PROGRAM: NAME: TEXT OF ERRNO` */
void complain_errno(const char *name);

int out_of_memory(void);

#endif
