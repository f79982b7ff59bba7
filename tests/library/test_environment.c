/*
 * test_environment.c - floors shape and intersect: answers do not depend on the
 * floating-point environment
 *
 * Shapes are made and questions answered in the default environment and in
 * another one: rounding upward, downward or toward zero, subnormal results
 * flushed to zero, subnormal operands treated as zero.  Relation, number, every
 * bit of all members of hits, and the statuses of the constructors must agree,
 * whatever members are wanted.  CYLINT_CASES is the number of cases of each
 * family, CYLINT_SEED changes all cases, CYLINT_FAMILY=n tests one family.
 */
#include <math.h>
#include <string.h>

#include "check.h"
#include "cylint.h"
#include "environment.h"
#include "families.h"
#include "shapes/shape_facts.h"

enum { CASES = 400 };

/* ------------------------------------------------------------- answers -- */

/* The differences that constructors compute: axis, dr and d, high and low
 * parts. */
enum { DIFFERENCES = 14 };

/* All values that must agree. */
struct answers {
    int line_status, shape_status, kind, left_handed;
    double made[DIFFERENCES];
    cylint_answer all;
    int occluded, contains;
    int agree; /* the answers with other members wanted, and `all` */
};

static int same_bits(double x, double y)
{
    return memcmp(&x, &y, sizeof x) == 0;
}

/* Hits are compared by members, because a struct has padding. */
static int same_members(const cylint_hit *x, const cylint_hit *y, unsigned want)
{
    return (!(want & CYLINT_WANT_T) || same_bits(x->t, y->t)) &&
           (!(want & CYLINT_WANT_PART) ||
            (x->part == y->part && x->side == y->side)) &&
           (!(want & CYLINT_WANT_POINT) ||
            memcmp(x->point, y->point, sizeof x->point) == 0) &&
           (!(want & CYLINT_WANT_NORMAL) ||
            memcmp(x->normal, y->normal, sizeof x->normal) == 0) &&
           (!(want & CYLINT_WANT_Z) || same_bits(x->z, y->z)) &&
           (!(want & CYLINT_WANT_PHI) || same_bits(x->phi, y->phi));
}

static const char *difference(const struct answers *x, const struct answers *y)
{
    if (x->line_status != y->line_status ||
        x->shape_status != y->shape_status) {
        return "status";
    }
    if (x->kind != y->kind || x->left_handed != y->left_handed) {
        return "kind of shape";
    }
    for (int i = 0; i < DIFFERENCES; i++) {
        if (x->made[i] != y->made[i]) {
            return "axis, dr or d";
        }
    }
    if (x->all.relation != y->all.relation) {
        return "relation";
    }
    if (x->all.n != y->all.n || x->all.flags != y->all.flags) {
        return "number of hits";
    }
    for (int i = 0; i < x->all.n; i++) {
        const cylint_hit *a = &x->all.hit[i], *b = &y->all.hit[i];
        if (a->part != b->part || a->side != b->side) {
            return "part or side";
        }
        if (!same_bits(a->t, b->t)) {
            return "t";
        }
        if (!same_members(a, b, CYLINT_WANT_ALL)) {
            return "point, normal, z or phi";
        }
    }
    return x->occluded != y->occluded   ? "any hit"
           : x->contains != y->contains ? "contains"
           : !x->agree || !y->agree     ? "an answer with other members wanted"
                                        : NULL;
}

/* Whether the answers with fewer members wanted are parts of `all`. */
static int others_agree(const struct family_case *c, const cylint_answer *all)
{
    static const unsigned wants[] = {CYLINT_WANT_COUNT,
                                     CYLINT_WANT_T,
                                     CYLINT_WANT_PART,
                                     CYLINT_WANT_POINT,
                                     CYLINT_WANT_NORMAL,
                                     CYLINT_WANT_Z,
                                     CYLINT_WANT_PHI,
                                     CYLINT_WANT_NEAREST,
                                     CYLINT_WANT_NEAREST | CYLINT_WANT_T,
                                     CYLINT_WANT_NEAREST | CYLINT_WANT_PART,
                                     CYLINT_WANT_NEAREST | CYLINT_WANT_ALL};
    int agree = 1;
    for (size_t k = 0; k < sizeof wants / sizeof *wants; k++) {
        const unsigned want = wants[k];
        cylint_answer a;
        cylint_intersect(&c->shape, &c->line, want, &a);
        agree &= a.relation == all->relation && a.flags == all->flags &&
                 a.n == (want & CYLINT_WANT_NEAREST ? all->n > 0 : all->n);
        for (int i = 0; i < a.n && agree; i++) {
            agree &= same_members(&a.hit[i], &all->hit[i], want);
        }
    }
    return agree;
}

