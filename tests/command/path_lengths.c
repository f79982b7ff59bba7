/*
 * path_lengths.c - floor command: pieces and sums of lengths by a loop over all
 * shapes, to compare with those of the command
 *
 * usage: path_lengths pieces|sums SCENE LINES [RANKS]
 *
 * Writes doubles: t0, t1, the number of the owner and the depth of each piece, in
 * the mode `owner`; or a sum of lengths for each label.  A line of LINES is cut at
 * all ends of chords.  For each cell a loop finds the solids that contain it.  The
 * sums must be those of the library as well.
 */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "labels.h"

const char *const program = "path_lengths";

#define MUST(condition) ((condition) ? (void)0 : fail(#condition))

enum { LINE_BYTES = 1 << 12 };

static void fail(const char *what)
{
    fprintf(stderr, "path_lengths: not true: %s\n", what);
    exit(1);
}

static void *array_of(size_t n, size_t size)
{
    void *array = calloc(n, size);
    MUST(array != NULL);
    return array;
}

/* ---------------------------------------------------------- exact sums -- */

/* A sum of doubles without rounding: partials that do not overlap, ascending. */
struct sum {
    double partial[64];
    int count;
    int is_infinite;
};

static void sum_add(struct sum *s, double x)
{
    int kept = 0;
    for (int i = 0; i < s->count; i++) {
        double y = s->partial[i];
        if (fabs(x) < fabs(y)) {
            const double z = x;
            x = y;
            y = z;
        }
        const double high = x + y, low = y - (high - x);
        if (low != 0) {
            s->partial[kept++] = low;
        }
        x = high;
    }
    s->partial[kept++] = x;
    s->count = kept;
}

/* The double nearest to the sum.  The partials decide a tie. */
static double sum_rounded(const struct sum *s)
{
    int i = s->count - 1;
    if (s->is_infinite) {
        return HUGE_VAL;
    }
    double high = s->count > 0 ? s->partial[i] : 0, low = 0;
    while (i > 0 && !(low != 0)) {
        const double x = high, y = s->partial[--i];
        high = x + y;
        low = y - (high - x);
    }
    if (i > 0 && (low < 0) == (s->partial[i - 1] < 0)) {
        const double twice = 2 * low, x = high + twice;
        high = x - high - twice != 0 ? high : x;
    }
    return high;
}

/* --------------------------------------------------------------- scene -- */

static struct {
    struct scene scene;
    struct labels labels;
    struct groups groups;
    size_t n, members, solids;
    cylint_shape *shape;
    cylint_member *member;
    size_t *number;  /* of each solid */
    char *is_member; /* of each shape */
    char *contains;  /* of each shape: the present cell */
    cylint_interval *chord;
    size_t *shape_of_chord, chords;
    double *end;
} all;

static int is_of(const cylint_member *m, size_t solid, int is_complement)
{
    return m->solid == solid && (m->clause < 0) == is_complement;
}

static size_t number_of_solid(size_t solid)
{
    size_t number = all.n;
    for (int is_complement = 0; is_complement < 2 && number == all.n;
         is_complement++) {
        for (size_t i = 0; i < all.members; i++) {
            if (is_of(&all.member[i], solid, is_complement) &&
                all.member[i].shape < number) {
                number = all.member[i].shape;
            }
        }
    }
    return number;
}

static void read_solids(void)
{
    all.members = cylint_scene_members(all.scene.shapes);
    all.member = array_of(all.members + 1, sizeof *all.member);
    for (size_t i = 0; i < all.members; i++) {
        cylint_scene_member(all.scene.shapes, i, &all.member[i]);
        all.is_member[all.member[i].shape] = 1;
        if (all.member[i].solid >= all.solids) {
            all.solids = all.member[i].solid + 1;
        }
    }
    all.number = array_of(all.solids + 1, sizeof *all.number);
    for (size_t i = 0; i < all.solids; i++) {
        all.number[i] = number_of_solid(i);
    }
}

