/*
 * calls.c - which call when: shapes one by one, a pack, a scene
 *
 * For the nearest hits of random rays among sticks: the time of a line and of each
 * preparation, and for how many lines a preparation saves time.
 */
#include "inputs.h"

enum { LINES = 4096, LINES_A_CALL = 16, TURNS = 5 };
#define SECONDS 0.05 /* of a turn, at least */

static struct {
    const struct sticks *sticks;
    cylint_line line[LINES];
    cylint_pack pack;
    void *memory; /* of the pack */
    cylint_scene *scene;
} in;

typedef void timed_call(const cylint_line *line);

static void nearest_of_shapes(const cylint_line *line)
{
    cylint_answer a;
    for (int i = 0; i < LINES_A_CALL; i++)
        for (size_t j = 0; j < in.sticks->n; j++)
            cylint_intersect(&in.sticks->shapes[j], &line[i], CYLINT_WANT_T,
                             &a);
}

static void nearest_of_pack(const cylint_line *line)
{
    cylint_hit hit;
    for (int i = 0; i < LINES_A_CALL; i++)
        cylint_nearest(&in.pack, &line[i], CYLINT_WANT_T, &hit);
}

static void nearest_of_scene(const cylint_line *line)
{
    cylint_hit hit;
    for (int i = 0; i < LINES_A_CALL; i++)
        cylint_scene_nearest(in.scene, &line[i], CYLINT_WANT_T, &hit);
}

static void make_pack(const cylint_line *line)
{
    (void)line;
    cylint_pack_shapes(&in.pack, in.memory, in.sticks->shapes, in.sticks->n);
}

static void make_scene(const cylint_line *line)
{
    (void)line;
    cylint_scene_free(in.scene);
    in.scene = cylint_scene_new(in.sticks->shapes, in.sticks->n, 1, NULL);
    must(in.scene != NULL, "out of memory");
}

/* The least mean of several turns. */
static double seconds_of_call(timed_call *call)
{
    double least = HUGE_VAL;
    int at = 0;
    for (int turn = 0; turn < TURNS; turn++) {
        const double start = seconds_of(CLOCK_THREAD_CPUTIME_ID);
        double taken;
        int calls = 0;
        do {
            call(&in.line[at]);
            at = (at + LINES_A_CALL) % LINES;
            calls++;
            taken = seconds_of(CLOCK_THREAD_CPUTIME_ID) - start;
        } while (taken < SECONDS);
        least = fmin(least, taken / calls);
    }
    return least;
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
    in.sticks = s;
    in.memory = need(cylint_pack_bytes(s->n));
    draw_lines(draw_incoherent, LINES, in.line);
    const double pack = seconds_of_call(make_pack),
                 scene = seconds_of_call(make_scene),
                 by_shapes = seconds_of_call(nearest_of_shapes) / LINES_A_CALL,
                 by_pack = seconds_of_call(nearest_of_pack) / LINES_A_CALL,
                 by_scene = seconds_of_call(nearest_of_scene) / LINES_A_CALL,
                 per = 1e9 / (double)s->n;
    print_figure(s->name, "make a pack, a shape", NULL, NULL, "ns", NAN,
                 per * pack);
    print_figure(s->name, "make a scene, a shape", NULL, NULL, "ns", NAN,
                 per * scene);
    print_figure(s->name, "a line, a shape", NULL, NULL, "ns", NAN,
                 per * by_shapes);
    print_figure(s->name, "a line, a shape of a pack", NULL, NULL, "ns", NAN,
                 per * by_pack);
    print_figure(s->name, "a line, a scene", NULL, NULL, "ns", NAN,
                 1e9 * by_scene);
    print_lines("a pack, not shapes", pack, by_shapes, by_pack);
    print_lines("a scene, not a pack", scene - pack, by_pack, by_scene);
    print_lines("a scene, not shapes", scene, by_shapes, by_scene);
    cylint_scene_free(in.scene);
    in.scene = NULL;
    free(in.memory);
}

void bench_calls(void)
{
    for (double n = 100; n <= largest(1e6); n *= 10)
        with_sticks(&thin_sticks, n, 0, 1, compare_calls);
}
