/*
 * test_paths.c - every call has the same answers, with every build of the kernels,
 * in every floating-point environment
 *
 * A group of lines and shapes is answered one by one in the default
 * environment, with all members.  The calls of `paths`, with other members
 * wanted, must return the same bits, in an environment and with kernels that
 * change from group to group; every second group is also made there.  The
 * groups are those of the families; exact coincidences and their neighbours;
 * plain numbers; and numbers of extreme exponents, which are answered in each
 * environment.  Many domains begin or end at a hit, or one double beside it.
 *
 * CYLINT_CASES is the number of groups of each kind, CYLINT_SEED changes them.
 * The program prints a digest of all answers, which must be the same from all
 * compilers (tests/package/cross.sh), with one C library: its pow() and cos() place
 * the cases of families.
 */
#include <float.h>
#include <math.h>

#define CHECK_OWN_MAIN
#include "answers.h"
#include "check.h"
#include "columns.h"
#include "environment.h"
#include "ulps.h"

enum { GROUP = 8, GROUPS = 8, EXTREME_GROUPS = 3 };

/* ------------------------------------------------------------- a group -- */

static struct {
    struct family_case c[GROUP]; /* line i and shape i */
    cylint_shape shape[GROUP];
    cylint_answer all[GROUP][GROUP];    /* of line i and shape j */
    cylint_answer column[GROUP][GROUP]; /* of line i as a batch reads it */
    int side[GROUP][GROUP];             /* of line i's origin in shape j */
    struct line_answers due[GROUP];     /* of line i and all shapes */
    cylint_scene *scene;
    char name[80];
} g;

static cylint_answer intersect(const cylint_shape *shape,
                               const cylint_line *line, unsigned want)
{
    cylint_answer a;
    memset(&a, 0, sizeof a);
    cylint_intersect(shape, line, want, &a);
    return a;
}

static void answer_one_by_one(void)
{
    for (int i = 0; i < GROUP; i++) {
        const cylint_line *line = &g.c[i].line;
        const cylint_line as_column = column_line(line, 3);
        line_by_loop(g.shape, GROUP, line, &g.due[i]);
        for (int j = 0; j < GROUP; j++) {
            g.all[i][j] = intersect(&g.shape[j], line, CYLINT_WANT_ALL);
            g.column[i][j] =
                intersect(&g.shape[j], &as_column, CYLINT_WANT_ALL);
            g.side[i][j] = cylint_contains(&g.shape[j], line->o);
        }
    }
}

/* Line i beside shape j, for a report. */
static struct family_case pair_of(int i, size_t j)
{
    struct family_case c = g.c[j];
    c.line_word = g.c[i].line_word;
    memcpy(c.line_data, g.c[i].line_data, sizeof c.line_data);
    return c;
}

static void failed(int i, size_t j, const char *path, unsigned want)
{
    const struct family_case c = pair_of(i, j);
    REPORT("%s, %s, members %#x, kernels %s:", g.name, path, want,
           cylint_kernels_in_use());
    REPORT_CASE(&c);
}

static void expect(int holds, int i, size_t j, const char *path, unsigned want)
{
    if (!CHECK(holds))
        failed(i, j, path, want);
}

/* ------------------------------------------------------------ the paths -- */

static unsigned any_want(void)
{
    return (unsigned)whole_between(0, EVERY_WANT);
}

/* The statuses and the hits of each line with each shape; of its own shape with
 * several sets of members. */
static void single_questions(int i)
{
    for (size_t j = 0; j < GROUP; j++) {
        for (int k = (size_t)i == j ? 16 : 1; k > 0; k--) {
            const unsigned want = any_want();
            const cylint_answer got =
                intersect(&g.shape[j], &g.c[i].line, want);
            expect(same_answer(&got, &g.all[i][j], want), i, j, "one question",
                   want);
        }
        expect(cylint_occluded(&g.shape[j], &g.c[i].line) ==
                   (g.all[i][j].n > 0),
               i, j, "occluded", 0);
        expect(cylint_contains(&g.shape[j], g.c[i].line.o) == g.side[i][j], i,
               j, "contains", 0);
    }
}

/* Members of a hit of which t, part and side are known. */
static void described_hits(int i)
{
    for (size_t j = 0; j < GROUP; j++)
        for (int k = 0; k < g.all[i][j].n; k++) {
            const unsigned want = any_want();
            const cylint_hit *due = &g.all[i][j].hit[k];
            cylint_hit got = {
                .t = due->t, .part = due->part, .side = due->side};
            cylint_describe(&g.shape[j], &g.c[i].line, want, &got);
            expect(same_hit(&got, due, want | CYLINT_WANT_T | CYLINT_WANT_PART),
                   i, j, "describe", want);
        }
}

