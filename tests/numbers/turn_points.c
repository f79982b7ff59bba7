/*
 * turn_points.c - turns_of() over arrays; compiled for several instruction sets
 */
#include "numbers/turns_lanes.h"
#include "turn_points.h"

#ifndef TURNS
#define TURNS turns_plain
#endif

void TURNS(size_t n, const turn_point *p, turn_answer *answer)
{
    for (size_t i = 0; i < n; i += LANES) {
        double in[6][LANES], out[3][LANES];
        for (size_t j = 0; j < LANES; j++) {
            const turn_point *q = p + i + j;
            const double of[] = {q->x.hi, q->x.lo, q->y.hi,
                                 q->y.lo, q->ex,   q->ey};
            for (int k = 0; k < 6; k++)
                in[k][j] = of[k];
        }
        vd error;
        const vpair turn = turns_of((vpair){v_load(in[0]), v_load(in[1])},
                                    (vpair){v_load(in[2]), v_load(in[3])},
                                    v_load(in[4]), v_load(in[5]), &error);
        v_store(out[0], turn.hi);
        v_store(out[1], turn.lo);
        v_store(out[2], error);
        for (size_t j = 0; j < LANES; j++)
            answer[i + j] = (turn_answer){{out[0][j], out[1][j]}, out[2][j]};
    }
}
