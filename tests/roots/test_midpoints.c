/*
 * test_midpoints.c - roots at the midpoint of two doubles, and beside it
 *
 * Random roots are never midpoints, so these are made, from lines and shapes of few
 * digits whose roots have few digits, too.  With the line's origin moved back by
 * d T, a root k becomes T + k, here an odd number of more digits than a double has.
 * d T is too long for doubles, but a sum hi + lo of two: the line's origin becomes
 * -hi, and the shape is moved by lo.  So the even neighbour is known without
 * arithmetic of the library or the oracle.  If the shape is moved on by one ulp
 * along the line, the root is the lower or the upper neighbour.  A domain that ends
 * at a neighbour has the roots that it contains.  CYLINT_SEED changes the cases.
 */
#include <math.h>
#include <string.h>

#include "check.h"
#include "families.h"
#include "numbers/double_double.h"
#include "draw.h"
#include "ulps.h"
#ifdef HAVE_MPFR
#include "oracle.h"
#endif

/* The midpoint: n 2^f, where n is odd and has 54 bits, or 2^f is half of the least
 * double.  Lengths are multiplied by 2^e. */
struct midpoint {
    uint64_t n;
    int e, f;
};

/* The exponent of the lowest bit of a number of few digits other than 0; 99 for
 * other numbers. */
static int lowest_bit(double x)
{
    int e = -10;
    if (!(fabs(x) < 1e6) || x == 0 || fmod(x, ldexp(1, e)) != 0)
        return 99;
    while (fmod(x, ldexp(2, e)) == 0)
        e++;
    return e;
}

/* Of all numbers of a case, and the tangent of its angle. */
static int has_few_digits(const struct family_case *c)
{
    int few = c->shape_word != FAMILY_ACONE || c->shape_data[6] == 45;
    for (int i = 0; i < 6 + family_shape_size(c->shape_word); i++) {
        const double x = i < 6 ? c->line_data[i] : c->shape_data[i - 6];
        few &= x == 0 || lowest_bit(x) < 99;
    }
    return few;
}

/* Adds x to coordinate i of the points of a shape. */
static int move_points(struct family_case *c, int i, double x)
{
    int exact = add_exactly(&c->shape_data[i], x);
    if (family_has_points(c->shape_word))
        exact &= add_exactly(&c->shape_data[family_axis(c->shape_word) + i], x);
    return exact;
}

/* Moves and scales a whole line and its shape, so that the root k is the midpoint.
 * Returns 0 if they or k have too many digits. */
static int place_root(struct family_case *c, double k,
                      const struct midpoint *at)
{
    const int unit = lowest_bit(k);
    if (unit == 99)
        return 0;
    const double odd = ldexp(k, -unit);
    const int64_t from = (int64_t)at->n - (int64_t)odd;
    const double T = (double)from;
    int exact = (int64_t)T == from;
    for (int i = 0; i < 3; i++) {
        const double o = c->line_data[i];
        const pair back = two_prod(ldexp(c->line_data[3 + i], unit), T);
        double by = back.lo;
        exact &= add_exactly(&by, -o) && move_points(c, i, by);
        c->line_data[i] = -back.hi;
    }
    return scale_exactly(c->line_data, 3, at->e) &&
           scale_exactly(c->line_data + 3, 3, at->e - at->f + unit) &&
           scale_exactly(c->shape_data, family_lengths(c->shape_word), at->e) &&
           exact && family_make(c);
}

/* ------------------------------------------------------------ checking -- */

static int has_root(const cylint_answer *answer, double t)
{
    for (int i = 0; i < answer->n; i++)
        if (answer->hit[i].t == t)
            return 1;
    return 0;
}

static cylint_answer answer_to(const struct family_case *c)
{
    cylint_answer got;
    cylint_intersect(&c->shape, &c->line, CYLINT_WANT_T | CYLINT_WANT_PART,
                     &got);
#ifdef HAVE_MPFR
    cylint_answer want;
    oracle_intersect(&c->shape, &c->line, CYLINT_WANT_T, &want);
    int same = got.n == want.n && got.relation == want.relation;
    for (int i = 0; i < want.n && same; i++)
        same = got.hit[i].t == want.hit[i].t &&
               got.hit[i].part == want.hit[i].part;
    if (!CHECK(same)) {
        REPORT("from %a to %a", c->line.tmin, c->line.tmax);
        REPORT_CASE(c);
    }
#endif
    return got;
}

static void expect(const struct family_case *c, double t, const char *which)
{
    const cylint_answer got = answer_to(c);
    if (CHECK(has_root(&got, t)))
        return;
    REPORT("%s: want %a, got %d: %a %a", which, t, got.n,
           got.n > 0 ? got.hit[0].t : 0, got.n > 1 ? got.hit[1].t : 0);
    REPORT_CASE(c);
}

