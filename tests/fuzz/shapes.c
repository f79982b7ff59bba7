/*
 * shapes.c - fuzzes the library
 *
 * The bytes of an input become a line and some shapes.  The answers are those of
 * the oracle, if there is MPFR, and batches with all kernels give the answers of
 * single questions.  A build with CYLINT_PARANOID also makes each decision twice.
 */
#include <math.h>
#include <string.h>

#define CHECK_OWN_MAIN /* it is in replay.c or libFuzzer */
#include "../scene/answers.h"
#include "columns.h"
#include "fuzz.h"
#include "same.h"
#include "ulps.h"
#ifdef HAVE_MPFR
#include "oracle.h"
#endif

enum { SHAPES_MOST = 9, LINES = 5 };

/* ------------------------------------------------------ bytes to numbers -- */

struct bytes {
    const uint8_t *p, *end;
    double last[8]; /* recent numbers, for reuse */
    unsigned count;
};

static unsigned next(struct bytes *b)
{
    return b->p < b->end ? *b->p++ : 0;
}

static double raw(struct bytes *b)
{
    uint64_t bits = 0;
    double value;
    for (int i = 0; i < 8; i++)
        bits = bits << 8 | next(b);
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Usually a small integer, so that lines touch, graze and lie along; otherwise a
 * recent number, perhaps moved by a few ulp, a power of two, or any double. */
static double draw(struct bytes *b)
{
    const unsigned kind = next(b);
    return kind < 128   ? (int)kind % 17 - 8
           : kind < 160 ? ((int)kind - 144) / 16.0
           : kind < 176 ? b->last[kind % 8]
           : kind < 192 ? -b->last[kind % 8]
           : kind < 216 ? stepped(b->last[kind % 8], (int)(kind / 8 % 8) - 3)
           : kind < 224 ? ldexp(1 + (kind & 1), (int)next(b) * 9 - 1074)
                        : raw(b);
}

static void numbers(struct bytes *b, double *to, int n)
{
    for (int i = 0; i < n; i++)
        to[i] = b->last[b->count++ % 8] = draw(b);
}

static void draw_line(struct bytes *b, struct family_case *c)
{
    c->line_word = (family_line)(next(b) % 4);
    numbers(b, c->line_data, family_line_size(c->line_word));
}

static void draw_shape(struct bytes *b, struct family_case *c)
{
    const unsigned kind = next(b);
    c->shape_word = kind < 240 ? (family_shape)(kind % 8) : FAMILY_HALFSPACE;
    c->ends = (cylint_ends)(kind / 8 % 6);
    numbers(b, c->shape_data, family_shape_size(c->shape_word));
    if (c->shape_word == FAMILY_ACONE)
        c->shape_data[6] *= 45;
    family_make(c);
}

/* ------------------------------------------------------------- one shape -- */

static void check_answer(const struct family_case *c)
{
#ifdef HAVE_MPFR
    cylint_answer got = {0}, want;
    cylint_intersect(&c->shape, &c->line, CYLINT_WANT_ALL, &got);
    oracle_intersect(&c->shape, &c->line, CYLINT_WANT_ALL, &want);
    MUST(is_right(&got, &want, oracle_other(0)));
    MUST(cylint_contains(&c->shape, c->line.o) ==
         oracle_contains(&c->shape, c->line.o));
#else
    (void)c;
#endif
}

/* Also in domains that end at a hit. */
static void check_shape(const struct family_case *c)
{
    cylint_answer a;
    cylint_intersect(&c->shape, &c->line, CYLINT_WANT_T, &a);
    check_answer(c);
    for (int i = 0; i < 2 * a.n; i++) {
        struct family_case within = *c;
        *(i % 2 ? &within.line.tmin : &within.line.tmax) = a.hit[i / 2].t;
        check_answer(&within);
    }
    for (unsigned want = 1; want <= CYLINT_WANT_NEAREST; want *= 2)
        MUST(has_wanted_members(c, want));
    MUST(has_wanted_members(c, CYLINT_WANT_T | CYLINT_WANT_PART |
                                   CYLINT_WANT_NEAREST));
}

/* ------------------------------------------------------------ many shapes -- */

static double doubles[COLUMNS][SHAPES_MOST];
static signed char words[COLUMNS][SHAPES_MOST];
static void *arrays[COLUMNS];

static cylint_columns all_columns(void)
{
    for (int i = 0; i < COLUMNS; i++)
        arrays[i] = column_size(i) == 1 ? (void *)words[i] : (void *)doubles[i];
    return columns_of(arrays);
}

static void check_pack(const cylint_pack *pack, const cylint_line *line)
{
    static struct line_answers due;
    const cylint_columns columns = all_columns();
    cylint_answer a;
    cylint_intersect_shapes(pack, line, &columns);
    for (size_t i = 0; i < pack->n; i++) {
        cylint_intersect(&pack->shapes[i], line, CYLINT_WANT_ALL, &a);
        MUST(is_column_answer(arrays, i, &a));
    }
    line_by_loop(pack->shapes, pack->n, line, &due);
    MUST(pack_agrees(pack, line, CYLINT_WANT_ALL, &due));
}

/* Several copies of the line, each with a later tmin. */
static void check_lines(const cylint_shape *s, const cylint_line *line)
{
    double v[8][LINES], *array[8];
    for (int i = 0; i < 8; i++)
        array[i] = v[i];
    cylint_line each = *line;
    for (size_t i = 0; i < LINES; i++, each.tmin += 1)
        set_columns(&each, array, i);
    const cylint_lines lines = lines_of(array, LINES, 3);
    const cylint_columns columns = all_columns();
    cylint_intersect_lines(s, &lines, &columns);
    each.tmin = line->tmin;
    for (size_t i = 0; i < LINES; i++, each.tmin += 1) {
        const cylint_line one = column_line(&each, 3);
        cylint_answer a;
        cylint_intersect(s, &one, CYLINT_WANT_ALL, &a);
        MUST(is_column_answer(arrays, i, &a));
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct bytes b = {data, data + size, {0, 1, 2, -1, 0.5, 3, 1e-3, 1e8}, 0};
    struct family_case c;
    cylint_shape shapes[SHAPES_MOST];
    cylint_pack pack;
    size_t count = 0;
    const char *name;
    memset(&c, 0, sizeof c);
    draw_line(&b, &c);
    for (; b.p < b.end && count < SHAPES_MOST; count++) {
        draw_shape(&b, &c);
        check_shape(&c);
        shapes[count] = c.shape;
    }
    void *memory = malloc(cylint_pack_bytes(count));
    MUST(memory);
    cylint_pack_shapes(&pack, memory, shapes, count);
    for (int i = 0; count > 0 && (name = cylint_kernels_name(i)); i++) {
        MUST(cylint_use_kernels(name));
        check_pack(&pack, &c.line);
        for (size_t j = 0; j < count; j++)
            check_lines(&shapes[j], &c.line);
    }
    MUST(cylint_use_kernels(NULL));
    free(memory);
    return 0;
}
