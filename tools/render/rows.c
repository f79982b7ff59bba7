/*
 * rows.c - computes the rows of a picture on several threads
 */
#include <pthread.h>

#include "../../src/bvh/threads.h"
#include "picture.h"
#include "report.h"

struct work {
    const struct drawing *drawing;
    row_function *draw;
    const void *how;

    pthread_mutex_t lock; /* protects the members below */
    int has_failed;
    size_t rows_done;
    struct progress progress;
};

static void draw_some(void *work, size_t from, size_t to)
{
    struct work *w = work;
    int has_memory = 1;
    for (size_t y = from; y < to && has_memory; y++)
        has_memory = w->draw(w->drawing, w->how, (int)y);
    pthread_mutex_lock(&w->lock);
    w->has_failed |= !has_memory;
    w->rows_done += to - from;
    progress_add(&w->progress, to - from, (double)w->rows_done,
                 w->drawing->picture->height);
    pthread_mutex_unlock(&w->lock);
}

int draw_rows(const struct drawing *d, row_function *draw, const void *how)
{
    struct work w = {.drawing = d,
                     .draw = draw,
                     .how = how,
                     .lock = PTHREAD_MUTEX_INITIALIZER};
    progress_start(&w.progress, d->shows_progress, -1, "rows", 0);
    cylint_threads_share(d->workers, (size_t)d->picture->height, 1, 1,
                         draw_some, &w);
    progress_end(&w.progress);
    return w.has_failed ? out_of_memory() : 0;
}
