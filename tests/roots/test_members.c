/*
 * test_members.c - floors roots and filter: members of hits that are known
 * exactly
 *
 * Each row is a line, a shape, and part, point, normal, z and phi of its hits: the
 * doubles nearest to the real numbers, where a small coordinate frame gives them.
 * The library must return them bit for bit, with each member wanted alone, in every
 * floating-point environment; the oracle must return them too.
 *
 * About the axis from (0, 0, 0) to (0, 0, h) phi is 0 at -y, 1/4 at x, 1/2 at y
 * and 3/4 at -x.
 */
#include <math.h>
#include <string.h>

#include "check.h"
#include "environment.h"
#include "families.h"
#ifdef HAVE_MPFR
#include "oracle.h"
#endif

#define UNIT 0x1p-1074                 /* the least subnormal number */
#define HALF_ROOT 0x1.6a09e667f3bcdp-1 /* the double nearest to sqrt(1/2) */
#define BELOW_1 0x1.fffffffffffffp-1

enum { LATERAL = CYLINT_PART_LATERAL, CAP0, CAP1 };

struct known_hit {
    int part;
    double point[3], normal[3], z, phi;
};

struct known_case {
    const char *what;
    family_line line;
    double line_data[8];
    family_shape shape;
    double shape_data[13];
    cylint_ends ends;
    int n;
    struct known_hit hit[2];
};

/* Radius 1, an axis of length 4. */
#define UPRIGHT FAMILY_CYLINDER, {0, 0, 0, 0, 0, 4, 1}, CYLINT_ENDS_CAPPED

