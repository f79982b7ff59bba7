/*
 * test_rare_branches.c - floors signs, roots and shapes: constructed inputs
 *
 * Each row reaches a branch of src/ that the families never take, or an
 * operator whose change they do not detect (make coverage, make mutants), and
 * names it.  All members of a hit must have the bits of the oracle.
 */
#ifdef HAVE_MPFR

#include <float.h>
#include <math.h>
#include <string.h>

#include "check.h"
#include "families.h"
#include "oracle.h"
#include "ulps.h"

enum { BOX_ULPS = 4 };

struct special_case {
    const char *what;
    family_line line;
    double o_d[6];
    family_shape shape;
    double data[13];
    cylint_ends ends;
};

static const struct special_case special_cases[] = {
    {"a root whose further digits are too inaccurate",
     FAMILY_LINE,
     {0, 0, 0, 0, -7, 6},
     FAMILY_CYLINDER,
     {6, 0x1.0a0a0a0a0a0ap+907, 0, 0, 0, 0, 6},
     CYLINT_ENDS_CAP0},
    {"a root that differs from -1 by 2^-2007: the normal was NaN",
     FAMILY_LINE,
     {0x1p934, 0x1p934, 0x1p934, 0x1p934, 0x1p934, 0x1p934},
     FAMILY_ECYLINDER,
     {0, 0, 0, 0, -7, 0, 0, -7, -0x1p-1073, 4, 0x1.8p-977, -8},
     CYLINT_ENDS_CAP0},
    {"z where a, b and h are nearly dependent: had an error of 22 ulp",
     FAMILY_LINE,
     {-0x1.f4e4804e96c52p-54, -0x1.645d5c3ab05ecp-63, 0x1.ffe90529f6272p-55,
      -0x1.636ff62d275b5p-1, 0x1.645d5c3ab05ecp-4, 0x1.6fad609d8e459p-7},
     FAMILY_ECYLINDER,
     {0, 0, 0, 0x1.515ac200faf3bp-1, -0x1.10323f4a5421fp-2,
      0x1.dbce4dd109826p-7, 0x1.0e8f9ee746e4ap-2, 0x1.35fef62b65678p-2,
      -0x1.e2e0745d73a1cp-1, 0x1.db5a6f97f68ccp-1, -0x1.a76af030a74cep-3,
      -0x1.796907f3e6a6ap-2},
     CYLINT_ENDS_NAPPE},
    {"z where a.(b x h) underflows: was NaN",
     FAMILY_LINE,
     {0, 0, 0, 0x1p-904, 0x1p36, 0},
     FAMILY_ECYLINDER,
     {0, 0, 0x1p-33, 0, 0, 0x1p35, 0x1p-184, 0, 0, 0, 0x1p-467, 0},
     CYLINT_ENDS_NAPPE},
    {"phi so far away that underflow matters: had an error of 1/4",
     FAMILY_LINE,
     {-0x1.2400d3b2cp-38, 0, -0x1.6358f422p+53, -0x1.18e0d9e54p-799,
      -0x1.e882d99fp+25, -0x1.4a609288p-860},
     FAMILY_ECONE,
     {0x1.459540d9p-533, -0x1.7e4f64d5p-256, 0x1.3dbf7826p-42,
      -0x1.0678551bp-937, -0x1.16d1c872cp-282, 0, 0, -0x1.c3f62d74p-598,
      -0x1.a985db15p+50, 0, 0, 0x1.f2bb2209p-193, 0},
     CYLINT_ENDS_NAPPE},
    {"z beyond the doubles in pairs: was NaN",
     FAMILY_LINE,
     {-0x1.72879722p-916, 0x1.5381e2ep-664, 0, -0x1.634e62b1p-971,
      -0x1.986f203fp-56, 0},
     FAMILY_ECYLINDER,
     {-0x1.cd3c54448p-936, 0x1.f6a7542cp-900, 0x0.0000000001926p-1022,
      0x1.cbb3fce3p+1, -0x1.19ae1edbp-1020, 0x1.45a20ec5p-548,
      0x1.4b6ac69cp-669, -0x1.71e40e47p-355, -0x1.3bbe3a2cp-32, 0,
      0x1.8278dc93p-287, 0},
     CYLINT_ENDS_INFINITE},
    {"apex normal: u.w needs pairs",
     FAMILY_LINE,
     {0, 0, 0, 1, -0x1.fffffffffffffp-1, 0},
     FAMILY_ACONE,
     {0, 0, 0, 1, 1, 0, 45},
     CYLINT_ENDS_INFINITE},
    {"apex normal: u.w needs exact arithmetic",
     FAMILY_LINE,
     {0, 0, 0, 1, 0, -0x1p-1000},
     FAMILY_ACONE,
     {0, 0, 0, 0, 0, 1, 45},
     CYLINT_ENDS_INFINITE},
    {"apex normal: no filter applies",
     FAMILY_LINE,
     {0x1p80, 0x1p80, 0, 1, 1, 0},
     FAMILY_ACONE,
     {0, 0, 0, 0, 1, 1, 30},
     CYLINT_ENDS_INFINITE},
    {"parallel to a ruling: the sign of B needs pairs",
     FAMILY_LINE,
     {0x1.0000000000001p0, 0, 1, 1, 0, 1},
     FAMILY_ACONE,
     {0, 0, 0, 0, 0, 1, 45},
     CYLINT_ENDS_INFINITE},
    {"parallel to a ruling: the sign of B needs exact arithmetic",
     FAMILY_LINE,
     {1, 0, 1, 1, 0, 1},
     FAMILY_ACONE,
     {0x1p-106, 0, 0, 0, 0, 1, 45},
     CYLINT_ENDS_INFINITE},
    {"the same with the other sign",
     FAMILY_LINE,
     {1, 0, 1, 1, 0, 1},
     FAMILY_ACONE,
     {-0x1p-106, 0, 0, 0, 0, 1, 45},
     CYLINT_ENDS_NAPPE},
    {"parallel to a ruling: B on a grid, exact without pairs",
     FAMILY_LINE,
     {0x1.0000000000004p50, 0, 0x1p50, 1, 0, 1},
     FAMILY_ACONE,
     {0, 0, 0, 0, 0, 1, 45},
     CYLINT_ENDS_INFINITE},
    {"parallel to a ruling: no filter applies to B",
     FAMILY_LINE,
     {0x1p80, 0, 0, 1, 0, 1},
     FAMILY_ACONE,
     {0, 0, 0, 0, 0, 1, 45},
     CYLINT_ENDS_NAPPE},
    {"the midpoint of two doubles is the other root",
     FAMILY_LINE,
     {-0x1.8p80, 0x1.ffffffffffffep51, 0, 1, 0, 0},
     FAMILY_CYLINDER,
     {0, 0, 0, 0, 0, 1, 0x1.0000000000001p52},
     CYLINT_ENDS_INFINITE},
    {"the same where the line is steeper than the rulings",
     FAMILY_LINE,
     {0x1p27, 0, -0x1.8p80, 0, 0, 1},
     FAMILY_ACONE,
     {0, 0, 0, 0, 0, 1, 45},
     CYLINT_ENDS_INFINITE},
    {"a root beyond 2^300 in the filters' scale",
     FAMILY_LINE,
     {1, 0, 0, 1, 0x1p-300, 1},
     FAMILY_ACONE,
     {0, 0, 0, 0, 0, 1, 45},
     CYLINT_ENDS_INFINITE},
    {"a root below 2^-300 in the filters' scale",
     FAMILY_LINE,
     {0, 0, -0x1p-350, 0, 0, 1},
     FAMILY_CYLINDER,
     {0, 0, 0, 0, 0, 1, 1},
     CYLINT_ENDS_CAPPED},
    {"a root beyond 2^1000 by the line's scale",
     FAMILY_LINE,
     {-3, 0, 0.5, 0x1p-1010, 0x1p-1011, 0},
     FAMILY_CYLINDER,
     {0, 0, 0, 0, 0, 1, 3},
     CYLINT_ENDS_CAPPED},
    {"phi where the axis overflows: a rounded component was the least",
     FAMILY_LINE,
     {0x1.8p+1023, 0, 0x1.4p+1023, -0x0.0000000000004p-1022, 0x1p+1022,
      -0x1.fffffffffffffp+1023},
     FAMILY_CONE,
     {0x1.4p+1023, 0x0.0000000000001p-1022, 0, 0x1.4p+1023, -0x1.cp+1023,
      -0x1p+1022, 0x1p+1022, 0x1.cp+1023},
     CYLINT_ENDS_NAPPE},
    {"phi where the axis overflows: of two subnormal components the least",
     FAMILY_LINE,
     {0, 0x1p1023, 0x1p1022, 0, -1, -0.25},
     FAMILY_CYLINDER,
     {-0x1.4p1023, 0, 0, 0x1.4p1023, 0x1p-1073, 0x1p-1074, 0x1p1022},
     CYLINT_ENDS_CAPPED},
    {"components of a normal in the middle of two doubles, and near it",
     FAMILY_LINE,
     {0.75, 0.625, -2, 0, 0, 1},
     FAMILY_SPHERE,
     {0x1p-54, 0x1.0000000001p-54, 0, 1},
     CYLINT_ENDS_CAPPED},
    {"phi where two components of the axis differ by less than a rounding",
     FAMILY_RAY,
     {0x1.999999999999ap-2, 0x1p-1, -0x1.999999999999ap-1, 0, 0,
      -0x1.999999999999ap-3},
     FAMILY_CYLINDER,
     {0, 0x1.3333333333333p-2, -0x1.8p+0, -0x1.199999999999ap+0,
      -0x1.999999999999ap-1, 0x1p-1, 0x1.ccccccccccccdp-1},
     CYLINT_ENDS_INFINITE},
    {"a subnormal component of a normal, by that of the line's direction",
     FAMILY_LINE,
     {-4, 2, -6, 1, -0x0.0000000000001p-1022, 3},
     FAMILY_ACONE,
     {-3, 2, -1, -1, 0, -3, 45},
     CYLINT_ENDS_CAPPED},
    {"an axis of which all components but one are 0 when they are scaled",
     FAMILY_RAY,
     {0x1.189206ee0b844p-894, -0x1.3e8f59b7511b9p-900, -0x1.3e1a78d46fb57p+183,
      0x1.7b83c3c9fc9aep+173, -0x1.6ca3d2f1086fcp-890, -0x1.ca5ac27106f95p-901},
     FAMILY_CYLINDER,
     {0x0.095fc1d6aa39cp-1022, -0x1.98bfd78247755p-897, -0x1.5031b20968116p-895,
      -0x1.7d9ef85b21732p-889, 0x1.a8a0b1a0560a2p-896, -0x1.19fe0e7a0d61fp-887,
      0x1.1dbfdbce4e3cbp+187},
     CYLINT_ENDS_CAP0},
    {"a root below 2^-900 by the line's scale",
     FAMILY_LINE,
     {-3, 0, 0.5, 0x1p1000, 0x1p999, 0},
     FAMILY_CYLINDER,
     {0, 0, 0, 0, 0, 1, 3},
     CYLINT_ENDS_CAPPED},
};