static void compute_answers(const struct family_case *c, struct answers *to)
{
    memset(to, 0, sizeof *to);
    to->line_status = (int)c->line_status;
    to->shape_status = (int)c->shape_status;
    to->kind = c->shape.kind;
    to->left_handed = cylint_left_handed(&c->shape);
    for (int i = 0; i < 3; i++) {
        to->made[i] = cylint_axis(&c->shape)[i];
        to->made[i + 3] = cylint_axis_pair(&c->shape, i).lo;
        to->made[i + 6] = c->line.d[i];
        to->made[i + 9] = c->line.d_lo[i];
    }
    to->made[12] = cylint_radius_growth(&c->shape).hi;
    to->made[13] = cylint_radius_growth(&c->shape).lo;
    cylint_intersect(&c->shape, &c->line, CYLINT_WANT_ALL, &to->all);
    to->occluded = cylint_occluded(&c->shape, &c->line);
    to->contains = cylint_contains(&c->shape, c->line_data);
    to->agree = others_agree(c, &to->all) && to->occluded == (to->all.n > 0);
}

static void report(const struct family_case *c, const char *what,
                   const char *where, const struct answers *got,
                   const struct answers *want)
{
    if (check_bad > CHECK_SHOWN) {
        return;
    }
    fprintf(stderr, "# %s differs, %s\n", what, where);
    family_print(stderr, c);
    fprintf(stderr,
            "\n#   got  relation %d n %d t %a %a\n"
            "#   want relation %d n %d t %a %a\n",
            got->all.relation, got->all.n, got->all.hit[0].t, got->all.hit[1].t,
            want->all.relation, want->all.n, want->all.hit[0].t,
            want->all.hit[1].t);
}

/* Makes the case in the default or the other environment and answers it in the
 * default or the other one, in three combinations. */
static void compare(struct family_case *c, struct environment there)
{
    static const char *const where[] = {
        "answered there", "made and answered there", "made there"};
    struct answers want, got[3];
    family_make(c);
    compute_answers(c, &want);
    environment_set(there);
    compute_answers(c, &got[0]);
    family_make(c);
    compute_answers(c, &got[1]);
    environment_reset();
    compute_answers(c, &got[2]);
    for (int i = 0; i < 3; i++) {
        const char *what = difference(&got[i], &want);
        if (!CHECK(what == NULL)) {
            report(c, what, where[i], &got[i], &want);
            return;
        }
    }
}

/* ------------------------------------------------------------ families -- */

static void every_family(struct environment there)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES);
    const uint64_t only = check_setting("CYLINT_FAMILY", UINT64_MAX);
    for (int family = 0; family < family_count(); family++) {
        if (only != UINT64_MAX && only != (uint64_t)family) {
            continue;
        }
        const int bad = check_bad;
        for (uint64_t i = 0; i < cases; i++) {
            struct family_case c;
            family_case(check_setting("CYLINT_SEED", 1), family, i, &c);
            compare(&c, there);
        }
        if (check_bad > bad) {
            REPORT("%d of %llu of family %d, %s", check_bad - bad,
                   (unsigned long long)cases, family, family_name(family));
        }
    }
}

/* -------------------------------------------- cases of no other family --- */

/* Frusta whose radii differ by a subnormal number and whose axes are subnormal;
 * radii and axes of one subnormal unit. */
