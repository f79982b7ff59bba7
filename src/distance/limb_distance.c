/*
 * limb_distance.c - the distance of a point in numbers of two limbs (limbs.h)
 *
 * The first stage of cylint_distance(): capped cylinders and cones, spheres,
 * capsules and rounded cones, if neither the nearest point nor the normal is
 * wanted.  It computes the distance with an error bound and accepts it if all
 * numbers within the bound round to the same double.  The rest goes to
 * undecided_distance.c, by a call in the last place, so that nothing is saved on
 * the stack.
 *
 * The distance is a continuous function of z and rho and changes by no more than
 * they do, so for the distance it does not matter which of two nearly equal
 * features is chosen.  If the part is wanted, points near a boundary between two
 * features are left.
 *
 * Compiled once as it is and again for processors with a fused multiply-add.
 */
#define CYLINT_NARROW
#include "limb_distance.h"

#include "limbs.h"
#include "nearest.h"
#include "undecided_distance.h"

#ifndef CYLINT_LIMB
#define CYLINT_LIMB cylint_limb_plain
#endif

/* Without and with the part. */
#define NEITHER                                              \
    {                                                        \
        cylint_undecided_distance, cylint_undecided_distance \
    }

#if LANES == 2

#define ARGUMENTS                                                \
    const cylint_shape *s, const double point[3], unsigned want, \
        cylint_closest *answer
#define FORWARD s, point, want, answer

enum { UNDECIDED = -1 };

/* Writes the distance if it is certain, else computes all of it again.
 * feature: if `parted`. */
INLINE double finish(vd d, int parted, int feature, ARGUMENTS)
{
    const double low = v_first(d), high = v_first(v_turned(d));
    if (!(low >= high) || (parted && feature == UNDECIDED))
        return cylint_undecided_distance(FORWARD);
    answer->flags = 0;
    if (parted) {
        answer->feature = feature;
        answer->part = cylint_feature_part(feature);
    }
    return answer->distance = low;
}

/* A number that can be 0 within M has no certain sign. */
INLINE int is_near_zero(double x, double M)
{
    return !(fabs(x) > M);
}

/* ------------------------------------------------- cylinders and cones -- */

/* Of a point between two planes. */
typedef struct {
    upright m;
    limbs x0, x1;         /* rho minus the radii */
    limbs lateral, above; /* from the lateral line; z - height */
    double error;
} section;

INLINE limbs height_of(const cylint_shape *s, double snap)
{
    limbs h = split(cylint_height(s), snap);
    h.lo += cylint_number_pair(s, CYLINT_AT_HEIGHT).lo;
    return h;
}

/* cosine x - sine y. */
INLINE limbs turned(const cylint_shape *s, limbs x, limbs y)
{
    const limbs cosine = split_unit(cylint_number_pair(s, CYLINT_AT_COSINE));
    const limbs sine = split_unit(cylint_number_pair(s, CYLINT_AT_SINE));
    const double C = cosine.hi, S = sine.hi;
    const double x2 = sum_of_limbs(x), y2 = sum_of_limbs(y);
    const double hi = sum_of(C, x.hi, -(S * y.hi));
    const double across = sum_of(C, x.lo, cosine.lo * x2);
    return (limbs){hi, sum_of(-S, y.lo, sum_of(-sine.lo, y2, across))};
}

INLINE void load_section(section *p, const cylint_shape *s,
                         const double point[3], int tapered)
{
    load_upright(&p->m, s, point, 1);
    const limbs rho = root_of_limbs(square_across(&p->m),
                                    double_root(rough_square_across(&p->m)),
                                    &p->m, &p->error);
    p->above = limbs_sub(p->m.z, height_of(s, p->m.snap));
    p->x0 = limbs_sub(rho, split(cylint_r0(s), p->m.snap));
    p->x1 = tapered ? limbs_sub(rho, split(cylint_r1(s), p->m.snap)) : p->x0;
    p->lateral = tapered ? turned(s, p->x0, p->m.z) : p->x0;
}

/* From the planes of the caps, positive outside, rounded. */
INLINE vd round_beyond(const section *p, vd both)
{
    const limbs below = {-p->m.z.hi, -p->m.z.lo};
    return v_max(round_limbs(below, both), round_limbs(p->above, both));
}

/* The foot of the point on the lateral line from its ends. */
typedef struct {
    double before, after;
} foot;

INLINE foot foot_of(const section *p, const cylint_shape *s)
{
    const double C = cylint_cosine(s), S = cylint_sine(s);
    return (foot){sum_of(C, sum_of_limbs(p->m.z), S * sum_of_limbs(p->x0)),
                  sum_of(C, sum_of_limbs(p->above), S * sum_of_limbs(p->x1))};
}

