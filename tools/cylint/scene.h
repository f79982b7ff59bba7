/*
 * scene.h - the shapes of a file: of text, of a neuron's nodes, or a saved
 * scene
 *
 * Words of a record make solids of shapes (solids.c):
 *
 *   in=NAME            the shape is a member of clause 1 of the solid
 *   in=NAME/CLAUSE     of this clause, an integer from 1
 *   out=NAME           its complement is a clause of its own
 *   out=NAME/CLAUSE    its complement is a member of this clause
 */
#ifndef CYLINT_COMMAND_SCENE_H
#define CYLINT_COMMAND_SCENE_H

#include "../../src/scene/piece_memory.h"
#include "grammar.h"
#include "labels.h"
#include "output.h"

enum { CLAUSE_MOST = 999999999 }; /* the largest number of a clause */

/* Zero it before use. */
struct solids {
    struct names names;    /* of the solids */
    cylint_member *member; /* clause 0: a clause of its own */
    size_t count, capacity;
};

/* Adds the members that a record's words in=NAME and out=NAME state. Returns 0;
 * EXIT_BAD and writes a note; or another exit status after a message. */
int solids_read(struct solids *solids, size_t shape, struct string words,
                struct notes *notes);

/* Adds a member without a name, of a saved scene.  Returns 0, or an exit status
 * after a message. */
int solids_add(struct solids *solids, const cylint_member *member);

/* Numbers the clauses of their own, when all members of the file are added: above
 * the others of their solid.  Returns 0, or an exit status after a message:
 * EXIT_BAD if two solids have the same first shape. */
int solids_complete(struct solids *solids, size_t shapes, const char *file);

/* Returns a new array with the number that the library gives to each solid, from 1:
 * that of its first shape with in=, or of its first shape if it has none; 0 for a
 * solid without members.  NULL: no memory.  All members have clauses. */
size_t *solids_numbers(const struct solids *solids);

/* For qsort(): by solid, then by the clause's number. */
int compare_by_solid(const void *a, const void *b);

void solids_free(struct solids *solids);

/* -------------------------------------------------------------- scene -- */

/* What the nodes become: frusta, or round cones and a sphere at each root. */
enum swc_form { SWC_CONES, SWC_ROUND };

extern const char *const swc_forms[]; /* their words, then NULL */

/* Whether a file is SWC: its name ends in .swc or .SWC, or the form is given. */
int swc_is_neuron(const char *file, int form);

/* Zero it before use, but for the first three members. */
struct scene {
    const char *file; /* where it is read from */
    int ends;     /* of shapes whose records do not state them, or NOT_GIVEN */
    int swc_form; /* enum swc_form of a neuron, or NOT_GIVEN: SWC_CONES */
    cylint_scene *shapes; /* NULL: none yet */
    size_t count;
    struct solids solids; /* that were read, for scene_build() */
    int keeps_labels;     /* else there are none */
    struct labels labels; /* the tails of the records */
};

/* All return 0, or an exit status after a message. */

/* Adds the shape of a record. */
int scene_add(struct scene *scene, const struct record *record);

/* Reads shapes, one a line, or a neuron's nodes.  Stops at the first bad line. */
int scene_read_text(struct scene *scene);
/* Reads a neuron's nodes. */
int swc_read(struct scene *scene);

enum { NOT_SAVED = -1 };

/* Opens a saved scene.  Its file is mapped and checked.  Returns NOT_SAVED
 * if the file is something else, cannot be opened or is no regular file.
 * `ends` and `swc_form` must be NOT_GIVEN, as the shapes are made. */
int scene_open(struct scene *scene);

/* As scene_read_text(), or adds the shapes of a saved scene, with their
 * labels as tails, and their solids. */
int scene_read(struct scene *scene);

/* Builds the scene by at most this number of threads, unless that was done, and
 * sets its solids. */
int scene_build(struct scene *scene, int threads);

/* Saves a scene that was built, with its labels. */
int scene_save(struct scene *scene, const char *file);

void scene_free(struct scene *scene);

/* --------------------------------------------------------------- text -- */

/* The most bytes that put_record() writes before it refuses a record as too long:
 * 512 for the shape, a line of solids, one more solid, and a label. */
enum { RECORD_MOST = 512 + 3 * LINE_MOST };

/* A record to write. */
struct shape_record {
    const cylint_shape *shape;
    const struct solids *solids;
    const cylint_member *member; /* those of this shape */
    size_t members;
    struct string label;
};

/* Appends the record and a line feed.  The text has space for RECORD_MOST bytes.
 * Returns NULL, or why text cannot hold the record; then the text is as before.
 * digits: as in cylint_write_number(). */
const char *put_record(struct text *t, const struct shape_record *record,
                       int digits);

/* Writes all shapes of a scene that was read, with solids and labels.  Returns 0,
 * or an exit status after a message. */
int scene_write_text(struct scene *scene, int digits, struct output *out);

/* ---------------------------------------------------------------- pieces -- */

/* The memory of a thread.  Zero it before use. */
struct piece_memory {
    cylint_piece_memory found;
    size_t *number; /* of the shapes found last */
    size_t number_capacity;
};

void piece_memory_free(struct piece_memory *memory);

/* Makes space for more numbers.  Returns 0 if there is no memory. */
int grow_numbers(struct piece_memory *memory);

/* All return CYLINT_NO_ROOM if there is no memory. */

/* Writes the numbers of the shapes that the line hits to memory->number, ascending.
 * Returns how many. */
size_t find_hit(const cylint_scene *scene, const cylint_line *line,
                struct piece_memory *memory);

/* As cylint_scene_first_boundary() and cylint_scene_depth(). */
size_t first_boundary(const cylint_scene *scene, const cylint_line *line,
                      unsigned want, cylint_hit *hit,
                      struct piece_memory *memory);
size_t depth_of_point(const cylint_scene *scene, const double point[3],
                      const int *rank, size_t *owner,
                      struct piece_memory *memory);

#endif