static void subnormal_differences(struct environment there)
{
    static const double size[] = {0x1p-1022, 0x1.8p-1021, 0x1p-1000, 0x1p-1060,
                                  0x1p-1074};
    for (int i = 0; i < 5; i++) {
        for (int ends = CYLINT_ENDS_CAPPED; ends <= CYLINT_ENDS_NAPPE; ends++) {
            const double x = size[i], s = 0x1p-1074;
            const double line[] = {0, x, -3 * x, x, -x, 4 * x};
            const double cone[] = {0, 0, x, x, 0, s, 4 * x, x + 2 * s};
            const double rod[] = {x, x, x, x, x, x + s, x};
            struct family_case c =
                family_of(FAMILY_LINE, line, FAMILY_CONE, cone);
            c.ends = (cylint_ends)ends;
            compare(&c, there);
            c = family_of(FAMILY_SEGMENT, line, FAMILY_CYLINDER, rod);
            c.ends = (cylint_ends)ends;
            compare(&c, there);
        }
    }
}

/* A shape with a tiny radius far from the origin, or with a subnormal offset
 * among other tiny numbers: it must not be lost before scaling. */
static void subnormal_offsets(struct environment there)
{
    for (int e = 0; e < 70; e++) {
        const double x = ldexp(1, -1005), y = ldexp(1, -1074 + e);
        const double line[] = {x + y, y, -3 * x, y, 0x1p-1074, x};
        const double rod[] = {y, 0x1p-1074, 0, 0, 0x1p-1074, x, x + y};
        struct family_case c =
            family_of(FAMILY_LINE, line, FAMILY_CYLINDER, rod);
        compare(&c, there);
        c.ends = CYLINT_ENDS_INFINITE;
        compare(&c, there);
    }
}

/* Domains whose ends, or hits whose t, are subnormal. */
static void subnormal_domains(struct environment there)
{
    const double s = 0x1p-1074;
    const double rod[] = {0, 0, 0, 0, 0, 3 * s, 1};
    for (int from = -4; from <= 4; from++) {
        for (int to = -4; to <= 4; to++) {
            const double line[] = {0, 0, 0, 0, 0, 1, from * s, to * s};
            struct family_case c =
                family_of(FAMILY_SPAN, line, FAMILY_CYLINDER, rod);
            compare(&c, there);
        }
    }
    const double huge_step[] = {1, 0, -3, 0, 0, 0x1p1023};
    const double unit[] = {0, 0, 0, 0, 0, 1, 1};
    struct family_case c =
        family_of(FAMILY_RAY, huge_step, FAMILY_CYLINDER, unit);
    compare(&c, there);
}

/* Squares of the distance overflow, to infinity or to the largest double. */
static void squares_that_overflow(struct environment there)
{
    const double rod[] = {2, 2, -1, 1, 0, 1, 3};
    const double cone[] = {-3, 0, 2, 2, 1, -3, 2, 1};
    for (int e = 60; e < 1020; e++) {
        const double back[] = {3, ldexp(0x1.f39b9148p0, e), -1, 0, 1, 0};
        const double past[] = {ldexp(1, e), 3, 0, -2, -1, 2};
        struct family_case c =
            family_of(FAMILY_LINE, back, FAMILY_CYLINDER, rod);
        compare(&c, there);
        c = family_of(FAMILY_LINE, past, FAMILY_CONE, cone);
        c.ends = CYLINT_ENDS_INFINITE;
        compare(&c, there);
    }
}

/* The tangent of an angle is rounded to nearest, also if it is subnormal. */
static void angles(struct environment there)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES);
    const double v[] = {0, 0, 0}, u[] = {0, 0, 1};
    for (uint64_t i = 0; i < 10 * cases; i++) {
        const double part = (double)(i + 1) / (double)(10 * cases + 1);
        const double angle = i % 3 == 0   ? 90 * part
                             : i % 3 == 1 ? 90 - part * 0x1p-20
                                          : ldexp(part, -1 - (int)(i % 1070));
        cylint_shape want, got;
        const cylint_status status =
            cylint_angle_cone(&want, v, u, angle, CYLINT_ENDS_CAPPED);
        environment_set(there);
        const cylint_status other =
            cylint_angle_cone(&got, v, u, angle, CYLINT_ENDS_CAPPED);
        environment_reset();
        if (!CHECK(status == other &&
                   same_bits(cylint_r1(&want), cylint_r1(&got)))) {
            REPORT("acone 0 0 0  0 0 1  %a: got %a, want %a", angle,
                   cylint_r1(&got), cylint_r1(&want));
        }
    }
}