static int case_of(const struct special_case *from, struct family_case *c)
{
    *c = family_of(from->line, from->o_d, from->shape, from->data);
    c->ends = from->ends;
    return family_make(c);
}

static int agrees(const struct family_case *c)
{
    cylint_answer got, want;
    memset(&got, 0, sizeof got);
    cylint_intersect(&c->shape, &c->line, CYLINT_WANT_ALL, &got);
    oracle_intersect(&c->shape, &c->line, CYLINT_WANT_ALL, &want);
    int same = CHECK(got.relation == want.relation) && CHECK(got.n == want.n);
    for (int i = 0; same && i < want.n; i++) {
        double off[MEASURES];
        ulps_of_hit(&got.hit[i], &want.hit[i], oracle_other(i), off);
        same = CHECK(got.hit[i].t == want.hit[i].t) &&
               CHECK(got.hit[i].part == want.hit[i].part) &&
               CHECK(got.hit[i].side == want.hit[i].side);
        for (int k = 0; same && k < MEASURES; k++)
            if (!(same = CHECK(off[k] == 0)))
                REPORT("%s of hit %d, %g ulp", measure_names[k], i, off[k]);
    }
    return same;
}

static void every_special_case_agrees_with_the_oracle(void)
{
    for (size_t i = 0; i < sizeof special_cases / sizeof special_cases[0];
         i++) {
        struct family_case c;
        if (CHECK(case_of(&special_cases[i], &c)) && agrees(&c))
            continue;
        REPORT("%s", special_cases[i].what);
        family_report(&c);
    }
}

