/*
 * leaf.c - filling blocks
 */
#include "leaf.h"

#include <string.h>

/*
 * From the box's centre to its sides it is at most REACH steps.  Ten bits hold
 * the rest: radii, at most sqrt(3/2) REACH for a disc in such a box, and axes
 * that are lengthened below.
 */
#define REACH 440.0
#define LARGEST_P 511.0
#define LARGEST_R 1023.0

/* At most 2^100 a unit: what floats take for zero is no part of a step. */
static uint16_t steps_per_unit(double half)
{
    const double most = 0x1p100;
    return cylint_half_below(REACH < most * half ? REACH / half : most);
}

static void place(cylint_leaf *block, const cylint_boxed_piece *boxes, int used)
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
        most = cylint_larger(most, cylint_larger((double)upper - (double)c,
                                                 (double)c - (double)lower));
    }
    block->steps = steps_per_unit(most);
}

/* A cylinder in steps. */
typedef struct {
    double p[2][3], r;
} hull;

/* How far rounding it to whole steps moves an end. */
static double moved(const double p[3])
{
    double square = 0;
    for (int j = 0; j < 3; j++)
        square += (p[j] - rint(p[j])) * (p[j] - rint(p[j]));
    return sqrt(square);
}

static int store(cylint_leaf *block, int lane, const hull *h)
{
    const double r = ceil(h->r + cylint_larger(moved(h->p[0]), moved(h->p[1])));
    for (int end = 0; end < 2; end++)
        for (int j = 0; j < 3; j++)
            if (!(fabs(h->p[end][j]) < LARGEST_P))
                return 0;
    if (!(r <= LARGEST_R))
        return 0;
    for (int end = 0; end < 2; end++)
        for (int j = 0; j < 3; j++)
            block->p[end][lane] |=
                (uint32_t)(CYLINT_LEAF_MIDDLE + lrint(h->p[end][j]))
                << j * CYLINT_LEAF_P_BITS;
    block->r[lane] = (uint16_t)(block->r[lane] | (int)r);
    return 1;
}

/* What is not steps: of the piece and of the shape's ends. */
static void label(cylint_leaf *block, int lane, cylint_piece piece, int ends)
{
    const uint32_t more = (uint32_t)piece.count - 1;
    block->p[0][lane] = more << 30;
    block->p[1][lane] = more >> 2 << 30;
    block->r[lane] =
        (uint16_t)((piece.index | ends << 4) << CYLINT_LEAF_R_BITS);
}

/*
 * The piece is the hull of two sections; A(z) is on its axis, X in the
 * section at z, |X - A(z)| <= across off the axis and <= along along it.  Ends
 * are lengthened by g along the axis, then rounded: the rounded axis passes
 * A(z) at Q(z), and is less than e = 7/8 step from it, at most sqrt(3)/2 from
 * the rounding and the rest (`rough`) from the doubles before; and as much as
 * a line may be off, the piece must be thicker and longer.  So
 *
 *   X is at most across + e from the rounded axis (stored with what the
 *   rounding was, not the most that it can be),
 *   and along it at most e + along + across sin(a) from Q(z),
 *
 * a being the angle between the axes: its ends being moved less than e, the
 * lengthened axis turns by sin(a) <= 2 e / (l + 2 g - 2 e).  g must be no less
 * than what X may stick out: with g = e + along + 4 + x, where x is
 * sqrt(across e), sin(a) is less than e / x, and across sin(a) than x; or, if
 * that is less, x = across 2 e / (l - 2 e).  4 more, so that no lane is without
 * axis.
 */
static int hold(cylint_leaf *block, int lane, const cylint_packed_disc *s,
                cylint_piece piece, double blur)
{
    const double steps = cylint_leaf_steps(block);
    const double *base = s->base, *axis = s->axis;
    const double k0 = s->across[0], k1 = s->across[1];
    const double slant = cylint_float_of_half(s->slant);
    const double length =
        sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    const double rough =
        blur * steps + 0x1p-48 * steps *
                           (fabs(base[0]) + fabs(base[1]) + fabs(base[2]) +
                            length + cylint_larger(k0, k1) * (1 + slant));
    const double e = 0.875 + rough;
    double z[2];
    cylint_piece_ends(piece, z);
    const double across =
        cylint_larger(k0 + (k1 - k0) * z[0], k0 + (k1 - k0) * z[1]) * steps;
    const double l = length * steps * (z[1] - z[0]);
    const double out = sqrt(across * e);
    const double g =
        e + across * slant + 4 +
        (l > 4 * e ? cylint_smaller(out, across * 2 * e / (l - 2 * e)) : out);
    const double g_per_length = length > 0 ? g / length : 0;
    hull h = {.r = across + rough + 0x1p-20};
    for (int j = 0; j < 3; j++) {
        const double from = base[j] - (double)block->center[j];
        const double more = length > 0 ? g_per_length * axis[j] : j ? 0 : g;
        h.p[0][j] = (from + z[0] * axis[j]) * steps - more;
        h.p[1][j] = (from + z[1] * axis[j]) * steps + more;
    }
    return rough < 1 && store(block, lane, &h);
}

void cylint_leaf_fill(cylint_leaf *block, const cylint_packed_disc *stems,
                      const cylint_boxed_piece *boxes, int used, double blur)
{
    memset(block, 0, sizeof *block);
    place(block, boxes, used);
    block->used = (uint8_t)(used | CYLINT_LEAF_SOLID);
    for (int lane = 0; lane < used; lane++) {
        const cylint_packed_disc *stem = stems + lane;
        const cylint_piece piece = {boxes[lane].index, boxes[lane].count};
        block->number[lane] = stem->number;
        label(block, lane, piece, stem->ends);
        if (!stem->solid)
            block->used = (uint8_t)used;
        if (!hold(block, lane, stem, piece, blur))
            block->always |= (uint8_t)(1u << lane);
    }
}
