/*
 * test_tube.c - hollow cylinders and cones and their sectors; those of tube.txt
 */
#include <math.h>

#include "check.h"
#include "cylint_pieces.h"
#include "draw.h"
#include "environment.h"
#include "records.h"
#include "same.h"
#include "shapes/shape_facts.h"
#include "ulps.h"
#ifdef HAVE_MPFR
#include "real.h"
#endif

enum { TUBES = 2000 };

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

TEST(members_are_those_of_the_constructors)
{
    static const double p0[3] = {1, 2, 3}, p1[3] = {2, 3, 5}, outer[2] = {3, 2},
                        inner[2] = {1, 0.5}, refused[2] = {-3, 2},
                        sector[2][3] = {{1, 0, 0}, {0, 1, 2}}; /* half a turn */
    for (int with = 0; with < 4; with++) {
        const int is_hollow = with & 1, has_sector = with >> 1;
        cylint_shape cone;
        CHECK(make_members(p0, p1, refused, is_hollow ? inner : NULL,
                           has_sector ? sector : NULL) == CYLINT_ERADIUS &&
              n == 0);
        CHECK(make_members(p0, p1, outer, is_hollow ? inner : NULL,
                           has_sector ? sector : NULL) == CYLINT_OK &&
              n == 1 + (size_t)is_hollow + 2 * (size_t)has_sector);
        for (int i = 0; i <= is_hollow; i++) {
            const double *r = i ? inner : outer;
            cylint_cone(&cone, p0, r[0], p1, r[1], CYLINT_ENDS_CAPPED);
            CHECK(same_bytes(&s[i], &cone, sizeof cone) &&
                  clauses[i] == (i ? -2 : 1));
        }
        for (size_t i = 1 + (size_t)is_hollow; i < n; i++)
            CHECK(same_bytes(cylint_base(&s[i]), p0, sizeof p0) &&
                  clauses[i] == (int)(i + 2) - is_hollow);
    }
}

/* Makes the tube of a record in every environment, and compares its status or its
 * pieces on the record's line. */
static const char *check_tube(const char *text, const char *known)
{
    double x[22], t[2 * CYLINT_SOLID_PIECES], count = 0, sector[2][3];
    int want, has_sector = 0;
    if (!family_numbers(text, 22, x) || !(known = read_status(known, &want)))
        return NULL;
    if (want == CYLINT_OK &&
        (!(known = family_numbers(known, 1, &count)) || !(count <= 2) ||
         !(known = family_numbers(known, 2 * (int)count, t))))
        return NULL;
    memcpy(sector, x + 10, sizeof sector);
    for (int i = 10; i < 16; i++)
        has_sector |= x[i] != 0;
    EACH_ENVIRONMENT(there) {
        environment_set(there);
        const cylint_status status =
            make_members(x, x + 3, x + 6, isnan(x[8]) ? NULL : x + 8,
                         has_sector ? (const double(*)[3])sector : NULL);
        const int found = status ? (int)n : pieces_on(x + 16, x + 19);
        environment_reset();
        int same = (int)status == want && found == (int)count;
        for (int i = 0; i < found && same; i++)
            same = piece[i].t0 == t[2 * i] && piece[i].t1 == t[2 * i + 1];
        if (!CHECK(same))
            REPORT("%s: status %d, %d pieces", text, (int)status, found);
    }
    return known;
}

TEST(known_tubes_have_their_pieces_or_are_refused)
{
    each_record("tests/library/tube.txt", 16, check_tube);
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
        CHECK(make_members(p0, p1, outer, NULL, (const double(*)[3])sector) ==
                  CYLINT_OK &&
              n == 3 && cylint_contains(&s[1], sector[0]) == 0 &&
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
