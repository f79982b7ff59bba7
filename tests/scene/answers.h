/*
 * answers.h - all answers about a line or a point: of a loop over all shapes,
 * and of a scene
 */
#ifndef CYLINT_SCENE_ANSWERS_H
#define CYLINT_SCENE_ANSWERS_H

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "cylint_scene.h"
#include "draw.h"
#include "same.h"
#include "scenes.h"

enum { LISTED = 2000 };

/* Shapes, ascending, and the t of their first hits or their distances. */
struct found {
    size_t n, number[LISTED];
    double at[LISTED];
};

struct line_answers {
    struct found hit;
    /* without no shape, without the nearest one, without the one of least number */
    size_t nearest[3];
    cylint_hit first[3];
    int occluded[3];
    size_t up_to_three, chords;
    cylint_piece chord[LISTED];
};

struct point_answers {
    struct found near;
    size_t up_to_three, nearest;
    cylint_closest closest;
};

static inline void add_found(struct found *to, size_t number, double at)
{
    if (to->n < LISTED) {
        to->number[to->n] = number;
        to->at[to->n++] = at;
    }
}

static inline int same_found(const struct found *x, const struct found *y)
{
    return x->n == y->n &&
           same_bytes(x->number, y->number, x->n * sizeof *x->number) &&
           same_bytes(x->at, y->at, x->n * sizeof *x->at);
}

static inline int same_piece(const cylint_piece *x, const cylint_piece *y)
{
    return same_double(x->t0, y->t0) && same_double(x->t1, y->t1) &&
           x->shape == y->shape && x->depth == y->depth;
}

static inline int same_pieces(const cylint_piece *x, size_t n,
                              const cylint_piece *y, size_t m)
{
    int same = n == m;
    for (size_t i = 0; i < n && same; i++)
        same = same_piece(&x[i], &y[i]);
    return same;
}

static inline int same_line_answers(const struct line_answers *x,
                                    const struct line_answers *y)
{
    return same_found(&x->hit, &y->hit) &&
           same_pieces(x->chord, x->chords, y->chord, y->chords) &&
           same_bytes(x->nearest, y->nearest, sizeof x->nearest) &&
           same_bytes(x->first, y->first, sizeof x->first) &&
           same_bytes(x->occluded, y->occluded, sizeof x->occluded) &&
           x->up_to_three == y->up_to_three;
}

static inline int same_point_answers(const struct point_answers *x,
                                     const struct point_answers *y)
{
    return same_found(&x->near, &y->near) && x->nearest == y->nearest &&
           x->up_to_three == y->up_to_three &&
           same_bytes(&x->closest, &y->closest, sizeof x->closest);
}

/* ----------------------------------------------------------------- lines -- */

static inline void begin_line_answers(struct line_answers *a)
{
    a->hit.n = a->chords = 0;
    memset(a->first, UNTOUCHED, sizeof a->first);
}

/* The shapes that are left out. */
static inline size_t left_out(const struct line_answers *a, int k, size_t n)
{
    return k == 0 || a->hit.n == 0 ? n
           : k == 1                ? a->nearest[0]
                                   : a->hit.number[0];
}

static inline int by_begin(const void *a, const void *b)
{
    const cylint_piece *x = a, *y = b;
    return x->t0 != y->t0 ? (x->t0 > y->t0) - (x->t0 < y->t0)
                          : (x->shape > y->shape) - (x->shape < y->shape);
}

static inline void line_by_loop(const cylint_shape *shapes, size_t n,
                                const cylint_line *line, struct line_answers *a)
{
    begin_line_answers(a);
    for (size_t i = 0; i < n; i++) {
        cylint_answer x;
        cylint_interval chord[2];
        if (cylint_intersect(&shapes[i], line,
                             CYLINT_WANT_T | CYLINT_WANT_NEAREST, &x))
            add_found(&a->hit, i, x.hit[0].t);
        const int chords =
            line->in_range ? cylint_chord(&shapes[i], line, chord) : 0;
        for (int k = 0; k < chords && a->chords < LISTED; k++)
            a->chord[a->chords++] =
                (cylint_piece){chord[k].t0, chord[k].t1, i, 1};
    }
    qsort(a->chord, a->chords, sizeof *a->chord, by_begin);
    a->up_to_three = a->hit.n < 3 ? a->hit.n : 3;
    for (int k = 0; k < 3; k++) {
        const size_t except = left_out(a, k, n);
        size_t nearest = n;
        double t = 0;
        for (size_t i = 0; i < a->hit.n; i++)
            if (a->hit.number[i] != except &&
                (nearest == n || a->hit.at[i] < t)) {
                nearest = a->hit.number[i];
                t = a->hit.at[i];
            }
        a->nearest[k] = nearest;
        a->occluded[k] = nearest < n;
        if (nearest == n)
            continue;
        cylint_answer x;
        memset(&x, UNTOUCHED, sizeof x);
        cylint_intersect(&shapes[nearest], line, EVERY_WANT, &x);
        a->first[k] = x.hit[0];
    }
}

