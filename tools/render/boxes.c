/*
 * boxes.c - the boxes of a scene's bounded solids
 */
#include <stdlib.h>

#include "view.h"
#include "scene.h"

static const struct box NOWHERE = {{{HUGE_VAL, HUGE_VAL, HUGE_VAL}},
                                   {{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}}};
static const struct box EVERYWHERE = {{{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}},
                                      {{HUGE_VAL, HUGE_VAL, HUGE_VAL}}};

static int is_bounded(const struct box *box)
{
    for (int i = 0; i < 3; i++)
        if (!(box->low.v[i] <= box->high.v[i] &&
              box->high.v[i] - box->low.v[i] < HUGE_VAL))
            return 0;
    return 1;
}

typedef double limit(double, double);

/* fmin, fmax: the box encloses the other one; fmax, fmin: it is cut by it. */
static void combine(struct box *box, const struct box *other, limit *low,
                    limit *high)
{
    for (int k = 0; k < 3; k++) {
        box->low.v[k] = low(box->low.v[k], other->low.v[k]);
        box->high.v[k] = high(box->high.v[k], other->high.v[k]);
    }
}

static void measure_all(struct boxes *boxes)
{
    struct box all = NOWHERE;
    for (size_t i = 0; i < boxes->count; i++)
        combine(&all, &boxes->box[i], fmin, fmax);
    boxes->middle = mixed(all.low, all.high, 0.5);
    boxes->size = length(minus(all.high, all.low));
}

static struct box box_of_shape(const struct scene *scene, size_t number)
{
    struct box box = NOWHERE;
    cylint_shape shape;
    cylint_scene_shape(scene->shapes, number, &shape);
    cylint_bounds(&shape, box.low.v, box.high.v);
    return box;
}

static void add_box(struct boxes *boxes, const struct box *box)
{
    if (is_bounded(box))
        boxes->box[boxes->count++] = *box;
}

/* ------------------------------------------------------------- solids -- */

/* The box of the clause that begins with member `first`; complements have no box.
 * Returns the number of the next member. */
static size_t box_of_clause(const struct scene *scene, const cylint_member *m,
                            size_t count, size_t first, struct box *box)
{
    size_t i = first;
    *box = NOWHERE;
    for (; i < count && m[i].solid == m[first].solid &&
           abs(m[i].clause) == abs(m[first].clause);
         i++) {
        const struct box one =
            m[i].clause > 0 ? box_of_shape(scene, m[i].shape) : EVERYWHERE;
        combine(box, &one, fmin, fmax);
    }
    return i;
}

static void add_solids(struct boxes *boxes, const struct scene *scene,
                       const cylint_member *m, size_t count)
{
    for (size_t i = 0; i < count;) {
        const size_t solid = m[i].solid;
        struct box box = EVERYWHERE, clause;
        while (i < count && m[i].solid == solid) {
            i = box_of_clause(scene, m, count, i, &clause);
            combine(&box, &clause, fmax, fmin);
        }
        add_box(boxes, &box);
    }
}

/* A box for each solid, and for each shape that is in no solid. */
static void add_all(struct boxes *boxes, const struct scene *scene,
                    char *is_member)
{
    const struct solids *s = &scene->solids;
    for (size_t i = 0; i < s->count; i++)
        is_member[s->member[i].shape] = 1;
    for (size_t i = 0; i < scene->count; i++) {
        if (!is_member[i]) {
            const struct box box = box_of_shape(scene, i);
            add_box(boxes, &box);
        }
    }
    if (s->count > 0) {
        qsort(s->member, s->count, sizeof *s->member, compare_by_solid);
        add_solids(boxes, scene, s->member, s->count);
    }
    if (boxes->count > 0)
        measure_all(boxes);
}

int boxes_make(struct boxes *boxes, const struct scene *scene)
{
    const size_t most = scene->count + scene->solids.count + 1;
    char *is_member = calloc(scene->count + 1, 1);
    *boxes = (struct boxes){.box = calloc(most, sizeof *boxes->box)};
    const int has_memory = is_member && boxes->box;
    if (has_memory)
        add_all(boxes, scene, is_member);
    free(is_member);
    return has_memory ? 0 : out_of_memory();
}

void boxes_free(struct boxes *boxes)
{
    free(boxes->box);
    boxes->box = NULL;
}

static double reach_of_box(struct vector direction, const struct box *box)
{
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        const double d = direction.v[i];
        sum += d * (d > 0 ? box->high.v[i] : box->low.v[i]);
    }
    return sum;
}

double reach(const struct boxes *boxes, struct vector direction)
{
    double most = -HUGE_VAL;
    for (size_t i = 0; i < boxes->count; i++)
        most = fmax(most, reach_of_box(direction, &boxes->box[i]));
    return most;
}
