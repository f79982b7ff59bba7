/*
 * threads.h - work that several threads share
 *
 * With CYLINT_THREADS these are POSIX threads.  Without it the caller does all
 * the work.  The result of the work must not depend on how it is divided.
 */
#ifndef CYLINT_BVH_THREADS_H
#define CYLINT_BVH_THREADS_H

#include <stddef.h>

enum { CYLINT_THREADS_MOST = 64 };

/* The least number of shapes for a thread.  They take 3 ms, far more than starting
 * the thread. */
enum { CYLINT_THREADS_LEAST_SHAPES = 4096 };

/* The number of processors that the process may use (taskset, cpusets), where the
 * system is Linux; else of those on line.  Below 1: unknown. */
int cylint_processors(void);

/* The number of threads, each with at least `least` of n items, at most `wanted`
 * and at most CYLINT_THREADS_MOST.  wanted = 0: one for every processor. */
int cylint_threads_for(size_t n, size_t least, int wanted);

/* Does items [from, to) of the work. */
typedef void cylint_thread_work(void *self, size_t from, size_t to);

/* Calls `work` for n items, each once, in blocks of at most `block` items.  A
 * thread takes the next block when it has done one, so items may differ in cost.
 * Each thread, the caller's included, gets at least `least` items on average;
 * threads: at most, as for cylint_threads_for().  Uses fewer if the system refuses
 * threads. */
void cylint_threads_share(int threads, size_t n, size_t block, size_t least,
                          cylint_thread_work *work, void *self);

/* cylint_thread_self() is the calling thread; cylint_thread_is() returns whether
 * it is the given one.
 *
 * cylint_thread_start() starts a thread, or returns 0 if the system refuses it.
 * The stack has space for exact numbers, which take up to 200 kB; musl's default
 * is 128 kB.
 *
 * A mutex does not allocate. */
#ifdef CYLINT_THREADS

#include <pthread.h>

typedef pthread_t cylint_thread;
typedef pthread_mutex_t cylint_mutex;

#define CYLINT_MUTEX_INITIALIZER PTHREAD_MUTEX_INITIALIZER
#define cylint_thread_self() pthread_self()
#define cylint_thread_is(thread) pthread_equal(*(thread), pthread_self())
#define cylint_thread_join(thread) pthread_join(thread, NULL)
#define cylint_mutex_lock(m) pthread_mutex_lock(m)
#define cylint_mutex_unlock(m) pthread_mutex_unlock(m)
#define cylint_mutex_destroy(m) pthread_mutex_destroy(m)

int cylint_thread_start(cylint_thread *thread, void *(*work)(void *),
                        void *argument);

#else

typedef char cylint_thread, cylint_mutex;

#define CYLINT_MUTEX_INITIALIZER 0
#define cylint_thread_self() 0
#define cylint_thread_is(thread) 1
#define cylint_thread_join(thread) ((void)0)
#define cylint_thread_start(thread, work, argument) ((void)(thread), 0)
#define cylint_mutex_lock(m) ((void)(m))
#define cylint_mutex_unlock(m) ((void)(m))
#define cylint_mutex_destroy(m) ((void)(m))

#endif

#endif
