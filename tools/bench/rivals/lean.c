/*
 * lean.c - prepared quadratics and distances in doubles
 *
 * Each quadratic is written once and is compiled twice: for both t, and for the
 * first t with its normal.
 */
#include "lean.h"

#include "numbers/compiler.h"
#include "shapes/layout.h"

/* Where an end of the overlap is: the lateral surface, the base or the top. */
enum place { LATERAL, BASE, TOP };

static inline int hits_of(const double t[2], double t0, double t1)
{
    return (t[0] >= t0 && t[0] <= t1) + (t[1] >= t0 && t[1] <= t1);
}

/* The roots of A t^2 + 2 B t + C.  Returns 0 if there are none. */
static inline int roots(double A, double B, double C, double t[2])
{
    const double G = B * B - A * C;
    if (!(G >= 0))
        return 0;
    const double root = sqrt(G), inverse = 1 / A;
    t[0] = (-B - root) * inverse;
    t[1] = (-B + root) * inverse;
    return 1;
}

/* Clips the overlap t to the slab.  Returns 0 if it is then empty. */
static inline int clip(const struct lean *s, double z, double speed,
                       double t[2], enum place *on)
{
    if (!(s->height < HUGE_VAL))
        return 1;
    const double inverse = 1 / speed;
    const double base = -z * inverse, top = (s->height - z) * inverse;
    const int up = base < top;
    const double first = up ? base : top, last = up ? top : base;
    if (on) {
        on[0] = first > t[0] ? up ? BASE : TOP : LATERAL;
        on[1] = last < t[1] ? up ? TOP : BASE : LATERAL;
    }
    t[0] = first > t[0] ? first : t[0];
    t[1] = last < t[1] ? last : t[1];
    return t[0] <= t[1];
}

CYLINT_INLINE int cylinder(const struct lean *s, const double o[3],
                           const double d[3], double t[2], enum place *on)
{
    double q[3];
    minus3(q, o, s->base);
    const double speed = dot3(d, s->axis), z = dot3(q, s->axis);
    const double A = dot3(d, d) - speed * speed, B = dot3(q, d) - z * speed;
    const double C = dot3(q, q) - z * z - s->r0_squared;
    return roots(A, B, C, t) && clip(s, z, speed, t, on);
}

CYLINT_INLINE int cone(const struct lean *s, const double o[3],
                       const double d[3], double t[2], enum place *on)
{
    double q[3];
    minus3(q, o, s->base);
    const double speed = dot3(d, s->axis), z = dot3(q, s->axis);
    const double rho = s->r0 + s->slope * z, growth = s->slope * speed;
    const double A = dot3(d, d) - speed * speed - growth * growth;
    const double B = dot3(q, d) - z * speed - rho * growth;
    const double C = dot3(q, q) - z * z - rho * rho;
    if (!roots(A, B, C, t))
        return 0;
    if (A < 0 && s->height < HUGE_VAL) {
        const double low = fmin(t[0], t[1]), high = fmax(t[0], t[1]);
        t[0] = growth > 0 ? high : -HUGE_VAL;
        t[1] = growth > 0 ? HUGE_VAL : low;
    }
    return clip(s, z, speed, t, on);
}

CYLINT_INLINE int elliptic(const struct lean *s, const double o[3],
                           const double d[3], double t[2], enum place *on)
{
    double q[3];
    minus3(q, o, s->base);
    const double x = dot3(q, s->row[0]), y = dot3(q, s->row[1]);
    const double u = dot3(d, s->row[0]), v = dot3(d, s->row[1]);
    const double A = u * u + v * v, B = x * u + y * v;
    const double C = x * x + y * y - 1;
    return roots(A, B, C, t) &&
           clip(s, dot3(q, s->axis), dot3(d, s->axis), t, on);
}

CYLINT_INLINE int sphere(const struct lean *s, const double o[3],
                         const double d[3], double t[2], enum place *on)
{
    double q[3];
    minus3(q, o, s->base);
    if (on)
        on[0] = on[1] = BASE;
    return roots(dot3(d, d), dot3(q, d), dot3(q, q) - s->r0_squared, t);
}

/* Capsule and round cone [Quilez, iquilezles.org/articles/intersectors],
 * with both ends of the overlap: a root beyond the circles is replaced by
 * that of the ball. */
