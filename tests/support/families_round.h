/*
 * families_round.h - random cases of spheres, capsules and round cones
 *
 * Only families.c includes it.  A boundary point of the convex hull of two
 * balls is p0 + z w + (r0 + z dr) n, where the unit vector n makes the angle
 * with w at which a plane touches both balls, w.n = r0 - r1; or it is a point
 * of a ball.
 */
#ifndef CYLINT_FAMILIES_ROUND_H
#define CYLINT_FAMILIES_ROUND_H

typedef struct hull {
    double p[2][3], r[2];
} hull;

static cylint_ends round_ends(family_shape word)
{
    return word == FAMILY_SPHERE || chance(0.5) ? CYLINT_ENDS_CAPPED
                                                : (cylint_ends)one_of(4);
}

static void write_hull(struct family_case *out, const hull *h)
{
    const int end = chance(0.5);
    family_shape word = h->r[0] == h->r[1] ? FAMILY_CAPSULE : FAMILY_RCONE;
    if (h->p[0][0] == h->p[1][0] && h->p[0][1] == h->p[1][1] &&
        h->p[0][2] == h->p[1][2] && h->r[0] == h->r[1] && chance(0.9))
        word = FAMILY_SPHERE;
    family_set_shape(out, word, h->p[end], NULL, NULL, h->p[1 - end], h->r[end],
                     h->r[1 - end]);
    out->ends = round_ends(word);
}

/* Radius and length as given, one of: sphere, capsule, round cone, ball and
 * point. */
static void make_hull(hull *h, double r, double length)
{
    double w[3];
    const int form = one_of(6);
    random_vector(h->p[0], 1);
    random_direction(w);
    h->r[0] = h->r[1] = r;
    if (form >= 2)
        h->r[1] = r * between(0.02, 1);
    if (form == 5)
        h->r[1] = 0;
    for (int i = 0; i < 3; i++)
        h->p[1][i] = h->p[0][i] + (form == 0 ? 0 : length * w[i]);
    if (form >= 2 && form < 5) { /* as steep as any, but one ball sticks out */
        const double most = length / r;
        if (1 - h->r[1] / r > most)
            h->r[1] = r * (1 - most * between(0, 1.05));
        if (h->r[1] < 0)
            h->r[1] = 0;
    }
}

static void simple_hull(hull *h)
{
    const double length = between(0.2, 3);
    make_hull(h, between(0.2, 2), length);
}

/* The boundary point of the ruling that a plane touches, at z, and the normal
 * n there; ruling: the direction of the ruling.  A ball alone: any point. */
static void ruling_point(const hull *h, double z, double p[3], double n[3],
                         double ruling[3])
{
    double w[3], e[3];
    minus3(w, h->p[1], h->p[0]);
    const double ww = dot3(w, w);
    const double dr = h->r[1] - h->r[0];
    if (!(ww > dr * dr)) {
        random_direction(n);
        across(n, ruling);
        z = dr > 0;
    } else {
        const double sine = -dr / ww, cosine = sqrt(1 - dr * dr / ww);
        across(w, e);
        copy3(n, w);
        scale3(n, sine);
        add3(n, cosine, e);
        along3(ruling, w, dr, n);
    }
    along3(p, h->p[0], z, w);
    add3(p, h->r[0] + z * dr, n);
}

/* A boundary point of any part with its normal. */
static void boundary_point(const hull *h, double p[3], double n[3])
{
    double ruling[3];
    if (chance(0.5)) {
        ruling_point(h, between(0, 1), p, n, ruling);
        return;
    }
    double reach[2];
    random_direction(n);
    for (int k = 0; k < 2; k++)
        reach[k] = dot3(h->p[k], n) + h->r[k];
    const int end = reach[1] > reach[0];
    along3(p, h->p[end], h->r[end], n);
}

static double size_of_hull(const hull *h)
{
    double w[3];
    minus3(w, h->p[1], h->p[0]);
    return length3(w) + fmax(h->r[0], h->r[1]);
}

