/*
 * test_refit.c - a scene whose shapes moved returns the bits of a new scene
 *
 * CYLINT_CASES: how many times shapes move in each scene.
 */
#include <math.h>

#include "check.h"
#include "cylint_scene.h"
#include "answers.h"
#include "environment.h"
#include "scene_file.h"
#include "shapes/shape_facts.h"

enum { SHAPES = 300, MOVES = 4 };

static int is_finite_shape(const cylint_shape *s)
{
    double lo[3], hi[3];
    int finite = s->kind != CYLINT_KIND_NONE;
    cylint_bounds(s, lo, hi);
    for (int j = 0; j < 3; j++)
        finite &= fabs(lo[j]) < 0x1p399 && fabs(hi[j]) < 0x1p399;
    return finite;
}

/* Whether a shape may take the place of another, by the words of the header. */
static int may_replace(const cylint_shape *x, const cylint_shape *y)
{
    return cylint_is_elliptic(x->kind) == cylint_is_elliptic(y->kind) &&
           (x->kind == CYLINT_KIND_NONE) == (y->kind == CYLINT_KIND_NONE) &&
           (is_finite_shape(x) || !is_finite_shape(y));
}

/* Replaces [first, first + n) of the shapes where that is possible, by those of
 * another scene. */
static void replace(struct scene_shapes *of, const struct scene_shapes *by,
                    size_t first, size_t n)
{
    for (size_t i = first; i < first + n; i++)
        if (may_replace(&by->shapes[i], &of->shapes[i]))
            of->shapes[i] = by->shapes[i];
    for (int j = 0; j < 3; j++) {
        of->lo[j] = fmin(of->lo[j], by->lo[j]);
        of->hi[j] = fmax(of->hi[j], by->hi[j]);
    }
}

static void check_moves(int kind, uint64_t seed, long moves)
{
    stream = seed;
    cylint_scene_status status;
    OWN_SHAPES of =
        scene_generate(kind, scene_is_slow(kind) ? SHAPES / 10 : SHAPES, seed);
    OWN_SCENE *scene = cylint_scene_new(of.shapes, of.n, 1, NULL);
    CHECK(cylint_scene_worsening(scene) == 1);
    for (long k = 0; k < moves; k++) {
        /* sometimes of another kind, size and place */
        const int other = one_of(4) ? kind : one_of(SCENE_KINDS);
        OWN_SHAPES by = scene_generate(other, of.n, seed + 1 + (uint64_t)k);
        const size_t first = (size_t)below(of.n), most = of.n - first;
        const size_t n = one_of(4) ? 1 + (size_t)below(most) : 1;
        const int all = one_of(5) == 0;
        replace(&of, &by, all ? 0 : first, all ? of.n : n);
        status = all ? cylint_scene_refit(scene, 0, of.n, of.shapes)
                     : cylint_scene_refit(scene, first, n, of.shapes + first);
        CHECK(status == CYLINT_SCENE_OK);
        OWN_SCENE *expected = cylint_scene_new(of.shapes, of.n, 1, NULL);
        CHECK(differences(expected, scene, &of, seed + (uint64_t)k) == 0);
        CHECK(cylint_scene_worsening(scene) > 0);
    }
    OWN_BYTES file = {NULL, NULL, 0};
    OWN_SCENE *opened = scene_file_reopen(scene, &file);
    CHECK(opened && differences(scene, opened, &of, seed) == 0 &&
          cylint_scene_worsening(opened) == 1);
}

/* And is saved as it then is. */
TEST(a_scene_that_moved_answers_as_a_new_one)
{
    const long moves = (long)check_setting("CYLINT_CASES", MOVES);
    for (int kind = 0; kind < SCENE_KINDS; kind++)
        check_moves(kind, 100 + (uint64_t)kind, moves);
}

/* Cylinders in a row, in the order of their numbers or in another. */
static void fill_row(cylint_shape *shapes, size_t n, size_t stride)
{
    for (size_t i = 0; i < n; i++) {
        const double x = (double)(i * stride % n);
        cylint_cylinder(&shapes[i], (double[]){x, 0, 0}, (double[]){x, 1, 1},
                        0.25, CYLINT_ENDS_CAPPED);
    }
}

static double move_each(cylint_scene *scene, const cylint_shape *shapes,
                        size_t n)
{
    for (size_t i = 0; i < n; i++)
        CHECK(cylint_scene_refit(scene, i, 1, &shapes[i]) == CYLINT_SCENE_OK);
    return cylint_scene_worsening(scene);
}

