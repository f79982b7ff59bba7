/*
 * test_scene_pieces.c - the pieces of a line in solids, in every mode, against a loop over
 * all cells
 *
 * Coordinates are small integers, so that shapes touch, share faces, lie in each other
 * and are the same, and lines run along rulings, caps and through apexes.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "cylint_scene.h"
#include "random.h"

enum { SHAPES = 24, MEMBERS = 48, SOLIDS = 8, MOST = 4096, LINES = 40 };

static long cases_of(long normal)
{
    const char *text = getenv("CYLINT_CASES");
    return text ? strtol(text, NULL, 10) : normal;
}

static uint64_t rng;

static int integer(int most)
{
    return random_int(&rng, 2 * most + 1) - most;
}

static int choice(int n)
{
    return random_int(&rng, n);
}

static void point_of_integers(double p[3], int most)
{
    for (int i = 0; i < 3; i++)
        p[i] = integer(most);
}

/* Any kind, with any ends. */
static cylint_status any_shape(cylint_shape *s)
{
    double p[3], q[3], a[3], b[3];
    const cylint_ends ends =
        choice(2) ? CYLINT_ENDS_CAPPED : (cylint_ends)choice(6);
    point_of_integers(p, 6);
    point_of_integers(a, 2);
    point_of_integers(b, 2);
    for (int i = 0; i < 3; i++)
        q[i] = p[i] + integer(4);
    switch (choice(9)) {
    case 0:
        return cylint_cone(s, p, choice(3), q, choice(3), ends);
    case 1:
        return cylint_capsule(s, p, q, 1 + choice(2), CYLINT_ENDS_CAPPED);
    case 2:
        return cylint_sphere(s, p, 1 + choice(4), CYLINT_ENDS_CAPPED);
    case 3:
        return cylint_tangent_cone(s, p, a, 1, ends);
    case 4:
        return cylint_elliptic_cone(s, p, a, b, q, choice(3), ends);
    case 5:
        return cylint_round_cone(s, p, choice(3), q, choice(3), ends);
    case 6:
        return cylint_halfspace(s, p, a);
    default:
        return cylint_cylinder(s, p, q, 1 + choice(2), ends);
    }
}

static cylint_status any_line(cylint_line *line)
{
    double o[3], d[3];
    point_of_integers(o, 6);
    point_of_integers(d, 2);
    switch (choice(4)) {
    case 0:
        return cylint_ray(line, o, d);
    case 1:
        return cylint_span(line, o, d, -choice(3), choice(4));
    case 2:
        return cylint_segment(line, o, d);
    default:
        return cylint_whole_line(line, o, d);
    }
}

/* ------------------------------------------------ a loop over all cells -- */

static struct {
    cylint_shape shape[SHAPES];
    size_t n;
    int rank[SHAPES];
    cylint_member member[MEMBERS];
    size_t members, solids;
    cylint_scene *scene;
    /* of a line */
    cylint_line line;
    cylint_interval chord[SHAPES][2];
    int chords[SHAPES];
    double end[4 * SHAPES + 2];
    size_t ends;
} world;

/* The number of a solid, as the header defines it. */
static size_t number_of(size_t solid)
{
    size_t least[2] = {SIZE_MAX, SIZE_MAX};
    for (size_t i = 0; i < world.members; i++)
        if (world.member[i].solid == solid) {
            size_t *at = &least[world.member[i].clause < 0];
            *at = world.member[i].shape < *at ? world.member[i].shape : *at;
        }
    return least[0] < SIZE_MAX ? least[0] : least[1];
}

static int shape_contains(size_t shape, double t0, double t1)
{
    for (int i = 0; i < world.chords[shape]; i++)
        if (world.chord[shape][i].t0 <= t0 && t1 <= world.chord[shape][i].t1)
            return 1;
    return 0;
}

static int solid_contains(size_t solid, double t0, double t1)
{
    int has_members = 0;
    for (size_t i = 0; i < world.members; i++) {
        const cylint_member *m = &world.member[i];
        int holds = 0;
        if (m->solid != solid)
            continue;
        has_members = 1;
        for (size_t j = 0; j < world.members; j++) {
            const cylint_member *k = &world.member[j];
            if (k->solid == solid && abs(k->clause) == abs(m->clause))
                holds |= shape_contains(k->shape, t0, t1) == (k->clause > 0);
        }
        if (!holds)
            return 0;
    }
    return has_members;
}

static int is_member(size_t shape)
{
    for (size_t i = 0; i < world.members; i++)
        if (world.member[i].shape == shape)
            return 1;
    return 0;
}

static int compare_doubles(const void *x, const void *y)
{
    const double a = *(const double *)x, b = *(const double *)y;
    return (a > b) - (a < b);
}

static void find_chords(const cylint_line *line)
{
    world.line = *line;
    world.ends = 0;
    world.end[world.ends++] = line->tmin;
    world.end[world.ends++] = line->tmax;
    for (size_t i = 0; i < world.n; i++) {
        world.chords[i] = cylint_chord(&world.shape[i], line, world.chord[i]);
        for (int j = 0; j < world.chords[i]; j++) {
            world.end[world.ends++] = world.chord[i][j].t0;
            world.end[world.ends++] = world.chord[i][j].t1;
        }
    }
    qsort(world.end, world.ends, sizeof *world.end, compare_doubles);
}

