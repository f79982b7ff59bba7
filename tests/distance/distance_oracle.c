/*
 * distance_oracle.c - the oracle of distances to all kinds but elliptic ones
 *
 * The meridian half plane has the coordinates s, along the axis from the base,
 * and rho >= 0, the distance from the axis.  The figure's pieces are
 *     lateral surface   a segment, a ray, a line or two rays
 *     caps of planes    segments from the axis
 *     round ends        arcs of circles about points of the axis
 *     half-space        a ray from the axis, which is along the normal
 * The nearest point of each piece follows by projection.  The first piece with
 * the least distance is the answer.
 */
#include "distance_oracle.h"

#include "cylint_distance.h"
#include "oracle.h"
#include "real.h"
#include "shapes/shape_facts.h"

/* distance_oracle_elliptic.c; size: the distance, not rounded */
void oracle_elliptic_distance(const cylint_shape *shape, const double point[3],
                              struct oracle_closest *expected, mpfr_t size);

enum { PIECES = 4 };

enum form { SEGMENT, RAY, LINE, ARC };

/* A point of the half plane; a normal there. */
typedef struct {
    real s, rho;
} planar;

typedef struct piece {
    enum form form;
    planar at, by, n;               /* start, direction, normal; arc: centre */
    real r;                         /* arc: the radius */
    int part, feature, first, last; /* inside, at the start, at the end */
} piece;

/* The nearest point of a piece. */
typedef struct {
    planar at, n;
    real distance;
    int part, feature;
} foot;

static struct {
    piece pieces[PIECES];
    int count;
    vector w, q, across;
    real length, r0, r1, dr, zero, sine;
    planar point;
} g;

/* The last distance, not rounded. */
static mpfr_t last_;

static planar planar_of(real s, real rho)
{
    const planar p = {s, rho};
    return p;
}

/* sqrt(x^2 + y^2) */
static real hypotenuse(planar p)
{
    return root_of(plus(square_of(p.s), square_of(p.rho)));
}

static planar difference(planar p, planar q)
{
    return planar_of(minus(p.s, q.s), minus(p.rho, q.rho));
}

/* at + t by */
static planar moved(planar at, real t, planar by)
{
    return planar_of(plus(at.s, times(t, by.s)),
                     plus(at.rho, times(t, by.rho)));
}

static planar divided(planar p, real by)
{
    return planar_of(over(p.s, by), over(p.rho, by));
}

/* ------------------------------------------------- shape and point ----- */

/* The unit vector away from the axis through the point; on the axis e x w. */
static void load_across(void)
{
    vector c;
    cross(c, g.q, g.w);
    if (sign_of(c[0]) == 0 && sign_of(c[1]) == 0 && sign_of(c[2]) == 0) {
        perpendicular(g.across, g.w);
        g.point.rho = g.zero;
    } else {
        cross(g.across, g.w, c); /* |w|^2 q - (w.q) w */
        g.point.rho = over(norm(c), g.length);
    }
    divide(g.across, g.across, norm(g.across));
}

static void load(const cylint_shape *shape, const double point[3])
{
    static const double any_axis[3] = {0, 0, 1};
    g.zero = real_of(0);
    set_difference(g.q, point, cylint_base(shape));
    if (shape->kind == CYLINT_KIND_SPHERE)
        set(g.w, any_axis);
    else if (cylint_has_end_points(shape->kind))
        set_difference(g.w, cylint_top(shape), cylint_base(shape));
    else
        set(g.w, cylint_axis(shape));
    g.length = norm(g.w);
    g.point.s = over(dot(g.q, g.w), g.length);
    load_across();
    g.r0 = real_of(cylint_r0(shape));
    g.r1 = real_of(cylint_r1(shape));
    if (shape->kind == CYLINT_KIND_ACONE)
        g.r1 = times(g.r1, g.length);
    g.dr = minus(g.r1, g.r0);
}

/* -------------------------------------------------------------- pieces -- */

static piece *new_piece(enum form form, int part, int feature, real s, real rho)
{
    piece *p = &g.pieces[g.count++];
    p->form = form;
    p->part = part;
    p->feature = p->first = p->last = feature;
    p->at = planar_of(s, rho);
    return p;
}

/* The direction, and the normal (-drho, ds) turned outward: away from the
 * axis. */
static void set_direction(piece *p, real ds, real drho)
{
    p->by = planar_of(ds, drho);
    p->n = divided(planar_of(negated(drho), ds), hypotenuse(p->by));
    if (sign_of(ds) < 0)
        p->n = planar_of(negated(p->n.s), negated(p->n.rho));
}

