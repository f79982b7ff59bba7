/*
 * test_batch.c - floor batch: batches give the bits of single questions
 *
 * The arrays of every batch lie between guard pages; its inputs and its pack
 * are read-only during the call.  All tests run with every build of the kernels
 * that this processor has.  CYLINT_SEED changes all cases of the families,
 * CYLINT_CASES sets the number of lines of each, at most 59.
 */
#include <math.h>
#include <pthread.h>
#include <stdint.h>

#include "batch_layout.h"
#include "check.h"
#include "cylint.h"
#include "families.h"

enum {
    FEW = 21 /* for all addresses: more than twice the lanes */
};

static uint64_t seed(void)
{
    return check_setting("CYLINT_SEED", 1);
}

static size_t lines_per_family(void)
{
    return (size_t)check_setting("CYLINT_CASES", 24);
}

/* ------------------------------------------------------------- answers -- */

/* The line as a batch reads it, with the stored direction. */
static cylint_line column_line(const cylint_line *from, int domain)
{
    cylint_line line;
    cylint_span(&line, from->o, from->d, domain & 1 ? from->tmin : 0,
                domain & 2 ? from->tmax : HUGE_VAL);
    return line;
}

static int same(double x, double y)
{
    return memcmp(&x, &y, sizeof x) == 0;
}

static int missing(const double *t, const signed char *part, size_t i)
{
    return (!t || t[i] != t[i]) && (!part || part[i] == -1);
}

/* The members beside t of hit k; hit: NULL if there is none. */
static int are_members(const cylint_columns *got, size_t i, int k,
                       const cylint_hit *hit)
{
    double *column[HIT_COLUMNS], want[HIT_COLUMNS];
    hit_columns(got, k, column);
    for (int c = 0; c < 3 && hit; c++) {
        want[c] = hit->point[c];
        want[3 + c] = hit->normal[c];
    }
    want[6] = hit ? hit->z : 0;
    want[7] = hit ? hit->phi : 0;
    for (int c = 0; c < HIT_COLUMNS; c++)
        if (column[c] &&
            !(hit ? same(column[c][i], want[c]) : column[c][i] != column[c][i]))
            return 0;
    return 1;
}

static int is_answer(const cylint_columns *got, size_t i,
                     const cylint_answer *want)
{
    const double *t[2] = {got->t0, got->t1};
    const signed char *part[2] = {got->part0, got->part1};
    if ((got->relation && got->relation[i] != want->relation) ||
        (got->n && got->n[i] != want->n))
        return 0;
    for (int k = 0; k < 2; k++) {
        if (!are_members(got, i, k, k < want->n ? &want->hit[k] : NULL))
            return 0;
        if (k >= want->n) {
            if (!missing(t[k], part[k], i))
                return 0;
        } else if ((t[k] && !same(t[k][i], want->hit[k].t)) ||
                   (part[k] && part[k][i] != want->hit[k].part)) {
            return 0;
        }
    }
    return 1;
}

/* Prints the case as a record of the command. */
static void show(const struct family_case *line,
                 const struct family_case *shape)
{
    struct family_case record = *shape;
    record.line_word = line->line_word;
    memcpy(record.line_data, line->line_data, sizeof record.line_data);
    fprintf(stderr, "    seed %llu, kernels %s\n    ",
            (unsigned long long)seed(), cylint_kernels_in_use());
    family_report(&record);
}

static void check_answer(const cylint_columns *got, size_t i,
                         const cylint_line *line,
                         const struct family_case *line_case,
                         const struct family_case *shape_case)
{
    cylint_answer want;
    cylint_intersect(&shape_case->shape, line, CYLINT_WANT_ALL, &want);
    if (CHECK(is_answer(got, i, &want)) || check_bad > CHECK_SHOWN)
        return;
    show(line_case, shape_case);
    fprintf(stderr, "    %zu: want relation %d n %d", i, want.relation, want.n);
    for (int k = 0; k < want.n; k++)
        fprintf(stderr, " t %a part %d", want.hit[k].t, want.hit[k].part);
    fprintf(stderr, "\n    got relation %d n %d t %a %a part %d %d\n",
            got->relation ? got->relation[i] : -9, got->n ? got->n[i] : -9,
            got->t0 ? got->t0[i] : -9, got->t1 ? got->t1[i] : -9,
            got->part0 ? got->part0[i] : -9, got->part1 ? got->part1[i] : -9);
}

