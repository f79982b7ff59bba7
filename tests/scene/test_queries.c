/*
 * test_queries.c - a scene returns what all its shapes return
 *
 * Every kind of scene, and a loop over all shapes (answers.h), answer every kind
 * of line, and points of several places.  CYLINT_CASES is the number of lines of
 * each kind for each scene (1000 in make check-scene), CYLINT_SEED changes all
 * random numbers.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#define CHECK_OWN_MAIN
#include "answers.h"
#include "check.h"
#include "environment.h"
#include "scene/scene.h"
#include "shapes/shape_facts.h"

enum { SHAPES = 1200, NEAR = 150, LINES = 20 };

static size_t n_lines, n_hit, n_points, n_near, n_inside, most_found;

static cylint_scene *open_scene(const struct scene_shapes *of, int threads)
{
    cylint_scene_status status;
    cylint_scene *scene = cylint_scene_new(of->shapes, of->n, threads, &status);
    CHECK(scene && status == CYLINT_SCENE_OK);
    return scene;
}

/* ----------------------------------------------------------------- lines -- */

static void check_line(const struct scene_shapes *of, const cylint_scene *scene,
                       const cylint_line *line)
{
    static struct line_answers got, want;
    line_by_loop(of->shapes, of->n, line, &want);
    line_in_scene(scene, line, &got);
    if (!CHECK(same_line_answers(&got, &want))) {
        REPORT("scene %s, seed %llu: nearest %zu %zu %zu, not %zu %zu %zu; %zu "
               "hit, not %zu; %zu chords, not %zu",
               of->name, (unsigned long long)check_seed(), got.nearest[0],
               got.nearest[1], got.nearest[2], want.nearest[0], want.nearest[1],
               want.nearest[2], got.hit.n, want.hit.n, got.chords, want.chords);
        REPORT("span %a %a %a  %a %a %a  %a %a", line->o[0], line->o[1],
               line->o[2], line->d[0], line->d[1], line->d[2], line->tmin,
               line->tmax);
    }
    const unsigned members = (unsigned)(n_lines++ % (CYLINT_WANT_ALL + 1));
    n_hit += want.hit.n > 0;
    most_found = want.hit.n > most_found ? want.hit.n : most_found;
    cylint_hit some;
    memset(&some, UNTOUCHED, sizeof some);
    const size_t nearest = cylint_scene_nearest(scene, line, members, &some);
    CHECK(is_nearest_of(of->n, nearest, &some, members, &want));
}

/* ---------------------------------------------------------------- points -- */

static double distance[2][LISTED];

/* Also with some of the members; the others keep their bytes.  Sometimes the
 * function for arrays of shapes answers, too. */
static void check_radius(const struct scene_shapes *of,
                         const cylint_scene *scene, const double point[3],
                         double radius, unsigned want)
{
    static struct point_answers got, due;
    const unsigned members = CYLINT_WANT_PART * (unsigned)below(8) | want;
    cylint_closest some, of_array, due_some;
    memset(&some, UNTOUCHED, sizeof some);
    of_array = due_some = some;
    point_by_loop(of->shapes, of->n, distance[want != 0], point, radius, want,
                  &due);
    point_in_scene(scene, point, radius, want, &got);
    if (due.nearest < of->n)
        cylint_distance(&of->shapes[due.nearest], point, members, &due_some);
    if (!CHECK(same_point_answers(&got, &due) &&
               cylint_scene_closest(scene, point, radius, members, &some) ==
                   due.nearest &&
               same_bytes(&some, &due_some, sizeof some)))
        REPORT("point %a %a %a, scene %s, radius %a%s: nearest %zu, not %zu; "
               "%zu near, not %zu",
               point[0], point[1], point[2], of->name, radius,
               want ? ", signed" : "", got.nearest, due.nearest, got.near.n,
               due.near.n);
    if (one_of(8) == 0)
        CHECK(cylint_closest_shape(of->shapes, of->n, point, radius, members,
                                   &of_array) == due.nearest &&
              same_bytes(&of_array, &due_some, sizeof of_array));
    n_near += due.nearest < of->n;
    most_found = due.near.n > most_found ? due.near.n : most_found;
}

