/*
 * test_properties.c - floor intersect: properties of answers, without an oracle
 *
 * The library is compared with itself on changed input whose answer changes in
 * a known manner.  CYLINT_CASES is the number of cases of each family.
 */
#include <float.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "check.h"
#include "cylint.h"
#include "families.h"
#include "shapes/layout.h"

enum { CASES = 500 };

static cylint_answer intersect(const struct family_case *c)
{
    cylint_answer a;
    memset(&a, 0, sizeof a);
    cylint_intersect(&c->shape, &c->line, CYLINT_WANT_ALL, &a);
    return a;
}

/* Compares relation, n, t, part and side. */
static int same(const cylint_answer *x, const cylint_answer *y)
{
    int equal =
        x->relation == y->relation && x->n == y->n && x->flags == y->flags;
    for (int i = 0; i < x->n && equal; i++) {
        equal = x->hit[i].t == y->hit[i].t &&
                x->hit[i].part == y->hit[i].part &&
                x->hit[i].side == y->hit[i].side;
    }
    return equal;
}

typedef void property(const struct family_case *c);

/* Tests the property on CASES cases of each family. */
static void over_all_families(property *holds)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES);
    for (int family = 0; family < family_count(); family++) {
        for (uint64_t i = 0; i < cases; i++) {
            struct family_case c;
            family_case(3, family, i, &c);
            holds(&c);
        }
    }
}

/* -------------------------------------------------------------- parity -- */

static int wholly_finite(const cylint_answer *a)
{
    return a->n == 0 || (isfinite(a->hit[0].t) && isfinite(a->hit[1].t));
}

static void parity(const struct family_case *given)
{
    struct family_case c = *given;
    c.ends = CYLINT_ENDS_CAPPED;
    c.line_word = c.line_word == FAMILY_SEGMENT ? FAMILY_SEGMENT : FAMILY_LINE;
    family_make(&c);
    c.line.tmin = -HUGE_VAL;
    c.line.tmax = HUGE_VAL;
    const cylint_answer a = intersect(&c);
    const int due = a.relation == CYLINT_RELATION_MISS    ? 0
                    : a.relation == CYLINT_RELATION_TOUCH ? 1
                                                          : 2;
    int good = a.n == due;
    if (due == 1) {
        good = good && a.hit[0].side == CYLINT_SIDE_BOTH;
    } else if (due == 2) {
        good = good && a.hit[0].side == CYLINT_SIDE_ENTERING &&
               a.hit[1].side == CYLINT_SIDE_LEAVING && a.hit[0].t <= a.hit[1].t;
    }
    if (!CHECK(good)) {
        REPORT_CASE(&c);
    }
}

static void a_capped_shape_has_an_even_number_of_hits(void)
{
    over_all_families(parity);
}

/* ------------------------------------------------- changes of the line -- */

static int turned(int side)
{
    return side == CYLINT_SIDE_ENTERING  ? CYLINT_SIDE_LEAVING
           : side == CYLINT_SIDE_LEAVING ? CYLINT_SIDE_ENTERING
                                         : side;
}

/* d becomes -d: t becomes -t. */
static void reversed(const struct family_case *given)
{
    struct family_case c = *given;
    if (c.line_word == FAMILY_SEGMENT) {
        return;
    }
    const cylint_answer a = intersect(given);
    for (int i = 3; i < 6; i++) {
        c.line_data[i] = -c.line_data[i];
    }
    family_make(&c);
    c.line.tmin = -given->line.tmax;
    c.line.tmax = -given->line.tmin;
    const cylint_answer b = intersect(&c);
    int good = a.relation == b.relation && a.n == b.n;
    for (int i = 0; i < a.n && good; i++) {
        const cylint_hit *x = &a.hit[i], *y = &b.hit[a.n - 1 - i];
        good =
            x->t == -y->t && x->part == y->part && x->side == turned(y->side);
    }
    if (!CHECK(good)) {
        REPORT_CASE(given);
    }
}

