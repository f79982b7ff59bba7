/*
 * oracle.c - the oracle: exact answers by real numbers with bounds (real.h)
 *
 * A solid is a union of pieces.  A piece is where F < 0 and up to two linear
 * functions are positive.  F is a sum of squares of linear functions, with signs.
 * On the line all these functions are polynomials in t.  Their zeros are the
 * critical parameters.  A point of each gap between two of them, and the critical
 * parameters themselves, are inside a piece, outside or on its boundary.  The
 * answer follows from that.  Of a half-space F is linear.
 */
#include "oracle.h"
#include "shapes/shape_facts.h"

enum { BOUNDS = 2, FUNCTIONS = 1 + BOUNDS, PIECES = 3, TERMS = 5 };
enum { MOST_CRITICAL = 2 * PIECES + PIECES * BOUNDS };
enum { TURN_BITS = 128 };

/* A function along the line: c[0] + c[1] t + c[2] t^2. */
typedef struct {
    real c[3];
} polynomial;

/* F is the sum of s L^2, L = v.(p - base) + a constant. */
typedef struct {
    int count;
    struct {
        real s;
        vector v;
        polynomial L;
    } term[TERMS];
    polynomial F;
} quadric;

typedef struct {
    quadric surface;
    int bounds;
    polynomial bound[BOUNDS];
} piece;

typedef struct {
    real t;
    unsigned zeros; /* the functions of which t is a zero: bits */
} critical;

/* What the answer to one question is computed from. */
static struct {
    int circular, round, plane, bounded, nappe;
    vector q, w, d;    /* q: the line's origin from the base; w: axis */
    vector o;          /* the line's origin */
    vector gx, gy, gz; /* gradients of x, y, z; circular: not normalised */
    real whole;        /* z = Z / whole, whole > 0 */
    real gamma, delta; /* the radius is proportional to gamma + delta Z */
    polynomial X, Y, Z, rho;
    int count_of_pieces; /* round: in the order of their parts */
    piece pieces[PIECES];
    int count;
    critical at[MOST_CRITICAL];
    int in[MOST_CRITICAL], in_gap[MOST_CRITICAL + 1]; /* as inside() */
} o_;

/* ------------------------------------------------------- polynomials ---- */

static real value_of(const polynomial *p, real t)
{
    return plus(times(plus(times(p->c[2], t), p->c[1]), t), p->c[0]);
}

/* v.(p - base) + constant, of points p of the line */
static polynomial along_line(vector v, real constant)
{
    const polynomial p = {
        {plus(dot(v, o_.q), constant), dot(v, o_.d), real_of(0)}};
    return p;
}

/* by + sign p */
static polynomial beyond(real by, const polynomial *p, int sign)
{
    const real s = real_of(sign);
    const polynomial moved = {
        {plus(by, times(s, p->c[0])), times(s, p->c[1]), times(s, p->c[2])}};
    return moved;
}

/* s (v.(p - base) + constant)^2 */
static void add_term(quadric *q, real s, vector v, real constant)
{
    polynomial *F = &q->F, *L = &q->term[q->count].L;
    if (q->count == 0)
        F->c[0] = F->c[1] = F->c[2] = real_of(0);
    memcpy(q->term[q->count].v, v, sizeof(vector));
    q->term[q->count++].s = s;
    *L = along_line(v, constant);
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            F->c[i + j] = plus(F->c[i + j], times(times(s, L->c[i]), L->c[j]));
}

/* s |p - base - center|^2; no center: the base */
static void add_distance(quadric *q, real s, const real *center)
{
    for (int i = 0; i < 3; i++) {
        vector e = {real_of(i == 0), real_of(i == 1), real_of(i == 2)};
        add_term(q, s, e, center ? negated(center[i]) : real_of(0));
    }
}

/* -(gamma + delta Z)^2, Z = v.(p - base) */
static void subtract_radius(quadric *q, vector v)
{
    vector by;
    scale(by, o_.delta, v);
    add_term(q, real_of(-1), by, o_.gamma);
    o_.rho = q->term[q->count - 1].L;
}

/* -------------------------------------------------------------- shapes -- */

/*
 * With Z = q.w, W = |w|^2, z = Z / W:
 *     distance^2 = |q|^2 - Z^2 / W,   radius = r0 + dr Z / W;
 * times W^2,
 *     F = W^2 |q|^2 - W Z^2 - (r0 W + dr Z)^2.
 * The cone by its tangent k has radius^2 = k^2 Z^2 / W; times W,
 *     F = W |q|^2 - Z^2 - (k Z)^2.
 */
