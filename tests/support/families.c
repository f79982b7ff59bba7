/*
 * families.c - the random lines and shapes of all tests and benchmarks
 *
 * Most families set the line by points in the shape's own coordinates
 * (x a + y b + z h, with x = y = 1 one radius), so the difficulty is the same
 * for every kind of shape.  Families of exact coincidences use small whole
 * numbers, because rounding would destroy the coincidence.  Every case has a
 * stream of random numbers of its own.
 */
#include "families.h"

#include <math.h>
#include <string.h>

#include "families_draw.h"

/* ------------------------------------------------------------ families -- */

/* A point at z in a square about the axis, of 2 `size` radii. */
static void place_near(const frame *f, double size, double z, double p[3])
{
    const double y = between(-size, size), x = between(-size, size);
    place(f, x, y, z, p);
}

/* A line through two points in a box about the shape. */
static void aim(struct family_case *out, const frame *f, double size)
{
    double p[3], q[3];
    place_near(f, size, between(-size, 1 + size), p);
    place_near(f, 1, between(0, 1), q);
    add3(q, -1, p);
    scale3(q, power(-0.5, 0.5));
    write_line(out, p, q);
}

static void ordinary(struct family_case *out)
{
    frame f;
    simple_shape(out, &f, any_word());
    aim(out, &f, 3);
}

/* Moves line and shape by v. */
static void translate(struct family_case *c, const double v[3])
{
    add3(c->shape_data, 1, v);
    if (family_has_points(c->shape_word))
        add3(c->shape_data + family_axis(c->shape_word), 1, v);
    add3(c->line_data, 1, v);
    if (c->line_word == FAMILY_SEGMENT)
        add3(c->line_data + 3, 1, v);
}

static void nearly_parallel(struct family_case *out)
{
    frame f;
    double p[3], d[3], aside[3];
    simple_shape(out, &f, any_word());
    const double factor = chance(0.3) ? 1 : between(0, 1.2);
    surface_point(&f, any_z(&f), factor, p);
    copy3(d, f.h);
    random_direction(aside);
    add3(d, power(-12, -3), aside);
    write_line_from(out, p, d, between(-2, 2));
}

/* ----- whole numbers: coincidences that are exact ---------------------- */

/* unit: the most of a component of a short direction. */
static void draw_grid(struct family_case *out, int most, int unit)
{
    double p[3], d[3];
    whole_shape(out, most);
    whole_point(p, 2 * most);
    whole_vector(d, chance(0.5) ? unit : most);
    write_line(out, p, d);
    if (out->line_word == FAMILY_SPAN) {
        out->line_data[6] = whole_between(-4, 1);
        out->line_data[7] = out->line_data[6] + whole_between(0, 5);
    }
}

static void integer_grid(struct family_case *out)
{
    draw_grid(out, 3, 1);
}

/* Numbers as people write them: whole, or in tenths, which doubles round. */
static void plain(struct family_case *out)
{
    const int most = 1 << (1 + one_of(5)), by = one_of(3) ? 1 : 10;
    draw_grid(out, by * most, by);
    for (int i = 0; i < 6; i++)
        out->line_data[i] /= by;
    for (int i = 0; i < family_lengths(out->shape_word); i++)
        out->shape_data[i] /= by;
}

/* A number far from all others, so that sums nearly cancel. */
static void add_odd_number(struct family_case *c)
{
    static const double odd[] = {1e17, 1e-17, 1e-9, 1e9, 0x1p-1022, 1e150};
    const double x = odd[one_of(6)];
    if (chance(0.6))
        c->shape_data[family_shape_size(c->shape_word) - 1] = x;
    else
        c->line_data[one_of(6)] *= x;
}

