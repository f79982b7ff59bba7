/*
 * test_extreme_exponents.c - floors intersect, batch and scene: extreme
 * exponents have the same answers from every call in every floating-point
 * environment
 *
 * Groups of shapes and lines of similar sizes: numbers with exponents of their
 * own; small whole numbers times powers of two from the least to the largest
 * double; exact coincidences scaled until they are subnormal or huge; domains
 * that begin and end at hits.  Each group is answered one by one, with several
 * values of `want`, and by every batch and scene function, in all rounding
 * modes, with subnormal results flushed or not and subnormal operands treated
 * as zero or not.
 *
 * A question is one line and one shape in one call.  CYLINT_CASES is the number
 * of questions in each environment, CYLINT_SEED changes the groups,
 * CYLINT_GROUP=n tests one group.  The program prints a digest of all answers,
 * which must be the same from all compilers.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "check.h"
#include "constructed.h"
#include "cylint.h"
#include "cylint_scene.h"
#include "environment.h"
#include "families.h"
#include "random.h"

enum { CASES = 8000, GROUP = 6, MASKS = 4 };

/* ------------------------------------------------------ random numbers -- */

static uint64_t stream;

static int whole(int low, int high)
{
    return low + random_int(&stream, high - low + 1);
}

static double power(int e)
{
    return ldexp(1, e < -1074 ? -1074 : e > 1023 ? 1023 : e);
}

/* The exponents of the numbers of a group. */
typedef enum { ANY_DIGITS, FEW_DIGITS, SCALED, SORTS } sort;

struct sizes {
    sort sort;
    int about[2]; /* exponents */
};

static double few_digits(const struct sizes *s)
{
    static const double extreme[] = {1, DBL_MAX, DBL_MIN, 0x1p-1074,
                                     DBL_MIN / 2};
    const int where = whole(0, 19);
    const double sign = whole(0, 1) ? 1 : -1;
    if (where < 5)
        return sign * extreme[where];
    if (where < 8)
        return 0;
    const int e = where == 8 ? whole(-1074, 1020) : s->about[where % 2];
    return fmax(-DBL_MAX, fmin(DBL_MAX, sign * whole(1, 7) * 0.5 * power(e)));
}

static double any_digits(const struct sizes *s)
{
    const int where = whole(0, 9);
    const double mantissa = random_mantissa(&stream);
    const int e = where == 0 ? whole(-1074, 1023)
                             : s->about[where < 6 ? 0 : 1] + whole(-8, 8);
    if (whole(0, 7) == 0)
        return 0;
    return mantissa * power(e) > DBL_MAX
               ? -DBL_MAX
               : (whole(0, 1) ? 1 : -1) * (mantissa * power(e));
}

static double number(const struct sizes *s)
{
    return s->sort == FEW_DIGITS ? few_digits(s) : any_digits(s);
}

/* -------------------------------------------------------------- groups -- */

static void draw_case(const struct sizes *s, struct family_case *c)
{
    double *x = c->shape_data;
    memset(c, 0, sizeof *c);
    c->line_word = (family_line)whole(0, 3);
    c->shape_word = (family_shape)whole(0, 4);
    c->ends = (cylint_ends)(whole(0, 1) ? 0 : whole(0, 5));
    for (int i = 0; i < 6; i++)
        c->line_data[i] = number(s);
    for (int i = 0; i < 13; i++)
        x[i] = number(s);
    if (c->shape_word == FAMILY_CONE) {
        x[3] = fabs(x[3]);
        x[7] = fabs(x[7]);
    } else if (c->shape_word <= FAMILY_ACONE) {
        x[6] = fabs(x[6]);
    }
    if (c->shape_word == FAMILY_ACONE)
        x[6] = fmod(x[6], 90);
    x[12] = fabs(x[12]);
    c->line_data[6] = -HUGE_VAL;
    c->line_data[7] = HUGE_VAL;
}

static void scale(double *x, int n, int e)
{
    for (int i = 0; i < n; i++) {
        const double y = ldexp(x[i], e);
        x[i] = fabs(y) <= DBL_MAX ? y : copysign(DBL_MAX, y);
    }
}

