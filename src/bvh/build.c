/*
 * build.c - builds the nodes of a bounding volume hierarchy over boxes
 *
 * The surface area heuristic over bins [Wald 2007]; costs count whole leaves.
 * Embree's rtcBuildBVH fills leaves of 8 with 4.4 boxes on average and takes
 * twice the time.
 */
#define CYLINT_FOUR_LANES
#include "build.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "float_bounds.h"
#include "float_simd.h"
#include "threads.h"

/* Of more than SAMPLES boxes only every second, third, ... box is put into the
 * bins.  The split is as good as with all boxes. */
enum { BINS = 16, SAMPLES = 2048 };

/* A box, in vectors of one or four lanes.  A fourth lane holds what follows in
 * memory, and is not used. */
typedef struct {
    vf lower[PARTS], upper[PARTS];
} bounds;

static inline bounds nothing(void)
{
    bounds h;
    EACH(k, PARTS) {
        h.lower[k] = f_set(FLT_MAX);
        h.upper[k] = f_set(-FLT_MAX);
    }
    return h;
}

static inline bounds joined(bounds a, bounds b)
{
    EACH(k, PARTS) {
        a.lower[k] = f_lower(a.lower[k], b.lower[k]);
        a.upper[k] = f_higher(a.upper[k], b.upper[k]);
    }
    return a;
}

static inline bounds bounds_of(const cylint_boxed_slice *b)
{
    bounds h;
    EACH(k, PARTS) {
        h.lower[k] = f_load(b->box.lower + k * WIDTH);
        h.upper[k] = f_load(b->box.upper + k * WIDTH);
    }
    return h;
}

static inline cylint_extent extent_of(bounds h)
{
    float lower[4], upper[4];
    EACH(k, PARTS) {
        f_store(lower + k * WIDTH, h.lower[k]);
        f_store(upper + k * WIDTH, h.upper[k]);
    }
    return (cylint_extent){{lower[0], lower[1], lower[2]},
                           {upper[0], upper[1], upper[2]}};
}

/* Half the area; infinite for no boxes. */
static inline float area(bounds h)
{
    const cylint_extent e = extent_of(h);
    const float x = e.upper[0] - e.lower[0], y = e.upper[1] - e.lower[1],
                z = e.upper[2] - e.lower[2];
    return x * y + y * z + z * x;
}

/* Consecutive boxes, the box of all of them, and the box of their centres times
 * two. */
typedef struct {
    cylint_boxed_slice *boxes;
    size_t n;
    bounds box, centers;
} range;

/* The box's centre times two. */
static inline bounds center_of(bounds h)
{
    EACH(k, PARTS)
        h.lower[k] = h.upper[k] = h.lower[k] + h.upper[k];
    return h;
}

/* A coordinate of the box's centre, times two. */
static inline float key(const cylint_boxed_slice *b, int axis)
{
    return b->box.lower[axis] + b->box.upper[axis];
}

static range measured(cylint_boxed_slice *boxes, size_t n)
{
    range r = {boxes, n, nothing(), nothing()};
    for (size_t i = 0; i < n; i++) {
        const bounds h = bounds_of(&boxes[i]);
        r.box = joined(r.box, h);
        r.centers = joined(r.centers, center_of(h));
    }
    return r;
}

/* Maps a centre to its bin. */
typedef struct {
    float least[3], per_bin[3];
} scale;

static scale bin_scale(const range *r)
{
    const cylint_extent e = extent_of(r->centers);
    scale s;
    EACH(j, 3) {
        const float side = e.upper[j] - e.lower[j], bins = BINS;
        s.least[j] = e.lower[j];
        s.per_bin[j] =
            side > FLT_MIN * bins ? bins * (1 - 4 * FLT_EPSILON) / side : 0;
    }
    return s;
}

/* The place of the box's centre, in bins from the first one. */
static inline float bin_place(const cylint_boxed_slice *b, const scale *s,
                              int axis)
{
    return (key(b, axis) - s->least[axis]) * s->per_bin[axis];
}

typedef struct {
    bounds box[3][BINS];
    size_t n[3][BINS];
} bins;

