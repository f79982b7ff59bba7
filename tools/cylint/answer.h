/*
 * answer.h - a block of records becomes a block of answers
 */
#ifndef CYLINT_ANSWER_H
#define CYLINT_ANSWER_H

#include "block.h"
#include "input.h"
#include "options.h"
#include "output.h"
#include "progress.h"
#include "scene.h"

/* What all blocks share.  The first group does not change; the second is
 * for the block whose turn it is to be delivered. */
struct job {
    const struct options *options;
    const struct scene *scene;
    char refusal[96]; /* said when the method does not answer */

    struct input in;
    struct output out;
    struct report report;
    struct progress progress;
};

void job_prepare(struct job *job, const struct options *options,
                 const struct scene *scene);

/* Answers all records of a block and delivers the answers.  Returns 0 or an
 * exit status; b->stopped if a bad record is to end the work. */
int answer_block(struct job *job, struct block *b);

#endif
