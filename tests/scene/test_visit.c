/*
 * test_visit.c - floor scene: a visit finds each shape once, and no other
 *
 * Bundles of long shapes of several pieces, so that more of them are found than
 * the set of a visit holds.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "cylint_scene.h"
#include "random.h"

enum { SHAPES = 700, BUNDLES = 12, QUESTIONS = 40 };

static cylint_shape shapes[SHAPES];

/* Nearly parallel shapes of the length 1 that begin within `width` of 0. */
static cylint_scene *bundle(uint64_t *random, double width)
{
    for (int i = 0; i < SHAPES; i++) {
        const double r = 0.002 + 0.004 * random_unit(random);
        double p[3], q[3], h[3], a[3] = {r, 0, 0.3 * r}, b[3] = {0, 2 * r, 0};
        for (int j = 0; j < 3; j++) {
            p[j] = width * (random_unit(random) - 0.5);
            h[j] = 0.6 + 0.1 * random_unit(random);
            q[j] = p[j] + h[j];
        }
        switch (i % 4) {
        case 0:
            cylint_cylinder(&shapes[i], p, q, r, CYLINT_ENDS_CAPPED);
            break;
        case 1:
            cylint_cone(&shapes[i], p, r, q, 0, CYLINT_ENDS_OPEN);
            break;
        case 2:
            cylint_round_cone(&shapes[i], p, r, q, 2 * r, CYLINT_ENDS_CAPPED);
            break;
        default:
            cylint_elliptic_cone(&shapes[i], p, a, b, h, 0.5,
                                 CYLINT_ENDS_CAPPED);
        }
    }
    return cylint_scene_new(shapes, SHAPES, 1, NULL);
}

/* What the callbacks found. */
struct found {
    int times[SHAPES];
    unsigned want;   /* 0 or CYLINT_SIGNED */
    int calls, most; /* most: of calls; 0: any number */
    double bound;    /* returned */
    double least;    /* of the t or distances that came */
};

static double take_hit(void *context, size_t number, const cylint_hit *hit)
{
    struct found *f = context;
    f->times[number]++;
    if (hit && hit->t < f->least)
        f->least = hit->t;
    return ++f->calls == f->most ? (double)NAN : f->bound;
}

static double take_near(void *context, size_t number, double distance,
                        int flags)
{
    struct found *f = context;
    (void)flags;
    f->times[number]++;
    const double size = f->want ? distance : fabs(distance);
    if (size < f->least)
        f->least = size;
    return ++f->calls == f->most ? (double)NAN : f->bound;
}

static int check_line(const cylint_scene *scene, const cylint_line *line)
{
    int hits = 0, wrong = 0;
    struct found without = {.bound = HUGE_VAL},
                 with = {.bound = HUGE_VAL, .least = HUGE_VAL};
    cylint_scene_visit(scene, line, 0, take_hit, &without);
    cylint_scene_visit(scene, line, CYLINT_WANT_T | CYLINT_WANT_Z, take_hit,
                       &with);
    for (int i = 0; i < SHAPES; i++) {
        const int hit = cylint_occluded(&shapes[i], line);
        wrong += without.times[i] != hit || with.times[i] != hit;
        hits += hit;
    }
    CHECK(wrong == 0);
    if (hits == 0)
        return 0;
    cylint_hit nearest;
    cylint_scene_nearest(scene, line, CYLINT_WANT_T, &nearest);
    CHECK(with.least <= nearest.t && with.least >= nearest.t);
    struct found one = {.bound = HUGE_VAL, .most = 1};
    cylint_scene_visit(scene, line, 0, take_hit, &one);
    CHECK(one.calls == 1);
    struct found bounded = {.bound = nearest.t, .least = HUGE_VAL};
    cylint_scene_visit(scene, line, CYLINT_WANT_T, take_hit, &bounded);
    CHECK(bounded.least <= nearest.t && bounded.calls <= with.calls);
    return hits;
}

static void each_shape_that_a_line_hits_comes_once(void)
{
    uint64_t random = 3;
    int most = 0;
    for (int k = 0; k < BUNDLES; k++) {
        cylint_scene *scene = bundle(&random, 0.002 * (k + 1));
        for (int i = 0; i < QUESTIONS; i++) {
            cylint_line line;
            double p[3], q[3];
            /* through the bundle near its begin, along it or in any direction */
            const double along = 0.2 * random_unit(&random);
            for (int j = 0; j < 3; j++) {
                p[j] = along + 0.01 * (random_unit(&random) - 0.5);
                q[j] = random_unit(&random) - 0.5;
                q[j] = i % 2 ? q[j] : 0.65 + 0.1 * q[j];
            }
            CHECK(cylint_whole_line(&line, p, q) == CYLINT_OK);
            const int hits = check_line(scene, &line);
            most = hits > most ? hits : most;
        }
        cylint_scene_free(scene);
    }
    CHECK(most > 250);
}

