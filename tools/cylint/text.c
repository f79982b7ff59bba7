/*
 * text.c - parts of texts, texts in the caller's memory, and tables of words
 */
#include "text.h"

int read_whole(struct string s, unsigned long long most,
               unsigned long long *value)
{
    const char *p = s.text;
    *value = 0;
    for (; p < end_of(s) && is_digit(*p) && *value <= most; p++)
        *value = 10 * *value + (unsigned long long)(*p - '0');
    return s.length > 0 && p == end_of(s) && *value <= most;
}

void put_whole(struct text *t, unsigned long long value)
{
    char digits[24], *p = digits + sizeof digits;
    do {
        *--p = (char)('0' + value % 10);
        value /= 10;
    } while (value);
    put_string(t, between(p, digits + sizeof digits));
}

const char *escape(char to[SHOWN_CAPACITY], struct string from, size_t most)
{
    static const char hex[] = "0123456789abcdef";
    struct text t = {to, 0};
    for (size_t i = 0; i < from.length && i < most; i++) {
        const unsigned char c = (unsigned char)from.text[i];
        if (c >= 0x20 && c < 0x7f && c != '\\') {
            put_char(&t, (char)c);
        } else {
            put_word(&t, "\\x");
            put_char(&t, hex[c >> 4]);
            put_char(&t, hex[c & 15]);
        }
    }
    put_word(&t, from.length > most ? "..." : "");
    put_char(&t, '\0');
    return to;
}

/* --------------------------------------------------------------- words -- */

static const char *word_of_table(struct words words, int i)
{
    const char *word;
    memcpy(&word, (const char *)words.table + (size_t)i * words.size,
           sizeof word);
    return word;
}

int find_word(struct words words, struct string s)
{
    const char *word;
    for (int i = 0; (word = word_of_table(words, i)) != NULL; i++)
        if (strlen(word) == s.length && memcmp(word, s.text, s.length) == 0)
            return i;
    return NOT_GIVEN;
}

const char *list_words(char to[WORDS_CAPACITY], struct words words)
{
    struct text t = {to, 0};
    for (int i = 0; word_of_table(words, i); i++) {
        if (i > 0)
            put_word(&t, word_of_table(words, i + 1) ? ", " : " or ");
        put_word(&t, word_of_table(words, i));
    }
    put_char(&t, '\0');
    return to;
}

enum { COMPARED_MOST = 31 };

/* Upper and lower case count as equal. */
static int is_same_letter(char a, char b)
{
    return (a | 0x20) == (b | 0x20);
}

static int lesser(int a, int b)
{
    return a < b ? a : b;
}

/* The number of characters inserted, deleted or replaced, and of neighbours
 * exchanged (optimal string alignment).  cost[i][j] is that of the first i
 * and j characters. */
static int edit_distance(struct string s, struct string word)
{
    const char *a = s.text, *b = word.text;
    int cost[COMPARED_MOST + 1][COMPARED_MOST + 1] = {{0}};
    for (size_t i = 0; i <= s.length; i++)
        for (size_t j = 0; j <= word.length; j++) {
            int *c = &cost[i][j];
            *c = (int)(i + j);
            if (i > 0 && j > 0)
                *c = lesser(cost[i - 1][j - 1] +
                                !is_same_letter(a[i - 1], b[j - 1]),
                            lesser(cost[i - 1][j], cost[i][j - 1]) + 1);
            if (i > 1 && j > 1 && is_same_letter(a[i - 1], b[j - 2]) &&
                is_same_letter(a[i - 2], b[j - 1]))
                *c = lesser(*c, cost[i - 2][j - 2] + 1);
        }
    return cost[s.length][word.length];
}

/* A word is near if the distance is at most a third of the text's length, or
 * 1, and less than the length. */
int is_near(struct string s, struct string word)
{
    const int length = (int)s.length, third = length < 6 ? 1 : length / 3;
    return s.length <= COMPARED_MOST && word.length <= COMPARED_MOST &&
           edit_distance(s, word) <= lesser(third, length - 1);
}

const char *nearer_word(struct string s, const char *best, const char *word)
{
    return is_near(s, string_of(word)) &&
                   (!best || edit_distance(s, string_of(word)) <
                                 edit_distance(s, string_of(best)))
               ? word
               : best;
}

const char *similar_word(struct words words, struct string s)
{
    const char *best = NULL;
    for (int i = 0; word_of_table(words, i); i++)
        best = nearer_word(s, best, word_of_table(words, i));
    return best;
}
