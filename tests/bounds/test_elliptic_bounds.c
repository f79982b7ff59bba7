/*
 * test_elliptic_bounds.c - floor distance: the errors of elliptic kinds in pairs
 *
 * Computes x, y, z, the volume and the height over a tangent plane in pairs and in
 * triples, and compares the differences with CYLINT_SIZED_ERROR times the sizes
 * of the terms; and the same numbers in doubles with the bounds that features
 * depend on.
 */
#define CYLINT_ONE_LANE
#include "check.h"
#include "distance/elliptic_pairs.h"
#include "distance/triple_vector.h"
#include "distance_points.h"

enum { CASES = 4000 };

static double most_in_pairs, most_in_doubles;

/* x, y, z and a.(b x h) of a point in triples. */
typedef struct {
    triple x, y, z, volume;
} triple_numbers;

/* D.(u x v) */
static triple triple_product(const triple D[3], const double u[3],
                             const double v[3])
{
    triple x[3], U[3], V[3];
    for (int i = 0; i < 3; i++) {
        U[i] = triple_of(u[i]);
        V[i] = triple_of(v[i]);
    }
    triple_cross(x, U, V);
    return triple_dot(D, x);
}

static void load_triples(triple_numbers *t, const double point[3],
                         const cylint_shape *s)
{
    const double *a = cylint_a(s), *b = cylint_b(s), *h = cylint_axis(s);
    triple D[3], A[3];
    for (int i = 0; i < 3; i++) {
        D[i] = triple_of_pair(two_diff(point[i], cylint_base(s)[i]));
        A[i] = triple_of(a[i]);
    }
    t->x = triple_product(D, b, h);
    t->y = triple_product(D, h, a);
    t->z = triple_product(D, a, b);
    t->volume = triple_product(A, b, h);
}

/* n of an angle, whose length is brought to 1 in triples. */
static triple height_in_triples(const triple_numbers *t, triple rho,
                                const direction_pair *e)
{
    const triple c = triple_of_pair(e->cos.v), d = triple_of_pair(e->sin.v);
    const triple more = triple_sub(triple_mul2(c, c, d, d), triple_of(1));
    const triple turned = triple_mul2(c, t->x, d, t->y);
    const triple less = triple_times(turned, -0.5 * triple_value(more));
    return triple_sub(triple_add(turned, less), rho);
}

/* The size of x - y. */
static double difference(vpair x, triple y)
{
    const triple d =
        triple_sub(triple_add(triple_of(x.hi), triple_of(x.lo)), y);
    return fabs(triple_value(d));
}

static int is_below(double error, double bound, double *most)
{
    const double ratio = bound > 0 ? error / bound : error > 0 ? HUGE_VAL : 0;
    *most = fmax(*most, ratio);
    return ratio <= 1;
}

static int is_exact(sized x, triple y)
{
    return is_below(difference(x.v, y), CYLINT_SIZED_ERROR * x.size,
                    &most_in_pairs);
}

/* The error of x as the quotient of y and the volume. */
static double off_by(double x, triple y, triple volume)
{
    const triple d = triple_sub(triple_times(volume, x), y);
    return fabs(triple_value(d) / triple_value(volume));
}

static void check_place(const elliptic_numbers *m, const triple_numbers *t,
                        const elliptic_place *p, triple rho)
{
    const double off = off_by(p->x, t->x, t->volume) +
                       off_by(p->y, t->y, t->volume) +
                       off_by(p->rho, rho, t->volume);
    CHECK(is_exact(m->x, t->x) && is_exact(m->y, t->y) && is_exact(m->z, t->z));
    CHECK(is_exact(m->volume, t->volume) && is_exact(m->rho, rho));
    CHECK(is_below(off, p->error, &most_in_doubles));
    CHECK(
        is_below(off_by(p->z, t->z, t->volume), p->z_error, &most_in_doubles));
}

static void check_point(const cylint_shape *s, const double point[3])
{
    elliptic_numbers m;
    elliptic_place p;
    triple_numbers t;
    plane_in_pairs plane;
    load_numbers(&m, s, point);
    locate(&p, s, point, CYLINT_ELLIPTIC_ERROR);
    load_triples(&t, point, s);
    const triple growth = triple_add(triple_of(cylint_r1(s)), triple_of(-1));
    const triple rho = triple_add(t.volume, triple_mul(growth, t.z));
    check_place(&m, &t, &p, rho);
    const double turn = between(0, 6.283185307179586);
    const direction_pair at =
        direction_of((vpair){cos(turn), 0}, (vpair){sin(turn), 0});
    load_plane(&plane, &m, &at, cylint_is_tapered(s->kind));
    CHECK(is_exact(plane.n, height_in_triples(&t, rho, &at)));
}

/* Of all families of prepared shapes but those of extreme sizes. */
TEST(errors_are_below_their_bounds)
{
    EACH_CASE(c, 4, check_setting("CYLINT_CASES", CASES)) {
        double p[3];
        if (!cylint_is_elliptic(c.shape.kind) || !cylint_prepared(&c.shape) ||
            family_is_wild(family) || family_is_scaled(family))
            continue;
        draw_point(&c, p);
        if (cylint_largest(p) <= CYLINT_FAR) /* a hit can overflow */
            check_point(&c.shape, p);
    }
    printf("note: the largest error is %.3f of its bound in pairs, %.3f in "
           "doubles\n",
           most_in_pairs, most_in_doubles);
    CHECK(most_in_pairs > 0x1p-13 && most_in_doubles > 0x1p-13);
}