/* The normal is the point minus c: 2^-54 before 3/4 and 5/8.  If c[1] exceeds
 * 2^-54 by 2^-94, the second component is nearer to the middle of two doubles than
 * 2^-90 of itself; if by 2^-90, it is not. */
static void the_oracle_has_both_doubles_beside_a_middle(void)
{
    static const double o[3] = {0.75, 0.625, -2}, d[3] = {0, 0, 1};
    static const double beyond[] = {0x1p-94, 0x1p-90};
    for (int i = 0; i < 2; i++) {
        const double c[3] = {0x1p-54, 0x1p-54 + beyond[i], 0};
        cylint_shape s;
        cylint_line line;
        cylint_answer want;
        CHECK(cylint_sphere(&s, c, 1, CYLINT_ENDS_CAPPED) == CYLINT_OK &&
              cylint_whole_line(&line, o, d) == CYLINT_OK);
        oracle_intersect(&s, &line, CYLINT_WANT_ALL, &want);
        const double *n = want.hit[0].normal;
        const double *other = oracle_other(0)->normal;
        CHECK(n[0] == 0.75 && other[0] == 0x1.7ffffffffffffp-1);
        CHECK(n[1] == 0x1.3ffffffffffffp-1);
        CHECK(other[1] == (i == 0 ? 0.625 : n[1]));
        CHECK(other[2] == n[2]);
    }
}

