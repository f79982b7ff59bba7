/*
 * methods.c - the table of published methods
 *
 * `cylint --list=methods` prints the names and texts.  The third text lists
 * the shapes and ends that the method's own file accepts.
 */
#include <stddef.h>

#include "cylint_methods.h"

static const cylint_method methods[] = {
    {"shene-cylinder",
     "C.-K. Shene, Computing the Intersection of a Line and a Cylinder, "
     "Graphics Gems IV, 1994",
     "cylinder: infinite, nappe", cylint_shene_cylinder},
    {"shene-cone",
     "C.-K. Shene, Computing the Intersection of a Line and a Cone, "
     "Graphics Gems V, 1995",
     "acone, cone of unequal radii: infinite", cylint_shene_cone},
    {"gullotti",
     "E. Gullotti, notes on a line and a non uniform cylinder, "
     "illusioncatalyst.com",
     "cylinder, ecylinder: any ends", cylint_gullotti},
    {"closest-points",
     "xissburg, Intersecting a Line against a Cylinder, "
     "xissburg.github.io, 2022",
     "cylinder: any ends", cylint_closest_points},
    {"quadratic", "textbook: roots of A t^2 + B t + C by B^2 - 4AC",
     "cylinder, cone, acone, ecylinder, econe: any ends", cylint_quadratic},
    {"cychosz-waggenspack",
     "J. M. Cychosz and W. N. Waggenspack, Jr., Intersecting a Ray with a "
     "Cylinder, Graphics Gems IV, 1994",
     "cylinder: any ends", cylint_cychosz_waggenspack},
    {NULL, NULL, NULL, NULL}};

const cylint_method *cylint_methods(void)
{
    return methods;
}
