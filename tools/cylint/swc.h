/*
 * swc.h - neurons in SWC: a frustum from each node to its parent
 */
#ifndef CYLINT_SWC_H
#define CYLINT_SWC_H

#include "block.h"
#include "scene.h"

struct swc_node;

/* The nodes of one file, in its order; zero it before use. */
struct swc {
    struct swc_node *nodes;
    size_t count, room;
    size_t *places; /* where in nodes[] a number is, by hashing; from 1 */
    int bits;       /* there are 2^bits places */
};

/* Whether a file is taken for SWC: by its name, which ends in .swc or .SWC. */
int swc_is_name(const char *file);

/* Both return 0 or an exit status, having said what is wrong. */
int swc_read_nodes(struct swc *swc, struct block *block);
/* Adds the frusta to the scene, once all nodes were read. */
int swc_add_frusta(struct swc *swc, struct scene *scene, int ends,
                   const char *name);

void swc_free(struct swc *swc);

#endif