static void a_reversed_line_has_hits_at_minus_t(void)
{
    over_all_families(reversed);
}

/* A segment's relation and parts do not depend on its order. */
static void segment_reversed(const struct family_case *given)
{
    struct family_case c = *given;
    if (c.line_word != FAMILY_SEGMENT) {
        return;
    }
    memcpy(c.line_data, given->line_data + 3, 3 * sizeof(double));
    memcpy(c.line_data + 3, given->line_data, 3 * sizeof(double));
    family_make(&c);
    const cylint_answer a = intersect(given), b = intersect(&c);
    int good = a.relation == b.relation && a.n == b.n;
    for (int i = 0; i < a.n && good; i++) {
        const cylint_hit *x = &a.hit[i], *y = &b.hit[a.n - 1 - i];
        good = fabs(x->t - (1 - y->t)) <= DBL_EPSILON && x->part == y->part &&
               x->side == turned(y->side);
    }
    if (!CHECK(good)) {
        REPORT_CASE(given);
    }
}

static void a_reversed_segment_has_hits_at_1_minus_t(void)
{
    over_all_families(segment_reversed);
}

/* The hits are those of the whole line that lie in the domain.  Where t rounds
 * to an end of the domain the exact root decides; only the oracle tests
 * that. */
static void clipped(const struct family_case *given)
{
    struct family_case c = *given;
    const double tmin = c.line.tmin, tmax = c.line.tmax;
    c.line.tmin = -HUGE_VAL;
    c.line.tmax = HUGE_VAL;
    const cylint_answer all = intersect(&c), some = intersect(given);
    int n = 0, good = all.relation == some.relation;
    for (int i = 0; i < all.n; i++) {
        const double t = all.hit[i].t;
        if (t == tmin || t == tmax) {
            return;
        }
        if (tmin <= t && t <= tmax) {
            good = good && n < some.n && some.hit[n].t == t &&
                   some.hit[n].part == all.hit[i].part &&
                   some.hit[n].side == all.hit[i].side;
            n++;
        }
    }
    if (!CHECK(good && n == some.n)) {
        REPORT_CASE(given);
    }
}

static void hits_in_a_domain_are_the_lines_hits_within_it(void)
{
    over_all_families(clipped);
}

/* ---------------------------------------------- changes of the whole -- */

static int is_elliptic(family_shape word)
{
    return word == FAMILY_ECYLINDER || word == FAMILY_ECONE;
}

/* The index of each vector in a shape's record, up to four. */
static int vectors(family_shape word, int at[4])
{
    static const int where[][4] = {{0, 3},       {0, 4}, {0, 3}, {0, 3, 6, 9},
                                   {0, 3, 6, 9}, {0},    {0, 3}, {0, 4}};
    memcpy(at, where[word], sizeof where[word]);
    return is_elliptic(word) ? 4 : word == FAMILY_SPHERE ? 1 : 2;
}

/* Rotates the coordinates, (x, y, z) to (z, x, y), `round` times, and changes
 * the signs of x and y by the bits of `flip`. */
static void turn3(double v[3], int round, int flip)
{
    const double x[3] = {v[0], v[1], v[2]};
    for (int i = 0; i < 3; i++) {
        v[(i + round) % 3] = flip >> i & 1 ? -x[i] : x[i];
    }
}

static void moved(const struct family_case *given, int round, int flip)
{
    struct family_case c = *given;
    int at[4];
    const int n = vectors(c.shape_word, at);
    for (int i = 0; i < n; i++) {
        turn3(c.shape_data + at[i], round, flip);
    }
    turn3(c.line_data, round, flip);
    turn3(c.line_data + 3, round, flip);
    family_make(&c);
    const cylint_answer a = intersect(given), b = intersect(&c);
    if (!CHECK(same(&a, &b))) {
        REPORT_CASE(given);
    }
}