static double numbers[COLUMNS][GROUP], input[8][GROUP];
static signed char words[COLUMNS][GROUP];
static char memory[1 << 14];

/* The columns of some of the members. */
static void some_columns(void *p[COLUMNS], cylint_columns *to)
{
    const int wanted =
        whole_between(0, 3) ? whole_between(0, ALL_COLUMNS) : ALL_COLUMNS;
    for (int c = 0; c < COLUMNS; c++)
        p[c] = !(wanted >> c & 1)    ? NULL
               : column_size(c) == 1 ? (void *)words[c]
                                     : (void *)numbers[c];
    *to = columns_of(p);
}

static cylint_lines all_lines(void)
{
    double *array[8];
    for (int k = 0; k < 8; k++)
        array[k] = input[k];
    for (int i = 0; i < GROUP; i++)
        set_columns(&g.c[i].line, array, (size_t)i);
    return lines_of(array, GROUP, 3);
}

static cylint_pack pack_all(void)
{
    cylint_pack pack = {0};
    if (CHECK(cylint_pack_bytes(GROUP) <= sizeof memory))
        cylint_pack_shapes(&pack, memory, g.shape, GROUP);
    return pack;
}

/* This line and all shapes, all lines and this shape, and once all pairs. */
static void batches(int i)
{
    const cylint_pack pack = pack_all();
    const cylint_lines lines = all_lines();
    void *p[COLUMNS];
    cylint_columns to;
    some_columns(p, &to);
    cylint_intersect_shapes(&pack, &g.c[i].line, &to);
    for (size_t j = 0; j < GROUP; j++)
        expect(is_column_answer(p, j, &g.all[i][j]), i, j, "shapes", 0);
    some_columns(p, &to);
    cylint_intersect_lines(&g.shape[i], &lines, &to);
    for (int j = 0; j < GROUP; j++)
        expect(is_column_answer(p, (size_t)j, &g.column[j][i]), j, (size_t)i,
               "lines", 0);
    if (i > 0)
        return;
    some_columns(p, &to);
    cylint_intersect_pairs(&pack, &lines, &to);
    for (int j = 0; j < GROUP; j++)
        expect(is_column_answer(p, (size_t)j, &g.column[j][j]), j, (size_t)j,
               "pairs", 0);
}

static void nearest_of_a_pack(int i)
{
    const cylint_pack pack = pack_all();
    const unsigned want = any_want();
    expect(pack_agrees(&pack, &g.c[i].line, want, &g.due[i]), i,
           g.due[i].nearest[0] % GROUP, "nearest or count of a pack", want);
}

static void queries_of_a_scene(int i)
{
    static struct line_answers got;
    const unsigned want = any_want();
    cylint_hit hit;
    memset(&hit, UNTOUCHED, sizeof hit);
    const size_t near = cylint_scene_nearest(g.scene, &g.c[i].line, want, &hit);
    expect(is_nearest_of(GROUP, near, &hit, want, &g.due[i]), i, near % GROUP,
           "nearest of a scene", want);
    line_in_scene(g.scene, &g.c[i].line, &got);
    expect(same_line_answers(&got, &g.due[i]), i, (size_t)i, "a scene", 0);
}

static void (*const paths[])(int) = {single_questions, described_hits, batches,
                                     nearest_of_a_pack, queries_of_a_scene};

/* ------------------------------------------------------------- groups --- */

static uint64_t digest = UINT64_C(0xcbf29ce484222325);
static long met, hit, pairs;

/* FNV-1a of numbers that are the same on every machine. */
static void digest_number(uint64_t x)
{
    for (int i = 0; i < 8; i++)
        digest = (digest ^ (x >> 8 * i & 0xff)) * UINT64_C(0x100000001b3);
}

static void digest_answers(void)
{
    for (int i = 0; i < GROUP; i++)
        for (int j = 0; j < GROUP; j++) {
            const cylint_answer *a = &g.all[i][j];
            pairs++;
            met += a->relation != CYLINT_RELATION_MISS;
            hit += a->n > 0;
            digest_number((uint64_t)(a->relation * 4 + a->n));
            for (int k = 0; k < a->n; k++) {
                uint64_t t;
                memcpy(&t, &a->hit[k].t, sizeof t);
                digest_number((uint64_t)(a->hit[k].part * 4 + a->hit[k].side));
                digest_number(t);
            }
        }
}

/* Makes the lines and shapes again in the present environment. */
static void make_again(void)
{
    for (int i = 0; i < GROUP; i++) {
        struct family_case made = g.c[i];
        const cylint_line limited = g.c[i].line;
        family_make(&made);
        made.line.tmin = limited.tmin;
        made.line.tmax = limited.tmax;
        CHECK(made.line_status == g.c[i].line_status &&
              made.shape_status == g.c[i].shape_status);
        g.c[i] = made;
        g.shape[i] = made.shape;
    }
}

