/*
 * leaf_test.h - which lanes of a leaf a line may hit
 *
 * The test is conservative and in floats: the line certainly does not hit the
 * slice of a rejected lane within the domain.  The origin is first moved near
 * the leaf's centre, in doubles where it is far away, so that the test is as
 * tight far from the origin as near it.
 *
 * For files that are compiled for several instruction sets.  The builds may
 * pass different lanes, but none rejects a slice that is hit.
 */
#ifndef CYLINT_BVH_LEAF_TEST_H
#define CYLINT_BVH_LEAF_TEST_H

#include "../numbers/compiler.h"
#include "float_simd.h"
#include "leaf.h"
#include "traverse.h"

/*
 * In steps relative to the leaf's centre, a lane is a cylinder with the axis p
 * to p + w and the radius r.  The line is q + s e.  With D = q - p
 *
 *   n = e x w,  f = D.n:           the line passes the axis at |f| / |n|;
 *   T = (D.w)(e.w) - (D.e) ww:     nearest at s = T / nn;
 *   C = sqrt((r^2 nn - f^2) ww):   within r of the axis for |s nn - T| <= C,
 *
 * the line hits the cylinder only if (D + s e).w is in [0, ww] and s in the
 * domain.  All is multiplied by nn, so that a line parallel to the axis needs no
 * division; there the errors below are merely larger beside nn.  With A, the axial
 * distance from the end on the line's side to the point at T, and B, how far T is
 * from the domain times nn, this is A <= |e.w| C and B <= C.  Squares are compared,
 * so that the verdict does not wait for a root.
 *
 * Errors.  u = 2^-23, of floats in any rounding mode; W >= |w|, E >= |e|, N = |n|
 * <= E W.  K bounds D.  Cylinders lie within 2^11 of the centre, as a sum of sizes
 * of components, so K also bounds s e where it matters, and r < K / 4.
 *
 *  - q, e and D are rounded, by 3 u K together, and q has an error q_error
 *    before.  Both count as a wider and longer cylinder.
 *  - The error of n is a vector of at most 2 sqrt(3) u E W,
 *    that of f is K (2 sqrt(3) u E W + 3 u N).
 *    |f| <= r N is certainly false if |f| exceeds
 *      (r + 3 u K + q_error) N + 2 sqrt(3) u (K + r) E W + 3 u K N
 *        <= r N + (k - 5 u K) E W,  k = 16 u K + q_error,
 *    and so if f^2 > g2 = r^2 nn + (2 r + k) k E^2 W^2.  The square of the
 *    bound is less than g2 by at least 10 u r K E^2 W^2 + 5 u K k E^2 W^2, more
 *    than the roundings of g2 and f^2: 8 u r^2 E^2 W^2 and 6 u of the rest.
 *    g2 serves C too: g2 - f^2 as computed >= r^2 nn - f^2 as it is, since the
 *    errors of f^2 and r^2 nn, (13 r K + 42 u K^2 + 13 r^2) u E^2 W^2 where
 *    |f| <= r N, are less than those of 32 u r K and 256 u^2 K^2.
 *  - T: the dot products have errors of 3 u of their bounds K W, E W, K E, W^2,
 *    so T one of 15 u K E W^2.  Where s is within r of the axis, n's error times
 *    K, r and T moves s nn from T + C by at most 8 u K E W^2; C has an error of
 *    2 u K E W^2; roundings from t to s, to s nn, and from T / nn to s and t
 *    are 9 u K E W^2.
 *    In all less than 3 k E W^2.
 *  - The squares of A and B and the products beside them are rounded by less than
 *    2^-17 together, and C^2 is computed 2^-16 of it larger.  A number that
 *    overflows is infinite, and then the greater side is infinite.
 *  - (D.w) nn + (e.w) s nn: 13 u K E^2 W^3 for the products, 31 from T, and
 *    (3 u K + q_error) W nn for the longer ends: in all less than 4 k E^2 W^3.
 *  - If the line is within r of the axis before it passes the end of the
 *    cylinder on its side, it enters there, at s nn = T - A / |e.w|.  Where that
 *    matters, |s nn - T| < K E W^2 / 2, so the error of e.w adds 1.5 u K E^2 W^3
 *    to A, and two sums add 4: with the 47 above still less than 4 k E^2 W^3.
 *    The quotient, the difference and the reciprocal of nn round by 4 u K E W^2,
 *    which with the 34 above is still less than 3 k E W^2.
 *
 * A capsule with the same axis and radius: where the line passes the axis nearest
 * beyond an end, at A / (|w| nn) from it along the axis, its distance from the
 * end is not more than r only if
 *
 *   A <= |e| |w| C,  that is  A^2 <= ee ww C^2,
 *
 * in place of A <= |e.w| C, and the ends are not longer.  The line enters where it
 * is within r of the axis, and not before the plane that is r beyond the end on its
 * side.
 *
 * These errors are not small beside W^2 nn and W^3 nn for lines nearly parallel
 * to the axis.  A number flushed to zero is less than k E W, since W >= 1 in
 * every lane and E and K are limited below.
 */
