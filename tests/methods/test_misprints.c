/*
 * test_misprints.c - the print fails, the method does not
 *
 * Each error or omission of the published methods is here as a small function,
 * as printed.  It fails on an input where the corrected method is right.  The
 * comments in src/methods/ explain the corrections.
 */
#include <math.h>
#include <string.h>

#include "check.h"
#include "cylint_methods.h"
#include "records.h"
#include "vectors.h"

static int is(double t, double expected)
{
    return fabs(t - expected) <= 1e-9 * fabs(expected);
}

/* The answer of the corrected method to a record of the command, of which the text
 * after => is known: relation, number of hits, and of each hit t (~: nearly) and
 * part. */
static cylint_answer corrected(cylint_method_fn *method, const char *record)
{
    const struct family_case c = case_of(record);
    const char *known = strstr(record, "=>") + 2;
    cylint_answer a = {0}, want;
    double x[2];
    CHECK(method(&c.shape, &c.line, CYLINT_WANT_ALL, &a) == CYLINT_OK);
    known = read_relation(known, &want);
    int same = CHECK(known) && a.relation == want.relation && a.n == want.n;
    for (int i = 0; same && i < a.n; i++) {
        known += strspn(known, " ");
        const int nearly = *known == '~';
        known = family_numbers(known + nearly, 2, x);
        same = CHECK(known) && a.hit[i].part == x[1] &&
               (nearly ? is(a.hit[i].t, x[0]) : a.hit[i].t == x[0]);
    }
    if (!CHECK(same))
        REPORT("%s: relation %d, %d hits, t %a %a", record, a.relation, a.n,
               a.hit[0].t, a.hit[1].t);
    return a;
}

static const double origin[3] = {0, 0, 0};
static const double along_x[3] = {1, 0, 0}, along_y[3] = {0, 1, 0};
static const double along_z[3] = {0, 0, 1};

/* A whole cylinder of radius 1 about the z axis, and one from z = 0 to 2. */
#define ROD "  cylinder 0 0 0 0 0 1 1 ends=infinite => "
#define SOLID "  cylinder 0 0 0 0 0 2 1 => "

/* ------------------------------------------------- Shene, Gems IV and V -- */

/* "two intersections if r < |d|, one if r = |d|, none otherwise" */
static int shene_count_as_printed(double r, double d)
{
    return r < fabs(d) ? 2 : r == fabs(d) ? 1 : 0;
}

TEST(shene_prints_two_hits_where_the_line_passes_outside)
{
    CHECK(shene_count_as_printed(1, 0.5) == 0);
    corrected(cylint_shene_cylinder,
              "line -3 0.5 0 1 0 0" ROD
              "cross 2  ~2.13397459621556 0 ~3.86602540378444 0");
    CHECK(shene_count_as_printed(1, 2) == 2);
    corrected(cylint_shene_cylinder, "line -3 2 0 1 0 0" ROD "miss 0");
}

/* "if the distance of B from l is r, l lies on it; else no intersection" */
static int shene_parallel_as_printed(double r, double distance)
{
    return distance == r ? CYLINT_RELATION_ALONG : CYLINT_RELATION_MISS;
}

TEST(shene_prints_that_a_parallel_line_inside_does_not_intersect)
{
    CHECK(shene_parallel_as_printed(1, 0.5) == CYLINT_RELATION_MISS);
    corrected(cylint_shene_cylinder, "line 0.5 0 0 0 0 1" ROD "cross 0");
}

/* The formula of t_P is cut off in print.  Read as (D x v).w, without the
 * division by |u x v| squared, it is right for perpendicular lines only. */
TEST(shenes_foot_halves_the_chord_of_an_oblique_line)
{
    const double o[3] = {-3, 0.6, 0}, d[3] = {3, 0, 4};
    double u[3], uv[3], w[3], D[3], Dv[3];

    unit3(u, d);
    cross3(uv, u, along_z);
    unit3(w, uv);
    minus3(D, origin, o);
    cross3(Dv, D, along_z);
    CHECK(!is(dot3(Dv, w), 5));
    CHECK(is(dot3(Dv, uv) / dot3(uv, uv), 5)); /* the foot: x = 0 */
    corrected(cylint_shene_cylinder,           /* 1 - 0.8 / 3 and 1 + 0.8 / 3 */
              "line -3 0.6 0 3 0 4" ROD
              "cross 2  ~0.73333333333333 0 ~1.26666666666667 0");
}

