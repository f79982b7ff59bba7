/*
 * scenes.c - many shapes, and lines that are hard for a hierarchy of them
 */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "families.h"
#include "random.h"
#include "scenes.h"
#include "vectors.h"
#include "shapes/layout.h"

/* ------------------------------------------------------ random numbers -- */

typedef struct {
    uint64_t state;
} dice;

static uint64_t bits(dice *r)
{
    return random_bits(&r->state);
}

static dice dice_of(uint64_t seed, uint64_t kind, uint64_t index)
{
    dice r = {seed};
    r.state = bits(&r) + kind;
    r.state = bits(&r) + index;
    return r;
}

static double between(dice *r, double low, double high)
{
    return low + (high - low) * random_unit(&r->state);
}

static size_t one_of(dice *r, size_t n)
{
    return (size_t)(bits(r) % n);
}

static double power(dice *r, double low, double high)
{
    return pow(10, between(r, low, high));
}

/* At most 1 in size, never 0. */
static void direction(dice *r, double d[3])
{
    do
        for (int j = 0; j < 3; j++)
            d[j] = between(r, -1, 1);
    while (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] > 1 ||
           (d[0] == 0 && d[1] == 0 && d[2] == 0));
}

static void unit(double d[3])
{
    const double length = sqrt(dot3(d, d));
    for (int j = 0; j < 3; j++)
        d[j] /= length;
}

static void along(double to[3], const double o[3], double t, const double d[3])
{
    for (int j = 0; j < 3; j++)
        to[j] = o[j] + t * d[j];
}

/* -------------------------------------------------------------- scenes -- */

static const char *const scene_names[SCENE_KINDS] = {
    "thin",    "fat",     "fibres",  "needles", "discs", "mixed", "unbounded",
    "distant", "lengths", "lattice", "small",   "huge",  "round", "strands"};

/* Length and radius in multiples of the mean distance of neighbours. */
static const double proportions[SCENE_KINDS][2] = {
    {3, 0.15}, {1.2, 0.4}, {10, 0.02}, {30, 3e-5}, {0.003, 1}};

static cylint_status stick(dice *r, const double at[3], double length,
                           double radius, cylint_shape *shape)
{
    double d[3], top[3];
    const cylint_ends ends = (cylint_ends)one_of(r, 4);
    direction(r, d);
    unit(d);
    along(top, at, length, d);
    if (bits(r) % 4 == 0)
        return cylint_cone(shape, at, radius, top, radius * between(r, 0, 1),
                           ends);
    return cylint_cylinder(shape, at, top, radius, ends);
}

/* Any kind of shape, of about this size, some of them pointed. */
static cylint_status any_shape(dice *r, const double at[3], double size,
                               cylint_ends ends, cylint_shape *shape)
{
    double d[3], a[3], b[3], top[3];
    direction(r, d);
    direction(r, a);
    direction(r, b);
    for (int j = 0; j < 3; j++) {
        d[j] *= size;
        a[j] *= size / 3;
        b[j] *= size / 5;
        top[j] = at[j] + d[j];
    }
    switch (bits(r) % 6) {
    case 0:
        return cylint_cylinder(shape, at, top, size * 0.2, ends);
    case 1:
        return cylint_cone(shape, at, size * 0.3, top,
                           bits(r) % 2 ? 0 : size * 0.1, ends);
    case 2:
        return cylint_cone(shape, at, 0, top, size * 0.2, ends);
    case 3:
        return cylint_angle_cone(shape, at, d, between(r, 5, 60), ends);
    case 4:
        return cylint_elliptic_cylinder(shape, at, a, b, d, ends);
    default:
        return cylint_elliptic_cone(shape, at, a, b, d, between(r, 0, 2), ends);
    }
}

/* Whole numbers: neighbours share caps, rims and tangents, and some shapes
 * occur twice. */
static cylint_status lattice_shape(dice *r, size_t n, cylint_shape *shape)
{
    const size_t side = (size_t)cbrt((double)n) + 1;
    double at[3], top[3];
    for (int j = 0; j < 3; j++)
        top[j] = at[j] = (double)one_of(r, side);
    top[one_of(r, 3)] += 1;
    if (bits(r) % 3 == 0)
        return cylint_cone(shape, at, 0.5, top, 0.25 * (double)one_of(r, 4),
                           (cylint_ends)one_of(r, 4));
    return cylint_cylinder(shape, at, top, 0.5, (cylint_ends)one_of(r, 4));
}

