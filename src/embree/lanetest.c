/*
 * lanetest.c - which lanes of a block a line may meet
 *
 * Compiled once as it is and again for AVX2 where the Makefile knows that:
 * the builds may differ in what they let through, not in what they owe.
 */
#include "block.h"
#include "lanes.h"

#ifndef CYLINT_BLOCK_TEST
#define CYLINT_BLOCK_TEST cylint_block_test_plain
#endif

/*
 * In steps around the block's centre a lane is a cylinder: axis p to p + w,
 * radius r.  The line is q + s e, e of unit length, q its point nearest to
 * the centre.  With D = q - p
 *
 *   n = e x w,  f = D.n:           the line passes the axis at |f| / |n|;
 *   T = (D.w)(e.w) - (D.e) ww:     nearest at s = T / nn;
 *   C = sqrt((r^2 nn - f^2) ww):   within r of the axis for |s nn - T| <= C,
 *
 * where (D + s e).w must come into [0, ww], and s into the domain.  All is
 * multiplied by nn, so that a line along the axis needs no division; it only
 * makes the errors weigh more.
 *
 * Errors.  u = 2^-24; W = |w|, N = |n| <= W; K = 2^17 bounds |D|, |s| and
 * with r stays below 2^18: the parts of the pieces that count are no farther
 * than sqrt(3) REACH < 2^16 from the centre, nor is q, else the line misses.
 *
 *  - q, e and D are rounded.  The line is displaced by u |q| + u |s| + u |D| <
 *    2^-5, and by `off` from the doubles.  That is a wider and longer lane.
 *  - n is wrong by a vector of at most 2 sqrt(3) u W.
 *    f is wrong by K (2 sqrt(3) u W + 3 u N).
 *    r |n| <= |f| is certainly false if g < |f|, with
 *      g = (r + 2^-5 + off) N + 2 sqrt(3) u 2^18 W + 3 u K N
 *        + 6 u r N (from N and g themselves) <= (r + 1/8 + off) N + W / 8.
 *    This g serves C too, as (g - f)(g + f) >= r^2 nn - f^2 follows from
 *    g - r N >= the error of f.
 *  - T: the dot products are wrong by 3 u of their bounds K W, W, K, W^2, so T
 *    by 15 u K W^2; where s is within r of the axis, s nn differs from T + C
 *    by what n's error makes of K, r and T, 11 u K W^2 at most, and C is
 *    wrong by 4 u 2^17 W^2.  In all 30 u 2^17 W^2 < W^2 / 4: half of ww is
 *    given, the other quarter for rounding s nn and T / nn, each below 2^18.
 *  - (D.w) nn + (e.w) s nn: 12 u K W^3 < W^3 / 8 for the products, W^3 / 4
 *    from T, and the longer ends, (2^-5 + off) W nn: in all (ww + off nn) W.
 *
 * W is taken from above as |w_x| + |w_y| + |w_z|.  What is flushed to zero
 * instead of being subnormal is below 2^-126 and disappears in W / 8 and ww / 2,
 * as every lane has W >= 1.
 */
typedef struct {
    float q[3], e[3];
    float off, first, last; /* first and last with `off` and 1/8 to spare */
} lane_line;

static inline vf dot(const vf x[3], const vf y[3])
{
    return f_mad(x[0], y[0], f_mad(x[1], y[1], x[2] * y[2]));
}