/* Signs that doubles cannot decide: of B for lines parallel to a ruling, and of
 * u.w at an apex, which decides the normal. */
static void signs_by_more_than_doubles(struct environment there)
{
    const double beside[] = {0x1.0000000000001p0, 0, 1, 1, 0, 1};
    const double across[] = {0, 0, 0, 1, -0x1.fffffffffffffp-1, 0};
    const double upright[] = {0, 0, 0, 0, 0, 1, 45};
    const double leaning[] = {0, 0, 0, 1, 1, 0, 45};
    struct family_case c =
        family_of(FAMILY_LINE, beside, FAMILY_ACONE, upright);
    c.ends = CYLINT_ENDS_INFINITE;
    compare(&c, there);
    c = family_of(FAMILY_LINE, across, FAMILY_ACONE, leaning);
    c.ends = CYLINT_ENDS_INFINITE;
    compare(&c, there);
    cylint_answer a;
    environment_set(there);
    cylint_intersect(&c.shape, &c.line, CYLINT_WANT_NORMAL, &a);
    environment_reset();
    CHECK(a.n == 1 && a.hit[0].normal[0] < 0 && a.hit[0].normal[1] < 0);
}

enum { ROW = 40 };

/* A batch's answer; NaN and -1 for no hit. */
struct batch_answers {
    double t[2][ROW];
    signed char relation[ROW], n[ROW], part[2][ROW];
    size_t nearest, count;
    double member[8][ROW];                     /* of the first hits */
    double first, point[3], normal[3], z, phi; /* of the nearest */
};

static void query_batches(const cylint_pack *pack, const cylint_lines *lines,
                          const cylint_line *line, struct batch_answers to[2])
{
    memset(to, 0, 2 * sizeof *to);
    for (int i = 0; i < 2; i++) {
        double(*m)[ROW] = to[i].member;
        const cylint_columns columns = {.relation = to[i].relation,
                                        .n = to[i].n,
                                        .t0 = to[i].t[0],
                                        .t1 = to[i].t[1],
                                        .part0 = to[i].part[0],
                                        .part1 = to[i].part[1],
                                        .point0 = {m[0], m[1], m[2]},
                                        .normal0 = {m[3], m[4], m[5]},
                                        .z0 = m[6],
                                        .phi0 = m[7]};
        if (i == 0)
            cylint_intersect_shapes(pack, line, &columns);
        else
            cylint_intersect_lines(&pack->shapes[0], lines, &columns);
    }
    cylint_hit hit = {0};
    to->nearest = cylint_nearest(pack, line, CYLINT_WANT_ALL, &hit);
    to->first = hit.t;
    memcpy(to->point, hit.point, sizeof hit.point);
    memcpy(to->normal, hit.normal, sizeof hit.normal);
    to->z = hit.z;
    to->phi = hit.phi;
    to->count = cylint_count(pack, line, 0);
}

static void batches(struct environment there)
{
    for (int family = 0; family < family_count(); family++) {
        static double memory[ROW * 64], column[6][ROW];
        cylint_shape shapes[ROW];
        cylint_pack pack;
        struct family_case c;
        struct batch_answers want[2], got[2];
        cylint_lines lines = {ROW,
                              {column[0], column[1], column[2]},
                              {column[3], column[4], column[5]},
                              NULL,
                              NULL};
        for (int i = ROW - 1; i >= 0; i--) { /* c keeps the first */
            family_case(check_setting("CYLINT_SEED", 1), family, (uint64_t)i,
                        &c);
            shapes[i] = c.shape;
            for (int k = 0; k < 3; k++) {
                column[k][i] = c.line.o[k];
                column[3 + k][i] = c.line.d[k];
            }
        }
        if (!CHECK(cylint_pack_bytes(ROW) <= sizeof memory))
            return;
        cylint_pack_shapes(&pack, memory, shapes, ROW);
        query_batches(&pack, &lines, &c.line, want);
        environment_set(there);
        query_batches(&pack, &lines, &c.line, got);
        environment_reset();
        if (!CHECK(memcmp(got, want, sizeof got) == 0))
            REPORT("family %s", family_name(family));
    }
}

