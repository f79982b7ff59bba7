/*
 * text.h - parts of texts, texts in the caller's memory and in memory that grows,
 * tables of words, and different names with their numbers
 */
#ifndef CYLINT_TEXT_H
#define CYLINT_TEXT_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* CYLINT_SHRINK divides the sizes, so that the short input of a fuzzer has as
 * many blocks as a large file. */
#ifndef CYLINT_SHRINK
#define CYLINT_SHRINK 1
#endif

enum {
    LINE_MOST = (1 << 20) / CYLINT_SHRINK,  /* of a line, without its end */
    BLOCK_GOAL = (1 << 18) / CYLINT_SHRINK, /* bytes of a full block */
    BLOCK_CAPACITY = 2 * LINE_MOST, /* a long line and the bytes read with it */
    TEXT_FULL =
        (1 << 18) / CYLINT_SHRINK, /* answers of so many bytes are written */
    NPY_HEADER_MOST = (1 << 16) / CYLINT_SHRINK,
    SHOWN_MOST = 256, /* bytes of a text in a message */
    SHOWN_CAPACITY = 4 * SHOWN_MOST + 4
};

/* A part of a text; no NUL follows. */
struct string {
    const char *text;
    size_t length;
};

static inline struct string between(const char *begin, const char *end)
{
    const struct string s = {begin, (size_t)(end - begin)};
    return s;
}

static inline struct string string_of(const char *text)
{
    return between(text, text + strlen(text));
}

static inline const char *end_of(struct string s)
{
    return s.text + s.length;
}

static inline int begins_with(struct string s, const char *word)
{
    const size_t length = strlen(word);
    return s.length >= length && memcmp(s.text, word, length) == 0;
}

/* A control character that is neither a tab nor the end of a line. */
static inline int is_control(char c)
{
    return (unsigned char)c < ' ' && c != '\t' && c != '\n' && c != '\r';
}

static inline int is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* Whether a string is digits, a number up to `most`, which is below 2^60. */
int read_whole(struct string s, unsigned long long most,
               unsigned long long *value);

/* Copies a string and a NUL.  Writes each byte that is not printable ASCII,
 * and the backslash, as \xHH, so that the text is unambiguous.  After `most`
 * bytes it writes "..." and stops.  Returns `to`. */
const char *escape(char to[SHOWN_CAPACITY], struct string from, size_t most);

/* --------------------------------------------------------------- texts -- */

/* Memory of the caller, who makes it large enough. */
struct text {
    char *data;
    size_t length;
};

static inline void put_char(struct text *t, char c)
{
    t->data[t->length++] = c;
}

static inline void put_string(struct text *t, struct string s)
{
    memcpy(t->data + t->length, s.text, s.length);
    t->length += s.length;
}

static inline void put_word(struct text *t, const char *word)
{
    put_string(t, string_of(word));
}

/* Appends a whole number in decimal digits. */
void put_whole(struct text *t, unsigned long long value);

/* Copies a double to or from eight bytes of which the lowest is the first. */
static inline void copy_little_endian(void *to, const void *from)
{
    const uint16_t one = 1;
    if (*(const unsigned char *)&one == 1)
        memcpy(to, from, sizeof(double));
    else
        for (size_t i = 0; i < sizeof(double); i++)
            ((char *)to)[i] = ((const char *)from)[sizeof(double) - 1 - i];
}

static inline void put_little_endian(struct text *t, double value)
{
    copy_little_endian(t->data + t->length, &value);
    t->length += sizeof value;
}

/* --------------------------------------------------------------- words -- */

enum { NOT_GIVEN = -1, WORDS_CAPACITY = 160 };

/* A table whose elements begin with a word.  The last one's word is NULL. */
struct words {
    const void *table;
    size_t size; /* of an element */
};

#define WORDS(table) ((struct words){(table), sizeof *(table)})

/* The index of a word, or NOT_GIVEN. */
int find_word(struct words words, struct string s);

/* Writes `a, b or c`.  Returns `to`. */
const char *list_words(char to[WORDS_CAPACITY], struct words words);

/* Whether the word can be what was meant by the string. */
int is_near(struct string s, struct string word);

/* Returns the word if it is near to the string, and nearer than `best`; else
 * `best`, which is NULL at first. */
const char *nearer_word(struct string s, const char *best, const char *word);

/* The nearest word of a table, of equally near ones the first; or NULL. */
const char *similar_word(struct words words, struct string s);

/* -------------------------------------------------- growing texts, names -- */

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
