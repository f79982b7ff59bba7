/*
 * distant.c - finds the few shapes that are far from all others, or much larger
 */
#include "distant.h"

#include <float.h>
#include <math.h>

#include "../numbers/bits.h"
#include "../shapes/shape_facts.h"

/* Let B be the box of the middle half of the samples of each coordinate.  A shape
 * is distant if it extends more than DISTANT longest sides of B beyond B.  If there
 * are more than MOST_DISTANT such shapes, or more than one of SAMPLES, then the
 * hierarchy has all.  (Measured: to test one such shape takes a ray as long as a
 * hierarchy with a shape at 100 to 300 sides loses.  These numbers change only the
 * time.) */
enum { SAMPLES = 64, MOST_DISTANT = 16, DISTANT = 256 };

static void extend_box(cylint_shapes_box *box, const cylint_shapes_box *by)
{
    for (int j = 0; j < 3; j++) {
        box->lo[j] = cylint_smaller(box->lo[j], by->lo[j]);
        box->hi[j] = cylint_larger(box->hi[j], by->hi[j]);
    }
    box->n += by->n;
}

/* Each number has at most 6 roundings and errors of its data.  A larger factor is
 * refused: squares of lengths may underflow later, and it would multiply that
 * error. */
int cylint_extend_by_shape(cylint_shapes_box *box, const cylint_shape *s)
{
    cylint_shapes_box own = {.n = 1};
    if (!cylint_is_bounded(s) ||
        (cylint_has_factors(s->kind) && cylint_r1(s) > CYLINT_BOX_MOST))
        return 0;
    for (int j = 0; j < 3; j++) {
        const double bottom = cylint_rough_reach(s, 0, j),
                     top = cylint_rough_reach(s, 1, j);
        const double base = cylint_base(s)[j], end = base + cylint_axis(s)[j];
        const double margin =
            DBL_MIN +
            0x1p-50 * (fabs(base) + fabs(cylint_axis(s)[j]) + bottom + top);
        own.lo[j] = cylint_smaller(base - bottom, end - top) - margin;
        own.hi[j] = cylint_larger(base + bottom, end + top) + margin;
        if (!(own.lo[j] >= -CYLINT_BOX_MOST && own.hi[j] <= CYLINT_BOX_MOST))
            return 0;
    }
    extend_box(box, &own);
    return 1;
}

/* Sets the box of shape number i of a view.  Returns 0 if there is none. */
static int load_box(cylint_shapes_box *own, const cylint_view *view, size_t i)
{
    cylint_shape spare;
    *own = (cylint_shapes_box)CYLINT_NO_BOX;
    return cylint_extend_by_shape(
        own, view->shape_at(view->owner, (uint32_t)i, &spare));
}

#define SORTED double
#define IS_BEFORE(x, y) cylint_less(*(x), *(y))
#define SORT sort_samples
#include "../merge_sort_template.h"

/* Sets the box outside which shapes are distant, from samples of `of` shapes. */
static void set_inner_box(const cylint_view *view, size_t of,
                          cylint_shapes_box *inner)
{
    double lo[3][SAMPLES], hi[3][SAMPLES], spare[SAMPLES], longest = 0;
    size_t n = 0;
    for (size_t i = 0; i < SAMPLES; i++) {
        cylint_shapes_box own;
        if (!load_box(&own, view, i * of / SAMPLES))
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

int cylint_choose_box(cylint_shapes_box *inner, const cylint_view *view,
                      size_t n, const cylint_shapes_box *all)
{
    const cylint_shapes_box space = {
        {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, {HUGE_VAL, HUGE_VAL, HUGE_VAL}, 0};
    const size_t part = n / SAMPLES,
                 most = part < MOST_DISTANT ? part : MOST_DISTANT;
    size_t distant = 0;
    *inner = space;
    if (most == 0)
        return 1;
    set_inner_box(view, n, inner);
    if (lies_in(all, inner))
        return 1;
    for (size_t i = 0; i < n && distant <= most; i++) {
        cylint_shapes_box own;
        distant += load_box(&own, view, i) && !lies_in(&own, inner);
    }
    if (distant <= most)
        return 0;
    *inner = space;
    return 1;
}

size_t cylint_list_near(const cylint_view *view, size_t n,
                        const cylint_shapes_box *inner, cylint_watch *watch,
                        uint32_t *number, cylint_shapes_box *box)
{
    size_t near = 0;
    *box = (cylint_shapes_box)CYLINT_NO_BOX;
    for (size_t i = 0; i < n; i++) {
        cylint_shapes_box own;
        if (!cylint_watch_item(watch, i))
            return SIZE_MAX;
        if (load_box(&own, view, i) && lies_in(&own, inner)) {
            extend_box(box, &own);
            number[near++] = (uint32_t)i;
        }
    }
    return near;
}

cylint_bvh_status cylint_bvh_build_near(cylint_bvh *bvh,
                                        const cylint_bvh_input *input,
                                        uint32_t *number, size_t *refused,
                                        cylint_extent *all)
{
    const cylint_bvh_status status = cylint_bvh_build(bvh, input, refused);
    cylint_shapes_box inner, box = {.n = input->n};
    cylint_bvh_input near = *input;
    *all = bvh->box;
    for (int j = 0; j < 3; j++) {
        box.lo[j] = (double)all->lower[j];
        box.hi[j] = (double)all->upper[j];
    }
    if (status != CYLINT_BVH_OK ||
        cylint_choose_box(&inner, input->view, input->n, &box))
        return status;
    near.numbers = number;
    near.n = cylint_list_near(input->view, input->n, &inner, input->watch,
                              number, &box);
    if (near.n == SIZE_MAX) {
        cylint_bvh_free(bvh);
        return CYLINT_BVH_ESTOPPED;
    }
    if (input->n - near.n > MOST_DISTANT) /* some shapes have no box */
        return status;
    cylint_bvh_free(bvh);
    return cylint_bvh_build(bvh, &near, refused);
}
