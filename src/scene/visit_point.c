/*
 * visit_point.c - the shapes of a scene that are near a point
 *
 * The hierarchy rejects shapes that are certainly farther than the radius
 * (traverse_point.h), and cylint_safety() rejects others.  cylint_distance()
 * computes the distances to the rest.
 *
 * A box contains the surface of its shapes, so the distance to the box, which
 * is 0 for a point inside, is a lower bound of the distance to the surface.
 */
#include <string.h>

#include "../numbers/bits.h"
#include "../shapes/shape_facts.h"
#include "number_set.h"
#include "visit.h"

/* As in visit_line.c: the cache serves visits that may repeat a shape; the set has
 * the shapes that were visited; if it is full, the piece that contains the nearest
 * point decides. */
enum { RECENT = 16 };

typedef struct {
    const cylint_scene *scene;
    const double *point;
    double radius;  /* no larger distance is wanted */
    double reject;  /* a lower bound of a distance above this is too far */
    double reach;   /* the same in the frame */
    double x[3];    /* the point in the frame */
    int to_nearest; /* doubles are rounded to nearest */
    int often, stopped;
    cylint_scene_near *callback;
    void *context;
    uint32_t recent[RECENT];
    cylint_number_set visited; /* not used if `often` */
} point_visit;

/* More than the error of cylint_distance(). */
#define SLACK (1 + 0x1p-40)

static void set_point_radius(point_visit *v, double radius)
{
    v->radius = radius;
    v->reject = radius * SLACK + DBL_MIN;
    v->reach = v->reject * v->scene->frame.scale * SLACK + 0x1p-400;
    v->stopped = !(radius >= 0);
}

/* Whether the shape's surface is at most v->radius away.  Writes distance and
 * flags.  cylint_safety() pays for elliptic shapes only. */
static int point_is_near(const point_visit *v, size_t number,
                         cylint_closest *answer)
{
    cylint_shape shape;
    cylint_record_shape(&v->scene->records, number, &shape);
    if (cylint_is_elliptic(shape.kind) && v->to_nearest &&
        cylint_safety(&shape, v->point) > v->reject)
        return 0;
    answer->part = 0; /* written only if there is no surface */
    cylint_distance(&shape, v->point, 0, answer);
    return answer->part >= 0 && !cylint_less(v->radius, fabs(answer->distance));
}

/* Returns whether the shape is near. */
static int test_point_at(point_visit *v, size_t number)
{
    cylint_closest answer;
    if (!point_is_near(v, number, &answer))
        return 0;
    const double radius =
        v->callback(v->context, number, answer.distance, answer.flags);
    if (!(radius >= v->radius))
        set_point_radius(v, radius);
    return 1;
}

/* ------------------------------------------------------------- leaves --- */

static int point_tested(point_visit *v, uint32_t number)
{
    uint32_t *recent = &v->recent[number % RECENT];
    const int was = *recent == number;
    *recent = number;
    return was;
}

/* The axial coordinate of a point in the frame; 0 for a shape whose axis is lost to
 * underflow, all lanes of which are tested always. */
static double axial_of(const cylint_swept_disc *disc, const double x[3])
{
    double across[3], zz = 0, zx = 0;
    for (int j = 0; j < 3; j++) {
        const int k = (j + 1) % 3, l = (j + 2) % 3;
        across[j] = disc->elliptic
                        ? disc->a[k] * disc->b[l] - disc->a[l] * disc->b[k]
                        : disc->axis[j];
        zz += across[j] * disc->axis[j];
        zx += across[j] * (x[j] - disc->base[j]);
    }
    return fabs(zz) > 0 ? zx / zz : 0;
}

/*
 * Whether the lane's piece contains the shape's nearest point, computed in doubles.
 * That piece is within v->radius, but for an error that is less than the bounds of
 * traverse_point.h allow for, so its lane is never rejected; and it is the same
 * piece whenever the shape is tested.
 */
