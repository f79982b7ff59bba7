/*
 * file.c - writes a scene to a file, and opens it
 *
 * A file is a header of 512 bytes and the arrays of the scene as they are in
 * memory, each from a multiple of 64 bytes on, with zeros between them.  Their
 * order is that of FILE_ARRAYS; the header has the bytes of each.
 */
#ifdef __linux__
#define _DEFAULT_SOURCE 1 /* fileno(), mmap(), realpath()... with -std=c99 */
#endif
#if defined(__unix__) || defined(__APPLE__)
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../numbers/bits.h"
#include "scene.h"

/* The arrays of the scene s, in the order of the file, and how many elements each
 * has. */
#define FILE_ARRAYS(X)                                          \
    X(RECORDS, records.record, s->n)                            \
    X(TAGS, records.tag, s->n)                                  \
    X(SEMI_AXES, records.semi_axes, s->records.n_elliptic)      \
    X(NODES, bvh.nodes, s->bvh.n_nodes)                         \
    X(LEAVES, bvh.leaves, s->bvh.n_leaves)                      \
    X(BOUNDED, bounded, s->n_bounded < s->n ? s->n_bounded : 0) \
    X(OTHERS, others, s->n_others)                              \
    X(LABEL_ENDS, labels.end, s->labels.end ? s->n : 0)         \
    X(LABEL_TEXT, labels.text, label_bytes(s))                  \
    X(SOLIDS, solids.given, s->solids.n_members)

#define NAME(section, array, n) section,
typedef enum { FILE_ARRAYS(NAME) SECTIONS } section;
#undef NAME

enum { FILE_VERSION = 3, FILE_BLOCK = 64, HEADER_BYTES = 512 };

/* The bytes of this number are all different. */
#define FILE_ORDER 0x1.23456789abcdep+7

static const char file_magic[8] = {'\x89', 'C', 'Y', 'L', 'I', 'N', 'T', '\n'};

typedef struct {
    char magic[8];
    uint32_t version, sections;
    double order;
    uint64_t file_bytes;
    uint64_t checksum; /* at CYLINT_FILE_CHECKSUM */
    uint64_t n, n_bounded;
    uint64_t bytes[SECTIONS];
    double lo[3], hi[3]; /* the box of the frame */
    cylint_extent box;   /* of the hierarchy */
    char spare[512 - 8 * (13 + SECTIONS) - 24];
} file_header;

typedef char header_has_512_bytes[sizeof(file_header) == HEADER_BYTES ? 1 : -1];

/* Bytes of an element. */
#define BYTES(section, array, n) \
    [section] = sizeof *((const cylint_scene *)NULL)->array,
static const uint64_t element_bytes[SECTIONS] = {FILE_ARRAYS(BYTES)};
#undef BYTES

static size_t elements_of(const file_header *h, section i)
{
    return (size_t)(h->bytes[i] / element_bytes[i]);
}

/* ----------------------------------------------------------- the system -- */

#if defined(__unix__) || defined(__APPLE__)

/* Whether another file can take the place of this one: not of a pipe, a device, a
 * folder, or a link that leads to no name, as /dev/stdout to a removed file. */
static int is_replaceable(const char *path)
{
    struct stat about;
    return lstat(path, &about) != 0 || S_ISREG(about.st_mode);
}

/* The name that a path or a link leads to, to be freed; NULL: there is none. */
#define file_of(path) realpath(path, NULL)

/* Creates a file, which fails if the name exists, a link too.  It gets the
 * permissions of the file `old`, if there is one, and its owner, if that is
 * allowed. */
static FILE *create_file(const char *name, const char *old)
{
    struct stat about;
    const int has_old = stat(old, &about) == 0;
    const int fd = open(name, O_WRONLY | O_CREAT | O_EXCL,
                        has_old ? about.st_mode & 0777 : 0666);
    if (fd < 0)
        return NULL;
    if (has_old &&
        (fchown(fd, about.st_uid, about.st_gid) == 0 || errno == EPERM))
        fchmod(fd, about.st_mode & 0777); /* open() leaves some out */
    FILE *file = fdopen(fd, "wb");
    if (!file) {
        close(fd);
        remove(name);
    }
    return file;
}

static void unmap_file(void *memory)
{
    const cylint_memory *m = memory;
    munmap(m->data, m->bytes);
}

