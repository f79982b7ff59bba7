/*
 * colours.h - a colour for every shape
 *
 * A field #rrggbb in the tail of a shape's record is its colour; an option says
 * how the other shapes get theirs.
 */
#ifndef CYLINT_COLOURS_H
#define CYLINT_COLOURS_H

#include <stddef.h>
#include <stdint.h>

#include "scene.h"
#include "vector.h"

enum colouring {
    COLOUR_ONE,       /* one colour for all */
    COLOUR_NUMBER,    /* one after the other from a palette */
    COLOUR_LABEL,     /* by the record's tail: equal tails, equal colours */
    COLOUR_KIND,      /* by the kind of shape */
    COLOUR_CONNECTED, /* one colour for shapes connected by common end points */
    COLOUR_RADIUS,    /* from thin to thick */
    COLOUR_HEIGHT,    /* from low to high */
    COLOUR_ELEMENT,   /* atoms by their elements (atoms.h) */
    COLOUR_CHAIN      /* atoms and bonds by their chains */
};

extern const char *const colouring_words[]; /* from COLOUR_NUMBER on, NULL */

struct colours {
    enum colouring how; /* of the shapes that have no colour in their tails */
    uint32_t *of;       /* 0xrrggbb for each shape, sRGB */
    uint32_t *label;    /* a hash of each tail, 0 if it has none */
    size_t of_most, label_most; /* capacities */
};

/* The callback `also` of struct scene; its context is a struct colours. */
int colours_take_tail(struct scene *scene, const struct record *record);

/* Gives a colour to all shapes of the scene that have none.  `one` is the colour
 * for COLOUR_ONE.  Returns 0 or an exit status. */
int colours_complete(struct colours *colours, const struct scene *scene,
                     uint32_t one, struct vector up);

void colours_free(struct colours *colours);

/* Reads #rrggbb.  Returns 0 if the text is anything else. */
int read_colour(struct string s, uint32_t *colour);

/* Converts 0xrrggbb to shares of the brightest light, and back. */
struct vector light_of_colour(uint32_t colour);
unsigned char byte_of_light(double light);

#endif
