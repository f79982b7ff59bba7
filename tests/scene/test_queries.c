/*
 * test_queries.c - floor scene: a scene returns what all its shapes return
 *
 * Every kind of line is traced through every kind of scene, and tested against
 * each shape in a batch.  Both must find the same shapes, the same nearest
 * shape and the same bits of its hit.  An argument sets the number of lines of
 * each kind for each scene (make check-scene).  CYLINT_SEED changes all random
 * numbers.
 */
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "cylint_scene.h"
#include "scenes.h"

enum { SHAPES = 1500, LINES = 60, THREADS = 8 };

static size_t lines_of_a_kind = LINES;

static uint64_t seed(void)
{
    return check_setting("CYLINT_SEED", 1);
}

static void *allocate(size_t bytes)
{
    void *p = malloc(bytes > 0 ? bytes : 1);
    if (!p)
        abort();
    return p;
}

/* ------------------------------------------------------------ one scene -- */

/* A scene, and its shapes in a pack. */
struct scene_and_pack {
    struct scene_shapes of;
    cylint_scene *scene;
    cylint_pack pack;
    void *memory;
    signed char *hits; /* of all shapes, by the batch */
    size_t *numbers;
};

static int open_both(struct scene_and_pack *a)
{
    cylint_scene_status status;
    a->scene = cylint_scene_new(a->of.shapes, a->of.n, 2, &status);
    a->memory = allocate(cylint_pack_bytes(a->of.n));
    cylint_pack_shapes(&a->pack, a->memory, a->of.shapes, a->of.n);
    a->hits = allocate(a->of.n);
    a->numbers = allocate(a->of.n * sizeof *a->numbers);
    return CHECK(a->scene && status == CYLINT_SCENE_OK);
}

static void close_both(struct scene_and_pack *a)
{
    cylint_scene_free(a->scene);
    free(a->memory);
    free(a->hits);
    free(a->numbers);
    scene_release(&a->of);
}

static void show_line(const struct scene_and_pack *a, const cylint_line *l,
                      const char *what, size_t got, size_t want)
{
    REPORT("scene %s, seed %llu, %s: %zu, by brute force %zu", a->of.name,
           (unsigned long long)seed(), what, got, want);
    if (l->segment)
        REPORT("segment %a %a %a  %a %a %a", l->o[0], l->o[1], l->o[2],
               l->end[0], l->end[1], l->end[2]);
    else
        REPORT("span %a %a %a  %a %a %a  %a %a", l->o[0], l->o[1], l->o[2],
               l->d[0], l->d[1], l->d[2], l->tmin, l->tmax);
}

static int same_hit(const cylint_hit *x, const cylint_hit *y)
{
    return memcmp(x, y, sizeof *x) == 0;
}

static void check_nearest(const struct scene_and_pack *a,
                          const cylint_line *line)
{
    cylint_hit got, want;
    memset(&got, 0x55, sizeof got);
    memset(&want, 0x55, sizeof want);
    const size_t i =
        cylint_scene_nearest(a->scene, line, CYLINT_WANT_ALL, &got);
    const size_t j = cylint_nearest(&a->pack, line, CYLINT_WANT_ALL, &want);
    if (!CHECK(i == j && same_hit(&got, &want))) {
        show_line(a, line, "nearest", i, j);
        if (i < a->of.n && j < a->of.n)
            REPORT("t %a, by brute force %a", got.t, want.t);
    }
}

/* All numbers again, three at a time. */
static void check_threes(const struct scene_and_pack *a,
                         const cylint_line *line)
{
    size_t first = 0, found, number[4] = {0, 0, 0, a->of.n};
    do {
        found = cylint_scene_all(a->scene, line, first, number, 3);
        for (size_t k = 0; k < found; k++) {
            while (first < a->of.n && a->hits[first] <= 0)
                first++;
            if (!CHECK(number[k] == first++))
                show_line(a, line, "all, by threes", number[k], first - 1);
        }
    } while (found == 3);
    while (first < a->of.n && a->hits[first] <= 0)
        first++;
    if (!CHECK(first == a->of.n && number[3] == a->of.n))
        show_line(a, line, "all, by threes, too few", a->of.n, first);
}

/* The nearest of the shapes that the line hits, the first `count` of a->numbers,
 * without one of them, or of all if it is none of them. */
