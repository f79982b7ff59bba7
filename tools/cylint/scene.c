/*
 * scene.c - the shapes that every line is asked about
 *
 * The library asks all of them at once; a published method is asked about one
 * after the other.  Of equal t the lower number is nearest either way.
 */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "block.h"
#include "input.h"
#include "main.h"
#include "scene.h"
#include "swc.h"

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

int scene_add(struct scene *scene, const struct record *record)
{
    const int status = scene->also ? scene->also(scene, record) : 0;
    return status != 0 ? status : add_shape(scene, &record->shape);
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
            take_note(&b->notes, number, 0, p, end, &fault);
            print_note(&b->notes.note[0], b->name);
            return EXIT_BAD;
        }
        const int status = scene_add(scene, &b->parsed);
        if (status != 0) {
            return status;
        }
        p = stop + 1;
    }
    return 0;
}

/* How a file of another program becomes a scene, by the file's name. */
static const char *converter_of(const char *file)
{
    static const char *const remedies[][2] = {
        {".csv", "convert it with qsm2scene"},
        {".pdb", "convert it with pdb2scene"},
        {".ent", "convert it with pdb2scene"},
        {".cif", "convert it with pdb2scene"},
        {".mmcif", "convert it with pdb2scene"},
        {".pov", "convert it with pov2scene"},
        {".inc", "convert it with pov2scene"}};
    const char *dot = strrchr(file, '.');
    for (size_t i = 0; dot && i < sizeof remedies / sizeof *remedies; i++) {
        if (strcmp(dot, remedies[i][0]) == 0) {
            return remedies[i][1];
        }
    }
    return NULL;
}

int scene_read(struct scene *scene, const char *file, int ends)
{
    const struct grammar g = {.has_shape = 1,
                              .line = NOT_GIVEN,
                              .shape = NOT_GIVEN,
                              .ends = ends,
                              .convert = converter_of(file)};
    char *const files[] = {(char *)(uintptr_t)file};
    const int is_swc = swc_is_name(file);
    struct swc swc = {0};
    struct input in;
    struct block block;
    int status = block_make(&block, 0, 0);
    if (status == 0) {
        status = input_open(&in, files, 1, 0);
        in.cr_ends_lines = is_swc;
        while (status == 0 && (status = input_next(&in, &block)) == 0 &&
               block.length > 0) {
            status = is_swc ? swc_read_nodes(&swc, &block)
                            : read_shapes(scene, &g, &block);
        }
        if (status == 0 && is_swc) {
            status = swc_add_frusta(&swc, scene, ends, file);
        }
        input_close(&in);
    }
    swc_free(&swc);
    block_free(&block);
    return status;
}

int scene_prepare(struct scene *scene, enum accel accel, int threads)
{
    return search_make(&scene->search, scene->shapes, scene->count, accel,
                       threads);
}

void scene_free(struct scene *scene)
{
    search_free(&scene->search);
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

static int ask_any(solver method, const cylint_shape *shape,
                   const cylint_line *line, int *hit)
{
    cylint_answer answer;
    const int answered = ask(method, shape, line, CYLINT_WANT_COUNT, &answer);
    *hit = answered && answer.n > 0;
    return answered;
}

/* Sets row->shape.  Returns 0, or the shape the method does not answer for. */
static size_t nearest_by_method(const struct scene *scene, solver method,
                                const cylint_line *line, struct row *row)
{
    const unsigned first = CYLINT_WANT_T | CYLINT_WANT_NEAREST;
    double t = 0;
    row->shape = 0;
    for (size_t i = 0; i < scene->count; i++) {
        cylint_answer answer;
        if (!ask(method, &scene->shapes[i], line, first, &answer)) {
            return i + 1;
        }
        if (answer.n > 0 && (row->shape == 0 || answer.hit[0].t < t)) {
            row->shape = i + 1;
            t = answer.hit[0].t;
        }
    }
    return 0;
}

/* What is shown of the shape is asked of that one alone. */
size_t scene_nearest(const struct scene *scene, solver method,
                     const cylint_line *line, unsigned want,
                     cylint_answer *answer, struct row *row)
{
    row->answer = NULL;
    if (method) {
        const size_t refused = nearest_by_method(scene, method, line, row);
        if (refused > 0) {
            return refused;
        }
    } else {
        const size_t i = search_nearest(&scene->search, line);
        row->shape = i < scene->count ? i + 1 : 0;
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
    if (!method) {
        const size_t enough = most < SIZE_MAX ? (size_t)most : 0;
        row->count = search_count(&scene->search, line, enough);
        return 0;
    }
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
