/*
 * trace.h - the rows of a picture, shared out among threads
 */
#ifndef CYLINT_TRACE_H
#define CYLINT_TRACE_H

#include "light.h"
#include "picture.h"
#include "view.h"

/* Behind the shapes: from the picture's upper edge to its lower one. */
struct backdrop {
    int transparent;
    struct vector top, bottom;
};

/* Fills the picture; its bytes do not depend on the number of workers.
 * progress: also where standard error is not a terminal.  Returns 0 or an
 * exit status. */
int trace(struct picture *picture, const struct stage *stage,
          const struct view *view, const struct backdrop *backdrop, int samples,
          int workers, int progress);

#endif