/* A capsule, rounded cone or sphere; some are pointed, of some one ball holds the
 * other. */
static cylint_status round_shape(dice *r, const double at[3], double length,
                                 double radius, cylint_shape *shape)
{
    double d[3], top[3];
    const cylint_ends ends =
        bits(r) % 2 ? CYLINT_ENDS_CAPPED : (cylint_ends)one_of(r, 4);
    direction(r, d);
    unit(d);
    along(top, at, length, d);
    switch (bits(r) % 6) {
    case 0:
        return cylint_sphere(shape, at, radius, CYLINT_ENDS_CAPPED);
    case 1:
        return cylint_round_cone(shape, at, radius, top, 0, ends);
    case 2:
        along(top, at, radius * between(r, 0, 1), d);
        return cylint_round_cone(shape, at, radius * between(r, 0, 1), top,
                                 radius, ends);
    case 3:
        return cylint_round_cone(shape, at, radius * between(r, 0, 1), top,
                                 radius, ends);
    default:
        return cylint_capsule(shape, at, top, radius, ends);
    }
}

static cylint_status round_lattice_shape(dice *r, size_t n, cylint_shape *shape)
{
    const size_t side = (size_t)cbrt((double)n) + 1;
    double at[3], top[3];
    for (int j = 0; j < 3; j++)
        top[j] = at[j] = (double)one_of(r, side);
    if (bits(r) % 4)
        top[one_of(r, 3)] += 1;
    return cylint_round_cone(shape, at, 0.5, top, 0.25 * (double)one_of(r, 4),
                             (cylint_ends)one_of(r, 4));
}

/* In a cube of side cbrt(n), so that neighbours are about 1 apart. */
static cylint_status draw_shape(dice *r, enum scene_kind kind, size_t n,
                                cylint_shape *shape)
{
    const double side = cbrt((double)n);
    double at[3];
    for (int j = 0; j < 3; j++)
        at[j] = between(r, -side / 2, side / 2);
    switch (kind) {
    case SCENE_MIXED:
        return any_shape(r, at, 1, (cylint_ends)one_of(r, 4), shape);
    case SCENE_UNBOUNDED: /* and some that are refused */
        if (bits(r) % 64 == 0)
            at[1] = NAN;
        return any_shape(
            r, at, 1,
            (cylint_ends)(bits(r) % 16 ? one_of(r, 4) : 4 + one_of(r, 2)),
            shape);
    case SCENE_DISTANT:
        for (int j = 0; j < 3; j++)
            at[j] += 1e6 * side * (j - 0.7);
        return any_shape(r, at, 2, (cylint_ends)one_of(r, 4), shape);
    case SCENE_LENGTHS: {
        const double length = power(r, -6, 7);
        for (int j = 0; j < 3; j++)
            at[j] = between(r, -1e7, 1e7) * power(r, -9, 0);
        return stick(r, at, length, length * power(r, -2, 0), shape);
    }
    case SCENE_LATTICE:
        return lattice_shape(r, n, shape);
    case SCENE_SMALL:
        for (int j = 0; j < 3; j++)
            at[j] *= 1e-130;
        return any_shape(r, at, 2e-130, (cylint_ends)one_of(r, 4), shape);
    case SCENE_HUGE: /* some beyond what a frame holds */
        for (int j = 0; j < 3; j++)
            at[j] *= 1e110;
        return any_shape(r, at, bits(r) % 32 ? 2e110 : 1e150,
                         (cylint_ends)one_of(r, 4), shape);
    case SCENE_ROUND:
        return bits(r) % 4 ? round_shape(r, at, 1.5, 0.3, shape)
                           : round_lattice_shape(r, n, shape);
    case SCENE_STRANDS:
        return round_shape(r, at, 10, 0.02, shape);
    default:
        return stick(r, at, proportions[kind][0], proportions[kind][1], shape);
    }
}

