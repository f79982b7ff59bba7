/*
 * round_lines.h - how a line lies to a sphere, capsule or rounded cone, by
 * signs in local coordinates
 *
 * The planes of the two circles (shapes/local.h) cut a capsule or rounded cone
 * into a part of ball 0, a cone between planes, and a part of ball 1.  The forms
 * of the cone are those of local_lines.h.  They decide whether the line crosses
 * the cone.  If it passes outside both circles and does not cross the cone, it
 * can cross ball i only on the far side of plane i: where inward_i < 0.
 * A line that crosses pierces the disc of a circle, or crosses the cone twice,
 * or its chord is in one ball.  A sphere is one ball.
 */
#ifndef CYLINT_ROUND_LINES_H
#define CYLINT_ROUND_LINES_H

#include "local_pairs.h"

/* What a kernel is compiled for. */
enum { ROUND_BALL, ROUND_STRAIGHT, ROUND_TAPERED };

/* in: z and r of the planes and circles; of a sphere not used. */
typedef struct {
    local_line l;
    balls_doubles balls;
} round_line;

typedef struct {
    line_pairs in;
    balls_pairs balls;
} round_pairs;

INLINE void load_sphere(round_line *x, const cylint_shape *shape,
                        const cylint_line *line)
{
    local_line *l = &x->l;
    const vd from = v_load(line->o) - v_load(shape->base);
    const double z = line->o[2] - shape->base[2];
    const vd size = v_abs(from), both = v_max(size, v_turned(size));
    l->in.p = from;
    l->in.v = v_load(line->d);
    l->in.w = v_set(line->d[2]);
    l->in.z = x->balls.z = v_set(z);
    l->in.r = x->balls.r = v_set(shape->r0);
    l->z[0] = l->z[1] = z;
    l->w = line->d[2];
    l->Q = cylint_larger(v_first(both), fabs(z)) + shape->local.reach;
    l->D = line->size;
    l->unit = CYLINT_ROUNDING;
}

INLINE void load_round(round_line *x, const cylint_shape *shape,
                       const cylint_line *line, int kind)
{
    local_line *l = &x->l;
    if (kind == ROUND_BALL) {
        load_sphere(x, shape, line);
        return;
    }
    load_local(l, shape, line, kind == ROUND_TAPERED);
    x->balls = (balls_doubles){l->in.z, l->in.r};
    if (kind == ROUND_TAPERED) {
        l->in.z = v_sum_of(v_set(shape->local.sine), l->in.r, l->in.z);
        l->in.r = l->in.r * v_set(shape->local.cosine);
        l->unit = CYLINT_LOCAL_ROUND * CYLINT_ROUNDING;
    }
}

INLINE void load_round_pairs(round_pairs *x, const cylint_shape *shape,
                             const cylint_line *line, int kind)
{
    const cylint_local *f = &shape->local;
    line_pairs *in = &x->in;
    load_pairs(in, shape, line);
    if (kind == ROUND_BALL)
        in->r = twice(shape->r0, 0);
    x->balls = (balls_pairs){in->z, in->r};
    if (kind == ROUND_TAPERED) {
        const vpair sine = twice(f->sine, f->sine_lo);
        in->z = vpair_add(in->z, vpair_mul(in->r, sine));
        in->r = vpair_mul(in->r, twice(f->cosine, f->cosine_lo));
    }
}

/* cone: of the cone, but misses and crosses of the whole.  g: of the balls,
 * where it was computed.  chord: bit i, the chord is in ball i. */
typedef struct {
    local_verdict cone;
    vd g, g_error;
    unsigned chord;
} round_verdict;

INLINE vd ball_error(const round_line *x)
{
    const local_line *l = &x->l;
    return v_set(CYLINT_LOCAL_BALL * l->unit * l->Q * l->D * l->D) *
           (x->balls.r + v_set(CYLINT_LOCAL_SECOND * l->unit * l->Q));
}

