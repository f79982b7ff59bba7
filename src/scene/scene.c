/*
 * scene.c - makes a scene: its records, its frame and its hierarchy
 */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

#include "../numbers/bits.h"
#include "../bvh/threads.h"
#include "../shapes/shape_facts.h"
#include "scene.h"

const char *cylint_scene_strerror(int status)
{
    static const char *const texts[] = {
        [CYLINT_SCENE_OK] = "no error",
        [CYLINT_SCENE_EMEMORY] = "out of memory",
        [CYLINT_SCENE_ESIZE] = "no such shape or solid, or more than 2^28",
        [CYLINT_SCENE_ESTOPPED] = "stopped by a function of the caller",
        [CYLINT_SCENE_EFINISHED] = "the scene is finished already",
        [CYLINT_SCENE_EUNFINISHED] = "the scene is not finished",
        [CYLINT_SCENE_EFILE] = "the file cannot be read or written",
        [CYLINT_SCENE_EFORMAT] = "not a saved scene",
        [CYLINT_SCENE_EVERSION] =
            "the file is of another version or machine: make it again",
        [CYLINT_SCENE_EDAMAGED] = "the file is damaged",
        [CYLINT_SCENE_EOPENED] = "the shapes of an opened scene do not change",
        [CYLINT_SCENE_EREPLACE] =
            "a shape cannot take the place of the one before: make a new scene",
        [CYLINT_SCENE_ESOLID] = ("a member of a solid has no clause, or two "
                                 "solids have the same number")};
    return status >= 0 && status <= CYLINT_SCENE_ESOLID ? texts[status]
                                                        : "unknown status";
}

/* ------------------------------------------------------------- numbers -- */

size_t cylint_place_among(const uint32_t *numbers, size_t n, size_t number)
{
    size_t from = 0, to = n;
    while (from < to) {
        const size_t middle = from + (to - from) / 2;
        if (numbers[middle] < number)
            from = middle + 1;
        else
            to = middle;
    }
    return from;
}

int cylint_is_other(const cylint_scene *s, size_t number)
{
    const size_t at = cylint_place_among(s->others, s->n_others, number);
    return at < s->n_others && s->others[at] == number;
}

/* ------------------------------------------------------------ building -- */

static void *allocate(cylint_scene *s, size_t count, size_t size)
{
    s->own_bytes += count * size;
    return cylint_resized(NULL, count, size);
}

/* Makes the frame of the shapes that one can contain.  Returns 0 if there is
 * none. */
static int choose_frame(cylint_scene *s)
{
    if (s->box.n == 0)
        return 0;
    cylint_frame_round_box(s->box.lo, s->box.hi);
    return cylint_frame_make(&s->frame, s->box.lo, s->box.hi);
}

static const cylint_shape *data_at(const void *owner, uint32_t number,
                                   cylint_shape *shape)
{
    const cylint_scene *s = owner;
    cylint_record_data(&s->records, number, shape);
    return shape;
}

/* Lists the numbers of the shapes in the hierarchy, unless all are, and behind them
 * those of the others.  A refused shape is in neither list: no line hits it. */
static cylint_scene_status sort_shapes(cylint_scene *s, cylint_watch *watch)
{
    cylint_shapes_box inner;
    const cylint_view view = {.shape_at = data_at, .owner = s};
    const int all_near = cylint_choose_box(&inner, &view, s->n, &s->box);
    s->n_bounded = s->n;
    if (s->box.n == s->n && all_near && choose_frame(s))
        return CYLINT_SCENE_OK;
    uint32_t *const number = allocate(s, s->n, sizeof *number);
    s->bounded = number;
    s->n_bounded = 0;
    if (!number)
        return CYLINT_SCENE_EMEMORY;
    s->n_bounded =
        cylint_list_near(&view, s->n, &inner, watch, number, &s->box);
    if (s->n_bounded == SIZE_MAX)
        return CYLINT_SCENE_ESTOPPED;
    if (!choose_frame(s))
        s->n_bounded = 0;
    uint32_t *const others = number + s->n_bounded;
    s->others = others;
    for (size_t i = 0, next = 0; i < s->n; i++)
        if (next < s->n_bounded && number[next] == i)
            next++;
        else if (cylint_record_kind(&s->records, i) != CYLINT_KIND_NONE)
            others[s->n_others++] = (uint32_t)i;
    return CYLINT_SCENE_OK;
}

void cylint_scene_pack_others(cylint_scene *s)
{
    for (size_t i = 0; i < s->n_others; i++)
        cylint_record_shape(&s->records, s->others[i], &s->copies[i]);
    cylint_pack_shapes(&s->pack, s->pack_memory, s->copies, s->n_others);
}

int cylint_scene_complete(cylint_scene *s)
{
    s->traversal = cylint_traversal_used();
    s->frame.view.shape_at = data_at;
    s->frame.view.owner = s;
    s->copies = allocate(s, s->n_others, sizeof *s->copies);
    s->pack_memory = allocate(s, cylint_pack_bytes(s->n_others), 1);
    if (!s->copies || !s->pack_memory)
        return 0;
    cylint_scene_pack_others(s);
    return 1;
}

