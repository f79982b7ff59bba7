/*
 * names.c - texts in memory that grows, and different names with their numbers
 */
#include <stdlib.h>
#include <string.h>

#include "text.h"

void *grown(void *array, size_t count, size_t *capacity, size_t size)
{
    if (count < *capacity)
        return array;
    const size_t new_capacity = *capacity > 0 ? 2 * *capacity : 64;
    void *larger = new_capacity <= SIZE_MAX / size
                       ? realloc(array, new_capacity * size)
                       : NULL;
    if (larger)
        *capacity = new_capacity;
    return larger;
}

int texts_add(struct texts *t, struct string s)
{
    uint64_t *end = grown(t->end, t->count, &t->end_capacity, sizeof *t->end);
    if (!end)
        return 0;
    t->end = end;
    while (t->capacity - t->length < s.length) {
        char *bytes = grown(t->bytes, t->capacity, &t->capacity, 1);
        if (!bytes)
            return 0;
        t->bytes = bytes;
    }
    if (s.length > 0)
        memcpy(t->bytes + t->length, s.text, s.length);
    t->length += s.length;
    t->end[t->count++] = t->length;
    return 1;
}

struct string text_at(const uint64_t *end, const char *bytes, size_t i)
{
    const size_t begin = i > 0 ? (size_t)end[i - 1] : 0;
    const size_t length = (size_t)end[i] - begin;
    return (struct string){length > 0 ? bytes + begin : "", length};
}

void texts_free(struct texts *t)
{
    free(t->bytes);
    free(t->end);
}

/* ---------------------------------------------------------------- names -- */

struct string names_get(const struct names *n, size_t number)
{
    return text_at(n->texts.end, n->texts.bytes, number);
}

static size_t hash(struct string name)
{
    uint64_t h = 14695981039346656037u; /* FNV-1a */
    for (size_t i = 0; i < name.length; i++)
        h = (h ^ (unsigned char)name.text[i]) * 1099511628211u;
    return (size_t)(h ^ h >> 32);
}

/* The bucket that has the name, or the empty one where it belongs. */
static size_t *bucket_of(const struct names *n, struct string name)
{
    size_t i = hash(name) & (n->buckets - 1);
    for (; n->bucket[i] > 0; i = (i + 1) & (n->buckets - 1)) {
        const struct string other = names_get(n, n->bucket[i] - 1);
        if (other.length == name.length &&
            memcmp(other.text, name.text, name.length) == 0)
            break;
    }
    return &n->bucket[i];
}

/* Keeps at least half of the buckets empty.  Returns 0 if there is no
 * memory. */
static int grow_buckets(struct names *n)
{
    if (2 * (n->texts.count + 1) <= n->buckets)
        return 1;
    const size_t buckets = n->buckets > 0 ? 2 * n->buckets : 64;
    size_t *bucket = calloc(buckets, sizeof *bucket);
    if (!bucket)
        return 0;
    free(n->bucket);
    n->bucket = bucket;
    n->buckets = buckets;
    for (size_t i = 0; i < n->texts.count; i++)
        *bucket_of(n, names_get(n, i)) = i + 1;
    return 1;
}

int names_add(struct names *n, struct string name, size_t *number)
{
    if (!grow_buckets(n))
        return 0;
    size_t *bucket = bucket_of(n, name);
    if (*bucket == 0) {
        if (!texts_add(&n->texts, name))
            return 0;
        *bucket = n->texts.count;
    }
    *number = *bucket - 1;
    return 1;
}

size_t names_find(const struct names *n, struct string name)
{
    const size_t found = n->buckets > 0 ? *bucket_of(n, name) : 0;
    return found > 0 ? found - 1 : n->texts.count;
}

void names_free(struct names *n)
{
    texts_free(&n->texts);
    free(n->bucket);
}
