/*
 * test_float_filter.c - the float filter agrees with the library
 *
 * Every build that this processor can run, on lines of all families, rounded to
 * floats: first hits on slices, hits where the line leaves, t and the floats of a
 * description bit for bit.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#define CYLINT_ONE_LANE
#include "check.h"
#include "embree/shapes.h"
#include "bvh/float_bounds.h"
#include "bvh/swept_disc.h"
#include "environment.h"
#include "families.h"
#include "records.h"
#include "shapes/layout.h"
#include "shapes/measure.h"

enum { CASES = 10000, MOST = 16 };

/* The numbers of hits, and of certain hits. */
struct tally {
    long hits, certain;
};

/* A build for this processor; most: the questions of a call. */
struct build {
    const char *name;
    cylint_float_filter *answer;
    int most;
};

static struct build build_in_use(int many)
{
    return (struct build){cylint_kernels_in_use(),
                          cylint_float_filter_used(many), many ? MOST : 1};
}

/* A loop over those of all kernels, of which several can have one in common. */
#define EACH_BUILD(b)                                                   \
    EACH_KERNELS(k)                                                     \
        for (int many = 0; many < 2; many++)                            \
            for (struct build b = build_in_use(many), *once = &b; once; \
                 once = NULL)

/* A question about a case's line in floats, and its shape, made circular and
 * bounded, with the library's answer. */
struct filter_case {
    cylint_float_filter_question q;
    const cylint_shape *shape;
    cylint_answer answer;
    int n;
};

static int circular(struct family_case *c, uint64_t index)
{
    c->ends = (cylint_ends)(index % 4); /* planes */
    return family_make(c);
}

/* near: the point nearest to the base, or a float before or behind the hit. */
static float near_shape(const struct filter_case *q, uint64_t index)
{
    const double t = q->n ? q->answer.hit[0].t : 0;
    double along = 0, dd = 0;
    for (int j = 0; j < 3; j++) {
        along += (cylint_base(q->shape)[j] - q->q.line.o[j]) * q->q.line.d[j];
        dd += q->q.line.d[j] * q->q.line.d[j];
    }
    if (index % 3 == 0)
        return (float)(along / dd);
    return (float)(t * (index % 3 == 1 ? 0.98 : 1.03));
}

/* Slices and limits of case i: tmax infinite, or near the first hit. */
static void set_slice(struct filter_case *x, uint64_t i)
{
    const int count = i % 3 ? 1 : 1 + (int)(i / 3 % 16);
    float tmax = HUGE_VALF;
    x->q.ends = x->shape->ends;
    x->q.slice =
        (cylint_slice){(uint16_t)((int)(i / 48) % count), (uint16_t)count};
    x->q.exit_only = i % 11 == 0;
    x->q.describes = i % 7 != 0;
    const double t = x->answer.hit[i / 4 % 2 && x->n ? x->n - 1 : 0].t;
    if (i % 4 == 0 && x->n && t != 0) /* there is no float before 0 */
        tmax = cylint_float_after(cylint_float_above(t), (int)(i / 8 % 5) - 2);
    if (!(fabsf(tmax) <= FLT_MAX)) /* nor one beyond FLT_MAX */
        tmax = HUGE_VALF;
    x->q.line.tmax = (double)tmax;
    cylint_filter_record_of(&x->q.record, x->shape);
}

static int make_case(struct filter_case *x, const cylint_shape *shape,
                     const double o[3], const double d[3], uint64_t index)
{
    cylint_line line;
    memset(&x->q, 0, sizeof x->q);
    for (int j = 0; j < 3; j++) {
        x->q.line.o[j] = (float)o[j];
        x->q.line.d[j] = (float)d[j];
    }
    x->q.line.tmin = index % 5 ? 0 : -HUGE_VAL;
    if (cylint_span(&line, x->q.line.o, x->q.line.d, x->q.line.tmin,
                    HUGE_VAL) != CYLINT_OK)
        return 0;
    x->shape = shape;
    x->n = cylint_intersect(shape, &line, CYLINT_WANT_ALL, &x->answer);
    x->q.near = near_shape(x, index);
    set_slice(x, index);
    return 1;
}

static int same_float(float x, double y)
{
    const float z = (float)y;
    return memcmp(&x, &z, sizeof x) == 0;
}

static int same_floats(const float f[CYLINT_HIT_FLOATS], const cylint_hit *hit)
{
    int same = same_float(f[3], hit->z) && same_float(f[4], hit->phi);
    for (int j = 0; j < 3; j++)
        same &= same_float(f[j], hit->normal[j]);
    return same;
}

/* The cases of one call. */
struct filter_call {
    struct filter_case cases[MOST];
    struct family_case from[MOST];
    cylint_float_filter_question *question[MOST];
    int n;
};

/* The library's first hit on the slice, or NULL. */
static const cylint_hit *hit_on_slice(const struct filter_case *x)
{
    for (int i = 0; i < x->n; i++)
        if (cylint_slice_at(x->answer.hit[i].z, x->q.slice.count) ==
                x->q.slice.index &&
            (!x->q.exit_only || x->answer.hit[i].side == CYLINT_SIDE_LEAVING))
            return &x->answer.hit[i];
    return NULL;
}

/* Up to `most` cases of a family, every second one of `other`, from number *i on,
 * with shapes of words up to `last`. */
static void gather(struct filter_call *c, int family, int other,
                   family_shape last, uint64_t *i, int most)
{
    for (c->n = 0; c->n < most && *i < CASES; ++*i) {
        const int n = c->n;
        struct filter_case *x = &c->cases[n];
        struct family_case *from = &c->from[n];
        family_case(1, n % 2 ? other : family, *i, from);
        if (from->shape_word > last || !circular(from, *i) ||
            !make_case(x, &from->shape, from->line.o, from->line.d, *i))
            continue;
        c->question[n] = &x->q;
        x->q.exit_only = c->question[0]->exit_only;
        x->q.describes = c->question[0]->describes;
        c->n++;
    }
}