/* Whether a query for the nearest of n shapes, with these members, returned that of
 * the loop.  Without one, the hit keeps its bytes. */
static inline int is_nearest_of(size_t n, size_t number, const cylint_hit *hit,
                                unsigned want, const struct line_answers *a)
{
    const cylint_hit due = with_members(&a->first[0], number < n ? want : 0);
    return number == a->nearest[0] && same_hit(hit, &due, EVERY_WANT);
}

/* Whether the nearest shape, with these members, and counts are the loop's. */
static inline int pack_agrees(const cylint_pack *pack, const cylint_line *line,
                              unsigned want, const struct line_answers *a)
{
    cylint_hit hit;
    memset(&hit, UNTOUCHED, sizeof hit);
    const size_t number = cylint_nearest(pack, line, want, &hit);
    int same = is_nearest_of(pack->n, number, &hit, want, a);
    for (size_t enough = 0; enough < 4; enough++)
        same &= cylint_count(pack, line, enough) ==
                (enough && enough < a->hit.n ? enough : a->hit.n);
    return same;
}

static inline double take_hit(void *context, size_t number,
                              const cylint_hit *hit)
{
    add_found(context, number, hit->t);
    return HUGE_VAL;
}

static inline void sort_found(struct found *f)
{
    for (size_t i = 1; i < f->n; i++)
        for (size_t j = i; j > 0 && f->number[j - 1] > f->number[j]; j--) {
            const size_t number = f->number[j];
            const double at = f->at[j];
            f->number[j] = f->number[j - 1];
            f->at[j] = f->at[j - 1];
            f->number[j - 1] = number;
            f->at[j - 1] = at;
        }
}

/* Takes the shapes from a visit.  Lists of all of them, and of a third at a time,
 * must hold the same ones. */
static inline void line_in_scene(const cylint_scene *scene,
                                 const cylint_line *line,
                                 struct line_answers *a)
{
    static double memory[1 << 17];
    static size_t number[2 * LISTED];
    const cylint_piece_rule rule = {.mode = CYLINT_PIECES_CHORDS};
    cylint_workspace work = {memory, sizeof memory, 0};
    const size_t n = cylint_scene_size(scene);
    size_t first = 0, listed = 0, more;
    begin_line_answers(a);
    cylint_scene_visit(scene, line, CYLINT_WANT_T, take_hit, &a->hit);
    sort_found(&a->hit);
    const size_t some = a->hit.n / 3 + 1;
    CHECK(cylint_scene_count(scene, line, 0) == a->hit.n);
    CHECK(cylint_scene_all(scene, line, 0, number, LISTED) == a->hit.n &&
          same_bytes(number, a->hit.number, a->hit.n * sizeof *number));
    do {
        more = cylint_scene_all(scene, line, first, number + listed, some);
        listed += more;
        first = more ? number[listed - 1] + 1 : 0;
    } while (more == some && listed < LISTED);
    CHECK(listed == a->hit.n &&
          same_bytes(number, a->hit.number, listed * sizeof *number));
    a->up_to_three = cylint_scene_count(scene, line, 3);
    a->nearest[0] =
        cylint_scene_nearest(scene, line, CYLINT_WANT_ALL, &a->first[0]);
    for (int k = 0; k < 3; k++) {
        const size_t except = left_out(a, k, n);
        if (k > 0)
            a->nearest[k] = cylint_scene_nearest_other(
                scene, line, except, CYLINT_WANT_ALL, &a->first[k]);
        a->occluded[k] = cylint_scene_occluded(scene, line, except);
    }
    if (line->in_range) /* others take exact numbers for each shape */
        a->chords =
            cylint_scene_pieces(scene, line, &rule, a->chord, LISTED, &work);
}

/* ---------------------------------------------------------------- points -- */

static inline double compared(double distance, unsigned want)
{
    return want & CYLINT_SIGNED ? distance : fabs(distance);
}

/* The distances that are compared, of all shapes; NaN if there is no surface.
 * want: 0 or CYLINT_SIGNED. */
static inline void all_distances(const cylint_shape *shapes, size_t n,
                                 const double point[3], unsigned want,
                                 double distance[LISTED])
{
    for (size_t i = 0; i < n; i++) {
        cylint_closest x = {.part = 0};
        const double d = cylint_distance(&shapes[i], point, want, &x);
        distance[i] = x.part < 0 ? (double)NAN : compared(d, want);
    }
}