/* Returns 0 if the file cannot be mapped. */
static int map_file(cylint_memory *m, FILE *file)
{
    struct stat about;
    if (fstat(fileno(file), &about) != 0 || !S_ISREG(about.st_mode) ||
        (uintmax_t)about.st_size < HEADER_BYTES ||
        (uintmax_t)about.st_size > SIZE_MAX)
        return 0;
    void *data = mmap(NULL, (size_t)about.st_size, PROT_READ, MAP_SHARED,
                      fileno(file), 0);
    if (data == MAP_FAILED)
        return 0;
    *m = (cylint_memory){data, (size_t)about.st_size, m, unmap_file};
    return 1;
}

#else

#ifdef _WIN32
#define create_file(name, old) fopen(name, "wb")
#else
#define create_file(name, old) fopen(name, "wbx")
#endif
#define getpid() 0
#define is_replaceable(path) ((void)(path), 1)
#define file_of(path) NULL
#define map_file(m, file) 0

#endif

/* ------------------------------------------------------------ checksum -- */

/* Two sums for each of the 8 numbers in a block.  A changed byte changes both. */
typedef struct {
    uint64_t sum[8], sum_of_sums[8];
} file_checksum;

/* Adds whole blocks. */
static int add_blocks(void *context, const void *data, size_t bytes)
{
    file_checksum *c = context;
    const char *from = data;
    for (; bytes > 0; bytes -= FILE_BLOCK, from += FILE_BLOCK) {
        uint64_t x[8];
        memcpy(x, from, sizeof x);
        for (int i = 0; i < 8; i++) {
            c->sum[i] += x[i];
            c->sum_of_sums[i] += c->sum[i];
        }
    }
    return 1;
}

/* Different for different x. */
static uint64_t mixed(uint64_t x)
{
    return (x ^ x >> 32) * UINT64_C(0x9e3779b97f4a7c15);
}

/* A change of one byte changes one of the sums by some m, not a multiple of 2^64,
 * and, where j blocks follow from its own on, its sum of sums by j m.  So it
 * changes x by m (1 + 2 j): an odd multiple. */
static uint64_t checksum_of(const file_checksum *c)
{
    uint64_t x = 0;
    for (int i = 0; i < 8; i++)
        x = mixed(x ^ (c->sum[i] + 2 * c->sum_of_sums[i]));
    return x;
}

uint64_t cylint_file_checksum(const void *data, size_t bytes)
{
    const file_header *h = data;
    file_checksum sums = {{0}, {0}};
    file_header header = *h;
    header.checksum = 0;
    add_blocks(&sums, &header, sizeof header);
    add_blocks(&sums, h + 1, bytes - sizeof *h);
    return checksum_of(&sums);
}

/* ------------------------------------------------------------- writing -- */

/* The array of a section, and how many elements it has. */
typedef struct {
    const void *data;
    uint64_t n;
} section_array;

static uint64_t label_bytes(const cylint_scene *s)
{
    return s->labels.end && s->n > 0 ? s->labels.end[s->n - 1] : 0;
}

static section_array array_of(const cylint_scene *s, section i)
{
#define ARRAY(section, array, n) [section] = {s->array, n},
    const section_array arrays[SECTIONS] = {FILE_ARRAYS(ARRAY)};
#undef ARRAY
    return arrays[i];
}

static uint64_t whole_blocks(uint64_t bytes)
{
    return (bytes + FILE_BLOCK - 1) / FILE_BLOCK * FILE_BLOCK;
}

static file_header header_of(const cylint_scene *s)
{
    file_header h;
    memset(&h, 0, sizeof h);
    memcpy(h.magic, file_magic, sizeof h.magic);
    h.version = FILE_VERSION;
    h.sections = SECTIONS;
    h.order = FILE_ORDER;
    h.n = s->n;
    h.n_bounded = s->n_bounded;
    if (s->n_bounded > 0) {
        h.box = s->bvh.box;
        memcpy(h.lo, s->frame.lo, sizeof h.lo);
        memcpy(h.hi, s->frame.hi, sizeof h.hi);
    }
    h.file_bytes = sizeof h;
    for (section i = 0; i < SECTIONS; i++) {
        h.bytes[i] = array_of(s, i).n * element_bytes[i];
        h.file_bytes += whole_blocks(h.bytes[i]);
    }
    return h;
}

