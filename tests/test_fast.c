/*
 * test_fast.c - floor filter: the fast t depends on line, shape and root only
 *
 * A lane, a single question and the exact signs give the same fast t, within
 * its bound.  The origins are far away, where t in doubles is barely accurate
 * enough.
 */
#include <math.h>

#include "check.h"
#include "cylint.h"
#include "random.h"

enum { SHAPES = 256, ROUNDS = 1200, FAST = CYLINT_WANT_T | CYLINT_WANT_FAST };

/* A random number in [-1, 1). */
static double draw(void)
{
    static uint64_t stream = 7;
    return 2 * random_unit(&stream) - 1;
}

static cylint_shape shapes[SHAPES];
static cylint_line lines[SHAPES];
static double o[3][SHAPES], d[3][SHAPES], t0[SHAPES], t1[SHAPES];
static char memory[64 * 1024];
static cylint_pack pack;

static void make_shape(cylint_shape *s, const double p[3], double length,
                       cylint_ends ends, int i)
{
    double q[3], a[3], b[3], h[3];
    for (int j = 0; j < 3; j++) {
        h[j] = length * draw();
        q[j] = p[j] + h[j];
        a[j] = draw();
        b[j] = draw();
    }
    if (i % 4 == 0)
        cylint_cylinder(s, p, q, 1, ends);
    else if (i % 4 == 1)
        cylint_cone(s, p, 1, q, 0.5, ends);
    else if (i % 4 == 2)
        cylint_elliptic_cone(s, p, a, b, h, 0.5, ends);
    else
        cylint_tangent_cone(s, p, h, 0.25, ends);
}

static void make_questions(int round)
{
    const double length = pow(10, 6 * draw()), far = pow(10, 4 + 3 * draw());
    const cylint_ends ends =
        round % 2 ? CYLINT_ENDS_INFINITE : CYLINT_ENDS_CAPPED;
    for (int i = 0; i < SHAPES; i++) {
        double p[3], from[3], to[3];
        for (int j = 0; j < 3; j++) {
            p[j] = draw();
            from[j] = o[j][i] = far * draw();
            to[j] = d[j][i] = p[j] + 0.5 * draw() - from[j];
        }
        make_shape(&shapes[i], p, length, ends, i);
        cylint_whole_line(&lines[i], from, to);
    }
    cylint_pack_shapes(&pack, memory, shapes, SHAPES);
}

static void fast_t_is_the_same_from_lanes_and_alone(void)
{
    CHECK(cylint_pack_bytes(SHAPES) <= sizeof memory);
    for (int round = 0; round < ROUNDS; round++) {
        make_questions(round);
        for (int i = 0; i < SHAPES; i += 5) {
            cylint_hit hit;
            cylint_answer a;
            const size_t k = cylint_nearest(&pack, &lines[i], FAST, &hit);
            if (k == SHAPES)
                continue;
            cylint_intersect(&shapes[k], &lines[i], FAST | CYLINT_WANT_NEAREST,
                             &a);
            if (!CHECK(a.n == 1 && a.hit[0].t == hit.t))
                REPORT("round %d, line %d, shape %d: %a alone, %a in a lane",
                       round, i, (int)k, a.hit[0].t, hit.t);
        }
    }
}

/* The bound of cylint.h; |d| by its largest component is not more. */
static void check_bound(int i, double fast, double t)
{
    double far = 0, size = 0;
    for (int j = 0; j < 3; j++) {
        far += pow(lines[i].o[j] - shapes[i].base[j], 2);
        size += pow(lines[i].d[j], 2);
    }
    const double bound = 0x1p-34 * fmax(fabs(t), sqrt(far / size) * 2);
    if (!CHECK(fabs(fast - t) <= bound))
        REPORT("line %d: fast %a, exact %a", i, fast, t);
}

static void fast_t_lies_within_its_bound(void)
{
    for (int round = 0; round < ROUNDS; round++) {
        make_questions(round);
        for (int i = 0; i < SHAPES; i += 5) {
            cylint_answer fast, exact;
            cylint_intersect(&shapes[i], &lines[i], FAST, &fast);
            cylint_intersect(&shapes[i], &lines[i], CYLINT_WANT_T, &exact);
            CHECK(fast.n == exact.n && fast.relation == exact.relation);
            for (int k = 0; k < exact.n && k < fast.n; k++)
                check_bound(i, fast.hit[k].t, exact.hit[k].t);
        }
    }
}

/* Lanes of one question each must agree with questions alone in exact t. */
static void far_lines_have_the_same_t_in_pairs_and_alone(void)
{
    const cylint_lines columns = {
        SHAPES, {o[0], o[1], o[2]}, {d[0], d[1], d[2]}, NULL, NULL};
    for (int round = 0; round < ROUNDS / 4; round++) {
        cylint_columns to = {0};
        cylint_answer a;
        double tmin[SHAPES];
        cylint_lines from = columns;
        make_questions(round);
        for (int i = 0; i < SHAPES; i++)
            tmin[i] = -HUGE_VAL;
        from.tmin = tmin;
        to.t0 = t0;
        to.t1 = t1;
        cylint_intersect_pairs(&pack, &from, &to);
        for (int i = 0; i < SHAPES; i++) {
            const int n =
                cylint_intersect(&shapes[i], &lines[i], CYLINT_WANT_T, &a);
            CHECK((n > 0) == (t0[i] == t0[i]) && (n > 1) == (t1[i] == t1[i]));
            CHECK(n < 1 || a.hit[0].t == t0[i]);
            CHECK(n < 2 || a.hit[1].t == t1[i]);
        }
    }
}

int main(void)
{
    RUN(fast_t_is_the_same_from_lanes_and_alone);
    RUN(fast_t_lies_within_its_bound);
    RUN(far_lines_have_the_same_t_in_pairs_and_alone);
    return check_end();
}
