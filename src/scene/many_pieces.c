/*
 * many_pieces.c - the pieces of many lines, and sums of their lengths by label
 */
#include <stdlib.h>
#include <string.h>

#include "../bvh/threads.h"
#include "../intersect.h"
#include "../numbers/exact_sum.h"
#include "scene.h"

enum {
    LINES_AT_ONCE = 64, /* of a block, which a thread takes at a time */
    LINES_A_THREAD = 256,
    FIRST_BYTES = 1 << 14,
    FIRST_PIECES = 256
};

/* -------------------------------------------------------------- blocks -- */

/* The pieces of the lines that a thread takes, and memory to find them. */
typedef struct {
    int has_failed;
    cylint_workspace work;
    cylint_piece *pieces;
    size_t n, capacity;
} piece_block;

typedef struct {
    const cylint_scene *scene;
    size_t n; /* lines */
    const cylint_lines *lines;
    const cylint_line *line; /* the only one, where `lines` is NULL */
    cylint_piece_rule rule;
    size_t most;
    piece_block *block, one; /* one: of few lines, which then allocate less */
    size_t n_blocks;
    /* of rows: [i + 1] is the number of pieces of line i; of sums NULL */
    size_t *first;
    const int *label;
    size_t labels;
    int in_units;
    double *sums;
} pieces_query;

static int grow_workspace(cylint_workspace *work, size_t bytes)
{
    free(work->memory); /* nothing stays in it */
    work->memory = malloc(bytes);
    work->bytes = work->memory ? bytes : 0;
    return work->memory != NULL;
}

static int grow_pieces(piece_block *b)
{
    const size_t capacity = 2 * b->capacity + FIRST_PIECES;
    cylint_piece *grown = cylint_resized(b->pieces, capacity, sizeof *grown);
    if (!grown)
        return 0;
    b->pieces = grown;
    b->capacity = capacity;
    return 1;
}

/* Adds all pieces of a line, or the first `most`.  Returns 0 if there is no
 * memory. */
static int add_pieces(const pieces_query *q, const cylint_line *line,
                      piece_block *b)
{
    if (b->capacity - b->n < FIRST_PIECES && !grow_pieces(b))
        return 0;
    for (;;) {
        const size_t room = b->capacity - b->n,
                     wanted = q->most > 0 && q->most < room ? q->most : room;
        const size_t n = cylint_scene_pieces(
            q->scene, line, &q->rule, b->pieces + b->n, wanted, &b->work);
        if (n == CYLINT_NO_ROOM) {
            if (!grow_workspace(&b->work, b->work.wanted + b->work.wanted / 2))
                return 0;
        } else if (n < room || n == q->most) {
            b->n += n;
            return 1;
        } else if (!grow_pieces(b)) {
            return 0;
        }
    }
}

static int add_sums(const pieces_query *q, size_t i, const cylint_line *line,
                    piece_block *b);

/* Finds the pieces of lines; for sums it keeps those of one line at a time. */
static int find_each(const pieces_query *q, size_t from, size_t to,
                     piece_block *b)
{
    for (size_t i = from; i < to; i++) {
        cylint_line line;
        if (q->lines)
            cylint_read_line(q->lines, i, &line);
        else
            line = *q->line;
        const size_t before = q->first ? b->n : 0;
        b->n = before;
        if (!add_pieces(q, &line, b))
            return 0;
        if (q->first)
            q->first[i + 1] = b->n - before;
        else if (!add_sums(q, i, &line, b))
            return 0;
    }
    return 1;
}

/* Rows are kept in no more memory than they take; with sums nothing is kept. */
static void find_block(void *self, size_t from, size_t to)
{
    const pieces_query *q = self;
    piece_block *b = &q->block[from / LINES_AT_ONCE];
    b->has_failed =
        !grow_workspace(&b->work, FIRST_BYTES) || !find_each(q, from, to, b);
    free(b->work.memory);
    if (q->first) {
        cylint_piece *kept = cylint_resized(b->pieces, b->n, sizeof *kept);
        b->pieces = kept ? kept : b->pieces;
    } else {
        free(b->pieces);
        b->pieces = NULL;
    }
}

/* ---------------------------------------------------------------- rows -- */

/* Makes one array of those of all blocks. */
static int unite_rows(const pieces_query *q, cylint_piece_rows *rows)
{
    size_t n = 0;
    rows->first[0] = 0;
    for (size_t i = 0; i < q->n; i++)
        rows->first[i + 1] += rows->first[i];
    rows->pieces =
        cylint_resized(NULL, rows->first[q->n], sizeof *rows->pieces);
    if (!rows->pieces)
        return 0;
    for (size_t i = 0; i < q->n_blocks; i++) {
        const piece_block *b = &q->block[i];
        if (b->n > 0)
            memcpy(rows->pieces + n, b->pieces, b->n * sizeof *b->pieces);
        n += b->n;
    }
    return 1;
}

