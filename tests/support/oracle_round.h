/*
 * oracle_round.h - the oracle's answers for spheres, capsules and rounded cones
 *
 * Only oracle.c includes it.  The surface of the convex hull of two balls is
 * made of parts of the two balls and of the cone that touches both.  Each is a
 * quadratic along the line, with a discriminant of its own.  The line enters
 * the hull at the least of all roots of the balls and of those roots of the
 * cone that lie between the two circles of contact; it leaves at the greatest.
 */
#ifndef CYLINT_ORACLE_ROUND_H
#define CYLINT_ORACLE_ROUND_H

enum { BALL0, BALL1, BETWEEN, QUADRICS, MOST_ROOTS = 2 * QUADRICS };

typedef struct root {
    critical at;
    int quadric;
} root;

static struct {
    int ready, balls; /* 1: one ball is all */
    mpz_t A[QUADRICS], B[QUADRICS], C[QUADRICS], D[QUADRICS];
    mpz_t center[2][3];    /* the line's origin seen from the centres */
    linear above0, above1; /* Z beyond the planes of the circles */
    root at[MOST_ROOTS];
    int count;
    mpz_t a, b, c, u, v;
} round_;

static void start_round(void)
{
    start();
    if (round_.ready)
        return;
    for (int k = 0; k < QUADRICS; k++) {
        mpz_inits(round_.A[k], round_.B[k], round_.C[k], round_.D[k],
                  (mpz_ptr)NULL);
    }
    for (int i = 0; i < 3; i++)
        mpz_inits(round_.center[0][i], round_.center[1][i], (mpz_ptr)NULL);
    for (int i = 0; i < MOST_ROOTS; i++)
        mpz_inits(round_.at[i].at.p, round_.at[i].at.r, (mpz_ptr)NULL);
    mpz_inits(round_.above0.g0, round_.above0.g1, round_.above1.g0,
              round_.above1.g1, round_.a, round_.b, round_.c, round_.u,
              round_.v, (mpz_ptr)NULL);
    round_.ready = 1;
}

static int is_round(const cylint_shape *shape)
{
    return shape->kind == CYLINT_KIND_SPHERE ||
           shape->kind == CYLINT_KIND_CAPSULE ||
           shape->kind == CYLINT_KIND_RCONE;
}

/* |q + tau d|^2 - r^2 */
static void load_ball(int k, mpz_t r)
{
    dot(round_.A[k], o_.d, o_.d);
    dot(round_.B[k], round_.center[k], o_.d);
    dot(round_.C[k], round_.center[k], round_.center[k]);
    mpz_submul(round_.C[k], r, r);
    mpz_mul(round_.D[k], round_.B[k], round_.B[k]);
    mpz_submul(round_.D[k], round_.A[k], round_.C[k]);
}

/*
 * The cone about the axis that touches both balls has the half angle with
 * sine (r0 - r1) / |w|:
 *     distance cos = r0 - Z sin / |w|,
 * squared and times W^2, W = |w|^2, distance^2 = |q|^2 - Z^2 / W,
 *     F = (W - dr^2) (W |q|^2 - Z^2) - (r0 W + dr Z)^2.
 */
static void load_between(void)
{
    mpz_mul(o_.beta, o_.delta, o_.delta);
    mpz_sub(o_.beta, o_.whole, o_.beta);
    mpz_mul(o_.alpha, o_.beta, o_.whole);
    mpz_mul(o_.gamma, o_.r0, o_.whole);
    load_quadratic();
    mpz_set(round_.A[BETWEEN], o_.A);
    mpz_set(round_.B[BETWEEN], o_.B);
    mpz_set(round_.C[BETWEEN], o_.C);
    mpz_set(round_.D[BETWEEN], o_.D);
}

