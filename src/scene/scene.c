/*
 * scene.c - makes a scene: its records, its frame and its hierarchy
 */
#include <float.h>
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

/* ------------------------------------------------------------ building -- */

static void extend_box(cylint_shapes_box *box, const cylint_shapes_box *by)
{
    for (int j = 0; j < 3; j++) {
        box->lo[j] = fmin(box->lo[j], by->lo[j]);
        box->hi[j] = fmax(box->hi[j], by->hi[j]);
    }
    box->n += by->n;
}

/* Each number has at most 6 roundings and errors of its data.  A larger factor is
 * refused: squares of lengths may underflow later, and it would multiply what that
 * loses. */
int cylint_extend_by_shape(cylint_shapes_box *box, const cylint_shape *s)
{
    cylint_shapes_box own = {.n = 1};
    if (!cylint_is_bounded(s) ||
        (cylint_has_factors(s->kind) && cylint_r1(s) > CYLINT_FRAME_MOST))
        return 0;
    for (int j = 0; j < 3; j++) {
        const double bottom = cylint_rough_reach(s, 0, j),
                     top = cylint_rough_reach(s, 1, j);
        const double base = cylint_base(s)[j], end = base + cylint_axis(s)[j];
        const double margin =
            DBL_MIN +
            0x1p-50 * (fabs(base) + fabs(cylint_axis(s)[j]) + bottom + top);
        own.lo[j] = fmin(base - bottom, end - top) - margin;
        own.hi[j] = fmax(base + bottom, end + top) + margin;
        if (!(own.lo[j] >= -CYLINT_FRAME_MOST &&
              own.hi[j] <= CYLINT_FRAME_MOST))
            return 0;
    }
    if (box)
        extend_box(box, &own);
    return 1;
}

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

/* A few shapes that are far from all others, or much larger, are beside the
 * hierarchy: with them, its floats would not distinguish the others.  How many may
 * be, at most one of SAMPLES; a distance in sizes of the box of half of the
 * samples. */
enum { SAMPLES = 64, MOST_DISTANT = 16, DISTANT = 1 << 13 };

/* Sets the box of one shape.  Returns 0 if no frame can contain it. */
static int load_box(const cylint_scene *s, size_t number,
                    cylint_shapes_box *own)
{
    cylint_shape shape;
    *own = (cylint_shapes_box)CYLINT_NO_BOX;
    cylint_record_data(&s->records, number, &shape);
    return cylint_extend_by_shape(own, &shape);
}

#define SORTED double
#define IS_BEFORE(x, y) cylint_less(*(x), *(y))
#define SORT sort_samples
#include "../merge_sort_template.h"

/* Sets the box outside which shapes are distant. */
static void load_samples(const cylint_scene *s, cylint_shapes_box *inner)
{
    double lo[3][SAMPLES], hi[3][SAMPLES], spare[SAMPLES], longest = 0;
    size_t n = 0;
    for (size_t i = 0; i < SAMPLES; i++) {
        cylint_shapes_box own;
        if (!load_box(s, i * s->n / SAMPLES, &own))
            continue;
        for (int j = 0; j < 3; j++) {
            lo[j][n] = own.lo[j];
            hi[j][n] = own.hi[j];
        }
        n++;
    }
    for (int j = 0; j < 3 && n > 0; j++) {
        sort_samples(lo[j], n, spare);
        sort_samples(hi[j], n, spare);
        inner->lo[j] = lo[j][n / 4];
        inner->hi[j] = hi[j][n - 1 - n / 4];
        longest = fmax(longest, inner->hi[j] - inner->lo[j]);
    }
    for (int j = 0; j < 3; j++) {
        inner->lo[j] -= DISTANT * longest;
        inner->hi[j] += DISTANT * longest;
    }
}

static int lies_in(const cylint_shapes_box *box, const cylint_shapes_box *outer)
{
    int is = 1;
    for (int j = 0; j < 3; j++)
        is &= outer->lo[j] <= box->lo[j] && box->hi[j] <= outer->hi[j];
    return is;
}

/* Sets the box of the shapes that shall be in the hierarchy: of all but a few, or
 * all space. */
static void choose_box(const cylint_scene *s, cylint_shapes_box *inner)
{
    const cylint_shapes_box all = {
        {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL, HUGE_VAL}, 0};
    const size_t part = s->n / SAMPLES,
                 most = part < MOST_DISTANT ? part : MOST_DISTANT;
    size_t distant = 0;
    *inner = all;
    if (most == 0)
        return;
    load_samples(s, inner);
    if (lies_in(&s->box, inner))
        return;
    for (size_t i = 0; i < s->n && distant <= most; i++) {
        cylint_shapes_box own;
        distant += load_box(s, i, &own) && !lies_in(&own, inner);
    }
    if (distant > most)
        *inner = all;
}

/* Lists the numbers of the shapes in the hierarchy, unless all are, and behind them
 * those of the others.  A refused shape is in neither list: no line hits it. */
static cylint_scene_status sort_shapes(cylint_scene *s, cylint_watch *watch)
{
    cylint_shapes_box inner;
    const int has_frame = choose_frame(s);
    choose_box(s, &inner);
    s->n_bounded = s->n;
    if (has_frame && s->box.n == s->n && lies_in(&s->box, &inner))
        return CYLINT_SCENE_OK;
    uint32_t *const number = allocate(s, s->n, sizeof *number);
    s->bounded = number;
    if (!number)
        return CYLINT_SCENE_EMEMORY;
    s->n_bounded = 0;
    s->box = (cylint_shapes_box)CYLINT_NO_BOX;
    for (size_t i = 0; has_frame && i < s->n; i++) {
        cylint_shapes_box own;
        if (!cylint_watch_item(watch, i))
            return CYLINT_SCENE_ESTOPPED;
        if (load_box(s, i, &own) && lies_in(&own, &inner)) {
            extend_box(&s->box, &own);
            number[s->n_bounded++] = (uint32_t)i;
        }
    }
    if (has_frame)
        choose_frame(s);
    uint32_t *const others = number + s->n_bounded;
    s->others = others;
    for (size_t i = 0, next = 0; i < s->n; i++)
        if (next < s->n_bounded && number[next] == i)
            next++;
        else if (cylint_record_kind(&s->records, i) != CYLINT_KIND_NONE)
            others[s->n_others++] = (uint32_t)i;
    return CYLINT_SCENE_OK;
}

static const cylint_shape *data_at(const void *owner, uint32_t number,
                                   cylint_shape *shape)
{
    const cylint_scene *s = owner;
    cylint_record_data(&s->records, number, shape);
    return shape;
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