/* Gives a section and zeros up to a whole block to the writer. */
static int write_section(const char *data, size_t bytes,
                         cylint_scene_writer *writer, void *context)
{
    char last[FILE_BLOCK] = {0};
    const size_t last_bytes = bytes % FILE_BLOCK;
    if (bytes > last_bytes && !writer(context, data, bytes - last_bytes))
        return 0;
    if (last_bytes == 0)
        return 1;
    memcpy(last, data + bytes - last_bytes, last_bytes);
    return writer(context, last, sizeof last);
}

static int write_all(const cylint_scene *s, const file_header *h,
                     cylint_scene_writer *writer, void *context)
{
    if (!writer(context, h, sizeof *h))
        return 0;
    for (section i = 0; i < SECTIONS; i++)
        if (!write_section(array_of(s, i).data, (size_t)h->bytes[i], writer,
                           context))
            return 0;
    return 1;
}

cylint_scene_status cylint_scene_write(const cylint_scene *scene,
                                       cylint_scene_writer *writer,
                                       void *context)
{
    file_checksum sums = {{0}, {0}};
    if (!scene->is_finished)
        return CYLINT_SCENE_EUNFINISHED;
    file_header header = header_of(scene);
    write_all(scene, &header, add_blocks, &sums);
    header.checksum = checksum_of(&sums);
    return write_all(scene, &header, writer, context) ? CYLINT_SCENE_OK
                                                      : CYLINT_SCENE_ESTOPPED;
}

static int write_to_file(void *context, const void *data, size_t bytes)
{
    return fwrite(data, 1, bytes, context) == bytes;
}

/* Creates PATH.NUMBER.new and writes its name; of the last name of PATH, which can
 * have 255 bytes, it keeps 200.  Another thread, or a process of this number on
 * another machine, may write beside the same path. */
static FILE *create_beside(const char *path, char *beside, size_t bytes)
{
    enum { TRIES = 100, NAME_KEPT = 200 };
    const char *slash = strrchr(path, '/');
    const int kept = NAME_KEPT + (slash ? (int)(slash + 1 - path) : 0);
    FILE *file = NULL;
    for (long i = 0; !file && (i == 0 || (i < TRIES && errno == EEXIST)); i++) {
        snprintf(beside, bytes, "%.*s.%ld.new", kept, path, (long)getpid() + i);
        file = create_file(beside, path);
    }
    return file;
}

static cylint_scene_status write_and_close(const cylint_scene *s, FILE *file)
{
    const cylint_scene_status status =
        cylint_scene_write(s, write_to_file, file);
    const int why = errno;
    const int closed = fclose(file) == 0;
    if (status == CYLINT_SCENE_OK)
        return closed ? CYLINT_SCENE_OK : CYLINT_SCENE_EFILE;
    errno = why;
    return status == CYLINT_SCENE_ESTOPPED ? CYLINT_SCENE_EFILE : status;
}

/* Writes the file `beside` and renames it. */
static cylint_scene_status save_beside(const cylint_scene *s, FILE *file,
                                       const char *path, const char *beside)
{
    cylint_scene_status status = write_and_close(s, file);
#ifdef _WIN32
    if (status == CYLINT_SCENE_OK)
        remove(path); /* rename() does not replace a file */
#endif
    if (status == CYLINT_SCENE_OK && rename(beside, path) != 0)
        status = CYLINT_SCENE_EFILE;
    const int why = errno;
    if (status != CYLINT_SCENE_OK)
        remove(beside);
    errno = why;
    return status;
}

static cylint_scene_status save_at(const cylint_scene *scene, const char *path)
{
    const int replaces = is_replaceable(path);
    const size_t bytes = strlen(path) + 32;
    char *beside = malloc(bytes);
    if (!beside)
        return CYLINT_SCENE_EMEMORY;
    FILE *file =
        replaces ? create_beside(path, beside, bytes) : fopen(path, "wb");
    const cylint_scene_status status =
        !file      ? CYLINT_SCENE_EFILE
        : replaces ? save_beside(scene, file, path, beside)
                   : write_and_close(scene, file);
    free(beside);
    return status;
}

cylint_scene_status cylint_scene_save(const cylint_scene *scene,
                                      const char *path)
{
    char *file = file_of(path);
    const cylint_scene_status status = save_at(scene, file ? file : path);
    free(file);
    return status;
}

