/*
 * kernel.h - the relation of a line and a solid of revolution, by signs, in lanes
 *
 * The forms are those of local_forms_template.h, in doubles or, where those are
 * too near to 0, in pairs.  The bounds on their errors are in error_bounds.h.
 *
 * `solid` is a constant where a function is inlined for one solid.  The planes of
 * a bounded solid are those of its caps or, of a round one, of the circles in which
 * its lateral surface touches the balls.  The planes of the circles cut a capsule
 * or round cone into a part of ball 0, a cone between planes, and a part of ball
 * 1.  A line that passes outside both circles and does not cross the cone can
 * cross ball i only on the far side of plane i.  A sphere is one ball.
 */
#ifndef CYLINT_KERNEL_H
#define CYLINT_KERNEL_H

#include <float.h>

#ifdef CYLINT_NARROW
#include "narrow_frame.h"
#else
#include "wide_frame.h"
#endif

/* A value with a bound on its error. */
typedef struct {
    vd v, e;
} bounded_value;

/* x of end i, in all lanes. */
INLINE bounded_value bounded_of_end(const bounded_value x[ENDS], int i)
{
    return (bounded_value){of_all(x[i % ENDS].v, i), of_all(x[i % ENDS].e, i)};
}

/* Which signs are certain. */
typedef struct {
    vm positive, negative;
} signs;

INLINE signs signs_of(vd x, vd error)
{
    return (signs){v_lt(error, x), v_lt(x, -error)};
}

INLINE signs signs_if(vm m, signs x, signs y)
{
    return (signs){m_if(m, x.positive, y.positive),
                   m_if(m, x.negative, y.negative)};
}

INLINE signs reversed(signs x)
{
    return (signs){x.negative, x.positive};
}

/* ------------------------------------------------------------- forms ---- */

/* The values of the forms of a line; of a sphere G, A, B are those of the ball. */
typedef struct {
    vd G, Y[2], T, A, B, E[ENDS], N[ENDS];
} forms;

/* G, or g of a sphere. */
INLINE void first_form(forms *f, const local_line *l, int solid)
{
    const int tapered = cylint_solid_is_tapered(solid);
    if (solid == CYLINT_SOLID_SPHERE) {
        f->G = ball_g_doubles(&l->in, l->in.z, l->in.r);
        return;
    }
    if (tapered)
        set_Y_doubles(&l->in, f->Y);
    f->G = G_doubles(&l->in, tapered, f->Y);
}

/* The others, after load_after_G(). */
INLINE void other_forms(forms *f, const local_line *l, int solid)
{
    const line_doubles *in = &l->in;
    const int tapered = cylint_solid_is_tapered(solid);
    if (solid == CYLINT_SOLID_NAPPE)
        f->T = T_doubles(in, f->Y);
    f->A = A_doubles(in, tapered);
    f->B = B_doubles(in, tapered);
    if (solid == CYLINT_SOLID_SPHERE) {
        f->A = ball_A_doubles(in);
        f->B = ball_B_doubles(in, in->z);
        return;
    }
    if (!cylint_solid_has_planes(solid))
        return;
    EACH(k, ENDS) {
        f->E[k] = E_doubles(in, l->z[k], l->r[k]);
        f->N[k] = N_doubles(in, l->z[k], l->r[k], tapered);
    }
}

/* ------------------------------------------------ bounds on their errors -- */

/* Of the difference of two squares, of which the larger is near (r D)^2. */
INLINE vd disc_error(const local_line *l, double constant, vd r)
{
    const vd u = l->unit;
    return v_set(constant) * u * l->Q * l->D * l->D *
           v_sum_of(v_set(CYLINT_LOCAL_SECOND) * u, l->Q, r);
}

INLINE bounded_value bounded_G(const forms *f, const local_line *l, int solid)
{
    if (solid == CYLINT_SOLID_SPHERE)
        return (bounded_value){f->G, disc_error(l, CYLINT_LOCAL_BALL, l->in.r)};
    if (!cylint_solid_is_tapered(solid))
        return (bounded_value){f->G, disc_error(l, CYLINT_LOCAL_FORM, l->in.r)};
    const vd off =
        v_set(0.5 * CYLINT_LOCAL_FORM) * l->unit * l->Q * l->D * l->taper;
    return (bounded_value){f->G, (off + off) *
                                     (v_abs(f->Y[0]) + v_abs(f->Y[1]) + off)};
}

