/*
 * inputs.c - random shapes and rays, and scenes of sticks
 */
#include "inputs.h"

#include "families.h"
#include "shapes/layout.h"

const char *const kind_names[KINDS] = {[CYLINT_KIND_CYLINDER] = "cylinder",
                                       [CYLINT_KIND_CONE] = "cone",
                                       [CYLINT_KIND_ECYLINDER] =
                                           "elliptic cylinder",
                                       [CYLINT_KIND_SPHERE] = "sphere",
                                       [CYLINT_KIND_CAPSULE] = "capsule",
                                       [CYLINT_KIND_RCONE] = "round cone"};

double between(uint64_t *random, double low, double high)
{
    return low + (high - low) * random_unit(random);
}

double power_between(uint64_t *random, double low, double high)
{
    return pow(10, between(random, low, high));
}

void draw_direction(uint64_t *random, double d[3])
{
    do
        for (int i = 0; i < 3; i++)
            d[i] = between(random, -1, 1);
    while (dot3(d, d) > 1 || dot3(d, d) < 0.01);
    unit3(d, d);
}

double approach(double (*function)(double), double most, double wanted)
{
    double low = 0, high = most, value = 0;
    for (int step = 0; step < 16; step++) {
        const double middle = 0.5 * (low + high);
        value = function(middle);
        *(value > wanted ? &low : &high) = middle;
    }
    return value;
}

void draw_in_ball(uint64_t *random, double radius, double p[3])
{
    const double at = radius * cbrt(random_unit(random));
    draw_direction(random, p);
    scale3(p, at);
}

cylint_shape draw_shape(uint64_t *random, int kind, double ball)
{
    const family_shape word = (family_shape)(kind - CYLINT_KIND_CYLINDER);
    const int is_tapered =
        kind == CYLINT_KIND_CONE || kind == CYLINT_KIND_RCONE;
    struct family_case made = family_example(word);
    double r[2], p[3], h[3], a[3] = {0}, b[3] = {0};
    r[0] = between(random, 0.2, 0.5);
    r[1] = between(random, 0.05, 0.45);
    for (int i = 0; i < 3; i++) {
        p[i] = between(random, -1, 1);
        h[i] = between(random, -1, 1);
    }
    if (kind == CYLINT_KIND_ECYLINDER) {
        draw_direction(random, a);
        cross3(b, h, a);
        scale3(a, r[0]);
        scale3(b, r[1]);
    }
    if (kind == CYLINT_KIND_RCONE) /* neither ball is in the other */
        r[1] = fmax(r[1], r[0] - 0.5 * length3(h));
    if (ball > 0) {
        draw_in_ball(random, ball, p);
        add3(p, kind == CYLINT_KIND_SPHERE ? 0 : -0.5, h);
    }
    if (family_has_points(word))
        add3(h, 1, p);
    family_set_shape(&made, word, p, a, b, h, r[0], r[is_tapered]);
    made.ends = CYLINT_ENDS_CAPPED;
    require(family_make(&made), "a shape was refused");
    return made.shape;
}

void middle_of(const cylint_shape *s, double middle[3])
{
    copy3(middle, cylint_base(s));
    if (s->kind != CYLINT_KIND_SPHERE)
        add3(middle, 0.5, cylint_axis(s));
}

void make_ray(cylint_line *ray, const double o[3], const double d[3])
{
    require(cylint_ray(ray, o, d) == CYLINT_OK, "a ray was refused");
}

/* -------------------------------------------------------------- sticks -- */

const struct stick_kind thin_sticks = {"thin sticks", 1, 1.0 / 20},
                        fat_sticks = {"fat sticks", 1, 1.0 / 3},
                        thin = {"thin", 3, 1.0 / 20},
                        fat = {"fat", 1.2, 1.0 / 3},
                        fibres = {"fibres", 10, 1.0 / 500};

