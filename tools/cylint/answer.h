/*
 * answer.h - computes the answers to a block of records
 */
#ifndef CYLINT_ANSWER_H
#define CYLINT_ANSWER_H

#include "block.h"
#include "input.h"
#include "labels.h"
#include "names.h"
#include "options.h"
#include "output.h"
#include "progress.h"
#include "scene.h"
#include "write_order.h"

/* The data shared by all blocks.  The first group is constant.  The second is
 * for the thread that reads, the last for the thread that writes. */
struct job {
    const struct options *options;
    const struct scene *scene;
    const struct labels *labels; /* of the shapes, if they are kept */
    const struct groups *groups; /* of shapes that records may leave out */
    const struct names *names;   /* their ranks and columns of sums */
    char refusal[96];            /* message: the method does not support this */

    struct input in;

    struct write_order order;

    struct output out;
    struct report report;
    struct progress progress;
    int status; /* exit status of the work */
};

void job_prepare(struct job *job, const struct options *options,
                 const struct scene *scene, const struct labels *labels,
                 const struct groups *groups, const struct names *names);

/* Allocates the buffers of a block.  Returns 0 if there is no memory. */
int job_block(const struct job *job, struct block *block);

enum answered {
    ANSWERED,      /* the block's ticket is still the next */
    ANSWERED_LAST, /* the same, and the work ends: see job->status */
    OVERTAKEN      /* the work ended before its ticket was the next */
};

/* Answers all records of a block, and delivers the answers in the order of the
 * tickets. */
enum answered answer_block(struct job *job, struct block *b);

#endif
