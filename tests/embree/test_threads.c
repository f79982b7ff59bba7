/*
 * test_threads.c - eight threads get the answers of one
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

/* An answer, as bytes that can be compared. */
struct answer {
    unsigned word[RAY_MEMBERS - RAY_TFAR];
    unsigned shadowed;
    unsigned long shape, count;
    double t;
};

static struct answer answers[THREADS + 1][MOST];

static void answer_question(int number, struct answer *a)
{
    struct rays r = questions[number];
    const int last = r.n - 1;
    cylint_hit hit;
    memset(a, 0, sizeof *a);
    rays_intersect(&r, w.scene, NULL);
    for (int m = RAY_TFAR; m < RAY_MEMBERS; m++)
        a->word[m - RAY_TFAR] = rays_at(&r, (enum ray_member)m, last)->u;
    const cylint_line line = rays_line(&r, last);
    memcpy(r.word, r.before, sizeof r.word);
    rays_occluded(&r, w.scene, NULL);
    a->shadowed = (unsigned)rays_shadowed(&r, last);
    a->shape =
        (unsigned long)cylint_scene_nearest(scene, &line, CYLINT_WANT_T, &hit);
    a->t = a->shape < SOME ? hit.t : 0;
    a->count = (unsigned long)cylint_scene_count(scene, &line, 0);
}

static void *work(void *p)
{
    const int thread = *(const int *)p;
    treat_subnormals(thread & 3);
    for (int i = 0; i < n_questions; i++) {
        const int number = (i + thread * (n_questions / THREADS)) % n_questions;
        answer_question(number, &answers[thread][number]);
    }
    return NULL;
}

TEST(eight_threads_get_the_answers_of_one)
{
    cylint_shape shapes[SOME];
    pthread_t thread[THREADS];
    int number[THREADS + 1];
    long hits = 0;
    world_shapes(SCENE_MIXED, shapes, SOME);
    scene = cylint_scene_new(shapes, SOME, 1, NULL);
    w = world_made(shapes, SOME, NULL);
    n_questions = (int)check_setting("CYLINT_CASES", 2000);
    if (!CHECK(scene && n_questions > 0 && n_questions <= MOST))
        return;
    for (int i = 0; i < n_questions; i++)
        aim_all(&questions[i], rays_sizes[i % 4]);
    for (int i = 0; i <= THREADS; i++)
        number[i] = i;
    work(&number[THREADS]); /* alone, before the others */
    for (int i = 0; i < THREADS; i++)
        CHECK(pthread_create(&thread[i], NULL, work, &number[i]) == 0);
    for (int i = 0; i < THREADS; i++)
        pthread_join(thread[i], NULL);
    for (int i = 0; i < n_questions; i++) {
        const struct answer *alone = &answers[THREADS][i];
        const int hit = alone->word[HIT_GEOM - RAY_TFAR] == 0;
        hits += hit;
        CHECK((alone->shape < SOME) == hit && hit == (int)alone->shadowed);
        for (int t = 0; t < THREADS; t++)
            if (!CHECK(memcmp(&answers[t][i], alone, sizeof *alone) == 0))
                REPORT("question %d, thread %d", i, t);
    }
    CHECK(hits > n_questions / 10);
    cylint_scene_free(scene);
    world_free(&w);
}
