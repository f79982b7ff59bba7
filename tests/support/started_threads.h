/*
 * started_threads.h - pthread_create(), which counts threads and can refuse them
 *
 * The linker puts this function in place of the library's (--wrap).
 */
#ifndef CYLINT_TEST_STARTED_THREADS_H
#define CYLINT_TEST_STARTED_THREADS_H

#include <errno.h>
#include <pthread.h>
#include <stdint.h>

/* Threads are started until so many are; NO_LIMIT: all are. */
enum { NO_LIMIT = 1000 };
static int threads_started, most_threads = NO_LIMIT;
static size_t least_stack = SIZE_MAX; /* of a thread */

int __real_pthread_create(pthread_t *, const pthread_attr_t *,
                          void *(*)(void *), void *);
int __wrap_pthread_create(pthread_t *, const pthread_attr_t *,
                          void *(*)(void *), void *);

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                          void *(*function)(void *), void *argument)
{
    size_t stack = 0;
    if (threads_started == most_threads)
        return EAGAIN;
    threads_started++;
    if (attributes)
        pthread_attr_getstacksize(attributes, &stack);
    least_stack = stack < least_stack ? stack : least_stack;
    return __real_pthread_create(thread, attributes, function, argument);
}

#endif
