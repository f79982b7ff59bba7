/*
 * test_solids.c - solids that are set, refused and saved, and workspaces of every
 * size
 *
 * CYLINT_CASES: scenes in tests of random ones.
 */
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "cylint_distance.h"
#include "cylint_scene.h"
#include "piece_world.h"
#include "scene_file.h"
#include "shapes/shape_facts.h"

enum { FEW = 12 };

static cylint_line line[FEW];

static void draw_lines(void)
{
    for (int i = 0; i < FEW; i++)
        line[i] = any_line();
}

static int same_solids(const cylint_scene *x, const cylint_scene *y)
{
    static world_answers p, q;
    const size_t n = cylint_scene_members(x);
    int same = cylint_scene_members(y) == n;
    for (size_t i = 0; i < n && same; i++) {
        cylint_member a, b;
        cylint_scene_member(x, i, &a);
        cylint_scene_member(y, i, &b);
        same = a.shape == b.shape && a.solid == b.solid && a.clause == b.clause;
    }
    for (int i = 0; i < FEW && same; i++) {
        answer_all(x, &line[i], &p);
        answer_all(y, &line[i], &q);
        same = same_bytes(&p, &q, sizeof p);
    }
    return same;
}

/* -------------------------------------------------------------- errors -- */

/* Members that are refused, and why. */
static const struct {
    cylint_scene_status status;
    size_t n;
    cylint_member member[3];
} refused[] = {
    {CYLINT_SCENE_ESOLID, 1, {{0, 0, 0}}},
    {CYLINT_SCENE_ESOLID, 2, {{0, 0, 1}, {1, 0, 0}}},
    {CYLINT_SCENE_ESOLID, 1, {{0, 0, INT_MIN}}},
    {CYLINT_SCENE_ESOLID, 2, {{3, 0, 1}, {3, 1, 1}}},
    {CYLINT_SCENE_ESOLID, 3, {{3, 0, 1}, {1, 0, -1}, {3, 1, -1}}},
    {CYLINT_SCENE_ESOLID, 2, {{3, 0, -1}, {3, 1, -1}}},
    {CYLINT_SCENE_ESIZE, 1, {{SHAPES, 0, 1}}},
    {CYLINT_SCENE_ESIZE, 2, {{1, 0, 1}, {SIZE_MAX, 0, 1}}},
    {CYLINT_SCENE_ESIZE, 1, {{SIZE_MAX / 2 + 1, 0, 1}}},
    {CYLINT_SCENE_ESIZE, 2, {{1, 0, 1}, {2, 3, 1}}},
    {CYLINT_SCENE_ESIZE, 1, {{1, 1, 1}}},
    {CYLINT_SCENE_ESIZE, 1, {{1, SIZE_MAX / 2 + 1, 1}}},
    {CYLINT_SCENE_ESIZE, ((size_t)1 << 28) + 1, {{1, 0, 1}}},
};

TEST(a_refused_solid_changes_nothing)
{
    stream = 1;
    for (int with = 0; with < 2; with++) {
        make_shapes();
        if (with)
            make_solids();
        draw_lines();
        OWN_SCENE *same = cylint_scene_new(world.shape, world.n, 1, NULL);
        cylint_scene_set_solids(same, world.member, world.members);
        for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
            const cylint_scene_status status = cylint_scene_set_solids(
                world.scene, refused[i].member, refused[i].n);
            if (!CHECK(status == refused[i].status))
                REPORT("case %zu: status %d", i, (int)status);
            CHECK(same_solids(world.scene, same));
        }
    }
}

