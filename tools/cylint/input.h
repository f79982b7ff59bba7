/*
 * input.h - reads blocks of whole records from one file after another
 */
#ifndef CYLINT_INPUT_H
#define CYLINT_INPUT_H

#include "block.h"
#include "npy.h"

struct input {
    char *const *files; /* "-" is standard input */
    int count, next;    /* number of files; the next to open */
    size_t record_size; /* bytes of a binary record; 0: lines of text */
    int cr_ends_lines;  /* CR ends a line, like LF and CR LF */

    int fd;       /* -1: none is open */
    int regular;  /* reading never waits */
    int ended;    /* the end of the file was read */
    int skipping; /* skips the rest of a line that was too long */
    const char *name;
    char *carry; /* read, but not yet in a block: part of a record */
    size_t carried;
    unsigned long long line, record; /* numbers of the next line and record */

    int fresh;                 /* no block has bytes of this file yet */
    char npy_wrong[NPY_WRONG]; /* a message about a .npy header */
    int promised;              /* a .npy header states the number of rows */
    unsigned long long bytes_promised, bytes_given;
    int error;  /* errno of a read: reported after the records before it */
    int ending; /* a descriptor: its end of file ends the waiting
                           for input; -1: none */

    unsigned long long bytes; /* read so far, of all files */
    double total;             /* bytes of all files; 0: unknown */
};

/* Returns 0, or an exit status after a message. */
int input_open(struct input *in, char *const *files, int count,
               size_t record_size);
/* Waits for the first byte, before the first block.  Returns whether there is
 * none: all files are empty. */
int input_is_empty(struct input *in);
/* Reads the next block.  Its length is 0 at the end of all input and if
 * block->failure is set. */
void input_read(struct input *in, struct block *block);
/* Prints the failure. */
void input_complain(const struct block *block);
/* Reads a block and prints its failure.  Returns 0, or an exit status after a
 * message. */
int input_next(struct input *in, struct block *block);

void input_close(struct input *in);

/* Allocate the buffers of a block: for answers of at most `row` bytes without
 * the tail, and for the numbers of hits with `shapes` shapes.  block_allocate()
 * returns 0 if there is no memory, block_make() an exit status after a
 * message. */
int block_allocate(struct block *block, size_t row, size_t shapes);
int block_make(struct block *block, size_t row, size_t shapes);
void block_free(struct block *block);

#endif