static void draw_stick(uint64_t *random, const double low[3], double width,
                       double length, double radius, size_t i, struct sticks *s)
{
    double d[3], p[2][3], r[2];
    draw_direction(random, d);
    for (int j = 0; j < 3; j++) {
        const double middle = low[j] + width * random_unit(random);
        for (int k = 0; k < 2; k++)
            p[k][j] = (float)(middle + (k - 0.5) * length * d[j]);
    }
    for (int k = 0; k < 2; k++)
        r[k] = (float)(radius * (s->is_round ? between(random, 0.5, 1) : 1));
    cylint_shape *to = &s->shapes[i];
    require((s->is_round ? cylint_round_cone(to, p[0], r[0], p[1], r[1],
                                             CYLINT_ENDS_CAPPED)
                         : cylint_cylinder(to, p[0], p[1], r[0],
                                           CYLINT_ENDS_CAPPED)) == CYLINT_OK,
            "a shape was refused");
}

static void draw_sticks(const struct stick_kind *kind, struct sticks *to)
{
    uint64_t random = 1;
    const size_t n = to->n, side = to->side;
    const double length = kind->length / cbrt((double)n);
    const double width = 1 / (double)side;
    const size_t cells = side * side * side;
    to->shapes = allocate(n * sizeof *to->shapes);
    for (size_t cell = 0; cell < cells; cell++) {
        const double low[3] = {width * (double)(cell % side),
                               width * (double)(cell / side % side),
                               width * (double)(cell / side / side)};
        for (size_t i = cell * n / cells; i < (cell + 1) * n / cells; i++)
            draw_stick(&random, low, width, length, length * kind->radius, i,
                       to);
    }
}

void with_sticks(const struct stick_kind *kind, double n, int is_round,
                 size_t side, void (*measure)(const struct sticks *s))
{
    struct sticks s = {.n = (size_t)n, .side = side, .is_round = is_round};
    snprintf(s.name, sizeof s.name, "%.0e %s%s", n, is_round ? "round " : "",
             kind->name);
    if (n > most_or(1e6) || !is_wanted(s.name))
        return;
    draw_sticks(kind, &s);
    measure(&s);
    free(s.shapes);
}

static void set_ray(cylint_line *ray, const double o[3], double d[3])
{
    double from[3];
    unit3(d, d);
    for (int j = 0; j < 3; j++) {
        from[j] = (float)o[j];
        d[j] = (float)d[j];
    }
    make_ray(ray, from, d);
}

void draw_incoherent(int n, cylint_line *ray)
{
    uint64_t random = 2;
    for (int i = 0; i < n; i++) {
        double o[3], d[3];
        draw_direction(&random, d);
        for (int j = 0; j < 3; j++)
            o[j] = random_unit(&random);
        set_ray(&ray[i], o, d);
    }
}

/* The bits of a ray's number in its tile are those of y x y x. */
void draw_coherent(int n, cylint_line *ray)
{
    const int side = (int)sqrt(n), across = side / 4;
    for (int i = 0; i < n; i++) {
        const int tile = i / 16;
        const int x = tile % across * 4 + (i & 1) + (i >> 2 & 1) * 2;
        const int y = tile / across * 4 + (i >> 1 & 1) + (i >> 3 & 1) * 2;
        const double eye[3] = {0.5, 0.5, -1};
        double d[3] = {(x + 0.5) / side - 0.5, (y + 0.5) / side - 0.5, 1};
        set_ray(&ray[i], eye, d);
    }
}

/* ---------------------------------------------------------------- scenes -- */

static cylint_scene *scenes[KERNELS_MOST];

void make_scenes(const struct sticks *s)
{
    for (int k = 0; use_kernels(k); k++) {
        scenes[k] = cylint_scene_new(s->shapes, s->n, 1, NULL);
        require(scenes[k] != NULL, "out of memory");
    }
}

const cylint_scene *scene_in_use(void)
{
    return scenes[kernels_in_use()];
}

void free_scenes(void)
{
    for (int k = 0; k < KERNELS_MOST; k++) {
        cylint_scene_free(scenes[k]);
        scenes[k] = NULL;
    }
}
