/*
 * output.h - the file that a command writes, whole or not at all
 *
 * A regular file is written under another name in its folder and renamed when
 * it is whole, so that readers and failures find the old file or the new one.
 * The new file has the owner and the permissions of the old one, or those that
 * open(2) gives.  A signal that ends the command removes what was written.
 *
 * A file is written in place if it is not regular, if it is standard output or a
 * link to no file, or if the rights of its folder or its owner do not allow to
 * replace it.
 */
#ifndef CYLINT_OUTPUT_H
#define CYLINT_OUTPUT_H

#include <limits.h>
#include <stddef.h>

enum { PART_MOST = PATH_MAX + 32 };

struct output {
    const char *name;
    int fd;
    char place[PART_MOST]; /* the file itself, where `name` is a link */
    char part[PART_MOST];  /* its name until it is whole; "": in place */
    size_t row_size;       /* bytes of a binary row; 0: rows are lines */
};

/* Opens those of the descriptors 0 to 2 that are closed.  Otherwise the next
 * file opened would become standard output.  Also ignores SIGXFSZ, so that a write
 * beyond the limit of a file's size fails as other writes do.  Call it first. */
void guard_standard_streams(void);

/* open(), repeated if a signal interrupts it. */
int open_file(const char *name, int flags, unsigned mode);

/* Whether file (NULL: standard output) and input ("-": standard input) are one
 * regular file.  Prints a message if so. */
int output_is_input(const char *file, const char *input);

/* All return 0, or an exit status after a message.  A command has one output
 * at a time. */
/* name: NULL for standard output. */
int output_open(struct output *out, const char *name, size_t row_size);
/* A file that cannot take all bytes ends with a whole row. */
int output_write(struct output *out, const char *data, size_t length);
/* is_whole: the file takes its place.  0: what was written is removed; a
 * file that was written in place stays as it is. */
int output_close(struct output *out, int is_whole);

#endif
