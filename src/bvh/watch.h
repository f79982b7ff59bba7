/*
 * watch.h - the progress of a build, and whether its caller stops it
 */
#ifndef CYLINT_BVH_WATCH_H
#define CYLINT_BVH_WATCH_H

#include <stddef.h>

#include "threads.h"

/* Items between two reports of one thread.  They take some milliseconds. */
enum { CYLINT_WATCHED = 4096 };

/* The steps of a build, and their parts of its time in percent, measured with
 * 10^6 thin cylinders.  Threads share the items of a step. */
typedef enum cylint_step {
    CYLINT_STEP_COUNT = 8,
    CYLINT_STEP_SPLIT = 26,
    CYLINT_STEP_NODES = 44,
    CYLINT_STEP_LEAVES = 22
} cylint_step;

typedef struct cylint_watch {
    int (*progress)(void *context, double part); /* returns 0 to stop */
    void *context;
    cylint_thread caller; /* the only thread that calls progress() */
    int before, step;   /* percent of the build: before this step; this step */
    size_t total;       /* items of this step */
    cylint_mutex mutex; /* protects the members below */
    size_t done;        /* items of this step */
    int stopped;
} cylint_watch;

/* A pointer to a watch may be NULL: the build then never stops. */

/* Begins the next step. */
void cylint_watch_step(cylint_watch *w, cylint_step step, size_t total);

/* Adds items that are done, and reports them in the caller's thread.  Returns 0
 * if the build is to stop. */
int cylint_watch_add(cylint_watch *w, size_t items);

/* Called before item i of a loop; adds the items in groups.  Returns 0 if the
 * build is to stop. */
static inline int cylint_watch_item(cylint_watch *w, size_t i)
{
    return i % CYLINT_WATCHED != 0 || cylint_watch_add(w, CYLINT_WATCHED);
}

#endif