static void permuted(const struct family_case *c)
{
    moved(c, 1, 0);
    moved(c, 2, 0);
}

static void coordinates_may_be_permuted(void)
{
    over_all_families(permuted);
}

static void mirrored(const struct family_case *c)
{
    moved(c, 0, 1);
    moved(c, 0, 6);
    moved(c, 1, 4);
}

static void coordinates_may_change_sign(void)
{
    over_all_families(mirrored);
}

/* Multiplies by 2^e; returns whether that is exact. */
static int scale_exactly(double *x, int n, int e)
{
    for (int i = 0; i < n; i++) {
        const double y = ldexp(x[i], e);
        if (!isfinite(y) || ldexp(y, -e) != x[i]) {
            return 0;
        }
        x[i] = y;
    }
    return 1;
}

/* All lengths times 2^e and d times 2^f give t times 2^(e - f). */
static void scaled_by(const struct family_case *given, int e, int f)
{
    struct family_case c = *given;
    const int factor =
        c.shape_word == FAMILY_ACONE || c.shape_word == FAMILY_ECONE;
    const int segment = c.line_word == FAMILY_SEGMENT;
    if (!scale_exactly(c.shape_data, family_shape_size(c.shape_word) - factor,
                       e) ||
        !scale_exactly(c.line_data, 3, e) ||
        !scale_exactly(c.line_data + 3, 3, segment ? e : f)) {
        return;
    }
    family_make(&c);
    struct family_case whole = *given;
    if (!segment) {
        whole.line.tmin = c.line.tmin = -HUGE_VAL;
        whole.line.tmax = c.line.tmax = HUGE_VAL;
    }
    const cylint_answer a = intersect(&whole), b = intersect(&c);
    int good = a.relation == b.relation && a.n == b.n;
    for (int i = 0; i < a.n && good; i++) {
        const double t = a.hit[i].t, s = ldexp(t, segment ? 0 : e - f);
        const int rounds = !isfinite(s) || !isfinite(t) || fabs(s) < DBL_MIN ||
                           fabs(t) < DBL_MIN;
        good = (rounds || s == b.hit[i].t) && a.hit[i].part == b.hit[i].part &&
               a.hit[i].side == b.hit[i].side;
    }
    if (!CHECK(good)) {
        REPORT("lengths times 2^%d, d times 2^%d", e, f);
        REPORT_CASE(given);
    }
}

static void powers_of_two(const struct family_case *c)
{
    scaled_by(c, 1, 1);
    scaled_by(c, -7, 3);
    scaled_by(c, 300, -200);
    scaled_by(c, -500, 500);
    scaled_by(c, 900, 0);
}

static void scaling_by_powers_of_two_keeps_the_digits_of_t(void)
{
    over_all_families(powers_of_two);
}

/* ------------------------------------------------ changes of the shape -- */

static int other_cap(int part)
{
    return part == CYLINT_PART_CAP0   ? CYLINT_PART_CAP1
           : part == CYLINT_PART_CAP1 ? CYLINT_PART_CAP0
                                      : part;
}

static cylint_ends other_ends(cylint_ends ends)
{
    return ends == CYLINT_ENDS_CAP0   ? CYLINT_ENDS_CAP1
           : ends == CYLINT_ENDS_CAP1 ? CYLINT_ENDS_CAP0
                                      : ends;
}

