/*
 * answers.c - prints the bits of the library's answers
 *
 *   answers <FILE     FILE has records of the command
 *
 * One line a question: relation, number of hits and, of each hit, part, side,
 * point, normal, t, z, phi and the points outside and inside of it; the chords; of
 * the line's origin and of each hit's point, whether the solid contains it, and its
 * distance with all members; then " |" and their safeties.  Numbers are the bits of
 * the double.  It needs the C library only, so that cross.sh can compare systems on
 * which the command is not built.
 */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cylint_distance.h"
#include "cylint_pieces.h"
#include "families.h"

static void print_bits(const double *x, int n)
{
    for (int i = 0; i < n; i++) {
        uint64_t u;
        memcpy(&u, &x[i], sizeof u);
        printf(" %016" PRIx64, u);
    }
}

static void print_hit(const cylint_shape *shape, const cylint_hit *h)
{
    const double numbers[] = {h->point[0],  h->point[1],  h->point[2],
                              h->normal[0], h->normal[1], h->normal[2],
                              h->t,         h->z,         h->phi};
    printf(" %d %d", h->part, h->side);
    print_bits(numbers, 9);
    for (int side = -1; side <= 1; side += 2) {
        double point[3];
        printf(" %d", cylint_outside(shape, h, side, point));
        print_bits(point, 3);
    }
}

/* Of distances from other elliptic shapes only the sign is right
 * (cylint_distance(3)); other digits differ with -mfma. */
static int has_digits(const struct family_case *c)
{
    int has = 1;
    if (c->shape_word == FAMILY_ECYLINDER || c->shape_word == FAMILY_ECONE)
        for (int i = 0; i < family_shape_size(c->shape_word); i++) {
            const double size = fabs(c->shape_data[i]);
            has = has && size < 0x1p100 && (size == 0 || size >= 0x1p-100);
        }
    return has;
}

static void print_distance(const cylint_shape *shape, const double point[3])
{
    const unsigned want =
        CYLINT_WANT_PART | CYLINT_WANT_POINT | CYLINT_WANT_NORMAL;
    cylint_closest near = {.part = -1};
    cylint_distance(shape, point, want, &near);
    print_bits(&near.distance, 1);
    print_bits(near.point, 3);
    print_bits(near.normal, 3);
    printf(" %d %d", near.part, near.feature);
}

int main(void)
{
    char text[1000];
    while (fgets(text, sizeof text, stdin)) {
        const struct family_case c = case_of(text);
        cylint_answer a;
        cylint_intersect(&c.shape, &c.line, CYLINT_WANT_ALL, &a);
        printf("%d %d", a.relation, a.n);
        for (int i = 0; i < a.n; i++)
            print_hit(&c.shape, &a.hit[i]);
        cylint_interval chord[2];
        const int chords = cylint_chord(&c.shape, &c.line, chord);
        printf(" %d", chords);
        for (int i = 0; i < chords; i++) {
            print_bits(&chord[i].t0, 1);
            print_bits(&chord[i].t1, 1);
        }
        const double *point[3] = {c.line.o, a.hit[0].point, a.hit[1].point};
        for (int i = 0; i <= a.n; i++) {
            printf(" %d", cylint_contains(&c.shape, point[i]));
            if (has_digits(&c))
                print_distance(&c.shape, point[i]);
        }
        printf(" |");
        for (int i = 0; i <= a.n && has_digits(&c); i++) {
            const double safety = cylint_safety(&c.shape, point[i]);
            print_bits(&safety, 1);
        }
        putchar('\n');
    }
    return ferror(stdin) || ferror(stdout);
}