static void exactly_parallel(struct family_case *out)
{
    double p[3], d[3];
    whole_shape(out, 3);
    axis_of(out, d);
    scale3(d, ldexp(1, whole_between(-3, 3)));
    scale3(d, chance(0.5) ? 1 : -1);
    for (int i = 0; i < 3; i++)
        p[i] = out->shape_data[i] + whole_between(-5, 5);
    if (out->shape_word >= FAMILY_ECYLINDER && chance(0.5)) { /* on it */
        const int axis = chance(0.5) ? 3 : 6;
        for (int i = 0; i < 3; i++)
            p[i] = out->shape_data[i] + out->shape_data[axis + i];
    }
    write_line(out, p, d);
    if (chance(0.2)) {
        const int i = one_of(6);
        out->line_data[i] = stepped(out->line_data[i], whole_between(-4, 4));
    }
}

/* ----- scales ----------------------------------------------------------- */

static void multiply(double *x, int n, double by)
{
    for (int i = 0; i < n; i++)
        x[i] *= by;
}

/* Multiplies lengths by `by`, but no directions of lines and no factors. */
static void enlarge(struct family_case *c, double by)
{
    multiply(c->shape_data, family_lengths(c->shape_word), by);
    multiply(c->line_data, c->line_word == FAMILY_SEGMENT ? 6 : 3, by);
}

/* Multiplies the direction of a line that has one. */
static void lengthen(struct family_case *c, double by)
{
    multiply(c->line_data + 3, c->line_word == FAMILY_SEGMENT ? 0 : 3, by);
}

/* Very small or large radii, needles, discs, and narrow or wide cones. */
static void odd_sizes(struct family_case *out)
{
    static const double ratios[] = {1e12, 1e-12, 1e8, 1e-8, 1e6, 1e-6};
    frame f;
    const family_shape word = any_word();
    const double ratio = ratios[one_of(6)], h = between(0.2, 3);
    if (chance(0.5))
        make_frame(&f, word, ratio, h);
    else
        make_frame(&f, word, h, h * ratio);
    write_shape(out, word, &f);
    aim(out, &f, 1.5);
}

/* ----- changes of a case ------------------------------------------------ */

static void translate_far(struct family_case *c)
{
    double v[3];
    random_direction(v);
    scale3(v, power(4, 8));
    translate(c, v);
}

static void scale(struct family_case *c)
{
    enlarge(c, power(-100, 100));
    lengthen(c, power(-100, 100));
}

static void lengthen_direction(struct family_case *c)
{
    lengthen(c, power(-8, 8));
}

static void make_subnormal(struct family_case *c)
{
    enlarge(c, ldexp(1, whole_between(-1074, -1000)));
    lengthen(c, ldexp(1, whole_between(-1074, 0)));
}

static void make_huge(struct family_case *c)
{
    enlarge(c, ldexp(1, whole_between(980, 1019)));
    lengthen(c, ldexp(1, whole_between(0, 1020)));
}

static void make_extreme(struct family_case *c)
{
    (chance(0.5) ? make_subnormal : make_huge)(c);
}

/* A number with any of these exponents. */
static double any_power(int least, int most)
{
    const int exponent = whole_between(least, most);
    return ldexp(between(1, 2), exponent);
}

/* Every number has its own exponent. */
static void mix_exponents(struct family_case *c)
{
    const int deep = chance(0.3) ? 1074 : 60;
    const int n = family_shape_size(c->shape_word) -
                  (c->shape_word == FAMILY_ACONE); /* its angle */
    for (int i = 0; i < 6; i++)
        c->line_data[i] *= any_power(-deep, 60);
    for (int i = 0; i < n; i++)
        c->shape_data[i] *= any_power(-deep, 60);
}

/* A limit of a domain of any size and sign, or near t. */
static double any_limit(double t)
{
    if (chance(0.3))
        return t * (1 + small(-16, 0));
    const double sign = chance(0.5) ? 1 : -1;
    return sign * (chance(0.2) ? HUGE_VAL : any_power(-1074, 1023));
}

/* Makes a case's line begin further back by any number of steps d.  The domain
 * of a span ends anywhere. */
static void begin_anywhere(struct family_case *out)
{
    double *x = out->line_data;
    const double back = any_power(0, 1010);
    for (int i = 0; i < 3; i++) {
        if (out->line_word == FAMILY_SEGMENT)
            x[i + 3] -= x[i];
        x[i] -= back * x[i + 3];
    }
    out->line_word =
        (family_line[]){FAMILY_LINE, FAMILY_RAY, FAMILY_SPAN}[one_of(3)];
    const double from = any_limit(back), to = any_limit(back);
    x[6] = from < to ? from : to;
    x[7] = from < to ? to : from;
}

