/*
 * turns.h - blocks are written in the order in which they were read
 *
 * Every block gets a ticket when it is read: 0, 1, 2, ...  Only the thread with
 * the next ticket may write, until it calls turns_pass() or turns_end().
 */
#ifndef CYLINT_TURNS_H
#define CYLINT_TURNS_H

#include <pthread.h>

struct turns {
    pthread_mutex_t lock;
    pthread_cond_t changed;
    unsigned long long now; /* the next ticket to write */
    int over;               /* the work has ended; no ticket may write */
};

void turns_prepare(struct turns *turns);
void turns_destroy(struct turns *turns);

/* Waits until this ticket is the next.  Returns 1, or 0 if the work has ended. */
int turns_wait(struct turns *turns, unsigned long long ticket);

/* Only the thread with the next ticket may call these.  turns_pass() lets the
 * following ticket write; turns_end() ends the work. */
void turns_pass(struct turns *turns);
void turns_end(struct turns *turns);

/* Returns whether the work has ended. */
int turns_over(struct turns *turns);

#endif
