/*
 * turns.h - blocks leave in the order in which they came
 *
 * Every block gets a ticket when it is read, 0, 1, 2, ...; the
 * thread whose ticket is next may write, alone, until it passes the turn on or
 * ends the work.
 */
#ifndef CYLINT_TURNS_H
#define CYLINT_TURNS_H

#include <pthread.h>

struct turns {
    pthread_mutex_t lock;
    pthread_cond_t changed;
    unsigned long long now; /* the ticket whose turn it is */
    int over;               /* nobody has the turn any more */
};

void turns_prepare(struct turns *turns);
void turns_destroy(struct turns *turns);

/* Waits for the ticket's turn; returns 0 if the work ended before it came. */
int turns_wait(struct turns *turns, unsigned long long ticket);

/* Both for the one whose turn it is. */
void turns_pass(struct turns *turns);
void turns_end(struct turns *turns);

int turns_over(struct turns *turns);

#endif
