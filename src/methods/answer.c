/*
 * answer.c - writes the chord of an unbounded solid as a cylint_answer, as
 * cylint_intersect() does
 *
 * No author defines the members of a hit.  They are computed from its point in
 * plain doubles, as cylint.h defines them.
 */
#include "methods.h"

#include "../shapes/measure.h"

/* ---------------------------------------------------------------- ends -- */

/*
 * The hits of a bounded shape are the ends of the intersection of two
 * intervals: the one between the lateral roots and the one in which
 * 0 <= z <= 1.  An intersection of intervals always has two ends.  Testing
 * candidate points one by one can instead give one hit or three at a rim.
 *
 * Where the plane and a lateral root have the same t the hit is on the rim
 * and counts as lateral.  A chord in the plane has the relation along.  A
 * chord clipped to one point touches the rim.
 */
void cylint_chord_clip(cylint_method_chord *chord, cylint_affine f, int part)
{
    if (chord->relation == CYLINT_RELATION_MISS)
        return;
    if (f.slope == 0) {
        if (f.at == 0 && chord->relation == CYLINT_RELATION_CROSS)
            chord->relation = CYLINT_RELATION_ALONG;
        else if (!(f.at >= 0))
            chord->relation = CYLINT_RELATION_MISS;
        return;
    }

    const double t = -f.at / f.slope;
    const int end = f.slope > 0 ? 0 : 1;
    if (end == 0 ? t > chord->t[0] : t < chord->t[1]) {
        chord->t[end] = t;
        chord->part[end] = chord->relation == CYLINT_RELATION_ALONG
                               ? CYLINT_PART_LATERAL
                               : part;
    }
    if (!(chord->t[0] <= chord->t[1])) {
        chord->relation = CYLINT_RELATION_MISS;
    } else if (chord->t[0] == t && chord->t[1] == t) {
        chord->relation = CYLINT_RELATION_TOUCH;
        chord->part[0] = chord->part[1] = CYLINT_PART_LATERAL;
    }
}

/* A pointed end has no cap, so its plane does not clip. */
void cylint_chord_ends(cylint_method_chord *chord, const cylint_shape *shape,
                       cylint_affine z)
{
    if (!cylint_is_bounded(shape))
        return;
    if (cylint_r0(shape) != 0)
        cylint_chord_clip(chord, z, CYLINT_PART_CAP0);
    if (cylint_r1(shape) != 0)
        cylint_chord_clip(chord, (cylint_affine){1 - z.at, -z.slope},
                          CYLINT_PART_CAP1);
}

/* ------------------------------------------------------- members of hits -- */

/* A point is c + x a + y b + z h; it is inside if x^2 + y^2 <= rho(z)^2.  For a
 * circular shape a and b have length one. */
typedef struct frame {
    double row[3][3]; /* the gradients of x, y and z */
    double rho, drho; /* rho(z) = rho + drho z */
} frame;

static void semi_axes(const cylint_shape *shape, double radius, double a[3],
                      double b[3])
{
    const double *axis = cylint_axis(shape);
    double e[3] = {0, 0, 0}, h[3];
    int least = 0;

    if (cylint_is_elliptic(shape->kind)) {
        memcpy(a, cylint_a(shape), sizeof e);
        memcpy(b, cylint_b(shape), sizeof e);
        return;
    }
    for (int i = 1; i < 3; i++)
        if (cylint_less(fabs(axis[i]), fabs(axis[least])))
            least = i;
    e[least] = 1;
    unit(axis, h);
    cross(e, h, a);
    unit(a, a);
    cross(h, a, b);
    for (int i = 0; i < 3; i++) {
        a[i] *= radius;
        b[i] *= radius;
    }
}

void cylint_method_rows(const cylint_shape *shape, double radius,
                        double row[3][3])
{
    const double *h = cylint_axis(shape);
    double a[3], b[3];

    semi_axes(shape, radius, a, b);
    cross(b, h, row[0]);
    cross(h, a, row[1]);
    cross(a, b, row[2]);
    const double det = dot(row[2], h);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            row[i][j] /= det;
}

static frame frame_of(const cylint_shape *shape)
{
    const double r0 = cylint_r0(shape), dr = cylint_r1(shape) - r0;
    frame f = {.rho = r0,
               .drho =
                   dr * cylint_radius_unit(shape, length(cylint_axis(shape)))};

    cylint_method_rows(shape, 1, f.row);
    return f;
}