/* Also that no members remove all solids, and that the members are copied. */
TEST(solids_replace_those_before)
{
    stream = 2;
    make_shapes();
    draw_lines();
    OWN_SCENE *same = cylint_scene_new(world.shape, world.n, 1, NULL);
    for (int i = 0; i < 10; i++) {
        make_solids();
        CHECK(cylint_scene_set_solids(same, NULL, 0) == CYLINT_SCENE_OK &&
              cylint_scene_members(same) == 0);
        cylint_member copy[MEMBERS];
        memcpy(copy, world.member, sizeof copy);
        CHECK(cylint_scene_set_solids(same, copy, world.members) ==
              CYLINT_SCENE_OK);
        memset(copy, 0xff, sizeof copy);
        CHECK(same_solids(world.scene, same));
    }
    OWN_SCENE *plain = cylint_scene_new(world.shape, world.n, 1, NULL);
    cylint_scene_set_solids(same, NULL, 0);
    CHECK(same_solids(plain, same));
}

/* -------------------------------------------------------- saved scenes -- */

TEST(saved_solids_are_the_same)
{
    const long worlds = (long)check_setting("CYLINT_CASES", 100);
    stream = 3;
    for (long i = 0; i < worlds; i++) {
        OWN_BYTES b = {NULL, NULL, 0};
        make_shapes();
        make_solids();
        draw_lines();
        scene_file_write(world.scene, &b);
        for (unsigned flags = 0; flags < 2; flags++) {
            OWN_SCENE *opened = cylint_scene_open_memory(
                b.data, b.n, flags ? CYLINT_SCENE_TRUSTED : 0, NULL);
            if (CHECK(opened))
                CHECK(same_solids(world.scene, opened));
            /* solids of an opened scene can be replaced */
            CHECK(cylint_scene_set_solids(opened, NULL, 0) == CYLINT_SCENE_OK);
            CHECK(cylint_scene_members(opened) == 0);
            CHECK(cylint_scene_set_solids(opened, world.member,
                                          world.members) == CYLINT_SCENE_OK);
            CHECK(same_solids(world.scene, opened));
        }
        CHECK(scene_file_try(b.data, b.n) == CYLINT_SCENE_OK);
    }
}

/* ----------------------------------------------------------- workspaces -- */

enum { QUERIES = 7, GUARD = 64 };

typedef struct {
    size_t n;
    cylint_piece piece[3];
    cylint_hit hit;
    size_t owner;
} query_answer;

/* Pieces in each mode, few and all; the first boundary; the depth. */
static void make_query(int query, int of, cylint_workspace *work,
                       query_answer *a)
{
    const cylint_piece_rule rule = {.mode = (cylint_piece_mode)(query % 4)};
    memset(a, 0, sizeof *a);
    if (query < 5)
        a->n = cylint_scene_pieces(world.scene, &line[of], &rule, a->piece,
                                   query == 4 ? 1 : 2, work);
    else if (query == 5)
        a->n = cylint_scene_first_boundary(world.scene, &line[of],
                                           CYLINT_WANT_ALL, &a->hit, work);
    else
        a->n =
            cylint_scene_depth(world.scene, line[of].o, NULL, &a->owner, work);
}

/* Makes a query with `bytes` bytes; nothing beyond them may change. */
static void query_with(size_t bytes, int query, int of, query_answer *a,
                       size_t *wanted)
{
    static const cylint_piece zero;
    unsigned char *memory = malloc(bytes + GUARD);
    cylint_workspace work = {memory, bytes, 0};
    memset(memory, 0x5a, bytes + GUARD);
    make_query(query, of, &work, a);
    for (size_t i = 0; i < GUARD; i++)
        CHECK(memory[bytes + i] == 0x5a);
    CHECK(work.memory == memory && work.bytes == bytes);
    CHECK(memcmp(&a->piece[2], &zero, sizeof zero) == 0);
    CHECK(a->n != CYLINT_NO_ROOM || work.wanted > bytes);
    *wanted = a->n == CYLINT_NO_ROOM ? work.wanted : 0;
    free(memory);
}