/* How many shapes, each a solid of its own, hold the point; these have signed
 * distances of at most 0. */
static void check_contains(const struct scene_shapes *of,
                           const cylint_scene *scene, const double point[3])
{
    static double memory[1 << 15];
    cylint_workspace work = {memory, sizeof memory, 0};
    size_t count = 0, wrong = 0, first = of->n, owner;
    for (size_t i = of->n; i-- > 0;) {
        const int side = cylint_contains(&of->shapes[i], point);
        const double d = distance[1][i];
        first = side >= 0 ? i : first;
        count += side >= 0;
        wrong += side >= 0 ? !(d <= 0) || (side > 0) != (d < 0) : d <= 0;
    }
    for (size_t enough = 0; enough <= 4; enough++)
        CHECK(cylint_scene_contains(scene, point, enough) ==
              (enough && enough < count ? enough : count));
    CHECK(cylint_scene_depth(scene, point, NULL, &owner, &work) == count &&
          owner == first);
    CHECK(wrong == 0);
    n_inside += count > 0;
    most_found = count > most_found ? count : most_found;
}

static void begin_point(const struct scene_shapes *of, const double point[3])
{
    all_distances(of->shapes, of->n, point, 0, distance[0]);
    all_distances(of->shapes, of->n, point, CYLINT_SIGNED, distance[1]);
    n_points++;
}

/* Radii about the least distance and about that of another shape, where a step
 * of the doubles decides. */
static void check_point(const struct scene_shapes *of,
                        const cylint_scene *scene, const double point[3])
{
    begin_point(of, point);
    check_contains(of, scene, point);
    for (int i = 0; i < 2; i++) {
        const unsigned want = i ? CYLINT_SIGNED : 0;
        double radii[8] = {HUGE_VAL, 0, -0.001}, least = NAN;
        int n = 3;
        const double other = distance[i][below(of->n)];
        for (size_t k = 0; k < of->n; k++)
            least = fmin(least, distance[i][k]);
        if (least <= DBL_MAX) {
            radii[n++] = least;
            radii[n++] = nextafter(least, -HUGE_VAL);
            radii[n++] = 3 * least;
        }
        if (other <= DBL_MAX) {
            radii[n++] = other;
            radii[n++] = nextafter(other, -HUGE_VAL);
        }
        for (int k = 0; k < n; k++)
            check_radius(of, scene, point, radii[k], want);
    }
}

enum place { IN_BOX, ON_SHAPE, AT_CENTER, LATTICE, FAR, WILD, PLACES };

/* On the surface of a shape but for roundings, or on its axis. */
static void point_on(const struct scene_shapes *of, int on_axis,
                     double point[3])
{
    const cylint_shape *s = &of->shapes[below(of->n)];
    const double z = on_axis ? 0.5 * (double)below(3) : between(0, 1);
    cylint_closest a = {.part = -1};
    for (int j = 0; j < 3; j++) {
        point[j] = cylint_base(s)[j] + z * cylint_axis(s)[j];
        if (!on_axis)
            point[j] += cylint_axis_size(s) * between(-0.5, 0.5);
    }
    if (!on_axis)
        cylint_distance(s, point, CYLINT_WANT_POINT, &a);
    if (a.part >= 0)
        memcpy(point, a.point, sizeof a.point);
}

static void point_of(const struct scene_shapes *of, enum place where,
                     double point[3])
{
    static const double wild[] = {0,        -0.0,    5e-324, DBL_MIN,
                                  DBL_MAX,  1e300,   -1e200, 1e-200,
                                  HUGE_VAL, -1e-310, NAN,    0x1p60};
    const double far = power(3, 20);
    if (where == ON_SHAPE || where == AT_CENTER) {
        point_on(of, where == AT_CENTER, point);
        return;
    }
    for (int j = 0; j < 3; j++) {
        const double in = between(of->lo[j], of->hi[j]);
        point[j] = where == LATTICE ? floor(2 * in) / 2
                   : where == FAR
                       ? in + longest_side(of) * far * between(-0.5, 0.5)
                   : where == WILD ? wild[below(sizeof wild / sizeof *wild)]
                                   : in;
    }
}

