/*
 * test_hits.c - floors roots, batch and scene: the members of a hit have the
 * same bits from every path
 *
 * The paths are: a single question with sets of wanted members (16 a case, all
 * 128 of eight cases), with each build of the kernels, with a domain that ends
 * at the hit, so that the filter is undecided; the nearest shape of a pack and
 * of a scene, and its first shape not excluded.  All are asked again in the
 * environments of environment.h, in turn: one a case.  CYLINT_CASES and
 * CYLINT_SEED change the cases.
 */
#include <math.h>
#include <string.h>

#include "check.h"
#include "constructed.h"
#include "cylint_scene.h"
#include "environment.h"
#include "families.h"

enum { CASES = 4000, SHAPES = 64 };

static const unsigned beside_t =
    CYLINT_WANT_POINT | CYLINT_WANT_NORMAL | CYLINT_WANT_Z | CYLINT_WANT_PHI;

/* The members wanted of the nearest of several shapes: all if turn is 0, else one
 * of the six alone, in turn by case. */
static unsigned wanted(uint64_t i, int turn)
{
    return turn == 0 ? CYLINT_WANT_ALL : 1u << i % 6;
}

static long hits_seen;

/* That of the questions: the default one or another. */
static struct environment here;

static void next_environment(uint64_t i)
{
    here = environment_of((int)(i % ENVIRONMENTS));
    if (!can_treat_subnormals(here.tiny))
        here.tiny = 0;
}

static int intersect(const struct family_case *c, unsigned want,
                     cylint_answer *answer)
{
    memset(answer, 0, sizeof *answer);
    environment_set(here);
    cylint_intersect(&c->shape, &c->line, want, answer);
    environment_reset();
    return answer->n;
}

static size_t nearest_in_pack(const cylint_pack *pack, const cylint_line *line,
                              unsigned want, cylint_hit *hit)
{
    environment_set(here);
    const size_t nearest = cylint_nearest(pack, line, want, hit);
    environment_reset();
    return nearest;
}

static size_t nearest_in_scene(const cylint_scene *scene,
                               const cylint_line *line, unsigned want,
                               cylint_hit *hit)
{
    environment_set(here);
    const size_t nearest = cylint_scene_nearest(scene, line, want, hit);
    environment_reset();
    return nearest;
}

static uint64_t seed(void)
{
    return check_setting("CYLINT_SEED", 1);
}

static uint64_t cases(void)
{
    return check_setting("CYLINT_CASES", CASES);
}

/* Case i: of the families in turn, of coincidences, and of plain numbers. */
static int draw_case(uint64_t i, struct family_case *c)
{
    const uint64_t kinds = (uint64_t)family_count() + 6, kind = i % kinds;
    if (kind < (uint64_t)family_count()) {
        family_case(seed(), (int)kind, i, c);
    } else if (kind < kinds - 4) {
        struct family_case base;
        constructed_base(seed(), i, &base);
        const int all = constructed_neighbours(&base);
        return constructed_neighbour(&base, (int)(i * 37 % (uint64_t)all), c);
    } else {
        constructed_plain(seed(), i, c);
    }
    return 1;
}

static int same(const void *x, const void *y, size_t bytes)
{
    return memcmp(x, y, bytes) == 0;
}

static int same_hit(const cylint_hit *x, const cylint_hit *y, unsigned want)
{
    return (!(want & CYLINT_WANT_T) || same(&x->t, &y->t, sizeof x->t)) &&
           (!(want & CYLINT_WANT_PART) ||
            (x->part == y->part && x->side == y->side)) &&
           (!(want & CYLINT_WANT_POINT) ||
            same(x->point, y->point, sizeof x->point)) &&
           (!(want & CYLINT_WANT_NORMAL) ||
            same(x->normal, y->normal, sizeof x->normal)) &&
           (!(want & CYLINT_WANT_Z) || same(&x->z, &y->z, sizeof x->z)) &&
           (!(want & CYLINT_WANT_PHI) || same(&x->phi, &y->phi, sizeof x->phi));
}

static void expect(const struct family_case *c, const char *path,
                   const cylint_hit *got, const cylint_hit *want,
                   unsigned members)
{
    if (CHECK(same_hit(got, want, members)))
        return;
    REPORT("%s, members %#x, rounding %d, subnormals %d", path, members,
           here.rounding, here.tiny);
    REPORT("got  %a %a %a  %a %a %a  %a %a", got->point[0], got->point[1],
           got->point[2], got->normal[0], got->normal[1], got->normal[2],
           got->z, got->phi);
    REPORT("want %a %a %a  %a %a %a  %a %a", want->point[0], want->point[1],
           want->point[2], want->normal[0], want->normal[1], want->normal[2],
           want->z, want->phi);
    family_report(c);
}

static void expect_all(const struct family_case *c, const char *path,
                       unsigned want, const cylint_answer *all)
{
    cylint_answer got;
    const int most = want & CYLINT_WANT_NEAREST ? 1 : 2;
    if (!CHECK(intersect(c, want, &got) == (all->n < most ? all->n : most)))
        return;
    for (int i = 0; i < got.n; i++)
        expect(c, path, &got.hit[i], &all->hit[i], want);
}

static void single_questions(uint64_t i, const struct family_case *c,
                             const cylint_answer *all)
{
    for (unsigned want = (unsigned)(i % 8);
         want <= (CYLINT_WANT_ALL | CYLINT_WANT_NEAREST); want += 8)
        expect_all(c, "single", want, all);
}

