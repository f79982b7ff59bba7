/*
 * oracle.c - the oracle: exact answers by integer arithmetic
 *
 * There are two units.  Lengths (o, base, axis, radii, a, b) are integers times
 * 2^unit, the direction d is integers times 2^d_unit.  So the parameter of this
 * file is tau with t = tau 2^(unit - d_unit).
 *
 * In these units every lateral surface on the line is
 *     F(tau) = A tau^2 + 2 B tau + C,        F < 0 inside,
 * and z and the radius are linear in tau.  The critical parameters (roots of F,
 * of z, of z - 1 and of the radius) all have the form
 *     tau = (p + q sqrt(D)) / r,   q in {-1, 0, 1},  r > 0,  D = B^2 - A C,
 * and comparing them needs only the sign of x + y sqrt(D).
 */
#include "oracle.h"
#include "shapes/layout.h"
#include "oracle_field.h"

/* ------------------------------------------------------ shape and line -- */

static int elliptic(const cylint_shape *shape)
{
    return shape->kind == CYLINT_KIND_ECYLINDER ||
           shape->kind == CYLINT_KIND_ECONE;
}

static void load_lengths(const cylint_shape *shape, const double o[3])
{
    const double radii[2] = {cylint_r0(shape), cylint_r1(shape)};
    o_.unit = LONG_MAX;
    lower_unit(&o_.unit, o, 3);
    lower_unit(&o_.unit, cylint_base(shape), 3);
    o_.circular = !elliptic(shape);
    if (!o_.circular || shape->kind == CYLINT_KIND_ACONE) {
        lower_unit(&o_.unit, cylint_axis(shape), 3);
        lower_unit(&o_.unit, cylint_a(shape), o_.circular ? 0 : 3);
        lower_unit(&o_.unit, cylint_b(shape), o_.circular ? 0 : 3);
        whole3(o_.w, cylint_axis(shape), o_.unit);
    } else {
        lower_unit(&o_.unit, cylint_top(shape), 3);
        lower_unit(&o_.unit, radii, 2);
        difference(o_.w, cylint_top(shape), cylint_base(shape), o_.unit);
    }
    whole3(o_.base, cylint_base(shape), o_.unit);
    whole3(o_.o, o, o_.unit);
    for (int i = 0; i < 3; i++)
        mpz_sub(o_.q[i], o_.o[i], o_.base[i]);
}

/*
 * Circular kinds, with Z = q.w, W = |w|^2, z = Z / W:
 *     distance^2 = |q|^2 - Z^2 / W,   radius = r0 + dr Z / W;
 * times W^2,
 *     F = W^2 |q|^2 - W Z^2 - (r0 W + dr Z)^2.
 * The cone by its tangent k = K 2^-s has radius^2 = k^2 Z^2 / W; times
 * W 4^s,
 *     F = 4^s W |q|^2 - 4^s Z^2 - (K Z)^2.
 * Both are  alpha |q|^2 - beta Z^2 - (gamma + delta Z)^2.
 */
static void load_circular(const cylint_shape *shape)
{
    dot(o_.whole, o_.w, o_.w);
    if (shape->kind == CYLINT_KIND_ACONE) {
        long unit = 0;
        lower_unit(&unit, cylint_radii(shape) + 1, 1);
        whole(o_.delta, cylint_r1(shape), unit);
        mpz_set_ui(o_.gamma, 0);
        mpz_set_ui(o_.beta, 1);
        mpz_mul_2exp(o_.beta, o_.beta, (mp_bitcnt_t)(-2 * unit));
        mpz_mul(o_.alpha, o_.beta, o_.whole);
    } else {
        whole(o_.r0, cylint_r0(shape), o_.unit);
        whole(o_.dr, cylint_r1(shape), o_.unit);
        mpz_sub(o_.delta, o_.dr, o_.r0);
        mpz_mul(o_.gamma, o_.r0, o_.whole);
        mpz_set(o_.beta, o_.whole);
        mpz_mul(o_.alpha, o_.whole, o_.whole);
    }
}

