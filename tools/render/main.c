/*
 * main.c - cylint-render, a picture of a scene
 *
 * The locale is never set: numbers have a point everywhere.
 */
#include <stdlib.h>
#include <string.h>

#include "report.h"
#include "options.h"

const char *const program = "cylint-render";

struct job {
    struct options options;
    struct scene scene;
    uint32_t *colours; /* of the shapes, and of the ground behind them */
    struct stage stage;
    struct view view;
};

/* The ground is a flat cylinder under the scene, so wide that it has faded before
 * its rim. */
static int add_ground(struct job *job, const struct boxes *all)
{
    const struct vector up = job->stage.up;
    const double radius = 30 * all->size, depth = 0.01 * all->size;
    const double low = -reach(all, times(-1, up));
    const struct vector top = plus(all->middle, low - dot(up, all->middle), up);
    const struct vector base = plus(top, -depth, up);
    struct record record;
    if (cylint_cylinder(&record.shape, base.v, top.v, radius,
                        CYLINT_ENDS_CAPPED) != CYLINT_OK)
        return complain(EXIT_BAD, job->options.scene,
                        "the scene is too large for --ground");
    job->colours[job->scene.count] = job->options.ground.colour;
    return scene_add(&job->scene, &record);
}

/* The default: from the left above the camera. */
static struct vector sun_of(const struct options *o, const struct view *view)
{
    return unit(o->has_sun ? o->sun
                           : plus(plus(times(0.75, unit(o->viewing.up)), -0.7,
                                       view->right),
                                  -0.45, view->forward));
}

static struct backdrop backdrop_of(struct paint background)
{
    enum { SKY_TOP = 0xc3d7ea, SKY_BOTTOM = 0xf6f3ec };
    const int is_sky = background.word == BACKGROUND_SKY;
    const uint32_t colour = background.colour;
    return (struct backdrop){background.word == BACKGROUND_NONE,
                             light_of_colour(is_sky ? SKY_TOP : colour),
                             light_of_colour(is_sky ? SKY_BOTTOM : colour)};
}

/* The view contains the scene without the ground. */
static int set_stage(struct job *job, const struct boxes *boxes)
{
    const struct options *o = &job->options;
    const struct vector up = unit(o->viewing.up);
    job->colours = colours_make(&job->scene, (enum colouring)o->colouring.word,
                                o->colouring.colour, up);
    if (!job->colours)
        return EXIT_MEMORY;
    job->scene.keeps_labels = 0;
    labels_free(&job->scene.labels);
    const char *fault = view_of_scene(&job->view, &o->viewing, boxes);
    if (fault)
        return complain(EXIT_BAD, o->scene, "%s", fault);
    job->stage = (struct stage){.colours = job->colours,
                                .has_solids = job->scene.solids.count > 0,
                                .has_ground = o->ground.word != GROUND_NONE &&
                                              boxes->size > 0,
                                .middle = boxes->middle,
                                .size = boxes->size,
                                .shading = (enum shading)o->shading,
                                .sun = sun_of(o, &job->view),
                                .up = up,
                                .backdrop = backdrop_of(o->background)};
    const int status = job->stage.has_ground ? add_ground(job, boxes) : 0;
    job->stage.count = job->scene.count;
    return status;
}

static int prepare(struct job *job)
{
    const struct options *o = &job->options;
    struct boxes boxes;
    job->scene = (struct scene){o->scene, o->ends, o->swc, .keeps_labels = 1};
    int status = scene_read(&job->scene);
    if (status != 0)
        return status;
    status = boxes_make(&boxes, &job->scene);
    if (status == 0)
        status = set_stage(job, &boxes);
    boxes_free(&boxes);
    return status;
}

static int draw_picture(struct job *job, struct output *out)
{
    const struct options *o = &job->options;
    struct picture picture;
    const struct drawing drawing = {&picture, &job->view, o->samples,
                                    o->workers};
    int status = scene_build(&job->scene, o->workers);
    if (status != 0)
        return status;
    job->stage.scene = job->scene.shapes;
    status = picture_make(&picture, o->size[0], o->size[1],
                          o->has_xray                          ? 1
                          : job->stage.backdrop.is_transparent ? 4
                                                               : 3);
    if (status == 0)
        status = o->has_xray ? xray_picture(&drawing, o->mu, job->stage.scene)
                             : trace(&drawing, &job->stage);
    if (status == 0)
        status = picture_write(&picture, out);
    picture_free(&picture);
    return status;
}

int main(int argc, char **argv)
{
    static struct job job;
    const struct options *o = &job.options;
    struct output out;
    guard_standard_streams();
    int status = read_options(&job.options, argc, argv);
    if (status != 0 || o->about)
        return status != 0 ? status : print_about(o->about);
    const char *file = strcmp(o->output, "-") == 0 ? NULL : o->output;
    status =
        output_is_input(file, o->scene) ? EXIT_IO : output_open(&out, file, 1);
    if (status != 0)
        return status;
    status = prepare(&job);
    if (status == 0)
        status = draw_picture(&job, &out);
    const int closed = output_close(&out, status == 0);
    scene_free(&job.scene);
    free(job.colours);
    return status != 0 ? status : closed;
}