/* The general case alone: both rulings by the vector quotient, with the apex at
 * the origin and the axis z.  Returns 0 where the plane meets the cone in the
 * apex only. */
static int shene_cone_without_exceptions(double cosine, const double D[3],
                                         const double d[3], double t[2])
{
    double n[3], m[3], k[3];

    cross3(n, d, D);
    unit3(n, n);
    along3(m, along_z, -n[2], n);
    const double cos_theta = length3(m);
    unit3(m, m);
    cross3(k, n, m);
    const double cos_b = cosine / cos_theta;
    if (cos_b > 1)
        return 0;
    const double sin_b = sqrt(1 - cos_b * cos_b);
    for (int i = 0; i < 2; i++) {
        double delta[3], across[3], reach[3], to_V[3];
        for (int j = 0; j < 3; j++)
            delta[j] = cos_b * m[j] + (i ? sin_b : -sin_b) * k[j];
        minus3(to_V, origin, D);
        cross3(across, d, delta);
        cross3(reach, to_V, delta);
        t[i] = dot3(reach, across) / dot3(across, across);
    }
    return 1;
}

/* Half angle arctan 4/3: cosine and sine are 0.6 and 0.8. */
#define SHENES_CONE "  cone 0 0 0 0 0 0 3 4 ends=infinite => "

TEST(shenes_general_cone_case_is_right_where_it_applies)
{
    const double o[3] = {-8, 1, 3}, d[3] = {2, -0.25, -0.1};
    static const char record[] =
        "line -8 1 3  2 -0.25 -0.1  cone 0 0 0 0 0 0 3 4 ends=infinite => "
        "cross 2  ~2.15821412164745 0 ~5.61323014729012 0";
    double u[3], t[2];

    unit3(u, d);
    CHECK(shene_cone_without_exceptions(0.6, o, u, t));
    corrected(cylint_shene_cone, record);
    const cylint_answer q = corrected(cylint_quadratic, record);
    const double size = length3(d);
    for (int i = 0; i < 2; i++)
        CHECK(is(q.hit[i].t, t[0] / size) || is(q.hit[i].t, t[1] / size));
}

TEST(a_line_through_the_apex_has_no_plane)
{
    const double outside[3] = {-3, 0, 0}, inside[3] = {0, 0, -3};
    const double on[3] = {1, 0, 1};
    double t[2], u[3];

    CHECK(!shene_cone_without_exceptions(0.6, outside, along_x, t) ||
          isnan(t[0]));
    corrected(cylint_shene_cone,
              "line -3 0 0 1 0 0" SHENES_CONE "touch 1  3 0");
    CHECK(!shene_cone_without_exceptions(0.6, inside, along_z, t) ||
          isnan(t[0]));
    CHECK(corrected(cylint_shene_cone,
                    "line 0 0 -3 0 0 1" SHENES_CONE "cross 1  3 0")
              .hit[0]
              .side == CYLINT_SIDE_BOTH);
    /* on a ruling of 45 degrees: |d.v| is cos a */
    unit3(u, on);
    CHECK(!shene_cone_without_exceptions(u[2], on, u, t) || isnan(t[0]));
    corrected(
        cylint_shene_cone,
        "line 1 0 1 1 0 1  cone 0 0 0 0 0 0 1 1 ends=infinite => along 0");
}

TEST(a_plane_perpendicular_to_the_axis_cuts_the_apex_only)
{
    const double o[3] = {1, -3, 0};
    double n[3], m[3];

    cross3(n, along_y, o);
    unit3(n, n);
    along3(m, along_z, -n[2], n);
    unit3(m, m);
    CHECK(isnan(m[0]) && isnan(m[2])); /* the frame of delta has no m */
    corrected(cylint_shene_cone, "line 1 -3 0 0 1 0" SHENES_CONE "miss 0");
    corrected(cylint_shene_cone,
              "line 0 -3 0 0 1 0" SHENES_CONE "touch 1  3 0");
}

TEST(a_line_parallel_to_a_ruling_meets_the_other_one_only)
{
    const double o[3] = {0, 0, -3}, d[3] = {4, 0, 3};
    double u[3], t[2];

    unit3(u, d);
    CHECK(shene_cone_without_exceptions(0.6, o, u, t));
    CHECK(isnan(t[0]) != isnan(t[1]));
    cylint_answer a = corrected(
        cylint_shene_cone, "line 0 0 -3 4 0 3" SHENES_CONE "cross 1  ~0.5 0");
    CHECK(a.hit[0].side == CYLINT_SIDE_LEAVING); /* the lower nappe, upwards */
    a = corrected(cylint_shene_cone,
                  "line 0 0 3 4 0 3" SHENES_CONE "cross 1  ~-0.5 0");
    CHECK(a.hit[0].side == CYLINT_SIDE_ENTERING);
}

