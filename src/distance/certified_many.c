/*
 * certified_many.c - distances of many points from capped shapes, in lanes
 *
 * The formulas and bounds are those of limbs.h and limb_distance.c.  Every lane
 * computes all features, and masks choose.
 */
#include "certified_many.h"

#include "../numbers/double_double.h" /* before simd.h */
#include "../numbers/simd.h"
#include "../shapes/shape_facts.h"
#include "error_bounds.h"

#ifndef CYLINT_CERTIFY_MANY
#define CYLINT_CERTIFY_MANY cylint_certify_many_plain
#endif

/* -------------------------------------------------------------- limbs -- */

typedef vpair vlimbs;

INLINE vd sum_of_limbs(vlimbs a)
{
    return a.hi + a.lo;
}

INLINE vlimbs split(vd x, vd snap)
{
    const vd hi = (x + snap) - snap;
    return (vlimbs){hi, x - hi};
}

INLINE vlimbs limbs_sub(vlimbs a, vlimbs b)
{
    return (vlimbs){a.hi - b.hi, a.lo - b.lo};
}

INLINE vlimbs pick(vm m, vlimbs a, vlimbs b)
{
    return (vlimbs){v_select(m, a.hi, b.hi), v_select(m, a.lo, b.lo)};
}

/* a + x^2; x2: x rounded to doubles. */
INLINE vlimbs plus_square(vlimbs a, vlimbs x, vd x2)
{
    return (vlimbs){v_sum_of(x.hi, x.hi, a.hi),
                    v_sum_of(x.lo, x2 + x.hi, a.lo)};
}

INLINE vlimbs minus_square(vlimbs a, vlimbs x, vd x2)
{
    return (vlimbs){v_sum_of(-x.hi, x.hi, a.hi),
                    v_sum_of(-x.lo, x2 + x.hi, a.lo)};
}

/* --------------------------------------------------------- half plane -- */

/* The constants of the shape in all lanes. */
typedef struct {
    vlimbs unit[3], turn[2]; /* the direction of the axis; cosine, sine */
    vd base[3], height, height_lo, cosine, sine, r[2], reach;
} vshape;

typedef struct {
    vlimbs z, square, above; /* above: z - height */
    vd size, snap;
} vplane;

/* The distance, rounded with the error subtracted and added. */
typedef struct {
    vd low, high;
} vrounded;

typedef struct {
    vrounded d;
    vd feature; /* if wanted */
    vm known;
} vnearest;

/* A number of the shapes of all lanes. */
INLINE vd of_lanes(const cylint_shape *const at[LANES], int number)
{
    double of_lane[LANES];
    for (int lane = 0; lane < LANES; lane++)
        of_lane[lane] = at[lane]->library.number[number];
    return v_load(of_lane);
}

/* Of size 1 at most: as a multiple of 2^-26, and the rest. */
INLINE vlimbs unit_of_lanes(const cylint_shape *const at[LANES], int number)
{
    const vlimbs x = split(of_lanes(at, number), v_set(CYLINT_UNIT_SNAP));
    return (vlimbs){x.hi, x.lo + of_lanes(at, number + CYLINT_LOW)};
}

INLINE void load_shapes(vshape *v, const cylint_shape *const at[LANES])
{
    EACH(i, 3) {
        v->base[i] = of_lanes(at, CYLINT_AT_BASE + i);
        v->unit[i] = unit_of_lanes(at, CYLINT_AT_COLUMNS + 3 * i + 2);
    }
    v->turn[0] = unit_of_lanes(at, CYLINT_AT_COSINE);
    v->turn[1] = unit_of_lanes(at, CYLINT_AT_SINE);
    v->height = of_lanes(at, CYLINT_AT_HEIGHT);
    v->height_lo = of_lanes(at, CYLINT_AT_HEIGHT + CYLINT_LOW);
    v->cosine = of_lanes(at, CYLINT_AT_COSINE);
    v->sine = of_lanes(at, CYLINT_AT_SINE);
    v->r[0] = of_lanes(at, CYLINT_AT_R0);
    v->r[1] = of_lanes(at, CYLINT_AT_R1);
    v->reach = of_lanes(at, CYLINT_AT_REACH);
}

