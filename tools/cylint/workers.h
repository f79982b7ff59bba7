/*
 * workers.h - answers all blocks of the input in several threads
 */
#ifndef CYLINT_WORKERS_H
#define CYLINT_WORKERS_H

#include "answer.h"

/* Answers all input with at most `most` workers, the caller included.  Returns
 * the exit status of the work. */
int workers_run(struct job *job, int most);

#endif
