/*
 * certified_many.c - distances of many points from capped shapes, in lanes
 *
 * The formulas and bounds are those of certified_distance.c.  Every lane
 * computes all features, and masks choose.
 */
#include "certified_many.h"

#include "../numbers/double_double.h" /* before simd.h */
#include "../numbers/error_bounds.h"
#include "../numbers/simd.h"
#include "../shapes/shape_facts.h"

#ifndef CYLINT_CERTIFY_MANY
#define CYLINT_CERTIFY_MANY cylint_certify_many_plain
#endif

/* -------------------------------------------------------------- pairs -- */

INLINE vpair both(double hi, double lo)
{
    return (vpair){v_set(hi), v_set(lo)};
}

INLINE vpair times(vpair a, vpair b)
{
    const vpair p = v_two_prod(a.hi, b.hi);
    return (vpair){p.hi, v_sum_of(a.hi, b.lo, v_sum_of(a.lo, b.hi, p.lo))};
}

/* lo^2 included. */
INLINE vpair square(vpair a)
{
    const vpair p = v_two_prod(a.hi, a.hi);
    return (vpair){p.hi, v_sum_of(a.hi + a.hi + a.lo, a.lo, p.lo)};
}

INLINE vpair pick(vm m, vpair a, vpair b)
{
    return (vpair){v_select(m, a.hi, b.hi), v_select(m, a.lo, b.lo)};
}

INLINE vpair sum_of_squares(vpair x, vpair y, vpair z)
{
    const vpair a = square(x), b = square(y), c = square(z);
    const vpair s = v_two_sum(a.hi, b.hi), t = v_two_sum(s.hi, c.hi);
    return (vpair){t.hi, (s.lo + t.lo) + (a.lo + (b.lo + c.lo))};
}

/* A root and the size of its first correction relative to it. */
typedef struct {
    vpair v;
    vd half, step;
} vroot;

INLINE vroot root_of(vpair a)
{
    vroot r;
    const vd s = v_sqrt(a.hi);
    const vpair p = v_two_prod(s, s);
    r.half = v_set(0.5) / s;
    const vd step = ((a.hi - p.hi) + (a.lo - p.lo)) * r.half;
    r.v = (vpair){s, step - step * step * r.half};
    r.step = v_abs(step) * (r.half + r.half);
    return r;
}

/* --------------------------------------------------------- half plane -- */

/* The constants of the shape in all lanes. */
typedef struct {
    vpair base[3], top[3], w[3], height, cosine, sine, offset;
    vpair z[2], rho[2]; /* the ends of the lateral line */
    vd r[2], reach;
    int is_hull;
} vshape;

typedef struct {
    vpair D[3], z, dd, rho;
    vd size, error, margin;
} vplane;

/* The nearest feature so far. */
typedef struct {
    vpair d;
    vd feature, error;
    vm certain;
} vnearest;

/* A member of the shapes of all lanes. */
#define OF_LANES(to, member)                     \
    do {                                         \
        double of_lane[LANES];                   \
        for (int lane = 0; lane < LANES; lane++) \
            of_lane[lane] = at[lane]->member;    \
        (to) = v_load(of_lane);                  \
    } while (0)

INLINE void load_shapes(vshape *v, const cylint_shape *const at[LANES])
{
    const vd zero = v_set(0);
    vd reach;
    v->is_hull = cylint_is_hull(at[0]->kind);
    EACH(i, 3) {
        OF_LANES(v->base[i].hi, base[i]);
        OF_LANES(v->top[i].hi, top[i]);
        OF_LANES(v->w[i].hi, local.xyz[i][2]);
        OF_LANES(v->w[i].lo, local.xyz_lo[i][2]);
        v->base[i].lo = v->top[i].lo = zero;
    }
    OF_LANES(v->height.hi, local.height);
    OF_LANES(v->height.lo, local.height_lo);
    OF_LANES(v->cosine.hi, local.cosine);
    OF_LANES(v->cosine.lo, local.cosine_lo);
    OF_LANES(v->sine.hi, local.sine);
    OF_LANES(v->sine.lo, local.sine_lo);
    OF_LANES(v->r[0], r0);
    OF_LANES(v->r[1], r1);
    OF_LANES(reach, local.reach);
    v->reach = reach + v->r[0];
    v->z[0] = both(0, 0);
    v->z[1] = v->height;
    v->rho[0] = (vpair){v->r[0], zero};
    v->rho[1] = (vpair){v->r[1], zero};
    v->offset = v->is_hull ? v->rho[0] : times(v->cosine, v->rho[0]);
}

