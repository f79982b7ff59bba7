/*
 * write_order.c - blocks are written in the order in which they were read
 */
#include "write_order.h"

void write_order_prepare(struct write_order *order)
{
    pthread_mutex_init(&order->lock, NULL);
    pthread_cond_init(&order->changed, NULL);
    order->next = 0;
    order->ended = 0;
}

void write_order_destroy(struct write_order *order)
{
    pthread_cond_destroy(&order->changed);
    pthread_mutex_destroy(&order->lock);
}

int write_order_wait(struct write_order *order, unsigned long long ticket)
{
    pthread_mutex_lock(&order->lock);
    while (!order->ended && order->next != ticket)
        pthread_cond_wait(&order->changed, &order->lock);
    const int mine = !order->ended;
    pthread_mutex_unlock(&order->lock);
    return mine;
}

void write_order_pass(struct write_order *order)
{
    pthread_mutex_lock(&order->lock);
    order->next++;
    pthread_cond_broadcast(&order->changed);
    pthread_mutex_unlock(&order->lock);
}

void write_order_end(struct write_order *order)
{
    pthread_mutex_lock(&order->lock);
    order->ended = 1;
    pthread_cond_broadcast(&order->changed);
    pthread_mutex_unlock(&order->lock);
}

int write_order_ended(struct write_order *order)
{
    pthread_mutex_lock(&order->lock);
    const int ended = order->ended;
    pthread_mutex_unlock(&order->lock);
    return ended;
}