static void load_circular(const cylint_shape *s, quadric *q)
{
    const int by_tangent = s->kind == CYLINT_KIND_ACONE;
    const real W = o_.whole = dot(o_.w, o_.w), r0 = real_of(cylint_r0(s));
    o_.Z = along_line(o_.w, real_of(0));
    o_.gamma = by_tangent ? real_of(0) : times(r0, W);
    o_.delta = real_of(cylint_r1(s));
    if (!by_tangent)
        o_.delta = minus(o_.delta, r0);
    add_distance(q, by_tangent ? W : times(W, W), NULL);
    add_term(q, negated(by_tangent ? real_of(1) : W), o_.w, real_of(0));
    subtract_radius(q, o_.w);
}

/*
 * q = x a + y b + z h by Cramer's rule, x = X / det with X = q.(b x h) and so on,
 * det = a.(b x h) made positive; times det^2,
 *     F = X^2 + Y^2 - (det + (k - 1) Z)^2.
 */
static void load_elliptic(const cylint_shape *s, quadric *q)
{
    vector a, b;
    set(a, cylint_a(s));
    set(b, cylint_b(s));
    cross(o_.gx, b, o_.w);
    cross(o_.gy, o_.w, a);
    cross(o_.gz, a, b);
    o_.whole = dot(a, o_.gx);
    const real sign = real_of(sign_of(o_.whole));
    o_.whole = times(o_.whole, sign);
    scale(o_.gx, sign, o_.gx);
    scale(o_.gy, sign, o_.gy);
    scale(o_.gz, sign, o_.gz);
    o_.X = along_line(o_.gx, real_of(0));
    o_.Y = along_line(o_.gy, real_of(0));
    o_.Z = along_line(o_.gz, real_of(0));
    o_.gamma = o_.whole;
    o_.delta = minus(real_of(s->kind == CYLINT_KIND_ECONE ? cylint_r1(s) : 1),
                     real_of(1));
    add_term(q, real_of(1), o_.gx, real_of(0));
    add_term(q, real_of(1), o_.gy, real_of(0));
    subtract_radius(q, o_.gz);
}

static void load_straight(const cylint_shape *s)
{
    piece *p = &o_.pieces[0];
    o_.count_of_pieces = 1;
    (o_.circular ? load_circular : load_elliptic)(s, &p->surface);
    if (o_.bounded) {
        p->bound[0] = o_.Z;
        p->bound[1] = beyond(o_.whole, &o_.Z, -1);
        p->bounds = 2;
    } else if (o_.nappe) {
        p->bound[0] = o_.rho;
        p->bounds = 1;
    }
}

static void load_ball(quadric *q, const real *center, double r)
{
    vector nothing = {real_of(0), real_of(0), real_of(0)};
    add_distance(q, real_of(1), center);
    add_term(q, real_of(-1), nothing, real_of(r));
}

/*
 * The convex hull of two balls is their union with the cone about the axis that
 * touches both, between the circles of contact.  That has the half angle with
 * sine (r0 - r1) / |w|:
 *     distance cos = r0 - Z sin / |w|,
 * squared and times W^2, W = |w|^2, distance^2 = |q|^2 - Z^2 / W,
 *     F = (W - dr^2) (W |q|^2 - Z^2) - (r0 W + dr Z)^2.
 * The circles are at Z = -r0 dr and W - r1 dr.
 */
static void load_round(const cylint_shape *s)
{
    const real r0 = real_of(cylint_r0(s)), r1 = real_of(cylint_r1(s));
    const real W = o_.whole = dot(o_.w, o_.w), dr = o_.delta = minus(r1, r0);
    piece *p = o_.pieces;
    o_.count_of_pieces = 1;
    o_.Z = along_line(o_.w, real_of(0));
    if (s->kind == CYLINT_KIND_SPHERE) {
        load_ball(&p->surface, NULL, cylint_r0(s));
        if (cylint_surface(s) == CYLINT_PART_CAP1) { /* the base is at z = 1 */
            scale(o_.w, real_of(-1), o_.w);
            o_.Z = along_line(o_.w, W);
        }
        return;
    }
    o_.count_of_pieces = 3;
    o_.gamma = times(r0, W);
    const real steep = minus(W, square_of(dr));
    add_distance(&p->surface, times(steep, W), NULL);
    add_term(&p->surface, negated(steep), o_.w, real_of(0));
    subtract_radius(&p->surface, o_.w);
    p->bound[0] = beyond(times(r0, dr), &o_.Z, 1);
    p->bound[1] = beyond(minus(W, times(r1, dr)), &o_.Z, -1);
    p->bounds = 2;
    load_ball(&p[CYLINT_PART_CAP0].surface, NULL, cylint_r0(s));
    load_ball(&p[CYLINT_PART_CAP1].surface, o_.w, cylint_r1(s));
}

