/*
 * saved.c - scenes in files of cylint_scene_save()
 */
#include <string.h>
#include <sys/stat.h>

#include "labels.h"
#include "main.h"
#include "output.h"
#include "report.h"
#include "saved.h"

static int is_regular(const char *file)
{
    struct stat about;
    return strcmp(file, "-") != 0 && stat(file, &about) == 0 &&
           S_ISREG(about.st_mode);
}

int saved_open(struct scene *scene, const char *file, int ends)
{
    cylint_scene_status status = CYLINT_SCENE_EFORMAT;
    if (is_regular(file))
        scene->shapes = cylint_scene_open(file, 0, &status);
    if (status == CYLINT_SCENE_EFORMAT || status == CYLINT_SCENE_EFILE)
        return NOT_SAVED;
    if (status == CYLINT_SCENE_EMEMORY)
        return out_of_memory();
    if (status != CYLINT_SCENE_OK) {
        complain(file, cylint_scene_strerror((int)status));
        return EXIT_IO;
    }
    if (ends != NOT_GIVEN) {
        complain(file, "is a saved scene, whose shapes have their ends");
        return EXIT_USAGE;
    }
    scene->count = cylint_scene_size(scene->shapes);
    return 0;
}

int saved_begins(const char *bytes, size_t length)
{
    cylint_scene_status status;
    cylint_scene_free(cylint_scene_open_memory(bytes, length, 0, &status));
    return status != CYLINT_SCENE_EFORMAT && status != CYLINT_SCENE_EMEMORY;
}

int saved_add(const struct scene *saved, const char *file, struct scene *scene)
{
    struct labels labels = {0};
    int status = labels_take(&labels, saved, file);
    for (size_t i = 0; i < saved->count && status == 0; i++) {
        const struct label label = labels_get(&labels, i);
        struct record record = {.tail = label.text,
                                .tail_length = label.length};
        scene_shape(saved, i, &record.shape);
        status = scene_add(scene, &record);
    }
    for (size_t i = 0; i < cylint_scene_members(saved->shapes) && status == 0;
         i++) {
        cylint_member member;
        cylint_scene_member(saved->shapes, i, &member);
        status = solids_add(&scene->solids, &member);
    }
    return status;
}

/* The context of write_part(). */
struct writing {
    struct output out;
    int status; /* exit status */
};

/* Some systems write less than 2 GiB at once. */
static int write_part(void *context, const void *data, size_t bytes)
{
    const size_t most = (size_t)1 << 30;
    struct writing *w = context;
    for (const char *at = data; bytes > 0 && w->status == 0;) {
        const size_t part = bytes < most ? bytes : most;
        w->status = output_write(&w->out, at, part);
        at += part;
        bytes -= part;
    }
    return w->status == 0;
}

int saved_write(struct scene *scene, int threads, const char *file)
{
    struct writing w = {.out = {.row = 1, .array = -1}};
    int status = search_build(scene->shapes, threads);
    if (status != 0 || (status = target_open(&w.out.target, file)) != 0)
        return status;
    cylint_scene_write(scene->shapes, write_part, &w);
    const int closed = output_close(&w.out, w.status == 0);
    return w.status != 0 ? w.status : closed;
}
