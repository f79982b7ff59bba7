/*
 * many_pieces.c - the pieces of many lines, and sums of their lengths by label
 */
#include <stdlib.h>
#include <string.h>

#include "../bvh/threads.h"
#include "../intersect.h"
#include "../numbers/exact_sum.h"
#include "piece_memory.h"
#include "scene.h"

enum {
    LINES_AT_ONCE = 64, /* of a block, which a thread takes at a time */
    LINES_A_THREAD = 256,
    FIRST_BYTES = 1 << 14,
    FIRST_PIECES = 256
};

/* -------------------------------------------------------------- memory -- */

int cylint_grow_workspace(cylint_workspace *work)
{
    const size_t wanted = work->wanted + work->wanted / 2;
    free(work->memory);
    work->bytes = wanted > FIRST_BYTES ? wanted : FIRST_BYTES;
    work->memory = malloc(work->bytes);
    if (!work->memory)
        work->bytes = 0;
    return work->memory != NULL;
}

static int grow_pieces(cylint_piece_memory *m)
{
    const size_t capacity = 2 * m->capacity + FIRST_PIECES;
    cylint_piece *grown = cylint_resized(m->piece, capacity, sizeof *grown);
    if (!grown)
        return 0;
    m->piece = grown;
    m->capacity = capacity;
    return 1;
}

int cylint_add_pieces(const cylint_scene *scene, const cylint_line *line,
                      const cylint_piece_rule *rule, size_t most,
                      cylint_piece_memory *m)
{
    if (m->capacity - m->n < FIRST_PIECES && !grow_pieces(m))
        return 0;
    for (;;) {
        const size_t room = m->capacity - m->n,
                     wanted = most > 0 && most < room ? most : room;
        const size_t n = cylint_scene_pieces(scene, line, rule, m->piece + m->n,
                                             wanted, &m->work);
        if (n != CYLINT_NO_ROOM && n < room) {
            m->n += n;
            return 1;
        }
        if (n == CYLINT_NO_ROOM ? !cylint_grow_workspace(&m->work)
                                : !grow_pieces(m))
            return 0;
    }
}

/* -------------------------------------------------------------- blocks -- */

/* The pieces of the lines that a thread takes. */
typedef struct {
    int has_failed;
    cylint_piece_memory found;
} piece_block;

typedef struct {
    const cylint_scene *scene;
    size_t n; /* lines */
    const cylint_lines *lines;
    const cylint_line *line; /* the only one, where `lines` is NULL */
    cylint_piece_rule rule;
    size_t most;
    piece_block *block;
    size_t n_blocks;
    /* of rows: [i + 1] is the number of pieces of line i; of sums NULL */
    size_t *first;
    const int *label;
    size_t labels;
    int in_units;
    double *sums;
} pieces_query;

static int add_sums(const pieces_query *q, size_t i, const cylint_line *line,
                    cylint_piece_memory *m);

/* Finds the pieces of lines; for sums it keeps those of one line at a time. */
static int find_each(const pieces_query *q, size_t from, size_t to,
                     cylint_piece_memory *m)
{
    for (size_t i = from; i < to; i++) {
        cylint_line line;
        if (q->lines)
            cylint_read_line(q->lines, i, &line);
        else
            line = *q->line;
        const size_t before = q->first ? m->n : 0;
        m->n = before;
        if (!cylint_add_pieces(q->scene, &line, &q->rule, q->most, m))
            return 0;
        if (q->first)
            q->first[i + 1] = m->n - before;
        else if (!add_sums(q, i, &line, m))
            return 0;
    }
    return 1;
}

/* Rows are kept in no more memory than they take; with sums nothing is kept. */
static void find_block(void *self, size_t from, size_t to)
{
    const pieces_query *q = self;
    piece_block *b = &q->block[from / LINES_AT_ONCE];
    cylint_piece_memory *m = &b->found;
    b->has_failed = !find_each(q, from, to, m);
    free(m->work.memory);
    if (q->first) {
        cylint_piece *kept = cylint_resized(m->piece, m->n, sizeof *kept);
        m->piece = kept ? kept : m->piece;
    } else {
        free(m->piece);
        m->piece = NULL;
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
        const cylint_piece_memory *m = &q->block[i].found;
        if (m->n > 0)
            memcpy(rows->pieces + n, m->piece, m->n * sizeof *m->piece);
        n += m->n;
    }
    return 1;
}

/* Finds all pieces, and unites them in rows unless these are NULL. */
static cylint_scene_status answer_query(pieces_query *q, int threads,
                                        cylint_piece_rows *rows)
{
    q->rule.after = NULL;
    q->n_blocks = q->n / LINES_AT_ONCE + 1;
    q->block = calloc(q->n_blocks, sizeof *q->block);
    if (!q->block)
        return CYLINT_SCENE_EMEMORY;
    cylint_threads_share(threads, q->n, LINES_AT_ONCE, LINES_A_THREAD,
                         find_block, q);
    int has_failed = 0;
    for (size_t i = 0; i < q->n_blocks; i++)
        has_failed |= q->block[i].has_failed;
    has_failed = has_failed || (rows && !unite_rows(q, rows));
    for (size_t i = 0; i < q->n_blocks; i++)
        free(q->block[i].found.piece);
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
static int label_pieces(const pieces_query *q, cylint_piece_memory *m)
{
    size_t n = 0;
    m->work.wanted = m->n * sizeof *m->piece;
    for (size_t i = 0; i < m->n; i++) {
        const int label = q->label ? q->label[m->piece[i].shape] : 0;
        m->piece[n] = m->piece[i];
        m->piece[n].shape = (size_t)label;
        n += label >= 0 && (size_t)label < q->labels;
    }
    m->n = n;
    if (m->work.wanted > m->work.bytes && !cylint_grow_workspace(&m->work))
        return 0;
    sort_by_label(m->piece, n, m->work.memory);
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
                    cylint_piece_memory *m)
{
    double *to = q->sums + i * q->labels;
    if (!label_pieces(q, m))
        return 0;
    for (size_t j = 0; j < q->labels; j++)
        to[j] = 0;
    const cylint_piece *p = m->piece;
    for (size_t j = 0, n; j < m->n; j += n) {
        for (n = 1; j + n < m->n && p[j + n].shape == p[j].shape;)
            n++;
        const double sum = sum_of_lengths(p + j, n);
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
