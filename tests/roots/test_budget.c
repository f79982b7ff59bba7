/*
 * test_budget.c - floors intersect and roots: errors stay within budgets.txt
 *
 * Measures every line of budgets.txt against the oracle and, for boxes and
 * tangents, against MPFR.  A function without a line fails, and so does a
 * different table in cylint(3).  CYLINT_CASES and CYLINT_SEED change the cases,
 * CYLINT_MEASURE=1 prints the largest error of every function in the format of
 * budgets.txt.
 *
 * An error is measured between rounded answers: error 0 means within half a
 * unit of the exact value, error 1 within 1.5 units.  Budgets are about the
 * exact value, so half a unit is added to the measured error.  A budget of 0.5
 * therefore permits no bit to differ from the oracle's nearest double.
 */
#ifdef HAVE_MPFR

#include <mpfr.h>
#include <string.h>

#include "check.h"
#include "constructed.h"
#include "oracle.h"
#include "shapes/shape_facts.h"
#include "ulps.h"

enum { CASES = 1500, WILD_CASES = 300, EXTRA = 2, MOST_LINES = 300 };

static const char *const budgets = "tests/roots/budgets.txt";
static const char *const manual = "man/cylint.3";

struct budget {
    char function[20], family[40], kind[20];
    double ulps, found;
    int measured;
};

static struct budget lines[MOST_LINES];
static int line_count;

static uint64_t seed(void)
{
    return check_setting("CYLINT_SEED", 3);
}

static uint64_t cases(int wild)
{
    return check_setting("CYLINT_CASES", wild ? WILD_CASES : CASES);
}

/* ------------------------------------------------------------ families -- */

/* A family's name as one word. */
static const char *family_word(int family)
{
    static char word[40];
    static const char *const extra[EXTRA] = {"coincidences", "wild exponents"};
    const int n = family_count();
    const char *name = family < n ? family_name(family) : extra[family - n];
    int k = 0;
    for (const char *p = name; *p && k < 39; p++) {
        const int letter = (*p >= 'a' && *p <= 'z') || (*p >= '0' && *p <= '9');
        if (letter || (k > 0 && word[k - 1] != '-'))
            word[k++] = letter ? *p : '-';
    }
    word[k] = '\0';
    return word;
}

static int is_wild(int family)
{
    const int n = family_count();
    return family < n ? family_is_wild(family) : family == n + 1;
}

static int word_is_wild(const char *word)
{
    for (int f = 0; f < family_count() + EXTRA; f++)
        if (strcmp(word, family_word(f)) == 0)
            return is_wild(f);
    return 0;
}

static int make_case(int family, uint64_t i, struct family_case *c)
{
    const int n = family_count();
    if (family < n) {
        family_case(seed(), family, i, c);
    } else if (family == n) {
        struct family_case base;
        constructed_base(seed(), i / 8, &base);
        const int all = constructed_neighbours(&base);
        return constructed_neighbour(&base, (int)(i * 37 % (uint64_t)all), c);
    } else {
        constructed_wild(seed(), i, c);
    }
    return 1;
}

/* ----------------------------------------------------------- budgets.txt -- */

static struct budget *line_of(const char *function, const char *family)
{
    for (int i = 0; i < line_count; i++)
        if (strcmp(lines[i].function, function) == 0 &&
            strcmp(lines[i].family, family) == 0)
            return &lines[i];
    return NULL;
}

static void read_budgets(void)
{
    char text[200];
    FILE *f = fopen(budgets, "r");
    if (!CHECK(f != NULL))
        return;
    while (fgets(text, sizeof text, f)) {
        struct budget *b = &lines[line_count];
        if (text[0] == '#' || text[0] == '\n')
            continue;
        memset(b, 0, sizeof *b);
        if (!CHECK(line_count < MOST_LINES &&
                   sscanf(text, "%19s %39s %lf %19s", b->function, b->family,
                          &b->ulps, b->kind) == 4))
            break;
        CHECK(strcmp(b->kind, "proved") == 0 ||
              strcmp(b->kind, "observed") == 0);
        line_count++;
    }
    fclose(f);
}

