/*
 * test_local_coordinates.c - local coordinates, and the filter for one line and
 * one shape that works in them
 *
 * The matrix of every shape is compared with MPFR.  The filter, in each build
 * that runs here, is compared with exact signs for every combination of what is
 * wanted, also where the domain ends at a root or an ulp beside it.
 * CYLINT_CASES is the number of cases of each family, CYLINT_SEED changes all.
 */
#include <math.h>
#include <string.h>

#include "check.h"
#include "cylint.h"
#include "families.h"
#include "filter/filter.h"
#include "dispatch.h"
#include "intersect.h"
#include "numbers/error_bounds.h"
#include "draw.h"
#include "same.h"
#include "shapes/local.h"
#include "shapes/measure.h"
#include "true_shape.h"
#include "ulps.h"

enum { CASES = 200, BITS = 2200 }; /* holds any axis */

/* 2^x, x between a and b. */
static double binary(double a, double b)
{
    return exp2(between(a, b));
}

/* ------------------------------------------------------- the matrix ----- */

/* The largest error found, in units of the one that is stated. */
static double worst_row;

static int rows_are_accurate(const cylint_shape *s, true_shape *m)
{
    const double bound = cylint_frame_error(s) * cylint_norm(s);
    int good = 1;
    for (int r = 0; r < 3; r++) {
        double size = 0, off = 0;
        for (int i = 0; i < 3; i++) {
            size += fabs(mpfr_get_d(m->row[r][i]->x, MPFR_RNDZ));
            off += off_by(m->row[r][i], cylint_column(s, i)[r],
                          cylint_column_lo(s, i)[r]);
        }
        worst_row = fmax(worst_row, off / bound);
        good &= off <= bound && size <= cylint_norm(s);
    }
    return good;
}

/* Whether a number of the shape has the relative error; low parts may underflow
 * where x is tiny beside 1. */
static int is_near(real x, const cylint_shape *s, int at, double error)
{
    const pair y = cylint_number_pair(s, at);
    return off_by(x, y.hi, y.lo) <= error * fmax(fabs(y.hi), 0x1p-900);
}

static int sizes_are_accurate(const cylint_shape *s, true_shape *m)
{
    const int round = cylint_is_hull(s->kind);
    const double error = round ? cylint_frame_error(s) : CYLINT_LOCAL_ERROR;
    return is_near(m->height, s, CYLINT_AT_HEIGHT, CYLINT_LOCAL_ERROR) &&
           (!round || (is_near(m->sine, s, CYLINT_AT_SINE, error) &&
                       is_near(m->cosine, s, CYLINT_AT_COSINE, error))) &&
           is_near(m->slope, s, CYLINT_AT_SLOPE, error) &&
           cylint_height(s) + fmax(cylint_r0(s), cylint_r1(s)) <=
               cylint_reach(s);
}

/* Whether the build without fused operations writes the same bits, but for numbers
 * that are tiny beside 1. */
static int has_one_form(const cylint_shape *s)
{
    cylint_shape plain = *s;
    cylint_measure_local_plain(&plain);
    for (int i = 0; i < CYLINT_NUMBERS; i++) {
        double *x = &plain.library.number[i], y = s->library.number[i];
        if (fmax(fabs(*x), fabs(y)) < 0x1p-900)
            *x = y;
    }
    return memcmp(&plain, s, sizeof plain) == 0;
}

/* Returns whether the shape has local coordinates. */
static int matrix_is_accurate(const cylint_shape *s)
{
    true_shape m;
    if (s->kind == CYLINT_KIND_NONE || !cylint_prepared(s) ||
        s->kind == CYLINT_KIND_SPHERE)
        return 0;
    CHECK(has_one_form(s)); /* in each build */
    real_fixed(BITS);
    set_true_shape(&m, s);
    CHECK(cylint_frame_error(s) >= CYLINT_LOCAL_ERROR &&
          cylint_frame_error(s) <= CYLINT_LOCAL_WORST);
    if (!CHECK(rows_are_accurate(s, &m) && sizes_are_accurate(s, &m)))
        REPORT("kind %d, axis %a %a %a, radii %a %a", s->kind,
               cylint_axis(s)[0], cylint_axis(s)[1], cylint_axis(s)[2],
               cylint_r0(s), cylint_r1(s));
    return 1;
}

TEST(the_matrix_is_as_accurate_as_it_states)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES);
    const uint64_t seed = check_seed();
    /* a slope of about 2^-1025, the low parts of which underflow */
    const double p0[3] = {0, 0, -0x1.8487cec45be26p-120},
                 p1[3] = {0, -0x1.bea8fae24911p+14, 0};
    cylint_shape thin;
    int usable = 0;
    cylint_round_cone(&thin, p0, 0, p1, 0x1.a7070b54813bcp-1011,
                      CYLINT_ENDS_CAPPED);
    CHECK(!matrix_is_accurate(&thin));
    EACH_CASE(c, seed, cases) {
        usable += matrix_is_accurate(&c.shape);
    }
    CHECK(usable > 0);
}

