/*
 * test_pieces.c - the pieces of a line in solids, its first boundary, and the depth
 * of points, against a loop over all cells; the pieces and sums of many lines
 *
 * piece_world.h makes the scenes and gives the expected pieces.
 *
 * CYLINT_CASES: scenes in each test.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "check.h"
#include "columns.h"
#include "cylint_scene.h"
#include "environment.h"
#include "piece_world.h"
#ifdef HAVE_MPFR
#include "real.h"
#endif

/* -------------------------------------------------------------- pieces -- */

/* `capacity` pieces at a time. */
static size_t resumed(const cylint_piece_rule *rule, cylint_piece *to,
                      size_t capacity)
{
    cylint_line line = world.line;
    cylint_piece_rule next = *rule;
    size_t n = 0, more;
    do {
        more = pieces_in_world(&line, &next, to + n, capacity);
        n += more;
        if (n > 0 && rule->mode == CYLINT_PIECES_CHORDS)
            next.after = &to[n - 1];
        else if (n > 0)
            line.tmin = to[n - 1].t1;
    } while (more == capacity);
    return n;
}

static long pieces_compared;

static void check_rule(const cylint_piece_rule *rule)
{
    static cylint_piece expected[MOST], got[MOST];
    static const size_t capacities[] = {1, 2, 3, 4, 5, 7, MOST};
    const size_t n = expected_pieces(rule, expected);
    for (size_t i = 0; i < sizeof capacities / sizeof *capacities; i++) {
        const size_t m = resumed(rule, got, capacities[i]);
        pieces_compared += (long)m;
        if (!CHECK(same_pieces(expected, n, got, m)))
            REPORT("mode %d, %zu at a time: %zu pieces, not %zu", rule->mode,
                   capacities[i], m, n);
    }
}

static void check_rules(void)
{
    for (int mode = CYLINT_PIECES_UNION; mode <= CYLINT_PIECES_CHORDS; mode++)
        for (int ranked = 0; ranked < 2; ranked++) {
            const cylint_piece_rule rule = {.mode = (cylint_piece_mode)mode,
                                            .rank = ranked ? world.rank : NULL};
            check_rule(&rule);
        }
}

/* ------------------------------------------------------ first boundary -- */

typedef struct {
    size_t number; /* world.n: there is none */
    double t;
    int enters, is_complement;
} boundary;

/* Whether the line enters or leaves the solid of this number by shape i at the
 * boundary; a touch is neither.  Then writes the hit; that of a complement has the
 * other side and the opposite normal. */
static int is_surface(size_t i, size_t owner, boundary *b, cylint_hit *hit)
{
    int is_part[2] = {!is_member(i) && i == owner, 0}; /* as a complement */
    cylint_shape shape = world.shape[i];
    const cylint_line whole = whole_of(world.line);
    cylint_answer a;
    for (size_t j = 0; j < world.members; j++)
        if (world.member[j].shape == i &&
            number_of(world.member[j].solid) == owner)
            is_part[world.member[j].clause < 0] = 1;
    if (shape.ends < CYLINT_ENDS_INFINITE)
        shape.ends = CYLINT_ENDS_CAPPED;
    cylint_intersect(&shape, &whole, CYLINT_WANT_ALL, &a);
    if (a.n == 2 && a.hit[0].t == a.hit[1].t)
        return 0;
    for (int k = 0; k < 2 * a.n; k++) {
        *hit = a.hit[k % a.n];
        b->is_complement = k >= a.n;
        if (!is_part[b->is_complement] || hit->t != b->t ||
            hit->side != (b->enters != b->is_complement ? CYLINT_SIDE_ENTERING
                                                        : CYLINT_SIDE_LEAVING))
            continue;
        hit->side = b->enters ? CYLINT_SIDE_ENTERING : CYLINT_SIDE_LEAVING;
        for (int j = 0; j < 3 && b->is_complement; j++)
            hit->normal[j] = 0 - hit->normal[j];
        return 1;
    }
    return 0;
}