static void check_budget(const char *function, const char *family, double found,
                         const struct family_case *c)
{
    struct budget *b = line_of(function, family);
    if (!b) {
        if (CHECK(line_count < MOST_LINES)) {
            b = &lines[line_count++];
            memset(b, 0, sizeof *b);
            strcpy(b->function, function);
            strcpy(b->family, family);
            b->ulps = -1; /* no such line */
        }
        return;
    }
    b->measured = 1;
    if (!(found <= b->found))
        b->found = found;
    if (!getenv("CYLINT_MEASURE") && b->ulps >= 0 && !CHECK(found <= b->ulps) &&
        check_bad <= CHECK_SHOWN) {
        REPORT("%s, %s: %g ulp", function, family, found);
        family_report(c);
    }
}

/* ---------------------------------------------------------------- hits -- */

static void measure_hits(const struct family_case *c)
{
    cylint_answer got, want;
    memset(&got, 0, sizeof got);
    cylint_intersect(&c->shape, &c->line, CYLINT_WANT_ALL, &got);
    oracle_intersect(&c->shape, &c->line, CYLINT_WANT_ALL, &want);
    if (!CHECK(got.n == want.n))
        return;
    for (int i = 0; i < want.n; i++) {
        double off[MEASURES];
        ulps_of_hit(&got.hit[i], &want.hit[i], oracle_other(i), off);
        for (int k = 0; k < MEASURES; k++)
            check_budget(measure_names[k], "all", 0.5 + off[k], c);
    }
}

/* --------------------------------------------------------------- boxes -- */

enum { BITS = 4400 }; /* holds the sum and product of any two doubles */

static mpfr_t m_[6];

static void set_difference(mpfr_t x, double a, double b)
{
    mpfr_set_d(x, a, MPFR_RNDN);
    mpfr_sub_d(x, x, b, MPFR_RNDN);
}

/* m_[0] += x^2, exactly */
static void add_square(double a, double b)
{
    set_difference(m_[2], a, b);
    mpfr_sqr(m_[2], m_[2], MPFR_RNDN);
    mpfr_add(m_[0], m_[0], m_[2], MPFR_RNDN);
}

static void axis_ends(const cylint_shape *s, int i, double *a, double *b)
{
    const int points = cylint_has_end_points(s->kind);
    *a = points ? cylint_top(s)[i] : cylint_axis(s)[i];
    *b = points ? cylint_base(s)[i] : 0;
}

/* m_[0] = half the width of the disc of cap i, or of the ball about end i,
 * along coordinate j. */
static void true_reach(const cylint_shape *s, int i, int j)
{
    double a, b;
    mpfr_set_zero(m_[0], 1);
    if (cylint_is_round(s->kind)) {
        mpfr_set_ui(m_[0], 1, MPFR_RNDN);
    } else if (cylint_is_elliptic(s->kind)) {
        add_square(cylint_a(s)[j], 0);
        add_square(cylint_b(s)[j], 0);
    } else {
        for (int k = 1; k < 3; k++) {
            axis_ends(s, (j + k) % 3, &a, &b);
            add_square(a, b);
        }
        if (s->kind != CYLINT_KIND_ACONE && !mpfr_zero_p(m_[0])) {
            mpfr_set(m_[3], m_[0], MPFR_RNDN);
            axis_ends(s, j, &a, &b);
            add_square(a, b);
            mpfr_div(m_[0], m_[3], m_[0], MPFR_RNDN);
        }
    }
    if (!cylint_is_round(s->kind))
        mpfr_sqrt(m_[0], m_[0], MPFR_RNDN);
    mpfr_mul_d(m_[0], m_[0], i ? cylint_r1(s) : cylint_r0(s), MPFR_RNDN);
}

/* m_[1] = the bound of cap i's disc */
static void true_bound(const cylint_shape *s, int i, int j, int up)
{
    true_reach(s, i, j);
    mpfr_set_d(m_[1], cylint_base(s)[j], MPFR_RNDN);
    if (i && cylint_has_end_points(s->kind))
        mpfr_set_d(m_[1], cylint_top(s)[j], MPFR_RNDN);
    else if (i)
        mpfr_add_d(m_[1], m_[1], cylint_axis(s)[j], MPFR_RNDN);
    if (up)
        mpfr_add(m_[1], m_[1], m_[0], MPFR_RNDN);
    else
        mpfr_sub(m_[1], m_[1], m_[0], MPFR_RNDN);
}

