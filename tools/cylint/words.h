/*
 * words.h - tables of words: which one a text is, the nearest one, all of them
 */
#ifndef CYLINT_WORDS_H
#define CYLINT_WORDS_H

#include <stddef.h>

enum { NOT_GIVEN = -1, WORDS_CAPACITY = 160 };

/* A table whose elements begin with a word.  The last one's word is NULL. */
struct words {
    const void *table;
    size_t size; /* of an element */
};

#define WORDS(table) ((struct words){(table), sizeof *(table)})

/* Word i, or NULL at the end. */
const char *word_at(struct words words, int i);

/* The index of the text, or NOT_GIVEN. */
int find_word(struct words words, const char *text, size_t length);

/* Writes `a, b or c`.  Returns `to`. */
const char *list_words(char to[WORDS_CAPACITY], struct words words);

/* A text that is not one of the expected words, and the nearest of these. */
struct similar {
    const char *text;
    size_t length;
    const char *word; /* NULL: no word is near */
    int most;         /* the distance of a nearer word */
};

/* Compares the words that the caller keeps.  Of equally near ones the first
 * stays. */
struct similar similar_to(const char *text, size_t length);
void similar_try(struct similar *similar, const char *word);

/* The nearest word of a table, or NULL. */
const char *similar_word(struct words words, const char *text, size_t length);

#endif