/* A line through two points in a box about the hull. */
static void aim_at_hull(struct family_case *out, const hull *h, double size)
{
    double p[3], d[3];
    const double s = size_of_hull(h), z = between(0, 1);
    const double r = h->r[0] + z * (h->r[1] - h->r[0]);
    for (int i = 0; i < 3; i++) {
        p[i] = h->p[0][i] + s * between(-size, size);
        d[i] = h->p[0][i] + z * (h->p[1][i] - h->p[0][i]) +
               r * between(-1.1, 1.1) - p[i];
    }
    scale3(d, power(-0.5, 0.5));
    write_line(out, p, d);
}

static void round_ordinary(struct family_case *out)
{
    hull h;
    simple_hull(&h);
    write_hull(out, &h);
    aim_at_hull(out, &h, 3);
}

/* Through a circle where ball and cone touch, or tangent there, or along the
 * ruling; moved by a little. */
static void round_near_a_circle(struct family_case *out)
{
    hull h;
    double p[3], n[3], d[3], aside[3];
    simple_hull(&h);
    write_hull(out, &h);
    ruling_point(&h, one_of(2), p, n, d);
    const int way = one_of(3);
    if (way == 0)
        random_direction(d);
    if (way == 1)
        across(n, d);
    random_direction(aside);
    const double off = small(-16, -4), by = small(-16, -4);
    for (int i = 0; i < 3; i++) {
        p[i] += off * n[i] + small(-16, -4);
        d[i] += by * aside[i];
    }
    write_line_from(out, p, d, between(-3, 3));
}

/* Perpendicular to the axis, nearly, at the height of a circle, nearly. */
static void round_across(struct family_case *out)
{
    hull h;
    double p[3], n[3], d[3], w[3];
    simple_hull(&h);
    if (chance(0.5)) { /* exactly */
        const int i = one_of(3);
        for (int k = 0; k < 3; k++)
            h.p[1][k] = h.p[0][k] + (k == i ? between(1, 3) : 0);
        write_hull(out, &h);
        boundary_point(&h, p, n);
        random_direction(d);
        d[i] = 0;
    } else {
        write_hull(out, &h);
        ruling_point(&h, one_of(2), p, n, d);
        for (int k = 0; k < 3; k++)
            w[k] = h.p[1][k] - h.p[0][k] + small(-16, -4);
        random_direction(n);
        cross3(d, w, n);
    }
    for (int k = 0; k < 3; k++)
        p[k] += between(-1, 1) * d[k];
    write_line_from(out, p, d, between(-3, 3));
}

/* One ball in the other, nearly: |p1 - p0| is |r1 - r0| but for little. */
static void round_inside(struct family_case *out)
{
    static const double pythagorean[][3] = {
        {3, 4, 0}, {0, 5, 12}, {1, 2, 2}, {2, 3, 6}, {1, 4, 8}};
    static const double length[] = {5, 13, 3, 7, 9};
    const int k = one_of(5), n = one_of(3);
    hull h;
    double d[3];
    whole_point(h.p[0], 3);
    for (int i = 0; i < 3; i++)
        h.p[1][i] = h.p[0][i] + pythagorean[k][(i + n) % 3];
    h.r[1] = chance(0.3) ? 0 : whole_between(1, 4);
    h.r[0] = h.r[1] + length[k];
    if (chance(0.6))
        h.r[0] = stepped(h.r[0], whole_between(-4, 4));
    if (chance(0.2))
        h.r[0] += small(-12, 0);
    if (h.r[0] < 0)
        h.r[0] = 1;
    write_hull(out, &h);
    if (chance(0.5)) { /* through the point of contact, or tangent there */
        minus3(d, h.p[1], h.p[0]);
        const double ww = length[k] * length[k];
        double p[3], e[3];
        along3(p, h.p[0], (ww + h.r[1] * length[k]) / ww, d);
        if (chance(0.5))
            across(d, e);
        else
            random_direction(e);
        write_line_from(out, p, e, between(-3, 3));
        return;
    }
    aim_at_hull(out, &h, 2);
}

