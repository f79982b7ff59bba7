/*
 * test_random.c - random rays and packets have the answers of brute force
 *
 * All kinds of lines, and packets of rays of all arrangements, through all kinds
 * of scenes, as float rays, compared with cylint_nearest() on the same floats.
 * From within three sizes of the scene every answer has the same bits.  Embree
 * misses some rays from farther away, up to 1e16 sizes, as cylint_embree.h says:
 * they are counted, and a reported hit must be a hit of the library.
 * CYLINT_CASES is the number of rays, and CYLINT_SEED changes all of them.
 */
#include <math.h>
#include <string.h>

#include "shapes/layout.h"
#include "embree_world.h"
#include "environment.h"

/* The rays so far; those from farther than `sizes` of the scene, as far as boxes
 * are wide enough; how often Embree had another answer to these. */
static const struct scene_shapes *scene;
static double sizes;
static struct {
    long rays, hits, far, missed;
} tally;

/* Makes a ray for Embree from the line.  Returns 0 if that is impossible. */
static int add_line(struct rays *r, int i, const cylint_line *line)
{
    float o[3], d[3];
    const float tnear = (float)fmax(line->tmin, 0), tfar = (float)line->tmax;
    int length = 0;
    for (int k = 0; k < 3; k++) {
        if (!(fabs(line->o[k]) < 1e18 && fabs(line->d[k]) < 1e18))
            return 0;
        o[k] = (float)line->o[k];
        d[k] = (float)line->d[k];
        /* less is 0 to Embree's boxes: the direction would be another */
        length |= fabsf(d[k]) > 1e-12f;
    }
    if (!length || !(tnear <= tfar))
        return 0;
    rays_add(r, i, o, d, tnear, tfar);
    return 1;
}

static int is_far(const cylint_line *line)
{
    const double away = sizes * longest_side(scene);
    int far = 0;
    for (int k = 0; k < 3; k++)
        far |= line->o[k] < scene->lo[k] - away ||
               line->o[k] > scene->hi[k] + away;
    return far;
}

static int may_miss(const cylint_line *line)
{
    const int far = is_far(line);
    tally.missed += far;
    return far;
}

static void trace(const struct world *w, struct rays *r, int coherent)
{
    const struct rays_query query = {.coherent = coherent};
    tally.hits += check_both_queries(w, r, &query);
    for (int i = 0; i < r->n; i++)
        if (r->valid[i]) {
            const cylint_line line = rays_line(r, i);
            tally.rays++;
            tally.far += is_far(&line);
        }
}

static void trace_lines(const struct world *w, enum scene_lines kind,
                        uint64_t seed, int rays)
{
    uint64_t index = 0;
    for (int n_rays = 0, turn = 0;
         n_rays < rays && index < 100u * (unsigned)rays; turn++) {
        struct rays r;
        rays_begin(&r, rays_sizes[turn % 4]);
        for (int i = 0; i < r.n; i++) {
            cylint_line line;
            if (scene_line(scene, kind, seed, index++, &line) == CYLINT_OK)
                n_rays += add_line(&r, i, &line);
        }
        if (r.n > 1 || r.valid[0])
            trace(w, &r, 0);
    }
}

/* -------------------------------------------------------------- packets -- */

/* Arrangements of the rays of a packet. */
enum manner {
    EYE,    /* from one point to points that are near each other */
    BEAM,   /* nearly parallel, from different places */
    MIXED,  /* as from an eye, but every third anywhere */
    OCTANT, /* only their signs are the same */
    AFAR,   /* from an eye a hundred to a million sizes away */
    ALONG,  /* parallel to the z axis, with zeros of both signs */
    SPANS,  /* from an eye among the shapes, with ends of domains there */
    ANYHOW,
    MANNERS
};

struct aim {
    double lo[3], size[3];
    double eye[3], at[3], spread;
};

static void point(const struct aim *a, double p[3])
{
    for (int k = 0; k < 3; k++)
        p[k] = a->lo[k] + a->size[k] * between(0, 1);
}

