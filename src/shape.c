/*
 * shape.c - the constructors of shapes and lines, and their checks
 *
 * No other function of cylint.h can fail.  A refused shape or line is all
 * zero; every query then returns "miss".
 */
#include "dispatch.h"
#include "intersect.h"
#include "shapes/local.h"

const char *cylint_strerror(int status)
{
    static const char *const text[] = {
        [CYLINT_OK] = "no error",
        [CYLINT_ENONFINITE] = "a number is not finite",
        [CYLINT_EAXIS] = "the axis or normal has no length",
        [CYLINT_EDEGENERATE] = "the vectors a, b, h are linearly dependent",
        [CYLINT_ERADIUS] = "a radius is negative, or all radii are zero",
        [CYLINT_EANGLE] = ("the half angle is not between 0 and 90 degrees, "
                           "or its tangent is 0"),
        [CYLINT_EENDS] = "this kind of shape has no such ends",
        [CYLINT_EDIRECTION] = "the direction has no length",
        [CYLINT_EDOMAIN] = "the domain is empty or not a number",
        [CYLINT_EMETHOD] = "this method does not support such a shape"};
    return status >= 0 && status <= CYLINT_EMETHOD ? text[status]
                                                   : "unknown status";
}

static void copy3(double to[3], const double from[3])
{
    for (int i = 0; i < 3; i++)
        to[i] = from[i];
}

/* Writes a shape that no line hits. */
static cylint_status refuse_shape(cylint_shape *shape, cylint_status why)
{
    memset(shape, 0, sizeof *shape);
    return why;
}

static const double none[3] = {0, 0, 0};

/* Writes x - y: the nearest doubles.  The environment is tested once for all. */
static void write_difference(double to[3], const double x[3], const double y[3])
{
    int exact = cylint_rounds_to_nearest();
    for (int i = 0; i < 3; i++) {
        exact &= !(cylint_too_small(x[i]) | cylint_too_small(y[i]));
        to[i] = x[i] - y[i] + 0.0; /* no -0 */
    }
    for (int i = 0; i < 3 && !exact; i++)
        to[i] = cylint_difference(x[i], y[i]).hi;
}

/* Writes each member of a valid shape once: to clear the struct first would cost
 * time.  p0, r0, p1, r1: as in a record (record.h); a, b: of elliptic kinds. */
static void write_shape(cylint_shape *shape, int kind, int ends,
                        const double p0[3], double r0, const double p1[3],
                        double r1, const double a[3], const double b[3])
{
    const int has_end_points = cylint_has_end_points(kind);
    int *flag = shape->library.flag;
    double *x = shape->library.number;
    shape->kind = kind;
    shape->ends = ends;
    copy3(x + CYLINT_AT_BASE, p0);
    if (has_end_points)
        write_difference(x + CYLINT_AT_AXIS, p1, p0);
    else
        copy3(x + CYLINT_AT_AXIS, p1);
    copy3(x + CYLINT_AT_TOP, has_end_points ? p1 : none);
    copy3(x + CYLINT_AT_A, a);
    copy3(x + CYLINT_AT_B, b);
    x[CYLINT_AT_R0] = r0;
    x[CYLINT_AT_R1] = r1;
    flag[CYLINT_AT_LEFT_HANDED] = 0;
    flag[CYLINT_AT_SURFACE] = CYLINT_PART_LATERAL;
    flag[CYLINT_AT_IN_RANGE] = cylint_is_in_window(shape);
    CYLINT_OF_FMA(cylint_measure_local)(shape);
}

/* Checks and writes a shape.  cylint_kind lists a tapered kind right after the kind
 * for equal radii. */
