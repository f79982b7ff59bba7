/*
 * swc.h - neurons in SWC: a frustum or a rounded cone from each node to its
 * parent
 */
#ifndef CYLINT_SWC_H
#define CYLINT_SWC_H

#include <stddef.h>

struct block;
struct scene;
struct swc_node;

/* What the nodes become: frusta, or rounded cones and a sphere at each root. */
enum swc_form { SWC_CONES, SWC_ROUND };

/* The values of an option --swc, and the text of a message about them. */
extern const char *const swc_forms[];
#define SWC_FORMS "cones or round"

/* The nodes of one file, in its order; zero it before use. */
struct swc {
    struct swc_node *nodes;
    size_t count, capacity;
    size_t *places; /* a hash table of indices into nodes[], from 1 */
    int bits;       /* it has 2^bits entries */
};

/* Whether a file is SWC: its name ends in .swc or .SWC. */
int swc_is_name(const char *file);

/* Both return 0, or an exit status after a message. */
int swc_read_nodes(struct swc *swc, struct block *block);
/* Adds the shapes to the scene, after all nodes were read. */
int swc_add_shapes(struct swc *swc, struct scene *scene, int ends,
                   enum swc_form form, const char *name);

void swc_free(struct swc *swc);

#endif
