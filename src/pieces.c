/*
 * pieces.c - the pieces of a line that are inside one shape, or one solid
 */
#include "cylint_pieces.h"

#include <limits.h>
#include <math.h>
#include <string.h>

#include "dispatch.h"
#include "intersect.h"
#include "numbers/double_double.h"
#include "numbers/exact.h"
#include "shapes/shape_facts.h"
#include "solid_sweep.h"

/* -------------------------------------------------------------- chords -- */

/* Writes the part of [t0, t1] in the domain.  Returns 1 if it is a chord, else
 * 0. */
static int add_chord(const cylint_line *line, double t0, double t1,
                     cylint_interval *to)
{
    to->t0 = cylint_less(t0, line->tmin) ? line->tmin : t0;
    to->t1 = cylint_less(line->tmax, t1) ? line->tmax : t1;
    return cylint_less(to->t0, to->t1);
}

/* The overlap of the whole line with a closed solid, in the domain of `line`. */
static int chord_of_answer(const cylint_answer *a, const cylint_line *line,
                           cylint_interval chord[2])
{
    const cylint_hit *hit = a->hit;
    const int is_in_both_nappes =
        a->n == 2 && hit[0].side == CYLINT_SIDE_LEAVING;
    if (a->relation < CYLINT_RELATION_ALONG)
        return 0;
    if (is_in_both_nappes && cylint_less(hit[0].t, hit[1].t)) {
        const int n = add_chord(line, -HUGE_VAL, hit[0].t, chord);
        return n + add_chord(line, hit[1].t, HUGE_VAL, chord + n);
    }
    /* through the apex, or past it between roots that round to one double */
    const int has_no_gap =
        is_in_both_nappes || (a->n == 1 && hit[0].side == CYLINT_SIDE_BOTH);
    double t0 = -HUGE_VAL, t1 = HUGE_VAL;
    for (int i = 0; i < a->n && !has_no_gap; i++)
        *(hit[i].side == CYLINT_SIDE_ENTERING ? &t0 : &t1) = hit[i].t;
    return add_chord(line, t0, t1, chord);
}

static cylint_line whole_of(const cylint_line *line)
{
    cylint_line whole = *line;
    whole.tmin = -HUGE_VAL;
    whole.tmax = HUGE_VAL;
    return whole;
}

int cylint_chord(const cylint_shape *shape, const cylint_line *line,
                 cylint_interval chord[2])
{
    const int ends = cylint_closed_ends(shape->ends);
    const cylint_line whole = whole_of(line);
    cylint_answer answer;
    cylint_shape closed;
    if (ends != shape->ends) {
        closed = *shape;
        closed.ends = ends;
        shape = &closed;
    }
    cylint_intersect(shape, &whole, CYLINT_WANT_T | CYLINT_WANT_PART, &answer);
    return chord_of_answer(&answer, line, chord);
}

/* -------------------------------------------------- chords of many shapes -- */

typedef struct {
    const cylint_line *line;
    cylint_interval *chord;
    signed char *count;
} record_chords;

/* A line that crosses a bounded solid has both ends of the overlap. */
static int keep_group(void *self, cylint_filter_batch *from,
                      const cylint_filter_group *g)
{
    const record_chords *to = self;
    const size_t first = (size_t)(g->number - from->list);
    EACH_BIT(lane, g->found) {
        const size_t i = first + (size_t)lane;
        to->count[i] =
            (signed char)(g->undecided >> lane & 1
                              ? CYLINT_UNDECIDED
                              : add_chord(to->line, g->t[0][lane],
                                          g->t[1][lane], &to->chord[i]));
    }
    return 0;
}

void cylint_chords_of_records(const cylint_record *records, int solid,
                              const uint32_t *number, size_t n,
                              const cylint_line *line, cylint_interval *chord,
                              signed char *count)
{
    const cylint_line whole = whole_of(line);
    record_chords to = {line, chord, count};
    cylint_filter_batch from;
    memset(count, 0, n);
    from.shapes = NULL;
    from.records = records;
    from.run = NULL;
    from.line = &whole;
    from.lines = NULL;
    from.solid = solid;
    from.n = from.lane = from.first = from.awaited = 0;
    from.want = CYLINT_WANT_T;
    from.relations = 0;
    from.nearest = HUGE_VAL;
    from.end = n;
    for (size_t i = 0; i < n; i++)
        from.list[i] = number[i];
    CYLINT_OF_LANES(n > CYLINT_LANES_AVX512 / 2, cylint_many)
    (&from, keep_group, &to);
}

