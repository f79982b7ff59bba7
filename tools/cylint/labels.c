/*
 * labels.c - the tails of a scene's lines: names of its shapes
 */
#include <stdlib.h>
#include <string.h>

#include "labels.h"
#include "main.h"
#include "report.h"

/* Makes space for `more` bytes; at least doubles the capacity. */
static int grow_bytes(struct labels *labels, size_t more)
{
    if (more <= labels->capacity - labels->length)
        return 0;
    const size_t twice = 2 * labels->capacity;
    const size_t capacity =
        labels->length + more > twice ? labels->length + more : twice;
    char *bytes = realloc(labels->bytes, capacity);
    if (!bytes)
        return out_of_memory();
    labels->bytes = bytes;
    labels->capacity = capacity;
    return 0;
}

static int grow_ends(struct labels *labels)
{
    if (labels->count < labels->end_capacity)
        return 0;
    const size_t end_capacity =
        labels->end_capacity > 0 ? 2 * labels->end_capacity : 64;
    uint64_t *end = end_capacity <= SIZE_MAX / sizeof *end
                        ? realloc(labels->end, end_capacity * sizeof *end)
                        : NULL;
    if (!end)
        return out_of_memory();
    labels->end = end;
    labels->end_capacity = end_capacity;
    return 0;
}

static int store_label(struct scene *scene, const struct record *record)
{
    struct labels *labels = scene->context;
    const size_t length = record->tail_length;
    int status = grow_ends(labels);
    if (status == 0 && length > 0)
        status = grow_bytes(labels, length);
    if (status != 0)
        return status;
    if (length > 0) {
        memcpy(labels->bytes + labels->length, record->tail, length);
        labels->length += length;
    }
    if (length > labels->longest)
        labels->longest = length;
    labels->end[labels->count++] = labels->length;
    return 0;
}

void labels_collect(struct labels *labels, struct scene *scene)
{
    scene->also = store_label;
    scene->context = labels;
}

void labels_give(struct labels *labels, struct scene *scene)
{
    if (labels->length > 0) {
        labels->table = (cylint_scene_labels){labels->end, labels->bytes};
        cylint_scene_set_labels(scene->shapes, &labels->table);
    }
}

int labels_take(struct labels *labels, const struct scene *scene,
                const char *file)
{
    const cylint_scene_labels *of = cylint_scene_get_labels(scene->shapes);
    if (!of)
        return 0;
    labels->table = *of;
    for (size_t i = 0; i < scene->count; i++) {
        const size_t length = labels_get(labels, i).length;
        if (length > labels->longest)
            labels->longest = length;
    }
    if (labels->longest > 0 &&
        memchr(of->text, '\n', (size_t)of->end[scene->count - 1])) {
        complain(file, "a label of the scene has a line feed");
        return EXIT_BAD;
    }
    return 0;
}

void labels_free(struct labels *labels)
{
    free(labels->bytes);
    free(labels->end);
}

struct label labels_get(const struct labels *labels, size_t shape)
{
    const cylint_scene_labels *t = &labels->table;
    const size_t begin = t->end && shape > 0 ? (size_t)t->end[shape - 1] : 0;
    const size_t length = t->end ? (size_t)t->end[shape] - begin : 0;
    return (struct label){length > 0 ? t->text + begin : "", length};
}
