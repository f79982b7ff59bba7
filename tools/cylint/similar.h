/*
 * similar.h - the known word that is nearest to a mistyped one
 */
#ifndef CYLINT_SIMILAR_H
#define CYLINT_SIMILAR_H

#include <stddef.h>

/* A text that is not one of the expected words, and the nearest of these. */
struct similar {
    const char *text;
    size_t length;
    const char *word; /* NULL: no word is near */
    size_t distance;
};

struct similar similar_to(const char *text, size_t length);

/* Compares one more word, which the caller keeps.  Of equally near words the
 * first stays. */
void similar_try(struct similar *similar, const char *word);

/* The nearest of `words` (NULL at the end), or NULL. */
const char *similar_word(const char *const *words, const char *text,
                         size_t length);

#endif