INLINE void load_plane(vplane *m, const vshape *s, const vd x[3], int axial)
{
    const vd zero = v_set(0);
    vpair D[3];
    m->size = s->reach;
    EACH(i, 3) {
        D[i] = v_two_sum(x[i], -s->base[i]);
        m->size = m->size + v_abs(D[i].hi);
    }
    m->snap = v_set(CYLINT_LIMB_SNAP) * m->size;
    m->z = m->square = (vlimbs){zero, zero};
    EACH(i, 3) {
        const vd hi = (D[i].hi + m->snap) - m->snap;
        const vd lo = (D[i].hi - hi) + D[i].lo;
        m->square.hi = v_sum_of(hi, hi, m->square.hi);
        m->square.lo = v_sum_of(lo, D[i].hi + hi, m->square.lo);
        m->z.hi = v_sum_of(hi, s->unit[i].hi, m->z.hi);
        m->z.lo = v_sum_of(lo, s->unit[i].hi,
                           v_sum_of(D[i].hi, s->unit[i].lo, m->z.lo));
    }
    if (!axial)
        return;
    const vlimbs z = split(sum_of_limbs(m->z), m->snap);
    m->z = (vlimbs){z.hi, (m->z.hi - z.hi) + m->z.lo};
    vlimbs h = split(s->height, m->snap);
    h.lo = h.lo + s->height_lo;
    m->above = limbs_sub(m->z, h);
}

/* sqrt(a); adds its error to *error. */
INLINE vlimbs root_of(vlimbs a, const vplane *m, vd *error)
{
    const vd s = v_sqrt(sum_of_limbs(a)), half = v_set(0.5) / s;
    const vlimbs root = split(s, m->snap);
    const vd rest = sum_of_limbs(minus_square(a, root, s));
    const vd unit = v_set(CYLINT_LIMB_ERROR) * m->size;
    const vd thin = m->size * half;
    *error = *error + v_select(v_le(thin, v_set(CYLINT_LIMB_THINNEST)),
                               v_sum_of(unit, thin, unit), v_set(HUGE_VAL));
    return (vlimbs){root.hi, v_sum_of(rest, half, root.lo)};
}

INLINE vlimbs square_across(const vplane *m)
{
    return minus_square(m->square, m->z, sum_of_limbs(m->z));
}

/* cosine x - sine z. */
INLINE vlimbs turned(const vshape *s, const vplane *m, vlimbs x)
{
    const vd C = s->turn[0].hi, S = s->turn[1].hi;
    const vd across = v_sum_of(C, x.lo, s->turn[0].lo * sum_of_limbs(x));
    const vd along = v_sum_of(S, m->z.lo, s->turn[1].lo * sum_of_limbs(m->z));
    return (vlimbs){v_sum_of(C, x.hi, -(S * m->z.hi)), across - along};
}

INLINE vrounded round_limbs(vlimbs a, vd error)
{
    return (vrounded){a.hi + (a.lo - error), a.hi + (a.lo + error)};
}

/* NaN where b is. */
INLINE vrounded larger_of(vrounded a, vrounded b)
{
    return (vrounded){v_max(a.low, b.low), v_max(a.high, b.high)};
}

INLINE vrounded pick_rounded(vm m, vrounded a, vrounded b)
{
    return (vrounded){v_select(m, a.low, b.low), v_select(m, a.high, b.high)};
}

/* Feet on the lateral line: before it and after it; or neither is certain. */
typedef struct {
    vm before, on, after;
} vfoot;

INLINE vfoot foot_of(vd before, vd after, vd M)
{
    const vm is_before = v_lt(before, -M);
    return (vfoot){is_before, m_and(v_lt(M, before), v_lt(after, -M)),
                   m_and(v_lt(M, after), m_not(is_before))};
}

INLINE vd feature_at(vm top, int at_base, int at_top)
{
    return v_select(top, v_set(at_top), v_set(at_base));
}

/* ------------------------------------------------- a capped cylinder or cone */

/* A point and a shape between planes, in doubles. */
typedef struct {
    vd z, above, a, x0, x1, before, after, error;
} vsection;