/*
 * Elliptic kinds: q = x a + y b + z h by Cramer's rule, x = X / det with
 * X = q.(b x h) and so on, det = a.(b x h) made positive; k - 1 = K 2^-s;
 * times det^2 4^s,
 *     F = 4^s (X^2 + Y^2) - (2^s det + K Z)^2.
 */
static void load_elliptic(const cylint_shape *shape)
{
    whole3(o_.a, cylint_a(shape), o_.unit);
    whole3(o_.b, cylint_b(shape), o_.unit);
    cross(o_.gx, o_.b, o_.w);
    cross(o_.gy, o_.w, o_.a);
    cross(o_.gz, o_.a, o_.b);
    dot(o_.whole, o_.a, o_.gx);
    if (mpz_sgn(o_.whole) < 0) {
        mpz_neg(o_.whole, o_.whole);
        for (int i = 0; i < 3; i++) {
            mpz_neg(o_.gx[i], o_.gx[i]);
            mpz_neg(o_.gy[i], o_.gy[i]);
            mpz_neg(o_.gz[i], o_.gz[i]);
        }
    }
    long unit = 0;
    const double k = shape->kind == CYLINT_KIND_ECONE ? cylint_r1(shape) : 1;
    lower_unit(&unit, &k, 1);
    whole(o_.delta, k, unit);
    mpz_set_ui(o_.beta, 1);
    mpz_mul_2exp(o_.beta, o_.beta, (mp_bitcnt_t)-unit);
    mpz_sub(o_.delta, o_.delta, o_.beta);
    mpz_mul(o_.gamma, o_.whole, o_.beta);
    mpz_mul(o_.alpha, o_.beta, o_.beta);
    mpz_set_ui(o_.beta, 0);
}

/* g(tau) = v.q + v.d tau */
static void along_line(linear *g, mpz_t v[3])
{
    dot(g->g0, v, o_.q);
    dot(g->g1, v, o_.d);
}

/* sum += s u v */
static void add_product(mpz_t sum, mpz_t s, mpz_t u, mpz_t v, int sign)
{
    mpz_mul(o_.s[0], u, v);
    mpz_mul(o_.s[0], o_.s[0], s);
    if (sign > 0)
        mpz_add(sum, sum, o_.s[0]);
    else
        mpz_sub(sum, sum, o_.s[0]);
}

/* A, B, C += sign s g^2 */
static void add_square(mpz_t s, const linear *g, int sign)
{
    linear *h = (linear *)g;
    add_product(o_.A, s, h->g1, h->g1, sign);
    add_product(o_.B, s, h->g0, h->g1, sign);
    add_product(o_.C, s, h->g0, h->g0, sign);
}

static void load_quadratic(void)
{
    mpz_set_ui(o_.s[3], 1);
    mpz_mul(o_.rho.g0, o_.delta, o_.Z.g0);
    mpz_add(o_.rho.g0, o_.rho.g0, o_.gamma);
    mpz_mul(o_.rho.g1, o_.delta, o_.Z.g1);
    if (o_.circular) {
        dot(o_.A, o_.d, o_.d);
        dot(o_.B, o_.q, o_.d);
        dot(o_.C, o_.q, o_.q);
        mpz_mul(o_.A, o_.A, o_.alpha);
        mpz_mul(o_.B, o_.B, o_.alpha);
        mpz_mul(o_.C, o_.C, o_.alpha);
        add_square(o_.beta, &o_.Z, -1);
    } else {
        mpz_set_ui(o_.A, 0);
        mpz_set_ui(o_.B, 0);
        mpz_set_ui(o_.C, 0);
        add_square(o_.alpha, &o_.X, 1);
        add_square(o_.alpha, &o_.Y, 1);
    }
    add_square(o_.s[3], &o_.rho, -1);
    mpz_mul(o_.D, o_.B, o_.B);
    mpz_submul(o_.D, o_.A, o_.C);
}