/* Lines parallel to the axis of a cylinder: inside, on the surface, outside. */
enum { PARALLELS = 3 };
static const struct {
    double o[3];
    const char *record;
} parallels[PARALLELS] = {{{0.5, 0, -2}, "line 0.5 0 -2 0 0 1" ROD "cross 0"},
                          {{1, 0, -2}, "line 1 0 -2 0 0 1" ROD "along 0"},
                          {{7, 0, -2}, "line 7 0 -2 0 0 1" ROD "miss 0"}};

/* ------------------------------------------------------------ Gullotti -- */

/* "the discriminant is 0 and v' is parallel to h: the line lies on it" */
static int gullotti_parallel_as_printed(const double p[3], const double v[3])
{
    const double a = dot3(v, v) - v[2] * v[2];
    const double b = 2 * (dot3(v, p) - v[2] * p[2]);
    const double c = dot3(p, p) - p[2] * p[2] - 1;

    if (b * b - 4 * a * c == 0 && v[0] == 0 && v[1] == 0)
        return CYLINT_RELATION_ALONG;
    return CYLINT_RELATION_MISS;
}

TEST(gullotti_puts_every_parallel_line_on_the_surface)
{
    for (int i = 0; i < PARALLELS; i++) {
        CHECK(gullotti_parallel_as_printed(parallels[i].o, along_z) ==
              CYLINT_RELATION_ALONG);
        corrected(cylint_gullotti, parallels[i].record);
    }
}

TEST(gullottis_parallel_lines_never_reach_the_caps)
{
    const double a = 0, b = 0, disc = 0; /* of every parallel line */

    CHECK(isnan((-b - sqrt(disc)) / (2 * a)));
    corrected(cylint_gullotti, "line 0.5 0 -2 0 0 1" SOLID "cross 2  2 1 4 2");
}

/* "accept the hit if 0 <= P.h <= 1" with P in world space, h = (0, 0, 1) */
static int gullotti_accepts_as_printed(const double world[3])
{
    return world[2] >= 0 && world[2] <= 1;
}

TEST(gullottis_axial_test_in_world_space_loses_hits)
{
    const double hit[3] = {-1, 0, 12}, no_hit[3] = {-1, 0, 0.5};

    CHECK(!gullotti_accepts_as_printed(hit));
    corrected(cylint_gullotti, "line -3 0 12 1 0 0  cylinder 0 0 10 0 0 15 1 "
                               "ends=open => cross 2  2 0 4 0");
    CHECK(gullotti_accepts_as_printed(no_hit));
    corrected(
        cylint_gullotti,
        "line -3 0 0.5 1 0 0  cylinder 0 0 10 0 0 15 1 ends=open => miss 0");
}

TEST(gullottis_leading_coefficient_cancels)
{
    const double v[3] = {1, 0, 0x1p29}; /* d in local coordinates */

    CHECK(dot3(v, v) - v[2] * v[2] == 0);
    CHECK(v[0] * v[0] + v[1] * v[1] == 1);
    corrected(cylint_gullotti,
              "line -3 0 0 1 0 0.5  cylinder 0 0 0 0 0 0x1p-30 1 "
              "ends=infinite => cross 2  2 0 4 0");
}

/* The x coordinate under M = T R S.  The columns of R are the directions of a,
 * b and c; R is inverted by its transpose, as a rotation is. */
static double gullotti_local_x_as_printed(const double D[3], const double a[3])
{
    return dot3(D, a) / dot3(a, a);
}

TEST(gullottis_rotation_is_none_for_an_oblique_cylinder)
{
    const double o[3] = {0.5, -3, 0.5};

    /* at z = 0.5 the section's centre is at x = 0.5: the line meets it */
    CHECK(gullotti_local_x_as_printed(o, along_x) == 0.5);
    corrected(cylint_gullotti,
              "line 0.5 -3 0.5 0 1 0  ecylinder 0 0 0 1 0 0 0 1 0 1 0 1 "
              "ends=infinite => cross 2  2 0 4 0");
}

/* ------------------------------------------------------ closest points -- */

static double delta_as_printed(const double d[3], const double e[3], double r,
                               double f)
{
    const double below = dot3(d, d) * dot3(e, e) - dot3(d, e) * dot3(d, e);
    return sqrt(dot3(e, e) * (r * r - f * f) / below);
}

