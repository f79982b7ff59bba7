/*
 * visit.c - the shapes of a scene that a line hits, or that are near a point or
 * hold it
 *
 * The hierarchy finds a shape of several slices several times.  A direct-mapped
 * cache of the shapes that were tested last saves repeated tests.  A hash table
 * with open addressing has those that were visited; if it is full, other shapes of
 * several slices are left, and further traversals find them.
 */
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "../numbers/bits.h"
#include "../intersect.h"
#include "../shapes/shape_facts.h"
#include "visit.h"

/* -------------------------------------------- the shapes of a leaf, once -- */

enum { RECENT = 16, SET_SIZE = 256, SET_MOST = 192 };

/* No shape has this number. */
#define NO_SHAPE UINT32_MAX

/* A further traversal finds up to MOST_LEFT shapes in a list; or in as many words
 * of bits, where shapes of neighbouring numbers are left, MOST_BITS shapes. */
enum { MOST_LEFT = 4096, MOST_BITS = 32 * MOST_LEFT };

typedef struct {
    int may_repeat; /* a shape may be visited more than once: without the table */
    int visited;
    uint32_t recent[RECENT], slot[SET_SIZE];
    int has_left; /* further shapes were found, which are not in `left` */
    /* NULL in the first traversal; then the lowest of those shapes that are not
     * in the table, from first_left on: ascending, or a bit for each number */
    uint32_t *left;
    size_t n_left;
    uint32_t first_left;
    int in_bits;
} tested_shapes;

static inline void begin_tests(tested_shapes *s, int may_repeat)
{
    s->may_repeat = may_repeat;
    s->visited = s->has_left = 0;
    s->left = NULL;
    memset(s->recent, 0xff, sizeof s->recent); /* NO_SHAPE */
    if (!may_repeat)
        memset(s->slot, 0xff, sizeof s->slot);
}

/* Whether the shape is in the cache, in which it is afterwards. */
static inline int was_tested(tested_shapes *s, uint32_t number)
{
    uint32_t *recent = &s->recent[number % RECENT];
    const int was = *recent == number;
    *recent = number;
    return was;
}

/* The slot of the table that has the number or is free for it. */
static inline uint32_t *slot_of(tested_shapes *s, uint32_t number)
{
    uint32_t at = number * UINT32_C(2654435769) >> 24;
    while (s->slot[at] != number && s->slot[at] != NO_SHAPE)
        at = (at + 1) % SET_SIZE;
    return &s->slot[at];
}

/* Adds a shape to the list, unless that has MOST_LEFT lower ones. */
static void list_left(tested_shapes *s, uint32_t number)
{
    const size_t at = cylint_place_among(s->left, s->n_left, number);
    if (at < s->n_left && s->left[at] == number)
        return;
    s->has_left |= s->n_left == MOST_LEFT;
    if (at == MOST_LEFT)
        return;
    s->n_left += s->n_left < MOST_LEFT;
    memmove(s->left + at + 1, s->left + at,
            (s->n_left - at - 1) * sizeof *s->left);
    s->left[at] = number;
}

/* Adds a shape to those that are left. */
static void keep_left(tested_shapes *s, uint32_t number)
{
    const uint32_t at = number - s->first_left;
    if (number < s->first_left)
        return;
    if (!s->in_bits)
        list_left(s, number);
    else if (at < MOST_BITS)
        s->left[at / 32] |= UINT32_C(1) << at % 32;
    else
        s->has_left = 1;
}

/* Tests a shape and calls back for it.  Returns whether it did. */
typedef int shape_test(void *visit, size_t number);

/* Tests shapes [from, to) of a list, or those with these numbers if it is NULL. */
static void test_each(void *visit, const int *stopped, shape_test *test,
                      const uint32_t *list, size_t from, size_t to)
{
    for (size_t i = from; i < to && !*stopped; i++)
        test(visit, list ? list[i] : i);
}

/* Tests the shape of a lane, unless it was tested or is left. */
CYLINT_INLINE void test_lane(tested_shapes *s, const cylint_leaf *leaf,
                             int lane, shape_test *test, void *visit)
{
    const uint32_t number = leaf->number[lane];
    if (cylint_leaf_slice(leaf, lane).count == 1) {
        if (!s->left)
            test(visit, number);
        return;
    }
    if (s->may_repeat) {
        if (!was_tested(s, number))
            test(visit, number);
        return;
    }
    uint32_t *slot = slot_of(s, number);
    if (*slot == number)
        return;
    if (s->left) {
        keep_left(s, number);
    } else if (s->visited == SET_MOST) {
        s->has_left = 1;
    } else if (!was_tested(s, number) && test(visit, number)) {
        *slot = number;
        s->visited++;
    }
}

