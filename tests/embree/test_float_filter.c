/*
 * test_float_filter.c - floor embree: the float filter agrees with the
 * library
 *
 * Every build of float_filter.c and packet_filter.c that this processor can
 * run, on lines of all families, rounded to floats: hits, parts, t and z within
 * their errors, and the floats of a description bit for bit.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#define CYLINT_ONE_LANE
#include "check.h"
#include "embree/packet_filter.h"
#include "bvh/float_bounds.h"
#include "bvh/swept_disc.h"
#include "embree/angle.h"
#include "families.h"
#include "shapes/layout.h"

#ifndef HAVE_GSL

int main(void)
{
    return check_skip("no GSL: no families to draw from (make deps)");
}

#else

enum { CASES = 10000 };

/* The numbers of hits, of certain hits, and of certain descriptions. */
struct tally {
    long hits, certain, described;
};

/* A case's line in floats, and its shape, made circular and bounded. */
struct scene_query {
    cylint_float_filter_ray line;
    const cylint_shape *shape;
    cylint_answer answer;
    int n;
};

static int circular(struct family_case *c, uint64_t index)
{
    static const cylint_ends bounded[4] = {CYLINT_ENDS_CAPPED, CYLINT_ENDS_OPEN,
                                           CYLINT_ENDS_CAP0, CYLINT_ENDS_CAP1};
    c->ends = bounded[index % 4];
    return family_make(c);
}

/* near: unknown, a float before the hit, or a float behind it. */
static float near_shape(const struct scene_query *q, uint64_t index)
{
    const double t = q->n ? q->answer.hit[0].t : 0;
    if (index % 3 == 0)
        return HUGE_VALF;
    return (float)(t * (index % 3 == 1 ? 0.98 : 1.03));
}

static int make_query(struct scene_query *q, struct family_case *c,
                      uint64_t index)
{
    cylint_line line;
    if (!circular(c, index))
        return 0;
    for (int j = 0; j < 3; j++) {
        q->line.o[j] = (float)c->line.o[j];
        q->line.d[j] = (float)c->line.d[j];
    }
    q->line.tmin = index % 5 ? 0 : -HUGE_VAL;
    q->line.tmax = HUGE_VAL;
    if (cylint_span(&line, q->line.o, q->line.d, q->line.tmin, q->line.tmax) !=
        CYLINT_OK)
        return 0;
    q->shape = &c->shape;
    q->n = cylint_intersect(q->shape, &line, CYLINT_WANT_ALL, &q->answer);
    q->line.near = near_shape(q, index);
    return 1;
}

static int same_float(float x, double y)
{
    const float z = (float)y;
    return memcmp(&x, &z, sizeof x) == 0;
}

static int same_floats(const cylint_hit_floats *f, const cylint_hit *hit)
{
    int same = same_float(f->z, hit->z) &&
               same_float(f->phi, cylint_angle_as_float(hit->phi));
    for (int j = 0; j < 3; j++)
        same &= same_float(f->normal[j], hit->normal[j]);
    return same;
}

static int part_of(const cylint_float_filter_hit *at, const cylint_shape *shape)
{
    return at->round == 2 ? cylint_surface(shape)
           : !at->capped  ? CYLINT_PART_LATERAL
           : at->top      ? CYLINT_PART_CAP1
                          : CYLINT_PART_CAP0;
}

static int describes(const cylint_float_filter *build,
                     const cylint_float_filter_state *q,
                     const cylint_float_filter_hit *at,
                     const cylint_shape *shape, const cylint_hit *hit,
                     struct tally *tally)
{
    cylint_hit_floats floats;
    tally->certain++;
    if (part_of(at, shape) != (int)hit->part ||
        !(fabs(at->t - hit->t) <= at->t_error) ||
        !(fabs(at->z - hit->z) <= at->z_error))
        return 0;
    if (!build->describe(q, at, &floats))
        return 1;
    tally->described++;
    return same_floats(&floats, hit);
}

static int agrees(const cylint_float_filter *build, const struct scene_query *x,
                  struct tally *tally)
{
    cylint_float_filter_state q;
    cylint_float_filter_hit at;
    int n = 0;
    cylint_float_filter_shape shape;
    cylint_float_filter_shape_of(&shape, x->shape);
    const cylint_float_filter_target subject = {&shape, 0, x->shape,
                                                x->shape->ends};
    cylint_float_filter_result is =
        build->test_entry(&q, &subject, &x->line, &at);
    tally->hits += x->n;
    for (int i = 0; i < 2 && is != CYLINT_FLOAT_FILTER_UNCERTAIN; i++) {
        if (i == 1)
            is = build->test_exit(&q, &at);
        if (is != CYLINT_FLOAT_FILTER_HIT)
            continue;
        if (n == x->n ||
            !describes(build, &q, &at, x->shape, &x->answer.hit[n], tally))
            return 0;
        n++;
    }
    return is == CYLINT_FLOAT_FILTER_UNCERTAIN || n == x->n;
}

