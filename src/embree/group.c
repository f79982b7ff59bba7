/*
 * group.c - shapes cut into pieces, pieces that lie together in blocks
 */
#include "group.h"

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

static int make_blocks(cylint_group *group, RTCDevice device,
                       const cylint_box *boxes, size_t n,
                       const cylint_view *view)
{
    group->n = (n + CYLINT_BLOCK - 1) / CYLINT_BLOCK;
    if (!cylint_memory_take(&group->memory, device,
                            group->n * sizeof(cylint_block)))
        return 0;
    cylint_block *blocks = group->memory.data;
    for (size_t i = 0; i < group->n; i++) {
        fetch_ahead(view, boxes, (i + AHEAD) * CYLINT_BLOCK, n);
        const size_t left = n - i * CYLINT_BLOCK;
        cylint_block_fill(&blocks[i], view, boxes + i * CYLINT_BLOCK,
                          left < CYLINT_BLOCK ? (int)left : CYLINT_BLOCK);
    }
    group->blocks = blocks;
    return 1;
}

int cylint_group_make(cylint_group *group, RTCDevice device,
                      const cylint_view *view, const uint32_t *numbers,
                      size_t n)
{
    const members m = {view, numbers, n};
    cylint_memory memory;
    *group = (cylint_group){{0}, NULL, 0};
    if (n == 0)
        return 1;
    const size_t pieces = count_pieces(&m);
    if (!cylint_memory_take(&memory, device, pieces * sizeof(cylint_box)))
        return 0;
    cylint_box *boxes = memory.data;
    cut(boxes, &m);
    cylint_sort_boxes(boxes, pieces);
    const int made = make_blocks(group, device, boxes, pieces, view);
    cylint_memory_give(&memory);
    return made;
}

void cylint_group_free(cylint_group *group)
{
    cylint_memory_give(&group->memory);
    *group = (cylint_group){{0}, NULL, 0};
}
