/*
 * threads.c - threads that share work, where there are any
 */
#include "threads.h"

#ifdef CYLINT_THREADS

#include <unistd.h>

/* One thread's share. */
typedef struct {
    pthread_t thread;
    cylint_thread_work *part;
    void *self;
    size_t from, to;
} share;

static void *do_share(void *argument)
{
    const share *s = argument;
    s->part(s->self, s->from, s->to);
    return NULL;
}

void cylint_threads_run(int threads, size_t n, cylint_thread_work *part,
                        void *self)
{
    share shares[CYLINT_THREADS_MOST];
    const size_t each = n / (size_t)threads, more = n % (size_t)threads;
    int started = 1;
    for (size_t i = 0, from = 0; i < (size_t)threads; i++) {
        const size_t to = from + each + (i < more);
        shares[i] = (share){.part = part, .self = self, .from = from, .to = to};
        from = to;
    }
    while (started < threads && pthread_create(&shares[started].thread, NULL,
                                               do_share, &shares[started]) == 0)
        started++;
    do_share(&shares[0]);
    for (int i = started; i < threads; i++)
        do_share(&shares[i]);
    for (int i = 1; i < started; i++)
        pthread_join(shares[i].thread, NULL);
}

static long smaller(long x, long y)
{
    return x < y ? x : y;
}

/* For so many shapes, 3 ms of work, a thread is worth its making by far. */
enum { LEAST_SHARE = 4096 };

int cylint_threads_for(size_t n, int wanted)
{
    const long most = wanted > 0 ? wanted : sysconf(_SC_NPROCESSORS_ONLN);
    const size_t busy = n / LEAST_SHARE;
    const long threads =
        smaller(smaller(most, CYLINT_THREADS_MOST),
                busy < CYLINT_THREADS_MOST ? (long)busy : CYLINT_THREADS_MOST);
    return threads > 1 ? (int)threads : 1;
}

#else

void cylint_threads_run(int threads, size_t n, cylint_thread_work *part,
                        void *self)
{
    (void)threads;
    part(self, 0, n);
}

int cylint_threads_for(size_t n, int wanted)
{
    (void)n;
    (void)wanted;
    return 1;
}

#endif