/* Inside, or outside above a cap. */
INLINE int is_over(double beyond, double x)
{
    return (beyond > 0) & (x < 0);
}

INLINE int section_feature(const section *p, const cylint_shape *s)
{
    const double M =
        CYLINT_FEATURE_MARGIN * (p->m.size + cylint_reach(s)) + p->error;
    const double z = sum_of_limbs(p->m.z), above = sum_of_limbs(p->above);
    const double a = sum_of_limbs(p->lateral), t = z + above;
    const int top = t > 0,
              cap = top ? CYLINT_FEATURE_CAP1 : CYLINT_FEATURE_CAP0;
    const double b = top ? above : -z;
    const double x = sum_of_limbs(top ? p->x1 : p->x0);
    const foot at = foot_of(p, s);
    if (is_near_zero(cylint_height(s), 2 * M))
        return UNDECIDED;
    if ((a < -M) & (b < -M)) {
        if (is_near_zero(a - b, M) | ((a < b) & is_near_zero(t, M)))
            return UNDECIDED;
        return a < b ? cap : CYLINT_FEATURE_LATERAL;
    }
    if (!((a > 2 * M) | (b > M)) || is_near_zero(b, M) ||
        (b > M && is_near_zero(x, M)))
        return UNDECIDED;
    if (b > M && x < -M)
        return cap;
    if (is_near_zero(at.before, M) | is_near_zero(at.after, M))
        return UNDECIDED;
    return at.before < 0  ? CYLINT_FEATURE_RIM0
           : at.after > 0 ? CYLINT_FEATURE_RIM1
                          : CYLINT_FEATURE_LATERAL;
}

/* The nearest feature, or undecided. */
INLINE int feature_of(const section *p, const cylint_shape *s)
{
    const int feature = section_feature(p, s);
    return feature != UNDECIDED && cylint_feature_is_apex(s, feature)
               ? CYLINT_FEATURE_APEX
               : feature;
}

/* The root of x^2 + y^2, rounded. */
INLINE vd round_length(const section *p, limbs x, limbs y)
{
    const limbs zero = {0, 0};
    const limbs square =
        plus_square(plus_square(zero, x, sum_of_limbs(x)), y, sum_of_limbs(y));
    double error;
    const limbs d =
        root_of_limbs(square, double_root(sum_of_limbs(square)), &p->m, &error);
    return round_limbs(d, both_ways(p->error + error));
}

/* Of a convex section the largest of the distances from its lines counts, unless
 * a corner is nearest.  The larger of two numbers is NaN if the second is. */
INLINE double section_distance(int tapered, int parted, ARGUMENTS)
{
    section p;
    load_section(&p, s, point, tapered);
    const vd both = both_ways(p.error);
    const vd beyond = round_beyond(&p, both);
    const vd lateral = round_limbs(p.lateral, both);
    const double z = sum_of_limbs(p.m.z);
    vd d = v_max(beyond, lateral);
    int rim = cylint_smaller(v_first(beyond), v_first(lateral)) > 0;
    double to_end = z;
    if (tapered) {
        const foot at = foot_of(&p, s);
        const int outside = v_first(d) > 0;
        const int beyond_end = (at.before < 0) | (at.after > 0);
        const int over_cap = is_over(-z, sum_of_limbs(p.x0)) |
                             is_over(sum_of_limbs(p.above), sum_of_limbs(p.x1));
        rim = outside & beyond_end & !over_cap;
        to_end = at.after;
    }
    if (rim) {
        const vm top = v_lt(v_set(0), v_set(to_end));
        d = round_length(&p, tapered ? limbs_select(top, p.x1, p.x0) : p.x0,
                         limbs_select(top, p.above, p.m.z));
    }
    return finish(d, parted, parted ? feature_of(&p, s) : 0, FORWARD);
}

/* -------------------------------------------------------- round kinds --- */

/* The distance from the segment between the centres, minus the radius. */
INLINE double capsule_distance(int parted, ARGUMENTS)
{
    upright m;
    double error;
    const double h = cylint_height(s);
    load_upright(&m, s, point, 1);
    const limbs zero = {0, 0}, above = limbs_sub(m.z, height_of(s, m.snap));
    const double z = m.rough_z, up = z - h;
    const double rough = cylint_larger(up, 0) + cylint_smaller(z, 0);
    const limbs y =
        limbs_select(v_lt(v_set(0), v_set(up)), above,
                     limbs_select(v_lt(v_set(z), v_set(0)), m.z, zero));
    const limbs square = plus_square(square_across(&m), y, sum_of_limbs(y));
    const double root =
        double_root(sum_of(rough, rough, rough_square_across(&m)));
    const limbs d = limbs_sub(root_of_limbs(square, root, &m, &error),
                              split(cylint_r0(s), m.snap));
    const double M = CYLINT_FEATURE_MARGIN * m.size;
    const int feature = is_near_zero(z, M) | is_near_zero(up, M) ? UNDECIDED
                        : up > 0 ? CYLINT_FEATURE_CAP1
                        : z < 0  ? CYLINT_FEATURE_CAP0
                                 : CYLINT_FEATURE_LATERAL;
    return finish(round_limbs(d, both_ways(error)), parted, feature, FORWARD);
}