typedef struct {
    vf q[3], e[3], E, k, first, last;
    vf t_per_s;
} leaf_line;

/* The bound of a slice. */
typedef enum { LEAF_CYLINDER, LEAF_CAPSULE } leaf_bound;

static inline vf f_dot(const vf x[3], const vf y[3])
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

/* WIDTH lanes of a leaf, unpacked. */
typedef struct {
    vf p[3], w[3], W, ww, r;
} cylinders;

CYLINT_INLINE cylinders cylinders_of(const cylint_leaf *b, int from)
{
    cylinders s;
    const vi base = i_load(b->p[0] + from), top = i_load(b->p[1] + from);
    EACH(j, 3) {
        s.p[j] = steps_of(base, j);
        s.w[j] = steps_of(top, j) - s.p[j];
    }
    s.W = f_abs(s.w[0]) + f_abs(s.w[1]) + f_abs(s.w[2]);
    s.ww = f_dot(s.w, s.w);
    s.r = f_from_bits(i_load_shorts(b->r + from), CYLINT_LEAF_R_MASK);
    return s;
}

/*
 * The lanes from `lane` on whose middle, at p + w / 2, the line passes at no more
 * than r plus half of the axis across e, |n| / (2 |e|): for lines nearly parallel
 * to the axis.  The error of (D - w / 2) x e is at most k E, those of n and of the
 * roundings, too.  All is computed again, so that callers keep their registers.
 */
ASIDE unsigned near_middle(const cylint_leaf *b, int lane, const leaf_line *l)
{
    const cylinders s = cylinders_of(b, lane);
    const vf *const e = l->e, half = f_set(0.5f);
    vf M[3], n[3], c[3];
    EACH(j, 3)
        M[j] = f_mad(s.w[j], -half, l->q[j] - s.p[j]);
    EACH(j, 3) {
        const int k = (j + 1) % 3, m = (j + 2) % 3;
        n[j] = f_mad(e[k], s.w[m], -(e[m] * s.w[k]));
        c[j] = f_mad(M[k], e[m], -(M[m] * e[k]));
    }
    const vf most =
        f_mad(s.r, f_sqrt(f_dot(e, e)), f_sqrt(f_dot(n, n)) * half) +
        f_set(3) * l->k * l->E;
    return f_not_greater(f_dot(c, c), most * most);
}

/*
 * Returns the lanes (bits) that the line may hit.  least[] of a lane, unless least
 * is NULL, is a lower bound of s times t_per_s.  *certain, unless certain is NULL:
 * the lanes where the line's point nearest to the axis certainly lies in the domain
 * and, if the slice belongs to a cylinder, in the slice.
 *
 * In the notation of leaf.c: r <= across + 1 + 2 e - 7/8, and the axes are less
 * than e < 15/8 apart, so a point within r - 5 of the rounded axis is in the
 * cylinder.  g is less than 3 e + 4 + 2 sqrt(e r) < 25 + r / 8, so a point that
 * far from the ends of the rounded axis is between the ends of the slice.  The
 * errors are those above, subtracted instead of added.
 */
