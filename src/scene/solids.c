/*
 * solids.c - the solids of a scene that are made of shapes
 */
#include "scene.h"

#include <stdlib.h>
#include <string.h>

/* By solid, then by clause. */
static int is_before_in_solid(const cylint_membership *x,
                              const cylint_membership *y)
{
    return x->solid != y->solid ? x->solid < y->solid
                                : abs(x->clause) < abs(y->clause);
}

#define SORTED cylint_membership
#define IS_BEFORE(x, y) is_before_in_solid(x, y)
#define SORT sort_by_solid
#include "../merge_sort_template.h"

/* Divides the memory of the arrays.  Without memory, only counts its bytes. */
static void divide_memory(cylint_solids *s, const cylint_scene *scene)
{
    const size_t n = s->n_members;
    cylint_room room = {s->memory, s->bytes, 0};
    s->of_shapes = cylint_take_room(&room, n, sizeof *s->of_shapes);
    s->late = cylint_take_room(&room, n, sizeof *s->late); /* first all */
    s->complements = cylint_take_room(&room, n, sizeof *s->complements);
    s->first_of_shape =
        cylint_take_room(&room, scene->n + 1, sizeof *s->first_of_shape);
    s->solid = cylint_take_room(&room, s->n, sizeof *s->solid);
    s->always = cylint_take_room(&room, scene->n_others, sizeof *s->always);
    s->outside = cylint_take_room(&room, s->n, sizeof *s->outside);
    s->bytes = room.wanted;
}

/* Allocates the arrays, filled with 0. */
static int allocate_solids(cylint_solids *s, const cylint_scene *scene)
{
    divide_memory(s, scene);
    s->memory = calloc(1, s->bytes);
    divide_memory(s, scene);
    return s->memory != NULL;
}

static cylint_scene_status check_members(cylint_solids *s, size_t shapes)
{
    for (size_t i = 0; i < s->n_members; i++) {
        const cylint_membership *m = &s->given[i];
        if (m->clause == 0 || m->clause == INT32_MIN)
            return CYLINT_SCENE_ESOLID;
        if (m->shape >= shapes || m->solid >= s->n_members)
            return CYLINT_SCENE_ESIZE;
        if (m->solid >= s->n)
            s->n = (size_t)m->solid + 1;
    }
    return CYLINT_SCENE_OK;
}

/* If a shape has more members, a line that hits it would make events for all their
 * solids.  So these members are late where the solid has a clause of other bounded
 * shapes, which the line must hit first.  The number changes only the time. */
enum { FEW_MEMBERS = 16 };

/* Whether a shape has many members.  first_of_shape must still count them. */
static int is_shared(const cylint_solids *s, uint32_t shape)
{
    return s->first_of_shape[shape] > FEW_MEMBERS;
}

/* lint: memory for the clauses of all members was allocated */
/* Makes a solid of its n members, which are sorted by clause: numbers its clauses,
 * and counts the complements in each. */
static void make_solid(const cylint_solids *s, const cylint_scene *scene,
                       cylint_scene_solid *solid, cylint_membership *member,
                       size_t n, int32_t *complements)
{
    uint32_t least = UINT32_MAX, least_complement = UINT32_MAX;
    for (size_t i = 0; i < n; complements++) {
        const int32_t given = abs(member[i].clause),
                      clause = (int32_t)++solid->clauses;
        int is_bounded = 1, is_unshared = 1;
        for (; i < n && abs(member[i].clause) == given; i++) {
            const uint32_t shape = member[i].shape;
            const int is_complement = member[i].clause < 0;
            uint32_t *lowest = is_complement ? &least_complement : &least;
            *lowest = shape < *lowest ? shape : *lowest;
            *complements += is_complement;
            is_bounded &= !is_complement && !cylint_is_other(scene, shape);
            is_unshared &= !is_shared(s, shape);
            member[i].clause = is_complement ? -clause : clause;
        }
        solid->failing += *complements == 0;
        solid->is_bounded |= is_bounded;
        solid->has_unshared_clause |= is_bounded && is_unshared;
    }
    solid->number = least < UINT32_MAX ? least : least_complement;
}

static void make_each_solid(cylint_solids *s, const cylint_scene *scene)
{
    uint32_t clauses = 0;
    for (size_t i = 0; i < s->n_members; i++)
        s->first_of_shape[s->late[i].shape]++;
    for (size_t i = 0, n; i < s->n_members; i += n) {
        cylint_membership *const member = &s->late[i];
        cylint_scene_solid *solid = &s->solid[member->solid];
        for (n = 1; i + n < s->n_members && member[n].solid == member->solid;)
            n++;
        solid->first_clause = clauses;
        make_solid(s, scene, solid, member, n, s->complements + clauses);
        clauses += solid->clauses;
        if (solid->clauses > s->most_clauses)
            s->most_clauses = solid->clauses;
    }
}

/* Whether all solids have different numbers.  first_of_shape counts the members of
 * each shape, before and afterwards. */