TEST(closest_points_lose_a_nearly_parallel_line)
{
    const double d[3] = {1e-9, 0, 1};

    CHECK(!(delta_as_printed(d, along_z, 1, 0) < HUGE_VAL));
    corrected(cylint_closest_points,
              "line 0 0 0 1e-9 0 1" ROD "cross 2  ~-1e9 0 ~1e9 0");
}

TEST(closest_points_have_no_answer_for_a_parallel_line)
{
    for (int i = 0; i < PARALLELS; i++) {
        const double away = parallels[i].o[0];
        CHECK(!(delta_as_printed(along_z, along_z, 1, away) < HUGE_VAL));
        corrected(cylint_closest_points, parallels[i].record);
    }
}

TEST(closest_points_leave_out_the_ends)
{
    CHECK(delta_as_printed(along_x, along_z, 1, 0) == 1); /* a hit */
    corrected(cylint_closest_points, "line -3 0 5 1 0 0" SOLID "miss 0");
    corrected(cylint_closest_points,
              "line -3 0 -1 1 0 1" SOLID "cross 2  ~2 0 ~3 2");
}

/* The print leaves out t_c, where the connecting line is perpendicular to both
 * lines. */
TEST(the_closest_point_halves_the_chord)
{
    const double p0[3] = {1, 2, 3}, p1[3] = {2, 4, 7}, o[3] = {-5, 1, 6};
    const double d[3] = {3, 1, -0.5};
    double M[3], n[3], e[3], De[3], D[3];

    const cylint_answer a = corrected(
        cylint_closest_points,
        "line -5 1 6 3 1 -0.5  cylinder 1 2 3 2 4 7 4 ends=infinite => "
        "cross 2  ~0.87030533471806 0 ~3.42060375619103 0");
    const double t_c = (a.hit[0].t + a.hit[1].t) / 2;
    along3(M, o, t_c, d);
    minus3(e, p1, p0);
    minus3(D, M, p0);
    cross3(n, d, e);
    cross3(De, D, e);
    CHECK(fabs(dot3(De, n)) <= 1e-9 * dot3(n, n));
}

/* ------------------------------------------------ Cychosz, Waggenspack -- */

/* clipobj with one plane whose normal points outward.  dc and dw are the
 * products of the normal with direction and origin.  Returns 0 if rejected. */
static int clipobj_as_printed(double dc, double dw, double *in, double *out)
{
    if (dc == 0)
        return dw < 0 && *in < *out;
    const double t = -dw / dc;
    if (dc > 0) { /* far plane */
        if (t > *in && t < *out)
            *out = t;
        if (t < *in)
            return 0;
    } else { /* near plane */
        if (t > *in && t < *out)
            *in = t;
        if (t > *out)
            return 0;
    }
    return *in < *out;
}

TEST(clipobj_keeps_a_chord_that_begins_on_the_far_plane)
{
    double in = 1, out = 5 / 3.0; /* the lateral roots */

    CHECK(clipobj_as_printed(4, -4, &in, &out) && out > 1);
    corrected(cylint_cychosz_waggenspack,
              "line -4 0 0 3 0 4  cylinder 0 0 0 0 0 4 1 => touch 1  ~1 0");
}

TEST(clipobj_rejects_tangents_and_lines_in_a_caps_plane)
{
    double in = 3, out = 3;

    CHECK(!clipobj_as_printed(0, -1, &in, &out)); /* tangent: in = out */
    corrected(cylint_cychosz_waggenspack,
              "line 1 -3 1 0 1 0" SOLID "touch 1  3 0");
    in = 2;
    out = 4;
    CHECK(!clipobj_as_printed(0, 0, &in, &out)); /* dw = 0: in the plane */
    corrected(cylint_cychosz_waggenspack,
              "line -3 0 2 1 0 0" SOLID "along 2  2 0 4 0");
}

TEST(intcyls_infinity_is_neither_far_enough_nor_a_hit)
{
    double in = -1.0e21, out = 1.0e21; /* HUGE, of a parallel ray inside */

    CHECK(!clipobj_as_printed(-1, 1e22, &in, &out)); /* the base's plane */
    corrected(cylint_cychosz_waggenspack,
              "line 0.5 0 -1e22 0 0 1  cylinder 0 0 0 0 0 1e22 1 => cross 2  "
              "~1e22 1 ~2e22 2");
    corrected(cylint_cychosz_waggenspack, "line 0.5 0 0 0 0 1" ROD "cross 0");
}
