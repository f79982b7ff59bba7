/*
 * labels.c - the labels of shapes, and groups of shapes
 */
#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "input.h"
#include "labels.h"

int labels_add(struct labels *labels, struct string label)
{
    struct texts *t = &labels->texts;
    if (!texts_add(t, label))
        return out_of_memory();
    labels->table = (cylint_scene_labels){t->end, t->bytes};
    if (label.length > labels->longest)
        labels->longest = label.length;
    return 0;
}

int labels_use(struct labels *labels, const cylint_scene *scene,
               const char *file)
{
    const cylint_scene_labels *saved = cylint_scene_get_labels(scene);
    const size_t count = cylint_scene_size(scene);
    if (!saved)
        return 0;
    labels->table = *saved;
    for (size_t i = 0; i < count; i++) {
        const struct string label = labels_get(labels, i);
        if (label.length > labels->longest)
            labels->longest = label.length;
        if (memchr(label.text, '\n', label.length) ||
            memchr(label.text, '\0', label.length))
            return complain(EXIT_BAD, file,
                            "shape %llu: its label has a line feed or NUL",
                            (unsigned long long)i + 1);
    }
    return 0;
}

void labels_free(struct labels *labels)
{
    texts_free(&labels->texts);
    memset(labels, 0, sizeof *labels);
}

struct string labels_get(const struct labels *labels, size_t shape)
{
    const cylint_scene_labels *t = &labels->table;
    return t->end ? text_at(t->end, t->text, shape) : (struct string){"", 0};
}

/* --------------------------------------------------------------- groups -- */

int groups_make(struct groups *g, const struct labels *labels, int is_total)
{
    size_t group;
    g->group_of = malloc((g->shapes + 1) * sizeof *g->group_of);
    if (!g->group_of)
        return out_of_memory();
    for (size_t i = 0; i < g->shapes; i++) {
        if (!names_add(&g->names, first_field(labels_get(labels, i)), &group))
            return out_of_memory();
        g->group_of[i] = (int)group;
    }
    g->is_total = is_total;
    g->columns = g->shapes > 0 && !is_total ? g->names.texts.count : 1;
    return 0;
}

void groups_free(struct groups *g)
{
    names_free(&g->names);
    free(g->group_of);
    free(g->rank);
}

/* ---------------------------------------------------------------- ranks -- */

enum { NO_RANK = INT_MIN };

/* The file as it is read. */
struct rank_file {
    const struct groups *groups;
    int *rank; /* of each group, or NO_RANK */
};

/* Reads an integer.  Returns 0 if the text is none. */
static int read_rank(struct string s, int *rank)
{
    const int has_sign = *s.text == '-' || *s.text == '+';
    unsigned long long size;
    const int is_whole =
        read_whole(between(s.text + has_sign, end_of(s)), INT_MAX, &size);
    *rank = *s.text == '-' ? -(int)size : (int)size;
    return is_whole;
}

/* Stores the rank.  A label that no shape has is a remark. */
static int store_rank(struct rank_file *f, struct string name, int rank,
                      struct notes *notes)
{
    const size_t group = names_find(&f->groups->names, name);
    if (group < f->groups->names.texts.count) {
        if (f->rank[group] != NO_RANK)
            return refuse_text(notes, "this label has a rank already", name);
        f->rank[group] = rank;
    } else if (wants_remark(notes, REMARK_LABEL)) {
        refuse_text(notes, "no shape has this label", name);
        make_remark(notes, REMARK_LABEL);
    }
    return 0;
}

/* A line LABEL INTEGER. */
static int read_ranking(void *context, const char *line, const char *end,
                        struct notes *notes)
{
    struct reader r;
    int rank;
    if (begin_line(&r, line, end, notes))
        return EXIT_BAD;
    const struct string name = field(&r);
    if (name.length == 0)
        return refuse_other_field(&r, "a label");
    skip_field(&r);
    if (!read_rank(field(&r), &rank))
        return refuse_other(notes, "an integer from -2147483647 to 2147483647",
                            field(&r));
    skip_field(&r);
    return r.p < r.end ? refuse_other(notes, "the end of the line", field(&r))
                       : store_rank(context, name, rank, notes);
}

/* Names without a line have the rank 0. */
int groups_read_ranks(struct groups *g, const char *file)
{
    const size_t count = g->names.texts.count;
    struct rank_file f = {.groups = g};
    f.rank = malloc((count + 1) * sizeof *f.rank);
    g->rank = malloc((g->shapes + 1) * sizeof *g->rank);
    int status = EXIT_MEMORY;
    if (f.rank && g->rank) {
        for (size_t i = 0; i < count; i++)
            f.rank[i] = NO_RANK;
        status = read_lines(file, 0, read_ranking, &f);
    } else {
        out_of_memory();
    }
    for (size_t i = 0; i < g->shapes && status == 0; i++)
        g->rank[i] =
            f.rank[g->group_of[i]] == NO_RANK ? 0 : f.rank[g->group_of[i]];
    free(f.rank);
    return status;
}

/* ------------------------------------------------------------- left out -- */

int left_out_has(const struct left_out *l, size_t group)
{
    for (int i = 0; i < l->count; i++)
        if (l->group[i] == group)
            return 1;
    return 0;
}

/* Writes the group with this name.  Returns 0 if there is none. */
static int find_group(const struct groups *g, int by_label, struct string name,
                      size_t *group)
{
    unsigned long long number = 0;
    if (by_label) {
        *group = names_find(&g->names, name);
        return *group < g->names.texts.count;
    }
    const int is_number = read_whole(name, g->shapes, &number);
    *group = (size_t)number - 1;
    return is_number && number > 0;
}

static int leave_out(struct left_out *l, const struct groups *g, int by_label,
                     struct string word, struct notes *notes)
{
    const struct string name =
        between(word.text + strlen(NOT_WORD), end_of(word));
    size_t group;
    if (name.length == 0)
        return refuse_text(notes, "not= without a number or label", name);
    if (find_group(g, by_label, name, &group)) {
        if (l->count == LEFT_OUT_MOST && !left_out_has(l, group))
            return refuse_text(notes, "more than 64 words not=", name);
        if (!left_out_has(l, group))
            l->group[l->count++] = group;
    } else if (!by_label) {
        return refuse_other(notes, "the number of a shape of the scene", name);
    } else if (wants_remark(notes, REMARK_LABEL)) {
        refuse_text(notes, "no shape has this label", name);
        advise(notes, "nothing is left out");
        make_remark(notes, REMARK_LABEL);
    }
    return 0;
}

int left_out_read(struct left_out *l, const struct groups *g, int by_label,
                  struct string words, struct notes *notes)
{
    int status = 0;
    l->count = 0;
    while (words.length > 0 && status == 0)
        status = leave_out(l, g, by_label, take_field(&words), notes);
    return status;
}
