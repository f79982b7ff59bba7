/*
 * scene_file.c - fuzzes files of scenes
 *
 * An input is such a file, which is opened and queried.  Of seven files in eight
 * the checksum is made right before.  libFuzzer changes bytes; the first input, and
 * some others, is the file of a scene of scenes.h.
 */
#include <math.h>
#include <string.h>

#include "scene_file.h"
#include "scenes.h"

/* ------------------------------------------------------------- the file -- */

enum { MOST_SHAPES = 33 };

/* Solids of three shapes; the second of each is a complement. */
static void set_solids(cylint_scene *scene, size_t n)
{
    cylint_member members[MOST_SHAPES];
    for (size_t i = 0; i < n; i++)
        members[i] =
            (cylint_member){i, i / 3, i % 3 == 1 ? -2 : 1 + (int)(i % 2)};
    MUST(cylint_scene_set_solids(scene, members, n) == CYLINT_SCENE_OK);
}

/* The file of a scene of this kind and size; in some, every second shape has a
 * label, or the shapes form solids. */
static void write_scene(int kind, size_t n, struct bytes *file)
{
    static const char text[] = "a shape with a name, and one without";
    uint64_t end[MOST_SHAPES];
    const cylint_scene_labels labels = {end, text};
    OWN_SHAPES of = scene_generate(kind, n > 0 ? n : 1, n);
    for (size_t i = 0; i < n; i++)
        end[i] = (i + 1) / 2;
    OWN_SCENE *scene = cylint_scene_new(of.shapes, n, 1, NULL);
    MUST(scene);
    if (n % 2 == 1)
        cylint_scene_set_labels(scene, &labels);
    if (n % 3 == 2)
        set_solids(scene, n);
    scene_file_write(scene, file);
}

/* ---------------------------------------------------------------- target -- */

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t most);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most,
                               unsigned seed);

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most,
                               unsigned seed)
{
    static const size_t sizes[] = {0, 1, 2, 3, 5, 8, 12, MOST_SHAPES};
    OWN_BYTES file = {NULL, NULL, 0};
    if (size >= 512 && seed % 64 > 0)
        return LLVMFuzzerMutate(data, size, most);
    write_scene((int)(seed / 64 % SCENE_KINDS),
                sizes[seed / 64 / SCENE_KINDS % 8], &file);
    memcpy(data, file.data, file.n < most ? file.n : most);
    return file.n < most ? file.n : most;
}

/* One of the shapes; what is queried is drawn from `bits`.  Exact arithmetic takes
 * most of the time of points, so that one file in two has none. */
static void query(const cylint_scene *scene, uint64_t bits, size_t size)
{
    static const int what[4] = {SCENE_FILE_LINE, SCENE_FILE_LINE,
                                SCENE_FILE_POINT,
                                SCENE_FILE_LINE | SCENE_FILE_POINT};
    const size_t n = cylint_scene_size(scene);
    scene_file_read_labels(scene);
    if (n > 0)
        scene_file_query_at(scene, bits / 16 % n,
                            (int)(bits / 4 % SCENE_FILE_SIDES), what[bits % 4]);
    if (bits % 4 == 3)
        scene_file_save_again(scene, size);
}

static long files_opened;

/* The memory ends with the file, so that a sanitizer detects reading beyond. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    cylint_scene_status status;
    void *copy;
    uint64_t bits = 0;
    if (size < 512)
        return 0;
    MUST(posix_memalign(&copy, 64, size) == 0);
    memcpy(copy, data, size);
    memcpy(&bits, data + CYLINT_FILE_CHECKSUM, sizeof bits);
    if (bits % 8 > 0)
        scene_file_repair(copy, size);
    cylint_scene *scene = cylint_scene_open_memory(copy, size, 0, &status);
    MUST((scene != NULL) == (status == CYLINT_SCENE_OK));
    if (scene) {
        files_opened++;
        query(scene, bits / 8, size);
    }
    cylint_scene_free(scene);
    free(copy);
    return 0;
}
