/*
 * diagnostics.h - builds that check every decision, or count the stages
 */
#ifndef CYLINT_DIAGNOSTICS_H
#define CYLINT_DIAGNOSTICS_H

#include "cylint.h"

/* A build that compares every answer with exact arithmetic (make PARANOID=1). */
#ifdef CYLINT_PARANOID
#include <stdlib.h>
#define CYLINT_IS_PARANOID 1
#define cylint_contradiction(wrong) ((wrong) ? abort() : (void)0)
#else
#define CYLINT_IS_PARANOID 0
#define cylint_contradiction(wrong) ((void)(0 && (wrong)))
#endif

/* A build that counts the queries that reach each stage (make stages).  It
 * must run in one thread. */
enum {
    CYLINT_STAGE_FILTER, /* the kernels did not decide */
    CYLINT_STAGE_PAIRS,
    CYLINT_STAGE_EXACT,
    CYLINT_STAGE_MIDDLE, /* a root close to the midpoint of two doubles */
    CYLINT_STAGES
};
#ifdef CYLINT_COUNT_STAGES
extern CYLINT_API unsigned long long cylint_stages[CYLINT_STAGES];
#define cylint_reached(stage) ((void)cylint_stages[CYLINT_STAGE_##stage]++)
#else
#define cylint_reached(stage) ((void)0)
#endif

#endif
