/*
 * group.c - shapes cut into pieces, pieces that lie together in blocks
 */
#include "group.h"

#include <string.h>

/* -------------------------------------------------------------- cutting -- */

static double box_area(const cylint_extent *b)
{
    const double x = (double)b->upper[0] - (double)b->lower[0];
    const double y = (double)b->upper[1] - (double)b->lower[1];
    const double z = (double)b->upper[2] - (double)b->lower[2];
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
 * other loses.  MANY pieces pay for fibres only, for which twice as many would
 * be faster by less than 10 % and slower to build.
 */
enum { FEW = 4, MANY = 8 };

/* So many shapes tell how many pieces the others may have. */
enum { FIRST = 4096 };

static const cylint_piece whole = {0, 1};

static int pieces_of(const cylint_trunk *t, const cylint_extent *box)
{
    const double m = sqrt(box_area(box) / trunk_area(t));
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

/* Stems, and boxes of their pieces, as many as there is room for. */
typedef struct {
    const cylint_memory_source *source;
    cylint_memory memory, stem_memory;
    cylint_stem *stem;
    cylint_box *box;
    size_t n, room;
    cylint_extent all;
} pieces;

static int make_room(pieces *p, size_t room)
{
    pieces more = *p;
    more.room = room;
    if (room > SIZE_MAX / sizeof *p->box ||
        !cylint_memory_take(&more.memory, p->source, room * sizeof *p->box))
        return 0;
    more.box = more.memory.data;
    if (p->n > 0)
        memcpy(more.box, p->box, p->n * sizeof *p->box);
    cylint_memory_give(&p->memory);
    *p = more;
    return 1;
}

/* Room for all pieces, if those to come are like those of the first `done`
 * shapes; and for the next ones in any case. */
static size_t room_for(const pieces *p, size_t done, size_t shapes)
{
    const size_t first = shapes < FIRST ? shapes : FIRST;
    const double each = done > 0 ? (double)p->n / (double)done : 0;
    return p->n + first * MANY +
           (size_t)(each * 1.0625 * (double)(shapes - done));
}

static void add_piece(pieces *p, const cylint_extent *b, uint32_t stem,
                      cylint_piece piece)
{
    p->box[p->n++] = (cylint_box){
        {b->lower[0], b->lower[1], b->lower[2]}, stem,
        {b->upper[0], b->upper[1], b->upper[2]}, (uint16_t)piece.index,
        (uint16_t)piece.count};
    cylint_extend_box(&p->all, b);
}

/* The pieces of a shape that is the stem of the given index.  0: its box is
 * not one to be kept. */
static int cut_shape(pieces *p, const cylint_view *view, uint32_t number,
                     uint32_t stem)
{
    cylint_trunk trunk;
    double reach[3];
    cylint_trunk_of(&trunk, view, number);
    cylint_trunk_reach(&trunk, reach);
    const cylint_extent box = cylint_piece_box(&trunk, reach, whole);
    if (!cylint_keeps_box(&box))
        return 0;
    p->stem[stem] = cylint_stem_of(&trunk, &view->shapes[number], number);
    const int count = pieces_of(&trunk, &box);
    if (count == 1)
        add_piece(p, &box, stem, whole);
    else
        for (int index = 0; index < count; index++) {
            const cylint_piece piece = {index, count};
            const cylint_extent b = cylint_piece_box(&trunk, reach, piece);
            add_piece(p, &b, stem, piece);
        }
    return 1;
}

static cylint_group_status cut(pieces *p, const members *m, size_t *refused)
{
    if (m->n > SIZE_MAX / sizeof *p->stem ||
        !cylint_memory_take(&p->stem_memory, p->source,
                            m->n * sizeof *p->stem))
        return CYLINT_GROUP_EMEMORY;
    p->stem = p->stem_memory.data;
    for (size_t i = 0; i < m->n; i++) {
        if (p->room - p->n < MANY && !make_room(p, room_for(p, i, m->n)))
            return CYLINT_GROUP_EMEMORY;
        *refused = member(m, i);
        if (*refused >= UINT32_MAX ||
            !cylint_is_bounded(&m->view->shapes[*refused]) ||
            !cut_shape(p, m->view, (uint32_t)*refused, (uint32_t)i))
            return CYLINT_GROUP_ESHAPE;
    }
    return CYLINT_GROUP_OK;
}

/* --------------------------------------------------------------- blocks -- */

/* The stems of so many boxes are brought together at a time: they lie here and
 * there, and the processor then waits for many at once.  (Prefetching them
 * showed no effect where every one needs an address translated.) */
enum { TOGETHER = 4 * CYLINT_BLOCK };

static void fill_blocks(cylint_block *blocks, const pieces *p, double blur)
{
    cylint_stem stem[TOGETHER];
    for (size_t from = 0; from < p->n; from += TOGETHER) {
        const size_t left = p->n - from;
        const int n = left < TOGETHER ? (int)left : TOGETHER;
        const cylint_box *box = p->box + from;
        for (int i = 0; i < n; i++)
            stem[i] = p->stem[box[i].stem];
        for (int i = 0; i < n; i += CYLINT_BLOCK)
            cylint_block_fill(blocks++, stem + i, box + i,
                              n - i < CYLINT_BLOCK ? n - i : CYLINT_BLOCK,
                              blur);
    }
}

/* Boxes, and nodes above them. */
typedef struct {
    pieces pieces;
    cylint_memory memory; /* of the nodes */
    cylint_node *nodes;
    size_t n_nodes;
} plan;

static size_t blocks_of(size_t boxes)
{
    return (boxes + CYLINT_BLOCK - 1) / CYLINT_BLOCK;
}

/* S being the longest side of the box of all: pad and near_by as in walk.c. */
static void measure(cylint_group *group, const cylint_extent *box,
                    double blur)
{
    double longest = 0;
    for (int j = 0; j < 3; j++) {
        const double lower = box->lower[j], upper = box->upper[j];
        longest = fmax(longest, upper - lower);
        group->center[j] = (float)((lower + upper) / 2);
    }
    group->box = *box;
    group->pad = cylint_float_above(longest * 0x1p-20 + blur);
    group->near_by = cylint_float_above(longest * 256);
}

static void give_plan(plan *p)
{
    cylint_memory_give(&p->pieces.memory);
    cylint_memory_give(&p->pieces.stem_memory);
    cylint_memory_give(&p->memory);
}

static cylint_group_status make_plan(plan *p, cylint_group *group,
                                     const members *m, size_t *refused)
{
    const cylint_group_status cuts = cut(&p->pieces, m, refused);
    if (cuts != CYLINT_GROUP_OK)
        return cuts;
    const size_t blocks = blocks_of(p->pieces.n);
    if (blocks >= CYLINT_LEAF ||
        !cylint_memory_take(&p->memory, p->pieces.source,
                            cylint_tree_most_nodes(blocks) * sizeof *p->nodes))
        return CYLINT_GROUP_EMEMORY;
    p->nodes = p->memory.data;
    measure(group, &p->pieces.all, m->view->blur);
    p->n_nodes = cylint_tree_build(p->nodes, p->pieces.box, p->pieces.n,
                                   group->center);
    return CYLINT_GROUP_OK;
}

/* What was planned, in no more room than it takes. */
static cylint_group_status carry_out(cylint_group *group, const plan *p,
                                     double blur)
{
    group->n = blocks_of(p->pieces.n);
    if (!cylint_memory_take(&group->memory, p->pieces.source,
                            p->n_nodes * sizeof *p->nodes +
                            group->n * sizeof(cylint_block)))
        return CYLINT_GROUP_EMEMORY;
    cylint_node *nodes = group->memory.data;
    cylint_block *blocks = (cylint_block *)(void *)(nodes + p->n_nodes);
    memcpy(nodes, p->nodes, p->n_nodes * sizeof *nodes);
    fill_blocks(blocks, &p->pieces, blur);
    group->nodes = nodes;
    group->blocks = blocks;
    return CYLINT_GROUP_OK;
}

cylint_group_status cylint_group_make(cylint_group *group,
                                      const cylint_memory_source *source,
                                      const cylint_view *view,
                                      const uint32_t *numbers, size_t n,
                                      size_t *refused)
{
    const members m = {view, numbers, n};
    plan p = {.pieces = {.source = source, .all = cylint_no_box()}};
    memset(group, 0, sizeof *group);
    group->box = p.pieces.all;
    if (n == 0)
        return CYLINT_GROUP_OK;
    cylint_group_status status = make_plan(&p, group, &m, refused);
    if (status == CYLINT_GROUP_OK)
        status = carry_out(group, &p, view->blur);
    give_plan(&p);
    return status;
}

void cylint_group_free(cylint_group *group)
{
    cylint_memory_give(&group->memory);
    memset(group, 0, sizeof *group);
}
