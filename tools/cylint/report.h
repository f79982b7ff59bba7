/*
 * report.h - messages about bad records: the first ten, then a count
 *
 * Blocks keep notes; they become messages when the block is delivered, so
 * that their order is the input's.
 */
#ifndef CYLINT_REPORT_H
#define CYLINT_REPORT_H

#include <stddef.h>

struct fault;

enum { NOTES_MOST = 10, NOTE_ROOM = 320 };

struct note {
    unsigned long long line;   /* from 1; 0 in binary input */
    unsigned long long record; /* from 1; used where line is 0 */
    unsigned long long column; /* from 1 */
    char text[NOTE_ROOM];
};

struct notes {
    struct note note[NOTES_MOST];
    unsigned long long count; /* of bad records; the first ten have notes */
};

/* What was complained about so far, in all blocks. */
struct report {
    unsigned long long bad;
};

/* Notes that a record, which begins at `text`, is bad. */
void take_note(struct notes *notes, unsigned long long line,
               unsigned long long record, const char *text,
               const struct fault *fault);

/* Prints a block's notes as long as ten were not yet printed. */
void report_notes(struct report *report, const struct notes *notes,
                  const char *name);

/* One note, at once: a scene's bad line. */
void print_note(const struct note *note, const char *name);

/* Prints the count, if there were more than ten. */
void report_end(const struct report *report);

/* `PROGRAM: NAME: WHAT`, NAME escaped. */
void complain(const char *name, const char *what);

/* `PROGRAM: NAME: what errno says` */
void complain_errno(const char *name);

int out_of_memory(void);

#endif
