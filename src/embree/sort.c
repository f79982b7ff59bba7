/*
 * sort.c - boxes into an order in which each 8 lie together
 *
 * The surface area heuristic over bins [Wald 2007], with costs counted in
 * whole blocks.  Embree's own rtcBuildBVH fills leaves of 8 by 4.4 on average
 * and takes twice the time.
 */
#include "sort.h"

#include <float.h>

#include "lanes.h"

/* Of more than MANY boxes only the widest axis is looked at. */
enum { BINS = 16, MANY = 4096 };

typedef struct {
    v4 lower, upper;
} hull;

static hull nothing(void)
{
    return (hull){v4_set(FLT_MAX), v4_set(-FLT_MAX)};
}

static hull joined(hull a, hull b)
{
    return (hull){v4_min(a.lower, b.lower), v4_max(a.upper, b.upper)};
}

static hull hull_of(const cylint_box *b)
{
    /* the fourth is not a float; no one looks at it */
    return (hull){v4_load(b->lower), v4_load(b->upper)};
}

/* Half of it; 0 of nothing. */
static float area(hull h)
{
    float x[4];
    v4_store(x, v4_sub(h.upper, h.lower));
    return x[0] < 0 ? 0 : x[0] * x[1] + x[1] * x[2] + x[2] * x[0];
}

/* Twice the centre, twice the extent of all centres: how a range of boxes is
 * cut into bins. */
typedef struct {
    v4 least, per_bin;
} scale;

static v4 center_of(const cylint_box *b)
{
    const hull h = hull_of(b);
    return v4_add(v4_xyz(h.lower), v4_xyz(h.upper));
}

static scale scale_of(const cylint_box *boxes, size_t n)
{
    hull centers = nothing();
    float extent[4];
    for (size_t i = 0; i < n; i++) {
        const v4 c = center_of(&boxes[i]);
        centers = joined(centers, (hull){c, c});
    }
    v4_store(extent, v4_sub(centers.upper, centers.lower));
    for (int j = 0; j < 4; j++)
        extent[j] = extent[j] > FLT_MIN * BINS
                  ? BINS * (1 - 4 * FLT_EPSILON) / extent[j] : 0;
    return (scale){centers.lower, v4_load(extent)};
}

static int widest_axis(const scale *s)
{
    float x[4];
    v4_store(x, s->per_bin);
    int widest = 0;
    for (int j = 1; j < 3; j++)
        if (x[j] > 0 && (x[widest] <= 0 || x[j] < x[widest]))
            widest = j;
    return widest;
}

static void bins_of(const cylint_box *b, const scale *s, int32_t bin[4])
{
    v4_truncate(bin, v4_mul(v4_sub(center_of(b), s->least), s->per_bin));
}

typedef struct {
    hull box[3][BINS];
    size_t n[3][BINS];
} bins;

/* Axes from `first` to before `end`. */
static void fill(bins *b, const scale *s, int first, int end,
                 const cylint_box *boxes, size_t n)
{
    for (int j = first; j < end; j++)
        for (int i = 0; i < BINS; i++) {
            b->box[j][i] = nothing();
            b->n[j][i] = 0;
        }
    for (size_t i = 0; i < n; i++) {
        const hull h = hull_of(&boxes[i]);
        int32_t bin[4];
        bins_of(&boxes[i], s, bin);
        for (int j = first; j < end; j++) {
            b->box[j][bin[j]] = joined(b->box[j][bin[j]], h);
            b->n[j][bin[j]]++;
        }
    }
}

static float blocks(size_t n)
{
    return (float)((n + CYLINT_BLOCK - 1) / CYLINT_BLOCK);
}

/* Where to split: before bin `bin` along `axis`, n boxes to the left. */
typedef struct {
    float cost;
    int axis, bin;
    size_t n;
} split;