static void compare_all(int rounding, int tiny)
{
    const struct environment there = {rounding, tiny};
    if (!can_treat_subnormals(tiny)) {
        return;
    }
    every_family(there);
    subnormal_differences(there);
    subnormal_offsets(there);
    subnormal_domains(there);
    squares_that_overflow(there);
    angles(there);
    signs_by_more_than_doubles(there);
    batches(there);
}

/* --------------------------------------------------------------- tests -- */

static void answers_are_the_same_rounding_upward(void)
{
    compare_all(FE_UPWARD, 0);
}

static void answers_are_the_same_rounding_downward(void)
{
    compare_all(FE_DOWNWARD, 0);
}

static void answers_are_the_same_rounding_toward_zero(void)
{
    compare_all(FE_TOWARDZERO, 0);
}

static void answers_are_the_same_flushing_results(void)
{
    compare_all(FE_TONEAREST, FLUSH);
}

static void answers_are_the_same_with_operands_as_zero(void)
{
    compare_all(FE_TONEAREST, ZERO);
}

static void answers_are_the_same_doing_both(void)
{
    compare_all(FE_TONEAREST, FLUSH | ZERO);
}

static void answers_are_the_same_doing_all_at_once(void)
{
    compare_all(FE_UPWARD, FLUSH | ZERO);
    compare_all(FE_TOWARDZERO, FLUSH | ZERO);
}

static void the_selftest_finds_nothing_in_the_default_environment(void)
{
    if (!CHECK(cylint_selftest() == 0)) {
        REPORT("cylint_selftest() is %d", cylint_selftest());
    }
}

static void the_selftest_detects_each_environment(void)
{
    static const int directed[] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    for (int tiny = 0; tiny <= (FLUSH | ZERO); tiny++) {
        for (int i = -1; i < 3 && can_treat_subnormals(tiny); i++) {
            const struct environment there = {
                i < 0 ? FE_TONEAREST : directed[i], tiny};
            const int want = (i < 0 ? 0 : CYLINT_SELFTEST_DIRECTED) |
                             (tiny & FLUSH ? CYLINT_SELFTEST_FLUSHED : 0) |
                             (tiny & ZERO ? CYLINT_SELFTEST_ZEROED : 0);
            environment_set(there);
            const int found = cylint_selftest();
            environment_reset();
            if (!CHECK(found == want)) {
                REPORT("found %d, not %d", found, want);
            }
        }
    }
}

/* Called in another environment, the library does not change it. */
static void no_function_changes_the_environment(void)
{
    const struct environment odd = {
        FE_DOWNWARD, can_treat_subnormals(FLUSH | ZERO) ? FLUSH | ZERO : 0};
    for (int family = 0; family < family_count(); family++) {
        struct family_case c;
        struct answers answers;
        double lo[3], hi[3];
        family_case(1, family, 0, &c);
        environment_set(odd);
        const int before = cylint_selftest();
        family_make(&c);
        compute_answers(&c, &answers);
        cylint_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &answers.all);
        cylint_bounds(&c.shape, lo, hi);
        const int after = cylint_selftest(), rounding = fegetround();
        environment_reset();
        CHECK(before == after && rounding == FE_DOWNWARD);
    }
}

int main(void)
{
    if (family_count() == 0) {
        return check_skip("no GSL: no families to draw from (make deps)");
    }
    if (!can_treat_subnormals(FLUSH | ZERO)) {
        puts("note: this processor cannot flush subnormals");
    }
    RUN(the_selftest_finds_nothing_in_the_default_environment);
    RUN(the_selftest_detects_each_environment);
    RUN(no_function_changes_the_environment);
    RUN(answers_are_the_same_flushing_results);
    RUN(answers_are_the_same_with_operands_as_zero);
    RUN(answers_are_the_same_doing_both);
    RUN(answers_are_the_same_rounding_upward);
    RUN(answers_are_the_same_rounding_downward);
    RUN(answers_are_the_same_rounding_toward_zero);
    RUN(answers_are_the_same_doing_all_at_once);
    return check_end();
}