/* Loads the shape and the line o + tau d; o_.d is set. */
static void load(const cylint_shape *shape, const double o[3])
{
    load_lengths(shape, o);
    if (o_.circular) {
        load_circular(shape);
        along_line(&o_.Z, o_.w);
    } else {
        load_elliptic(shape);
        along_line(&o_.X, o_.gx);
        along_line(&o_.Y, o_.gy);
        along_line(&o_.Z, o_.gz);
    }
    load_quadratic();
    o_.nappe = shape->ends == CYLINT_ENDS_NAPPE;
    o_.bounded = !o_.nappe && shape->ends != CYLINT_ENDS_INFINITE;
}

static void load_line(const cylint_line *line)
{
    o_.d_unit = LONG_MAX;
    if (line->segment) {
        lower_unit(&o_.d_unit, line->o, 3);
        lower_unit(&o_.d_unit, line->end, 3);
        difference(o_.d, line->end, line->o, o_.d_unit);
    } else {
        lower_unit(&o_.d_unit, line->d, 3);
        whole3(o_.d, line->d, o_.d_unit);
    }
}

/* ------------------------------------------------ critical parameters -- */

/* tau = (p + q sqrt(D)) / r for any r but 0 */
static void add_critical(mpz_t p, int q, mpz_t r, int lateral)
{
    critical *at = &o_.at[o_.count++];
    mpz_set(at->p, p);
    mpz_abs(at->r, r);
    if (mpz_sgn(r) < 0)
        mpz_neg(at->p, at->p);
    at->q = q;
    at->lateral = lateral;
}

/* g(tau) = c, if it has one solution */
static void add_plane(linear *g, mpz_t c)
{
    if (mpz_sgn(g->g1) != 0) {
        mpz_sub(o_.s[1], c, g->g0);
        add_critical(o_.s[1], 0, g->g1, 0);
    }
}

static void add_roots(void)
{
    mpz_neg(o_.s[1], o_.B);
    if (mpz_sgn(o_.A) == 0) {
        if (mpz_sgn(o_.B) != 0) {
            mpz_neg(o_.s[1], o_.C);
            mpz_mul_2exp(o_.s[2], o_.B, 1);
            add_critical(o_.s[1], 0, o_.s[2], 1);
        }
    } else if (mpz_sgn(o_.D) == 0) {
        add_critical(o_.s[1], 0, o_.A, 1);
    } else if (mpz_sgn(o_.D) > 0) {
        add_critical(o_.s[1], -1, o_.A, 1);
        add_critical(o_.s[1], 1, o_.A, 1);
    }
}

/* F at a parameter that is not one of its roots, hence rational. */
static int lateral_sign(const critical *at)
{
    if (at->lateral)
        return 0;
    mpz_mul(o_.s[1], o_.A, at->p);
    mpz_mul(o_.s[2], o_.B, at->r);
    mpz_addmul_ui(o_.s[1], o_.s[2], 2);
    mpz_mul(o_.s[1], o_.s[1], at->p);
    mpz_mul(o_.s[2], o_.C, at->r);
    mpz_addmul(o_.s[1], o_.s[2], at->r);
    return mpz_sgn(o_.s[1]);
}

/* Sorts and merges equal ones; the result is lateral if one of them is. */
static void sort_critical(void)
{
    int kept = 0;
    for (int i = 1; i < o_.count; i++) {
        for (int j = i; j > 0 && compare(&o_.at[j - 1], &o_.at[j]) > 0; j--) {
            const critical swapped = o_.at[j];
            o_.at[j] = o_.at[j - 1];
            o_.at[j - 1] = swapped;
        }
    }
    for (int i = 1; i < o_.count; i++) {
        if (compare(&o_.at[kept], &o_.at[i]) == 0) {
            o_.at[kept].lateral |= o_.at[i].lateral;
        } else if (++kept != i) {
            const critical swapped = o_.at[i];
            o_.at[i] = o_.at[kept];
            o_.at[kept] = swapped;
        }
    }
    o_.count = o_.count > 0 ? kept + 1 : 0;
}

