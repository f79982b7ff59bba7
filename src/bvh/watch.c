/*
 * watch.c - the progress of a build, and whether its caller stops it
 */
#include "watch.h"

void cylint_watch_step(cylint_watch *w, cylint_step step, size_t total)
{
    if (!w)
        return;
    w->before += w->step;
    w->step = (int)step;
    w->total = total;
    cylint_mutex_lock(&w->mutex);
    w->done = 0;
    cylint_mutex_unlock(&w->mutex);
}

/* The part of the build that is done.  Groups of items may add up to more than
 * the step has. */
static double part_done(const cylint_watch *w, size_t done)
{
    const double of_step =
        done < w->total ? (double)done / (double)w->total : 1;
    return (w->before + w->step * of_step) / 100;
}

int cylint_watch_add(cylint_watch *w, size_t items)
{
    if (!w)
        return 1;
    cylint_mutex_lock(&w->mutex);
    const size_t done = w->done += items;
    const int stopped = w->stopped;
    cylint_mutex_unlock(&w->mutex);
    if (stopped || !cylint_thread_is(&w->caller))
        return !stopped;
    /* without the mutex, so that no thread waits for the caller's function */
    if (w->progress(w->context, part_done(w, done)))
        return 1;
    cylint_mutex_lock(&w->mutex);
    w->stopped = 1;
    cylint_mutex_unlock(&w->mutex);
    return 0;
}
