/*
 * options.c - the options of cylint-render
 *
 * A new option needs a line in the table.
 */
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "arguments.h"
#include "options.h"
#include "scene.h"

enum { MOST_PIXELS = 1 << 16 /* of a side */ };

enum { CLAY = 0xd9cbb8 };

/* ------------------------------------------------------------- values -- */

static int read_place(const struct option *o, const char *value, void *place)
{
    struct vector *at = place;
    return check_value(o, value,
                       read_bounds(value, at->v, 3) && is_finite(*at));
}

/* The length of a direction neither vanishes nor overflows. */
static int read_direction(const struct option *o, const char *value,
                          void *place)
{
    struct vector *direction = place;
    return check_value(o, value,
                       read_bounds(value, direction->v, 3) &&
                           length(*direction) > 0 &&
                           length(*direction) < HUGE_VAL);
}

static int read_positive(const char *p, double *value)
{
    return read_bounds(p, value, 1) && *value > 0 && *value < HUGE_VAL;
}

/* A number above 0, and below o->number unless that is 0. */
static int read_factor(const struct option *o, const char *value, void *place)
{
    const double *factor = place;
    return check_value(o, value,
                       read_positive(value, place) &&
                           (o->number == 0 || *factor < o->number));
}

/* WxH */
static int read_size(const struct option *o, const char *value, void *place)
{
    int *const size = place;
    unsigned long long width = 0, height = 0;
    const char *x = value + strcspn(value, "x"), *end = x + strlen(x);
    const int is_size = x < end &&
                        read_whole(between(value, x), MOST_PIXELS, &width) &&
                        read_whole(between(x + 1, end), MOST_PIXELS, &height) &&
                        width > 0 && height > 0;
    size[0] = (int)width;
    size[1] = (int)height;
    return check_value(o, value, is_size);
}

/* o->extra: words, the last of which stands for a colour. */
static int read_paint(const struct option *o, const char *value, void *place)
{
    struct paint *paint = place;
    const int is_colour = read_colour(string_of(value), &paint->colour);
    if (!is_colour && strcmp(value, RGB) == 0)
        return usage("--%s: " RGB " stands for six digits, as in #ff8800",
                     o->name);
    return read_word_of(o, is_colour ? RGB : value,
                        WORDS((const char *const *)o->extra), NULL,
                        &paint->word);
}

static int read_xray(const struct option *o, const char *value, void *place)
{
    double *mu = place;
    *mu = 0;
    return check_value(o, value,
                       strcmp(value, "auto") == 0 || read_positive(value, mu));
}

/* A viewer refuses a PNG file with the name of another format. */
static int read_output(const struct option *o, const char *value, void *place)
{
    static const char *const endings[] = {
        ".jpg", ".jpeg", ".gif", ".bmp", ".tif", ".tiff", ".webp", ".avif",
        ".jxl", ".ppm",  ".tga", ".svg", ".pdf", ".eps",  NULL};
    const char *dot = strrchr(value, '.');
    int is_other = 0;
    for (int i = 0; dot && endings[i]; i++)
        is_other |= strcasecmp(dot, endings[i]) == 0;
    *(const char **)place = value;
    return check_value(o, value, !is_other);
}

/* ---------------------------------------------------------------- table -- */

enum { OF_SURFACES = 1 /* an option for light and colour, not for X-rays */ };

static const char *const shadings[] = {"light", "plain", "normal", NULL};
static const char *const grounds[] = {"none", RGB, NULL};
static const char *const backgrounds[] = {"sky", "none", RGB, NULL};
static const char direction[] = "a direction X,Y,Z";

#define AT(member) offsetof(struct options, member)

