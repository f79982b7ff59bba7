/*
 * light.c - the colour along a line, and a picture of such lines
 *
 * Every surface is matt.  The sun, a disc, lights it with soft shadows, and so
 * does the visible part of the sky: one ray to each for every sample.  A ray begins
 * at a point of cylint_outside(), so it does not hit again what it leaves.
 * A pixel depends on its place only.
 */
#include "colours.h"
#include "picture.h"
#include "sampling.h"
#include "view.h"

/* Light on a surface perpendicular to it.  Under an open sky both together show
 * white as nearly white. */
static const struct vector SUN = {{2.05, 1.86, 1.58}};
static const struct vector ZENITH = {{0.50, 0.64, 0.86}};
static const struct vector HORIZON = {{0.80, 0.80, 0.78}};
static const struct vector BELOW = {{0.36, 0.33, 0.30}};
/* Light from a surface that hides the sky, as a share of the sky's. */
static const double BOUNCE = 0.22;
static const double SUN_RADIUS = 0.025; /* tangent of its angular radius */

enum { FOR_SUN = 1, FOR_SKY = 2 }; /* the purpose of samples */

/* The stage as one thread traces it.  Its memory is zero before use. */
struct tracer {
    const struct stage *stage;
    struct piece_memory memory;
    int has_failed; /* there was no memory: the samples are wrong */
};

/* Light times opacity, and opacity: 1 on a shape, 0 on none, between these where
 * the ground fades. */
struct sample {
    struct vector light;
    double opacity;
};

/* A place beside a hit, on the viewer's side of the shape.  `facing` is the normal
 * on that side. */
struct place {
    size_t number;
    struct vector point, facing;
    int is_leaving; /* rays from here leave the shape, which is convex */
};

/* ------------------------------------------------------------ surfaces -- */

/* The shape where the ray first enters or leaves the union of all solids, or the
 * number of all shapes. */
static size_t first_boundary_of_ray(struct tracer *tracer,
                                    const cylint_line *ray, unsigned want,
                                    cylint_hit *hit)
{
    const struct stage *stage = tracer->stage;
    const size_t number =
        first_boundary(stage->scene, ray, want, hit, &tracer->memory);
    if (number == CYLINT_NO_ROOM)
        tracer->has_failed = 1;
    return number < stage->count ? number : stage->count;
}

/* The normal of a boundary points out of the solid.  Writes the same hit as one of
 * the shape, which can be a bore: its normal points out of the shape.  Missing caps
 * count as present. */
static void make_hit_of_shape(cylint_shape *shape, const cylint_line *ray,
                              unsigned want, cylint_hit *hit)
{
    cylint_answer answer;
    if (shape->ends < CYLINT_ENDS_INFINITE)
        shape->ends = CYLINT_ENDS_CAPPED;
    const double t = hit->t;
    cylint_intersect(shape, ray, want, &answer);
    for (int i = 0; i < answer.n; i++)
        if (answer.hit[i].t == t)
            *hit = answer.hit[i];
}

/* Whether nothing is in the way of a ray along d.  The place is certainly on the
 * viewer's side of its shape.  If that is convex and the ray leaves it, it does
 * not hit the shape again, so that need not be tested. */
static int is_free(struct tracer *tracer, const struct place *at,
                   struct vector d)
{
    const struct stage *stage = tracer->stage;
    cylint_line ray;
    cylint_hit hit;
    if (cylint_ray(&ray, at->point.v, d.v) != CYLINT_OK)
        return 0;
    return stage->has_solids
               ? first_boundary_of_ray(tracer, &ray, 0, &hit) == stage->count
               : !cylint_scene_occluded(stage->scene, &ray,
                                        at->is_leaving ? at->number
                                                       : stage->count);
}

/* -------------------------------------------------------------- light -- */

static struct vector sky(const struct stage *stage, struct vector d)
{
    const double up = dot(d, stage->up);
    return up > 0 ? mixed(HORIZON, ZENITH, sqrt(up))
                  : mixed(HORIZON, BELOW, sqrt(-up));
}

static struct vector from_sun(struct tracer *tracer, const struct place *at,
                              uint32_t i, uint32_t seed)
{
    const struct stage *stage = tracer->stage;
    const struct vector disc =
        sample_disc(i, hash_words(seed, FOR_SUN), stage->sun);
    const struct vector d = unit(plus(stage->sun, SUN_RADIUS, disc));
    const double cosine = dot(d, at->facing);
    return cosine > 0 && is_free(tracer, at, d) ? times(cosine, SUN)
                                                : vector(0, 0, 0);
}

static struct vector from_sky(struct tracer *tracer, const struct place *at,
                              uint32_t i, uint32_t seed)
{
    const struct vector d =
        sample_hemisphere(i, hash_words(seed, FOR_SKY), at->facing);
    const struct vector light = sky(tracer->stage, d);
    return is_free(tracer, at, d) ? light : times(BOUNCE, light);
}

/* ------------------------------------------------------------- shading -- */

