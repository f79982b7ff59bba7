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

/* Fills the picture.  Returns 0 or an exit status. */
int trace(const struct drawing *drawing, const struct stage *stage,
          const struct backdrop *backdrop);

#endif
