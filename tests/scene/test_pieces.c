/*
 * test_pieces.c - the pieces of a line in solids, in every mode, against a loop
 * over all cells
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