static struct vector shaded(struct tracer *tracer, const struct place *at,
                            const cylint_line *ray, struct vector colour,
                            uint32_t i, uint32_t seed)
{
    const struct vector d = vector_of(ray->d);
    switch (tracer->stage->shading) {
    case SHADE_NORMAL:
        return light_of_shares(0.5 + 0.5 * at->facing.v[0],
                               0.5 + 0.5 * at->facing.v[1],
                               0.5 + 0.5 * at->facing.v[2]);
    case SHADE_PLAIN:
        return times(-dot(unit(d), at->facing), colour);
    default:
        return filtered(colour, plus(from_sun(tracer, at, i, seed), 1,
                                     from_sky(tracer, at, i, seed)));
    }
}

/* The ground is opaque under the scene and fades out around it. */
static double opacity(const struct stage *stage, const struct place *at)
{
    if (!stage->has_ground || at->number + 1 < stage->count)
        return 1;
    const double far = length(minus(at->point, stage->middle)) / stage->size;
    return exp(-far * far);
}

/* A double cone is not; an unbounded cylinder is. */
static int is_convex(const cylint_shape *s)
{
    return s->ends != CYLINT_ENDS_INFINITE || s->kind == CYLINT_KIND_CYLINDER ||
           s->kind == CYLINT_KIND_ECYLINDER;
}

/* Sample i of the pixel whose hash is `seed`. */
static struct sample trace_sample(struct tracer *tracer, const cylint_line *ray,
                                  uint32_t i, uint32_t seed)
{
    const unsigned want = CYLINT_WANT_T | CYLINT_WANT_POINT |
                          CYLINT_WANT_NORMAL | CYLINT_WANT_PART;
    const struct stage *stage = tracer->stage;
    cylint_hit hit;
    cylint_shape hit_shape;
    const size_t shape =
        stage->has_solids ? first_boundary_of_ray(tracer, ray, want, &hit)
                          : cylint_scene_nearest(stage->scene, ray, want, &hit);
    if (shape == stage->count)
        return (struct sample){vector(0, 0, 0), 0};
    cylint_scene_shape(stage->scene, shape, &hit_shape);
    if (stage->has_solids)
        make_hit_of_shape(&hit_shape, ray, want, &hit);
    const struct vector normal = vector_of(hit.normal);
    const struct vector d = vector_of(ray->d);
    const int is_inside = dot(normal, d) > 0;
    struct place at = {shape, vector(0, 0, 0),
                       is_inside ? times(-1, normal) : normal,
                       !is_inside && is_convex(&hit_shape)};
    cylint_outside(&hit_shape, &hit, is_inside ? 1 : -1, at.point.v);
    const double covered = opacity(stage, &at);
    const struct vector light = shaded(
        tracer, &at, ray, light_of_colour(stage->colours[shape]), i, seed);
    return (struct sample){times(covered, light), covered};
}

/* ---------------------------------------------------------------- rows -- */

static struct sample pixel_of_samples(const struct drawing *d,
                                      struct tracer *tracer, int x, int y)
{
    const uint32_t seed = hash_words((uint32_t)x, (uint32_t)y);
    struct sample sum = {vector(0, 0, 0), 0};
    for (int i = 0; i < d->samples; i++) {
        cylint_line ray;
        view_sample(d, x, y, i, &ray);
        const struct sample one = trace_sample(tracer, &ray, (uint32_t)i, seed);
        sum.light = plus(sum.light, 1, one.light);
        sum.opacity += one.opacity;
    }
    const double share = 1.0 / d->samples;
    return (struct sample){times(share, sum.light), share * sum.opacity};
}

/* The light of sun and sky is brighter than white; it saturates slowly instead of
 * being clipped. */
static double exposed(const struct stage *stage, double light)
{
    return stage->shading == SHADE_LIGHT ? 1 - exp(-light) : light;
}

/* down: the share of the picture that is above the pixel's middle */
static void put_pixel(const struct stage *stage, double down,
                      struct sample mean, unsigned char *bytes)
{
    const struct backdrop *b = &stage->backdrop;
    const struct vector behind = mixed(b->top, b->bottom, down);
    for (int i = 0; i < 3; i++) {
        const double light =
            mean.opacity > 0 ? exposed(stage, mean.light.v[i] / mean.opacity)
                             : 0;
        bytes[i] = byte_of_light(b->is_transparent
                                     ? light
                                     : mean.opacity * light +
                                           (1 - mean.opacity) * behind.v[i]);
    }
    if (b->is_transparent)
        bytes[3] = (unsigned char)(255 * mean.opacity + 0.5);
}

static int trace_row(const struct drawing *d, const void *stage, int y)
{
    const struct picture *p = d->picture;
    struct tracer tracer = {.stage = stage};
    const double down = (y + 0.5) / p->height;
    unsigned char *bytes =
        p->pixels + (size_t)y * (size_t)p->width * (size_t)p->channels;
    for (int x = 0; x < p->width; x++, bytes += p->channels)
        put_pixel(stage, down, pixel_of_samples(d, &tracer, x, y), bytes);
    piece_memory_free(&tracer.memory);
    return !tracer.has_failed;
}

int trace(const struct drawing *d, const struct stage *stage)
{
    return draw_rows(d, trace_row, stage);
}
