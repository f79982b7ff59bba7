/*
 * similar.c - the known word that is nearest to a mistyped one
 *
 * The distance of two words is the number of characters inserted, deleted or
 * replaced, and of neighbours exchanged (optimal string alignment).  Upper and
 * lower case count as equal.  A word is near if the distance is at most a third
 * of the text's length, or 1, and less than the length.
 */
#include <string.h>

#include "similar.h"

enum { LENGTH_MOST = 31 };

struct similar similar_to(const char *text, size_t length)
{
    return (struct similar){text, length, NULL, 0};
}

static char lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

static int same(char a, char b)
{
    return lower(a) == lower(b);
}

static unsigned least(unsigned a, unsigned b)
{
    return a < b ? a : b;
}

/* cost[i][j] is the distance of a's first i and b's first j characters. */
static unsigned distance(const char *a, size_t a_length, const char *b,
                         size_t b_length)
{
    unsigned cost[LENGTH_MOST + 1][LENGTH_MOST + 1];
    for (size_t i = 0; i <= a_length; i++) {
        for (size_t j = 0; j <= b_length; j++) {
            if (i == 0 || j == 0) {
                cost[i][j] = (unsigned)(i + j);
                continue;
            }
            const unsigned replaced = !same(a[i - 1], b[j - 1]);
            unsigned d = cost[i - 1][j - 1] + replaced;
            d = least(d, least(cost[i - 1][j], cost[i][j - 1]) + 1);
            if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) &&
                same(a[i - 2], b[j - 1]))
                d = least(d, cost[i - 2][j - 2] + 1);
            cost[i][j] = d;
        }
    }
    return cost[a_length][b_length];
}

void similar_try(struct similar *similar, const char *word)
{
    const size_t length = strlen(word);
    if (length > LENGTH_MOST || similar->length > LENGTH_MOST)
        return;
    const size_t d = distance(similar->text, similar->length, word, length);
    const size_t third = similar->length / 3;
    if (d <= (third > 1 ? third : 1) && d < similar->length &&
        (!similar->word || d < similar->distance)) {
        similar->word = word;
        similar->distance = d;
    }
}

const char *similar_word(const char *const *words, const char *text,
                         size_t length)
{
    struct similar similar = similar_to(text, length);
    for (int i = 0; words[i]; i++)
        similar_try(&similar, words[i]);
    return similar.word;
}
