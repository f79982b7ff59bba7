/*
 * leaf_test.h - which lanes of a block a line may meet
 *
 * A block answers in floats, conservatively: a lane is left out only if the
 * line certainly does not meet its piece within the domain.  What comes from
 * far is moved to the block's centre in doubles, so a block is as discerning
 * far from the origin as near it.
 *
 * For traverse.c, which is compiled for several instruction sets: they may differ
 * in what they let through, not in what they owe.
 */
#ifndef CYLINT_BVH_LEAF_TEST_H
#define CYLINT_BVH_LEAF_TEST_H

#include "../numbers/compiler.h"
#include "leaf.h"
#include "../numbers/float_simd.h"
#include "traverse.h"

/*
 * In steps around the block's centre a lane is a cylinder: axis p to p + w,
 * radius r.  The line is q + s e.  With D = q - p
 *
 *   n = e x w,  f = D.n:           the line passes the axis at |f| / |n|;
 *   T = (D.w)(e.w) - (D.e) ww:     nearest at s = T / nn;
 *   C = sqrt((r^2 nn - f^2) ww):   within r of the axis for |s nn - T| <= C,
 *
 * where (D + s e).w must come into [0, ww], and s into the domain.  All is
 * multiplied by nn, so that a line along the axis needs no division; it only
 * makes the errors weigh more.
 *
 * Errors.  u = 2^-24; W >= |w|, E >= |e|, N = |n| <= E W.  K bounds D and, as
 * pieces lie within 2^11 of the centre, counting sizes of components, r < K / 4
 * and s e where it counts.
 *
 *  - q, e and D are rounded, by 3 u K in all: a wider and longer lane.  So it
 *    is by `off`, what q is off before.
 *  - n is wrong by a vector of at most 2 sqrt(3) u E W,
 *    f by K (2 sqrt(3) u E W + 3 u N).
 *    |f| <= r N is certainly false if more than
 *      (r + 3 u K + off) N + 2 sqrt(3) u (K + r) E W + 3 u K N
 *        <= r N + (k - 5 u K) E W,  k = 16 u K + off,
 *    and so if f^2 > g2 = r^2 nn + (2 r + k) k E^2 W^2: the square of the
 *    former is less by 10 u r K E^2 W^2 at least, and by 5 u K k E^2 W^2,
 *    which is more than g2 and f^2 round by: 8 u r^2 E^2 W^2 and 6 u of the
 *    rest.  g2 serves C too: g2 - f^2 >= r^2 nn - f^2 with what f is, as what
 *    f^2 and r^2 nn are wrong by, (13 r K + 42 u K^2 + 13 r^2) u E^2 W^2 where
 *    |f| <= r N, is less than 32 u r K and 256 u^2 K^2.
 *  - T: the dot products are wrong by 3 u of their bounds K W, E W, K E, W^2,
 *    so T by 15 u K E W^2; where s is within r of the axis, s nn differs from
 *    T + C by what n's error makes of K, r and T, 8 u K E W^2 at most, C is
 *    wrong by 2 u K E W^2, and rounding t to s, s nn and T / nn to s to t
 *    takes 9 u K E W^2.
 *    In all less than 3 k E W^2.
 *  - (D.w) nn + (e.w) s nn: 13 u K E^2 W^3 for the products, 31 from T, and
 *    the longer ends, (3 u K + off) W nn: in all less than 4 k E^2 W^3.
 *  - A line that comes to be within r of the axis before the end of the lane it
 *    comes by enters there, at s nn = T - A / |e.w|, A being the axial
 *    coordinate at T from that end on.  Where that counts, |s nn - T| < K E W^2
 *    / 2, so the error of e.w makes 1.5 u K E^2 W^3 of A, and two sums make 4:
 *    with the 47 above still less than 4 k E^2 W^3.  The quotient, the
 *    difference and a reciprocal of nn instead of a quotient round by 4 u K E
 *    W^2, which with the 34 above is still less than 3 k E W^2.
 *
 * All are not small beside W^2 nn and W^3 nn when the line is nearly along
 * the axis.  What is flushed to zero instead of being subnormal disappears in
 * k E W, as every lane has W >= 1, and E and K are limited below.
 */