/* An exact coincidence, or a neighbour of one, scaled to another size. */
static void scaled_case(const struct sizes *s, struct family_case *c)
{
    struct family_case base;
    double *x = c->shape_data;
    const int e = s->about[0], f = s->about[1];
    constructed_base(random_bits(&stream), 0, &base);
    if (whole(0, 1) ||
        !constructed_neighbour(&base,
                               whole(0, constructed_neighbours(&base) - 1), c))
        *c = base;
    scale(c->line_data, c->line_word == FAMILY_SEGMENT ? 6 : 3, e);
    if (c->line_word != FAMILY_SEGMENT)
        scale(c->line_data + 3, 3, f);
    scale(c->line_data + 6, 2, e - f);
    scale(x,
          c->shape_word == FAMILY_ACONE ? 6
          : c->shape_word == FAMILY_ECYLINDER || c->shape_word == FAMILY_ECONE
              ? 12
              : family_shape_size(c->shape_word),
          e);
}

static double stepped(double t)
{
    return fabs(t) < DBL_MAX ? constructed_stepped(t, whole(-1, 1)) : t;
}

/* A span that begins or ends at or beside the hits of its line. */
static void limit(struct family_case *c)
{
    cylint_answer a;
    if (c->line_word != FAMILY_SPAN || whole(0, 3) == 0 || !family_make(c))
        return;
    cylint_whole_line(&c->line, c->line_data, c->line_data + 3);
    const int n = cylint_intersect(&c->shape, &c->line, CYLINT_WANT_T, &a);
    c->line_data[6] = -HUGE_VAL;
    c->line_data[7] = HUGE_VAL;
    if (n > 0 && whole(0, 2))
        c->line_data[6] = stepped(a.hit[0].t);
    if (n > 0 && whole(0, 2))
        c->line_data[7] = stepped(a.hit[n - 1].t);
}

/* Sizes for lengths, or lengths and directions: subnormal, huge, or any. */
static struct sizes any_sizes(void)
{
    struct sizes s = {(sort)whole(0, SORTS - 1), {0, 0}};
    for (int i = 0; i < 2; i++) {
        const int where = whole(0, 3);
        s.about[i] = where == 0   ? whole(-1074, -1015)
                     : where == 1 ? whole(940, 1020)
                     : where == 2 ? whole(-1074, 1020)
                                  : whole(-3, 3);
    }
    return s;
}

static void draw_group(uint64_t seed, uint64_t index,
                       struct family_case group[GROUP])
{
    stream = seed;
    stream = random_bits(&stream) + index;
    const struct sizes s = any_sizes();
    for (int i = 0; i < GROUP; i++) {
        do {
            if (s.sort == SCALED)
                scaled_case(&s, &group[i]);
            else
                draw_case(&s, &group[i]);
            limit(&group[i]);
        } while (!family_make(&group[i]) && whole(0, 9));
    }
}

/* ------------------------------------------------------------- answers -- */

/* One answer; unwanted members are 0. */
struct answer {
    int relation, n, part[2], side[2];
    uint64_t t[2]; /* bits */
};

struct columns {
    uint64_t t[2][GROUP];
    signed char relation[GROUP], n[GROUP], part[2][GROUP];
};

struct first {
    size_t number, count, any;
    uint64_t t;
    int part, side;
};

struct answers {
    int status[GROUP][2];
    struct answer single[GROUP][GROUP], masked[GROUP][MASKS];
    struct columns shapes[GROUP], lines[GROUP], pairs;
    struct first in_pack[GROUP], in_scene[GROUP];
    int occluded[GROUP][GROUP];
};

/* The number of questions in a group.  Nearest, count and any of a pack or
 * scene count once for every shape. */
enum { QUESTIONS = GROUP * GROUP * (1 + 2 + 3 + 3 + 1) + GROUP * (MASKS + 1) };

static uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static void query_one(const cylint_shape *shape, const cylint_line *line,
                      unsigned want, struct answer *to)
{
    cylint_answer a;
    to->n = cylint_intersect(shape, line, want, &a);
    to->relation = a.relation;
    for (int i = 0; i < to->n; i++) {
        if (want & CYLINT_WANT_PART) {
            to->part[i] = a.hit[i].part;
            to->side[i] = a.hit[i].side;
        }
        if (want & CYLINT_WANT_T)
            to->t[i] = bits_of(a.hit[i].t);
    }
}

static void keep_hit(struct first *to, int found, const cylint_hit *hit)
{
    if (found) {
        to->t = bits_of(hit->t);
        to->part = hit->part;
        to->side = hit->side;
    }
}

