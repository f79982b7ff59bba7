/*
 * options.h - the options of the command line
 */
#ifndef CYLINT_RENDER_OPTIONS_H
#define CYLINT_RENDER_OPTIONS_H

#include <stdint.h>

#include "colours.h"
#include "light.h"
#include "trace.h"
#include "view.h"
#include "xray.h"

struct options {
    const char *scene, *output;
    int ends;         /* of records without ends, or NOT_GIVEN */
    int has_swc, swc; /* whether --swc was given; its enum swc_form */
    int width, height, samples;
    int workers; /* 0: one for each processor */
    int progress;
    struct viewing viewing;
    int has_sun;
    struct vector sun; /* towards it */
    enum shading shading;
    enum colouring colouring;
    uint32_t colour;    /* of shapes without a colour of their own */
    const char *ground; /* #rrggbb, or NULL */
    struct backdrop backdrop;
    const char *surface; /* the last option about light and colour, or NULL */
    struct xray xray;

    const char *print; /* the text of --help or --version, or NULL */
};

/* Returns 0, or reports the fault and returns EXIT_USAGE. */
int read_options(struct options *options, int argc, char **argv);

#endif