CYLINT_INLINE cylint_status construct(cylint_shape *shape, int kind,
                                      cylint_ends ends, const double p0[3],
                                      double r0, const double p1[3], double r1,
                                      const double a[3], const double b[3])
{
    const int has_length =
        cylint_has_end_points(kind)
            ? cylint_is_round(kind) || !cylint_are_equal(p0, p1)
            : !cylint_is_zero(p1);
    const int is_straight = cylint_rank(r0) == cylint_rank(r1);
    if (!cylint_is_finite(p0) || !cylint_is_finite(p1) ||
        !cylint_is_finite(a) || !cylint_is_finite(b) ||
        !(fabs(r0) <= DBL_MAX) || !(fabs(r1) <= DBL_MAX))
        return refuse_shape(shape, CYLINT_ENONFINITE);
    if (cylint_has_tangent(kind) && cylint_sign(r1) <= 0)
        return refuse_shape(shape, CYLINT_EANGLE);
    if (cylint_sign(r0) < 0 || cylint_sign(r1) < 0 ||
        (cylint_sign(r0) == 0 && cylint_sign(r1) == 0))
        return refuse_shape(shape, CYLINT_ERADIUS);
    if (!has_length)
        return refuse_shape(shape, CYLINT_EAXIS);
    if (!cylint_ends_fit(kind, (int)ends))
        return refuse_shape(shape, CYLINT_EENDS);
    write_shape(shape, is_straight && cylint_is_tapered(kind) ? kind - 1 : kind,
                (int)ends, p0, r0, p1, r1, a, b);
    return CYLINT_OK;
}

cylint_status cylint_cone(cylint_shape *shape, const double p0[3], double r0,
                          const double p1[3], double r1, cylint_ends ends)
{
    return construct(shape, CYLINT_KIND_CONE, ends, p0, r0, p1, r1, none, none);
}

cylint_status cylint_cylinder(cylint_shape *shape, const double p0[3],
                              const double p1[3], double r, cylint_ends ends)
{
    return cylint_cone(shape, p0, r, p1, r, ends);
}

cylint_status cylint_sphere(cylint_shape *shape, const double c[3], double r,
                            cylint_ends ends)
{
    return construct(shape, CYLINT_KIND_SPHERE, ends, c, r, c, r, none, none);
}

/* The sign of the S of forms_template.h, exactly: of |p1 - p0|^2 - (r1 - r0)^2,
 * or of a.(b x h). */
static int sign_of_S(const cylint_shape *shape)
{
    cylint_line line;
    cylint_query q;
    cylint_open_at(&q, shape, &line, cylint_base(shape));
    return cylint_form_sign(&q, FORM_ROOT_OF_S, 0);
}

cylint_status cylint_round_cone(cylint_shape *shape, const double p0[3],
                                double r0, const double p1[3], double r1,
                                cylint_ends ends)
{
    const cylint_status status =
        construct(shape, CYLINT_KIND_RCONE, ends, p0, r0, p1, r1, none, none);
    /* local coordinates that are accurate show that neither ball holds the
     * other */
    if (status == CYLINT_OK && !cylint_prepared(shape) &&
        (cylint_are_equal(p0, p1) || sign_of_S(shape) <= 0)) {
        const cylint_shape hull = *shape;
        cylint_ball_of(shape, &hull, cylint_less(r0, r1));
        CYLINT_OF_FMA(cylint_measure_local)(shape);
    }
    return status;
}

cylint_status cylint_capsule(cylint_shape *shape, const double p0[3],
                             const double p1[3], double r, cylint_ends ends)
{
    return cylint_round_cone(shape, p0, r, p1, r, ends);
}

/* Writes the sign of a.(b x h).  Returns whether it is 0.  Local coordinates that
 * are accurate have it already. */
static int is_flat(cylint_shape *shape)
{
    if (cylint_prepared(shape))
        return 0;
    shape->library.flag[CYLINT_AT_LEFT_HANDED] = 0;
    const int det = sign_of_S(shape);
    shape->library.flag[CYLINT_AT_LEFT_HANDED] = det < 0;
    return det == 0;
}

