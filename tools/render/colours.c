/*
 * colours.c - a colour for every shape
 *
 * Palettes are made in Oklab, where equal steps look equal [Ottosson, A perceptual
 * color space for image processing, 2020].
 */
#include <stdlib.h>
#include <string.h>

#include "colours.h"
#include "../../src/shapes/shape_facts.h"

const char *const colouring_words[] = {"number", "label",  "kind",
                                       "radius", "height", "element",
                                       "chain",  RGB,      NULL};

enum { NO_COLOUR = 1 << 24 };

/* -------------------------------------------------------------- light -- */

/* IEC 61966-2-1 */
static double light_of_share(double c)
{
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

struct vector light_of_shares(double red, double green, double blue)
{
    return vector(light_of_share(red), light_of_share(green),
                  light_of_share(blue));
}

struct vector light_of_colour(uint32_t colour)
{
    return light_of_shares((colour >> 16 & 255) / 255.0,
                           (colour >> 8 & 255) / 255.0, (colour & 255) / 255.0);
}

unsigned char byte_of_light(double light)
{
    const double x = fmin(fmax(light, 0), 1);
    const double c =
        x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055;
    return (unsigned char)(255 * c + 0.5);
}

/* Lightness, chroma and hue (radians) in Oklab to 0xrrggbb. */
static uint32_t colour_of_lch(double lightness, double chroma, double hue)
{
    const double a = chroma * cos(hue), b = chroma * sin(hue);
    const double l = lightness + 0.3963377774 * a + 0.2158037573 * b;
    const double m = lightness - 0.1055613458 * a - 0.0638541728 * b;
    const double s = lightness - 0.0894841775 * a - 1.2914855480 * b;
    const double l3 = l * l * l, m3 = m * m * m, s3 = s * s * s;
    const double light[3] = {
        4.0767416621 * l3 - 3.3077115913 * m3 + 0.2309699292 * s3,
        -1.2684380046 * l3 + 2.6097574011 * m3 - 0.3413193965 * s3,
        -0.0041960863 * l3 - 0.7034186147 * m3 + 1.7076147010 * s3};
    return (uint32_t)byte_of_light(light[0]) << 16 |
           (uint32_t)byte_of_light(light[1]) << 8 | byte_of_light(light[2]);
}

/* ----------------------------------------------------------- palettes -- */

/* Hues differ by the golden section of the circle, so close hues are far apart in
 * the order; every third colour has another lightness. */
static uint32_t colour_of_number(size_t n)
{
    static const double lightness[3] = {0.74, 0.64, 0.82};
    const double golden_angle = 2.3999632297286533;
    return colour_of_lch(lightness[n % 3], 0.125,
                         0.7 + golden_angle * (double)(n % 100000));
}

/* Green (thin) to brown (thick), or blue (low) to yellow (high). */
static uint32_t colour_of_share(double x, int is_radius)
{
    return is_radius
               ? colour_of_lch(0.72 - 0.22 * x, 0.11 - 0.04 * x, 2.2 - 1.2 * x)
               : colour_of_lch(0.48 + 0.38 * x, 0.11 + 0.02 * x, 4.6 - 2.9 * x);
}

/* -------------------------------------------------------------- tails -- */

int read_colour(struct string s, uint32_t *colour)
{
    char digits[7] = "";
    if (s.length != 7 || *s.text != '#')
        return 0;
    memcpy(digits, s.text + 1, 6);
    *colour = (uint32_t)strtoul(digits, NULL, 16);
    return strspn(digits, "0123456789abcdefABCDEF") == 6;
}

/* The first field of the tail that is a colour. */
static uint32_t colour_in_tail(struct string tail)
{
    uint32_t colour;
    while (tail.length > 0)
        if (read_colour(take_field(&tail), &colour))
            return colour;
    return NO_COLOUR;
}

/* A scene that is being coloured. */
struct colours {
    const struct scene *scene;
    enum colouring how;
    struct vector up;
    uint32_t one;       /* the colour for COLOUR_ONE */
    uint32_t *of;       /* the colour of each shape, or NO_COLOUR */
    struct names names; /* the labels or chains so far */
    int has_failed;     /* there was no memory for a name */
};

/* Names have the colours of the palette in the order in which they come. */
static uint32_t colour_of_name(struct colours *c, struct string name)
{
    size_t number = 0;
    c->has_failed |= !names_add(&c->names, name, &number);
    return colour_of_number(number);
}

/* By the first field of the tail, the label of an atom or bond. */
static uint32_t colour_of_atom(struct colours *c, struct string tail)
{
    const struct string label = first_field(tail);
    struct string chain;
    uint32_t colour;
    if (c->how == COLOUR_ELEMENT && colour_of_element(label, &colour))
        return colour;
    return c->how == COLOUR_CHAIN && chain_of(label, &chain)
               ? colour_of_name(c, chain)
               : NO_COLOUR;
}

static void read_tails(struct colours *c)
{
    for (size_t i = 0; i < c->scene->count; i++) {
        const struct string tail = labels_get(&c->scene->labels, i);
        c->of[i] = colour_in_tail(tail);
        if (c->of[i] == NO_COLOUR)
            c->of[i] = colour_of_atom(c, tail);
    }
}

/* ---------------------------------------------- shapes without a colour -- */

/* The radius of an elliptic shape: that of a circle with the same area. */
static double radius_of(const cylint_shape *s)
{
    double radius = fmax(cylint_r0(s), cylint_r1(s));
    if (cylint_is_elliptic(s->kind))
        radius *=
            sqrt(length(cross(vector_of(cylint_a(s)), vector_of(cylint_b(s)))));
    return radius;
}

/* The middle of the axis. */
static double height_of(const cylint_shape *s, struct vector up)
{
    return dot(up,
               plus(vector_of(cylint_base(s)), 0.5, vector_of(cylint_axis(s))));
}

static double measure_of_shape(const struct colours *c, size_t i)
{
    cylint_shape shape;
    cylint_scene_shape(c->scene->shapes, i, &shape);
    return c->how == COLOUR_RADIUS ? log(radius_of(&shape))
                                   : height_of(&shape, c->up);
}

/* Colours along a gradient, from the least to the greatest finite value. */
static void by_measure(struct colours *c)
{
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (size_t i = 0; i < c->scene->count; i++) {
        const double x = measure_of_shape(c, i);
        if (x - x == 0) {
            least = fmin(least, x);
            most = fmax(most, x);
        }
    }
    for (size_t i = 0; i < c->scene->count; i++) {
        const double x = measure_of_shape(c, i);
        const double share =
            x - x == 0 && most > least ? (x - least) / (most - least) : 0.5;
        if (c->of[i] == NO_COLOUR)
            c->of[i] = colour_of_share(share, c->how == COLOUR_RADIUS);
    }
}

static uint32_t colour_of_shape(struct colours *c, size_t i)
{
    const struct string label = labels_get(&c->scene->labels, i);
    cylint_shape shape;
    switch (c->how) {
    case COLOUR_NUMBER:
        return colour_of_number(i);
    case COLOUR_LABEL:
        return label.length > 0 ? colour_of_name(c, label) : c->one;
    case COLOUR_KIND:
        cylint_scene_shape(c->scene->shapes, i, &shape);
        return colour_of_number((size_t)shape.kind);
    default:
        return c->one;
    }
}

static void colour_one(struct colours *c, size_t i)
{
    if (c->of[i] == NO_COLOUR)
        c->of[i] = colour_of_shape(c, i);
}

/* Members of a solid without a colour of their own have that of its first shape.
 * Members are sorted by solid (boxes_make()), so a shape of several solids has it
 * from the first of them. */
static int colour_others(struct colours *c)
{
    const struct solids *s = &c->scene->solids;
    size_t *number = solids_numbers(s);
    if (!number)
        return out_of_memory();
    for (size_t i = 0; i < s->count; i++) {
        const size_t first = number[s->member[i].solid] - 1;
        uint32_t *of_member = &c->of[s->member[i].shape];
        colour_one(c, first);
        if (*of_member == NO_COLOUR)
            *of_member = c->of[first];
    }
    free(number);
    for (size_t i = 0; i < c->scene->count; i++)
        colour_one(c, i);
    return 0;
}

uint32_t *colours_make(const struct scene *scene, enum colouring how,
                       uint32_t one, struct vector up)
{
    struct colours c = {.scene = scene, .how = how, .one = one, .up = up};
    c.of = malloc((scene->count + 1) * sizeof *c.of);
    if (!c.of) {
        out_of_memory();
        return NULL;
    }
    read_tails(&c);
    if (how == COLOUR_RADIUS || how == COLOUR_HEIGHT)
        by_measure(&c);
    const int status = colour_others(&c);
    names_free(&c.names);
    if (status == 0 && !c.has_failed)
        return c.of;
    free(c.of);
    if (status == 0)
        out_of_memory();
    return NULL;
}
