/*
 * sizes.h - how many bytes are handled at a time, and how many at most
 *
 * CYLINT_SHRINK divides them all, so that a fuzzer's few bytes are cut into
 * as many blocks as a large file is.
 */
#ifndef CYLINT_SIZES_H
#define CYLINT_SIZES_H

#ifndef CYLINT_SHRINK
#define CYLINT_SHRINK 1
#endif

enum {
    LINE_MOST = (1 << 20) / CYLINT_SHRINK,  /* of a line, its end not counted */
    BLOCK_GOAL = (1 << 18) / CYLINT_SHRINK, /* enough to begin answering */
    BLOCK_ROOM = 2 * LINE_MOST, /* a long line, and what comes with it */
    TEXT_FULL = (1 << 18) / CYLINT_SHRINK, /* time to write answers out */
    NPY_HEADER_MOST = (1 << 16) / CYLINT_SHRINK
};

#endif
