/*
 * test_scene_point_bounds.c - floor bvh: lower bounds of the distances from a
 * point to boxes and to the cylinders of leaves
 *
 * Compares the bounds of traverse_point.c with distances in long double: they are
 * never above these, and below by no more than the errors that are stated there, in
 * every rounding mode.
 * CYLINT_SEED changes all cases.
 */
#define CYLINT_TRAVERSE_POINT cylint_traverse_point_tested
#include "bvh/traverse.h"
cylint_traverse_point CYLINT_TRAVERSE_POINT;
#include "bvh/traverse_point.c"

#include "check.h"
#include "draw.h"
#include "environment.h"

enum { ROUNDS = 4000 };

/* ---------------------------------------------------------------- boxes -- */

/* A hierarchy of one node: its boxes lie in the box of all, which has sides of
 * up to 2 and a centre of floats. */
static void draw_node(cylint_bvh *bvh, cylint_node *node)
{
    memset(bvh, 0, sizeof *bvh);
    memset(node, 0, sizeof *node);
    bvh->nodes = node;
    node->children = 0xff;
    for (int j = 0; j < 3; j++) {
        const float half = (float)pow(2, between(-8, -0.01));
        bvh->center[j] = (float)between(-0.9, 0.9) * (1 - half);
        bvh->box.lower[j] =
            cylint_float_below((double)bvh->center[j] - (double)half);
        bvh->box.upper[j] =
            cylint_float_above((double)bvh->center[j] + (double)half);
        node->corner[j] = -half;
        node->step[j] = half / 128;
        for (int i = 0; i < CYLINT_CHILDREN; i++) {
            const int x = one_of(256), y = one_of(256);
            node->face[0][j][i] = (uint8_t)(x < y ? x : y);
            node->face[1][j][i] = (uint8_t)(x < y ? y : x);
        }
    }
}

static long double distance_to_box(const cylint_bvh *bvh, int child,
                                   const double point[3])
{
    const cylint_node *node = bvh->nodes;
    long double sum = 0;
    for (int j = 0; j < 3; j++) {
        const long double from =
            (long double)point[j] - bvh->center[j] - node->corner[j];
        const long double below =
            (long double)node->step[j] * node->face[0][j][child] - from;
        const long double above =
            from - (long double)node->step[j] * node->face[1][j][child];
        const long double out = below > above ? below : above;
        sum += out > 0 ? out * out : 0;
    }
    return sqrtl(sum);
}

/* Whether the child is visited if shapes within the distance are sought. */
static int is_visited(traversal *t, int child, double distance)
{
    child_hits hits;
    t->distance = &distance;
    update_last(t);
    return children_near(t, t->bvh->nodes, &hits) >> child & 1;
}

/* What the bounds may lack: the stated errors along three coordinates and of the
 * point, and of floats. */
static double most_lacking(const traversal *t, double distance)
{
    return 8 * t->error + 4 * t->box_error + 0x1p-17 * (distance - t->nearest);
}

static void check_boxes(double far)
{
    cylint_bvh bvh;
    cylint_node node;
    traversal t;
    double point[3], distance = 0;
    draw_node(&bvh, &node);
    for (int j = 0; j < 3; j++) {
        const double half = (double)(bvh.box.upper[j] - bvh.box.lower[j]);
        point[j] = (double)bvh.center[j] + between(-far, far) * half;
    }
    start_point(&t, &bvh, point, &distance);
    for (int child = 0; child < CYLINT_CHILDREN; child++) {
        const double apart = (double)distance_to_box(&bvh, child, point);
        const double less = apart - most_lacking(&t, apart);
        if (!CHECK(is_visited(&t, child, apart * (1 + 0x1p-52))))
            REPORT("far %g: at %a it is not visited", far, apart);
        if (!CHECK(!(less >= 0) || !is_visited(&t, child, less)))
            REPORT("far %g: at %a, %a nearer, it is visited", far, apart,
                   apart - less);
    }
}

TEST(boxes_are_visited_within_their_distance_only)
{
    stream = check_seed();
    for (int round = 0; round < ROUNDS; round++) {
        fesetround(roundings[round % ROUNDINGS]);
        check_boxes(between(0, 1));
        check_boxes(between(1, 100));
        check_boxes(pow(2, between(8, 59)));
    }
}

/* --------------------------------------------------------------- leaves -- */

static void draw_leaf(cylint_leaf *b)
{
    memset(b, 0, sizeof *b);
    b->used = CYLINT_LEAF_SIZE;
    b->steps = cylint_bfloat16_below(pow(2, between(6, 20)));
    for (int lane = 0; lane < CYLINT_LEAF_SIZE; lane++) {
        const int spread = 1 << one_of(11);
        for (int j = 0; j < 3; j++) {
            const int at = one_of(1024);
            int top = at + one_of(2 * spread + 1) - spread;
            top = top < 0 ? 0 : top > 1023 ? 1023 : top;
            b->p[0][lane] |= (uint32_t)at << j * CYLINT_LEAF_P_BITS;
            b->p[1][lane] |= (uint32_t)top << j * CYLINT_LEAF_P_BITS;
        }
        b->r[lane] = (uint16_t)(one_of(4) ? one_of(1024) : 0);
    }
    for (int j = 0; j < 3; j++)
        b->center[j] = (float)between(-1, 1);
}