static const struct known_case known_cases[] = {
    /* ---- along the axes of coordinates */
    {"upright cylinder, along x",
     FAMILY_LINE,
     {-3, 0, 1, 1, 0, 0},
     UPRIGHT,
     2,
     {{LATERAL, {-1, 0, 1}, {-1, 0, 0}, 0.25, 0.75},
      {LATERAL, {1, 0, 1}, {1, 0, 0}, 0.25, 0.25}}},
    {"upright cylinder, along y",
     FAMILY_LINE,
     {0, -3, 3, 0, 1, 0},
     UPRIGHT,
     2,
     {{LATERAL, {0, -1, 3}, {0, -1, 0}, 0.75, 0},
      {LATERAL, {0, 1, 3}, {0, 1, 0}, 0.75, 0.5}}},
    {"upright cylinder, down its axis",
     FAMILY_RAY,
     {0, 0, 7, 0, 0, -0.5},
     UPRIGHT,
     2,
     {{CAP1, {0, 0, 4}, {0, 0, 1}, 1, 0}, {CAP0, {0, 0, 0}, {0, 0, -1}, 0, 0}}},
    {"the same with zeros that are negative",
     FAMILY_RAY,
     {-0.0, -0.0, 7, -0.0, -0.0, -0.5},
     FAMILY_CYLINDER,
     {-0.0, -0.0, -0.0, -0.0, -0.0, 4, 1},
     CYLINT_ENDS_CAPPED,
     2,
     {{CAP1, {0, 0, 4}, {0, 0, 1}, 1, 0}, {CAP0, {0, 0, 0}, {0, 0, -1}, 0, 0}}},
    {"negative zeros across the axis",
     FAMILY_LINE,
     {3, -0.0, 2, -1, -0.0, -0.0},
     UPRIGHT,
     2,
     {{LATERAL, {1, 0, 2}, {1, 0, 0}, 0.5, 0.25},
      {LATERAL, {-1, 0, 2}, {-1, 0, 0}, 0.5, 0.75}}},
    {"an axis downward: phi turns the other way",
     FAMILY_LINE,
     {-3, 0, 1, 1, 0, 0},
     FAMILY_CYLINDER,
     {0, 0, 4, 0, 0, 0, 1},
     CYLINT_ENDS_CAPPED,
     2,
     {{LATERAL, {-1, 0, 1}, {-1, 0, 0}, 0.75, 0.75},
      {LATERAL, {1, 0, 1}, {1, 0, 0}, 0.75, 0.25}}},
    {"an axis along x: e is y",
     FAMILY_LINE,
     {1, -3, 0, 0, 1, 0},
     FAMILY_CYLINDER,
     {0, 0, 0, 4, 0, 0, 1},
     CYLINT_ENDS_CAPPED,
     2,
     {{LATERAL, {1, -1, 0}, {0, -1, 0}, 0.25, 0.75},
      {LATERAL, {1, 1, 0}, {0, 1, 0}, 0.25, 0.25}}},
    {"a diagonal of the section: eighths of a turn",
     FAMILY_LINE,
     {-3, -3, 2, 1, 1, 0},
     UPRIGHT,
     2,
     {{LATERAL,
       {-HALF_ROOT, -HALF_ROOT, 2},
       {-HALF_ROOT, -HALF_ROOT, 0},
       0.5,
       0.875},
      {LATERAL,
       {HALF_ROOT, HALF_ROOT, 2},
       {HALF_ROOT, HALF_ROOT, 0},
       0.5,
       0.375}}},
    {"a whole cylinder far above and below its ends",
     FAMILY_LINE,
     {-17, 0, -47, 1, 0, 1},
     FAMILY_CYLINDER,
     {0, 0, 0, 0, 0, 4, 1},
     CYLINT_ENDS_INFINITE,
     2,
     {{LATERAL, {-1, 0, -31}, {-1, 0, 0}, -7.75, 0.75},
      {LATERAL, {1, 0, -29}, {1, 0, 0}, -7.25, 0.25}}},
    {"a right triangle: 3/5 and 4/5",
     FAMILY_LINE,
     {-9, 3, 1, 1, 0, 0},
     FAMILY_CYLINDER,
     {0, 0, 0, 0, 0, 4, 5},
     CYLINT_ENDS_OPEN,
     2,
     {{LATERAL, {-4, 3, 1}, {-0.8, 0.6, 0}, 0.25, 0x1.4b90147677cc2p-1},
      {LATERAL, {4, 3, 1}, {0.8, 0.6, 0}, 0.25, 0x1.68dfd7131067cp-2}}},
    {"a touch",
     FAMILY_LINE,
     {1, -3, 3, 0, 1, 0},
     UPRIGHT,
     1,
     {{LATERAL, {1, 0, 3}, {1, 0, 0}, 0.75, 0.25}}},
    {"the ray begins on the lateral surface: t is 0",
     FAMILY_RAY,
     {0, -1, 0.1, 0, 1, 0},
     UPRIGHT,
     2,
     {{LATERAL, {0, -1, 0.1}, {0, -1, 0}, 0.025, 0},
      {LATERAL, {0, 1, 0.1}, {0, 1, 0}, 0.025, 0.5}}},

    /* ---- caps and rims */
    {"a ray between the caps: z is 0 and 1",
     FAMILY_LINE,
     {-0.1, 0.3, -1, 0.1, -0.3, 1},
     UPRIGHT,
     2,
     {{CAP0, {0, 0, 0}, {0, 0, -1}, 0, 0},
      {LATERAL,
       {0x1.43d136248490fp-2, -0x1.e5b9d136c6d96p-1, 0x1.94c583ada5b53p+1},
       {0x1.43d136248490fp-2, -0x1.e5b9d136c6d96p-1, 0},
       0x1.94c583ada5b53p-1,
       0x1.a37f5c4c419f0p-5}}},
    {"a ray from the middle of the base: t is 0",
     FAMILY_RAY,
     {0, 0, 0, 0, 0, 1},
     UPRIGHT,
     2,
     {{CAP0, {0, 0, 0}, {0, 0, -1}, 0, 0}, {CAP1, {0, 0, 4}, {0, 0, 1}, 1, 0}}},
    {"in the plane of the top: the rim is lateral",
     FAMILY_LINE,
     {-3, 0, 4, 1, 0, 0},
     UPRIGHT,
     2,
     {{LATERAL, {-1, 0, 4}, {-1, 0, 0}, 1, 0.75},
      {LATERAL, {1, 0, 4}, {1, 0, 0}, 1, 0.25}}},
    {"through both rims",
     FAMILY_LINE,
     {-2, 0, -2, 1, 0, 2},
     UPRIGHT,
     2,
     {{LATERAL, {-1, 0, 0}, {-1, 0, 0}, 0, 0.75},
      {LATERAL, {1, 0, 4}, {1, 0, 0}, 1, 0.25}}},
    {"on a ruling: its ends on the rims",
     FAMILY_LINE,
     {0, 1, -5, 0, 0, 1},
     UPRIGHT,
     2,
     {{LATERAL, {0, 1, 0}, {0, 1, 0}, 0, 0.5},
      {LATERAL, {0, 1, 4}, {0, 1, 0}, 1, 0.5}}},

    /* ---- cones */
    {"upright cone of 45 degrees, along x",
     FAMILY_LINE,
     {-3, 0, 0.5, 1, 0, 0},
     FAMILY_CONE,
     {0, 0, 0, 1, 0, 0, 1, 0},
     CYLINT_ENDS_CAPPED,
     2,
     {{LATERAL, {-0.5, 0, 0.5}, {-HALF_ROOT, 0, HALF_ROOT}, 0.5, 0.75},
      {LATERAL, {0.5, 0, 0.5}, {HALF_ROOT, 0, HALF_ROOT}, 0.5, 0.25}}},
    {"the apex of a capped cone",
     FAMILY_LINE,
     {-3, 0, 1, 1, 0, 0},
     FAMILY_CONE,
     {0, 0, 0, 1, 0, 0, 1, 0},
     CYLINT_ENDS_CAPPED,
     1,
     {{LATERAL, {0, 0, 1}, {0, 0, 1}, 1, 0}}},
    {"the apex of a nappe, below its base",
     FAMILY_LINE,
     {-3, 0, -1, 1, 0, 0},
     FAMILY_CONE,
     {0, 0, 0, 1, 0, 0, 1, 2},
     CYLINT_ENDS_NAPPE,
     1,
     {{LATERAL, {0, 0, -1}, {0, 0, -1}, -1, 0}}},
    {"the apex of a double cone, down its axis",
     FAMILY_LINE,
     {1, 2, 9, 0, 0, -1},
     FAMILY_ACONE,
     {1, 2, 3, 0, 0, 1, 45},
     CYLINT_ENDS_INFINITE,
     1,
     {{LATERAL, {1, 2, 3}, {0, 0, 1}, 0, 0}}},
    {"double cone of 45 degrees, across",
     FAMILY_LINE,
     {0, -9, -2, 0, 1, 0},
     FAMILY_ACONE,
     {0, 0, 0, 0, 0, 1, 45},
     CYLINT_ENDS_INFINITE,
     2,
     {{LATERAL, {0, -2, -2}, {0, -HALF_ROOT, HALF_ROOT}, -2, 0},
      {LATERAL, {0, 2, -2}, {0, HALF_ROOT, HALF_ROOT}, -2, 0.5}}},

    /* ---- elliptic kinds: phi is 0 along a and 1/4 along b */
    {"upright elliptic cylinder, along a",
     FAMILY_LINE,
     {-3, 0, 1, 1, 0, 0},
     FAMILY_ECYLINDER,
     {0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 4},
     CYLINT_ENDS_CAPPED,
     2,
     {{LATERAL, {-2, 0, 1}, {-1, 0, 0}, 0.25, 0.5},
      {LATERAL, {2, 0, 1}, {1, 0, 0}, 0.25, 0}}},
    {"a left-handed one, along b",
     FAMILY_LINE,
     {0, -9, 1, 0, 1, 0},
     FAMILY_ECYLINDER,
     {0, 0, 0, -2, 0, 0, 0, 3, 0, 0, 0, 4},
     CYLINT_ENDS_CAPPED,
     2,
     {{LATERAL, {0, -3, 1}, {0, -1, 0}, 0.25, 0.75},
      {LATERAL, {0, 3, 1}, {0, 1, 0}, 0.25, 0.25}}},
    {"an oblique one: the caps are perpendicular to z",
     FAMILY_LINE,
     {2, 0, -1, 0, 0, 1},
     FAMILY_ECYLINDER,
     {0, 0, 0, 3, 0, 0, 0, 1, 0, 2, 0, 4},
     CYLINT_ENDS_CAPPED,
     2,
     {{CAP0, {2, 0, 0}, {0, 0, -1}, 0, 0}, {CAP1, {2, 0, 4}, {0, 0, 1}, 1, 0}}},
    {"the apex of an elliptic cone",
     FAMILY_LINE,
     {0, -9, 4, 0, 1, 0},
     FAMILY_ECONE,
     {0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0, 4, 0},
     CYLINT_ENDS_CAPPED,
     1,
     {{LATERAL, {0, 0, 4}, {0, 0, 1}, 1, 0}}},

    /* ---- round kinds */
    {"sphere: 3/5 and 4/5",
     FAMILY_LINE,
     {1, 5, -9, 0, 0, 1},
     FAMILY_SPHERE,
     {1, 2, 3, 5},
     CYLINT_ENDS_CAPPED,
     2,
     {{LATERAL, {1, 5, -1}, {0, 0.6, -0.8}, 0, 0},
      {LATERAL, {1, 5, 7}, {0, 0.6, 0.8}, 0, 0}}},
    {"capsule, down its axis: the poles",
     FAMILY_LINE,
     {0, 0, 9, 0, 0, -1},
     FAMILY_CAPSULE,
     {0, 0, 0, 0, 0, 4, 1},
     CYLINT_ENDS_CAPPED,
     2,
     {{CAP1, {0, 0, 5}, {0, 0, 1}, 1.25, 0},
      {CAP0, {0, 0, -1}, {0, 0, -1}, -0.25, 0}}},
    {"capsule, on the circle of tangency",
     FAMILY_LINE,
     {0, -9, 4, 0, 1, 0},
     FAMILY_CAPSULE,
     {0, 0, 0, 0, 0, 4, 1},
     CYLINT_ENDS_CAPPED,
     2,
     {{LATERAL, {0, -1, 4}, {0, -1, 0}, 1, 0},
      {LATERAL, {0, 1, 4}, {0, 1, 0}, 1, 0.5}}},
    {"capsule, on the ball: 3/5 and 4/5",
     FAMILY_LINE,
     {-99, 0, 8, 1, 0, 0},
     FAMILY_CAPSULE,
     {0, 0, 0, 0, 0, 4, 5},
     CYLINT_ENDS_CAPPED,
     2,
     {{CAP1, {-3, 0, 8}, {-0.6, 0, 0.8}, 2, 0.75},
      {CAP1, {3, 0, 8}, {0.6, 0, 0.8}, 2, 0.25}}},
    {"rounded cone of sine 3/5, on its lateral surface",
     FAMILY_LINE,
     {-99, 0, 5.4, 1, 0, 0},
     FAMILY_RCONE,
     {0, 0, 0, 6, 0, 0, 10, 0},
     CYLINT_ENDS_CAPPED,
     2,
     {{LATERAL, {-0x1.b999999999999p1, 0, 5.4}, {-0.8, 0, 0.6}, 0.54, 0.75},
      {LATERAL, {0x1.b999999999999p1, 0, 5.4}, {0.8, 0, 0.6}, 0.54, 0.25}}},

    /* ---- roundings */
    {"coordinates between two doubles: ties to even",
     FAMILY_LINE,
     {1, 0x1.0000000000001p0, 0, 0x1p-53, 0x1p-53, 1},
     FAMILY_CYLINDER,
     {0, 0, -1, 0, 0, 1, 2},
     CYLINT_ENDS_CAPPED,
     2,
     {{CAP0, {BELOW_1, 1, -1}, {0, 0, -1}, 0, 0.375},
      {CAP1, {1, 0x1.0000000000002p0, 1}, {0, 0, 1}, 1, 0.375}}},
    {"z between two doubles: ties to even",
     FAMILY_LINE,
     {0, -2, 1, 0, 1, 0x1p-53},
     FAMILY_CYLINDER,
     {0, 0, 0, 0, 0, 1, 1},
     CYLINT_ENDS_INFINITE,
     2,
     {{LATERAL, {0, -1, 1}, {0, -1, 0}, 1, 0},
      {LATERAL,
       {0, 1, 0x1.0000000000002p0},
       {0, 1, 0},
       0x1.0000000000002p0,
       0.5}}},
    {"beyond the largest double: infinite",
     FAMILY_LINE,
     {-3, 0, 0, 0x1p-1000, 0, 0x1p100},
     FAMILY_CYLINDER,
     {0, 0, 0, 0, 0, 4, 1},
     CYLINT_ENDS_INFINITE,
     2,
     {{LATERAL, {-1, 0, HUGE_VAL}, {-1, 0, 0}, HUGE_VAL, 0.75},
      {LATERAL, {1, 0, HUGE_VAL}, {1, 0, 0}, HUGE_VAL, 0.25}}},
    {"subnormal coordinates",
     FAMILY_LINE,
     {-9 * UNIT, 3 * UNIT, 2 * UNIT, 1, 0, 0},
     FAMILY_CYLINDER,
     {0, 0, 0, 0, 0, 4 * UNIT, 5 * UNIT},
     CYLINT_ENDS_CAPPED,
     2,
     {{LATERAL,
       {-4 * UNIT, 3 * UNIT, 2 * UNIT},
       {-0.8, 0.6, 0},
       0.5,
       0x1.4b90147677cc2p-1},
      {LATERAL,
       {4 * UNIT, 3 * UNIT, 2 * UNIT},
       {0.8, 0.6, 0},
       0.5,
       0x1.68dfd7131067cp-2}}},
    {"subnormal coordinates between two doubles; below 0 too",
     FAMILY_LINE,
     {0, 0, 0, 0.5, -0.25, 1},
     FAMILY_CYLINDER,
     {0, 0, -1 * UNIT, 0, 0, 3 * UNIT, 1},
     CYLINT_ENDS_CAPPED,
     2,
     {{CAP0, {0, 0, -1 * UNIT}, {0, 0, -1}, 0, 0x1.5a37f5c4c419fp-1},
      {CAP1,
       {2 * UNIT, -1 * UNIT, 3 * UNIT},
       {0, 0, 1},
       1,
       0x1.68dfd7131067cp-3}}},
    {"an angle just below a whole turn",
     FAMILY_LINE,
     {-1e-300, -2, 1, 0, 1, 0},
     UPRIGHT,
     2,
     {{LATERAL, {-1e-300, -1, 1}, {-1e-300, -1, 0}, 0.25, BELOW_1},
      {LATERAL, {-1e-300, 1, 1}, {-1e-300, 1, 0}, 0.25, 0.5}}},
    {"an angle below a whole turn by less than half a step of 1",
     FAMILY_LINE,
     {-0x1p-51, -2, 1, 0, 1, 0},
     UPRIGHT,
     2,
     {{LATERAL, {-0x1p-51, -1, 1}, {-0x1p-51, -1, 0}, 0.25, BELOW_1},
      {LATERAL,
       {-0x1p-51, 1, 1},
       {-0x1p-51, 1, 0},
       0.25,
       0x1.0000000000001p-1}}},
    {"an angle below the normal numbers",
     FAMILY_LINE,
     {16 * UNIT, -2, 1, 0, 1, 0},
     UPRIGHT,
     2,
     {{LATERAL, {16 * UNIT, -1, 1}, {16 * UNIT, -1, 0}, 0.25, 3 * UNIT},
      {LATERAL, {16 * UNIT, 1, 1}, {16 * UNIT, 1, 0}, 0.25, 0.5}}},
    {"an angle below all numbers: 0",
     FAMILY_LINE,
     {3 * UNIT, -2, 1, 0, 1, 0},
     UPRIGHT,
     2,
     {{LATERAL, {3 * UNIT, -1, 1}, {3 * UNIT, -1, 0}, 0.25, 0},
      {LATERAL, {3 * UNIT, 1, 1}, {3 * UNIT, 1, 0}, 0.25, 0.5}}},
    {"an angle below a whole turn by less than all numbers",
     FAMILY_LINE,
     {-UNIT, -2, 1, 0, 1, 0},
     UPRIGHT,
     2,
     {{LATERAL, {-UNIT, -1, 1}, {-UNIT, -1, 0}, 0.25, BELOW_1},
      {LATERAL, {-UNIT, 1, 1}, {-UNIT, 1, 0}, 0.25, 0.5}}},
    {"from 1e10 radii away",
     FAMILY_LINE,
     {-5e10, 3, 1, 1, 0, 0},
     FAMILY_CYLINDER,
     {0, 0, 0, 0, 0, 4, 5},
     CYLINT_ENDS_CAPPED,
     2,
     {{LATERAL, {-4, 3, 1}, {-0.8, 0.6, 0}, 0.25, 0x1.4b90147677cc2p-1},
      {LATERAL, {4, 3, 1}, {0.8, 0.6, 0}, 0.25, 0x1.68dfd7131067cp-2}}},
};