static struct aim draw_aim(enum manner manner)
{
    struct aim a;
    double lo[3], hi[3];
    float away[3];
    const double far = manner == AFAR    ? power(2, 6)
                       : manner == SPANS ? 0
                                         : between(0, 2);
    for (int k = 0; k < 3; k++) {
        a.lo[k] = scene->lo[k];
        a.size[k] = scene->hi[k] - scene->lo[k];
    }
    world_direction(away);
    cylint_bounds(&scene->shapes[below(scene->n)], lo, hi);
    for (int k = 0; k < 3; k++)
        a.at[k] = (lo[k] + hi[k]) / 2;
    point(&a, a.eye);
    for (int k = 0; k < 3; k++)
        a.eye[k] += far * a.size[k] * away[k];
    a.spread = power(-4, 0);
    return a;
}

/* A ray of the packet, with a random length. */
static void add(const struct aim *a, enum manner manner, struct rays *r, int i)
{
    const int anywhere = manner == ANYHOW || (manner == MIXED && i % 3 == 0);
    double from[3], to[3];
    float o[3], d[3], tnear = 0, tfar = HUGE_VALF;
    point(a, from);
    point(a, to);
    for (int k = 0; k < 3; k++) {
        const double sign = a->at[k] < a->eye[k] ? -1 : 1;
        if (manner == OCTANT)
            to[k] = from[k] + sign * fabs(to[k] - from[k]);
        else if (!anywhere) {
            to[k] = a->at[k] + a->spread * (to[k] - a->at[k]);
            from[k] = manner == ALONG && k < 2
                          ? to[k]
                          : a->eye[k] + (manner == BEAM ? to[k] - a->at[k] : 0);
        }
    }
    const double length = between(0.01, 1.01);
    for (int k = 0; k < 3; k++) {
        o[k] = (float)from[k];
        d[k] = (float)((to[k] - (double)o[k]) * length);
        if (manner == ALONG && k < 2)
            d[k] = chance(0.5) ? 0 : -0.0f;
    }
    if (manner == SPANS) {
        tnear = (float)(between(0, 1) / length);
        tfar = tnear + (float)(between(0, 1) / length);
    }
    rays_add(r, i, o, d, tnear, tfar);
}

/* All, some or none of the rays of a packet are active. */
static void trace_packets(const struct world *w, int packets)
{
    for (int turn = 0; turn < packets; turn++) {
        const enum manner manner = (enum manner)(turn % MANNERS);
        const struct aim a = draw_aim(manner);
        const double share = turn % 2 ? 1 : between(0, 1);
        struct rays r;
        rays_begin(&r, rays_sizes[1 + turn / MANNERS % 3]);
        for (int i = 0; i < r.n; i++) {
            add(&a, manner, &r, i);
            r.valid[i] = chance(share) ? -1 : 0; /* it too would hit */
        }
        trace(w, &r, turn / 2 % 2);
    }
}

/* ---------------------------------------------------------------- tests -- */

/* A world of the scene. */
static struct world world_of(const struct scene_shapes *s, unsigned how,
                             double far)
{
    struct world w = world_with(s->shapes, s->n, how);
    w.may_miss = may_miss;
    scene = s;
    sizes = far;
    return w;
}

static void answers_are_those_of_brute_force(unsigned how, double far)
{
    const int rays = (int)check_setting("CYLINT_CASES", 100000);
    memset(&tally, 0, sizeof tally);
    stream = check_seed();
    for (int i = 0; i < WORLD_SCENES; i++) {
        OWN_SHAPES s = scene_generate(world_scenes[i], 200, check_seed());
        OWN_WORLD w = world_of(&s, how, far);
        for (int kind = 0; kind < LINES_KINDS; kind++)
            trace_lines(&w, (enum scene_lines)kind, check_seed(),
                        1 + rays / (4 * WORLD_SCENES * LINES_KINDS));
        trace_packets(&w, 1 + rays / (6 * WORLD_SCENES));
    }
    CHECK(tally.rays >= rays / 2 && tally.hits > tally.rays / 4 &&
          tally.hits < tally.rays - tally.rays / 100);
    CHECK(tally.far < tally.rays / 4 && tally.missed <= tally.far / 20);
    printf("note: %ld rays, %ld hit, as by brute force; of %ld from farther "
           "than %g sizes %ld answers are others\n",
           tally.rays, tally.hits, tally.far, far, tally.missed);
}