CYLINT_INLINE int hull(const struct lean *s, const double o[3],
                       const double d[3], double t[2], enum place *on)
{
    double q[3];
    minus3(q, o, s->base);
    const double *w = s->axis;
    const double ww = s->height, shrink = -s->slope, shift = shrink * s->r0;
    const double wq = dot3(w, q), wd = dot3(w, d), dq = dot3(d, q);
    const double qq = dot3(q, q), dd = dot3(d, d);
    const double d2 = ww - shrink * shrink;
    const double A = d2 * dd - wd * wd, B = d2 * dq - wq * wd + wd * shift;
    const double C = d2 * qq - wq * wq + 2 * wq * shift - ww * s->r0_squared;
    if (!roots(A, B, C, t))
        return 0;
    for (int k = 0; k < 2; k++) {
        const double y = wq - shift + t[k] * wd;
        if (on)
            on[k] = LATERAL;
        if (y > 0 && y < d2)
            continue;
        const int first = A > 0 ? y <= 0 : (wd > 0) != k;
        const double r1 = s->r0 - shrink, b = first ? dq : dq - wd;
        const double c =
            first ? qq - s->r0_squared : qq - 2 * wq + ww - r1 * r1;
        const double g = b * b - dd * c;
        if (!(g >= 0))
            return 0;
        t[k] = (-b + (k ? sqrt(g) : -sqrt(g))) / dd;
        if (on)
            on[k] = first ? BASE : TOP;
    }
    return 1;
}

/* ------------------------------------------------------------- normals -- */

static inline void straight_normal(const struct lean *s, const double p[3],
                                   enum place on, double normal[3])
{
    const double z = dot3(p, s->axis);
    const double back = z + s->slope * (s->r0 + s->slope * z);
    const double scale = s->scale / fabs(s->r0 + s->slope * z);
    if (on == LATERAL)
        along3(normal, p, -back, s->axis);
    else
        copy3(normal, s->axis);
    scale3(normal, on == LATERAL ? scale : on == BASE ? -1 : 1);
}

static inline void elliptic_normal(const struct lean *s, const double p[3],
                                   enum place on, double normal[3])
{
    const double x = dot3(p, s->row[0]), y = dot3(p, s->row[1]);
    copy3(normal, s->axis);
    if (on == LATERAL) {
        copy3(normal, s->row[0]);
        scale3(normal, x);
        along3(normal, normal, y, s->row[1]);
    }
    scale3(normal, on == LATERAL ? 1 / length3(normal)
                   : on == BASE  ? -s->outside
                                 : s->outside);
}

/* From the centre of the ball that touches the surface there. */
static inline void round_normal(const struct lean *s, const double p[3],
                                enum place on, double normal[3])
{
    const double wp = dot3(p, s->axis), rise = -s->slope;
    const double d2 = s->height - rise * rise;
    double at = on == TOP;
    if (on == LATERAL)
        at = (wp - rise * s->r0) / d2;
    const double scale = 1 / (s->r0 + s->slope * at);
    along3(normal, p, -at, s->axis);
    scale3(normal, scale);
}

static inline void ball_normal(const struct lean *s, const double p[3],
                               enum place on, double normal[3])
{
    (void)on;
    copy3(normal, p);
    scale3(normal, s->scale);
}

#define DEFINE(name, normal_of)                                        \
    static int name##_line(const struct lean *s, const double o[3],    \
                           const double d[3], double t0, double t1,    \
                           double t[2])                                \
    {                                                                  \
        return name(s, o, d, t, NULL) ? hits_of(t, t0, t1) : 0;        \
    }                                                                  \
    static int name##_first(const struct lean *s, const double o[3],   \
                            const double d[3], double *t, double n[3]) \
    {                                                                  \
        double both[2], p[3];                                          \
        enum place on[2] = {LATERAL, LATERAL};                         \
        if (!name(s, o, d, both, on) || !(both[1] >= 0))               \
            return 0;                                                  \
        *t = both[0] >= 0 ? both[0] : both[1];                         \
        minus3(p, o, s->base);                                         \
        along3(p, p, *t, d);                                           \
        normal_of(s, p, both[0] >= 0 ? on[0] : on[1], n);              \
        return 1;                                                      \
    }
DEFINE(cylinder, straight_normal)
DEFINE(cone, straight_normal)
DEFINE(elliptic, elliptic_normal)
DEFINE(sphere, ball_normal)
DEFINE(hull, round_normal)

#define LEAN(kind, name) [CYLINT_KIND_##kind] = {name##_line, name##_first}
const struct lean_formulas lean_formulas[KINDS] = {
    LEAN(CYLINDER, cylinder), LEAN(CONE, cone),    LEAN(ECYLINDER, elliptic),
    LEAN(SPHERE, sphere),     LEAN(CAPSULE, hull), LEAN(RCONE, hull)};

static void prepare_elliptic(struct lean *to, const cylint_shape *s)
{
    const double *a = cylint_a(s), *b = cylint_b(s), *h = cylint_axis(s);
    double bh[3], ha[3], ab[3];
    cross3(bh, b, h);
    cross3(ha, h, a);
    cross3(ab, a, b);
    const double det = dot3(a, bh);
    for (int i = 0; i < 3; i++) {
        to->row[0][i] = bh[i] / det;
        to->row[1][i] = ha[i] / det;
        to->axis[i] = ab[i] / det;
    }
    to->height = 1;
    to->outside = 1 / sqrt(dot3(to->axis, to->axis));
}

