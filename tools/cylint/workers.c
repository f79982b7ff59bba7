/*
 * workers.c - answers all blocks of the input in several threads
 *
 * Every worker reads a block while no other reads, answers it, waits until its
 * ticket is the next, and writes.  Therefore threads exchange no data, one
 * worker runs the same code as many, and the number of workers bounds the
 * memory. A worker that reads a full block starts another worker, because more
 * input follows.  A short input, or slow input from a pipe, has one worker.
 */
#include <fcntl.h>
#include <unistd.h>

#include "../../src/bvh/threads.h"
#include "answer.h"

/* ---------------------------------------------------------------- order -- */

int wait_for_turn(struct job *job, unsigned long long ticket)
{
    pthread_mutex_lock(&job->order);
    while (!job->ended && job->next != ticket)
        pthread_cond_wait(&job->changed, &job->order);
    const int is_mine = !job->ended;
    pthread_mutex_unlock(&job->order);
    return is_mine;
}

/* Lets the following ticket write, or ends the work. */
static void pass_turn(struct job *job, int ends)
{
    pthread_mutex_lock(&job->order);
    job->next++;
    job->ended = ends;
    pthread_cond_broadcast(&job->changed);
    pthread_mutex_unlock(&job->order);
}

static int has_ended(struct job *job)
{
    pthread_mutex_lock(&job->order);
    const int ended = job->ended;
    pthread_mutex_unlock(&job->order);
    return ended;
}

/* -------------------------------------------------------------- workers -- */

static void *work(void *task);

static int has_ending(struct job *job)
{
    if (job->ending[0] < 0 && pipe(job->ending) == 0) {
        fcntl(job->ending[0], F_SETFD, FD_CLOEXEC);
        fcntl(job->ending[1], F_SETFD, FD_CLOEXEC);
        job->in.end_fd = job->ending[0];
    }
    return job->ending[0] >= 0;
}

/* If memory, threads or descriptors are short, the present workers continue. */
static void start_worker(struct job *job)
{
    struct task *task = has_ending(job) ? task_make(job) : NULL;
    if (task && cylint_thread_start(&task->thread, work, task)) {
        task->next = job->others;
        job->others = task;
        job->workers++;
        return;
    }
    if (task)
        task_free(task);
    job->most = job->workers;
}

/* Reads a block and gives it a ticket.  Returns 0 if the work has ended. */
static int read_block(struct task *task)
{
    struct job *job = task->job;
    pthread_mutex_lock(&job->reading);
    const int ended = has_ended(job);
    if (!ended) {
        input_read(&job->in, &task->block);
        task->ticket = job->tickets++;
        if (task->block.is_full && job->workers < job->most)
            start_worker(job);
    }
    pthread_mutex_unlock(&job->reading);
    return !ended;
}

static void close_end(int fd)
{
    if (fd >= 0)
        close(fd);
}

static void *work(void *context)
{
    struct task *task = context;
    struct job *job = task->job;
    while (read_block(task)) {
        const enum answered status = answer_block(task);
        if (status != OVERTAKEN)
            pass_turn(job, status == ANSWERED_LAST);
        if (status == ANSWERED_LAST)
            close_end(job->ending[1]);
    }
    return NULL;
}

/* Waits for the other workers.  None starts after the work has ended. */
static void join_workers(struct job *job)
{
    pthread_mutex_lock(&job->reading);
    struct task *task = job->others;
    pthread_mutex_unlock(&job->reading);
    while (task) {
        struct task *next = task->next;
        pthread_join(task->thread, NULL);
        task_free(task);
        task = next;
    }
    close_end(job->ending[0]);
}

static int put_first_line(struct task *task)
{
    struct job *job = task->job;
    const struct options *o = job->options;
    put_header(&task->out, options_fields(o), &o->style);
    const size_t length = task->out.length;
    task->out.length = 0;
    return output_write(&job->out, task->out.data, length);
}

int workers_run(struct job *job, int most)
{
    struct task *first = task_make(job);
    job->most = most;
    job->workers = 1;
    job->ending[0] = job->ending[1] = -1;
    if (!first)
        return out_of_memory();
    job->status = job->options->header ? put_first_line(first) : 0;
    if (job->status == 0) {
        work(first);
        join_workers(job);
    }
    task_free(first);
    return job->status;
}
