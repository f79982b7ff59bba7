/*
 * shapes.c - floors intersect and batch: fuzzes the library
 *
 * The bytes of an input become a line and some shapes.  All functions of the
 * library must give the same answer, also under mirrors, rotations of the
 * axes, powers of two and reversal of the line.  A build with CYLINT_PARANOID
 * also makes each decision twice.
 */
#include <math.h>
#include <string.h>

#include "cylint.h"
#include "fuzz.h"

enum { SHAPES_MOST = 9 };

/* ------------------------------------------------------ bytes to numbers -- */

struct bytes {
    const uint8_t *p, *end;
    double last[8]; /* recent numbers, for reuse */
    unsigned count;
};

static unsigned next(struct bytes *b)
{
    return b->p < b->end ? *b->p++ : 0;
}

static double neighbour(double x, int steps)
{
    for (; steps > 0; steps--) {
        x = nextafter(x, HUGE_VAL);
    }
    for (; steps < 0; steps++) {
        x = nextafter(x, -HUGE_VAL);
    }
    return x;
}

static double raw(struct bytes *b)
{
    uint64_t bits = 0;
    double value;
    for (int i = 0; i < 8; i++) {
        bits = bits << 8 | next(b);
    }
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Usually a small integer, so that lines touch, graze and lie along; otherwise
 * a recent number, perhaps moved by a few ulp, a power of two, or any
 * double. */
static double draw(struct bytes *b)
{
    const unsigned kind = next(b);
    if (kind < 128) {
        return (int)kind % 17 - 8;
    }
    if (kind < 160) {
        return ((int)kind - 144) / 16.0;
    }
    if (kind < 176) {
        return b->last[kind % 8];
    }
    if (kind < 192) {
        return -b->last[kind % 8];
    }
    if (kind < 216) {
        return neighbour(b->last[kind % 8], (int)(kind / 8 % 8) - 3);
    }
    if (kind < 224) {
        return ldexp(1 + (kind & 1), (int)next(b) * 9 - 1074);
    }
    return raw(b);
}

static double number(struct bytes *b)
{
    return b->last[b->count++ % 8] = draw(b);
}

/* ------------------------------------------------- numbers to the library -- */

/* Lengths are kept apart, so that they can be scaled: the vectors of a line,
 * the four vectors of a shape, and its other lengths. */
struct given_line {
    int kind;
    double o[3], d[3], tmin, tmax;
};

struct given_shape {
    int kind;
    cylint_ends ends;
    double v[4][3], r0, r1, factor;
};

enum { VECTORS_MOST = 4 };

static void vector(struct bytes *b, double v[3])
{
    for (int i = 0; i < 3; i++) {
        v[i] = number(b);
    }
}

static struct given_line line_given(struct bytes *b)
{
    struct given_line g;
    memset(&g, 0, sizeof g);
    g.kind = (int)(next(b) % 4);
    vector(b, g.o);
    vector(b, g.d);
    g.tmin = g.kind == 3 ? number(b) : 0;
    g.tmax = g.kind == 3 ? number(b) : 0;
    return g;
}

static struct given_shape shape_given(struct bytes *b)
{
    struct given_shape g;
    memset(&g, 0, sizeof g);
    const unsigned kind = next(b);
    g.kind = (int)(kind % 6);
    g.ends = (cylint_ends)(kind / 6 % 6);
    const int vectors =
        g.kind == CYLINT_KIND_ECYLINDER || g.kind == CYLINT_KIND_ECONE ? 4 : 2;
    for (int i = 0; i < vectors; i++) {
        vector(b, g.v[i]);
    }
    g.r0 = number(b);
    g.r1 = number(b);
    g.factor = number(b);
    return g;
}

static void make_line(const struct given_line *g, cylint_line *line)
{
    switch (g->kind) {
    case 0:
        cylint_whole_line(line, g->o, g->d);
        break;
    case 1:
        cylint_ray(line, g->o, g->d);
        break;
    case 2:
        cylint_segment(line, g->o, g->d);
        break;
    default:
        cylint_span(line, g->o, g->d, g->tmin, g->tmax);
    }
}

static void make_shape(const struct given_shape *g, cylint_shape *s)
{
    switch (g->kind) {
    case CYLINT_KIND_CYLINDER:
        cylint_cylinder(s, g->v[0], g->v[1], g->r0, g->ends);
        break;
    case CYLINT_KIND_CONE:
        cylint_cone(s, g->v[0], g->r0, g->v[1], g->r1, g->ends);
        break;
    case CYLINT_KIND_ACONE:
        cylint_tangent_cone(s, g->v[0], g->v[1], g->factor, g->ends);
        break;
    case CYLINT_KIND_ECYLINDER:
        cylint_elliptic_cylinder(s, g->v[0], g->v[1], g->v[2], g->v[3],
                                 g->ends);
        break;
    case CYLINT_KIND_ECONE:
        cylint_elliptic_cone(s, g->v[0], g->v[1], g->v[2], g->v[3], g->factor,
                             g->ends);
        break;
    default:
        cylint_angle_cone(s, g->v[0], g->v[1], 45 * g->factor, g->ends);
    }
}

/* ------------------------------------------------------------- one shape -- */

static int same_bits(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

static const unsigned verdicts = CYLINT_WANT_T | CYLINT_WANT_PART;

/* Compares relation, number, parts, sides and t. */
static void must_agree(const cylint_answer *a, const cylint_answer *b)
{
    MUST(a->relation == b->relation && a->n == b->n && a->flags == b->flags);
    for (int i = 0; i < a->n; i++) {
        MUST(a->hit[i].t == b->hit[i].t);
        MUST(a->hit[i].part == b->hit[i].part);
        MUST(a->hit[i].side == b->hit[i].side);
    }
}

static void check_hit(const cylint_hit *hit, const cylint_line *line)
{
    MUST(!isnan(hit->t) && line->tmin <= hit->t && hit->t <= line->tmax);
    MUST(!(hit->t == 0 && signbit(hit->t)));
    MUST(hit->part >= CYLINT_PART_LATERAL && hit->part <= CYLINT_PART_CAP1);
    MUST(hit->side >= CYLINT_SIDE_ENTERING && hit->side <= CYLINT_SIDE_BOTH);
    MUST(hit->phi >= 0 && hit->phi < 1);
    MUST(!isnan(hit->z));
    double most = 0; /* of a unit vector, sqrt(1/3) at least */
    for (int i = 0; i < 3; i++) {
        MUST(!isnan(hit->point[i]) && fabs(hit->normal[i]) <= 1);
        most = fmax(most, fabs(hit->normal[i]));
    }
    MUST(most > 0.5);
}

static void check_answer(const cylint_shape *s, const cylint_line *line,
                         const cylint_answer *a)
{
    const int refused = s->kind == CYLINT_KIND_NONE || !line->valid;
    MUST(a->n >= 0 && a->n <= 2);
    MUST(a->relation >= CYLINT_RELATION_MISS &&
         a->relation <= CYLINT_RELATION_CROSS);
    MUST(a->flags == (refused ? CYLINT_FLAG_INVALID : 0));
    MUST(!refused || a->relation == CYLINT_RELATION_MISS);
    MUST(a->relation != CYLINT_RELATION_MISS || a->n == 0);
    MUST(a->relation != CYLINT_RELATION_TOUCH || a->n <= 1);
    MUST(a->n < 2 || a->hit[0].t <= a->hit[1].t);
    for (int i = 0; i < a->n; i++) {
        check_hit(&a->hit[i], line);
    }
}

/* A member wanted alone has the bits that it has when all are wanted. */
static void check_alone(const cylint_shape *s, const cylint_line *line,
                        const cylint_answer *all)
{
    cylint_answer point, normal, z, phi;
    cylint_intersect(s, line, CYLINT_WANT_POINT, &point);
    cylint_intersect(s, line, CYLINT_WANT_NORMAL, &normal);
    cylint_intersect(s, line, CYLINT_WANT_Z, &z);
    cylint_intersect(s, line, CYLINT_WANT_PHI, &phi);
    for (int i = 0; i < all->n; i++) {
        const cylint_hit *h = &all->hit[i];
        for (int j = 0; j < 3; j++) {
            MUST(same_bits(point.hit[i].point[j], h->point[j]));
            MUST(same_bits(normal.hit[i].normal[j], h->normal[j]));
        }
        MUST(same_bits(z.hit[i].z, h->z) && same_bits(phi.hit[i].phi, h->phi));
    }
}

static void check_wants(const cylint_shape *s, const cylint_line *line,
                        const cylint_answer *all)
{
    cylint_answer a;
    check_alone(s, line, all);
    cylint_intersect(s, line, verdicts, &a);
    must_agree(all, &a);
    MUST(cylint_intersect(s, line, CYLINT_WANT_COUNT, &a) == all->n);
    MUST(a.relation == all->relation);
    MUST(cylint_occluded(s, line) == (all->n > 0));
    MUST(cylint_intersect(s, line, verdicts | CYLINT_WANT_NEAREST, &a) ==
         (all->n > 0));
    MUST(a.n == 0 || (same_bits(a.hit[0].t, all->hit[0].t) &&
                      a.hit[0].part == all->hit[0].part));
}

/* The place of the origin bounds the relation of the line. */
static void check_origin(const cylint_shape *s, const cylint_line *line,
                         const cylint_answer *a)
{
    double lo[3], hi[3];
    const int where = cylint_contains(s, line->o);
    if (where < 0 || !line->valid) {
        return;
    }
    MUST(a->relation != CYLINT_RELATION_MISS);
    MUST(where == 0 || a->relation == CYLINT_RELATION_CROSS);
    cylint_bounds(s, lo, hi);
    for (int i = 0; i < 3; i++) {
        MUST(lo[i] <= line->o[i] && line->o[i] <= hi[i]);
    }
}

/* ------------------------------------------------------- transformations -- */

/* Transforms a vector; returns whether the result is exact. */
typedef int transformation(double v[3], int k);

static int scaled(double v[3], int k)
{
    for (int i = 0; i < 3; i++) {
        const double x = v[i];
        v[i] = ldexp(x, k);
        if (ldexp(v[i], -k) != x) {
            return 0;
        }
    }
    return 1;
}

static int turned(double v[3], int k)
{
    (void)k;
    const double x = v[0];
    v[0] = v[1];
    v[1] = v[2];
    v[2] = x;
    return 1;
}

static int mirrored(double v[3], int k)
{
    v[k] = -v[k];
    return 1;
}

static void check_transformed(const struct given_shape *shape,
                              const struct given_line *line,
                              const cylint_answer *all, transformation *f,
                              int k)
{
    struct given_shape s = *shape;
    struct given_line l = *line;
    int exact = f(l.o, k) && f(l.d, k);
    for (int i = 0; i < VECTORS_MOST; i++) {
        exact = exact && f(s.v[i], k);
    }
    if (f == scaled) {
        double radii[3] = {s.r0, s.r1, 0};
        exact = exact && scaled(radii, k);
        s.r0 = radii[0];
        s.r1 = radii[1];
    }
    if (exact) {
        cylint_line new_line;
        cylint_shape new_shape;
        cylint_answer a;
        make_line(&l, &new_line);
        make_shape(&s, &new_shape);
        cylint_intersect(&new_shape, &new_line, verdicts, &a);
        must_agree(all, &a);
    }
}

/* The reversed line has the same hits in reverse order. */
static void check_reversed(const cylint_shape *s, const cylint_line *line,
                           const cylint_answer *all)
{
    cylint_line back;
    cylint_answer a;
    if (line->segment || !line->valid) {
        return;
    }
    const double d[3] = {-line->d[0], -line->d[1], -line->d[2]};
    cylint_span(&back, line->o, d, -line->tmax, -line->tmin);
    cylint_intersect(s, &back, verdicts, &a);
    MUST(a.relation == all->relation && a.n == all->n);
    for (int i = 0; i < a.n; i++) {
        const cylint_hit *h = &a.hit[i], *was = &all->hit[a.n - 1 - i];
        MUST(h->t == -was->t && h->part == was->part);
        MUST(h->side == (was->side == CYLINT_SIDE_BOTH ? CYLINT_SIDE_BOTH
                                                       : 1 - was->side));
    }
}

/* A cylinder is a cone of equal radii, elliptic or not. */
static void check_as_cone(const struct given_shape *shape,
                          const cylint_line *line, const cylint_answer *all)
{
    struct given_shape cone = *shape;
    cylint_shape s;
    cylint_answer a;
    if (cone.kind != CYLINT_KIND_CYLINDER &&
        cone.kind != CYLINT_KIND_ECYLINDER) {
        return;
    }
    cone.kind = cone.kind == CYLINT_KIND_CYLINDER ? CYLINT_KIND_CONE
                                                  : CYLINT_KIND_ECONE;
    cone.r1 = cone.r0;
    cone.factor = 1;
    make_shape(&cone, &s);
    cylint_intersect(&s, line, verdicts, &a);
    must_agree(all, &a);
}

static void check_shape(const struct given_shape *g, const cylint_shape *s,
                        const struct given_line *line_was,
                        const cylint_line *line)
{
    cylint_answer all;
    MUST(cylint_intersect(s, line, CYLINT_WANT_ALL, &all) == all.n);
    check_answer(s, line, &all);
    check_wants(s, line, &all);
    check_origin(s, line, &all);
    check_reversed(s, line, &all);
    check_as_cone(g, line, &all);
    check_transformed(g, line_was, &all, scaled, 3);
    check_transformed(g, line_was, &all, scaled, -70);
    check_transformed(g, line_was, &all, turned, 0);
    check_transformed(g, line_was, &all, mirrored, 1);
}

/* ------------------------------------------------------------ many shapes -- */

static void must_be_column(const cylint_columns *c, size_t i,
                           const cylint_answer *a)
{
    MUST(c->relation[i] == a->relation && c->n[i] == a->n);
    MUST(a->n < 1 ? isnan(c->t0[i]) && c->part0[i] == -1
                  : same_bits(c->t0[i], a->hit[0].t) &&
                        c->part0[i] == a->hit[0].part);
    MUST(a->n < 2 ? isnan(c->t1[i]) && c->part1[i] == -1
                  : same_bits(c->t1[i], a->hit[1].t) &&
                        c->part1[i] == a->hit[1].part);
}

struct column_arrays {
    signed char relation[SHAPES_MOST], n[SHAPES_MOST], part0[SHAPES_MOST],
        part1[SHAPES_MOST];
    double t0[SHAPES_MOST], t1[SHAPES_MOST];
};

static cylint_columns columns_of(struct column_arrays *a)
{
    return (cylint_columns){.relation = a->relation,
                            .n = a->n,
                            .t0 = a->t0,
                            .t1 = a->t1,
                            .part0 = a->part0,
                            .part1 = a->part1};
}

static void check_pack(const cylint_pack *pack, const cylint_line *line)
{
    struct column_arrays arrays;
    const cylint_columns columns = columns_of(&arrays);
    size_t nearest = pack->n, hit_count = 0;
    double t = 0;
    cylint_intersect_shapes(pack, line, &columns);
    for (size_t i = 0; i < pack->n; i++) {
        cylint_answer a;
        cylint_intersect(&pack->shapes[i], line, verdicts, &a);
        must_be_column(&columns, i, &a);
        hit_count += a.n > 0;
        if (a.n > 0 && (nearest == pack->n || a.hit[0].t < t)) {
            nearest = i;
            t = a.hit[0].t;
        }
    }
    cylint_hit hit;
    MUST(cylint_nearest(pack, line, verdicts, &hit) == nearest);
    MUST(nearest == pack->n || same_bits(hit.t, t));
    MUST(cylint_count(pack, line, 0) == hit_count);
    MUST(cylint_count(pack, line, 1) == (hit_count > 0));
}

/* Several copies of the line, each with a later tmin. */
static void check_lines(const cylint_shape *s, const cylint_line *line)
{
    enum { N = 5 };
    double v[6][N], tmin[N], tmax[N];
    struct column_arrays arrays;
    const cylint_lines lines = {
        N, {v[0], v[1], v[2]}, {v[3], v[4], v[5]}, tmin, tmax};
    const cylint_columns columns = columns_of(&arrays);
    for (int i = 0; i < N; i++) {
        for (int j = 0; j < 3; j++) {
            v[j][i] = line->o[j];
            v[3 + j][i] = line->d[j];
        }
        tmin[i] = line->tmin + i;
        tmax[i] = line->tmax;
    }
    cylint_intersect_lines(s, &lines, &columns);
    for (size_t i = 0; i < N; i++) {
        const double o[3] = {v[0][i], v[1][i], v[2][i]};
        const double d[3] = {v[3][i], v[4][i], v[5][i]};
        cylint_line one;
        cylint_answer a;
        cylint_span(&one, o, d, tmin[i], tmax[i]);
        cylint_intersect(s, &one, verdicts, &a);
        must_be_column(&columns, i, &a);
    }
}

static void check_batches(const cylint_shape *shapes, size_t count,
                          const cylint_line *line)
{
    cylint_pack pack;
    void *memory = malloc(cylint_pack_bytes(count));
    const char *name;
    MUST(memory);
    cylint_pack_shapes(&pack, memory, shapes, count);
    for (int i = 0; (name = cylint_kernels_name(i)) != NULL; i++) {
        MUST(cylint_use_kernels(name));
        check_pack(&pack, line);
        for (size_t j = 0; j < count; j++) {
            check_lines(&shapes[j], line);
        }
    }
    MUST(cylint_use_kernels(NULL));
    free(memory);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct bytes b = {data, data + size, {0, 1, 2, -1, 0.5, 3, 1e-3, 1e8}, 0};
    const struct given_line given = line_given(&b);
    cylint_line line;
    cylint_shape shapes[SHAPES_MOST];
    size_t count = 0;
    make_line(&given, &line);
    while (b.p < b.end && count < SHAPES_MOST) {
        const struct given_shape g = shape_given(&b);
        make_shape(&g, &shapes[count]);
        check_shape(&g, &shapes[count], &given, &line);
        count++;
    }
    check_batches(shapes, count, &line);
    return 0;
}