INLINE bounded_value bounded_A(vd A, const local_line *l, vd taper)
{
    const vd D = taper * l->D;
    return (bounded_value){A, v_set(CYLINT_LOCAL_A) * l->unit * D * D};
}

INLINE bounded_value bounded_B(vd B, const local_line *l, vd taper)
{
    return (bounded_value){B, v_set(CYLINT_LOCAL_FORM) * l->unit *
                                  (taper * l->Q) * (taper * l->D)};
}

/* The bound of T and N. */
INLINE vd cubic_error(const local_line *l)
{
    return v_set(CYLINT_LOCAL_FORM) * l->unit * l->Q * l->D * l->D * l->taper;
}

/* ----------------------------------------------------------- verdicts --- */

/* The quadratics A t^2 + 2 B t + C of a round solid's balls, g = B^2 - A C;
 * computed: whether they are set. */
typedef struct {
    bounded_value A, B[ENDS], g[ENDS];
    int computed;
} balls;

/* What is certain of a whole line.  pierced: it pierces the disc of a plane.
 * chord: all of its chord is in that ball.  exists: there is an end of the
 * overlap at that root.  sided: `pierced` is certain.  in_plane: the line lies in
 * the plane of an end, one of coordinates. */
typedef struct {
    bounded_value G, A, B;
    balls ball;
    vm pierced[ENDS], chord[ENDS], exists[ENDS];
    vm misses, crosses, sided, in_plane;
} verdict;

INLINE void set_balls(balls *b, const local_line *l, vd A, const vd B[ENDS],
                      const vd g[ENDS])
{
    const vd one = v_set(1);
    b->A = bounded_A(A, l, one);
    EACH(k, ENDS) {
        b->B[k] = bounded_B(B[k], l, one);
        b->g[k] = (bounded_value){
            g[k], disc_error(l, CYLINT_LOCAL_BALL, l->ball_r[k])};
    }
    b->computed = 1;
}

INLINE void compute_balls(balls *b, const local_line *l)
{
    const line_doubles *in = &l->in;
    vd B[ENDS], g[ENDS];
    if (b->computed)
        return;
    EACH(k, ENDS) {
        B[k] = ball_B_doubles(in, l->ball_z[k]);
        g[k] = ball_g_doubles(in, l->ball_z[k], l->ball_r[k]);
    }
    set_balls(b, l, ball_A_doubles(in), B, g);
}

/* A line that misses the cone of a round solid can cross a ball beyond it.  rises:
 * see judge_between_planes(). */
INLINE void judge_balls(verdict *v, const local_line *l, const vm rises[ENDS])
{
    vm there[ENDS], outside[ENDS];
    EACH(k, ENDS) {
        there[k] = m_and(v->misses, rises[k]);
        v->chord[k] = m_from(0);
    }
    if (!m_any(either_end(there))) {
        /* not used; without it compilers warn */
        v->ball.A = (bounded_value){v_set(0), v_set(0)};
        EACH(k, ENDS)
            v->ball.B[k] = v->ball.A;
        return;
    }
    compute_balls(&v->ball, l);
    EACH(k, ENDS) {
        const signs in_ball = signs_of(v->ball.g[k].v, v->ball.g[k].e);
        v->chord[k] = m_and(there[k], in_ball.positive);
        outside[k] = in_ball.negative;
    }
    v->misses = m_and(v->misses, both_ends(outside));
    v->crosses = m_or(v->crosses, either_end(v->chord));
}

/* Whether the quadric stays positive from plane k to the other one, where it is
 * positive at both: it rises from there, or hardly falls, as along a line parallel
 * to the axis.  If it is not convex, it is least at a plane.  Else it falls from -E
 * / w^2 at the plane by at most inward / w^2 times the height, which is at most
 * l->Q, before it rises to the other plane.  The test takes twice that: the bound
 * of E is right only where E is near 0; elsewhere the error of E is less than half
 * of E. */