/* Of world.line; its chords are known. */
static boundary expected_boundary(cylint_hit *hit)
{
    static cylint_piece piece[MOST];
    const cylint_piece_rule unions = {.mode = CYLINT_PIECES_UNION},
                            owners = {.mode = CYLINT_PIECES_OWNER};
    boundary b = {.number = world.n};
    if (expected_pieces(&unions, piece) == 0)
        return b;
    b.enters = piece[0].t0 > world.line.tmin;
    b.t = b.enters ? piece[0].t0 : piece[0].t1;
    if (!(b.t < world.line.tmax))
        return b;
    const size_t n = expected_pieces(&owners, piece);
    size_t i = 0;
    while (i < n && !b.enters && piece[i].t1 != b.t)
        i++;
    b.number = 0;
    while (b.number < world.n && !is_surface(b.number, piece[i].shape, &b, hit))
        b.number++;
    CHECK(i < n && b.number < world.n);
    return b;
}

static size_t first_boundary(unsigned want, cylint_hit *hit)
{
    cylint_workspace work = any_workspace();
    size_t n;
    do
        n = cylint_scene_first_boundary(world.scene, &world.line, want, hit,
                                        &work);
    while (needs_more(n, &work));
    return n;
}

static long boundaries, in_bores;

static void check_boundary(void)
{
    cylint_hit got, expected;
    const boundary b = expected_boundary(&expected);
    const double *d = world.line.d;
    const size_t n = first_boundary(CYLINT_WANT_ALL, &got);
    if (!CHECK(n == b.number))
        REPORT("shape %zu, not %zu, at t %a", n, b.number, b.t);
    if (n != b.number || n == world.n)
        return;
    boundaries++;
    in_bores += b.is_complement;
    if (!CHECK(same_hit(&got, &expected, CYLINT_WANT_ALL)))
        REPORT("shape %zu, t %a, part %d, side %d", n, got.t, got.part,
               got.side);
    const double along = dot3(d, got.normal);
    CHECK(b.enters ? along <= 1e-14 : along >= -1e-14);
    const unsigned want = (unsigned)below(CYLINT_WANT_ALL + 1);
    const cylint_hit due = with_members(&got, want);
    cylint_hit few = with_members(&got, 0);
    CHECK(first_boundary(want, &few) == n);
    CHECK(same_hit(&few, &due, CYLINT_WANT_ALL));
}

/* --------------------------------------------------------------- depth -- */

static size_t expected_depth(const double point[3], const int *rank,
                             size_t *owner)
{
    int in[SHAPES];
    for (size_t i = 0; i < world.n; i++)
        in[i] = cylint_contains(&world.shape[i], point) >= 0;
    const size_t depth = depth_in(in, rank, ALL, owner);
    *owner = *owner == SIZE_MAX ? world.n : *owner;
    return depth;
}

static long points_inside;

static void check_depth(void)
{
    const int *rank = one_of(2) ? world.rank : NULL;
    cylint_workspace work = any_workspace();
    double point[3];
    size_t owner, expected, n;
    whole_point(point, 7);
    if (one_of(2))
        point[one_of(3)] /= 2;
    do
        n = cylint_scene_depth(world.scene, point, rank, &owner, &work);
    while (needs_more(n, &work));
    points_inside += n > 0;
    if (!CHECK(n == expected_depth(point, rank, &expected) &&
               owner == expected))
        REPORT("point %g %g %g: depth %zu, owner %zu, not %zu", point[0],
               point[1], point[2], n, owner, expected);
}

/* -------------------------------------------------------------- worlds -- */

/* The solids of the scene stay. */
static void move_a_shape(void)
{
    const int i = one_of(SHAPES);
    const cylint_shape moved = any_shape();
    if (cylint_scene_refit(world.scene, (size_t)i, 1, &moved) ==
        CYLINT_SCENE_OK)
        world.shape[i] = moved;
}

static void begin_world(void)
{
    make_shapes();
    if (one_of(4))
        make_solids();
}

TEST(pieces_boundaries_and_depths_are_those_of_a_loop)
{
    const long worlds = (long)check_setting("CYLINT_CASES", 120);
    stream = 1;
    for (long i = 0; i < worlds; i++) {
        begin_world();
        for (int j = 0; j < 2 * LINES; j++) {
            const cylint_line line = any_line();
            find_chords(&line);
            check_boundary();
            check_depth();
            if (j % 2 == 0)
                continue;
            check_rules();
            move_a_shape();
        }
    }
    CHECK(pieces_compared > 100 * worlds && points_inside > worlds &&
          boundaries > 10 * worlds && in_bores > worlds / 10);
    printf(
        "note: %ld pieces, %ld boundaries, %ld of them in bores, %ld points in "
        "solids\n",
        pieces_compared, boundaries, in_bores, points_inside);
}

