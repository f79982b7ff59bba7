/*
 * pieces.c - the pieces of a line that are inside the solids of a scene, where it
 * first enters or leaves one, and which solids contain a point
 *
 * Chords are collected, sorted by t0, and swept: at each end of a chord the set of
 * solids that contain the line changes.  As a chord is one record, an entry without
 * an exit is not possible.
 */
#include "../numbers/bits.h"

#include <math.h>
#include <string.h>

#include "../intersect.h"
#include "../shapes/shape_facts.h"
#include "../solid_sweep.h"
#include "visit.h"

/* A chord in a shape, or a piece in a solid. */
typedef struct {
    double t0, t1;
    uint32_t number;
} numbered_chord;

/* By t0, then by number. */
static int begins_before(const numbered_chord *x, const numbered_chord *y)
{
    const int64_t a = cylint_rank(x->t0), b = cylint_rank(y->t0);
    return a != b ? a < b : x->number < y->number;
}

#define SORTED numbered_chord
#define IS_BEFORE(x, y) begins_before(x, y)
#define SORT sort_chords
#include "../merge_sort_template.h"

#define SORTED double
#define IS_BEFORE(x, y) cylint_less(*(x), *(y))
#define SORT sort_ends
#include "../merge_sort_template.h"

/* ----------------------------------------------------------- collecting -- */

static const cylint_interval whole_domain = {0, 1};

/* The most pieces for which the line is searched in order. */
enum { FEW_PIECES = 4 };

/* All chords that begin at `complete` or before are collected: of a line or, where
 * it is NULL, of a point.  A shape that contains the point has the chord [0, 1] of
 * the domain [0, 1]. */
typedef struct {
    const cylint_scene *scene;
    const cylint_line *line;
    const double *point;
    numbered_chord *chord;
    size_t n, capacity; /* n counts those without room too */
    double complete;
    /* of a search for the first pieces, see keep_first_chord(): */
    int unites;
    double least_complete; /* `complete` is not reduced below this */
    cylint_interval first[2 * FEW_PIECES + 1];
    size_t n_first, most_first;
} collector;

static numbered_chord chord_of(const collector *c, const cylint_found *x)
{
    const cylint_interval of = c->line ? x->chord : whole_domain;
    return (numbered_chord){of.t0, of.t1, (uint32_t)x->number};
}

static double keep_chord(void *context, const cylint_found *found)
{
    collector *c = context;
    if (c->n < c->capacity)
        c->chord[c->n] = chord_of(c, found);
    c->n++;
    return HUGE_VAL;
}

/* Adds an interval to c->first, which are disjoint and ascend: joins it with those
 * that it meets, and keeps the first. */
static void add_interval(collector *c, cylint_interval x)
{
    size_t from = 0, to;
    while (from < c->n_first && cylint_less(c->first[from].t1, x.t0))
        from++;
    for (to = from; to < c->n_first && !cylint_less(x.t1, c->first[to].t0);
         to++) {
        if (cylint_less(c->first[to].t0, x.t0))
            x.t0 = c->first[to].t0;
        if (cylint_less(x.t1, c->first[to].t1))
            x.t1 = c->first[to].t1;
    }
    memmove(&c->first[from + 1], &c->first[to], (c->n_first - to) * sizeof x);
    c->first[from] = x;
    c->n_first += from + 1 - to;
    if (c->n_first > c->most_first)
        c->n_first = c->most_first;
}

/* Of a union c->first has the first pieces of the chords so far.  Else it has the
 * first places where chords begin or end: among 2 k of them are the ends of k cells
 * at least, because no gap follows another.  Later chords can join two pieces, and
 * so move the end of the last piece: the search is complete up to the least of
 * these ends. */
static double keep_first_chord(void *context, const cylint_found *found)
{
    collector *c = context;
    const cylint_interval x = found->chord;
    keep_chord(c, found);
    add_interval(c, c->unites ? x : (cylint_interval){x.t0, x.t0});
    if (!c->unites)
        add_interval(c, (cylint_interval){x.t1, x.t1});
    if (c->n_first == c->most_first) {
        const double limit =
            cylint_larger(c->first[c->n_first - 1].t1, c->least_complete);
        if (cylint_less(limit, c->complete))
            c->complete = limit;
    }
    return c->complete;
}