static void measure(struct scene_shapes *s)
{
    for (int j = 0; j < 3; j++) {
        s->lo[j] = HUGE_VAL;
        s->hi[j] = -HUGE_VAL;
    }
    for (size_t i = 0; i < s->n; i++) {
        double lo[3], hi[3];
        cylint_bounds(&s->shapes[i], lo, hi);
        for (int j = 0; j < 3; j++) {
            if (lo[j] >= -DBL_MAX && lo[j] < s->lo[j])
                s->lo[j] = lo[j];
            if (hi[j] <= DBL_MAX && hi[j] > s->hi[j])
                s->hi[j] = hi[j];
        }
    }
    for (int j = 0; j < 3; j++)
        if (!(s->lo[j] <= s->hi[j]))
            s->lo[j] = s->hi[j] = 0;
}

static cylint_shape *allocate(size_t n)
{
    cylint_shape *shapes = malloc((n > 0 ? n : 1) * sizeof *shapes);
    if (!shapes) {
        fputs("scenes: out of memory\n", stderr);
        exit(4);
    }
    return shapes;
}

struct scene_shapes scene_generate(int kind, size_t n, uint64_t seed)
{
    struct scene_shapes scene = {
        .name = scene_names[kind], .n = n, .shapes = allocate(n)};
    dice r = dice_of(seed, (uint64_t)kind, 0);
    for (size_t i = 0; i < n; i++) /* refused shapes stay */
        draw_shape(&r, (enum scene_kind)kind, n, &scene.shapes[i]);
    measure(&scene);
    return scene;
}

int scene_from(const char *name, const char *command,
               struct scene_shapes *scene)
{
    char text[4096];
    size_t full = 1024;
    FILE *lines = popen(command, "r");
    scene->name = name;
    scene->n = 0;
    scene->shapes = allocate(full);
    while (lines && fgets(text, sizeof text, lines)) {
        if (scene->n == full) {
            cylint_shape *more = allocate(2 * full);
            memcpy(more, scene->shapes, full * sizeof *more);
            free(scene->shapes);
            scene->shapes = more;
            full *= 2;
        }
        struct family_case c;
        if (family_parse(text, &c))
            scene->shapes[scene->n++] = c.shape;
    }
    if (lines)
        pclose(lines);
    measure(scene);
    if (scene->n == 0)
        scene_release(scene);
    return scene->n > 0;
}

void scene_release(struct scene_shapes *scene)
{
    free(scene->shapes);
    scene->shapes = NULL;
}

/* --------------------------------------------------------------- lines -- */

const char *const scene_lines_name[LINES_KINDS] = {
    "camera", "random",  "grazing", "axis",     "far", "shadow",
    "beyond", "segment", "span",    "parallel", "wild"};

static double size_of(const struct scene_shapes *s)
{
    double size = 0;
    for (int j = 0; j < 3; j++)
        size = fmax(size, s->hi[j] - s->lo[j]);
    return size;
}

static void point_in(dice *r, const struct scene_shapes *s, double to[3])
{
    for (int j = 0; j < 3; j++)
        to[j] = between(r, s->lo[j], s->hi[j]);
}

static const cylint_shape *some_shape(dice *r, const struct scene_shapes *s)
{
    return &s->shapes[one_of(r, s->n)];
}

/* A point of the shape or near it. */
static void point_near(dice *r, const cylint_shape *shape, double to[3])
{
    along(to, cylint_base(shape), between(r, 0, 1), cylint_axis(shape));
    for (int j = 0; j < 3; j++)
        to[j] += between(r, -1, 1) * cylint_r0(shape) *
                 (shape->kind >= CYLINT_KIND_ACONE ? 0 : 0.6);
}

static cylint_status ray_to(const double from[3], const double to[3],
                            double scale, cylint_line *line)
{
    double d[3];
    for (int j = 0; j < 3; j++)
        d[j] = (to[j] - from[j]) * scale;
    return cylint_ray(line, from, d);
}

/* A ray that is likely to hit some shape, and its nearest hit of that one:
 * 0 if there is none. */