static int check_point(const cylint_scene *scene, const double point[3],
                       double radius, unsigned want)
{
    int near = 0, wrong = 0;
    struct found all = {.want = want, .bound = radius, .least = HUGE_VAL};
    cylint_closest answer;
    cylint_scene_visit_point(scene, point, radius, want, take_near, &all);
    for (int i = 0; i < SHAPES; i++) {
        const double d = cylint_distance(&shapes[i], point, want, &answer);
        const int is = (want ? d : fabs(d)) <= radius;
        wrong += all.times[i] != is;
        near += is;
    }
    if (!CHECK(wrong == 0))
        REPORT("point %a %a %a, radius %a%s: %d wrong", point[0], point[1],
               point[2], radius, want ? ", signed" : "", wrong);
    if (near == 0)
        return 0;
    cylint_scene_closest(scene, point, radius, want, &answer);
    const double least = want ? answer.distance : fabs(answer.distance);
    CHECK(all.least <= least && all.least >= least);
    struct found one = {.bound = radius, .most = 1};
    cylint_scene_visit_point(scene, point, radius, want, take_near, &one);
    CHECK(one.calls == 1);
    return near;
}

static void each_shape_that_is_near_a_point_comes_once(void)
{
    uint64_t random = 4;
    int most = 0;
    for (int k = 0; k < BUNDLES; k++) {
        cylint_scene *scene = bundle(&random, 0.05 * (k + 1));
        for (int i = 0; i < QUESTIONS; i++) {
            const double along = random_unit(&random);
            double p[3];
            for (int j = 0; j < 3; j++)
                p[j] = 0.7 * along + 0.3 * (random_unit(&random) - 0.5);
            const double radius = 0.4 * random_unit(&random);
            const int near = check_point(scene, p, radius, 0);
            check_point(scene, p, radius, CYLINT_SIGNED);
            most = near > most ? near : most;
        }
        cylint_scene_free(scene);
    }
    CHECK(most > 250);
}

/* How many solids hold the point. */
static int check_holding(const cylint_scene *scene, const double point[3])
{
    int holding = 0;
    for (int i = 0; i < SHAPES; i++)
        holding += cylint_contains(&shapes[i], point) >= 0;
    if (!CHECK((int)cylint_scene_contains(scene, point, 0) == holding))
        REPORT("point %a %a %a: not %d", point[0], point[1], point[2], holding);
    CHECK((int)cylint_scene_contains(scene, point, 1) == (holding > 0));
    return holding;
}

/* Points near the bundle's axis, so that more solids of several pieces hold them
 * than the set of a visit holds. */
static void each_shape_that_holds_a_point_counts_once(void)
{
    uint64_t random = 6;
    int most = 0;
    for (int k = 0; k < BUNDLES; k++) {
        cylint_scene *scene = bundle(&random, 0.0005 * k);
        for (int i = 0; i < QUESTIONS; i++) {
            const double along = 0.65 * random_unit(&random);
            double p[3];
            for (int j = 0; j < 3; j++)
                p[j] = along * (i % 4 ? 0.1 : 1) +
                       0.002 * (random_unit(&random) - 0.5);
            const int holding = check_holding(scene, p);
            check_point(scene, p, 0, CYLINT_SIGNED);
            check_point(scene, p, -0.001, CYLINT_SIGNED);
            most = holding > most ? holding : most;
        }
        cylint_scene_free(scene);
    }
    CHECK(most > 250);
}

/* A callback may query the scene. */
static double query_again(void *context, size_t number, const cylint_hit *hit)
{
    const cylint_scene *scene = context;
    cylint_closest answer;
    CHECK(cylint_scene_closest(scene, hit->point, HUGE_VAL, 0, &answer) <
          SHAPES);
    CHECK(fabs(answer.distance) < 1e-15);
    (void)number;
    return HUGE_VAL;
}

static void a_callback_may_query_the_scene(void)
{
    uint64_t random = 5;
    static const double p[3] = {0.3, 0.3, -1}, q[3] = {0.33, 0.31, 2};
    cylint_line line;
    cylint_scene *scene = bundle(&random, 0.2);
    CHECK(cylint_segment(&line, p, q) == CYLINT_OK);
    cylint_scene_visit(scene, &line, CYLINT_WANT_POINT, query_again, scene);
    cylint_scene_free(scene);
}

int main(void)
{
    RUN(each_shape_that_a_line_hits_comes_once);
    RUN(each_shape_that_is_near_a_point_comes_once);
    RUN(each_shape_that_holds_a_point_counts_once);
    RUN(a_callback_may_query_the_scene);
    return check_end();
}