/* ---------------------------------------------------------------- scenes -- */

/* With one of the builds of the kernels. */
static void check_lines(const struct scene_shapes *of, uint64_t number,
                        uint64_t lines)
{
    use_some_kernels(number);
    OWN_SCENE *scene = open_scene(of, 2);
    for (int kind = 0; scene && kind < LINES_KINDS; kind++) {
        /* exact numbers decide for most shapes */
        const int slow =
            kind == LINES_WILD || of->hi[0] > 0x1p300 || of->hi[0] < 0x1p-300;
        for (uint64_t i = 0; i <= lines / (slow ? 20 : 1); i++) {
            cylint_line line;
            scene_line(of, (enum scene_lines)kind, check_seed(), number + i,
                       &line);
            check_line(of, scene, &line);
        }
    }
    cylint_use_kernels(NULL);
}

static void check_points(const struct scene_shapes *of, uint64_t number,
                         uint64_t points)
{
    stream = check_seed() + number;
    OWN_SCENE *scene = open_scene(of, 1);
    for (int where = 0; scene && where < PLACES; where++)
        for (uint64_t i = 0; i < points; i++) {
            double point[3];
            point_of(of, (enum place)where, point);
            check_point(of, scene, point);
        }
}

/* A loop takes far longer where doubles cannot decide, and for points. */
TEST(generated_scenes_answer_as_a_loop)
{
    const uint64_t lines = check_setting("CYLINT_CASES", LINES);
    for (int kind = 0; kind < SCENE_KINDS; kind++) {
        OWN_SHAPES of = scene_generate(
            kind, scene_is_slow(kind) ? SHAPES / 30 : SHAPES, check_seed());
        OWN_SHAPES few = scene_generate(kind, NEAR, check_seed());
        check_lines(&of, (uint64_t)kind, lines);
        check_points(&few, (uint64_t)kind, 1 + lines / 200);
        for (size_t n = 1; n <= 66; n += n < 10 ? 1 : 14) {
            OWN_SHAPES small = scene_generate(kind, n, check_seed());
            check_lines(&small, n, 0);
            check_points(&small, n, 1);
        }
    }
    CHECK(n_hit > n_lines / 10 && n_near > n_points && n_inside > 10);
}

/* Nearly parallel shapes of the length 1 that begin within `width` of 0: each has
 * several boxes, and more of them are found than the set of a query holds. */
static void fill_bundle(struct scene_shapes *of, double width)
{
    for (size_t i = 0; i < of->n; i++) {
        const double r = between(0.002, 0.006);
        double p[3], q[3], h[3], a[3] = {r, 0, 0.3 * r}, b[3] = {0, 2 * r, 0};
        for (int j = 0; j < 3; j++) {
            p[j] = width * between(-0.5, 0.5);
            h[j] = between(0.6, 0.7);
            q[j] = p[j] + h[j];
        }
        cylint_shape *s = &of->shapes[i];
        if (i % 4 == 0)
            cylint_cylinder(s, p, q, r, CYLINT_ENDS_CAPPED);
        else if (i % 4 == 1)
            cylint_cone(s, p, r, q, 0, CYLINT_ENDS_OPEN);
        else if (i % 4 == 2)
            cylint_round_cone(s, p, r, q, 2 * r, CYLINT_ENDS_CAPPED);
        else
            cylint_elliptic_cone(s, p, a, b, h, 0.5, CYLINT_ENDS_CAPPED);
    }
}

enum { BUNDLED = 700 };