/* -------------------------------------------------------- the batches --- */

static void check_pairs(const struct family_case *cases, size_t n,
                        const struct layout *at)
{
    cylint_pack pack;
    cylint_lines lines;
    cylint_columns got;
    CHECK(lay_pack(&pack, cases, n, at));
    lay_lines(&lines, cases, n, at);
    lay_answers(&got, n, at);
    cylint_intersect_pairs(&pack, &lines, &got);
    CHECK(only_answers_written(&got, n));
    for (size_t i = 0; i < n; i++) {
        const cylint_line line = column_line(&cases[i].line, at->domain);
        check_answer(&got, i, &line, &cases[i], &cases[i]);
    }
}

static void check_lines(const struct family_case *shape,
                        const struct family_case *cases, size_t n,
                        const struct layout *at)
{
    cylint_lines lines;
    cylint_columns got;
    lay_lines(&lines, cases, n, at);
    lay_answers(&got, n, at);
    cylint_intersect_lines(&shape->shape, &lines, &got);
    CHECK(only_answers_written(&got, n));
    for (size_t i = 0; i < n; i++) {
        const cylint_line line = column_line(&cases[i].line, at->domain);
        check_answer(&got, i, &line, &cases[i], shape);
    }
}

static void check_shapes(const struct family_case *line,
                         const struct family_case *cases, size_t n,
                         const struct layout *at)
{
    cylint_pack pack;
    cylint_columns got;
    CHECK(lay_pack(&pack, cases, n, at));
    lay_answers(&got, n, at);
    cylint_intersect_shapes(&pack, &line->line, &got);
    CHECK(only_answers_written(&got, n));
    for (size_t i = 0; i < n; i++)
        check_answer(&got, i, &line->line, line, &cases[i]);
}

static const unsigned hit_masks[] = {
    CYLINT_WANT_T,     CYLINT_WANT_PART,  CYLINT_WANT_T | CYLINT_WANT_PART,
    CYLINT_WANT_COUNT, CYLINT_WANT_POINT, CYLINT_WANT_NORMAL,
    CYLINT_WANT_Z,     CYLINT_WANT_PHI,   CYLINT_WANT_T | CYLINT_WANT_NORMAL,
    CYLINT_WANT_ALL};

enum { HIT_MASKS = sizeof hit_masks / sizeof *hit_masks };

static int same_bytes(const void *x, const void *y, size_t n)
{
    return memcmp(x, y, n) == 0;
}

static int same_hit(const cylint_hit *x, const cylint_hit *y, unsigned want)
{
    return (!(want & CYLINT_WANT_T) || same(x->t, y->t)) &&
           (!(want & CYLINT_WANT_PART) ||
            (x->part == y->part && x->side == y->side)) &&
           (!(want & CYLINT_WANT_POINT) ||
            same_bytes(x->point, y->point, sizeof x->point)) &&
           (!(want & CYLINT_WANT_NORMAL) ||
            same_bytes(x->normal, y->normal, sizeof x->normal)) &&
           (!(want & CYLINT_WANT_Z) || same(x->z, y->z)) &&
           (!(want & CYLINT_WANT_PHI) || same(x->phi, y->phi));
}

static void check_nearest(const cylint_pack *pack, const cylint_line *line,
                          size_t nearest, const cylint_hit *hit)
{
    for (int m = 0; m < HIT_MASKS; m++) {
        cylint_hit got, untouched;
        memset(&untouched, GUARDED_UNTOUCHED, sizeof untouched);
        got = untouched;
        CHECK(cylint_nearest(pack, line, hit_masks[m], &got) == nearest);
        if (nearest == pack->n)
            CHECK(same_bytes(&got, &untouched, sizeof got));
        else
            CHECK(same_hit(&got, hit, hit_masks[m]));
    }
}

