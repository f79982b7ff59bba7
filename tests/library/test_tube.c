/*
 * test_tube.c - hollow cylinders and cones and their sectors, at sampled points
 *
 * A point of a line is inside a piece if its radius, height and angle say so.
 * Points next to a surface are left out.
 */
#include <math.h>

#include "check.h"
#include "cylint_pieces.h"
#include "draw.h"
#include "shapes/shape_facts.h"
#include "ulps.h"
#ifdef HAVE_MPFR
#include "real.h"
#endif

enum { TUBES = 2000, LINES = 20, POINTS = 20 };

static struct {
    double p0[3], p1[3], outer[2], inner[2], sector[2][3];
    int is_hollow, has_sector;
} tube;

/* The last tube, and its pieces on the last line. */
static cylint_shape s[CYLINT_TUBE_MEMBERS];
static int clauses[CYLINT_TUBE_MEMBERS];
static size_t n;
static cylint_interval piece[CYLINT_SOLID_PIECES];

static cylint_status make_members(const double p0[3], const double p1[3],
                                  const double outer[2], const double inner[2],
                                  const double sector[2][3])
{
    return cylint_tube(p0, p1, outer, inner, sector, s, clauses, &n);
}

static int pieces_on(const double o[3], const double d[3])
{
    cylint_line line;
    CHECK(cylint_whole_line(&line, o, d) == CYLINT_OK);
    return cylint_solid_pieces(s, clauses, n, &line, piece,
                               CYLINT_SOLID_PIECES);
}

static cylint_status make_tube(void)
{
    tube.is_hollow = one_of(2);
    tube.has_sector = one_of(4) > 0;
    random_vector(tube.p0, 1);
    random_vector(tube.p1, 1);
    for (int i = 0; i < 2; i++) {
        tube.outer[i] = between(0.2, 1);
        tube.inner[i] = tube.is_hollow ? between(0, tube.outer[i]) : 0;
        random_vector(tube.sector[i], 1);
    }
    return make_members(tube.p0, tube.p1, tube.outer, tube.inner,
                        tube.has_sector ? (const double(*)[3])tube.sector
                                        : NULL);
}

/* The angle from the first direction to x about the axis, in [0, 2 pi). */
static double angle_of(const double axis[3], const double x[3])
{
    double across[3];
    const double ww = dot3(axis, axis), *u = tube.sector[0];
    cross3(across, u, x);
    const double sine = dot3(axis, across) * sqrt(ww),
                 cosine = ww * dot3(u, x) - dot3(axis, u) * dot3(axis, x);
    const double angle = atan2(sine, cosine);
    return angle < 0 ? angle + 2 * acos(-1) : angle;
}

/* 1 inside, 0 outside, -1: next to a surface. */
static int is_inside(const double point[3])
{
    enum { LIMITS = 6 };
    double axis[3], x[3], limit[LIMITS] = {1, 1, 1, 1, 1, 1};
    minus3(axis, tube.p1, tube.p0);
    minus3(x, point, tube.p0);
    const double z = dot3(axis, x) / dot3(axis, axis);
    const double r = sqrt(fmax(0, dot3(x, x) - z * z * dot3(axis, axis)));
    limit[0] = z;
    limit[1] = 1 - z;
    limit[2] = tube.outer[0] + z * (tube.outer[1] - tube.outer[0]) - r;
    if (tube.is_hollow)
        limit[3] = r - tube.inner[0] - z * (tube.inner[1] - tube.inner[0]);
    if (tube.has_sector) {
        const double angle = angle_of(axis, x),
                     end = angle_of(axis, tube.sector[1]);
        limit[4] = end - angle;
        limit[5] = fmin(angle, 2 * acos(-1) - angle) > 1e-9 ? 1 : 0;
    }
    int inside = 1;
    for (int i = 0; i < LIMITS; i++) {
        if (fabs(limit[i]) < 1e-9)
            return -1;
        inside &= limit[i] > 0;
    }
    return inside;
}

static long points_inside;

static void check_line(void)
{
    double o[3], d[3];
    random_vector(o, 1);
    random_vector(d, 1);
    const int pieces = pieces_on(o, d);
    for (int i = 0; i < POINTS; i++) {
        const double t = between(-1.5, 1.5);
        double point[3];
        int is = 0;
        along3(point, o, t, d);
        for (int j = 0; j < pieces; j++)
            is |= piece[j].t0 <= t && t <= piece[j].t1;
        const int expected = is_inside(point);
        points_inside += is;
        if (expected >= 0 && !CHECK(is == expected))
            REPORT("t = %g: inside %d, not %d; %zu members", t, is, expected,
                   n);
    }
}