/* Exchanging p0, r0 with p1, r1 exchanges cap 0 with cap 1. */
static void swapped(const struct family_case *given)
{
    struct family_case c = *given;
    const family_shape word = c.shape_word;
    const int n = word == FAMILY_CONE || word == FAMILY_RCONE ? 4 : 3;
    const int equal = /* equal balls: always cap 0 */
        memcmp(cylint_base(&c.shape), cylint_top(&c.shape),
               3 * sizeof(double)) == 0;
    if (word == FAMILY_ACONE || is_elliptic(word) || word == FAMILY_SPHERE ||
        equal) {
        return;
    }
    memcpy(c.shape_data, given->shape_data + n, (size_t)n * sizeof(double));
    memcpy(c.shape_data + n, given->shape_data, (size_t)n * sizeof(double));
    c.ends = other_ends(c.ends);
    family_make(&c);
    const cylint_answer a = intersect(given);
    cylint_answer b = intersect(&c);
    for (int i = 0; i < b.n; i++) {
        b.hit[i].part = other_cap(b.hit[i].part);
    }
    if (!CHECK(same(&a, &b))) {
        REPORT_CASE(given);
    }
}

static void the_ends_may_be_swapped(void)
{
    over_all_families(swapped);
}

/* Exchanges the semi-axes of an ellipse, or changes the sign of one. */
static void axes_swapped(const struct family_case *given)
{
    struct family_case c = *given;
    if (!is_elliptic(c.shape_word)) {
        return;
    }
    const cylint_answer a = intersect(given);
    memcpy(c.shape_data + 3, given->shape_data + 6, 3 * sizeof(double));
    memcpy(c.shape_data + 6, given->shape_data + 3, 3 * sizeof(double));
    family_make(&c);
    const cylint_answer b = intersect(&c);
    if (!CHECK(same(&a, &b))) {
        REPORT_CASE(given);
    }
    turn3(c.shape_data + 6, 0, 7);
    family_make(&c);
    const cylint_answer d = intersect(&c);
    if (!CHECK(same(&a, &d))) {
        REPORT_CASE(given);
    }
}

static void an_ellipses_axes_may_be_swapped_or_reversed(void)
{
    over_all_families(axes_swapped);
}

static void equal_radii(const struct family_case *given)
{
    struct family_case c = *given;
    if (c.shape_word != FAMILY_CYLINDER) {
        return;
    }
    const double *x = given->shape_data;
    const double data[8] = {x[0], x[1], x[2], x[6], x[3], x[4], x[5], x[6]};
    memcpy(c.shape_data, data, sizeof data);
    c.shape_word = FAMILY_CONE;
    family_make(&c);
    const cylint_answer a = intersect(given), b = intersect(&c);
    if (!CHECK(same(&a, &b))) {
        REPORT_CASE(given);
    }
}

static void a_cone_with_equal_radii_is_a_cylinder(void)
{
    over_all_families(equal_radii);
}

/* An elliptic cone with k = 1 is an elliptic cylinder. */
static void factor_one(const struct family_case *given)
{
    struct family_case c = *given;
    if (c.shape_word != FAMILY_ECYLINDER) {
        return;
    }
    c.shape_word = FAMILY_ECONE;
    c.shape_data[12] = 1;
    family_make(&c);
    const cylint_answer a = intersect(given), b = intersect(&c);
    if (!CHECK(same(&a, &b))) {
        REPORT_CASE(given);
    }
}

static void an_elliptic_cone_with_k_1_is_an_elliptic_cylinder(void)
{
    over_all_families(factor_one);
}

/* Writes a shape along coordinate `up` in two forms: circular, or elliptic with
 * the semi-axes (r, 0, 0) and (0, r, 0).  k = r1 / r0 is a power of two. */
static void write_form(struct family_case *c, int form, int up, double h,
                       double r0, double r1)
{
    double *x = c->shape_data;
    double p[3];
    memcpy(p, x, sizeof p);
    memset(x, 0, sizeof c->shape_data);
    memcpy(x, p, sizeof p);
    if (form == 0) {
        c->shape_word = FAMILY_CONE;
        x[3] = r0;
        memcpy(x + 4, p, sizeof p);
        x[4 + up] += h;
        x[7] = r1;
    } else {
        c->shape_word = FAMILY_ECONE;
        x[3 + (up + 1) % 3] = r0;
        x[6 + (up + 2) % 3] = r0;
        x[9 + up] = h;
        x[12] = r1 / r0;
    }
    family_make(c);
}