static void show(const cylint_float_filter_ray *line,
                 const struct family_case *c)
{
    REPORT("in floats, near %a, from %a:", line->near, line->tmin);
    REPORT_CASE(c);
}

static struct tally compare_family(const cylint_float_filter *build, int family,
                                   family_shape last)
{
    struct tally tally = {0, 0, 0};
    for (uint64_t i = 0; i < CASES; i++) {
        struct family_case c;
        struct scene_query x;
        family_case(1, family, i, &c);
        if (c.shape_word > last || !make_query(&x, &c, i))
            continue;
        if (!CHECK(agrees(build, &x, &tally))) {
            show(&x.line, &c);
        }
    }
    return tally;
}

static void query_families(const char *name, const cylint_float_filter *build)
{
    /* of cylinders and cones, of round kinds */
    const double least[2] = {0.6, 0.3};
    for (int round = 0; round < 2; round++) {
        struct tally sum = {0, 0, 0};
        for (int family = 0; family < family_count(); family++) {
            if (family_is_round(family) != round)
                continue;
            const struct tally t = compare_family(
                build, family, round ? FAMILY_RCONE : FAMILY_ACONE);
            sum.hits += t.hits;
            sum.certain += t.certain;
            sum.described += t.described;
        }
        printf("%s%s: %ld hits, certain of %ld, described %ld\n", name,
               round ? ", round" : "", sum.hits, sum.certain, sum.described);
        CHECK((double)sum.described > least[round] * (double)sum.hits);
    }
}

static void a_certain_result_is_the_librarys(void)
{
    query_families("plain", &cylint_float_filter_plain);
}

static void a_certain_result_with_fused_operations_is_the_librarys(void)
{
    if (cylint_float_filter_used() != &cylint_float_filter_plain)
        query_families("fused", cylint_float_filter_used());
}

/* -------------------------------------------------------- nearest hits -- */

/* The library's first hit on the piece, or NULL. */
static const cylint_hit *hit_on_piece(const struct scene_query *x, int index,
                                      int count)
{
    for (int i = 0; i < x->n; i++)
        if (cylint_piece_at(x->answer.hit[i].z, count) == index)
            return &x->answer.hit[i];
    return NULL;
}

/* Pieces and limits of case i: tfar infinite, or near the first hit. */
static cylint_float_filter_limits limits_of(const struct scene_query *x,
                                            uint64_t i)
{
    const int count = i % 3 ? 1 : 1 + (int)(i / 3 % 16);
    cylint_float_filter_limits limits = {HUGE_VALF, (int)(i / 48) % count,
                                         count, i % 7 != 0};
    if (i % 4 == 0 && x->n)
        limits.tfar = cylint_float_after(
            cylint_float_above(x->answer.hit[i / 4 % 2 ? x->n - 1 : 0].t),
            (int)(i / 8 % 5) - 2);
    return limits;
}

/* Whether a certain result is that of the library. */
static int is_nearest(const cylint_float_filter *build,
                      const struct scene_query *x, uint64_t i,
                      struct tally *tally)
{
    cylint_float_filter_nearest at;
    cylint_float_filter_shape shape;
    cylint_float_filter_shape_of(&shape, x->shape);
    const cylint_float_filter_target subject = {&shape, 0, x->shape,
                                                x->shape->ends};
    const cylint_float_filter_limits limits = limits_of(x, i);
    const cylint_hit *hit = hit_on_piece(x, limits.index, limits.count);
    const cylint_float_filter_result is =
        build->nearest(&subject, &x->line, &limits, &at);
    const float t = hit ? cylint_float_above(hit->t) : HUGE_VALF;
    tally->hits += t < limits.tfar;
    tally->certain += is == CYLINT_FLOAT_FILTER_HIT;
    if (is == CYLINT_FLOAT_FILTER_UNCERTAIN)
        return 1;
    if (is == CYLINT_FLOAT_FILTER_MISS)
        return !hit || t > limits.tfar;
    return hit && at.t == t && t < limits.tfar &&
           at.leaves == (hit->side == CYLINT_SIDE_LEAVING) &&
           (!limits.describes || same_floats(&at.floats, hit));
}