TEST(pieces_are_where_radius_height_and_angle_say)
{
    stream = 1;
    points_inside = 0;
    for (int i = 0; i < TUBES; i++) {
        if (!CHECK(make_tube() == CYLINT_OK))
            continue;
        CHECK(n == 1 + (size_t)tube.is_hollow + 2 * (size_t)tube.has_sector);
        for (int j = 0; j < LINES; j++)
            check_line();
    }
    CHECK(points_inside > TUBES * LINES * POINTS / 40);
}

TEST(sectors_of_simple_directions_are_exact)
{
    const double p0[3] = {0, 0, 0}, p1[3] = {0, 0, 2}, outer[2] = {2, 2},
                 inner[2] = {1, 1};
    const double quarter[2][3] = {{1, 0, 0}, {0, 1, 0}},
                 rest[2][3] = {{0, 1, 0}, {1, 0, 0}},
                 half[2][3] = {{1, 0, 0}, {-1, 0, 5}};
    const double o[3] = {-5, 0, 1}, d[3] = {1, 0, 0};
    /* The line lies in the plane y = 0 that bounds the sectors, and is inside. */
    CHECK(make_members(p0, p1, outer, inner, quarter) == CYLINT_OK &&
          clauses[2] != clauses[3]);
    CHECK(pieces_on(o, d) == 1 && piece[0].t0 == 6 && piece[0].t1 == 7);
    CHECK(make_members(p0, p1, outer, inner, rest) == CYLINT_OK &&
          clauses[2] == clauses[3]);
    CHECK(pieces_on(o, d) == 2 && piece[0].t0 == 3 && piece[0].t1 == 4 &&
          piece[1].t0 == 6);
    CHECK(make_members(p0, p1, outer, inner, half) == CYLINT_OK &&
          clauses[2] != clauses[3]);
    CHECK(pieces_on(o, d) == 2);
}

/* The planes contain their directions exactly. */
TEST(sectors_about_a_coordinate_are_exact)
{
    stream = 3;
    for (int i = 0; i < TUBES; i++) {
        const int axis = i % 3;
        const double p0[3] = {0, 0, 0}, outer[2] = {2, 3};
        double p1[3] = {0, 0, 0}, sector[2][3];
        p1[axis] = between(-3, 3);
        random_vector(sector[0], 1);
        random_vector(sector[1], 1);
        if (make_members(p0, p1, outer, NULL, (const double(*)[3])sector) !=
            CYLINT_OK)
            continue;
        CHECK(n == 3 && cylint_contains(&s[1], sector[0]) == 0 &&
              cylint_contains(&s[2], sector[1]) == 0);
    }
}

#ifdef HAVE_MPFR

/* Component i of a normal minus that of x cross y, in its units in the last place;
 * the normal is divided by a power of two. */
static double error_of_normal(const double normal[3], const double x[3],
                              const double y[3], int i)
{
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    real_fixed(300);
    const real exact = minus(times(real_of(x[j]), real_of(y[k])),
                             times(real_of(x[k]), real_of(y[j])));
    const double ratio = normal[i] / mpfr_get_d(exact->x, RND);
    const double got = normal[i] / exp2(rint(log2(ratio)));
    return mpfr_get_d(minus(exact, real_of(got))->x, RND) / ulp(got);
}

/* The products of every other direction nearly cancel. */
TEST(normals_of_sectors_are_within_0501_units)
{
    const double p0[3] = {0, 0, 0}, outer[2] = {2, 3};
    stream = 6;
    for (int i = 0; i < TUBES; i++) {
        double p1[3], sector[2][3];
        random_vector(p1, 1);
        for (int k = 0; k < 2; k++) {
            random_vector(sector[k], 1);
            if (i % 2)
                along3(sector[k], p1, 1e-9, sector[k]);
        }
        if (!CHECK(make_members(p0, p1, outer, NULL,
                                (const double(*)[3])sector) == CYLINT_OK))
            continue;
        for (int j = 0; j < 3; j++) {
            const double *one = cylint_axis(&s[1]), *other = cylint_axis(&s[2]);
            CHECK(fabs(error_of_normal(one, sector[0], p1, j)) <= 0.501);
            CHECK(fabs(error_of_normal(other, p1, sector[1], j)) <= 0.501);
        }
    }
}

#endif