typedef struct {
    vf q[3], e[3], E, k, first, last;
    vf t_per_s;
} lane_line;

static inline vf dot(const vf x[3], const vf y[3])
{
    return f_mad(x[0], y[0], f_mad(x[1], y[1], x[2] * y[2]));
}

static inline vf steps_of(vi p, int j)
{
    return f_from_bits(i_right(p, j * CYLINT_LEAF_P_BITS), CYLINT_LEAF_P_MASK) -
           f_set(CYLINT_LEAF_MIDDLE);
}

static inline unsigned greater(vf x, vf y)
{
    return ~f_not_greater(x, y) & ((1u << WIDTH) - 1);
}

/* WIDTH of a block's lanes, from a multiple of that on: all but the line. */
typedef struct {
    vf p[3], w[3], W, ww, r;
} pieces;

CYLINT_INLINE pieces pieces_of(const cylint_leaf *b, int from)
{
    pieces s;
    const vi base = i_load(b->p[0] + from), top = i_load(b->p[1] + from);
    EACH(j, 3) {
        s.p[j] = steps_of(base, j);
        s.w[j] = steps_of(top, j) - s.p[j];
    }
    s.W = f_abs(s.w[0]) + f_abs(s.w[1]) + f_abs(s.w[2]);
    s.ww = dot(s.w, s.w);
    s.r = f_from_bits(i_load_shorts(b->r + from), CYLINT_LEAF_R_MASK);
    return s;
}

/*
 * Those that the line may meet.  least[] of each is at most what s is there,
 * times t_per_s.  *sure, unless NULL: the lanes of which the line's point
 * nearest to the axis is certainly within the piece, if that is a cylinder, and
 * in the domain.
 *
 * In leaf.c's words: r <= across + 1 + 2 e - 7/8 and the axes are less than e
 * apart, e < 15/8, so that what is within r - 5 of the rounded one is in the
 * cylinder; and what is 3 e + 4 + 2 sqrt(e r) < 25 + r / 8 from the ends of the
 * lane, of which g was added, is between those of the piece.  Errors are those
 * above, from the other side.
 */
CYLINT_INLINE unsigned test_lanes(const pieces *s, const lane_line *l,
                                  float *least, unsigned *sure)
{
    const vf *const e = l->e;
    vf D[3], n[3];
    EACH(j, 3) {
        const int k = (j + 1) % 3, m = (j + 2) % 3;
        D[j] = l->q[j] - s->p[j];
        n[j] = f_mad(e[k], s->w[m], -(e[m] * s->w[k]));
    }
    const vf r = s->r, ww = s->ww;
    const vf nn = dot(n, n), f = dot(D, n), ff = f * f;
    const vf EW = l->E * s->W;
    const vf kEW = l->k * EW;
    const vf gg = f_mad(r * r, nn, (r + r + l->k) * (kEW * EW));
    unsigned met = f_not_greater(ff, gg);
    const vf Dw = dot(D, s->w), ew = dot(e, s->w);
    const vf T = f_mad(Dw, ew, -(dot(D, e) * ww));
    const vf C = f_sqrt((gg - ff) * ww);
    const vf middle = ww * nn * f_set(0.5f), kEWW = kEW * s->W;
    const vf off = kEWW * EW * f_set(4), spare = kEWW * f_set(3);
    const vf above = f_mad(Dw, nn, ew * T) - middle, foot = f_abs(above);
    met &= f_not_greater(foot, middle + f_mad(f_abs(ew), C, off));
    if (sure) {
        const vf ri = r - f_set(5);
        const vf gi = f_mad(ri * ri, nn, -((ri + ri + l->k) * (kEW * EW)));
        const vf inset = f_mad(r, f_set(0.125f), f_set(25)) * (s->W * nn);
        *sure = greater(ri, f_set(0)) & greater(gi, ff) &
                greater(middle - inset - off, foot) &
                greater(T - spare, l->first * nn) &
                greater(l->last * nn, T + spare);
    }
    const vf reach = spare + C;
    met &= f_not_greater(T - reach, l->last * nn);
    met &= f_not_greater(l->first * nn, T + reach);
    if (!met)
        return 0;
    /* none where e.w is 0 */
    const vf per_nn = f_set(1) / nn, per_ew = f_set(1) / f_abs(ew);
    const vf past_cap = (f_turned(above, ew) + middle + off) * per_ew;
    const vf begin = f_higher(T - spare - past_cap, T - reach);
    f_store(least, begin * (per_nn * l->t_per_s));
    return met & f_not_greater(begin, l->last * nn);
}

