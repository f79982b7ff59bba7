/*
 * upright_template.h - unit vectors along and across the axis of a shape, in pairs
 *
 * One text at two widths.  Narrow: one shape, and a vector of lanes has x, y, z and
 * one more number.  Wide (CYLINT_WIDE): each lane has a shape of its own.  What one
 * number of a shape is depends on the width: a `real` in doubles, a `one` in pairs.
 *
 * The including file includes double_double.h, simd.h and measure.h before.
 */

/* ----------------------------------- four numbers of each shape, in pairs -- */

#ifdef CYLINT_WIDE
enum { PARTS = 4 };
typedef vd real;
typedef vpair one;
#else
enum { PARTS = 4 / LANES };
typedef double real;
typedef pair one;
#endif

/* A vector and another number. */
typedef struct {
    vpair part[PARTS];
} four;

typedef struct {
    four x, y, z;
} rows;

#if defined(CYLINT_WIDE)

INLINE void store_four(real hi[4], real lo[4], const four *x)
{
    EACH(k, 4) {
        hi[k] = x->part[k].hi;
        lo[k] = x->part[k].lo;
    }
}

#else

INLINE void store_four(real hi[4], real lo[4], const four *x)
{
    EACH(k, PARTS) {
        v_store(hi + k * LANES, x->part[k].hi);
        v_store(lo + k * LANES, x->part[k].lo);
    }
}

#endif

#if !defined(CYLINT_WIDE) && LANES == 2

/* From registers: a load of two lanes waits for numbers just stored one by
 * one. */
INLINE four four_of(double x, double y, double z, double w)
{
    return (four){{{v_two(x, y), v_set(0)}, {v_two(z, w), v_set(0)}}};
}

INLINE vpair both_firsts(vpair x, vpair y)
{
    return (vpair){v_firsts(x.hi, y.hi), v_firsts(x.lo, y.lo)};
}

INLINE vpair swapped(vpair x)
{
    return (vpair){v_turned(x.hi), v_turned(x.lo)};
}

/* (x1, x2, x0, x3). */
INLINE four turned(const four *x)
{
    return (four){{both_firsts(swapped(x->part[0]), x->part[1]),
                   both_firsts(x->part[0], swapped(x->part[1]))}};
}

INLINE one last_of(const four *x)
{
    const vpair last = swapped(x->part[1]);
    return (one){v_first(last.hi), v_first(last.lo)};
}

INLINE void set_last(four *x, one last)
{
    x->part[1] =
        both_firsts(x->part[1], (vpair){v_set(last.hi), v_set(last.lo)});
}

#else

INLINE four four_of(real x, real y, real z, real w)
{
    const vd zero = v_set(0);
    return (four){{{x, zero}, {y, zero}, {z, zero}, {w, zero}}};
}

INLINE four turned(const four *x)
{
    return (four){{x->part[1], x->part[2], x->part[0], x->part[3]}};
}

INLINE one last_of(const four *x)
{
    return (one){x->part[3].hi, x->part[3].lo};
}

INLINE void set_last(four *x, one last)
{
    x->part[3] = (vpair){last.hi, last.lo};
}

#endif

INLINE four products(const four *x, const four *y)
{
    four xy;
    EACH(k, PARTS) {
        const vpair p = vpair_mul(x->part[k], y->part[k]);
        xy.part[k] = v_fast_two_sum(p.hi, p.lo);
    }
    return xy;
}

/* ------------------------------------------------ one number of each shape -- */

/* one_sum() does not normalise its result.  inverse_roots(): 1 / sqrt(a) of three
 * numbers. */
#ifdef CYLINT_WIDE

INLINE real real_of(double x)
{
    return v_set(x);
}

INLINE one one_sum(one x, one y)
{
    return vpair_add(x, y);
}

INLINE one one_mul(one x, one y)
{
    const vpair p = vpair_mul(x, y);
    return v_fast_two_sum(p.hi, p.lo);
}

INLINE four all_four(one x)
{
    return (four){{x, x, x, x}};
}