/* Domains that begin or end at or beside a hit of the line and one of the
 * shapes. */
static void limit_domains(void)
{
    for (int i = 0; i < GROUP; i++) {
        const cylint_answer *a = &g.all[i][i];
        cylint_line *line = &g.c[i].line;
        if (a->n == 0 || line->segment || whole_between(0, 1))
            continue;
        for (int end = 0; end < 2; end++) {
            const double t = a->hit[end * (a->n - 1)].t;
            if (fabs(t) < DBL_MAX && whole_between(0, 2))
                *(end ? &line->tmax : &line->tmin) =
                    stepped(t, whole_between(-1, 1));
        }
        if (!(line->tmin <= line->tmax)) {
            const double tmin = line->tmax;
            line->tmax = line->tmin;
            line->tmin = tmin;
        }
    }
    answer_one_by_one();
}

/* A scene that is made there, or in the default environment, of shapes that are
 * made there, and added in two blocks, returns them. */
static cylint_scene *scene_of_shapes_made(struct environment there,
                                          int is_made_there)
{
    cylint_scene *scene = cylint_scene_begin(0);
    make_again();
    if (!is_made_there)
        environment_reset();
    cylint_scene_add(scene, g.shape, 3);
    cylint_scene_add(scene, g.shape + 3, GROUP - 3);
    CHECK(cylint_scene_finish(scene, 1, NULL, NULL) == CYLINT_SCENE_OK);
    environment_set(there);
    for (size_t j = 0; j < GROUP; j++) {
        cylint_shape back;
        cylint_scene_shape(scene, j, &back);
        expect(same_bytes(&back, &g.shape[j], sizeof back), (int)j, j, "shape",
               0);
    }
    return scene;
}

static void answer_there(struct environment there, int are_made_there)
{
    cylint_scene *scene = g.scene;
    environment_set(there);
    if (are_made_there)
        g.scene = scene_of_shapes_made(there, one_of(2));
    for (size_t k = 0; k < sizeof paths / sizeof *paths; k++)
        for (int i = 0; i < GROUP; i++)
            paths[k](i);
    environment_reset();
    if (are_made_there)
        cylint_scene_free(g.scene);
    g.scene = scene;
}

/* g.c is drawn.  each: in each environment, else in one of them. */
static void test_group(uint64_t number, int each)
{
    for (int i = 0; i < GROUP; i++)
        g.shape[i] = g.c[i].shape;
    use_some_kernels(number / 2);
    answer_one_by_one();
    limit_domains();
    digest_answers();
    g.scene = cylint_scene_new(g.shape, GROUP, 1, NULL);
    if (!CHECK(g.scene))
        return;
    EACH_ENVIRONMENT(there)
        if (each || there.number == (int)(number % ENVIRONMENTS))
            answer_there(there, (int)(number / ENVIRONMENTS + number) % 2);
    cylint_scene_free(g.scene);
}

static uint64_t groups(uint64_t usual)
{
    return check_setting("CYLINT_CASES", usual);
}

static void begin_group(uint64_t kind, uint64_t number)
{
    stream = check_seed() + kind * UINT64_C(0x9e3779b97f4a7c15);
    stream = random_bits(&stream) + number;
}

/* each: in each environment. */
static void test_family(int family, uint64_t n_groups, int each)
{
    for (uint64_t k = 0; k < n_groups; k++) {
        begin_group((uint64_t)family, k);
        for (uint64_t i = 0; i < GROUP; i++)
            family_case(check_seed(), family, k * GROUP + i, &g.c[i]);
        snprintf(g.name, sizeof g.name, "family %s, group %d",
                 family_name(family), (int)k);
        test_group((uint64_t)family + 5 * k, each);
    }
}

TEST(families_have_the_same_answers)
{
    for (int family = 0; family < family_count(); family++)
        test_family(family,
                    groups(family_is_wild(family) ? GROUPS / 4 : GROUPS), 0);
}

TEST(coincidences_have_the_same_answers)
{
    for (uint64_t k = 0; k < 4 * groups(GROUPS); k++) {
        begin_group(200, k);
        for (uint64_t i = 0; i < GROUP; i++) {
            const char *family = i % 4 == 3 ? "plain" : "constructed";
            family_case(check_seed(), family_named(family), k * GROUP + i,
                        &g.c[i]);
        }
        snprintf(g.name, sizeof g.name, "coincidences %d", (int)k);
        test_group(k, 0);
    }
}

