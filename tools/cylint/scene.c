/*
 * scene.c - the shapes that every line is asked about
 *
 * By asking all of them.  The order of the shapes decides ties, so whatever
 * finds candidates faster must give the lower number of equal t.
 */
#include <stdint.h>
#include <stdlib.h>

#include "block.h"
#include "input.h"
#include "main.h"
#include "scene.h"

static int add_shape(struct scene *scene, const cylint_shape *shape)
{
    if (scene->count == scene->room) {
        const size_t room = scene->room > 0 ? 2 * scene->room : 64;
        if (room > SIZE_MAX / sizeof *shape) {
            return out_of_memory();
        }
        cylint_shape *more = realloc(scene->shapes, room * sizeof *shape);
        if (!more) {
            return out_of_memory();
        }
        scene->shapes = more;
        scene->room = room;
    }
    scene->shapes[scene->count++] = *shape;
    return 0;
}

static int read_shapes(struct scene *scene, const struct grammar *g,
                       struct block *b)
{
    const char *end = b->text + b->length;
    unsigned long long number = b->line;
    for (const char *p = b->text; p < end; number++) {
        const char *stop = end_of_line(p, end);
        struct fault fault;
        if (!is_record(p, stop)) {
            p = stop + 1;
            continue;
        }
        if (!read_record(g, p, stop, &b->parsed, &fault)) {
            take_note(&b->notes, number, 0, p, &fault);
            print_note(&b->notes.note[0], b->name);
            return EXIT_BAD;
        }
        const int status = add_shape(scene, &b->parsed.shape);
        if (status != 0) {
            return status;
        }
        p = stop + 1;
    }
    return 0;
}

int scene_read(struct scene *scene, const char *file, int ends)
{
    const struct grammar g = {0, 1, NOT_GIVEN, NOT_GIVEN, ends, 0, 0, 0};
    char *const files[] = {(char *)(uintptr_t)file};
    struct input in;
    struct block block;
    int status = block_make(&block, 0);
    if (status == 0) {
        status = input_open(&in, files, 1, 0);
        while (status == 0 && (status = input_next(&in, &block)) == 0
               && block.length > 0) {
            status = read_shapes(scene, &g, &block);
        }
        input_close(&in);
    }
    block_free(&block);
    return status;
}

void scene_free(struct scene *scene)
{
    free(scene->shapes);
    scene->shapes = NULL;
}

int ask(solver method, const cylint_shape *shape, const cylint_line *line,
        unsigned want, cylint_answer *answer)
{
    if (method) {
        return method(shape, line, want, answer) == CYLINT_OK;
    }
    cylint_intersect(shape, line, want, answer);
    return 1;
}

int ask_any(solver method, const cylint_shape *shape, const cylint_line *line,
            int *hit)
{
    cylint_answer answer;
    if (!method) {
        *hit = cylint_occluded(shape, line);
        return 1;
    }
    const int answered = ask(method, shape, line, CYLINT_WANT_COUNT, &answer);
    *hit = answered && answer.n > 0;
    return answered;
}

size_t scene_nearest(const struct scene *scene, solver method,
                     const cylint_line *line, unsigned want,
                     cylint_answer *answer, struct row *row)
{
    const unsigned first = CYLINT_WANT_T | CYLINT_WANT_NEAREST;
    double t = 0;
    row->answer = NULL;
    row->shape = 0;
    for (size_t i = 0; i < scene->count; i++) {
        if (!ask(method, &scene->shapes[i], line, first, answer)) {
            return i + 1;
        }
        if (answer->n > 0 && (row->shape == 0 || answer->hit[0].t < t)) {
            row->shape = i + 1;
            t = answer->hit[0].t;
        }
    }
    if (row->shape > 0) {
        row->answer = answer;
        ask(method, &scene->shapes[row->shape - 1], line,
            want | CYLINT_WANT_NEAREST, answer);
    }
    return 0;
}

size_t scene_count(const struct scene *scene, solver method,
                   const cylint_line *line, unsigned long long most,
                   struct row *row)
{
    row->count = 0;
    for (size_t i = 0; i < scene->count && row->count < most; i++) {
        int hit;
        if (!ask_any(method, &scene->shapes[i], line, &hit)) {
            return i + 1;
        }
        row->count += (unsigned long long)hit;
    }
    return 0;
}
