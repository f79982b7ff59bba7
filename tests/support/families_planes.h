/*
 * families_planes.h - random cases of half-spaces
 *
 * Only families.c includes it.  A line passes through a point of the plane, or near
 * it.  In whole numbers the origin, the ends of the domain and the whole line can
 * lie in the plane exactly.
 */
#ifndef CYLINT_FAMILIES_PLANES_H
#define CYLINT_FAMILIES_PLANES_H

static void write_plane(struct family_case *out, const double p[3],
                        const double n[3])
{
    family_set_shape(out, FAMILY_HALFSPACE, p, NULL, NULL, n, 0, 0);
}

/* A half-space, the unit vector n along its normal, and another point p of its
 * plane. */
static void simple_plane(struct family_case *out, double p[3], double n[3])
{
    double along[3], normal[3];
    random_vector(p, 1);
    random_direction(n);
    copy3(normal, n);
    scale3(normal, power(-1, 1));
    write_plane(out, p, normal);
    across(n, along);
    add3(p, between(-3, 3), along);
}

static void plane_ordinary(struct family_case *out)
{
    double p[3], n[3], d[3];
    simple_plane(out, p, n);
    random_direction(d);
    scale3(d, power(-0.5, 0.5));
    write_line_from(out, p, d, chance(0.2) ? 0 : between(-3, 3));
}

/* Parallel to the plane: inside, in it or outside; or through a point of the plane,
 * where the origin can lie, or an end of the domain. */
static void plane_whole(struct family_case *out)
{
    double p[3], n[3], d[3], u[3], along[3];
    whole_point(p, 6);
    whole_vector(n, 3);
    if (chance(0.4)) {
        set3(n, 0, 0, 0);
        set_any(n, chance(0.5) ? 1 : -2);
    }
    write_plane(out, p, n);
    whole_vector(u, 3);
    cross3(along, u, n);
    add3(p, whole_between(-2, 2), along);
    whole_vector(d, 3);
    if (chance(0.3)) {
        copy3(d, along);
        add3(p, whole_between(-1, 1), n);
    }
    const double back = whole_between(-3, 3);
    write_line_from(out, p, d, back);
    if (out->line_word == FAMILY_SPAN) {
        out->line_data[6] = back + whole_between(-2, 0);
        out->line_data[7] = back + whole_between(0, 2);
    }
    const int i = one_of(12);
    double *x = i < 6 ? &out->line_data[i] : &out->shape_data[i - 6];
    if (chance(0.3) && *x != 0)
        *x = stepped(*x, whole_between(-4, 4));
}

#endif
