/*
 * trace.c - traces the rows of a picture on several threads
 *
 * A worker takes the next free row; a pixel depends on its place only.
 */
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "colours.h"
#include "light.h"
#include "report.h"
#include "sampling.h"
#include "view.h"

struct work {
    const struct drawing *drawing;
    const struct stage *stage;
    const struct backdrop *backdrop;

    pthread_mutex_t lock; /* protects the members below */
    int next_row, rows_done, status;
    struct progress progress;
};

static struct sample pixel_of_samples(const struct work *w,
                                      struct tracer *tracer, int x, int y)
{
    const struct drawing *d = w->drawing;
    const struct picture *p = d->picture;
    const uint32_t seed = hash_words((uint32_t)x, (uint32_t)y);
    struct sample sum = {vector(0, 0, 0), 0};
    for (int i = 0; i < d->samples; i++) {
        cylint_line ray;
        view_sample(d->view, p->width, p->height, x, y, i, d->samples, &ray);
        const struct sample one = trace_sample(tracer, &ray, (uint32_t)i, seed);
        sum.light = plus(sum.light, 1, one.light);
        sum.opacity += one.opacity;
    }
    const double share = 1.0 / d->samples;
    return (struct sample){times(share, sum.light), share * sum.opacity};
}

/* Bright light saturates slowly instead of being clipped. */
static double exposed(double light)
{
    return 1 - exp(-light);
}

static void put_pixel(const struct work *w, int y, struct sample mean,
                      unsigned char *bytes)
{
    const struct backdrop *b = w->backdrop;
    const double down = (y + 0.5) / w->drawing->picture->height;
    const struct vector behind = mixed(b->top, b->bottom, down);
    for (int i = 0; i < 3; i++) {
        const double light =
            mean.opacity > 0 ? exposed(mean.light.v[i] / mean.opacity) : 0;
        bytes[i] = byte_of_light(b->transparent
                                     ? light
                                     : mean.opacity * light +
                                           (1 - mean.opacity) * behind.v[i]);
    }
    if (b->transparent)
        bytes[3] = (unsigned char)(255 * mean.opacity + 0.5);
}

static void trace_row(const struct work *w, struct tracer *tracer, int y)
{
    const struct picture *p = w->drawing->picture;
    unsigned char *bytes =
        p->pixels + (size_t)y * (size_t)p->width * (size_t)p->channels;
    for (int x = 0; x < p->width; x++, bytes += p->channels)
        put_pixel(w, y, pixel_of_samples(w, tracer, x, y), bytes);
}

static void *take_rows(void *context)
{
    struct work *w = context;
    const int rows = w->drawing->picture->height;
    struct tracer tracer;
    memset(&tracer, 0, sizeof tracer);
    tracer.stage = w->stage;
    pthread_mutex_lock(&w->lock);
    while (w->next_row < rows && w->status == 0) {
        const int y = w->next_row++;
        pthread_mutex_unlock(&w->lock);
        trace_row(w, &tracer, y);
        pthread_mutex_lock(&w->lock);
        if (tracer.has_failed && w->status == 0)
            w->status = out_of_memory();
        w->rows_done++;
        progress_add(&w->progress, 1, w->rows_done, rows);
    }
    pthread_mutex_unlock(&w->lock);
    piece_memory_free(&tracer.memory);
    return NULL;
}

/* The caller is the first worker.  If the system refuses threads, there are
 * fewer. */
int trace(const struct drawing *d, const struct stage *stage,
          const struct backdrop *backdrop)
{
    struct work w = {.drawing = d,
                     .stage = stage,
                     .backdrop = backdrop,
                     .lock = PTHREAD_MUTEX_INITIALIZER};
    const int rows = d->picture->height;
    const int most = d->workers < rows ? d->workers : rows;
    pthread_t *others = malloc((size_t)most * sizeof *others);
    int started = 0;
    if (!others)
        return out_of_memory();
    progress_start(&w.progress, d->progress, "rows", 0);
    while (started < most - 1 &&
           pthread_create(&others[started], NULL, take_rows, &w) == 0)
        started++;
    take_rows(&w);
    while (started > 0)
        pthread_join(others[--started], NULL);
    progress_end(&w.progress);
    free(others);
    return w.status;
}
