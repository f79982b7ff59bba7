/*
 * answers.c - prints the bits of the library's answers
 *
 *   answers <FILE     FILE has records of the command
 *
 * One line a question: relation, number of hits and, of each hit, t, part,
 * side, point, normal, z and phi; then the distance of the line's origin, part
 * and feature.  Numbers are the bits of the double.  It needs the C library
 * only, so that cross.sh can compare systems on which the command is not
 * built.
 */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "cylint_distance.h"
#include "families.h"

static uint64_t bits(double x)
{
    uint64_t u;
    memcpy(&u, &x, sizeof u);
    return u;
}

int main(void)
{
    char text[1000];
    while (fgets(text, sizeof text, stdin)) {
        const struct family_case c = case_of(text);
        cylint_answer a;
        cylint_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &a);
        printf("%d %d", (int)a.relation, a.n);
        for (int i = 0; i < a.n; i++) {
            const cylint_hit *h = &a.hit[i];
            printf(" %016" PRIx64 " %d %d", bits(h->t), h->part, h->side);
            for (int k = 0; k < 3; k++)
                printf(" %016" PRIx64 " %016" PRIx64, bits(h->point[k]),
                       bits(h->normal[k]));
            printf(" %016" PRIx64 " %016" PRIx64, bits(h->z), bits(h->phi));
        }
        cylint_closest closest = {.part = -1};
        cylint_distance(&c.shape, c.line.o, CYLINT_WANT_PART, &closest);
        printf(" %016" PRIx64 " %d %d\n", bits(closest.distance), closest.part,
               closest.feature);
    }
    return ferror(stdin) || ferror(stdout);
}
