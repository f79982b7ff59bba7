/*
 * solids.h - the solids of a scene that are made of shapes: in=NAME, out=NAME
 *
 *   in=NAME            the shape is a member of clause 1 of the solid
 *   in=NAME/CLAUSE     of this clause, an integer from 1
 *   out=NAME           its complement is a clause of its own
 *   out=NAME/CLAUSE    its complement is a member of this clause
 */
#ifndef CYLINT_COMMAND_SOLIDS_H
#define CYLINT_COMMAND_SOLIDS_H

#include <stddef.h>

#include "cylint_scene.h"
#include "grammar.h"

struct solid_name {
    size_t begin, length; /* in solids.bytes */
};

/* Zero it before use. */
struct solids {
    const char *file;      /* for messages */
    cylint_member *member; /* clause 0: a clause of its own */
    size_t count, capacity;
    int last_clause; /* the largest number of a clause in the file */

    struct solid_name *name; /* of each solid */
    size_t names, names_capacity;
    char *bytes; /* of all names */
    size_t length, bytes_capacity;
    size_t *bucket; /* a hash table of names: a solid's number from 1, or 0 */
    size_t buckets; /* 0 or a power of two */
};

/* Adds the members that a record's words in=NAME and out=NAME state.  Returns 0;
 * EXIT_BAD and writes *fault; or another exit status after a message. */
int solids_read(struct solids *solids, size_t shape, const char *words,
                size_t length, struct fault *fault);

/* Adds a member without a name, of a saved scene.  Returns 0, or an exit status
 * after a message. */
int solids_add(struct solids *solids, const cylint_member *member);

/* Numbers the clauses of their own, when all members are added. */
void solids_complete(struct solids *solids);

/* Gives a finished scene its solids.  Returns 0, or an exit status after a
 * message. */
int solids_give(struct solids *solids, cylint_scene *scene);

void solids_free(struct solids *solids);

#endif
