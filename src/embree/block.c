/*
 * block.c - filling blocks
 */
#include "block.h"

#include <string.h>

/*
 * From the box's centre to its sides it is at most REACH
 * steps of 2^-k, and more than half as many unless k is limited.  Shorts hold
 * the rest: radii, at most sqrt(3/2) REACH for a disc in such a box, and
 * axes that are lengthened below.
 */
#define REACH 24000.0
#define LARGEST 32767.0

/* At most 2^100 a unit: what floats take for zero is no part of a step. */
static float steps_per_unit(double half)
{
    int e;
    frexp(fmax(half, REACH * 0x1p-100) / REACH, &e); /* half / REACH <= 2^e */
    return ldexpf(1, -e);
}

static void place(cylint_block *block, const cylint_box *boxes, int used)
{
    double most = 0;
    for (int j = 0; j < 3; j++) {
        float lower = boxes[0].lower[j], upper = boxes[0].upper[j];
        for (int lane = 1; lane < used; lane++) {
            lower = fminf(lower, boxes[lane].lower[j]);
            upper = fmaxf(upper, boxes[lane].upper[j]);
        }
        const float c = (float)(((double)lower + (double)upper) / 2);
        const double half = fmax((double)upper - (double)c,
                                 (double)c - (double)lower);
        block->center[j] = c;
        most = fmax(most, half);
    }
    block->per_unit = steps_per_unit(most);
}

/* A cylinder in steps. */
typedef struct {
    double p[2][3], r;
} hull;

static int store(cylint_block *block, int lane, const hull *h)
{
    for (int end = 0; end < 2; end++)
        for (int j = 0; j < 3; j++)
            if (!(fabs(h->p[end][j]) < LARGEST))
                return 0;
    if (!(h->r < LARGEST))
        return 0;
    for (int end = 0; end < 2; end++)
        for (int j = 0; j < 3; j++)
            block->p[end][j][lane] = (int16_t)lrint(h->p[end][j]);
    block->r[lane] = (int16_t)ceil(h->r);
    return 1;
}

/*
 * The piece is the hull of two sections; A(z) is on its axis, X in the
 * section at z, |X - A(z)| <= across off the axis and <= along along it.  Ends
 * are lengthened by g along the axis, then rounded: the rounded axis passes
 * A(z) at Q(z), and is less than e = 7/8 step from it, sqrt(3)/2 from the
 * rounding and the rest (`rough`) from the doubles before; and as much as
 * a line may be off, the piece must be thicker and longer.  So
 *
 *   X is at most across + e from the rounded axis,
 *   and along it at most e + along + across sin(a) from Q(z),
 *
 * a being the angle between the axes: its ends being moved less than e, the
 * axis of length l >= 2e turns by sin(a) <= 2 e / (l - 2 e).  g is no less
 * than what X may stick out, and at least 4, so that no lane is without axis.
 */
static int hold(cylint_block *block, int lane, const cylint_trunk *t,
                cylint_piece piece, double blur)
{
    const double steps = block->per_unit;
    const double rough = blur * steps + 0x1p-48 * steps *
        (fabs(t->base[0]) + fabs(t->base[1]) + fabs(t->base[2]) + t->length +
         fmax(t->k[0], t->k[1]) * (t->across + t->along));
    const double e = 0.875 + rough;
    double z[2];
    cylint_piece_ends(piece, z);
    const double k = fmax(t->k[0] + (t->k[1] - t->k[0]) * z[0],
                          t->k[0] + (t->k[1] - t->k[0]) * z[1]) * steps;
    const double across = k * t->across, length = t->length * steps;
    const double l = length * (z[1] - z[0]);
    const double turn = l > 4 * e ? 2 * e / (l - 2 * e) : 1;
    const double g = e + k * t->along + across * fmin(turn, 1) + 4;
    hull h = {.r = across + e};
    for (int end = 0; end < 2; end++)
        for (int j = 0; j < 3; j++) {
            const double unit = t->length > 0 ? t->axis[j] / t->length
                                              : j == 0;
            const double from = t->base[j] - (double)block->center[j];
            h.p[end][j] = (from + z[end] * t->axis[j]) * steps +
                          (end ? g : -g) * unit;
        }
    return rough < 1 && store(block, lane, &h);
}

void cylint_block_fill(cylint_block *block, const cylint_view *view,
                       const cylint_box *boxes, int used)
{
    memset(block, 0, sizeof *block);
    place(block, boxes, used);
    block->used = (uint8_t)used;
    for (int lane = 0; lane < used; lane++) {
        const cylint_box *box = boxes + lane;
        const cylint_piece piece = {box->index, box->count};
        cylint_trunk trunk;
        cylint_trunk_of(&trunk, view, box->number);
        block->number[lane] = box->number;
        block->piece[lane] = (uint8_t)(piece.index | (piece.count - 1) << 4);
        if (!hold(block, lane, &trunk, piece, view->blur))
            block->always |= (uint8_t)(1u << lane);
    }
}
