/*
 * report.h - exit statuses, messages about records, files and memory, and progress
 *
 * What is wrong with a record becomes a note of its block.  The notes are
 * printed when the block is delivered, so the messages are in the order of the
 * input.
 */
#ifndef CYLINT_REPORT_H
#define CYLINT_REPORT_H

#include "text.h"

extern const char *const program; /* the name of the program, in messages */

enum {
    EXIT_ANSWERED = 0, /* all records; a miss is an answer */
    EXIT_BAD = 1,      /* some records are bad, or a line of the scene */
    EXIT_USAGE = 2,
    EXIT_IO = 3, /* input or output failed */
    EXIT_MEMORY = 4
};

/* The numbers of a function's arguments `format` and `...`. */
#if defined(__GNUC__)
#define LIKE_PRINTF(format_, first) \
    __attribute__((format(printf, format_, first)))
#else
#define LIKE_PRINTF(format_, first)
#endif

/* Prints `PROGRAM: `, the text as printf() writes it, and a line feed. */
void message(const char *format, ...) LIKE_PRINTF(1, 2);

/* Whether the signal that interrupted a function of the system ends the work. */
int is_interrupted(void);

/* Messages about good records.  Each is printed for the first such record
 * only. */
enum remark {
    REMARK_NONE,    /* the record is bad */
    REMARK_NUMBERS, /* its tail begins with a number, or a number has a decimal
                       * comma */
    REMARK_DOMAIN,  /* -t does not apply to its line or point */
    REMARK_LABEL,   /* it has a label that no shape has */
    REMARK_LATE_WORD, /* its tail has a word or a shape without effect there */
    REMARKS
};

enum { NOTES_MOST = 10, NOTE_CAPACITY = 384 };

struct note {
    unsigned long long line, record, column; /* from 1; line 0: binary input */
    enum remark remark;
    int looks_binary; /* its file */
    char text[NOTE_CAPACITY];
};

/* The notes of a block.  note[kept] is that of the present record, until
 * count_bad() or make_remark() keeps it. */
struct notes {
    unsigned long long line, record; /* the present record's numbers */
    const char *text,
        *end;        /* from its first byte to the block's end; or NULL */
    unsigned wanted; /* a bit for each remark to test for */
    int may_remark;  /* the next note may become a remark */
    struct note note[NOTES_MOST + REMARKS + 1];
    int kept, kept_bad;     /* of these, and how many are about bad records */
    unsigned long long bad; /* bad records in all */
};

/* The messages printed so far, of all blocks. */
struct report {
    unsigned long long bad, shown; /* bad records; those that had a message */
    unsigned remarks;              /* a bit for each remark that was printed */
    const char *binary_file;       /* that looked binary last, or NULL */
};

/* All write the note that the present record is bad, and return EXIT_BAD.
 * at: the place in the record's text, or NULL. */
/* A text in the format of printf(). */
int refuse(struct notes *notes, const char *at, const char *format, ...)
    LIKE_PRINTF(3, 4);
/* `WHAT: 'TEXT'`, or `WHAT` if the text is empty. */
int refuse_text(struct notes *notes, const char *what, struct string text);
/* `expected WHAT, found 'TEXT'`; an empty text is the end of the line. */
int refuse_other(struct notes *notes, const char *expected, struct string text);
/* Append `; ADVICE`, and `; did you mean WORD?` if one of the words is near. */
void advise(struct notes *notes, const char *advice);
void suggest(struct notes *notes, struct words words, struct string text);

/* Whether to test the present record for a remark.  If so, the caller writes a
 * note as for a bad record and calls make_remark(): the note becomes the remark,
 * also if the record is bad. */
int wants_remark(struct notes *notes, enum remark remark);
void make_remark(struct notes *notes, enum remark remark);

/* The present record is bad, as the note says. */
void count_bad(struct notes *notes);

/* Prints the notes of a block and clears them.  Of the bad records the first
 * ten of the whole input are printed. */
void report_notes(struct report *report, struct notes *notes, const char *name);

/* Prints the number of bad records, if some had no message. */
void report_end(const struct report *report);

/* All return an exit status after a message. */
/* EXIT_BAD: `PROGRAM: NAME:LINE:COLUMN: WHAT`, NAME escaped, `-` as stdin. */
int complain_at(const char *name, unsigned long long line,
                unsigned long long column, const char *what);
/* `status`: `PROGRAM: NAME: ` and a text in the format of printf(). */
int complain(int status, const char *name, const char *format, ...)
    LIKE_PRINTF(3, 4);
/* EXIT_IO: the same with the text of errno. */
int complain_errno(const char *name);
/* EXIT_MEMORY */
int out_of_memory(void);

/* -------------------------------------------------------------- progress -- */

/* On a terminal that has no answers the progress appears when the work has lasted a
 * second.  With --progress it is also written elsewhere, one line a second. */
struct progress {
    const char *unit;          /* what is counted, in the plural */
    int in_bytes;              /* `done` and `total` are bytes */
    int is_shown, is_terminal; /* is_shown: whether anything is written */
    double start, last;        /* seconds */
    unsigned long long count;
};

/* answers: their descriptor, or -1. */
void progress_start(struct progress *p, int is_wanted, int answers,
                    const char *unit, int in_bytes);

/* Adds `count` to the number done.  The work is at `done` of `total`; 0: the
 * total is unknown. */
void progress_add(struct progress *p, unsigned long long count, double done,
                  double total);

/* Clears the terminal's line, or prints the last figure. */
void progress_end(struct progress *p);

#endif