static void find_critical(void)
{
    mpz_t nothing;
    mpz_init(nothing);
    o_.count = 0;
    add_roots();
    if (o_.bounded) {
        add_plane(&o_.Z, nothing);
        add_plane(&o_.Z, o_.whole);
    } else if (o_.nappe) {
        add_plane(&o_.rho, nothing);
    }
    mpz_clear(nothing);
    sort_critical();
    for (int i = 0; i < o_.count; i++)
        o_.at[i].lateral = lateral_sign(&o_.at[i]) == 0;
}

/* --------------------------------------------------------- membership -- */

/* 1 interior, 0 boundary, -1 outside, from the sign of F and from the signs of
 * the values that must not be negative. */
static int combine(int f, int low, int high)
{
    if (f > 0 || low < 0 || high < 0)
        return -1;
    return f < 0 && low > 0 && high > 0;
}

/* g = whole - Z */
static void below_top(linear *g)
{
    mpz_init(g->g0);
    mpz_init(g->g1);
    mpz_sub(g->g0, o_.whole, o_.Z.g0);
    mpz_neg(g->g1, o_.Z.g1);
}

static int inside_at(const critical *at)
{
    const int f = lateral_sign(at);
    if (o_.nappe)
        return combine(f, linear_sign(&o_.rho, at), 1);
    if (!o_.bounded)
        return combine(f, 1, 1);
    linear rest;
    below_top(&rest);
    const int in = combine(f, linear_sign(&o_.Z, at), linear_sign(&rest, at));
    mpz_clears(rest.g0, rest.g1, (mpz_ptr)NULL);
    return in;
}

/* The sign of g on the open interval before critical parameter `gap`.  A zero
 * of g that matters is a critical parameter. */
static int linear_sign_in_gap(linear *g, int gap)
{
    const int slope = mpz_sgn(g->g1);
    if (slope == 0)
        return mpz_sgn(g->g0);
    if (gap == 0)
        return -slope;
    const int before = linear_sign(g, &o_.at[gap - 1]);
    return before != 0 ? before : slope;
}

/* The sign of F on the open interval; outside the roots it is that of A. */
static int lateral_sign_in_gap(int gap)
{
    int roots_before = 0, roots = 0;
    for (int i = 0; i < o_.count; i++) {
        roots += o_.at[i].lateral;
        roots_before += o_.at[i].lateral && i < gap;
    }
    if (mpz_sgn(o_.A) != 0)
        return roots == 2 && roots_before == 1 ? -mpz_sgn(o_.A) : mpz_sgn(o_.A);
    if (mpz_sgn(o_.B) != 0)
        return roots_before == 1 ? mpz_sgn(o_.B) : -mpz_sgn(o_.B);
    return mpz_sgn(o_.C);
}

static int inside_gap(int gap)
{
    const int f = lateral_sign_in_gap(gap);
    if (o_.nappe)
        return combine(f, linear_sign_in_gap(&o_.rho, gap), 1);
    if (!o_.bounded)
        return combine(f, 1, 1);
    linear rest;
    below_top(&rest);
    const int in = combine(f, linear_sign_in_gap(&o_.Z, gap),
                           linear_sign_in_gap(&rest, gap));
    mpz_clears(rest.g0, rest.g1, (mpz_ptr)NULL);
    return in;
}

/* -------------------------------------- points, normals, z and the angle -- */

/* The hits of the answer, and oracle_other() of them. */
static cylint_hit *hits_, others_[2];

static cylint_hit *other_of(const cylint_hit *hit)
{
    return &others_[hit - hits_];
}

/* The double nearest to x.  *other is it too, or, if x is nearer than 2^-90 of
 * itself to the middle of two doubles, the other one of the two. */