/* ------------------------------------------------------------ comparing -- */

static int case_of(const struct known_case *from, struct family_case *c)
{
    *c = family_of(from->line, from->line_data, from->shape, from->shape_data);
    c->ends = from->ends;
    return family_make(c);
}

static int same(const double *got, const double *want, int n)
{
    return memcmp(got, want, (size_t)n * sizeof *got) == 0;
}

static int is_hit(const cylint_hit *got, const struct known_hit *want,
                  unsigned members)
{
    return (!(members & CYLINT_WANT_PART) || got->part == want->part) &&
           (!(members & CYLINT_WANT_POINT) ||
            same(got->point, want->point, 3)) &&
           (!(members & CYLINT_WANT_NORMAL) ||
            same(got->normal, want->normal, 3)) &&
           (!(members & CYLINT_WANT_Z) || same(&got->z, &want->z, 1)) &&
           (!(members & CYLINT_WANT_PHI) || same(&got->phi, &want->phi, 1));
}

static void expect(const cylint_answer *got, const struct known_case *want,
                   unsigned members, const char *whose)
{
    int good = CHECK(got->n == want->n);
    for (int i = 0; good && i < want->n; i++) {
        const cylint_hit *h = &got->hit[i];
        good = CHECK(is_hit(h, &want->hit[i], members));
        if (!good)
            REPORT(
                "%s, hit %d, members %#x: part %d {%a, %a, %a}, {%a, %a, %a}, "
                "%a, %a",
                whose, i, members, h->part, h->point[0], h->point[1],
                h->point[2], h->normal[0], h->normal[1], h->normal[2], h->z,
                h->phi);
    }
    if (!good)
        REPORT("%s", want->what);
}

