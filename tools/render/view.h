/*
 * view.h - the camera, the line for each point of the picture, and the boxes of a
 * scene's bounded solids
 *
 * A shape that is in no solid is itself a solid.  The box of a solid contains it:
 * it is the common part of the boxes of its clauses.
 */
#ifndef CYLINT_VIEW_H
#define CYLINT_VIEW_H

#include "cylint.h"
#include "vector.h"

struct drawing;
struct scene;

struct box {
    struct vector low, high;
};

struct boxes {
    struct box *box;
    size_t count;
    struct vector middle; /* of the box of all */
    double size;          /* the diagonal of that box; 0: none is bounded */
};

/* Sorts the members of solids.  Returns 0 or an exit status. */
int boxes_make(struct boxes *boxes, const struct scene *scene);
void boxes_free(struct boxes *boxes);

/* The maximum of direction . point over all boxes. */
double reach(const struct boxes *boxes, struct vector direction);

/* -------------------------------------------------------------- camera -- */

/* The options of the camera; the scene determines those not given. */
struct viewing {
    int has_eye, has_from, has_target;
    struct vector eye;    /* the camera's place */
    struct vector from;   /* or only the side of the scene where it is */
    struct vector target; /* the point it looks at, with an eye */
    struct vector up;
    double fov;      /* degrees from bottom to top */
    int is_parallel; /* all lines have one direction */
    double zoom;
    double aspect; /* the picture's width over its height */
    int rows;      /* of the picture's pixels */
};

struct view {
    struct vector eye;
    struct vector right, up, forward; /* perpendicular unit vectors */
    double half_width, half_height;   /* of the picture: at the distance 1
                                         from the eye, or if parallel as such */
    int is_parallel;
};

/* Fits the scene into the picture if no eye is given.  Returns NULL, or why there
 * is no view. */
const char *view_of_scene(struct view *view, const struct viewing *camera,
                          const struct boxes *boxes);

/* Ray i through pixel x, y of a picture; y is counted from the top.  A single ray
 * goes through the pixel's middle.  Samples have the same places in all pixels, so
 * that edges are even.  A ray whose numbers are too large is refused: it hits
 * nothing, and o and d are 0. */
void view_sample(const struct drawing *drawing, int x, int y, int i,
                 cylint_line *ray);

#endif