static void try_axis(const bins *b, int axis, size_t n, split *best)
{
    float right[BINS];
    hull h = nothing();
    for (int i = BINS - 1; i > 0; i--) {
        h = joined(h, b->box[axis][i]);
        right[i] = area(h);
    }
    h = nothing();
    size_t left = 0;
    for (int i = 1; i < BINS; i++) {
        h = joined(h, b->box[axis][i - 1]);
        left += b->n[axis][i - 1];
        if (left == 0 || left == n)
            continue;
        const float cost = area(h) * blocks(left) +
                           right[i] * blocks(n - left);
        if (cost < best->cost)
            *best = (split){cost, axis, i, left};
    }
}

static void swap(cylint_box *a, cylint_box *b)
{
    const cylint_box c = *a;
    *a = *b;
    *b = c;
}

static float key(const cylint_box *b, int axis)
{
    return b->lower[axis] + b->upper[axis];
}

/* So that none of the first k has a larger key than any of the rest. */
static void select(cylint_box *boxes, size_t n, size_t k, int axis)
{
    size_t from = 0, to = n; /* the k-th is in here */
    while (to - from > 1) {
        const float pivot = key(&boxes[from + (to - from - 1) / 2], axis);
        size_t i = from, j = to - 1;
        for (;;) {
            while (key(&boxes[i], axis) < pivot)
                i++;
            while (key(&boxes[j], axis) > pivot)
                j--;
            if (i >= j)
                break;
            swap(&boxes[i++], &boxes[j--]);
        }
        if (k <= j)
            to = j + 1;
        else
            from = j + 1;
    }
}

/* Those before the bin to the front; returns how many. */
static size_t partition(cylint_box *boxes, size_t n, const scale *s, int axis,
                        int bin)
{
    size_t left = 0, right = n;
    int32_t at[4];
    for (;;) {
        while (left < right && (bins_of(&boxes[left], s, at), at[axis] < bin))
            left++;
        while (left < right &&
               (bins_of(&boxes[right - 1], s, at), at[axis] >= bin))
            right--;
        if (left >= right)
            return left;
        swap(&boxes[left++], &boxes[--right]);
    }
}

/* The multiple of 8 next to `left` that leaves something on both sides. */
static size_t whole_blocks(size_t left, size_t n)
{
    const size_t most = (n - 1) / CYLINT_BLOCK * CYLINT_BLOCK;
    const size_t near = (left + CYLINT_BLOCK / 2) / CYLINT_BLOCK * CYLINT_BLOCK;
    return near < CYLINT_BLOCK ? CYLINT_BLOCK : near < most ? near : most;
}

/* Splits more than 8 boxes; returns how many are to the left, a multiple. */
static size_t divide(cylint_box *boxes, size_t n)
{
    const scale s = scale_of(boxes, n);
    split best = {FLT_MAX, -1, 0, 0};
    bins b;
    const int widest = widest_axis(&s);
    const int first = n > MANY ? widest : 0, end = n > MANY ? widest + 1 : 3;
    fill(&b, &s, first, end, boxes, n);
    for (int axis = first; axis < end; axis++)
        try_axis(&b, axis, n, &best);
    if (best.axis < 0) /* all in one place */
        return whole_blocks(n / 2, n);
    const size_t left = partition(boxes, n, &s, best.axis, best.bin);
    const size_t k = whole_blocks(left, n);
    if (k < left)
        select(boxes, left, k, best.axis);
    else if (k > left)
        select(boxes + left, n - left, k - left, best.axis);
    return k;
}

/* The smaller part by recursion, so that this is no deeper than log2(n). */
void cylint_sort_boxes(cylint_box *boxes, size_t n)
{
    while (n > CYLINT_BLOCK) {
        const size_t k = divide(boxes, n);
        if (k < n - k) {
            cylint_sort_boxes(boxes, k);
            boxes += k;
            n -= k;
        } else {
            cylint_sort_boxes(boxes + k, n - k);
            n = k;
        }
    }
}