/* Writes the feature, and where it is known. */
INLINE void find_feature(vnearest *n, const vplane *m, const vshape *s,
                         const vsection *p)
{
    const vd M = v_set(CYLINT_FEATURE_MARGIN) * m->size + p->error;
    const vd t = p->z + p->above, a = p->a;
    const vm top = v_lt(v_set(0), t);
    const vd b = v_select(top, p->above, -p->z);
    const vd x = v_select(top, p->x1, p->x0);
    const vm less = v_lt(a, b);
    const vm inside = m_and(v_lt(a, -M), v_lt(b, -M));
    const vm tie = m_or(v_le(v_abs(a - b), M), m_and(less, v_le(v_abs(t), M)));
    const vm outside = m_or(v_lt(M + M, a), v_lt(M, b));
    const vm beyond = m_and(v_lt(M, b), v_lt(x, -M));
    const vm not_beyond = m_or(v_lt(b, -M), v_lt(M, x));
    const vfoot foot = foot_of(p->before, p->after, M);
    const vm sides = m_or(foot.on, m_or(foot.before, foot.after));
    const vm cap = m_or(m_and(inside, less), m_and(m_not(inside), beyond));
    const vm lateral = m_or(inside, m_or(beyond, foot.on));
    n->feature = v_select(
        lateral, v_set(CYLINT_FEATURE_LATERAL),
        feature_at(foot.after, CYLINT_FEATURE_RIM0, CYLINT_FEATURE_RIM1));
    n->feature =
        v_select(cap, feature_at(top, CYLINT_FEATURE_CAP0, CYLINT_FEATURE_CAP1),
                 n->feature);
    n->known = m_or(m_and(inside, m_not(tie)),
                    m_and(outside, m_or(beyond, m_and(not_beyond, sides))));
    n->known = m_and(n->known, v_lt(M + M, s->height));
}

/* Where both are positive. */
INLINE vm is_over(vd x, vd y)
{
    return m_and(v_lt(v_set(0), x), v_lt(v_set(0), y));
}

/* limb_distance.c: the largest of the distances from the lines, or a rim. */
INLINE void between_planes(vnearest *n, const vplane *m, const vshape *s,
                           int tapered, int parted)
{
    const vd zero = v_set(0);
    vsection p;
    p.error = zero;
    const vlimbs rho = root_of(square_across(m), m, &p.error);
    const vlimbs x0 = limbs_sub(rho, split(s->r[0], m->snap));
    const vlimbs x1 = tapered ? limbs_sub(rho, split(s->r[1], m->snap)) : x0;
    const vlimbs lateral = tapered ? turned(s, m, x0) : x0;
    const vlimbs below = {-m->z.hi, -m->z.lo};
    const vrounded beyond =
        larger_of(round_limbs(below, p.error), round_limbs(m->above, p.error));
    n->d = larger_of(beyond, round_limbs(lateral, p.error));
    p.z = sum_of_limbs(m->z);
    p.above = sum_of_limbs(m->above);
    p.a = sum_of_limbs(lateral);
    p.x0 = sum_of_limbs(x0);
    p.x1 = sum_of_limbs(x1);
    p.before = tapered ? v_sum_of(s->cosine, p.z, s->sine * p.x0) : p.z;
    p.after = tapered ? v_sum_of(s->cosine, p.above, s->sine * p.x1) : p.above;
    const vm top = v_lt(zero, p.after);
    const vm outside = m_or(v_lt(p.before, zero), top);
    const vm caps = m_or(is_over(-p.z, -p.x0), is_over(p.above, -p.x1));
    const vm rims =
        tapered ? m_and(m_and(outside, m_not(caps)), v_lt(zero, n->d.low))
                : is_over(beyond.low, p.a);
    if (parted)
        find_feature(n, m, s, &p);
    if (m_any(rims)) {
        const vlimbs none = {zero, zero};
        const vlimbs x = pick(top, x1, x0), y = pick(top, m->above, m->z);
        vd error = p.error;
        const vlimbs square = plus_square(plus_square(none, x, sum_of_limbs(x)),
                                          y, sum_of_limbs(y));
        const vlimbs root = root_of(square, m, &error);
        n->d = pick_rounded(rims, round_limbs(root, error), n->d);
    }
}

/* ---------------------------------------------------- a hull or a sphere -- */

/* The distance from the segment between the centres, minus the radius. */
INLINE void of_capsule(vnearest *n, const vplane *m, const vshape *s,
                       int parted)
{
    const vd zero = v_set(0);
    vd error = zero;
    const vd z = sum_of_limbs(m->z), above = sum_of_limbs(m->above);
    const vm low = v_lt(z, zero), top = v_lt(zero, above);
    const vlimbs none = {zero, zero};
    const vlimbs y = pick(top, m->above, pick(low, m->z, none));
    const vlimbs root =
        root_of(plus_square(square_across(m), y, sum_of_limbs(y)), m, &error);
    n->d = round_limbs(limbs_sub(root, split(s->r[0], m->snap)), error);
    if (!parted)
        return;
    const vd M = v_set(CYLINT_FEATURE_MARGIN) * m->size;
    n->known = m_and(v_lt(M, v_abs(z)), v_lt(M, v_abs(above)));
    n->feature =
        v_select(m_or(low, top),
                 feature_at(top, CYLINT_FEATURE_CAP0, CYLINT_FEATURE_CAP1),
                 v_set(CYLINT_FEATURE_LATERAL));
}

