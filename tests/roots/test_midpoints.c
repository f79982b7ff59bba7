/*
 * test_midpoints.c - roots at the midpoint of two doubles, and beside it
 *
 * Random roots are never midpoints, so these are constructed.  A root
 * t = T 2^f with T = 2m + 1 of 54 bits (for subnormal t f = -1075 and any m) is
 * the midpoint of m 2^(f+1) and (m+1) 2^(f+1).  A coordinate of the line is
 * c t plus its origin, so the origin must be c T before the boundary.
 * c T = hi + lo is too long for one double, but the difference of the line's
 * origin -hi and the shape's place lo is exact.  So the even neighbour is known
 * without arithmetic of the library or the oracle.  Moving the shape by one ulp
 * must give the lower or the upper neighbour.  A domain that ends at a neighbour
 * has the roots that it contains.
 */
#include <math.h>
#include <string.h>

#include "check.h"
#include "families.h"
#include "numbers/double_double.h"
#include "draw.h"
#include "ulps.h"
#ifdef HAVE_MPFR
#include "oracle.h"
#endif

enum where { CAP, SIDE, TANGENT, ALONG_A_RULING, APEX, PLACES };

static const char *const place_names[PLACES] = {"cap", "side", "tangent",
                                                "along a ruling", "apex"};

/* The tie to construct: m, f and c as above; lengths are whole numbers times
 * 2^e; side: +1 or -1 of the axis; sign: of t. */
struct plan {
    enum where where;
    family_shape word;
    double m, c;
    int f, e, side, sign, axis, other; /* other: further choices */
};

/* ------------------------------------------------------------ building -- */

/* The line in the shape's own coordinates: x, y in the section, z along the
 * axis.  place: the vector to add to the shape's coordinates. */
struct local_case {
    double o[3], d[3], place[3];
    double low, high;     /* z of base and top, or of apex and end of u */
    double r0, r1, k;     /* radii, factor of an econe */
    double a, b, lean[2]; /* semi-axes and h's lean */
    cylint_ends ends;
};

/* Sets origin and place of coordinate i from d_i T = hi + lo. */
static void set_origin(const struct plan *p, struct local_case *s, int i)
{
    const pair twice = two_prod(2 * s->d[i], p->m);
    s->o[i] = -twice.hi;
    s->place[i] = twice.lo + s->d[i];
}

static int is_cone(family_shape word)
{
    return word == FAMILY_CONE || word == FAMILY_ACONE || word == FAMILY_ECONE;
}

static void cap_tie(const struct plan *p, struct local_case *s)
{
    const double wide = 0x1p60, height = 1024;
    const int top = p->word == FAMILY_ACONE || (p->other & 1);
    s->d[2] = p->c;
    s->d[0] = p->word == FAMILY_ACONE ? 0 : one_of(3) - 1;
    set_origin(p, s, 2);
    s->low = top ? -height : 0;
    s->high = top ? 0 : height;
    s->r0 = s->a = s->b = wide;
    s->r1 = p->word == FAMILY_CYLINDER ? wide : wide / 2;
    s->k = 0.5;
    s->lean[0] = 2;
    s->lean[1] = -4;
}

/* At half the height is a section with the semi-axes size a and size b.  A line
 * along x at y = q meets it at x = +-p. */
static void side_tie(const struct plan *p, struct local_case *s)
{
    static const int triples[][3] = {
        {3, 4, 5}, {5, 12, 13}, {15, 8, 17}, {9, 40, 41}, {1, 0, 1}};
    const int *t = triples[one_of(5)];
    const double px = p->where == TANGENT ? 0 : t[0];
    const double qy = p->where == TANGENT ? t[2] : t[1], r = t[2];
    const int cylinder = !is_cone(p->word);
    const double size = cylinder ? 1 : 2;
    s->a = r * (1 + one_of(3));
    s->b = r * (1 + one_of(3));
    if (p->word < FAMILY_ECYLINDER)
        s->b = s->a;
    s->r0 = s->a;
    s->r1 = cylinder ? s->a : 3 * s->a;
    s->k = 3;
    s->low = -1;
    s->high = 1;
    if (p->word == FAMILY_ACONE) { /* as wide as it is high */
        s->low = -size * s->a;
        s->high = size * s->a;
    }
    s->d[0] = p->c;
    set_origin(p, s, 0);
    s->place[0] -= p->side * size * px * (s->a / r);
    s->o[1] = size * qy * (s->b / r);
    if (cylinder && (p->other & 1)) {
        s->d[2] = one_of(7) - 3;
        s->ends = CYLINT_ENDS_INFINITE;
    } else if (p->word >= FAMILY_ECYLINDER) {
        s->lean[0] = 2 * one_of(3);
        s->lean[1] = 2 * one_of(3);
        s->place[0] -= s->lean[0] / 2;
        s->place[1] -= s->lean[1] / 2;
    }
}

