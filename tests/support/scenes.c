/*
 * scenes.c - many shapes, and lines that are hard for a hierarchy of them
 */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "draw.h"
#include "families.h"
#include "scenes.h"
#include "shapes/layout.h"

/* ------------------------------------------------------ random numbers -- */

/* Begins the stream of a scene, or of a line. */
static void begin(uint64_t seed, uint64_t kind, uint64_t index)
{
    stream = seed;
    stream = random_bits(&stream) + kind;
    stream = random_bits(&stream) + index;
}

static cylint_ends any_ends(void)
{
    return (cylint_ends)one_of(4);
}

/* -------------------------------------------------------------- scenes -- */

static const char *const scene_names[SCENE_KINDS] = {
    "thin",  "fat",       "fibres",  "needles", "discs",
    "mixed", "unbounded", "distant", "lengths", "lattice",
    "small", "huge",      "round",   "strands", "strays"};

/* Length and radius in multiples of the mean distance of neighbours. */
static const double proportions[SCENE_KINDS][2] = {
    {3, 0.15}, {1.2, 0.4}, {10, 0.02}, {30, 3e-5}, {0.003, 1}};

static cylint_status stick(const double at[3], double length, double radius,
                           cylint_shape *shape)
{
    double d[3], top[3];
    const cylint_ends ends = any_ends();
    random_direction(d);
    along3(top, at, length, d);
    if (one_of(4) == 0)
        return cylint_cone(shape, at, radius, top, radius * between(0, 1),
                           ends);
    return cylint_cylinder(shape, at, top, radius, ends);
}

/* Any kind of shape, of about this size, some of them pointed. */
static cylint_status any_shape(const double at[3], double size,
                               cylint_ends ends, cylint_shape *shape)
{
    double d[3], a[3], b[3], top[3];
    random_direction(d);
    random_direction(a);
    random_direction(b);
    scale3(d, size);
    scale3(a, size / 3);
    scale3(b, size / 5);
    along3(top, at, 1, d);
    switch (one_of(6)) {
    case 0:
        return cylint_cylinder(shape, at, top, size * 0.2, ends);
    case 1:
        return cylint_cone(shape, at, size * 0.3, top,
                           one_of(2) ? 0 : size * 0.1, ends);
    case 2:
        return cylint_cone(shape, at, 0, top, size * 0.2, ends);
    case 3:
        return cylint_angle_cone(shape, at, d, between(5, 60), ends);
    case 4:
        return cylint_elliptic_cylinder(shape, at, a, b, d, ends);
    default:
        return cylint_elliptic_cone(shape, at, a, b, d, between(0, 2), ends);
    }
}

/* Whole numbers: neighbours share caps, rims and tangents, and some shapes occur
 * twice.  Round cones, of which some are balls, or cylinders and cones. */
static cylint_status lattice_shape(size_t n, int round, cylint_shape *shape)
{
    const size_t side = (size_t)cbrt((double)n) + 1;
    double at[3], top[3];
    for (int j = 0; j < 3; j++)
        top[j] = at[j] = (double)below(side);
    if (!round || one_of(4))
        top[below(3)] += 1;
    const int is_cylinder = !round && one_of(3) != 0;
    const cylint_ends ends = any_ends();
    if (is_cylinder)
        return cylint_cylinder(shape, at, top, 0.5, ends);
    return (round ? cylint_round_cone : cylint_cone)(
        shape, at, 0.5, top, 0.25 * (double)below(4), ends);
}

/* A capsule, round cone or sphere; some are pointed, of some one ball holds the
 * other. */
static cylint_status round_shape(const double at[3], double length,
                                 double radius, cylint_shape *shape)
{
    double d[3], top[3];
    const cylint_ends ends = one_of(2) ? CYLINT_ENDS_CAPPED : any_ends();
    random_direction(d);
    along3(top, at, length, d);
    switch (one_of(6)) {
    case 0:
        return cylint_sphere(shape, at, radius, CYLINT_ENDS_CAPPED);
    case 1:
        return cylint_round_cone(shape, at, radius, top, 0, ends);
    case 2:
        along3(top, at, radius * between(0, 1), d);
        return cylint_round_cone(shape, at, radius * between(0, 1), top, radius,
                                 ends);
    case 3:
        return cylint_round_cone(shape, at, radius * between(0, 1), top, radius,
                                 ends);
    default:
        return cylint_capsule(shape, at, top, radius, ends);
    }
}

