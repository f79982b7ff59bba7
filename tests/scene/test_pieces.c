/*
 * test_pieces.c - the pieces of a line in solids, in every mode, against a loop
 * over all cells
 *
 * CYLINT_CASES: scenes in each test.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "check.h"
#include "cylint_scene.h"
#include "environment.h"
#include "piece_world.h"

/* ---------------------------------------------------------- the library -- */

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

/* -------------------------------------------------------------- worlds -- */

static void check_line(void)
{
    const cylint_line line = any_line();
    find_chords(&line);
    for (int mode = CYLINT_PIECES_UNION; mode <= CYLINT_PIECES_CHORDS; mode++)
        for (int ranked = 0; ranked < 2; ranked++) {
            const cylint_piece_rule rule = {.mode = (cylint_piece_mode)mode,
                                            .rank = ranked ? world.rank : NULL};
            check_rule(&rule);
        }
}

/* The solids of the scene stay. */
static void move_a_shape(void)
{
    const int i = one_of(SHAPES);
    const cylint_shape moved = any_shape();
    if (cylint_scene_refit(world.scene, (size_t)i, 1, &moved) ==
        CYLINT_SCENE_OK)
        world.shape[i] = moved;
}

static void check_worlds(long worlds, int with_solids)
{
    pieces_compared = 0;
    for (long i = 0; i < worlds; i++) {
        make_shapes();
        if (with_solids)
            make_solids();
        for (int j = 0; j < LINES; j++) {
            check_line();
            move_a_shape();
        }
    }
    CHECK(pieces_compared > 100 * worlds);
    printf("note: %ld pieces\n", pieces_compared);
}

TEST(pieces_of_shapes_are_those_of_a_loop)
{
    stream = 1;
    check_worlds((long)check_setting("CYLINT_CASES", 60), 0);
}

TEST(pieces_of_solids_are_those_of_a_loop)
{
    stream = 2;
    check_worlds((long)check_setting("CYLINT_CASES", 60), 1);
}

/* --------------------------------------------------------- environment -- */

/* Half of the lines have such long directions that t is subnormal. */
TEST(pieces_are_the_same_in_every_environment)
{
    static world_answers expected, got;
    cylint_line asked;
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
        cylint_span(&asked, line.o, d, line.tmin / size, line.tmax / size);
        answer_all(world.scene, &asked, &expected);
        EACH_ENVIRONMENT(there) {
            environment_set(there);
            answer_all(world.scene, &asked, &got);
            environment_reset();
            CHECK(same_bytes(&expected, &got, sizeof got));
        }
        const double t = expected.piece[0][0].t0;
        subnormal_ends += t > 0 && t < DBL_MIN;
    }
    CHECK(subnormal_ends > 0);
}