/* Sorts the chords and removes those that were found several times. */
static size_t sort_and_unite(numbered_chord *chord, size_t n,
                             numbered_chord *spare)
{
    size_t kept = 0;
    sort_chords(chord, n, spare);
    for (size_t i = 0; i < n; i++)
        if (kept == 0 || begins_before(&chord[kept - 1], &chord[i]))
            chord[kept++] = chord[i];
    return kept;
}

/* ----------------------------------------------------- chords of solids -- */

/* The chords of a late member; writes them. */
static int chords_of_late(const collector *c, const cylint_membership *member,
                          cylint_interval chord[2])
{
    cylint_shape shape;
    cylint_record_shape(&c->scene->records, member->shape, &shape);
    if (c->line)
        return cylint_chord(&shape, c->line, chord);
    chord[0] = whole_domain;
    return cylint_contains(&shape, c->point) >= 0;
}

/* Each chord of a member gives two events.  These are sorted by solid and t; a
 * sweep over those of a solid gives its chords. */
typedef struct {
    const collector *from; /* chords in shapes */
    cylint_event *event;
    size_t n_events;
    void *spare; /* memory for as many chords as there can be, or events */
    int32_t *holding;
    numbered_chord *chord;
    size_t n;
    uint32_t number; /* of the solid of a sweep */
    /* the shape of the last late member, which solids often share, and its
     * chords */
    uint32_t late;
    cylint_interval last[2];
    int n_last;
} assembly;

static int add_solid_chord(void *self, double t0, double t1)
{
    assembly *a = self;
    a->chord[a->n++] = (numbered_chord){t0, t1, a->number};
    return 1;
}

/* Adds the events of a chord for each member of its shape that is not late.  A
 * shape in no solid is its own. */
static void add_chord_of_shape(assembly *a, const numbered_chord *chord)
{
    const cylint_solids *s = &a->from->scene->solids;
    const uint32_t first = s->first_of_shape[chord->number];
    if (first == s->first_of_shape[chord->number + 1])
        a->chord[a->n++] = *chord;
    for (uint32_t i = first; cylint_is_early_member(s, chord->number, i);
         i++, a->n_events += 2)
        cylint_add_events(a->event + a->n_events,
                          (cylint_interval){chord->t0, chord->t1},
                          s->of_shapes[i].solid, s->of_shapes[i].clause);
}

static void add_late_member(assembly *a, const cylint_membership *member)
{
    if (a->late != member->shape) {
        a->late = member->shape;
        a->n_last = chords_of_late(a->from, member, a->last);
    }
    for (int i = 0; i < a->n_last; i++, a->n_events += 2)
        cylint_add_events(a->event + a->n_events, a->last[i], member->solid,
                          member->clause);
}

/* Adds the events of late members, of the solids that have events. */
static void add_late_members(assembly *a)
{
    const cylint_solids *s = &a->from->scene->solids;
    const size_t n = a->n_events;
    for (size_t i = 0; i < n; i++) {
        const cylint_scene_solid *solid = &s->solid[a->event[i].solid];
        if (i > 0 && a->event[i].solid == a->event[i - 1].solid)
            continue;
        for (uint32_t j = 0; j < solid->n_late; j++)
            add_late_member(a, &s->late[solid->first_late + j]);
    }
    if (a->n_events > n)
        cylint_sort_events(a->event, a->n_events, a->spare);
}

/* Adds the chords of a solid, which has n events. */
static void sweep_events(assembly *a, uint32_t solid, const cylint_event *event,
                         size_t n)
{
    const cylint_solids *s = &a->from->scene->solids;
    const cylint_scene_solid *of = &s->solid[solid];
    const cylint_line *line = a->from->line;
    for (size_t i = 0; i < n; i++) {
        const int32_t c = event[i].clause;
        const size_t clause = (size_t)(c < 0 ? -c : c) - 1;
        a->holding[clause] = s->complements[of->first_clause + clause];
    }
    a->number = of->number;
    cylint_sweep_solid(event, n, a->holding, of->failing,
                       line ? line->tmin : whole_domain.t0,
                       line ? line->tmax : whole_domain.t1, add_solid_chord, a);
}

