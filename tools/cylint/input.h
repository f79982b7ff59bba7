/*
 * input.h - reads blocks of whole records from one file after another
 */
#ifndef CYLINT_INPUT_H
#define CYLINT_INPUT_H

#include "report.h"

enum { FAULT_CAPACITY = SHOWN_CAPACITY + 100 /* bytes of a message */ };

/* Whole records, and why the input ends after them. */
struct block {
    /* A NUL byte follows.  The last record may be the beginning of a line that is
     * too long, or a binary record cut off by the end of the input. */
    char *text;
    size_t length;
    int is_full; /* has BLOCK_GOAL bytes or more: there may be more input */
    const char *name;                  /* of the file, for messages */
    unsigned long long line;           /* number of the first line, from 1 */
    unsigned long long record;         /* number of the first record, from 1 */
    unsigned long long record_of_file; /* the same, counted in its file */
    unsigned long long records;        /* number of records */
    unsigned long long bytes_read;     /* of all input so far */

    char fault[FAULT_CAPACITY]; /* why the input failed, or "" */
};

struct input {
    char *const *files; /* "-" is standard input */
    int count, next;    /* number of files; the next to open */
    size_t record_size; /* bytes of a binary record; 0: lines of text */
    int cr_ends_lines;  /* CR ends a line, like LF and CR LF */

    int fd;          /* -1: none is open */
    int is_regular;  /* reading never waits */
    int has_ended;   /* the end of the file was read, or an error */
    int is_skipping; /* skips the remaining bytes of a line that was too long */
    const char *name;
    char *carry; /* read, but not yet in a block: part of a record */
    size_t carried;
    unsigned long long line, record; /* numbers of the next line and record */
    unsigned long long before;       /* records of the files before this one */

    int is_fresh;   /* no block has bytes of this file yet */
    int has_header; /* of .npy, which states the number of rows */
    unsigned long long bytes_stated;   /* by the header, behind it */
    unsigned long long bytes_returned; /* in blocks, of this file */
    int read_errno; /* of a read: reported after the records before it; or 0 */
    int end_fd;     /* whose end of file ends the waiting for input; or -1 */

    unsigned long long bytes_read; /* so far, of all files */
    double total;                  /* bytes of all files; 0: unknown */
};

/* Returns 0, or an exit status after a message. */
int input_open(struct input *in, char *const *files, int count,
               size_t record_size);
/* Reads the next block.  Its length is 0 at the end of all input and at a
 * fault. */
void input_read(struct input *in, struct block *block);
void input_close(struct input *in);

/* Allocates a block's text.  Returns 0 if there is no memory. */
int block_make(struct block *block);

/* Handles the line [line, end) of a file.  Returns 0; EXIT_BAD after it has
 * written a note; or another exit status after a message. */
typedef int line_handler(void *context, const char *line, const char *end,
                         struct notes *notes);

/* Calls `handle` for each line of a file that is neither blank nor a comment,
 * up to the first bad one, and prints the notes.  Returns 0, or an exit status. */
int read_lines(const char *file, int cr_ends_lines, line_handler *handle,
               void *context);

/* ---------------------------------------------- the header of .npy files -- */

enum { NPY_PREFIX = 12 /* bytes that contain the header's length */ };

/* Reads the header at the beginning of a file, of which `length` bytes are here, of
 * an array of rows x columns doubles, little endian, row after row.  Returns its
 * length, or 0 if there is none; if there are too few bytes, a number above
 * `length`: NPY_PREFIX, or the header's length.  Writes a NUL over its last byte.
 * If the header is wrong, writes a message that names the wrong field. */
size_t npy_read(char *bytes, size_t length, size_t columns,
                unsigned long long *rows, char wrong[FAULT_CAPACITY]);

#endif