/* The end of which the ball is hit, or -1. */
static int ball_of(const struct filter_case *x, const cylint_hit *hit)
{
    if (!cylint_is_round(x->shape->kind))
        return -1;
    if (hit->part == CYLINT_PART_LATERAL)
        return cylint_has_no_axis(x->shape) ? 0 : -1;
    return hit->part == CYLINT_PART_CAP1;
}

/* Whether a certain answer is that of the library. */
static int is_right(const struct filter_case *x, struct tally *tally)
{
    const cylint_float_filter_question *q = &x->q;
    const cylint_hit *hit = hit_on_slice(x);
    const float f = hit ? cylint_float_above(hit->t) : HUGE_VALF;
    const double t = (double)f, tmax = q->line.tmax;
    tally->hits += t < tmax;
    tally->certain += q->is == CYLINT_FLOAT_FILTER_HIT;
    if (q->is == CYLINT_FLOAT_FILTER_UNDECIDED)
        return 1;
    if (q->is == CYLINT_FLOAT_FILTER_MISS)
        return !hit || t > tmax;
    return hit && q->t == f && q->ball == ball_of(x, hit) &&
           (q->ball < 0 ? t < tmax : t <= tmax) &&
           q->leaves == (hit->side == CYLINT_SIDE_LEAVING) &&
           (!q->describes || same_floats(q->floats, hit));
}

/* The number of questions in a call is 1 to build->most in turn. */
static struct tally answer_families(const struct build *build, int family,
                                    int other, family_shape last)
{
    struct tally tally = {0, 0};
    int most = 1;
    for (uint64_t i = 0; i < CASES; most = most % build->most + 1) {
        struct filter_call c;
        gather(&c, family, other, last, &i, most);
        if (c.n == 0)
            continue;
        build->answer(c.question, c.n);
        for (int k = 0; k < c.n; k++)
            if (!CHECK(is_right(&c.cases[k], &tally))) {
                const cylint_float_filter_question *q = c.question[k];
                REPORT("%s, %d of %d, %d; in floats, near %a, from %a:",
                       build->name, k, c.n, (int)q->is, q->near, q->line.tmin);
                REPORT_CASE(&c.from[k]);
            }
    }
    return tally;
}

TEST(certain_answers_are_the_librarys)
{
    EACH_BUILD(build)
    for (int round = 0; round < 2; round++) {
        struct tally sum = {0, 0};
        for (int family = 0; family < family_count(); family++) {
            if (family_is_round(family) != round)
                continue;
            const struct tally t = answer_families(
                &build, family, family, round ? FAMILY_RCONE : FAMILY_ACONE);
            sum.hits += t.hits;
            sum.certain += t.certain;
        }
        printf("%s, %d at once%s: %ld hits, certain of %ld\n", build.name,
               build.most, round ? ", round" : "", sum.hits, sum.certain);
        CHECK((double)sum.certain > (round ? 0.3 : 0.45) * (double)sum.hits);
    }
}

TEST(round_shapes_and_others_are_answered_together)
{
    const int family = family_named("ordinary"), round = family_named("round");
    EACH_BUILD(build)
    answer_families(&build, family, round, FAMILY_RCONE);
}

/* Not certain are hits on round shapes of which one ball holds the other, and those
 * where the line passes near the circle between ball and cone. */
TEST(ordinary_shapes_are_certain)
{
    static const struct {
        const char *name;
        family_shape last;
        double least;
    } ordinary[] = {{"ordinary", FAMILY_CYLINDER, 0.99},
                    {"round", FAMILY_RCONE, 0.93}};
    for (int i = 0; i < 2; i++) {
        const int family = family_named(ordinary[i].name);
        const struct build one = build_in_use(0);
        const struct tally t =
            answer_families(&one, family, family, ordinary[i].last);
        if (!CHECK(t.hits > CASES / 20 &&
                   (double)t.certain >= ordinary[i].least * (double)t.hits))
            REPORT("%s: %ld of %ld hits", ordinary[i].name, t.certain, t.hits);
    }
}

/* Checks the answers to one question.  near: inf for the point nearest to the base.
 * Returns 0 if the text is not one. */
static int check_question(const char *text, double near, int is_certain)
{
    struct tally tally = {0, 0};
    struct filter_case x;
    struct family_case c;
    cylint_float_filter_question *const one = &x.q;
    if (!family_parse(text, &c))
        return 0;
    CHECK(make_case(&x, &c.shape, c.line.o, c.line.d, 1) && x.n > 0);
    x.q.near = isinf(near) ? (double)near_shape(&x, 0) : near;
    EACH_BUILD(build)
    {
        build.answer(&one, 1);
        if (!CHECK(is_right(&x, &tally) &&
                   (!is_certain || x.q.is == CYLINT_FLOAT_FILTER_HIT)))
            REPORT("%s: %s", build.name, text);
    }
    return 1;
}

static const char *check_known(const char *text, const char *known)
{
    double near;
    const char *end = family_numbers(known, 1, &near);
    const char *certain = end ? strstr(end, "certain") : NULL;
    if (!end || !check_question(text, near, certain != NULL))
        return NULL;
    return certain ? certain + strlen("certain") : end;
}

TEST(known_cases_are_not_decided_wrongly_or_are_certain)
{
    each_record("tests/embree/float_filter.txt", 16, check_known);
}
