/*
 * elliptic_safety.c - a lower bound of the distance of elliptic kinds, in doubles
 *
 * In local coordinates (shapes/local.h) let w = (x, y), rho = r + slope z, and G
 * the matrix of x and y, g the row of z.  The lateral surface is |w| = rho.  For
 * a unit vector e, w.e - rho = 0 is one of its tangent planes, at the distance
 *     (w.e - rho) / |N|,   N = G' e - slope g.
 * Outside, every tangent plane is a lower bound, and so is every plane
 * perpendicular to some n that touches the solid.  So a rough e or n costs
 * tightness only.
 *
 * Inside, the least of these distances over all e is wanted.  Let A be a matrix
 * with e.Ae >= |N|^2 for all e, m > 0, M = 1 - m A positive definite and
 * W = w.(1/M) w <= rho^2.  By Cauchy's inequality
 *     w.e <= sqrt(W) sqrt(e.Me) = sqrt(W) sqrt(1 - m e.Ae),
 *     sqrt(W) sqrt(1 - m e.Ae) + sqrt(rho^2 - W) sqrt(m e.Ae) <= rho,
 * so rho - w.e >= sqrt(m (rho^2 - W)) sqrt(e.Ae), and the distance is at least
 *     sqrt(m (rho^2 - W)).
 * For each m this is a lower bound.  It is the distance, where e.Ae = |N|^2, if
 * |(1/M) w| = rho.  Outside m is negative, and e is the direction of (1/M) w.
 *
 * |N|^2 = e.Be - 2 b.e + c with B = G G', b = slope G g, c = slope^2 g.g, and
 * -2 b.e <= (b.e)^2 / |b| + |b|.  So A = B + b b' / |b| + (|b| + c).  Upright
 * shapes and cylinders have b = 0 and lose nothing by that.
 */
#include "elliptic.h"

#include "../numbers/bits.h"
#include "../shapes/shape_facts.h"
#include "error_bounds.h"

/* A symmetric matrix. */
typedef struct {
    double xx, xy, yy;
} section_matrix;

/* A point in local coordinates. */
typedef struct {
    const cylint_shape *shape;
    double D[3]; /* from the base */
    double x, y, z, rho;
    double error; /* of rho - w.e and of z */
    double g;     /* at least |g| */
    section_matrix A;
} elliptic_position;

/* The iteration for m ends after so many steps, or after the first one when the
 * length of (1/M) w differs from rho by such a part of it. */
enum { MULTIPLIER_STEPS = 6 };
#define CLOSE_ENOUGH 0x1p-4

/* Numbers up to this, times the sizes of points and shapes, have squares that
 * do not overflow. */
#define TAME 0x1p400

/* How near m comes to where M is singular, relative to m. */
#define SINGULAR_MARGIN 0x1p-16

