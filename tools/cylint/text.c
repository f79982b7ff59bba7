/*
 * text.c - whole numbers, escaped bytes, and tables of words
 */
#include "text.h"

void put_whole(struct text *t, unsigned long long value)
{
    char digits[24];
    size_t i = sizeof digits;
    do {
        digits[--i] = (char)('0' + value % 10);
        value /= 10;
    } while (value);
    put_bytes(t, digits + i, sizeof digits - i);
}

int read_whole(const char *p, const char *end, unsigned long long most,
               unsigned long long *value)
{
    *value = 0;
    if (p == end)
        return 0;
    for (; p < end && *p >= '0' && *p <= '9' && *value <= most; p++)
        *value = 10 * *value + (unsigned long long)(*p - '0');
    return p == end && *value <= most;
}

size_t escape_bytes(char *to, const char *from, const char *end, size_t most)
{
    static const char hex[] = "0123456789abcdef";
    struct text t = {to, 0};
    const char *last = (size_t)(end - from) > most ? from + most : end;
    for (const char *p = from; p < last; p++) {
        const unsigned char c = (unsigned char)*p;
        if (c >= 0x20 && c < 0x7f && c != '\\') {
            put_char(&t, *p);
        } else {
            put_string(&t, "\\x");
            put_char(&t, hex[c >> 4]);
            put_char(&t, hex[c & 15]);
        }
    }
    put_string(&t, last < end ? "..." : "");
    to[t.length] = '\0';
    return t.length;
}

/* --------------------------------------------------------------- words -- */

enum { LENGTH_MOST = 31 };

const char *word_at(struct words words, int i)
{
    const char *word;
    memcpy(&word, (const char *)words.table + (size_t)i * words.size,
           sizeof word);
    return word;
}

int find_word(struct words words, const char *text, size_t length)
{
    const char *word;
    for (int i = 0; (word = word_at(words, i)) != NULL; i++)
        if (strlen(word) == length && memcmp(word, text, length) == 0)
            return i;
    return NOT_GIVEN;
}

const char *list_words(char to[WORDS_CAPACITY], struct words words)
{
    struct text t = {to, 0};
    for (int i = 0; word_at(words, i); i++) {
        put_string(&t, i == 0                          ? ""
                       : word_at(words, i + 1) == NULL ? " or "
                                                       : ", ");
        put_string(&t, word_at(words, i));
    }
    put_char(&t, '\0');
    return to;
}

/* Upper and lower case count as equal. */
static int same(char a, char b)
{
    const int differs = a ^ b;
    return differs == 0 ||
           (differs == 0x20 && (a | 0x20) >= 'a' && (a | 0x20) <= 'z');
}

static int least(int a, int b)
{
    return a < b ? a : b;
}

/*
 * The number of characters inserted, deleted or replaced, and of neighbours
 * exchanged (optimal string alignment).  cost[i][j] is the distance of a's first i and
 * b's first j characters.
 */
static int distance(const char *a, size_t a_length, const char *b,
                    size_t b_length)
{
    int cost[LENGTH_MOST + 1][LENGTH_MOST + 1];
    for (size_t i = 0; i <= a_length; i++)
        for (size_t j = 0; j <= b_length; j++) {
            if (i == 0 || j == 0) {
                cost[i][j] = (int)(i + j);
                continue;
            }
            cost[i][j] = least(cost[i - 1][j - 1] + !same(a[i - 1], b[j - 1]),
                               least(cost[i - 1][j], cost[i][j - 1]) + 1);
            if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) &&
                same(a[i - 2], b[j - 1]))
                cost[i][j] = least(cost[i][j], cost[i - 2][j - 2] + 1);
        }
    return cost[a_length][b_length];
}

/* A word is near if the distance is at most a third of the text's length, or 1, and
 * less than the length. */
struct similar similar_to(const char *text, size_t length)
{
    const int third = length > LENGTH_MOST ? -1 : (int)length / 3;
    return (struct similar){text, length, NULL,
                            least(third == 0 ? 1 : third, (int)length - 1)};
}

void similar_try(struct similar *similar, const char *word)
{
    const size_t length = strlen(word);
    if (similar->most < 0 || length > LENGTH_MOST)
        return;
    const int d = distance(similar->text, similar->length, word, length);
    if (d <= similar->most) {
        similar->word = word;
        similar->most = d - 1;
    }
}

const char *similar_word(struct words words, const char *text, size_t length)
{
    struct similar similar = similar_to(text, length);
    for (int i = 0; word_at(words, i); i++)
        similar_try(&similar, word_at(words, i));
    return similar.word;
}