TEST(an_invalid_line_or_point_is_in_no_solid)
{
    const double o[3] = {0, 0, 0}, far[3] = {0, HUGE_VAL, 0};
    cylint_workspace work = {NULL, 0, 0};
    cylint_hit hit;
    size_t owner = 0;
    stream = 4;
    begin_world();
    CHECK(cylint_whole_line(&world.line, o, o) != CYLINT_OK);
    CHECK(cylint_scene_first_boundary(world.scene, &world.line, CYLINT_WANT_ALL,
                                      &hit, &work) == world.n);
    CHECK(cylint_scene_depth(world.scene, far, NULL, &owner, &work) == 0 &&
          owner == world.n);
}

/* A program may change tmin and tmax.  NaN is not allowed, but the search ends. */
TEST(a_line_with_an_empty_domain_has_no_hits_and_no_pieces)
{
    static const double empty[][2] = {
        {1, 0}, {HUGE_VAL, -HUGE_VAL}, {NAN, NAN}, {NAN, 0}};
    static world_answers got;
    cylint_interval chord[2];
    stream = 5;
    begin_world();
    cylint_line line = any_line();
    for (size_t i = 0; i < sizeof empty / sizeof *empty; i++) {
        line.tmin = empty[i][0];
        line.tmax = empty[i][1];
        for (size_t j = 0; j < world.n; j++)
            CHECK(!cylint_occluded(&world.shape[j], &line) &&
                  cylint_chord(&world.shape[j], &line, chord) == 0);
        CHECK(cylint_scene_count(world.scene, &line, 0) == 0);
        answer_all(world.scene, &line, &got);
        CHECK(got.boundary == world.n && got.sum == 0);
        for (int mode = CYLINT_PIECES_UNION; mode <= CYLINT_PIECES_CHORDS;
             mode++)
            CHECK(got.n[mode] == 0);
    }
}

/* --------------------------------------------------------- environment -- */

/* Half of the lines have such long directions that t is subnormal. */
TEST(pieces_are_the_same_in_every_environment)
{
    static world_answers expected, got;
    cylint_line scaled;
    long subnormal_ends = 0;
    stream = 3;
    for (int i = 0; i < 400; i++) {
        const double size = i % 2 ? 0x1p1022 : 1;
        if (i % 40 == 0) {
            make_shapes();
            if (i % 80 == 0)
                make_solids();
        }
        const cylint_line line = any_line();
        const double d[3] = {line.d[0] * size, line.d[1] * size,
                             line.d[2] * size};
        cylint_span(&scaled, line.o, d, line.tmin / size, line.tmax / size);
        answer_all(world.scene, &scaled, &expected);
        EACH_ENVIRONMENT(there) {
            environment_set(there);
            answer_all(world.scene, &scaled, &got);
            environment_reset();
            CHECK(same_bytes(&expected, &got, sizeof got));
        }
        const double t = expected.piece[0][0].t0;
        subnormal_ends += t > 0 && t < DBL_MIN;
    }
    CHECK(subnormal_ends > 0);
}

/* ---------------------------------------------------------- many lines -- */

enum { MANY = 1500, LABELS = 5 };

static double column[8][MANY];
static double *const array[8] = {column[0], column[1], column[2], column[3],
                                 column[4], column[5], column[6], column[7]};
static cylint_line each[MANY];

/* Some of them invalid. */
static cylint_lines many_lines(void)
{
    for (size_t i = 0; i < MANY; i++) {
        cylint_line line = any_line();
        if (one_of(100) == 0)
            memset(line.d, 0, sizeof line.d);
        set_columns(&line, array, i);
        each[i] = column_line(&line, 3);
    }
    return lines_of(array, MANY, 3);
}

static size_t pieces_of(size_t i, const cylint_piece_rule *rule, size_t most,
                        cylint_piece *to)
{
    return pieces_in_world(&each[i], rule, to, most > 0 ? most : MOST);
}

