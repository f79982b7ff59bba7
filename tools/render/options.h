/*
 * options.h - the options of cylint-render
 */
#ifndef CYLINT_RENDER_OPTIONS_H
#define CYLINT_RENDER_OPTIONS_H

#include <stdint.h>

#include "colours.h"
#include "picture.h"
#include "view.h"

/* A word of an option, by its number; the last word stands for a colour. */
struct paint {
    int word;
    uint32_t colour;
};

enum { GROUND_NONE };                     /* the first word of --ground */
enum { BACKGROUND_SKY, BACKGROUND_NONE }; /* of --background */

struct options {
    unsigned long long given; /* a bit for each option in the table */
    const char *scene, *output;
    int ends;    /* of records without ends, or NOT_GIVEN */
    int swc;     /* enum swc_form, or NOT_GIVEN */
    int size[2]; /* width and height */
    int samples;
    int workers; /* at most; 0: one per processor */
    struct viewing viewing;
    int has_sun;
    struct vector sun;      /* towards it */
    int shading;            /* enum shading */
    struct paint colouring; /* enum colouring */
    struct paint ground, background;
    int has_xray;
    double mu; /* of an X-ray; 0: auto */

    const char *about; /* help or version, to print instead; or NULL */
};

/* Returns 0, or reports the fault and returns EXIT_USAGE. */
int read_options(struct options *options, int argc, char **argv);

/* Writes the help or the version.  Returns 0 or EXIT_IO. */
int print_about(const char *what);

#endif