TEST(moving_forth_and_back_adds_nothing_to_boxes)
{
    static cylint_shape shapes[SHAPES];
    double forth = 0, back = 0;
    fill_row(shapes, SHAPES, 1);
    OWN_SCENE *scene = cylint_scene_new(shapes, SHAPES, 1, NULL);
    for (int k = 0; k < 20; k++) {
        fill_row(shapes, SHAPES, 7);
        forth = move_each(scene, shapes, SHAPES);
        fill_row(shapes, SHAPES, 1);
        back = move_each(scene, shapes, SHAPES);
    }
    CHECK(forth > 3); /* neighbours in a leaf are far from each other */
    CHECK(back < 1.05);
}

/* While it is far away, floats of the hierarchy do not distinguish the others. */
TEST(worsening_is_large_while_one_shape_is_far_away)
{
    static cylint_shape shapes[SHAPES];
    const cylint_shape far = shape_of("sphere 1e9 0 0  1");
    fill_row(shapes, SHAPES, 1);
    OWN_SCENE *scene = cylint_scene_new(shapes, SHAPES, 1, NULL);
    CHECK(cylint_scene_refit(scene, 7, 1, &far) == CYLINT_SCENE_OK);
    CHECK(cylint_scene_worsening(scene) > 10);
    CHECK(cylint_scene_refit(scene, 7, 1, &shapes[7]) == CYLINT_SCENE_OK);
    CHECK(cylint_scene_worsening(scene) < 1.05);
}

/* All others are bounded again, also one that is alone in the last leaf. */
TEST(one_shape_leaves_the_frame)
{
    cylint_shape shapes[20];
    const cylint_shape far = shape_of("sphere 1e6 0 0  1");
    for (int n = 2; n <= 20; n++)
        for (int i = 0; i < n; i++) {
            for (int k = 0; k < n; k++)
                cylint_sphere(&shapes[k], (double[]){-k, 0, 0}, 0.25,
                              CYLINT_ENDS_CAPPED);
            OWN_SCENE *scene = cylint_scene_new(shapes, (size_t)n, 1, NULL);
            CHECK(cylint_scene_refit(scene, (size_t)i, 1, &far) ==
                  CYLINT_SCENE_OK);
            for (int k = 0; k < n; k++) {
                const double p[3] = {k == i ? 1e6 : -k, 0, 0};
                CHECK(cylint_scene_contains(scene, p, 0) == 1);
            }
        }
}

/* A file keeps its box alone: in each rounding mode this makes the same frame. */
static void check_frame(const cylint_scene *scene)
{
    const cylint_frame *f = &scene->frame;
    EACH_ENVIRONMENT(e) {
        cylint_frame again;
        environment_set(e);
        const int is_frame = cylint_frame_make(&again, f->lo, f->hi);
        environment_reset();
        CHECK(is_frame && again.view.scale == f->view.scale);
        for (int j = 0; j < 3; j++)
            CHECK(again.view.center[j] == f->view.center[j]);
    }
}

/* The first shape is beside the hierarchy, so that numbers there are others. */
TEST(the_last_shape_leaves_the_frame_of_others_than_the_first)
{
    const cylint_shape shapes[] = {
        shape_of("cylinder 0 9 0  1 9 0  1 ends=infinite"),
        shape_of("sphere 0 0 0  1"), shape_of("sphere 4 0 0  1")};
    const cylint_shape far = shape_of("sphere 1234567.8 0 0  1");
    OWN_SCENE *scene = cylint_scene_new(shapes, 3, 1, NULL);
    CHECK(cylint_scene_refit(scene, 2, 1, &far) == CYLINT_SCENE_OK);
    CHECK(cylint_scene_contains(scene, (double[]){1234567.8, 0, 0}, 0) == 1);
    CHECK(cylint_scene_contains(scene, (double[]){0, 0, 0}, 0) == 1);
    check_frame(scene);
}

/* Balls of radius r about x and -x. */
static void fill_pair(cylint_shape shapes[2], double x, double r)
{
    for (int i = 0; i < 2; i++)
        cylint_sphere(&shapes[i], (double[]){i ? x : -x, 0, 0}, r,
                      CYLINT_ENDS_CAPPED);
}

