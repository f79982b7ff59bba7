/*
 * scene_file.c - floor scene: fuzzes the opening of files of scenes
 *
 * An input chooses a small scene, whose file is then changed by edits; after them
 * the checksum is made right, so that the other checks must find what is wrong.
 * Byte 0 is the kind of the scene, byte 1 its size and (128) more queries; each edit has 11 bytes: what,
 * where (2) and a number (8).  Queries of a file that opens must end, and read
 * nothing beyond the bytes.
 */
#include <string.h>

#include "../scene_file.h"
#include "../scenes.h"
#include "fuzz.h"

enum { SIZES = 4, EDIT = 11, EDITS_MOST = 64, LINE = 64 };

/* A file at the begin of a cache line. */
struct file {
    char *data;
    size_t n;
};

static int append(void *context, const void *data, size_t n)
{
    struct file *f = context;
    f->data = realloc(f->data, f->n + n);
    MUST(f->data);
    memcpy(f->data + f->n, data, n);
    f->n += n;
    return 1;
}

static struct file make_file(int kind, int size)
{
    static const size_t sizes[SIZES] = {0, 1, 9, 24};
    struct scene_shapes of;
    struct file f = {NULL, 0};
    MUST(scene_generate(kind, sizes[size], 1, &of));
    cylint_scene *scene = cylint_scene_new(of.shapes, of.n, 1, NULL);
    MUST(scene);
    uint64_t end[24];
    for (size_t i = 0; i < of.n; i++)
        end[i] = i / 2;
    if (size == 2)
        cylint_scene_set_labels(scene,
                                &(cylint_scene_labels){end, "abcdefghijkl"});
    MUST(cylint_scene_write(scene, append, &f) == CYLINT_SCENE_OK);
    cylint_scene_free(scene);
    scene_release(&of);
    return f;
}

/* The file of a scene; made when it is used first. */
static const struct file *file_of(int kind, int size)
{
    static struct file made[SCENE_KINDS][SIZES];
    struct file *f = &made[kind][size];
    if (!f->data)
        *f = make_file(kind, size);
    return f;
}

/* Sets or copies some bytes.  64: in the header; 128: at a multiple of them. */
static void apply_edit(const uint8_t *edit, char *data, size_t n)
{
    const unsigned what = edit[0];
    const size_t bytes = (size_t)1 << what % 4;
    const size_t limit = what & 64 && n > 512 ? 512 : n;
    uint64_t number;
    size_t at = (size_t)(edit[1] + 256 * edit[2]) % (limit - bytes + 1);
    memcpy(&number, edit + 3, sizeof number);
    if (what & 128)
        at -= at % bytes;
    if (what & 16)
        memmove(data + at, data + number % (n - bytes + 1), bytes);
    else
        memcpy(data + at, &number, bytes);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 2 + EDIT || size > 2 + EDIT * EDITS_MOST)
        return 0;
    const struct file *f = file_of(data[0] % SCENE_KINDS, data[1] % SIZES);
    /* the memory ends with the file, so a sanitizer detects reading beyond */
    void *copy;
    MUST(posix_memalign(&copy, LINE, f->n) == 0);
    memcpy(copy, f->data, f->n);
    for (const uint8_t *edit = data + 2; edit + EDIT <= data + size;
         edit += EDIT)
        apply_edit(edit, copy, f->n);
    scene_file_repair(copy, f->n);
    scene_file_try(copy, f->n, data[1] & 128 ? 3 : 1);
    free(copy);
    return 0;
}