/* A ball or the cone that touches both. */
INLINE void of_round_cone(vnearest *n, const vplane *m, const vshape *s,
                          int parted)
{
    const vd zero = v_set(0);
    vd error = zero;
    const vd z = sum_of_limbs(m->z), above = sum_of_limbs(m->above);
    const vlimbs across = square_across(m);
    const vlimbs rho = root_of(across, m, &error);
    const vd lean = s->sine * sum_of_limbs(rho);
    const vd before = v_sum_of(s->cosine, z, lean);
    const vd after = v_sum_of(s->cosine, above, lean);
    const vm low = v_lt(before, zero), top = v_lt(zero, after);
    const vm balls = m_or(low, top);
    const vlimbs d = limbs_sub(turned(s, m, rho), split(s->r[0], m->snap));
    n->d = round_limbs(d, error);
    if (m_any(balls)) {
        const vlimbs y = pick(top, m->above, m->z);
        const vd r = v_select(top, s->r[1], s->r[0]);
        vd ball_error = zero;
        const vlimbs root =
            root_of(plus_square(across, y, sum_of_limbs(y)), m, &ball_error);
        const vlimbs ball = limbs_sub(root, split(r, m->snap));
        n->d = pick_rounded(balls, round_limbs(ball, ball_error), n->d);
    }
    if (!parted)
        return;
    const vd M = v_set(CYLINT_FEATURE_MARGIN) * m->size + error;
    const vfoot foot = foot_of(before, after, M);
    n->known = m_or(foot.on, m_or(foot.before, foot.after));
    n->feature = v_select(
        balls, feature_at(top, CYLINT_FEATURE_CAP0, CYLINT_FEATURE_CAP1),
        v_set(CYLINT_FEATURE_LATERAL));
}

INLINE void of_sphere(vnearest *n, const vplane *m, const vshape *s)
{
    vd error = v_set(0);
    const vlimbs root = root_of(m->square, m, &error);
    n->d = round_limbs(limbs_sub(root, split(s->r[0], m->snap)), error);
}

/* ------------------------------------------------------------- blocks -- */

/* Where all numbers within the error round to the same double. */
INLINE vm is_certain(const vnearest *n)
{
    return m_and(v_le(n->d.high, n->d.low), n->known);
}

INLINE void find_nearest(vnearest *n, const cylint_shape *shape,
                         const vshape *s, const vd x[3], int parted)
{
    vplane m;
    n->known = v_le(v_set(0), v_set(0));
    n->feature = v_set(CYLINT_FEATURE_LATERAL);
    load_plane(&m, s, x, shape->kind != CYLINT_KIND_SPHERE);
    if (shape->kind == CYLINT_KIND_SPHERE)
        of_sphere(n, &m, s);
    else if (shape->kind == CYLINT_KIND_CAPSULE)
        of_capsule(n, &m, s, parted);
    else if (shape->kind == CYLINT_KIND_RCONE)
        of_round_cone(n, &m, s, parted);
    else
        between_planes(n, &m, s, shape->kind == CYLINT_KIND_CONE, parted);
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

INLINE unsigned write_lanes(const vnearest *at, int i, int n, double *distance,
                            signed char *feature)
{
    double d[LANES], f[LANES];
    const unsigned certain = m_bits(is_certain(at));
    v_store(d, at->d.low);
    v_store(f, at->feature);
    for (int lane = 0; lane < LANES && i + lane < n; lane++) {
        distance[i + lane] = d[lane];
        if (feature)
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
            vnearest nearest;
            find_nearest(&nearest, at[0], &s, x, feature != NULL);
            certain = write_lanes(&nearest, i, n, distance, feature);
        }
        for (int lane = 0; lane < LANES && i + lane < n; lane++) {
            rest[left] = i + lane;
            left += !(certain >> lane & 1);
        }
    }
    return left;
}