CYLINT_INLINE unsigned test_lanes(const cylinders *s, const cylint_leaf *b,
                                  int lane, const leaf_line *l, float *least,
                                  unsigned *certain, leaf_bound bound)
{
    const vf *const e = l->e;
    vf D[3], n[3];
    EACH(j, 3) {
        const int k = (j + 1) % 3, m = (j + 2) % 3;
        D[j] = l->q[j] - s->p[j];
        n[j] = f_mad(e[k], s->w[m], -(e[m] * s->w[k]));
    }
    const vf r = s->r, ww = s->ww;
    const vf nn = f_dot(n, n), f = f_dot(D, n), ff = f * f;
    const vf EW = l->E * s->W;
    const vf kEW = l->k * EW;
    const vf gg = f_mad(r * r, nn, (r + r + l->k) * (kEW * EW));
    unsigned hit = f_not_greater(ff, gg);
    if (hit & greater(gg, (r + r) * r * nn)) {
        const leaf_line copy = *l; /* so that *l stays in registers */
        hit &= near_middle(b, lane, &copy);
    }
    const vf Dw = f_dot(D, s->w), ew = f_dot(e, s->w);
    const vf T = f_mad(Dw, ew, -(f_dot(D, e) * ww));
    const vf CC = (gg - ff) * (ww * f_set(1 + 0x1p-16f)), zero = f_set(0);
    const vf middle = ww * nn * f_set(0.5f), kEWW = kEW * s->W;
    const vf offset_error = kEWW * EW * f_set(4), T_error = kEWW * f_set(3);
    const vf offset = f_mad(Dw, nn, ew * T) - middle, distance = f_abs(offset);
    vf beyond = middle + offset_error; /* the end on the line's side */
    const vf A = f_higher(distance - beyond, zero);
    const vf after = (T - T_error) - l->last * nn;
    const vf before = l->first * nn - (T + T_error);
    const vf B = f_higher(after, f_higher(before, zero));
    const vf slope2 = bound == LEAF_CAPSULE ? f_dot(e, e) * ww : ew * ew;
    hit &= f_not_greater(A * A, slope2 * CC) & f_not_greater(B * B, CC);
    if (bound == LEAF_CAPSULE)
        beyond = f_mad(r * s->W, nn, beyond);
    if (certain) {
        const vf ri = r - f_set(5);
        const vf gi = f_mad(ri * ri, nn, -((ri + ri + l->k) * (kEW * EW)));
        const vf inset = f_mad(r, f_set(0.125f), f_set(25)) * (s->W * nn);
        *certain = greater(ri, f_set(0)) & greater(gi, ff) &
                   greater(middle - inset - offset_error, distance) &
                   greater(T - T_error, l->first * nn) &
                   greater(l->last * nn, T + T_error);
    }
    if (!hit || !least)
        return hit;
    const vf reach = T_error + f_sqrt(CC);
    /* entry_shift is infinite or NaN where e.w is 0: f_higher() ignores it */
    const vf per_nn = f_set(1) / nn, per_ew = f_set(1) / f_abs(ew);
    const vf entry_shift = (f_flipped(offset, ew) + beyond) * per_ew;
    const vf first_s = f_higher(T - T_error - entry_shift, T - reach);
    f_store(least, first_s * (per_nn * l->t_per_s));
    return hit & f_not_greater(first_s, l->last * nn);
}

static inline unsigned lanes_in_use(const cylint_leaf *b)
{
    return (1u << cylint_leaf_used(b)) - 1;
}

/* all: the unpacked cylinders of all lanes, or NULL to unpack them here. */
CYLINT_INLINE unsigned test_bounds(const cylint_leaf *b, const cylinders *all,
                                   const leaf_line *l, float *least,
                                   unsigned *certain, leaf_bound bound)
{
    unsigned hit = 0, all_certain = 0;
    int lane = 0;
    do {
        unsigned some = 0;
        const cylinders here = all ? all[lane / WIDTH] : cylinders_of(b, lane);
        hit |= test_lanes(&here, b, lane, l, least ? least + lane : NULL,
                          certain ? &some : NULL, bound)
               << lane;
        all_certain |= some << lane;
        lane += WIDTH;
    } while (lane < CYLINT_LEAF_SIZE && lane < cylint_leaf_used(b));
    hit = (hit | b->always) & lanes_in_use(b);
    if (certain)
        *certain = all_certain & hit & ~(unsigned)b->always;
    return hit;
}

/* least[] of a lane without a cylinder is -infinity. */
CYLINT_INLINE unsigned test_cylinders(const cylint_leaf *b,
                                      const cylinders *all, const leaf_line *l,
                                      float *least, unsigned *certain)
{
    const unsigned hit =
        b->used & CYLINT_LEAF_ROUND
            ? test_bounds(b, all, l, least, certain, LEAF_CAPSULE)
            : test_bounds(b, all, l, least, certain, LEAF_CYLINDER);
    EACH_BIT(lane, least ? hit & b->always : 0)
        least[lane] = -HUGE_VALF;
    return hit;
}

/* Floats are accurate enough for origins up to FAR_LIMIT steps away and E and
 * 1 / E up to E_LIMIT. */
#define FAR_LIMIT 0x1p18f
#define E_LIMIT 0x1p10f
#define CYLINDER_REACH 0x1p11f

/* Whether floats are accurate enough for a ray's direction of this size. */
static inline int is_fit(float E)
{
    return (E > 1 / E_LIMIT) & (E < E_LIMIT);
}