/* ------------------------------------------------------------- reading -- */

enum { FIRST_BYTES = 1 << 16 };

/* Bytes of memory for the file, with one to read beyond its end. */
static size_t bytes_for(FILE *file)
{
    const long size = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    rewind(file);
    return size >= 0 && size < LONG_MAX ? (size_t)size + 1 : FIRST_BYTES;
}

/* Reads to the end, of a pipe too, but no more of a file without the magic. */
static cylint_scene_status read_file(cylint_memory *m, FILE *file)
{
    size_t bytes = 0;
    if (!cylint_memory_allocate(m, NULL, bytes_for(file)))
        return CYLINT_SCENE_EMEMORY;
    for (;;) {
        bytes += fread((char *)m->data + bytes, 1, m->bytes - bytes, file);
        if (bytes < m->bytes ||
            (bytes >= sizeof file_magic &&
             memcmp(m->data, file_magic, sizeof file_magic) != 0))
            break;
        if (m->bytes > PTRDIFF_MAX / 2 ||
            !cylint_memory_resize(m, NULL, 2 * m->bytes))
            return CYLINT_SCENE_EMEMORY;
    }
    m->bytes = bytes;
    return ferror(file) ? CYLINT_SCENE_EFILE : CYLINT_SCENE_OK;
}

/* Maps the file, or reads it: if is_read is not 0, if the system cannot map it, or
 * if it is shorter than a header.  *m must then stay at its address.  After a
 * failure the memory is to be freed too.  The file is opened once: to close a pipe
 * would end its writer. */
static cylint_scene_status map_or_read(cylint_memory *m, const char *path,
                                       int is_read)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return CYLINT_SCENE_EFILE;
    const cylint_scene_status status =
        !is_read && map_file(m, file) ? CYLINT_SCENE_OK : read_file(m, file);
    fclose(file);
    return status;
}

/* The same for bytes in memory, which are copied unless they lie at the start of a
 * cache line. */
static cylint_scene_status use_memory(cylint_memory *m, const void *data,
                                      size_t bytes)
{
    if ((uintptr_t)data % FILE_BLOCK == 0) {
        *m = (cylint_memory){(void *)(uintptr_t)data, bytes, NULL, NULL};
        return CYLINT_SCENE_OK;
    }
    if (!cylint_memory_allocate(m, NULL, bytes))
        return CYLINT_SCENE_EMEMORY;
    memcpy(m->data, data, bytes);
    return CYLINT_SCENE_OK;
}

/* ------------------------------------------------------------- opening -- */

/* Whether the sizes are those of the arrays that the header implies. */
static int sizes_fit(const file_header *h, size_t bytes)
{
    const size_t bounded = elements_of(h, BOUNDED),
                 ends = elements_of(h, LABEL_ENDS);
    uint64_t sum = sizeof *h;
    for (int i = 0; i < SECTIONS; i++) {
        if (h->bytes[i] > bytes || h->bytes[i] % element_bytes[i] != 0)
            return 0;
        sum += whole_blocks(h->bytes[i]);
    }
    return sum == h->file_bytes && sum == bytes &&
           h->n <= CYLINT_SCENE_MOST_SHAPES && h->n_bounded <= h->n &&
           elements_of(h, RECORDS) == h->n && elements_of(h, TAGS) == h->n &&
           bounded == (h->n_bounded < h->n ? h->n_bounded : 0) &&
           elements_of(h, OTHERS) <= h->n - h->n_bounded &&
           elements_of(h, SOLIDS) <= CYLINT_SCENE_MOST_SHAPES &&
           (h->n_bounded > 0) == (h->bytes[NODES] > 0) &&
           (ends == h->n || ends == 0);
}

static cylint_scene_status check_header(const file_header *h, size_t bytes)
{
    if (bytes < sizeof h->magic ||
        memcmp(h->magic, file_magic, sizeof h->magic) != 0)
        return CYLINT_SCENE_EFORMAT;
    if (bytes < sizeof *h)
        return CYLINT_SCENE_EDAMAGED;
    if (h->version != FILE_VERSION || h->sections != SECTIONS ||
        cylint_rank(h->order) != cylint_rank(FILE_ORDER))
        return CYLINT_SCENE_EVERSION;
    return sizes_fit(h, bytes) ? CYLINT_SCENE_OK : CYLINT_SCENE_EDAMAGED;
}

