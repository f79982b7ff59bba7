/*
 * options.c - the options of the command line
 */
#include <limits.h>
#include <string.h>
#include <strings.h>

#include "arguments.h"
#include "main.h"
#include "numbers.h"
#include "options.h"
#include "swc.h"

enum option_id {
    OPT_BACKGROUND = 256,
    OPT_COLOUR,
    OPT_ENDS,
    OPT_EYE,
    OPT_FOV,
    OPT_FROM,
    OPT_GROUND,
    OPT_HELP,
    OPT_LIGHT,
    OPT_LOOK_AT,
    OPT_ORTHO,
    OPT_PROGRESS,
    OPT_SAMPLES,
    OPT_SHADE,
    OPT_SIZE,
    OPT_SWC,
    OPT_UP,
    OPT_VERSION,
    OPT_XRAY,
    OPT_ZOOM
};

static const struct option options_known[] = {{"j", 'j', 1},
                                              {"o", 'o', 1},
                                              {"background", OPT_BACKGROUND, 1},
                                              {"colour", OPT_COLOUR, 1},
                                              {"color", OPT_COLOUR, 1},
                                              {"ends", OPT_ENDS, 1},
                                              {"eye", OPT_EYE, 1},
                                              {"fov", OPT_FOV, 1},
                                              {"from", OPT_FROM, 1},
                                              {"ground", OPT_GROUND, 1},
                                              {"help", OPT_HELP, 0},
                                              {"light", OPT_LIGHT, 1},
                                              {"look-at", OPT_LOOK_AT, 1},
                                              {"ortho", OPT_ORTHO, 0},
                                              {"progress", OPT_PROGRESS, 0},
                                              {"samples", OPT_SAMPLES, 1},
                                              {"shade", OPT_SHADE, 1},
                                              {"size", OPT_SIZE, 1},
                                              {"swc", OPT_SWC, 1},
                                              {"up", OPT_UP, 1},
                                              {"version", OPT_VERSION, 0},
                                              {"xray", OPT_XRAY, 1},
                                              {"zoom", OPT_ZOOM, 1},
                                              {NULL, 0, 0}};

enum { MOST_PIXELS = 1 << 16 /* of a side */ };

static const uint32_t SKY_TOP = 0xc3d7ea, SKY_BOTTOM = 0xf6f3ec;
static const uint32_t CLAY = 0xd9cbb8;

/* ------------------------------------------------------------- values -- */

static const char *read_finite(const char *p, double *value)
{
    const char *after = cylint_read_number(p, p + strlen(p), value);
    return after && *value - *value == 0 ? after : NULL;
}

/* X,Y,Z */
static int read_point(const char *p, struct vector *point)
{
    for (int i = 0; i < 3; i++) {
        p = read_finite(p, &point->v[i]);
        if (!p || *p != (i < 2 ? ',' : '\0')) {
            return 0;
        }
        p++;
    }
    return 1;
}

/* The length of a direction neither vanishes nor overflows. */
static int read_direction(const char *p, struct vector *direction)
{
    return read_point(p, direction) && length(*direction) > 0 &&
           length(*direction) < HUGE_VAL;
}

static int read_between(const char *p, double above, double below,
                        double *value)
{
    p = read_finite(p, value);
    return p && *p == '\0' && *value > above && *value < below;
}

/* WxH */
static int read_size(const char *value, int *width, int *height)
{
    char first[8];
    const size_t length = strcspn(value, "x");
    if (value[length] == '\0' || length >= sizeof first) {
        return 0;
    }
    memcpy(first, value, length);
    first[length] = '\0';
    return read_count(first, MOST_PIXELS, width) &&
           read_count(value + length + 1, MOST_PIXELS, height);
}