TEST(shapes_of_many_slices_count_once)
{
    static cylint_shape shapes[BUNDLED];
    struct scene_shapes of = {.name = "bundle", .shapes = shapes, .n = BUNDLED};
    most_found = 0;
    for (int k = 0; k < 18; k++) {
        static const double widths[] = {0.002, 0.05, 0.0005};
        fill_bundle(&of, widths[k % 3] * (1 + k / 3));
        OWN_SCENE *scene = open_scene(&of, 1);
        for (int i = 0; i < 15; i++) {
            cylint_line line;
            double p[3], q[3];
            const double along = between(0, 1);
            for (int j = 0; j < 3; j++) {
                p[j] = 0.2 * along + between(-0.005, 0.005);
                q[j] = between(-0.5, 0.5);
                q[j] = i % 2 ? q[j] : 0.65 + 0.1 * q[j];
            }
            CHECK(cylint_whole_line(&line, p, q) == CYLINT_OK);
            check_line(&of, scene, &line);
            for (int j = 0; j < 3; j++)
                p[j] =
                    0.65 * along * (i % 4 ? 0.1 : 1) + between(-0.001, 0.001);
            begin_point(&of, p);
            check_contains(&of, scene, p);
            for (int m = 0; m < 4 && i % 4 == 0; m++)
                check_radius(&of, scene, p, m == 3 ? -0.001 : 0.2 * m,
                             m == 2 ? 0 : CYLINT_SIGNED);
        }
    }
    CHECK(most_found > 250);
}

static double count_visit(void *context, size_t number, const cylint_hit *hit)
{
    ((unsigned char *)context)[number]++;
    return hit->t + 4;
}

static size_t traversals;

static size_t count_traversal(const cylint_bvh *bvh,
                              const cylint_bvh_line *line,
                              cylint_leaf_callback *callback, void *self)
{
    traversals++;
    return cylint_traversal_used()->all(bvh, line, callback, self);
}

/* Shapes of several slices, many more than one traversal finds beside a full table,
 * and balls, which are whole.  Beside the first traversal and a list, numbers that
 * follow each other are found as bits, others again as a list.  So the time grows
 * as the number of shapes. */
TEST(few_traversals_find_a_hundred_thousand_shapes_once)
{
    enum { ADDED = 3400, TIMES = 160, DENSE = 40 * ADDED, APART = 200 };
    enum { FOUND = DENSE + (TIMES - 40) * (ADDED / APART) };
    static const double p[3] = {0, 0, 0}, q[2][3] = {{8, 8, 8}, {9, 9, 9}},
                        inside[3] = {3, 3, 3};
    static cylint_shape all[ADDED], few[ADDED];
    static size_t hit[FOUND + 1], near[FOUND + 1];
    static unsigned char visits[ADDED * TIMES];
    cylint_traversal counting = *cylint_traversal_used();
    cylint_line line;
    counting.all = count_traversal;
    for (int i = 0; i < ADDED; i++) {
        if (i % 9 == 0)
            cylint_sphere(&all[i], (double[]){2, 2, 2}, 3, CYLINT_ENDS_CAPPED);
        else
            cylint_cylinder(&all[i], p, q[i % 2], 0.02, CYLINT_ENDS_CAPPED);
        cylint_sphere(&few[i], (double[]){5, 1, 1}, 0.5, CYLINT_ENDS_CAPPED);
        if (i % APART == 0)
            few[i] = all[i];
    }
    OWN_SCENE *scene = cylint_scene_begin(0);
    for (int i = 0; i < TIMES; i++)
        CHECK(cylint_scene_add(scene, i < 40 ? all : few, ADDED) ==
              CYLINT_SCENE_OK);
    CHECK(cylint_scene_finish(scene, 1, NULL, NULL) == CYLINT_SCENE_OK);
    cylint_ray(&line, (double[]){1, 0, 1}, (double[]){0, 1, 0});
    CHECK(cylint_scene_count(scene, &line, 0) == FOUND &&
          cylint_scene_count(scene, &line, FOUND - 1) == FOUND - 1 &&
          cylint_scene_count(scene, &line, DENSE / 2) == DENSE / 2 &&
          cylint_scene_contains(scene, inside, 0) == FOUND &&
          cylint_scene_within(scene, line.o, 1, 0, 0, near, NULL, FOUND + 1) ==
              FOUND);
    cylint_scene_visit(scene, &line, CYLINT_WANT_T, count_visit, visits);
    scene->traversal = &counting;
    CHECK(cylint_scene_all(scene, &line, 0, hit, FOUND + 1) == FOUND &&
          traversals == 5);
    for (size_t i = 0; i < FOUND; i++) {
        const size_t due = i < DENSE ? i : DENSE + (i - DENSE) * APART;
        CHECK(hit[i] == due && near[i] == due && visits[due] == 1);
    }
}

