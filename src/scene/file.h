/*
 * file.h - the checksum of a file of a scene
 */
#ifndef CYLINT_SCENE_FILE_H
#define CYLINT_SCENE_FILE_H

#include <stddef.h>
#include <stdint.h>

/* The place of the checksum in the file, in bytes. */
enum { CYLINT_FILE_CHECKSUM = 32 };

/* The checksum of a file of at least 512 bytes, a multiple of 64, at the begin of
 * a cache line.  It does not depend on the bytes at the checksum's place. */
uint64_t cylint_file_checksum(const void *data, size_t bytes);

#endif
