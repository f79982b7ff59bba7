/*
 * embree_scenes.h - cylinders strewn in a cube, and rays through it
 *
 * Everything is drawn in floats, so that Embree's own curves are given the
 * same numbers as the shapes.
 */
#ifndef BENCH_EMBREE_SCENES_H
#define BENCH_EMBREE_SCENES_H

#include <cylint_embree.h>

#include "embree/api.h"

/* In multiples of s, the mean spacing: length; in multiples of that: radius. */
struct cylinder_kind {
    const char *name;
    double length, radius;
    int most_segments; /* by which curves are split by hand */
};

extern const struct cylinder_kind thin, fat, fibre;

struct cylinders {
    size_t n;
    float (*ends)[2][3];
    float *radius; /* all the same, but read like others */
    cylint_shape *shapes;
};

/* n capped cylinders in the unit cube; exits where there is no memory. */
struct cylinders draw_cylinders(const struct cylinder_kind *kind, size_t n);
void free_cylinders(struct cylinders *c);

struct rays {
    int n;
    struct RTCRay *ray;
};

/* From anywhere in the cube to anywhere; a camera's before the cube, in the
 * order of packets: 4 after 4 are tiles of 2 x 2, 8 of 4 x 2, 16 of 4 x 4. */
struct rays draw_incoherent_rays(int n);
struct rays draw_camera_rays(int n);
void free_rays(struct rays *r);

/* What renderers do, as Embree advises: subnormal numbers are zero. */
void flush_subnormals(void);

/* malloc(), or exits. */
void *need(size_t bytes);

#endif
