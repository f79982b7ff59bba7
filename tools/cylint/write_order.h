/*
 * write_order.h - blocks are written in the order in which they were read
 *
 * Every block gets a ticket when it is read: 0, 1, 2, ...  Only the thread with
 * the next ticket may write, until it calls write_order_pass() or
 * write_order_end().
 */
#ifndef CYLINT_WRITE_ORDER_H
#define CYLINT_WRITE_ORDER_H

#include <pthread.h>

struct write_order {
    pthread_mutex_t lock;
    pthread_cond_t changed;
    unsigned long long next; /* the next ticket to write */
    int ended;               /* the work has ended; no ticket may write */
};

void write_order_prepare(struct write_order *order);
void write_order_destroy(struct write_order *order);

/* Waits until this ticket is the next.  Returns 1, or 0 if the work has ended. */
int write_order_wait(struct write_order *order, unsigned long long ticket);

/* Only the thread with the next ticket may call these.  write_order_pass()
 * lets the following ticket write; write_order_end() ends the work. */
void write_order_pass(struct write_order *order);
void write_order_end(struct write_order *order);

/* Returns whether the work has ended. */
int write_order_ended(struct write_order *order);

#endif
