/*
 * visit_point.c - the shapes of a scene that are near a point or hold it
 *
 * The hierarchy rejects shapes that are certainly farther than the radius
 * (traverse_point.c), and cylint_safety() rejects others.  cylint_distance()
 * computes the distances to the rest.
 *
 * The box of a piece contains the surface and the solid of the piece, whatever
 * its ends: a piece is the convex hull of two sections (leaf.c), and the pieces
 * of a shape cover its solid.  The distance to a box is 0 for a point inside.  So
 * it is a lower bound of the distance to the surface, and of the distance to the
 * closed solid, which is 0 inside.  A traversal with the radius 0 therefore finds
 * a piece of each solid that holds the point: the bounds of traverse_point.c are
 * lower by more than their roundings, so they are 0 for such a piece.  Solids
 * deeper than a negative radius hold the point, so that they are found too.
 */
#include "../numbers/bits.h"
#include "../shapes/shape_facts.h"
#include "visit.h"
#include "visit_leaf.h"

typedef struct {
    const cylint_scene *scene;
    const double *point;
    double radius; /* no larger distance is wanted; negative: no lesser depth */
    double reject; /* a lower bound of a distance above this is too far */
    double reach;  /* the same in the frame */
    double x[3];   /* the point in the frame */
    int to_nearest; /* doubles are rounded to nearest */
    cylint_nearness nearness;
    int stopped;
    cylint_use_found *callback;
    void *context;
    cylint_tested_shapes tested;
} point_visit;

/* More than the error of cylint_distance(). */
#define SLACK (1 + 0x1p-40)

/* Whether no shape can be within the radius. */
static int is_no_radius(cylint_nearness nearness, double radius)
{
    return nearness == CYLINT_NEAR_SURFACE ? !(radius >= 0) : radius != radius;
}

static void set_point_radius(point_visit *v, double radius)
{
    const double outside = cylint_larger(radius, 0);
    v->radius = radius;
    v->reject = outside * SLACK + DBL_MIN;
    v->reach = v->reject * v->scene->frame.scale * SLACK + 0x1p-400;
    v->stopped = is_no_radius(v->nearness, radius);
}

/* Makes the shape, or its closed solid. */
static void make_tested(const point_visit *v, size_t number,
                        cylint_shape *shape)
{
    cylint_record_shape(&v->scene->records, number, shape);
    if (v->nearness != CYLINT_NEAR_SURFACE)
        shape->ends = cylint_closed_ends(shape->ends);
}

/* Whether cylint_safety() shows that the shape is beyond the radius.  It pays for
 * elliptic shapes only.  It is positive inside a solid too. */
static int is_safely_far(const point_visit *v, const cylint_shape *shape)
{
    return cylint_is_elliptic(shape->kind) && v->to_nearest &&
           cylint_safety(shape, v->point) > v->reject &&
           (v->nearness == CYLINT_NEAR_SURFACE ||
            cylint_contains(shape, v->point) < 0);
}

/* The distance that is compared. */
static double compared(const point_visit *v, const cylint_closest *answer)
{
    return v->nearness == CYLINT_NEAR_SURFACE ? fabs(answer->distance)
                                              : answer->distance;
}

/* Whether the shape's surface or solid is at most v->radius away.  Writes distance
 * and flags.  cylint_contains() takes less time than the distance, and decides
 * about shapes that must hold the point. */
static int point_is_near(const point_visit *v, size_t number,
                         cylint_closest *answer)
{
    cylint_shape shape;
    make_tested(v, number, &shape);
    answer->distance = answer->flags = 0;
    if (v->nearness != CYLINT_NEAR_SURFACE && cylint_sign(v->radius) <= 0 &&
        cylint_contains(&shape, v->point) < 0)
        return 0;
    if (v->nearness == CYLINT_HOLDING)
        return 1;
    if (is_safely_far(v, &shape))
        return 0;
    answer->part = 0; /* written only if there is no surface */
    cylint_distance(&shape, v->point, 0, answer);
    return answer->part >= 0 && !cylint_less(v->radius, compared(v, answer));
}

/* Returns whether the shape is near. */
static int test_point_at(void *self, size_t number)
{
    point_visit *v = self;
    cylint_closest answer;
    if (!point_is_near(v, number, &answer))
        return 0;
    const cylint_found found = {
        .number = number, .at = compared(v, &answer), .closest = &answer};
    const double radius = v->callback(v->context, &found);
    if (!(radius >= v->radius))
        set_point_radius(v, radius);
    return 1;
}

/* ------------------------------------------------------------- leaves --- */

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
 * Whether the lane's piece contains the nearest point of the surface or solid,
 * computed in doubles; of a solid that holds the point it is the point.  That
 * piece is within v->radius, but for an error that is less than the bounds of
 * traverse_point.c allow for, so its lane is never rejected; and it is the same
 * piece whenever the shape is tested.
 */
static int owns_nearest_point(const void *self, const cylint_leaf *leaf,
                              int lane)
{
    const point_visit *v = self;
    const cylint_frame *frame = &v->scene->frame;
    cylint_shape shape;
    cylint_swept_disc disc;
    cylint_closest answer;
    double x[3];
    make_tested(v, leaf->number[lane], &shape);
    cylint_distance(&shape, v->point, CYLINT_WANT_POINT, &answer);
    const int is_point =
        v->nearness != CYLINT_NEAR_SURFACE && answer.distance < 0;
    const double *nearest = is_point ? v->point : answer.point;
    for (int j = 0; j < 3; j++)
        x[j] = (nearest[j] - frame->center[j]) * frame->scale;
    cylint_swept_disc_of(&disc, &v->scene->view, &shape);
    return cylint_leaf_owns(leaf, lane, axial_of(&disc, x));
}

static int test_point_leaf(void *self, const cylint_leaf *leaf,
                           const double least[CYLINT_LEAF_SIZE])
{
    point_visit *v = self;
    unsigned lanes = (1u << cylint_leaf_used(leaf)) - 1;
    if (!v->tested.often) { /* then most shapes within reach are tested */
        for (int lane = 0; lane < cylint_leaf_used(leaf); lane++)
            lanes &= ~((unsigned)(least[lane] > v->reach) << lane);
        cylint_prefetch_shapes(v->scene, leaf, lanes);
    }
    while (lanes && !v->stopped) {
        const int lane = cylint_first_lane(lanes, least);
        if (least[lane] > v->reach)
            break;
        lanes &= ~(1u << lane);
        cylint_test_lane(&v->tested, leaf, lane, test_point_at,
                         owns_nearest_point, v);
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
        s->traversal->point(&s->bvh, v->x, &v->reach, test_point_leaf, v);
        return;
    }
    for (size_t i = 0; i < s->n_bounded && !v->stopped; i++)
        test_point_at(v, cylint_bounded_number(s, i));
}

void cylint_visit_point(const cylint_scene *scene, const double point[3],
                        double radius, cylint_nearness nearness, int often,
                        cylint_use_found *callback, void *context)
{
    point_visit v;
    if (is_no_radius(nearness, radius) || !cylint_is_finite(point))
        return;
    v.scene = scene;
    v.point = point;
    v.to_nearest = cylint_rounds_to_nearest();
    v.nearness = nearness;
    v.callback = callback;
    v.context = context;
    cylint_begin_tests(&v.tested, often);
    set_point_radius(&v, radius);
    for (size_t i = 0; i < scene->n_others && !v.stopped; i++)
        test_point_at(&v, scene->others[i]);
    traverse_points(&v);
}
