/*
 * boundary.c - features from exact signs of surfaces at a point: of points on the
 * surface, and next to the planes between two features
 */
#include "../dispatch.h"
#include "../intersect.h"
#include "../signs/origin.h"
#include "../signs/sign.h"
#include "nearest.h"

static int side_of(const cylint_shape *shape, const cylint_line *line,
                   int surface)
{
    const pair origin = {0, 0};
    return CYLINT_OF_FMA(cylint_sign_on_line)(shape, line, origin, surface);
}

static int is_apex(const cylint_shape *shape, const cylint_line *line)
{
    cylint_query q;
    cylint_query_open(&q, shape, line);
    return cylint_form_sign(&q, FORM_RHO0, 0) == 0;
}

int cylint_boundary_feature(const cylint_shape *shape, const double point[3])
{
    const unsigned caps = cylint_caps_present(shape->ends);
    const int bounded = cylint_is_bounded(shape);
    cylint_line line;
    if (cylint_is_round(shape->kind) || cylint_has_tangent(shape->kind))
        return CYLINT_NO_FEATURE;
    cylint_line_at(&line, point);
    const int at0 = bounded && side_of(shape, &line, 0) == 0;
    const int at1 = bounded && !at0 && side_of(shape, &line, 1) == 0;
    if (side_of(shape, &line, CYLINT_LATERAL_SURFACE) == 0) {
        if (cylint_is_tapered(shape->kind) && is_apex(shape, &line))
            return CYLINT_FEATURE_APEX;
        return at0   ? CYLINT_FEATURE_RIM0
               : at1 ? CYLINT_FEATURE_RIM1
                     : CYLINT_FEATURE_LATERAL;
    }
    return at0 && (caps & 1)   ? CYLINT_FEATURE_CAP0
           : at1 && (caps & 2) ? CYLINT_FEATURE_CAP1
                               : CYLINT_NO_FEATURE;
}