static int have_own_numbers(cylint_solids *s)
{
    const uint32_t taken = (uint32_t)1 << 31;
    int are_own = 1;
    for (size_t i = 0; i < s->n; i++)
        if (s->solid[i].clauses > 0) {
            uint32_t *of_shape = &s->first_of_shape[s->solid[i].number];
            are_own &= !(*of_shape & taken);
            *of_shape |= taken;
        }
    for (size_t i = 0; i < s->n; i++)
        s->first_of_shape[s->solid[i].number] &= ~taken;
    return are_own;
}

static void mark_late(cylint_solids *s, const cylint_scene *scene)
{
    for (size_t i = 0; i < s->n_members; i++) {
        cylint_membership *m = &s->late[i];
        const cylint_scene_solid *solid = &s->solid[m->solid];
        if (cylint_is_other(scene, m->shape)
                ? solid->is_bounded
                : solid->has_unshared_clause && is_shared(s, m->shape))
            m->shape += CYLINT_LATE_MEMBER;
    }
}

/* Sorts the members by shape: sums up where those of each shape end, and stores
 * them from the last to the first, late ones first. */
static void list_by_shape(cylint_solids *s, size_t shapes)
{
    uint32_t *first = s->first_of_shape, end = 0;
    for (size_t shape = 0; shape <= shapes; shape++)
        first[shape] = end += first[shape];
    for (int round = 0; round < 2; round++) {
        const uint32_t late = round == 0 ? CYLINT_LATE_MEMBER : 0;
        for (size_t i = s->n_members; i-- > 0;)
            if ((s->late[i].shape & CYLINT_LATE_MEMBER) == late)
                s->of_shapes[--first[s->late[i].shape - late]] = s->late[i];
    }
}

/* Lists what all lines test: solids, and shapes beside the hierarchy that are
 * themselves solids or have a member that is not late. */
static void list_always(cylint_solids *s, const cylint_scene *scene)
{
    for (size_t i = 0; i < s->n; i++)
        if (s->solid[i].clauses > 0 && s->solid[i].failing == 0)
            s->outside[s->n_outside++] = (uint32_t)i;
    for (size_t i = 0; i < scene->n_others; i++) {
        const uint32_t shape = scene->others[i],
                       first = s->first_of_shape[shape];
        if (first == s->first_of_shape[shape + 1] ||
            cylint_is_early_member(s, shape, first))
            s->always[s->n_always++] = shape;
    }
}

/* Keeps the late members only. */
static void keep_late(cylint_solids *s)
{
    for (size_t i = 0; i < s->n_members; i++) {
        cylint_membership m = s->late[i];
        cylint_scene_solid *solid = &s->solid[m.solid];
        if (!(m.shape & CYLINT_LATE_MEMBER))
            continue;
        m.shape -= CYLINT_LATE_MEMBER;
        if (solid->n_late++ == 0)
            solid->first_late = (uint32_t)s->n_late;
        s->late[s->n_late++] = m;
    }
}

cylint_scene_status cylint_solids_make(cylint_solids *s,
                                       const cylint_scene *scene)
{
    const cylint_scene_status status = check_members(s, scene->n);
    if (status != CYLINT_SCENE_OK || s->n == 0)
        return status;
    if (!allocate_solids(s, scene))
        return CYLINT_SCENE_EMEMORY;
    memcpy(s->late, s->given, s->n_members * sizeof *s->late);
    sort_by_solid(s->late, s->n_members, s->of_shapes); /* not used yet */
    make_each_solid(s, scene);
    if (!have_own_numbers(s))
        return CYLINT_SCENE_ESOLID;
    mark_late(s, scene);
    list_by_shape(s, scene->n);
    list_always(s, scene);
    keep_late(s);
    return CYLINT_SCENE_OK;
}

/* ------------------------------------------------------ of the caller -- */

cylint_scene_status cylint_scene_set_solids(cylint_scene *scene,
                                            const cylint_member *members,
                                            size_t n)
{
    cylint_solids solids = {.n_members = n};
    if (!scene->is_finished)
        return CYLINT_SCENE_EUNFINISHED;
    if (n > CYLINT_SCENE_MOST_SHAPES)
        return CYLINT_SCENE_ESIZE;
    cylint_membership *given = malloc((n + 1) * sizeof *given);
    if (!given)
        return CYLINT_SCENE_EMEMORY;
    solids.given = given;
    for (size_t i = 0; i < n; i++)
        given[i] = (cylint_membership){
            members[i].shape < scene->n ? (uint32_t)members[i].shape
                                        : UINT32_MAX,
            members[i].solid < n ? (uint32_t)members[i].solid : UINT32_MAX,
            members[i].clause};
    const cylint_scene_status status = cylint_solids_make(&solids, scene);
    if (status != CYLINT_SCENE_OK) {
        free(solids.memory);
        free(given);
        return status;
    }
    free(scene->solids.memory);
    free(scene->given);
    scene->solids = solids;
    scene->given = given;
    return CYLINT_SCENE_OK;
}

size_t cylint_scene_members(const cylint_scene *scene)
{
    return scene->solids.n_members;
}

void cylint_scene_member(const cylint_scene *scene, size_t i,
                         cylint_member *member)
{
    const cylint_membership *from = &scene->solids.given[i];
    *member = (cylint_member){from->shape, from->solid, from->clause};
}