/* The solid is where (p - base).n < 0.  There is no z and no angle. */
static void load_plane(void)
{
    o_.count_of_pieces = 1;
    o_.whole = real_of(0);
    o_.pieces[0].surface.F = along_line(o_.w, real_of(0));
}

/* Loads the shape; the line's direction is o_.d. */
static void load(const cylint_shape *s, const double o[3])
{
    o_.circular = !cylint_is_elliptic(s->kind);
    o_.round = cylint_is_round(s->kind);
    o_.plane = cylint_is_plane(s->kind);
    o_.nappe = s->ends == CYLINT_ENDS_NAPPE;
    o_.bounded = cylint_ends_are_planes(s->ends);
    set(o_.o, o);
    set_difference(o_.q, o, cylint_base(s));
    if (cylint_has_end_points(s->kind))
        set_difference(o_.w, cylint_top(s), cylint_base(s));
    else
        set(o_.w, cylint_axis(s));
    for (int i = 0; i < PIECES; i++)
        o_.pieces[i].bounds = o_.pieces[i].surface.count = 0;
    if (o_.plane)
        load_plane();
    else
        (o_.round ? load_round : load_straight)(s);
}

/* ------------------------------------------------ critical parameters -- */

static unsigned bit_of(int piece, int function)
{
    return 1u << (FUNCTIONS * piece + function);
}

/* Equal ones become one. */
static void add_critical(real t, unsigned zeros)
{
    int i = o_.count, order = -1;
    while (i > 0 && (order = order_of(o_.at[i - 1].t, t)) > 0)
        i--;
    if (i > 0 && order == 0) {
        o_.at[i - 1].zeros |= zeros;
        return;
    }
    memmove(&o_.at[i + 1], &o_.at[i],
            (size_t)(o_.count++ - i) * sizeof o_.at[0]);
    o_.at[i] = (critical){t, zeros};
}

/* The zeros of a polynomial that are isolated. */
static void add_zeros(const polynomial *p, unsigned bit)
{
    const real a = times(real_of(2), p->c[2]), b = negated(p->c[1]);
    if (sign_of(a) == 0) {
        if (sign_of(b) != 0)
            add_critical(over(p->c[0], b), bit);
        return;
    }
    const real D = minus(square_of(b), times(times(real_of(2), a), p->c[0]));
    const int sign = sign_of(D);
    if (sign >= 0)
        add_critical(over(minus(b, root_of(D)), a), bit);
    if (sign > 0)
        add_critical(over(plus(b, root_of(D)), a), bit);
}

/* The sign of a function of a piece at t, of which `zeros` are known. */
static int sign_at(int piece, int function, real t, unsigned zeros)
{
    const polynomial *p = function ? &o_.pieces[piece].bound[function - 1]
                                   : &o_.pieces[piece].surface.F;
    return zeros & bit_of(piece, function) ? 0 : sign_of(value_of(p, t));
}

/* 1 in the interior, 0 on the boundary, -1 outside. */
static int inside(real t, unsigned zeros)
{
    int in = -1;
    for (int i = 0; i < o_.count_of_pieces; i++) {
        int in_piece = -sign_at(i, 0, t, zeros);
        for (int k = 1; k <= o_.pieces[i].bounds; k++) {
            const int sign = sign_at(i, k, t, zeros);
            in_piece = sign < in_piece ? sign : in_piece;
        }
        in = in_piece > in ? in_piece : in;
    }
    return in;
}

/* Some t between critical parameter i - 1 and i. */
static real within_gap(int i)
{
    if (o_.count == 0)
        return real_of(0);
    if (i > 0 && i < o_.count)
        return times(real_of(0.5), plus(o_.at[i - 1].t, o_.at[i].t));
    const real end = o_.at[i ? i - 1 : 0].t;
    real step = plus(real_of(1), times(real_of(sign_of(end)), end));
    return i ? plus(end, step) : minus(end, step);
}

static void find_critical(void)
{
    o_.count = 0;
    for (int i = 0; i < o_.count_of_pieces; i++) {
        add_zeros(&o_.pieces[i].surface.F, bit_of(i, 0));
        for (int k = 0; k < o_.pieces[i].bounds; k++)
            add_zeros(&o_.pieces[i].bound[k], bit_of(i, 1 + k));
    }
    for (int i = 0; i <= o_.count; i++) {
        o_.in_gap[i] = inside(within_gap(i), 0);
        if (i < o_.count)
            o_.in[i] = inside(o_.at[i].t, o_.at[i].zeros);
    }
}

