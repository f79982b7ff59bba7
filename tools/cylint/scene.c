/*
 * scene.c - the shapes of a file: of text, of a neuron's nodes, or a saved
 * scene
 */
#include <string.h>
#include <sys/stat.h>

#include "input.h"
#include "scene.h"

/* Returns 0 for the status OK of the library, else an exit status after a message:
 * EXIT_MEMORY or `otherwise`. */
static int exit_status_of(cylint_scene_status status, const char *file,
                          int otherwise)
{
    return status == CYLINT_SCENE_OK ? 0
           : status == CYLINT_SCENE_EMEMORY
               ? out_of_memory()
               : complain(otherwise, file, "%s",
                          cylint_scene_strerror((int)status));
}

static int scene_begin(struct scene *scene)
{
    if (!scene->shapes)
        scene->shapes = cylint_scene_begin(0);
    return scene->shapes ? 0 : out_of_memory();
}

int scene_add(struct scene *scene, const struct record *record)
{
    int status =
        scene->keeps_labels ? labels_add(&scene->labels, record->tail) : 0;
    if (status == 0)
        status = scene_begin(scene);
    if (status == 0)
        status =
            exit_status_of(cylint_scene_add(scene->shapes, &record->shape, 1),
                           scene->file, EXIT_BAD);
    scene->count += status == 0;
    return status;
}

int scene_build(struct scene *scene, int threads)
{
    int status = scene_begin(scene);
    if (status != 0)
        return status;
    const cylint_scene_status finished =
        cylint_scene_finish(scene->shapes, threads, NULL, NULL);
    const struct solids *s = &scene->solids;
    if (finished != CYLINT_SCENE_EFINISHED)
        status = exit_status_of(finished, scene->file, EXIT_BAD);
    if (status == 0 && s->count > 0)
        status = exit_status_of(
            cylint_scene_set_solids(scene->shapes, s->member, s->count),
            scene->file, EXIT_BAD);
    return status;
}

void scene_free(struct scene *scene)
{
    solids_free(&scene->solids);
    cylint_scene_free(scene->shapes);
    scene->shapes = NULL;
    labels_free(&scene->labels);
}

/* ----------------------------------------------------------------- text -- */

/* The context of add_shape_of_line(). */
struct reading {
    struct scene *scene;
    struct grammar grammar;
};

/* Adds the shape of a line, and to the solids that it names. */
static int add_shape_of_line(void *context, const char *line, const char *end,
                             struct notes *notes)
{
    struct reading *r = context;
    struct record record;
    const size_t number = r->scene->count;
    if (read_record(&r->grammar, line, end, &record, notes))
        return EXIT_BAD;
    const int status = scene_add(r->scene, &record);
    return status != 0 || record.words.length == 0
               ? status
               : solids_read(&r->scene->solids, number, record.words, notes);
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
    for (size_t i = 0; dot && i < sizeof remedies / sizeof *remedies; i++)
        if (strcmp(dot, remedies[i][0]) == 0)
            return remedies[i][1];
    return NULL;
}

int scene_read_text(struct scene *scene)
{
    const char *const file = scene->file;
    struct reading reading = {scene,
                              {.has_shape = 1,
                               .line = NOT_GIVEN,
                               .shape = NOT_GIVEN,
                               .ends = scene->ends,
                               .convert = converter_of(file)}};
    if (swc_is_neuron(file, scene->swc_form))
        return swc_read(scene);
    const int status = read_lines(file, 0, add_shape_of_line, &reading);
    return status == 0 ? solids_complete(&scene->solids, scene->count, file)
                       : status;
}

/* --------------------------------------------------------- saved scenes -- */

static int is_regular(const char *file)
{
    struct stat about;
    return strcmp(file, "-") != 0 && stat(file, &about) == 0 &&
           S_ISREG(about.st_mode);
}

int scene_open(struct scene *scene)
{
    const char *const file = scene->file;
    cylint_scene_status status = CYLINT_SCENE_EFORMAT;
    if (is_regular(file))
        scene->shapes = cylint_scene_open(file, 0, &status);
    if (status == CYLINT_SCENE_EFORMAT || status == CYLINT_SCENE_EFILE)
        return NOT_SAVED;
    if (scene->ends != NOT_GIVEN)
        return complain(
            EXIT_USAGE, file,
            "is a saved scene, whose shapes have their ends already");
    if (scene->swc_form != NOT_GIVEN)
        return complain(EXIT_USAGE, file, "is a saved scene, not a neuron");
    scene->count = scene->shapes ? cylint_scene_size(scene->shapes) : 0;
    return status == CYLINT_SCENE_OK && scene->keeps_labels
               ? labels_use(&scene->labels, scene->shapes, file)
               : exit_status_of(status, file, EXIT_IO);
}

static int add_saved(struct scene *scene, const struct scene *saved)
{
    int status = 0;
    for (size_t i = 0; i < saved->count && status == 0; i++) {
        struct record record = {.tail = labels_get(&saved->labels, i)};
        cylint_scene_shape(saved->shapes, i, &record.shape);
        status = scene_add(scene, &record);
    }
    const size_t members = cylint_scene_members(saved->shapes);
    for (size_t i = 0; i < members && status == 0; i++) {
        cylint_member member;
        cylint_scene_member(saved->shapes, i, &member);
        status = solids_add(&scene->solids, &member);
    }
    return status;
}

int scene_read(struct scene *scene)
{
    struct scene saved = {scene->file, scene->ends, scene->swc_form,
                          .keeps_labels = 1};
    int status = scene_open(&saved);
    if (status == NOT_SAVED)
        status = scene_read_text(scene);
    else if (status == 0)
        status = add_saved(scene, &saved);
    scene_free(&saved);
    return status;
}

/* The context of write_part(). */
struct writing {
    struct output out;
    int status; /* exit status */
};

static int write_part(void *context, const void *data, size_t bytes)
{
    struct writing *w = context;
    w->status = output_write(&w->out, data, bytes);
    return w->status == 0;
}

int scene_save(struct scene *scene, const char *file)
{
    struct writing w = {.status = 0};
    const int status = output_open(&w.out, file, 1);
    if (status != 0)
        return status;
    if (scene->labels.texts.length > 0)
        cylint_scene_set_labels(scene->shapes, &scene->labels.table);
    cylint_scene_write(scene->shapes, write_part, &w);
    const int closed = output_close(&w.out, w.status == 0);
    return w.status != 0 ? w.status : closed;
}
