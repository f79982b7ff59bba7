/*
 * view.c - the camera, and the line for each point of the picture
 *
 * The eye is placed so that all boxes of shapes lie, with a margin, within the four
 * planes through the picture's edges.
 */
#include "picture.h"
#include "sampling.h"
#include "view.h"

/* The size of the picture over that of the scene. */
static const double MARGIN = 1.06;
static const double DEGREE = 0.017453292519943295;

/* The default direction: along the shorter horizontal side of the scene, from so
 * much aside and above, in degrees; a flat scene is viewed from above. */
enum { ASIDE = 28, ABOVE = 14, ABOVE_FLAT = 32 };

/* ------------------------------------------------- the default direction -- */

static double extent(const struct boxes *boxes, struct vector direction)
{
    return reach(boxes, direction) + reach(boxes, times(-1, direction));
}

/* u and v are horizontal; for the upward direction z they are x and y. */
static struct vector default_side(const struct boxes *boxes, struct vector up)
{
    const struct vector v = perpendicular(up), u = cross(v, up);
    const double along_u = extent(boxes, u), along_v = extent(boxes, v);
    const int is_flat = 2 * extent(boxes, up) < hypot(along_u, along_v);
    const double turn = DEGREE * (along_u < along_v ? ASIDE : ASIDE - 90);
    const double above = DEGREE * (is_flat ? ABOVE_FLAT : ABOVE);
    const struct vector horizontal = plus(times(cos(turn), u), sin(turn), v);
    return plus(times(cos(above), horizontal), sin(above), up);
}

/* ------------------------------------------------------------ framing -- */

static const char TOO_LARGE[] =
    "the scene is too large or too far from the camera for a picture";

/* Returns NULL, or why it is no direction of view. */
static const char *set_directions(struct view *view, struct vector forward,
                                  struct vector up)
{
    if (length(forward) == 0)
        return "--eye and --look-at are the same point";
    if (!(length(forward) < HUGE_VAL))
        return TOO_LARGE;
    view->forward = unit(forward);
    view->right = cross(view->forward, up);
    if (length(view->right) == 0)
        return "the view is along --up; choose another --up";
    view->right = unit(view->right);
    view->up = cross(view->right, view->forward);
    return NULL;
}

/*
 * A point p lies between the left and the right plane through the eye e if
 * (p - e).(+-right - h forward) <= 0, where h is half the picture's width at the
 * distance 1, or 0 for parallel rays.  Let m be the maximum of p.(...) over the
 * scene, for each sign: then e.(...) >= m.  The difference of the two gives the
 * eye's place between the planes.  Their sum, *size, is that of the scene between
 * parallel planes; divided by -2 h it bounds how far forward e may be.
 */
static struct vector between_edges(const struct boxes *boxes,
                                   struct vector right, struct vector forward,
                                   double half, double *size)
{
    const struct vector planes[2] = {plus(right, -half, forward),
                                     plus(times(-1, right), -half, forward)};
    double most[2];
    for (int k = 0; k < 2; k++)
        most[k] = reach(boxes, planes[k]) - dot(planes[k], boxes->middle);
    *size = most[0] + most[1];
    return times(0.5 * (most[0] - most[1]), right);
}

/* A parallel picture is as wide as the scene.  Its eye is the scene's size before
 * it, so that rounding puts it behind no shape. */
static void place_eye(struct view *view, double aspect,
                      const struct boxes *boxes)
{
    /* the margin widens the scene */
    const double w = view->is_parallel ? 0 : view->half_width / MARGIN;
    const double h = view->is_parallel ? 0 : view->half_height / MARGIN;
    double width, height, forward;
    const struct vector across =
        between_edges(boxes, view->right, view->forward, w, &width);
    const struct vector up =
        between_edges(boxes, view->up, view->forward, h, &height);
    if (view->is_parallel) {
        view->half_height = 0.5 * MARGIN * fmax(height, width / aspect);
        view->half_width = aspect * view->half_height;
        forward = -reach(boxes, times(-1, view->forward)) - boxes->size -
                  dot(view->forward, boxes->middle);
    } else {
        forward = -fmax(width / (2 * w), height / (2 * h));
    }
    view->eye = plus(plus(plus(boxes->middle, 1, across), 1, up), forward,
                     view->forward);
}

static int has_finite_size(const struct view *view)
{
    return view->half_width < HUGE_VAL && view->half_height < HUGE_VAL;
}

/* Whether doubles distinguish the rays of two neighbouring pixels. */
static int has_distinct_rays(const struct view *view, int rows)
{
    const double size = view->is_parallel ? length(view->eye) : 1;
    return size + 2 * view->half_height / rows > size;
}

const char *view_of_scene(struct view *view, const struct viewing *camera,
                          const struct boxes *boxes)
{
    const int is_placed = camera->has_eye && !camera->is_parallel;
    if (boxes->size == 0 && !(is_placed && camera->has_target))
        return "no bounded shape; use --eye and --look-at";
    if (!is_placed && !(boxes->size < HUGE_VAL))
        return TOO_LARGE;
    const struct vector up = unit(camera->up);
    const struct vector target =
        camera->has_target ? camera->target : boxes->middle;
    const struct vector backward = camera->has_eye ? minus(camera->eye, target)
                                   : camera->has_from ? camera->from
                                                      : default_side(boxes, up);
    view->is_parallel = camera->is_parallel;
    view->half_height = tan(0.5 * DEGREE * camera->fov);
    view->half_width = camera->aspect * view->half_height;
    const char *fault = set_directions(view, times(-1, backward), up);
    if (fault)
        return fault;
    if (camera->is_parallel || !camera->has_eye)
        place_eye(view, camera->aspect, boxes);
    if (camera->has_eye)
        view->eye = camera->eye;
    if (!is_finite(view->eye) || !has_finite_size(view))
        return TOO_LARGE;
    view->half_width /= camera->zoom;
    view->half_height /= camera->zoom;
    return !has_finite_size(view) ? "--zoom is too small"
           : !has_distinct_rays(view, camera->rows)
               ? "neighbouring pixels have the same ray; use a larger --fov or "
                 "a smaller --zoom"
               : NULL;
}

void view_sample(const struct drawing *drawing, int x, int y, int i,
                 cylint_line *ray)
{
    const struct view *view = drawing->view;
    const struct picture *picture = drawing->picture;
    double at[2] = {0.5, 0.5};
    if (drawing->samples > 1)
        sample_square((uint32_t)i, 0, at);
    const double right = 2 * (x + at[0]) / picture->width - 1;
    const double up = 1 - 2 * (y + at[1]) / picture->height;
    const struct vector across =
        plus(times(right * view->half_width, view->right),
             up * view->half_height, view->up);
    const struct vector o =
        view->is_parallel ? plus(view->eye, 1, across) : view->eye;
    const struct vector d =
        view->is_parallel ? view->forward : plus(view->forward, 1, across);
    cylint_ray(ray, o.v, d.v);
}