/* x^2 + y^2 = rho^2: half the gradient is x dx + y dy - rho drho dz. */
static void normal_at(const cylint_shape *shape, const frame *f,
                      const double d[3], double x, double y, double z, int part,
                      double normal[3])
{
    if (part != CYLINT_PART_LATERAL) {
        const double sign = part == CYLINT_PART_CAP0 ? -1 : 1;
        for (int i = 0; i < 3; i++)
            normal[i] = sign * f->row[2][i];
    } else if (x == 0 && y == 0) {
        const double climb = dot(d, cylint_axis(shape));
        const int sign =
            cylint_apex_normal_sign(shape, (climb > 0) - (climb < 0));
        for (int i = 0; i < 3; i++)
            normal[i] = sign * cylint_axis(shape)[i];
    } else {
        const double slope = (f->rho + f->drho * z) * f->drho;
        for (int i = 0; i < 3; i++)
            normal[i] =
                x * f->row[0][i] + y * f->row[1][i] - slope * f->row[2][i];
    }
    unit(normal, normal);
}

/* The angle of (x, y) in turns: in [0, 1).  An angle that underflows is a quotient:
 * atan2() would set errno. */
static double angle_in_turns(double x, double y)
{
    const int is_tiny = x > 0 && fabs(y) < x * DBL_MIN;
    const double pi = 3.14159265358979323846;
    const double turns = (is_tiny ? y / x : atan2(y, x)) / (2 * pi);
    const double positive = turns < 0 ? turns + 1 : turns;
    return positive < 1 ? fabs(positive) : 0; /* no -0 */
}

/* Writes the wanted members of a hit. */
static void write_hit(const cylint_shape *shape, const cylint_line *line,
                      unsigned want, double t, int part, int side,
                      cylint_hit *hit)
{
    double point[3], D[3];

    if (want & CYLINT_WANT_T)
        hit->t = t;
    if (want & CYLINT_WANT_PART) {
        hit->part = part;
        hit->side = side;
    }
    if (!(want & (CYLINT_WANT_POINT | CYLINT_WANT_NORMAL | CYLINT_WANT_Z |
                  CYLINT_WANT_PHI)))
        return;
    along(line->o, t, line->d, point);
    if (want & CYLINT_WANT_POINT)
        memcpy(hit->point, point, sizeof point);

    const frame f = frame_of(shape);
    minus(point, cylint_base(shape), D);
    const double x = dot(D, f.row[0]), y = dot(D, f.row[1]),
                 z = dot(D, f.row[2]);
    if (want & CYLINT_WANT_Z)
        hit->z = z;
    if (want & CYLINT_WANT_PHI)
        hit->phi = x == 0 && y == 0 ? 0 : angle_in_turns(x, y);
    if (want & CYLINT_WANT_NORMAL)
        normal_at(shape, &f, line->d, x, y, z, part, hit->normal);
}

/* -------------------------------------------------------------- answer -- */

static void refuse(cylint_answer *answer)
{
    answer->relation = CYLINT_RELATION_MISS;
    answer->n = 0;
    answer->flags = CYLINT_FLAG_INVALID;
}

cylint_status cylint_method_not_applicable(cylint_answer *answer)
{
    refuse(answer);
    return CYLINT_EMETHOD;
}

static void add_hit(const cylint_shape *shape, const cylint_line *line,
                    unsigned want, double t, int part, int side,
                    cylint_answer *answer)
{
    if (!(t > -INFINITY && t < INFINITY)) /* the chord has no end, or NaN */
        return;
    if (!(t >= line->tmin && t <= line->tmax) ||
        !cylint_part_is_present(shape->ends, part))
        return;
    if (answer->n == 1 && (want & CYLINT_WANT_NEAREST))
        return;
    write_hit(shape, line, want, t, part, side, &answer->hit[answer->n]);
    answer->n++;
}

cylint_status cylint_method_report(const cylint_shape *shape,
                                   const cylint_line *line, unsigned want,
                                   const cylint_method_chord *chord,
                                   cylint_answer *answer)
{
    if (!line->valid) {
        refuse(answer);
        return CYLINT_OK;
    }
    answer->relation = chord->relation;
    answer->n = 0;
    answer->flags = 0;
    if (chord->relation == CYLINT_RELATION_MISS)
        return CYLINT_OK;

    const int one_point = chord->relation == CYLINT_RELATION_TOUCH ||
                          (chord->gap && chord->t[0] == chord->t[1]);
    const int first = one_point    ? CYLINT_SIDE_BOTH
                      : chord->gap ? CYLINT_SIDE_LEAVING
                                   : CYLINT_SIDE_ENTERING;
    const int second = chord->gap ? CYLINT_SIDE_ENTERING : CYLINT_SIDE_LEAVING;
    add_hit(shape, line, want, chord->t[0], chord->part[0], first, answer);
    if (!one_point)
        add_hit(shape, line, want, chord->t[1], chord->part[1], second, answer);
    return CYLINT_OK;
}