/* Tests the shapes that have bits.  A list follows if they are few. */
static void test_bits(tested_shapes *s, void *visit, const int *stopped,
                      shape_test *test)
{
    for (uint32_t i = 0; i < MOST_LEFT; i++)
        for (uint32_t of = s->left[i]; of && !*stopped; of &= of - 1) {
            s->n_left++;
            test(visit, s->first_left + 32 * i + (uint32_t)cylint_lowest(of));
        }
    s->in_bits = s->n_left >= MOST_LEFT;
    s->first_left += MOST_BITS;
}

/* The same of the list.  Bits follow if its numbers are near each other. */
static void test_list(tested_shapes *s, void *visit, const int *stopped,
                      shape_test *test)
{
    const size_t n = s->n_left;
    test_each(visit, stopped, test, s->left, 0, n);
    if (!s->has_left)
        return;
    s->in_bits = s->left[n - 1] - s->left[0] < MOST_BITS;
    s->first_left = s->left[n - 1] + 1;
}

/* Tests the shapes that were left, each once, by traversing again. */
ASIDE void test_left(tested_shapes *s, void *visit, const int *stopped,
                     shape_test *test, void (*traverse)(void *visit))
{
    uint32_t left[MOST_LEFT];
    s->left = left;
    s->first_left = 0;
    s->in_bits = 0;
    while (s->has_left) {
        s->has_left = 0;
        s->n_left = 0;
        if (s->in_bits)
            memset(left, 0, sizeof left);
        traverse(visit);
        (s->in_bits ? test_bits : test_list)(s, visit, stopped, test);
    }
}

/* Begins to load the lanes' shapes.  Always inlined: GCC removes calls of a
 * function which only prefetches. */
CYLINT_INLINE void prefetch_shapes(const cylint_scene *scene,
                                   const cylint_leaf *leaf, unsigned lanes)
{
    const cylint_records *r = &scene->records;
    EACH_BIT(lane, lanes) {
        const uint32_t number = leaf->number[lane];
        CYLINT_PREFETCH(&r->record[number]);
        CYLINT_PREFETCH(&r->record[number].r1); /* in another line */
        CYLINT_PREFETCH(&r->tag[number]);
    }
}

/* ---------------------------------------------------- a line and a shape -- */

/*
 * A hierarchy over slices of shapes (bvh.h) rejects shapes that the line
 * certainly does not hit, or hits beyond the last t that is wanted
 * (traverse.h).  Of the others local coordinates in doubles reject nearly all
 * that the line does not hit; cylint_intersect() tests the others.
 */

/* The most lanes that wait while their shapes are loaded. */
enum { LATER = CYLINT_MOST_RECORDS };

typedef struct {
    const cylint_scene *scene;
    cylint_line line;          /* its tmax decreases with `last` */
    const cylint_line *domain; /* of chords */
    cylint_frame_ray ray;      /* its tmax does, too */
    double last;               /* the last t that is wanted */
    size_t except;
    unsigned want;
    int stopped;
    int is_cut; /* a lesser `last` may have left out shapes */
    int is_of_chords, in_no_order;
    cylint_use_found *callback;
    void *context;
    tested_shapes tested;
    struct {
        const cylint_leaf *leaf;
        int lane;
    } later[LATER];
    int n_later;
} line_visit;

/* Whether the line hits the shape; writes the shape and the members if members are
 * wanted. */
static int line_hits(const line_visit *v, size_t number, cylint_shape *shape,
                     cylint_hit *hit)
{
    const cylint_records *r = &v->scene->records;
    const unsigned want = v->want;
    cylint_answer answer;
    const int is =
        r->tag[number] & CYLINT_TAG_PLAIN
            ? cylint_occluded_in_doubles(cylint_record_kind(r, number),
                                         cylint_record_ends(r, number),
                                         &r->record[number], &v->line)
            : CYLINT_UNDECIDED;
    if (is == 0 || (is == 1 && want == 0))
        return is;
    cylint_record_shape(r, number, shape);
    if (want == 0)
        return cylint_occluded(shape, &v->line);
    if (!cylint_intersect(shape, &v->line, want | CYLINT_WANT_NEAREST, &answer))
        return 0;
    *hit = answer.hit[0];
    return 1;
}