INLINE void inverse_roots(one root[3], const one a[3])
{
    EACH(k, 3)
        root[k] = vpair_inverse_root(a[k]);
}

/* A coordinate in each lane. */
typedef struct {
    vm is[3];
} coordinate;

INLINE coordinate least_of_axis(const real hi[4], const real lo[4],
                                const cylint_shape *s)
{
    const vd x = v_abs(hi[0]), y = v_abs(hi[1]), z = v_abs(hi[2]);
    const vm y_first = v_lt(y, x);
    const vm last = v_lt(z, v_select(y_first, y, x));
    (void)lo;
    (void)s;
    return (coordinate){
        {m_and_not(m_not(last), y_first), m_and_not(y_first, last), last}};
}

INLINE real number_of(coordinate c, const real x[3])
{
    return v_select(c.is[0], x[0], v_select(c.is[1], x[1], x[2]));
}

INLINE four direction_of(coordinate c)
{
    const vd zero = v_set(0), unit = v_set(1);
    return four_of(v_select(c.is[0], unit, zero), v_select(c.is[1], unit, zero),
                   v_select(c.is[2], unit, zero), zero);
}

#else

INLINE real real_of(double x)
{
    return x;
}

INLINE one one_sum(one x, one y)
{
    const pair sum = two_sum(x.hi, y.hi);
    return (pair){sum.hi, sum.lo + (x.lo + y.lo)};
}

INLINE one one_mul(one x, one y)
{
    return pair_mul(x, y);
}

INLINE four all_four(one x)
{
    four all;
    EACH(k, PARTS)
        all.part[k] = (vpair){v_set(x.hi), v_set(x.lo)};
    return all;
}

INLINE void inverse_roots(one root[3], const one a[3])
{
    double hi[4], lo[4];
    const four high = four_of(a[0].hi, a[1].hi, a[2].hi, 1),
               low = four_of(a[0].lo, a[1].lo, a[2].lo, 0);
    four r;
    EACH(k, PARTS)
        r.part[k] =
            vpair_inverse_root((vpair){high.part[k].hi, low.part[k].hi});
    store_four(hi, lo, &r);
    EACH(k, 3)
        root[k] = (pair){hi[k], lo[k]};
}

typedef int coordinate;

/* The coordinate along which the axis is least, where high parts are equal.  The
 * processor can have flushed a low part, of a subnormal coordinate. */
INLINE coordinate least_of_equal(const real hi[4], const real lo[4],
                                 const cylint_shape *s)
{
    int tiny = 0, least = 0;
    EACH(i, 3) {
        const double size = fabs(hi[i]), most = fabs(hi[least]);
        const double low = hi[i] < 0 ? -lo[i] : lo[i],
                     most_low = hi[least] < 0 ? -lo[least] : lo[least];
        tiny |= cylint_too_small(cylint_base(s)[i]) |
                cylint_too_small(cylint_top(s)[i]);
        if (size < most || (size == most && low < most_low))
            least = i;
    }
    return tiny ? cylint_least_axis_component(s) : least;
}

/* The coordinate along which the axis of a shape is least, from which phi is
 * counted.  Which one is unpredictable, so there is no branch but for equal
 * ones. */
INLINE coordinate least_of_axis(const real hi[4], const real lo[4],
                                const cylint_shape *s)
{
    const double x = fabs(hi[0]), y = fabs(hi[1]), z = fabs(hi[2]);
    const double xy = cylint_smaller(x, y);
    const int least = y < x, last = z < xy;
    return x == y || z == xy ? least_of_equal(hi, lo, s)
                             : least + last * (2 - least);
}

INLINE real number_of(coordinate c, const real x[3])
{
    return x[c];
}