INLINE void compute_balls(round_verdict *v, const round_line *x)
{
    v->g = ball_g_doubles(&x->l.in, &x->balls);
    v->g_error = ball_error(x);
}

INLINE void compute_ball(round_verdict *v, const round_line *x)
{
    v->g = one_ball_g_doubles(&x->l.in, x->balls.z, x->balls.r);
    v->g_error = ball_error(x);
}

INLINE sign_bits signs_of_balls(const round_verdict *v)
{
    return (sign_bits){m_bits(v_lt(v->g_error, v->g)),
                       m_bits(v_lt(v->g, -v->g_error))};
}

/* Returns 1 if the line misses the sphere, or the cone on all of its length,
 * which holds both balls.  G or g is computed. */
INLINE int misses_at_once(round_verdict *v, const round_line *x,
                          const cylint_shape *shape, int kind)
{
    if (kind != ROUND_BALL)
        return classify_by_G(&v->cone, &x->l, shape, kind == ROUND_TAPERED);
    compute_ball(v, x);
    return v_first(v->g) < -v_first(v->g_error);
}

INLINE void classify_sphere(round_verdict *v)
{
    v->chord = v_first(v->g_error) < v_first(v->g);
    v->cone.pierced = 0;
    v->cone.spared = 3;
    v->cone.crosses = (int)v->chord;
    v->cone.misses = v_first(v->g) < -v_first(v->g_error);
}

/* By the cone.  Returns bits of the balls in which all of the chord may be. */
INLINE unsigned classify_cone(round_verdict *v, const round_line *x,
                              const cylint_shape *shape, vd E, vd N,
                              int tapered)
{
    local_verdict *cone = &v->cone;
    const cap_signs c = signs_at_caps(cone, &x->l, shape, E, N, tapered);
    v->chord = 0;
    cone->pierced = c.E.positive;
    cone->spared = c.E.negative;
    cone->misses = (int)(misses_local(&c) & 1);
    cone->crosses = (int)(crosses_local(&c) & 1);
    return cone->misses ? c.inward.negative : 0;
}

/* By the balls of those bits; the line misses the cone. */
INLINE void classify_balls(round_verdict *v, unsigned balls)
{
    const sign_bits g = signs_of_balls(v);
    v->chord = balls & g.positive;
    v->cone.crosses = v->chord != 0;
    v->cone.misses = !(balls & ~g.negative);
}

/* Of a line that misses_at_once() does not show to miss. */
INLINE void classify_round(round_verdict *v, round_line *x,
                           const cylint_shape *shape, int kind)
{
    const int tapered = kind == ROUND_TAPERED;
    if (kind == ROUND_BALL) {
        set_products_doubles(&x->l.in);
        classify_sphere(v);
        return;
    }
    const unsigned balls = classify_cone(v, x, shape, E_doubles(&x->l.in),
                                         N_doubles(&x->l.in, tapered), tapered);
    if (balls) {
        compute_balls(v, x);
        classify_balls(v, balls);
    }
}

/* Where a point of a line that crosses the shape lies: before the overlap of
 * line and shape, inside it, or after it.  LOCAL_NEAR: it is near the surface;
 * added to where it lies if it is outside. */
enum { LOCAL_BEFORE, LOCAL_INSIDE, LOCAL_AFTER, LOCAL_UNCERTAIN, LOCAL_NEAR };

/* The lanes of ends in the domain, as bits, from where its limits lie; or
 * CYLINT_UNDECIDED. */
INLINE int ends_between(int from, int to, int first)
{
    if (from == LOCAL_UNCERTAIN || to == LOCAL_UNCERTAIN)
        return CYLINT_UNDECIDED;
    const int begins = (from == LOCAL_BEFORE) & (to != LOCAL_BEFORE);
    const int ends = (from != LOCAL_AFTER) & (to == LOCAL_AFTER);
    return first ? begins << 1 | ends : ends << 1 | begins;
}

