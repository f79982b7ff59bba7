/*
 * scene.c - queries of scenes, and what it takes to build, move, save and open
 * them
 *
 * The time to refit, save or open a scene stands beside that to build it, which is
 * "theirs".
 */
#include <string.h>

#include "cylint_distance.h"
#include "inputs.h"

enum { RAYS = 4096 };

static struct {
    cylint_line line[RAYS];
} in;

/* --------------------------------------------------------------- queries -- */

static inline double closest_of(const cylint_scene *scene, int i)
{
    cylint_closest a = {.distance = 0};
    cylint_scene_closest(scene, in.line[i].o, HUGE_VAL, 0, &a);
    return a.distance;
}

#define SCENE const cylint_scene *scene = scene_in_use()
BENCH_TURN(nearest, SCENE;
           cylint_hit hit,
           cylint_scene_nearest(scene, &in.line[i], CYLINT_WANT_T, &hit))
BENCH_TURN(any, SCENE,
           cylint_scene_occluded(scene, &in.line[i], cylint_scene_size(scene)))
BENCH_TURN(count, SCENE, cylint_scene_count(scene, &in.line[i], 0))
BENCH_TURN(closest, SCENE, closest_of(scene, i))

/* ------------------------------------------------ building and files -- */

/* The least of three: the first one of a scene also prepares it. */
static double seconds_of_refit(cylint_scene *scene, const struct sticks *s,
                               size_t n)
{
    double least = HUGE_VAL;
    for (int turn = 0; turn < 3; turn++) {
        const double start = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
        require(cylint_scene_refit(scene, s->n / 3, n, s->shapes + s->n / 3) ==
                    CYLINT_SCENE_OK,
                "refit failed");
        least = fmin(least, seconds_of(CLOCK_PROCESS_CPUTIME_ID) - start);
    }
    return least;
}

static double seconds_to_open(const char *path, unsigned flags)
{
    cylint_scene_status status;
    cylint_hit hit;
    const double start = seconds_of(CLOCK_MONOTONIC);
    cylint_scene *scene = cylint_scene_open(path, flags, &status);
    require(scene != NULL, "a scene was not opened");
    cylint_scene_nearest(scene, &in.line[0], CYLINT_WANT_T, &hit);
    const double seconds = seconds_of(CLOCK_MONOTONIC) - start;
    cylint_scene_free(scene);
    return seconds;
}

static void measure_building(const struct sticks *s)
{
    char path[64] = "bench.scene";
    const char *folder = getenv("TMPDIR");
    if (folder && strlen(folder) < 40)
        snprintf(path, sizeof path, "%s/bench.scene", folder);
    const double start = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    cylint_scene *scene = cylint_scene_new(s->shapes, s->n, 1, NULL);
    const double build = seconds_of(CLOCK_PROCESS_CPUTIME_ID) - start;
    require(scene != NULL, "out of memory");
    print_figure(s->name, "build", NULL, NULL, "s", NAN, build);
    print_figure(s->name, "a shape", NULL, NULL, "bytes", NAN,
                 (double)cylint_scene_bytes(scene) / (double)s->n);
    print_figure(s->name, "refit 1 % of the shapes, unmoved", NULL, "build",
                 "s", build, seconds_of_refit(scene, s, s->n / 100));
    print_figure(s->name, "refit half of the shapes, unmoved", NULL, "build",
                 "s", build, seconds_of_refit(scene, s, s->n / 2));
    const double saved = seconds_of(CLOCK_MONOTONIC);
    require(cylint_scene_save(scene, path) == CYLINT_SCENE_OK,
            "a scene was not saved");
    print_figure(s->name, "save", NULL, "build", "s", build,
                 seconds_of(CLOCK_MONOTONIC) - saved);
    print_figure(s->name, "open trusted and first line", NULL, "build", "s",
                 build, seconds_to_open(path, CYLINT_SCENE_TRUSTED));
    print_figure(s->name, "open checked and first line", NULL, "build", "s",
                 build, seconds_to_open(path, 0));
    remove(path);
    cylint_scene_free(scene);
}

static void measure_queries(const struct sticks *s)
{
    static const struct {
        const char *name;
        draw_rays *draw;
        bench_turn *ours;
    } questions[] = {{"nearest; random rays", draw_incoherent, nearest},
                     {"any; random rays", draw_incoherent, any},
                     {"count; random rays", draw_incoherent, count},
                     {"closest to points", draw_incoherent, closest},
                     {"nearest; rays of a camera", draw_coherent, nearest}};
    make_scenes(s);
    for (size_t q = 0; q < sizeof questions / sizeof *questions; q++) {
        questions[q].draw(RAYS, in.line);
        compete(&(struct contest){.subject = s->name,
                                  .question = questions[q].name,
                                  .ours = questions[q].ours,
                                  .questions = RAYS});
    }
    free_scenes();
}

static void compare_scene(const struct sticks *s)
{
    measure_queries(s);
    measure_building(s);
}

void bench_scene(void)
{
    static const struct stick_kind *const kinds[] = {&thin, &fat, &fibres};
    const double sizes[] = {1e4, 1e6, most_or(1e6)};
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < (sizes[2] > 1e6 ? 3 : 2); i++)
            with_sticks(kinds[k], sizes[i], 0, 1, compare_scene);
}
