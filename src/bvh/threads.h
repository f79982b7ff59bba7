/*
 * threads.h - threads that share work, where there are any
 *
 * With CYLINT_THREADS they are POSIX threads; without, the caller does all.
 * What comes out must not depend on who does what.
 */
#ifndef CYLINT_BVH_THREADS_H
#define CYLINT_BVH_THREADS_H

#include <stddef.h>

enum { CYLINT_THREADS_MOST = 64 };

/* How many of the wanted threads, 0 standing for one a processor, find enough
 * to do in n shapes; CYLINT_THREADS_MOST at most. */
int cylint_threads_for(size_t n, int wanted);

/* Does [from, to) of n things. */
typedef void cylint_thread_work(void *self, size_t from, size_t to);

/* All n, each once, by so many threads, of which the caller is one, and not by
 * so many if no more are to be had. */
void cylint_threads_run(int threads, size_t n, cylint_thread_work *part,
                        void *self);

/* A lock for what the members of a crew share, and a bell to wait for under
 * it: waiting opens the lock, ringing wakes all. */
#ifdef CYLINT_THREADS

#include <pthread.h>

typedef struct cylint_mutex {
    pthread_mutex_t mutex;
    pthread_cond_t bell;
} cylint_mutex;

/* Neither allocates where both are initialised so. */
#define CYLINT_MUTEX_INITIALIZER                            \
    {                                                       \
        PTHREAD_MUTEX_INITIALIZER, PTHREAD_COND_INITIALIZER \
    }

static inline void cylint_mutex_lock(cylint_mutex *l)
{
    pthread_mutex_lock(&l->mutex);
}

static inline void cylint_mutex_unlock(cylint_mutex *l)
{
    pthread_mutex_unlock(&l->mutex);
}

static inline void cylint_mutex_wait(cylint_mutex *l)
{
    pthread_cond_wait(&l->bell, &l->mutex);
}

static inline void cylint_mutex_wake_all(cylint_mutex *l)
{
    pthread_cond_broadcast(&l->bell);
}

static inline void cylint_mutex_destroy(cylint_mutex *l)
{
    pthread_cond_destroy(&l->bell);
    pthread_mutex_destroy(&l->mutex);
}

#else

typedef char cylint_mutex;
#define CYLINT_MUTEX_INITIALIZER 0

static inline void cylint_mutex_lock(cylint_mutex *l)
{
    (void)l;
}
static inline void cylint_mutex_unlock(cylint_mutex *l)
{
    (void)l;
}
static inline void cylint_mutex_wait(cylint_mutex *l)
{
    (void)l;
}
static inline void cylint_mutex_wake_all(cylint_mutex *l)
{
    (void)l;
}
static inline void cylint_mutex_destroy(cylint_mutex *l)
{
    (void)l;
}

#endif

#endif
