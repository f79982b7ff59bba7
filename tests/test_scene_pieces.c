/*
 * test_scene_pieces.c - the pieces of a line in solids, in every mode, against a loop over
 * all cells
 *
 * integer_shapes.h says why the coordinates are small integers.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "cylint_scene.h"
#include "piece_world.h"

static long cases_of(long normal)
{
    const char *text = getenv("CYLINT_CASES");
    return text ? strtol(text, NULL, 10) : normal;
}

/* ---------------------------------------------------------- the library -- */

/* With memory that is at first too small. */
static size_t query(const cylint_line *line, const cylint_piece_rule *rule,
                    cylint_piece *to, size_t capacity)
{
    static double memory[1 << 16];
    cylint_workspace work = {memory, (size_t)choice(2) * sizeof memory, 0};
    for (;;) {
        const size_t n =
            cylint_scene_pieces(world.scene, line, rule, to, capacity, &work);
        if (n != CYLINT_NO_ROOM)
            return n;
        if (!CHECK(work.wanted > work.bytes && work.wanted <= sizeof memory))
            exit(1);
        work.bytes = work.wanted;
    }
}

/* `capacity` pieces at a time. */
static size_t resumed(const cylint_piece_rule *rule, cylint_piece *to,
                      size_t capacity)
{
    cylint_line line = world.line;
    cylint_piece_rule next = *rule;
    size_t n = 0, more;
    do {
        more = query(&line, &next, to + n, capacity);
        n += more;
        if (n > 0 && rule->mode == CYLINT_PIECES_CHORDS)
            next.after = &to[n - 1];
        else if (n > 0)
            line.tmin = to[n - 1].t1;
    } while (more == capacity);
    return n;
}

static int same_pieces(const cylint_piece *x, size_t n, const cylint_piece *y,
                       size_t m)
{
    for (size_t i = 0; i < n && n == m; i++)
        if (x[i].t0 != y[i].t0 || x[i].t1 != y[i].t1 ||
            x[i].shape != y[i].shape || x[i].depth != y[i].depth)
            return 0;
    return n == m;
}

static long pieces_compared;

static void check_rule(const cylint_piece_rule *rule)
{
    static cylint_piece expected[MOST], got[MOST];
    static const size_t capacities[] = {1, 2, 3, 4, 5, 7, MOST};
    const size_t n = rule->mode == CYLINT_PIECES_CHORDS
                         ? expected_chords(expected)
                         : expected_pieces(rule, expected);
    for (size_t i = 0; i < sizeof capacities / sizeof *capacities; i++) {
        const size_t m = resumed(rule, got, capacities[i]);
        pieces_compared += (long)m;
        if (!CHECK(same_pieces(expected, n, got, m)))
            REPORT("mode %d, %zu at a time: %zu pieces, not %zu", rule->mode,
                   capacities[i], m, n);
    }
}

/* ------------------------------------------------------ first boundary -- */

/* Whether the line enters (or leaves) solid `number` at t by the shape; 2: by the
 * complement. */
static int bounds_solid(size_t shape, size_t number, double t, int enters)
{
    int begins = 0, ends = 0, kind = 0;
    for (int i = 0; i < world.chords[shape]; i++) {
        begins |= world.chord[shape][i].t0 == t;
        ends |= world.chord[shape][i].t1 == t;
    }
    if (!is_member(shape))
        return shape == number && (enters ? begins : ends);
    for (size_t i = 0; i < world.members; i++) {
        const cylint_member *m = &world.member[i];
        if (m->shape != shape || number_of(m->solid) != number)
            continue;
        if (m->clause > 0 && (enters ? begins : ends))
            kind = 1;
        else if (m->clause < 0 && (enters ? ends : begins) && kind == 0)
            kind = 2;
    }
    return kind;
}