/* From far away the root in pairs is accurate enough for t but may be too
 * inaccurate for the point. */
static void a_grazing_line_from_afar_finds_its_point(void)
{
    for (int far = 8; far <= 60; far += 4) {
        for (int depth = 2; depth <= 48; depth += 2) {
            struct special_case k = {
                "grazing from afar",
                FAMILY_LINE,
                {-ldexp(1.1, far), 0, 1 - ldexp(1.3, -depth), 1, 0x1p-40, 0},
                FAMILY_CYLINDER,
                {0, -1, 0, 0, 1, 0, 1},
                CYLINT_ENDS_INFINITE};
            struct family_case c;
            k.o_d[1] = k.o_d[0] * 0x1p-40; /* aims at the origin's plane */
            if (CHECK(case_of(&k, &c)) && agrees(&c))
                continue;
            family_report(&c);
        }
    }
}

/* t is rounded to the largest double, which is the end of the domain. */
static void a_root_beyond_the_largest_double_is_outside(void)
{
    const double o[3] = {0, 0, 0x1.2p-102}, d[3] = {0, 0, 0x1.8p-1073};
    const double p0[3] = {0, 0, 0x1.8p-49}, p1[3] = {0, 0, 1};
    cylint_shape s;
    cylint_line line;
    cylint_answer a;
    CHECK(cylint_cylinder(&s, p0, p1, 1, CYLINT_ENDS_CAPPED) == CYLINT_OK);
    CHECK(cylint_ray(&line, o, d) == CYLINT_OK);
    CHECK(cylint_intersect(&s, &line, CYLINT_WANT_T, &a) == 2 &&
          a.hit[0].t == DBL_MAX);
    CHECK(cylint_span(&line, o, d, 0, DBL_MAX) == CYLINT_OK);
    CHECK(cylint_intersect(&s, &line, CYLINT_WANT_T, &a) == 0);
}