static void read_all(const char *file, const char *ranks)
{
    labels_collect(&all.labels, &all.scene);
    MUST(scene_read_text(&all.scene, file, NOT_GIVEN, SWC_CONES) == 0);
    labels_give(&all.labels, &all.scene);
    MUST(scene_build(&all.scene, 2) == 0);
    all.n = all.groups.shapes = all.scene.count;
    MUST(groups_make(&all.groups, &all.labels) == 0);
    MUST(!ranks || groups_read_ranks(&all.groups, ranks) == 0);
    all.shape = array_of(all.n + 1, sizeof *all.shape);
    all.is_member = array_of(all.n + 1, 1);
    all.contains = array_of(all.n + 1, 1);
    all.chord = array_of(2 * all.n + 2, sizeof *all.chord);
    all.shape_of_chord = array_of(2 * all.n + 2, sizeof *all.shape_of_chord);
    all.end = array_of(4 * all.n + 2, sizeof *all.end);
    for (size_t i = 0; i < all.n; i++) {
        scene_shape(&all.scene, i, &all.shape[i]);
    }
    read_solids();
}

static void free_all(void)
{
    scene_free(&all.scene);
    labels_free(&all.labels);
    groups_free(&all.groups);
    free(all.shape);
    free(all.is_member);
    free(all.contains);
    free(all.chord);
    free(all.shape_of_chord);
    free(all.end);
    free(all.member);
    free(all.number);
}

/* --------------------------------------------------------------- cells -- */

static int clause_holds(size_t solid, int clause)
{
    for (size_t i = 0; i < all.members; i++) {
        const cylint_member *m = &all.member[i];
        if (m->solid == solid && abs(m->clause) == clause &&
            all.contains[m->shape] == (m->clause > 0)) {
            return 1;
        }
    }
    return 0;
}

static int solid_holds(size_t solid)
{
    for (size_t i = 0; i < all.members; i++) {
        const cylint_member *m = &all.member[i];
        if (m->solid == solid && !clause_holds(solid, abs(m->clause))) {
            return 0;
        }
    }
    return 1;
}

static int outranks(size_t x, size_t y)
{
    const int *rank = all.groups.rank;
    return y == all.n ||
           (rank && rank[x] != rank[y] ? rank[x] < rank[y] : x < y);
}

/* The owner of a cell and its depth. */
static cylint_piece owner_of_cell(double t0, double t1)
{
    cylint_piece cell = {t0, t1, all.n, 0};
    memset(all.contains, 0, all.n);
    for (size_t i = 0; i < all.chords; i++) {
        if (all.chord[i].t0 <= t0 && t1 <= all.chord[i].t1) {
            all.contains[all.shape_of_chord[i]] = 1;
        }
    }
    for (size_t i = 0; i < all.n + all.solids; i++) {
        const int is_shape = i < all.n;
        const size_t number = is_shape ? i : all.number[i - all.n];
        if (is_shape ? all.contains[i] && !all.is_member[i]
                     : solid_holds(i - all.n)) {
            cell.depth++;
            if (outranks(number, cell.shape)) {
                cell.shape = number;
            }
        }
    }
    return cell;
}

static int compare(const void *x, const void *y)
{
    const double a = *(const double *)x, b = *(const double *)y;
    return (a > b) - (a < b);
}

/* Returns the number of ends. */
static size_t find_ends(const cylint_line *line)
{
    size_t ends = 0;
    all.chords = 0;
    all.end[ends++] = line->tmin;
    all.end[ends++] = line->tmax;
    for (size_t i = 0; i < all.n; i++) {
        cylint_interval *c = &all.chord[all.chords];
        const int found = cylint_chord(&all.shape[i], line, c);
        for (int j = 0; j < found; j++) {
            all.end[ends++] = c[j].t0;
            all.end[ends++] = c[j].t1;
            all.shape_of_chord[all.chords++] = i;
        }
    }
    qsort(all.end, ends, sizeof *all.end, compare);
    return ends;
}

