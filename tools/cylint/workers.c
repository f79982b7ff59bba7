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
    while (!job->has_ended && job->next_written != ticket)
        pthread_cond_wait(&job->changed, &job->order);
    const int is_mine = !job->has_ended;
    pthread_mutex_unlock(&job->order);
    return is_mine;
}

static void close_pipe_end(int fd)
{
    if (fd >= 0)
        close(fd);
}

/* Lets the following ticket write, or ends the work, once. */
static void pass_turn(struct job *job, int ends)
{
    pthread_mutex_lock(&job->order);
    const int is_first_end = ends && !job->has_ended;
    job->next_written++;
    job->has_ended |= ends;
    pthread_cond_broadcast(&job->changed);
    pthread_mutex_unlock(&job->order);
    if (is_first_end)
        close_pipe_end(job->end_pipe[1]);
}

static int has_ended(struct job *job)
{
    pthread_mutex_lock(&job->order);
    const int ended = job->has_ended;
    pthread_mutex_unlock(&job->order);
    return ended;
}

/* -------------------------------------------------------------- workers -- */

static void *work(void *task);

/* Opens the pipe, unless that was done.  Returns 0 if there are no descriptors. */
static int open_end_pipe(struct job *job)
{
    if (job->end_pipe[0] < 0 && pipe(job->end_pipe) == 0) {
        fcntl(job->end_pipe[0], F_SETFD, FD_CLOEXEC);
        fcntl(job->end_pipe[1], F_SETFD, FD_CLOEXEC);
        job->in.end_fd = job->end_pipe[0];
    }
    return job->end_pipe[0] >= 0;
}

/* If memory, threads or descriptors are short, the present workers continue. */
static void start_worker(struct job *job)
{
    struct task *task = open_end_pipe(job) ? task_make(job) : NULL;
    if (task && cylint_thread_start(&task->thread, work, task)) {
        task->next = job->other_tasks;
        job->other_tasks = task;
        job->workers++;
        return;
    }
    if (task)
        task_free(task);
    job->most_workers = job->workers;
}

/* Reads a block and gives it a ticket.  Returns 0 if the work has ended. */
static int read_block(struct task *task)
{
    struct job *job = task->job;
    pthread_mutex_lock(&job->reading);
    const int ended = has_ended(job);
    if (!ended) {
        input_read(&job->in, &task->block);
        task->ticket = job->next_read++;
        if (task->block.is_full && job->workers < job->most_workers)
            start_worker(job);
    }
    pthread_mutex_unlock(&job->reading);
    return !ended;
}

static void *work(void *context)
{
    struct task *task = context;
    while (read_block(task)) {
        answer_block(task);
        pass_turn(task->job, task->ends);
    }
    return NULL;
}

/* Waits for the other workers.  None starts after the work has ended. */
static void join_workers(struct job *job)
{
    pthread_mutex_lock(&job->reading);
    struct task *task = job->other_tasks;
    pthread_mutex_unlock(&job->reading);
    while (task) {
        struct task *next = task->next;
        pthread_join(task->thread, NULL);
        task_free(task);
        task = next;
    }
    close_pipe_end(job->end_pipe[0]);
}

static int write_header(struct task *task)
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
    job->most_workers = most > 0 ? most : cylint_processors();
    job->workers = 1;
    job->end_pipe[0] = job->end_pipe[1] = -1;
    if (!first)
        return out_of_memory();
    job->status = job->options->writes_header ? write_header(first) : 0;
    if (job->status == 0) {
        work(first);
        join_workers(job);
    }
    task_free(first);
    return job->status;
}