/* Lanes from `from` on; s of each that is let through is at least least[]. */
static inline unsigned test_lanes(const cylint_block *b, int from,
                                  const lane_line *l, float *least)
{
    vf w[3], D[3], e[3], n[3];
    for (int j = 0; j < 3; j++) {
        const vf p = f_from_shorts(b->p[0][j] + from);
        w[j] = f_from_shorts(b->p[1][j] + from) - p;
        D[j] = f_set(l->q[j]) - p;
        e[j] = f_set(l->e[j]);
    }
    for (int j = 0; j < 3; j++) {
        const int k = (j + 1) % 3, m = (j + 2) % 3;
        n[j] = f_mad(e[k], w[m], -(e[m] * w[k]));
    }
    const vf eighth = f_set(0.125f), half = f_set(0.5f), off = f_set(l->off);
    const vf nn = dot(n, n), f = f_abs(dot(D, n));
    const vf W = f_abs(w[0]) + f_abs(w[1]) + f_abs(w[2]);
    const vf r = f_from_shorts(b->r + from) + (eighth + off);
    const vf g = f_mad(r, f_sqrt(nn), W * eighth);
    unsigned met = f_not_greater(f, g);
    if (!met)
        return 0;
    const vf ww = dot(w, w), Dw = dot(D, w), ew = dot(e, w);
    const vf T = f_mad(Dw, ew, -(dot(D, e) * ww));
    const vf C = f_sqrt((g - f) * (g + f) * ww);
    const vf middle = ww * nn * half;
    const vf room = f_mad(f_abs(ew), C, f_mad(off, nn, ww) * W);
    met &= f_not_greater(f_abs(f_mad(Dw, nn, ew * T) - middle), middle + room);
    const vf half_ww = ww * half;
    const vf begin = T - C - half_ww, end = T + C + half_ww;
    met &= f_not_greater(begin, f_set(l->last) * nn);
    met &= f_not_greater(f_set(l->first) * nn, end);
    f_store(least + from, begin / nn);
    return met;
}

/* All that q and the domain may be off, in steps, beyond which floats are of
 * no use; and how far q may be from the centre where pieces are met. */
#define OFF_LIMIT 4096.0
#define NEAR_LIMIT (65536.0 - OFF_LIMIT)
#define DOMAIN_LIMIT 262144.0

static unsigned all_lanes(const cylint_block *b, double tmin, double *least)
{
    for (int lane = 0; lane < b->used; lane++)
        least[lane] = tmin;
    return (1u << b->used) - 1;
}

static float clamp(double s)
{
    return (float)fmin(fmax(s, -DOMAIN_LIMIT), DOMAIN_LIMIT);
}

/*
 * The line at the block.  o - c, the unit vector, the distance s0 along it and
 * the sums are rounded doubles: the line is displaced, and a t misplaced along
 * it, by less than 11 roundings of |o - c|, here 16.
 */
unsigned CYLINT_BLOCK_TEST(const cylint_block *b, const double o[3],
                           const double d[3], double tmin, double tmax,
                           double least[CYLINT_BLOCK])
{
    const double dd = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if (!(dd > 0x1p-900 && dd < 0x1p900))
        return all_lanes(b, tmin, least);
    const double steps = b->per_unit, length = sqrt(dd), per_length = 1 / length;
    double from[3], along = 0, far = 0, apart = 0;
    lane_line l;
    for (int j = 0; j < 3; j++) {
        from[j] = o[j] - (double)b->center[j];
        along += from[j] * (d[j] * per_length);
        far += fabs(from[j]);
    }
    const double off = 0x1p-49 * far * steps;
    if (!(off <= OFF_LIMIT))
        return all_lanes(b, tmin, least);
    for (int j = 0; j < 3; j++) {
        const double e = d[j] * per_length;
        const double q = (from[j] - along * e) * steps;
        apart += q * q;
        l.q[j] = (float)q;
        l.e[j] = (float)e;
    }
    if (apart > NEAR_LIMIT * NEAR_LIMIT)
        return 0;
    const double spare = off + 0.125;
    l.off = cylint_float_above(off);
    l.first = clamp((tmin * length + along) * steps - spare);
    l.last = clamp((tmax * length + along) * steps + spare);
    float s[CYLINT_BLOCK];
    unsigned met = 0;
    for (int lane = 0; lane < b->used; lane += WIDTH)
        met |= test_lanes(b, lane, &l, s) << lane;
    met = (met | b->always) & ((1u << b->used) - 1);
    for (unsigned left = met; left; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        const double t = ((s[lane] - spare) / steps - along) * per_length;
        least[lane] = b->always >> lane & 1 || !(t > tmin) ? tmin : t;
    }
    return met;
}
