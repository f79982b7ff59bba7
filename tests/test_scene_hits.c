/*
 * test_scene_hits.c - floors roots, batch and scene: point, normal, z and phi
 * have the same bits from every path
 *
 * The paths are: a single question with each set of wanted members, with each
 * build of the kernels, with a domain that ends at the hit, so that the filter
 * is undecided; the nearest shape of a pack and of a scene.  CYLINT_CASES and
 * CYLINT_SEED change the cases.
 */
#include <math.h>
#include <string.h>

#include "check.h"
#include "constructed.h"
#include "cylint_scene.h"
#include "families.h"

enum { CASES = 4000, SHAPES = 64 };

static const unsigned beside_t =
    CYLINT_WANT_POINT | CYLINT_WANT_NORMAL | CYLINT_WANT_Z | CYLINT_WANT_PHI;

static long hits_seen;

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
    return (!(want & CYLINT_WANT_POINT) ||
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
    REPORT("%s: %a %a %a  %a %a %a  %a %a", path, got->point[0], got->point[1],
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
    cylint_intersect(&c->shape, &c->line, want, &got);
    const int most = want & CYLINT_WANT_NEAREST ? 1 : 2;
    if (!CHECK(got.n == (all->n < most ? all->n : most)))
        return;
    for (int i = 0; i < got.n; i++)
        expect(c, path, &got.hit[i], &all->hit[i], want);
}

static void single_questions(const struct family_case *c,
                             const cylint_answer *all)
{
    static const unsigned wants[] = {CYLINT_WANT_POINT,
                                     CYLINT_WANT_NORMAL,
                                     CYLINT_WANT_Z,
                                     CYLINT_WANT_PHI | CYLINT_WANT_POINT,
                                     CYLINT_WANT_ALL,
                                     CYLINT_WANT_ALL | CYLINT_WANT_NEAREST,
                                     CYLINT_WANT_NORMAL | CYLINT_WANT_NEAREST};
    for (size_t i = 0; i < sizeof wants / sizeof *wants; i++)
        expect_all(c, "single", wants[i], all);
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
            cylint_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &got);
            for (int k = 0; k < got.n; k++)
                for (int j = 0; j < all->n; j++)
                    if (got.hit[k].t == all->hit[j].t &&
                        got.hit[k].side == all->hit[j].side)
                        expect(&c, "ended domain", &got.hit[k], &all->hit[j],
                               beside_t);
        }
}

static void every_kernel(const struct family_case *c, const cylint_answer *all)
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
        if (cylint_nearest(&pack, &c->line, CYLINT_WANT_ALL, &hit) == 0 &&
            CHECK(all->n > 0))
            expect(c, name, &hit, &all->hit[0], beside_t);
    }
    cylint_use_kernels(NULL);
}

static void every_path_gives_the_same_bits_for_a_shape(void)
{
    for (uint64_t i = 0; i < cases(); i++) {
        struct family_case c;
        cylint_answer all;
        if (!draw_case(i, &c))
            continue;
        cylint_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &all);
        hits_seen += all.n;
        if (all.n == 0)
            continue;
        single_questions(&c, &all);
        ended_domains(&c, &all);
        every_kernel(&c, &all);
    }
}

/* Lines against packs and scenes of all kinds of shapes: the hit of the nearest
 * shape has the bits of the single question. */
static void scenes_and_packs_give_the_bits_of_single_shapes(void)
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
            if (!draw_case(k, &c))
                continue;
            const size_t near =
                cylint_scene_nearest(scene, &c.line, CYLINT_WANT_ALL, &hit);
            if (near == SHAPES)
                continue;
            hits_seen++;
            c.shape = shapes[near];
            cylint_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &want);
            expect(&c, "scene", &hit, &want.hit[0], beside_t);
            if (CHECK(cylint_nearest(&pack, &c.line, CYLINT_WANT_ALL, &hit) ==
                      near))
                expect(&c, "pack", &hit, &want.hit[0], beside_t);
        }
        cylint_scene_free(scene);
    }
}

int main(void)
{
    RUN(every_path_gives_the_same_bits_for_a_shape);
    RUN(scenes_and_packs_give_the_bits_of_single_shapes);
    printf("note: %ld hits, seed %llu\n", hits_seen,
           (unsigned long long)seed());
    return check_end();
}
