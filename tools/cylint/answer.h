/*
 * answer.h - a block of records becomes a block of answers
 */
#ifndef CYLINT_ANSWER_H
#define CYLINT_ANSWER_H

#include "block.h"
#include "input.h"
#include "labels.h"
#include "options.h"
#include "output.h"
#include "progress.h"
#include "scene.h"
#include "turns.h"

/* What all blocks share.  The first group does not change, the second is for
 * whoever reads, the last for the block whose turn it is to be delivered. */
struct job {
    const struct options *options;
    const struct scene *scene;
    const struct labels *labels; /* of its shapes, where they are kept */
    const struct groups *groups; /* what its records may leave out */
    char refusal[96];            /* said when the method does not answer */

    struct input in;

    struct turns turns;

    struct output out;
    struct report report;
    struct progress progress;
    int status; /* with which the work ended */
};

void job_prepare(struct job *job, const struct options *options,
                 const struct scene *scene, const struct labels *labels,
                 const struct groups *groups);

/* Makes buffers for the job's blocks; returns whether there is memory. */
int job_block(const struct job *job, struct block *block);

enum answered {
    ANSWERED,      /* it is still the block's turn */
    ANSWERED_LAST, /* so it is, but there will be no other: job->status */
    OVERTAKEN      /* the work ended before its turn came */
};

/* Answers all records of a block and delivers the answers in its turn. */
enum answered answer_block(struct job *job, struct block *b);

#endif