static void check_rows(const cylint_lines *lines, const cylint_piece_rule *rule,
                       size_t most, int threads)
{
    static cylint_piece piece[MOST];
    cylint_piece_rule given = *rule;
    cylint_piece_rows rows;
    given.after = piece; /* is not read */
    const cylint_scene_status status = cylint_scene_pieces_lines(
        world.scene, lines, &given, most, threads, &rows);
    if (!CHECK(status == CYLINT_SCENE_OK && rows.first[0] == 0))
        return;
    for (size_t i = 0; i < lines->n; i++) {
        const size_t n = pieces_of(i, rule, most, piece);
        if (!CHECK(same_pieces(rows.pieces + rows.first[i],
                               rows.first[i + 1] - rows.first[i], piece, n)))
            REPORT("line %zu, %d threads, most %zu", i, threads, most);
    }
    cylint_piece_rows_free(&rows);
    CHECK(!rows.first && !rows.pieces);
}

static cylint_piece_rule any_rule(void)
{
    const cylint_piece_mode mode = (cylint_piece_mode)one_of(4);
    return (cylint_piece_rule){.mode = mode,
                               .rank = one_of(2) ? world.rank : NULL};
}

TEST(pieces_of_many_lines_are_those_of_each)
{
    static const int threads[] = {1, 2, 5};
    const long worlds = (long)check_setting("CYLINT_CASES", 8);
    stream = 7;
    for (long i = 0; i < worlds; i++) {
        begin_world();
        cylint_lines lines = many_lines();
        for (int k = 0; k < 3; k++) {
            const cylint_piece_rule rule = any_rule();
            check_rows(&lines, &rule, (size_t)one_of(4), threads[k]);
        }
        lines.n = 0;
        const cylint_piece_rule rule = {.mode = CYLINT_PIECES_UNION};
        check_rows(&lines, &rule, 0, 2);
    }
}

/* A line through a row of balls, of which more are wanted than the first memory for
 * pieces holds. */
TEST(many_pieces_of_a_line_are_all_those_that_are_wanted)
{
    enum { BALLS = 700 };
    static cylint_shape ball[BALLS];
    static const size_t most[] = {0, 255, 256, 257, 600, BALLS + 1, SIZE_MAX};
    const double o[3] = {-1, 0, 0}, d[3] = {1, 0, 0};
    const cylint_piece_rule rule = {.mode = CYLINT_PIECES_UNION};
    const cylint_lines lines = {
        1, {&o[0], &o[1], &o[2]}, {&d[0], &d[1], &d[2]}, NULL, NULL};
    for (int i = 0; i < BALLS; i++)
        cylint_sphere(&ball[i], (double[]){i, 0, 0}, 0.25, CYLINT_ENDS_CAPPED);
    OWN_SCENE *scene = cylint_scene_new(ball, BALLS, 1, NULL);
    for (size_t i = 0; i < sizeof most / sizeof *most; i++) {
        const size_t n = most[i] > 0 && most[i] < BALLS ? most[i] : BALLS;
        cylint_piece_rows rows;
        if (!CHECK(cylint_scene_pieces_lines(scene, &lines, &rule, most[i], 1,
                                             &rows) == CYLINT_SCENE_OK))
            continue;
        CHECK(rows.first[1] == n && rows.pieces[n - 1].shape == n - 1);
        cylint_piece_rows_free(&rows);
    }
}

/* Needles about one axis: a line along it is found in each of their slices. */
TEST(a_shape_of_many_slices_has_each_chord_once)
{
    enum { NEEDLES = 99 };
    static cylint_shape shape[NEEDLES];
    static cylint_interval memory[99 * NEEDLES];
    cylint_workspace work = {memory, sizeof memory, 0};
    cylint_piece piece[NEEDLES + 1];
    cylint_line line;
    for (int i = 0; i < NEEDLES; i++)
        cylint_cylinder(&shape[i], (double[]){0, 0, 0},
                        (double[]){1 + i, 1 + i, 1 + i}, 1e-5,
                        CYLINT_ENDS_CAPPED);
    cylint_ray(&line, (double[]){-1, -1, -1}, (double[]){1, 1, 1});
    OWN_SCENE *scene = cylint_scene_new(shape, NEEDLES, 1, NULL);
    for (int mode = CYLINT_PIECES_OWNER; mode <= CYLINT_PIECES_CHORDS; mode++) {
        const cylint_piece_rule rule = {.mode = (cylint_piece_mode)mode};
        CHECK(cylint_scene_pieces(scene, &line, &rule, piece, NEEDLES + 1,
                                  &work) == NEEDLES);
        CHECK(mode != CYLINT_PIECES_CELLS || piece[0].depth == NEEDLES);
    }
}