static void circular_as_elliptic(const struct family_case *given)
{
    static const double factors[] = {0, 0.5, 1, 2};
    struct family_case c = *given;
    for (int i = 0; i < 3; i++) { /* p1 - p0 is h exactly */
        c.shape_data[i] = floor(fmod(c.shape_data[i], 64));
    }
    for (int k = 0; k < 4; k++) {
        struct family_case e = c;
        write_form(&c, 0, k % 3, 2, 1.25, 1.25 * factors[k]);
        write_form(&e, 1, k % 3, 2, 1.25, 1.25 * factors[k]);
        const cylint_answer a = intersect(&c), b = intersect(&e);
        if (!CHECK(same(&a, &b))) {
            REPORT_CASE(&c);
        }
    }
}

static void a_circular_shape_is_an_elliptic_one_with_equal_axes(void)
{
    over_all_families(circular_as_elliptic);
}

/* Open ends and single caps remove hits and change nothing else. */
static void fewer_caps(const struct family_case *given)
{
    struct family_case c = *given, capped = *given;
    if (c.shape_word == FAMILY_SPHERE) {
        return; /* it has no other ends */
    }
    capped.ends = CYLINT_ENDS_CAPPED;
    family_make(&capped);
    const cylint_answer all = intersect(&capped);
    for (int ends = CYLINT_ENDS_OPEN; ends <= CYLINT_ENDS_CAP1; ends++) {
        c.ends = (cylint_ends)ends;
        family_make(&c);
        const cylint_answer some = intersect(&c);
        int n = 0, good = some.relation == all.relation;
        for (int i = 0; i < all.n; i++) {
            const int part = all.hit[i].part;
            if (part == CYLINT_PART_LATERAL ||
                (part == CYLINT_PART_CAP0 && ends == CYLINT_ENDS_CAP0) ||
                (part == CYLINT_PART_CAP1 && ends == CYLINT_ENDS_CAP1)) {
                good = good && n < some.n && some.hit[n].t == all.hit[i].t &&
                       some.hit[n].part == part;
                n++;
            }
        }
        if (!CHECK(good && n == some.n)) {
            REPORT_CASE(&c);
        }
    }
}

static void missing_caps_only_remove_hits(void)
{
    over_all_families(fewer_caps);
}

/* -------------------------------------------------------------- wants -- */

static void occluded(const struct family_case *c)
{
    const cylint_answer a = intersect(c);
    if (!CHECK(cylint_occluded(&c->shape, &c->line) == (a.n > 0))) {
        REPORT_CASE(c);
    }
}

static void occluded_is_whether_there_is_a_hit(void)
{
    over_all_families(occluded);
}

/* The place of each member of a hit, and the want that names it. */
static const struct {
    unsigned want;
    size_t at, size;
} members[] = {
    {CYLINT_WANT_T, offsetof(cylint_hit, t), sizeof(double)},
    {CYLINT_WANT_PART, offsetof(cylint_hit, part), sizeof(int)},
    {CYLINT_WANT_PART, offsetof(cylint_hit, side), sizeof(int)},
    {CYLINT_WANT_POINT, offsetof(cylint_hit, point), 3 * sizeof(double)},
    {CYLINT_WANT_NORMAL, offsetof(cylint_hit, normal), 3 * sizeof(double)},
    {CYLINT_WANT_Z, offsetof(cylint_hit, z), sizeof(double)},
    {CYLINT_WANT_PHI, offsetof(cylint_hit, phi), sizeof(double)},
};

/* Wanted members have the bits of the full answer; the others keep their
 * bytes. */