/* Nearest and count, compared with a loop over all shapes. */
static void check_scene(const struct family_case *line,
                        const struct family_case *cases, size_t n,
                        const struct layout *at)
{
    const int bad = check_bad;
    size_t nearest = n, count = 0;
    cylint_answer first = {0}, answer;
    cylint_pack pack;
    for (size_t i = 0; i < n; i++) {
        cylint_intersect(&cases[i].shape, &line->line,
                         CYLINT_WANT_T | CYLINT_WANT_NEAREST, &answer);
        count += answer.n > 0;
        if (answer.n > 0 &&
            (nearest == n || answer.hit[0].t < first.hit[0].t)) {
            nearest = i;
            first = answer;
        }
    }
    if (nearest < n)
        cylint_intersect(&cases[nearest].shape, &line->line,
                         CYLINT_WANT_ALL | CYLINT_WANT_NEAREST, &first);
    CHECK(lay_pack(&pack, cases, n, at));
    check_nearest(&pack, &line->line, nearest, &first.hit[0]);
    CHECK(cylint_count(&pack, &line->line, 0) == count);
    for (size_t enough = 1; enough < 4; enough++)
        CHECK(cylint_count(&pack, &line->line, enough) ==
              (count < enough ? count : enough));
    if (check_bad > bad && check_bad <= CHECK_SHOWN)
        show(line, &cases[nearest < n ? nearest : 0]);
}

/* ---------------------------------------------------------------- input -- */

static struct family_case drawn[MOST], lined[MOST];

static void draw(int family, uint64_t first, size_t n)
{
    for (size_t i = 0; i < n; i++)
        family_case(seed(), family, first + i, &drawn[i]);
}

/* All families in turn, with all kinds and ends and some invalid cases. */
static void draw_mixed(size_t n)
{
    for (size_t i = 0; i < n; i++) {
        struct family_case *c = &drawn[i];
        family_case(seed() + 7, (int)(i % (size_t)family_count()), i, c);
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
        if (i % 2)
            continue;
        for (int k = 0; k < 3; k++) {
            const double step = c->line.d[k] * ((double)i / 8);
            c->line_data[k] += step;
            if (c->line_word == FAMILY_SEGMENT)
                c->line_data[3 + k] += step;
        }
        family_make(c);
    }
}

/* ----------------------------------------------------------------- tests -- */

static void kernels_are_chosen_by_name(void)
{
    int n = 0;
    while (cylint_kernels_name(n))
        n++;
    CHECK(n > 0);
    CHECK(strcmp(cylint_kernels_name(n - 1), "plain") == 0);
    CHECK(!cylint_use_kernels("no such kernels"));
    CHECK(cylint_use_kernels("plain"));
    CHECK(!cylint_use_kernels(""));
    CHECK(strcmp(cylint_kernels_in_use(), "plain") == 0);
    CHECK(cylint_use_kernels(NULL));
    CHECK(strcmp(cylint_kernels_in_use(), cylint_kernels_name(0)) == 0);
}

static void pairs_answer_as_single_questions(void)
{
    for (int family = 0; family < family_count(); family++) {
        draw(family, 0, MOST);
        check_pairs(drawn, MOST, &usual);
        check_pairs(drawn, MOST, &without_members);
    }
    draw_mixed(MOST);
    check_pairs(drawn, MOST, &usual);
}

static void lines_answer_as_single_questions(void)
{
    for (int family = 0; family < family_count(); family++) {
        draw(family, 1000, MOST);
        for (size_t i = 0; i < lines_per_family(); i++) {
            slide(&drawn[i], 100);
            check_lines(&drawn[i], lined, 100,
                        i % 2 ? &usual : &without_members);
        }
        check_lines(&drawn[lines_per_family()], drawn, MOST, &usual);
    }
}

static void shapes_answer_as_single_questions(void)
{
    for (int family = 0; family < family_count(); family++) {
        draw(family, 2000, 100);
        for (size_t i = 0; i < lines_per_family(); i++)
            check_shapes(&drawn[i], drawn, 100,
                         i % 2 ? &usual : &without_members);
    }
    draw_mixed(MOST);
    for (size_t i = 0; i < 2 * lines_per_family(); i++)
        check_shapes(&drawn[i], drawn, MOST, &usual);
}

static void packs_answer_as_a_loop_over_all_shapes(void)
{
    for (int family = 0; family < family_count(); family++) {
        draw(family, 3000, 60);
        for (size_t i = 0; i < lines_per_family(); i++)
            check_scene(&drawn[i], drawn, 60, &usual);
    }
    draw_mixed(MOST);
    for (size_t i = 0; i < 2 * lines_per_family(); i++)
        check_scene(&drawn[i], drawn, MOST, &usual);
}

