/*
 * test_safety_elliptic.c - floor distance: cylint_safety() of elliptic kinds
 *
 * It is never above the distance, and not far below it.  The families print the
 * mean and the least ratio of the two.  CYLINT_CASES is the number of shapes of
 * each family.
 */
#include <math.h>

#include "check.h"
#include "cylint_distance.h"
#include "elliptic_solids.h"

enum { CASES = 400, POINTS = 4 };

struct gap {
    long n, above;
    double sum, least;
};

static void add_ratio(struct gap *g, const cylint_shape *s, const double p[3])
{
    cylint_closest q;
    const double size = fabs(cylint_distance(s, p, 0, &q));
    const double safe = cylint_safety(s, p);
    if (!(size > 0))
        return;
    g->n++;
    g->sum += safe / size;
    g->least = fmin(g->least, safe / size);
    if (!CHECK(safe >= 0 && safe <= size))
        REPORT("point %a %a %a: safety %a, distance %a", p[0], p[1], p[2], safe,
               size);
}

static struct gap gap_of(enum form form, enum where where, cylint_ends ends)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES);
    struct gap g = {0, 0, 0, 1};
    for (uint64_t i = 0; i < cases; i++) {
        struct solid e;
        cylint_shape s;
        draw_solid(&e, form, i % 2 == 1);
        if (!make_solid(&s, &e, ends))
            continue;
        for (int n = 0; n < POINTS; n++) {
            double p[3];
            draw_place(&e, where, p);
            add_ratio(&g, &s, p);
        }
    }
    return g;
}

static void over_families(cylint_ends ends)
{
    for (int form = 0; form < FORMS; form++)
        for (int where = 0; where < PLACES; where++) {
            const struct gap g =
                gap_of((enum form)form, (enum where)where, ends);
            const double mean = g.sum / (double)g.n;
            printf("note: %s, %s, %s: safety / distance %.4f in the mean, at "
                   "least %.3g\n",
                   ends == CYLINT_ENDS_CAPPED ? "capped"
                   : ends == CYLINT_ENDS_OPEN ? "open"
                                              : "infinite",
                   form_names[form], place_names[where], mean, g.least);
            if (!CHECK(mean > 0.85))
                REPORT("%s %s: %g", form_names[form], place_names[where], mean);
        }
}

static void safety_is_close_to_the_distance_of_capped_shapes(void)
{
    over_families(CYLINT_ENDS_CAPPED);
}

static void and_of_infinite_ones(void)
{
    over_families(CYLINT_ENDS_INFINITE);
}

static void and_of_open_ones(void)
{
    over_families(CYLINT_ENDS_OPEN);
}

/* Far along a thin cylinder the error of its local coordinates is larger than
 * their circle. */
static void a_large_error_of_local_coordinates_leaves_no_safety(void)
{
    const double c[3] = {0x1.e40a3c08p-2, -0x1.2722ddap-1, 0x1.84b3e10cp-1};
    const double a[3] = {-0x1.ca41ab0894793p-41, 0x1.c149043420eebp-44,
                         0x1.d8ec540984505p-39};
    const double b[3] = {0x1.335dfb04d84f2p-28, 0x1.1719724d5cb91p-26,
                         0x1.c7844210af6ffp-27};
    const double h[3] = {-0x1.46b0fb057931fp+15, 0x1.8b4a11488c19ep+12,
                         0x1.4ed31dd3908bfp+10};
    const double p[3] = {-0x1.947d7ae62ec6dp+16, 0x1.e9688df088fc4p+13,
                         0x1.9ea83cdfed63p+11};
    cylint_shape s;
    cylint_closest q;
    cylint_elliptic_cylinder(&s, c, a, b, h, CYLINT_ENDS_INFINITE);
    const double size = fabs(cylint_distance(&s, p, 0, &q));
    CHECK(size < 0x1p-38 && cylint_safety(&s, p) <= size);
}

int main(void)
{
    RUN(safety_is_close_to_the_distance_of_capped_shapes);
    RUN(and_of_infinite_ones);
    RUN(and_of_open_ones);
    RUN(a_large_error_of_local_coordinates_leaves_no_safety);
    return check_end();
}
