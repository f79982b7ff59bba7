/*
 * test_nodes.c - nodes, slices and traversals of the hierarchy; builds by
 * several threads, and their progress
 */
#include <math.h>
#include <pthread.h>
#include <string.h>

#include "check.h"
#include "cylint_scene.h"
#include "draw.h"
#include "families.h"
#include "bvh/bvh.h"
#include "bvh/leaf_test.h"
#include "scene/scene.h"
#include "scenes.h"
#include "shapes/layout.h"

static int build_bvh(cylint_bvh *bvh, const struct scene_shapes *of,
                     int threads)
{
    const cylint_view view = cylint_plain_view(of->shapes);
    const cylint_bvh_input input = {
        .view = &view, .n = of->n, .threads = threads};
    size_t refused;
    return CHECK(cylint_bvh_build(bvh, &input, &refused) == CYLINT_BVH_OK);
}

static int are_equal(const cylint_bvh *x, const cylint_bvh *y)
{
    return x->n_leaves == y->n_leaves && x->n_nodes == y->n_nodes &&
           memcmp(x->leaves, y->leaves, x->n_leaves * sizeof *x->leaves) == 0 &&
           memcmp(x->nodes, y->nodes, x->n_nodes * sizeof *x->nodes) == 0;
}

/* ---------------------------------------------------------------- nodes -- */

/* sound.c finds each leaf once and each node after the one before.  Returns the
 * number of leaves; 0: none was built. */
static size_t check_nodes(const struct scene_shapes *of, size_t most_nodes)
{
    cylint_bvh bvh;
    if (!build_bvh(&bvh, of, 2))
        return 0;
    const size_t leaves = bvh.n_leaves;
    CHECK(cylint_bvh_is_sound(&bvh, of->n));
    CHECK(bvh.n_nodes <= cylint_build_most_nodes(leaves));
    CHECK(bvh.n_nodes <= most_nodes);
    cylint_bvh_free(&bvh);
    return leaves;
}

TEST(every_leaf_has_one_parent_and_nodes_have_no_gaps)
{
    static const size_t sizes[] = {1, 7, 8, 9, 57, 64, 65, 520, 3000, 20000};
    static const int kinds[] = {SCENE_THIN, SCENE_FIBRES, SCENE_LATTICE,
                                SCENE_LENGTHS};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
            OWN_SHAPES of = scene_generate(kinds[k], sizes[i], 3);
            check_nodes(&of, SIZE_MAX);
        }
}

/* With 8 parts in each node, as long as a part has more than a leaf, the root's
 * parts of 15 leaves each would make 53 nodes of the fat shapes. */
TEST(needles_are_cut_and_shapes_as_wide_as_long_are_not)
{
    static const struct {
        int kind;
        size_t n, least, most; /* slices of a shape */
        size_t most_nodes;
    } of[] = {{SCENE_FAT, 1000, 1, 1, 125 / 4},
              {SCENE_THIN, 2000, 2, 3, SIZE_MAX},
              {SCENE_FIBRES, 2000, 3, 4, SIZE_MAX}};
    for (size_t k = 0; k < sizeof of / sizeof *of; k++) {
        OWN_SHAPES shapes = scene_generate(of[k].kind, of[k].n, 7);
        const size_t leaves = check_nodes(&shapes, of[k].most_nodes);
        CHECK(leaves >= cylint_leaves_for(of[k].least * shapes.n) &&
              leaves <= cylint_leaves_for(of[k].most * shapes.n));
    }
}

/* Shapes that no split separates, and shapes of which each split separates
 * one. */
TEST(scenes_without_good_splits_have_correct_nodes)
{
    enum { N = 3000 };
    static cylint_shape shapes[N];
    struct scene_shapes of = {.shapes = shapes, .n = N};
    for (int apart = 0; apart < 2; apart++) {
        double x = 0x1p-55;
        for (int i = 0; i < N; i++) {
            x = apart && i % (N / 100) == 0 ? 2 * x : x;
            const double base[3] = {x, 0, 0}, top[3] = {x, x, 0};
            CHECK(cylint_cylinder(&shapes[i], base, top, x / 8,
                                  CYLINT_ENDS_CAPPED) == CYLINT_OK);
        }
        check_nodes(&of, SIZE_MAX);
    }
}