static struct tally nearest_of_family(const cylint_float_filter *build,
                                      int family, family_shape last)
{
    struct tally tally = {0, 0, 0};
    for (uint64_t i = 0; i < CASES; i++) {
        struct family_case c;
        struct scene_query x;
        family_case(1, family, i, &c);
        if (c.shape_word > last || !make_query(&x, &c, i))
            continue;
        if (!CHECK(is_nearest(build, &x, i, &tally)))
            show(&x.line, &c);
    }
    return tally;
}

static void compare_nearest(const char *name, const cylint_float_filter *build)
{
    struct tally sum = {0, 0, 0};
    for (int family = 0; family < family_count(); family++) {
        const struct tally t = nearest_of_family(build, family, FAMILY_RCONE);
        sum.hits += t.hits;
        sum.certain += t.certain;
    }
    printf("%s: %ld nearest hits, certain of %ld\n", name, sum.hits,
           sum.certain);
    CHECK((double)sum.certain > 0.1 * (double)sum.hits);
}

static void a_certain_nearest_hit_is_the_librarys(void)
{
    compare_nearest("plain", &cylint_float_filter_plain);
    if (cylint_float_filter_used() != &cylint_float_filter_plain)
        compare_nearest("fused", cylint_float_filter_used());
}

/* ------------------------------------------------------- many at a time -- */

/* Questions side by side. */
struct crowd {
    struct scene_query question[CYLINT_PACKET_FILTER_MOST];
    struct family_case from[CYLINT_PACKET_FILTER_MOST];
    cylint_float_filter_shape shape[CYLINT_PACKET_FILTER_MOST];
    cylint_float_filter_target subject[CYLINT_PACKET_FILTER_MOST];
    const cylint_float_filter_ray *line[CYLINT_PACKET_FILTER_MOST];
    int n;
};

/* Up to `most` cases of the family, from number *i on. */
static void gather(struct crowd *c, int family, uint64_t *i, int most)
{
    for (c->n = 0; c->n < most && *i < CASES; ++*i) {
        const int n = c->n;
        struct scene_query *x = &c->question[n];
        family_case(3, family, *i, &c->from[n]);
        if (c->from[n].shape_word > FAMILY_ACONE ||
            !make_query(x, &c->from[n], *i))
            continue;
        cylint_float_filter_shape_of(&c->shape[n], x->shape);
        c->subject[n] = (cylint_float_filter_target){&c->shape[n], 0, x->shape,
                                                     x->shape->ends};
        c->line[c->n++] = &x->line;
    }
}

static int is_reported(const cylint_packet_filter_results *a, int i,
                       const cylint_hit *hit)
{
    return fabs(a->t[i] - hit->t) <= a->t_error[i] &&
           fabs(a->z[i] - hit->z) <= a->z_error[i];
}

static int is_described(const cylint_packet_filter_results *a, int i,
                        const cylint_hit *hit)
{
    const cylint_hit_floats f = {(float)a->float_z[i],
                                 (float)a->phi[i],
                                 {(float)a->normal[0][i],
                                  (float)a->normal[1][i],
                                  (float)a->normal[2][i]}};
    return same_floats(&f, hit);
}

/* Whether the result of question i is right. */
static int is_right(const cylint_packet_filter_results *a, int i,
                    const struct scene_query *x)
{
    const unsigned hit = a->hit >> i & 1, uncertain = a->uncertain >> i & 1;
    if (hit &&
        (uncertain || x->n == 0 || !is_reported(a, i, &x->answer.hit[0])))
        return 0;
    if (a->described >> i & 1 &&
        !(hit && is_described(a, i, &x->answer.hit[0])))
        return 0;
    return hit || uncertain || x->n <= (int)(a->crosses >> i & 1);
}

static void query_batches(cylint_packet_filter *many, int family,
                          struct tally *tally)
{
    int most = 1; /* the number of questions, 1 to all in turn */
    for (uint64_t i = 0; i < CASES;
         most = most % CYLINT_PACKET_FILTER_MOST + 1) {
        struct crowd c;
        cylint_packet_filter_results a;
        gather(&c, family, &i, most);
        if (c.n == 0)
            break;
        many(c.subject, c.line, c.n, 1, &a);
        CHECK((a.hit | a.uncertain | a.crosses | a.described) >> c.n == 0);
        for (int k = 0; k < c.n; k++) {
            tally->hits += c.question[k].n > 0;
            tally->certain += a.hit >> k & 1;
            tally->described += a.described >> k & 1;
            if (!CHECK(is_right(&a, k, &c.question[k]))) {
                REPORT("%d of %d:", k, c.n);
                show(c.line[k], &c.from[k]);
            }
        }
    }
}

