/*
 * geant4.c - many rays in one solid: the pieces of libcylint and the steps of
 * Geant4
 *
 * geant4.py loads this as a shared library.  Geant4 comes compiled, without
 * headers: the script passes the addresses of an object and of its member
 * functions, which get the object first and references as addresses [Itanium
 * C++ ABI].
 *
 * A ray is o, d: six doubles.  Pieces are written as t0, t1 to MOST places for
 * each ray. Functions return nanoseconds of processor time.
 */
#include <stdbool.h>
#include <time.h>

#include "cylint_pieces.h"

enum { MOST = 8, STEPS = 100, INSIDE = 2 };

typedef struct {
    const void *solid;
    int (*inside)(const void *, const double p[3]);
    double (*to_in)(const void *, const double p[3], const double v[3]);
    double (*to_out)(const void *, const double p[3], const double v[3], bool,
                     bool *, double *);
} geant4;

static double nanoseconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

/* From boundary to boundary. After ten steps of length 0 a ray is pushed by
 * 100 tolerances of 1e-9, as G4Navigator does. Some rays never end. */
static int take_steps(const geant4 *g, const double ray[6], double t[MOST][2])
{
    const double infinity = 9e98;
    double at = 0;
    int n = 0, zeros = 0;
    bool is_inside = g->inside(g->solid, ray) == INSIDE;
    for (int i = 0; i < STEPS && n < MOST; i++, is_inside = !is_inside) {
        const double *v = ray + 3;
        const double p[3] = {ray[0] + at * v[0], ray[1] + at * v[1],
                             ray[2] + at * v[2]};
        const double step = is_inside
                                ? g->to_out(g->solid, p, v, false, NULL, NULL)
                                : g->to_in(g->solid, p, v);
        if (!is_inside && step >= infinity)
            break;
        if (is_inside && step > 0) {
            t[n][0] = at;
            t[n++][1] = at + step;
        }
        zeros = step > 0 ? 0 : zeros + 1;
        at += zeros < 10 ? step : 1e-7;
    }
    return n;
}

double geant4_steps(const geant4 *g, const double (*rays)[6], size_t n,
                    int *counts, double (*t)[MOST][2])
{
    const double start = nanoseconds();
    for (size_t i = 0; i < n; i++)
        counts[i] = take_steps(g, rays[i], t[i]);
    return nanoseconds() - start;
}

double cylint_pieces_of(const double p0[3], const double p1[3],
                        const double outer[2], const double inner[2],
                        const double sector[2][3], const double (*rays)[6],
                        size_t n, int *counts, cylint_interval (*t)[MOST])
{
    cylint_shape shapes[CYLINT_TUBE_MEMBERS];
    int clauses[CYLINT_TUBE_MEMBERS];
    size_t members;
    if (cylint_tube(p0, p1, outer, inner, sector, shapes, clauses, &members) !=
        CYLINT_OK)
        return -1;
    const double start = nanoseconds();
    for (size_t i = 0; i < n; i++) {
        cylint_line line;
        cylint_ray(&line, rays[i], rays[i] + 3);
        counts[i] =
            cylint_solid_pieces(shapes, clauses, members, &line, t[i], MOST);
    }
    return nanoseconds() - start;
}