/* Half of them with one ball that nearly holds the other. */
static void any_round_cone(cylint_shape *s, const double h[3])
{
    const double zero[3] = {0, 0, 0}, r0 = binary(-60, 50);
    const double length = hypot(hypot(h[0], h[1]), h[2]);
    const double r1 =
        one_of(2) ? binary(-60, 50) : r0 + length * (1 - binary(-50, -1));
    cylint_round_cone(s, zero, r0, h, r1, (cylint_ends)one_of(4));
}

/* Needles, discs, thin and oblique ellipses, down to lengths whose products
 * underflow. */
static void any_shape(cylint_shape *s)
{
    const double zero[3] = {0, 0, 0};
    const cylint_ends ends = (cylint_ends)one_of(6);
    double h[3], a[3], b[3];
    do {
        random_vector(h, one_of(3) ? 1 : binary(-600, 50));
        random_vector(a, one_of(3) ? 1 : binary(-600, 50));
        random_vector(b, one_of(3) ? 1 : binary(-40, 5));
        if (one_of(3) == 0) {
            const double off = binary(-30, -1);
            for (int i = 0; i < 3; i++) /* nearly in a plane with others */
                b[i] = a[i] + off * b[i];
        }
        const double r = binary(-60, 50);
        switch (one_of(6)) {
        case 4:
            cylint_capsule(s, zero, h, r, (cylint_ends)one_of(4));
            break;
        case 5:
            any_round_cone(s, h);
            break;
        case 0:
            cylint_cylinder(s, zero, h, r, ends);
            break;
        case 1:
            cylint_cone(s, zero, r, h, binary(-60, 50), ends);
            break;
        case 2:
            cylint_tangent_cone(s, zero, h, r, ends);
            break;
        default:
            cylint_elliptic_cone(s, zero, a, b, h, r, ends);
        }
    } while (s->kind == CYLINT_KIND_NONE);
}

TEST(the_matrix_of_extreme_shapes_is_accurate)
{
    const uint64_t cases = 40 * check_setting("CYLINT_CASES", CASES);
    int usable = 0;
    stream = check_seed();
    for (uint64_t i = 0; i < cases; i++) {
        cylint_shape s;
        any_shape(&s);
        usable += matrix_is_accurate(&s);
    }
    CHECK(usable > 0);
    printf("note: largest error of a row: %.2g of the stated one\n", worst_row);
}

/* ----------------------------------------------------- one question ----- */

TEST(all_paths_have_the_bits_of_the_exact_stage)
{
    EACH_CASE(c, 24, CASES) {
        cylint_answer got, want;
        memset(&got, 0, sizeof got);
        memset(&want, 0, sizeof want);
        cylint_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &got);
        cylint_intersect_by_signs(&c.shape, &c.line, CYLINT_WANT_ALL, &want);
        if (!CHECK(same_answer(&got, &want, CYLINT_WANT_ALL)))
            report_answers(&c, "all stages, exact stage", &got, &want);
    }
}

/* The answers of one build are undecided or exact, whatever is wanted.  Returns
 * the number of those that are decided. */
static int compare_build(const cylint_one_kernels *kernels,
                         const cylint_shape *s, const cylint_line *l,
                         const cylint_answer *exact)
{
    static const unsigned wants[] = {0, CYLINT_WANT_PART, CYLINT_WANT_T,
                                     CYLINT_WANT_T | CYLINT_WANT_PART};
    int decided = 0;
    for (int i = 0; i < 8; i++) {
        const unsigned want = wants[i / 2] | (i % 2 ? CYLINT_WANT_NEAREST : 0);
        cylint_answer got;
        cylint_question question;
        memset(&got, 0, sizeof got);
        const int n = cylint_filter_one(kernels, s, l, want, &got, &question);
        if (n == CYLINT_UNDECIDED)
            continue;
        decided++;
        if (!CHECK(n == got.n && same_answer(&got, exact, want)))
            REPORT("kind %d ends %d want %u t %a %a, exactly n %d t %a %a",
                   s->kind, s->ends, want, got.hit[0].t, got.hit[1].t, exact->n,
                   exact->hit[0].t, exact->hit[1].t);
    }
    return decided;
}

/* In the build of this processor and in the one without fused products.  Writes
 * the exact answer. */
static int compare(const cylint_shape *s, const cylint_line *l,
                   cylint_answer *exact)
{
    memset(exact, 0, sizeof *exact);
    cylint_intersect_by_signs(s, l, CYLINT_WANT_T | CYLINT_WANT_PART, exact);
    return compare_build(&cylint_one_plain, s, l, exact) +
           compare_build(cylint_one_used, s, l, exact);
}

/* x moved by up to two ulps. */
static double beside(double x)
{
    return stepped(x, whole_between(-2, 2));
}

