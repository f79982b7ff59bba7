/*
 * refit.c - moves shapes of a scene
 */
#include <stdlib.h>

#include "scene.h"

/* The shapes that take the places of [first, first + n). */
typedef struct {
    cylint_scene *scene;
    size_t first, n;
    const cylint_shape *shapes;
    cylint_shapes_box box; /* of those in the hierarchy */
} replacement;

/* Returns 0 if a shape cannot take the place of another. */
static int measure_all(replacement *r)
{
    const cylint_scene *s = r->scene;
    for (size_t i = 0; i < r->n; i++) {
        const cylint_shape *shape = &r->shapes[i];
        if (!cylint_record_takes(&s->records, r->first + i, shape))
            return 0;
        if (shape->kind != CYLINT_KIND_NONE &&
            !cylint_is_other(s, r->first + i) &&
            !cylint_extend_by_shape(&r->box, shape))
            return 0;
    }
    return 1;
}

/* In the frame, the box of all pieces of shapes within a box.  A piece's box is
 * larger than the piece by less than 2^-20, the rounding of its floats. */
static void load_box_of_pieces(const cylint_frame *f, const double lo[3],
                               const double hi[3], double lower[3],
                               double upper[3])
{
    for (int j = 0; j < 3; j++) {
        lower[j] = (lo[j] - f->view.center[j]) * f->view.scale - 0x1p-20;
        upper[j] = (hi[j] - f->view.center[j]) * f->view.scale + 0x1p-20;
    }
}

/* Whether the box of the shapes lies in the frame and in the hierarchy's box. */
static int stays_in_frame(const replacement *r)
{
    const cylint_frame *f = &r->scene->frame;
    const cylint_extent *box = &r->scene->bvh.box;
    double lower[3], upper[3];
    int is = 1;
    load_box_of_pieces(f, r->box.lo, r->box.hi, lower, upper);
    for (int j = 0; j < 3; j++)
        is &= r->box.lo[j] >= f->lo[j] && r->box.hi[j] <= f->hi[j] &&
              lower[j] >= (double)box->lower[j] &&
              upper[j] <= (double)box->upper[j];
    return is;
}

static double longest_side(const double lo[3], const double hi[3])
{
    return fmax(hi[0] - lo[0], fmax(hi[1] - lo[1], hi[2] - lo[2]));
}

/* Makes a frame of a box, with room for shapes that move on, within the range of
 * frames. */
static int make_frame(const cylint_scene *s, double lo[3], double hi[3],
                      cylint_frame *frame)
{
    const double room = fmax(longest_side(lo, hi) / 16, CYLINT_FRAME_LEAST);
    for (int j = 0; j < 3; j++) {
        lo[j] = fmax(lo[j] - room, -CYLINT_BOX_MOST);
        hi[j] = fmin(hi[j] + room, CYLINT_BOX_MOST);
    }
    cylint_frame_round_box(lo, hi);
    *frame = s->frame; /* for the shapes of its view */
    return cylint_frame_make(frame, lo, hi);
}

/* Makes a frame of the shapes that move, and of the old frame if other shapes
 * stay. */
static int grow_frame(const replacement *r, cylint_frame *frame)
{
    const cylint_frame *old = &r->scene->frame;
    const int all = r->box.n == r->scene->n_bounded;
    double lo[3], hi[3];
    for (int j = 0; j < 3; j++) {
        lo[j] = all ? r->box.lo[j] : fmin(r->box.lo[j], old->lo[j]);
        hi[j] = all ? r->box.hi[j] : fmax(r->box.hi[j], old->hi[j]);
    }
    return make_frame(r->scene, lo, hi, frame);
}

/* Makes a frame of the hierarchy's box if that is much smaller than the frame, as
 * after shapes came back from far away.  Returns 0 if it is not.  The rounding
 * errors of a corner are less than 2^-50 of its parts. */
static int shrink_frame(const cylint_scene *s, cylint_frame *frame)
{
    const cylint_frame *old = &s->frame;
    const cylint_extent box = cylint_bvh_bounds(&s->bvh);
    const double longest = longest_side(old->lo, old->hi);
    double lo[3], hi[3];
    for (int j = 0; j < 3; j++) {
        const double center = old->view.center[j],
                     lower = (double)box.lower[j] / old->view.scale,
                     upper = (double)box.upper[j] / old->view.scale;
        const double error =
            0x1p-50 * (fabs(center) + fmax(fabs(lower), fabs(upper)));
        lo[j] = center + lower - error;
        hi[j] = center + upper + error;
    }
    return longest_side(lo, hi) < longest / 4 && make_frame(s, lo, hi, frame) &&
           longest_side(frame->lo, frame->hi) < longest / 2;
}

/* Sets the frame, and the hierarchy's box to that of all pieces that fit in it. */
static void set_frame(cylint_scene *s, const cylint_frame *frame)
{
    double lo[3], hi[3];
    s->frame = *frame;
    load_box_of_pieces(frame, frame->lo, frame->hi, lo, hi);
    const cylint_extent box = cylint_float_box(lo, hi);
    cylint_bvh_set_box(&s->bvh, &box, CYLINT_FRAME_ERROR);
}

static void replace_records(const replacement *r)
{
    for (size_t i = 0; i < r->n; i++)
        cylint_record_replace(&r->scene->records, r->first + i, &r->shapes[i]);
}

/* Bounds the shapes that moved, or all in a new frame. */
static cylint_scene_status refit_hierarchy(replacement *r)
{
    cylint_scene *s = r->scene;
    cylint_frame frame;
    const int reframes = !stays_in_frame(r);
    if (reframes && !grow_frame(r, &frame))
        return CYLINT_SCENE_EREPLACE;
    cylint_extent *extents =
        malloc((s->bvh.n_leaves + s->bvh.n_nodes) * sizeof *extents);
    if (!extents)
        return CYLINT_SCENE_EMEMORY;
    if (s->built_cost == 0)
        s->built_cost = cylint_bvh_cost(&s->bvh);
    if (reframes)
        set_frame(s, &frame);
    replace_records(r);
    cylint_bvh_refit(&s->bvh, &s->frame.view, reframes ? 0 : (uint32_t)r->first,
                     reframes ? UINT32_MAX : (uint32_t)r->n, extents);
    while (shrink_frame(s, &frame)) { /* boxes in a large frame are coarse */
        set_frame(s, &frame);
        cylint_bvh_refit(&s->bvh, &s->frame.view, 0, UINT32_MAX, extents);
    }
    free(extents);
    return CYLINT_SCENE_OK;
}

cylint_scene_status cylint_scene_refit(cylint_scene *scene, size_t first,
                                       size_t n, const cylint_shape *shapes)
{
    replacement r = {.scene = scene,
                     .first = first,
                     .n = n,
                     .shapes = shapes,
                     .box = CYLINT_NO_BOX};
    if (!scene->is_finished)
        return CYLINT_SCENE_EUNFINISHED;
    if (scene->file.data)
        return CYLINT_SCENE_EOPENED;
    if (first > scene->n || n > scene->n - first)
        return CYLINT_SCENE_ESIZE;
    if (!measure_all(&r))
        return CYLINT_SCENE_EREPLACE;
    if (r.box.n > 0) {
        const cylint_scene_status status = refit_hierarchy(&r);
        if (status != CYLINT_SCENE_OK)
            return status;
    } else {
        replace_records(&r);
    }
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