/* A domain that ends at the hit.  Only exact signs decide whether the hit is in
 * it; it is not if the root was rounded away from it. */
static void ended_domains(const struct family_case *given,
                          const cylint_answer *all)
{
    for (int i = 0; i < all->n; i++)
        for (int end = 0; end < 2; end++) {
            struct family_case c = *given;
            cylint_answer got;
            const double t = all->hit[i].t;
            if (!(fabs(t) < HUGE_VAL))
                continue;
            c.line.tmin = end ? c.line.tmin : t;
            c.line.tmax = end ? t : c.line.tmax;
            intersect(&c, CYLINT_WANT_ALL, &got);
            for (int k = 0; k < got.n; k++)
                for (int j = 0; j < all->n; j++)
                    if (got.hit[k].t == all->hit[j].t &&
                        got.hit[k].side == all->hit[j].side)
                        expect(&c, "ended domain", &got.hit[k], &all->hit[j],
                               beside_t);
        }
}

static void every_kernel(uint64_t i, const struct family_case *c,
                         const cylint_answer *all)
{
    const char *name;
    for (int k = 0; (name = cylint_kernels_name(k)) != NULL; k++) {
        cylint_hit hit;
        cylint_pack pack;
        static char memory[1 << 16];
        if (!CHECK(cylint_use_kernels(name)) ||
            !CHECK(cylint_pack_bytes(1) <= sizeof memory))
            continue;
        expect_all(c, name, CYLINT_WANT_ALL, all);
        cylint_pack_shapes(&pack, memory, &c->shape, 1);
        for (int turn = 0; turn < 2; turn++) {
            const unsigned want = wanted(i, turn);
            if (CHECK(nearest_in_pack(&pack, &c->line, want, &hit) == 0))
                expect(c, name, &hit, &all->hit[0], want);
        }
    }
    cylint_use_kernels(NULL);
}

static void paths_of_a_shape(int other_environments)
{
    for (uint64_t i = 0; i < cases(); i++) {
        struct family_case c;
        cylint_answer all;
        next_environment(0);
        if (!draw_case(i, &c) || intersect(&c, CYLINT_WANT_ALL, &all) == 0)
            continue;
        hits_seen += all.n;
        if (other_environments)
            next_environment(i);
        single_questions(i, &c, &all);
        ended_domains(&c, &all);
        every_kernel(i, &c, &all);
    }
}

static void every_path_gives_the_same_bits_for_a_shape(void)
{
    paths_of_a_shape(0);
}

static void every_environment_gives_the_same_bits_for_a_shape(void)
{
    paths_of_a_shape(1);
}

/* Lines against packs and scenes of all kinds of shapes: the hit of the nearest
 * shape has the bits of the single question. */
static void paths_of_many_shapes(int other_environments)
{
    static cylint_shape shapes[SHAPES];
    static char memory[1 << 18];
    for (uint64_t from = 0; from < cases(); from += 2 * SHAPES) {
        struct family_case c;
        cylint_pack pack;
        for (size_t n = 0, k = from; n < SHAPES; k++)
            if (draw_case(k, &c))
                shapes[n++] = c.shape;
        cylint_scene *scene = cylint_scene_new(shapes, SHAPES, 1, NULL);
        if (!CHECK(scene != NULL) ||
            !CHECK(cylint_pack_bytes(SHAPES) <= sizeof memory))
            break;
        cylint_pack_shapes(&pack, memory, shapes, SHAPES);
        for (uint64_t k = from; k < from + 2 * SHAPES; k++) {
            cylint_hit hit;
            cylint_answer want;
            next_environment(0);
            if (!draw_case(k, &c))
                continue;
            const size_t near =
                nearest_in_scene(scene, &c.line, CYLINT_WANT_ALL, &hit);
            if (near == SHAPES)
                continue;
            hits_seen++;
            c.shape = shapes[near];
            intersect(&c, CYLINT_WANT_ALL, &want);
            if (other_environments)
                next_environment(k);
            for (int turn = 0; turn < 2; turn++) {
                const unsigned some = wanted(k, turn);
                if (CHECK(nearest_in_scene(scene, &c.line, some, &hit) == near))
                    expect(&c, "scene", &hit, &want.hit[0], some);
                if (CHECK(nearest_in_pack(&pack, &c.line, some, &hit) == near))
                    expect(&c, "pack", &hit, &want.hit[0], some);
            }
            environment_set(here);
            const size_t other = cylint_scene_nearest_other(
                scene, &c.line, near, CYLINT_WANT_ALL, &hit);
            environment_reset();
            if (other == SHAPES)
                continue;
            c.shape = shapes[other];
            next_environment(0);
            intersect(&c, CYLINT_WANT_ALL, &want);
            expect(&c, "other of the scene", &hit, &want.hit[0],
                   CYLINT_WANT_ALL);
        }
        cylint_scene_free(scene);
    }
}

static void scenes_and_packs_give_the_bits_of_single_shapes(void)
{
    paths_of_many_shapes(0);
}

static void scenes_and_packs_give_them_in_every_environment(void)
{
    paths_of_many_shapes(1);
}

int main(void)
{
    RUN(every_path_gives_the_same_bits_for_a_shape);
    RUN(every_environment_gives_the_same_bits_for_a_shape);
    RUN(scenes_and_packs_give_the_bits_of_single_shapes);
    RUN(scenes_and_packs_give_them_in_every_environment);
    printf("note: %ld hits, seed %llu\n", hits_seen,
           (unsigned long long)seed());
    return check_end();
}
