/*
 * threads.c - work that several threads share
 */
#ifdef __linux__
#define _GNU_SOURCE 1 /* sched_getaffinity() */
#include <sched.h>
#endif

#include "threads.h"

#ifdef CYLINT_THREADS
#include <unistd.h>
#endif

int cylint_processors(void)
{
#ifndef CYLINT_THREADS
    return 1;
#elif defined(_WIN32)
    return pthread_num_processors_np();
#else
#ifdef CPU_COUNT
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0)
        return CPU_COUNT(&set);
#endif
    return (int)sysconf(_SC_NPROCESSORS_ONLN);
#endif
}

int cylint_threads_for(size_t n, size_t least, int wanted)
{
    int threads = wanted > 0 ? wanted : cylint_processors();
    if (threads > CYLINT_THREADS_MOST)
        threads = CYLINT_THREADS_MOST;
    if (threads > 1 && n / least < (size_t)threads)
        threads = (int)(n / least);
    return threads > 1 ? threads : 1;
}

#ifdef CYLINT_THREADS

enum { LEAST_STACK = 1 << 20 };

int cylint_thread_start(cylint_thread *thread, void *(*work)(void *),
                        void *argument)
{
    pthread_attr_t attributes;
    size_t stack;
    if (pthread_attr_init(&attributes) != 0)
        return 0;
    if (pthread_attr_getstacksize(&attributes, &stack) == 0 &&
        stack < LEAST_STACK)
        pthread_attr_setstacksize(&attributes, LEAST_STACK);
    const int is_started =
        pthread_create(thread, &attributes, work, argument) == 0;
    pthread_attr_destroy(&attributes);
    return is_started;
}

#endif

/* Work of which each thread takes the next block. */
typedef struct {
    cylint_mutex mutex; /* protects `next` */
    size_t next, n, block;
    cylint_thread_work *work;
    void *self;
} shared_work;

/* The first item of a block that no thread has taken; n: there is none. */
static size_t take_block(shared_work *w)
{
    cylint_mutex_lock(&w->mutex);
    const size_t from = w->next;
    w->next += w->block < w->n - from ? w->block : w->n - from;
    cylint_mutex_unlock(&w->mutex);
    return from;
}

static void *do_blocks(void *argument)
{
    shared_work *w = argument;
    for (size_t from; (from = take_block(w)) < w->n;)
        w->work(w->self, from, w->block < w->n - from ? from + w->block : w->n);
    return NULL;
}

/* If the system refuses a thread, the others do its blocks. */
void cylint_threads_share(int threads, size_t n, size_t block, size_t least,
                          cylint_thread_work *work, void *self)
{
    shared_work w = {.mutex = CYLINT_MUTEX_INITIALIZER,
                     .n = n,
                     .block = block,
                     .work = work,
                     .self = self};
    cylint_thread thread[CYLINT_THREADS_MOST];
    const int most = cylint_threads_for(n, least, threads);
    int started = 1; /* with the caller's */
    while (started < most &&
           cylint_thread_start(&thread[started], do_blocks, &w))
        started++;
    do_blocks(&w);
    while (--started > 0)
        cylint_thread_join(thread[started]);
    cylint_mutex_destroy(&w.mutex);
}