/* Sets the members that lie in the file.  It is never written. */
static void point_into_file(cylint_scene *s, const file_header *h)
{
    char *data[SECTIONS], *at = (char *)(uintptr_t)h + sizeof *h;
    for (int i = 0; i < SECTIONS; i++) {
        data[i] = h->bytes[i] > 0 ? at : NULL;
        at += whole_blocks(h->bytes[i]);
    }
    s->n = (size_t)h->n;
    s->n_bounded = (size_t)h->n_bounded;
    s->n_others = elements_of(h, OTHERS);
    s->is_finished = 1;
    s->records.n = s->n;
    s->records.n_elliptic = elements_of(h, SEMI_AXES);
    s->bvh.n_nodes = elements_of(h, NODES);
    s->bvh.n_leaves = elements_of(h, LEAVES);
    s->solids.n_members = elements_of(h, SOLIDS);
#define SET(section, array, n) s->array = (void *)data[section];
    FILE_ARRAYS(SET)
#undef SET
    s->own_bytes = sizeof *s;
    cylint_bvh_set_box(&s->bvh, &h->box, CYLINT_FRAME_ERROR);
}

static int ascends(const uint32_t *number, size_t count, size_t n)
{
    for (size_t i = 0; i < count; i++)
        if (number[i] >= n || (i > 0 && number[i] <= number[i - 1]))
            return 0;
    return 1;
}

static int labels_are_sound(const file_header *h, const cylint_scene *s)
{
    uint64_t last = 0;
    for (size_t i = 0; s->labels.end && i < s->n; i++) {
        if (s->labels.end[i] < last)
            return 0;
        last = s->labels.end[i];
    }
    return last == h->bytes[LABEL_TEXT];
}

/* Whether no number in the file makes a query fail. */
static int is_sound(const cylint_scene *s, const file_header *h)
{
    return cylint_file_checksum(h, s->file.bytes) == h->checksum &&
           cylint_records_are_sound(&s->records) &&
           ascends(s->bounded, s->bounded ? s->n_bounded : 0, s->n) &&
           ascends(s->others, s->n_others, s->n) && labels_are_sound(h, s) &&
           cylint_bvh_is_sound(&s->bvh, s->n);
}

static cylint_scene_status open_file(cylint_scene *s, unsigned flags)
{
    const file_header *h = s->file.data;
    const cylint_scene_status status = check_header(h, s->file.bytes);
    if (status != CYLINT_SCENE_OK)
        return status;
    point_into_file(s, h);
    if ((s->n_bounded > 0 && (!cylint_frame_make(&s->frame, h->lo, h->hi) ||
                              !cylint_extent_is_valid(&h->box))) ||
        (!(flags & CYLINT_SCENE_TRUSTED) && !is_sound(s, h)))
        return CYLINT_SCENE_EDAMAGED;
    if (!cylint_scene_complete(s))
        return CYLINT_SCENE_EMEMORY;
    const cylint_scene_status made = cylint_solids_make(&s->solids, s);
    return made == CYLINT_SCENE_OK || made == CYLINT_SCENE_EMEMORY
               ? made
               : CYLINT_SCENE_EDAMAGED;
}

/* The scene of a file that has been mapped, or not. */
static cylint_scene *opened(cylint_scene *s, cylint_scene_status mapped,
                            unsigned flags, cylint_scene_status *status)
{
    return cylint_scene_or_null(
        s, mapped == CYLINT_SCENE_OK ? open_file(s, flags) : mapped, status);
}

cylint_scene *cylint_scene_open(const char *path, unsigned flags,
                                cylint_scene_status *status)
{
    cylint_scene *s = calloc(1, sizeof *s);
    return opened(
        s,
        s ? map_or_read(&s->file, path, (flags & CYLINT_SCENE_READ) != 0)
          : CYLINT_SCENE_EMEMORY,
        flags, status);
}

cylint_scene *cylint_scene_open_memory(const void *data, size_t bytes,
                                       unsigned flags,
                                       cylint_scene_status *status)
{
    cylint_scene *s = calloc(1, sizeof *s);
    return opened(s,
                  s ? use_memory(&s->file, data, bytes) : CYLINT_SCENE_EMEMORY,
                  flags, status);
}
