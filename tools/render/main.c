/*
 * main.c - cylint-render, a picture of a scene
 *
 * The locale is never set: numbers have a point everywhere.
 */
#include <stdio.h>
#include <string.h>

#include "main.h"
#include "options.h"
#include "progress.h"
#include "report.h"

const char *const program = "cylint-render";

/* -------------------------------------------------------------- stages -- */

struct stages {
    int reported;          /* on standard error */
    double last, last_cpu; /* seconds; of all threads together */
};

static void stages_start(struct stages *stages, int reported)
{
    *stages = (struct stages){reported, seconds_of(CLOCK_MONOTONIC),
                              seconds_of(CLOCK_PROCESS_CPUTIME_ID)};
}

/* Reports the time since the last call: `WHAT COUNT UNIT: SECONDS s, SECONDS s of
 * CPU`. */
static void stages_end(struct stages *stages, const char *what,
                       unsigned long long count, const char *unit)
{
    const struct stages before = *stages;
    stages_start(stages, before.reported);
    if (before.reported)
        fprintf(stderr, "%s: %s %llu %s: %.2f s, %.2f s of CPU\n", program,
                what, count, unit, stages->last - before.last,
                stages->last_cpu - before.last_cpu);
}

/* ------------------------------------------------------------- picture -- */

/* The ground is a flat cylinder under the scene, so wide that it has faded before
 * its rim.  Its record's tail has its colour. */
static int add_ground(struct scene *scene, const char *colour, struct vector up,
                      const struct boxes *all)
{
    const double radius = 30 * all->size, depth = 0.01 * all->size;
    const double low = -reach(all, times(-1, up));
    const struct vector top = plus(all->middle, low - dot(up, all->middle), up);
    const struct vector base = plus(top, -depth, up);
    struct record record;
    record.tail = string_of(colour);
    cylint_cylinder(&record.shape, base.v, top.v, radius, CYLINT_ENDS_CAPPED);
    return scene_add(scene, &record);
}

/* The default: from the left above the camera. */
static struct vector sun_of(const struct options *o, const struct view *view)
{
    return unit(o->has_sun ? o->sun
                           : plus(plus(times(0.75, unit(o->viewing.up)), -0.7,
                                       view->right),
                                  -0.45, view->forward));
}

static int draw_picture(const struct options *o, struct scene *scene,
                        struct stage *stage, const struct view *view,
                        struct stages *stages, struct output *out)
{
    const unsigned long long pixels =
        (unsigned long long)o->size[0] * (unsigned long long)o->size[1];
    const int is_xray = o->xray.scale != XRAY_NONE;
    struct picture picture;
    /* More builders than processors are not faster. */
    const int processors_here = processors();
    const int workers = o->workers > 0 ? o->workers : processors_here;
    const int builders = workers < processors_here ? workers : processors_here;
    int status = scene_build(scene, builders);
    if (status != 0)
        return status;
    stage->scene = scene->shapes;
    stages_end(stages, "built a scene of", cylint_scene_bytes(stage->scene),
               "bytes");
    status = picture_make(&picture, o->size[0], o->size[1],
                          is_xray                   ? 1
                          : o->backdrop.transparent ? 4
                                                    : 3);
    if (status == 0) {
        status = is_xray ? xray_picture(&picture, &o->xray, stage->scene, view,
                                        o->samples, workers, o->progress)
                         : trace(&picture, stage, view, &o->backdrop,
                                 o->samples, workers, o->progress);
    }
    stages_end(stages, "traced", pixels, "pixels");
    if (status == 0)
        status = picture_write(&picture, out);
    stages_end(stages, "wrote", pixels, "pixels");
    picture_free(&picture);
    return status;
}

/* The view contains the scene without the ground. */
static int set_stage(const struct options *o, struct scene *scene,
                     struct colours *colours, const struct boxes *boxes,
                     struct stage *stage, struct view *view)
{
    const int has_ground = o->ground && boxes->size > 0;
    const struct vector up = unit(o->viewing.up);
    int status = colours_complete(colours, scene, o->colour, up);
    if (status == 0 && !view_of_scene(view, &o->viewing, boxes)) {
        complain(o->scene, "no shape is bounded, or the view is along --up; "
                           "use --eye and --look-at");
        status = EXIT_BAD;
    }
    if (status == 0 && has_ground)
        status = add_ground(scene, o->ground, up, boxes);
    if (status == 0) {
        *stage = (struct stage){NULL,
                                scene->count,
                                colours->of,
                                scene->solids.count > 0,
                                has_ground,
                                boxes->middle,
                                boxes->size,
                                (enum shading)o->shading,
                                sun_of(o, view),
                                up};
    }
    return status;
}

static int prepare(const struct options *o, struct scene *scene,
                   struct colours *colours, struct stage *stage,
                   struct view *view)
{
    struct boxes boxes;
    int status = scene_read(scene, o->scene, o->ends, (enum swc_form)o->swc);
    if (status == 0) {
        status = boxes_make(&boxes, scene);
        if (status == 0)
            status = set_stage(o, scene, colours, &boxes, stage, view);
        boxes_free(&boxes);
    }
    return status;
}

int main(int argc, char **argv)
{
    struct options options;
    struct colours colours = {0};
    struct scene scene;
    struct stage stage;
    struct view view;
    struct stages stages;
    struct output out;
    guard_standard_streams();
    memset(&scene, 0, sizeof scene);
    scene.also = colours_take_tail;
    scene.context = &colours;
    int status = read_options(&options, argc, argv);
    if (status != 0 || options.print)
        return status != 0 ? status : print_about(options.print);
    colours.how = options.colouring;
    stages_start(&stages, options.progress);
    status = output_open(
        &out, strcmp(options.output, "-") == 0 ? NULL : options.output, 1);
    if (status != 0)
        return status;
    status = prepare(&options, &scene, &colours, &stage, &view);
    if (status == 0) {
        stages_end(&stages, "read", stage.count, "shapes");
        status = draw_picture(&options, &scene, &stage, &view, &stages, &out);
    }
    const int closed = output_close(&out, status == 0);
    scene_free(&scene);
    colours_free(&colours);
    return status != 0 ? status : closed;
}