INLINE vm stays_outside(const local_line *l, vd E, vd inward)
{
    /* mutant '2' -> '3', '-' -> '': slower, pairs decide */
    return v_lt(v_set(2) * l->Q * inward, -E);
}

/* By the signs of E, of N inward and of G (roots/overlap.c), which the caller has
 * tested: it is not below 0.  Certain of plane k: outside: the line crosses it
 * outside the disc; falls: from there the quadric falls towards the other plane;
 * rises: it stays positive. */
INLINE void judge_between_planes(verdict *v, const forms *f,
                                 const local_line *l, int solid)
{
    /* of round solids the larger radius is that of a circle, or more */
    const vd eE = disc_error(l, CYLINT_LOCAL_FORM, l->widest);
    const vd eN = cubic_error(l);
    vm outside[ENDS], falls[ENDS], rises[ENDS], sided[ENDS];
    EACH(k, ENDS) {
        const vd inward = f->N[k] * ends_of(v_set(-1), v_set(1), k);
        const signs E = signs_of(f->E[k], eE);
        v->pierced[k] = E.positive;
        outside[k] = E.negative;
        sided[k] = m_or(E.positive, E.negative);
        falls[k] = v_lt(eN, inward);
        rises[k] = stays_outside(l, f->E[k] + eE, inward + eN);
    }
    v->sided = both_ends(sided);
    v->misses = m_and(both_ends(outside), either_end(rises));
    v->crosses = m_or(either_end(v->pierced),
                      m_and(both_ends(falls), v_lt(v->G.e, v->G.v)));
    if (cylint_solid_is_hull(solid))
        judge_balls(v, l, rises);
}

/*
 * A solid that no two planes bound is crossed if Q has two roots and missed if it
 * has none: a line cannot stay inside a double cone.  G > 0 implies A > 0, but not
 * for a double cone, where A = 0 leaves one root.
 *
 * Of a nappe: if A > 0 both roots are on the nappe that holds the chord's middle,
 * where rho has the sign of T.  If A < 0 there is one on each, and the line enters
 * this nappe if rho grows along it.
 */
INLINE void judge_quadric(verdict *v, const forms *f, const local_line *l,
                          int solid)
{
    const vm all = m_if_all(1);
    const signs A = signs_of(v->A.v, v->A.e);
    v->crosses = v_lt(v->G.e, v->G.v);
    v->misses = m_from(0);
    v->sided = all;
    EACH(k, ENDS) {
        v->pierced[k] = m_from(0);
        v->exists[k] = all;
    }
    if (cylint_solid_is_tapered(solid))
        v->crosses = m_and(v->crosses, m_or(A.positive, A.negative));
    if (solid != CYLINT_SOLID_NAPPE)
        return;
    const signs T = signs_of(f->T, cubic_error(l));
    const vm leaves = v_lt(l->in.slope * l->in.w, v_set(0));
    const vm both = v_lt(v_set(0), v->A.v);
    v->misses = m_and(A.positive, T.negative);
    v->crosses = m_and(v->crosses, m_or(A.negative, T.positive));
    EACH(k, ENDS)
        v->exists[k] = m_or(both, m_if(last_end(k), leaves, m_not(leaves)));
}

/* The verdict on lines that G does not reject; v->G is set. */
INLINE void judge(verdict *v, const forms *f, const local_line *l, int solid)
{
    v->A = bounded_A(f->A, l, l->taper);
    v->B = bounded_B(f->B, l, l->taper);
    if (cylint_solid_has_planes(solid))
        judge_between_planes(v, f, l, solid);
    else
        judge_quadric(v, f, l, solid);
}

/* The planes that bound the lateral surface are those of the ends. */
INLINE int has_end_planes(int solid)
{
    return cylint_solid_has_discs(solid) || solid == CYLINT_SOLID_CAPSULE;
}

/* A line in the plane of an end overlaps the solid between its roots on the lateral
 * surface, if G > 0.  It pierces no disc.  The circles of a capsule lie in these
 * planes. */
