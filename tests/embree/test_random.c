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

/* A line of another length that begins up to `apart` sizes of the scene from this
 * one.  turn: of its direction; components that are 0 stay 0, with any sign. */
static cylint_line beside(const cylint_line *line, double apart, double turn)
{
    const double size = longest_side(scene), length = between(0.01, 1.01);
    double o[3], d[3];
    cylint_line to = *line;
    for (int k = 0; k < 3; k++) {
        o[k] = line->o[k] + apart * size * between(-1, 1);
        d[k] = line->d[k] * length * (1 + turn * between(-1, 1));
        if (d[k] == 0 && one_of(2))
            d[k] = -d[k];
    }
    cylint_span(&to, o, d, line->tmin, line->tmax);
    return to;
}

/* No ray of a query with the flag for coherent rays begins on a surface, where
 * packets are an exception (cylint_embree.h). */
static int draw_line(enum scene_lines kind, uint64_t seed, uint64_t index,
                     int coherent, cylint_line *line)
{
    const int is_line = scene_line(scene, kind, seed, index, line) == CYLINT_OK;
    if (is_line && coherent)
        *line = beside(line, power(-4, -1), 0);
    return is_line;
}

/* Single rays, and packets of which all, some or none are active.  The rays of a
 * packet lie beside the first one, or two in three do, or one, or none. */
static void trace_lines(const struct world *w, enum scene_lines kind,
                        uint64_t seed, int rays)
{
    uint64_t index = 0;
    for (int n_rays = 0, turn = 0;
         n_rays < rays && index < 100u * (unsigned)rays; turn++) {
        struct rays r;
        cylint_line first;
        const int others = one_of(4), coherent = turn / 8 % 4 == 3;
        const double share = turn % 8 < 4 ? 1 : between(0, 1);
        const double apart = one_of(2) ? power(-4, 0) : 0, by = power(-4, 0);
        rays_begin(&r, rays_sizes[turn % 4]);
        if (!draw_line(kind, seed, index++, coherent, &first))
            continue;
        for (int i = 0; i < r.n; i++) {
            cylint_line line = i > 0 ? beside(&first, apart, by) : first;
            if (i % 3 > 2 - others &&
                !draw_line(kind, seed, index++, coherent, &line))
                continue;
            n_rays += add_line(&r, i, &line);
            if (r.n > 1 && !chance(share))
                r.valid[i] = 0; /* it too would hit */
        }
        if (r.n > 1 || r.valid[0])
            trace(w, &r, coherent);
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
                        1 + 2 * rays / (WORLD_SCENES * LINES_KINDS));
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
        trace_lines(&w, LINES_BEYOND, turn, 6000);
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
            trace_lines(&w, (enum scene_lines)kind, 1 + how, 2000);
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