/* Puts every `every`-th box into the bins.  Returns their number. */
static size_t fill(bins *b, const scale *s, const range *r, size_t every)
{
    size_t n = 0;
    for (int j = 0; j < 3; j++)
        for (int i = 0; i < BINS; i++) {
            b->box[j][i] = nothing();
            b->n[j][i] = 0;
        }
    for (size_t i = 0; i < r->n; i += every, n++) {
        const bounds h = bounds_of(&r->boxes[i]);
        EACH(j, 3) {
            const int bin = (int)bin_place(&r->boxes[i], s, j);
            b->box[j][bin] = joined(b->box[j][bin], h);
            b->n[j][bin]++;
        }
    }
    return n;
}

static float leaf_count(size_t n)
{
    return (float)(ptrdiff_t)cylint_leaves_for(n);
}

/* A place to split: before bin `bin` along `axis`. */
typedef struct {
    float cost;
    int axis, bin;
} cut_plan;

static void try_axis(const bins *b, int axis, size_t n, cut_plan *best)
{
    float right[BINS];
    bounds h = nothing();
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
        const float cost =
            area(h) * leaf_count(left) + right[i] * leaf_count(n - left);
        if (cost < best->cost)
            *best = (cut_plan){cost, axis, i};
    }
}

/*
 * Moves the boxes before the bin to the front and returns their number.  The
 * side of a box is unpredictable, so there is no branch: each box changes places
 * with the first box of the right side, which then begins one later if the box
 * belongs to the left side.
 */
static size_t partition(cylint_boxed_slice *boxes, size_t n, const scale *s,
                        int axis, int bin)
{
    size_t left = 0;
    for (size_t i = 0; i < n; i++) {
        const cylint_boxed_slice box = boxes[i];
        boxes[i] = boxes[left];
        boxes[left] = box;
        left += bin_place(&box, s, axis) < (float)bin;
    }
    return left;
}

/* The multiple of 8 nearest to `left` that leaves boxes on both sides. */
static size_t whole_leaves(size_t left, size_t n)
{
    const size_t most = (n - 1) / CYLINT_LEAF_SIZE * CYLINT_LEAF_SIZE;
    const size_t near =
        (left + CYLINT_LEAF_SIZE / 2) / CYLINT_LEAF_SIZE * CYLINT_LEAF_SIZE;
    return near < CYLINT_LEAF_SIZE ? CYLINT_LEAF_SIZE
           : near < most           ? near
                                   : most;
}

/* Fewer than 8 boxes move to the other side, so that the leaves of both sides are
 * full.  Each is the nearest to that side among NEARBY boxes. */
enum { NEARBY = 512 };

/* Moves boxes, so that k and not `left` are to the left. */
static void move_nearest(const range *r, size_t left, size_t k, int axis)
{
    while (left != k) {
        const int grows = left < k;
        const size_t all = grows ? r->n - left : left,
                     near = all < NEARBY ? all : NEARBY;
        cylint_boxed_slice *from = r->boxes + left - (grows ? 0 : near),
                           *best = from,
                           *to = &r->boxes[grows ? left++ : --left];
        for (size_t i = 1; i < near; i++)
            if ((key(&from[i], axis) < key(best, axis)) == grows)
                best = &from[i];
        const cylint_boxed_slice box = *to;
        *to = *best;
        *best = box;
    }
}

/* Splits more than 8 boxes.  Returns the number to the left, a multiple of 8. */
ASIDE size_t divide(const range *r)
{
    const size_t n = r->n;
    const scale s = bin_scale(r);
    cut_plan best = {FLT_MAX, -1, 0};
    bins b;
    const size_t filled = fill(&b, &s, r, n / SAMPLES + 1);
    for (int axis = 0; axis < 3; axis++)
        try_axis(&b, axis, filled, &best);
    if (best.axis < 0) /* all in one place */
        return whole_leaves(n / 2, n);
    const size_t left = partition(r->boxes, n, &s, best.axis, best.bin);
    const size_t k = whole_leaves(left, n);
    move_nearest(r, left, k, best.axis);
    return k;
}

/* ---------------------------------------------------------------- nodes -- */

/* A node to be built over a range. */
typedef struct {
    range all;
    size_t number;
    int depth;
} task;

/* A range of more than 1/MOST_TASKS of all boxes becomes a task.  Tasks share no
 * box, so at most MOST_TASKS wait at any time. */
