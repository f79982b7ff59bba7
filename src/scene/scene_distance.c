/*
 * scene_distance.c - the shapes of a scene that are near a point
 *
 * The hierarchy rejects shapes that are certainly farther than the radius, or
 * than the nearest shape so far (traverse_point.h), and cylint_safety() rejects
 * others.  cylint_distance() computes the distances to the rest.
 *
 * A box contains the surface of its shapes, so the distance to the box, which
 * is 0 for a point inside, is a lower bound of the distance to the surface.
 */
#include <string.h>

#include "../numbers/bits.h"
#include "../shapes/shape_facts.h"
#include "number_heap.h"
#include "number_set.h"
#include "scene.h"

/* The shapes of several pieces that were tested last; a direct-mapped cache. */
enum { RECENT = 16 };

/* How shapes of several pieces are tested once: by the set of the tested ones,
 * or, if it becomes full, in a second traversal at one of their pieces. */
typedef enum { BY_SET, SET_FULL, BY_PIECE } once;

/* The state of one query. */
typedef struct {
    const cylint_scene *scene;
    const double *point;
    double most;   /* the radius, or the distance of the nearest shape so far */
    double reject; /* a lower bound of a distance above this is too far */
    double reach;  /* the same in the frame */
    double x[3];   /* the point in the frame */
    int to_nearest;        /* doubles are rounded to nearest */
    size_t nearest;        /* n: none so far */
    cylint_closest answer; /* of it: distance and flags */
    size_t count, enough;
    cylint_number_heap heap;
    uint32_t recent[RECENT];
    once once;
    cylint_number_set tested;
} search;

/* More than the error of cylint_distance(). */
#define SLACK (1 + 0x1p-40)

static void set_most(search *q, double most)
{
    q->most = most;
    q->reject = most * SLACK + DBL_MIN;
    q->reach = q->reject * q->scene->frame.scale * SLACK + 0x1p-400;
}

/* Whether the shape's surface is at most q->most away.  Writes distance and
 * flags.  cylint_safety() pays for elliptic shapes only. */
static int is_near(const search *q, size_t number, cylint_closest *answer)
{
    cylint_shape shape;
    cylint_record_shape(&q->scene->records, number, &shape);
    if (cylint_is_elliptic(shape.kind) && q->to_nearest &&
        cylint_safety(&shape, q->point) > q->reject)
        return 0;
    answer->part = 0; /* written only if there is no surface */
    cylint_distance(&shape, q->point, 0, answer);
    return answer->part >= 0 && !cylint_less(q->most, fabs(answer->distance));
}

/* ----------------------------------------------------- the nearest one -- */

static void test_nearest(search *q, size_t number)
{
    cylint_closest answer;
    if (!is_near(q, number, &answer))
        return;
    const double distance = fabs(answer.distance);
    if (number > q->nearest && !cylint_less(distance, q->most) &&
        q->nearest < q->scene->n)
        return;
    q->nearest = number;
    q->answer.distance = answer.distance;
    q->answer.flags = answer.flags;
    set_most(q, distance);
}

static int was_tested(search *q, const cylint_leaf *leaf, int lane)
{
    const uint32_t number = leaf->number[lane];
    uint32_t *recent = &q->recent[number % RECENT];
    if (cylint_leaf_piece(leaf, lane).count == 1)
        return 0;
    const int was = *recent == number;
    *recent = number;
    return was;
}

/* The nearest of the lanes. */
static int nearest_lane(unsigned lanes, const double least[CYLINT_LEAF_SIZE])
{
    int first = cylint_lowest(lanes);
    while (lanes &= lanes - 1)
        if (least[cylint_lowest(lanes)] < least[first])
            first = cylint_lowest(lanes);
    return first;
}