static inline unsigned lanes_in_use(const cylint_leaf *b)
{
    return (1u << cylint_leaf_used(b)) - 1;
}

#ifdef CYLINT_COUNT_VISITS
static inline int count_lanes(unsigned lanes)
{
    int n = 0;
    for (; lanes; lanes &= lanes - 1)
        n++;
    return n;
}
#endif

/* all: the pieces of all lanes, or NULL: they are not made yet. */
CYLINT_INLINE unsigned test(const cylint_leaf *b, const pieces *all,
                            const lane_line *l, float *least, unsigned *sure)
{
    unsigned met = 0, all_sure = 0;
    int lane = 0;
    do { /* more than once only where WIDTH asks for it */
        unsigned some = 0;
        const pieces here = all ? all[lane / WIDTH] : pieces_of(b, lane);
        met |= test_lanes(&here, l, least + lane, sure ? &some : NULL) << lane;
        all_sure |= some << lane;
        lane += WIDTH;
    } while (lane < CYLINT_LEAF_SIZE && lane < cylint_leaf_used(b));
    met = (met | b->always) & lanes_in_use(b);
    if (sure)
        *sure = all_sure & met & ~(unsigned)b->always;
    cylint_visited(lanes, (unsigned)count_lanes(met));
    return met;
}

/* How far a line may begin, in steps, and its E, for floats to be of use. */
#define FAR_LIMIT 0x1p18f
#define E_LIMIT 0x1p10f
#define REACH_OF_PIECES 0x1p11f

/* ------------------------------------------------------- from far: lines -- */

static inline unsigned all_lanes(const cylint_leaf *b, double tmin,
                                 double *least)
{
    for (int lane = 0; lane < cylint_leaf_used(b); lane++)
        least[lane] = tmin;
    return lanes_in_use(b);
}

/* All that q may be off, beyond which floats are of no use. */
#define OFF_LIMIT 64.0

/* Farther than pieces are, but for what rounding adds. */
static inline float clamp(double s)
{
    const double most = 0x1p13;
    return (float)(s < -most ? -most : s > most ? most : s);
}

/*
 * The line is moved to its point nearest to the block's centre, in doubles,
 * e being of unit length.  o - c, the unit vector, the distance along it and
 * the sums are rounded: the line is displaced, and a t misplaced along it, by
 * less than 11 roundings of |o - c|, here 16.  Should q still be far, the line
 * misses: sizes of components are at most sqrt(3) of lengths.
 */
static inline unsigned test_line(const cylint_leaf *b, const double o[3],
                                 const double d[3], double tmin, double tmax,
                                 double least[CYLINT_LEAF_SIZE])
{
    const double dd = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if (!(dd > 0x1p-900 && dd < 0x1p900))
        return all_lanes(b, tmin, least);
    const double steps = cylint_leaf_steps(b), length = sqrt(dd);
    const double per_length = 1 / length;
    double from[3], along = 0, far = 0, apart = 0;
    lane_line l;
    l.E = f_set(2);
    l.t_per_s = f_set(1);
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
        apart += fabs(q);
        l.q[j] = f_set((float)q);
        l.e[j] = f_set((float)e);
    }
    if (apart > (double)REACH_OF_PIECES + 2 * OFF_LIMIT)
        return 0;
    l.k = f_set(
        cylint_float_above((apart + (double)REACH_OF_PIECES) * 0x1p-20 + off));
    l.first = f_set(clamp((tmin * length + along) * steps - off));
    l.last = f_set(clamp((tmax * length + along) * steps + off));
    float s[CYLINT_LEAF_SIZE] = {0};
    const unsigned met = test(b, NULL, &l, s, NULL);
    for (unsigned lanes = met; lanes; lanes &= lanes - 1) {
        const int lane = cylint_lowest(lanes);
        least[lane] = tmin;
        if (b->always >> lane & 1)
            continue;
        const double t = (((double)s[lane] - off) / steps - along) * per_length;
        least[lane] = t > tmin ? t : tmin;
    }
    return met;
}