/* In the order of --help. */
static const struct option option_table[] = {
    {"o", "FILE", read_output, AT(output), "a PNG file, NAME.png", 0, 0,
     "the picture; - is standard output"},
    {"size", "WxH", read_size, AT(size), "WIDTHxHEIGHT, each 1 to 65536", 0, 0,
     "pixels, default 1280x720"},
    {"samples", "N", read_count, AT(samples), "1 to 65536 samples", MOST_PIXELS,
     0, "rays per pixel, default 8"},
    {"j", "N", read_count, AT(workers), "a number of workers", INT_MAX, 0,
     "workers; the picture is the same"},
    {"eye", "X,Y,Z", read_place, AT(viewing.eye), "X,Y,Z", 0, 0,
     "the camera's place; default: the scene fits"},
    {"look-at", "X,Y,Z", read_place, AT(viewing.target), "X,Y,Z", 0, 0,
     "the point that an --eye looks at, default the middle"},
    {"from", "X,Y,Z", read_direction, AT(viewing.from), direction, 0, 0,
     "only the direction to the camera"},
    {"up", "X,Y,Z", read_direction, AT(viewing.up), direction, 0, 0,
     "the upward direction, default 0,0,1; 0,1,0 for\n"
     "--from along z"},
    {"fov", "DEGREES", read_factor, AT(viewing.fov),
     "degrees above 0 and below 180", 180, 0, "from bottom to top, default 30"},
    {"ortho", 0, read_flag, AT(viewing.is_parallel), 0, 1, 0, "parallel rays"},
    {"zoom", "FACTOR", read_factor, AT(viewing.zoom), "a number above 0", 0, 0,
     "enlarge about the picture's centre"},
    {"colour", "HOW", read_paint, AT(colouring), colouring_words, 0,
     OF_SURFACES,
     "of shapes without a field #rrggbb in their records:\n"
     "number, label, kind, radius, height, element, chain\nor #rrggbb"},
    {"shade", "HOW", read_word, AT(shading), shadings, 0, OF_SURFACES,
     "light (default), plain or normal"},
    {"light", "X,Y,Z", read_direction, AT(sun), direction, 0, OF_SURFACES,
     "the direction to the sun"},
    {"ground", "HOW", read_paint, AT(ground), grounds, 0, OF_SURFACES,
     "#rrggbb below the scene, or none (default)"},
    {"background", "HOW", read_paint, AT(background), backgrounds, 0,
     OF_SURFACES, "sky (default), #rrggbb or none: transparent"},
    {"xray", "MU", read_xray, AT(mu), "MU or auto", 0, 0,
     "grey, by the length inside the solids:\n"
     "exp(-MU length); auto for a fitting MU"},
    {"ends", "WORD", read_word, AT(ends), ends_words, 0, 0,
     "the ends of shapes whose records do not state them"},
    {"swc", "FORM", read_word, AT(swc), swc_forms, 0, 0,
     "the scene is a neuron, of cones (default) or round"},
    {"help", 0, read_about, AT(about), 0, 0, 0, NULL},
    {"version", 0, read_about, AT(about), 0, 0, 0,
     "print this text or the version"},
    {0}};

static int is_given(const struct options *o, const char *name)
{
    return was_given(option_table, o->given, name);
}

/* An option about light and colour that was given, or NULL. */
static const char *surface_option(const struct options *o)
{
    const char *name = NULL;
    for (int i = 0; option_table[i].name; i++)
        if (o->given >> i & 1 && option_table[i].needs == OF_SURFACES)
            name = option_table[i].name;
    return name;
}

static int settle(struct options *o, char **argv, int files)
{
    struct viewing *v = &o->viewing;
    v->has_eye = is_given(o, "eye");
    v->has_target = is_given(o, "look-at");
    v->has_from = is_given(o, "from");
    o->has_xray = is_given(o, "xray");
    v->aspect = (double)o->size[0] / o->size[1];
    v->rows = o->size[1];
    if (v->has_from && v->from.v[0] == 0 && v->from.v[1] == 0 &&
        !is_given(o, "up"))
        v->up = vector(0, 1, 0);
    if (!o->output) {
        return usage(
            "no output file: use -o FILE, or -o - for standard output");
    }
    if (files != 1)
        return usage("expected one scene, found %d", files);
    o->scene = argv[0];
    if (v->has_target && !v->has_eye)
        return usage("--look-at needs --eye");
    if (o->has_xray && surface_option(o))
        return usage("--xray and --%s exclude each other", surface_option(o));
    if (v->has_from && v->has_eye)
        return usage("--from and --eye exclude each other");
    return 0;
}

int read_options(struct options *o, int argc, char **argv)
{
    int files;
    memset(o, 0, sizeof *o);
    o->ends = o->swc = NOT_GIVEN;
    o->size[0] = 1280;
    o->size[1] = 720;
    o->samples = 8;
    o->viewing.up = vector(0, 0, 1);
    o->viewing.fov = 30;
    o->viewing.zoom = 1;
    o->colouring = (struct paint){COLOUR_ONE, CLAY};
    const int status =
        take_arguments(option_table, argc, argv, o, &files, &o->given);
    o->has_sun = is_given(o, "light");
    return status != 0 || o->about ? status : settle(o, argv, files);
}

/* ----------------------------------------------------------------- help -- */

int print_about(const char *what)
{
    if (strcmp(what, "version") == 0) {
        puts("cylint-render " CYLINT_VERSION);
    } else {
        puts(
            "cylint-render [OPTION]... SCENE -o FILE\n"
            "\n"
            "Renders a scene, as cylint -s reads it, and writes a PNG file.\n");
        print_options(option_table);
        puts("\nExit status: 0 done, 1 a bad scene, 2 usage, 3 input or output "
             "failed,\n"
             "4 out of memory.  See cylint-render(1).");
    }
    return end_printing();
}