static void check_nearest_other(const struct scene_and_pack *a,
                                const cylint_line *line, size_t count,
                                size_t except)
{
    size_t want = a->of.n;
    double t = 0;
    cylint_hit hit;
    for (size_t k = 0; k < count; k++) {
        cylint_answer answer;
        if (a->numbers[k] == except)
            continue;
        cylint_intersect(&a->of.shapes[a->numbers[k]], line,
                         CYLINT_WANT_T | CYLINT_WANT_NEAREST, &answer);
        if (want == a->of.n || answer.hit[0].t < t) {
            want = a->numbers[k];
            t = answer.hit[0].t;
        }
    }
    const size_t got =
        cylint_scene_nearest_other(a->scene, line, except, CYLINT_WANT_T, &hit);
    if (!CHECK(got == want && (got == a->of.n || hit.t == t)))
        show_line(a, line, "nearest other", got, want);
}

static void check_numbers(const struct scene_and_pack *a,
                          const cylint_line *line)
{
    cylint_columns columns = {0};
    size_t count = 0;
    columns.n = a->hits;
    cylint_intersect_shapes(&a->pack, line, &columns);
    for (size_t i = 0; i < a->of.n; i++)
        count += a->hits[i] > 0;
    const size_t all = cylint_scene_all(a->scene, line, 0, a->numbers, a->of.n);
    int same = all == count;
    for (size_t i = 0, k = 0; i < a->of.n && same; i++)
        same = a->hits[i] <= 0 || a->numbers[k++] == i;
    if (!CHECK(same))
        show_line(a, line, "all", all, count);
    const size_t first = count ? a->numbers[0] : a->of.n;
    cylint_hit hit;
    const size_t nearest = cylint_scene_nearest(a->scene, line, 0, &hit);
    check_nearest_other(a, line, all, nearest);
    check_nearest_other(a, line, all, first);
    check_threes(a, line);
    const size_t counted = cylint_scene_count(a->scene, line, 0);
    if (!CHECK(counted == count))
        show_line(a, line, "count", counted, count);
    const size_t any = cylint_scene_count(a->scene, line, 1);
    if (!CHECK(any == (count > 0)))
        show_line(a, line, "any", any, count > 0);
    CHECK(cylint_scene_occluded(a->scene, line, a->of.n) == (count > 0));
    CHECK(cylint_scene_occluded(a->scene, line, first) == (count > 1));
    const size_t three = cylint_scene_count(a->scene, line, 3);
    if (!CHECK(three == (count < 3 ? count : 3)))
        show_line(a, line, "three", three, count);
}

/* Brute force takes far longer where doubles cannot decide. */
static size_t shapes_of(int kind)
{
    struct scene_shapes few;
    double extreme = 0;
    if (!scene_generate(kind, 1, seed(), &few))
        return 0;
    extreme = fmax(fabs(few.lo[0]), fabs(few.hi[0]));
    scene_release(&few);
    return extreme < 1e-30 || extreme > 1e30 ? SHAPES / 30 : SHAPES;
}

static size_t lines_asked, lines_hit;

static void check_lines(const struct scene_and_pack *a)
{
    for (int kind = 0; kind < LINES_KINDS; kind++)
        for (size_t i = 0; i < lines_of_a_kind / (kind == LINES_WILD ? 10 : 1);
             i++) {
            cylint_line line;
            cylint_hit hit;
            scene_line(&a->of, (enum scene_lines)kind, seed(), i, &line);
            check_nearest(a, &line);
            check_numbers(a, &line);
            lines_asked++;
            lines_hit +=
                cylint_scene_nearest(a->scene, &line, 0, &hit) < a->of.n;
        }
}

static void generated_scenes_answer_as_brute_force(void)
{
    struct scene_and_pack a;
    for (int kind = 0; scene_generate(kind, shapes_of(kind), seed(), &a.of);
         kind++) {
        if (open_both(&a))
            check_lines(&a);
        close_both(&a);
    }
}

static void small_scenes_answer_as_brute_force(void)
{
    struct scene_and_pack a;
    for (size_t n = 1; n <= 20; n++)
        for (int kind = 0; scene_generate(kind, n, seed(), &a.of); kind++) {
            if (open_both(&a))
                for (int lines = 0; lines < LINES_KINDS; lines++) {
                    cylint_line line;
                    scene_line(&a.of, (enum scene_lines)lines, seed(), n,
                               &line);
                    check_nearest(&a, &line);
                    check_numbers(&a, &line);
                }
            close_both(&a);
        }
}