TEST(shapes_move_to_the_ends_of_the_range)
{
    static const double to[][2] = {{0x1.ffp399, 0x1p390},
                                   {0x1p-402, 0x1p-410},
                                   {0x1p-1000, 0x1p-1005},
                                   {0x1.ffp399, 1},
                                   {1, 0x1p-1000}};
    cylint_shape shapes[2];
    cylint_line ray;
    cylint_hit hit;
    fill_pair(shapes, 1, 0.25);
    OWN_SCENE *scene = cylint_scene_new(shapes, 2, 1, NULL);
    cylint_ray(&ray, (double[]){0, 0, 0}, (double[]){1, 0, 0});
    for (size_t i = 0; i < sizeof to / sizeof *to; i++)
        for (size_t first = 0; first < 2; first++) {
            fill_pair(shapes, to[i][0], to[i][1]);
            CHECK(cylint_scene_refit(scene, first, 2 - first, shapes + first) ==
                  CYLINT_SCENE_OK);
            CHECK(cylint_scene_nearest(scene, &ray, CYLINT_WANT_T, &hit) == 1);
            CHECK(cylint_scene_contains(scene, (double[]){to[i][0], 0, 0}, 0) ==
                  1);
            CHECK(cylint_scene_worsening(scene) > 0);
            check_frame(scene);
        }
}

/* Round cones that begin near 0, of this length along each coordinate. */
static void fill_round_cones(cylint_shape shapes[SHAPES], double length,
                             double radius)
{
    for (int i = 0; i < SHAPES; i++) {
        double p[3], q[3];
        for (int j = 0; j < 3; j++) {
            p[j] = between(-0.025, 0.025);
            q[j] = p[j] + length;
        }
        cylint_round_cone(&shapes[i], p, radius * between(1, 1.5), q, 0.001,
                          CYLINT_ENDS_CAPPED);
    }
}

/* One ball holds the other, whose pieces are those of the needles.  There are more
 * of them than the set of a query holds. */
TEST(needles_become_balls)
{
    static cylint_shape shapes[SHAPES];
    static struct line_answers got, due;
    fill_round_cones(shapes, 1, 0.001);
    OWN_SCENE *scene = cylint_scene_new(shapes, SHAPES, 1, NULL);
    fill_round_cones(shapes, 0.05, 0.2);
    CHECK(cylint_scene_refit(scene, 0, SHAPES, shapes) == CYLINT_SCENE_OK);
    for (int k = 0; k < 100; k++) {
        cylint_line line;
        double p[3], q[3];
        for (int j = 0; j < 3; j++) {
            p[j] = between(-1, 1);
            q[j] = between(-0.15, 0.15);
        }
        cylint_segment(&line, p, q);
        line_by_loop(shapes, SHAPES, &line, &due);
        line_in_scene(scene, &line, &got);
        CHECK(same_line_answers(&got, &due));
    }
}

TEST(what_is_refused_changes_nothing)
{
    static cylint_shape shapes[SHAPES], moved[SHAPES];
    const cylint_shape refused[] = {
        shape_of("cylinder 0 0 0  1 0 0  1 ends=infinite"),
        shape_of("ecylinder 0 0 0  1 0 0  0 2 0  0 0 1"),
        shape_of("cylinder 0 0 0  0x1p401 0 0  1"),
        {.kind = CYLINT_KIND_NONE}};
    cylint_line line;
    cylint_hit hit;
    fill_row(shapes, SHAPES, 1);
    fill_row(moved, SHAPES, 7);
    OWN_SCENE *scene = cylint_scene_new(shapes, SHAPES, 1, NULL);
    CHECK(cylint_scene_refit(scene, 0, 0, NULL) == CYLINT_SCENE_OK);
    CHECK(cylint_scene_refit(scene, SHAPES, 0, NULL) == CYLINT_SCENE_OK);
    CHECK(cylint_scene_refit(scene, 1, SHAPES, moved) == CYLINT_SCENE_ESIZE);
    CHECK(cylint_scene_refit(scene, SIZE_MAX, 2, moved) == CYLINT_SCENE_ESIZE);
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        moved[40] = refused[i];
        CHECK(cylint_scene_refit(scene, 0, SHAPES, moved) ==
              CYLINT_SCENE_EREPLACE);
    }
    cylint_whole_line(&line, (double[]){3, 0.5, 0}, (double[]){0, 0, 1});
    CHECK(cylint_scene_nearest(scene, &line, CYLINT_WANT_T, &hit) == 3 &&
          hit.t < 1);
    CHECK(cylint_scene_worsening(scene) == 1);
}