/* Adds the chords of all solids that have events. */
static void sweep_solids(assembly *a)
{
    for (size_t i = 0, n; i < a->n_events; i += n) {
        const uint32_t solid = a->event[i].solid;
        for (n = 1; i + n < a->n_events && a->event[i + n].solid == solid;)
            n++;
        sweep_events(a, solid, a->event + i, n);
    }
}

/* Writes upper bounds of the numbers of events and of chords in solids. */
static void count_events(const collector *c, size_t *events, size_t *chords)
{
    const cylint_solids *s = &c->scene->solids;
    size_t late = 0;
    *events = s->n_outside;
    *chords = 0;
    for (size_t i = 0; i < c->n; i++) {
        const uint32_t shape = c->chord[i].number,
                       first = s->first_of_shape[shape];
        *chords += first == s->first_of_shape[shape + 1];
        for (uint32_t j = first; cylint_is_early_member(s, shape, j); j++) {
            *events += 2;
            late += s->solid[s->of_shapes[j].solid].n_late;
        }
    }
    *events += 4 * (late < s->n_late ? late : s->n_late);
    *chords += *events;
}

/* Makes the chords in solids from those in shapes (c->chord, sorted, without
 * duplicates, at the start of the workspace).  Returns their number, or
 * CYLINT_NO_ROOM.  They follow those in shapes, in no order; *spare: as much memory
 * as they take.  A scene without solids has the chords of its shapes, and *spare
 * stays. */
static size_t chords_of_solids(const collector *c, cylint_workspace *work,
                               numbered_chord **of_solids,
                               numbered_chord **spare)
{
    const cylint_solids *s = &c->scene->solids;
    const size_t used = c->n * sizeof *c->chord;
    cylint_room room = {(char *)(c->chord + c->n), work->bytes - used, used};
    assembly a = {.from = c, .late = UINT32_MAX};
    size_t events, chords;
    *of_solids = c->chord;
    if (s->n == 0)
        return c->n;
    count_events(c, &events, &chords);
    a.event = cylint_take_room(&room, events, sizeof *a.event);
    a.holding = cylint_take_room(&room, s->most_clauses, sizeof *a.holding);
    *of_solids = a.chord = cylint_take_room(&room, chords, sizeof *a.chord);
    *spare = a.spare = cylint_take_room(&room, chords, sizeof **spare);
    work->wanted = room.wanted;
    if (!a.event || !a.holding || !a.chord || !*spare)
        return CYLINT_NO_ROOM;
    for (size_t i = 0; i < s->n_outside; i++) /* which no sweep reaches */
        a.event[a.n_events++] = (cylint_event){HUGE_VAL, s->outside[i], 1};
    for (size_t i = 0; i < c->n; i++)
        add_chord_of_shape(&a, &c->chord[i]);
    cylint_sort_events(a.event, a.n_events, a.spare);
    add_late_members(&a);
    sweep_solids(&a);
    return a.n;
}

/* ------------------------------------------------------------ sweeping -- */

/* Whether solid x owns a place that y contains too: it has the lesser rank, or the
 * same rank and the lower number. */
static int outranks(const int *rank, size_t x, size_t y)
{
    return rank && rank[x] != rank[y] ? rank[x] < rank[y] : x < y;
}

typedef struct {
    const cylint_piece_rule *rule;
    const numbered_chord *chord; /* sorted */
    size_t n;
    double complete; /* pieces that end later are not certain */
    double *end;     /* of all chords, sorted */
    uint32_t *heap;  /* chords that have begun; the owner is heap[0] */
    size_t open;     /* how many; some have ended */
    cylint_piece *pieces;
    size_t n_pieces, capacity;
} sweep;

/* Whether chord x owns a place that both contain. */
static int owns(const sweep *s, uint32_t x, uint32_t y)
{
    return outranks(s->rule->rank, s->chord[x].number, s->chord[y].number);
}

static void push_chord(sweep *s, uint32_t x)
{
    size_t i = s->open++;
    for (; i > 0 && owns(s, x, s->heap[(i - 1) / 2]); i = (i - 1) / 2)
        s->heap[i] = s->heap[(i - 1) / 2];
    s->heap[i] = x;
}

