/*
 * test_batch.c - batches give the bits of single questions
 *
 * The arrays of every batch lie between guard pages; its inputs and its pack
 * are read-only during the call.  All tests run with every build of the kernels
 * that this processor has.  CYLINT_SEED changes all cases of the families;
 * CYLINT_CASES is the number of lines of each, with 50 pairs for each line, but at
 * most MOST lines and MOST pairs.
 */
#include <math.h>
#include <stdint.h>

#define CHECK_OWN_MAIN
#include "../scene/answers.h"
#include "check.h"
#include "columns.h"
#include "environment.h"
#include "guarded.h"
#include "records.h"

enum {
    MOST = 600,
    FEW = 21 /* more than twice the lanes */
};
enum { WITHOUT_MEMBERS = 63 };

static size_t lines_per_family(void)
{
    const uint64_t lines = check_setting("CYLINT_CASES", 12);
    return lines < MOST ? (size_t)lines : MOST;
}

/* -------------------------------------------------------------- layout -- */

/* The places of the arrays, and which of them are present. */
struct layout {
    size_t offset; /* bytes from a guard page, 0 to 63 */
    int at_end;    /* from the upper guard page */
    int columns;   /* a bit for each member of cylint_columns */
    int domain;    /* bits: 1 tmin is present, 2 tmax is present */
};

static const struct layout usual = {0, 1, ALL_COLUMNS, 3};
static const struct layout without_members = {0, 1, WITHOUT_MEMBERS, 3};

static struct guarded line_pages[8], answer_pages[COLUMNS], shape_pages,
    pack_pages;

static void allocate_pages(void)
{
    for (int i = 0; i < 8; i++)
        line_pages[i] = guarded_allocate(MOST * sizeof(double));
    for (int i = 0; i < COLUMNS; i++)
        answer_pages[i] = guarded_allocate(MOST * column_size(i));
    shape_pages = guarded_allocate(MOST * sizeof(cylint_shape));
    pack_pages = guarded_allocate(cylint_pack_bytes(MOST));
}

/* The gap of array i, a multiple of `size`, which is that of no array beside it. */
static size_t gap_of(const struct layout *at, int i, size_t size)
{
    return (at->offset + (size_t)i) * size % 64;
}

/* Packs the shapes; that writes to the memory of the pack only.  Batches then use a
 * copy of the struct. */
static cylint_pack lay_pack(const struct family_case *shapes, size_t n,
                            const struct layout *at)
{
    cylint_pack pack;
    const size_t bytes = cylint_pack_bytes(n);
    cylint_shape *to = guarded_place(&shape_pages, n * sizeof *to,
                                     gap_of(at, 3, sizeof(double)), at->at_end);
    for (size_t i = 0; i < n; i++)
        to[i] = shapes[i].shape;
    guarded_permit(&shape_pages, 0);
    char *memory = guarded_place(&pack_pages, bytes, at->offset, at->at_end);
    cylint_pack_shapes(&pack, memory, to, n);
    guarded_permit(&pack_pages, 0);
    CHECK(pack.memory == memory && guarded_kept(&pack_pages, memory, bytes));
    return pack;
}

static cylint_lines lay_lines(const struct family_case *from, size_t n,
                              const struct layout *at)
{
    double *array[8];
    for (int i = 0; i < 8; i++)
        array[i] = guarded_place(&line_pages[i], n * sizeof(double),
                                 gap_of(at, i, sizeof(double)), at->at_end);
    for (size_t i = 0; i < n; i++)
        set_columns(&from[i].line, array, i);
    for (int i = 0; i < 8; i++)
        guarded_permit(&line_pages[i], 0);
    return lines_of(array, n, at->domain);
}

static void *answers[COLUMNS];

static cylint_columns lay_answers(size_t n, const struct layout *at)
{
    for (int i = 0; i < COLUMNS; i++) {
        answers[i] = guarded_place(&answer_pages[i], n * column_size(i),
                                   gap_of(at, i, column_size(i)), at->at_end);
        if (!(at->columns >> i & 1))
            answers[i] = NULL;
    }
    return columns_of(answers);
}

