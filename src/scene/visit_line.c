/*
 * visit_line.c - the shapes of a scene that a line hits
 *
 * A hierarchy over pieces of shapes (bvh.h) rejects shapes that the line
 * certainly does not hit, or hits beyond the last t that is wanted
 * (traverse.h).  Of the others local coordinates in doubles reject nearly all
 * that the line does not hit; cylint_intersect() tests the rest.
 */
#include <math.h>
#include <stddef.h>

#include "../numbers/bits.h"
#include "../intersect.h"
#include "../shapes/shape_facts.h"
#include "visit.h"
#include "visit_leaf.h"

/* The most lanes that wait while their shapes are loaded; fewer chords than these
 * take less time one by one. */
enum { LATER = CYLINT_MOST_RECORDS, FEW_CHORDS = 3 };

typedef struct {
    const cylint_scene *scene;
    cylint_line line;          /* its tmax decreases with `last` */
    const cylint_line *domain; /* of chords */
    cylint_frame_ray ray;      /* its length does too */
    double last;               /* the last t that is wanted */
    size_t except;
    unsigned want;
    int stopped;
    cylint_use_found *callback; /* NULL: a visit of chords */
    cylint_scene_chord *chord;
    void *context;
    cylint_tested_shapes tested;
    struct {
        const cylint_leaf *leaf;
        int lane;
    } later[LATER];
    int n_later;
} line_visit;

/* ---------------------------------------------------------- one shape --- */

/* Whether the line hits the shape: 0, 1, or CYLINT_UNDECIDED. */
static int is_hit_in_doubles(const line_visit *v, size_t number)
{
    const cylint_records *r = &v->scene->records;
    const cylint_record *at = &r->record[number];
    return r->tag[number] & CYLINT_TAG_PLAIN
               ? cylint_occluded_in_doubles(cylint_record_kind(r, number),
                                            cylint_record_ends(r, number),
                                            at->p0, at->r0, at->p1, at->r1,
                                            &v->line)
               : CYLINT_UNDECIDED;
}

/* Whether the line hits the shape; writes the wanted members. */
static int line_hits(const line_visit *v, size_t number, unsigned want,
                     cylint_hit *hit)
{
    cylint_shape shape;
    cylint_answer answer;
    const int is = is_hit_in_doubles(v, number);
    if (is == 0 || (is == 1 && want == 0))
        return is;
    cylint_record_shape(&v->scene->records, number, &shape);
    if (want == 0)
        return cylint_occluded(&shape, &v->line);
    if (!cylint_intersect(&shape, &v->line, want | CYLINT_WANT_NEAREST,
                          &answer))
        return 0;
    *hit = answer.hit[0];
    return 1;
}

/* Sets the last t that is wanted.  A root that rounds to t is less than the double
 * above t, so that this bounds the domain. */
static void shorten_line(line_visit *v, double t)
{
    v->stopped = t != t;
    if (v->stopped || !cylint_less(t, v->last))
        return;
    v->last = t;
    v->line.tmax = cylint_next_above(t);
}

/* lint: cylint_chord() wrote n chords */
/* Returns whether the shape has chords. */
static int visit_chords_at(line_visit *v, size_t number)
{
    cylint_shape shape;
    cylint_interval chord[2];
    cylint_record_shape(&v->scene->records, number, &shape);
    int n = cylint_chord(&shape, v->domain, chord);
    if (n == 2 && !cylint_less(chord[0].t1, chord[1].t0)) {
        chord[0].t1 = chord[1].t1; /* the gap is shorter than the roundings */
        n = 1;
    }
    for (int i = 0; i < n; i++)
        shorten_line(v, v->chord(v->context, number, chord[i]));
    return n > 0;
}

/* Returns whether the line hits the shape. */
static int test_line_at(void *self, size_t number)
{
    line_visit *v = self;
    cylint_hit hit;
    if (!v->callback)
        return visit_chords_at(v, number);
    if (number == v->except || !line_hits(v, number, v->want, &hit))
        return 0;
    const cylint_found found = {.number = number,
                                .at = v->want & CYLINT_WANT_T ? hit.t : 0,
                                .hit = v->want ? &hit : NULL};
    shorten_line(v, v->callback(v->context, &found));
    return 1;
}

/* ------------------------------------------------------------- leaves --- */

/* Whether the lane's piece contains the shape's first hit.  The traversal finds
 * that piece, and no other piece contains the hit. */
static int owns_first_hit(const void *self, const cylint_leaf *leaf, int lane)
{
    cylint_hit hit;
    return line_hits(self, leaf->number[lane], CYLINT_WANT_Z, &hit) &&
           cylint_leaf_owns(leaf, lane, hit.z);
}

static void test_line_lane(line_visit *v, const cylint_leaf *leaf, int lane)
{
    cylint_test_lane(&v->tested, leaf, lane, test_line_at, owns_first_hit, v);
}