static double nearest_real(mpfr_t x, double *other)
{
    const double nearest = mpfr_get_d(x, MPFR_RNDN) + 0;
    mpfr_t moved;
    mpfr_init2(moved, BITS);
    *other = nearest;
    for (int sign = -1; sign <= 1; sign += 2) {
        mpfr_set_si_2exp(moved, sign, -90, MPFR_RNDN);
        mpfr_add_ui(moved, moved, 1, MPFR_RNDN);
        mpfr_mul(moved, moved, x, MPFR_RNDN);
        const double beside = mpfr_get_d(moved, MPFR_RNDN) + 0;
        *other = beside != nearest ? beside : *other;
    }
    mpfr_clear(moved);
    return nearest;
}

static void point_at(const critical *at, double point[3])
{
    mpz_set_ui(o_.s[4], 1);
    for (int i = 0; i < 3; i++)
        point[i] = nearest_linear(o_.o[i], o_.d[i], o_.s[4], o_.unit, at);
}

static double z_at(const critical *at)
{
    return nearest_linear(o_.Z.g0, o_.Z.g1, o_.whole, 0, at);
}

/* The hit's normal: v / |v|; clears v */
static void normalise(mpfr_t v[3], cylint_hit *hit)
{
    cylint_hit *other = other_of(hit);
    mpfr_t sum, square;
    mpfr_inits2(BITS, sum, square, (mpfr_ptr)NULL);
    mpfr_set_zero(sum, 1);
    for (int i = 0; i < 3; i++) {
        mpfr_sqr(square, v[i], MPFR_RNDN);
        mpfr_add(sum, sum, square, MPFR_RNDN);
    }
    mpfr_sqrt(sum, sum, MPFR_RNDN);
    for (int i = 0; i < 3; i++) {
        mpfr_div(v[i], v[i], sum, MPFR_RNDN);
        hit->normal[i] = nearest_real(v[i], &other->normal[i]);
        mpfr_clear(v[i]);
    }
    mpfr_clears(sum, square, (mpfr_ptr)NULL);
}

static void unit_vector(mpz_t v[3], int sign, cylint_hit *hit)
{
    mpfr_t real[3];
    for (int i = 0; i < 3; i++) {
        mpfr_init2(real[i], BITS);
        mpfr_set_z(real[i], v[i], MPFR_RNDN);
        mpfr_mul_si(real[i], real[i], sign, MPFR_RNDN);
    }
    normalise(real, hit);
}

/* The normal at the apex: away from the solid; of a double cone against d, or
 * towards the base. */
static int apex_normal_sign(void)
{
    const int opening = mpz_sgn(o_.delta);
    if (o_.bounded || o_.nappe)
        return -opening;
    dot(o_.s[1], o_.w, o_.d);
    if (mpz_sgn(o_.s[1]) != 0)
        return -mpz_sgn(o_.s[1]);
    return mpz_sgn(o_.gamma) == 0 ? -1 : opening;
}

/* n_i += (s g)(tau) v_i; constant and linear terms are kept apart */
static void add_scaled(mpz_t n0, mpz_t n1, mpz_t s, linear *g, mpz_t v,
                       int sign)
{
    add_product(n0, s, g->g0, v, sign);
    add_product(n1, s, g->g1, v, sign);
}

/*
 * Half the gradient of F, linear in tau:
 *   circular   alpha q - (beta Z + delta rho) w
 *   elliptic   alpha (X gx + Y gy) - delta rho gz
 */
static void lateral_normal(const critical *at, cylint_hit *hit)
{
    mpfr_t n[3];
    mpz_set_ui(o_.s[3], 1);
    for (int i = 0; i < 3; i++) {
        mpfr_init2(n[i], BITS);
        mpz_set_ui(o_.s[4], 0);
        mpz_set_ui(o_.s[5], 0);
        if (o_.circular) {
            add_product(o_.s[4], o_.alpha, o_.q[i], o_.s[3], 1);
            add_product(o_.s[5], o_.alpha, o_.d[i], o_.s[3], 1);
            add_scaled(o_.s[4], o_.s[5], o_.beta, &o_.Z, o_.w[i], -1);
            add_scaled(o_.s[4], o_.s[5], o_.delta, &o_.rho, o_.w[i], -1);
        } else {
            add_scaled(o_.s[4], o_.s[5], o_.alpha, &o_.X, o_.gx[i], 1);
            add_scaled(o_.s[4], o_.s[5], o_.alpha, &o_.Y, o_.gy[i], 1);
            add_scaled(o_.s[4], o_.s[5], o_.delta, &o_.rho, o_.gz[i], -1);
        }
        linear_value(n[i], o_.s[4], o_.s[5], at);
    }
    normalise(n, hit);
}