/* --------------------------------------------------------- the batches --- */

static void show(const struct family_case *line,
                 const struct family_case *shape)
{
    struct family_case record = *shape;
    record.line_word = line->line_word;
    memcpy(record.line_data, line->line_data, sizeof record.line_data);
    REPORT("seed %llu, kernels %s", (unsigned long long)check_seed(),
           cylint_kernels_in_use());
    REPORT_CASE(&record);
}

/* Element i is that of line i, or of the only line; and of shape i, or of the only
 * shape.  Nothing else was written. */
static void check_answers(const struct family_case *line, size_t line_step,
                          const struct family_case *shape, size_t shape_step,
                          size_t n, const struct layout *at)
{
    for (int i = 0; i < COLUMNS; i++)
        CHECK(guarded_kept(&answer_pages[i], answers[i],
                           answers[i] ? n * column_size(i) : 0));
    for (size_t i = 0; i < n; i++) {
        const struct family_case *l = line + i * line_step,
                                 *s = shape + i * shape_step;
        const cylint_line as_read =
            line_step ? column_line(&l->line, at->domain) : l->line;
        cylint_answer want;
        cylint_intersect(&s->shape, &as_read, CYLINT_WANT_ALL, &want);
        if (!CHECK(is_column_answer(answers, i, &want)))
            show(l, s);
    }
}

static void check_pairs(const struct family_case *cases, size_t n,
                        const struct layout *at)
{
    const cylint_pack pack = lay_pack(cases, n, at);
    const cylint_lines lines = lay_lines(cases, n, at);
    const cylint_columns got = lay_answers(n, at);
    cylint_intersect_pairs(&pack, &lines, &got);
    check_answers(cases, 1, cases, 1, n, at);
}

static void check_lines(const struct family_case *shape,
                        const struct family_case *cases, size_t n,
                        const struct layout *at)
{
    const cylint_lines lines = lay_lines(cases, n, at);
    const cylint_columns got = lay_answers(n, at);
    cylint_intersect_lines(&shape->shape, &lines, &got);
    check_answers(cases, 1, shape, 0, n, at);
}

static void check_shapes(const struct family_case *line,
                         const struct family_case *cases, size_t n,
                         const struct layout *at)
{
    const cylint_pack pack = lay_pack(cases, n, at);
    const cylint_columns got = lay_answers(n, at);
    cylint_intersect_shapes(&pack, &line->line, &got);
    check_answers(line, 0, cases, 1, n, at);
}

/* Nearest, with several sets of members, and count, beside a loop over all
 * shapes. */
static void check_nearest_and_count(const struct family_case *line,
                                    const struct family_case *cases, size_t n,
                                    const struct layout *at)
{
    static const unsigned wants[] = {CYLINT_WANT_T,
                                     CYLINT_WANT_PART,
                                     CYLINT_WANT_T | CYLINT_WANT_PART,
                                     CYLINT_WANT_COUNT,
                                     CYLINT_WANT_POINT,
                                     CYLINT_WANT_NORMAL,
                                     CYLINT_WANT_Z,
                                     CYLINT_WANT_PHI,
                                     CYLINT_WANT_T | CYLINT_WANT_NORMAL,
                                     CYLINT_WANT_ALL};
    static struct line_answers due;
    const cylint_pack pack = lay_pack(cases, n, at);
    line_by_loop(pack.shapes, n, &line->line, &due);
    for (size_t m = 0; m < sizeof wants / sizeof *wants; m++)
        if (!CHECK(pack_agrees(&pack, &line->line, wants[m], &due)))
            show(line, &cases[due.nearest[0] < n ? due.nearest[0] : 0]);
}

/* ---------------------------------------------------------------- input -- */

static struct family_case drawn[MOST], lined[MOST];

static void draw(int family, uint64_t first, size_t n)
{
    for (size_t i = 0; i < n; i++)
        family_case(check_seed(), family, first + i, &drawn[i]);
}