/* A slice of a needle that is shorter than the steps of floats has the same box. */
TEST(tiny_shapes_are_not_cut)
{
    enum { N = 800 };
    static cylint_shape shapes[N];
    const struct scene_shapes of = {.shapes = shapes, .n = N};
    for (int e = 22; e < 50; e += 2) {
        const double l = ldexp(1, -e);
        for (int i = 0; i < N; i++) {
            const double p[3] = {between(1, 2), between(1, 2), between(1, 2)},
                         q[3] = {p[0] + l, p[1] + l, p[2] + l};
            CHECK(cylint_cylinder(&shapes[i], p, q, l / 200,
                                  CYLINT_ENDS_CAPPED) == CYLINT_OK);
        }
        CHECK(check_nodes(&of, SIZE_MAX) == N / CYLINT_LEAF_SIZE);
    }
}

/* -------------------------------------------------------------- damage --- */

/* Writes an integer, or the bits of a float, and returns what was there. */
static uint32_t put(void *at, int bytes, uint32_t value)
{
    uint32_t before = 0;
    if (bytes == 1) {
        before = *(uint8_t *)at;
        *(uint8_t *)at = (uint8_t)value;
    } else if (bytes == 2) {
        before = *(uint16_t *)at;
        *(uint16_t *)at = (uint16_t)value;
    } else {
        memcpy(&before, at, sizeof before);
        memcpy(at, &value, sizeof value);
    }
    return before;
}

static void check_counts(cylint_bvh *bvh, size_t n)
{
    for (size_t less = 0; less < 3; less++) {
        cylint_bvh nodes = *bvh, leaves = *bvh, empty = {.n_leaves = less};
        nodes.n_nodes += 1 - less;
        leaves.n_leaves += 1 - less;
        CHECK(cylint_bvh_is_sound(&nodes, n) == (less == 1));
        CHECK(cylint_bvh_is_sound(&leaves, n) == (less == 1));
        CHECK(cylint_bvh_is_sound(&empty, n) == (less == 0));
    }
}

/* The last leaf has unused lanes, whose numbers are not read. */
TEST(a_damaged_hierarchy_is_not_sound)
{
    enum { N = 515, USED = N % CYLINT_LEAF_SIZE };
    const uint32_t nan = 0x7fc00000, infinity = 0x7f800000;
    cylint_bvh bvh;
    OWN_SHAPES of = scene_generate(SCENE_FAT, N, 3);
    if (!build_bvh(&bvh, &of, 1))
        return;
    cylint_node *node = bvh.node_memory.data, *end = node + bvh.n_nodes - 1;
    cylint_leaf *leaf = bvh.leaf_memory.data, *last = leaf + bvh.n_leaves - 1;
    uint32_t *to_node = &node->child[0], *to_leaf = &end->child[0];
    const struct {
        void *at;
        int bytes, is_sound;
        uint32_t value;
    } put_there[] = {{&node->children, 1, 0, 0},
                     {&node->children, 1, 0, 5},
                     {&node->children, 1, 0, node->children >> 1},
                     {&node->leaves, 1, 0, node->leaves ^ 1u},
                     {&end->leaves, 1, 0, end->leaves ^ 1u},
                     {&end->corner[0], 4, 0, nan},
                     {&end->corner[2], 4, 0, infinity},
                     {&end->step[1], 4, 0, infinity},
                     {to_node, 4, 0, 0},
                     {to_node, 4, 0, 2},
                     {to_node, 4, 0, CYLINT_LEAF_FLAG},
                     {to_leaf, 4, 0, *to_leaf - 1},
                     {to_leaf, 4, 0, *to_leaf + 1},
                     {to_leaf, 4, 0, (uint32_t)bvh.n_nodes - 1},
                     {&leaf->center[1], 4, 0, nan},
                     {&leaf->steps, 2, 0, 0},
                     {&leaf->steps, 2, 0, 0x8000u | leaf->steps},
                     {&leaf->steps, 2, 0, infinity >> 16},
                     {&leaf->used, 1, 0, 0},
                     {&leaf->used, 1, 0, CYLINT_LEAF_SIZE + 1},
                     {&leaf->r[7], 2, 0, leaf->r[7] | 1u << CYLINT_LEAF_R_BITS},
                     {&leaf->number[0], 4, 1, N - 1},
                     {&leaf->number[0], 4, 0, N},
                     {&last->number[USED - 1], 4, 0, UINT32_MAX},
                     {&last->number[USED], 4, 1, UINT32_MAX}};
    CHECK(*to_node == 1 && *to_leaf > CYLINT_LEAF_FLAG && end > node + 1);
    for (size_t i = 0; i < sizeof put_there / sizeof *put_there; i++) {
        const uint32_t before =
            put(put_there[i].at, put_there[i].bytes, put_there[i].value);
        if (!CHECK(cylint_bvh_is_sound(&bvh, N) == put_there[i].is_sound))
            REPORT("damage %zu", i);
        put(put_there[i].at, put_there[i].bytes, before);
    }
    check_counts(&bvh, N);
    cylint_bvh_free(&bvh);
}