static int read_background(const char *value, struct backdrop *b)
{
    uint32_t colour = SKY_TOP;
    b->transparent = strcmp(value, "none") == 0;
    if (b->transparent) {
        return 1;
    }
    if (strcmp(value, "sky") == 0) {
        b->top = light_of_colour(SKY_TOP);
        b->bottom = light_of_colour(SKY_BOTTOM);
        return 1;
    }
    const int is_colour = read_colour(value, strlen(value), &colour);
    b->top = b->bottom = light_of_colour(colour);
    return is_colour;
}

static int read_colouring(const char *value, struct options *options)
{
    const int index = find_word(colouring_words, value, strlen(value));
    if (index == NOT_GIVEN) {
        options->colouring = COLOUR_ONE;
        return read_colour(value, strlen(value), &options->colour);
    }
    options->colouring = (enum colouring)(index + COLOUR_NUMBER);
    return 1;
}

static int read_shading(const struct option *o, const char *value,
                        enum shading *shading)
{
    static const char *const words[] = {"light", "plain", "normal", NULL};
    int index;
    const int status =
        read_word(o, value, words, "light, plain or normal", &index);
    *shading = (enum shading)index;
    return status;
}

static int read_ground(const char *value, const char **ground)
{
    uint32_t colour;
    *ground = strcmp(value, "none") != 0 ? value : NULL;
    return !*ground || read_colour(value, strlen(value), &colour);
}

static int read_xray(const char *value, struct xray *xray)
{
    xray->scale = strcmp(value, "auto") == 0     ? XRAY_AUTO
                  : strcmp(value, "linear") == 0 ? XRAY_LINEAR
                                                 : XRAY_GIVEN;
    return xray->scale != XRAY_GIVEN ||
           read_between(value, 0, HUGE_VAL, &xray->mu);
}

/* ------------------------------------------------------------ options -- */

/* Returns NULL, or a text that names the expected value. */
static const char *read_view_options(struct viewing *v, int id,
                                     const char *value)
{
    switch (id) {
    case OPT_EYE:
        v->has_eye = 1;
        return read_point(value, &v->eye) ? NULL : "X,Y,Z";
    case OPT_LOOK_AT:
        v->has_target = 1;
        return read_point(value, &v->target) ? NULL : "X,Y,Z";
    case OPT_FROM:
        v->has_from = 1;
        return read_direction(value, &v->from) ? NULL : "a direction X,Y,Z";
    case OPT_UP:
        return read_direction(value, &v->up) ? NULL : "a direction X,Y,Z";
    case OPT_FOV:
        return read_between(value, 0, 180, &v->fov)
                   ? NULL
                   : "degrees above 0 and below 180";
    default: /* OPT_ZOOM */
        return read_between(value, 0, HUGE_VAL, &v->zoom) ? NULL
                                                          : "a number above 0";
    }
}

static const char *read_look_options(struct options *options, int id,
                                     const char *value)
{
    switch (id) {
    case OPT_BACKGROUND:
        return read_background(value, &options->backdrop)
                   ? NULL
                   : "sky, none or #rrggbb";
    case OPT_COLOUR:
        return read_colouring(value, options)
                   ? NULL
                   : "number, label, kind, connected, radius, height, "
                     "element, chain or #rrggbb";
    case OPT_GROUND:
        return read_ground(value, &options->ground) ? NULL : "none or #rrggbb";
    case OPT_LIGHT:
        options->has_sun = 1;
        return read_direction(value, &options->sun) ? NULL
                                                    : "a direction X,Y,Z";
    case OPT_SAMPLES:
        return read_count(value, MOST_PIXELS, &options->samples)
                   ? NULL
                   : "a number of samples";
    case OPT_SIZE:
        return read_size(value, &options->width, &options->height)
                   ? NULL
                   : "WIDTHxHEIGHT";
    case OPT_XRAY:
        return read_xray(value, &options->xray) ? NULL : "MU, auto or linear";
    default: /* 'j' */
        return read_count(value, INT_MAX / 10 - 1, &options->workers)
                   ? NULL
                   : "a number of workers";
    }
}