static void real_scenes_answer_as_brute_force(void)
{
    static const char *const real[][2] = {
        {"neuron", "awk '{ at[$1] = $3 \" \" $4 \" \" $5 \" \" $6 } at[$7] "
                   "{ print \"cone\", at[$1], at[$7] }' "
                   "../shared/data/medulla_7114.swc 2>/dev/null"},
        {"tree", "awk -F, 'NR > 1 { print \"cylinder\", $1, $2, $3, $4, $5, "
                 "$6, $10 }' ../shared/data/tree_archi.csv 2>/dev/null"},
    };
    const size_t usual = lines_of_a_kind;
    lines_of_a_kind = usual > LINES ? usual / 4 : usual / 2;
    for (size_t i = 0; i < sizeof real / sizeof real[0]; i++) {
        struct scene_and_pack a;
        if (!scene_from(real[i][0], real[i][1], &a.of)) {
            printf("note: no %s in ../shared/data\n", real[i][0]);
            continue;
        }
        if (open_both(&a))
            check_lines(&a);
        close_both(&a);
    }
    lines_of_a_kind = usual;
}

/* ------------------------------------------------------------ contracts -- */

static void an_empty_scene_is_never_hit(void)
{
    const double o[3] = {0, 0, 0}, d[3] = {1, 2, 3};
    cylint_scene *scene = cylint_scene_new(NULL, 0, 1, NULL);
    cylint_line line;
    cylint_hit hit;
    cylint_ray(&line, o, d);
    if (!CHECK(scene != NULL))
        return;
    CHECK(cylint_scene_nearest(scene, &line, CYLINT_WANT_ALL, &hit) == 0);
    CHECK(cylint_scene_count(scene, &line, 0) == 0);
    CHECK(cylint_scene_all(scene, &line, 0, NULL, 0) == 0);
    CHECK(cylint_scene_bytes(scene) > 0);
    cylint_scene_free(scene);
    cylint_scene_free(NULL);
}

static void unwanted_members_are_not_written(void)
{
    struct scene_and_pack a;
    scene_generate(0, 200, seed(), &a.of);
    if (open_both(&a))
        for (size_t i = 0; i < 40; i++)
            for (unsigned want = 0; want <= CYLINT_WANT_ALL; want++) {
                cylint_line line;
                cylint_hit got, by_batch;
                memset(&got, 0x55, sizeof got);
                memset(&by_batch, 0x55, sizeof by_batch);
                scene_line(&a.of, LINES_CAMERA, seed(), i, &line);
                cylint_scene_nearest(a.scene, &line, want, &got);
                cylint_nearest(&a.pack, &line, want, &by_batch);
                CHECK(same_hit(&got, &by_batch));
            }
    close_both(&a);
}

static void a_ray_that_begins_behind_a_hit_does_not_find_it(void)
{
    struct scene_and_pack a;
    size_t hits = 0;
    for (int kind = 0; scene_generate(kind, 500, seed(), &a.of); kind++) {
        if (open_both(&a))
            for (size_t i = 0; i < 200; i++) {
                cylint_line line;
                cylint_hit hit, next;
                if (scene_line(&a.of, LINES_RANDOM, seed(), i, &line))
                    continue;
                const size_t first =
                    cylint_scene_nearest(a.scene, &line, CYLINT_WANT_T, &hit);
                const double o[3] = {line.o[0], line.o[1], line.o[2]};
                const double d[3] = {line.d[0], line.d[1], line.d[2]};
                if (first == a.of.n ||
                    cylint_span(&line, o, d, nextafter(hit.t, HUGE_VAL),
                                HUGE_VAL))
                    continue;
                hits++;
                if (cylint_scene_nearest(a.scene, &line, CYLINT_WANT_T, &next) <
                    a.of.n)
                    CHECK(next.t > hit.t);
            }
        close_both(&a);
    }
    CHECK(hits > 500);
}

/* Long shapes have many boxes.  Lines along a bundle of nested tubes pass most
 * boxes of each tube, and hit more tubes than the query's hash table holds. */