static void check_sizes(int query, int of)
{
    cylint_workspace large = {workspace, sizeof workspace, 0};
    query_answer expected, a;
    size_t wanted, bytes = 0, enough;
    make_query(query, of, &large, &expected);
    CHECK(expected.n != CYLINT_NO_ROOM);
    for (int i = 0;; i++) { /* as a caller does */
        query_with(bytes, query, of, &a, &wanted);
        if (wanted == 0 || !CHECK(i < 9))
            break;
        bytes = wanted;
    }
    enough = bytes;
    CHECK(a.n == expected.n && memcmp(&a, &expected, sizeof a) == 0);
    const size_t step = enough > 900 ? enough / 300 : 1;
    for (bytes = 0; bytes <= enough + 8; bytes += step) {
        query_with(bytes, query, of, &a, &wanted);
        if (a.n != CYLINT_NO_ROOM)
            CHECK(memcmp(&a, &expected, sizeof a) == 0);
        else
            CHECK(bytes < enough);
    }
}

TEST(workspaces_of_every_size_are_kept)
{
    const int worlds = (int)check_setting("CYLINT_CASES", 6);
    stream = 7;
    for (int i = 0; i < worlds; i++) {
        make_shapes();
        if (i % 3)
            make_solids();
        draw_lines();
        for (int query = 0; query < QUERIES; query++)
            for (int of = 0; of < 4; of++)
                check_sizes(query, of);
    }
}

/* The line has a chord in each of a row of spheres and half-spaces, which then are
 * one solid. */
TEST(chords_take_so_many_bytes_and_half_spaces_of_a_solid_once)
{
    enum { BALLS = 100, PLANES = 8, N = BALLS + PLANES };
    static unsigned char memory[160 * BALLS + 256 * PLANES];
    cylint_workspace work = {memory, 48 * N, 0};
    cylint_member members[N];
    cylint_shape shape[N];
    cylint_piece piece[BALLS];
    const cylint_piece_rule rule = {.mode = CYLINT_PIECES_UNION};
    const cylint_line along =
        case_of("line -1 0 0  1 0 0  sphere 0 0 0 1").line;
    for (int i = 0; i < N; i++) {
        const double p[3] = {i, 0, 0}, above[3] = {0, 0, i}, up[3] = {0, 0, 1};
        const int plane = i - BALLS;
        MUST((plane < 0 ? cylint_sphere(&shape[i], p, 0.25, CYLINT_ENDS_CAPPED)
                        : cylint_halfspace(&shape[i], above, up)) == CYLINT_OK);
        members[i] = (cylint_member){(size_t)i, 0, plane < 0 ? 1 : 2 + plane};
    }
    OWN_SCENE *scene = cylint_scene_new(shape, N, 1, NULL);
    CHECK(cylint_scene_pieces(scene, &along, &rule, piece, BALLS, &work) == 1);
    CHECK(cylint_scene_set_solids(scene, members, N) == CYLINT_SCENE_OK);
    work.bytes = sizeof memory;
    CHECK(cylint_scene_pieces(scene, &along, &rule, piece, BALLS, &work) ==
          BALLS);
}

/* Each solid is what lies outside a ball; the line hits none. */
TEST(a_complement_in_an_unbounded_solid_takes_64_bytes)
{
    enum { BALLS = 100 };
    static unsigned char memory[64 * BALLS + 8];
    cylint_workspace work = {memory, sizeof memory, 0};
    cylint_member members[BALLS];
    cylint_shape shape[BALLS];
    cylint_piece piece[BALLS];
    const cylint_piece_rule rule = {.mode = CYLINT_PIECES_CHORDS};
    const cylint_line past = case_of("line 0 9 0  1 0 0  sphere 0 0 0 1").line;
    for (int i = 0; i < BALLS; i++) {
        MUST(cylint_sphere(&shape[i], (double[]){i, 0, 0}, 0.25,
                           CYLINT_ENDS_CAPPED) == CYLINT_OK);
        members[i] = (cylint_member){(size_t)i, (size_t)i, -1};
    }
    OWN_SCENE *scene = cylint_scene_new(shape, BALLS, 1, NULL);
    MUST(cylint_scene_set_solids(scene, members, BALLS) == CYLINT_SCENE_OK);
    CHECK(cylint_scene_pieces(scene, &past, &rule, piece, BALLS, &work) ==
          BALLS);
}