/* ------------------------------------------------------------ contracts -- */

TEST(an_empty_scene_has_no_answers)
{
    const struct scene_shapes none = {.name = "empty"};
    const double o[3] = {0, 0, 0}, d[3] = {1, 2, 3};
    OWN_SCENE *scene = open_scene(&none, 1);
    cylint_line line;
    cylint_ray(&line, o, d);
    check_line(&none, scene, &line);
    begin_point(&none, d);
    for (unsigned i = 0; i < 2; i++)
        check_radius(&none, scene, d, HUGE_VAL, i ? CYLINT_SIGNED : 0);
    check_contains(&none, scene, d);
    CHECK(cylint_scene_bytes(scene) > 0);
    cylint_scene_free(NULL);
}

TEST(a_bad_point_or_radius_has_no_shape)
{
    static const double radii[] = {NAN, -1, -5e-324, -HUGE_VAL};
    static const double wrong[] = {NAN, HUGE_VAL, -HUGE_VAL};
    static const double good[3] = {0, 0, 0};
    cylint_closest a;
    size_t number;
    double distance;
    OWN_SHAPES of = scene_generate(SCENE_UNBOUNDED, 100, check_seed());
    OWN_SCENE *scene = open_scene(&of, 1);
    for (int i = 0; i < 26; i++) {
        const unsigned want = i % 2 ? CYLINT_SIGNED : 0;
        double p[3] = {0, 0, 0}, radius = HUGE_VAL;
        if (i < 18)
            p[i / 6] = wrong[i / 2 % 3];
        else
            radius = radii[(i - 18) / 2];
        if (want && radius < 0 && radius > -HUGE_VAL)
            continue; /* selects the shapes in which the point is so deep */
        CHECK(cylint_scene_closest(scene, p, radius, want, &a) == of.n);
        CHECK(cylint_scene_within_count(scene, p, radius, want, 0) == 0);
        CHECK(cylint_scene_within(scene, p, radius, want, 0, &number, &distance,
                                  1) == 0);
        CHECK(i >= 18 || cylint_scene_contains(scene, p, 0) == 0);
    }
    CHECK(cylint_scene_within(scene, good, HUGE_VAL, 0, 0, NULL, NULL, 0) == 0);
}

/* The case of cylint_scene(3), section Overlapping shapes. */
TEST(the_nearest_surface_may_lie_inside_another_shape)
{
    const cylint_shape shapes[2] = {shape_of("sphere 0 0 0 10"),
                                    shape_of("capsule 0 0 0  30 0 0  1")};
    const double p[3] = {0, 3, 0};
    cylint_closest near;
    OWN_SCENE *scene = cylint_scene_new(shapes, 2, 1, NULL);
    CHECK(cylint_scene_closest(scene, p, HUGE_VAL, 0, &near) == 1 &&
          near.distance == 2);
    CHECK(cylint_contains(&shapes[0], p) == 1 &&
          cylint_distance(&shapes[0], p, 0, &near) == -7);
    CHECK(cylint_scene_closest(scene, p, HUGE_VAL, CYLINT_SIGNED, &near) == 0 &&
          near.distance == -7);
    CHECK(cylint_scene_contains(scene, p, 0) == 1);
}

/* A visit that ends after some calls, or returns a bound below the one before. */
struct visit {
    struct found seen;
    double bound;
    size_t most;
    const cylint_scene *scene; /* NULL, or one that is queried at each hit */
};

static double next_bound(struct visit *v, size_t number, double at)
{
    add_found(&v->seen, number, at);
    return v->seen.n == v->most ? (double)NAN : v->bound;
}