static int test_leaf_nearest(void *self, const cylint_leaf *leaf,
                             const double least[CYLINT_LEAF_SIZE])
{
    search *q = self;
    unsigned lanes = (1u << cylint_leaf_used(leaf)) - 1;
    while (lanes) {
        const int lane = nearest_lane(lanes, least);
        if (least[lane] > q->reach)
            break;
        lanes &= ~(1u << lane);
        if (!was_tested(q, leaf, lane))
            test_nearest(q, leaf->number[lane]);
    }
    return 0;
}

/* ------------------------------------------------- all within a radius -- */

/* Counts the shape if it is within the radius.  Returns whether there are enough
 * now. */
static int test_within(search *q, size_t number)
{
    cylint_closest answer;
    if (q->heap.numbers && !cylint_heap_accepts(&q->heap, number))
        return 0;
    if (!is_near(q, number, &answer))
        return 0;
    if (q->heap.numbers)
        cylint_heap_add(&q->heap, number, fabs(answer.distance));
    q->count++;
    return q->count == q->enough;
}

/* The square of the distance from x to a box. */
static double square_to_box(const double x[3], const cylint_extent *box)
{
    double sum = 0;
    for (int j = 0; j < 3; j++) {
        const double below = (double)box->lower[j] - x[j];
        const double above = x[j] - (double)box->upper[j];
        const double apart = cylint_larger(cylint_larger(below, above), 0);
        sum += apart * apart;
    }
    return sum;
}

/*
 * Whether a shape is tested at this piece of it: the one whose box is nearest,
 * of equal boxes the first.  If the shape is within the radius, so is that
 * box, and the traversal visits every box within the radius.
 */
static int is_first_piece(const search *q, uint32_t number, cylint_piece piece)
{
    cylint_swept_disc disc;
    double reach[3], least = HUGE_VAL;
    int first = 0;
    cylint_shape spare;
    cylint_swept_disc_of(
        &disc, &q->scene->view,
        cylint_view_shape(&q->scene->view, number, &spare));
    cylint_swept_disc_reach(&disc, reach);
    for (int index = 0; index < piece.count; index++) {
        const cylint_extent box =
            cylint_piece_box(&disc, reach, (cylint_piece){index, piece.count});
        const double square = square_to_box(q->x, &box);
        if (square < least) {
            least = square;
            first = index;
        }
    }
    return first == piece.index;
}

/* In the traversal BY_PIECE the bounds of lanes do not count, because they may
 * reject that piece. */
static int test_leaf_by_piece(void *self, const cylint_leaf *leaf,
                              const double least[CYLINT_LEAF_SIZE])
{
    search *q = self;
    for (int lane = 0; lane < cylint_leaf_used(leaf); lane++) {
        const cylint_piece piece = cylint_leaf_piece(leaf, lane);
        const uint32_t number = leaf->number[lane];
        if (piece.count > 1 ? is_first_piece(q, number, piece)
                            : least[lane] <= q->reach)
            if (test_within(q, number))
                return 1;
    }
    return 0;
}

/* Whether the shape has several pieces and was tested.  If not, it counts as
 * tested now. */
static int was_tested_before(search *q, const cylint_leaf *leaf, int lane)
{
    const uint32_t number = leaf->number[lane];
    if (cylint_leaf_piece(leaf, lane).count == 1)
        return 0;
    uint32_t *slot = cylint_set_slot(&q->tested, number);
    if (*slot == number)
        return 1;
    if (cylint_set_is_full(&q->tested))
        q->once = SET_FULL;
    else
        cylint_set_add(&q->tested, slot, number);
    return 0;
}

static int test_leaf_by_set(void *self, const cylint_leaf *leaf,
                            const double least[CYLINT_LEAF_SIZE])
{
    search *q = self;
    for (int lane = 0; lane < cylint_leaf_used(leaf); lane++)
        if (least[lane] <= q->reach && !was_tested_before(q, leaf, lane) &&
            (q->once == SET_FULL || test_within(q, leaf->number[lane])))
            return 1;
    return 0;
}

/* ------------------------------------------------------------- queries -- */