/* Each solid is a rod, cut by a half-space of its own, by one that all have in
 * common, and by one large ball: these take no memory where the line hits no rod of
 * their solid. */
TEST(members_take_bytes_only_where_the_line_hits_their_solid)
{
    enum { RODS = 40, N = 2 * RODS + 2, CUTS = 4 };
    static unsigned char memory[150 + 3 * 256 + 50];
    cylint_workspace work = {memory, sizeof memory, 0};
    cylint_member members[CUTS * RODS];
    cylint_shape shape[N];
    cylint_piece piece[2];
    const cylint_piece_rule rule = {.mode = CYLINT_PIECES_UNION};
    const double up[3] = {0, 0, 1}, middle[3] = {RODS / 2, 0, 0};
    const cylint_line through =
        case_of("line 7 -200 0.5  0 1 0  sphere 0 0 0 1").line;
    for (int i = 0; i < RODS; i++) {
        const double p[3] = {i, 0, 0}, q[3] = {i, 0, 1};
        MUST(cylint_cylinder(&shape[i], p, q, 0.25, CYLINT_ENDS_CAPPED) ==
                 CYLINT_OK &&
             cylint_halfspace(&shape[RODS + i], q, up) == CYLINT_OK);
        const size_t cut[CUTS] = {(size_t)i, RODS + (size_t)i, N - 2, N - 1};
        for (int k = 0; k < CUTS; k++)
            members[CUTS * i + k] = (cylint_member){cut[k], (size_t)i, k + 1};
    }
    MUST(cylint_halfspace(&shape[N - 2], middle, (double[3]){0, 1, 0}) ==
             CYLINT_OK &&
         cylint_sphere(&shape[N - 1], middle, 100, CYLINT_ENDS_CAPPED) ==
             CYLINT_OK);
    OWN_SCENE *scene = cylint_scene_new(shape, N, 1, NULL);
    MUST(cylint_scene_set_solids(scene, members, CUTS * RODS) ==
         CYLINT_SCENE_OK);
    CHECK(cylint_scene_pieces(scene, &through, &rule, piece, 2, &work) == 1);
    CHECK(piece[0].shape == 7 && piece[0].t0 == 199.75 && piece[0].t1 == 200);
}

/* ---------------------------------------------- one solid without a scene -- */

/* One solid in world.member, some of its shapes refused. */
static void make_one_solid(int clause[SHAPES])
{
    const double p[3] = {0, 0, 0};
    const int clauses = 1 + one_of(5);
    world.n = world.members = 1 + (size_t)one_of(one_of(3) ? 6 : SHAPES);
    world.solids = 1;
    for (size_t i = 0; i < world.n; i++) {
        cylint_shape *s = &world.shape[i];
        if (one_of(16) == 0)
            cylint_cylinder(s, p, p, 1, CYLINT_ENDS_CAPPED);
        else
            *s = any_shape();
        clause[i] = 100 * (1 + one_of(clauses));
        if (one_of(3) == 0)
            clause[i] = -clause[i];
        world.member[i] = (cylint_member){i, 0, clause[i]};
    }
}

/* The safety of a point in the solid: of its members.  0: one lacks a cap. */
static double least_safety(const double point[3])
{
    double least = HUGE_VAL;
    for (size_t i = 0; i < world.n; i++) {
        const cylint_shape *shape = &world.shape[i];
        least = fmin(least, cylint_surface_is_whole(shape->ends)
                                ? cylint_safety(shape, point)
                                : 0);
    }
    return least;
}

/* Whether t is an end of the line or at least so far from its origin, except for
 * the rounding of t and of the length. */