static int owns_nearest_point(const point_visit *v, const cylint_leaf *leaf,
                              int lane)
{
    const cylint_frame *frame = &v->scene->frame;
    cylint_shape shape;
    cylint_swept_disc disc;
    cylint_closest answer;
    double x[3];
    cylint_record_shape(&v->scene->records, leaf->number[lane], &shape);
    cylint_distance(&shape, v->point, CYLINT_WANT_POINT, &answer);
    for (int j = 0; j < 3; j++)
        x[j] = (answer.point[j] - frame->center[j]) * frame->scale;
    cylint_swept_disc_of(&disc, &v->scene->view, &shape);
    return cylint_leaf_owns(leaf, lane, axial_of(&disc, x));
}

/* Tests a shape of several pieces at one of them. */
static void test_point_piece(point_visit *v, const cylint_leaf *leaf, int lane)
{
    const uint32_t number = leaf->number[lane];
    if (v->often) {
        if (!point_tested(v, number))
            test_point_at(v, number);
        return;
    }
    uint32_t *slot = cylint_set_slot(&v->visited, number);
    if (*slot == number)
        return;
    if (cylint_set_is_full(&v->visited)) {
        if (owns_nearest_point(v, leaf, lane))
            test_point_at(v, number);
    } else if (test_point_at(v, number)) {
        cylint_set_add(&v->visited, slot, number);
    }
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

static int test_point_leaf(void *self, const cylint_leaf *leaf,
                           const double least[CYLINT_LEAF_SIZE])
{
    point_visit *v = self;
    unsigned lanes = (1u << cylint_leaf_used(leaf)) - 1;
    if (!v->often) { /* then most shapes within reach are tested */
        for (int lane = 0; lane < cylint_leaf_used(leaf); lane++)
            lanes &= ~((unsigned)(least[lane] > v->reach) << lane);
        cylint_prefetch_shapes(v->scene, leaf, lanes);
    }
    while (lanes && !v->stopped) {
        const int lane = nearest_lane(lanes, least);
        if (least[lane] > v->reach)
            break;
        lanes &= ~(1u << lane);
        if (cylint_leaf_piece(leaf, lane).count > 1)
            test_point_piece(v, leaf, lane);
        else
            test_point_at(v, leaf->number[lane]);
    }
    return v->stopped;
}

/* ------------------------------------------------------------- visits --- */

/* Writes the point in the frame.  Returns 0 if it is too far away. */
static int point_to_frame(point_visit *v)
{
    const cylint_frame *frame = &v->scene->frame;
    int fits = v->to_nearest;
    for (int j = 0; j < 3; j++) {
        v->x[j] = (v->point[j] - frame->center[j]) * frame->scale;
        fits &= fabs(v->x[j]) <= CYLINT_POINT_MOST;
    }
    return fits;
}

/* Traverses the hierarchy or, where the frame cannot hold the point, tests every
 * shape in it. */
static void traverse_points(point_visit *v)
{
    const cylint_scene *s = v->scene;
    if (s->n_bounded == 0 || v->stopped)
        return;
    if (point_to_frame(v)) {
        s->traverse_point(&s->bvh, v->x, &v->reach, test_point_leaf, v);
        return;
    }
    for (size_t i = 0; i < s->n_bounded && !v->stopped; i++)
        test_point_at(v, s->bounded ? s->bounded[i] : i);
}

void cylint_visit_point(const cylint_scene *scene, const double point[3],
                        double radius, int often, cylint_scene_near *callback,
                        void *context)
{
    point_visit v;
    if (!(radius >= 0) || !cylint_is_finite(point))
        return;
    v.scene = scene;
    v.point = point;
    v.to_nearest = cylint_rounds_to_nearest();
    v.often = often;
    v.callback = callback;
    v.context = context;
    memset(v.recent, 0xff, sizeof v.recent); /* CYLINT_NO_SHAPE */
    if (!often)
        cylint_set_clear(&v.visited);
    set_point_radius(&v, radius);
    for (size_t i = 0; i < scene->n_others && !v.stopped; i++)
        test_point_at(&v, scene->others[i]);
    traverse_points(&v);
}

void cylint_scene_visit_point(const cylint_scene *scene, const double point[3],
                              double radius, cylint_scene_near *callback,
                              void *context)
{
    cylint_visit_point(scene, point, radius, 0, callback, context);
}
