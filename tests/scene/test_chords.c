/*
 * test_chords.c - the chords of a line in a scene are those of its shapes, one
 * by one, bit for bit, with every instruction set
 */
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "cylint_scene.h"
#include "scenes.h"

enum { SHAPES = 400, LINES = 40, MOST = 2 * SHAPES, SEED = 2711 };

static cylint_piece expected[MOST], got[MOST];
static char memory[1 << 20];
static long chords;

static int by_begin(const void *a, const void *b)
{
    const cylint_piece *x = a, *y = b;
    return x->t0 < y->t0         ? -1
           : x->t0 > y->t0       ? 1
           : x->shape < y->shape ? -1
                                 : x->shape > y->shape;
}

static size_t find_chords(const struct scene_shapes *of,
                          const cylint_line *line)
{
    size_t n = 0;
    for (size_t i = 0; i < of->n; i++) {
        cylint_interval chord[2];
        const int found = cylint_chord(&of->shapes[i], line, chord);
        for (int j = 0; j < found; j++)
            expected[n++] = (cylint_piece){chord[j].t0, chord[j].t1, i, 1};
    }
    qsort(expected, n, sizeof *expected, by_begin);
    return n;
}

static void check_line(const cylint_scene *scene, const cylint_line *line,
                       size_t n)
{
    const cylint_piece_rule rule = {.mode = CYLINT_PIECES_CHORDS};
    cylint_workspace work = {memory, sizeof memory, 0};
    const size_t m = cylint_scene_pieces(scene, line, &rule, got, MOST, &work);
    int same = n == m;
    for (size_t i = 0; same && i < n; i++)
        same = memcmp(&got[i].t0, &expected[i].t0, sizeof got->t0) == 0 &&
               memcmp(&got[i].t1, &expected[i].t1, sizeof got->t1) == 0 &&
               got[i].shape == expected[i].shape;
    if (!CHECK(same))
        REPORT("%s: %zu chords, not %zu", cylint_kernels_in_use(), m, n);
    chords += (long)n;
}

static void check_scene(int kind)
{
    struct scene_shapes of;
    const char *name;
    cylint_line line;
    if (!CHECK(scene_generate(kind, SHAPES, SEED, &of)))
        return;
    for (int k = 0; (name = cylint_kernels_name(k)); k++) {
        cylint_use_kernels(name);
        cylint_scene *scene = cylint_scene_new(of.shapes, of.n, 1, NULL);
        CHECK(scene != NULL);
        for (int lines = 0; lines < LINES_KINDS; lines++)
            for (uint64_t i = 0; scene && i < LINES; i++)
                if (scene_line(&of, (enum scene_lines)lines, SEED, i, &line) ==
                    CYLINT_OK)
                    check_line(scene, &line, find_chords(&of, &line));
        cylint_scene_free(scene);
    }
    cylint_use_kernels(NULL);
    scene_release(&of);
}

static void chords_of_a_scene_are_those_of_its_shapes(void)
{
    for (int kind = 0; kind < SCENE_KINDS; kind++)
        check_scene(kind);
    printf("note: %ld chords\n", chords);
}

int main(void)
{
    RUN(chords_of_a_scene_are_those_of_its_shapes);
    return check_end();
}