static void pop_chord(sweep *s)
{
    const uint32_t x = s->heap[--s->open];
    size_t i = 0, child;
    while ((child = 2 * i + 1) < s->open) {
        child +=
            child + 1 < s->open && owns(s, s->heap[child + 1], s->heap[child]);
        if (!owns(s, s->heap[child], x))
            break;
        s->heap[i] = s->heap[child];
        i = child;
    }
    s->heap[i] = x;
}

/* The owner at t. */
static uint32_t owner_at(sweep *s, double t)
{
    while (!cylint_less(t, s->chord[s->heap[0]].t1))
        pop_chord(s);
    return s->chord[s->heap[0]].number;
}

/* lint: there are pieces where the capacity is not 0 */
/* Adds the cell [t0, t1], or makes the last piece longer by it.  Returns 0 if no
 * more pieces are wanted. */
static int add_cell(sweep *s, double t0, double t1, size_t depth)
{
    const cylint_piece_mode mode = s->rule->mode;
    cylint_piece *last = s->n_pieces > 0 ? &s->pieces[s->n_pieces - 1] : NULL;
    const int follows = last && !cylint_less(last->t1, t0);
    const size_t owner =
        follows && mode == CYLINT_PIECES_UNION ? last->shape : owner_at(s, t0);
    if (follows && mode != CYLINT_PIECES_CELLS && owner == last->shape) {
        last->t1 = t1;
        last->depth = last->depth < depth ? depth : last->depth;
        return 1;
    }
    if (s->n_pieces == s->capacity)
        return 0;
    s->pieces[s->n_pieces++] = (cylint_piece){t0, t1, owner, depth};
    return 1;
}

static void sweep_chords(sweep *s)
{
    size_t begun = 0, ended = 0;
    double t = 0;
    for (;;) {
        if (begun == ended) {
            if (begun == s->n)
                return;
            t = s->chord[begun].t0;
            s->open = 0;
        }
        for (; begun < s->n && !cylint_less(t, s->chord[begun].t0); begun++)
            push_chord(s, (uint32_t)begun);
        double next = s->end[ended];
        if (begun < s->n && cylint_less(s->chord[begun].t0, next))
            next = s->chord[begun].t0;
        if (!add_cell(s, t, next, begun - ended))
            return;
        t = next;
        while (ended < begun && !cylint_less(t, s->end[ended]))
            ended++;
    }
}

/* Writes chords as pieces, after the one of the rule. */
static void list_chords(sweep *s)
{
    const cylint_piece *after = s->rule->after;
    for (size_t i = 0; i < s->n && s->n_pieces < s->capacity; i++) {
        const numbered_chord *x = &s->chord[i];
        if (after &&
            (cylint_less(x->t0, after->t0) ||
             (!cylint_less(after->t0, x->t0) && x->number <= after->shape)))
            continue;
        s->pieces[s->n_pieces++] = (cylint_piece){x->t0, x->t1, x->number, 1};
    }
}

/* Writes the pieces of sorted chords.  spare: as much memory as the chords. */
static size_t write_swept_pieces(sweep *s, void *spare)
{
    s->n_pieces = 0;
    if (s->rule->mode == CYLINT_PIECES_CHORDS) {
        list_chords(s);
        return s->n_pieces;
    }
    s->end = spare;
    s->heap = (uint32_t *)(void *)(s->end + 2 * s->n);
    for (size_t i = 0; i < s->n; i++)
        s->end[i] = s->chord[i].t1;
    sort_ends(s->end, s->n, s->end + s->n);
    sweep_chords(s);
    while (s->n_pieces > 0 &&
           cylint_less(s->complete, s->pieces[s->n_pieces - 1].t1))
        s->n_pieces--;
    return s->n_pieces;
}

/* -------------------------------------------------------------- lines -- */

/* Writes the pieces of the c->n chords.  The memory has room for 2 c->capacity
 * chords; the second half is spare. */
static size_t pieces_of_chords(collector *c, cylint_workspace *work, sweep *s)
{
    numbered_chord *spare = c->chord + c->capacity, *of_solids;
    s->complete = c->complete;
    c->n = sort_and_unite(c->chord, c->n, spare);
    s->n = chords_of_solids(c, work, &of_solids, &spare);
    if (s->n == CYLINT_NO_ROOM)
        return CYLINT_NO_ROOM;
    if (of_solids != c->chord)
        sort_chords(of_solids, s->n, spare);
    s->chord = of_solids;
    return write_swept_pieces(s, spare);
}