TEST(leaves_answer_as_brute_force_does)
{
    EACH_KERNELS(k)
        answers_are_those_of_brute_force(0, 4095);
}

TEST(without_filters_leaves_answer_as_brute_force_does)
{
    answers_are_those_of_brute_force(CYLINT_EMBREE_NO_FILTERS, 4095);
}

TEST(primitives_answer_as_brute_force_does)
{
    answers_are_those_of_brute_force(CYLINT_EMBREE_SINGLE, 3);
}

TEST(bare_hits_are_those_of_brute_force_and_are_completed_later)
{
    answers_are_those_of_brute_force(CYLINT_EMBREE_BARE, 4095);
    answers_are_those_of_brute_force(CYLINT_EMBREE_BARE | CYLINT_EMBREE_SINGLE,
                                     3);
}

/* Lengths from 1e-6 to 1e7: the entry and the exit of a small shape may round
 * to the same float.  The entry is the hit even if the traversal finds the
 * piece with the exit first, and if it is bare and completed later. */
TEST(hits_of_a_shape_that_share_a_float_are_distinguished)
{
    memset(&tally, 0, sizeof tally);
    for (uint64_t turn = 1; turn <= 8; turn++) {
        OWN_SHAPES s = scene_generate(SCENE_LENGTHS, 300, turn);
        OWN_WORLD w = world_of(&s, turn % 2 ? 0 : CYLINT_EMBREE_BARE, 4095);
        trace_lines(&w, LINES_BEYOND, turn, 3000);
    }
    CHECK(tally.hits > tally.rays / 4);
}

/* The shapes beside the hierarchy are hit, and do not hide nearer ones.  Rays begin
 * near the others. */
TEST(distant_and_large_shapes_are_hit_among_others)
{
    memset(&tally, 0, sizeof tally);
    for (unsigned how = 0; how < 3; how++) {
        static const unsigned flags[] = {0, CYLINT_EMBREE_BARE,
                                         CYLINT_EMBREE_NO_FILTERS};
        OWN_SHAPES s =
            scene_generate(how == 1 ? SCENE_ROUND : SCENE_MIXED, 300, 1 + how);
        world_distant(s.shapes);
        OWN_WORLD w = world_of(&s, flags[how], 4095);
        for (int kind = 0; kind < LINES_KINDS; kind++)
            trace_lines(&w, (enum scene_lines)kind, 1 + how, 1000);
        trace_packets(&w, 1000);
    }
    CHECK(tally.hits > tally.rays / 4);
}

/* Certain occlusion in floats is right: a leaf of capped cylinders alone has it. */
TEST(rays_that_barely_miss_are_not_occluded)
{
    memset(&tally, 0, sizeof tally);
    for (int i = SCENE_THIN; i <= SCENE_FAT; i++) {
        OWN_SHAPES s = scene_generate(i, 100, check_seed());
        for (size_t k = 0; k < s.n; k++) {
            const cylint_shape was = s.shapes[k];
            cylint_cylinder(&s.shapes[k], cylint_base(&was), cylint_top(&was),
                            cylint_r0(&was), CYLINT_ENDS_CAPPED);
        }
        OWN_WORLD w = world_of(&s, CYLINT_EMBREE_NO_FILTERS, 4095);
        for (int kind = 0; kind < LINES_KINDS; kind++)
            trace_lines(&w, (enum scene_lines)kind, check_seed(), 2000);
    }
    CHECK(tally.hits > tally.rays / 4);
}