/* -------------------------------------------------------------- solids -- */

/* Numbers the clauses of n members from 1 in the order in which they come.  Returns
 * how many there are, or -1 if one is 0 or has no opposite. */
static int number_clauses(const int *clause, size_t n, int32_t *number)
{
    int clauses = 0;
    for (size_t i = 0; i < n; i++) {
        size_t j = 0;
        if (clause[i] == 0 || clause[i] == INT_MIN)
            return -1;
        while (j < i && clause[j] != clause[i] && clause[j] != -clause[i])
            j++;
        number[i] = j < i ? number[j] : ++clauses;
    }
    return clauses;
}

typedef struct {
    cylint_interval *pieces;
    size_t n, capacity;
} solid_pieces;

/* Writes the members in an order in which the bounds come first, and returns how
 * many there are: the solid is within a member that is no complement and alone in
 * its clause. */
static size_t order_members(const int *clause, const int32_t *number, size_t n,
                            size_t *order)
{
    int members[CYLINT_SOLID_MEMBERS] = {0}; /* of each clause */
    size_t bounds = 0, others = n;
    for (size_t i = 0; i < n; i++)
        members[number[i] - 1]++;
    for (size_t i = 0; i < n; i++)
        order[clause[i] > 0 && members[number[i] - 1] == 1 ? bounds++
                                                           : --others] = i;
    return bounds;
}

static int add_solid_piece(void *self, double t0, double t1)
{
    solid_pieces *to = self;
    to->pieces[to->n++] = (cylint_interval){t0, t1};
    return to->n < to->capacity;
}

int cylint_solid_pieces(const cylint_shape *shapes, const int *clause, size_t n,
                        const cylint_line *line, cylint_interval *pieces,
                        size_t capacity)
{
    enum { EVENTS = 4 * CYLINT_SOLID_MEMBERS };
    int32_t number[CYLINT_SOLID_MEMBERS], holding[CYLINT_SOLID_MEMBERS] = {0};
    cylint_event event[EVENTS], spare[EVENTS];
    solid_pieces to = {pieces, 0, capacity};
    size_t order[CYLINT_SOLID_MEMBERS], events = 0, failing = 0;
    double after = line->tmin, before = line->tmax; /* no piece is elsewhere */
    const int clauses =
        n > CYLINT_SOLID_MEMBERS ? -1 : number_clauses(clause, n, number);
    if (clauses <= 0 || !line->valid || capacity == 0)
        return clauses < 0 ? -1 : 0;
    const size_t bounds = order_members(clause, number, n, order);
    for (size_t k = 0; k < n; k++) {
        const size_t i = order[k];
        const int is_complement = clause[i] < 0;
        cylint_interval chord[2];
        const int chords = cylint_chord(&shapes[i], line, chord);
        if (k < bounds && chords > 0) {
            const double t0 = chord[0].t0, t1 = chord[chords - 1].t1;
            after = cylint_less(after, t0) ? t0 : after;
            before = cylint_less(t1, before) ? t1 : before;
        }
        if (k < bounds && (chords == 0 || !cylint_less(after, before)))
            return 0;
        holding[number[i] - 1] += is_complement;
        for (int j = 0; j < chords; j++, events += 2)
            cylint_add_events(&event[events], chord[j], 0,
                              is_complement ? -number[i] : number[i]);
    }
    for (int i = 0; i < clauses; i++)
        failing += holding[i] == 0;
    cylint_sort_events(event, events, spare);
    cylint_sweep_solid(event, events, holding, failing, line->tmin, line->tmax,
                       add_solid_piece, &to);
    return (int)to.n;
}

/* -------------------------------------------------------------- length -- */

double cylint_line_length(const cylint_line *line)
{
    const double size = cylint_largest(line->d);
    cylint_arena arena;
    pair square = {0, 0};
    if (!line->valid)
        return 0;
    if (size > DBL_MAX) /* a segment */
        return HUGE_VAL;
    const int e = cylint_any_exponent(size);
    for (int i = 0; i < 3; i++) {
        const pair d = {cylint_scaled(line->d[i], -e),
                        cylint_scaled(line->d_lo[i], -e)};
        square = pair_add(square, pair_mul(d, d));
    }
    cylint_arena_open(&arena);
    return cylint_nearest_of_pair(&arena, pair_sqrt(square), e);
}