/* Collects all chords, or enough for some pieces. */
static void collect(collector *c, size_t pieces, double least_complete)
{
    const cylint_visit_options options = {.is_of_chords = 1,
                                          .in_no_order = pieces == 0};
    c->n = 0;
    c->complete = HUGE_VAL;
    c->n_first = 0;
    c->most_first = c->unites ? pieces : 2 * pieces;
    c->least_complete = least_complete;
    if (!cylint_visit_line(c->scene, c->line, &options, HUGE_VAL,
                           pieces > 0 ? keep_first_chord : keep_chord, c))
        c->complete = HUGE_VAL;
}

/* How many searches in order precede that for all chords, and how far each goes
 * beyond the one before. */
enum { SEARCHES = 8, FARTHER = 4 };

/* As cylint_scene_pieces().  Afterwards c->chord has the chords in shapes, and
 * s->chord those in solids: if there are s->capacity pieces, all that begin where
 * the last one ends, or before. */
static size_t find_pieces(collector *c, sweep *s, cylint_workspace *work)
{
    const int are_few =
        s->capacity <= FEW_PIECES && s->rule->mode != CYLINT_PIECES_CHORDS;
    double least_complete = -HUGE_VAL;
    c->unites = s->rule->mode == CYLINT_PIECES_UNION;
    c->chord = work->memory;
    c->capacity = work->bytes / (2 * sizeof *c->chord);
    if (!c->line->valid || s->capacity == 0)
        return 0;
    /* each search is complete up to a larger t, the last one up to tmax */
    for (int i = are_few ? SEARCHES : 0;; i--) {
        collect(c, i > 0 ? s->capacity : 0, least_complete);
        if (c->n > c->capacity || !work->memory) {
            work->wanted = (c->n + 1) * 2 * sizeof *c->chord;
            return CYLINT_NO_ROOM;
        }
        const size_t n = pieces_of_chords(c, work, s);
        const double begin = c->n > 0 ? c->chord[0].t0 : 0;
        if (i == 0 || n == s->capacity || n == CYLINT_NO_ROOM ||
            !cylint_less(c->complete, c->line->tmax))
            return n;
        least_complete = c->complete + FARTHER * (c->complete - begin);
    }
}

size_t cylint_scene_pieces(const cylint_scene *scene, const cylint_line *line,
                           const cylint_piece_rule *rule, cylint_piece *pieces,
                           size_t capacity, cylint_workspace *work)
{
    collector c = {.scene = scene, .line = line};
    sweep s = {.rule = rule, .pieces = pieces, .capacity = capacity};
    return find_pieces(&c, &s, work);
}

/* ------------------------------------------------------------ boundaries -- */

/* A search among the members of a solid on whose surface the line is at t. */
typedef struct {
    const collector *from;
    double t;
    int enters;     /* the line enters the solid */
    uint32_t solid; /* which of the scene's */
    size_t number;  /* of the shape with the lowest number so far */
} boundary_search;

/* Keeps the shape of a member of the solid if its chord begins or ends at q->t, so
 * that the line enters or leaves the solid there as wanted, and no kept number is
 * lower. */
static void consider_chord(boundary_search *q, size_t number, int32_t clause,
                           cylint_interval chord)
{
    const double t = q->enters == (clause > 0) ? chord.t0 : chord.t1;
    if (number < q->number && cylint_rank(t) == cylint_rank(q->t))
        q->number = number;
}

/* Finds the shape of the solid that has this number: the shape itself, or one of
 * its members. */
static void search_solid(boundary_search *q, size_t number)
{
    const cylint_solids *s = &q->from->scene->solids;
    if (s->n == 0 ||
        s->first_of_shape[number] == s->first_of_shape[number + 1]) {
        q->number = number;
        return;
    }
    const cylint_membership *m = s->of_shapes + s->first_of_shape[number];
    while (s->solid[m->solid].number != number)
        m++;
    q->solid = m->solid;
    const cylint_scene_solid *solid = &s->solid[m->solid];
    for (uint32_t i = 0; i < solid->n_late; i++) {
        const cylint_membership *late = &s->late[solid->first_late + i];
        cylint_interval chord[2];
        const int n = chords_of_late(q->from, late, chord);
        for (int k = 0; k < n; k++)
            consider_chord(q, late->shape, late->clause, chord[k]);
    }
    for (size_t i = 0; i < q->from->n; i++) {
        const numbered_chord *x = &q->from->chord[i];
        for (uint32_t j = s->first_of_shape[x->number];
             cylint_is_early_member(s, x->number, j); j++)
            if (s->of_shapes[j].solid == q->solid)
                consider_chord(q, x->number, s->of_shapes[j].clause,
                               (cylint_interval){x->t0, x->t1});
    }
}