/* Domains that end at t or at a neighbour.  The oracle has their answers. */
static void expect_in_domains(const struct family_case *c, double t)
{
    for (int i = 0; i < 6; i++) {
        struct family_case within = *c;
        const double end = stepped(t, i / 2 - 1);
        cylint_span(&within.line, c->line.o, c->line.d, i % 2 ? end : -HUGE_VAL,
                    i % 2 ? HUGE_VAL : end);
        answer_to(&within);
    }
}

/* Beside the midpoint: the shape is moved along the line by an ulp of its point. */
static void expect_beside(const struct family_case *c, double lower,
                          double upper)
{
    const double *d = c->line.d;
    const int i = d[0] != 0 ? 0 : d[1] != 0 ? 1 : 2;
    for (int ulps = -1; ulps <= 1; ulps += 2) {
        struct family_case moved = *c;
        const double x = c->shape_data[i];
        if (d[(i + 1) % 3] == 0 && d[(i + 2) % 3] == 0 &&
            move_points(&moved, i, stepped(x, ulps) - x) && family_make(&moved))
            expect(&moved, (ulps < 0) == (d[i] > 0) ? lower : upper,
                   "beside the midpoint");
    }
}

static int counted[FAMILY_SHAPES];

/* A line and a shape of few digits whose root k is moved to the midpoint. */
static void try_midpoint(struct family_case *c, const struct midpoint *at)
{
    cylint_answer few;
    c->line_word = FAMILY_LINE;
    memcpy(c->line_data + 3, c->line.d, sizeof c->line.d);
    if (!has_few_digits(c) || !family_make(c))
        return;
    cylint_intersect(&c->shape, &c->line, CYLINT_WANT_T, &few);
    if (few.n == 0 || !place_root(c, few.hit[one_of(few.n)].t, at))
        return;
    const double t = ldexp((double)at->n, at->f);
    counted[c->shape_word]++;
    expect(c, t, "midpoint");
    expect_in_domains(c, t);
    expect_beside(c, ldexp((double)(at->n - 1), at->f),
                  ldexp((double)(at->n + 1), at->f));
}

/* -------------------------------------------------------------- ranges -- */

static uint64_t odd_of_bits(int bits)
{
    const uint64_t top = (uint64_t)1 << (bits - 1);
    return top | (random_bits(&stream) & (top - 1)) | 1;
}

static void over_midpoints(void (*choose)(struct midpoint *at), uint64_t cases)
{
    static const char *const names[] = {"constructed", "plain", "integer grid",
                                        "round, whole numbers",
                                        "half-space, whole numbers"};
    enum { NAMES = sizeof names / sizeof *names };
    memset(counted, 0, sizeof counted);
    for (uint64_t i = 0; i < NAMES * cases; i++) {
        struct family_case c;
        struct midpoint at;
        family_case(check_seed(), family_named(names[i % NAMES]), i, &c);
        stream = check_seed() + i;
        choose(&at);
        try_midpoint(&c, &at);
    }
    printf("note:");
    for (int word = 0; word < FAMILY_SHAPES; word++) {
        CHECK(counted[word] > 0 || word == FAMILY_SPHERE);
        printf(" %d", counted[word]);
    }
    puts(" midpoints");
}

static void ordinary(struct midpoint *at)
{
    at->n = odd_of_bits(54);
    at->f = one_of(121) - 60;
    at->e = one_of(41) - 20;
}

TEST(ordinary_ties_go_to_even)
{
    over_midpoints(ordinary, 5000);
}

static void of_any_size(struct midpoint *at)
{
    at->n = odd_of_bits(54);
    do {
        at->e = one_of(2000) - 1074;
        at->f = one_of(2044) - 1074;
    } while (at->e - at->f > 1000 || at->e - at->f < -1074);
}

TEST(ties_of_any_exponent_go_to_even)
{
    over_midpoints(of_any_size, 3000);
}

static void below_normal(struct midpoint *at)
{
    at->n = odd_of_bits(1 + one_of(53));
    at->f = -1075;
    at->e = one_of(1000) - 1074;
}

TEST(subnormal_ties_go_to_even)
{
    over_midpoints(below_normal, 3000);
}

/* Midpoints of the largest double and 2^1024, which counts as even. */
static void at_the_end(struct midpoint *at)
{
    at->n = ((uint64_t)1 << 54) - 1 - 2 * (uint64_t)one_of(3);
    at->f = 970 + (one_of(8) == 0);
    at->e = one_of(1020) - 100;
}

TEST(ties_at_the_largest_double_go_to_infinity)
{
    over_midpoints(at_the_end, 3000);
}