/* All families in turn, with all kinds and ends and some invalid cases. */
static void draw_mixed(size_t n)
{
    for (size_t i = 0; i < n; i++) {
        struct family_case *c = &drawn[i];
        family_case(check_seed() + 7, (int)(i % (size_t)family_count()), i, c);
        if (i % 50 == 49) {
            c->shape_data[6] = -1;
            c->shape_data[0] = i % 100 == 99 ? NAN : 0;
            family_make(c);
        }
    }
}

/* Lines that meet the shape of one case as its own line does, with the origin
 * moved along the line; every second line is from another case. */
static void slide(const struct family_case *one, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        struct family_case *c = &lined[i];
        *c = i % 2 ? drawn[i] : *one;
        for (int k = 0; k < 6 && i % 2 == 0; k++)
            if (k < 3 || c->line_word == FAMILY_SEGMENT)
                c->line_data[k] += c->line.d[k % 3] * ((double)i / 8);
        family_make(c);
    }
}

/* ----------------------------------------------------------------- tests -- */

TEST(batches_answer_as_single_questions)
{
    const size_t lines = lines_per_family(), n = lines < 12 ? 50 * lines : MOST;
    for (int family = 0; family <= family_count(); family++) {
        if (family < family_count())
            draw(family, 1000, MOST);
        else
            draw_mixed(MOST);
        check_pairs(drawn, n, &usual);
        check_pairs(drawn, n, &without_members);
        check_lines(&drawn[MOST - 1], drawn, n, &usual);
        check_shapes(&drawn[MOST - 2], drawn, n, &usual);
        for (size_t i = 0; i < lines; i++) {
            const struct layout *at = i % 2 ? &usual : &without_members;
            slide(&drawn[i], 100);
            check_lines(&drawn[i], lined, 100, at);
            check_shapes(&drawn[i], drawn, 100, at);
            check_nearest_and_count(&drawn[i], drawn, 60, &usual);
        }
    }
}

static void check_batches(size_t n, const struct layout *at)
{
    check_pairs(drawn, n, at);
    check_lines(&drawn[0], lined, n, at);
    check_shapes(&drawn[0], drawn, n, at);
    check_nearest_and_count(&drawn[0], drawn, n, at);
}

/* Shapes of one kind with the same ends, so that all lanes are of one run. */
TEST(runs_of_one_kind_answer_as_single_questions)
{
    enum { N = 120 };
    uint64_t index = 5000;
    for (int kind = FAMILY_CYLINDER; kind < FAMILY_SHAPES; kind++)
        for (int ends = CYLINT_ENDS_CAPPED; ends <= CYLINT_ENDS_NAPPE; ends++) {
            for (size_t n = 0; n < N; index++) {
                struct family_case *c = &drawn[n];
                family_case(check_seed(),
                            (int)(index % (uint64_t)family_count()), index, c);
                c->ends = (cylint_ends)(kind == FAMILY_SPHERE  ? 0
                                        : kind > FAMILY_SPHERE ? ends % 4
                                                               : ends);
                lined[n] = *c;
                n += (int)c->shape_word == kind && family_make(c);
            }
            check_batches(N, &usual);
        }
}

/* A case of one family: its shape among others, its line moved along itself. */
static void draw_around(int family)
{
    draw_mixed(MOST);
    family_case(check_seed(), family, 0, &drawn[0]);
    slide(&drawn[0], MOST);
}

/* All columns but members in turn, each column alone, then all; with and without
 * the arrays of the domain. */
TEST(every_length_address_and_column_has_its_answers)
{
    static const size_t longer[] = {31,  255, 256, 257, 263,
                                    264, 511, 513, MOST};
    for (int i = 0; i < 256; i++) {
        const int alone = i - WITHOUT_MEMBERS - 1;
        const struct layout at = {(size_t)i / 2 % 64, i % 2,
                                  alone < 0         ? i
                                  : alone < COLUMNS ? 1 << alone
                                                    : ALL_COLUMNS,
                                  i / 8 % 4};
        if (i % 128 == 0)
            draw_around(i / 128);
        check_batches(i % 8 ? (size_t)i % 18 : longer[i / 8 % 9], &at);
    }
}