TEST(extreme_exponents_have_the_same_answers)
{
    static const char *const names[] = {"wild", "extreme, few digits",
                                        "constructed, any exponents"};
    for (int i = 0; i < 3; i++)
        test_family(family_named(names[i]), groups(EXTREME_GROUPS), 1);
}

/* --------------------------------------------------- subnormal numbers -- */

static double units(int most)
{
    return whole_between(-most, most) * 0x1p-1074;
}

/* Lines along z and discs that they hit at a few units; lines of a few units, whose
 * domain is often empty by one, and discs with subnormal axes or large factors. */
static void subnormal_case(int discs, struct family_case *c)
{
    static const double rods[][7] = {
        {0, 0, -0x1p-1074, 0, 0, 0x1p-1073, 0x1p-1030},
        {0, 0, -1, 0, 0, 1, 1},
        {0, 0, 0, 0, 0x1p-1057, 0, 7},
        {0, 0, 0, 0, 0x1p-600, 0, 7}};
    static const double cones[][13] = {
        {3, 0, 0, 0x1p-1057, 0, 0, 0, 0x1p-1057, 0, 0, 0, 1, DBL_MAX},
        {3, 0, 0, 0x1p-600, 0, 0, 0, 0x1p-600, 0, 0, 0, 1, 0x1p600},
        {3, 0, 0, 0x1p-500, 0, 0, 0, 0x1p-500, 0, 0, 0, 1, 0x1p500}};
    const double unit = whole_between(0, 2) ? 0x1p-1074 : 0x1p-1030;
    const double z = units(9), r = 1 + 0.01 * whole_between(0, 9);
    const double disc[7] = {0, 0, z, 0, 0, 1, r};
    const double across[8] = {3, -5, 0.5, 0, 1, 0, 0, HUGE_VAL};
    double line[8] = {0, 0, 0, 0, 0, 1, -1, 1};
    const int kind = whole_between(0, 6);
    for (int i = 0; i < 6 && !discs; i++)
        line[i] = whole_between(-5, 5) * unit;
    if (whole_between(0, 1)) {
        line[6] = units(4);
        line[7] = line[6] + units(3);
    }
    *c = discs ? family_of(FAMILY_SPAN, line, FAMILY_CYLINDER, disc)
         : kind < 4
             ? family_of(FAMILY_SPAN, line, FAMILY_CYLINDER, rods[kind])
             : family_of(FAMILY_SPAN, across, FAMILY_ECONE, cones[kind - 4]);
    if (kind == 1)
        c->ends = CYLINT_ENDS_INFINITE;
}

TEST(subnormal_numbers_have_the_same_answers)
{
    for (uint64_t k = 0; k < 2 * groups(GROUPS); k++) {
        begin_group(400, k);
        for (int i = 0; i < GROUP; i++) {
            subnormal_case((int)k % 2, &g.c[i]);
            family_make(&g.c[i]);
        }
        snprintf(g.name, sizeof g.name, "subnormal numbers %d", (int)k);
        test_group(k, 1);
    }
}

/* Differences of coordinates are rounded, and overflow where they are scaled. */
TEST(the_largest_exponents_have_the_same_answers)
{
    static const char *const records[2] = {
        "segment 0x0.008p-1022 -3.5 0  0 -0x1.fffffffffffffp1023 -0.5  "
        "ecylinder 0x0.03p-1022 -3 0x1p-1023  -0x1p-1023 0x1p-1023 0  "
        "-0x0.028p-1022 0x1p-1023 -0x1p-1074  0x1p-1074 0 0x0.01p-1022  "
        "ends=infinite",
        "segment -0x1.8p1002 0x1.8p1002 0  0 -0x1p1002 -0x1p1001  "
        "cone 0 -1 0 0x1.8p702  "
        "0 0x1.fffffffffffffp1023 0 0x1.fffffffffffffp1023"};
    begin_group(500, 0);
    for (int i = 0; i < GROUP; i++)
        g.c[i] = case_of(records[i % 2]);
    snprintf(g.name, sizeof g.name, "largest exponents");
    test_group(0, 1);
    CHECK(g.all[0][0].n == 0 && g.all[0][0].relation == CYLINT_RELATION_CROSS);
    CHECK(g.all[1][1].n == 1 && g.all[1][1].hit[0].t == 0x1.7ffff7p-300 &&
          g.all[1][1].hit[0].side == CYLINT_SIDE_LEAVING);
}

int main(void)
{
    const int failed = check_all();
    cylint_use_kernels(NULL);
    printf("note: of %ld lines and shapes %.0f %% meet, %.0f %% hit; digest "
           "%016llx\n",
           pairs, 100. * (double)met / (double)pairs,
           100. * (double)hit / (double)pairs, (unsigned long long)digest);
    return failed;
}