INLINE void judge_in_plane(verdict *v, vm lanes)
{
    v->in_plane = lanes;
    v->crosses = m_if(lanes, v_lt(v->G.e, v->G.v), v->crosses);
    v->sided = m_or(v->sided, lanes);
}

/* -------------------------------------- signs at an end of the domain ---- */

/* Where a point of a line that crosses lies: before the overlap of line and
 * solid, inside it, or after it.  None: uncertain. */
typedef struct {
    vm before, inside, after;
} place;

/* Signs at a point of the line: of Q, or of a sphere; of z from each plane; of a
 * nappe's rho; of each ball of a hull; and of which side of a point of the chord it
 * lies on. */
typedef struct {
    signs side, above[2], rho, ball[2], past;
} point_signs;

static const point_signs no_point_signs;

/* A larger |t| counts as infinite: no line hits a bounded solid there. */
INLINE vd latest(int solid)
{
    return v_set(cylint_solid_is_bounded(solid) ? CYLINT_LATE : DBL_MAX);
}

/* The limit, 0 where it is too large for the forms. */
INLINE vd near_limit(vd limit)
{
    return v_select(v_le(v_abs(limit), v_set(CYLINT_LATE)), limit, v_set(0));
}

/*
 * A point outside lies before the overlap if a point of the chord lies ahead.  Of
 * a double cone with A < 0 the overlap is taken for the part of the line between
 * the roots, which is outside the solid.  Of a nappe it is a half-line then, and
 * callers ignore the end that does not exist.
 */
INLINE place place_of(const point_signs *at, const verdict *v, vd limit,
                      int solid)
{
    const vd most = latest(solid);
    const vm above = v_lt(most, limit), below = v_lt(limit, -most);
    const vm is_near = v_le(v_abs(limit), v_set(CYLINT_LATE));
    signs side = at->side, past = at->past;
    if (solid == CYLINT_SOLID_DOUBLE_CONE) {
        const vm between = v_lt(v_set(0), v->A.v);
        side = signs_if(between, side, reversed(side));
        past = signs_if(between, past, reversed(past));
    }
    vm inside = side.negative, outside = side.positive;
    if (solid == CYLINT_SOLID_NAPPE) {
        const vm enters = m_of_end(v->exists, 0);
        const vm leaves = m_of_end(v->exists, 1);
        inside = m_and(inside, at->rho.positive);
        outside = m_or(outside, at->rho.negative);
        past.positive = m_or(past.positive, m_not(enters));
        past.negative = m_or(past.negative, m_not(leaves));
    } else if (cylint_solid_has_planes(solid)) {
        const vm below0 = at->above[0].negative, above1 = at->above[1].positive;
        inside =
            m_and(inside, m_and(at->above[0].positive, at->above[1].negative));
        if (cylint_solid_is_hull(solid)) {
            outside = m_or(outside, m_or(m_and(below0, at->ball[0].positive),
                                         m_and(above1, at->ball[1].positive)));
            inside =
                m_or(inside, m_or(at->ball[0].negative, at->ball[1].negative));
        } else {
            outside = m_or(outside, m_or(below0, above1));
        }
    }
    outside = m_and(outside, is_near);
    return (place){m_or(m_and(outside, past.negative), below),
                   m_and(inside, is_near),
                   m_or(m_and(outside, past.positive), above)};
}

/* A line in the plane of an end is nowhere beyond the planes. */
INLINE void set_between_planes(point_signs *at, vm lanes)
{
    at->above[0].positive = m_or(at->above[0].positive, lanes);
    at->above[1].negative = m_or(at->above[1].negative, lanes);
}

/* On which side of a point of the chord a point lies: of the disc that the line
 * pierces, of the middle of the chord in a ball, or else of the vertex of Q.
 * down: the line goes down. */
INLINE signs past_chord(const point_signs *at, const verdict *v,
                        const signs ball[2], signs vertex, vm down, int solid)
{
    signs past = vertex;
    if (!cylint_solid_has_planes(solid))
        return past;
    EACH(i, 2) {
        const signs plane =
            signs_if(down, reversed(at->above[i]), at->above[i]);
        if (cylint_solid_is_hull(solid))
            past = signs_if(m_of_end(v->chord, i), ball[i], past);
        past = signs_if(m_of_end(v->pierced, i), plane, past);
    }
    return past;
}