/* In a cube of side cbrt(n), so that neighbours are about 1 apart. */
static cylint_status draw_shape(enum scene_kind kind, size_t n,
                                cylint_shape *shape)
{
    const double side = cbrt((double)n);
    double at[3];
    random_vector(at, side / 2);
    switch (kind) {
    case SCENE_MIXED:
        return any_shape(at, 1, any_ends(), shape);
    case SCENE_UNBOUNDED: /* and some that are refused */
        if (one_of(64) == 0)
            at[1] = NAN;
        return any_shape(
            at, 1, (cylint_ends)(one_of(16) ? below(4) : 4 + below(2)), shape);
    case SCENE_DISTANT:
        for (int j = 0; j < 3; j++)
            at[j] += 1e6 * side * (j - 0.7);
        return any_shape(at, 2, any_ends(), shape);
    case SCENE_LENGTHS: {
        const double length = power(-6, 7);
        for (int j = 0; j < 3; j++) {
            at[j] = between(-1e7, 1e7);
            at[j] *= power(-9, 0);
        }
        return stick(at, length, length * power(-2, 0), shape);
    }
    case SCENE_LATTICE:
        return lattice_shape(n, 0, shape);
    case SCENE_SMALL:
        scale3(at, 1e-130);
        return any_shape(at, 2e-130, any_ends(), shape);
    case SCENE_HUGE: { /* some beyond what a frame holds */
        const cylint_ends ends = any_ends();
        scale3(at, 1e110);
        return any_shape(at, one_of(32) ? 2e110 : 1e150, ends, shape);
    }
    case SCENE_ROUND:
        return one_of(4) ? round_shape(at, 1.5, 0.3, shape)
                         : lattice_shape(n, 1, shape);
    case SCENE_STRANDS:
        return round_shape(at, 10, 0.02, shape);
    case SCENE_STRAYS:
        if (one_of(100) == 0)
            scale3(at, power(3, 9));
        return stick(at, 1, 0.1, shape);
    default:
        return stick(at, proportions[kind][0], proportions[kind][1], shape);
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
    begin(seed, (uint64_t)kind, 0);
    for (size_t i = 0; i < n; i++) /* refused shapes stay */
        draw_shape((enum scene_kind)kind, n, &scene.shapes[i]);
    measure(&scene);
    return scene;
}

void scene_release(struct scene_shapes *scene)
{
    free(scene->shapes);
    scene->shapes = NULL;
}

/* --------------------------------------------------------------- lines -- */

static void point_in(const struct scene_shapes *s, double to[3])
{
    for (int j = 0; j < 3; j++)
        to[j] = between(s->lo[j], s->hi[j]);
}

static const cylint_shape *some_shape(const struct scene_shapes *s)
{
    return &s->shapes[below(s->n)];
}

/* A point of the shape or near it. */
static void point_near(const cylint_shape *shape, double to[3])
{
    along3(to, cylint_base(shape), between(0, 1), cylint_axis(shape));
    for (int j = 0; j < 3; j++)
        to[j] += between(-1, 1) * cylint_r0(shape) *
                 (shape->kind >= CYLINT_KIND_ACONE ? 0 : 0.6);
}

static cylint_status ray_to(const double from[3], const double to[3],
                            double scale, cylint_line *line)
{
    double d[3];
    minus3(d, to, from);
    scale3(d, scale);
    return cylint_ray(line, from, d);
}

/* A ray that is likely to hit some shape, and its nearest hit of that one:
 * 0 if there is none. */
static int some_hit(const struct scene_shapes *s, cylint_line *line,
                    cylint_hit *hit)
{
    const cylint_shape *shape = some_shape(s);
    double from[3], to[3];
    cylint_answer answer;
    point_in(s, from);
    point_near(shape, to);
    if (ray_to(from, to, 1, line) != CYLINT_OK ||
        !cylint_intersect(shape, line, CYLINT_WANT_ALL | CYLINT_WANT_NEAREST,
                          &answer))
        return 0;
    *hit = answer.hit[0];
    return 1;
}

static cylint_status camera_line(const struct scene_shapes *s,
                                 cylint_line *line)
{
    double to[3];
    const double size = longest_side(s),
                 eye[3] = {s->lo[0] - 0.7 * size, s->lo[1] - 0.4 * size,
                           s->hi[2] + 0.3 * size};
    point_in(s, to);
    return ray_to(eye, to, 1 / size, line);
}

static cylint_status random_line(const struct scene_shapes *s,
                                 cylint_line *line)
{
    double from[3], to[3];
    point_in(s, from);
    point_in(s, to);
    return ray_to(from, to, power(-8, 8), line);
}

static cylint_status grazing_line(const struct scene_shapes *s,
                                  cylint_line *line)
{
    cylint_hit hit;
    double other[3], d[3], o[3], at[3];
    if (!some_hit(s, line, &hit))
        return random_line(s, line);
    random_direction(other);
    cross3(d, hit.normal, other);
    const double size = longest_side(s);
    double off = one_of(3) == 0 ? 0 : one_of(2) ? size : -size;
    off *= power(-18, -8);
    along3(at, hit.point, off, hit.normal);
    along3(o, at, -between(0, 1) * size, d);
    return cylint_ray(line, o, d);
}

static cylint_status axis_line(const struct scene_shapes *s, cylint_line *line)
{
    const cylint_shape *shape = some_shape(s);
    double d[3], o[3], off[3];
    random_direction(off);
    copy3(d, cylint_axis(shape));
    if (one_of(2) == 0)
        along3(d, d, power(-14, -3) * sqrt(dot3(d, d)), off);
    random_direction(off);
    along3(o, cylint_base(shape), 0.5 * cylint_r0(shape), off);
    along3(o, o, -between(0, 5), d);
    for (int j = 0; j < 3; j++)
        d[j] *= one_of(4096) ? 1 : -1;
    return cylint_ray(line, o, d);
}

static cylint_status far_line(const struct scene_shapes *s, cylint_line *line)
{
    double to[3], d[3], o[3];
    const double size = longest_side(s), away = power(3, one_of(4) ? 6.5 : 16);
    point_near(some_shape(s), to);
    random_direction(d);
    scale3(d, size);
    along3(o, to, -away, d);
    return cylint_ray(line, o, d);
}

static cylint_status shadow_line(const struct scene_shapes *s,
                                 cylint_line *line)
{
    cylint_hit hit;
    if (!some_hit(s, line, &hit))
        return random_line(s, line);
    const double size = longest_side(s),
                 light[3] = {s->hi[0] + size, s->hi[1] + 2 * size,
                             s->hi[2] + 3 * size};
    return one_of(2) ? cylint_segment(line, hit.point, light)
                     : ray_to(hit.point, light, 1 / size, line);
}

static cylint_status beyond_line(const struct scene_shapes *s,
                                 cylint_line *line)
{
    cylint_hit hit;
    if (!some_hit(s, line, &hit))
        return random_line(s, line);
    const cylint_line was = *line;
    return cylint_span(line, was.o, was.d, nextafter(hit.t, HUGE_VAL),
                       HUGE_VAL);
}

static cylint_status segment_line(const struct scene_shapes *s,
                                  cylint_line *line)
{
    double from[3], to[3];
    point_in(s, from);
    point_in(s, to);
    if (one_of(2) == 0) { /* a short one, or one that begins far away */
        const double k = power(-4, one_of(2) ? 0 : 13);
        minus3(from, from, to);
        along3(from, to, k, from);
    }
    return cylint_segment(line, from, to);
}

static cylint_status span_line(const struct scene_shapes *s, cylint_line *line)
{
    double from[3], to[3], d[3];
    point_in(s, from);
    point_in(s, to);
    minus3(d, to, from);
    const double tmin = between(-2, 2), length = between(0, 2);
    switch (one_of(4)) {
    case 0:
        return cylint_whole_line(line, from, d);
    case 1:
        return cylint_span(line, from, d, -HUGE_VAL, tmin);
    default:
        return cylint_span(line, from, d, tmin, tmin + length);
    }
}

static cylint_status parallel_line(const struct scene_shapes *s,
                                   cylint_line *line)
{
    double o[3], d[3] = {0, 0, 0};
    point_in(s, o);
    if (one_of(2) == 0)
        for (int j = 0; j < 3; j++)
            o[j] = one_of(4)   ? floor(o[j]) + 0.5 * (double)below(3)
                   : one_of(2) ? s->lo[j]
                               : s->hi[j];
    for (int j = 0; j < 3; j++)
        d[j] = one_of(2) ? 0.0 : -0.0;
    set_any(d, one_of(2) ? 1 : -3);
    if (one_of(4) == 0)
        set_any(d, one_of(2) ? 2 : -5);
    return cylint_whole_line(line, o, d);
}

static cylint_status wild_line(const struct scene_shapes *s, cylint_line *line)
{
    double o[3], to[3], d[3];
    point_in(s, o);
    point_near(some_shape(s), to);
    minus3(d, to, o);
    const double size = longest_side(s);
    double u[3] = {d[0] / size, d[1] / size, d[2] / size};
    switch (one_of(8)) {
    case 0: /* no directions but subnormal ones */
        scale3(u, 0x1p-1060);
        return cylint_ray(line, o, u);
    case 1:
        scale3(u, 0x1p1000);
        return cylint_ray(line, o, u);
    case 2: /* one component next to nothing */
        set_any(d, one_of(2) ? 0x1p-1070 : -0x1p-300);
        return cylint_ray(line, o, d);
    case 3:
        along3(o, to, -0x1p1010, u);
        return ray_to(o, to, 1, line);
    case 4: /* a segment whose difference overflows */
        scale3(u, DBL_MAX);
        set3(o, -u[0], -u[1], -u[2]);
        return cylint_segment(line, o, u);
    case 5: /* refused */
        set_any(d, one_of(2) ? NAN : HUGE_VAL);
        return cylint_ray(line, o, d);
    case 6: /* where the line begins, t is in the millions */
        return cylint_span(line, o, d, 0x1p-1074,
                           between(0, 1) < 0.5 ? 0x1p-1040 : 1e300);
    default: { /* domain far from the origin, origin far from the scene */
        const double far = power(3, 14);
        double from[3];
        along3(from, o, -far, d);
        return cylint_span(line, from, d, far - 1, far + 1);
    }
    }
}

cylint_status scene_line(const struct scene_shapes *s, enum scene_lines kind,
                         uint64_t seed, uint64_t index, cylint_line *line)
{
    static cylint_status (*const make[LINES_KINDS])(const struct scene_shapes *,
                                                    cylint_line *) = {
        camera_line, random_line,   grazing_line, axis_line,
        far_line,    shadow_line,   beyond_line,  segment_line,
        span_line,   parallel_line, wild_line};
    begin(seed, 100 + (uint64_t)kind, index);
    return make[kind](s, line);
}
