/*
 * tube.c - hollow cylinders and cones, and sectors of them, as members of a solid
 */
#include "cylint_pieces.h"

#include "numbers/bits.h"
#include "numbers/double_double.h"
#include "shapes/layout.h"

/* x divided by a power of two, so that products neither over- nor underflow. */
static void to_size_of_one(const double x[3], double to[3])
{
    const double most = cylint_largest_by_bits(x);
    const int e = cylint_sign(most) == 0 ? 0 : cylint_any_exponent(most);
    for (int i = 0; i < 3; i++)
        to[i] = cylint_scaled(x[i], -e);
}

/* The direction of the cone's axis: of one along a coordinate, that of length 1, so
 * that cross products with it are exact. */
static void along_axis(const cylint_shape *cone, double to[3])
{
    /* so that a difference does not overflow */
    const int e = cylint_is_finite(cylint_axis(cone)) ? 0 : -1;
    int components = 0;
    for (int i = 0; i < 3; i++)
        to[i] = cylint_difference(cylint_scaled(cylint_top(cone)[i], e),
                                  cylint_scaled(cylint_base(cone)[i], e))
                    .hi;
    to_size_of_one(to, to);
    for (int i = 0; i < 3; i++)
        components += cylint_sign(to[i]) != 0;
    for (int i = 0; i < 3; i++)
        to[i] = components == 1 ? cylint_sign(to[i]) : to[i];
}

static void cross_product(const double x[3], const double y[3], double to[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        to[i] = pair_sub(two_prod(x[j], y[k]), two_prod(x[k], y[j])).hi;
    }
}

/* The sign of axis . (x cross y), exact: that of the sine of the angle from x to
 * y.  It is that of an elliptic shape's a.(b x h). */
static int turn_sign(const double axis[3], const double x[3], const double y[3])
{
    static const double center[3] = {0, 0, 0};
    cylint_shape s;
    return cylint_elliptic_cylinder(&s, center, axis, x, y,
                                    CYLINT_ENDS_CAPPED) != CYLINT_OK
               ? 0
           : cylint_left_handed(&s) ? -1
                                    : 1;
}

/* Writes the two half-spaces of a sector, and their clauses from 3 on. */
static cylint_status make_sector(const cylint_shape *cone,
                                 const double sector[2][3],
                                 cylint_shape shape[2], int clause[2])
{
    double axis[3], direction[2][3], normal[2][3];
    along_axis(cone, axis);
    for (int i = 0; i < 2; i++) {
        if (!cylint_is_finite(sector[i]))
            return CYLINT_ENONFINITE;
        to_size_of_one(sector[i], direction[i]);
    }
    cross_product(direction[0], axis, normal[0]);
    cross_product(axis, direction[1], normal[1]);
    /* Rounded normals would take an angle of 0 for a full turn. */
    const int turn = turn_sign(axis, direction[0], direction[1]);
    if (turn == 0 && cylint_dot(normal[0], normal[1]) < 0)
        return CYLINT_EDIRECTION;
    for (int i = 0; i < 2; i++) {
        if (cylint_halfspace(&shape[i], cylint_base(cone), normal[i]) !=
            CYLINT_OK)
            return CYLINT_EDIRECTION;
        clause[i] = turn >= 0 ? 3 + i : 3;
    }
    return CYLINT_OK;
}

cylint_status cylint_tube(const double p0[3], const double p1[3],
                          const double outer[2], const double inner[2],
                          const double sector[2][3],
                          cylint_shape shapes[CYLINT_TUBE_MEMBERS],
                          int clauses[CYLINT_TUBE_MEMBERS], size_t *n)
{
    const int is_hollow =
        inner && (cylint_sign(inner[0]) != 0 || cylint_sign(inner[1]) != 0);
    cylint_status status =
        cylint_cone(&shapes[0], p0, outer[0], p1, outer[1], CYLINT_ENDS_CAPPED);
    size_t members = 1;
    clauses[0] = 1;
    if (status == CYLINT_OK && is_hollow) {
        status = cylint_cone(&shapes[1], p0, inner[0], p1, inner[1],
                             CYLINT_ENDS_CAPPED);
        clauses[members++] = -2;
    }
    if (status == CYLINT_OK && sector) {
        status =
            make_sector(shapes, sector, &shapes[members], &clauses[members]);
        members += 2;
    }
    *n = status == CYLINT_OK ? members : 0;
    return status;
}
