/*
 * pairs.c - pairs of lines and shapes, answered in batches
 */
#include <stdlib.h>

#include "pairs.h"

struct pairs *pairs_make(void)
{
    struct pairs *p = malloc(sizeof *p);
    if (!p)
        return NULL;
    p->count = 0;
    p->memory = malloc(cylint_pack_bytes(PAIRS_MOST));
    if (!p->memory) {
        free(p);
        return NULL;
    }
    return p;
}

void pairs_free(struct pairs *p)
{
    if (p) {
        free(p->memory);
        free(p);
    }
}

int pairs_can_answer(int line_kind, unsigned want, int sides)
{
    const unsigned can = CYLINT_WANT_T | CYLINT_WANT_PART | CYLINT_WANT_NEAREST;
    return line_kind != NOT_GIVEN && line_kind != LINE_SEGMENT && !sides &&
           !(want & ~can);
}

void pairs_place(struct pairs *p, struct parts *parts)
{
    parts->line = &p->line;
    parts->shape = &p->shapes[p->count];
    parts->tail = &p->tail[p->count];
    parts->tail_length = &p->tail_length[p->count];
}

void pairs_take(struct pairs *p)
{
    const int i = p->count++;
    for (int k = 0; k < 3; k++) {
        p->o[k][i] = p->line.o[k];
        p->d[k][i] = p->line.d[k];
    }
    p->tmin[i] = p->line.tmin;
    p->tmax[i] = p->line.tmax;
}

/* If only the first hit is wanted, part0 is -1 if there is none. */
void pairs_intersect(struct pairs *p, unsigned want)
{
    const int both = !(want & CYLINT_WANT_NEAREST);
    const int roots = (want & CYLINT_WANT_T) != 0;
    const int parts = (want & CYLINT_WANT_PART) != 0;
    const cylint_lines lines = {(size_t)p->count,
                                {p->o[0], p->o[1], p->o[2]},
                                {p->d[0], p->d[1], p->d[2]},
                                p->tmin,
                                p->tmax};
    const cylint_columns columns = {.relation = p->relation,
                                    .n = both ? p->n : NULL,
                                    .t0 = roots ? p->t0 : NULL,
                                    .t1 = roots && both ? p->t1 : NULL,
                                    .part0 = parts || !both ? p->part0 : NULL,
                                    .part1 = parts && both ? p->part1 : NULL};
    cylint_pack pack;
    cylint_pack_shapes(&pack, p->memory, p->shapes, lines.n);
    cylint_intersect_pairs(&pack, &lines, &columns);
}

void pairs_get(const struct pairs *p, int i, unsigned want,
               cylint_answer *answer)
{
    answer->relation = p->relation[i];
    answer->n = want & CYLINT_WANT_NEAREST ? p->part0[i] >= 0 : p->n[i];
    if (answer->n > 0) {
        answer->hit[0].t = p->t0[i];
        answer->hit[0].part = p->part0[i];
    }
    if (answer->n > 1) {
        answer->hit[1].t = p->t1[i];
        answer->hit[1].part = p->part1[i];
    }
}
