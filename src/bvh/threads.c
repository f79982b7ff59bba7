/*
 * threads.c - work that several threads share
 */
#include "threads.h"

#ifdef CYLINT_THREADS

#ifdef _WIN32
#include <windows.h>
#else
#include <unistd.h>
#endif

static long processors(void)
{
#ifdef _WIN32
    SYSTEM_INFO info;
    GetSystemInfo(&info);
    return (long)info.dwNumberOfProcessors;
#else
    return sysconf(_SC_NPROCESSORS_ONLN);
#endif
}

/* The items of one thread. */
typedef struct {
    pthread_t thread;
    cylint_thread_work *work;
    void *self;
    size_t from, to;
} job;

static void *run_job(void *argument)
{
    const job *j = argument;
    j->work(j->self, j->from, j->to);
    return NULL;
}

void cylint_threads_run(int threads, size_t n, cylint_thread_work *work,
                        void *self)
{
    job jobs[CYLINT_THREADS_MOST];
    const size_t each = n / (size_t)threads, more = n % (size_t)threads;
    int started = 1;
    for (size_t i = 0, from = 0; i < (size_t)threads; i++) {
        const size_t to = from + each + (i < more);
        jobs[i] = (job){.work = work, .self = self, .from = from, .to = to};
        from = to;
    }
    while (started < threads && pthread_create(&jobs[started].thread, NULL,
                                               run_job, &jobs[started]) == 0)
        started++;
    run_job(&jobs[0]);
    for (int i = started; i < threads; i++)
        run_job(&jobs[i]);
    for (int i = 1; i < started; i++)
        pthread_join(jobs[i].thread, NULL);
}

static long smaller(long x, long y)
{
    return x < y ? x : y;
}

/* The number of threads, each with at least `least` of n items. */
static int threads_for(size_t n, size_t least, int wanted)
{
    const long most = wanted > 0 ? wanted : processors();
    const size_t busy = n / least;
    const long threads =
        smaller(smaller(most, CYLINT_THREADS_MOST),
                busy < CYLINT_THREADS_MOST ? (long)busy : CYLINT_THREADS_MOST);
    return threads > 1 ? (int)threads : 1;
}

#else

static int threads_for(size_t n, size_t least, int wanted)
{
    (void)n;
    (void)least;
    (void)wanted;
    return 1;
}

void cylint_threads_run(int threads, size_t n, cylint_thread_work *work,
                        void *self)
{
    (void)threads;
    work(self, 0, n);
}

#endif

/* The least number of shapes for a thread.  They take 3 ms, far more than
 * starting the thread. */
enum { LEAST_SHAPES = 4096 };

int cylint_threads_for(size_t n, int wanted)
{
    return threads_for(n, LEAST_SHAPES, wanted);
}

/* -------------------------------------------------------------- blocks -- */

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

static void do_blocks(void *self, size_t first, size_t last)
{
    shared_work *w = self;
    (void)first;
    (void)last;
    for (size_t from; (from = take_block(w)) < w->n;)
        w->work(w->self, from, w->block < w->n - from ? from + w->block : w->n);
}

void cylint_threads_share(int threads, size_t n, size_t block, size_t least,
                          cylint_thread_work *work, void *self)
{
    shared_work w = {.mutex = CYLINT_MUTEX_INITIALIZER,
                     .n = n,
                     .block = block,
                     .work = work,
                     .self = self};
    threads = threads_for(n, least, threads);
    cylint_threads_run(threads, (size_t)threads, do_blocks, &w);
    cylint_mutex_destroy(&w.mutex);
}