TEST(bad_sectors_are_refused)
{
    const double p0[3] = {0, 0, 0}, p1[3] = {0, 0, 2}, outer[2] = {2, 2};
    const double along[2][3] = {{0, 0, 1}, {0, 1, 0}},
                 same[2][3] = {{1, 0, 0}, {2, 0, 3}},
                 bad[2][3] = {{1, 0, 0}, {NAN, 0, 3}};
    const double zeros[2] = {0, 0}, none[2][3] = {{1, 0, 0}, {0, 0, 0}};
    CHECK(make_members(p0, p1, outer, NULL, along) == CYLINT_EDIRECTION &&
          n == 0);
    CHECK(make_members(p0, p1, outer, NULL, same) == CYLINT_EDIRECTION);
    CHECK(make_members(p0, p1, outer, NULL, bad) == CYLINT_ENONFINITE);
    CHECK(make_members(p0, p1, zeros, NULL, NULL) == CYLINT_ERADIUS);
    CHECK(make_members(p0, p1, outer, zeros, NULL) == CYLINT_OK && n == 1);
    CHECK(make_members(p0, p1, outer, NULL, none) == CYLINT_EDIRECTION);
}

/* The hole is a cone with its apex at p0. */
TEST(a_hole_can_begin_with_the_radius_0)
{
    const double p0[3] = {0, 0, 0}, p1[3] = {0, 0, 2}, outer[2] = {2, 2},
                 inner[2] = {0, 1}, o[3] = {-3, 0, 1}, d[3] = {1, 0, 0};
    CHECK(make_members(p0, p1, outer, inner, NULL) == CYLINT_OK && n == 2);
    CHECK(pieces_on(o, d) == 2);
    CHECK(piece[0].t0 == 1 && piece[0].t1 == 2.5 && piece[1].t0 == 3.5 &&
          piece[1].t1 == 5);
}

TEST(a_bore_that_is_nowhere_narrower_than_the_tube_leaves_no_wall)
{
    const double p0[3] = {0, 0, 0}, p1[3] = {0, 0, 2}, outer[2] = {2, 1},
                 inner[2][2] = {{2, 1}, {3, 1}}, o[3] = {-3, 0, 1},
                 d[3] = {1, 0, 0};
    for (int i = 0; i < 2; i++)
        CHECK(make_members(p0, p1, outer, inner[i], NULL) == CYLINT_OK &&
              pieces_on(o, d) == 0);
}

/* Integers of which no double has a cross product: y is x 2^22, moved by one in a
 * coordinate, or not.  axis . (x cross y) is then a component of axis cross x. */
TEST(directions_that_nearly_agree_make_the_sector_that_they_say)
{
    const double p0[3] = {0, 0, 0}, outer[2] = {1, 1};
    int found[3] = {0};
    stream = 4;
    for (int i = 0; i < 100 * TUBES; i++) {
        const int k = one_of(3), move = one_of(3) - 1;
        int64_t axis[3], x[3];
        double p1[3], sector[2][3];
        for (int j = 0; j < 3; j++) {
            axis[j] = one_of(1 << 30) - (1 << 29);
            x[j] = one_of(1 << 30) - (1 << 29);
            p1[j] = (double)axis[j];
            sector[0][j] = (double)x[j];
            sector[1][j] = 0x1p22 * sector[0][j] + (j == k ? move : 0);
        }
        const int64_t turn = move * (axis[(k + 1) % 3] * x[(k + 2) % 3] -
                                     axis[(k + 2) % 3] * x[(k + 1) % 3]);
        const cylint_status status =
            make_members(p0, p1, outer, NULL, (const double(*)[3])sector);
        found[turn == 0 ? 0 : turn > 0 ? 1 : 2]++;
        CHECK(turn == 0 ? status == CYLINT_EDIRECTION
                        : status == CYLINT_OK && n == 3 &&
                              (clauses[1] != clauses[2]) == (turn > 0));
    }
    CHECK(found[0] > TUBES && found[1] > TUBES && found[2] > TUBES);
}

/* The axis (1, 0, 2), in multiples of the least double and of a double that its
 * points' difference overflows. */
TEST(an_axis_of_extreme_doubles_keeps_its_digits)
{
    static const double p0[2][3] = {{0, 0, 0}, {-0x1p1022, 0, -0x1p1023}},
                        p1[2][3] = {{0x1p-1074, 0, 0x1p-1073},
                                    {0x1p1022, 0, 0x1p1023}},
                        radii[2] = {1, 1},
                        sector[2][3] = {{1, 0, 0}, {0, 1, 0}},
                        out[3] = {1, 0, 3}, in[3] = {1, 0, 1};
    for (int k = 0; k < 2; k++) {
        double outer[3], inner[3];
        CHECK(make_members(p0[k], p1[k], radii, NULL, sector) == CYLINT_OK);
        along3(outer, p0[k], k ? 0x1p1021 : 1, out);
        along3(inner, p0[k], k ? 0x1p1021 : 1, in);
        CHECK(n == 3 && cylint_contains(&s[2], outer) == -1 &&
              cylint_contains(&s[2], inner) == 1);
    }
}