static double dot_doubles(const double u[3], const double v[3])
{
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

static double sum_of_sizes(const double v[3])
{
    return fabs(v[0]) + fabs(v[1]) + fabs(v[2]);
}

static void load_local_row(double row[3], const cylint_shape *s, int k)
{
    for (int i = 0; i < 3; i++)
        row[i] = cylint_column(s, i)[k];
}

/* Entries of B have the error 9 u norm^2, those of b 9 u |slope| norm^2, c 9 u
 * slope^2 norm^2, u = CYLINT_ROUNDING.  The sums for A add as much again. */
static void load_section_matrix(elliptic_position *p, const double x[3],
                                const double y[3], const double g[3])
{
    const double slope = cylint_slope(p->shape), gg = dot_doubles(g, g);
    const double k = cylint_norm(p->shape) * (1 + fabs(slope));
    double more = CYLINT_ELLIPTIC_SAFETY_ERROR * k * k;
    p->A = (section_matrix){dot_doubles(x, x), dot_doubles(x, y),
                            dot_doubles(y, y)};
    p->g = sqrt(gg) * (1 + CYLINT_ELLIPTIC_SAFETY_ERROR);
    if (cylint_sign(slope) != 0) {
        const double bx = slope * dot_doubles(x, g),
                     by = slope * dot_doubles(y, g);
        const double b = sqrt(bx * bx + by * by);
        more += b + slope * slope * gg;
        if (b > CYLINT_ELLIPTIC_SAFETY_ERROR * k * k) {
            p->A.xx += bx * bx / b;
            p->A.xy += bx * by / b;
            p->A.yy += by * by / b;
        } else {
            more += b;
        }
    }
    p->A.xx += more;
    p->A.yy += more;
}

static void locate_elliptic(elliptic_position *p, const cylint_shape *s,
                            const double point[3])
{
    double x[3], y[3], g[3];
    p->shape = s;
    for (int i = 0; i < 3; i++)
        p->D[i] = point[i] - cylint_base(s)[i];
    load_local_row(x, s, 0);
    load_local_row(y, s, 1);
    load_local_row(g, s, 2);
    load_section_matrix(p, x, y, g);
    p->x = dot_doubles(p->D, x);
    p->y = dot_doubles(p->D, y);
    p->z = dot_doubles(p->D, g);
    p->rho = cylint_r0(s) + cylint_slope(s) * p->z;
    p->error =
        CYLINT_ELLIPTIC_SAFETY_ERROR * (1 + fabs(cylint_slope(s))) *
        (sum_of_sizes(p->D) * cylint_norm(s) + cylint_reach(s) + cylint_r0(s));
}

/* ------------------------------------------------------ the multiplier -- */

/* M = 1 - m A: its entries xx, xy, yy, and 1 / det. */
typedef struct {
    double a, b, c, inverse;
} inverse_section;

static inverse_section invert_section(const section_matrix *A, double m)
{
    const double a = 1 - m * A->xx, b = -m * A->xy, c = 1 - m * A->yy;
    return (inverse_section){a, b, c, 1 / (a * c - b * b)};
}

/* to = (1/M) (x, y) */
static void solve_section(const inverse_section *M, double x, double y,
                          double to[2])
{
    to[0] = (M->c * x - M->b * y) * M->inverse;
    to[1] = (M->a * y - M->b * x) * M->inverse;
}

/* Writes v = (1/M) w for an m, not above `most`, at which its length is about
 * rho.  Returns m.  1 / |v| is nearly linear in m: each step is Newton's for
 * it. */
static double find_multiplier(const section_matrix *A, double x, double y,
                              double rho, double most, double v[2])
{
    double m = 0;
    inverse_section M = {1, 0, 1, 1};
    v[0] = x;
    v[1] = y;
    for (int i = 0; i < MULTIPLIER_STEPS; i++) {
        double t[2];
        const double square = v[0] * v[0] + v[1] * v[1];
        const double short_by = rho - sqrt(square);
        if (i > 0 && fabs(short_by) <= CLOSE_ENOUGH * rho)
            break;
        solve_section(&M, A->xx * v[0] + A->xy * v[1],
                      A->xy * v[0] + A->yy * v[1], t);
        const double slope = v[0] * t[0] + v[1] * t[1];
        const double next = m + square * short_by / (slope * rho);
        m = next < most ? next : most;
        M = invert_section(A, m);
        solve_section(&M, x, y, v);
    }
    return m;
}

/* ------------------------------------------------------------- bounds --- */

/* The largest m for which M is positive definite, nearly. */
static double largest_multiplier(const section_matrix *A)
{
    const double half = 0.5 * (A->xx - A->yy);
    const double most =
        0.5 * (A->xx + A->yy) + sqrt(half * half + A->xy * A->xy);
    return (1 - SINGULAR_MARGIN) / most;
}

/* From all tangent planes, for a point on their inner side.  det has the error
 * 16 u, and the numerator of W 56 u |w|^2, where W is at least |w|^2. */
static double inside_lateral(const elliptic_position *p)
{
    double v[2];
    const double rho = p->rho - p->error;
    if (!(rho > 0))
        return 0;
    const double m =
        find_multiplier(&p->A, p->x, p->y, rho, largest_multiplier(&p->A), v);
    if (!(m > 0))
        return 0;
    const double inverse = invert_section(&p->A, m).inverse;
    const double W = (p->x * v[0] + p->y * v[1]) *
                     (1 + 2 * CYLINT_ELLIPTIC_SAFETY_ERROR * (1 + inverse));
    const double rest = rho * rho * (1 - CYLINT_ELLIPTIC_SAFETY_ERROR) - W;
    return rest > 0 ? sqrt(m * rest) * (1 - CYLINT_ELLIPTIC_SAFETY_ERROR) : 0;
}

/* N of a unit vector e.  Returns at least its length. */
static double load_tangent_normal(const elliptic_position *p, const double e[2],
                                  double N[3])
{
    for (int i = 0; i < 3; i++)
        N[i] = cylint_column(p->shape, i)[0] * e[0] +
               cylint_column(p->shape, i)[1] * e[1] -
               cylint_slope(p->shape) * cylint_column(p->shape, i)[2];
    return sqrt(dot_doubles(N, N)) * (1 + CYLINT_ELLIPTIC_SAFETY_ERROR) +
           CYLINT_ELLIPTIC_SAFETY_ERROR * cylint_norm(p->shape) *
               (1 + fabs(cylint_slope(p->shape)));
}

/* The direction e of a tangent plane that is far from a point outside. */
static void choose_tangent_plane(const elliptic_position *p, double e[2])
{
    if (p->rho > 0) {
        find_multiplier(&p->A, p->x, p->y, p->rho, 0, e);
    } else { /* m = infinity */
        e[0] = p->A.yy * p->x - p->A.xy * p->y;
        e[1] = p->A.xx * p->y - p->A.xy * p->x;
    }
    const double size = sqrt(e[0] * e[0] + e[1] * e[1]);
    e[0] /= size;
    e[1] /= size;
}

/* From one tangent plane.  foot: z of the foot on it. */
static double outside_lateral(const elliptic_position *p, const double e[2],
                              double *foot)
{
    double N[3], g[3];
    const double size = load_tangent_normal(p, e, N);
    const double height = p->x * e[0] + p->y * e[1] - p->rho - p->error;
    load_local_row(g, p->shape, 2);
    *foot = p->z - height * dot_doubles(N, g) / (size * size);
    return height / size;
}

/* From the plane through a point of a rim that is perpendicular to the vector n
 * to D, the point minus the center of that end. */
static double above_support_plane(const cylint_shape *s, int end,
                                  const double D[3], const double n[3])
{
    const double na = dot_doubles(n, cylint_a(s)),
                 nb = dot_doubles(n, cylint_b(s)),
                 nh = dot_doubles(n, cylint_axis(s));
    const double reach = sqrt(na * na + nb * nb);
    const double here = reach * cylint_end_factor(s, end);
    const double there = reach * cylint_end_factor(s, !end) + (end ? -nh : nh);
    const double error =
        CYLINT_ELLIPTIC_SAFETY_ERROR * sum_of_sizes(n) *
        (sum_of_sizes(D) + sum_of_sizes(cylint_axis(s)) +
         (sum_of_sizes(cylint_a(s)) + sum_of_sizes(cylint_b(s))) *
             cylint_larger(1, cylint_r1(s)));
    return (dot_doubles(n, D) - cylint_larger(here, there) - error) /
           (sqrt(dot_doubles(n, n)) * (1 + CYLINT_ELLIPTIC_SAFETY_ERROR));
}

/* From the plane through the nearest point of a rim.  In the plane of the rim
 * the matrix of the coordinates in a and b is the inverse of (a b)' (a b). */
static double from_elliptic_rim(const elliptic_position *p, int end)
{
    const cylint_shape *s = p->shape;
    const double factor = cylint_end_factor(s, end);
    const double aa = dot_doubles(cylint_a(s), cylint_a(s)),
                 ab = dot_doubles(cylint_a(s), cylint_b(s)),
                 bb = dot_doubles(cylint_b(s), cylint_b(s)),
                 inverse = 1 / (aa * bb - ab * ab);
    double D[3], n[3], v[2] = {0, 0};
    for (int i = 0; i < 3; i++)
        D[i] = end ? p->D[i] - cylint_axis(s)[i] : p->D[i];
    const double Da = dot_doubles(D, cylint_a(s)),
                 Db = dot_doubles(D, cylint_b(s));
    const double x = (bb * Da - ab * Db) * inverse;
    const double y = (aa * Db - ab * Da) * inverse;
    if (x * x + y * y <= factor * factor || !(x * x + y * y <= TAME))
        return 0; /* the cap is nearer, or a square could overflow */
    const section_matrix A = {bb * inverse, -ab * inverse, aa * inverse};
    if (factor > 0) {
        find_multiplier(&A, x, y, factor, 0, v);
        const double scale = factor / sqrt(v[0] * v[0] + v[1] * v[1]);
        v[0] *= scale;
        v[1] *= scale;
    }
    for (int i = 0; i < 3; i++)
        n[i] = D[i] - (v[0] * cylint_a(s)[i] + v[1] * cylint_b(s)[i]);
    return above_support_plane(s, end, D, n);
}

/* For a point outside.  inner: not outside the lateral surface but beyond an
 * end. */
static double outside_bounded(const elliptic_position *p, int inner)
{
    const double above = p->z - cylint_height(p->shape);
    double best = cylint_larger(-p->z, above) - p->error, foot = p->z;
    best = best > 0 ? best / p->g : 0;
    if (!inner) {
        double e[2];
        choose_tangent_plane(p, e);
        const double lateral = outside_lateral(p, e, &foot);
        best = lateral > best ? lateral : best;
    } else if (p->shape->ends == CYLINT_ENDS_OPEN) {
        const double lateral = inside_lateral(p);
        return lateral > best ? lateral : best;
    }
    if (foot >= 0 && foot <= cylint_height(p->shape))
        return best;
    const double rim = from_elliptic_rim(p, foot > 0);
    return rim > best ? rim : best;
}

/* For a point between the planes of the ends and within the lateral surface. */
static double inside_bounded(const elliptic_position *p)
{
    const double height = cylint_height(p->shape);
    const double cap = (cylint_smaller(p->z, height - p->z) - p->error) / p->g;
    const double lateral = inside_lateral(p);
    return cap < lateral && p->shape->ends != CYLINT_ENDS_OPEN ? cap : lateral;
}

/* The nappe on the side of the point, seen from the apex, has rho > 0 and the
 * other one the opposite coordinates. */
static double from_infinite_elliptic(elliptic_position *p)
{
    double e[2], N[3], foot;
    if (p->rho < 0) {
        p->x = -p->x;
        p->y = -p->y;
        p->rho = -p->rho;
    }
    if (p->x * p->x + p->y * p->y < p->rho * p->rho)
        return inside_lateral(p);
    choose_tangent_plane(p, e);
    const double here = outside_lateral(p, e, &foot);
    if (cylint_sign(cylint_slope(p->shape)) == 0)
        return here;
    const double opposite[2] = {-e[0], -e[1]};
    const double there = (p->x * e[0] + p->y * e[1] + p->rho - p->error) /
                         load_tangent_normal(p, opposite, N);
    return there < here ? there : here;
}

static double from_bounded_elliptic(const elliptic_position *p)
{
    const double height = cylint_height(p->shape);
    const int inner = p->rho > 0 && p->x * p->x + p->y * p->y < p->rho * p->rho;
    return inner && p->z > 0 && p->z < height ? inside_bounded(p)
                                              : outside_bounded(p, inner);
}

/* Whether no product overflows, such as the square of A w: in directed rounding
 * it would be the largest double. */
static int is_tame(const elliptic_position *p)
{
    const cylint_shape *s = p->shape;
    const double k = cylint_norm(s) * (1 + fabs(cylint_slope(s)));
    return p->error * (1 + k * k) <= TAME;
}

double cylint_elliptic_safety(const cylint_shape *shape, const double point[3])
{
    elliptic_position p;
    locate_elliptic(&p, shape, point);
    if (!is_tame(&p))
        return 0;
    const double bound = cylint_is_bounded(shape) ? from_bounded_elliptic(&p)
                                                  : from_infinite_elliptic(&p);
    return bound > 0 ? bound : 0;
}