/* Writes the point in the frame.  Returns 0 if it is too far away. */
static int to_frame(search *q)
{
    const cylint_frame *frame = &q->scene->frame;
    int fits = q->to_nearest;
    for (int j = 0; j < 3; j++) {
        q->x[j] = (q->point[j] - frame->center[j]) * frame->scale;
        fits &= fabs(q->x[j]) <= CYLINT_POINT_MOST;
    }
    return fits;
}

static int test_one(search *q, size_t number, int nearest)
{
    if (!nearest)
        return test_within(q, number);
    test_nearest(q, number);
    return 0;
}

/* Traverses the hierarchy or, where the frame cannot hold the point, tests every
 * shape in it. */
static void test_bounded(search *q, int nearest)
{
    const cylint_scene *s = q->scene;
    if (s->n_bounded == 0)
        return;
    if (to_frame(q)) {
        s->traverse_point(&s->bvh, q->x, &q->reach,
                          nearest               ? test_leaf_nearest
                          : q->once == BY_PIECE ? test_leaf_by_piece
                                                : test_leaf_by_set,
                          q);
        return;
    }
    for (size_t i = 0; i < s->n_bounded; i++)
        if (test_one(q, s->bounded ? s->bounded[i] : i, nearest))
            return;
}

static void test_all(search *q, int nearest)
{
    const cylint_scene *s = q->scene;
    for (size_t i = 0; i < s->n_others; i++)
        if (test_one(q, s->others[i], nearest))
            return;
    test_bounded(q, nearest);
}

static void test_all_within(search *q)
{
    q->once = BY_SET;
    cylint_set_clear(&q->tested);
    test_all(q, 0);
    if (q->once == SET_FULL) {
        q->once = BY_PIECE;
        q->count = q->heap.n = 0;
        test_all(q, 0);
    }
}

/* Returns 0 if no shape is within the radius. */
static int start(search *q, const cylint_scene *scene, const double point[3],
                 double radius)
{
    if (!(radius >= 0) || !cylint_is_finite(point))
        return 0;
    memset(q->recent, 0xff, sizeof q->recent); /* CYLINT_NO_SHAPE */
    q->heap = (cylint_number_heap){.numbers = NULL};
    q->count = q->enough = 0;
    q->scene = scene;
    q->point = point;
    q->nearest = scene->n;
    q->to_nearest = cylint_rounds_to_nearest();
    set_most(q, radius);
    return 1;
}

/* The members that the search does not compute. */
#define WANTED (CYLINT_WANT_PART | CYLINT_WANT_POINT | CYLINT_WANT_NORMAL)

size_t cylint_scene_closest(const cylint_scene *scene, const double point[3],
                            double radius, unsigned want,
                            cylint_closest *answer)
{
    search q;
    if (!start(&q, scene, point, radius))
        return scene->n;
    test_all(&q, 1);
    if (q.nearest < scene->n && want & WANTED) {
        cylint_shape shape;
        cylint_record_shape(&scene->records, q.nearest, &shape);
        cylint_distance(&shape, point, want, answer);
    } else if (q.nearest < scene->n) {
        answer->distance = q.answer.distance;
        answer->flags = q.answer.flags;
    }
    return q.nearest;
}

size_t cylint_scene_within_count(const cylint_scene *scene,
                                 const double point[3], double radius,
                                 size_t enough)
{
    search q;
    if (!start(&q, scene, point, radius))
        return 0;
    q.enough = enough;
    test_all_within(&q);
    return q.count;
}

size_t cylint_scene_within(const cylint_scene *scene, const double point[3],
                           double radius, size_t first, size_t *numbers,
                           double *distances, size_t capacity)
{
    search q;
    if (capacity == 0 || !start(&q, scene, point, radius))
        return 0;
    q.heap = (cylint_number_heap){.numbers = numbers,
                                  .values = distances,
                                  .capacity = capacity,
                                  .first = first};
    test_all_within(&q);
    cylint_heap_sort(&q.heap);
    return q.heap.n;
}