/* Shapes of one kind with the same ends, so that all lanes are of one run. */
static void runs_of_one_kind_answer_as_single_questions(void)
{
    const int families = family_count();
    for (int kind = FAMILY_CYLINDER; kind <= FAMILY_ECONE; kind++) {
        for (int ends = CYLINT_ENDS_CAPPED; ends <= CYLINT_ENDS_NAPPE; ends++) {
            uint64_t index = 5000;
            for (size_t n = 0; n < 120; index++) {
                struct family_case *c = &drawn[n];
                family_case(seed(), (int)(index % (uint64_t)families), index,
                            c);
                c->ends = (cylint_ends)ends;
                n += (int)c->shape_word == kind && family_make(c);
            }
            check_pairs(drawn, 120, &usual);
            for (size_t i = 0; i < 4; i++) {
                check_shapes(&drawn[i], drawn, 120, &usual);
                check_scene(&drawn[i], drawn, 120, &usual);
                check_lines(&drawn[i], drawn, 120, &usual);
            }
        }
    }
}

static void check_all(size_t n, const struct layout *at)
{
    check_pairs(drawn, n, at);
    check_lines(&drawn[0], lined, n, at);
    check_shapes(&drawn[0], drawn, n, at);
    check_scene(&drawn[0], drawn, n, at);
}

/* A case of one family: its shape among others, its line moved along itself. */
static void draw_around(int family)
{
    draw_mixed(MOST);
    family_case(seed(), family, 0, &drawn[0]);
    slide(&drawn[0], MOST);
}

static void every_length_has_its_answers(void)
{
    static const size_t longer[] = {31,  255, 256, 257, 263,
                                    264, 511, 513, MOST};
    draw_around(0);
    for (size_t n = 0; n <= 2 * 8 + 1; n++) {
        struct layout at = usual;
        check_all(n, &at);
        at.at_end = 0;
        check_all(n, &at);
    }
    for (size_t i = 0; i < sizeof longer / sizeof *longer; i++)
        check_all(longer[i], &usual);
}

static void every_address_has_its_answers(void)
{
    for (int family = 0; family < 2; family++) {
        draw_around(family);
        for (size_t offset = 0; offset < 64; offset++) {
            const struct layout front = {offset, 0, ALL_COLUMNS, 3};
            const struct layout back = {offset, 1, ALL_COLUMNS, 3};
            check_all(FEW, &front);
            check_all(FEW, &back);
        }
    }
}

static void only_wanted_columns_are_written(void)
{
    draw_around(0);
    for (int i = 0; i <= WITHOUT_MEMBERS + COLUMNS; i++) {
        const int columns =
            i <= WITHOUT_MEMBERS ? i : 1 << (i - WITHOUT_MEMBERS - 1);
        const struct layout at = {0, columns % 2, columns, 3};
        check_pairs(drawn, 40, &at);
        check_lines(&drawn[0], lined, 40, &at);
        check_shapes(&drawn[0], drawn, 40, &at);
    }
}

static void without_a_domain_lines_are_rays(void)
{
    draw_around(0);
    for (int domain = 0; domain < 4; domain++) {
        const struct layout at = {0, 0, ALL_COLUMNS, domain};
        check_pairs(drawn, 100, &at);
        check_lines(&drawn[0], lined, 100, &at);
    }
}

static void segments_keep_the_low_parts_of_their_directions(void)
{
    int n_drawn = 0;
    draw_mixed(100);
    for (uint64_t i = 0; n_drawn < 60 && i < 100000; i++) {
        struct family_case c;
        family_case(seed(), (int)(i % (uint64_t)family_count()), i, &c);
        if (c.line_word != FAMILY_SEGMENT ||
            (c.line.d_lo[0] == 0 && c.line.d_lo[1] == 0 && c.line.d_lo[2] == 0))
            continue;
        drawn[n_drawn++] = c;
        check_shapes(&c, drawn, 100, &usual);
        check_scene(&c, drawn, 100, &usual);
    }
    CHECK(n_drawn == 60);
}