static void normal_at(const critical *at, cylint_hit *hit)
{
    if (hit->part != CYLINT_PART_LATERAL) {
        unit_vector(o_.circular ? o_.w : o_.gz,
                    hit->part == CYLINT_PART_CAP1 ? 1 : -1, hit);
    } else if (linear_sign(&o_.rho, at) == 0) {
        unit_vector(o_.w, apex_normal_sign(), hit);
    } else {
        lateral_normal(at, hit);
    }
}

/* Circular kinds: X and Y along e x w and w x (e x w); Y needs / |w|. */
static void circular_plane(void)
{
    int least = 0;
    for (int i = 1; i < 3; i++)
        if (mpz_cmpabs(o_.w[i], o_.w[least]) < 0)
            least = i;
    const int j = (least + 1) % 3, k = (least + 2) % 3;
    mpz_set_ui(o_.gx[least], 0);
    mpz_neg(o_.gx[j], o_.w[k]);
    mpz_set(o_.gx[k], o_.w[j]);
    cross(o_.gy, o_.w, o_.gx);
    along_line(&o_.X, o_.gx);
    along_line(&o_.Y, o_.gy);
}

/* An angle in [0, 1): a double below 1. */
static double below_one(double phi)
{
    return phi < 1 ? phi : 0x1.fffffffffffffp-1;
}

/* The angle has 126 bits, enough for nearest_real(). */
static double phi_at(const critical *at, double *other)
{
    mpfr_t x, y, turn;
    mpfr_inits2(BITS, x, y, turn, (mpfr_ptr)NULL);
    if (o_.circular) {
        circular_plane();
        mpfr_set_z(turn, o_.whole, MPFR_RNDN);
        mpfr_rec_sqrt(turn, turn, MPFR_RNDN);
    } else {
        mpfr_set_ui(turn, 1, MPFR_RNDN);
    }
    linear_value(x, o_.X.g0, o_.X.g1, at);
    linear_value(y, o_.Y.g0, o_.Y.g1, at);
    mpfr_mul(y, y, turn, MPFR_RNDN);
    mpfr_prec_round(x, 128, MPFR_RNDN);
    mpfr_prec_round(y, 128, MPFR_RNDN);
    if (mpfr_zero_p(x) && mpfr_zero_p(y))
        mpfr_set_zero(x, 1);
    else
        mpfr_atan2(x, y, x, MPFR_RNDN);
    mpfr_const_pi(turn, MPFR_RNDN);
    mpfr_div(x, x, turn, MPFR_RNDN);
    mpfr_div_ui(x, x, 2, MPFR_RNDN);
    if (mpfr_sgn(x) < 0)
        mpfr_add_ui(x, x, 1, MPFR_RNDN);
    const double phi = below_one(nearest_real(x, other));
    *other = below_one(*other);
    mpfr_clears(x, y, turn, (mpfr_ptr)NULL);
    return phi;
}

/* --------------------------------------------------------------- hits -- */