static void a_certain_result_of_the_packet_filter_is_the_librarys(void)
{
    const char *name;
    for (int i = 0; (name = cylint_kernels_name(i)); i++) {
        struct tally t = {0, 0, 0};
        CHECK(cylint_use_kernels(name));
        for (int family = 0; family < family_count(); family++)
            query_batches(cylint_packet_filter_used(), family, &t);
        printf("%s: %ld are hit, certain of %ld, described %ld\n", name, t.hits,
               t.certain, t.described);
        CHECK((double)t.described > 0.4 * (double)t.hits);
    }
    cylint_use_kernels(NULL);
}

/* Near the base z is small, and the error of the library's z is relative to
 * 1. */
static void a_small_z_is_no_more_certain_than_the_librarys(void)
{
    const double p0[3] = {-0x1.6020a5d5p+48, -0x1.c0feab9p+8, 0};
    const double p1[3] = {-0x1.7d09b8488p+46, -0x1.95b9e5dap+12,
                          -0x1.74b95eccp+49};
    const double o[3] = {0x1.0d3666p+53, -0x1.4a6948p-27, -0x1.86878cp-40};
    const double d[3] = {-0x1.0d3666p+53, 0x1.0321c4p-28, 0x1.86878cp-40};
    struct tally tally = {0, 0, 0};
    struct scene_query x;
    cylint_shape shape;
    cylint_line line;
    memset(&x, 0, sizeof x);
    memcpy(x.line.o, o, sizeof o);
    memcpy(x.line.d, d, sizeof d);
    x.line.tmax = HUGE_VAL;
    x.line.near = HUGE_VALF;
    x.shape = &shape;
    CHECK(cylint_cylinder(&shape, p0, p1, 0x1.bef9b1a9p+18, CYLINT_ENDS_OPEN) ==
          CYLINT_OK);
    CHECK(cylint_span(&line, o, d, 0, HUGE_VAL) == CYLINT_OK);
    x.n = cylint_intersect(&shape, &line, CYLINT_WANT_ALL, &x.answer);
    CHECK(x.n == 1 && x.answer.hit[0].z < 0x1p-30);
    CHECK(agrees(&cylint_float_filter_plain, &x, &tally));
    CHECK(agrees(cylint_float_filter_used(), &x, &tally));
}

/* The case's shape with all its numbers rounded to floats. */
static int in_floats(const struct family_case *c, cylint_shape *shape)
{
    double base[3], top[3];
    const int round = c->shape.kind >= CYLINT_KIND_SPHERE;
    if (c->shape.kind > CYLINT_KIND_CONE && !round)
        return 0;
    for (int j = 0; j < 3; j++) {
        base[j] = (float)cylint_base(&c->shape)[j];
        top[j] = (float)cylint_top(&c->shape)[j];
    }
    return (round ? cylint_round_cone
                  : cylint_cone)(shape, base, (float)cylint_r0(&c->shape), top,
                                 (float)cylint_r1(&c->shape),
                                 (cylint_ends)c->shape.ends) == CYLINT_OK;
}

/* Checks that both records give the same bits.  Returns how many do. */
static long small_as_large(const cylint_float_filter *build, int family)
{
    long same = 0;
    for (uint64_t i = 0; i < CASES / 10; i++) {
        struct family_case c;
        struct scene_query x;
        cylint_shape shape;
        cylint_float_filter_small small;
        cylint_float_filter_shape large;
        cylint_float_filter_state q[2];
        cylint_float_filter_hit at[2];
        family_case(2, family, i, &c);
        if (!make_query(&x, &c, i) || !in_floats(&c, &shape) ||
            !cylint_float_filter_small_of(&small, &shape))
            continue;
        memset(q, 0, sizeof q);
        memset(at, 0, sizeof at);
        cylint_float_filter_shape_of(&large, &shape);
        const cylint_float_filter_target subject[2] = {
            {&large, 0, &shape, shape.ends}, {&small, 1, &shape, shape.ends}};
        CHECK(build->test_entry(&q[0], &subject[0], &x.line, &at[0]) ==
              build->test_entry(&q[1], &subject[1], &x.line, &at[1]));
        same += CHECK(memcmp(&q[0], &q[1], sizeof q[0]) == 0 &&
                      memcmp(&at[0], &at[1], sizeof at[0]) == 0);
    }
    return same;
}