/* Loads the shape and the line o + tau d; o_.d is set. */
static void load_round(const cylint_shape *shape, const double o[3])
{
    load_lengths(shape, o);
    whole(o_.r0, cylint_r0(shape), o_.unit);
    whole(o_.dr, cylint_r1(shape), o_.unit);
    for (int i = 0; i < 3; i++) {
        mpz_set(round_.center[0][i], o_.q[i]);
        mpz_sub(round_.center[1][i], o_.q[i], o_.w[i]);
    }
    load_ball(BALL0, o_.r0);
    load_ball(BALL1, o_.dr);
    dot(o_.whole, o_.w, o_.w);
    along_line(&o_.Z, o_.w);
    round_.balls = 2;
    if (shape->kind == CYLINT_KIND_SPHERE) {
        round_.balls = 1;
        if (cylint_surface(shape) ==
            CYLINT_PART_CAP1) { /* the base is at z = 1 */
            mpz_sub(o_.Z.g0, o_.whole, o_.Z.g0);
            mpz_neg(o_.Z.g1, o_.Z.g1);
            for (int i = 0; i < 3; i++)
                mpz_neg(o_.w[i], o_.w[i]);
        }
        return;
    }
    mpz_sub(o_.delta, o_.dr, o_.r0);
    load_between();
    mpz_set(round_.above0.g0, o_.Z.g0);
    mpz_addmul(round_.above0.g0, o_.r0, o_.delta);
    mpz_set(round_.above0.g1, o_.Z.g1);
    mpz_sub(round_.above1.g0, o_.Z.g0, o_.whole);
    mpz_addmul(round_.above1.g0, o_.dr, o_.delta);
    mpz_set(round_.above1.g1, o_.Z.g1);
}

/* Makes one quadratic that of the functions of oracle_field.h. */
static void use_quadric(int k)
{
    mpz_set(o_.A, round_.A[k]);
    mpz_set(o_.B, round_.B[k]);
    mpz_set(o_.C, round_.C[k]);
    mpz_set(o_.D, round_.D[k]);
    mpfr_set_zero(o_.root_D, 1);
    if (mpz_sgn(o_.D) > 0) {
        mpfr_set_z(o_.root_D, o_.D, MPFR_RNDN);
        mpfr_sqrt(o_.root_D, o_.root_D, MPFR_RNDN);
    }
}

/* The sign of a + b sqrt(D of quadric k). */
static int sign_in(int k, mpz_t a, mpz_t b)
{
    mpz_set(o_.D, round_.D[k]);
    return surd_sign(a, b);
}

/* The sign of x - y. */
static int compare_roots(const root *x, const root *y)
{
    mpz_t *const a = &round_.a, *const b = &round_.b, *const c = &round_.c;
    /* a + b sqrt(D of x) + c sqrt(D of y) */
    mpz_mul(*a, x->at.p, y->at.r);
    mpz_submul(*a, y->at.p, x->at.r);
    mpz_mul_si(*b, y->at.r, x->at.q);
    mpz_mul_si(*c, x->at.r, -y->at.q);
    const int first = sign_in(x->quadric, *a, *b);
    const int second = mpz_sgn(round_.D[y->quadric]) > 0 ? mpz_sgn(*c) : 0;
    if (first * second >= 0)
        return first != 0 ? first : second;
    /* (a + b sqrt(D))^2 - c^2 E */
    mpz_mul(round_.u, *a, *a);
    mpz_mul(round_.v, *b, *b);
    mpz_addmul(round_.u, round_.v, round_.D[x->quadric]);
    mpz_mul(round_.v, *c, *c);
    mpz_submul(round_.u, round_.v, round_.D[y->quadric]);
    mpz_mul(round_.v, *a, *b);
    mpz_mul_2exp(round_.v, round_.v, 1);
    const int order = sign_in(x->quadric, round_.u, round_.v);
    return order > 0 ? first : order < 0 ? second : 0;
}

/* o_ has the quadric of the root. */
static int part_of_root(const cylint_shape *shape, const root *x)
{
    if (shape->kind == CYLINT_KIND_SPHERE)
        return cylint_surface(shape);
    return linear_sign(&round_.above0, &x->at) < 0   ? CYLINT_PART_CAP0
           : linear_sign(&round_.above1, &x->at) > 0 ? CYLINT_PART_CAP1
                                                     : CYLINT_PART_LATERAL;
}

/* The roots of all quadrics that lie on the hull or in it. */
static void find_roots(const cylint_shape *shape)
{
    round_.count = 0;
    for (int k = 0; k < (round_.balls == 1 ? 1 : QUADRICS); k++) {
        use_quadric(k);
        o_.count = 0;
        add_roots();
        for (int i = 0; i < o_.count; i++) {
            root *to = &round_.at[round_.count];
            mpz_set(to->at.p, o_.at[i].p);
            mpz_set(to->at.r, o_.at[i].r);
            to->at.q = o_.at[i].q;
            to->quadric = k;
            round_.count +=
                k != BETWEEN || part_of_root(shape, to) == CYLINT_PART_LATERAL;
        }
    }
}