/* Where the point at t lies. */
INLINE int round_state(const round_line *x, const round_verdict *v,
                       const cylint_shape *shape, double t, int kind)
{
    if (t > CYLINT_LATE)
        return LOCAL_AFTER;
    if (t < -CYLINT_LATE)
        return LOCAL_BEFORE;
    const local_line *l = &x->l;
    const int tapered = kind == ROUND_TAPERED;
    const double Q = sum_of(fabs(t), l->D, l->Q),
                 taper = taper_of(shape, tapered);
    const double eZ = CYLINT_LOCAL_POSITION * l->unit * Q, eP = eZ * taper;
    const vd along = v_set(t) * l->in.w;
    const vd p = v_sum_of(v_set(t), l->in.v, l->in.p),
             pp = v_sums(p * p, p * p);
    const vd zb = x->balls.z + along, r = x->balls.r;
    const vd C = v_sum_of(zb, zb, pp) - r * r;
    const vd eC = v_set(8 * eZ) * (r + v_set(eZ));
    const unsigned in = m_bits(v_lt(C, -eC)), out = m_bits(v_lt(eC, C));
    int inside = in != 0, outside = out == 3;
    double toward, eT;
    if (kind != ROUND_BALL) {
        const vd z = l->in.z + along;
        const unsigned below = m_bits(v_lt(z, v_set(-eZ)));
        const unsigned above = m_bits(v_lt(v_set(eZ), z));
        const double rho =
            v_first(tapered ? v_sum_of(v_set(shape->local.slope), z, l->in.r)
                            : l->in.r);
        const double side = sum_of(-rho, rho, v_first(pp));
        const double eS = 4 * eP * (widest_of(shape, tapered) + 4 * eP);
        inside |= (above & 1) && (below & 2) && side < -eS;
        outside = ((below & 1) && (out & 1)) || ((above & 2) && (out & 2)) ||
                  (!(below & 1) && !(above & 2) && side > eS);
    }
    if (v->cone.pierced) {
        const vd z = l->in.z + along;
        toward = -v_first(v->cone.pierced & 1 ? z : v_turned(z)) * l->w;
        eT = 2 * eZ * l->D;
    } else if (v->chord) {
        const vd B = v_sum_of(v_set(t), ball_A_doubles(&l->in),
                              ball_B_doubles(&l->in, &x->balls));
        toward = -v_first(v->chord & 1 ? B : v_turned(B));
        eT = 2 * CYLINT_LOCAL_FORM * l->unit * Q * l->D;
    } else {
        const local_quadratic q = quadratic_of(l, shape, tapered);
        toward = -sum_of(q.A, t, q.B);
        eT = 2 * CYLINT_LOCAL_FORM * l->unit * taper * taper * Q * l->D;
    }
    if (inside)
        return LOCAL_INSIDE;
    const int aside = !(fabs(toward) > eT) ? LOCAL_UNCERTAIN
                      : toward > 0         ? LOCAL_BEFORE
                                           : LOCAL_AFTER;
    return outside ? aside : LOCAL_NEAR + aside;
}

/* Of a line that crosses: whether part of the chord certainly lies ahead of
 * the line's origin. */
INLINE int is_round_ahead(const round_line *x, const round_verdict *v,
                          const cylint_shape *shape, int kind)
{
    const local_line *l = &x->l;
    if (v->cone.pierced) {
        const vd eZ = v_set(2 * CYLINT_LOCAL_POSITION * l->unit * l->Q * l->D);
        return (m_bits(v_lt(l->in.z * l->in.w, -eZ)) & v->cone.pierced) != 0;
    }
    if (v->chord) {
        const double eB = CYLINT_LOCAL_FORM * l->unit * l->Q * l->D;
        const vd B = ball_B_doubles(&l->in, &x->balls);
        return (m_bits(v_lt(B, v_set(-eB))) & v->chord) != 0;
    }
    const local_quadratic q = quadratic_of(l, shape, kind == ROUND_TAPERED);
    return q.B < -q.B_error;
}

#endif