static const cylint_columns *at(struct columns *to, cylint_columns *columns)
{
    *columns = (cylint_columns){.relation = to->relation,
                                .n = to->n,
                                .t0 = (double *)to->t[0],
                                .t1 = (double *)to->t[1],
                                .part0 = to->part[0],
                                .part1 = to->part[1]};
    return columns;
}

/* Lines in columns, for batches; a segment has its rounded direction. */
struct line_columns {
    double o[3][GROUP], d[3][GROUP], tmin[GROUP], tmax[GROUP];
};

static void columns_of(const struct family_case group[GROUP],
                       struct line_columns *to)
{
    for (int i = 0; i < GROUP; i++) {
        const cylint_line *l = &group[i].line;
        for (int j = 0; j < 3; j++) {
            to->o[j][i] = l->o[j];
            to->d[j][i] = l->d[j];
        }
        to->tmin[i] = l->tmin;
        to->tmax[i] = l->tmax;
    }
}

static void query_batches(const struct family_case group[GROUP],
                          const cylint_shape shapes[GROUP],
                          const struct line_columns *c, struct answers *to)
{
    static double memory[2000];
    const cylint_lines lines = {GROUP,
                                {c->o[0], c->o[1], c->o[2]},
                                {c->d[0], c->d[1], c->d[2]},
                                c->tmin,
                                c->tmax};
    const unsigned want = CYLINT_WANT_T | CYLINT_WANT_PART;
    cylint_columns columns;
    cylint_pack pack;
    cylint_hit hit;
    if (!CHECK(cylint_pack_bytes(GROUP) <= sizeof memory))
        return;
    cylint_pack_shapes(&pack, memory, shapes, GROUP);
    for (int i = 0; i < GROUP; i++) {
        struct first *first = &to->in_pack[i];
        const cylint_line *line = &group[i].line;
        cylint_intersect_shapes(&pack, line, at(&to->shapes[i], &columns));
        cylint_intersect_lines(&shapes[i], &lines, at(&to->lines[i], &columns));
        first->number = cylint_nearest(&pack, line, want, &hit);
        keep_hit(first, first->number < GROUP, &hit);
        first->count = cylint_count(&pack, line, 0);
        first->any = cylint_count(&pack, line, 1);
    }
    cylint_intersect_pairs(&pack, &lines, at(&to->pairs, &columns));
}

static void query_scene(const struct family_case group[GROUP],
                        const cylint_scene *scene, struct answers *to)
{
    cylint_hit hit;
    for (int i = 0; i < GROUP; i++) {
        struct first *first = &to->in_scene[i];
        const cylint_line *line = &group[i].line;
        first->number = cylint_scene_nearest(
            scene, line, CYLINT_WANT_T | CYLINT_WANT_PART, &hit);
        keep_hit(first, first->number < GROUP, &hit);
        first->count = cylint_scene_count(scene, line, 0);
        first->any = (size_t)cylint_scene_occluded(scene, line, GROUP);
    }
}

/* Answers all questions of the group.  Makes a scene of the shapes unless one
 * is given. */
static void answer_all(const struct family_case group[GROUP],
                       const struct line_columns *columns,
                       const unsigned mask[MASKS], cylint_scene *scene,
                       struct answers *to)
{
    cylint_shape shapes[GROUP];
    memset(to, 0, sizeof *to);
    for (int i = 0; i < GROUP; i++) {
        shapes[i] = group[i].shape;
        to->status[i][0] = (int)group[i].shape_status;
        to->status[i][1] = (int)group[i].line_status;
        for (int k = 0; k < MASKS; k++)
            query_one(&group[i].shape, &group[i].line, mask[k],
                      &to->masked[i][k]);
        for (int j = 0; j < GROUP; j++) {
            query_one(&group[j].shape, &group[i].line,
                      CYLINT_WANT_T | CYLINT_WANT_PART, &to->single[i][j]);
            to->occluded[i][j] =
                cylint_occluded(&group[j].shape, &group[i].line);
        }
    }
    query_batches(group, shapes, columns, to);
    cylint_scene *made =
        scene ? scene : cylint_scene_new(shapes, GROUP, 1, NULL);
    if (CHECK(made))
        query_scene(group, made, to);
    if (!scene)
        cylint_scene_free(made);
}

