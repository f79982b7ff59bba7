/*
 * records.h - files of cases with known answers
 *
 * A line is a record of a case, then => and what is known of it.  Lines that begin
 * with # and empty ones are comments.
 */
#ifndef CYLINT_TEST_RECORDS_H
#define CYLINT_TEST_RECORDS_H

#include "check.h"
#include "families.h"

/* Calls take() with both parts of each record; there are `least` or more.  take()
 * returns the end of what it read in the second part, or NULL if the record is
 * wrong. */
static inline void each_record(const char *path, int least,
                               const char *take(const char *record,
                                                const char *known))
{
    char text[1500];
    int n = 0;
    FILE *f = fopen(path, "r");
    if (!CHECK(f))
        return;
    while (fgets(text, sizeof text, f)) {
        char *arrow = strstr(text, "=>");
        if (text[0] == '#' || text[0] == '\n')
            continue;
        if (arrow)
            *arrow = '\0';
        const char *end = arrow ? take(text, arrow + 2) : NULL;
        if (CHECK(end && end[strspn(end, " \n")] == '\0'))
            n++;
        else
            REPORT("%s: %s", path, text);
    }
    fclose(f);
    CHECK(n >= least);
}

/* NULL: no relation. */
static inline const char *relation_word(int relation)
{
    static const char *const words[] = {"miss", "touch", "along", "cross"};
    return relation >= 0 && relation < 4 ? words[relation] : NULL;
}

/* Reads the relation and the number of hits.  Returns a pointer behind them, or
 * NULL. */
static inline const char *read_relation(const char *known, cylint_answer *to)
{
    char word[8];
    int used;
    if (sscanf(known, "%7s %d%n", word, &to->n, &used) != 2 || to->n > 2)
        return NULL;
    for (int i = 0; relation_word(i); i++)
        if (strcmp(relation_word(i), word) == 0) {
            to->relation = i;
            return known + used;
        }
    return NULL;
}

/* Reads the word of a status.  Returns a pointer behind it, or NULL. */
static inline const char *read_status(const char *known, int *status)
{
    static const char *const words[] = {"ok",         "nonfinite", "axis",
                                        "degenerate", "radius",    "angle",
                                        "ends",       "direction", "domain"};
    char word[12];
    int used;
    if (sscanf(known, "%11s%n", word, &used) != 1)
        return NULL;
    for (*status = 0; *status < (int)(sizeof words / sizeof *words); ++*status)
        if (strcmp(words[*status], word) == 0)
            return known + used;
    return NULL;
}

#endif