static void add_owner(size_t number, const int *rank, size_t *owner,
                      size_t *depth)
{
    ++*depth;
    if (*owner == SIZE_MAX ||
        (rank && rank[number] != rank[*owner] ? rank[number] < rank[*owner]
                                              : number < *owner))
        *owner = number;
}

/* The owner of a cell and how many solids contain it. */
static size_t cell(double t0, double t1, const int *rank, size_t *owner)
{
    size_t depth = 0;
    *owner = SIZE_MAX;
    for (size_t i = 0; i < world.n; i++)
        if (!is_member(i) && shape_contains(i, t0, t1))
            add_owner(i, rank, owner, &depth);
    for (size_t i = 0; i < world.solids; i++)
        if (solid_contains(i, t0, t1))
            add_owner(number_of(i), rank, owner, &depth);
    return depth;
}

/* Divides [t0, t1] where the set of solids changes.  Chords of members that change no
 * solid divide nothing, so neighbours with the same set are joined. */
static int same_set(double a0, double a1, double b0, double b1)
{
    for (size_t i = 0; i < world.n; i++)
        if (!is_member(i) &&
            (shape_contains(i, a0, a1) != shape_contains(i, b0, b1)))
            return 0;
    for (size_t i = 0; i < world.solids; i++)
        if (solid_contains(i, a0, a1) != solid_contains(i, b0, b1))
            return 0;
    return 1;
}

static size_t expected_pieces(const cylint_piece_rule *rule, cylint_piece *to)
{
    size_t n = 0;
    double before0 = 0, before1 = 0;
    for (size_t i = 0; i + 1 < world.ends; i++) {
        const double t0 = world.end[i], t1 = world.end[i + 1];
        size_t owner;
        if (!(t0 < t1))
            continue;
        const size_t depth = cell(t0, t1, rule->rank, &owner);
        const int follows = n > 0 && to[n - 1].t1 == t0;
        if (depth > 0 && follows &&
            (rule->mode == CYLINT_PIECES_UNION ||
             (rule->mode == CYLINT_PIECES_OWNER && owner == to[n - 1].shape) ||
             (rule->mode == CYLINT_PIECES_CELLS &&
              same_set(before0, before1, t0, t1)))) {
            to[n - 1].t1 = t1;
            if (to[n - 1].depth < depth)
                to[n - 1].depth = depth;
        } else if (depth > 0) {
            to[n++] = (cylint_piece){t0, t1, owner, depth};
        }
        before0 = t0;
        before1 = t1;
    }
    return n;
}

static int compare_pieces(const void *x, const void *y)
{
    const cylint_piece *a = x, *b = y;
    return a->t0 != b->t0 ? (a->t0 > b->t0) - (a->t0 < b->t0)
                          : (a->shape > b->shape) - (a->shape < b->shape);
}

static size_t expected_chords(cylint_piece *to)
{
    size_t n = 0;
    for (size_t i = 0; i < world.n; i++)
        for (int j = 0; j < world.chords[i] && !is_member(i); j++)
            to[n++] = (cylint_piece){world.chord[i][j].t0, world.chord[i][j].t1,
                                     i, 1};
    for (size_t i = 0; i < world.solids; i++) {
        int was = 0;
        for (size_t j = 0; j + 1 < world.ends; j++) {
            const double t0 = world.end[j], t1 = world.end[j + 1];
            if (!(t0 < t1))
                continue;
            const int is = solid_contains(i, t0, t1);
            if (is && was)
                to[n - 1].t1 = t1;
            else if (is)
                to[n++] = (cylint_piece){t0, t1, number_of(i), 1};
            was = is;
        }
    }
    qsort(to, n, sizeof *to, compare_pieces);
    return n;
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

static void make_shapes(void)
{
    world.n = 0;
    while (world.n < SHAPES)
        if (choice(8) == 0 && world.n > 0) {
            world.shape[world.n] = world.shape[choice((int)world.n)];
            world.n++;
        } else if (any_shape(&world.shape[world.n]) == CYLINT_OK) {
            world.n++;
        }
    for (size_t i = 0; i < world.n; i++)
        world.rank[i] = choice(3);
    world.scene = cylint_scene_new(world.shape, world.n, 1, NULL);
    world.members = world.solids = 0;
}

/* Of up to 8 shapes and 4 clauses.  Solids may share shapes. */
static void make_solids(void)
{
    do {
        world.members = 0;
        world.solids = 1 + (size_t)choice(4);
        for (size_t i = 0; i < world.solids; i++)
            for (int n = 1 + choice(8); n > 0; n--)
                world.member[world.members++] =
                    (cylint_member){(size_t)choice(SHAPES), i,
                                    (1 + choice(4)) * (choice(3) ? 1 : -1)};
    } while (cylint_scene_set_solids(world.scene, world.member,
                                     world.members) != CYLINT_SCENE_OK);
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

int main(void)
{
    RUN(pieces_of_shapes_are_those_of_a_loop);
    RUN(pieces_of_solids_are_those_of_a_loop);
    return check_end();
}