/* Sets the last t that is wanted.  A root that rounds to t is less than the double
 * above t, so that this bounds the domain. */
static void shorten_line(line_visit *v, double t)
{
    v->stopped = t != t;
    if (!cylint_less(t, v->last))
        return;
    v->last = t;
    v->line.tmax = cylint_next_above(t);
}

static void visit_chord(line_visit *v, size_t number, cylint_interval chord)
{
    const cylint_found found = {.number = number, .chord = chord};
    shorten_line(v, v->callback(v->context, &found));
}

/* lint: cylint_chord() wrote n chords */
/* Returns whether the shape has chords. */
static int visit_chords_at(line_visit *v, size_t number)
{
    cylint_shape shape;
    cylint_interval chord[2];
    cylint_record_shape(&v->scene->records, number, &shape);
    const int n = cylint_chord(&shape, v->domain, chord);
    for (int i = 0; i < n; i++)
        visit_chord(v, number, chord[i]);
    return n > 0;
}

/* Returns whether the line hits the shape. */
static int test_line_at(void *self, size_t number)
{
    line_visit *v = self;
    cylint_shape shape;
    cylint_hit hit;
    if (v->is_of_chords)
        return visit_chords_at(v, number);
    if (number == v->except || !line_hits(v, number, &shape, &hit))
        return 0;
    const cylint_found found = {.number = number,
                                .at = v->want & CYLINT_WANT_T ? hit.t : 0,
                                .hit = v->want ? &hit : NULL,
                                .shape = &shape};
    shorten_line(v, v->callback(v->context, &found));
    return 1;
}

/* ----------------------------------------------------- a line and leaves -- */

static void test_line_lane(line_visit *v, const cylint_leaf *leaf, int lane)
{
    test_lane(&v->tested, leaf, lane, test_line_at, v);
}

static int test_line_leaf(void *self, const cylint_leaf *leaf, unsigned lanes,
                          const float least[CYLINT_LEAF_SIZE])
{
    line_visit *v = self;
    while (lanes && !v->stopped) {
        const int lane = cylint_nearest_lane(lanes, least);
        const double last = v->last;
        lanes &= ~(1u << lane);
        if ((double)least[lane] > v->ray.line.tmax)
            continue;
        test_line_lane(v, leaf, lane);
        if (v->last < last) {
            const double tmax = cylint_frame_reach(&v->ray, v->last);
            v->is_cut |= tmax < v->ray.line.tmax;
            v->ray.line.tmax = fmin(v->ray.line.tmax, tmax);
        }
    }
    return v->stopped;
}

/* lint: all n counts are written, and a chord where its count is 1 */
/* Visits the chords of n > 0 waiting shapes, whose records are plain and of this
 * kind. */
static void visit_chords_of_kind(line_visit *v, int kind,
                                 const uint32_t *number, size_t n)
{
    cylint_interval chord[LATER];
    signed char count[LATER];
    cylint_chords_of_records(v->scene->records.record,
                             cylint_solid(kind, CYLINT_ENDS_CAPPED), number, n,
                             v->domain, chord, count);
    for (size_t i = 0; i < n; i++)
        if (count[i] > 0)
            visit_chord(v, number[i], chord[i]);
        else if (count[i] < 0)
            visit_chords_at(v, number[i]);
}

static void visit_later_chords(line_visit *v)
{
    const cylint_records *r = &v->scene->records;
    uint32_t number[CYLINT_KINDS][LATER];
    size_t n[CYLINT_KINDS] = {0};
    for (int i = 0; i < v->n_later; i++) {
        const cylint_leaf *leaf = v->later[i].leaf;
        const int lane = v->later[i].lane;
        const uint32_t at = leaf->number[lane];
        if (cylint_leaf_slice(leaf, lane).count > 1 &&
            was_tested(&v->tested, at))
            continue;
        const int kind = cylint_record_kind(r, at);
        if (r->tag[at] & CYLINT_TAG_PLAIN)
            number[kind][n[kind]++] = at;
        else
            visit_chords_at(v, at);
    }
    for (int kind = 0; kind < CYLINT_KINDS; kind++)
        if (n[kind] > 0)
            visit_chords_of_kind(v, kind, number[kind], n[kind]);
}