/* Multiplies the lengths of a case's shape by any power of two, its origin and
 * its direction, or both ends of a segment, by others. */
static void scale_anyhow(struct family_case *out)
{
    double *x = out->line_data;
    enlarge(out, ldexp(1, whole_between(-1074, 1010)));
    for (int i = 0; i < 6; i += 3)
        if (chance(0.7))
            multiply(x + i, 3, any_power(-1074, 1000));
    if (out->line_word == FAMILY_SPAN) {
        const double from = any_limit(x[6]), to = any_limit(x[7]);
        x[6] = from < to ? from : to;
        x[7] = from < to ? to : from;
    }
}

/* ----- cones ------------------------------------------------------------ */

/* z of the apex; 0.5 if there is none. */
static double apex_z(const frame *f)
{
    return f->by_angle ? 0 : f->k != 1 ? 1 / (1 - f->k) : 0.5;
}

static void near_the_apex(struct family_case *out)
{
    frame f;
    double p[3], d[3], aside[3];
    simple_shape(out, &f, cone_word());
    place(&f, 0, 0, apex_z(&f), p);
    random_direction(aside);
    random_direction(d);
    add3(p, small(-17, -1), aside);
    write_line_from(out, p, d, between(-2, 2));
}

static void near_a_ruling(struct family_case *out)
{
    frame f;
    double p[3], q[3], d[3], aside[3];
    simple_shape(out, &f, cone_word());
    const double turn = between(0, 6.283185307179586), z = any_z(&f);
    const double r0 = rho(&f, 0), r1 = rho(&f, 1), x = cos(turn);
    const double y = sin(turn), off = small(-16, -3), tilt = small(-16, -3);
    place(&f, r0 * x, r0 * y, 0, p);
    place(&f, r1 * x, r1 * y, 1, q);
    random_direction(aside);
    for (int i = 0; i < 3; i++) {
        d[i] = q[i] - p[i] + tilt * aside[(i + 1) % 3];
        p[i] += z * (q[i] - p[i]) + off * aside[i];
    }
    write_line_from(out, p, d, between(-2, 2));
}

/* So steep that the line meets both nappes. */
static void both_nappes(struct family_case *out)
{
    frame f;
    double p[3], d[3];
    simple_shape(out, &f, cone_word());
    const double apex = apex_z(&f), slope = fabs(rho(&f, 1) - rho(&f, 0));
    place_near(&f, 1, apex + between(-1, 1), p);
    const double y = slope * between(-0.4, 0.4);
    vary(&f, slope * between(-1.1, 1.1), y, 1, d);
    write_line_from(out, p, d, between(-2, 2));
    out->ends = chance(0.7) ? CYLINT_ENDS_INFINITE : CYLINT_ENDS_NAPPE;
}

/* Nearly along the axis of a thin cone, close to its rulings, or to the axis. */
static void along_a_thin_cone(struct family_case *out)
{
    const double zero[3] = {0, 0, 0}, r = ldexp(1, -one_of(51));
    const double r0 = r * one_of(2), r1 = r * one_of(3), back = between(0, 2);
    double h[3], o[3], d[3], off[3];
    random_vector(h, 1);
    random_vector(d, r * power(-12, 0.3));
    random_vector(off, r * power(-12, 0.3));
    add3(d, 1, h);
    along3(o, off, one_of(2), h);
    family_set_shape(out, FAMILY_CONE, zero, NULL, NULL, h, r0, r1);
    write_line_from(out, o, d, one_of(2) ? back : power(0, 9));
}

/* ----- ends ------------------------------------------------------------- */

static void near_a_rim(struct family_case *out)
{
    frame f;
    double p[3], d[3];
    simple_shape(out, &f, any_word());
    const double z = f.by_angle || chance(0.5) ? 1 : 0;
    const double factor = 1 + small(-16, -4);
    surface_point(&f, z + small(-16, -4), factor, p);
    random_direction(d);
    write_line_from(out, p, d, between(-3, 3));
}

