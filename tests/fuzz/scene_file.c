/*
 * scene_file.c - fuzzes files of scenes
 *
 * The first three bytes of an input set the kind and size of a scene (scenes.h) and
 * what is queried.  The others change the file of this scene, which is then opened.
 * Of seven files in eight the checksum is made right after the changes.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "scene_file.h"
#include "scenes.h"

struct input {
    const uint8_t *p, *end;
};

static unsigned next_byte(struct input *in)
{
    return in->p < in->end ? *in->p++ : 0;
}

static size_t next_place(struct input *in)
{
    const unsigned low = next_byte(in);
    return low | (size_t)next_byte(in) << 8;
}

/* ------------------------------------------------------------- the file -- */

enum { SIZES = 8 };

/* Solids of three shapes; the second of each is a complement. */
static void set_solids(cylint_scene *scene, size_t n)
{
    cylint_member members[36];
    for (size_t i = 0; i < n; i++)
        members[i] =
            (cylint_member){i, i / 3, i % 3 == 1 ? -2 : 1 + (int)(i % 2)};
    MUST(cylint_scene_set_solids(scene, members, n) == CYLINT_SCENE_OK);
}

/* The file of a scene of this kind and size, one shape in two with a label. */
static struct bytes make_file(int kind, size_t n)
{
    static const char text[] = "a shape with a name, and one without";
    struct bytes file = {NULL, NULL, 0};
    uint64_t end[36];
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
    scene_file_write(scene, &file);
    return file;
}

static const struct bytes *file_of(unsigned kind, unsigned size)
{
    static const size_t n[SIZES] = {0, 1, 2, 3, 5, 8, 12, 33};
    static struct bytes files[SCENE_KINDS][SIZES];
    struct bytes *file = &files[kind % SCENE_KINDS][size % SIZES];
    if (!file->memory)
        *file = make_file((int)(kind % SCENE_KINDS), n[size % SIZES]);
    return file;
}

/* -------------------------------------------------------------- changes -- */

/* Any bits, or a number at a limit. */
static double any_number(struct input *in)
{
    static const double limits[] = {
        0,       -0.0,     1,        -1,        0.5,     HUGE_VAL, -HUGE_VAL,
        DBL_MAX, -DBL_MAX, DBL_MIN,  0x1p-1074, 0x1p60,  0x1p-60,  0x1p100,
        0x1p400, 0x1p-400, 0x1p-120, 0x1p200,   0x1p-537};
    const unsigned which = next_byte(in),
                   count = sizeof limits / sizeof *limits;
    double x;
    uint64_t bits = 0;
    if (which < count)
        return limits[which];
    if (which < 2 * count)
        return nextafter(limits[which - count], which % 2 ? HUGE_VAL : 0);
    if (which < 0x40)
        return (double)NAN;
    for (int i = 0; i < 8; i++)
        bits = bits << 8 | next_byte(in);
    memcpy(&x, &bits, sizeof x);
    return x;
}

static void write_number(struct bytes *b, size_t at, double x)
{
    memcpy(b->data + at, &x, sizeof x);
}

static double read_number(const struct bytes *b, size_t at)
{
    double x;
    memcpy(&x, b->data + at, sizeof x);
    return x;
}

/* Fewer blocks, or more, of zeros. */
static void change_length(struct bytes *b, size_t blocks)
{
    const size_t n = blocks * 64 % (SCENE_FILE_MOST + 1);
    if (n > b->n)
        memset(b->data + b->n, 0, n - b->n);
    b->n = n;
}

static void change_file(struct bytes *b, struct input *in)
{
    const unsigned how = next_byte(in), size = 1u << (how >> 4) % 8;
    const size_t place = next_place(in);
    if (how % 16 == 0)
        change_length(b, place);
    if (b->n < 512)
        return;
    /* of one byte at any place; else of numbers of this size */
    const size_t at = place % (b->n / size) * size,
                 whole = place % (b->n / 8) * 8, any = place % b->n;
    switch (how % 16) {
    case 1:
    case 2:
        b->data[any] = (char)next_byte(in);
        break;
    case 3:
        b->data[any] = (char)(b->data[any] ^ (char)next_byte(in));
        break;
    case 4:
        b->data[any] = (char)(b->data[any] + (char)next_byte(in));
        break;
    case 5:
    case 6:
        for (unsigned i = 0; i < size && i < 8; i++)
            b->data[at + i] = (char)next_byte(in);
        break;
    case 7:
    case 8:
        memmove(b->data + at, b->data + next_place(in) % (b->n / size) * size,
                size);
        break;
    case 9:
        memset(b->data + at, (int)next_byte(in), size);
        break;
    case 10:
    case 11:
    case 12:
        write_number(b, whole, any_number(in));
        break;
    case 13:
        write_number(b, whole,
                     nextafter(read_number(b, whole), any_number(in)));
        break;
    case 14:
        write_number(b, whole, -read_number(b, whole));
        break;
    default:
        write_number(b, whole, read_number(b, whole) * any_number(in));
    }
}

/* --------------------------------------------------------------- target -- */

/* Memory that ends with the file, so that a sanitizer detects reading beyond. */
static void *exact_copy(const struct bytes *from)
{
    void *copy;
    MUST(posix_memalign(&copy, 64, from->n) == 0);
    memcpy(copy, from->data, from->n);
    return copy;
}

/* Exact arithmetic takes most of the time of points, so that one input in two has
 * none. */
static void query(const cylint_scene *scene, unsigned shape, int side,
                  size_t bytes)
{
    const size_t n = cylint_scene_size(scene);
    const unsigned what = shape / 64;
    scene_file_read_labels(scene);
    if (n > 0 && what != 2)
        scene_file_query_line_at(scene, shape % 64 % n, side);
    if (n > 0 && what >= 2)
        scene_file_query_point_at(scene, shape % 64 % n, side);
    if (what == 3)
        scene_file_save_again(scene, bytes);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static struct bytes work;
    struct input in = {data, data + size};
    cylint_scene_status status;
    const unsigned kind = next_byte(&in), sizes = next_byte(&in),
                   shape = next_byte(&in);
    const struct bytes *file = file_of(kind, sizes);
    const int is_changed = in.p < in.end;
    const int is_repaired = sizes / SIZES % 8 > 0;
    if (!work.memory)
        bytes_reserve(&work);
    memcpy(work.data, file->data, file->n);
    work.n = file->n;
    while (in.p < in.end)
        change_file(&work, &in);
    if (is_repaired)
        scene_file_repair(work.data, work.n);
    void *copy = exact_copy(&work);
    cylint_scene *scene = cylint_scene_open_memory(copy, work.n, 0, &status);
    MUST(scene || is_changed);
    MUST((scene != NULL) == (status == CYLINT_SCENE_OK));
    if (scene)
        query(scene, shape, (int)(kind / SCENE_KINDS) % SCENE_FILE_SIDES,
              work.n);
    cylint_scene_free(scene);
    free(copy);
    return 0;
}