INLINE void load_plane(vplane *m, const vshape *s, const vd x[3])
{
    vpair sum = {v_set(0), v_set(0)};
    EACH(i, 3) {
        m->D[i] = v_two_sum(x[i], -s->base[i].hi);
        const vpair p = times(m->D[i], s->w[i]);
        sum = i ? vpair_add(sum, p) : p;
    }
    m->z = sum;
    m->dd = sum_of_squares(m->D[0], m->D[1], m->D[2]);
    const vpair zz = times(m->z, m->z);
    const vpair rr = v_fast_two_sum(m->dd.hi, -zz.hi);
    const vroot root = root_of((vpair){rr.hi, rr.lo + (m->dd.lo - zz.lo)});
    m->rho = root.v;
    m->size = v_abs(m->D[0].hi) + v_abs(m->D[1].hi) + v_abs(m->D[2].hi);
    const vd thin = m->size * root.half;
    m->error =
        v_select(v_le(thin, v_set(CYLINT_THINNEST)),
                 v_set(CYLINT_HALF_PLANE_ERROR) * (m->size * thin + s->reach),
                 v_set(HUGE_VAL));
    m->margin = v_set(CYLINT_FEATURE_MARGIN) * (m->size + s->reach) + m->error;
}

INLINE vpair from_line(const vplane *m, const vshape *s)
{
    const vpair across = times(s->cosine, m->rho);
    return vpair_sub(vpair_sub(across, times(s->sine, m->z)), s->offset);
}

/* Feet on the lateral line: before it and after it; or neither is certain. */
typedef struct {
    vm before, on, after;
} vfoot;

INLINE vfoot foot_of(const vplane *m, const vshape *s)
{
    const vd C = s->cosine.hi, S = s->sine.hi, M = m->margin;
    const vd rho = m->rho.hi + m->rho.lo;
    const vd r0 = s->is_hull ? v_set(0) : s->r[0];
    const vd r1 = s->is_hull ? v_set(0) : s->r[1];
    const vd before = C * m->z.hi + S * (rho - r0);
    const vd after = C * (m->z.hi - s->height.hi) + S * (rho - r1);
    const vm is_before = v_lt(before, -M);
    return (vfoot){is_before, m_and(v_lt(M, before), v_lt(after, -M)),
                   m_and(v_lt(M, after), m_not(is_before))};
}

/* ------------------------------------------------- a capped cylinder or cone */

/* Chooses the rim in lanes of `rims`. */
INLINE void choose_rim(vnearest *n, const vplane *m, const vshape *s, vm rims,
                       vm top)
{
    const vpair r = pick(top, s->rho[1], s->rho[0]);
    const vpair z = pick(top, s->z[1], s->z[0]);
    const vpair x = vpair_sub(m->rho, r), y = vpair_sub(m->z, z);
    const vpair a = square(x), b = square(y), t = v_two_sum(a.hi, b.hi);
    const vroot root = root_of((vpair){t.hi, t.lo + (a.lo + b.lo)});
    const vm good = v_le(root.step, v_set(CYLINT_ROOT_STEP));
    n->d = pick(rims, root.v, n->d);
    n->feature = v_select(
        rims,
        v_select(top, v_set(CYLINT_FEATURE_RIM1), v_set(CYLINT_FEATURE_RIM0)),
        n->feature);
    n->certain = m_and(n->certain, m_or(m_not(rims), good));
}

