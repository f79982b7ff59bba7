/*
 * trace.h - traces the rows of a picture on several threads
 */
#ifndef CYLINT_TRACE_H
#define CYLINT_TRACE_H

#include "light.h"
#include "picture.h"
#include "view.h"

/* The background, from the picture's upper edge to its lower one. */
struct backdrop {
    int transparent;
    struct vector top, bottom;
};

/* Fills the picture; its bytes do not depend on the number of workers.
 * progress: report it even if standard error is no terminal.  Returns 0 or an
 * exit status. */
int trace(struct picture *picture, const struct stage *stage,
          const struct view *view, const struct backdrop *backdrop, int samples,
          int workers, int progress);

#endif
