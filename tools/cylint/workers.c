/*
 * workers.c - all blocks of the input, by as many threads as are worth it
 *
 * Every worker does everything: it reads a block while no other does, answers
 * it, waits for its turn and writes.  So nothing is handed over, one worker
 * runs the same code as many, and memory is bounded by the number of workers.
 * A worker that reads a full block, behind which there must be more, hires
 * the next: a short input, or a slow partner on a pipe, has but one.
 */
#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include "main.h"
#include "workers.h"

struct crew;

struct worker {
    struct crew *crew;
    struct block block;
    pthread_t thread;
    struct worker *next;
};

struct crew {
    struct job *job;
    pthread_mutex_t reading; /* for job->in and what stands below */
    unsigned long long tickets;
    int most, count;
    struct worker *hired; /* all but the first */

    int ending[2]; /* a pipe: closed when the work is over, so that a worker
                      that waits for input hears of it; made before there is
                      more than one, else -1 */
};

static void *work(void *worker);

static struct worker *make_worker(struct crew *crew)
{
    struct worker *w = malloc(sizeof *w);
    if (w) {
        w->crew = crew;
        w->next = NULL;
        if (job_block(crew->job, &w->block)) {
            return w;
        }
        block_free(&w->block);
        free(w);
    }
    return NULL;
}

static void free_worker(struct worker *w)
{
    block_free(&w->block);
    free(w);
}

static int has_ending(struct crew *crew)
{
    if (crew->ending[0] < 0 && pipe(crew->ending) == 0) {
        fcntl(crew->ending[0], F_SETFD, FD_CLOEXEC);
        fcntl(crew->ending[1], F_SETFD, FD_CLOEXEC);
        crew->job->in.ending = crew->ending[0];
    }
    return crew->ending[0] >= 0;
}

/* Where memory, threads or descriptors are short, those there are go on. */
static void hire(struct crew *crew)
{
    struct worker *w = has_ending(crew) ? make_worker(crew) : NULL;
    if (w && pthread_create(&w->thread, NULL, work, w) == 0) {
        w->next = crew->hired;
        crew->hired = w;
        crew->count++;
        return;
    }
    if (w) {
        free_worker(w);
    }
    crew->most = crew->count;
}

/* Returns 0 if the work is over; else there is a block whose turn comes. */
static int take_block(struct crew *crew, struct block *b)
{
    pthread_mutex_lock(&crew->reading);
    const int over = turns_over(&crew->job->turns);
    if (!over) {
        input_take(&crew->job->in, b);
        b->ticket = crew->tickets++;
        if (b->full && crew->count < crew->most) {
            hire(crew);
        }
    }
    pthread_mutex_unlock(&crew->reading);
    return !over;
}

static void close_end(int fd)
{
    if (fd >= 0) {
        close(fd);
    }
}

static void *work(void *worker)
{
    struct worker *w = worker;
    struct crew *crew = w->crew;
    struct job *job = crew->job;
    struct block *b = &w->block;
    while (take_block(crew, b)) {
        switch (answer_block(job, b)) {
        case ANSWERED:
            turns_pass(&job->turns);
            break;
        case ANSWERED_LAST:
            turns_end(&job->turns);
            close_end(crew->ending[1]);
            break;
        default: /* OVERTAKEN */
            break;
        }
    }
    return NULL;
}

/* Nobody is hired any more once the work is over and nobody is reading. */
static void dismiss(struct crew *crew)
{
    pthread_mutex_lock(&crew->reading);
    struct worker *w = crew->hired;
    pthread_mutex_unlock(&crew->reading);
    while (w) {
        struct worker *next = w->next;
        pthread_join(w->thread, NULL);
        free_worker(w);
        w = next;
    }
    close_end(crew->ending[0]);
    pthread_mutex_destroy(&crew->reading);
}

int workers_run(struct job *job, int most)
{
    struct crew crew = {job,     PTHREAD_MUTEX_INITIALIZER, 0, most, 1, NULL,
                        {-1, -1}};
    struct worker *first = make_worker(&crew);
    if (!first) {
        return out_of_memory();
    }
    work(first);
    dismiss(&crew);
    free_worker(first);
    return job->status;
}