INLINE vnearest between_planes(const vplane *m, const vshape *s)
{
    const vd M = m->margin, h = s->height.hi, zero = v_set(0);
    const vd t = m->z.hi + (m->z.hi - h), rho = m->rho.hi + m->rho.lo;
    const vm top = v_lt(zero, t);
    const vpair level = pick(top, s->height, both(0, 0));
    const vd sign = v_select(top, v_set(1), v_set(-1));
    const vpair T = vpair_sub(m->z, level), A = from_line(m, s);
    const vpair B = {sign * T.hi, sign * T.lo};
    /* near the axis the low part of a root counts */
    const vd a = A.hi + A.lo, b = B.hi + B.lo;
    const vm less = v_lt(a, b);
    const vm inside = m_and(v_lt(a, -M), v_lt(b, -M));
    const vm tie = m_or(v_le(v_abs(a - b), M), m_and(less, v_le(v_abs(t), M)));
    const vm outside = m_or(v_lt(M + M, a), v_lt(M, b));
    const vd r = v_select(top, s->r[1], s->r[0]);
    const vm beyond = m_and(v_lt(M, b), v_lt(rho, r - M));
    const vm not_beyond = m_or(v_lt(b, -M), v_lt(r + M, rho));
    const vfoot foot = foot_of(m, s);
    const vm known =
        m_or(beyond,
             m_and(not_beyond, m_or(foot.on, m_or(foot.before, foot.after))));
    const vm cap = m_or(m_and(inside, less), m_and(m_not(inside), beyond));
    const vm rims =
        m_and(m_not(m_or(inside, beyond)), m_or(foot.before, foot.after));
    vnearest n;
    n.d = pick(cap, B, A);
    n.feature = v_select(
        cap,
        v_select(top, v_set(CYLINT_FEATURE_CAP1), v_set(CYLINT_FEATURE_CAP0)),
        v_set(CYLINT_FEATURE_LATERAL));
    n.error = m->error;
    n.certain = m_or(m_and(inside, m_not(tie)), m_and(outside, known));
    n.certain = m_and(n.certain, v_lt(M + M, h));
    if (m_any(rims))
        choose_rim(&n, m, s, rims, foot.after);
    return n;
}

/* ---------------------------------------------------- a hull or a sphere -- */

/* Chooses the ball in lanes of `balls`. */
INLINE void choose_ball(vnearest *n, vpair dd, vd r, vm balls, int feature)
{
    const vroot root = root_of(v_fast_two_sum(dd.hi, dd.lo));
    const vpair d = vpair_sub(root.v, (vpair){r, v_set(0)});
    n->d = pick(balls, d, n->d);
    n->feature = v_select(balls, v_set(feature), n->feature);
    n->error = v_select(balls, v_set(CYLINT_HALF_PLANE_ERROR) * (root.v.hi + r),
                        n->error);
}

INLINE vnearest of_hull(const vplane *m, const vshape *s, const vd x[3])
{
    const vfoot foot = foot_of(m, s);
    vnearest n;
    n.d = from_line(m, s);
    n.feature = v_set(CYLINT_FEATURE_LATERAL);
    n.error = m->error;
    n.certain = m_or(foot.on, m_or(foot.before, foot.after));
    if (m_any(foot.before))
        choose_ball(&n, m->dd, s->r[0], foot.before, CYLINT_FEATURE_CAP0);
    if (m_any(foot.after)) {
        vpair D[3];
        EACH(i, 3)
            D[i] = v_two_sum(x[i], -s->top[i].hi);
        choose_ball(&n, sum_of_squares(D[0], D[1], D[2]), s->r[1], foot.after,
                    CYLINT_FEATURE_CAP1);
    }
    return n;
}