/* Each node has a leaf and the next node, the last one leaves. */
TEST(a_tree_of_nodes_without_gaps_and_of_the_greatest_depth_is_sound)
{
    enum { MOST = CYLINT_BVH_DEPTH + 1, LEAVES = MOST + CYLINT_CHILDREN };
    cylint_node nodes[MOST] = {{.children = 0}};
    cylint_leaf leaves[LEAVES];
    for (int i = 0; i < LEAVES; i++)
        leaves[i] = (cylint_leaf){.steps = 0x3f80, .used = 1};
    for (uint32_t depth = 1; depth <= MOST; depth++)
        for (unsigned bits = 0; bits < 256; bits++) {
            cylint_node *last = &nodes[depth - 1];
            cylint_bvh bvh = {.nodes = nodes,
                              .leaves = leaves,
                              .n_nodes = depth,
                              .n_leaves = depth - 1};
            last->children = (uint8_t)bits;
            last->leaves = 0xff;
            for (uint32_t i = 0; i < CYLINT_CHILDREN; i++) {
                last->child[i] = CYLINT_LEAF_FLAG | (depth - 1 + i);
                bvh.n_leaves += bits >> i != 0;
            }
            const int has_gaps = bits == 0 || (bits & (bits + 1)) != 0;
            CHECK(cylint_bvh_is_sound(&bvh, 1) ==
                  (!has_gaps && depth <= CYLINT_BVH_DEPTH));
            last->children = 3;
            last->leaves = 1;
            last->child[1] = depth;
        }
}

/* -------------------------------------------------------------- threads -- */

/* Enough shapes for five threads; some calls use more. */
TEST(any_number_of_threads_builds_the_same_bytes)
{
    static const int kinds[] = {SCENE_FIBRES, SCENE_MIXED, SCENE_FAT};
    static const int threads[] = {2, 3, 5, 100, 0};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        cylint_bvh alone, other;
        OWN_SHAPES of = scene_generate(kinds[k], 23000, 4);
        if (!build_bvh(&alone, &of, 1))
            return;
        for (size_t i = 0; i < sizeof threads / sizeof *threads; i++) {
            if (!build_bvh(&other, &of, threads[i]))
                return;
            CHECK(other.pad <= alone.pad && other.pad >= alone.pad);
            CHECK(memcmp(&other.box, &alone.box, sizeof alone.box) == 0);
            CHECK(are_equal(&other, &alone));
            cylint_bvh_free(&other);
        }
        cylint_bvh_free(&alone);
    }
}