/* A cone with its apex at z = 0 and the radius |z|. */
static void cone_of_45(const struct plan *p, struct local_case *s)
{
    s->low = p->word == FAMILY_ACONE ? 0 : 1;
    s->high = 2;
    s->r0 = s->a = s->b = 1;
    s->r1 = s->k = 2;
}

/* x - z = 2 side on the whole line, so the quadratic is a linear equation. */
static void ruling_tie(const struct plan *p, struct local_case *s)
{
    cone_of_45(p, s);
    s->ends = CYLINT_ENDS_INFINITE;
    s->d[0] = s->d[2] = p->c;
    set_origin(p, s, 0);
    set_origin(p, s, 2);
    s->place[0] -= p->side;
    s->place[2] += p->side;
}

static void apex_tie(const struct plan *p, struct local_case *s)
{
    cone_of_45(p, s);
    s->ends = p->other & 1 ? CYLINT_ENDS_INFINITE : CYLINT_ENDS_NAPPE;
    if (p->other & 4 && p->word == FAMILY_CONE) { /* the apex is the base */
        s->low = s->r0 = 0;
        s->r1 = s->high;
        s->ends = CYLINT_ENDS_CAPPED;
    }
    s->d[0] = p->other & 2 ? one_of(5) - 2 : 0;
    s->d[1] = p->other & 2 ? one_of(5) - 2 : 0;
    s->d[2] = p->c;
    if (s->d[0] * s->d[0] + s->d[1] * s->d[1] == p->c * p->c)
        s->ends = CYLINT_ENDS_NAPPE; /* on a double cone it is a ruling */
    for (int i = 0; i < 3; i++)
        if (s->d[i] != 0)
            set_origin(p, s, i);
}

/* Writes the case with coordinate p->axis as the axis, lengths times 2^e,
 * directions times 2^(e - f). */
static int write_case(const struct plan *p, const struct local_case *s,
                      struct family_case *c)
{
    double at[3], a[3], b[3], to[3];
    c->ends = s->ends;
    for (int j = 0; j < 3; j++) {
        const int i = (j + p->axis + 1) % 3;
        const double low = j < 2 ? 0 : s->low, high = j < 2 ? 0 : s->high;
        const double lean = j == 2                    ? high - low
                            : p->word == FAMILY_ACONE ? 0
                                                      : s->lean[j];
        c->line_data[i] = ldexp(s->o[j], p->e);
        c->line_data[3 + i] = p->sign * ldexp(s->d[j], p->e - p->f);
        at[i] = ldexp(s->place[j] + low, p->e);
        to[i] =
            ldexp(family_has_points(p->word) ? s->place[j] + high : lean, p->e);
        a[i] = j == 0 ? ldexp(s->a, p->e) : 0;
        b[i] = j == 1 ? ldexp(s->b, p->e) : 0;
    }
    family_set_shape(c, p->word, at, a, b, to, ldexp(s->r0, p->e),
                     p->word == FAMILY_ACONE   ? 45
                     : p->word == FAMILY_ECONE ? s->k
                     : p->word == FAMILY_CONE  ? ldexp(s->r1, p->e)
                                               : ldexp(s->r0, p->e));
    return family_make(c);
}

static int build(const struct plan *p, struct family_case *c)
{
    static void (*const ties[PLACES])(const struct plan *,
                                      struct local_case *) = {
        cap_tie, side_tie, side_tie, ruling_tie, apex_tie};
    struct local_case s;
    memset(&s, 0, sizeof s);
    memset(c, 0, sizeof *c);
    ties[p->where](p, &s);
    return write_case(p, &s, c);
}

/* ------------------------------------------------------------ checking -- */

static int has_root(const cylint_answer *answer, double t)
{
    for (int i = 0; i < answer->n; i++)
        if (answer->hit[i].t == t)
            return 1;
    return 0;
}

static int agrees_with_oracle(const struct family_case *c,
                              const cylint_answer *got)
{
#ifdef HAVE_MPFR
    cylint_answer want;
    oracle_intersect(&c->shape, &c->line, CYLINT_WANT_T, &want);
    int same = got->n == want.n && got->relation == want.relation;
    for (int i = 0; i < want.n && same; i++)
        same = got->hit[i].t == want.hit[i].t &&
               got->hit[i].part == want.hit[i].part;
    return same;
#else
    (void)c, (void)got;
    return 1;
#endif
}

static void expect(const struct plan *p, const struct family_case *c, double t,
                   const char *which)
{
    cylint_answer got;
    cylint_intersect(&c->shape, &c->line, CYLINT_WANT_T | CYLINT_WANT_PART,
                     &got);
    const int found = CHECK(has_root(&got, t));
    const int agrees = CHECK(agrees_with_oracle(c, &got));
    if (found && agrees)
        return;
    REPORT("%s, %s: want %a, got %d: %a %a", place_names[p->where], which, t,
           got.n, got.n > 0 ? got.hit[0].t : 0, got.n > 1 ? got.hit[1].t : 0);
    REPORT_CASE(c);
}

