/*
 * turns.c - blocks are written in the order in which they were read
 */
#include "turns.h"

void turns_prepare(struct turns *turns)
{
    pthread_mutex_init(&turns->lock, NULL);
    pthread_cond_init(&turns->changed, NULL);
    turns->now = 0;
    turns->over = 0;
}

void turns_destroy(struct turns *turns)
{
    pthread_cond_destroy(&turns->changed);
    pthread_mutex_destroy(&turns->lock);
}

int turns_wait(struct turns *turns, unsigned long long ticket)
{
    pthread_mutex_lock(&turns->lock);
    while (!turns->over && turns->now != ticket) {
        pthread_cond_wait(&turns->changed, &turns->lock);
    }
    const int mine = !turns->over;
    pthread_mutex_unlock(&turns->lock);
    return mine;
}

void turns_pass(struct turns *turns)
{
    pthread_mutex_lock(&turns->lock);
    turns->now++;
    pthread_cond_broadcast(&turns->changed);
    pthread_mutex_unlock(&turns->lock);
}

void turns_end(struct turns *turns)
{
    pthread_mutex_lock(&turns->lock);
    turns->over = 1;
    pthread_cond_broadcast(&turns->changed);
    pthread_mutex_unlock(&turns->lock);
}

int turns_over(struct turns *turns)
{
    pthread_mutex_lock(&turns->lock);
    const int over = turns->over;
    pthread_mutex_unlock(&turns->lock);
    return over;
}