/* The lowest number, whichever thread finds it. */
TEST(the_first_refused_shape_is_reported)
{
    OWN_SHAPES of = scene_generate(SCENE_THIN, 23000, 5);
    const cylint_view view = cylint_plain_view(of.shapes);
    static const size_t bad[] = {22999, 12000, 11999, 300};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        for (int threads = 1; threads < 6; threads++) {
            const cylint_bvh_input input = {
                .view = &view, .n = of.n, .threads = threads};
            size_t refused = 0;
            cylint_bvh bvh;
            of.shapes[bad[i]].kind = CYLINT_KIND_NONE;
            CHECK(cylint_bvh_build(&bvh, &input, &refused) ==
                  CYLINT_BVH_ESHAPE);
            CHECK(refused == bad[i]);
        }
}

/* ------------------------------------------------------------- progress -- */

/* The calls of a progress function so far. */
struct progress {
    pthread_t caller;
    long calls, stop; /* the call that stops the build, from 1; 0: none */
    double part;
};

static int report(void *context, double part)
{
    struct progress *seen = context;
    CHECK(pthread_equal(seen->caller, pthread_self()));
    CHECK(part >= seen->part && part <= 1);
    seen->part = part;
    return ++seen->calls != seen->stop;
}

/* Stopped at each of some calls and, last, at none. */
static void check_progress(const struct scene_shapes *of, int threads)
{
    OWN_SCENE *plain = cylint_scene_new(of->shapes, of->n, 1, NULL);
    cylint_scene *made = NULL;
    for (long stop = 1; !made && stop < 4000; stop += 1 + stop / 8) {
        struct progress seen = {.caller = pthread_self(), .stop = stop};
        cylint_scene_status status;
        made = cylint_scene_new_with_progress(of->shapes, of->n, threads,
                                              report, &seen, &status);
        if (!made) {
            CHECK(status == CYLINT_SCENE_ESTOPPED && seen.calls == stop);
            continue;
        }
        CHECK(status == CYLINT_SCENE_OK && seen.calls < stop);
        CHECK(seen.part > 0.9 && seen.calls > 20);
        CHECK(are_equal(&plain->bvh, &made->bvh));
        CHECK(cylint_scene_bytes(plain) == cylint_scene_bytes(made));
    }
    CHECK(made);
    cylint_scene_free(made);
}

/* Some shapes are long and in slices, some are unbounded.  Nor do several threads
 * change the scene. */
TEST(progress_grows_and_stops_a_build_but_does_not_change_the_scene)
{
    static const int kinds[] = {SCENE_FIBRES, SCENE_UNBOUNDED, SCENE_THIN};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        OWN_SHAPES of = scene_generate(kinds[i], 40000, 7);
        check_progress(&of, 1);
        check_progress(&of, 4);
    }
}

/* --------------------------------------------------------------- slices -- */

/* A cone or round cone of any taper, 1 to 30 times as long as thick. */
static void draw_tapered(int round, cylint_shape *shape)
{
    double p[2][3], r[2];
    const double length = exp(between(0, 3.4)),
                 taper = chance(0.3) ? 0 : between(0, 1);
    const int end = chance(0.5);
    double w[3], ww = 0;
    for (int j = 0; j < 3; j++) {
        p[0][j] = between(0, 1);
        w[j] = between(-0.5, 0.5);
        ww += w[j] * w[j];
    }
    for (int j = 0; j < 3; j++)
        p[1][j] = p[0][j] + length * w[j] / sqrt(ww);
    r[end] = 1;
    r[!end] = taper;
    CHECK((round ? cylint_round_cone : cylint_cone)(
              shape, p[0], r[0], p[1], r[1], CYLINT_ENDS_CAPPED) == CYLINT_OK);
}

