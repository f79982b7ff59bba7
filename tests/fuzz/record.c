/*
 * record.c - fuzzes the grammar of a record
 *
 * The first two bytes set the kinds of a record, the others are its text, in memory
 * that ends with it.  numbers_agree.c compares numbers with strtod().
 */
#include <math.h>
#include <string.h>

#include "cylint_distance.h"
#include "../../tools/cylint/grammar.h"
#include "../../tools/cylint/text.h"
#include "fuzz.h"

/* The note of a bad record, which begins at notes->text. */
static void check_note(struct notes *notes, const char *end)
{
    count_bad(notes);
    const struct note *note = &notes->note[0];
    MUST(notes->kept == 1 && note->remark == REMARK_NONE && note->text[0]);
    MUST(note->column >= 1 &&
         note->column <= (unsigned long long)(end - notes->text) + 1);
}

static void check_record(const struct grammar *g, const struct record *r)
{
    cylint_answer answer;
    MUST(!g->has_line || r->is_point || r->line.valid);
    MUST(!g->has_shape || r->shape.kind != CYLINT_KIND_NONE);
    MUST(memchr(r->tail.text, '\0', r->tail.length) == NULL);
    if (g->has_line && g->has_shape && r->is_point) {
        cylint_closest closest;
        const double d =
            cylint_distance(&r->shape, r->point, CYLINT_WANT_PART, &closest);
        MUST(d - d == 0 || d > 0);
    } else if (g->has_line && g->has_shape) {
        const int n =
            cylint_intersect(&r->shape, &r->line, CYLINT_WANT_ALL, &answer);
        MUST(n == answer.n && n >= 0 && n <= 2 && answer.flags == 0);
    }
}

static struct grammar make_grammar(unsigned a, unsigned b)
{
    struct grammar g = {0};
    g.has_line = a % 3 != 0;
    g.has_shape = a % 3 != 1;
    const int kind = (int)(a / 3 % (LINE_POINT + 2)) - 1;
    g.line = g.has_line ? kind : NOT_GIVEN;
    g.shape = g.has_shape && g.line != NOT_GIVEN
                  ? (int)(a / 18 % CYLINT_KIND_HALFSPACE)
                  : NOT_GIVEN;
    g.ends = (int)(b % 7) - 1;
    g.has_domain = b / 7 % 2 != 0;
    g.no_tail = b / 14 % 2 != 0;
    g.domain[0] = g.has_domain ? -1 : 0;
    g.domain[1] = g.has_domain ? HUGE_VAL : 0;
    return g;
}

static void check_line(const struct grammar *g, const char *text,
                       const char *end)
{
    struct record record;
    struct notes notes = {.line = 1, .text = text, .end = end, .wanted = ~0u};
    if (!is_record(text, end))
        return;
    memset(&record, 0, sizeof record);
    if (read_record(g, text, end, &record, &notes) == 0) {
        MUST(text <= record.tail.text && end_of(record.tail) <= end);
        check_record(g, &record);
    } else {
        check_note(&notes, end);
    }
}

static void check_doubles(const struct grammar *g, const char *bytes,
                          size_t size)
{
    double numbers[MOST_NUMBERS] = {0};
    struct record record;
    struct notes notes = {0};
    if (g->line == NOT_GIVEN)
        return;
    memcpy(numbers, bytes, size < sizeof numbers ? size : sizeof numbers);
    memset(&record, 0, sizeof record);
    record.tail = string_of("");
    if (record_of_numbers(g, numbers, &record, &notes) == 0)
        check_record(g, &record);
    else
        MUST(notes.note[0].text[0]);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 2)
        return 0;
    const struct grammar g = make_grammar(data[0], data[1]);
    char *text = malloc(size - 1);
    MUST(text);
    memcpy(text, data + 2, size - 2);
    char *end = text + size - 2;
    *end = '\n';
    check_doubles(&g, text, size - 2);
    const char *stop;
    for (const char *p = text; p < end; p = stop + 1) {
        stop = end_of_line(p, end);
        check_line(&g, p, stop);
    }
    free(text);
    return 0;
}
