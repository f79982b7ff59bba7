/*
 * pieces.c - the pieces of a line, beside what a caller does without them
 *
 * The recipe: the numbers of all shapes, both roots of each, qsort(), merge.
 * Embree: a user geometry that collects chords (rivals/embree_chords.c).  Times
 * are per hit.
 */
#include "inputs.h"
#ifdef CYLINT_EMBREE
#include "embree.h"
#endif

enum { RAYS = 1024, ROOM = 1 << 16, WORK = 1 << 23 };

static struct {
    const cylint_shape *shapes;
    cylint_line line[RAYS];
    size_t numbers[ROOM];
    cylint_piece pieces[ROOM];
    char work[WORK];
    double end[2 * ROOM][2]; /* t, and 1 or -1 */
} in;

/* The length of the union of all chords. */
static double one_by_recipe(const cylint_scene *scene, const cylint_line *line)
{
    const size_t n = cylint_scene_all(scene, line, 0, in.numbers, ROOM);
    size_t ends = 0;
    for (size_t i = 0; i < n; i++) {
        cylint_answer a;
        const int hits = cylint_intersect(&in.shapes[in.numbers[i]], line,
                                          CYLINT_WANT_T, &a);
        for (int j = 0; j < 2; j++) {
            const int hit = j + hits - 2;
            in.end[ends][0] = hit < 0 ? line->tmin : a.hit[hit].t;
            in.end[ends++][1] = j == 0 ? 1 : -1;
        }
    }
    qsort(in.end, ends, sizeof *in.end, compare_doubles);
    double depth = 0, begin = 0, sum = 0;
    for (size_t i = 0; i < ends; i++) {
        if (depth == 0)
            begin = in.end[i][0];
        depth += in.end[i][1];
        if (depth == 0)
            sum += in.end[i][0] - begin;
    }
    return sum;
}

static double pieces_of(const cylint_scene *scene, const cylint_line *line,
                        cylint_piece_mode mode, size_t most)
{
    const cylint_piece_rule rule = {.mode = mode};
    cylint_workspace work = {in.work, sizeof in.work, 0};
    double sum = 0;
    const size_t n =
        cylint_scene_pieces(scene, line, &rule, in.pieces, most, &work);
    for (size_t i = 0; i < n; i++)
        sum += in.pieces[i].t1 - in.pieces[i].t0;
    return sum;
}

#define SCENE const cylint_scene *scene = scene_in_use()
BENCH_TURN(by_recipe, SCENE, one_by_recipe(scene, &in.line[i]))
BENCH_TURN(nearest, SCENE;
           cylint_hit hit,
           cylint_scene_nearest(scene, &in.line[i], CYLINT_WANT_T, &hit))
BENCH_TURN(all_of_union, SCENE,
           pieces_of(scene, &in.line[i], CYLINT_PIECES_UNION, ROOM))
BENCH_TURN(all_of_owners, SCENE,
           pieces_of(scene, &in.line[i], CYLINT_PIECES_OWNER, ROOM))
BENCH_TURN(first_of_union, SCENE,
           pieces_of(scene, &in.line[i], CYLINT_PIECES_UNION, 1))
#ifdef CYLINT_EMBREE
BENCH_TURN(by_embree, , embree_chords_union(input, &in.line[i]))
#endif

static void compare_scene(const struct sticks *s)
{
    size_t hits = 0;
    in.shapes = s->shapes;
    make_scenes(s);
    draw_incoherent(RAYS, in.line);
    for (int i = 0; i < RAYS; i++)
        hits += cylint_scene_count(scene_in_use(), &in.line[i], 0);
    struct contest c = {.subject = s->name,
                        .question = "union of all pieces",
                        .rival = "recipe",
                        .theirs = by_recipe,
                        .ours = all_of_union,
                        .questions = RAYS,
                        .units = (double)hits / RAYS};
    print_figure(s->name, "hits of a ray", NULL, NULL, "1", NAN, c.units);
    compete(&c);
    c.question = "pieces by owner";
    c.ours = all_of_owners;
    compete(&c);
#ifdef CYLINT_EMBREE
    struct embree_chords *chords = embree_chords_new(s->shapes, s->n);
    c.question = "union of all pieces";
    c.rival = "Embree and qsort()";
    c.theirs = by_embree;
    c.others = chords;
    c.ours = all_of_union;
    compete(&c);
    embree_chords_free(chords);
#endif
    compete(&(struct contest){.subject = s->name,
                              .question = "first piece",
                              .rival = "nearest",
                              .theirs = nearest,
                              .ours = first_of_union,
                              .questions = RAYS});
    free_scenes();
}

void bench_pieces(void)
{
    static const struct stick_kind *const kinds[] = {&thin, &fat};
    for (double n = 1e4; n <= most_or(1e6); n *= 10)
        for (int k = 0; k < 2; k++)
            with_sticks(kinds[k], n, 0, 1, compare_scene);
}