static void a_shape_that_is_found_in_many_boxes_counts_once(void)
{
    enum { NESTED = 700 };
    struct scene_and_pack a = {.of = {.name = "nested", .n = NESTED}};
    a.of.shapes = allocate(NESTED * sizeof *a.of.shapes);
    for (int i = 0; i < NESTED; i++) {
        const double from[3] = {-30 - i * 0.0005, -30, -30};
        const double to[3] = {30, 30 + i * 0.0005, 30};
        cylint_cylinder(&a.of.shapes[i], from, to, 0.2 + 0.001 * i,
                        i % 2 ? CYLINT_ENDS_CAPPED : CYLINT_ENDS_OPEN);
    }
    if (open_both(&a))
        for (int i = 0; i < 40; i++) {
            cylint_line line;
            const double from[3] = {-50 + 0.01 * i, -50, -50};
            const double d[3] = {1, 1 + 0.0002 * i, 1};
            CHECK(cylint_whole_line(&line, from, d) == CYLINT_OK);
            check_numbers(&a, &line);
            check_nearest(&a, &line);
        }
    close_both(&a);
}

/* -------------------------------------------------------------- threads -- */

struct part {
    const struct scene_and_pack *both;
    uint64_t sum; /* checksum of all answers */
    pthread_t thread;
};

static void *answer_part(void *argument)
{
    struct part *p = argument;
    const struct scene_and_pack *a = p->both;
    for (int kind = 0; kind < LINES_KINDS; kind++)
        for (size_t i = 0; i < LINES; i++) {
            cylint_line line;
            cylint_hit hit;
            size_t numbers[16];
            uint64_t t = 0;
            scene_line(&a->of, (enum scene_lines)kind, seed(), i, &line);
            const size_t n =
                cylint_scene_nearest(a->scene, &line, CYLINT_WANT_T, &hit);
            if (n < a->of.n)
                memcpy(&t, &hit.t, sizeof t);
            p->sum = p->sum * 31 + n + t;
            p->sum = p->sum * 31 + cylint_scene_count(a->scene, &line, 2);
            p->sum =
                p->sum * 31 + cylint_scene_all(a->scene, &line, 0, numbers, 16);
        }
    return NULL;
}

static void threads_share_a_scene_with_the_same_answers(void)
{
    struct scene_and_pack a;
    struct part parts[THREADS];
    scene_generate(6, SHAPES, seed(), &a.of);
    if (open_both(&a)) {
        for (int i = 0; i < THREADS; i++) {
            parts[i] = (struct part){.both = &a};
            if (pthread_create(&parts[i].thread, NULL, answer_part,
                               &parts[i]) != 0)
                abort();
        }
        for (int i = 0; i < THREADS; i++)
            pthread_join(parts[i].thread, NULL);
        for (int i = 1; i < THREADS; i++)
            CHECK(parts[i].sum == parts[0].sum);
    }
    close_both(&a);
}

static void every_status_has_its_text(void)
{
    static const char *const texts[] = {
        [CYLINT_SCENE_OK] = "no error",
        [CYLINT_SCENE_EMEMORY] = "out of memory",
        [CYLINT_SCENE_ESIZE] = "more shapes than the scene can have",
        [CYLINT_SCENE_ESTOPPED] = "stopped by the progress function",
        [CYLINT_SCENE_EFINISHED] = "the scene is finished already",
        [CYLINT_SCENE_EUNFINISHED] = "the scene is not finished",
        [CYLINT_SCENE_EFILE] = "the file cannot be read or written",
        [CYLINT_SCENE_EFORMAT] = "not a file of a scene",
        [CYLINT_SCENE_EVERSION] =
            "the file is of another version or machine: make it again",
        [CYLINT_SCENE_EDAMAGED] = "the file is damaged",
        [CYLINT_SCENE_EOPENED] = "a scene that was opened does not change",
        [CYLINT_SCENE_EREPLACE] =
            "a shape cannot take the place of the one before: make a new "
            "scene",
        "a member of a solid has no clause, or two solids have the same "
        "number"};
    check_texts(cylint_scene_strerror, texts, sizeof texts / sizeof *texts);
}

int main(int argc, char **argv)
{
    if (argc > 1)
        lines_of_a_kind = strtoull(argv[1], NULL, 10);
    RUN(generated_scenes_answer_as_brute_force);
    RUN(small_scenes_answer_as_brute_force);
    RUN(real_scenes_answer_as_brute_force);
    RUN(an_empty_scene_is_never_hit);
    RUN(unwanted_members_are_not_written);
    RUN(a_ray_that_begins_behind_a_hit_does_not_find_it);
    RUN(a_shape_that_is_found_in_many_boxes_counts_once);
    RUN(threads_share_a_scene_with_the_same_answers);
    RUN(every_status_has_its_text);
    printf("note: %zu lines, %zu of them hit\n", lines_asked, lines_hit);
    return check_end();
}
