/*
 * names.h - texts in memory that grows, and different names with their numbers
 */
#ifndef CYLINT_NAMES_H
#define CYLINT_NAMES_H

#include "text.h"

/* Texts, one after the other in memory that grows.  Zero it before use. */
struct texts {
    char *bytes;
    size_t length, capacity;
    uint64_t *end; /* of each text in bytes */
    size_t count, end_capacity;
};

/* Different names, numbered in the order in which they come.  Zero it before
 * use. */
struct names {
    struct texts texts;
    size_t *bucket; /* a hash table: a name's number from 1, or 0 */
    size_t buckets; /* 0 or a power of two */
};

/* Returns an array with space for one more element, or NULL.  At least doubles
 * the capacity if there is none. */
void *grown(void *array, size_t count, size_t *capacity, size_t size);

/* Returns 0 if there is no memory. */
int texts_add(struct texts *texts, struct string text);
/* Text i of those that end at end[0], end[1] ... */
struct string text_at(const uint64_t *end, const char *bytes, size_t i);
void texts_free(struct texts *texts);

/* Adds the name if it is new, and writes its number.  Returns 0 if there is no
 * memory. */
int names_add(struct names *names, struct string name, size_t *number);
/* The number of the name, or the number of all names. */
size_t names_find(const struct names *names, struct string name);
struct string names_get(const struct names *names, size_t number);
void names_free(struct names *names);

#endif