cylint_status cylint_elliptic_cone(cylint_shape *shape, const double c[3],
                                   const double a[3], const double b[3],
                                   const double h[3], double k,
                                   cylint_ends ends)
{
    const cylint_status status =
        construct(shape, CYLINT_KIND_ECONE, ends, c, 1, h, k, a, b);
    return status == CYLINT_OK && is_flat(shape)
               ? refuse_shape(shape, CYLINT_EDEGENERATE)
               : status;
}

cylint_status cylint_elliptic_cylinder(cylint_shape *shape, const double c[3],
                                       const double a[3], const double b[3],
                                       const double h[3], cylint_ends ends)
{
    return cylint_elliptic_cone(shape, c, a, b, h, 1, ends);
}

cylint_status cylint_tangent_cone(cylint_shape *shape, const double v[3],
                                  const double u[3], double tangent,
                                  cylint_ends ends)
{
    return construct(shape, CYLINT_KIND_ACONE, ends, v, 0, u, tangent, none,
                     none);
}

cylint_status cylint_angle_cone(cylint_shape *shape, const double v[3],
                                const double u[3], double degrees,
                                cylint_ends ends)
{
    const int is_angle = cylint_sign(degrees) > 0 && degrees < 90,
              is_finite = fabs(degrees) <= DBL_MAX;
    /* the tangent is refused as the angle would be */
    return cylint_tangent_cone(shape, v, u,
                               is_angle    ? cylint_tangent(degrees)
                               : is_finite ? 0
                                           : degrees,
                               ends);
}

cylint_status cylint_halfspace(cylint_shape *shape, const double p[3],
                               const double n[3])
{
    if (!cylint_is_finite(p) || !cylint_is_finite(n))
        return refuse_shape(shape, CYLINT_ENONFINITE);
    if (cylint_is_zero(n))
        return refuse_shape(shape, CYLINT_EAXIS);
    memset(shape, 0, sizeof *shape); /* no local coordinates */
    shape->kind = CYLINT_KIND_HALFSPACE;
    shape->ends = CYLINT_ENDS_INFINITE;
    copy3(shape->library.number + CYLINT_AT_BASE, p);
    copy3(shape->library.number + CYLINT_AT_AXIS, n);
    shape->library.flag[CYLINT_AT_IN_RANGE] = cylint_is_in_window(shape);
    return CYLINT_OK;
}

/* --------------------------------------------------------------- lines -- */

static cylint_status refuse_line(cylint_line *line, cylint_status why)
{
    memset(line, 0, sizeof *line);
    return why;
}

cylint_status cylint_span(cylint_line *line, const double o[3],
                          const double d[3], double tmin, double tmax)
{
    if (!cylint_is_finite(o) || !cylint_is_finite(d))
        return refuse_line(line, CYLINT_ENONFINITE);
    if (cylint_is_zero(d))
        return refuse_line(line, CYLINT_EDIRECTION);
    if (tmin != tmin || tmax != tmax || cylint_less(tmax, tmin))
        return refuse_line(line, CYLINT_EDOMAIN);
    copy3(line->o, o);
    copy3(line->d, d);
    copy3(line->d_lo, none);
    copy3(line->end, none);
    line->tmin = tmin;
    line->tmax = tmax;
    line->segment = 0;
    line->valid = 1;
    cylint_measure_line(line);
    return CYLINT_OK;
}

cylint_status cylint_whole_line(cylint_line *line, const double o[3],
                                const double d[3])
{
    return cylint_span(line, o, d, -HUGE_VAL, HUGE_VAL);
}

cylint_status cylint_line_at(cylint_line *line, const double point[3])
{
    /* mutant '0' -> '1': any direction serves */
    static const double along[3] = {1, 0, 0};
    return cylint_whole_line(line, point, along);
}

cylint_status cylint_open_at(cylint_query *q, const cylint_shape *shape,
                             cylint_line *line, const double point[3])
{
    const cylint_status status = cylint_line_at(line, point);
    if (status == CYLINT_OK)
        cylint_query_open(q, shape, line);
    return status;
}

