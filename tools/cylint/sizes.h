/*
 * sizes.h - the sizes of buffers, and the longest line
 *
 * CYLINT_SHRINK divides them all, so that the short input of a fuzzer has as
 * many blocks as a large file.
 */
#ifndef CYLINT_SIZES_H
#define CYLINT_SIZES_H

#ifndef CYLINT_SHRINK
#define CYLINT_SHRINK 1
#endif

enum {
    LINE_MOST = (1 << 20) / CYLINT_SHRINK, /* of a line, without its end */
    BLOCK_GOAL =
        (1 << 18) / CYLINT_SHRINK,  /* a block is answered from this size on */
    BLOCK_CAPACITY = 2 * LINE_MOST, /* a long line and the bytes read with it */
    TEXT_FULL =
        (1 << 18) / CYLINT_SHRINK, /* answers are written from this size on */
    NPY_HEADER_MOST = (1 << 16) / CYLINT_SHRINK
};

#endif