/* Writes the wanted members of the hit at t.  It is the only one: a chord that
 * begins or ends at t has a length, and so has the gap between the chords of a
 * double cone.  Of a complement, normal and side are the opposite. */
static void describe_boundary(const boundary_search *q, unsigned want,
                              cylint_hit *hit)
{
    const int side = q->enters ? CYLINT_SIDE_ENTERING : CYLINT_SIDE_LEAVING;
    cylint_shape shape;
    cylint_answer answer;
    cylint_record_shape(&q->from->scene->records, q->number, &shape);
    shape.ends = cylint_closed_ends(shape.ends);
    cylint_intersect(&shape, q->from->line,
                     want | CYLINT_WANT_T | CYLINT_WANT_PART, &answer);
    for (int i = 0; i < answer.n; i++) {
        cylint_hit found = answer.hit[i];
        if (cylint_rank(found.t) != cylint_rank(q->t))
            continue;
        for (int j = 0;
             j < 3 && found.side != side && (want & CYLINT_WANT_NORMAL); j++)
            found.normal[j] = cylint_positive_zero(-found.normal[j]);
        found.side = side;
        cylint_copy_hit(hit, &found, want);
    }
}

/* The solid's chord begins or ends where the first piece of the union does: no
 * solid holds the place before, or behind. */
size_t cylint_scene_first_boundary(const cylint_scene *scene,
                                   const cylint_line *line, unsigned want,
                                   cylint_hit *hit, cylint_workspace *work)
{
    const cylint_piece_rule rule = {.mode = CYLINT_PIECES_UNION};
    cylint_piece piece;
    collector c = {.scene = scene, .line = line};
    sweep s = {.rule = &rule, .pieces = &piece, .capacity = 1};
    const size_t n = find_pieces(&c, &s, work);
    if (n == 0 || n == CYLINT_NO_ROOM)
        return n == 0 ? scene->n : n;
    boundary_search q = {.from = &c,
                         .enters = cylint_less(line->tmin, piece.t0),
                         .number = scene->n};
    q.t = q.enters ? piece.t0 : piece.t1;
    if (!cylint_less(q.t, line->tmax))
        return scene->n;
    size_t solid = scene->n;
    for (size_t i = 0; i < s.n; i++) {
        const numbered_chord *x = &s.chord[i];
        const double t = q.enters ? x->t0 : x->t1;
        if (cylint_rank(t) == cylint_rank(q.t) && x->number < solid)
            solid = x->number;
    }
    search_solid(&q, solid);
    describe_boundary(&q, want & CYLINT_WANT_ALL, hit);
    return q.number;
}

/* -------------------------------------------------------------- points -- */

size_t cylint_scene_depth(const cylint_scene *scene, const double point[3],
                          const int *rank, size_t *owner,
                          cylint_workspace *work)
{
    collector c = {.scene = scene,
                   .point = point,
                   .chord = work->memory,
                   .capacity = work->bytes / sizeof *c.chord};
    numbered_chord *chord, *spare;
    *owner = scene->n;
    if (!cylint_is_finite(point))
        return 0;
    cylint_visit_point(scene, point, 0, CYLINT_HOLDING_EARLY, 0, keep_chord,
                       &c);
    work->wanted = (c.n + 1) * sizeof *c.chord;
    if (c.n > c.capacity || !work->memory)
        return CYLINT_NO_ROOM;
    const size_t n = chords_of_solids(&c, work, &chord, &spare);
    for (size_t i = 0; n != CYLINT_NO_ROOM && i < n; i++)
        if (i == 0 || outranks(rank, chord[i].number, *owner))
            *owner = chord[i].number;
    return n;
}
