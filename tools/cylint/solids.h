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

#include "cylint_scene.h"
#include "grammar.h"
#include "names.h"

enum { CLAUSE_MOST = 999999999 }; /* the largest number of a clause */

/* Zero it before use. */
struct solids {
    const char *file;      /* for messages */
    struct names names;    /* of the solids */
    cylint_member *member; /* clause 0: a clause of its own */
    size_t count, capacity;
    int last_clause; /* the largest number of a clause in the file */
};

/* Adds the members that a record's words in=NAME and out=NAME state. Returns 0;
 * EXIT_BAD and writes a note; or another exit status after a message. */
int solids_read(struct solids *solids, size_t shape, struct string words,
                struct notes *notes);

/* Adds a member without a name, of a saved scene.  Returns 0, or an exit status
 * after a message. */
int solids_add(struct solids *solids, const cylint_member *member);

/* Numbers the clauses of their own, when all members are added.  Returns 0, or an
 * exit status after a message: EXIT_BAD if two solids have the same first shape. */
int solids_complete(struct solids *solids, size_t shapes);

void solids_free(struct solids *solids);

#endif