/* A cylinder about the z axis, and a line that crosses it. */
static void make_easy(struct family_case *c)
{
    static const double shape[7] = {0, 0, 0, 0, 0, 4, 1};
    static const double line[6] = {-3, 0.25, 1, 1, 0.125, 0.25};
    memset(c, 0, sizeof *c);
    c->line_word = FAMILY_RAY;
    c->shape_word = FAMILY_CYLINDER;
    memcpy(c->shape_data, shape, sizeof shape);
    memcpy(c->line_data, line, sizeof line);
    family_make(c);
}

static void an_invalid_line_misses(void)
{
    static const double wrong[] = {NAN, HUGE_VAL, -HUGE_VAL};
    struct family_case bad[40];
    int n = 0;
    for (int i = 0; i < 40; i++)
        make_easy(&bad[i]);
    for (int k = 0; k < 6; k++)
        for (int w = 0; w < 3; w++, n++) {
            cylint_line *l = &bad[2 * n % 40].line;
            (k < 3 ? l->o : l->d)[k % 3] = wrong[w];
            l->valid = 0;
        }
    memset(bad[36].line.d, 0, sizeof bad[36].line.d);
    bad[37].line.tmin = 1e300;
    bad[37].line.tmax = -1e300;
    bad[38].line.tmin = NAN;
    bad[39].line.tmax = NAN;
    check_lines(&bad[0], bad, 40, &usual);
    check_pairs(bad, 40, &usual);
    for (int i = 36; i < 40; i++)
        CHECK(!column_line(&bad[i].line, 3).valid);
    check_shapes(&bad[0], bad, 40, &usual);
    check_scene(&bad[0], bad, 40, &usual);
}

/* tmin is just above tmax, near every hit of the line. */
static void an_empty_domain_misses(void)
{
    struct family_case lines[FEW];
    for (int i = 0; i < FEW; i++) {
        make_easy(&lines[i]);
        lines[i].line.tmin = 3 + i / 8.;
        lines[i].line.tmax = 3;
    }
    check_lines(&lines[0], lines, FEW, &usual);
    check_pairs(lines, FEW, &usual);
}

/* The hard line is in every lane in turn, among easy ones. */
static void a_hard_lane_does_not_disturb_its_neighbours(void)
{
    static const double hard[][6] = {
        {1, -3, 1, 0, 1, 0},        /* touches: x = 1 */
        {1, 0, -3, 0, 0, 1},        /* along a ruling */
        {0.5, 0, -3, 0, 0, 1},      /* parallel, inside */
        {2, 0, -3, 0, 0, 1},        /* parallel, outside */
        {-3, 0, 0, 1, 0, 0},        /* in a cap's plane */
        {-1, 0, 4, 1, 0, -0.5},     /* from the rim */
        {1, -3e155, 1, 0, 1e300, 0} /* touches, outside the filter's range */
    };
    struct family_case cases[FEW];
    for (size_t h = 0; h < sizeof hard / sizeof *hard; h++) {
        for (int lane = 0; lane < FEW; lane++) {
            for (int i = 0; i < FEW; i++)
                make_easy(&cases[i]);
            memcpy(cases[lane].line_data, hard[h], sizeof hard[h]);
            family_make(&cases[lane]);
            check_lines(&cases[0], cases, FEW, &usual);
            check_pairs(cases, FEW, &usual);
        }
    }
}

static void a_hard_shape_does_not_disturb_its_neighbours(void)
{
    struct family_case cases[FEW], easy;
    make_easy(&easy);
    for (int lane = 0; lane < FEW; lane++) {
        for (int i = 0; i < FEW; i++) {
            cases[i] = easy;
            cases[i].shape_data[6] = 1 + i / 64.;
            family_make(&cases[i]);
        }
        /* lines in the plane y = 1 touch the one with radius 1 */
        struct family_case line = easy;
        const double touching[6] = {-3, 1, 1, 1, 0, 0};
        memcpy(line.line_data, touching, sizeof touching);
        family_make(&line);
        cases[lane].shape_data[6] = 1;
        family_make(&cases[lane]);
        check_shapes(&line, cases, FEW, &usual);
        check_scene(&line, cases, FEW, &usual);
    }
}