/* A cylinder about the z axis, and a line that crosses it. */
static struct family_case easy(void)
{
    return case_of("ray -3 0.25 1  1 0.125 0.25  cylinder 0 0 0  0 0 4  1");
}

/* Columns are whole vectors.  Where they are too short, the last lanes read what
 * follows: the numbers of balls that the line misses. */
TEST(a_pack_of_256_shapes_of_one_kind_has_its_answers)
{
    enum { BALLS = 8 };
    for (int i = 0; i < 256 + BALLS; i++) {
        drawn[i] =
            i < 256 ? case_of("ray -3 0.25 1  1 0 0  cylinder 0 0 0  0 0 4  1")
                    : case_of("sphere 0 9 9  1");
        if (i < 256)
            drawn[i].shape_data[0] = drawn[i].shape_data[3] = 8 * i;
        family_make(&drawn[i]);
    }
    check_shapes(&drawn[0], drawn, 256 + BALLS, &usual);
    check_nearest_and_count(&drawn[0], drawn, 256 + BALLS, &usual);
}

static size_t n_records;

static const char *take_record(const char *text, const char *known)
{
    if (n_records == MOST || !family_parse(text, &drawn[n_records]))
        return NULL;
    n_records++;
    return known + strlen(known);
}

/* Those of test_hits.c: lines and shapes with those of the records near them. */
TEST(known_hits_are_those_of_batches)
{
    n_records = 0;
    each_record("tests/library/hits.txt", 227, take_record);
    each_record("tests/library/hard.txt", 281, take_record);
    check_pairs(drawn, n_records, &usual);
    for (size_t i = 0; i + FEW <= n_records; i += FEW / 3) {
        check_lines(&drawn[i], &drawn[i], FEW, &usual);
        check_shapes(&drawn[i + FEW - 1], &drawn[i], FEW, &usual);
        check_nearest_and_count(&drawn[i], &drawn[i], FEW, &usual);
    }
}

/* A flat cone, of slope 2^12 to 2^20, and a line from afar that passes near its
 * apex: the estimate of a root may be nearer to the other one. */
static struct family_case draw_flat_cone(void)
{
    struct family_case c = case_of("ray 0 0 0  1 0 0  cone 0 0 0 1  0 0 1 2");
    c.ends = chance(0.5) ? CYLINT_ENDS_NAPPE : CYLINT_ENDS_INFINITE;
    const int upright = one_of(4);
    const double far = ldexp(1, whole_between(12, 24));
    double axis[3], length = 0;
    for (int i = 0; i < 3; i++) {
        c.shape_data[i] = (double)whole_between(-8, 8) / 4;
        axis[i] = upright == i || upright == 3 ? between(-8, 8) : 0;
        length += fabs(axis[i]);
        c.line_data[3 + i] = (double)whole_between(-10, 10) / 8;
        c.line_data[i] = c.shape_data[i] - far * c.line_data[3 + i];
        if (chance(0.5))
            c.line_data[i] =
                nextafter(c.line_data[i], chance(0.5) ? 1e9 : -1e9);
    }
    c.shape_data[3] = ldexp(between(1, 2), whole_between(-9, 0));
    for (int i = 0; i < 3; i++)
        c.shape_data[4 + i] = c.shape_data[i] + axis[i];
    c.shape_data[7] = ldexp(length, whole_between(12, 20));
    family_make(&c);
    return c;
}

