/*
 * processors.h - how many processors this process may use
 */
#ifndef CYLINT_PROCESSORS_H
#define CYLINT_PROCESSORS_H

/* At least 1. */
int processors(void);

#endif
