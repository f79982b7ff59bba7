/*
 * scene_read.c - reads a scene from a file of shapes, or of a neuron's nodes
 */
#include <stdint.h>
#include <string.h>

#include "block.h"
#include "input.h"
#include "main.h"
#include "saved.h"
#include "scene_read.h"

/* Prints the message about a bad line. */
static int refuse_line(struct block *b, unsigned long long number,
                       const char *line, const struct fault *fault)
{
    take_note(&b->notes, number, 0, line, b->text + b->length, fault);
    print_note(&b->notes.note[0], b->name);
    return EXIT_BAD;
}

/* Adds the shape of the record, and to the solids that it names. */
static int add_shape(struct scene *scene, const struct record *r,
                     struct fault *fault)
{
    const size_t shape = scene->count;
    const int status = scene_add(scene, r);
    return status != 0 || r->solids_length == 0
               ? status
               : solids_read(&scene->solids, shape, r->solids, r->solids_length,
                             fault);
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
            if (saved_begins(b->text, b->length)) {
                fault.remedy = "a saved scene cannot be read from a pipe";
            }
            return refuse_line(b, number, p, &fault);
        }
        fault.what = NULL;
        const int status = add_shape(scene, &b->parsed, &fault);
        if (status != 0) {
            return fault.what ? refuse_line(b, number, p, &fault) : status;
        }
        p = stop + 1;
    }
    return 0;
}

#define MOLECULE "convert it with python -m libcylint convert molecule"

/* Returns the command that converts a file with this name, or NULL. */
static const char *converter_of(const char *file)
{
    static const char *const remedies[][2] = {
        {".csv", "for a tree see python -m libcylint convert qsm"},
        {".pdb", MOLECULE},
        {".ent", MOLECULE},
        {".cif", MOLECULE},
        {".mmcif", MOLECULE}};
    const char *dot = strrchr(file, '.');
    for (size_t i = 0; dot && i < sizeof remedies / sizeof *remedies; i++) {
        if (strcmp(dot, remedies[i][0]) == 0) {
            return remedies[i][1];
        }
    }
    return NULL;
}

int scene_read_text(struct scene *scene, const char *file, int ends,
                    enum swc_form form)
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
    scene->solids.file = file;
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
            status = swc_add_shapes(&swc, scene, ends, form, file);
        }
        input_close(&in);
    }
    swc_free(&swc);
    block_free(&block);
    return status;
}

int scene_read(struct scene *scene, const char *file, int ends,
               enum swc_form form)
{
    struct scene saved = {0};
    int status = saved_open(&saved, file, ends);
    if (status == NOT_SAVED) {
        return scene_read_text(scene, file, ends, form);
    }
    if (status == 0) {
        status = saved_add(&saved, file, scene);
    }
    scene_free(&saved);
    return status;
}