void lean_prepare(struct lean *to, const cylint_shape *s)
{
    const double length = length3(cylint_axis(s)), r0 = cylint_r0(s);
    const int is_hull =
        s->kind == CYLINT_KIND_CAPSULE || s->kind == CYLINT_KIND_RCONE;
    const double dr = cylint_r1(s) - r0, slope = dr / length;
    *to = (struct lean){.height = is_hull ? length * length : length,
                        .r0 = r0,
                        .r0_squared = r0 * r0,
                        .slope = is_hull ? dr : slope,
                        .scale = s->kind == CYLINT_KIND_SPHERE
                                     ? 1 / r0
                                     : 1 / sqrt(1 + slope * slope)};
    copy3(to->base, cylint_base(s));
    copy3(to->axis, cylint_axis(s));
    if (!is_hull)
        unit3(to->axis, to->axis);
    if (s->kind == CYLINT_KIND_ECYLINDER)
        prepare_elliptic(to, s);
    if (s->ends == CYLINT_ENDS_INFINITE)
        to->height = HUGE_VAL;
}

/* ----------------------------------------------------------- distances -- */

static inline double positive(double x)
{
    return x > 0 ? x : 0;
}

static inline double clamped(double x)
{
    return x < 0 ? 0 : x > 1 ? 1 : x;
}

/* The coordinates along and across the axis. */
static inline double along_and_across(const struct lean_body *s,
                                      const double point[3], double *across)
{
    double q[3];
    minus3(q, point, s->base);
    const double z = dot3(q, s->axis);
    *across = sqrt(positive(dot3(q, q) - z * z));
    return z;
}

static double cylinder_distance(const struct lean_body *s,
                                const double point[3])
{
    double across;
    const double y = fabs(along_and_across(s, point, &across)) - s->half;
    const double x = across - s->r0;
    if (x < 0 || y < 0)
        return x > y ? x : y;
    return sqrt(x * x + y * y);
}

/* From a cap and from the lateral line; the lesser of the squares. */
static double cone_distance(const struct lean_body *s, const double point[3])
{
    double across;
    const double y = along_and_across(s, point, &across) - s->half;
    const double rim = y < 0 ? s->r0 : s->r1;
    const double cap_x = positive(across - rim), cap_y = fabs(y) - s->half;
    const double dr = s->r1 - s->r0, h = 2 * s->half;
    const double x = across - s->r1, up = y - s->half;
    const double at = clamped(-(x * dr + up * h) * s->inverse);
    const double line_x = x + dr * at, line_y = up + h * at;
    const double cap = cap_x * cap_x + cap_y * cap_y;
    const double line = line_x * line_x + line_y * line_y;
    const double distance = sqrt(cap < line ? cap : line);
    return line_x < 0 && cap_y < 0 ? -distance : distance;
}

static double sphere_distance(const struct lean_body *s, const double point[3])
{
    double q[3];
    minus3(q, point, s->base);
    return sqrt(dot3(q, q)) - s->r0;
}

static double capsule_distance(const struct lean_body *s, const double point[3])
{
    double q[3];
    minus3(q, point, s->base);
    const double at = clamped(dot3(q, s->axis) * s->inverse);
    along3(q, q, -at, s->axis);
    return sqrt(dot3(q, q)) - s->r0;
}

static double rcone_distance(const struct lean_body *s, const double point[3])
{
    double x;
    const double y = along_and_across(s, point, &x), h = 2 * s->half;
    const double k = s->cosine * y - s->sine * x;
    if (k < 0)
        return sqrt(x * x + y * y) - s->r0;
    if (k > s->cosine * h)
        return sqrt(x * x + (y - h) * (y - h)) - s->r1;
    return x * s->cosine + y * s->sine - s->r0;
}

void lean_prepare_body(struct lean_body *to, const cylint_shape *s)
{
    const double length = length3(cylint_axis(s));
    const double dr = cylint_r1(s) - cylint_r0(s);
    const int is_capsule = s->kind == CYLINT_KIND_CAPSULE;
    copy3(to->axis, cylint_axis(s));
    if (!is_capsule)
        unit3(to->axis, to->axis);
    copy3(to->base, cylint_base(s));
    if (s->kind == CYLINT_KIND_CYLINDER)
        middle_of(s, to->base);
    to->half = length / 2;
    to->r0 = cylint_r0(s);
    to->r1 = cylint_r1(s);
    to->sine = -dr / length;
    to->cosine = sqrt(positive(1 - to->sine * to->sine));
    to->inverse = 1 / (length * length + (is_capsule ? 0 : dr * dr));
}

lean_distance *const lean_distances[KINDS] = {
    [CYLINT_KIND_CYLINDER] = cylinder_distance,
    [CYLINT_KIND_CONE] = cone_distance,
    [CYLINT_KIND_SPHERE] = sphere_distance,
    [CYLINT_KIND_CAPSULE] = capsule_distance,
    [CYLINT_KIND_RCONE] = rcone_distance};