/* Finds all pieces, and unites them in rows unless these are NULL. */
static cylint_scene_status answer_query(pieces_query *q, int threads,
                                        cylint_piece_rows *rows)
{
    q->rule.after = NULL;
    q->n_blocks = q->n / LINES_AT_ONCE + 1;
    q->block =
        q->n_blocks > 1 ? calloc(q->n_blocks, sizeof *q->block) : &q->one;
    if (!q->block)
        return CYLINT_SCENE_EMEMORY;
    cylint_threads_share(threads, q->n, LINES_AT_ONCE, LINES_A_THREAD,
                         find_block, q);
    int has_failed = 0;
    for (size_t i = 0; i < q->n_blocks; i++)
        has_failed |= q->block[i].has_failed;
    has_failed = has_failed || (rows && !unite_rows(q, rows));
    for (size_t i = 0; i < q->n_blocks; i++)
        free(q->block[i].pieces);
    if (q->block != &q->one)
        free(q->block);
    return has_failed ? CYLINT_SCENE_EMEMORY : CYLINT_SCENE_OK;
}

cylint_scene_status cylint_scene_pieces_lines(const cylint_scene *scene,
                                              const cylint_lines *lines,
                                              const cylint_piece_rule *rule,
                                              size_t most, int threads,
                                              cylint_piece_rows *rows)
{
    pieces_query q = {.scene = scene,
                      .n = lines->n,
                      .lines = lines,
                      .rule = *rule,
                      .most = most};
    rows->pieces = NULL;
    rows->first = q.first =
        cylint_resized(NULL, lines->n + 1, sizeof *rows->first);
    if (q.first && answer_query(&q, threads, rows) == CYLINT_SCENE_OK)
        return CYLINT_SCENE_OK;
    cylint_piece_rows_free(rows);
    return CYLINT_SCENE_EMEMORY;
}

void cylint_piece_rows_free(cylint_piece_rows *rows)
{
    free(rows->first);
    free(rows->pieces);
    rows->first = NULL;
    rows->pieces = NULL;
}

/* ---------------------------------------------------------------- sums -- */

#define SORTED cylint_piece
#define IS_BEFORE(x, y) ((x)->shape < (y)->shape)
#define SORT sort_by_label
#include "../merge_sort_template.h"

/* Keeps the pieces that have a label, as `shape`, sorted by it.  Returns 0 if there
 * is no memory. */
static int label_pieces(const pieces_query *q, piece_block *b)
{
    const size_t bytes = b->n * sizeof *b->pieces;
    size_t n = 0;
    for (size_t i = 0; i < b->n; i++) {
        const int label = q->label ? q->label[b->pieces[i].shape] : 0;
        b->pieces[n] = b->pieces[i];
        b->pieces[n].shape = (size_t)label;
        n += label >= 0 && (size_t)label < q->labels;
    }
    b->n = n;
    if (bytes > b->work.bytes && !grow_workspace(&b->work, bytes))
        return 0;
    sort_by_label(b->pieces, n, b->work.memory);
    return 1;
}

static double sum_of_lengths(const cylint_piece *p, size_t n)
{
    cylint_exact_sum sum = {{0}};
    for (size_t i = 0; i < n; i++) {
        if (!(p[i].t0 >= -DBL_MAX && p[i].t1 <= DBL_MAX))
            return HUGE_VAL;
        cylint_sum_add(&sum, p[i].t1);
        cylint_sum_add(&sum, -p[i].t0);
    }
    return cylint_sum_rounded(&sum);
}

/* The double nearest to the product of two numbers above 0, in every floating-point
 * environment. */
static double product_of_lengths(double x, double y)
{
    const double rounded = x * y;
    if (x > DBL_MAX || y > DBL_MAX)
        return HUGE_VAL;
    return rounded > DBL_MIN && cylint_rounds_to_nearest()
               ? rounded
               : cylint_nearest_product(x, y);
}

static int add_sums(const pieces_query *q, size_t i, const cylint_line *line,
                    piece_block *b)
{
    double *to = q->sums + i * q->labels;
    if (!label_pieces(q, b))
        return 0;
    for (size_t j = 0; j < q->labels; j++)
        to[j] = 0;
    const cylint_piece *p = b->pieces;
    for (size_t j = 0, m; j < b->n; j += m) {
        for (m = 1; j + m < b->n && p[j + m].shape == p[j].shape;)
            m++;
        const double sum = sum_of_lengths(p + j, m);
        to[p[j].shape] = q->in_units
                             ? product_of_lengths(sum, cylint_line_length(line))
                             : sum;
    }
    return 1;
}

static cylint_scene_status answer_sums(pieces_query q,
                                       const cylint_piece_rule *rule,
                                       const int *label, size_t labels,
                                       int in_units, int threads, double *sums)
{
    q.rule = *rule;
    q.label = label;
    q.labels = labels;
    q.in_units = in_units;
    q.sums = sums;
    return answer_query(&q, threads, NULL);
}

cylint_scene_status cylint_scene_sums(const cylint_scene *scene,
                                      const cylint_lines *lines,
                                      const cylint_piece_rule *rule,
                                      const int *label, size_t labels,
                                      int in_units, int threads, double *sums)
{
    const pieces_query q = {.scene = scene, .n = lines->n, .lines = lines};
    return answer_sums(q, rule, label, labels, in_units, threads, sums);
}

cylint_scene_status cylint_scene_line_sums(const cylint_scene *scene,
                                           const cylint_line *line,
                                           const cylint_piece_rule *rule,
                                           const int *label, size_t labels,
                                           int in_units, double *sums)
{
    const pieces_query q = {.scene = scene, .n = 1, .line = line};
    return answer_sums(q, rule, label, labels, in_units, 1, sums);
}
