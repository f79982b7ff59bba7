/*
 * refit.c - moves shapes of a scene
 */
#include "scene.h"

/* The shapes that take the places of [first, first + n). */
typedef struct {
    cylint_scene *scene;
    size_t first, n;
    const cylint_shape *shapes;
    cylint_shapes_box box, before; /* of those in the hierarchy; as they were */
} replacement;

/* Returns 0 if a shape cannot take the place of another. */
static int measure_all(replacement *r)
{
    const cylint_scene *s = r->scene;
    cylint_shape old;
    for (size_t i = 0; i < r->n; i++) {
        const cylint_shape *shape = &r->shapes[i];
        if (!cylint_record_takes(&s->records, r->first + i, shape))
            return 0;
        if (shape->kind == CYLINT_KIND_NONE || cylint_is_other(s, r->first + i))
            continue;
        if (!cylint_extend_by_shape(&r->box, shape))
            return 0;
        cylint_record_data(&s->records, r->first + i, &old);
        cylint_extend_by_shape(&r->before, &old);
    }
    return 1;
}

/* In the frame, the box of all slices of shapes within a box.  A slice's box is
 * larger than the slice by less than 2^-20, the rounding of its floats. */
static cylint_extent box_of_slices(const cylint_frame *f, const double lo[3],
                                   const double hi[3])
{
    double lower[3], upper[3];
    for (int j = 0; j < 3; j++) {
        lower[j] = (lo[j] - f->view.center[j]) * f->view.scale - 0x1p-20;
        upper[j] = (hi[j] - f->view.center[j]) * f->view.scale + 0x1p-20;
    }
    return cylint_float_box(lower, upper);
}

/* Whether the box of the shapes lies in the frame and in the hierarchy's box. */
static int stays_in_frame(const replacement *r)
{
    const cylint_frame *f = &r->scene->frame;
    const cylint_extent *all = &r->scene->bvh.box,
                        box = box_of_slices(f, r->box.lo, r->box.hi);
    int is = 1;
    for (int j = 0; j < 3; j++)
        is &= r->box.lo[j] >= f->lo[j] && r->box.hi[j] <= f->hi[j] &&
              box.lower[j] >= all->lower[j] && box.upper[j] <= all->upper[j];
    return is;
}

static double longest_side(const double lo[3], const double hi[3])
{
    return fmax(hi[0] - lo[0], fmax(hi[1] - lo[1], hi[2] - lo[2]));
}

/* Makes the frame of the shapes in the hierarchy, within the range of frames, with
 * room for shapes that move on. */
static void make_frame(const cylint_scene *s, cylint_frame *frame)
{
    cylint_shapes_box all = CYLINT_NO_BOX;
    for (size_t i = 0; i < s->n_bounded; i++) {
        cylint_shape shape;
        cylint_record_data(&s->records, s->bounded ? s->bounded[i] : i, &shape);
        cylint_extend_by_shape(&all, &shape);
    }
    const double room =
        fmax(longest_side(all.lo, all.hi) / 16, CYLINT_FRAME_LEAST);
    for (int j = 0; j < 3; j++) {
        all.lo[j] = fmax(all.lo[j] - room, -CYLINT_BOX_MOST);
        all.hi[j] = fmin(all.hi[j] + room, CYLINT_BOX_MOST);
    }
    cylint_frame_round_box(all.lo, all.hi);
    *frame = s->frame; /* for the shapes of its view */
    cylint_frame_make(frame, all.lo, all.hi);
}

/* Makes the frame again if the hierarchy's box is much smaller than it, as after
 * shapes came back from far away: boxes in a large frame are coarse.  Returns 0 if
 * it need not be smaller. */
static int shrink_frame(const cylint_scene *s, const cylint_extent *box,
                        cylint_frame *frame)
{
    const double longest = longest_side(s->frame.lo, s->frame.hi);
    double side = 0;
    for (int j = 0; j < 3; j++)
        side = fmax(side, (double)box->upper[j] - (double)box->lower[j]);
    if (!(4 * side < longest * s->frame.view.scale))
        return 0;
    make_frame(s, frame);
    return longest_side(frame->lo, frame->hi) < longest / 2;
}

/* Bounds all shapes in another frame.  The hierarchy's box is that of all slices
 * that fit in it. */
static void refit_in_frame(cylint_scene *s, const cylint_frame *frame)
{
    const cylint_extent box = box_of_slices(frame, frame->lo, frame->hi);
    s->frame = *frame;
    cylint_bvh_set_box(&s->bvh, &box, CYLINT_FRAME_ERROR);
    cylint_bvh_refit(&s->bvh, &s->frame.view, 0, UINT32_MAX, NULL);
}

/* Bounds the shapes that moved, or all in a new frame. */
static void refit_hierarchy(const replacement *r)
{
    cylint_scene *s = r->scene;
    cylint_frame frame;
    if (s->built_cost == 0)
        s->built_cost = cylint_bvh_cost(&s->bvh);
    if (stays_in_frame(r)) {
        const cylint_extent before =
            box_of_slices(&s->frame, r->before.lo, r->before.hi);
        const cylint_extent box =
            cylint_bvh_refit(&s->bvh, &s->frame.view, (uint32_t)r->first,
                             (uint32_t)r->n, &before);
        if (!shrink_frame(s, &box, &frame))
            return;
    } else {
        make_frame(s, &frame);
    }
    refit_in_frame(s, &frame);
}

cylint_scene_status cylint_scene_refit(cylint_scene *scene, size_t first,
                                       size_t n, const cylint_shape *shapes)
{
    replacement r = {.scene = scene,
                     .first = first,
                     .n = n,
                     .shapes = shapes,
                     .box = CYLINT_NO_BOX,
                     .before = CYLINT_NO_BOX};
    if (!scene->is_finished)
        return CYLINT_SCENE_EUNFINISHED;
    if (scene->file.data)
        return CYLINT_SCENE_EOPENED;
    if (first > scene->n || n > scene->n - first)
        return CYLINT_SCENE_ESIZE;
    if (!measure_all(&r))
        return CYLINT_SCENE_EREPLACE;
    for (size_t i = 0; i < n; i++)
        cylint_record_replace(&scene->records, first + i, &shapes[i]);
    if (r.box.n > 0)
        refit_hierarchy(&r);
    if (r.box.n < n)
        cylint_scene_pack_others(scene);
    return CYLINT_SCENE_OK;
}

double cylint_scene_worsening(const cylint_scene *scene)
{
    return scene->built_cost > 0
               ? cylint_bvh_cost(&scene->bvh) / scene->built_cost
               : 1;
}