enum { MOST_TASKS = 128 };

typedef struct {
    const cylint_boxed_slice *boxes; /* all of them */
    cylint_node *nodes;
    float least_step;
    const float *center;
    cylint_watch *watch;
    size_t task_size;
    const task *now;   /* tasks that threads share */
    cylint_mutex lock; /* protects the members below */
    task next[MOST_TASKS];
    size_t n_next;
} builder;

/* Among parts of `least` to `most` leaves, the one with the largest box or, if
 * `evenly`, with the most boxes; -1 if there is none. */
static int largest_part(const range *parts, int n, size_t least, size_t most,
                        int evenly)
{
    int best = -1;
    for (int i = 0; i < n; i++) {
        const size_t leaves = cylint_leaves_for(parts[i].n);
        if (leaves >= least && leaves <= most &&
            (best < 0 || (evenly ? parts[i].n > parts[best].n
                                 : area(parts[i].box) > area(parts[best].box))))
            best = i;
    }
    return best;
}

/* The part to split next, or -1.  A part of up to 8 leaves can become one node
 * above these.  It is split only if all its leaves can be children here: then that
 * node is not needed; a few leaves in each of several nodes make more nodes. */
static int part_to_split(const range *parts, int n, int evenly)
{
    const size_t room = CYLINT_CHILDREN - (size_t)n;
    const int large =
        largest_part(parts, n, CYLINT_CHILDREN + 1, SIZE_MAX, evenly);
    return large >= 0 ? large : largest_part(parts, n, 2, room + 1, evenly);
}

/* Splits until there are 8 parts or no part is to be split.  Returns their number,
 * or 0 if the build is to stop.  The parts are in the order of their boxes. */
static int split_up(const builder *b, range parts[CYLINT_CHILDREN], int evenly)
{
    int n = 1, i;
    while (n < CYLINT_CHILDREN && (i = part_to_split(parts, n, evenly)) >= 0) {
        const range all = parts[i];
        if (all.n >= CYLINT_WATCHED && !cylint_watch_add(b->watch, 0))
            return 0;
        const size_t k = evenly ? whole_leaves(all.n / 2, all.n) : divide(&all);
        memmove(parts + i + 1, parts + i, (size_t)(n++ - i) * sizeof *parts);
        parts[i] = measured(all.boxes, k);
        parts[i + 1] = measured(all.boxes + k, all.n - k);
    }
    return n;
}

/* The distances and the quotients have errors of at most 2^-52 of themselves. */
void cylint_node_place_child(cylint_node *node, int child,
                             const cylint_extent *box, const float center[3])
{
    for (int j = 0; j < 3; j++) {
        const double corner = (double)node->corner[j] + (double)center[j];
        const double from = (double)box->lower[j] - corner,
                     to = (double)box->upper[j] - corner, step = node->step[j];
        node->face[0][j][child] = (uint8_t)(from / step * (1 - 0x1p-50));
        node->face[1][j][child] = (uint8_t)ceil(to / step * (1 + 0x1p-50));
    }
}

void cylint_node_place(cylint_node *node, const cylint_extent *boxes, int n,
                       const float center[3], float least_step)
{
    cylint_extent all = cylint_extent_empty();
    for (int i = 0; i < n; i++)
        cylint_extent_include(&all, &boxes[i]);
    for (int j = 0; j < 3; j++) {
        const double c = center[j];
        const float corner = cylint_float_below((double)all.lower[j] - c);
        const double side = (double)all.upper[j] - ((double)corner + c);
        const float step = cylint_float_above(side * (1 + 0x1p-20) / 255);
        node->corner[j] = corner;
        node->step[j] = step > least_step ? step : least_step;
    }
    for (int i = 0; i < n; i++)
        cylint_node_place_child(node, i, &boxes[i], center);
}

/* From this depth on, ranges are split in the middle, in the order in which they
 * stand: that bounds the depth.  No scene of the tests is so deep. */
enum { EVEN_DEPTH = 24 };