/* ---------------------------------------------------------- comparison -- */

static void show(const struct family_case *line, const struct family_case *of,
                 const char *where)
{
    struct family_case c = *line;
    if (check_bad > CHECK_SHOWN)
        return;
    c.shape_word = of->shape_word;
    c.ends = of->ends;
    memcpy(c.shape_data, of->shape_data, sizeof c.shape_data);
    fprintf(stderr, "    ");
    family_print(stderr, &c);
    fprintf(stderr, "  # %s\n", where);
}

static void show_firsts(const struct family_case *line, const struct answers *a,
                        int i, const char *what)
{
    const struct first *p = &a->in_pack[i], *s = &a->in_scene[i];
    show(line, line, what);
    REPORT("pack: shape %zu, t bits %llx, %zu hit, any %zu; scene: shape %zu, "
           "t bits %llx, %zu hit, any %zu",
           p->number, (unsigned long long)p->t, p->count, p->any, s->number,
           (unsigned long long)s->t, s->count, s->any);
}

#define SAME(member) (memcmp(&a->member, &b->member, sizeof a->member) == 0)

/* Reports differences, by line and shape if possible. */
static void compare(const struct family_case group[GROUP],
                    const struct answers *a, const struct answers *b)
{
    if (memcmp(a, b, sizeof *a) == 0)
        return;
    CHECK(SAME(status));
    for (int i = 0; i < GROUP; i++) {
        for (int j = 0; j < GROUP; j++)
            if (!CHECK(SAME(single[i][j]) && SAME(occluded[i][j])))
                show(&group[i], &group[j], "alone");
        if (!CHECK(SAME(masked[i])))
            show(&group[i], &group[i], "under some want");
        if (!CHECK(SAME(shapes[i])))
            show(&group[i], &group[0], "this line, all shapes");
        if (!CHECK(SAME(lines[i])))
            show(&group[0], &group[i], "all lines, this shape");
        if (!CHECK(SAME(in_pack[i]) && SAME(in_scene[i])))
            show_firsts(&group[i], b, i, "this line, the nearest shape");
    }
    if (!CHECK(SAME(pairs)))
        show(&group[0], &group[0], "pairs");
}

/* Compares batches, scenes and masks with single questions in one
 * environment. */
static void compare_calls(const struct family_case group[GROUP],
                          const unsigned mask[MASKS], const struct answers *a)
{
    for (int i = 0; i < GROUP; i++) {
        size_t count = 0;
        for (int j = 0; j < GROUP; j++) {
            const struct answer *x = &a->single[i][j];
            const struct columns *s = &a->shapes[i], *l = &a->lines[j];
            count += x->n > 0;
            if (!CHECK(a->occluded[i][j] == (x->n > 0) &&
                       s->relation[j] == x->relation && s->n[j] == x->n &&
                       (x->n < 1 || s->t[0][j] == x->t[0]) &&
                       (x->n < 2 || s->t[1][j] == x->t[1])))
                show(&group[i], &group[j], "a batch beside one question");
            if (!group[i].line.segment &&
                !CHECK(l->relation[i] == x->relation && l->n[i] == x->n &&
                       (x->n < 1 || l->t[0][i] == x->t[0]) &&
                       (x->n < 2 || l->t[1][i] == x->t[1])))
                show(&group[i], &group[j], "many lines beside one");
        }
        if (!CHECK(memcmp(&a->in_pack[i], &a->in_scene[i],
                          sizeof a->in_pack[i]) == 0 &&
                   a->in_pack[i].count == count &&
                   a->in_pack[i].any == (count > 0)))
            show_firsts(&group[i], a, i, "pack and scene");
        for (int k = 0; k < MASKS; k++) {
            const struct answer *x = &a->masked[i][k], *all = &a->single[i][i];
            const int n = mask[k] & CYLINT_WANT_NEAREST ? all->n > 0 : all->n;
            if (!CHECK(x->n == n && x->relation == all->relation))
                show(&group[i], &group[i], "the number depends on want");
        }
    }
}

/* ------------------------------------------------------------ the test -- */

static const char *name_of(int i)
{
    static const char *const rounding[] = {"to nearest", "upward", "downward",
                                           "toward zero"};
    static const char *const tiny[] = {"", ", flushing", ", taking for zero",
                                       ", both"};
    static char name[60];
    snprintf(name, sizeof name, "%s%s", rounding[i / 4], tiny[i % 4]);
    return name;
}

