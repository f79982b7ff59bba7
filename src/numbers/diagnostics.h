/*
 * diagnostics.h - builds that check every decision or count the stages
 */
#ifndef CYLINT_DIAGNOSTICS_H
#define CYLINT_DIAGNOSTICS_H

#include "cylint.h"

/* A build that asks every question again in every digit (make PARANOID=1). */
#ifdef CYLINT_PARANOID
#include <stdlib.h>
#define CYLINT_IS_PARANOID 1
#define cylint_contradiction(wrong) ((wrong) ? abort() : (void)0)
#else
#define CYLINT_IS_PARANOID 0
#define cylint_contradiction(wrong) ((void)(0 && (wrong)))
#endif

/* A build that counts how far questions must go (make stages); not for
 * several threads. */
enum {
    CYLINT_STAGE_FILTER, /* asked one by one: the kernels did not decide */
    CYLINT_STAGE_QUANTA, /* a sign near 0, but nothing was rounded */
    CYLINT_STAGE_PAIRS,
    CYLINT_STAGE_EXACT,
    CYLINT_STAGE_MIDDLE, /* a root beside the middle of two doubles */
    CYLINT_STAGES
};
#ifdef CYLINT_COUNT_STAGES
extern CYLINT_API unsigned long long cylint_stages[CYLINT_STAGES];
#define cylint_reached(stage) ((void)cylint_stages[CYLINT_STAGE_##stage]++)
#else
#define cylint_reached(stage) ((void)0)
#endif

#endif
