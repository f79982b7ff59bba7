/*
 * boundary.c - where a line first enters or leaves the solids of a scene
 */
#include "../numbers/bits.h"

#include <math.h>

#include "../intersect.h"
#include "../shapes/shape_facts.h"
#include "visit.h"

/* A search among the members of a solid on whose surface the line is at t. */
typedef struct {
    const cylint_scene *scene;
    const cylint_line *line;
    double t;
    int enters;     /* the line enters the solid */
    uint32_t solid; /* which of the scene's */
    size_t number;  /* of the shape with the lowest number so far */
    int is_complement;
} boundary_search;

/* Keeps the shape, of which a chord begins (is_entered) or ends at t, if t is q->t,
 * the line enters or leaves the solid there as wanted, and no kept number is
 * lower. */
static void consider_end(boundary_search *q, size_t number, double t,
                         int is_entered)
{
    const cylint_solids *s = &q->scene->solids;
    if (number >= q->number || cylint_less(t, q->t) || cylint_less(q->t, t))
        return;
    for (uint32_t i = s->first_of_shape[number];
         i < s->first_of_shape[number + 1]; i++) {
        const int is_complement = s->of_shapes[i].clause < 0;
        if (s->of_shapes[i].solid == q->solid &&
            (is_entered != is_complement) == q->enters) {
            q->number = number;
            q->is_complement = is_complement;
        }
    }
}

static double consider_chord(void *context, const cylint_found *x)
{
    boundary_search *q = context;
    consider_end(q, x->number, x->chord.t0, 1);
    consider_end(q, x->number, x->chord.t1, 0);
    return HUGE_VAL;
}

static void consider_late_member(boundary_search *q, uint32_t number)
{
    cylint_shape shape;
    cylint_interval chord[2];
    cylint_record_shape(&q->scene->records, number, &shape);
    const int n = cylint_chord(&shape, q->line, chord);
    for (int i = 0; i < n; i++)
        consider_chord(q, &(cylint_found){.number = number, .chord = chord[i]});
}

/* Finds the shape of the solid that has this number: the shape itself, or one of
 * its members.  A chord that begins or ends at t does so on `part`, too. */
static void search_solid(boundary_search *q, size_t number,
                         const cylint_line *part)
{
    const cylint_solids *s = &q->scene->solids;
    const cylint_visit_options options = {.is_of_chords = 1, .in_no_order = 1};
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
    for (uint32_t i = 0; i < solid->n_late; i++)
        consider_late_member(q, s->late[solid->first_late + i].shape);
    cylint_visit_line(q->scene, part, &options, HUGE_VAL, consider_chord, q);
}

/* Writes the wanted members of the hit at t.  It is the only one: a chord that
 * begins or ends at t has a length, and so has the gap between the chords of a
 * double cone. */
static void describe_boundary(const boundary_search *q, unsigned want,
                              cylint_hit *hit)
{
    cylint_shape shape;
    cylint_answer answer;
    cylint_record_shape(&q->scene->records, q->number, &shape);
    shape.ends = cylint_closed_ends(shape.ends);
    cylint_intersect(&shape, q->line, want | CYLINT_WANT_T | CYLINT_WANT_PART,
                     &answer);
    for (int i = 0; i < answer.n; i++) {
        cylint_hit found = answer.hit[i];
        if (cylint_less(found.t, q->t) || cylint_less(q->t, found.t))
            continue;
        found.side = q->enters ? CYLINT_SIDE_ENTERING : CYLINT_SIDE_LEAVING;
        for (int j = 0;
             j < 3 && q->is_complement && (want & CYLINT_WANT_NORMAL); j++)
            found.normal[j] = cylint_positive_zero(-found.normal[j]);
        cylint_copy_hit(hit, &found, want);
    }
}

size_t cylint_scene_first_boundary(const cylint_scene *scene,
                                   const cylint_line *line, unsigned want,
                                   cylint_hit *hit, cylint_workspace *work)
{
    const cylint_piece_rule unions = {.mode = CYLINT_PIECES_UNION},
                            owners = {.mode = CYLINT_PIECES_OWNER};
    cylint_piece piece;
    size_t n = cylint_scene_pieces(scene, line, &unions, &piece, 1, work);
    if (n == 0 || n == CYLINT_NO_ROOM)
        return n == 0 ? scene->n : n;
    boundary_search q = {.scene = scene,
                         .line = line,
                         .enters = cylint_less(line->tmin, piece.t0),
                         .number = scene->n};
    q.t = q.enters ? piece.t0 : piece.t1;
    if (!cylint_less(q.t, line->tmax))
        return scene->n;
    cylint_line part = *line;
    part.tmin = cylint_next(q.t, 0);
    part.tmax = cylint_next(q.t, 1);
    if (!q.enters && cylint_scene_pieces(scene, &part, &owners, &piece, 1,
                                         work) == CYLINT_NO_ROOM)
        return CYLINT_NO_ROOM;
    search_solid(&q, piece.shape, &part);
    describe_boundary(&q, want & CYLINT_WANT_ALL, hit);
    return q.number;
}