/* Domains that end at a neighbour of the root. */
static void expect_in_domains(const struct family_case *c, double lower,
                              double upper)
{
    const double domain[][2] = {{-HUGE_VAL, lower},
                                {-HUGE_VAL, upper},
                                {lower, HUGE_VAL},
                                {upper, HUGE_VAL}};
    for (int i = 0; i < 4; i++) {
        struct family_case within = *c;
        cylint_answer got;
        cylint_span(&within.line, c->line.o, c->line.d, domain[i][0],
                    domain[i][1]);
        cylint_intersect(&c->shape, &within.line,
                         CYLINT_WANT_T | CYLINT_WANT_PART, &got);
        if (CHECK(agrees_with_oracle(&within, &got)))
            continue;
        REPORT("domain %a %a: %d", domain[i][0], domain[i][1], got.n);
        REPORT_CASE(c);
    }
}

/* Moves by one ulp the coordinate of the shape on which t depends: of the
 * plane, or else of the whole axis. */
static int move_shape(const struct plan *p, int ulps, struct family_case *c)
{
    const int along = p->where == CAP ? 2 : 0;
    const int i = (along + p->axis + 1) % 3;
    const int two_points = family_has_points(p->word);
    const int to = family_axis(p->word);
    double *x = c->shape_data;
    if (p->where != CAP || !two_points || !(p->other & 1))
        x[i] = stepped(x[i], ulps);
    if (two_points && (p->where != CAP || p->other & 1))
        x[to + i] = stepped(x[to + i], ulps);
    return family_make(c);
}

static void try_plan(const struct plan *p)
{
    struct family_case c, moved;
    if (!CHECK(build(p, &c)))
        return;
    const double lower = p->sign * ldexp(p->m, p->f + 1);
    const double upper = p->sign * ldexp(p->m + 1, p->f + 1);
    const int odd = fmod(p->m, 2) != 0;
    expect(p, &c, odd ? upper : lower, "tie");
    expect_in_domains(&c, lower, upper);
    if (p->where == APEX)
        return; /* a moved line misses the apex and has other roots */
    for (int ulps = -1; ulps <= 1; ulps += 2) {
        moved = c;
        if (move_shape(p, ulps, &moved))
            expect(p, &moved, ulps < 0 ? lower : upper,
                   ulps < 0 ? "just below" : "just above");
    }
}

/* -------------------------------------------------------------- ranges -- */

static double whole_of_bits(int bits)
{
    const uint64_t top = (uint64_t)1 << (bits - 1);
    return (double)(top | (random_bits(&stream) & (top - 1)));
}

static void for_all_places(void (*choose)(struct plan *p), int times)
{
    for (int where = 0; where < PLACES; where++)
        for (int word = 0; word < 5; word++)
            for (int i = 0; i < times; i++) {
                struct plan p;
                memset(&p, 0, sizeof p);
                p.where = (enum where)where;
                p.word = (family_shape)word;
                if (where >= ALONG_A_RULING && !is_cone(p.word))
                    continue;
                p.c = i % 2 ? 1 + 2 * one_of(1 << one_of(19)) : 1;
                p.side = i & 2 ? 1 : -1;
                p.sign = i & 4 ? 1 : -1;
                p.other = i >> 3;
                p.axis = one_of(3);
                choose(&p);
                try_plan(&p);
            }
}

static void ordinary(struct plan *p)
{
    p->m = whole_of_bits(53);
    p->f = one_of(121) - 60;
    p->e = one_of(41) - 20;
}

TEST(ordinary_ties_go_to_even)
{
    for_all_places(ordinary, 400);
}

static void of_any_size(struct plan *p)
{
    p->m = whole_of_bits(53);
    do {
        p->e = one_of(2000) - 1074;
        p->f = one_of(2044) - 1074;
    } while (p->e - p->f > 1000 || p->e - p->f < -1074);
}

TEST(ties_of_any_exponent_go_to_even)
{
    for_all_places(of_any_size, 100);
}

static void below_normal(struct plan *p)
{
    const int bits = one_of(53);
    p->m = bits == 0 ? 0 : whole_of_bits(bits);
    p->f = -1075;
    p->e = one_of(1000) - 1074;
}

TEST(subnormal_ties_go_to_even)
{
    for_all_places(below_normal, 200);
}

/* Midpoints of the largest double and 2^1024, which counts as even. */
static void at_the_end(struct plan *p)
{
    p->m = one_of(2) ? 0x1p53 - 1 : 0x1p53 - 2 - one_of(2);
    p->f = 970 + (one_of(8) == 0);
    p->e = one_of(1020) - 100;
}

TEST(ties_at_the_largest_double_go_to_infinity)
{
    for_all_places(at_the_end, 100);
}
