/*
 * test_threads.c - eight threads get the library's answers
 *
 * Every thread traces all single rays and packets, nearest and occluded,
 * through one geometry of the adapter and one cylint_scene, each in another
 * order.  The processor's subnormal modes differ from thread to thread; the
 * answers must not.  `make check-threads` runs this under the thread sanitizer.
 * CYLINT_CASES sets the number of questions.
 */
#include <pthread.h>

#include "cylint_scene.h"
#include "embree_world.h"
#include "environment.h"

enum { THREADS = 8, MOST = 1 << 14 };

static int n_questions;
static struct world w;
static cylint_scene *scene;
static struct rays questions[MOST];

struct worker {
    pthread_t thread;
    int number;
    long hits, wrong;
};

/* Of the last ray: its nearest hit, whether it is occluded, and of the scene the
 * nearest shape, t and the number of shapes. */
static void answer_question(int number, struct worker *to)
{
    struct rays r = questions[number];
    const int last = r.n - 1;
    cylint_hit hit = {.t = 0}, due = hit;
    rays_intersect(&r, w.scene, NULL);
    const cylint_line line = rays_line(&r, last);
    const int is_hit = rays_hit(&r, last);
    to->hits += is_hit;
    to->wrong += !world_agrees(&w, &r, last);
    memcpy(r.word, r.before, sizeof r.word);
    rays_occluded(&r, w.scene, NULL);
    to->wrong +=
        rays_shadowed(&r, last) != is_hit ||
        cylint_scene_nearest(scene, &line, CYLINT_WANT_T, &hit) !=
            cylint_nearest(&w.pack, &line, CYLINT_WANT_T, &due) ||
        hit.t != due.t ||
        cylint_scene_count(scene, &line, 0) != cylint_count(&w.pack, &line, 0);
}

static void *work(void *p)
{
    struct worker *me = p;
    treat_subnormals(me->number & 3);
    for (int i = 0; i < n_questions; i++)
        answer_question(
            (i + me->number * (n_questions / THREADS)) % n_questions, me);
    return NULL;
}

TEST(eight_threads_get_the_answers_of_one)
{
    cylint_shape shapes[SOME];
    struct worker worker[THREADS] = {{.number = 0}};
    world_shapes(SCENE_MIXED, shapes, SOME);
    scene = cylint_scene_new(shapes, SOME, 1, NULL);
    w = world_made(shapes, SOME, NULL);
    n_questions = (int)check_setting("CYLINT_CASES", 2000);
    if (!CHECK(scene && n_questions > 0 && n_questions <= MOST))
        return;
    for (int i = 0; i < n_questions; i++)
        aim_all(&questions[i], rays_sizes[i % 4]);
    for (int i = 0; i < THREADS; i++) {
        worker[i].number = i;
        CHECK(pthread_create(&worker[i].thread, NULL, work, &worker[i]) == 0);
    }
    for (int i = 0; i < THREADS; i++) {
        pthread_join(worker[i].thread, NULL);
        if (!CHECK(worker[i].wrong == 0 && worker[i].hits > n_questions / 10))
            REPORT("thread %d: %ld wrong answers, %ld hits", i, worker[i].wrong,
                   worker[i].hits);
    }
    cylint_scene_free(scene);
    world_free(&w);
}