static int test_later(line_visit *v)
{
    if (v->is_of_chords)
        visit_later_chords(v);
    else
        for (int i = 0; i < v->n_later && !v->stopped; i++)
            test_line_lane(v, v->later[i].leaf, v->later[i].lane);
    v->n_later = 0;
    return v->stopped;
}

static int keep_line_leaf(void *self, const cylint_leaf *leaf, unsigned lanes,
                          const float least[CYLINT_LEAF_SIZE])
{
    line_visit *v = self;
    (void)least;
    prefetch_shapes(v->scene, leaf, lanes);
    EACH_BIT(lane, lanes) {
        v->later[v->n_later].leaf = leaf;
        v->later[v->n_later++].lane = lane;
    }
    return v->n_later > LATER - CYLINT_LEAF_SIZE && test_later(v);
}

/* ------------------------------------------------------- visits of lines -- */

/* Traverses the hierarchy or, where the frame cannot hold the line, tests every
 * shape in it. */
static void traverse_lines(void *self)
{
    line_visit *v = self;
    const cylint_scene *s = v->scene;
    if (s->n_bounded == 0 || v->stopped)
        return;
    switch (cylint_frame_line(&s->frame, &v->line, &v->ray)) {
    case CYLINT_FRAME_MISSED:
        return;
    case CYLINT_FRAME_ENTERED:
        if (v->in_no_order) {
            s->traversal->all(&s->bvh, &v->ray.line, keep_line_leaf, v);
            test_later(v);
            return;
        }
        s->traversal->line(&s->bvh, &v->ray.line, test_line_leaf, v, 0);
        return;
    default:
        test_each(v, &v->stopped, test_line_at, s->bounded, 0, s->n_bounded);
    }
}

/* The shapes beside the hierarchy; are_early: without late members. */
static const uint32_t *others_of(const cylint_scene *scene, int are_early,
                                 size_t *n)
{
    are_early &= scene->solids.n > 0;
    *n = are_early ? scene->solids.n_always : scene->n_others;
    return are_early ? scene->solids.always : scene->others;
}

int cylint_visit_line(const cylint_scene *scene, const cylint_line *line,
                      const cylint_visit_options *options, double last,
                      cylint_use_found *callback, void *context)
{
    size_t n;
    const uint32_t *others = others_of(scene, options->is_of_chords, &n);
    line_visit v;
    v.scene = scene;
    v.line = *line;
    v.domain = line;
    v.last = line->tmax;
    v.stopped = v.n_later = 0;
    v.except = options->except;
    v.want = options->want;
    v.is_of_chords = options->is_of_chords;
    v.in_no_order = options->in_no_order;
    v.callback = callback;
    v.context = context;
    begin_tests(&v.tested, options->may_repeat || options->is_of_chords);
    shorten_line(&v, last);
    test_each(&v, &v.stopped, test_line_at, others, options->first_other, n);
    v.is_cut = cylint_less(v.last, line->tmax);
    traverse_lines(&v);
    if (v.tested.has_left)
        test_left(&v.tested, &v, &v.stopped, test_line_at, traverse_lines);
    return v.is_cut;
}

/* --------------------------------------------------- a point and a shape -- */

/*
 * The hierarchy rejects shapes that are certainly farther than the radius
 * (traverse_point.c).  cylint_distance() computes the distances to the others.
 *
 * The box of a slice contains the surface and the solid of the slice, whatever
 * its ends: a slice is the convex hull of two sections (leaf.c), and the slices
 * of a shape cover its solid.  The distance to a box is 0 for a point inside.  So
 * it is a lower bound of the distance to the surface, and of the distance to the
 * closed solid, which is 0 inside.  A traversal with the radius 0 therefore finds
 * a slice of each solid that holds the point: the bounds of traverse_point.c are
 * lower by more than their roundings, so they are 0 for such a slice.  Solids
 * deeper than a negative radius hold the point, so that they are found too.
 */

typedef struct {
    const cylint_scene *scene;
    const double *point;
    double radius; /* no larger distance is wanted; negative: no lesser depth */
    double reach;  /* a lower bound above this is too far, in the frame */
    cylint_nearness nearness;
    int stopped;
    cylint_use_found *callback;
    void *context;
    tested_shapes tested;
} point_visit;