INLINE four direction_of(coordinate c)
{
    static const double direction[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const double *e = direction[c];
    return four_of(e[0], e[1], e[2], 0);
}

#endif

/* ------------------------------------------------------------- the rows ---- */

INLINE one one_of(coordinate c, const real hi[3], const real lo[3])
{
    return (one){number_of(c, hi), number_of(c, lo)};
}

/* x in lanes of `e`, which is 1 there and else 0; y in the others. */
INLINE vpair chosen(vd e, vpair x, vpair y)
{
    const vd other = v_set(1) - e;
    return (vpair){e * x.hi + other * y.hi, e * x.lo + other * y.lo};
}

/* 1 / |w|; lateral2 and 1 / sqrt(lateral2), which is |w|^2 + dr^2 for a cone, |w|^2
 * - dr^2 for a round cone, 1 + dr^2 for an acone, whose dr is its tangent. */
typedef struct {
    one axis, lateral, lateral2;
} inverse_lengths;

/*
 * Unit vectors along the axis and across it, of an axis w beside which stands dr,
 * the growth of the radius: x is perpendicular to the coordinate direction e along
 * which the axis is least.
 *
 *   h = 1 / |w|, l = 1 / |w x e|;  z = h w, x = l (w x e),
 *   y = z x x = h l (w (w.e) - e w.w)
 *
 * The component of the last vector along e is -|w x e|^2.  Beside z stands the
 * slope, beside x the height |w|.  sign: -1 for a round cone, else 1.  s: the
 * shape; NULL in wide lanes, where phi has no influence.
 *
 * Errors, in units of u^2, u = 2^-53, each relative to its number: squares 6;
 * |w x e|^2 13, |w|^2 22; e of l 51, of h 64; l 47, h 55; x 67, z, slope and
 * height 90; y 140, of which CYLINT_LOCAL_ERROR allows 1024.
 */
INLINE inverse_lengths upright_rows(rows *m, const four *axis, double sign,
                                    int has_tangent, const cylint_shape *s)
{
    const four w = *axis, w1 = turned(&w), w2 = turned(&w1);
    real hi[4], lo[4], square_hi[5], square_lo[5];
    store_four(hi, lo, &w);
    const coordinate least = least_of_axis(hi, lo, s);
    const four all_along = all_four(one_of(least, hi, lo));
    const four e = direction_of(least), e1 = turned(&e), e2 = turned(&e1);
    four square, x, y;
    EACH(k, PARTS) {
        const vd to1 = e1.part[k].hi, to2 = e2.part[k].hi;
        square.part[k] = vpair_mul(w.part[k], w.part[k]);
        x.part[k] = (vpair){w1.part[k].hi * to2 - w2.part[k].hi * to1,
                            w1.part[k].lo * to2 - w2.part[k].lo * to1};
        y.part[k] = vpair_mul(w.part[k], all_along.part[k]);
    }
    store_four(square_hi, square_lo, &square);
    const one dr2 = {square_hi[3], square_lo[3]};
    EACH(i, 2) { /* the two coordinates after each */
        square_hi[3 + i] = square_hi[i];
        square_lo[3 + i] = square_lo[i];
    }
    const one aside = one_sum(one_of(least, square_hi + 1, square_lo + 1),
                              one_of(least, square_hi + 2, square_lo + 2));
    const one length2 = one_sum(aside, one_of(least, square_hi, square_lo));
    const one lateral2 =
        one_sum(has_tangent ? (one){real_of(1), real_of(0)} : length2,
                (one){real_of(sign) * dr2.hi, real_of(sign) * dr2.lo});
    const one of[3] = {length2, aside, lateral2};
    one root[3];
    inverse_roots(root, of);
    const four minus_aside = all_four((one){-aside.hi, -aside.lo});
    EACH(k, PARTS)
        y.part[k] = chosen(e.part[k].hi, minus_aside.part[k], y.part[k]);
    const four to_z = all_four(root[0]);
    const four to_y = all_four(one_mul(root[0], root[1]));
    four to_x = all_four(root[1]);
    set_last(&x, length2);
    set_last(&to_x, root[0]);
    m->z = products(&w, &to_z);
    m->x = products(&x, &to_x);
    m->y = products(&y, &to_y);
    return (inverse_lengths){root[0], root[2], lateral2};
}

/* The cosine of the angle between the axis and the lateral surface of a round
 * cone. */
INLINE one cosine_of_hull(const inverse_lengths *inverse)
{
    return one_mul(one_mul(inverse->lateral2, inverse->axis), inverse->lateral);
}