/* Where coordinate and half width cancel, the error is that of pairs of
 * doubles: 2^-96 of the terms. */
static double cancelled(const cylint_shape *s, int j)
{
    const int factors = cylint_has_factors(s->kind);
    double size = factors ? 0 : fmax(cylint_r0(s), cylint_r1(s));
    for (int i = 0; i < 3; i++)
        size = fmax(fmax(size, fabs(cylint_axis(s)[i])),
                    fmax(fabs(cylint_a(s)[i]), fabs(cylint_b(s)[i])));
    const double reach = ldexp(size, -94) * fmax(1, factors ? cylint_r1(s) : 1);
    const double most = ldexp(fabs(cylint_base(s)[j]), -96) + reach;
    return isinf(size) ? ldexp(1, 930) : most;
}

/* The distance of a side of the box from the solid; infinite if the side cuts
 * the solid. */
static double looseness(const cylint_shape *s, int j, int up, double side)
{
    true_bound(s, 0, j, up);
    mpfr_set(m_[4], m_[1], MPFR_RNDN);
    if (s->ends < CYLINT_ENDS_INFINITE) {
        true_bound(s, 1, j, up);
        if (up ? mpfr_greater_p(m_[1], m_[4]) : mpfr_less_p(m_[1], m_[4]))
            mpfr_set(m_[4], m_[1], MPFR_RNDN);
    }
    const double nearest = mpfr_get_d(m_[4], MPFR_RNDN);
    if (isinf(side)) {
        if ((side > 0) != up || isinf(nearest))
            return (side > 0) != up ? HUGE_VAL : 0;
        mpfr_set_d(m_[5], up ? 1 : -1, MPFR_RNDN);
        mpfr_mul_2si(m_[5], m_[5], 1024, MPFR_RNDN);
    } else {
        mpfr_set_d(m_[5], side, MPFR_RNDN);
    }
    mpfr_sub(m_[5], m_[5], m_[4], MPFR_RNDN);
    if (!up)
        mpfr_neg(m_[5], m_[5], MPFR_RNDN);
    if (mpfr_sgn(m_[5]) < 0)
        return HUGE_VAL;
    mpfr_div_d(m_[5], m_[5], fmax(ulp(nearest), cancelled(s, j)), MPFR_RNDN);
    return mpfr_get_d(m_[5], MPFR_RNDU);
}

static void measure_box(int family, const struct family_case *c)
{
    const cylint_shape *s = &c->shape;
    const int constant =
        s->kind == CYLINT_KIND_CYLINDER || s->kind == CYLINT_KIND_ECYLINDER;
    double box[2][3], a, b;
    if (s->ends >= CYLINT_ENDS_INFINITE && !constant)
        return; /* infinite, or the apex: test_constructors.c */
    cylint_bounds(s, box[0], box[1]);
    for (int j = 0; j < 3; j++) {
        axis_ends(s, j, &a, &b);
        if (s->ends >= CYLINT_ENDS_INFINITE && a != b)
            continue;
        for (int up = 0; up < 2; up++)
            check_budget("bounds", family_word(family),
                         looseness(s, j, up, box[up][j]), c);
    }
}

static void measure_tangent(const struct family_case *c)
{
    if (c->shape.kind != CYLINT_KIND_ACONE)
        return;
    mpfr_t x, pi;
    mpfr_inits2(1200, x, pi, (mpfr_ptr)NULL);
    mpfr_const_pi(pi, MPFR_RNDN);
    mpfr_mul_d(x, pi, c->shape_data[6], MPFR_RNDN);
    mpfr_div_ui(x, x, 180, MPFR_RNDN);
    mpfr_tan(x, x, MPFR_RNDN);
    const double want = mpfr_get_d(x, MPFR_RNDN);
    check_budget("tangent", "all",
                 0.5 + ulps_apart(cylint_r1(&c->shape), want, want), c);
    mpfr_clears(x, pi, (mpfr_ptr)NULL);
}

/* --------------------------------------------------------------- tests -- */

