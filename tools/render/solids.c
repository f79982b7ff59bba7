/*
 * solids.c - what a ray meets in a scene with solids made of shapes
 */
#include <stdlib.h>

#include "report.h"
#include "solids.h"

enum { BYTES = 1 << 14 }; /* enough for most rays */

/* Memory on the stack, and more where a ray needs it. */
struct memory {
    double first[BYTES / sizeof(double)];
    cylint_workspace work;
};

static void begin(struct memory *m)
{
    m->work = (cylint_workspace){m->first, sizeof m->first, 0};
}

static void end(struct memory *m)
{
    if (m->work.memory != m->first) {
        free(m->work.memory);
    }
}

static void grow(struct memory *m)
{
    const size_t wanted = m->work.wanted;
    end(m);
    m->work.memory = malloc(wanted);
    m->work.bytes = wanted;
    if (!m->work.memory) {
        exit(out_of_memory());
    }
}

size_t solids_first(const cylint_scene *scene, const cylint_line *ray,
                    cylint_hit *hit)
{
    struct memory m;
    size_t shape;
    begin(&m);
    while ((shape = cylint_scene_first_boundary(
                scene, ray,
                CYLINT_WANT_T | CYLINT_WANT_POINT | CYLINT_WANT_NORMAL |
                    CYLINT_WANT_PART,
                hit, &m.work)) == CYLINT_NO_ROOM) {
        grow(&m);
    }
    end(&m);
    return shape;
}

int solids_hide(const cylint_scene *scene, const cylint_line *ray)
{
    const cylint_piece_rule rule = {.mode = CYLINT_PIECES_UNION};
    struct memory m;
    cylint_piece piece;
    size_t n;
    begin(&m);
    while ((n = cylint_scene_pieces(scene, ray, &rule, &piece, 1, &m.work)) ==
           CYLINT_NO_ROOM) {
        grow(&m);
    }
    end(&m);
    return n > 0;
}

/* Whether the hit is on a shape that the solid leaves out: the line enters one where
 * it leaves the other. */
static int is_left_out(const cylint_shape *shape, const cylint_line *ray,
                       const cylint_hit *hit)
{
    cylint_shape closed = *shape;
    cylint_answer a;
    if (shape->ends < CYLINT_ENDS_INFINITE) {
        closed.ends = CYLINT_ENDS_CAPPED;
    }
    cylint_intersect(&closed, ray, CYLINT_WANT_T | CYLINT_WANT_PART, &a);
    for (int i = 0; i < a.n; i++) {
        if (a.hit[i].t >= hit->t && a.hit[i].t <= hit->t) {
            return a.hit[i].side != hit->side;
        }
    }
    return 0;
}

void solids_beside(const cylint_shape *shape, const cylint_line *ray,
                   const cylint_hit *hit, int inside, double point[3])
{
    const int reversed = is_left_out(shape, ray, hit);
    cylint_hit own = *hit;
    for (int i = 0; i < 3 && reversed; i++) {
        own.normal[i] = -own.normal[i];
    }
    cylint_outside(shape, &own, inside != reversed ? 1 : -1, point);
}
