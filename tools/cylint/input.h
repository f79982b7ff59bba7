/*
 * input.h - blocks of whole records from one file after another
 */
#ifndef CYLINT_INPUT_H
#define CYLINT_INPUT_H

#include "block.h"
#include "npy.h"

struct input {
    char *const *files; /* "-" is standard input */
    int count, next;    /* of files; the one to open next */
    size_t record_size; /* bytes of a binary record; 0: lines of text */
    int cr_ends_lines;  /* so does LF, and CR LF ends one line */

    int fd;       /* -1: none is open */
    int regular;  /* reading never waits */
    int ended;    /* the end of the file was seen */
    int skipping; /* the rest of a line that was too long */
    const char *name;
    char *carry; /* read, but not yet given out: part of a record */
    size_t carried;
    unsigned long long line, record; /* numbers of the next ones */

    int fresh;                 /* nothing was given out of this file yet */
    char npy_wrong[NPY_WRONG]; /* a message about a .npy header */
    int promised;              /* a .npy header told how many bytes follow */
    unsigned long long bytes_promised, bytes_given;
    int error;  /* errno of a read: reported after the records before it */
    int ending; /* a descriptor: when it is at its end, waiting for
                           input is too; -1: none */

    unsigned long long bytes; /* read so far, of all files */
    double total;             /* bytes of all files; 0: unknown */
};

/* Returns 0 or an exit status, having said what is wrong. */
int input_open(struct input *in, char *const *files, int count,
               size_t record_size);
/* Fills the block; its length is 0 at the end of all input, and where
 * block->failure is set. */
void input_take(struct input *in, struct block *block);
/* Prints the failure. */
void input_complain(const struct block *block);
/* The same at once: returns 0 or an exit status, having said what is wrong. */
int input_next(struct input *in, struct block *block);

void input_close(struct input *in);

/* A block's buffers, for answers of at most `row` bytes beside the tail, and
 * for the numbers of hits with so many shapes.  block_room() returns whether
 * there is memory, block_make() 0 or an exit status, having said it. */
int block_room(struct block *block, size_t row, size_t shapes);
int block_make(struct block *block, size_t row, size_t shapes);
void block_free(struct block *block);

#endif