cylint_status cylint_ray(cylint_line *line, const double o[3],
                         const double d[3])
{
    return cylint_span(line, o, d, 0, HUGE_VAL);
}

cylint_status cylint_segment(cylint_line *line, const double a[3],
                             const double b[3])
{
    if (!cylint_is_finite(a) || !cylint_is_finite(b))
        return refuse_line(line, CYLINT_ENONFINITE);
    if (cylint_are_equal(a, b))
        return refuse_line(line, CYLINT_EDIRECTION);
    copy3(line->o, a);
    copy3(line->end, b);
    for (int i = 0; i < 3; i++) {
        const pair d = cylint_difference(b[i], a[i]);
        line->d[i] = d.hi;
        line->d_lo[i] = d.lo;
    }
    line->tmin = 0;
    line->tmax = 1;
    line->segment = 1;
    line->valid = 1;
    cylint_measure_line(line);
    return CYLINT_OK;
}

cylint_kind cylint_arguments(const cylint_shape *shape,
                             double numbers[CYLINT_ARGUMENTS_MOST])
{
    /* By kind: p, r, q, R are p0, r0, p1 and r1 of the record; a and b are the
     * semi-axes. */
    static const char *const parts[] = {
        [CYLINT_KIND_NONE] = "",          [CYLINT_KIND_CYLINDER] = "pqr",
        [CYLINT_KIND_CONE] = "prqR",      [CYLINT_KIND_ACONE] = "pqR",
        [CYLINT_KIND_ECYLINDER] = "pabq", [CYLINT_KIND_ECONE] = "pabqR",
        [CYLINT_KIND_SPHERE] = "pr",      [CYLINT_KIND_CAPSULE] = "pqr",
        [CYLINT_KIND_RCONE] = "prqR",     [CYLINT_KIND_HALFSPACE] = "pq"};
    const int kind = cylint_made_kind(shape);
    cylint_record record;
    cylint_set_record(&record, shape);
    for (const char *p = parts[kind]; *p; p++) {
        const double *from = *p == 'a'   ? cylint_a(shape)
                             : *p == 'b' ? cylint_b(shape)
                             : *p == 'p' ? record.p0
                             : *p == 'q' ? record.p1
                             : *p == 'r' ? &record.r0
                                         : &record.r1;
        const size_t count = *p == 'r' || *p == 'R' ? 1 : 3;
        memcpy(numbers, from, count * sizeof *from);
        numbers += count;
    }
    return (cylint_kind)kind;
}

cylint_status cylint_make_of_record(cylint_shape *shape, int kind, int ends,
                                    const cylint_record *from,
                                    const cylint_semi_axes *axes)
{
    switch (kind) {
    case CYLINT_KIND_CYLINDER:
    case CYLINT_KIND_CONE:
        return cylint_cone(shape, from->p0, from->r0, from->p1, from->r1,
                           (cylint_ends)ends);
    case CYLINT_KIND_ACONE:
        return cylint_tangent_cone(shape, from->p0, from->p1, from->r1,
                                   (cylint_ends)ends);
    case CYLINT_KIND_ECYLINDER:
    case CYLINT_KIND_ECONE:
        return cylint_elliptic_cone(shape, from->p0, axes->a, axes->b, from->p1,
                                    from->r1, (cylint_ends)ends);
    case CYLINT_KIND_SPHERE:
        return cylint_sphere(shape, from->p0, from->r0, (cylint_ends)ends);
    case CYLINT_KIND_CAPSULE:
    case CYLINT_KIND_RCONE:
        return cylint_round_cone(shape, from->p0, from->r0, from->p1, from->r1,
                                 (cylint_ends)ends);
    case CYLINT_KIND_HALFSPACE:
        return cylint_halfspace(shape, from->p0, from->p1);
    default:
        return refuse_shape(shape, CYLINT_ENONFINITE);
    }
}
