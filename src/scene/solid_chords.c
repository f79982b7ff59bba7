/*
 * solid_chords.c - the chords in solids, made of those in shapes
 *
 * Each chord of a member gives two events.  These are sorted by solid and t; a
 * sweep over those of a solid gives its chords.
 */
#include "../numbers/bits.h"

#include "../solid_sweep.h"
#include "pieces.h"

typedef struct {
    const cylint_scene *scene;
    const cylint_domain *domain;
    cylint_event *event, *spare;
    size_t n_events;
    int32_t *holding;
    cylint_numbered_chord *chord;
    size_t n;
    uint32_t number; /* of the solid of a sweep */
} assembly;

static int add_solid_chord(void *self, double t0, double t1)
{
    assembly *a = self;
    a->chord[a->n++] = (cylint_numbered_chord){t0, t1, a->number};
    return 1;
}

/* Adds the events of a chord for each membership of its shape.  A shape in no solid
 * is its own. */
static void add_chord_of_shape(assembly *a, const cylint_numbered_chord *chord)
{
    const cylint_solids *s = &a->scene->solids;
    const uint32_t first = s->first_of_shape[chord->number],
                   end = s->first_of_shape[chord->number + 1];
    if (first == end)
        a->chord[a->n++] = *chord;
    for (uint32_t i = first; i < end; i++, a->n_events += 2)
        cylint_add_events(a->event + a->n_events,
                          (cylint_interval){chord->t0, chord->t1},
                          s->of_shapes[i].solid, s->of_shapes[i].clause);
}

static void add_late_member(assembly *a, const cylint_membership *member)
{
    cylint_shape shape;
    cylint_interval chord[2];
    cylint_record_shape(&a->scene->records, member->shape, &shape);
    const int n = a->domain->chords(a->domain->line, &shape, chord);
    for (int i = 0; i < n; i++, a->n_events += 2)
        cylint_add_events(a->event + a->n_events, chord[i], member->solid,
                          member->clause);
}

/* Adds the events of members beside the hierarchy, of the bounded solids that have
 * events. */
static void add_late_members(assembly *a)
{
    const cylint_solids *s = &a->scene->solids;
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
    const cylint_solids *s = &a->scene->solids;
    const cylint_scene_solid *of = &s->solid[solid];
    for (size_t i = 0; i < n; i++) {
        const int32_t c = event[i].clause;
        const size_t clause = (size_t)(c < 0 ? -c : c) - 1;
        a->holding[clause] = s->complements[of->first_clause + clause];
    }
    a->number = of->number;
    cylint_sweep_solid(event, n, a->holding, of->failing, a->domain->tmin,
                       a->domain->tmax, add_solid_chord, a);
}

/* In the order of solids: those with events, and those that contain all points
 * outside their shapes. */
static void sweep_solids(assembly *a)
{
    const cylint_solids *s = &a->scene->solids;
    size_t next = 0, n;
    for (size_t i = 0; i < a->n_events; i += n) {
        const uint32_t solid = a->event[i].solid;
        for (n = 1; i + n < a->n_events && a->event[i + n].solid == solid;)
            n++;
        for (; next < s->n_holding && s->holding[next] < solid; next++)
            sweep_events(a, s->holding[next], NULL, 0);
        next += next < s->n_holding && s->holding[next] == solid;
        sweep_events(a, solid, a->event + i, n);
    }
    for (; next < s->n_holding; next++)
        sweep_events(a, s->holding[next], NULL, 0);
}

/* Not less than the numbers of events and of chords. */
static void count_events(const cylint_scene *scene,
                         const cylint_numbered_chord *chord, size_t n,
                         size_t *events, size_t *chords)
{
    const cylint_solids *s = &scene->solids;
    *events = 0;
    *chords = s->n_holding;
    for (size_t i = 0; i < n; i++) {
        const uint32_t first = s->first_of_shape[chord[i].number],
                       end = s->first_of_shape[chord[i].number + 1];
        *chords += first == end;
        for (uint32_t j = first; j < end; j++)
            *events += 2 + 4 * (size_t)s->solid[s->of_shapes[j].solid].n_late;
    }
    *chords += *events;
}

size_t cylint_chords_of_solids(const cylint_scene *scene,
                               const cylint_domain *domain,
                               cylint_numbered_chord *of_shapes, size_t n,
                               cylint_workspace *work,
                               cylint_numbered_chord **of_solids,
                               cylint_numbered_chord **spare)
{
    const size_t used = n * sizeof *of_shapes;
    cylint_room room = {(char *)(of_shapes + n), work->bytes - used, used};
    assembly a = {.scene = scene, .domain = domain};
    size_t events, chords;
    *of_solids = of_shapes;
    if (scene->solids.n == 0)
        return n;
    count_events(scene, of_shapes, n, &events, &chords);
    a.event = cylint_take_room(&room, events, sizeof *a.event);
    a.spare = cylint_take_room(&room, events, sizeof *a.spare);
    a.holding =
        cylint_take_room(&room, scene->solids.most_clauses, sizeof *a.holding);
    *of_solids = a.chord = cylint_take_room(&room, chords, sizeof *a.chord);
    *spare = cylint_take_room(&room, chords, sizeof **spare);
    work->wanted = room.wanted;
    if (!a.event || !a.spare || !a.holding || !a.chord || !*spare)
        return CYLINT_NO_ROOM;
    for (size_t i = 0; i < n; i++)
        add_chord_of_shape(&a, &of_shapes[i]);
    cylint_sort_events(a.event, a.n_events, a.spare);
    add_late_members(&a);
    sweep_solids(&a);
    return a.n;
}