static unsigned lanes_hit(const cylint_leaf *leaf, const double o[3],
                          const double d[3], double tmax)
{
    const cylint_bvh_line line = {
        {o[0], o[1], o[2]}, {d[0], d[1], d[2]}, 0, tmax};
    const float_direction along = float_direction_of(&line);
    float least[CYLINT_LEAF_SIZE];
    return test_line(leaf, NULL, &line, &along, least, NULL);
}

/* Each hit lies in the box of the slice that owns it, and the leaf test does not
 * reject that slice where the domain ends at the hit, or is the hit. */
static long check_slices(const cylint_shape *shape, const cylint_line *line,
                         int count)
{
    const cylint_view view = cylint_plain_view(shape);
    cylint_swept_disc swept;
    cylint_answer answer;
    double reach[3];
    cylint_swept_disc_of(&swept, &view, shape);
    cylint_swept_disc_reach(&swept, reach);
    const int n = cylint_intersect(shape, line, CYLINT_WANT_ALL, &answer);
    for (int i = 0; i < n; i++) {
        const cylint_hit *hit = &answer.hit[i];
        const cylint_slice slice = {(uint16_t)cylint_slice_at(hit->z, count),
                                    (uint16_t)count};
        const cylint_extent box = cylint_slice_box(&swept, reach, slice);
        const cylint_boxed_slice boxed = {box, 0, slice};
        cylint_leaf leaf;
        cylint_leaf_fill(&leaf, &swept, &boxed, 1, 0);
        for (int j = 0; j < 3; j++)
            CHECK((double)box.lower[j] <= hit->point[j] &&
                  hit->point[j] <= (double)box.upper[j]);
        if (!CHECK(lanes_hit(&leaf, line->o, line->d, hit->t) &&
                   lanes_hit(&leaf, hit->point, line->d, 0)))
            REPORT("slice %d of %d, kind %d, radii %g and %g", slice.index,
                   count, shape->kind, cylint_r0(shape), cylint_r1(shape));
    }
    return n;
}

TEST(slices_contain_the_hits_that_they_own)
{
    long hits = 0;
    for (int i = 0; i < 20000; i++) {
        cylint_shape shape;
        cylint_line line;
        double o[3], d[3];
        draw_tapered(i % 4 > 0, &shape);
        const double z = between(0, 1);
        for (int j = 0; j < 3; j++) {
            const double along =
                cylint_base(&shape)[j] + z * cylint_axis(&shape)[j];
            o[j] = along + (i % 3 ? 30 : 3e5) * between(-0.5, 0.5);
            d[j] = along + between(-0.8, 0.8) - o[j];
        }
        CHECK(cylint_ray(&line, o, d) == CYLINT_OK);
        hits += check_slices(&shape, &line, 1 + i % 8);
    }
    CHECK(hits > 20000);
}

/* By 2^-20 of their length. */
TEST(slices_overlap_their_neighbours)
{
    const cylint_shape shape = shape_of("rcone 0 0 0 0.01  1 0 0 0.02");
    const cylint_view view = cylint_plain_view(&shape);
    cylint_swept_disc swept;
    cylint_swept_disc_of(&swept, &view, &shape);
    for (int count = 2; count <= 16; count++)
        for (int i = 1; i < count; i++) {
            const cylint_slice at[2] = {{(uint16_t)(i - 1), (uint16_t)count},
                                        {(uint16_t)i, (uint16_t)count}};
            CHECK(cylint_slice_hull_of(&swept, at[0]).z[1] * count >
                  i + 0x1p-21);
            CHECK(cylint_slice_hull_of(&swept, at[1]).z[0] * count <
                  i - 0x1p-21);
        }
}

/* The plane of the cut is behind the end of the cone's lateral part, which is
 * outside the convex hull of the sections at both ends of the first slice. */
