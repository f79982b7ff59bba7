/*
 * truth.c - the correct answer, and the error of another answer
 */
#include "truth.h"
#include "../../src/shapes/layout.h"

#include <math.h>

/* --------------------------------------------------------- comparison -- */

enum verdict verdict_of(const struct truth *truth, unsigned want, int only_hit,
                        const cylint_answer *answer)
{
    const cylint_answer *right = &truth->answer;
    const int most = want & CYLINT_WANT_NEAREST ? 1 : 2;
    const int n = right->n < most ? right->n : most;

    if (want & CYLINT_WANT_T)
        for (int i = 0; i < answer->n; i++)
            if (!(fabs(answer->hit[i].t) < HUGE_VAL) &&
                !(i < n && right->hit[i].t == answer->hit[i].t))
                return VERDICT_NAN;
    if (only_hit)
        return answer->n == n ? VERDICT_RIGHT
               : n            ? VERDICT_HIT_AS_MISS
                              : VERDICT_MISS_AS_HIT;
    if (answer->relation != right->relation) {
        const int is = right->relation, given = answer->relation;
        return given == CYLINT_RELATION_MISS ? VERDICT_HIT_AS_MISS
               : is == CYLINT_RELATION_MISS  ? VERDICT_MISS_AS_HIT
               : is == CYLINT_RELATION_TOUCH || given == CYLINT_RELATION_TOUCH
                   ? VERDICT_TANGENT
                   : VERDICT_ALONG;
    }
    return answer->n == n ? VERDICT_RIGHT : VERDICT_NUMBER;
}

/* In long double, whose exponents hold 1e300 over 1e-300 on some machines. */
void error_of(const struct truth *truth, int i, double t, double *radii,
              double *ulps)
{
    const double right = truth->answer.hit[i].t, away = fabs(right);
    const long double error = fabsl((long double)t - right - truth->rest[i]);
    const double ulp =
        away < HUGE_VAL ? nextafter(away, HUGE_VAL) - away : HUGE_VAL;
    if (t == right && !(away < HUGE_VAL)) {
        *radii = *ulps = 0;
        return;
    }
    *radii = (double)(error / truth->size);
    *ulps = (double)(error / ulp);
}

static double largest_radius(const cylint_shape *s)
{
    const double k = cylint_r1(s) > 1 ? cylint_r1(s) : 1;
    const double a =
        hypot(hypot(cylint_a(s)[0], cylint_a(s)[1]), cylint_a(s)[2]);
    const double b =
        hypot(hypot(cylint_b(s)[0], cylint_b(s)[1]), cylint_b(s)[2]);
    switch (s->kind) {
    case CYLINT_KIND_CYLINDER:
    case CYLINT_KIND_CONE:
        return cylint_r0(s) > cylint_r1(s) ? cylint_r0(s) : cylint_r1(s);
    case CYLINT_KIND_ACONE:
        return cylint_r1(s) * hypot(hypot(cylint_axis(s)[0], cylint_axis(s)[1]),
                                    cylint_axis(s)[2]);
    default:
        return (a > b ? a : b) * k;
    }
}

#ifndef HAVE_MPFR

int truth_known(void)
{
    return 0;
}

void truth_of(const cylint_shape *shape, const cylint_line *line,
              struct truth *truth)
{
    cylint_intersect(shape, line, 0, &truth->answer);
    truth->rest[0] = truth->rest[1] = 0;
    truth->size = largest_radius(shape);
}

#else

#include <mpfr.h>

#include "oracle.h"

enum { BITS = 640 };

int truth_known(void)
{
    return 1;
}

/* ------------------------------------------------- vectors of MPFR ----- */

typedef struct {
    mpfr_t x[3];
} vector;

static void start_vector(vector *v)
{
    for (int i = 0; i < 3; i++)
        mpfr_init2(v->x[i], BITS);
}

static void set(vector *v, const double from[3])
{
    for (int i = 0; i < 3; i++)
        mpfr_set_d(v->x[i], from[i], MPFR_RNDN);
}

static void set_difference(vector *v, const double to[3], const double from[3])
{
    set(v, to);
    for (int i = 0; i < 3; i++)
        mpfr_sub_d(v->x[i], v->x[i], from[i], MPFR_RNDN);
}