/* -------------------------------------- points, normals, z and the angle -- */

/* Of the hits of the answer: oracle_real_hit(), oracle_other(). */
static oracle_hit real_hits_[2];
static cylint_hit others_[2];

/* The double nearest to x.  *other is it too, or, if x is nearer than 2^-90 of
 * itself to the middle of two doubles, the other one of the two. */
static double nearest_real(real x, double *other)
{
    const double nearest = *other = near_double(x) + 0;
    for (int sign = -1; sign <= 1; sign += 2) {
        real moved = times(x, plus(real_of(1), real_of(sign * 0x1p-90)));
        const double beside = mpfr_get_d(moved->x, RND) + 0;
        *other = beside != nearest ? beside : *other;
    }
    return nearest;
}

/* The normal at the apex: away from the solid; of a double cone against d, or
 * towards the base. */
static int apex_normal_sign(void)
{
    const int opening = sign_of(o_.delta), along = sign_of(dot(o_.w, o_.d));
    if (o_.bounded || o_.nappe)
        return -opening;
    if (along != 0)
        return -along;
    return sign_of(o_.gamma) == 0 ? -1 : opening;
}

/* Half the gradient of F. */
static void gradient(const quadric *q, real t, vector n)
{
    for (int i = 0; i < 3; i++)
        n[i] = real_of(0);
    for (int k = 0; k < q->count; k++) {
        const real sL = times(q->term[k].s, value_of(&q->term[k].L, t));
        for (int i = 0; i < 3; i++)
            n[i] = plus(n[i], times(sL, q->term[k].v[i]));
    }
}

/* The normal at t on a part. */
static void normal_at(real t, int part, vector n)
{
    const int sphere = o_.round && o_.count_of_pieces == 1;
    int sign = 1;
    if (o_.plane) {
        memcpy(n, o_.w, sizeof o_.w);
    } else if (!o_.round && part != CYLINT_PART_LATERAL) {
        memcpy(n, o_.circular ? o_.w : o_.gz, sizeof o_.w);
        sign = part == CYLINT_PART_CAP1 ? 1 : -1;
    } else if (part == CYLINT_PART_LATERAL && !sphere &&
               sign_of(value_of(&o_.rho, t)) == 0) {
        memcpy(n, o_.w, sizeof o_.w);
        sign = apex_normal_sign();
    } else {
        gradient(&o_.pieces[sphere ? 0 : part].surface, t, n);
    }
    divide(n, n, times(real_of(sign), norm(n)));
}

/* Circular kinds: X and Y along e x w and w x (e x w); Y needs / |w|. */
static void circular_plane(void)
{
    perpendicular(o_.gx, o_.w);
    cross(o_.gy, o_.w, o_.gx);
    o_.X = along_line(o_.gx, real_of(0));
    o_.Y = along_line(o_.gy, real_of(0));
}

/* An angle in [0, 1): a double below 1. */
static double below_one(double phi)
{
    return phi < 1 ? phi : 0x1.fffffffffffffp-1;
}

static real phi_at(real t)
{
    if (o_.circular)
        circular_plane();
    const real x = value_of(&o_.X, t), y = value_of(&o_.Y, t);
    return real_turns(x, o_.circular ? over(y, root_of(o_.whole)) : y,
                      TURN_BITS);
}

/* --------------------------------------------------------------- hits -- */

static int relation(void)
{
    int crosses = 0, points = 0, pieces = 0;
    for (int i = 0; i <= o_.count; i++) {
        const int at = i < o_.count ? o_.in[i] : -1;
        crosses |= o_.in_gap[i] > 0 || at > 0;
        pieces += o_.in_gap[i] >= 0;
        points += at >= 0;
    }
    return crosses  ? CYLINT_RELATION_CROSS
           : pieces ? CYLINT_RELATION_ALONG
           : points ? CYLINT_RELATION_TOUCH
                    : CYLINT_RELATION_MISS;
}

/* The side of a hit at critical parameter i, or -1 for none. */
static int side_at(int i)
{
    const int before = o_.in_gap[i], after = o_.in_gap[i + 1];
    if (o_.in[i] < 0)
        return -1;
    if (before >= 0 && after >= 0)
        return o_.in[i] == 0 && before > 0 && after > 0 ? CYLINT_SIDE_BOTH : -1;
    return before >= 0  ? CYLINT_SIDE_LEAVING
           : after >= 0 ? CYLINT_SIDE_ENTERING
                        : CYLINT_SIDE_BOTH;
}