/* Of the cells of the line, in order. */
static size_t expected_boundary(double *t, int *enters, size_t *number)
{
    size_t owner, before = SIZE_MAX;
    int was_inside = -1;
    for (size_t i = 0; i + 1 < world.ends; i++) {
        if (!(world.end[i] < world.end[i + 1]))
            continue;
        const int is = cell(world.end[i], world.end[i + 1], NULL, &owner) > 0;
        if (was_inside >= 0 && is != was_inside) {
            *t = world.end[i];
            *enters = is;
            *number = is ? owner : before;
            for (size_t j = 0; j < world.n; j++)
                if (bounds_solid(j, *number, *t, is))
                    return j;
        }
        was_inside = is;
        before = owner;
    }
    return world.n;
}

static void check_boundary(void)
{
    static double memory[1 << 16];
    cylint_workspace work = {memory, sizeof memory, 0};
    cylint_hit hit;
    double t = 0;
    int enters = 0;
    size_t number = 0;
    const size_t expected = expected_boundary(&t, &enters, &number),
                 got = cylint_scene_first_boundary(
                     world.scene, &world.line, CYLINT_WANT_ALL, &hit, &work);
    if (!CHECK(got == expected))
        REPORT("shape %zu, not %zu", got, expected);
    if (got != expected || got == world.n)
        return;
    CHECK(hit.t == t);
    CHECK(hit.side == (enters ? CYLINT_SIDE_ENTERING : CYLINT_SIDE_LEAVING));
    /* the normal points out of the solid: against a line that enters */
    double along = 0, size = 0;
    for (int i = 0; i < 3; i++) {
        along += hit.normal[i] * world.line.d[i];
        size += hit.normal[i] * hit.normal[i];
    }
    CHECK(fabs(size - 1) < 1e-14);
    CHECK(enters ? along < 1e-12 : along > -1e-12);
}

/* ------------------------------------------------------------- a point -- */

static int member_holds(const cylint_member *m, const double point[3])
{
    return (cylint_contains(&world.shape[m->shape], point) >= 0) ==
           (m->clause > 0);
}

static int solid_holds(size_t solid, const double point[3])
{
    int has_members = 0;
    for (size_t i = 0; i < world.members; i++) {
        int holds = 0;
        if (world.member[i].solid != solid)
            continue;
        has_members = 1;
        for (size_t j = 0; j < world.members; j++)
            if (world.member[j].solid == solid &&
                abs(world.member[j].clause) == abs(world.member[i].clause))
                holds |= member_holds(&world.member[j], point);
        if (!holds)
            return 0;
    }
    return has_members;
}

static void check_depth(void)
{
    static double memory[1 << 16];
    cylint_workspace work = {memory, sizeof memory, 0};
    double point[3];
    point_of_integers(point, 6);
    for (int ranked = 0; ranked < 2; ranked++) {
        const int *rank = ranked ? world.rank : NULL;
        size_t depth = 0, owner = SIZE_MAX, got;
        for (size_t i = 0; i < world.n; i++)
            if (!is_member(i) && cylint_contains(&world.shape[i], point) >= 0)
                add_owner(i, rank, &owner, &depth);
        for (size_t i = 0; i < world.solids; i++)
            if (solid_holds(i, point))
                add_owner(number_of(i), rank, &owner, &depth);
        CHECK(cylint_scene_depth(world.scene, point, rank, &got, &work) ==
              depth);
        CHECK(got == (depth > 0 ? owner : world.n));
    }
}

/* ---------------------------------------------------------- many lines -- */

static struct {
    double column[8][LINES];
    cylint_lines lines;
    cylint_line line[LINES];
} many;