/* ------------------------------------------------------- from near: rays -- */

ASIDE unsigned test_far_ray(const cylint_leaf *b, const cylint_float_ray *ray,
                            float least[CYLINT_LEAF_SIZE])
{
    const double o[3] = {ray->o[0], ray->o[1], ray->o[2]};
    const double d[3] = {ray->d[0], ray->d[1], ray->d[2]};
    double t[CYLINT_LEAF_SIZE];
    const unsigned met = test_line(b, o, d, ray->tnear, ray->tfar, t);
    for (int lane = 0; lane < cylint_leaf_used(b); lane++)
        if (met >> lane & 1)
            least[lane] = cylint_float_below(t[lane]);
    return met;
}

static inline float size_of(const cylint_float_ray *ray)
{
    return fabsf(ray->d[0]) + fabsf(ray->d[1]) + fabsf(ray->d[2]);
}

/* Rays, in lanes, or the same one in all lanes; E is size_of() it. */
typedef struct {
    vf o[3], d[3], tnear, tfar, E;
} ray_lanes;

/* Whether a ray's direction has a size of which floats are of use. */
static inline int is_fit(float E)
{
    return (E > 1 / E_LIMIT) & (E < E_LIMIT);
}

/* The ray as it is: e = d, q = (o - c) steps, s = t times steps.  That is of
 * use if the ray is fit and what is returned less than FAR_LIMIT. */
CYLINT_INLINE vf aim(const cylint_leaf *b, const ray_lanes *r, lane_line *l)
{
    const float per_unit = cylint_leaf_steps(b);
    const vf steps = f_set(per_unit);
    EACH(j, 3) {
        l->q[j] = (r->o[j] - f_set(b->center[j])) * steps;
        l->e[j] = r->d[j];
    }
    const vf far = f_abs(l->q[0]) + f_abs(l->q[1]) + f_abs(l->q[2]);
    l->E = r->E;
    l->k = (far + f_set(REACH_OF_PIECES)) * f_set(0x1p-20f);
    l->first = r->tnear * steps;
    l->last = r->tfar * steps;
    l->t_per_s = f_set(1 / per_unit);
    return far;
}

CYLINT_INLINE unsigned test_near_ray(const cylint_leaf *b, const pieces *all,
                                     const lane_line *l,
                                     float least[CYLINT_LEAF_SIZE],
                                     unsigned *sure)
{
    const unsigned met = test(b, all, l, least, sure);
    for (unsigned lanes = met & b->always; lanes; lanes &= lanes - 1)
        least[cylint_lowest(lanes)] = -HUGE_VALF;
    return met;
}

/* sure: NULL, or as in test_lanes().  E: size_of() the ray. */
CYLINT_INLINE unsigned test_ray(const cylint_leaf *b,
                                const cylint_float_ray *ray, float E,
                                float least[CYLINT_LEAF_SIZE], unsigned *sure)
{
    const ray_lanes r = {{f_set(ray->o[0]), f_set(ray->o[1]), f_set(ray->o[2])},
                         {f_set(ray->d[0]), f_set(ray->d[1]), f_set(ray->d[2])},
                         f_set(ray->tnear),
                         f_set(ray->tfar),
                         f_set(E)};
    lane_line l;
    const float far = f_first(aim(b, &r, &l));
    if (is_fit(E) & (far < FAR_LIMIT))
        return test_near_ray(b, NULL, &l, least, sure);
    if (sure)
        *sure = 0;
    return test_far_ray(b, ray, least);
}

#endif
