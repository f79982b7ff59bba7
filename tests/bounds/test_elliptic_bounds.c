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
#include "elliptic_solids.h"

enum { CASES = 3000 };

static double most_in_pairs, most_in_doubles;

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

static void check_solid(const struct solid *e, const double point[3])
{
    cylint_shape s;
    elliptic_numbers m;
    elliptic_place p;
    triple_numbers t;
    plane_in_pairs plane;
    if (!make_solid(&s, e, CYLINT_ENDS_CAPPED))
        return;
    load_numbers(&m, &s, point);
    locate_by_pairs(&p, &m, &s);
    load_triples(&t, &m, &s);
    const triple rho = triple_add(
        t.volume, triple_mul(triple_add(triple_of(e->k), triple_of(-1)), t.z));
    check_place(&m, &t, &p, rho);
    const double turn = between(0, 6.283185307179586);
    const direction_pair at =
        direction_of((vpair){cos(turn), 0}, (vpair){sin(turn), 0});
    load_plane(&plane, &m, &at, cylint_is_tapered(s.kind));
    CHECK(is_exact(plane.n, height_in_triples(&t, &s, &at)));
}

TEST(errors_are_below_their_bounds)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES);
    for (int form = 0; form < FORMS; form++)
        for (int where = 0; where < PLACES; where++)
            for (uint64_t i = 0; i < cases; i++) {
                struct solid e;
                double p[3];
                draw_solid(&e, (enum form)form, i % 2 == 1);
                draw_place(&e, (enum where)where, p);
                check_solid(&e, p);
            }
    printf("note: the largest error is %.3f of its bound in pairs, %.3f in "
           "doubles\n",
           most_in_pairs, most_in_doubles);
    CHECK(most_in_pairs > 0x1p-13 && most_in_doubles > 0x1p-13);
}