static void no_error_is_above_its_budget(void)
{
    for (int i = 0; i < 6; i++)
        mpfr_init2(m_[i], BITS);
    for (int f = 0; f < family_count() + EXTRA; f++)
        for (uint64_t i = 0; i < cases(is_wild(f)); i++) {
            struct family_case c;
            if (!make_case(f, i, &c))
                continue;
            measure_hits(&c);
            measure_tangent(&c);
            measure_box(f, &c);
        }
    for (int i = 0; i < 6; i++)
        mpfr_clear(m_[i]);
    mpfr_free_cache();
}

static void every_line_has_its_function(void)
{
    for (int i = 0; i < line_count; i++)
        if (!CHECK(lines[i].ulps >= 0 && lines[i].measured))
            REPORT("%s %s: %s", lines[i].function, lines[i].family,
                   lines[i].ulps < 0 ? "no such line" : "never measured");
}

/* The largest budget of a function over the ordinary or the wild families. */
static double largest_budget(const char *function, int wild)
{
    double most = 0;
    for (int i = 0; i < line_count; i++)
        if (strcmp(lines[i].function, function) == 0 &&
            word_is_wild(lines[i].family) == wild)
            most = fmax(most, lines[i].ulps);
    return most;
}

static int put_row(char *to, const char *what, double ulps, const char *kind)
{
    if (isinf(ulps))
        return sprintf(to, ".It %s Ta - Ta not bounded\n", what);
    return sprintf(to, ".It %s Ta %g Ta %s\n", what, ulps, kind);
}

/* Prints the text that cylint(3) must have between its marks. */
static void write_table(char *to)
{
    static const char *const shown[MEASURES] = {"t", "point", "normal", "z",
                                                "\\(*f"};
    to += sprintf(to, ".Bl -column \"relation, n, part, side\" \"error\" "
                      "\"nearest double\"\n"
                      ".It Sy answer Ta Sy error Ta Sy kind\n"
                      ".It relation, n, part, side Ta 0 Ta exact\n");
    for (int i = 0; i < MEASURES; i++)
        to += put_row(to, shown[i], largest_budget(measure_names[i], 0),
                      "nearest double");
    to += put_row(to, "a box's sides, outward", largest_budget("bounds", 0),
                  "observed");
    to += put_row(to, "tangent of a half angle", largest_budget("tangent", 0),
                  "observed");
    sprintf(to, ".El\n");
}

static void the_manual_shows_these_budgets(void)
{
    static char want[4000], got[4000];
    char text[300];
    int within = 0;
    FILE *f = fopen(manual, "r");
    if (!CHECK(f != NULL))
        return;
    write_table(want);
    while (fgets(text, sizeof text, f)) {
        if (strcmp(text, ".\\\" budgets end\n") == 0)
            within = 0;
        if (within && strlen(got) + strlen(text) < sizeof got)
            strcat(got, text);
        if (strcmp(text, ".\\\" budgets begin\n") == 0)
            within = 1;
    }
    fclose(f);
    if (!CHECK(strcmp(want, got) == 0))
        fprintf(stderr, "%s should have\n%s", manual, want);
}

static void print_found(void)
{
    const char *before = "";
    for (int i = 0; i < line_count; i++) {
        const struct budget *b = &lines[i];
        if (getenv("CYLINT_MEASURE"))
            printf("%-8s %-24s %.4g of %g\n", b->function, b->family, b->found,
                   b->ulps);
        else if (strcmp(b->function, before) != 0)
            printf("note: %s within %g\n", b->function,
                   fmax(largest_budget(b->function, 0),
                        largest_budget(b->function, 1)));
        before = b->function;
    }
}

int main(void)
{
    if (family_count() == 0) {
        return check_skip("no GSL: no families to draw from (make deps)");
    }
    printf("note: seed %llu\n", (unsigned long long)seed());
    RUN(read_budgets);
    RUN(no_error_is_above_its_budget);
    RUN(every_line_has_its_function);
    RUN(the_manual_shows_these_budgets);
    print_found();
    return check_end();
}

#else

#include "program.h"

int main(void)
{
    return check_skip("no MPFR: nothing to measure against (make deps)");
}

#endif
