/*
 * left_out.c - shapes that a record leaves out: not=NUMBER or not=LABEL
 */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "left_out.h"
#include "report.h"

struct label groups_name(const struct labels *labels, size_t shape)
{
    struct label name = labels_get(labels, shape);
    name.length =
        (size_t)(field_end(name.text, name.text + name.length) - name.text);
    return name;
}

static int compare_names(struct label a, struct label b)
{
    const size_t shorter = a.length < b.length ? a.length : b.length;
    const int order = memcmp(a.text, b.text, shorter);
    return order != 0 ? order : (a.length > b.length) - (a.length < b.length);
}

/* ------------------------------------------------------------- groups -- */

/* Merges order[begin, middle) and order[middle, end), which are sorted. */
static void merge(const struct groups *g, size_t *merged, size_t begin,
                  size_t middle, size_t end)
{
    size_t a = begin, b = middle;
    for (size_t i = begin; i < end; i++) {
        const int takes_a =
            b == end ||
            (a < middle &&
             compare_names(groups_name(g->labels, g->order[a]),
                           groups_name(g->labels, g->order[b])) <= 0);
        merged[i] = g->order[takes_a ? a++ : b++];
    }
    memcpy(g->order + begin, merged + begin, (end - begin) * sizeof *merged);
}

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Merge sort, because qsort() cannot pass the labels to its comparison.
 * first[] is the second array. */
static void sort_by_name(const struct groups *g)
{
    for (size_t i = 0; i < g->shapes; i++)
        g->order[i] = i;
    for (size_t half = 1; half < g->shapes; half *= 2) {
        for (size_t begin = 0; begin + half < g->shapes; begin += 2 * half) {
            merge(g, g->first, begin, begin + half,
                  least(begin + 2 * half, g->shapes));
        }
    }
}

static void find_groups(const struct groups *g)
{
    size_t begin = 0;
    for (size_t i = 0; i < g->shapes; i++) {
        if (compare_names(groups_name(g->labels, g->order[begin]),
                          groups_name(g->labels, g->order[i])) != 0)
            begin = i;
        g->first[g->order[i]] = begin;
    }
}

int groups_make(struct groups *g, size_t shapes, const struct labels *labels)
{
    g->shapes = shapes;
    g->labels = labels;
    if (!labels)
        return 0;
    g->order = malloc((shapes + 1) * sizeof *g->order);
    g->first = malloc((shapes + 1) * sizeof *g->first);
    if (!g->order || !g->first)
        return out_of_memory();
    sort_by_name(g);
    find_groups(g);
    return 0;
}

void groups_free(struct groups *g)
{
    free(g->order);
    free(g->first);
}

size_t groups_find(const struct groups *g, struct label name)
{
    size_t begin = 0, end = g->shapes;
    while (begin < end) {
        const size_t middle = begin + (end - begin) / 2;
        if (compare_names(groups_name(g->labels, g->order[middle]), name) < 0)
            begin = middle + 1;
        else
            end = middle;
    }
    return begin < g->shapes &&
                   compare_names(groups_name(g->labels, g->order[begin]),
                                 name) == 0
               ? begin
               : g->shapes;
}

/* The shape with this number, counted from 1; `shapes` if there is none. */
static size_t find_number(const struct groups *g, struct label name)
{
    size_t number = 0;
    for (size_t i = 0; i < name.length; i++) {
        const char c = name.text[i];
        if (c < '0' || c > '9' || number > g->shapes)
            return g->shapes;
        number = 10 * number + (size_t)(c - '0');
    }
    return number >= 1 && number <= g->shapes ? number - 1 : g->shapes;
}

/* -------------------------------------------------------- one record's -- */

static int has_group(const struct left_out *l, size_t group)
{
    for (int i = 0; i < l->count; i++)
        if (l->group[i] == group)
            return 1;
    return 0;
}

static int refuse(struct fault *fault, const char *what, int expected,
                  struct label name)
{
    *fault = (struct fault){.what = what,
                            .expected = expected,
                            .at = name.text,
                            .end = name.text + name.length};
    return 0;
}

static void remark_label(struct remarks *remarks, struct label name)
{
    if (remarks && remarks->wanted & 1u << REMARK_LABEL) {
        struct fault *f = &remarks->fault[REMARK_LABEL];
        remarks->found |= 1u << REMARK_LABEL;
        refuse(f, "no shape has this label", 0, name);
        f->remedy = "nothing is left out";
    }
}

static int leave_out(struct left_out *l, struct label name,
                     struct remarks *remarks, struct fault *fault)
{
    const struct groups *g = l->groups;
    if (name.length == 0)
        return refuse(fault, "not= without a number or label", 0, name);
    const size_t group =
        g->labels ? groups_find(g, name) : find_number(g, name);
    if (group == g->shapes && !g->labels)
        return refuse(fault, "the number of a shape of the scene", 1, name);
    if (group == g->shapes) {
        remark_label(remarks, name);
    } else if (!has_group(l, group)) {
        if (l->count == LEFT_OUT_MOST)
            return refuse(fault, "more than 64 words not=", 0, name);
        l->group[l->count++] = group;
    }
    return 1;
}

int left_out_read(struct left_out *l, const struct groups *groups,
                  const char *words, size_t length, struct remarks *remarks,
                  struct fault *fault)
{
    const char *const end = words + length;
    l->groups = groups;
    l->count = 0;
    for (const char *p = words; p < end;) {
        const char *name = p + strlen(NOT_WORD);
        const char *after = field_end(name, end);
        if (!leave_out(l, (struct label){name, (size_t)(after - name)}, remarks,
                       fault))
            return 0;
        p = skip_separator(after, end);
    }
    return 1;
}

int left_out_has(const struct left_out *l, size_t shape)
{
    return l->count > 0 &&
           has_group(l, l->groups->labels ? l->groups->first[shape] : shape);
}