static void dot(mpfr_t sum, const vector *u, const vector *v)
{
    mpfr_t product;
    mpfr_init2(product, BITS);
    mpfr_mul(sum, u->x[0], v->x[0], MPFR_RNDN);
    for (int i = 1; i < 3; i++) {
        mpfr_mul(product, u->x[i], v->x[i], MPFR_RNDN);
        mpfr_add(sum, sum, product, MPFR_RNDN);
    }
    mpfr_clear(product);
}

static void cross(vector *uv, const vector *u, const vector *v)
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        mpfr_fmms(uv->x[i], u->x[j], v->x[k], u->x[k], v->x[j], MPFR_RNDN);
    }
}

/* -------------------------------------------------- the rest of a root - */

/*
 * P is the point at the rounded t, u the line's direction, w the axis.  The
 * lateral surface is |X|^2 = rho^2 with X and rho linear in P:
 *
 *   circular  X = P x w,  rho = k P.w            acone
 *                         rho = r0 |w| + dr P.w / |w|   else
 *   elliptic  X = (P.p, P.q),  rho = det + kappa P.e
 *
 * So the rest x is a root of A x^2 + 2 B x + C = 0 with A = X1.X1 - rho1^2 and
 * so on: x = -C / (B +- sqrt(B^2 - A C)), with the sign of B.
 */
static struct {
    int ready;
    vector P, u, w, a, b, e, p, q, X0, X1;
    mpfr_t t, rho0, rho1, A, B, C, x, vv, k;
} m;

static void start(void)
{
    vector *const vectors[] = {&m.P, &m.u, &m.w, &m.a,  &m.b,
                               &m.e, &m.p, &m.q, &m.X0, &m.X1};
    mpfr_ptr const numbers[] = {m.t, m.rho0, m.rho1, m.A, m.B,
                                m.C, m.x,    m.vv,   m.k};
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++)
        start_vector(vectors[i]);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        mpfr_init2(numbers[i], BITS);
    m.ready = 1;
}

static void load(const cylint_shape *s, const cylint_line *l, double t)
{
    if (!m.ready)
        start();
    if (l->segment)
        set_difference(&m.u, l->end, l->o);
    else
        set(&m.u, l->d);
    if (s->kind <= CYLINT_KIND_CONE)
        set_difference(&m.w, cylint_top(s), cylint_base(s));
    else
        set(&m.w, cylint_axis(s));
    set_difference(&m.P, l->o, cylint_base(s));
    for (int i = 0; i < 3; i++) {
        mpfr_mul_d(m.x, m.u.x[i], t, MPFR_RNDN);
        mpfr_add(m.P.x[i], m.P.x[i], m.x, MPFR_RNDN);
    }
    if (s->kind >= CYLINT_KIND_ECYLINDER) {
        set(&m.a, cylint_a(s));
        set(&m.b, cylint_b(s));
        cross(&m.e, &m.a, &m.b);
        cross(&m.p, &m.b, &m.w);
        cross(&m.q, &m.w, &m.a);
    }
}

/* Adds k P.axial to rho0 and sets rho1, the slope of rho along the line. */
static void rho_of(const vector *axial)
{
    dot(m.x, &m.P, axial);
    mpfr_mul(m.x, m.x, m.k, MPFR_RNDN);
    mpfr_add(m.rho0, m.rho0, m.x, MPFR_RNDN);
    dot(m.rho1, &m.u, axial);
    mpfr_mul(m.rho1, m.rho1, m.k, MPFR_RNDN);
}

static void circular(const cylint_shape *s)
{
    cross(&m.X0, &m.P, &m.w);
    cross(&m.X1, &m.u, &m.w);
    if (s->kind == CYLINT_KIND_ACONE) {
        mpfr_set_zero(m.rho0, 1);
        mpfr_set_d(m.k, cylint_r1(s), MPFR_RNDN);
    } else {
        dot(m.vv, &m.w, &m.w);
        mpfr_sqrt(m.vv, m.vv, MPFR_RNDN);
        mpfr_mul_d(m.rho0, m.vv, cylint_r0(s), MPFR_RNDN);
        mpfr_set_d(m.k,
                   s->kind == CYLINT_KIND_CONE ? cylint_r1(s) : cylint_r0(s),
                   MPFR_RNDN);
        mpfr_sub_d(m.k, m.k, cylint_r0(s), MPFR_RNDN);
        mpfr_div(m.k, m.k, m.vv, MPFR_RNDN);
    }
    rho_of(&m.w);
}