static piece *add_lateral(enum form form, real s0, real rho0, real s1,
                          real rho1)
{
    piece *p =
        new_piece(form, CYLINT_PART_LATERAL, CYLINT_FEATURE_LATERAL, s0, rho0);
    set_direction(p, minus(s1, s0), minus(rho1, rho0));
    p->first = sign_of(rho0) ? CYLINT_FEATURE_RIM0 : CYLINT_FEATURE_APEX;
    p->last = sign_of(rho1) ? CYLINT_FEATURE_RIM1 : CYLINT_FEATURE_APEX;
    return p;
}

/* From the apex to the side `sign` of the axis. */
static void add_nappe(int sign)
{
    const real apex = negated(over(times(g.r0, g.length), g.dr));
    piece *p = add_lateral(RAY, apex, g.zero, apex, g.zero);
    set_direction(p, times(real_of(sign), g.length),
                  times(real_of(sign_of(g.dr)), g.dr));
}

static real radius_at(int end)
{
    return end ? g.r1 : g.r0;
}

/* A cap: a segment from the axis, or an arc.  An apex has none. */
static void add_end(enum form form, int end, int part, int feature)
{
    if (sign_of(radius_at(end)) == 0)
        return;
    piece *p = new_piece(form, part, feature, end ? g.length : g.zero, g.zero);
    p->r = radius_at(end);
    p->by = planar_of(g.zero, p->r);
    p->n = planar_of(real_of(end ? 1 : -1), g.zero);
}

static void add_caps(const cylint_shape *shape, enum form form)
{
    for (int end = 0; end < 2; end++)
        if (has_cap(shape, end))
            add_end(form, end, end ? CYLINT_PART_CAP1 : CYLINT_PART_CAP0,
                    end ? CYLINT_FEATURE_CAP1 : CYLINT_FEATURE_CAP0);
}

static void straight_pieces(const cylint_shape *shape)
{
    const int growth = sign_of(g.dr);
    if (shape->ends < CYLINT_ENDS_INFINITE) {
        add_lateral(SEGMENT, g.zero, g.r0, g.length, g.r1);
        add_caps(shape, SEGMENT);
    } else if (growth == 0) {
        add_lateral(LINE, g.zero, g.r0, g.length, g.r1);
    } else {
        add_nappe(growth);
        if (shape->ends == CYLINT_ENDS_INFINITE)
            add_nappe(-growth);
    }
}

static void plane_piece(void)
{
    piece *p = new_piece(RAY, CYLINT_PART_LATERAL, CYLINT_FEATURE_LATERAL,
                         g.zero, g.zero);
    p->by = planar_of(g.zero, real_of(1));
    p->n = planar_of(real_of(1), g.zero);
}

/* The segment that touches both arcs. */
static void round_pieces(const cylint_shape *shape)
{
    static const int feature[] = {CYLINT_FEATURE_LATERAL, CYLINT_FEATURE_CAP0,
                                  CYLINT_FEATURE_CAP1};
    const int of_ball = cylint_surface(shape);
    if (shape->kind == CYLINT_KIND_SPHERE) {
        if (of_ball == CYLINT_PART_LATERAL ||
            has_cap(shape, of_ball == CYLINT_PART_CAP1))
            add_end(ARC, 0, of_ball, feature[of_ball]);
        return;
    }
    g.sine = negated(over(g.dr, g.length)); /* of the normal's angle: its s */
    const real cosine = root_of(minus(real_of(1), square_of(g.sine)));
    add_lateral(SEGMENT, times(g.r0, g.sine), times(g.r0, cosine),
                plus(g.length, times(g.r1, g.sine)), times(g.r1, cosine));
    add_caps(shape, ARC);
}

/* ------------------------------------------------------- nearest points -- */

static foot foot_of_straight(const piece *p)
{
    const planar q = difference(g.point, p->at);
    const real length = hypotenuse(p->by);
    real t = over(plus(times(q.s, p->by.s), times(q.rho, p->by.rho)), length);
    foot f = {p->at, p->n, NULL, p->part, p->feature};
    if (p->form != LINE && sign_of(t) <= 0) {
        t = g.zero;
        f.feature = p->first;
    } else if (p->form == SEGMENT && order_of(t, length) >= 0) {
        t = length;
        f.feature = p->last;
    }
    f.at = moved(p->at, over(t, length), p->by);
    return f;
}

/* Feature -1: the nearest point belongs to the lateral surface, or the point is
 * the centre. */
static foot foot_of_arc(const piece *p, const cylint_shape *shape)
{
    const planar q = difference(g.point, p->at);
    const real length = hypotenuse(q);
    foot f = {p->at, p->n, NULL, p->part, -1};
    if (sign_of(length) == 0)
        return f;
    f.n = divided(q, length);
    f.at = moved(p->at, p->r, f.n);
    if (shape->kind == CYLINT_KIND_SPHERE ||
        order_of(f.n.s, g.sine) == (p->part == CYLINT_PART_CAP1 ? 1 : -1))
        f.feature = p->feature;
    return f;
}