/* Of a row of discs that touch, and then of a ball about all of them.  A search of
 * the whole line would find more chords than the workspace holds. */
TEST(the_first_pieces_are_found_in_a_part_of_the_line)
{
    enum { DISCS = 1000, FEW = 4, CHORDS = 64, MIDDLE = 500 };
    static cylint_shape shape[DISCS + 1];
    static cylint_interval memory[3 * CHORDS];
    cylint_workspace work = {memory, sizeof memory, 0};
    cylint_line line;
    for (int i = 0; i < DISCS; i++)
        cylint_cylinder(&shape[i], (double[]){i, 0, 0}, (double[]){i + 1, 0, 0},
                        1, CYLINT_ENDS_CAPPED);
    cylint_sphere(&shape[DISCS], (double[]){MIDDLE, 0, 0}, DISCS,
                  CYLINT_ENDS_CAPPED);
    cylint_ray(&line, (double[]){-5, 0.1, 0.2}, (double[]){1, 0, 0});
    for (int balls = 0; balls < 2; balls++) {
        const size_t n = DISCS + (size_t)balls;
        OWN_SCENE *scene = cylint_scene_new(shape, n, 1, NULL);
        for (int mode = CYLINT_PIECES_OWNER; mode <= CYLINT_PIECES_CELLS;
             mode++)
            for (size_t most = 1; most <= FEW; most++) {
                const cylint_piece_rule rule = {.mode = mode};
                cylint_piece piece[FEW];
                line.tmin = 0;
                CHECK(cylint_scene_pieces(scene, &line, &rule, piece, most,
                                          &work) == most);
                CHECK(piece[most - 1].shape ==
                      (balls && most == 1 ? DISCS : most - 1 - (size_t)balls));
                line.tmin = 5 + MIDDLE;
                CHECK(cylint_scene_pieces(scene, &line, &rule, piece, most,
                                          &work) == most);
                CHECK(piece[most - 1].shape == MIDDLE + most - 1);
            }
    }
}

/* ---------------------------------------------------------------- sums -- */

#ifdef HAVE_MPFR
/* Of the pieces with this label. */
static double exact_sum(const cylint_piece *piece, size_t n, const int *label,
                        int wanted)
{
    real_fixed(4000);
    real sum = real_of(0);
    for (size_t i = 0; i < n; i++)
        if ((label ? label[piece[i].shape] : 0) == wanted)
            sum = plus(sum, minus(real_of(piece[i].t1), real_of(piece[i].t0)));
    return mpfr_get_d(sum->x, RND);
}

static void check_sums(const cylint_lines *lines, const cylint_piece_rule *rule,
                       const int *label, int in_units, const double *sums)
{
    static cylint_piece piece[MOST];
    for (size_t i = 0; i < lines->n; i++) {
        const size_t n = pieces_of(i, rule, 0, piece);
        for (int k = 0; k < LABELS; k++) {
            double expected = exact_sum(piece, n, label, k);
            if (in_units && expected != 0)
                expected *= cylint_line_length(&each[i]);
            if (!CHECK(same_double(sums[i * LABELS + (size_t)k], expected)))
                REPORT("line %zu, label %d: %a, not %a", i, k,
                       sums[i * LABELS + (size_t)k], expected);
        }
    }
}

TEST(sums_are_the_nearest_doubles_for_all_threads)
{
    static const int threads[] = {1, 2, 5};
    static double sums[3][MANY * LABELS];
    const long worlds = (long)check_setting("CYLINT_CASES", 8);
    stream = 8;
    for (long i = 0; i < worlds; i++) {
        int label[SHAPES];
        begin_world();
        const cylint_lines lines = many_lines();
        const cylint_piece_rule rule = any_rule();
        const int in_units = one_of(2), *labels = one_of(4) ? label : NULL;
        for (int j = 0; j < SHAPES; j++)
            label[j] = one_of(LABELS + 2) - 1; /* -1 and 5 do not count */
        for (int k = 0; k < 3; k++) {
            memset(sums[k], 0x5a, sizeof sums[k]);
            CHECK(cylint_scene_sums(world.scene, &lines, &rule, labels, LABELS,
                                    in_units, threads[k],
                                    sums[k]) == CYLINT_SCENE_OK);
        }
        CHECK(memcmp(sums[0], sums[1], sizeof sums[0]) == 0 &&
              memcmp(sums[0], sums[2], sizeof sums[0]) == 0);
        check_sums(&lines, &rule, labels, in_units, sums[0]);
    }
}
#endif