INLINE vnearest of_sphere(const vshape *s, const vd x[3])
{
    const vm all = v_le(v_set(0), v_set(0));
    vnearest n = {both(0, 0), v_set(0), v_set(0), all};
    vpair D[3];
    EACH(i, 3)
        D[i] = v_two_sum(x[i], -s->base[i].hi);
    choose_ball(&n, sum_of_squares(D[0], D[1], D[2]), s->r[0], all,
                CYLINT_FEATURE_LATERAL);
    return n;
}

/* ------------------------------------------------------------- blocks -- */

/* Whether every number within the error rounds to d.hi; d becomes normal. */
INLINE vm is_certain(vnearest *n)
{
    n->d = v_fast_two_sum(n->d.hi, n->d.lo);
    const vd size = v_abs(n->d.hi);
    const vd most = n->error + v_set(CYLINT_NEAREST_MARGIN) * size;
    const vm up = v_eq(n->d.hi + (n->d.lo + most), n->d.hi);
    const vm down = v_eq(n->d.hi + (n->d.lo - most), n->d.hi);
    return m_and(m_and(n->certain, v_le(v_set(CYLINT_DISTANCE_LEAST), size)),
                 m_and(up, down));
}

INLINE vnearest nearest_of(const cylint_shape *shape, const vshape *s,
                           const vd x[3])
{
    vplane m;
    if (shape->kind == CYLINT_KIND_SPHERE)
        return of_sphere(s, x);
    load_plane(&m, s, x);
    return s->is_hull ? of_hull(&m, s, x) : between_planes(&m, s);
}

/* The points from i on, the last one again where there are no more. */
INLINE void load_points(vd x[3], const double *const xyz[3], int i, int n)
{
    EACH(k, 3) {
        double padded[LANES];
        if (i + LANES <= n) {
            x[k] = v_load(xyz[k] + i);
            continue;
        }
        for (int lane = 0; lane < LANES; lane++)
            padded[lane] = xyz[k][i + lane < n ? i + lane : n - 1];
        x[k] = v_load(padded);
    }
}

/* The shapes from i on, the last one again where there are no more.  Whether
 * the kernels serve them together. */
INLINE int find_shapes(const cylint_shape *at[LANES],
                       const cylint_shape *shapes, int i, int n)
{
    const int class_of_all = cylint_lane_class(shapes + i);
    int same = class_of_all != 0;
    for (int lane = 0; lane < LANES; lane++) {
        at[lane] = shapes + (i + lane < n ? i + lane : n - 1);
        same &= cylint_lane_class(at[lane]) == class_of_all;
    }
    return same;
}

INLINE unsigned write_lanes(vnearest *at, int i, int n, double *distance,
                            signed char *feature)
{
    double d[LANES], f[LANES];
    const unsigned certain = m_bits(is_certain(at));
    v_store(d, at->d.hi);
    v_store(f, at->feature);
    for (int lane = 0; lane < LANES && i + lane < n; lane++) {
        distance[i + lane] = d[lane];
        feature[i + lane] = (signed char)f[lane];
    }
    return certain;
}

int CYLINT_CERTIFY_MANY(const cylint_shape *shapes, int each,
                        const double *const xyz[3], int n, double *distance,
                        signed char *feature, int *rest)
{
    const cylint_shape *at[LANES];
    vshape s;
    int left = 0;
    for (int i = 0; i < n; i += LANES) {
        vd x[3];
        unsigned certain = 0;
        const int served = !each || find_shapes(at, shapes, i, n);
        if (!each && i == 0)
            for (int lane = 0; lane < LANES; lane++)
                at[lane] = shapes;
        if (served) {
            if (each || i == 0)
                load_shapes(&s, at);
            load_points(x, xyz, i, n);
            vnearest nearest = nearest_of(at[0], &s, x);
            certain = write_lanes(&nearest, i, n, distance, feature);
        }
        for (int lane = 0; lane < LANES && i + lane < n; lane++) {
            rest[left] = i + lane;
            left += !(certain >> lane & 1);
        }
    }
    return left;
}