/* Along the axis; of a double cone towards the base. */
static planar apex_normal(const piece *p, int is_double)
{
    int sign = p->first == CYLINT_FEATURE_APEX ? -1 : 1;
    if (p->form == RAY)
        sign *= sign_of(p->by.s);
    if (is_double && sign_of(g.r0) != 0)
        sign = sign_of(g.dr);
    return planar_of(real_of(sign), g.zero);
}

/* The first piece with the least distance; feature -1: none. */
static foot nearest_foot(const cylint_shape *shape)
{
    foot best = {{NULL, NULL}, {NULL, NULL}, NULL, -1, -1};
    for (int i = 0; i < g.count; i++) {
        const piece *p = &g.pieces[i];
        foot f = p->form == ARC ? foot_of_arc(p, shape) : foot_of_straight(p);
        if (f.feature < 0)
            continue;
        f.distance = hypotenuse(difference(f.at, g.point));
        if (f.feature == CYLINT_FEATURE_APEX)
            f.n = apex_normal(p, shape->ends == CYLINT_ENDS_INFINITE);
        if (best.feature < 0 || order_of(f.distance, best.distance) < 0)
            best = f;
    }
    return best;
}

/* At the centre of a sphere: along the first coordinate. */
static foot foot_from_centre(void)
{
    const piece *p = &g.pieces[0];
    const foot f = {
        {g.r0, g.zero}, {real_of(1), g.zero}, g.r0, p->part, p->feature};
    g.w[0] = real_of(1);
    g.w[1] = g.w[2] = g.zero;
    return f;
}

/* ---------------------------------------------------------- the answer -- */

/* to = s (the axis's direction) + rho across + base */
static void in_space(double to[3], planar at, const double *base)
{
    for (int i = 0; i < 3; i++) {
        real x = plus(times(at.s, over(g.w[i], g.length)),
                      times(at.rho, g.across[i]));
        if (base)
            x = plus(x, real_of(base[i]));
        to[i] = nearest_double(x);
    }
}

/* The distance with its sign.  side: of contains(). */
static real signed_distance(const cylint_shape *shape, real distance, int side)
{
    const int is_signed = shape->ends == CYLINT_ENDS_CAPPED ||
                          shape->ends >= CYLINT_ENDS_INFINITE;
    if (sign_of(distance) == 0 || (is_signed && side == 0))
        return g.zero;
    return is_signed && side > 0 ? negated(distance) : distance;
}

static void circular_distance(const cylint_shape *shape, const double point[3],
                              int side, struct oracle_closest *expected)
{
    load(shape, point);
    g.count = 0;
    if (shape->kind == CYLINT_KIND_HALFSPACE)
        plane_piece();
    else if (shape->kind >= CYLINT_KIND_SPHERE)
        round_pieces(shape);
    else
        straight_pieces(shape);
    foot f = nearest_foot(shape);
    if (shape->kind == CYLINT_KIND_SPHERE && g.count > 0 && f.feature < 0)
        f = foot_from_centre();
    expected->part = f.part;
    expected->distance = HUGE_VAL;
    if (f.part < 0)
        return;
    const real distance = signed_distance(shape, f.distance, side);
    expected->feature = f.feature;
    expected->distance = near_double(distance);
    mpfr_set_prec(last_, reals.bits);
    mpfr_set(last_, distance->x, RND);
    in_space(expected->point, f.at, cylint_base(shape));
    in_space(expected->normal, f.n, NULL);
}

void oracle_distance(const cylint_shape *shape, const double point[3],
                     struct oracle_closest *expected)
{
    static int is_ready;
    memset(expected, 0, sizeof *expected);
    if (!is_ready)
        mpfr_init(last_);
    is_ready = 1;
    if (cylint_is_elliptic(shape->kind)) {
        oracle_elliptic_distance(shape, point, expected, last_);
        return;
    }
    const int side = oracle_contains(shape, point);
    for (real_start(range_of_question(shape, point)); real_again();)
        circular_distance(shape, point, side, expected);
}

int oracle_distance_is_zero(void)
{
    return mpfr_zero_p(last_) != 0;
}

double oracle_distance_error(double got)
{
    int e;
    mpfr_t off;
    if (mpfr_zero_p(last_))
        return got == 0 ? 0 : HUGE_VAL;
    if (!isfinite(got))
        return isinf(got) && isinf(mpfr_get_d(last_, RND)) ? 0 : HUGE_VAL;
    frexp(mpfr_get_d(last_, MPFR_RNDZ), &e);
    if (mpfr_get_exp(last_) - 53 < -1074)
        e = -1074 + 53;
    mpfr_init2(off, mpfr_get_prec(last_));
    mpfr_abs(off, last_, RND);
    mpfr_d_sub(off, fabs(got), off, RND);
    mpfr_mul_2si(off, off, 53 - e, RND);
    const double error = mpfr_get_d(off, RND);
    mpfr_clear(off);
    return error;
}