static void near_a_cap_plane(struct family_case *out)
{
    frame f;
    double p[3], d[3];
    simple_shape(out, &f, any_word());
    const double z = chance(0.5) ? 1 : 0;
    place_near(&f, 1, z + small(-16, -4), p);
    const double up = small(-16, -4), y = between(-1, 1);
    vary(&f, between(-1, 1), y, up, d);
    write_line_from(out, p, d, between(-3, 3));
}

/* ----- elliptic --------------------------------------------------------- */

static family_shape elliptic_word(void)
{
    return chance(0.5) ? FAMILY_ECYLINDER : FAMILY_ECONE;
}

static void skewed(struct family_case *out)
{
    frame f;
    const family_shape word = elliptic_word();
    simple_frame(&f, word);
    const double flat = power(-6, 0);
    for (int i = 0; i < 3; i++) /* nearly in one plane */
        f.h[i] = flat * f.h[i] + f.a[i] + f.b[i];
    write_shape(out, word, &f);
    aim(out, &f, 3);
}

static void thin(struct family_case *out)
{
    frame f;
    const family_shape word = elliptic_word();
    simple_frame(&f, word);
    const double factor = power(-6, -3);
    scale3(chance(0.5) ? f.a : f.b, factor);
    write_shape(out, word, &f);
    aim(out, &f, 1.5);
}

/* Needles, discs, thin and oblique ellipses, down to lengths whose products
 * underflow, and balls that nearly hold the other one. */
static void extreme(struct family_case *out)
{
    const double zero[3] = {0, 0, 0}, degree = 57.29577951308232;
    const family_shape word = (family_shape)one_of(FAMILY_SHAPES);
    const double r0 = power(-18, 15), r1 = power(-18, 15);
    double h[3], a[3], b[3], o[3], d[3];
    random_vector(h, one_of(3) ? 1 : power(-180, 15));
    random_vector(a, one_of(3) ? 1 : power(-180, 15));
    random_vector(b, one_of(3) ? 1 : power(-12, 1.5));
    random_vector(o, one_of(2) ? 1 : power(-18, 6));
    random_vector(d, one_of(2) ? 1 : power(-18, 15));
    if (one_of(3) == 0) /* nearly in a plane with others */
        along3(b, a, power(-9, -0.3), b);
    const double near = r0 + length3(h) * (1 - power(-15, -0.3));
    family_set_shape(out, word, zero, a, b, h, r0,
                     word == FAMILY_ACONE                ? atan(r1) * degree
                     : word == FAMILY_RCONE && one_of(2) ? near
                                                         : r1);
    write_line(out, o, d);
}

/* ----- differences of points -------------------------------------------- */

/* Terms of very different size, so that b - a and p1 - p0 need all digits:
 * large common offsets, with ends moved by a few ulp of the offset. */
static void exact_differences(struct family_case *out)
{
    ordinary(out);
    if (chance(0.5)) {
        out->shape_word = FAMILY_CYLINDER;
        out->shape_data[6] = between(0.2, 2);
        for (int i = 0; i < 3; i++)
            out->shape_data[i + 3] = out->shape_data[i] + between(-2, 2);
    }
    out->line_word = FAMILY_SEGMENT;
    double *x = out->line_data, away[3];
    for (int i = 0; i < 3; i++)
        x[i + 3] = x[i] + between(-6, 6);
    random_direction(away);
    const double far = power(0, 16);
    for (int i = 0; i < 3; i++)
        x[i + 3] += far * away[i]; /* one end far, the other near */
    if (out->shape_word == FAMILY_CYLINDER && chance(0.5)) {
        for (int i = 0; i < 3; i++) { /* the line is nearly along the axis */
            x[i] = out->shape_data[i] + between(-1, 1);
            x[i + 3] = out->shape_data[i + 3] + between(-1, 1) * 1e-9;
        }
        for (int i = 0; i < 3; i++)
            x[i + 3] = x[i] + (out->shape_data[i + 3] - out->shape_data[i]);
    }
}

#include "families_constructed.h"
#include "families_round.h"
#include "families_planes.h"

