/*
 * mapping.h - the bytes of a file in memory
 */
#ifndef CYLINT_SCENE_MAPPING_H
#define CYLINT_SCENE_MAPPING_H

#include <stddef.h>

#include "../bvh/memory.h"
#include "cylint_scene.h"

typedef struct cylint_mapping {
    const void *data; /* NULL: none; else at the begin of a cache line */
    size_t bytes;
    int is_mapped;
    cylint_memory memory; /* of a copy */
} cylint_mapping;

/* Maps a file of at least `least` bytes, or reads it: if is_read is not 0, if the
 * system cannot map it, or if it is shorter.  EFILE: errno is set. */
cylint_scene_status cylint_mapping_open(cylint_mapping *mapping,
                                        const char *path, size_t least,
                                        int is_read);

/* The same for bytes in memory, which are copied unless they lie at the begin of
 * a cache line. */
cylint_scene_status cylint_mapping_of_memory(cylint_mapping *mapping,
                                             const void *data, size_t bytes);

void cylint_mapping_close(cylint_mapping *mapping);

#endif
