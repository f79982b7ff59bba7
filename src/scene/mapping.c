/*
 * mapping.c - files, and their bytes in memory
 */
#ifdef __linux__
#define _DEFAULT_SOURCE 1 /* fileno() and mmap() with -std=c99 */
#endif
#if defined(__unix__) || defined(__APPLE__)
#define CYLINT_HAS_MMAP
#include <sys/mman.h>
#include <sys/stat.h>
#endif

#include "mapping.h"

#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

enum { FIRST_BYTES = 1 << 16, MAPPING_ALIGNMENT = 64 };

/* Moves the bytes to memory of twice the size. */
static int double_memory(cylint_memory *memory)
{
    cylint_memory more;
    if (memory->bytes > SIZE_MAX / 2 ||
        !cylint_memory_allocate(&more, NULL, 2 * memory->bytes))
        return 0;
    memcpy(more.data, memory->data, memory->bytes);
    cylint_memory_free(memory);
    *memory = more;
    return 1;
}

/* Bytes of memory for the file, with one to read beyond its end. */
static size_t bytes_for(FILE *file)
{
    const long size = fseek(file, 0, SEEK_END) == 0 ? ftell(file) : -1;
    rewind(file);
    return size >= 0 && size < LONG_MAX ? (size_t)size + 1 : FIRST_BYTES;
}

/* Reads to the end, of a pipe too. */
static cylint_scene_status read_file(cylint_memory *m, FILE *file)
{
    size_t bytes = 0;
    if (!cylint_memory_allocate(m, NULL, bytes_for(file)))
        return CYLINT_SCENE_EMEMORY;
    for (;;) {
        bytes += fread((char *)m->data + bytes, 1, m->bytes - bytes, file);
        if (bytes < m->bytes)
            break;
        if (!double_memory(m))
            return CYLINT_SCENE_EMEMORY;
    }
    m->bytes = bytes;
    return ferror(file) ? CYLINT_SCENE_EFILE : CYLINT_SCENE_OK;
}

#ifdef CYLINT_HAS_MMAP

static void unmap_file(void *memory)
{
    const cylint_memory *m = memory;
    munmap(m->data, m->bytes);
}

/* Returns 0 if the file cannot be mapped. */
static int map_file(cylint_memory *m, FILE *file, size_t least)
{
    struct stat about;
    if (fstat(fileno(file), &about) != 0 || !S_ISREG(about.st_mode) ||
        (uintmax_t)about.st_size < least || (uintmax_t)about.st_size > SIZE_MAX)
        return 0;
    void *data = mmap(NULL, (size_t)about.st_size, PROT_READ, MAP_SHARED,
                      fileno(file), 0);
    if (data == MAP_FAILED)
        return 0;
    *m = (cylint_memory){data, (size_t)about.st_size, m, unmap_file};
    return 1;
}

int cylint_file_is_replaceable(const char *path)
{
    struct stat about;
    return stat(path, &about) != 0 || S_ISREG(about.st_mode);
}

#else

#define map_file(m, file, least) ((void)(least), 0)

int cylint_file_is_replaceable(const char *path)
{
    (void)path;
    return 1;
}

#endif

/* The file is opened once: to close a pipe would end its writer. */
cylint_scene_status cylint_mapping_open(cylint_memory *m, const char *path,
                                        size_t least, int is_read)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return CYLINT_SCENE_EFILE;
    const cylint_scene_status status = !is_read && map_file(m, file, least)
                                           ? CYLINT_SCENE_OK
                                           : read_file(m, file);
    fclose(file);
    return status;
}

/* Releases nothing: the bytes are those of the caller. */
static void leave(void *handle)
{
    (void)handle;
}

cylint_scene_status cylint_mapping_of_memory(cylint_memory *m, const void *data,
                                             size_t bytes)
{
    if ((uintptr_t)data % MAPPING_ALIGNMENT == 0) {
        *m = (cylint_memory){(void *)(uintptr_t)data, bytes, NULL, leave};
        return CYLINT_SCENE_OK;
    }
    if (!cylint_memory_allocate(m, NULL, bytes))
        return CYLINT_SCENE_EMEMORY;
    memcpy(m->data, data, bytes);
    return CYLINT_SCENE_OK;
}