/* ----- a point of the surface ------------------------------------------- */

/* Shapes of a frame, hulls of two balls, half-spaces. */
static enum group { FRAMES, ROUND, PLANES } group; /* of the present family */

/* An ordinary shape of the group, a point of its surface and the unit normal
 * there. */
static void draw_with_point(struct family_case *out, double p[3], double n[3])
{
    frame f;
    hull h;
    switch (group) {
    case FRAMES:
        simple_shape(out, &f, any_word());
        lateral_point(&f, p, n);
        break;
    case ROUND:
        simple_hull(&h);
        write_hull(out, &h);
        boundary_point(&h, p, n);
        break;
    case PLANES:
        simple_plane(out, p, n);
        break;
    }
}

static void on_the_surface(struct family_case *out)
{
    double p[3], n[3], d[3];
    draw_with_point(out, p, n);
    random_direction(d);
    write_line(out, p, d);
    out->line_word = chance(0.8) ? FAMILY_RAY : FAMILY_LINE;
}

static void far_origin(struct family_case *out)
{
    double p[3], n[3], d[3];
    draw_with_point(out, p, n);
    random_direction(d);
    add3(p, chance(0.5) ? 0 : between(-1, 0.5), n);
    write_line_from(out, p, d, power(3, 8));
}

/* A tangent, moved and turned by a little. */
static void grazing(struct family_case *out)
{
    double p[3], n[3], d[3];
    draw_with_point(out, p, n);
    across(n, d);
    add3(p, small(-16, -4), n);
    add3(d, small(-16, -4), n);
    write_line_from(out, p, d, between(-3, 3));
}

typedef void maker(struct family_case *out);