static void a_domain_beyond_all_numbers_holds_nothing(void)
{
    const double o[3] = {0, 0, -5}, d[3] = {0, 0, 1}, p0[3] = {0, 0, 0};
    const double at[3] = {1, -3, 0.5}, past[3] = {0, 1, 0};
    cylint_shape s;
    CHECK(cylint_cylinder(&s, p0, d, 1, CYLINT_ENDS_CAPPED) == CYLINT_OK);
    for (int sign = -1; sign <= 1; sign += 2) {
        const double end = sign * HUGE_VAL;
        cylint_line line;
        cylint_answer a;
        CHECK(cylint_span(&line, o, d, end, end) == CYLINT_OK);
        CHECK(cylint_intersect(&s, &line, CYLINT_WANT_T, &a) == 0);
        CHECK(a.relation == CYLINT_RELATION_CROSS);
        /* no filter decides this one */
        CHECK(cylint_span(&line, at, past, end, end) == CYLINT_OK);
        CHECK(cylint_intersect(&s, &line, CYLINT_WANT_T, &a) == 0);
        CHECK(a.relation == CYLINT_RELATION_TOUCH);
    }
}

/* A tiny angle below 0 is the double below a whole turn. */
static void an_angle_stays_below_a_turn(void)
{
    for (int sign = -1; sign <= 1; sign += 2) {
        const double o[3] = {sign * 1e-300, -2, 0.5}, d[3] = {0, 1, 0};
        const double p0[3] = {0, 0, 0}, p1[3] = {0, 0, 1};
        cylint_shape s;
        cylint_line line;
        cylint_answer a;
        CHECK(cylint_whole_line(&line, o, d) == CYLINT_OK &&
              cylint_cylinder(&s, p0, p1, 1, CYLINT_ENDS_CAPPED) == CYLINT_OK);
        CHECK(cylint_intersect(&s, &line, CYLINT_WANT_PHI, &a) == 2);
        CHECK(sign < 0 ? a.hit[0].phi == 0x1.fffffffffffffp-1
                       : a.hit[0].phi > 0 && a.hit[0].phi < 1e-300);
    }
}

/* A narrow nappe ends at its apex, before the base where its radius grows,
 * beyond the top where it shrinks, for both directions of its axis.  It has all
 * points on the base's side of the apex. */
static void boxes_of_nappes_are_open_on_the_bases_side(void)
{
    for (int which = 0; which < 4; which++) {
        const double direction = which & 1 ? 1 : -1, grows = which & 2 ? 1 : 0;
        const double p0[3] = {0, 0, 0}, p1[3] = {0, 0, direction};
        const double apex = grows ? -direction : 2 * direction;
        double lo[3], hi[3];
        cylint_shape s;
        CHECK(cylint_cone(&s, p0, grows ? 0.5 : 1, p1, grows ? 1 : 0.5,
                          CYLINT_ENDS_NAPPE) == CYLINT_OK);
        cylint_bounds(&s, lo, hi);
        const int up = apex > 0;
        const double side = up ? hi[2] - apex : apex - lo[2];
        CHECK(side >= 0 && side <= BOX_ULPS * ulp(apex));
        CHECK(isinf(up ? lo[2] : hi[2]));
        CHECK(isinf(lo[0]) && isinf(hi[0]) && isinf(lo[1]) && isinf(hi[1]));
    }
}

/* The axis and its length exceed the largest double; the box does not. */
static void boxes_of_the_longest_axes_are_tight(void)
{
    const double most = DBL_MAX, half = DBL_MAX / 2;
    const double p0[3] = {-most, 0, 0}, p1[3] = {most, 0, 0};
    const double q0[3] = {-half, -half, 1}, q1[3] = {half, half, 1};
    double lo[3], hi[3];
    cylint_shape s;
    CHECK(cylint_cone(&s, p0, 1, p1, 3, CYLINT_ENDS_CAPPED) == CYLINT_OK);
    cylint_bounds(&s, lo, hi);
    CHECK(lo[0] == -most && hi[0] == most);
    for (int i = 1; i < 3; i++)
        CHECK(lo[i] == -3 && hi[i] == 3);
    /* across, a disc reaches r, along either coordinate r / sqrt(2) */
    CHECK(cylint_cylinder(&s, q0, q1, 0x1p1000, CYLINT_ENDS_CAPPED) ==
          CYLINT_OK);
    cylint_bounds(&s, lo, hi);
    for (int i = 0; i < 2; i++) {
        const double reach = half + 0x1p1000 * sqrt(0.5);
        CHECK(hi[i] >= reach && hi[i] - reach <= BOX_ULPS * ulp(reach));
        CHECK(lo[i] == -hi[i]);
    }
    CHECK(lo[2] <= 1 - 0x1p1000 && hi[2] >= 1 + 0x1p1000);
    CHECK(hi[2] - 0x1p1000 <= BOX_ULPS * ulp(0x1p1000));
}