/* A line that touches the largest of some balls, then one through the centre of
 * all: the memory for the first suffices to find its chords, but not to sort its
 * cells. */
TEST(sums_of_more_cells_than_chords_have_room)
{
    enum { BALLS = 330 };
    static cylint_shape ball[BALLS];
    const double far[] = {-999, -999}, zero[] = {0, 0}, z[] = {BALLS, 0},
                 one[] = {1, 1};
    const cylint_lines lines = {
        2, {far, zero, z}, {one, zero, zero}, NULL, NULL};
    const cylint_piece_rule rule = {.mode = CYLINT_PIECES_CELLS};
    double sum[2];
    for (int i = 0; i < BALLS; i++)
        cylint_sphere(&ball[i], (double[]){0, 0, 0}, 1 + i, CYLINT_ENDS_CAPPED);
    OWN_SCENE *scene = cylint_scene_new(ball, BALLS, 1, NULL);
    CHECK(cylint_scene_sums(scene, &lines, &rule, NULL, 1, 0, 1, sum) ==
          CYLINT_SCENE_OK);
    CHECK(sum[0] == 0 && sum[1] == 2 * BALLS);
}

/* A piece whose t is subnormal, one whose length is, and a rounded product. */
TEST(a_sum_in_units_is_the_same_in_every_environment)
{
    static const struct {
        const char *record;
        double sum;
    } known[] = {{"ray -2 0 0  0x1p1023 0 0  sphere 0 0 0  0.5", 1},
                 {"ray 0 0 0  1 0 0  sphere 0 0 0  0x1.8p-1026", 0x1.8p-1026},
                 {"ray 0 0 0  3 0 0  sphere 0 0 0  1", 1}};
    const cylint_piece_rule rule = {.mode = CYLINT_PIECES_UNION};
    for (int i = 0; i < 3; i++) {
        const struct family_case c = case_of(known[i].record);
        OWN_SCENE *scene = cylint_scene_new(&c.shape, 1, 1, NULL);
        EACH_ENVIRONMENT(there) {
            double sum = 0;
            environment_set(there);
            const int status =
                cylint_scene_line_sums(scene, &c.line, &rule, NULL, 1, 1, &sum);
            environment_reset();
            CHECK(status == CYLINT_SCENE_OK && same_double(sum, known[i].sum));
        }
    }
}

/* Of pieces from minus infinity and to infinity, whose other end near the largest
 * double does not make the sum finite; and of one whose product with a length that
 * the thread reads as 0 would be NaN. */
TEST(a_sum_without_end_is_infinite_where_the_length_is_read_as_zero)
{
    static const char *const records[] = {
        "line 0 0 0x1.8p23  0 0 0x1p-1000  halfspace 0 0 0  0 0 1",
        "line 0 0 -0x1.8p23  0 0 0x1p-1000  halfspace 0 0 0  0 0 -1",
        "ray 0 0 0  0 0 0x1p-1074  cylinder 0 0 0  0 0 1  1 ends=infinite"};
    const cylint_piece_rule rule = {.mode = CYLINT_PIECES_UNION};
    for (int i = 0; i < 3; i++) {
        const struct family_case c = case_of(records[i]);
        const int in_units = i == 2;
        double sum = 0;
        OWN_SCENE *scene = cylint_scene_new(&c.shape, 1, 1, NULL);
        treat_subnormals(in_units ? FLUSH | ZERO : 0);
        CHECK(cylint_scene_line_sums(scene, &c.line, &rule, NULL, 1, in_units,
                                     &sum) == CYLINT_SCENE_OK);
        treat_subnormals(0);
        CHECK(sum == HUGE_VAL);
    }
}