/* A t + B and a bound on its error. */
INLINE bounded_value slope_at(bounded_value A, bounded_value B, vd t)
{
    const vd At = A.v * t;
    return (bounded_value){At + B.v, v_sum_of(v_abs(t), A.e, B.e) +
                                         v_set(2 * CYLINT_ROUNDING) *
                                             (v_abs(At) + v_abs(B.v))};
}

INLINE signs slope_signs(bounded_value A, bounded_value B, vd t)
{
    const bounded_value slope = slope_at(A, B, t);
    return signs_of(slope.v, slope.e);
}

/* In doubles, at t, but for at->past. */
INLINE void set_place_signs(point_signs *at, const local_line *l, vd t,
                            int solid)
{
    const line_doubles *in = &l->in;
    const int planes = cylint_solid_has_planes(solid);
    const vd k = l->taper, size = v_sum_of(v_abs(t), l->D, l->Q);
    const vd eZ = v_set(CYLINT_LOCAL_POSITION) * l->unit * size, eP = k * eZ;
    const vd x = v_sum_of(t, in->v[0], in->p[0]);
    const vd y = v_sum_of(t, in->v[1], in->p[1]);
    const vd pp = v_sum_of(x, x, y * y), step = t * in->w;
    EACH(i, 2) {
        at->above[i] = at->ball[i] = (signs){m_from(0), m_from(0)};
        if (planes)
            at->above[i] = signs_of(of_end(l->z, i) + step, eZ);
        if (cylint_solid_is_round(solid)) {
            const vd r = of_end(l->ball_r, i);
            const vd z = of_end(l->ball_z, i) + step;
            at->ball[i] =
                signs_of(v_sum_of(z, z, pp) - r * r, v_set(8) * eZ * (r + eZ));
        }
    }
    at->side = at->ball[0];
    if (solid != CYLINT_SOLID_SPHERE) {
        const vd growing = v_sum_of(in->slope, in->z + step, in->r);
        const vd rho = v_if(cylint_solid_is_tapered(solid), growing, in->r);
        const vd most = v_if(planes, l->widest, k * size);
        at->rho = signs_of(rho, eP);
        at->side = signs_of(v_sum_of(-rho, rho, pp),
                            v_set(4) * eP * (most + v_set(4) * eP));
    }
}

/* The same with at->past: on which side of a point of the chord it lies. */
INLINE void set_point_signs(point_signs *at, const local_line *l,
                            const verdict *v, vd t, int solid)
{
    signs of_ball[2] = {at->past, at->past};
    set_place_signs(at, l, t, solid);
    if (cylint_solid_is_hull(solid) && m_any(either_end(v->chord)))
        EACH(i, 2)
            of_ball[i] =
                slope_signs(v->ball.A, bounded_of_end(v->ball.B, i), t);
    at->past = past_chord(at, v, of_ball, slope_signs(v->A, v->B, t),
                          v_lt(l->in.w, v_set(0)), solid);
}

/* ------------------------------------------------------------ points ---- */

/* A point is a line's origin: its signs are those of the line at t = 0.  Outside,
 * it is both before the overlap and after it. */
INLINE place place_of_point(point_signs *at, int solid)
{
    const vm all = m_if_all(1);
    verdict v;
    v.A.v = v_set(1); /* of a double cone: outside where Q > 0 */
    EACH(k, ENDS)
        v.exists[k] = all;
    at->past = (signs){all, all};
    /* mutant '0' -> '1': a point's line has no direction */
    return place_of(at, &v, v_set(0), solid);
}

/* Call load_place() before. */
INLINE place place_in_doubles(const local_line *l, int solid)
{
    point_signs at = no_point_signs;
    /* mutant '0' -> '1': the same */
    set_place_signs(&at, l, v_set(0), solid);
    return place_of_point(&at, solid);
}

#endif