/* Sizes at both ends of the range: one box was too small, one infinite, one
 * NaN. */
static void boxes_of_the_least_and_largest_sections_are_tight(void)
{
    const double c[3] = {0, 0, 0}, x[3] = {1, 0, 0}, y[3] = {0, 1, 0},
                 z[3] = {0, 0, 1};
    const double least[3] = {0x3p-1074, 0, 0}, large[3] = {0, 0, -0x1.9p1018};
    const double p0[3] = {-0x1.8p1023, 0, 0};
    const double p1[3] = {-0x1.8p1023 + 0x1p1000, 0x1p1000, 0};
    double lo[3], hi[3];
    cylint_shape s;
    CHECK(cylint_elliptic_cone(&s, c, y, least, z, 0x1.8p133,
                               CYLINT_ENDS_CAPPED) == CYLINT_OK);
    cylint_bounds(&s, lo, hi);
    CHECK(hi[0] >= 0x4.8p-941 && hi[0] - 0x4.8p-941 <= BOX_ULPS * ulp(hi[0]));
    CHECK(lo[0] == -hi[0]);
    CHECK(cylint_elliptic_cylinder(&s, c, x, large, y, CYLINT_ENDS_CAPPED) ==
          CYLINT_OK);
    cylint_bounds(&s, lo, hi);
    CHECK(hi[2] == 0x1.9p1018 && lo[2] == -0x1.9p1018);
    CHECK(cylint_cylinder(&s, p0, p1, 0x1.8p1023, CYLINT_ENDS_CAPPED) ==
          CYLINT_OK);
    cylint_bounds(&s, lo, hi);
    const double right = p1[0] + 0x1.8p1023 * sqrt(0.5);
    CHECK(isinf(lo[0]) && hi[0] >= right &&
          hi[0] - right <= BOX_ULPS * ulp(right));
}

/* A whole cylinder is unbounded along its axis only. */
static void boxes_of_whole_cylinders_are_bounded_across(void)
{
    for (int ends = CYLINT_ENDS_INFINITE; ends <= CYLINT_ENDS_NAPPE; ends++) {
        const double c[3] = {4, 5, 6}, top[3] = {4, 5, 9};
        const double a[3] = {2, 0, 0}, b[3] = {0, 3, 0}, h[3] = {0, 0, 1};
        double lo[3], hi[3];
        cylint_shape s;
        cylint_cylinder(&s, c, top, 2, (cylint_ends)ends);
        cylint_bounds(&s, lo, hi);
        CHECK(lo[0] == 2 && hi[0] == 6 && lo[1] == 3 && hi[1] == 7);
        CHECK(isinf(lo[2]) && isinf(hi[2]));
        cylint_elliptic_cylinder(&s, c, a, b, h, (cylint_ends)ends);
        cylint_bounds(&s, lo, hi);
        CHECK(lo[0] == 2 && hi[0] == 6 && lo[1] == 2 && hi[1] == 8);
        CHECK(isinf(lo[2]) && isinf(hi[2]));
    }
}

int main(void)
{
    RUN(boxes_of_whole_cylinders_are_bounded_across);
    RUN(a_root_beyond_the_largest_double_is_outside);
    RUN(a_domain_beyond_all_numbers_holds_nothing);
    RUN(boxes_of_the_longest_axes_are_tight);
    RUN(boxes_of_the_least_and_largest_sections_are_tight);
    RUN(a_grazing_line_from_afar_finds_its_point);
    RUN(an_angle_stays_below_a_turn);
    RUN(the_oracle_has_both_doubles_beside_a_middle);
    RUN(boxes_of_nappes_are_open_on_the_bases_side);
    RUN(every_special_case_agrees_with_the_oracle);
    return check_end();
}

#else

#include "program.h"

int main(void)
{
    return check_skip("no MPFR: no oracle to compare with (make deps)");
}

#endif
