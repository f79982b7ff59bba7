/*
 * group.c - shapes cut into pieces, pieces that lie together in blocks
 *
 * Embree's builder sorts the pieces' boxes until leaves of up to 8 remain,
 * which become blocks.  It permutes the array of boxes in place and hands out
 * leaves as ranges of it; each leaf's length is noted in its first box.  Where
 * a note is missing or makes no sense, 8 boxes are a block as they come:
 * grouping is a matter of speed.
 */
#include "group.h"

#include <string.h>

typedef struct RTCBuildPrimitive build_box;

/* geomID of a box: the piece, and the length of the leaf it begins. */
static unsigned note_of(cylint_piece piece)
{
    return (unsigned)piece.index | (unsigned)piece.count << 8;
}

static cylint_piece piece_in(unsigned note)
{
    return (cylint_piece){(int)(note & 255), (int)(note >> 8 & 255)};
}

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

static int pieces_of(const cylint_trunk *t)
{
    const struct RTCBounds box = cylint_piece_box(t, (cylint_piece){0, 1});
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
        cylint_trunk_of(&trunk, m->view, member(m, i));
        pieces += (size_t)pieces_of(&trunk);
    }
    return pieces;
}

static void cut(build_box *boxes, const members *m)
{
    for (size_t i = 0; i < m->n; i++) {
        cylint_trunk trunk;
        cylint_trunk_of(&trunk, m->view, member(m, i));
        const int count = pieces_of(&trunk);
        for (int index = 0; index < count; index++) {
            const cylint_piece piece = {index, count};
            const struct RTCBounds b = cylint_piece_box(&trunk, piece);
            *boxes++ = (build_box){b.lower_x, b.lower_y, b.lower_z,
                                   note_of(piece), b.upper_x, b.upper_y,
                                   b.upper_z, member(m, i)};
        }
    }
}

/* ------------------------------------------------------------- building -- */

typedef struct {
    build_box *boxes;
    size_t n;
} build;

/* Only the leaves are of interest; a node is any pointer that is not null. */
static void *make_node(RTCThreadLocalAllocator allocator, unsigned children,
                       void *user)
{
    (void)allocator;
    (void)children;
    return user;
}

static void set_children(void *node, void **children, unsigned n, void *user)
{
    (void)node;
    (void)children;
    (void)n;
    (void)user;
}

static void set_bounds(void *node, const struct RTCBounds **bounds, unsigned n,
                       void *user)
{
    (void)node;
    (void)bounds;
    (void)n;
    (void)user;
}

static void *make_leaf(RTCThreadLocalAllocator allocator,
                       const build_box *leaf, size_t n, void *user)
{
    const build *b = user;
    const uintptr_t at = (uintptr_t)leaf, begin = (uintptr_t)b->boxes;
    (void)allocator;
    if (at >= begin && at - begin < b->n * sizeof *leaf)
        b->boxes[(at - begin) / sizeof *leaf].geomID |= (unsigned)n << 16;
    return user;
}

static int sort_into_leaves(RTCDevice device, build *b)
{
    struct RTCBuildArguments arguments = rtcDefaultBuildArguments();
    RTCBVH bvh = rtcNewBVH(device);
    if (!bvh)
        return 0;
    arguments.maxBranchingFactor = 4;
    arguments.maxDepth = 64;
    arguments.sahBlockSize = CYLINT_BLOCK;
    arguments.maxLeafSize = CYLINT_BLOCK;
    arguments.bvh = bvh;
    arguments.primitives = b->boxes;
    arguments.primitiveCount = b->n;
    arguments.primitiveArrayCapacity = b->n;
    arguments.createNode = make_node;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = make_leaf;
    arguments.userPtr = b;
    void *root = rtcBuildBVH(&arguments);
    rtcReleaseBVH(bvh);
    return root != NULL;
}

/* --------------------------------------------------------------- blocks -- */

/* How many boxes from i on are a block. */
static int block_at(const build *b, size_t i)
{
    const size_t noted = b->boxes[i].geomID >> 16;
    const size_t length = noted >= 1 && noted <= CYLINT_BLOCK ? noted
                                                              : CYLINT_BLOCK;
    return (int)(length < b->n - i ? length : b->n - i);
}

static size_t count_blocks(const build *b)
{
    size_t blocks = 0;
    for (size_t i = 0; i < b->n; i += (size_t)block_at(b, i))
        blocks++;
    return blocks;
}

static void fill_blocks(cylint_block *block, const build *b,
                        const cylint_view *view)
{
    size_t i = 0;
    while (i < b->n) {
        const int used = block_at(b, i);
        cylint_block_entry entries[CYLINT_BLOCK];
        struct RTCBounds box;
        for (int k = 0; k < used; k++) {
            const build_box *from = &b->boxes[i + (size_t)k];
            const struct RTCBounds one = {
                from->lower_x, from->lower_y, from->lower_z, 0,
                from->upper_x, from->upper_y, from->upper_z, 0};
            entries[k].number = from->primID;
            entries[k].piece = piece_in(from->geomID);
            if (k == 0)
                box = one;
            else
                cylint_extend_box(&box, &one);
        }
        cylint_block_fill(block++, view, entries, used, &box);
        i += (size_t)used;
    }
}

static int make_blocks(cylint_group *group, RTCDevice device, const build *b,
                       const cylint_view *view)
{
    group->n = count_blocks(b);
    if (!cylint_memory_take(&group->memory, device,
                            group->n * sizeof(cylint_block)))
        return 0;
    group->blocks = group->memory.data;
    fill_blocks(group->memory.data, b, view);
    return 1;
}

int cylint_group_make(cylint_group *group, RTCDevice device,
                      const cylint_view *view, const uint32_t *numbers,
                      size_t n)
{
    const members m = {view, numbers, n};
    cylint_memory memory;
    build b;
    *group = (cylint_group){{0}, NULL, 0};
    if (n == 0)
        return 1;
    b.n = count_pieces(&m);
    if (!cylint_memory_take(&memory, device, b.n * sizeof *b.boxes))
        return 0;
    b.boxes = memory.data;
    cut(b.boxes, &m);
    const int made = sort_into_leaves(device, &b) &&
                     make_blocks(group, device, &b, view);
    cylint_memory_give(&memory);
    return made;
}

void cylint_group_free(cylint_group *group)
{
    cylint_memory_give(&group->memory);
    *group = (cylint_group){{0}, NULL, 0};
}
