/*
 * colours.h - a colour for every shape
 *
 * A field #rrggbb in the tail of a shape's record is its colour; an option sets
 * those of the other shapes.
 */
#ifndef CYLINT_COLOURS_H
#define CYLINT_COLOURS_H

#include <stddef.h>
#include <stdint.h>

#include "scene.h"
#include "vector.h"

enum colouring {
    COLOUR_NUMBER,  /* one after the other from a palette */
    COLOUR_LABEL,   /* by the record's tail: equal tails, equal colours */
    COLOUR_KIND,    /* by the kind of shape */
    COLOUR_RADIUS,  /* from thin to thick */
    COLOUR_HEIGHT,  /* from low to high */
    COLOUR_ELEMENT, /* atoms by their elements (atoms.c) */
    COLOUR_CHAIN,   /* atoms and bonds by their chains */
    COLOUR_ONE      /* one colour for all */
};

#define RGB "#rrggbb" /* the word for a colour in lists of words */

extern const char *const colouring_words[]; /* by enum colouring, then NULL */

/* Returns a new array with a colour for each shape of a scene that keeps labels,
 * 0xrrggbb, sRGB, and space for one more; NULL after a message.  how: of the
 * shapes that have no colour in their tails; one: the colour for COLOUR_ONE. */
uint32_t *colours_make(const struct scene *scene, enum colouring how,
                       uint32_t one, struct vector up);

/* Reads #rrggbb.  Returns 0 if the text is anything else. */
int read_colour(struct string s, uint32_t *colour);

/* Converts a colour in sRGB, 0xrrggbb or three numbers from 0 to 1, to shares of
 * the brightest light, and back. */
struct vector light_of_colour(uint32_t colour);
struct vector light_of_shares(double red, double green, double blue);
unsigned char byte_of_light(double light);

/* ---------------------------------------------------------------- atoms -- */

/* Writes the colour of the element, 0xrrggbb; that of a bond is grey.  Returns 0 if
 * the text is no label of an atom or bond. */
int colour_of_element(struct string label, uint32_t *colour);

/* Writes the chain of an atom or of a bond's first atom.  Returns 0 likewise. */
int chain_of(struct string label, struct string *chain);

#endif