/* In domains that end beside a hit. */
TEST(flat_cones_from_afar_answer_as_single_questions)
{
    stream = check_seed() + 11;
    for (int round = 0; round < 200; round++) {
        for (int i = 0; i < FEW; i++) {
            drawn[i] = draw_flat_cone();
            cylint_answer a;
            cylint_intersect(&drawn[i].shape, &drawn[i].line, CYLINT_WANT_T,
                             &a);
            if (a.n == 0)
                continue;
            double t = a.hit[one_of(a.n)].t;
            const int upwards = chance(0.5), is_last = chance(0.5);
            for (int k = one_of(4); k > 0; k--)
                t = nextafter(t, upwards ? HUGE_VAL : -HUGE_VAL);
            *(is_last ? &drawn[i].line.tmax : &drawn[i].line.tmin) = t;
        }
        check_pairs(drawn, FEW, &usual);
        check_lines(&drawn[0], drawn, FEW, &usual);
        check_nearest_and_count(&drawn[0], drawn, FEW, &usual);
    }
}

/* Among them one whose tmin is just above tmax, near every hit. */
TEST(an_invalid_line_misses)
{
    static const double wrong[] = {NAN, HUGE_VAL, -HUGE_VAL};
    enum { N = 40 };
    struct family_case bad[N];
    for (int i = 0; i < N; i++) {
        bad[i] = easy();
        cylint_line *l = &bad[i].line;
        if (i < 36 && i % 2 == 0) {
            (i % 12 < 6 ? l->o : l->d)[i / 2 % 3] = wrong[i / 12];
            l->valid = 0;
        }
    }
    memset(bad[36].line.d, 0, sizeof bad[36].line.d);
    bad[37].line.tmin = 1e300;
    bad[37].line.tmax = -1e300;
    bad[38].line.tmin = NAN;
    bad[39].line.tmax = NAN;
    for (int i = 36; i < N; i++)
        CHECK(!column_line(&bad[i].line, 3).valid);
    memcpy(drawn, bad, sizeof bad);
    memcpy(lined, bad, sizeof bad);
    check_batches(N, &usual);
    for (int i = 0; i < FEW; i++) {
        drawn[i] = easy();
        drawn[i].line.tmin = 3 + i / 8.;
        drawn[i].line.tmax = 3;
    }
    check_lines(&drawn[0], drawn, FEW, &usual);
    check_pairs(drawn, FEW, &usual);
}

/* The same cylinder in four forms, after some that are missed or hit later. */
TEST(the_lower_number_is_nearest_for_equal_t)
{
    static const char *const forms[4] = {"cylinder 0 0 0  0 0 4  1",
                                         "cone 0 0 0 1  0 0 4 1",
                                         "ecylinder 0 0 0  1 0 0  0 1 0  0 0 4",
                                         "econe 0 0 0  1 0 0  0 1 0  0 0 4  1"};
    struct family_case cases[FEW];
    const struct family_case line = easy();
    for (int turn = 0; turn < 24; turn++) {
        const int ahead = turn / 4;
        for (int i = 0; i < FEW; i++) {
            cases[i] = case_of(forms[(i + turn) % 4]);
            if (i < ahead)
                cases[i].shape_data[0] += i % 2 ? 0.25 : 100.25;
            family_make(&cases[i]);
        }
        const cylint_pack pack = lay_pack(cases, FEW, &usual);
        cylint_hit hit;
        CHECK(cylint_nearest(&pack, &line.line, CYLINT_WANT_T, &hit) ==
              (size_t)ahead);
        check_nearest_and_count(&line, cases, FEW, &usual);
    }
}

/* The last test: the best kernels are in use then. */
TEST(kernels_are_chosen_by_name)
{
    int n = 0;
    while (cylint_kernels_name(n))
        n++;
    CHECK(n > 0 && !cylint_kernels_name(-1));
    CHECK(strcmp(cylint_kernels_name(n - 1), "plain") == 0);
    CHECK(!cylint_use_kernels("no such kernels"));
    CHECK(cylint_use_kernels("plain"));
    CHECK(!cylint_use_kernels(""));
    CHECK(strcmp(cylint_kernels_in_use(), "plain") == 0);
    CHECK(cylint_use_kernels(NULL));
    CHECK(strcmp(cylint_kernels_in_use(), cylint_kernels_name(0)) == 0);
}

int main(void)
{
    allocate_pages();
    EACH_KERNELS(k)
        check_each();
    return check_end();
}