static cylint_scene_status build_hierarchy(cylint_scene *s, int threads,
                                           cylint_watch *watch)
{
    size_t refused; /* not used: all shapes are bounded */
    const cylint_bvh_input members = {.view = &s->frame.view,
                                      .numbers = s->bounded,
                                      .n = s->n_bounded,
                                      .threads = threads,
                                      .watch = watch};
    const cylint_bvh_status status =
        cylint_bvh_build(&s->bvh, &members, &refused);
    return status == CYLINT_BVH_OK         ? CYLINT_SCENE_OK
           : status == CYLINT_BVH_ESTOPPED ? CYLINT_SCENE_ESTOPPED
                                           : CYLINT_SCENE_EMEMORY;
}

static cylint_scene_status build(cylint_scene *s, int threads,
                                 cylint_watch *watch)
{
    s->own_bytes = sizeof *s;
    s->is_finished = 1;
    cylint_records_trim(&s->records);
    const cylint_scene_status status = sort_shapes(s, watch);
    if (status != CYLINT_SCENE_OK)
        return status;
    if (!cylint_scene_complete(s))
        return CYLINT_SCENE_EMEMORY;
    return build_hierarchy(s, threads, watch);
}

cylint_scene *cylint_scene_begin(size_t expected)
{
    cylint_scene *s = calloc(1, sizeof *s);
    if (s)
        s->box = (cylint_shapes_box)CYLINT_NO_BOX;
    if (s && (expected > CYLINT_SCENE_MOST_SHAPES ||
              cylint_records_reserve(&s->records, expected)))
        return s;
    cylint_scene_free(s);
    return NULL;
}

cylint_scene_status cylint_scene_add(cylint_scene *s,
                                     const cylint_shape *shapes, size_t n)
{
    if (s->is_finished)
        return CYLINT_SCENE_EFINISHED;
    if (n > CYLINT_SCENE_MOST_SHAPES - s->n)
        return CYLINT_SCENE_ESIZE;
    if (!cylint_records_add(&s->records, shapes, n))
        return CYLINT_SCENE_EMEMORY;
    s->n += n;
    for (size_t i = 0; i < n; i++)
        cylint_extend_by_shape(&s->box, &shapes[i]);
    return CYLINT_SCENE_OK;
}

cylint_scene_status cylint_scene_finish(cylint_scene *s, int threads,
                                        cylint_scene_progress *progress,
                                        void *context)
{
    cylint_watch watch = {.progress = progress,
                          .context = context,
                          .caller = cylint_thread_self(),
                          .mutex = CYLINT_MUTEX_INITIALIZER};
    const cylint_scene_status status =
        s->is_finished ? CYLINT_SCENE_EFINISHED
                       : build(s, threads, progress ? &watch : NULL);
    cylint_mutex_destroy(&watch.mutex);
    return status;
}

cylint_scene *cylint_scene_new_with_progress(const cylint_shape *shapes,
                                             size_t n, int threads,
                                             cylint_scene_progress *progress,
                                             void *context,
                                             cylint_scene_status *status)
{
    cylint_scene_status result = CYLINT_SCENE_EMEMORY;
    cylint_scene *s = cylint_scene_begin(n);
    if (s)
        result = cylint_scene_add(s, shapes, n);
    if (result == CYLINT_SCENE_OK)
        result = cylint_scene_finish(s, threads, progress, context);
    return cylint_scene_or_null(s, result, status);
}

cylint_scene *cylint_scene_new(const cylint_shape *shapes, size_t n,
                               int threads, cylint_scene_status *status)
{
    return cylint_scene_new_with_progress(shapes, n, threads, NULL, NULL,
                                          status);
}

cylint_scene *cylint_scene_or_null(cylint_scene *s, cylint_scene_status result,
                                   cylint_scene_status *status)
{
    if (status)
        *status = result;
    if (result == CYLINT_SCENE_OK)
        return s;
    cylint_scene_free(s);
    return NULL;
}

void cylint_scene_free(cylint_scene *scene)
{
    if (!scene)
        return;
    if (scene->file.data) {
        cylint_memory_free(&scene->file);
    } else {
        cylint_bvh_free(&scene->bvh);
        cylint_records_free(&scene->records);
        free((void *)(uintptr_t)scene->bounded);
    }
    free(scene->solids.memory);
    free(scene->given);
    free(scene->copies);
    free(scene->pack_memory);
    free(scene);
}

size_t cylint_scene_bytes(const cylint_scene *scene)
{
    return scene->own_bytes + scene->file.bytes +
           cylint_records_bytes(&scene->records) +
           scene->bvh.node_memory.bytes + scene->bvh.leaf_memory.bytes +
           scene->solids.bytes +
           (scene->given ? scene->solids.n_members * sizeof *scene->given : 0);
}

void cylint_scene_set_labels(cylint_scene *scene,
                             const cylint_scene_labels *labels)
{
    scene->labels = labels ? *labels : (cylint_scene_labels){NULL, NULL};
}

const cylint_scene_labels *cylint_scene_get_labels(const cylint_scene *scene)
{
    return scene->labels.end ? &scene->labels : NULL;
}

size_t cylint_scene_size(const cylint_scene *scene)
{
    return scene->n;
}

void cylint_scene_shape(const cylint_scene *scene, size_t number,
                        cylint_shape *shape)
{
    cylint_record_shape(&scene->records, number, shape);
}
