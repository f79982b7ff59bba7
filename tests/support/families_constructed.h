/*
 * families_constructed.h - exact coincidences in whole numbers and their
 * neighbours, and numbers of any exponents
 *
 * Only families.c includes it.  A coincidence is a line that is exactly tangent,
 * through a rim or the apex, or along a ruling.  All kinds use one frame: points
 * c + x a + y b + z h with whole a, b, h, and the surface x^2 + y^2 = rho(z)^2.
 * With a Pythagorean triple p^2 + q^2 = r^2 and a = r a', b = r b' the point
 * c + rho (p a' + q b') + z h is on the surface.  The line's direction there is a
 * combination, by whole numbers, of the tangent -q a' + p b' and the ruling
 * h + rho' (p a' + q b').  Circular kinds have a', b', h along the coordinates.  A
 * cone by its angle has 45 degrees, whose tangent is 1, and |h| = r, so its rulings
 * are p a' + q b' + h.
 */
#ifndef CYLINT_FAMILIES_CONSTRUCTED_H
#define CYLINT_FAMILIES_CONSTRUCTED_H

typedef struct {
    double c[3], a[3], b[3], h[3]; /* of a and b: a' and b' */
    double p, q, r;                /* the triple */
    double rho0, slope;            /* rho = rho0 + slope z */
} exact_frame;

static void along_coordinate(double v[3], int i, double size)
{
    set3(v, 0, 0, 0);
    v[i] = size;
}

static double triple_product(const exact_frame *f)
{
    double across[3];
    cross3(across, f->b, f->h);
    return dot3(f->a, across);
}

static void any_exact_frame(exact_frame *f, family_shape word)
{
    static const int triples[][3] = {{3, 4, 5},    {4, 3, 5},   {5, 12, 13},
                                     {15, 8, 17},  {7, 24, 25}, {21, 20, 29},
                                     {12, 35, 37}, {1, 0, 1},   {0, 1, 1},
                                     {-3, 4, 5},   {5, -12, 13}};
    const int *t = triples[one_of((int)(sizeof triples / sizeof *triples))];
    const int i = one_of(3);
    f->p = t[0];
    f->q = t[1];
    f->r = t[2];
    f->rho0 = 1;
    f->slope = 0;
    whole_point(f->c, 3);
    do {
        whole_point(f->a, 3);
        whole_point(f->b, 3);
        whole_point(f->h, 3);
    } while (triple_product(f) == 0);
    if (word <= FAMILY_ACONE) {
        along_coordinate(f->a, (i + 1) % 3, 1);
        along_coordinate(f->b, (i + 2) % 3, 1);
        along_coordinate(f->h, i,
                         word == FAMILY_ACONE ? f->r : whole_between(1, 3));
    }
    if (word == FAMILY_ACONE) {
        f->rho0 = 0;
        f->slope = 1;
    } else if (word == FAMILY_CONE) {
        f->rho0 = whole_between(0, 3);
        f->slope = f->rho0 == 0 ? whole_between(1, 3)
                                : whole_between(-(int)f->rho0, 3);
    } else if (word == FAMILY_ECONE) {
        f->slope = 0.5 * whole_between(-2, 3);
    }
}

static void write_exact_shape(struct family_case *c, family_shape word,
                              const exact_frame *f)
{
    double a[3], b[3], to[3];
    copy3(a, f->a);
    copy3(b, f->b);
    scale3(a, f->r);
    scale3(b, f->r);
    end_of(word, f->c, f->h, to);
    family_set_shape(c, word, f->c, a, b, to, f->rho0 * f->r,
                     word == FAMILY_ACONE   ? 45
                     : word == FAMILY_ECONE ? 1 + f->slope
                                            : (f->rho0 + f->slope) * f->r);
}

typedef enum { TANGENT, RIM, RULING, APEX, COINCIDENCES } coincidence;

/* A line through a point of the surface, of its plane z, or the apex.  Quarters
 * of the tangent vectors keep all numbers exact. */
