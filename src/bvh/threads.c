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

/* The least number of shapes for a thread.  They take 3 ms, far more than
 * starting the thread. */
enum { LEAST_SHAPES = 4096 };

int cylint_threads_for(size_t n, int wanted)
{
    const long most = wanted > 0 ? wanted : processors();
    const size_t busy = n / LEAST_SHAPES;
    const long threads =
        smaller(smaller(most, CYLINT_THREADS_MOST),
                busy < CYLINT_THREADS_MOST ? (long)busy : CYLINT_THREADS_MOST);
    return threads > 1 ? (int)threads : 1;
}

#else

void cylint_threads_run(int threads, size_t n, cylint_thread_work *work,
                        void *self)
{
    (void)threads;
    work(self, 0, n);
}

int cylint_threads_for(size_t n, int wanted)
{
    (void)n;
    (void)wanted;
    return 1;
}

#endif
