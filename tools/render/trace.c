/*
 * trace.c - traces the rows of a picture on several threads
 *
 * A pixel depends on its place only.
 */
#include <pthread.h>

#include "../../src/bvh/threads.h"
#include "colours.h"
#include "light.h"
#include "report.h"
#include "sampling.h"
#include "view.h"

struct work {
    const struct drawing *drawing;
    const struct stage *stage;

    pthread_mutex_t lock; /* protects the members below */
    int has_failed;
    size_t rows_done;
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
    const struct backdrop *b = w->stage->backdrop;
    const double down = (y + 0.5) / w->drawing->picture->height;
    const struct vector behind = mixed(b->top, b->bottom, down);
    for (int i = 0; i < 3; i++) {
        const double light =
            mean.opacity > 0 ? exposed(mean.light.v[i] / mean.opacity) : 0;
        bytes[i] = byte_of_light(b->is_transparent
                                     ? light
                                     : mean.opacity * light +
                                           (1 - mean.opacity) * behind.v[i]);
    }
    if (b->is_transparent)
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

/* Each row is traced by one thread, which begins without memory for pieces. */
static void trace_rows(void *work, size_t from, size_t to)
{
    struct work *w = work;
    struct tracer tracer = {.stage = w->stage};
    for (size_t y = from; y < to && !tracer.has_failed; y++)
        trace_row(w, &tracer, (int)y);
    pthread_mutex_lock(&w->lock);
    w->has_failed |= tracer.has_failed;
    w->rows_done += to - from;
    progress_add(&w->progress, to - from, (double)w->rows_done,
                 w->drawing->picture->height);
    pthread_mutex_unlock(&w->lock);
    piece_memory_free(&tracer.memory);
}

int trace(const struct drawing *d, const struct stage *stage)
{
    struct work w = {
        .drawing = d, .stage = stage, .lock = PTHREAD_MUTEX_INITIALIZER};
    progress_start(&w.progress, d->shows_progress, -1, "rows", 0);
    cylint_threads_share(d->workers, (size_t)d->picture->height, 1, 1,
                         trace_rows, &w);
    progress_end(&w.progress);
    return w.has_failed ? out_of_memory() : 0;
}