static uint64_t digest = UINT64_C(0xcbf29ce484222325);
static unsigned long long n_single, n_met, n_hit;

/* FNV-1a of numbers that are the same on every machine. */
static void digest_number(uint64_t x)
{
    for (int i = 0; i < 8; i++)
        digest = (digest ^ (x >> 8 * i & 0xff)) * UINT64_C(0x100000001b3);
}

static void digest_answers(const struct answers *a)
{
    for (int i = 0; i < GROUP; i++) {
        digest_number((uint64_t)(a->status[i][0] * 16 + a->status[i][1]));
        digest_number((uint64_t)a->in_pack[i].number);
        for (int j = 0; j < GROUP; j++) {
            const struct answer *x = &a->single[i][j];
            n_single++;
            n_met += x->relation != CYLINT_RELATION_MISS;
            n_hit += x->n > 0;
            digest_number((uint64_t)(x->relation * 4 + x->n));
            for (int k = 0; k < x->n; k++) {
                digest_number((uint64_t)(x->part[k] * 4 + x->side[k]));
                digest_number(x->t[k]);
            }
        }
    }
}

static void use_kernels(uint64_t number)
{
    int n = 0;
    while (cylint_kernels_name(n))
        n++;
    CHECK(cylint_use_kernels(cylint_kernels_name((int)(number % (uint64_t)n))));
}

/* Compares a group in its environment with the default one.  Groups of odd
 * number are also made in their environment, scenes included. */
static void test_group(uint64_t index, int differences[ENVIRONMENTS])
{
    struct family_case group[GROUP], here[GROUP];
    struct line_columns columns;
    cylint_shape shapes[GROUP];
    static struct answers want, got;
    unsigned mask[MASKS];
    draw_group(check_setting("CYLINT_SEED", 1), index, group);
    for (int k = 0; k < MASKS; k++)
        mask[k] = (unsigned)whole(0, 2 * CYLINT_WANT_NEAREST - 1);
    columns_of(group, &columns);
    for (int i = 0; i < GROUP; i++)
        shapes[i] = group[i].shape;
    use_kernels(index);
    cylint_scene *scene = cylint_scene_new(shapes, GROUP, 1, NULL);
    answer_all(group, &columns, mask, scene, &want);
    compare_calls(group, mask, &want);
    digest_answers(&want);
    for (int e = 1; e < ENVIRONMENTS; e++) {
        const struct environment there = environment_of(e);
        const int bad = check_bad;
        if (!can_treat_subnormals(there.tiny))
            continue;
        memcpy(here, group, sizeof here);
        environment_set(there);
        for (int i = 0; i < GROUP && index % 2; i++)
            family_make(&here[i]);
        answer_all(here, &columns, mask, index % 2 ? NULL : scene, &got);
        environment_reset();
        compare(group, &want, &got);
        differences[e] += check_bad - bad;
        if (check_bad > bad)
            REPORT("group %llu, %s", (unsigned long long)index, name_of(e));
    }
    cylint_scene_free(scene);
}

static void every_call_has_the_same_answers_in_every_environment(void)
{
    const uint64_t cases = check_setting("CYLINT_CASES", CASES);
    const uint64_t groups = (cases + QUESTIONS - 1) / QUESTIONS;
    int differences[ENVIRONMENTS] = {0};
    const uint64_t only = check_setting("CYLINT_GROUP", UINT64_MAX);
    for (uint64_t i = 0; i < groups; i++)
        if (only == UINT64_MAX || i == only)
            test_group(i, differences);
    for (int e = 1; e < ENVIRONMENTS; e++)
        if (differences[e])
            fprintf(stderr, "    %d differences: %s\n", differences[e],
                    name_of(e));
    printf("note: %llu questions in each of %d environments; of lines and "
           "shapes %.0f %% meet, %.0f %% hit; digest %016llx\n",
           (unsigned long long)(groups * QUESTIONS), ENVIRONMENTS,
           100. * (double)n_met / (double)n_single,
           100. * (double)n_hit / (double)n_single, (unsigned long long)digest);
}

int main(void)
{
    RUN(every_call_has_the_same_answers_in_every_environment);
    return check_end();
}
