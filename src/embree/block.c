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

static double larger(double x, double y) /* fmax() is a call */
{
    return x > y ? x : y;
}

/* At most 2^100 a unit: what floats take for zero is no part of a step. */
static float steps_per_unit(double half)
{
    int e;
    frexp(larger(half, REACH * 0x1p-100) / REACH, &e); /* half / REACH <= 2^e */
    return ldexpf(1, -e);
}

static void place(cylint_block *block, const cylint_box *boxes, int used)
{
    double most = 0;
    for (int j = 0; j < 3; j++) {
        float lower = boxes[0].lower[j], upper = boxes[0].upper[j];
        for (int lane = 1; lane < used; lane++) {
            cylint_extend_side(&lower, &upper, boxes[lane].lower[j],
                               boxes[lane].upper[j]);
        }
        const float c = (float)(((double)lower + (double)upper) / 2);
        block->center[j] = c;
        most = larger(most, larger((double)upper - (double)c,
                                   (double)c - (double)lower));
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
    const int16_t r = (int16_t)h->r;
    block->r[lane] = (int16_t)(r + (r < h->r));
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
static int hold(cylint_block *block, int lane, const cylint_stem *s,
                cylint_piece piece, double blur)
{
    const double steps = block->per_unit;
    const double *base = s->base, *axis = s->axis;
    const double k0 = s->across[0], k1 = s->across[1];
    const double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] +
                               axis[2] * axis[2]);
    const double rough = blur * steps + 0x1p-48 * steps *
        (fabs(base[0]) + fabs(base[1]) + fabs(base[2]) + length +
         larger(k0, k1) * (1 + s->slant));
    const double e = 0.875 + rough;
    double z[2];
    cylint_piece_ends(piece, z);
    const double across = larger(k0 + (k1 - k0) * z[0],
                                 k0 + (k1 - k0) * z[1]) * steps;
    const double l = length * steps * (z[1] - z[0]);
    const double turn = l > 4 * e ? 2 * e / (l - 2 * e) : 1;
    const double g = e + across * (s->slant + turn) + 4;
    const double g_per_length = length > 0 ? g / length : 0;
    hull h = {.r = across + e};
    for (int j = 0; j < 3; j++) {
        const double from = base[j] - (double)block->center[j];
        const double more = length > 0 ? g_per_length * axis[j] : j ? 0 : g;
        h.p[0][j] = (from + z[0] * axis[j]) * steps - more;
        h.p[1][j] = (from + z[1] * axis[j]) * steps + more;
    }
    return rough < 1 && store(block, lane, &h);
}

void cylint_block_fill(cylint_block *block, const cylint_stem *stems,
                       const cylint_box *boxes, int used, double blur)
{
    memset(block, 0, sizeof *block);
    place(block, boxes, used);
    block->used = (uint8_t)used;
    for (int lane = 0; lane < used; lane++) {
        const cylint_stem *stem = stems + lane;
        const cylint_piece piece = {boxes[lane].index, boxes[lane].count};
        block->number[lane] = stem->number;
        block->piece[lane] = (uint8_t)(piece.index | (piece.count - 1) << 4);
        if (!hold(block, lane, stem, piece, blur))
            block->always |= (uint8_t)(1u << lane);
    }
}