/* More than the error of cylint_distance(). */
#define SLACK (1 + 0x1p-40)

/* Stops the visit if the radius is NaN. */
static void set_point_radius(point_visit *v, double radius)
{
    const double outside = cylint_larger(radius, 0);
    v->radius = radius;
    v->reach =
        (outside * SLACK + DBL_MIN) * v->scene->frame.view.scale * SLACK +
        0x1p-400;
    v->stopped = radius != radius;
}

/* The distance that is compared. */
static double compared(const point_visit *v, double distance)
{
    return v->nearness == CYLINT_NEAR_SURFACE ? fabs(distance) : distance;
}

/* Makes the shape, or its closed solid, and returns whether its surface or solid is
 * at most v->radius away.  Writes the distance.  cylint_contains() takes less time
 * than the distance, and decides about shapes that must hold the point. */
static int point_is_near(const point_visit *v, size_t number,
                         cylint_shape *shape, double *distance)
{
    const int is_of_solid = v->nearness != CYLINT_NEAR_SURFACE;
    cylint_closest answer;
    cylint_record_shape(&v->scene->records, number, shape);
    if (is_of_solid)
        shape->ends = cylint_closed_ends(shape->ends);
    *distance = 0;
    if (is_of_solid && cylint_sign(v->radius) <= 0 &&
        cylint_contains(shape, v->point) < 0)
        return 0;
    if (v->nearness >= CYLINT_HOLDING)
        return 1;
    answer.part = 0; /* written only if there is no surface */
    *distance = cylint_distance(shape, v->point, 0, &answer);
    return answer.part >= 0 && !cylint_less(v->radius, compared(v, *distance));
}

/* Returns whether the shape is near. */
static int test_point_at(void *self, size_t number)
{
    point_visit *v = self;
    cylint_shape shape;
    double distance;
    if (!point_is_near(v, number, &shape, &distance))
        return 0;
    const cylint_found found = {.number = number,
                                .at = compared(v, distance),
                                .distance = distance,
                                .shape = &shape};
    const double radius = v->callback(v->context, &found);
    if (!(radius >= v->radius))
        set_point_radius(v, radius);
    return 1;
}

/* ---------------------------------------------------- a point and leaves -- */

static int test_point_leaf(void *self, const cylint_leaf *leaf, unsigned lanes,
                           const float least[CYLINT_LEAF_SIZE])
{
    point_visit *v = self;
    if (!v->tested.may_repeat) /* then most of these shapes are tested */
        prefetch_shapes(v->scene, leaf, lanes);
    while (lanes && !v->stopped) {
        const int lane = cylint_nearest_lane(lanes, least);
        if ((double)least[lane] > v->reach)
            break;
        lanes &= ~(1u << lane);
        test_lane(&v->tested, leaf, lane, test_point_at, v);
    }
    return v->stopped;
}

/* ------------------------------------------------------ visits of points -- */

/* Traverses the hierarchy or, where the frame cannot hold the point, tests every
 * shape in it. */
static void traverse_points(void *self)
{
    point_visit *v = self;
    const cylint_scene *s = v->scene;
    double x[3];
    if (s->n_bounded == 0 || v->stopped)
        return;
    for (int j = 0; j < 3; j++)
        x[j] = (v->point[j] - s->frame.view.center[j]) * s->frame.view.scale;
    if (cylint_largest(x) <= CYLINT_POINT_MOST) {
        s->traversal->point(&s->bvh, x, &v->reach, test_point_leaf, v);
        return;
    }
    test_each(v, &v->stopped, test_point_at, s->bounded, 0, s->n_bounded);
}

void cylint_visit_point(const cylint_scene *scene, const double point[3],
                        double radius, cylint_nearness nearness, int may_repeat,
                        cylint_use_found *callback, void *context)
{
    size_t n;
    const uint32_t *others =
        others_of(scene, nearness == CYLINT_HOLDING_EARLY, &n);
    point_visit v;
    if (!cylint_is_finite(point))
        return;
    v.scene = scene;
    v.point = point;
    v.nearness = nearness;
    v.callback = callback;
    v.context = context;
    begin_tests(&v.tested, may_repeat);
    set_point_radius(&v, radius);
    test_each(&v, &v.stopped, test_point_at, others, 0, n);
    traverse_points(&v);
    if (v.tested.has_left)
        test_left(&v.tested, &v, &v.stopped, test_point_at, traverse_points);
}