static int relation(void)
{
    int crosses = 0, points = 0, pieces = 0;
    for (int i = 0; i <= o_.count; i++) {
        const int gap = inside_gap(i);
        const int at = i < o_.count ? inside_at(&o_.at[i]) : -1;
        crosses |= gap > 0 || at > 0;
        pieces += gap >= 0;
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
    const int before = inside_gap(i), after = inside_gap(i + 1);
    const int here = inside_at(&o_.at[i]);
    if (here < 0)
        return -1;
    if (before >= 0 && after >= 0)
        return here == 0 && before > 0 && after > 0 ? CYLINT_SIDE_BOTH : -1;
    return before >= 0  ? CYLINT_SIDE_LEAVING
           : after >= 0 ? CYLINT_SIDE_ENTERING
                        : CYLINT_SIDE_BOTH;
}

static int part_at(const critical *at)
{
    if (at->lateral)
        return CYLINT_PART_LATERAL;
    return linear_sign(&o_.Z, at) == 0 ? CYLINT_PART_CAP0 : CYLINT_PART_CAP1;
}

static int part_is_present(int part, int ends)
{
    switch (part) {
    case CYLINT_PART_CAP0:
        return ends == CYLINT_ENDS_CAPPED || ends == CYLINT_ENDS_CAP0;
    case CYLINT_PART_CAP1:
        return ends == CYLINT_ENDS_CAPPED || ends == CYLINT_ENDS_CAP1;
    default:
        return 1;
    }
}

static void describe(const critical *at, unsigned want, cylint_hit *hit)
{
    hit->t = nearest_t(at);
    if (want & CYLINT_WANT_POINT)
        point_at(at, hit->point);
    if (want & CYLINT_WANT_NORMAL)
        normal_at(at, hit);
    if (want & CYLINT_WANT_Z)
        hit->z = z_at(at);
    if (want & CYLINT_WANT_PHI)
        hit->phi = phi_at(at, &other_of(hit)->phi);
}

#include "oracle_round.h"

int oracle_contains(const cylint_shape *shape, const double point[3])
{
    if (shape->kind == CYLINT_KIND_NONE || !isfinite(point[0]) ||
        !isfinite(point[1]) || !isfinite(point[2]))
        return -1;
    if (is_round(shape))
        return round_contains(shape, point);
    start();
    for (int i = 0; i < 3; i++)
        mpz_set_ui(o_.d[i], 0);
    o_.d_unit = 0;
    load(shape, point);
    o_.count = 0;
    return inside_gap(0);
}

struct oracle_place oracle_place(void)
{
    const struct oracle_place place = {
        mpz_sgn(o_.C) == 0, mpz_sgn(o_.rho.g0) == 0, mpz_sgn(o_.Z.g0) == 0,
        mpz_cmp(o_.Z.g0, o_.whole) == 0};
    return place;
}

const cylint_hit *oracle_other(int i)
{
    return &others_[i];
}

void oracle_intersect(const cylint_shape *shape, const cylint_line *line,
                      unsigned want, cylint_answer *expected)
{
    memset(expected, 0, sizeof *expected);
    memset(others_, 0, sizeof others_);
    hits_ = expected->hit;
    if (shape->kind == CYLINT_KIND_NONE || !line->valid) {
        expected->flags = CYLINT_FLAG_INVALID;
        return;
    }
    if (is_round(shape)) {
        round_intersect(shape, line, want, expected);
        return;
    }
    start();
    load_line(line);
    load(shape, line->o);
    find_critical();
    expected->relation = relation();
    const int most = want & CYLINT_WANT_NEAREST ? 1 : 2;
    for (int i = 0; i < o_.count && expected->n < most; i++) {
        const int side = side_at(i), part = part_at(&o_.at[i]);
        if (side < 0 || !part_is_present(part, shape->ends) ||
            compare_to_double(&o_.at[i], line->tmin) < 0 ||
            compare_to_double(&o_.at[i], line->tmax) > 0)
            continue;
        cylint_hit *hit = &expected->hit[expected->n++];
        hit->side = side;
        hit->part = part;
        if (mpz_sgn(o_.D) > 0) {
            mpfr_set_z(o_.root_D, o_.D, MPFR_RNDN);
            mpfr_sqrt(o_.root_D, o_.root_D, MPFR_RNDN);
        } else {
            mpfr_set_zero(o_.root_D, 1);
        }
        describe(&o_.at[i], want, hit);
    }
}
