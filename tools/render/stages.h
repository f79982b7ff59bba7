/*
 * stages.h - what took how long
 */
#ifndef CYLINT_STAGES_H
#define CYLINT_STAGES_H

struct stages {
    int told;      /* on standard error */
    double last;   /* seconds */
};

void stages_start(struct stages *stages, int told);

/* Tells how long it took since the last call: `WHAT COUNT UNIT: SECONDS s`. */
void stages_end(struct stages *stages, const char *what,
                unsigned long long count, const char *unit);

#endif