/* A ball or the cone that touches both. */
INLINE double round_cone_distance(int parted, ARGUMENTS)
{
    upright m;
    double error;
    load_upright(&m, s, point, 1);
    const double rough = rough_square_across(&m), rho = double_root(rough);
    const limbs above = limbs_sub(m.z, height_of(s, m.snap));
    const double C = cylint_cosine(s), lean = cylint_sine(s) * rho;
    const double up = m.rough_z - cylint_height(s);
    const double before = sum_of(C, m.rough_z, lean);
    const double after = sum_of(C, up, lean);
    int feature = CYLINT_FEATURE_LATERAL;
    limbs d;
    if ((before < 0) | (after > 0)) {
        const vm top = v_lt(v_set(0), v_set(after));
        const limbs y = limbs_select(top, above, m.z);
        const double y2 = sum_of_limbs(y);
        const double r =
            v_first(v_select(top, v_set(cylint_r1(s)), v_set(cylint_r0(s))));
        const limbs square = plus_square(square_across(&m), y, y2);
        d = limbs_sub(root_of_limbs(square, double_root(sum_of(y2, y2, rough)),
                                    &m, &error),
                      split(r, m.snap));
        feature = cylint_sign(r) == 0 ? CYLINT_FEATURE_APEX
                  : after > 0         ? CYLINT_FEATURE_CAP1
                                      : CYLINT_FEATURE_CAP0;
    } else {
        const limbs x = root_of_limbs(square_across(&m), rho, &m, &error);
        d = limbs_sub(turned(s, x, m.z), split(cylint_r0(s), m.snap));
    }
    const double M =
        CYLINT_FEATURE_MARGIN * m.size * (1 + m.size / (rho + rho));
    if (parted && (is_near_zero(before, M) || is_near_zero(after, M)))
        feature = UNDECIDED;
    return finish(round_limbs(d, both_ways(error)), parted, feature, FORWARD);
}

INLINE double sphere_distance(int parted, ARGUMENTS)
{
    upright m;
    double error;
    load_upright(&m, s, point, 0);
    const limbs root =
        root_of_limbs(m.square, double_root(m.rough_square), &m, &error);
    const limbs d = limbs_sub(root, split(cylint_r0(s), m.snap));
    return finish(round_limbs(d, both_ways(error)), parted, cylint_surface(s),
                  FORWARD);
}

/* ------------------------------------------------------------- kernels -- */

/* name_alone and name_parted, without and with the part, which is `parted` in the
 * call. */
#define KERNEL(name, is_parted, call)                    \
    static double name(ARGUMENTS)                        \
    {                                                    \
        enum { parted = is_parted };                     \
        return cylint_rounds_to_nearest()                \
                   ? call                                \
                   : cylint_undecided_distance(FORWARD); \
    }
#define KERNELS(name, call)       \
    KERNEL(name##_alone, 0, call) \
    KERNEL(name##_parted, 1, call)

KERNELS(cylinder, section_distance(0, parted, FORWARD))
KERNELS(cone, section_distance(1, parted, FORWARD))
KERNELS(sphere, sphere_distance(parted, FORWARD))
KERNELS(capsule, capsule_distance(parted, FORWARD))
KERNELS(round_cone, round_cone_distance(parted, FORWARD))

#define BOTH(name)                  \
    {                               \
        name##_alone, name##_parted \
    }
cylint_one_distance *const CYLINT_LIMB[CYLINT_KINDS][2] = {
    [CYLINT_KIND_NONE] = NEITHER,
    [CYLINT_KIND_CYLINDER] = BOTH(cylinder),
    [CYLINT_KIND_CONE] = BOTH(cone),
    [CYLINT_KIND_ACONE] = NEITHER,
    [CYLINT_KIND_ECYLINDER] = NEITHER,
    [CYLINT_KIND_ECONE] = NEITHER,
    [CYLINT_KIND_SPHERE] = BOTH(sphere),
    [CYLINT_KIND_CAPSULE] = BOTH(capsule),
    [CYLINT_KIND_RCONE] = BOTH(round_cone)};

#else

/* Without vectors of two lanes. */
cylint_one_distance *const CYLINT_LIMB[CYLINT_KINDS][2] = {
    NEITHER, NEITHER, NEITHER, NEITHER, NEITHER,
    NEITHER, NEITHER, NEITHER, NEITHER};

#endif
