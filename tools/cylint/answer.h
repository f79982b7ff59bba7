/*
 * answer.h - answers records: the data of the whole work, and of one worker
 */
#ifndef CYLINT_ANSWER_H
#define CYLINT_ANSWER_H

#include <pthread.h>

#include "input.h"
#include "options.h"
#include "output.h"
#include "scene.h"
#include "report.h"

/* The data shared by all workers.  The first group is constant when they
 * start.  The second is for the worker that reads, which has locked `reading`; the
 * third is protected by `order`; the last is for the worker that writes. */
struct job {
    struct options *options;
    struct scene scene;   /* without -s it has no shapes */
    struct groups groups; /* which records leave out; ranks; sums */

    pthread_mutex_t reading;
    struct input in;
    unsigned long long next_read; /* the ticket of the next block */
    int most_workers, workers;    /* at most; now */
    struct task *other_tasks;     /* of all workers but the first */
    /* A pipe, closed when the work ends: this wakes a worker that waits for
     * input.  It is opened before the second worker starts; until then -1. */
    int end_pipe[2];

    pthread_mutex_t order;
    pthread_cond_t changed;
    unsigned long long next_written; /* the ticket of the next block */
    int has_ended;                   /* nothing is written any more */

    struct output out;
    struct report report;
    struct progress progress;
    int status; /* exit status of the work */
};

/* What a worker does: a block of records, and what changes while they are
 * answered. */
struct task {
    struct job *job;
    struct task *next; /* of another worker */
    pthread_t thread;
    struct block block;
    unsigned long long ticket; /* blocks are written in this order */

    struct text out;
    struct notes notes;
    int ends;       /* the work ends with this block, or has ended before it */
    int is_stopped; /* at a bad record, by -e stop */

    struct record record; /* the present record */
    struct left_out left_out;
    struct row row;
    struct piece_memory pieces;
};

/* Allocates a task and what it needs.  Returns NULL if there is no memory. */
struct task *task_make(struct job *job);
void task_free(struct task *task);

/* Answers all records of its block, and delivers the answers in the order of
 * the tickets.  Sets task->ends. */
void answer_block(struct task *task);

/* Writes the row of the present record's answer. */
void put_answer(struct task *task, int is_hit);
/* Ends the work after the answers so far.  Returns 0. */
int end_without_memory(struct task *task);

/* Answers the present record.  Returns 0, or EXIT_BAD and writes a note. */
int answer_record(struct task *task);

/* Writes the header line, if it is wanted, and answers all input with at most
 * `most` workers, the caller included; 0: one per processor.  Returns the exit
 * status of the work. */
int workers_run(struct job *job, int most);

/* Waits until the ticket is the next.  Returns 0 if the work has ended. */
int wait_for_turn(struct job *job, unsigned long long ticket);

#endif