static void every_case(struct environment there)
{
    static const unsigned members[] = {CYLINT_WANT_ALL,   CYLINT_WANT_PART,
                                       CYLINT_WANT_POINT, CYLINT_WANT_NORMAL,
                                       CYLINT_WANT_Z,     CYLINT_WANT_PHI};
    for (size_t i = 0; i < sizeof known_cases / sizeof *known_cases; i++)
        for (size_t k = 0; k < sizeof members / sizeof *members; k++) {
            struct family_case c;
            cylint_answer got;
            memset(&got, 0, sizeof got);
            CHECK(case_of(&known_cases[i], &c));
            environment_set(there);
            cylint_intersect(&c.shape, &c.line, members[k], &got);
            environment_reset();
            expect(&got, &known_cases[i], members[k], "got");
        }
}

static void members_are_the_nearest_doubles(void)
{
    every_case(environment_of(0));
}

static void members_are_the_same_in_every_environment(void)
{
    everywhere(every_case);
}

#ifdef HAVE_MPFR
static void the_oracle_has_the_same_members(void)
{
    for (size_t i = 0; i < sizeof known_cases / sizeof *known_cases; i++) {
        struct family_case c;
        cylint_answer want;
        CHECK(case_of(&known_cases[i], &c));
        oracle_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &want);
        expect(&want, &known_cases[i], CYLINT_WANT_ALL, "oracle");
    }
}
#endif

int main(void)
{
    RUN(members_are_the_nearest_doubles);
    RUN(members_are_the_same_in_every_environment);
#ifdef HAVE_MPFR
    RUN(the_oracle_has_the_same_members);
#endif
    return check_end();
}