static inline void point_by_loop(const cylint_shape *shapes, size_t n,
                                 const double distance[LISTED],
                                 const double point[3], double radius,
                                 unsigned want, struct point_answers *a)
{
    a->near.n = 0;
    a->nearest = n;
    for (size_t i = 0; i < n; i++)
        if (distance[i] <= radius) {
            add_found(&a->near, i, distance[i]);
            if (a->nearest == n || distance[i] < distance[a->nearest])
                a->nearest = i;
        }
    a->up_to_three = a->near.n < 3 ? a->near.n : 3;
    memset(&a->closest, UNTOUCHED, sizeof a->closest);
    if (a->nearest < n)
        cylint_distance(&shapes[a->nearest], point, CYLINT_WANT_ALL | want,
                        &a->closest);
}

struct visit_of_point {
    struct found *to;
    unsigned want;
    double radius;
};

static inline double take_near(void *context, size_t number, double distance,
                               int flags)
{
    const struct visit_of_point *v = context;
    CHECK(flags == 0);
    add_found(v->to, number, compared(distance, v->want));
    return v->radius;
}

static inline void point_in_scene(const cylint_scene *scene,
                                  const double point[3], double radius,
                                  unsigned want, struct point_answers *a)
{
    static size_t number[2 * LISTED];
    static double distance[2 * LISTED];
    struct visit_of_point visit = {&a->near, want, radius};
    size_t first = 0, listed = 0, more;
    a->near.n = 0;
    cylint_scene_visit_point(scene, point, radius, want, take_near, &visit);
    sort_found(&a->near);
    const size_t some = a->near.n / 3 + 1;
    do {
        more = cylint_scene_within(scene, point, radius, want, first,
                                   number + listed, distance + listed, some);
        listed += more;
        first = more ? number[listed - 1] + 1 : 0;
    } while (more == some && listed < LISTED);
    for (size_t i = 0; i < listed; i++)
        distance[i] = compared(distance[i], want);
    CHECK(listed == a->near.n &&
          same_bytes(number, a->near.number, listed * sizeof *number) &&
          same_bytes(distance, a->near.at, listed * sizeof *distance));
    CHECK(cylint_scene_within(scene, point, radius, want, 0, number, NULL,
                              LISTED) == a->near.n);
    CHECK(cylint_scene_within_count(scene, point, radius, want, 0) ==
          a->near.n);
    a->up_to_three = cylint_scene_within_count(scene, point, radius, want, 3);
    memset(&a->closest, UNTOUCHED, sizeof a->closest);
    a->nearest = cylint_scene_closest(scene, point, radius,
                                      CYLINT_WANT_ALL | want, &a->closest);
}

/* Of points in the box of a scene and around it. */
static inline void point_about(const struct scene_shapes *of, double point[3])
{
    for (int j = 0; j < 3; j++)
        point[j] = of->lo[j] + (of->hi[j] - of->lo[j]) * between(-0.25, 1.25);
}

/* ---------------------------------------------------------- two scenes --- */

static inline int same_shapes(const cylint_scene *x, const cylint_scene *y)
{
    const size_t n = cylint_scene_size(x);
    int same = cylint_scene_size(y) == n;
    for (size_t i = 0; i < n && same; i++) {
        cylint_shape first, second;
        memset(&first, 0, sizeof first);
        memset(&second, 0, sizeof second);
        cylint_scene_shape(x, i, &first);
        cylint_scene_shape(y, i, &second);
        same = same_bytes(&first, &second, sizeof first);
    }
    return same;
}

/* Returns the number of questions whose answers differ. */
static inline int differences(const cylint_scene *x, const cylint_scene *y,
                              const struct scene_shapes *of, uint64_t seed)
{
    enum { LINES_OF_A_KIND = 3, POINTS = 8 };
    static struct line_answers line_x, line_y;
    static struct point_answers point_x, point_y;
    int wrong = !same_shapes(x, y);
    for (int i = 0; i < LINES_KINDS * LINES_OF_A_KIND; i++) {
        cylint_line line;
        if (i % LINES_KINDS == LINES_WILD && i >= LINES_KINDS)
            continue; /* exact signs of all shapes */
        scene_line(of, (enum scene_lines)(i % LINES_KINDS), seed,
                   (uint64_t)(i / LINES_KINDS), &line);
        line_in_scene(x, &line, &line_x);
        line_in_scene(y, &line, &line_y);
        wrong += !same_line_answers(&line_x, &line_y);
    }
    for (int i = 0; i < POINTS; i++) {
        double point[3];
        point_about(of, point);
        const double radius = 0.2 * longest_side(of);
        const unsigned want = i % 2 ? CYLINT_SIGNED : 0;
        point_in_scene(x, point, radius, want, &point_x);
        point_in_scene(y, point, radius, want, &point_y);
        wrong += !same_point_answers(&point_x, &point_y);
    }
    return wrong;
}

#endif
