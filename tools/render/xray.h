/*
 * xray.h - a picture of how much of each ray is inside the scene's solids
 *
 * The length of a ray is that of its pieces inside the union of all solids, in the
 * scene's units: places in several solids count once.  The length of a pixel is the
 * mean of those of its rays.
 */
#ifndef CYLINT_XRAY_H
#define CYLINT_XRAY_H

#include "cylint_scene.h"
#include "picture.h"
#include "view.h"

enum xray_scale {
    XRAY_NONE,  /* no X-ray is wanted */
    XRAY_AUTO,  /* exp(-mu length); mu is ln 2 divided by the mean of the
                   lengths of all pixels, without those that are 0 or
                   infinite: a pixel with the mean length is half as bright
                   as an empty one */
    XRAY_GIVEN, /* the same with a given mu */
    XRAY_LINEAR /* length divided by the largest finite length */
};

struct xray {
    enum xray_scale scale;
    double mu;
};

/* Fills a grey picture of 16 bits and its note.  Returns 0 or an exit status. */
int xray_picture(const struct drawing *drawing, const struct xray *how,
                 const cylint_scene *scene);

#endif
