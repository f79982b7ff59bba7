/*
 * distance_template.h - the nearest feature of a circular or round shape and
 * the distance from it, over a type of numbers and any number of lanes
 *
 * The including file defines NUMBER(name), the names of the functions below
 * and of the operations that they use: rho, length, ball, turned, datum,
 * rough_rho, unit, minus and trimmed of head_tail.h or pair_lanes.h.  The macro
 * ends with this file.
 *
 * Every lane computes all features, and masks choose.  The distance is a
 * continuous function of z and rho that changes by no more than they do, so
 * for the distance it does not matter which of two nearly equal features is
 * chosen.  The feature is certain only where no boundary between two features
 * is near.
 */

/* x, and the doubles nearest to x less the error and to x plus the error: where
 * these are equal, all numbers within the error round to the same double. */
INLINE vdistance NUMBER(rounded)(vpair x, vd error)
{
    const vpair y = NUMBER(trimmed)(x);
    return (vdistance){x, y.hi + (y.lo - error), y.hi + (y.lo + error), error};
}

INLINE void NUMBER(load_shapes)(shape_lanes *v,
                                const cylint_shape *const at[LANES])
{
    const vd zero = v_set(0);
    vm is_zero[3];
    EACH(i, 3) {
        const vpair w = pair_of_lanes(at, CYLINT_AT_COLUMNS + 3 * i + 2);
        is_zero[i] = v_eq(w.hi, zero);
        v->base[i] = of_lanes(at, CYLINT_AT_BASE + i);
        v->top[i] = of_lanes(at, CYLINT_AT_TOP + i);
        v->top_low[i] = zero;
        v->axis[i] = NUMBER(unit)(w);
    }
    EACH(i, 3)
        v->own[i] = m_and(is_zero[(i + 1) % 3], is_zero[(i + 2) % 3]);
    v->along = m_or(v->own[0], m_or(v->own[1], v->own[2]));
    v->cosine = NUMBER(unit)(pair_of_lanes(at, CYLINT_AT_COSINE));
    v->sine = NUMBER(unit)(pair_of_lanes(at, CYLINT_AT_SINE));
    v->height = pair_of_lanes(at, CYLINT_AT_HEIGHT);
    v->r[0] = (vpair){of_lanes(at, CYLINT_AT_R0), zero};
    v->r[1] = (vpair){of_lanes(at, CYLINT_AT_R1), zero};
    v->reach = of_lanes(at, CYLINT_AT_REACH);
}

/* The larger one; NaN where b is NaN. */
INLINE vpair NUMBER(larger)(vpair a, vpair b)
{
    return pick(v_lt(v_set(0), rounded(NUMBER(minus)(a, b))), a, b);
}

/* The distance from a convex section is the largest of those from its lines, unless
 * a corner is nearest. */
INLINE bounded_pairs NUMBER(from_section)(const half_plane *m,
                                          const vsection *p, vpair lateral,
                                          vpair x0, vpair x1, int tapered)
{
    const vd zero = v_set(0), b = v_max(-p->z, p->above);
    const vm top = v_lt(zero, p->after);
    const vpair beyond = NUMBER(larger)(opposite(m->z), m->above);
    bounded_pairs d = {NUMBER(larger)(beyond, lateral), m->error};
    vm rims = are_positive(p->a, b);
    if (tapered) {
        const vm beyond_end = m_or(v_lt(p->before, zero), top);
        const vm over_cap =
            m_or(are_positive(-p->z, -p->x0), are_positive(p->above, -p->x1));
        const vm outside = v_lt(m->error, v_max(p->a, b));
        rims = m_and_not(m_and(beyond_end, outside), over_cap);
    }
    return m_any(rims)
               ? choose_pairs(rims,
                              NUMBER(length)(pick(top, x1, x0),
                                             pick(top, m->above, m->z), m),
                              d)
               : d;
}

INLINE bounded_pairs NUMBER(between_planes)(vnearest *n, half_plane *m,
                                            const shape_lanes *s, int tapered,
                                            int with_part)
{
    const vpair rho = NUMBER(rho)(m);
    const vpair x0 = NUMBER(minus)(rho, NUMBER(datum)(s->r[0], m));
    const vpair x1 =
        tapered ? NUMBER(minus)(rho, NUMBER(datum)(s->r[1], m)) : x0;
    const vpair lateral = tapered ? NUMBER(turned)(s, x0, m->z) : x0;
    const vd C = rounded(s->cosine), S = rounded(s->sine);
    const vd z = rounded(m->z), above = rounded(m->above);
    const vsection p = {z,
                        above,
                        rounded(lateral),
                        rounded(x0),
                        rounded(x1),
                        tapered ? v_sum_of(C, z, S * rounded(x0)) : z,
                        tapered ? v_sum_of(C, above, S * rounded(x1)) : above};
    if (with_part)
        find_feature(n, m, &p);
    return NUMBER(from_section)(m, &p, lateral, x0, x1, tapered);
}