/* Each case is made by one of up to two functions, then changed. */
static const struct {
    const char *name;
    maker *make, *other, *change;
    int wild;
    enum group group;
} families[] = {
    {"ordinary", ordinary, NULL, NULL, 0, FRAMES},
    {"origin on the surface", on_the_surface, NULL, NULL, 0, FRAMES},
    {"far origin", far_origin, NULL, NULL, 0, FRAMES},
    {"translated", ordinary, NULL, translate_far, 0, FRAMES},
    {"grazing", grazing, NULL, NULL, 0, FRAMES},
    {"nearly parallel", nearly_parallel, NULL, NULL, 0, FRAMES},
    {"exactly parallel", exactly_parallel, NULL, NULL, 0, FRAMES},
    {"integer grid", integer_grid, NULL, NULL, 0, FRAMES},
    {"pythagorean tangents", exact_tangent, NULL, NULL, 0, FRAMES},
    {"scaled", ordinary, NULL, scale, 0, FRAMES},
    {"odd sizes", odd_sizes, NULL, NULL, 0, FRAMES},
    {"direction not unit", ordinary, NULL, lengthen_direction, 0, FRAMES},
    {"near the apex", near_the_apex, NULL, NULL, 0, FRAMES},
    {"near a ruling", near_a_ruling, NULL, NULL, 0, FRAMES},
    {"both nappes", both_nappes, NULL, NULL, 0, FRAMES},
    {"near a rim", near_a_rim, NULL, NULL, 0, FRAMES},
    {"near a cap's plane", near_a_cap_plane, NULL, NULL, 0, FRAMES},
    {"elliptic, skewed", skewed, NULL, NULL, 0, FRAMES},
    {"elliptic, thin", thin, NULL, NULL, 0, FRAMES},
    {"exact differences", exact_differences, NULL, NULL, 0, FRAMES},
    {"subnormal", ordinary, NULL, make_subnormal, 0, FRAMES},
    {"huge", ordinary, NULL, make_huge, 0, FRAMES},
    {"mixed exponents", integer_grid, NULL, mix_exponents, 1, FRAMES},
    {"round", round_ordinary, NULL, NULL, 0, ROUND},
    {"round, on the surface", on_the_surface, NULL, NULL, 0, ROUND},
    {"round, far origin", far_origin, NULL, NULL, 0, ROUND},
    {"round, translated", round_ordinary, NULL, translate_far, 0, ROUND},
    {"round, grazing", grazing, NULL, NULL, 0, ROUND},
    {"round, near a circle", round_near_a_circle, NULL, NULL, 0, ROUND},
    {"round, across the axis", round_across, NULL, NULL, 0, ROUND},
    {"round, ball in a ball", round_inside, NULL, NULL, 0, ROUND},
    {"round, whole numbers", round_whole, NULL, NULL, 0, ROUND},
    {"round, along a ruling", round_ruling, NULL, NULL, 0, ROUND},
    {"round, sizes 1e+-12", round_needle, NULL, NULL, 0, ROUND},
    {"round, ball and point", round_apex, NULL, NULL, 0, ROUND},
    {"round, scaled", round_ordinary, NULL, scale, 0, ROUND},
    {"round, subnormal or huge", round_ordinary, NULL, make_extreme, 0, ROUND},
    {"round, mixed exponents", round_whole, NULL, mix_exponents, 1, ROUND},
    {"from any distance", integer_grid, ordinary, begin_anywhere, 1, FRAMES},
    {"any exponents", integer_grid, ordinary, scale_anyhow, 1, FRAMES},
    {"round, from any distance", round_whole, round_ordinary, begin_anywhere, 1,
     ROUND},
    {"round, any exponents", round_whole, round_ordinary, scale_anyhow, 1,
     ROUND},
    {"constructed", constructed, NULL, NULL, 0, FRAMES},
    {"constructed, any exponents", constructed, NULL, scale_anyhow, 1, FRAMES},
    {"plain", plain, NULL, NULL, 0, FRAMES},
    {"plain, one odd number", plain, NULL, add_odd_number, 1, FRAMES},
    {"wild", wild_numbers, NULL, NULL, 1, FRAMES},
    {"extreme, few digits", few_digits, NULL, NULL, 1, FRAMES},
    {"half-space", plane_ordinary, NULL, NULL, 0, PLANES},
    {"half-space, far origin", far_origin, NULL, NULL, 0, PLANES},
    {"half-space, translated", plane_ordinary, NULL, translate_far, 0, PLANES},
    {"half-space, grazing", grazing, NULL, NULL, 0, PLANES},
    {"half-space, whole numbers", plane_whole, NULL, NULL, 0, PLANES},
    {"half-space, scaled", plane_ordinary, plane_whole, scale, 0, PLANES},
    {"half-space, subnormal or huge", plane_ordinary, plane_whole, make_extreme,
     0, PLANES},
    {"half-space, mixed exponents", plane_whole, NULL, mix_exponents, 1,
     PLANES},
    {"half-space, from any distance", plane_whole, plane_ordinary,
     begin_anywhere, 1, PLANES},
    {"half-space, any exponents", plane_whole, plane_ordinary, scale_anyhow, 1,
     PLANES},
    {"along a thin cone", along_a_thin_cone, NULL, NULL, 0, FRAMES},
    {"extreme sizes", extreme, NULL, NULL, 1, FRAMES},
};

int family_count(void)
{
    return (int)(sizeof families / sizeof families[0]);
}

const char *family_name(int family)
{
    return families[family].name;
}

int family_named(const char *name)
{
    int family = 0;
    while (strcmp(families[family].name, name) != 0)
        family++;
    return family;
}

int family_is_wild(int family)
{
    return families[family].wild;
}

int family_is_scaled(int family)
{
    maker *change = families[family].change;
    return change == scale || change == make_subnormal || change == make_huge ||
           change == make_extreme;
}

int family_is_round(int family)
{
    return families[family].group == ROUND;
}

struct family_case *family_case(uint64_t seed, int family, uint64_t index,
                                struct family_case *out)
{
    stream = seed;
    stream = random_bits(&stream) + (uint64_t)family;
    stream = random_bits(&stream) + index;
    do { /* until the numbers make a shape */
        maker *other = families[family].other;
        memset(out, 0, sizeof *out);
        out->ends = any_ends();
        group = families[family].group;
        (other && chance(0.5) ? other : families[family].make)(out);
        if (families[family].change)
            families[family].change(out);
    } while (!family_make(out));
    return out;
}
