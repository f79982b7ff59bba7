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
#include "distance_points.h"

enum { CASES = 4000 };

static double most_in_pairs, most_in_doubles;

/* n of an angle, whose length is brought to 1 in triples. */
static triple height_in_triples(const elliptic_triples *t,
                                const direction_pair *e)
{
    const triple c = triple_of_pair(e->cos.v), d = triple_of_pair(e->sin.v);
    const triple more = triple_sub(triple_mul2(c, c, d, d), triple_of(1));
    const triple turned = triple_mul2(c, t->place[0], d, t->place[1]);
    const triple less = triple_times(turned, -0.5 * triple_value(more));
    return triple_sub(triple_add(turned, less), t->place[2]);
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

static void check_place(const elliptic_numbers *m, const elliptic_triples *t,
                        const elliptic_place *p)
{
    const double off = off_by(p->x, t->place[0], t->volume) +
                       off_by(p->y, t->place[1], t->volume) +
                       off_by(p->rho, t->place[2], t->volume);
    CHECK(is_exact(m->x, t->place[0]) && is_exact(m->y, t->place[1]) &&
          is_exact(m->rho, t->place[2]));
    CHECK(is_exact(m->z, t->z) && is_exact(m->volume, t->volume));
    CHECK(is_below(off, p->error, &most_in_doubles));
    CHECK(
        is_below(off_by(p->z, t->z, t->volume), p->z_error, &most_in_doubles));
}

static void check_point(const cylint_shape *s, const double point[3])
{
    elliptic_numbers m;
    elliptic_place p;
    elliptic_triples t;
    plane_in_pairs plane;
    load_numbers(&m, s, point);
    locate(&p, s, point, CYLINT_ELLIPTIC_ERROR);
    load_triples(&t, s, point);
    check_place(&m, &t, &p);
    const double turn = between(0, 6.283185307179586);
    const direction_pair at =
        direction_of((vpair){cos(turn), 0}, (vpair){sin(turn), 0});
    load_plane(&plane, &m, &at);
    CHECK(is_exact(plane.n, height_in_triples(&t, &at)));
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
