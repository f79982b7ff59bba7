/*
 * target.h - a file that a command writes, whole or not at all
 *
 * A regular file is written under another name in its folder and renamed when it
 * is whole, so that readers and failures find the old file or the new one.  The
 * new file has the owner and the permissions of the old one, or those that
 * open(2) gives.  A signal that ends the command removes what was written.
 *
 * Written in place are files that are not regular, links to no file, and a file
 * that its folder or its owner does not let us replace.
 */
#ifndef CYLINT_TARGET_H
#define CYLINT_TARGET_H

#include <limits.h>

enum { PART_MOST = PATH_MAX + 32 };

struct target {
    const char *name;
    int fd;
    char place[PART_MOST]; /* the file itself, where `name` is a link */
    char part[PART_MOST];  /* its name until it is whole; "": in place */
};

/* open(), repeated if a signal interrupts it. */
int open_file(const char *name, int flags, unsigned mode);

/* Both return 0, or an exit status after a message.  A command has one target at
 * a time.  name: NULL for standard output. */
int target_open(struct target *t, const char *name);
/* is_whole: the file takes its place.  0: what was written is removed; a file
 * that was written in place stays as it is. */
int target_close(struct target *t, int is_whole);

#endif
