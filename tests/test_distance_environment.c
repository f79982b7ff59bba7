/*
 * test_distance_environment.c - floor distance: answers known by hand, in every
 * rounding mode and treatment of subnormals
 */
#include <math.h>

#include "environment.h"
#include "known_distances.h"

static const double origin[3] = {0, 0, 0};

/* In every environment: a product of ulps and the unit would be rounded, or
 * flushed to zero.  The distance is two units. */
static void check_two_units(struct environment e)
{
    static const double down[3] = {0, 0, -1}, p[3] = {0x1p-1073, 0x1p-1074, 0};
    cylint_shape s;
    cylint_closest a;
    cylint_tangent_cone(&s, origin, down, 1, CYLINT_ENDS_INFINITE);
    CHECK(cylint_distance(&s, p, 0, &a) == 0x1p-1073);
    environment_set(e);
    const int less = cylint_on_surface(&s, p, 0x1.fffffffffffffp0) ||
                     cylint_on_surface(&s, p, 0x1p-1074) ||
                     cylint_on_surface(&s, p, -0x1p-1074) ||
                     cylint_on_surface(&s, p, NAN);
    const int enough = cylint_on_surface(&s, p, 2) &&
                       cylint_on_surface(&s, p, 3.5) &&
                       cylint_on_surface(&s, p, HUGE_VAL);
    environment_reset();
    CHECK(!less && enough);
}

static void subnormal_units_are_compared_exactly(void)
{
    everywhere(check_two_units);
}

int main(void)
{
    RUN(subnormal_units_are_compared_exactly);
    return check_end();
}
