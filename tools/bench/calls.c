/*
 * calls.c - which call when: shapes one by one, a pack, a scene
 *
 * For the nearest hits of random rays among sticks: the time of a line and of each
 * preparation, and for how many lines a preparation saves time.
 */
#include "inputs.h"

enum { LINES = 4096, LINES_LEAST = 16 };

static struct {
    const struct sticks *sticks;
    cylint_line line[LINES];
    cylint_pack pack;
    void *memory; /* of the pack */
    cylint_scene *scene;
} in;

static int hits_one_by_one(const cylint_line *line)
{
    cylint_answer a;
    int hits = 0;
    for (size_t j = 0; j < in.sticks->n; j++)
        hits +=
            cylint_intersect(&in.sticks->shapes[j], line, CYLINT_WANT_T, &a);
    return hits;
}

static int make_pack(int i)
{
    cylint_pack_shapes(&in.pack, in.memory, in.sticks->shapes, in.sticks->n);
    return i;
}

static size_t make_scene(int i)
{
    (void)i;
    cylint_scene_free(in.scene);
    in.scene = cylint_scene_new(in.sticks->shapes, in.sticks->n, 1, NULL);
    require(in.scene != NULL, "out of memory");
    return cylint_scene_size(in.scene);
}

BENCH_TURN(packs, , make_pack(i))
BENCH_TURN(scenes, , make_scene(i))
BENCH_TURN(by_shapes, , hits_one_by_one(&in.line[i]))
BENCH_TURN(by_pack, cylint_hit hit,
           cylint_nearest(&in.pack, &in.line[i], CYLINT_WANT_T, &hit))
BENCH_TURN(by_scene, cylint_hit hit,
           cylint_scene_nearest(in.scene, &in.line[i], CYLINT_WANT_T, &hit))

/* The ns of a line or a preparation, printed by `units`. */
static double ns_of(const char *question, bench_turn *turn, int questions,
                    double units)
{
    return units * compete(&(struct contest){.subject = in.sticks->name,
                                             .question = question,
                                             .ours = turn,
                                             .questions = questions,
                                             .units = units,
                                             .only_best_kernels = 1});
}

/* Infinite if the line takes longer with the preparation. */
static void print_lines(const char *question, double prepare, double without,
                        double with)
{
    print_figure(in.sticks->name, question, NULL, NULL, "lines", NAN,
                 with < without ? ceil(prepare / (without - with)) : HUGE_VAL);
}

static void compare_calls(const struct sticks *s)
{
    const double n = (double)s->n;
    const int lines = (int)fmax(LINES_LEAST, fmin(LINES, 1.6e7 / n));
    in.sticks = s;
    in.memory = allocate(cylint_pack_bytes(s->n));
    draw_incoherent(LINES, in.line);
    const double pack = ns_of("make a pack, a shape", packs, 1, n),
                 scene = ns_of("make a scene, a shape", scenes, 1, n),
                 shapes_line = ns_of("a line, a shape", by_shapes, lines, n),
                 pack_line =
                     ns_of("a line, a shape of a pack", by_pack, lines, n),
                 scene_line = ns_of("a line, a scene", by_scene, LINES, 1);
    print_lines("a pack, not shapes", pack, shapes_line, pack_line);
    print_lines("a scene, not a pack", scene - pack, pack_line, scene_line);
    print_lines("a scene, not shapes", scene, shapes_line, scene_line);
    cylint_scene_free(in.scene);
    in.scene = NULL;
    free(in.memory);
}

void bench_calls(void)
{
    for (double n = 100; n <= most_or(1e6); n *= 10)
        with_sticks(&thin_sticks, n, 0, 1, compare_calls);
}
