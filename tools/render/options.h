/*
 * options.h - what the command line asks for
 */
#ifndef CYLINT_RENDER_OPTIONS_H
#define CYLINT_RENDER_OPTIONS_H

#include <stdint.h>

#include "colours.h"
#include "light.h"
#include "trace.h"
#include "view.h"

struct options {
    const char *scene, *output;
    int ends; /* of shapes that do not say, or NOT_GIVEN */
    int width, height, samples;
    int workers; /* 0: as many as there are processors */
    int progress;
    struct viewing viewing;
    int has_sun;
    struct vector sun; /* towards it */
    enum shading shading;
    enum colouring colouring;
    uint32_t colour;    /* of shapes without another */
    const char *ground; /* #rrggbb, or NULL */
    struct backdrop backdrop;

    const char *print; /* help or version, and nothing else is done */
};

/* Returns 0 or EXIT_USAGE, having said what is wrong. */
int read_options(struct options *options, int argc, char **argv);

#endif