/* The same cylinder in four forms. */
static void make_in_another_form(struct family_case *c, int form)
{
    static const double data[4][13] = {{0, 0, 0, 0, 0, 4, 1},
                                       {0, 0, 0, 1, 0, 0, 4, 1},
                                       {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 4},
                                       {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 4, 1}};
    static const family_shape word[4] = {FAMILY_CYLINDER, FAMILY_CONE,
                                         FAMILY_ECYLINDER, FAMILY_ECONE};
    make_easy(c);
    c->shape_word = word[form];
    memcpy(c->shape_data, data[form], sizeof data[form]);
    family_make(c);
}

static void the_lower_number_is_nearest_for_equal_t(void)
{
    struct family_case cases[FEW], line;
    make_easy(&line);
    for (int turn = 0; turn < 24; turn++) {
        const int ahead = turn / 4; /* shapes that are missed or hit later */
        for (int i = 0; i < FEW; i++) {
            make_in_another_form(&cases[i], (i + turn) % 4);
            if (i < ahead) {
                cases[i].shape_data[0] += i % 2 ? 0 : 100;
                cases[i].shape_data[0] += 0.25;
            }
            family_make(&cases[i]);
        }
        cylint_pack pack;
        cylint_hit hit;
        CHECK(lay_pack(&pack, cases, FEW, &usual));
        const size_t first =
            cylint_nearest(&pack, &line.line, CYLINT_WANT_T, &hit);
        CHECK(first == (size_t)ahead);
        check_scene(&line, cases, FEW, &usual);
    }
}

/* -------------------------------------------------------------- threads -- */

struct share {
    const cylint_pack *pack;
    size_t nearest[MOST], count[MOST];
    double t[MOST], t0[MOST];
};

static void *query_all(void *at)
{
    struct share *s = at;
    cylint_columns columns = {0};
    columns.t0 = s->t0;
    for (size_t i = 0; i < MOST; i++) {
        cylint_hit hit = {0};
        s->nearest[i] =
            cylint_nearest(s->pack, &drawn[i].line, CYLINT_WANT_T, &hit);
        s->t[i] = hit.t;
        s->count[i] = cylint_count(s->pack, &drawn[i].line, 0);
        cylint_intersect_shapes(s->pack, &drawn[i].line, &columns);
    }
    return NULL;
}

static void threads_share_a_pack(void)
{
    static struct share of[2];
    pthread_t thread[2];
    cylint_pack pack;
    draw_mixed(MOST);
    CHECK(lay_pack(&pack, drawn, MOST, &usual));
    for (int i = 0; i < 2; i++) {
        of[i].pack = &pack;
        CHECK(pthread_create(&thread[i], NULL, query_all, &of[i]) == 0);
    }
    for (int i = 0; i < 2; i++)
        CHECK(pthread_join(thread[i], NULL) == 0);
    CHECK(same_bytes(&of[0].nearest, &of[1].nearest, sizeof of[0].nearest));
    CHECK(same_bytes(&of[0].count, &of[1].count, sizeof of[0].count));
    CHECK(same_bytes(&of[0].t, &of[1].t, sizeof of[0].t));
    CHECK(same_bytes(&of[0].t0, &of[1].t0, sizeof of[0].t0));
}

int main(void)
{
    const char *kernels;
    if (family_count() == 0) {
        return check_skip("no GSL: no families to draw from (make deps)");
    }
    allocate_pages();
    RUN(kernels_are_chosen_by_name);
    RUN(threads_share_a_pack);
    for (int i = 0; (kernels = cylint_kernels_name(i)) != NULL; i++) {
        cylint_use_kernels(kernels);
        RUN(pairs_answer_as_single_questions);
        RUN(lines_answer_as_single_questions);
        RUN(shapes_answer_as_single_questions);
        RUN(packs_answer_as_a_loop_over_all_shapes);
        RUN(runs_of_one_kind_answer_as_single_questions);
        RUN(every_length_has_its_answers);
        RUN(every_address_has_its_answers);
        RUN(only_wanted_columns_are_written);
        RUN(without_a_domain_lines_are_rays);
        RUN(segments_keep_the_low_parts_of_their_directions);
        RUN(an_invalid_line_misses);
        RUN(an_empty_domain_misses);
        RUN(a_hard_lane_does_not_disturb_its_neighbours);
        RUN(a_hard_shape_does_not_disturb_its_neighbours);
        RUN(the_lower_number_is_nearest_for_equal_t);
    }
    return check_end();
}
