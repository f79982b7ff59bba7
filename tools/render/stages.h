/*
 * stages.h - the time of each stage of the work
 */
#ifndef CYLINT_STAGES_H
#define CYLINT_STAGES_H

struct stages {
    int reported;          /* on standard error */
    double last, last_cpu; /* seconds; of all threads together */
};

void stages_start(struct stages *stages, int reported);

/* Reports the time since the last call: `WHAT COUNT UNIT: SECONDS s, SECONDS s of
 * CPU`. */
void stages_end(struct stages *stages, const char *what,
                unsigned long long count, const char *unit);

#endif
