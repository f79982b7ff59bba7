/*
 * embree_threads.c - rays a second of 1, 2, ... threads on one scene
 *
 * usage: embree_threads MOST N
 *
 * Each of 1 to MOST threads traces all incoherent rays of embree.c through N
 * thin cylinders.  The time is elapsed time, the least of several turns.
 */
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "embree_rivals.h"

enum { RAYS = 200000, TURNS = 5, MOST_THREADS = 256 };

struct worker {
    const struct rival *rival;
    const struct rays *rays;
    long hits;
};

static void *trace(void *self)
{
    struct worker *w = self;
    double t;
    w->hits = trace_nearest(w->rival, w->rays, &t);
    return NULL;
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Seconds that the threads take.  *hits: the hits of each thread, compared
 * with those before; negative: none before. */
static double race(const struct rival *rival, const struct rays *rays,
                   int threads, long *hits)
{
    struct worker worker[MOST_THREADS];
    pthread_t thread[MOST_THREADS];
    const double begin = now();
    for (int i = 0; i < threads; i++) {
        worker[i] = (struct worker){rival, rays, 0};
        if (pthread_create(&thread[i], NULL, trace, &worker[i]) != 0) {
            fprintf(stderr,
                    "embree_threads: cannot start more than %d threads\n", i);
            exit(1);
        }
    }
    for (int i = 0; i < threads; i++) {
        pthread_join(thread[i], NULL);
        if (*hits < 0)
            *hits = worker[i].hits;
        if (worker[i].hits != *hits) {
            fprintf(stderr,
                    "embree_threads: one thread has %ld hits, another %ld\n",
                    worker[i].hits, *hits);
            exit(1);
        }
    }
    return now() - begin;
}

int main(int argc, char **argv)
{
    const int wanted = argc > 1 ? atoi(argv[1]) : 2;
    const int most = wanted < MOST_THREADS ? wanted : MOST_THREADS;
    const size_t n = argc > 2 ? (size_t)atof(argv[2]) : 1000000;
    struct cylinders cylinders = draw_cylinders(&thin, n);
    struct rays rays = draw_incoherent_rays(RAYS);
    struct rival rival = build_shapes(&cylinders, 0, "threads=1");
    double least[MOST_THREADS];
    long hits = -1;
    for (int i = 0; i < most; i++)
        least[i] = HUGE_VAL;
    for (int turn = 0; turn < TURNS; turn++)
        for (int i = 0; i < most; i++)
            least[i] = fmin(least[i], race(&rival, &rays, i + 1, &hits));
    puts("# higher is better: Mray/s, and its ratio to one thread");
    printf("threads\tMray/s\tratio\n");
    for (int i = 0; i < most; i++)
        printf("%d\t%.3f\t%.2f\n", i + 1, (i + 1) * rays.n / least[i] * 1e-6,
               (i + 1) * least[0] / least[i]);
    free_rival(&rival);
    free_rays(&rays);
    free_cylinders(&cylinders);
    return 0;
}