/* ----------------------------------------------------------------- lines -- */

/* The largest error of q for which the test is of use. */
#define Q_ERROR_LIMIT 64.0

/* s, or a bound that is farther away than all cylinders. */
static inline float clamped(double s)
{
    const double most = 0x1p13;
    return (float)(s < -most ? -most : s > most ? most : s);
}

/*
 * Moves the line's origin to its point nearest to the leaf's centre, in doubles,
 * and makes e a unit vector.  o - c, the unit vector, the distance along it and
 * the sums are rounded: this moves the line, and a t along it, by less than 11
 * roundings of |o - c|; q_error allows 16.  If q is still far, the line misses:
 * a sum of sizes of components is at most sqrt(3) times the length.  d is such
 * (traverse.h) that squares do not over- or underflow.
 */
ASIDE unsigned test_far_line(const cylint_leaf *b, const cylint_bvh_line *line,
                             float *least)
{
    const double *const o = line->o, *const d = line->d;
    const double steps = cylint_leaf_steps(b), length = sqrt(cylint_dot(d, d));
    const double per_length = 1 / length;
    double from[3], along = 0, far = 0, apart = 0;
    leaf_line l;
    l.E = f_set(2);
    l.t_per_s = f_set((float)(1 / steps));
    for (int j = 0; j < 3; j++) {
        from[j] = o[j] - (double)b->center[j];
        along += from[j] * (d[j] * per_length);
        far += fabs(from[j]);
    }
    const double q_error = 0x1p-48 * far * steps;
    if (!(q_error <= Q_ERROR_LIMIT)) {
        for (int lane = 0; least && lane < CYLINT_LEAF_SIZE; lane++)
            least[lane] = -HUGE_VALF;
        return lanes_in_use(b);
    }
    for (int j = 0; j < 3; j++) {
        const double e = d[j] * per_length;
        const double q = (from[j] - along * e) * steps;
        apart += fabs(q);
        l.q[j] = f_set((float)q);
        l.e[j] = f_set((float)e);
    }
    if (apart > (double)CYLINDER_REACH + 2 * Q_ERROR_LIMIT)
        return 0;
    l.k = f_set(cylint_float_above((apart + (double)CYLINDER_REACH) * 0x1p-19 +
                                   q_error));
    l.first = f_set(clamped((line->tmin * length + along) * steps - q_error));
    l.last = f_set(clamped((line->tmax * length + along) * steps + q_error));
    const unsigned hit = test_cylinders(b, NULL, &l, least, NULL);
    EACH_BIT(lane, least ? hit : 0)
        least[lane] = cylint_float_below(
            ((double)least[lane] - (along + q_error / steps)) * per_length);
    return hit;
}

/* The direction of a line in floats.  E: the sum of the sizes of its components. */
typedef struct {
    float d[3], E;
} float_direction;

static inline float_direction float_direction_of(const cylint_bvh_line *line)
{
    float_direction to = {.E = 0};
    EACH(j, 3) {
        to.d[j] = (float)line->d[j];
        to.E += fabsf(to.d[j]);
    }
    return to;
}

/* all: the leaf's cylinders, or NULL.  along: the direction of the line.  least may
 * be NULL.  certain: NULL, or 0 before and then as in test_lanes().  Near the leaf
 * floats are accurate enough: q, e, tmin and tmax are rounded once, which the
 * errors above contain. */
CYLINT_INLINE unsigned test_line(const cylint_leaf *b, const cylinders *all,
                                 const cylint_bvh_line *line,
                                 const float_direction *along, float *least,
                                 unsigned *certain)
{
    const double steps = cylint_leaf_steps(b);
    leaf_line l;
    float q[3];
    EACH(j, 3) {
        q[j] = (float)((line->o[j] - (double)b->center[j]) * steps);
        l.q[j] = f_set(q[j]);
        l.e[j] = f_set(along->d[j]);
    }
    const float far = (fabsf(q[0]) + fabsf(q[1])) + fabsf(q[2]);
    if (!(is_fit(along->E) & (far < FAR_LIMIT)))
        return test_far_line(b, line, least);
    l.E = f_set(along->E);
    l.k = f_set((far + CYLINDER_REACH) * 0x1p-19f);
    l.first = f_set((float)(line->tmin * steps));
    l.last = f_set((float)(line->tmax * steps));
    l.t_per_s = f_set((float)(1 / steps));
    return test_cylinders(b, all, &l, least, certain);
}

#endif