/* In steps, from the points within r of a lane's axis; q from the centre. */
static long double distance_to_lane(const cylint_leaf *b, int lane,
                                    const long double q[3])
{
    long double D[3], w[3], ww = 0, Dw = 0, square = 0;
    for (int j = 0; j < 3; j++) {
        const int shift = j * CYLINT_LEAF_P_BITS;
        const int p = (int)(b->p[0][lane] >> shift & CYLINT_LEAF_P_MASK);
        const int top = (int)(b->p[1][lane] >> shift & CYLINT_LEAF_P_MASK);
        D[j] = q[j] - (p - CYLINT_LEAF_MIDDLE);
        w[j] = top - p;
        ww += w[j] * w[j];
        Dw += D[j] * w[j];
    }
    long double z = ww > 0 ? Dw / ww : 0;
    z = z < 0 ? 0 : z > 1 ? 1 : z;
    for (int j = 0; j < 3; j++)
        square += (D[j] - z * w[j]) * (D[j] - z * w[j]);
    return sqrtl(square) - (b->r[lane] & CYLINT_LEAF_R_MASK);
}

/* A point at which the nearest point of lane 0 is inside its axis, in steps. */
static void draw_beside(const cylint_leaf *b, double far, double q[3])
{
    double p[3], w[3], any[3], side[3], size = 0;
    random_vector(any, 1);
    const double z = between(0, 1);
    for (int j = 0; j < 3; j++) {
        const int shift = j * CYLINT_LEAF_P_BITS;
        p[j] = (double)(b->p[0][0] >> shift & CYLINT_LEAF_P_MASK);
        w[j] = (double)(b->p[1][0] >> shift & CYLINT_LEAF_P_MASK) - p[j];
    }
    cross3(side, w, any);
    for (int j = 0; j < 3; j++)
        size = fmax(size, fabs(side[j]));
    for (int j = 0; j < 3; j++)
        q[j] = p[j] - (double)CYLINT_LEAF_MIDDLE + z * w[j] +
               (size > 0 ? far * side[j] / size : far);
}

/* far: the distance from the centre in steps, about. */
static void check_lanes(double far)
{
    cylint_leaf b;
    double from[3], distance = HUGE_VAL;
    float least[CYLINT_LEAF_SIZE];
    traversal t = {.distance = &distance};
    long double q[3], K = (long double)CYLINDER_REACH;
    draw_leaf(&b);
    const double steps = (double)cylint_leaf_steps(&b);
    t.error = one_of(2) ? 0x1p-8 : 0;
    if (one_of(2))
        draw_beside(&b, far, from);
    else
        random_vector(from, far);
    for (int j = 0; j < 3; j++) {
        t.x[j] = (double)b.center[j] + from[j] / steps;
        q[j] = ((long double)t.x[j] - b.center[j]) * steps;
        K += fabsl(q[j]);
    }
    b.always = one_of(4) ? 0 : 1;
    CHECK(test_lanes_of(&t, &b, least) == (1u << CYLINT_LEAF_SIZE) - 1);
    const long double coarse =
        K < (long double)FAR_LIMIT ? 0x1p-18 * K : 0x1p-47 * K + 2 + 0x1p20 / K;
    for (int lane = 0; lane < CYLINT_LEAF_SIZE; lane++) {
        const double apart = (double)(distance_to_lane(&b, lane, q) / steps);
        const double lacks =
            (double)(coarse / steps) + 2 * t.error + 0x1p-21 * apart;
        const int is_certain = !(b.always >> lane & 1);
        const double bound = (double)least[lane];
        if (!CHECK(bound >= 0 && (bound == 0 || bound <= apart - t.error)))
            REPORT("far %g: bound %a above %a", far, bound, apart);
        if (!CHECK(is_certain ? bound >= apart - lacks : bound == 0))
            REPORT("far %g: bound %a far below %a", far, bound, apart);
        distance = fmax(apart, 0);
        CHECK(test_lanes_of(&t, &b, least) >> lane & 1);
        distance = bound * (1 - 0x1p-52);
        CHECK(bound == 0 || !(test_lanes_of(&t, &b, least) >> lane & 1));
    }
}

TEST(bounds_of_lanes_are_below_their_distances)
{
    stream = check_seed() + 1;
    for (int round = 0; round < ROUNDS; round++) {
        fesetround(roundings[round % ROUNDINGS]);
        check_lanes(between(0, 3));
        check_lanes(between(0, 2000));
        check_lanes(pow(2, between(10, 16)));
        check_lanes(pow(2, between(17, 21)));
        check_lanes(pow(2, between(16, 70)));
    }
}