static int test_line_leaf(void *self, const cylint_leaf *leaf, unsigned lanes,
                          const double least[CYLINT_LEAF_SIZE])
{
    line_visit *v = self;
    if (v->want == 0)
        cylint_prefetch_shapes(v->scene, leaf, lanes);
    while (lanes && !v->stopped) {
        const int lane =
            v->want ? cylint_first_lane(lanes, least) : cylint_lowest(lanes);
        const double last = v->last;
        if (least[lane] > v->ray.length)
            break;
        lanes &= ~(1u << lane);
        test_line_lane(v, leaf, lane);
        if (v->last < last)
            v->ray.length =
                fmin(v->ray.length, cylint_frame_reach(&v->ray, v->last));
    }
    return v->stopped;
}

/* lint: all n counts are written, and a chord where its count is 1 */
/* The chords of the shapes that wait and of which constructors made records of this
 * kind. */
static void visit_chords_of_kind(line_visit *v, int kind,
                                 const uint32_t *number, size_t n)
{
    cylint_interval chord[LATER];
    signed char count[LATER];
    if (n < FEW_CHORDS) {
        for (size_t i = 0; i < n; i++)
            visit_chords_at(v, number[i]);
        return;
    }
    cylint_chords_of_records(v->scene->records.record,
                             cylint_solid(kind, CYLINT_ENDS_CAPPED), number, n,
                             v->domain, chord, count);
    for (size_t i = 0; i < n; i++)
        if (count[i] > 0)
            v->chord(v->context, number[i], chord[i]);
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
        if (cylint_leaf_piece(leaf, lane).count > 1 &&
            cylint_was_tested(&v->tested, at))
            continue;
        const int kind = cylint_record_kind(r, at);
        if (r->tag[at] & CYLINT_TAG_PLAIN)
            number[kind][n[kind]++] = at;
        else
            visit_chords_at(v, at);
    }
    for (int kind = 0; kind < CYLINT_KINDS; kind++)
        visit_chords_of_kind(v, kind, number[kind], n[kind]);
}

static int test_later(line_visit *v)
{
    if (!v->callback)
        visit_later_chords(v);
    else
        for (int i = 0; i < v->n_later && !v->stopped; i++)
            test_line_lane(v, v->later[i].leaf, v->later[i].lane);
    v->n_later = 0;
    return v->stopped;
}

static int keep_line_leaf(void *self, const cylint_leaf *leaf, unsigned lanes,
                          const double least[CYLINT_LEAF_SIZE])
{
    line_visit *v = self;
    (void)least;
    cylint_prefetch_shapes(v->scene, leaf, lanes);
    for (; lanes; lanes &= lanes - 1) {
        v->later[v->n_later].leaf = leaf;
        v->later[v->n_later++].lane = cylint_lowest(lanes);
    }
    return v->n_later > LATER - CYLINT_LEAF_SIZE && test_later(v);
}

/* ------------------------------------------------------------- visits --- */

/* Traverses the hierarchy or, where the frame cannot hold the line, tests every
 * shape in it. */
static void traverse_lines(line_visit *v, int in_no_order)
{
    const cylint_scene *s = v->scene;
    if (s->n_bounded == 0 || v->stopped)
        return;
    switch (cylint_frame_line(&s->frame, &v->line, &v->ray)) {
    case CYLINT_FRAME_MISSED:
        return;
    case CYLINT_FRAME_ENTERED:
        if (in_no_order) {
            s->traversal->all(&s->bvh, v->ray.o, v->ray.d, &v->ray.length,
                              keep_line_leaf, v);
            test_later(v);
            return;
        }
        s->traversal->line(&s->bvh, v->ray.o, v->ray.d, &v->ray.length,
                           test_line_leaf, v);
        return;
    default:
        for (size_t i = 0; i < s->n_bounded && !v->stopped; i++)
            test_line_at(v, cylint_bounded_number(s, i));
    }
}

static void begin_visit(line_visit *v, const cylint_scene *scene,
                        const cylint_line *line, int often, void *context)
{
    v->scene = scene;
    v->line = *line;
    v->domain = line;
    v->last = line->tmax;
    v->stopped = v->n_later = 0;
    v->context = context;
    cylint_begin_tests(&v->tested, often);
}

void cylint_visit_line(const cylint_scene *scene, const cylint_line *line,
                       const cylint_visit_options *options, double last,
                       cylint_use_found *callback, void *context)
{
    line_visit v;
    begin_visit(&v, scene, line, options->often, context);
    v.except = options->except;
    v.want = options->want;
    v.callback = callback;
    shorten_line(&v, last);
    for (size_t i = options->first_other; i < scene->n_others && !v.stopped;
         i++)
        test_line_at(&v, scene->others[i]);
    traverse_lines(&v, options->in_no_order);
}

void cylint_visit_chords(const cylint_scene *scene, const cylint_line *line,
                         int in_order, cylint_scene_chord *callback,
                         void *context)
{
    const int has_solids = scene->solids.n > 0;
    const uint32_t *others = has_solids ? scene->solids.always : scene->others;
    const size_t n = has_solids ? scene->solids.n_always : scene->n_others;
    line_visit v;
    begin_visit(&v, scene, line, 1, context);
    v.want = CYLINT_WANT_T;
    v.callback = NULL;
    v.chord = callback;
    for (size_t i = 0; i < n; i++)
        visit_chords_at(&v, others[i]);
    traverse_lines(&v, !in_order);
}
