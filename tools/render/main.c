/*
 * main.c - cylint-render, a picture of a scene
 *
 * The locale is never set: numbers have a point everywhere.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "main.h"
#include "options.h"
#include "processors.h"
#include "report.h"
#include "scene_read.h"
#include "stages.h"

const char *const program = "cylint-render";

static const char help[] =
    "cylint-render [OPTION]... SCENE -o FILE\n"
    "\n"
    "Renders a scene, as cylint -s reads it, and writes a PNG file.\n"
    "\n"
    "  -o FILE            the picture; - is standard output\n"
    "  --size WxH         pixels, default 1280x720\n"
    "  --samples N        rays per pixel, default 8\n"
    "  -j N               workers; the picture is the same\n"
    "  --eye X,Y,Z        the camera's place; default: the scene fits\n"
    "  --look-at X,Y,Z    the point that an --eye looks at, default the "
    "middle\n"
    "  --from X,Y,Z       only the direction to the camera\n"
    "  --up X,Y,Z         the upward direction, default 0,0,1\n"
    "  --fov DEGREES      from bottom to top, default 30\n"
    "  --ortho            parallel rays\n"
    "  --zoom FACTOR      enlarge about the picture's centre\n"
    "  --colour HOW       of shapes without a field #rrggbb in their records:\n"
    "                     number, label, kind, connected, radius, height,\n"
    "                     element, chain or #rrggbb\n"
    "  --shade HOW        light (default), plain or normal\n"
    "  --light X,Y,Z      the direction to the sun\n"
    "  --ground HOW       #rrggbb below the scene, or none (default)\n"
    "  --background HOW   sky (default), #rrggbb or none: transparent\n"
    "  --xray HOW         grey, by the length inside the solids: MU for\n"
    "                     exp(-MU length), auto for a fitting MU, or linear\n"
    "  --ends WORD        the ends of shapes whose records do not state them\n"
    "  --swc FORM         of a neuron, NAME.swc: cones (default) or round\n"
    "  --progress         report the progress on standard error\n"
    "  --help, --version\n"
    "\n"
    "Exit status: 0 done, 1 a bad scene, 2 usage, 3 input or output failed,\n"
    "4 out of memory.  See cylint-render(1).\n";

static int print_about(const char *what)
{
    fputs(strcmp(what, "help") == 0 ? help
                                    : "cylint-render " CYLINT_VERSION "\n",
          stdout);
    if (fflush(stdout) != 0) {
        complain_errno("standard output");
        return EXIT_IO;
    }
    return 0;
}

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
    record.tail = colour;
    record.tail_length = strlen(colour);
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
        (unsigned long long)o->width * (unsigned long long)o->height;
    const int is_xray = o->xray.scale != XRAY_NONE;
    struct picture picture;
    /* More builders than processors are not faster. */
    const int processors_here = processors();
    const int workers = o->workers > 0 ? o->workers : processors_here;
    const int builders = workers < processors_here ? workers : processors_here;
    int status = scene_prepare(scene, ACCEL_TREE, builders);
    if (status != 0) {
        return status;
    }
    stage->scene = scene->shapes;
    stages_end(stages, "built a scene of", cylint_scene_bytes(stage->scene),
               "bytes");
    status = picture_make(&picture, o->width, o->height,
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
    if (status == 0) {
        status = picture_write(&picture, out);
    }
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
    if (status == 0 && has_ground) {
        status = add_ground(scene, o->ground, up, boxes);
    }
    if (status == 0) {
        *stage = (struct stage){NULL,
                                scene->count,
                                colours->of,
                                scene->solids.count > 0,
                                has_ground,
                                boxes->middle,
                                boxes->size,
                                o->shading,
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
        if (status == 0) {
            status = set_stage(o, scene, colours, &boxes, stage, view);
        }
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
    if (status != 0 || options.print) {
        return status != 0 ? status : print_about(options.print);
    }
    colours.how = options.colouring;
    stages_start(&stages, options.progress);
    status = picture_open(&out, options.output);
    if (status != 0) {
        return status;
    }
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
