/*
 * labels.c - the tails of a scene's lines, which are the labels of its shapes
 */
#include <string.h>

#include "labels.h"
#include "main.h"

static int store_label(struct scene *scene, const struct record *record)
{
    struct labels *labels = scene->context;
    if (record->tail_length > labels->longest)
        labels->longest = record->tail_length;
    return texts_add(&labels->texts, record->tail, record->tail_length)
               ? 0
               : out_of_memory();
}

void labels_collect(struct labels *labels, struct scene *scene)
{
    scene->also = store_label;
    scene->context = labels;
}

void labels_give(struct labels *labels, struct scene *scene)
{
    const struct texts *t = &labels->texts;
    if (t->length > 0) {
        labels->table = (cylint_scene_labels){t->end, t->bytes};
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
        labels->longest = length > labels->longest ? length : labels->longest;
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
    texts_free(&labels->texts);
}

struct label labels_get(const struct labels *labels, size_t shape)
{
    const cylint_scene_labels *t = &labels->table;
    return t->end ? text_at(t->end, t->text, shape) : (struct label){"", 0};
}

struct label name_of_shape(const struct labels *labels, size_t shape)
{
    struct label name = labels_get(labels, shape);
    name.length =
        (size_t)(field_end(name.text, name.text + name.length) - name.text);
    return name;
}