/* Whether the line lies on the cone. */
static int is_ruling(void)
{
    return round_.balls == 2 && mpz_sgn(round_.A[BETWEEN]) == 0 &&
           mpz_sgn(round_.B[BETWEEN]) == 0 && mpz_sgn(round_.C[BETWEEN]) == 0;
}

static void round_normal(const root *x, int end, cylint_hit *hit)
{
    mpfr_t n[3];
    for (int i = 0; i < 3; i++) {
        mpfr_init2(n[i], BITS);
        linear_value(n[i], round_.center[end][i], o_.d[i], &x->at);
    }
    normalise(n, hit);
}

static void describe_round(const cylint_shape *shape, const root *x,
                           unsigned want, cylint_hit *hit)
{
    const int has_axis = mpz_sgn(o_.whole) != 0;
    hit->t = nearest_t(&x->at);
    if (want & CYLINT_WANT_POINT)
        point_at(&x->at, hit->point);
    if (want & CYLINT_WANT_NORMAL) {
        if (shape->kind == CYLINT_KIND_SPHERE)
            round_normal(x, 0, hit);
        else if (hit->part != CYLINT_PART_LATERAL)
            round_normal(x, hit->part == CYLINT_PART_CAP1, hit);
        else if (linear_sign(&o_.rho, &x->at) == 0)
            unit_vector(o_.w, -mpz_sgn(o_.delta), hit);
        else
            lateral_normal(&x->at, hit);
    }
    if (want & CYLINT_WANT_Z)
        hit->z = has_axis ? z_at(&x->at) : 0;
    if (want & CYLINT_WANT_PHI)
        hit->phi = has_axis ? phi_at(&x->at, &other_of(hit)->phi) : 0;
}

static void round_intersect(const cylint_shape *shape, const cylint_line *line,
                            unsigned want, cylint_answer *expected)
{
    start_round();
    load_line(line);
    load_round(shape, line->o);
    find_roots(shape);
    if (round_.count == 0)
        return;
    const root *end[2] = {&round_.at[0], &round_.at[0]};
    for (int i = 1; i < round_.count; i++) {
        if (compare_roots(&round_.at[i], end[0]) < 0)
            end[0] = &round_.at[i];
        if (compare_roots(&round_.at[i], end[1]) > 0)
            end[1] = &round_.at[i];
    }
    const int one = compare_roots(end[0], end[1]) == 0;
    expected->relation = one           ? CYLINT_RELATION_TOUCH
                         : is_ruling() ? CYLINT_RELATION_ALONG
                                       : CYLINT_RELATION_CROSS;
    for (int i = 0; i < (one ? 1 : 2); i++) {
        use_quadric(end[i]->quadric);
        const int part = part_of_root(shape, end[i]);
        if (!part_is_present(part, shape->ends) ||
            compare_to_double(&end[i]->at, line->tmin) < 0 ||
            compare_to_double(&end[i]->at, line->tmax) > 0)
            continue;
        cylint_hit *hit = &expected->hit[expected->n++];
        hit->part = part;
        hit->side = one      ? CYLINT_SIDE_BOTH
                    : i == 0 ? CYLINT_SIDE_ENTERING
                             : CYLINT_SIDE_LEAVING;
        describe_round(shape, end[i], want, hit);
        if (want & CYLINT_WANT_NEAREST)
            return;
    }
}

/* In one of the balls, or between the planes and in the cone. */
static int round_contains(const cylint_shape *shape, const double point[3])
{
    start_round();
    for (int i = 0; i < 3; i++)
        mpz_set_ui(o_.d[i], 0);
    o_.d_unit = 0;
    load_round(shape, point);
    int in = -mpz_sgn(round_.C[BALL0]);
    if (round_.balls == 1)
        return in;
    if (-mpz_sgn(round_.C[BALL1]) > in)
        in = -mpz_sgn(round_.C[BALL1]);
    if (mpz_sgn(round_.above0.g0) >= 0 && mpz_sgn(round_.above1.g0) <= 0 &&
        -mpz_sgn(round_.C[BETWEEN]) > in)
        in = -mpz_sgn(round_.C[BETWEEN]);
    return in;
}

#endif