/* Small whole numbers: exact tangents, rulings, circles and apexes. */
static void round_whole(struct family_case *out)
{
    hull h;
    double p[3], d[3];
    whole_point(h.p[0], 3);
    copy3(h.p[1], h.p[0]);
    if (chance(0.9)) {
        double w[3] = {0, 0, 0};
        if (chance(0.6))
            set_any(w, whole_between(1, 5));
        else
            whole_vector(w, 3);
        add3(h.p[1], 1, w);
    }
    h.r[0] = whole_between(0, 5);
    h.r[1] = chance(0.4) ? h.r[0] : whole_between(0, 5);
    if (h.r[0] == 0 && h.r[1] == 0)
        h.r[0] = 1;
    write_hull(out, &h);
    whole_vector(d, 3);
    if (chance(0.4)) {
        set3(d, 0, 0, 0);
        set_any(d, chance(0.5) ? 1 : -1);
    }
    whole_point(p, 6);
    write_line(out, p, d);
}

/* Moves one component by up to 4 units in its last place. */
static void step_one(double v[3])
{
    const int i = one_of(3);
    v[i] = stepped(v[i], whole_between(-4, 4));
}

/* Axis along a coordinate with w = 25 k, r0 - r1 = 15 k or 7 k: the rulings in
 * the coordinate planes have whole numbers. */
static void round_ruling(struct family_case *out)
{
    const int steep = chance(0.5), i = one_of(3), j = (i + 1 + one_of(2)) % 3;
    const double delta = steep ? 15 : 7, cosine = steep ? 20 : 24;
    const double r1 = 25 * whole_between(0, 3), side = chance(0.5) ? 1 : -1;
    const double way = chance(0.5) ? 1 : -1;
    hull h;
    double p[3], d[3] = {0, 0, 0}, n[3] = {0, 0, 0};
    whole_point(h.p[0], 9);
    copy3(h.p[1], h.p[0]);
    const double size = 25;
    h.p[1][i] += way * 25 * size;
    h.r[1] = r1;
    h.r[0] = r1 + delta * size;
    n[i] = way * delta / 25;
    n[j] = side * cosine / 25;
    /* p_k + r_k n is whole, and so is the direction */
    for (int k = 0; k < 3; k++) {
        p[k] = h.p[0][k] + h.r[0] / 25 * (25 * n[k]);
        d[k] = 0;
    }
    d[i] = way * cosine;
    d[j] = -side * delta;
    if (chance(0.3)) /* across the ruling */
        d[3 - i - j] = whole_between(-40, 40);
    if (chance(0.3))
        step_one(d);
    if (chance(0.3))
        step_one(p);
    write_hull(out, &h);
    write_line_from(out, p, d, whole_between(-4, 4));
}

static void round_needle(struct family_case *out)
{
    hull h;
    const double r = chance(0.5) ? 1 : chance(0.5) ? 1e12 : 1e-12;
    make_hull(&h, r, chance(0.5) ? 1 : chance(0.5) ? 1e12 : 1e-12);
    write_hull(out, &h);
    aim_at_hull(out, &h, 1.5);
}

/* Through the point at which a cone ends, nearly. */
static void round_apex(struct family_case *out)
{
    hull h;
    double p[3], n[3], d[3];
    simple_hull(&h);
    h.r[1] = 0;
    ruling_point(&h, 1, p, n, d);
    write_hull(out, &h);
    if (chance(0.6))
        random_direction(d);
    for (int i = 0; i < 3; i++) {
        p[i] = h.p[1][i] + (chance(0.5) ? small(-16, -4) : 0);
        d[i] += small(-16, -4);
    }
    if (chance(0.5))
        write_line(out, p, d);
    else
        write_line_from(out, p, d, between(-3, 3));
}

#endif
