/*
 * view.c - where the picture is taken from, and a line for each of its points
 *
 * Framing is exact for the shapes' boxes: the eye is moved until every box
 * is within the four planes of the picture's edges and touches them.
 */
#include "view.h"

static const double MARGIN = 1.06; /* of the picture about the scene */
static const double DEGREE = 0.017453292519943295;

/* From the side where the scene is thinnest, this much aside and above: a
 * flat scene is looked down upon. */
static const double ASIDE = 28 * 0.017453292519943295;
static const double ABOVE = 14 * 0.017453292519943295;
static const double ABOVE_FLAT = 32 * 0.017453292519943295;

/* ------------------------------------------------- the side to look from -- */

/* Second moments of the shapes' middles, each as heavy as its box is long,
 * along the horizontal directions u and v and the vertical one. */
struct spread {
    double uu, uv, vv, ww;
};

static struct spread spread_of(const struct boxes *boxes, struct vector u,
                               struct vector v, struct vector w)
{
    struct spread s = {0, 0, 0, 0};
    for (size_t i = 0; i < boxes->count; i++) {
        const struct box *box = &boxes->box[i];
        const double weight = length(minus(box->high, box->low));
        const struct vector p = minus(box_middle(box), boxes->middle);
        const double x = dot(p, u), y = dot(p, v), z = dot(p, w);
        s.uu += weight * x * x;
        s.uv += weight * x * y;
        s.vv += weight * y * y;
        s.ww += weight * z * z;
    }
    return s;
}

/* The horizontal direction in which the scene is thinnest is the eigenvector
 * of the lesser eigenvalue; half the angle of (uu - vv, 2 uv) belongs to the
 * greater one. */
static struct vector flattering_side(const struct boxes *boxes,
                                     struct vector up)
{
    const struct vector v = perpendicular(up), u = cross(v, up);
    const struct spread s = spread_of(boxes, u, v, up);
    const double longest = 0.5 * atan2(2 * s.uv, s.uu - s.vv);
    const double turn = longest - 90 * DEGREE + ASIDE;
    const double above = 4 * s.ww < s.uu + s.vv ? ABOVE_FLAT : ABOVE;
    const struct vector level = plus(times(cos(turn), u), sin(turn), v);
    return plus(times(cos(above), level), sin(above), up);
}

/* ------------------------------------------------------------ framing -- */

static int look_along(struct view *view, struct vector forward,
                      struct vector up)
{
    view->forward = unit(forward);
    view->right = cross(view->forward, up);
    if (!(length(view->right) > 0) || !(length(forward) > 0)) {
        return 0;
    }
    view->right = unit(view->right);
    view->up = cross(view->right, view->forward);
    return 1;
}

/*
 * The eye e sees p between the planes to the left and to the right if
 * (p - e).(cos a (+-right) - sin a forward) <= 0, with tan a half the
 * picture's width at the distance 1.  With the most m of each product over
 * the scene, e.(...) >= m twice; adding them gives how far forward e may
 * be, subtracting where it stands between them.
 */
static double forward_most(double m_right, double m_left, double half)
{
    const double sine = half / sqrt(1 + half * half);
    return -(m_right + m_left) / (2 * sine);
}

static double halfway(double m_right, double m_left, double half)
{
    const double cosine = 1 / sqrt(1 + half * half);
    return (m_right - m_left) / (2 * cosine);
}

static struct vector edge_plane(struct vector outward, struct vector forward,
                                double half)
{
    const double cosine = 1 / sqrt(1 + half * half);
    return plus(times(cosine, outward), -cosine * half, forward);
}

static void stand_back(struct view *view, const struct boxes *boxes)
{
    /* With a margin the scene seems wider than it is. */
    const double w = view->half_width / MARGIN, h = view->half_height / MARGIN;
    const struct vector left = times(-1, view->right);
    const struct vector down = times(-1, view->up);
    const struct vector planes[4] = {edge_plane(view->right, view->forward, w),
                                     edge_plane(left, view->forward, w),
                                     edge_plane(view->up, view->forward, h),
                                     edge_plane(down, view->forward, h)};
    double most[4];
    for (int k = 0; k < 4; k++) {
        most[k] = reach(boxes, planes[k]) - dot(planes[k], boxes->middle);
    }
    view->eye = plus(
        plus(plus(boxes->middle, halfway(most[0], most[1], w), view->right),
             halfway(most[2], most[3], h), view->up),
        fmin(forward_most(most[0], most[1], w),
             forward_most(most[2], most[3], h)),
        view->forward);
}

/* The eye is where the scene begins, the picture as wide as the scene. */
static void stand_aside(struct view *view, double aspect,
                        const struct boxes *boxes)
{
    const double right = reach(boxes, view->right);
    const double left = reach(boxes, times(-1, view->right));
    const double up = reach(boxes, view->up);
    const double down = reach(boxes, times(-1, view->up));
    const double back = reach(boxes, times(-1, view->forward));
    view->half_height = 0.5 * MARGIN * fmax(up + down, (right + left) / aspect);
    view->half_width = aspect * view->half_height;
    view->eye = plus(plus(times(0.5 * (right - left), view->right),
                          0.5 * (up - down), view->up),
                     -back, view->forward);
}

int view_of_scene(struct view *view, const struct viewing *asked,
                  const struct boxes *boxes)
{
    if (boxes->size == 0 &&
        !(asked->has_eye && asked->has_target && !asked->parallel)) {
        return 0;
    }
    const struct vector up = unit(asked->up);
    const struct vector target =
        asked->has_target ? asked->target : boxes->middle;
    const struct vector backward = asked->has_eye ? minus(asked->eye, target)
                                   : asked->has_from
                                       ? asked->from
                                       : flattering_side(boxes, up);
    view->parallel = asked->parallel;
    view->half_height = tan(0.5 * DEGREE * asked->fov);
    view->half_width = asked->aspect * view->half_height;
    if (!look_along(view, times(-1, backward), up)) {
        return 0;
    }
    if (asked->parallel) {
        stand_aside(view, asked->aspect, boxes);
    } else if (!asked->has_eye) {
        stand_back(view, boxes);
    }
    if (asked->has_eye) {
        view->eye = asked->eye;
    }
    view->half_width /= asked->zoom;
    view->half_height /= asked->zoom;
    return 1;
}

void view_ray(const struct view *view, double x, double y, cylint_line *ray)
{
    const struct vector across = plus(times(x * view->half_width, view->right),
                                      y * view->half_height, view->up);
    const struct vector o =
        view->parallel ? plus(view->eye, 1, across) : view->eye;
    const struct vector d =
        view->parallel ? view->forward : plus(view->forward, 1, across);
    cylint_ray(ray, o.v, d.v);
}