static int part_at(const cylint_shape *s, const critical *at)
{
    if (s->kind == CYLINT_KIND_SPHERE)
        return cylint_surface(s);
    if (o_.round)
        return sign_at(0, 1, at->t, at->zeros) < 0   ? CYLINT_PART_CAP0
               : sign_at(0, 2, at->t, at->zeros) < 0 ? CYLINT_PART_CAP1
                                                     : CYLINT_PART_LATERAL;
    return sign_at(0, 0, at->t, at->zeros) == 0 ? CYLINT_PART_LATERAL
           : at->zeros & bit_of(0, 1)           ? CYLINT_PART_CAP0
                                                : CYLINT_PART_CAP1;
}

/* All members of hit i but its part, which is written. */
static void describe(real t, cylint_hit *hit, int i)
{
    oracle_hit *r = &real_hits_[i];
    cylint_hit *other = &others_[i];
    r->t = t;
    normal_at(t, hit->part, r->normal);
    for (int j = 0; j < 3; j++) {
        r->point[j] = plus(o_.o[j], times(o_.d[j], t));
        hit->point[j] = nearest_double(r->point[j]);
        hit->normal[j] = nearest_real(r->normal[j], &other->normal[j]);
    }
    if (sign_of(o_.whole) == 0) /* no axis */
        return;
    r->z = over(value_of(&o_.Z, t), o_.whole);
    r->phi = phi_at(t);
    hit->z = nearest_double(r->z);
    hit->phi = below_one(nearest_real(r->phi, &other->phi));
    other->phi = below_one(other->phi);
}

/* Whether t < bound (sign -1) or t > bound (sign 1). */
static int is_beyond(real t, double bound, int sign)
{
    return isfinite(bound) ? sign * order_of(t, real_of(bound)) > 0
                           : sign * bound < 0;
}

static void find_hits(const cylint_shape *s, const cylint_line *line,
                      unsigned want, cylint_answer *expected)
{
    memset(expected, 0, sizeof *expected);
    memset(others_, 0, sizeof others_);
    find_critical();
    expected->relation = relation();
    for (int i = 0; i < o_.count; i++) {
        const int side = side_at(i);
        if (side < 0 || is_beyond(o_.at[i].t, line->tmin, -1) ||
            is_beyond(o_.at[i].t, line->tmax, 1))
            continue;
        const int part = part_at(s, &o_.at[i]);
        if (part != CYLINT_PART_LATERAL &&
            !has_cap(s, part == CYLINT_PART_CAP1))
            continue;
        cylint_hit *hit = &expected->hit[expected->n];
        hit->t = nearest_double(o_.at[i].t);
        hit->side = side;
        hit->part = part;
        if (want == CYLINT_WANT_ALL)
            describe(o_.at[i].t, hit, expected->n);
        expected->n++;
    }
}

int oracle_contains(const cylint_shape *s, const double point[3])
{
    static const double nowhere[3] = {0, 0, 0};
    int in = 0;
    if (s->kind == CYLINT_KIND_NONE || !isfinite(point[0]) ||
        !isfinite(point[1]) || !isfinite(point[2]))
        return -1;
    for (real_start(range_of_question(s, point)); real_again();) {
        set(o_.d, nowhere);
        load(s, point);
        in = inside(real_of(0), 0);
    }
    return in;
}

struct oracle_place oracle_place(void)
{
    const struct oracle_place place = {
        sign_of(o_.pieces[0].surface.F.c[0]) == 0, sign_of(o_.rho.c[0]) == 0,
        sign_of(o_.Z.c[0]) == 0, order_of(o_.Z.c[0], o_.whole) == 0};
    return place;
}

const cylint_hit *oracle_other(int i)
{
    return &others_[i];
}

const oracle_hit *oracle_real_hit(int i)
{
    return &real_hits_[i];
}

void oracle_intersect(const cylint_shape *s, const cylint_line *line,
                      unsigned want, cylint_answer *expected)
{
    exponents of_d = no_exponents;
    memset(expected, 0, sizeof *expected);
    if (s->kind == CYLINT_KIND_NONE || !line->valid) {
        expected->flags = CYLINT_FLAG_INVALID;
        return;
    }
    widen(&of_d, line->segment ? line->o : line->d, 3);
    widen(&of_d, line->end, line->segment ? 3 : 0);
    const long range = range_of_question(s, line->o),
               range_of_d = range_of(of_d);
    for (real_start(range > range_of_d ? range : range_of_d); real_again();) {
        if (line->segment)
            set_difference(o_.d, line->end, line->o);
        else
            set(o_.d, line->d);
        load(s, line->o);
        find_hits(s, line, want, expected);
    }
}