static int as_wanted(const cylint_answer *full, const cylint_answer *some,
                     const cylint_answer *before, unsigned want)
{
    int good = some->relation == full->relation && some->flags == full->flags;
    for (int i = 0; i < 2; i++) {
        for (size_t k = 0; k < sizeof members / sizeof *members; k++) {
            const int written = (want & members[k].want) && i < some->n;
            const char *got = (const char *)&some->hit[i] + members[k].at;
            const char *due =
                (const char *)(written ? &full->hit[i] : &before->hit[i]);
            good =
                good && memcmp(got, due + members[k].at, members[k].size) == 0;
        }
    }
    return good;
}

static void masks(const struct family_case *c)
{
    const cylint_answer full = intersect(c);
    for (unsigned want = 0; want < 2 * CYLINT_WANT_NEAREST; want++) {
        cylint_answer some, before;
        memset(&before, 0x5a, sizeof before);
        some = before;
        const int n = cylint_intersect(&c->shape, &c->line, want, &some);
        const int due = want & CYLINT_WANT_NEAREST ? full.n > 0 : full.n;
        if (!CHECK(n == due && some.n == due &&
                   as_wanted(&full, &some, &before, want))) {
            REPORT("want %u", want);
            REPORT_CASE(c);
        }
    }
}

static void unwanted_members_are_not_written_and_change_nothing(void)
{
    for (int family = 0; family < family_count(); family++) {
        for (uint64_t i = 0; i < CASES / 25; i++) {
            struct family_case c;
            family_case(4, family, i, &c);
            masks(&c);
        }
    }
}

static int minus_zero(double x)
{
    return x == 0 && signbit(x);
}

static int has_minus_zero(const cylint_hit *h)
{
    return minus_zero(h->t) || minus_zero(h->z) || minus_zero(h->phi) ||
           minus_zero(h->point[0]) || minus_zero(h->point[1]) ||
           minus_zero(h->point[2]) || minus_zero(h->normal[0]) ||
           minus_zero(h->normal[1]) || minus_zero(h->normal[2]);
}

static void ascending(const struct family_case *c)
{
    const cylint_answer a = intersect(c);
    CHECK(a.n >= 0 && a.n <= 2);
    for (int i = 0; i < a.n; i++) {
        const cylint_hit *h = &a.hit[i];
        if (!CHECK(!has_minus_zero(h))) {
            REPORT_CASE(c);
        }
        if (!isfinite(h->t) || !wholly_finite(&a)) {
            continue;
        }
        if (!CHECK(h->phi >= 0 && h->phi < 1) ||
            !CHECK(h->t >= c->line.tmin && h->t <= c->line.tmax) ||
            !CHECK(i == 0 || a.hit[0].t <= h->t)) {
            REPORT_CASE(c);
        }
    }
}

static void hits_ascend_within_the_domain(void)
{
    over_all_families(ascending);
}

int main(void)
{
    if (family_count() == 0) {
        return check_skip("no GSL: no families to draw from (make deps)");
    }
    RUN(a_capped_shape_has_an_even_number_of_hits);
    RUN(a_reversed_line_has_hits_at_minus_t);
    RUN(a_reversed_segment_has_hits_at_1_minus_t);
    RUN(hits_in_a_domain_are_the_lines_hits_within_it);
    RUN(coordinates_may_be_permuted);
    RUN(coordinates_may_change_sign);
    RUN(scaling_by_powers_of_two_keeps_the_digits_of_t);
    RUN(the_ends_may_be_swapped);
    RUN(an_ellipses_axes_may_be_swapped_or_reversed);
    RUN(a_cone_with_equal_radii_is_a_cylinder);
    RUN(an_elliptic_cone_with_k_1_is_an_elliptic_cylinder);
    RUN(a_circular_shape_is_an_elliptic_one_with_equal_axes);
    RUN(missing_caps_only_remove_hits);
    RUN(occluded_is_whether_there_is_a_hit);
    RUN(unwanted_members_are_not_written_and_change_nothing);
    RUN(hits_ascend_within_the_domain);
    return check_end();
}
