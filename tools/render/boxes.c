/*
 * boxes.c - the boxes of a scene's bounded shapes
 */
#include <stdint.h>
#include <stdlib.h>

#include "boxes.h"
#include "report.h"
#include "scene.h"

static int is_bounded(const struct box *box)
{
    for (int i = 0; i < 3; i++) {
        if (!(box->high.v[i] - box->low.v[i] < HUGE_VAL)) {
            return 0;
        }
    }
    return 1;
}

struct vector box_middle(const struct box *box)
{
    return mixed(box->low, box->high, 0.5);
}

static void measure_all(struct boxes *boxes)
{
    struct box all = {{{HUGE_VAL, HUGE_VAL, HUGE_VAL}},
                      {{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}}};
    for (size_t i = 0; i < boxes->count; i++) {
        for (int k = 0; k < 3; k++) {
            all.low.v[k] = fmin(all.low.v[k], boxes->box[i].low.v[k]);
            all.high.v[k] = fmax(all.high.v[k], boxes->box[i].high.v[k]);
        }
    }
    boxes->middle = box_middle(&all);
    boxes->size = length(minus(all.high, all.low));
}

int boxes_make(struct boxes *boxes, const struct scene *scene)
{
    const size_t n = scene->count;
    *boxes = (struct boxes){NULL, 0, {{0, 0, 0}}, 0};
    if (n < SIZE_MAX / sizeof *boxes->box) {
        boxes->box = malloc((n + 1) * sizeof *boxes->box);
    }
    if (!boxes->box) {
        return out_of_memory();
    }
    for (size_t i = 0; i < n; i++) {
        struct box *box = &boxes->box[boxes->count];
        cylint_shape shape;
        scene_shape(scene, i, &shape);
        cylint_bounds(&shape, box->low.v, box->high.v);
        boxes->count += (size_t)is_bounded(box);
    }
    if (boxes->count > 0) {
        measure_all(boxes);
    }
    return 0;
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
    for (size_t i = 0; i < boxes->count; i++) {
        most = fmax(most, reach_of_box(direction, &boxes->box[i]));
    }
    return most;
}
