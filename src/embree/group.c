/*
 * group.c - shapes cut into pieces, pieces that lie together in blocks
 */
#include "group.h"

#include <string.h>

/* -------------------------------------------------------------- cutting -- */

static double box_area(const struct RTCBounds *b)
{
    const double x = (double)b->upper_x - (double)b->lower_x;
    const double y = (double)b->upper_y - (double)b->lower_y;
    const double z = (double)b->upper_z - (double)b->lower_z;
    return 2 * (x * y + y * z + z * x);
}

/* Of the cylinder about a trunk, nearly. */
static double trunk_area(const cylint_trunk *t)
{
    const double pi = 3.14159265358979323846;
    const double k = fmax(t->k[0], t->k[1]), r = k * t->across;
    return 2 * pi * r * (r + t->length + k * t->along);
}

/*
 * A ray that comes through the box meets the shape with the ratio of their
 * areas.  m pieces have m boxes of 1/m^2 the area, together 1/m of it, and m
 * times the boxes: the root of the ratio of areas is where one gains what the
 * other loses.  MANY pieces pay for fibres only.
 */
enum { FEW = 4, MANY = 16 };

static int pieces_of(const cylint_trunk *t, const double reach[3])
{
    const struct RTCBounds box = cylint_piece_box(t, reach,
                                                  (cylint_piece){0, 1});
    const double m = sqrt(box_area(&box) / trunk_area(t));
    const double most = m > 2 * FEW ? MANY : FEW;
    return !(m > 1) ? 1 : (int)fmin(m + 0.5, most);
}

/* The shapes to be grouped. */
typedef struct {
    const cylint_view *view;
    const uint32_t *numbers;
    size_t n;
} members;

static uint32_t member(const members *m, size_t i)
{
    return m->numbers ? m->numbers[i] : (uint32_t)i;
}

static size_t count_pieces(const members *m)
{
    size_t pieces = 0;
    for (size_t i = 0; i < m->n; i++) {
        cylint_trunk trunk;
        double reach[3];
        cylint_trunk_of(&trunk, m->view, member(m, i));
        cylint_trunk_reach(&trunk, reach);
        pieces += (size_t)pieces_of(&trunk, reach);
    }
    return pieces;
}

static void cut(cylint_box *boxes, const members *m)
{
    for (size_t i = 0; i < m->n; i++) {
        cylint_trunk trunk;
        double reach[3];
        cylint_trunk_of(&trunk, m->view, member(m, i));
        cylint_trunk_reach(&trunk, reach);
        const int count = pieces_of(&trunk, reach);
        for (int index = 0; index < count; index++) {
            const struct RTCBounds b = cylint_piece_box(
                &trunk, reach, (cylint_piece){index, count});
            *boxes++ = (cylint_box){
                {b.lower_x, b.lower_y, b.lower_z}, member(m, i),
                {b.upper_x, b.upper_y, b.upper_z}, (uint16_t)index,
                (uint16_t)count};
        }
    }
}

/* --------------------------------------------------------------- blocks -- */

/* The shapes of a block some blocks ahead, which lie here and there. */
enum { AHEAD = 4 };

static void fetch_ahead(const cylint_view *view, const cylint_box *boxes,
                        size_t from, size_t n)
{
    for (size_t i = from; i < from + CYLINT_BLOCK && i < n; i++)
        cylint_fetch_shape(view->shapes + boxes[i].number);
}

static void fill_blocks(cylint_block *blocks, const cylint_box *boxes,
                        size_t n, const cylint_view *view)
{
    for (size_t from = 0; from < n; from += CYLINT_BLOCK) {
        fetch_ahead(view, boxes, from + AHEAD * CYLINT_BLOCK, n);
        const size_t left = n - from;
        cylint_block_fill(blocks++, view, boxes + from,
                          left < CYLINT_BLOCK ? (int)left : CYLINT_BLOCK);
    }
}

/* Boxes, and room for the nodes above them. */
typedef struct {
    cylint_memory memory;
    cylint_node *nodes;
    cylint_box *boxes;
    size_t n, n_nodes;
} plan;

static size_t blocks_of(size_t boxes)
{
    return (boxes + CYLINT_BLOCK - 1) / CYLINT_BLOCK;
}

/* The middle of all boxes; with S their longest side, pad and near_by as in
 * walk.c. */
static void measure(cylint_group *group, const cylint_box *boxes, size_t n,
                    double blur)
{
    double longest = 0;
    for (int j = 0; j < 3; j++) {
        float lower = boxes[0].lower[j], upper = boxes[0].upper[j];
        for (size_t i = 1; i < n; i++) {
            lower = boxes[i].lower[j] < lower ? boxes[i].lower[j] : lower;
            upper = boxes[i].upper[j] > upper ? boxes[i].upper[j] : upper;
        }
        longest = fmax(longest, (double)upper - (double)lower);
        group->center[j] = (float)(((double)lower + (double)upper) / 2);
    }
    group->pad = cylint_float_above(longest * 0x1p-20 + blur);
    group->near_by = cylint_float_above(longest * 256);
}

static int make_plan(plan *p, cylint_group *group, RTCDevice device,
                     const members *m)
{
    p->n = count_pieces(m);
    const size_t most = cylint_tree_most_nodes(blocks_of(p->n));
    if (blocks_of(p->n) >= CYLINT_LEAF ||
        !cylint_memory_take(&p->memory, device, most * sizeof *p->nodes +
                            p->n * sizeof *p->boxes))
        return 0;
    p->nodes = p->memory.data;
    p->boxes = (cylint_box *)(void *)(p->nodes + most);
    cut(p->boxes, m);
    measure(group, p->boxes, p->n, m->view->blur);
    p->n_nodes = cylint_tree_build(p->nodes, p->boxes, p->n, group->center);
    return 1;
}

/* What was planned, in no more room than it takes. */
static int carry_out(cylint_group *group, RTCDevice device, const plan *p,
                     const cylint_view *view)
{
    group->n = blocks_of(p->n);
    if (!cylint_memory_take(&group->memory, device,
                            p->n_nodes * sizeof *p->nodes +
                            group->n * sizeof(cylint_block)))
        return 0;
    cylint_node *nodes = group->memory.data;
    cylint_block *blocks = (cylint_block *)(void *)(nodes + p->n_nodes);
    memcpy(nodes, p->nodes, p->n_nodes * sizeof *nodes);
    fill_blocks(blocks, p->boxes, p->n, view);
    group->nodes = nodes;
    group->blocks = blocks;
    return 1;
}

int cylint_group_make(cylint_group *group, RTCDevice device,
                      const cylint_view *view, const uint32_t *numbers,
                      size_t n)
{
    const members m = {view, numbers, n};
    plan p;
    memset(group, 0, sizeof *group);
    if (n == 0)
        return 1;
    if (!make_plan(&p, group, device, &m))
        return 0;
    const int made = carry_out(group, device, &p, view);
    cylint_memory_give(&p.memory);
    return made;
}

void cylint_group_free(cylint_group *group)
{
    cylint_memory_give(&group->memory);
    memset(group, 0, sizeof *group);
}
