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

/* A half-space in a bounded solid and in another one counts once in each. */
static void a_shape_is_in_bounded_and_unbounded_solids(void)
{
    const double o[3] = {0, 0, 0}, up[3] = {0, 0, 1}, far[3] = {0, 0, 9},
                 down[3] = {0, 0, -1}, ex[3] = {1, 0, 0}, low[3] = {0, 0, -5};
    const cylint_member members[] = {
        {2, 0, 1}, {0, 0, -2}, {1, 0, -2}, {0, 1, -1}};
    const cylint_piece_rule rule = {.mode = CYLINT_PIECES_UNION};
    double memory[512];
    cylint_workspace work = {memory, sizeof memory, 0};
    cylint_piece piece[2];
    cylint_shape shape[3];
    cylint_line line;
    size_t owner;
    cylint_halfspace(&shape[0], o, up);
    cylint_halfspace(&shape[1], far, down);
    cylint_sphere(&shape[2], low, 1, CYLINT_ENDS_CAPPED);
    cylint_scene *scene = cylint_scene_new(shape, 3, 1, NULL);
    CHECK(cylint_scene_set_solids(scene, members, 4) == CYLINT_SCENE_OK);
    cylint_whole_line(&line, low, ex);
    CHECK(cylint_scene_pieces(scene, &line, &rule, piece, 2, &work) == 1 &&
          piece[0].t0 == -1 && piece[0].t1 == 1 && piece[0].shape == 2);
    CHECK(cylint_scene_depth(scene, low, NULL, &owner, &work) == 1 &&
          owner == 2);
    cylint_scene_free(scene);
}

int main(void)
{
    RUN(a_shape_is_in_bounded_and_unbounded_solids);
    RUN(pieces_of_shapes_are_those_of_a_loop);
    RUN(pieces_of_solids_are_those_of_a_loop);
    return check_end();
}