TEST(slices_of_a_round_cone_as_wide_as_long_are_the_whole)
{
    const cylint_shape shape = shape_of("rcone 0 0 0  0  -0.875 0.485 0  0.9");
    for (int i = 1; i < 20; i++) {
        const double z = 0.01 * i;
        cylint_line line;
        cylint_ray(&line, (double[]){-0.875 * z, 0.485 * z, 0},
                   (double[]){0.485, 0.875, 0});
        CHECK(check_slices(&shape, &line, 2) == 1);
    }
}

/* Its sides are no doubles, and the nearest floats are inside it. */
TEST(the_box_of_a_tiny_ball_contains_it)
{
    const cylint_shape ball = shape_of("sphere 1 -1 0  0x1p-60");
    const cylint_view view = cylint_plain_view(&ball);
    const cylint_slice whole = {0, 1};
    cylint_swept_disc swept;
    double reach[3];
    cylint_swept_disc_of(&swept, &view, &ball);
    cylint_swept_disc_reach(&swept, reach);
    const cylint_extent box = cylint_slice_box(&swept, reach, whole);
    CHECK(box.lower[0] < 1 && box.upper[0] > 1);
    CHECK(box.lower[1] < -1 && box.upper[1] > -1);
}

/* ------------------------------------------------------------- stacks --- */

enum { MOST_COUNTED = 50000 };

static int count_leaf(void *self, const cylint_leaf *leaf, unsigned lanes,
                      const float least[CYLINT_LEAF_SIZE])
{
    long *count = self;
    (void)leaf;
    (void)least;
    CHECK(lanes == 1);
    return ++*count == MOST_COUNTED;
}

/* All children of a node are the next node, but the first `n_leaves`, and all of
 * the last node, are the leaf.  The line hits all boxes. */
static void traverse_equal_boxes(int depth, int n_leaves, long leaves)
{
    static const cylint_bvh_line through = {
        {0.5, 0.25, -2}, {0.25, 0.125, 1}, 0, 4};
    static const cylint_extent box = {{-1, -1, -1}, {1, 1, 1}};
    const cylint_leaf leaf = {.steps = 0x3c00, .used = 1, .always = 1};
    cylint_node nodes[CYLINT_BVH_DEPTH];
    cylint_bvh bvh = {.leaves = &leaf, .nodes = nodes};
    cylint_bvh_set_box(&bvh, &box, 0);
    for (int i = 0; i < depth; i++) {
        const unsigned of_leaves = i == depth - 1 ? 0xff : (1u << n_leaves) - 1;
        nodes[i] = (cylint_node){{-1, -1, -1}, {1, 1, 1}, .children = 0xff};
        nodes[i].leaves = (uint8_t)of_leaves;
        memset(nodes[i].face[1], 2, sizeof nodes[i].face[1]);
        for (int k = 0; k < CYLINT_CHILDREN; k++)
            nodes[i].child[k] =
                of_leaves >> k & 1 ? CYLINT_LEAF_FLAG : (uint32_t)i + 1;
    }
    const cylint_traversal *const builds[] = {&cylint_traversal_plain,
                                              cylint_traversal_used()};
    for (int k = 0; k < 2; k++) {
        long line = 0, all = 0;
        builds[k]->line(&bvh, &through, count_leaf, &line, 0);
        builds[k]->all(&bvh, &through, count_leaf, &all);
        CHECK(line == leaves && all == leaves);
    }
}

/* Run by `make sanitize`, which detects an access outside a stack. */
TEST(stacks_hold_the_greatest_depth)
{
    for (int n = 0; n < CYLINT_CHILDREN - 1; n++)
        traverse_equal_boxes(CYLINT_BVH_DEPTH, n, MOST_COUNTED);
}

TEST(each_leaf_is_visited)
{
    for (int n = 0; n < CYLINT_CHILDREN; n++) {
        const long nodes = CYLINT_CHILDREN - n;
        long leaves = CYLINT_CHILDREN;
        for (int depth = 1; depth <= 5; depth++) {
            traverse_equal_boxes(depth, n, leaves);
            leaves = n + nodes * leaves;
        }
    }
}