static int is_beyond(double t, const cylint_line *of, double safety)
{
    const double length = fabs(t) * cylint_line_length(of);
    return t == of->tmin || t == of->tmax ||
           !(length < safety * (1 - 0x1p-50) - 0x1p-1070);
}

TEST(pieces_of_one_solid_are_those_of_a_loop)
{
    static cylint_piece expected[MOST];
    static const size_t capacities[] = {1, 2, 3, CYLINT_SOLID_PIECES};
    long found = 0, safe = 0;
    stream = 8;
    for (int i = 0; i < 50000; i++) {
        int clause[SHAPES];
        cylint_line of = any_line();
        make_one_solid(clause);
        find_chords(&of);
        const cylint_piece_rule chords = {.mode = CYLINT_PIECES_CHORDS};
        const size_t n = expected_pieces(&chords, expected),
                     most = capacities[one_of(4)];
        const double safety = least_safety(of.o);
        size_t m = 0;
        int more;
        do {
            cylint_interval got[CYLINT_SOLID_PIECES];
            more = cylint_solid_pieces(world.shape, clause, world.n, &of, got,
                                       most);
            for (int j = 0; j < more; j++, m++)
                CHECK(m < n && got[j].t0 == expected[m].t0 &&
                      got[j].t1 == expected[m].t1 &&
                      is_beyond(got[j].t0, &of, safety) &&
                      is_beyond(got[j].t1, &of, safety));
            if (more > 0)
                of.tmin = got[more - 1].t1;
        } while (more == (int)most);
        CHECK(m == n);
        found += (long)m;
        safe += safety > 0 && m > 0;
    }
    CHECK(found > 10000 && safe > 1000);
}

TEST(bad_members_of_one_solid_are_refused)
{
    const double p[3] = {0, 0, 0}, d[3] = {1, 0, 0};
    cylint_shape shape[CYLINT_SOLID_MEMBERS + 1];
    int clause[CYLINT_SOLID_MEMBERS + 1];
    cylint_interval piece[CYLINT_SOLID_PIECES];
    const cylint_interval nothing = {7, 7};
    cylint_line ray, bad;
    for (int i = 0; i <= CYLINT_SOLID_MEMBERS; i++) {
        cylint_sphere(&shape[i], p, 1 + i, CYLINT_ENDS_CAPPED);
        clause[i] = i % 2 ? -1 - i : 1;
    }
    cylint_ray(&ray, p, d);
    cylint_ray(&bad, p, p);
    piece[0] = nothing;
    CHECK(cylint_solid_pieces(shape, clause, CYLINT_SOLID_MEMBERS + 1, &ray,
                              piece, 9) == -1);
    CHECK(cylint_solid_pieces(shape, clause, 0, &ray, piece, 9) == 0);
    CHECK(cylint_solid_pieces(shape, clause, 2, &ray, piece, 0) == 0);
    CHECK(cylint_solid_pieces(shape, clause, 2, &bad, piece, 9) == 0);
    clause[5] = 0;
    CHECK(cylint_solid_pieces(shape, clause, 6, &ray, piece, 9) == -1);
    clause[5] = INT_MIN; /* it has no opposite */
    CHECK(cylint_solid_pieces(shape, clause, 7, &ray, piece, 9) == -1);
    CHECK(piece[0].t0 == nothing.t0 && piece[0].t1 == nothing.t1);
    clause[5] = -6;
    CHECK(cylint_solid_pieces(shape, clause, CYLINT_SOLID_MEMBERS, &ray, piece,
                              9) == 0);
    clause[CYLINT_SOLID_MEMBERS - 1] =
        1; /* a ball of this radius, without those */
    CHECK(cylint_solid_pieces(shape, clause, CYLINT_SOLID_MEMBERS, &ray, piece,
                              9) == 1 &&
          piece[0].t0 == CYLINT_SOLID_MEMBERS - 2 &&
          piece[0].t1 == (double)CYLINT_SOLID_MEMBERS);
}