static void elliptic(const cylint_shape *s)
{
    dot(m.X0.x[0], &m.P, &m.p);
    dot(m.X0.x[1], &m.P, &m.q);
    dot(m.X1.x[0], &m.u, &m.p);
    dot(m.X1.x[1], &m.u, &m.q);
    mpfr_set_zero(m.X0.x[2], 1);
    mpfr_set_zero(m.X1.x[2], 1);
    dot(m.rho0, &m.a, &m.p);
    mpfr_set_d(m.k, cylint_r1(s), MPFR_RNDN);
    mpfr_sub_ui(m.k, m.k, 1, MPFR_RNDN);
    rho_of(&m.e);
}

static void less_product(mpfr_t from, const mpfr_t x, const mpfr_t y)
{
    mpfr_mul(m.x, x, y, MPFR_RNDN);
    mpfr_sub(from, from, m.x, MPFR_RNDN);
}

static double lateral_rest(const cylint_shape *s)
{
    if (s->kind >= CYLINT_KIND_ECYLINDER)
        elliptic(s);
    else
        circular(s);
    dot(m.A, &m.X1, &m.X1);
    less_product(m.A, m.rho1, m.rho1);
    dot(m.B, &m.X0, &m.X1);
    less_product(m.B, m.rho0, m.rho1);
    dot(m.C, &m.X0, &m.X0);
    less_product(m.C, m.rho0, m.rho0);
    mpfr_fmms(m.x, m.B, m.B, m.A, m.C, MPFR_RNDN);
    if (mpfr_sgn(m.x) < 0)
        mpfr_set_zero(m.x, 1);
    mpfr_sqrt(m.x, m.x, MPFR_RNDN);
    if (mpfr_sgn(m.B) < 0)
        mpfr_neg(m.x, m.x, MPFR_RNDN);
    mpfr_add(m.x, m.x, m.B, MPFR_RNDN);
    if (mpfr_zero_p(m.x))
        return 0;
    mpfr_div(m.x, m.C, m.x, MPFR_RNDN);
    return -mpfr_get_d(m.x, MPFR_RNDN);
}

static double cap_rest(const cylint_shape *s, int part)
{
    const vector *axial = s->kind >= CYLINT_KIND_ECYLINDER ? &m.e : &m.w;
    mpfr_set_zero(m.A, 1);
    if (part == CYLINT_PART_CAP1)
        dot(m.A, &m.w, axial);
    dot(m.B, &m.P, axial);
    mpfr_sub(m.A, m.A, m.B, MPFR_RNDN);
    dot(m.B, &m.u, axial);
    mpfr_div(m.A, m.A, m.B, MPFR_RNDN);
    return mpfr_get_d(m.A, MPFR_RNDN);
}

static double rest_of(const cylint_shape *s, const cylint_line *l, double t,
                      int part)
{
    if (!(fabs(t) < HUGE_VAL))
        return 0;
    load(s, l, t);
    const double rest =
        part == CYLINT_PART_LATERAL ? lateral_rest(s) : cap_rest(s, part);
    const double ulp = nextafter(fabs(t), HUGE_VAL) - fabs(t);
    return fabs(rest) <= 0.5 * ulp ? rest : 0;
}

void truth_of(const cylint_shape *shape, const cylint_line *line,
              struct truth *truth)
{
    const double *d = line->d;
    oracle_intersect(shape, line, CYLINT_WANT_T, &truth->answer);
    for (int i = 0; i < truth->answer.n; i++)
        truth->rest[i] = rest_of(shape, line, truth->answer.hit[i].t,
                                 truth->answer.hit[i].part);
    truth->size = largest_radius(shape) / hypot(hypot(d[0], d[1]), d[2]);
}

#endif