static double visit_hit(void *context, size_t number, const cylint_hit *hit)
{
    struct visit *v = context;
    cylint_closest answer;
    if (v->scene) {
        CHECK(cylint_scene_closest(v->scene, hit->point, HUGE_VAL, 0, &answer) <
              cylint_scene_size(v->scene));
        CHECK(fabs(answer.distance) < 1e-12);
    }
    return next_bound(v, number, hit ? hit->t : (double)NAN);
}

static double visit_near(void *context, size_t number, double distance,
                         int flags)
{
    (void)flags;
    return next_bound(context, number, fabs(distance));
}

/* Whether all shapes of x up to `bound` are shapes of y. */
static int has_all(const struct found *y, const struct found *x, double bound)
{
    for (size_t i = 0; i < x->n; i++) {
        size_t k = 0;
        while (k < y->n && y->number[k] != x->number[i])
            k++;
        if (k == y->n && x->at[i] <= bound)
            return 0;
    }
    return 1;
}

TEST(a_callback_may_shorten_or_end_a_visit_or_query_the_scene)
{
    /* none of these is a member of a hit */
    static const unsigned no_members[] = {0, CYLINT_WANT_NEAREST,
                                          CYLINT_SIGNED};
    int visited = 0;
    for (uint64_t i = 0; i < 600; i++) {
        static struct visit all, one, less, again, unwanted;
        const unsigned none = no_members[i % 3];
        cylint_line line;
        cylint_hit hit;
        cylint_closest near;
        OWN_SHAPES of =
            scene_generate(i % 2 ? SCENE_STRANDS : SCENE_FAT, 100, i);
        OWN_SCENE *scene = open_scene(&of, 1);
        scene_line(&of, LINES_RANDOM, check_seed(), i, &line);
        if (cylint_scene_nearest(scene, &line, CYLINT_WANT_T, &hit) == of.n)
            continue;
        all = one = less = again = unwanted = (struct visit){.bound = HUGE_VAL};
        one.most = 1;
        less.bound = hit.t;
        again.scene = scene;
        cylint_scene_visit(scene, &line, CYLINT_WANT_T, visit_hit, &all);
        cylint_scene_visit(scene, &line, CYLINT_WANT_T, visit_hit, &one);
        cylint_scene_visit(scene, &line, CYLINT_WANT_POINT, visit_hit, &again);
        cylint_scene_visit(scene, &line, none, visit_hit, &unwanted);
        CHECK(one.seen.n == 1 && again.seen.n == all.seen.n &&
              unwanted.seen.n == all.seen.n &&
              unwanted.seen.at[0] != unwanted.seen.at[0]);
        cylint_scene_visit(scene, &line, i % 4 < 2 ? CYLINT_WANT_T : none,
                           visit_hit, &less);
        CHECK(less.seen.n <= all.seen.n &&
              has_all(&less.seen, &all.seen, hit.t));
        one.seen.n = less.seen.n = all.seen.n = 0;
        cylint_scene_closest(scene, line.o, HUGE_VAL, 0, &near);
        less.bound = fabs(near.distance);
        cylint_scene_visit_point(scene, line.o, HUGE_VAL, 0, visit_near, &all);
        cylint_scene_visit_point(scene, line.o, HUGE_VAL, 0, visit_near, &one);
        cylint_scene_visit_point(scene, line.o, HUGE_VAL, 0, visit_near, &less);
        CHECK(one.seen.n == 1 && less.seen.n < all.seen.n &&
              has_all(&less.seen, &all.seen, less.bound));
        visited++;
    }
    CHECK(visited > 60);
}