/* The same with the packet filter. */
static long many_small_as_large(cylint_packet_filter *many, int family)
{
    long same = 0;
    for (uint64_t i = 0; i < CASES / 10;) {
        struct crowd c;
        cylint_float_filter_target small[CYLINT_PACKET_FILTER_MOST];
        cylint_float_filter_small shape[CYLINT_PACKET_FILTER_MOST];
        cylint_packet_filter_results a[2];
        gather(&c, family, &i, CYLINT_PACKET_FILTER_MOST);
        for (int k = 0; k < c.n; k++) {
            cylint_shape *whole = &c.from[k].shape;
            if (!in_floats(&c.from[k], whole) ||
                !cylint_float_filter_small_of(&shape[k], whole))
                c.n = k;
            else {
                cylint_float_filter_shape_of(&c.shape[k], whole);
                small[k] = (cylint_float_filter_target){&shape[k], 1, whole,
                                                        whole->ends};
            }
        }
        if (c.n == 0)
            continue;
        memset(a, 0, sizeof a);
        many(c.subject, c.line, c.n, 1, &a[0]);
        many(small, c.line, c.n, 1, &a[1]);
        same += CHECK(memcmp(&a[0], &a[1], sizeof a[0]) == 0);
    }
    return same;
}

static void small_records_give_the_same_bits_as_large_ones(void)
{
    long same = 0;
    for (int family = 0; family < family_count(); family++)
        same += small_as_large(cylint_float_filter_used(), family) +
                small_as_large(&cylint_float_filter_plain, family);
    CHECK(same > CASES);
}

static void the_packet_filter_gives_the_same_bits_for_small_records(void)
{
    const char *name;
    for (int i = 0; (name = cylint_kernels_name(i)); i++) {
        long same = 0;
        CHECK(cylint_use_kernels(name));
        for (int family = 0; family < family_count(); family++)
            same += many_small_as_large(cylint_packet_filter_used(), family);
        CHECK(same > CASES / 100);
    }
    cylint_use_kernels(NULL);
}

static void ordinary_cylinders_are_certain(void)
{
    const int ordinary = 0;
    CHECK(strcmp(family_name(ordinary), "ordinary") == 0);
    const struct tally t =
        compare_family(cylint_float_filter_used(), ordinary, FAMILY_CYLINDER);
    if (!CHECK(t.hits > CASES / 4 &&
               (double)t.described >= 0.999 * (double)t.hits))
        REPORT("%ld of %ld hits", t.described, t.hits);
    const struct tally n = nearest_of_family(cylint_float_filter_used(),
                                             ordinary, FAMILY_CYLINDER);
    if (!CHECK((double)n.certain >= 0.99 * (double)n.hits))
        REPORT("%ld of %ld nearest hits", n.certain, n.hits);
}

/* The rest are balls that hold one another, and shapes of which the line passes
 * near the circle between ball and cone. */
static void ordinary_round_shapes_are_certain(void)
{
    int family = 0;
    while (strcmp(family_name(family), "round") != 0)
        family++;
    const struct tally t =
        compare_family(cylint_float_filter_used(), family, FAMILY_RCONE);
    CHECK(t.hits > CASES / 4);
    if (!CHECK((double)t.described >= 0.93 * (double)t.hits))
        REPORT("%ld of %ld hits", t.described, t.hits);
    const struct tally n =
        nearest_of_family(cylint_float_filter_used(), family, FAMILY_RCONE);
    if (!CHECK((double)n.certain >= 0.93 * (double)n.hits))
        REPORT("%ld of %ld nearest hits", n.certain, n.hits);
}

int main(void)
{
    RUN(a_certain_result_is_the_librarys);
    RUN(a_certain_result_with_fused_operations_is_the_librarys);
    RUN(ordinary_cylinders_are_certain);
    RUN(ordinary_round_shapes_are_certain);
    RUN(a_certain_nearest_hit_is_the_librarys);
    RUN(a_certain_result_of_the_packet_filter_is_the_librarys);
    RUN(a_small_z_is_no_more_certain_than_the_librarys);
    RUN(small_records_give_the_same_bits_as_large_ones);
    RUN(the_packet_filter_gives_the_same_bits_for_small_records);
    return check_end();
}

#endif