static void write_exact_line(struct family_case *c, const exact_frame *f,
                             coincidence what)
{
    double z = what == RIM || one_of(3) == 0 ? whole_between(0, 1)
                                             : whole_between(-1, 5) / 4.;
    if (what == APEX && f->slope != 0)
        z = -f->rho0 / f->slope; /* if not exact, near the apex */
    const double rho = f->rho0 + f->slope * z;
    const double around = what == RULING ? 0 : whole_between(1, 3);
    const double up =
        what == RULING ? whole_between(1, 3) : whole_between(-3, 3);
    const double back = whole_between(-3, 3);
    double *o = c->line_data, *d = c->line_data + 3;
    for (int i = 0; i < 3; i++) {
        const double radial = f->p * f->a[i] + f->q * f->b[i];
        d[i] = around * (f->p * f->b[i] - f->q * f->a[i]) +
               up * (f->h[i] + f->slope * radial);
        if (what == RIM || what == APEX)
            d[i] += whole_between(-2, 2);
        o[i] = f->c[i] + rho * radial + z * f->h[i] - back * d[i];
    }
    c->line_word = (family_line)one_of(4);
    if (c->line_word == FAMILY_SEGMENT)
        add3(d, 1, o);
    o[6] = back; /* a span that begins or ends at the point */
    o[7] = back + whole_between(0, 2);
}

/* In half of the cases one number is moved by up to 4 ulp. */
static void construct(struct family_case *out, family_shape word,
                      coincidence what)
{
    exact_frame f;
    any_exact_frame(&f, word);
    write_exact_shape(out, word, &f);
    write_exact_line(out, &f, what);
    out->ends = (cylint_ends)(one_of(2) ? 0 : one_of(6));
    const int of_line = family_line_size(out->line_word);
    const int n = one_of(of_line + family_shape_size(word));
    double *moved =
        n < of_line ? &out->line_data[n] : &out->shape_data[n - of_line];
    if (chance(0.5))
        *moved = stepped(*moved, whole_between(-4, 4));
}

static void constructed(struct family_case *out)
{
    const coincidence what = (coincidence)one_of(COINCIDENCES);
    construct(out, any_word(), what);
}

static void exact_tangent(struct family_case *out)
{
    construct(out, any_word(), TANGENT);
}

/* ------------------------------------------------------ any exponents --- */

/* Subnormal, huge, any, or ordinary. */
static int any_exponent(void)
{
    const int where = one_of(4);
    return where == 0   ? whole_between(-1074, -1015)
           : where == 1 ? whole_between(940, 1020)
           : where == 2 ? whole_between(-1074, 1020)
                        : whole_between(-3, 3);
}

/* Usually near one of two sizes, so that line and shape are near each other;
 * otherwise any exponent. */
static double any_double(const int about[2])
{
    const int where = one_of(10);
    int e = whole_between(-1074, 1023);
    if (where < 9)
        e = about[where < 6 ? 0 : 1] + whole_between(-8, 8);
    e = e < -1074 ? -1074 : e > 1023 ? 1023 : e;
    const double x = ldexp(random_mantissa(&stream), e);
    return one_of(8) == 0 ? 0 : one_of(2) ? x : -x;
}

/* The same of few digits, or at an end of the doubles. */
static double any_short_double(const int about[2])
{
    static const double extreme[] = {1, 0x1.fffffffffffffp1023, 0x1p-1022,
                                     0x1p-1074, 0x1p-1023};
    const int where = one_of(20), e = whole_between(-1074, 1020);
    const double x = where < 5 ? extreme[where]
                     : where < 8
                         ? 0
                         : whole_between(1, 7) *
                               ldexp(0.5, where == 8 ? e : about[where % 2]);
    return one_of(2) ? x : -x;
}

/* Of any kind. */
static void draw_numbers(struct family_case *out, double draw(const int[2]))
{
    double *x = out->shape_data;
    const int often = any_exponent();
    const int about[2] = {often, any_exponent()};
    out->line_word = (family_line)one_of(4);
    out->shape_word = (family_shape)one_of(FAMILY_SHAPES);
    out->ends = (cylint_ends)(chance(0.5) ? 0 : one_of(6));
    for (int i = 0; i < 6; i++)
        out->line_data[i] = draw(about);
    out->line_data[6] = -HUGE_VAL;
    out->line_data[7] = HUGE_VAL;
    for (int i = 0; i < 13; i++) {
        x[i] = draw(about);
        if (family_is_size(out->shape_word, i))
            x[i] = fabs(x[i]);
    }
    if (out->shape_word == FAMILY_ACONE)
        x[6] = fmod(x[6], 90);
}

/* Every number has its own exponent. */
static void wild_numbers(struct family_case *out)
{
    draw_numbers(out, any_double);
}

static void few_digits(struct family_case *out)
{
    draw_numbers(out, any_short_double);
}

#endif