static int some_hit(dice *r, const struct scene_shapes *s, cylint_line *line,
                    cylint_hit *hit)
{
    const cylint_shape *shape = some_shape(r, s);
    double from[3], to[3];
    cylint_answer answer;
    point_in(r, s, from);
    point_near(r, shape, to);
    if (ray_to(from, to, 1, line) != CYLINT_OK ||
        !cylint_intersect(shape, line, CYLINT_WANT_ALL | CYLINT_WANT_NEAREST,
                          &answer))
        return 0;
    *hit = answer.hit[0];
    return 1;
}

static cylint_status camera_line(dice *r, const struct scene_shapes *s,
                                 cylint_line *line)
{
    double to[3];
    const double size = size_of(s),
                 eye[3] = {s->lo[0] - 0.7 * size, s->lo[1] - 0.4 * size,
                           s->hi[2] + 0.3 * size};
    point_in(r, s, to);
    return ray_to(eye, to, 1 / size, line);
}

static cylint_status random_line(dice *r, const struct scene_shapes *s,
                                 cylint_line *line)
{
    double from[3], to[3];
    point_in(r, s, from);
    point_in(r, s, to);
    return ray_to(from, to, power(r, -8, 8), line);
}

static cylint_status grazing_line(dice *r, const struct scene_shapes *s,
                                  cylint_line *line)
{
    cylint_hit hit;
    double other[3], d[3], o[3], at[3];
    if (!some_hit(r, s, line, &hit))
        return random_line(r, s, line);
    direction(r, other);
    cross3(d, hit.normal, other);
    const double size = size_of(s);
    const double off = bits(r) % 3 == 0
                           ? 0
                           : (bits(r) % 2 ? 1 : -1) * power(r, -18, -8) * size;
    along(at, hit.point, off, hit.normal);
    along(o, at, -between(r, 0, 1) * size, d);
    return cylint_ray(line, o, d);
}

static cylint_status axis_line(dice *r, const struct scene_shapes *s,
                               cylint_line *line)
{
    const cylint_shape *shape = some_shape(r, s);
    double d[3], o[3], off[3];
    direction(r, off);
    for (int j = 0; j < 3; j++)
        d[j] = cylint_axis(shape)[j];
    if (bits(r) % 2 == 0)
        along(d, d, power(r, -14, -3) * sqrt(dot3(d, d)), off);
    direction(r, off);
    along(o, cylint_base(shape), 0.5 * cylint_r0(shape), off);
    along(o, o, -between(r, 0, 5), d);
    for (int j = 0; j < 3; j++)
        d[j] *= bits(r) % 4096 ? 1 : -1;
    return cylint_ray(line, o, d);
}

static cylint_status far_line(dice *r, const struct scene_shapes *s,
                              cylint_line *line)
{
    double to[3], d[3], o[3];
    const double size = size_of(s), away = power(r, 3, bits(r) % 4 ? 6.5 : 16);
    point_near(r, some_shape(r, s), to);
    direction(r, d);
    for (int j = 0; j < 3; j++)
        d[j] *= size;
    along(o, to, -away, d);
    return cylint_ray(line, o, d);
}

static cylint_status shadow_line(dice *r, const struct scene_shapes *s,
                                 cylint_line *line)
{
    cylint_hit hit;
    if (!some_hit(r, s, line, &hit))
        return random_line(r, s, line);
    const double size = size_of(s),
                 light[3] = {s->hi[0] + size, s->hi[1] + 2 * size,
                             s->hi[2] + 3 * size};
    return bits(r) % 2 ? cylint_segment(line, hit.point, light)
                       : ray_to(hit.point, light, 1 / size, line);
}

static cylint_status beyond_line(dice *r, const struct scene_shapes *s,
                                 cylint_line *line)
{
    cylint_hit hit;
    if (!some_hit(r, s, line, &hit))
        return random_line(r, s, line);
    const double o[3] = {line->o[0], line->o[1], line->o[2]};
    const double d[3] = {line->d[0], line->d[1], line->d[2]};
    return cylint_span(line, o, d, nextafter(hit.t, HUGE_VAL), HUGE_VAL);
}

static cylint_status segment_line(dice *r, const struct scene_shapes *s,
                                  cylint_line *line)
{
    double from[3], to[3];
    point_in(r, s, from);
    point_in(r, s, to);
    if (bits(r) % 2 == 0) { /* a short one, or one that begins far away */
        const double k = power(r, -4, bits(r) % 2 ? 0 : 13);
        for (int j = 0; j < 3; j++)
            from[j] = to[j] + k * (from[j] - to[j]);
    }
    return cylint_segment(line, from, to);
}