/* The distance from a ball about the point of the axis that is y below. */
INLINE bounded_pairs NUMBER(from_ball)(vpair y, vd rough_y, vpair r,
                                       const half_plane *m)
{
    bounded_pairs d = NUMBER(ball)(y, rough_y, m);
    d.v = NUMBER(minus)(d.v, NUMBER(datum)(r, m));
    return d;
}

/* The distance from the segment between the centres, minus the radius. */
INLINE bounded_pairs NUMBER(capsule)(vnearest *n, half_plane *m,
                                     const shape_lanes *s, int with_part)
{
    const vd zero = v_set(0), z = m->rough_z, above = z - s->height.hi;
    const vm low = v_lt(z, zero), top = v_lt(zero, above);
    const vpair none = {zero, zero};
    const vpair y = pick(top, m->above, pick(low, m->z, none));
    const vd rough_y = v_select(top, above, v_select(low, z, zero));
    const bounded_pairs d = NUMBER(from_ball)(y, rough_y, s->r[0], m);
    if (!with_part)
        return d;
    const vd M = margin_of(m);
    n->certain = m_and(v_lt(M, v_abs(z)), v_lt(M, v_abs(above)));
    n->feature =
        v_select(m_or(low, top),
                 feature_at(top, CYLINT_FEATURE_CAP0, CYLINT_FEATURE_CAP1),
                 v_set(CYLINT_FEATURE_LATERAL));
    return d;
}

/* A ball or the cone that touches both.  Where rho is small, it is uncertain which
 * of them is nearest to a point near their common circle. */
INLINE bounded_pairs NUMBER(round_cone)(vnearest *n, half_plane *m,
                                        const shape_lanes *s, int with_part)
{
    const vd zero = v_set(0), z = m->rough_z, above = z - s->height.hi;
    vd margin;
    const vd rho = NUMBER(rough_rho)(m, &margin);
    const vd C = rounded(s->cosine), lean = rounded(s->sine) * rho;
    const vd before = v_sum_of(C, z, lean);
    const vd after = v_sum_of(C, above, lean);
    const vm low = v_lt(before, zero), top = v_lt(zero, after);
    const vm balls = m_or(low, top);
    const vd thin = m->size * (v_set(0.5) / rho);
    const vm thick = v_le(thin, v_set(CYLINT_HEAD_TAIL_THINNEST));
    const vd near = v_set(CYLINT_AXIS_MARGIN) * m->size;
    const vm sure =
        m_or(thick, m_and(v_lt(near, v_abs(before)), v_lt(near, v_abs(after))));
    const vd unsure = v_select(sure, zero, v_set(HUGE_VAL));
    bounded_pairs d = {{zero, zero}, zero};
    if (m_any(m_not(balls))) {
        const vpair exact_rho = NUMBER(rho)(m);
        d.v = NUMBER(minus)(NUMBER(turned)(s, exact_rho, m->z),
                            NUMBER(datum)(s->r[0], m));
        d.e = m->error;
    }
    if (m_any(balls)) {
        const vpair r = pick(top, s->r[1], s->r[0]);
        const bounded_pairs ball = NUMBER(from_ball)(
            pick(top, m->above, m->z), v_select(top, above, z), r, m);
        d = choose_pairs(balls, ball, d);
    }
    d.e = d.e + unsure;
    if (!with_part)
        return d;
    const vfoot foot = foot_of(before, after, margin);
    n->certain = m_or(foot.on, m_or(foot.before, foot.after));
    n->feature = v_select(
        balls, feature_at(top, CYLINT_FEATURE_CAP0, CYLINT_FEATURE_CAP1),
        v_set(CYLINT_FEATURE_LATERAL));
    return d;
}

/* A capped shape of this kind, and a point that is loaded.  with_part: the feature
 * is wanted. */
INLINE void NUMBER(nearest)(vnearest *n, half_plane *m, const shape_lanes *s,
                            int kind, int with_part)
{
    bounded_pairs d;
    n->certain = m_not(m_from(0));
    n->feature = v_set(CYLINT_FEATURE_LATERAL);
    if (kind == CYLINT_KIND_SPHERE) {
        d.v = NUMBER(minus)(NUMBER(rho)(m), NUMBER(datum)(s->r[0], m));
        d.e = m->error;
    } else if (kind == CYLINT_KIND_CAPSULE) {
        d = NUMBER(capsule)(n, m, s, with_part);
    } else if (kind == CYLINT_KIND_RCONE) {
        d = NUMBER(round_cone)(n, m, s, with_part);
    } else {
        d = NUMBER(between_planes)(n, m, s, kind == CYLINT_KIND_CONE,
                                   with_part);
    }
    n->d = NUMBER(rounded)(d.v, d.e);
}

#undef NUMBER