/*
 * The most nodes above B leaves.  With it the index of a node is known before
 * the nodes beside it are built.  By induction there are at most (4 B - 1) / 7
 * nodes where B >= 2.  Let L children be leaves and I be nodes above B_i leaves.
 * If I = 0, there is 1 node.  If there are 8 children, there are at most
 *
 *   1 + sum (4 B_i - 1) / 7 = 1 + (4 (B - L) - (8 - L)) / 7 <= (4 B - 1) / 7.
 *
 * If there are fewer, no B_i is more than 8, so that there are 1 + I nodes, and
 * the leaves of none had room: B_i >= 10 - (L + I), which is 3 or more.  So this
 * holds, too: B >= 3 I, and if I = 1, then B >= 9.
 */
size_t cylint_build_most_nodes(size_t leaves)
{
    return leaves < 2 ? 1 : (4 * leaves - 1) / 7;
}

/* Builds the node and the nodes below it, except those it posts as tasks.  If the
 * build is to stop, some are missing. */
static void make_nodes(builder *b, const task *t)
{
    range parts[CYLINT_CHILDREN] = {t->all};
    cylint_node *node = &b->nodes[t->number];
    size_t number = t->number + 1;
    memset(node, 0, sizeof *node);
    const int n = split_up(b, parts, t->depth >= EVEN_DEPTH);
    if (n == 0)
        return;
    node->children = (uint8_t)((1u << n) - 1);
    cylint_extent boxes[CYLINT_CHILDREN];
    for (int i = 0; i < n; i++)
        boxes[i] = extent_of(parts[i].box);
    cylint_node_place(node, boxes, n, b->center, b->least_step);
    for (int i = 0; i < n; i++) {
        const range *part = &parts[i];
        if (part->n <= CYLINT_LEAF_SIZE) {
            const size_t box = (size_t)(part->boxes - b->boxes);
            node->child[i] =
                CYLINT_LEAF_FLAG | (uint32_t)(box / CYLINT_LEAF_SIZE);
            node->leaves = (uint8_t)(node->leaves | 1u << i);
            continue;
        }
        const task child = {*part, number, t->depth + 1};
        node->child[i] = (uint32_t)number;
        number += cylint_build_most_nodes(cylint_leaves_for(part->n));
        if (part->n > b->task_size) {
            cylint_mutex_lock(&b->lock);
            b->next[b->n_next++] = child;
            cylint_mutex_unlock(&b->lock);
        } else {
            make_nodes(b, &child);
        }
        if (part->n < CYLINT_WATCHED && t->all.n >= CYLINT_WATCHED)
            cylint_watch_add(b->watch, part->n);
    }
}

static void do_tasks(void *self, size_t from, size_t to)
{
    builder *b = self;
    for (; from < to; from++)
        make_nodes(b, &b->now[from]);
}

/* Moves the node and those below it to the first places that are free, and returns
 * the place of the node.  Nodes are visited in the order of their places, so a
 * place that is written was read before. */
static uint32_t move_below(cylint_node *nodes, uint32_t *n, uint32_t number)
{
    const uint32_t place = (*n)++;
    nodes[place] = nodes[number];
    for (unsigned i = 0; nodes[place].children >> i; i++) {
        const uint32_t child = nodes[place].child[i];
        if (!(child & CYLINT_LEAF_FLAG))
            nodes[place].child[i] = move_below(nodes, n, child);
    }
    return place;
}

/* First the root, then the tasks that it posts, then those that these post. */
size_t cylint_build_nodes(cylint_node *nodes, cylint_boxed_slice *boxes,
                          size_t n, const float center[3], float least_step,
                          int threads, cylint_watch *watch)
{
    const range all = measured(boxes, n);
    task now[MOST_TASKS];
    builder b = {.boxes = boxes,
                 .nodes = nodes,
                 .least_step = least_step,
                 .center = center,
                 .watch = watch,
                 .task_size = n / MOST_TASKS,
                 .now = now,
                 .lock = CYLINT_MUTEX_INITIALIZER,
                 .next = {{all, 0, 0}},
                 .n_next = 1};
    while (b.n_next > 0) {
        const size_t tasks = b.n_next;
        memcpy(now, b.next, tasks * sizeof *now);
        b.n_next = 0;
        cylint_threads_share(threads, tasks, 1, 1, do_tasks, &b);
    }
    cylint_mutex_destroy(&b.lock);
    if (!cylint_watch_add(watch, 0))
        return 0;
    uint32_t n_nodes = 0;
    move_below(nodes, &n_nodes, 0);
    return n_nodes;
}