static cylint_status span_line(dice *r, const struct scene_shapes *s,
                               cylint_line *line)
{
    double from[3], to[3], d[3];
    point_in(r, s, from);
    point_in(r, s, to);
    for (int j = 0; j < 3; j++)
        d[j] = to[j] - from[j];
    const double tmin = between(r, -2, 2), length = between(r, 0, 2);
    switch (bits(r) % 4) {
    case 0:
        return cylint_whole_line(line, from, d);
    case 1:
        return cylint_span(line, from, d, -HUGE_VAL, tmin);
    default:
        return cylint_span(line, from, d, tmin, tmin + length);
    }
}

static cylint_status parallel_line(dice *r, const struct scene_shapes *s,
                                   cylint_line *line)
{
    double o[3], d[3] = {0, 0, 0};
    point_in(r, s, o);
    if (bits(r) % 2 == 0)
        for (int j = 0; j < 3; j++)
            o[j] = bits(r) % 4   ? floor(o[j]) + 0.5 * (double)one_of(r, 3)
                   : bits(r) % 2 ? s->lo[j]
                                 : s->hi[j];
    for (int j = 0; j < 3; j++)
        d[j] = bits(r) % 2 ? 0.0 : -0.0;
    d[one_of(r, 3)] = bits(r) % 2 ? 1 : -3;
    if (bits(r) % 4 == 0)
        d[one_of(r, 3)] = bits(r) % 2 ? 2 : -5;
    return cylint_whole_line(line, o, d);
}

static cylint_status wild_line(dice *r, const struct scene_shapes *s,
                               cylint_line *line)
{
    double o[3], to[3], d[3];
    point_in(r, s, o);
    point_near(r, some_shape(r, s), to);
    for (int j = 0; j < 3; j++)
        d[j] = to[j] - o[j];
    const double size = size_of(s);
    switch (bits(r) % 8) {
    case 0: /* no directions but subnormal ones */
        for (int j = 0; j < 3; j++)
            d[j] = d[j] / size * 0x1p-1060;
        return cylint_ray(line, o, d);
    case 1:
        for (int j = 0; j < 3; j++)
            d[j] = d[j] / size * 0x1p1000;
        return cylint_ray(line, o, d);
    case 2: /* one component next to nothing */
        d[one_of(r, 3)] = bits(r) % 2 ? 0x1p-1070 : -0x1p-300;
        return cylint_ray(line, o, d);
    case 3:
        for (int j = 0; j < 3; j++)
            o[j] = to[j] - d[j] / size * 0x1p1010;
        return ray_to(o, to, 1, line);
    case 4: { /* a segment whose difference overflows */
        double end[3];
        for (int j = 0; j < 3; j++) {
            o[j] = -d[j] / size * DBL_MAX;
            end[j] = d[j] / size * DBL_MAX;
        }
        return cylint_segment(line, o, end);
    }
    case 5: /* refused */
        d[one_of(r, 3)] = bits(r) % 2 ? NAN : HUGE_VAL;
        return cylint_ray(line, o, d);
    case 6: /* where the line begins, t is in the millions */
        return cylint_span(line, o, d, 0x1p-1074,
                           between(r, 0, 1) < 0.5 ? 0x1p-1040 : 1e300);
    default: { /* domain far from the origin, origin far from the scene */
        const double far = power(r, 3, 14);
        double from[3];
        along(from, o, -far, d);
        return cylint_span(line, from, d, far - 1, far + 1);
    }
    }
}

cylint_status scene_line(const struct scene_shapes *s, enum scene_lines kind,
                         uint64_t seed, uint64_t index, cylint_line *line)
{
    static cylint_status (*const make[LINES_KINDS])(
        dice *, const struct scene_shapes *, cylint_line *) = {
        camera_line, random_line,   grazing_line, axis_line,
        far_line,    shadow_line,   beyond_line,  segment_line,
        span_line,   parallel_line, wild_line};
    dice r = dice_of(seed, 100 + (uint64_t)kind, index);
    return make[kind](&r, s, line);
}