static void put(double x)
{
    MUST(fwrite(&x, sizeof x, 1, stdout) == 1);
}

static void put_piece(const cylint_piece *p)
{
    if (p->depth > 0) {
        put(p->t0);
        put(p->t1);
        put((double)p->shape + 1);
        put((double)p->depth);
    }
}

/* ---------------------------------------------------------------- work -- */

static void write_pieces(const cylint_line *line)
{
    const size_t ends = find_ends(line);
    cylint_piece last = {0, 0, all.n, 0};
    for (size_t i = 1; i < ends; i++) {
        if (!(all.end[i - 1] < all.end[i])) {
            continue;
        }
        const cylint_piece cell = owner_of_cell(all.end[i - 1], all.end[i]);
        if (cell.shape == last.shape) {
            last.t1 = cell.t1;
            last.depth = cell.depth > last.depth ? cell.depth : last.depth;
        } else {
            put_piece(&last);
            last = cell;
        }
    }
    put_piece(&last);
}

/* Those of the library, from one line and, unless it is a segment, from lines. */
static void compare_sums(const cylint_line *line, const double *expected)
{
    const struct groups *groups = &all.groups;
    const cylint_piece_rule rule = {.mode = CYLINT_PIECES_OWNER,
                                    .rank = groups->rank};
    const cylint_lines lines = {1,
                                {&line->o[0], &line->o[1], &line->o[2]},
                                {&line->d[0], &line->d[1], &line->d[2]},
                                &line->tmin,
                                &line->tmax};
    double *sums = array_of(groups->columns, sizeof *sums);
    MUST(cylint_scene_line_sums(all.scene.shapes, line, &rule, groups->of,
                                groups->columns, 1, sums) == CYLINT_SCENE_OK);
    MUST(memcmp(sums, expected, groups->columns * sizeof *sums) == 0);
    if (!line->segment) {
        MUST(cylint_scene_sums(all.scene.shapes, &lines, &rule, groups->of,
                               groups->columns, 1, 1, sums) == CYLINT_SCENE_OK);
        MUST(memcmp(sums, expected, groups->columns * sizeof *sums) == 0);
    }
    free(sums);
}

static void write_sums(const cylint_line *line)
{
    const size_t ends = find_ends(line), columns = all.groups.columns;
    struct sum *sum = array_of(columns, sizeof *sum);
    double *sums = array_of(columns, sizeof *sums);
    for (size_t i = 1; i < ends; i++) {
        const double t0 = all.end[i - 1], t1 = all.end[i];
        const cylint_piece cell = owner_of_cell(t0, t1);
        if (t0 < t1 && cell.depth > 0) {
            struct sum *s = &sum[all.groups.of[cell.shape]];
            if (t1 - t0 > DBL_MAX) {
                s->is_infinite = 1;
            } else {
                sum_add(s, t1);
                sum_add(s, -t0);
            }
        }
    }
    for (size_t i = 0; i < columns; i++) {
        sums[i] = sum_rounded(&sum[i]);
        sums[i] *= sums[i] > 0 ? cylint_line_length(line) : 1;
        put(sums[i]);
    }
    compare_sums(line, sums);
    free(sum);
    free(sums);
}

int main(int argc, char **argv)
{
    const struct grammar g = {.has_line = 1,
                              .line = NOT_GIVEN,
                              .shape = NOT_GIVEN,
                              .ends = NOT_GIVEN};
    char text[LINE_BYTES];
    MUST(argc > 3);
    read_all(argv[2], argc > 4 ? argv[4] : NULL);
    FILE *in = fopen(argv[3], "r");
    MUST(in != NULL);
    while (fgets(text, sizeof text, in)) {
        struct record r;
        struct notes notes = {.text = text};
        MUST(read_record(&g, text, text + strcspn(text, "\n"), &r, &notes) ==
             0);
        (strcmp(argv[1], "sums") == 0 ? write_sums : write_pieces)(&r.line);
    }
    fclose(in);
    free_all();
    return 0;
}