static void make_lines(void)
{
    many.lines =
        (cylint_lines){.n = LINES,
                       .o = {many.column[0], many.column[1], many.column[2]},
                       .d = {many.column[3], many.column[4], many.column[5]},
                       .tmin = many.column[6],
                       .tmax = many.column[7]};
    for (size_t i = 0; i < LINES;) {
        double o[3], d[3];
        point_of_integers(o, 6);
        point_of_integers(d, 2);
        const double tmin = choice(3) ? -choice(9) : -HUGE_VAL,
                     tmax = choice(3) ? choice(9) : HUGE_VAL;
        if (cylint_span(&many.line[i], o, d, tmin, tmax) != CYLINT_OK)
            continue;
        for (int j = 0; j < 3; j++) {
            many.column[j][i] = o[j];
            many.column[j + 3][i] = d[j];
        }
        many.column[6][i] = tmin;
        many.column[7][i++] = tmax;
    }
}

static void check_rows(const cylint_piece_rule *rule, size_t most)
{
    static cylint_piece expected[MOST];
    for (int threads = 1; threads <= 3; threads += 2) {
        cylint_piece_rows rows;
        if (!CHECK(cylint_scene_pieces_lines(world.scene, &many.lines, rule,
                                             most, threads,
                                             &rows) == CYLINT_SCENE_OK))
            return;
        CHECK(rows.first[0] == 0);
        for (size_t i = 0; i < LINES; i++) {
            const size_t n =
                query(&many.line[i], rule, expected, most > 0 ? most : MOST);
            CHECK(same_pieces(expected, n, rows.pieces + rows.first[i],
                              rows.first[i + 1] - rows.first[i]));
        }
        cylint_piece_rows_free(&rows);
    }
}

/* Sums of few lengths in long double are nearly exact. */
static void check_sums(const cylint_piece_rule *rule)
{
    enum { LABELS = 3 };
    static cylint_piece piece[MOST];
    static double sums[2][LINES * LABELS];
    int label[SHAPES];
    for (int i = 0; i < SHAPES; i++)
        label[i] = choice(LABELS + 2) - 1;
    for (int in_units = 0; in_units < 2; in_units++)
        CHECK(cylint_scene_sums(world.scene, &many.lines, rule, label, LABELS,
                                in_units, 1 + 2 * in_units,
                                sums[in_units]) == CYLINT_SCENE_OK);
    for (size_t i = 0; i < LINES; i++) {
        const size_t n = query(&many.line[i], rule, piece, MOST);
        for (int k = 0; k < LABELS; k++) {
            long double sum = 0;
            for (size_t j = 0; j < n; j++)
                if (label[piece[j].shape] == k)
                    sum += (long double)piece[j].t1 - piece[j].t0;
            const double got = sums[0][i * LABELS + (size_t)k];
            CHECK(sum > 1e300L ? got == HUGE_VAL
                               : fabsl(got - sum) <= 0.501L * 0x1p-52L * sum);
            CHECK(sums[1][i * LABELS + (size_t)k] ==
                  (got > 0 ? got * cylint_line_length(&many.line[i]) : 0));
        }
    }
}

static void check_many(void)
{
    make_lines();
    for (int mode = CYLINT_PIECES_UNION; mode <= CYLINT_PIECES_CHORDS; mode++) {
        const cylint_piece_rule rule = {.mode = (cylint_piece_mode)mode,
                                        .rank = choice(2) ? world.rank : NULL};
        check_rows(&rule, (size_t)choice(4));
        check_sums(&rule);
    }
}

/* -------------------------------------------------------------- worlds -- */

static void check_line(void)
{
    cylint_line line;
    if (any_line(&line) != CYLINT_OK)
        return;
    find_chords(&line);
    for (int mode = CYLINT_PIECES_UNION; mode <= CYLINT_PIECES_CHORDS; mode++)
        for (int ranked = 0; ranked < 2; ranked++) {
            const cylint_piece_rule rule = {.mode = (cylint_piece_mode)mode,
                                            .rank = ranked ? world.rank : NULL};
            check_rule(&rule);
        }
    check_boundary();
    check_depth();
}

static struct {
    char data[1 << 16];
    size_t n;
} file;