/* A viewer refuses a PNG file with the name of another format. */
static int is_named_otherwise(const char *file)
{
    static const char *const endings[] = {
        ".jpg",  ".jpeg", ".gif", ".bmp", ".tif", ".tiff", ".webp",
        ".avif", ".jxl",  ".ppm", ".tga", ".svg", ".pdf",  ".eps"};
    const char *dot = strrchr(file, '.');
    for (size_t i = 0; dot && i < sizeof endings / sizeof *endings; i++) {
        if (strcasecmp(dot, endings[i]) == 0) {
            return 1;
        }
    }
    return 0;
}

static int take_value(struct options *options, const struct option *o,
                      const char *value)
{
    const char *expected;
    switch (o->id) {
    case 'o':
        options->output = value;
        return is_named_otherwise(value)
                   ? usage_value(o, value, "a PNG file, NAME.png")
                   : 0;
    case OPT_ENDS:
        return read_word(o, value, ends_words,
                         "capped, open, cap0, cap1, infinite or nappe",
                         &options->ends);
    case OPT_SHADE:
        return read_shading(o, value, &options->shading);
    case OPT_SWC:
        options->has_swc = 1;
        return read_word(o, value, swc_forms, SWC_FORMS, &options->swc);
    case OPT_EYE:
    case OPT_LOOK_AT:
    case OPT_FROM:
    case OPT_UP:
    case OPT_FOV:
    case OPT_ZOOM:
        expected = read_view_options(&options->viewing, o->id, value);
        break;
    default:
        expected = read_look_options(options, o->id, value);
    }
    return expected ? usage_value(o, value, expected) : 0;
}

static int is_about_surfaces(int id)
{
    return id == OPT_BACKGROUND || id == OPT_COLOUR || id == OPT_GROUND ||
           id == OPT_LIGHT || id == OPT_SHADE;
}

static int take_option(void *context, const struct option *o, const char *value)
{
    struct options *options = context;
    if (is_about_surfaces(o->id)) {
        options->surface = o->name;
    }
    switch (o->id) {
    case OPT_ORTHO:
        options->viewing.parallel = 1;
        return 0;
    case OPT_PROGRESS:
        options->progress = 1;
        return 0;
    case OPT_HELP:
    case OPT_VERSION:
        options->print = o->name;
        return 0;
    default:
        return take_value(options, o, value);
    }
}

static int settle(struct options *options, char **argv, int files)
{
    const struct viewing *v = &options->viewing;
    if (files != 1) {
        return usage("expected one scene, found %d", files);
    }
    options->scene = argv[0];
    if (options->has_swc && !swc_is_name(options->scene)) {
        return usage("--swc needs a neuron, NAME.swc");
    }
    if (!options->output) {
        return usage(
            "no output file: use -o FILE, or -o - for standard output");
    }
    if (v->has_target && !v->has_eye) {
        return usage("--look-at needs --eye");
    }
    if (options->xray.scale != XRAY_NONE && options->surface) {
        return usage("--xray and --%s exclude each other", options->surface);
    }
    if (v->has_from && v->has_eye) {
        return usage("--from and --eye exclude each other");
    }
    return 0;
}

int read_options(struct options *options, int argc, char **argv)
{
    int files;
    memset(options, 0, sizeof *options);
    options->ends = NOT_GIVEN;
    options->width = 1280;
    options->height = 720;
    options->samples = 8;
    options->viewing.up = vector(0, 0, 1);
    options->viewing.fov = 30;
    options->viewing.zoom = 1;
    options->colour = CLAY;
    read_background("sky", &options->backdrop);
    const int status =
        take_arguments(options_known, argc, argv, take_option, options, &files);
    options->viewing.aspect = (double)options->width / options->height;
    return status != 0 || options->print ? status
                                         : settle(options, argv, files);
}