/* Of circular and round shapes, whose distances are correctly rounded. */
TEST(points_have_the_same_answers_in_every_environment)
{
    static const int kinds[] = {SCENE_THIN, SCENE_LATTICE, SCENE_ROUND};
    static struct point_answers want, got;
    EACH_ENVIRONMENT(there)
        for (int k = 0; k < 3 * PLACES; k++) {
            double point[3];
            OWN_SHAPES of = scene_generate(kinds[k % 3], 40, check_seed());
            OWN_SCENE *scene = open_scene(&of, 1);
            point_of(&of, (enum place)(k / 3), point);
            for (int i = 0; i < 2; i++) {
                const unsigned members = i ? 0 : CYLINT_SIGNED;
                point_in_scene(scene, point, 2, members, &want);
                const size_t holding = cylint_scene_contains(scene, point, 0);
                environment_set(there);
                point_in_scene(scene, point, 2, members, &got);
                const size_t in = cylint_scene_contains(scene, point, 0);
                environment_reset();
                if (!CHECK(in == holding && same_point_answers(&want, &got)))
                    REPORT("point %a %a %a  # scene %s", point[0], point[1],
                           point[2], of.name);
            }
        }
}

/* Round needles of which an end is thinner than a leaf's step, in every octant. */
static void make_needles(cylint_shape shape[8], double tip)
{
    for (int i = 0; i < 8; i++) {
        const double p0[3] = {i, 0, 0};
        const double p1[3] = {i + (i & 1 ? tip : -tip), i & 2 ? tip : -tip,
                              i & 4 ? tip : -tip};
        cylint_round_cone(&shape[i], p0, 0.25, p1, 0, CYLINT_ENDS_CAPPED);
    }
}

TEST(a_scene_made_in_any_environment_finds_its_shapes)
{
    EACH_ENVIRONMENT(there)
        for (double tip = 0x1p7; tip < 0x1p60; tip *= 0x1p3) {
            cylint_shape shape[8];
            make_needles(shape, tip);
            environment_set(there);
            OWN_SCENE *scene = cylint_scene_new(shape, 8, 1, NULL);
            environment_reset();
            for (int i = 0; i < 64; i++) {
                const double angle = 0.1 * i, o[3] = {i / 8, 0, 0};
                const double to[3] = {0.2 * cos(angle), 0.2 * sin(angle),
                                      i % 3 ? 0.01 : -0.1};
                const double from[3] = {o[0] + 3 * to[0], 3 * to[1], 3 * to[2]};
                const double d[3] = {-to[0], -to[1], -to[2]};
                size_t hit = 0;
                cylint_line line;
                cylint_span(&line, from, d, 0, 3);
                for (int k = 0; k < 8; k++)
                    hit += cylint_occluded(&shape[k], &line) != 0;
                if (!CHECK(cylint_scene_count(scene, &line, 0) == hit))
                    REPORT("tip %a, line %d", tip, i);
            }
        }
}

TEST(every_status_has_its_text)
{
    static const char *const texts[] = {
        [CYLINT_SCENE_OK] = "no error",
        [CYLINT_SCENE_EMEMORY] = "out of memory",
        [CYLINT_SCENE_ESIZE] = "no such shape or solid, or more than 2^28",
        [CYLINT_SCENE_ESTOPPED] = "stopped by a function of the caller",
        [CYLINT_SCENE_EFINISHED] = "the scene is finished already",
        [CYLINT_SCENE_EUNFINISHED] = "the scene is not finished",
        [CYLINT_SCENE_EFILE] = "the file cannot be read or written",
        [CYLINT_SCENE_EFORMAT] = "not a saved scene",
        [CYLINT_SCENE_EVERSION] =
            "the file is of another version or machine: make it again",
        [CYLINT_SCENE_EDAMAGED] = "the file is damaged",
        [CYLINT_SCENE_EOPENED] = "the shapes of an opened scene do not change",
        [CYLINT_SCENE_EREPLACE] =
            "a shape cannot take the place of the one before: make a new "
            "scene",
        "a member of a solid has no clause, or two solids have the same "
        "number"};
    check_texts(cylint_scene_strerror, texts, sizeof texts / sizeof *texts);
}

int main(void)
{
    const int failed = check_all();
    printf("note: %zu lines, %zu of them hit; %zu points, %zu of them inside\n",
           n_lines, n_hit, n_points, n_inside);
    return failed;
}