static int append_to_file(void *context, const void *data, size_t bytes)
{
    (void)context;
    if (bytes > sizeof file.data - file.n)
        return 0;
    memcpy(file.data + file.n, data, bytes);
    file.n += bytes;
    return 1;
}

/* In place of the scene, with its solids. */
static void open_saved_scene(void)
{
    file.n = 0;
    CHECK(cylint_scene_write(world.scene, append_to_file, NULL) ==
          CYLINT_SCENE_OK);
    cylint_scene_free(world.scene);
    world.scene = cylint_scene_open_memory(file.data, file.n, 0, NULL);
    if (!CHECK(world.scene != NULL))
        exit(1);
    CHECK(cylint_scene_members(world.scene) == world.members);
    for (size_t i = 0; i < world.members; i++) {
        cylint_member m;
        cylint_scene_member(world.scene, i, &m);
        CHECK(m.shape == world.member[i].shape &&
              m.solid == world.member[i].solid &&
              m.clause == world.member[i].clause);
    }
}

static void check_worlds(long worlds, int with_solids)
{
    pieces_compared = 0;
    for (long i = 0; i < worlds; i++) {
        make_shapes();
        if (with_solids)
            make_solids();
        for (int j = 0; j < LINES; j++)
            check_line();
        if (i % 16 == 0) {
            check_many();
            open_saved_scene();
            for (int j = 0; j < 3; j++)
                check_line();
        }
        cylint_scene_free(world.scene);
    }
    CHECK(pieces_compared > 100 * worlds);
    fprintf(stderr, "%ld pieces\n", pieces_compared);
}

static void pieces_of_shapes_are_those_of_a_loop(void)
{
    rng = 1;
    check_worlds(cases_of(100), 0);
}

static void pieces_of_solids_are_those_of_a_loop(void)
{
    rng = 2;
    check_worlds(cases_of(100), 1);
}

static void bad_solids_change_nothing(void)
{
    const double p[3] = {0, 0, 0};
    cylint_shape shape[3];
    const cylint_member good[2] = {{0, 0, 1}, {1, 0, -2}};
    const cylint_member bad[][2] = {{{0, 0, 1}, {3, 0, 2}},
                                    {{0, 0, 1}, {1, 2, 2}},
                                    {{0, 0, 1}, {1, 0, 0}},
                                    {{0, 0, 1}, {0, 1, 1}}};
    static const cylint_scene_status status[] = {
        CYLINT_SCENE_ESIZE, CYLINT_SCENE_ESIZE, CYLINT_SCENE_ESOLID,
        CYLINT_SCENE_ESOLID};
    for (int i = 0; i < 3; i++)
        cylint_sphere(&shape[i], p, 1 + i, CYLINT_ENDS_CAPPED);
    cylint_scene *scene = cylint_scene_begin(0);
    CHECK(cylint_scene_set_solids(scene, good, 2) == CYLINT_SCENE_EUNFINISHED);
    cylint_scene_free(scene);
    scene = cylint_scene_new(shape, 3, 1, NULL);
    CHECK(cylint_scene_set_solids(scene, good, 2) == CYLINT_SCENE_OK);
    for (int i = 0; i < 4; i++) {
        cylint_member m;
        CHECK(cylint_scene_set_solids(scene, bad[i], 2) == status[i]);
        CHECK(cylint_scene_members(scene) == 2);
        cylint_scene_member(scene, 1, &m);
        CHECK(m.shape == 1 && m.clause == -2);
    }
    CHECK(cylint_scene_set_solids(scene, NULL, 0) == CYLINT_SCENE_OK &&
          cylint_scene_members(scene) == 0);
    cylint_scene_free(scene);
}

int main(void)
{
    RUN(bad_solids_change_nothing);
    RUN(pieces_of_shapes_are_those_of_a_loop);
    RUN(pieces_of_solids_are_those_of_a_loop);
    return check_end();
}
