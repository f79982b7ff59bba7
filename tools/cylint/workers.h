/*
 * workers.h - all blocks of the input, by as many threads as are worth it
 */
#ifndef CYLINT_WORKERS_H
#define CYLINT_WORKERS_H

#include "answer.h"

/* Answers all input with at most `most` workers, of which the caller is one.
 * Returns the status with which the work ended. */
int workers_run(struct job *job, int most);

#endif