/* The line, and the same with domains that end at its hits or beside them. */
static int compare_domains(const cylint_shape *s, const cylint_line *line)
{
    cylint_answer exact, unused;
    cylint_line l = *line;
    int decided = compare(s, &l, &exact);
    for (int i = 0; i < 3 && exact.n > 0; i++) {
        l.tmin = one_of(3) ? beside(exact.hit[0].t) : -HUGE_VAL;
        l.tmax = one_of(3) ? beside(exact.hit[exact.n - 1].t) : HUGE_VAL;
        if (i == 2)
            l.tmin = beside(exact.hit[exact.n - 1].t);
        if (l.tmin <= l.tmax)
            decided += compare(s, &l, &unused);
    }
    return decided;
}

TEST(a_question_is_undecided_or_exact)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES);
    const uint64_t seed = check_seed();
    int decided = 0;
    stream = seed;
    EACH_CASE(c, seed, cases) {
        decided += compare_domains(&c.shape, &c.line);
    }
    CHECK(decided > 0);
}

/* Lines along a thin cone, close to its rulings or its axis: A and the slope at
 * the roots nearly vanish. */
TEST(questions_along_thin_cones_are_exact)
{
    const uint64_t cases = 100 * check_setting("CYLINT_CASES", CASES);
    stream = check_seed();
    for (uint64_t i = 0; i < cases; i++) {
        const double r = binary(-50, 0), zero[3] = {0, 0, 0};
        double h[3], o[3], d[3], across[3], off[3];
        cylint_shape s;
        cylint_line line;
        random_vector(h, 1);
        random_vector(across, r * binary(-40, 1));
        random_vector(off, r * binary(-40, 1));
        const double back = one_of(2) ? between(0, 2) : binary(0, 30);
        for (int k = 0; k < 3; k++) {
            d[k] = h[k] + across[k];
            o[k] = h[k] * one_of(2) + off[k] - back * d[k];
        }
        const cylint_ends ends = (cylint_ends)one_of(6);
        const double r1 = r * one_of(3);
        if (cylint_cone(&s, zero, r * one_of(2), h, r1, ends) == CYLINT_OK &&
            cylint_whole_line(&line, o, d) == CYLINT_OK)
            compare_domains(&s, &line);
    }
}

TEST(questions_of_extreme_shapes_are_exact)
{
    const uint64_t cases = 40 * check_setting("CYLINT_CASES", CASES);
    stream = check_seed();
    for (uint64_t i = 0; i < cases; i++) {
        double o[3], d[3];
        cylint_shape s;
        cylint_line line;
        any_shape(&s);
        random_vector(o, one_of(2) ? 1 : binary(-60, 20));
        random_vector(d, one_of(2) ? 1 : binary(-60, 50));
        if (cylint_whole_line(&line, o, d) == CYLINT_OK)
            compare_domains(&s, &line);
    }
}

/* ---------------------------------------------------- former errors ----- */

/* The square of the axis has no low part. */
TEST(a_disc_of_almost_no_height_is_exact)
{
    const double zero[3] = {0, 0, 0};
    for (int e = -400; e > -560; e--) {
        const double h[3] = {ldexp(1.5, e), ldexp(1.625, e - 1),
                             ldexp(1.1875, e - 2)};
        for (int i = 0; i < 40; i++) {
            double o[3], d[3];
            cylint_shape s;
            cylint_line line;
            random_vector(o, 0.4);
            random_vector(d, 1);
            cylint_cylinder(&s, zero, h, 1, CYLINT_ENDS_CAPPED);
            cylint_whole_line(&line, o, d);
            compare_domains(&s, &line);
        }
    }
}

/* The step from the estimate, with a residual in pairs, leads away from the
 * root; a second step from there must not be certain. */
TEST(a_root_after_a_wrong_step_is_exact)
{
    const double v[3] = {-0x1.abb40bf87f06fp-5, -0x1.5eca937204ffap-1,
                         -0x1.784813c86d34ep-3},
                 u[3] = {0x1.f548e2485077ep-5, 0x1.dc6d623e678fap+0,
                         0x1.49f2d69e41ff7p+0},
                 o[3] = {-0x1.2ad20a6e93e05p-3, -0x1.c474c059ea155p+1,
                         -0x1.14214ae69d596p+1},
                 d[3] = {0x1.79de9e2bcf272p-5, 0x1.6721d04ae141cp+0,
                         0x1.f16ea1a67ffbdp-1};
    cylint_shape s;
    cylint_line line;
    cylint_answer exact;
    cylint_tangent_cone(&s, v, u, 0x1.6bfeb2f310148p-26, CYLINT_ENDS_CAP1);
    cylint_span(&line, o, d, 0x1.0402af253094ap+1, HUGE_VAL);
    compare(&s, &line, &exact);
    CHECK(exact.n == 2 && exact.hit[0].t == 0x1.0402af2530981p+1);
}
