/*
 * mapping.h - files, and their bytes in memory
 */
#ifndef CYLINT_SCENE_MAPPING_H
#define CYLINT_SCENE_MAPPING_H

#include "../bvh/memory.h"
#include "cylint_scene.h"

/* Maps a file of at least `least` bytes, or reads it: if is_read is not 0, if the
 * system cannot map it, or if it is shorter.  *file must then stay at its address.
 * After a failure the memory is to be freed too.  EFILE: errno is set. */
cylint_scene_status cylint_mapping_open(cylint_memory *file, const char *path,
                                        size_t least, int is_read);

/* The same for bytes in memory, which are copied unless they lie at the begin of
 * a cache line; then they must stay. */
cylint_scene_status cylint_mapping_of_memory(cylint_memory *file,
                                             const void *data, size_t bytes);

/* Whether another file can take the place of this one: not of a pipe, a device or a
 * folder. */
int cylint_file_is_replaceable(const char *path);

#endif
